/* materials/bsdf_xml.c -- the XML of LBNL's BSDF files, as far as visible light goes:
 *
 *     WindowElement / Optical / Layer
 *         DataDefinition / IncidentDataStructure     Columns, Rows, TensorTree3 or TensorTree4
 *         DataDefinition / AngleBasis / AngleBasisName, AngleBasisBlock ...
 *                          AngleBasisBlock / nPhis, ThetaBounds / LowerTheta, UpperTheta
 *         WavelengthData / Wavelength                Visible: others are passed over
 *         WavelengthData / WavelengthDataBlock / WavelengthDataDirection    "Transmission Front"
 *             / ColumnAngleBasis, RowAngleBasis (Klems), AngleBasis (trees)
 *             / ScatteringDataType, ScatteringData
 *
 * Elements are known by name, wherever in their parent they stand; but Wavelength stands before the
 * blocks that it is said of, as the schema has it. A document type, and with it any entity of a
 * file's own, is refused.
 */
#include "materials/bsdf_parts.h"

#include "core/text.h"

#include <expat.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { MOST_DEPTH = 64 };

typedef struct xml_work {
    XML_Parser parser;
    bsdf_file *out;
    notices *n;
    lux_error *err;
    bool stopped;
    int depth, lines_before;

    char *text; /* what the elements looked at hold, one after the other, each with a NUL */
    size_t used, most, begin;
    int text_line;
    bool listening;

    bsdf_block block; /* the one that is open */
    bool in_block, in_bases, visible, structured;
    bsdf_side_name side;
    bsdf_part part;
    int named; /* line of its WavelengthDataDirection; 0: none yet */

    char basis[KLEMS_NAME];
    klems_ring ring[KLEMS_RINGS];
    int rings, basis_line;
} xml_work;

static int line_of(const xml_work *w)
{
    return (int)XML_GetCurrentLineNumber(w->parser) + w->lines_before;
}

#define STOP(w, code, format, ...)                                                                 \
    do {                                                                                           \
        if (!(w)->stopped)                                                                         \
            failed((w)->err, code, "%s:%d: " format, (w)->out->path, line_of(w), __VA_ARGS__);     \
        (w)->stopped = true;                                                                       \
        XML_StopParser((w)->parser, XML_FALSE);                                                    \
    } while (0)

/* A file's word, short and printable. */
static const char *shown(const char *text, char out[KLEMS_NAME])
{
    snprintf(out, KLEMS_NAME, "%s", text);
    for (char *c = out; *c; c++)
        if (*c < ' ' || *c > '~')
            *c = '?';
    return out;
}

static const char *local(const char *name)
{
    const char *colon = strrchr(name, ':');
    return colon ? colon + 1 : name;
}

/* Those whose text is wanted; the rest, geometry above all, may be long. */
static bool wanted(const char *name)
{
    static const char *const names[] = { "IncidentDataStructure",
                                         "AngleBasisName",
                                         "nPhis",
                                         "LowerTheta",
                                         "UpperTheta",
                                         "Wavelength",
                                         "AngleBasis",
                                         "WavelengthDataDirection",
                                         "ColumnAngleBasis",
                                         "RowAngleBasis",
                                         "ScatteringDataType",
                                         "ScatteringData" };
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strcmp(name, names[i]) == 0)
            return true;
    return false;
}

static void on_start(void *user, const char *qualified, const char **attributes)
{
    (void)attributes;
    xml_work *w      = user;
    const char *name = local(qualified);
    if (w->stopped)
        return;
    if (++w->depth > MOST_DEPTH)
        STOP(w, ERR_FORMAT, "XML nested deeper than %d elements", MOST_DEPTH);
    w->listening = wanted(name);
    w->begin     = w->used;
    w->text_line = line_of(w);
    if (strcmp(name, "AngleBasis") == 0 && !w->in_block) {
        w->in_bases   = true;
        w->rings      = 0;
        w->basis[0]   = '\0';
        w->basis_line = line_of(w);
    } else if (strcmp(name, "AngleBasisBlock") == 0 && w->in_bases) {
        if (w->rings == KLEMS_RINGS)
            STOP(w, ERR_FORMAT, "an AngleBasis of more than %d rings", KLEMS_RINGS);
        else
            w->ring[w->rings] =
                (klems_ring){ .low_deg  = w->rings ? w->ring[w->rings - 1].high_deg : 0,
                              .high_deg = -1.0 };
        w->rings += !w->stopped;
    } else if (strcmp(name, "WavelengthData") == 0) {
        w->visible = false;
    } else if (strcmp(name, "WavelengthDataBlock") == 0) {
        w->in_block = true;
        w->block    = (bsdf_block){ .line = line_of(w) };
        w->named    = 0;
    }
}

static void on_text(void *user, const char *text, int length)
{
    xml_work *w = user;
    if (w->stopped || !w->listening)
        return;
    if ((size_t)length + 1 > w->most - w->used) {
        STOP(w, ERR_FORMAT, "%s", "more text than the file can hold");
        return;
    }
    memcpy(w->text + w->used, text, (size_t)length);
    w->used += (size_t)length;
}

/* The text of the element that ends, without the spaces around it. */
static const char *element_text(xml_work *w)
{
    static const char spaces[] = " \t\r\n";
    char *text                 = w->text + w->begin;
    w->text[w->used]           = '\0';
    text += strspn(text, spaces);
    for (char *end = text + strlen(text); end > text && strchr(spaces, end[-1]);)
        *--end = '\0';
    return text;
}

/* ---- what each element says --------------------------------------------------------------------
 */

static void structure_said(xml_work *w, const char *text)
{
    static const char *const names[] = { "Columns", "Rows", "TensorTree3", "TensorTree4" };
    static const int ranks[]         = { 0, 0, 3, 4 };
    char word[KLEMS_NAME];
    for (int i = 0; i < 4; i++)
        if (strcasecmp(text, names[i]) == 0) {
            w->out->rank    = ranks[i];
            w->out->in_rows = i == 1;
            w->structured   = true;
            return;
        }
    STOP(w, ERR_UNSUPPORTED,
         "IncidentDataStructure \"%s\": Columns, Rows, TensorTree3 or TensorTree4 wanted",
         shown(text, word));
}

static void direction_said(xml_work *w, const char *text)
{
    static const char *const names[2][2] = { { "Reflection Front", "Transmission Front" },
                                             { "Reflection Back", "Transmission Back" } };
    char word[KLEMS_NAME];
    for (int side = 0; side < 2; side++)
        for (int part = 0; part < 2; part++)
            if (strcasecmp(text, names[side][part]) == 0) {
                w->side  = (bsdf_side_name)side;
                w->part  = (bsdf_part)part;
                w->named = line_of(w);
                return;
            }
    if (w->visible)
        STOP(w, ERR_FORMAT,
             "WavelengthDataDirection \"%s\": Transmission or Reflection, Front or Back wanted",
             shown(text, word));
}

static void wavelength_said(xml_work *w, const char *text)
{
    w->visible = strcasecmp(text, "Visible") == 0;
    if (strncasecmp(text, "CIE-", 4) == 0)
        notice_add(w->n, "%s: colour (CIE-X, CIE-Z) is not read: the layer is taken as grey",
                   w->out->path);
}

static void type_said(xml_work *w, const char *text)
{
    char word[KLEMS_NAME];
    if (w->visible && strcasecmp(text, "BTDF") != 0 && strcasecmp(text, "BRDF") != 0 &&
        strcasecmp(text, "BSDF") != 0)
        STOP(w, ERR_UNSUPPORTED, "ScatteringDataType \"%s\": BTDF or BRDF wanted",
             shown(text, word));
}

static void angle_said(xml_work *w, const char *name, const char *text)
{
    double number;
    const char *end;
    if (w->rings == 0)
        return;
    klems_ring *r = &w->ring[w->rings - 1];
    if (!text_number(text, &end, &number) || *end) {
        STOP(w, ERR_FORMAT, "%s: no number", name);
        return;
    }
    if (strcmp(name, "LowerTheta") == 0)
        r->low_deg = number;
    else if (strcmp(name, "UpperTheta") == 0)
        r->high_deg = number;
    else /* what is no whole number of cells is no number of cells */
        r->count = number >= 1 && number <= KLEMS_CELLS && number == (int)number ? (int)number : 0;
}

static void basis_ends(xml_work *w)
{
    enum { MOST = sizeof w->out->basis / sizeof *w->out->basis };
    w->in_bases = false;
    char word[KLEMS_NAME];
    if (w->out->bases == MOST) {
        STOP(w, ERR_UNSUPPORTED, "more than %d angle bases", MOST);
        return;
    }
    klems *k          = &w->out->basis[w->out->bases];
    const char *wrong = klems_make(k, w->basis, w->ring, w->rings);
    if (wrong)
        STOP(w, ERR_FORMAT, "AngleBasis \"%s\" of line %d: %s", shown(w->basis, word),
             w->basis_line, wrong);
    else
        w->out->bases++;
}

static void block_ends(xml_work *w)
{
    w->in_block = false;
    if (!w->visible)
        return;
    if (!w->named || !w->block.text) {
        STOP(w, ERR_FORMAT, "a WavelengthDataBlock without %s",
             w->named ? "ScatteringData" : "WavelengthDataDirection");
        return;
    }
    bsdf_block *to = &w->out->block[w->side][w->part];
    if (to->text)
        STOP(w, ERR_UNSUPPORTED, "the same WavelengthDataDirection as that of line %d", to->line);
    else
        *to = w->block;
}

/* Of an element within a block; true if its text is to stay. */
static bool block_said(xml_work *w, const char *name, const char *text)
{
    if (strcmp(name, "WavelengthDataDirection") == 0) {
        direction_said(w, text);
    } else if (strcmp(name, "ColumnAngleBasis") == 0) {
        snprintf(w->block.column, sizeof w->block.column, "%s", text);
    } else if (strcmp(name, "RowAngleBasis") == 0) {
        snprintf(w->block.row, sizeof w->block.row, "%s", text);
    } else if (strcmp(name, "AngleBasis") == 0) {
        snprintf(w->block.basis, sizeof w->block.basis, "%s", text);
    } else if (strcmp(name, "ScatteringDataType") == 0) {
        type_said(w, text);
    } else if (strcmp(name, "ScatteringData") == 0 && w->visible) {
        w->block.text      = w->text + w->begin;
        w->block.text_line = w->text_line;
        return true;
    }
    return false;
}

static void on_end(void *user, const char *qualified)
{
    xml_work *w      = user;
    const char *name = local(qualified);
    if (w->stopped)
        return;
    w->depth--;
    const char *text = w->listening ? element_text(w) : NULL;
    bool keep        = false;
    if (strcmp(name, "AngleBasis") == 0 && w->in_bases)
        basis_ends(w);
    else if (strcmp(name, "WavelengthDataBlock") == 0)
        block_ends(w);
    else if (text && w->in_block)
        keep = block_said(w, name, text);
    else if (text && strcmp(name, "IncidentDataStructure") == 0)
        structure_said(w, text);
    else if (text && strcmp(name, "Wavelength") == 0)
        wavelength_said(w, text);
    else if (text && strcmp(name, "AngleBasisName") == 0)
        snprintf(w->basis, sizeof w->basis, "%s", text);
    else if (text && w->in_bases)
        angle_said(w, name, text);
    w->used      = keep ? w->used + 1 : w->begin;
    w->begin     = w->used;
    w->listening = false;
}

static void on_doctype(void *user, const char *name, const char *system, const char *public_name,
                       int internal)
{
    (void)name, (void)system, (void)public_name, (void)internal;
    xml_work *w = user;
    STOP(w, ERR_UNSUPPORTED, "%s", "a document type (DOCTYPE), which no BSDF needs");
}

/* ---- the file ----------------------------------------------------------------------------------
 */

static bool parse(xml_work *w, const char *bytes, size_t size)
{
    w->parser = XML_ParserCreate(NULL);
    if (!w->parser)
        return failed(w->err, ERR_MEMORY, "%s: no memory to read it", w->out->path);
    XML_SetUserData(w->parser, w);
    XML_SetElementHandler(w->parser, on_start, on_end);
    XML_SetCharacterDataHandler(w->parser, on_text);
    XML_SetStartDoctypeDeclHandler(w->parser, on_doctype);
    bool good = XML_Parse(w->parser, bytes, (int)size, XML_TRUE) == XML_STATUS_OK;
    if (!good && !w->stopped)
        failed(w->err, ERR_FORMAT, "%s:%d: XML: %s", w->out->path, line_of(w),
               XML_ErrorString(XML_GetErrorCode(w->parser)));
    XML_ParserFree(w->parser);
    return good && !w->stopped;
}

bool bsdf_file_parse(arena *a, const char *path, const char *bytes, size_t size, notices *n,
                     bsdf_file *out, lux_error *err)
{
    /* Some tools leave a line of their own before the XML */
    *out              = (bsdf_file){ .path = path };
    xml_work w        = { .out = out, .n = n, .err = err, .most = 2 * size + 64 };
    const bool marked = size >= 2 && (unsigned char)bytes[0] >= 0xef; /* a byte order mark */
    const char *begin = marked || size == 0 ? NULL : memchr(bytes, '<', size);
    for (; begin && bytes < begin; bytes++, size--)
        w.lines_before += *bytes == '\n';
    w.text = arena_array(a, char, w.most, err);
    if (!w.text || !parse(&w, bytes, size))
        return false;
    if (!w.structured)
        return failed(err, ERR_FORMAT, "%s:1: no BSDF: an IncidentDataStructure is missing", path);
    for (int i = 0; i < 4; i++)
        if (out->block[i / 2][i % 2].text)
            return true;
    return failed(err, ERR_FORMAT, "%s:1: no ScatteringData of visible light", path);
}
