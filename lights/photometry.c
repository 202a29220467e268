/* lights/photometry.c -- which format a photometric file is in, and the names of what is in it. */
#include "lights/photometry.h"
#include "core/file.h"
#include "core/text.h"
#include "lights/photometry_parts.h"

#include <math.h>
#include <string.h>

const char *photometry_format_name(photometry_format f)
{
    static const char *const names[] = { "none",       "LM-63-1986", "LM-63-1991", "LM-63-1995",
                                         "LM-63-2002", "LM-63-2019", "EULUMDAT" };
    return names[f];
}

const char *photometry_symmetry_name(photometry_symmetry s)
{
    static const char *const names[] = { "none", "C0-C180", "C90-C270", "quadrant", "rotational" };
    return names[s];
}

const char *opening_shape_name(opening_shape s)
{
    static const char *const names[] = { "point",
                                         "line",
                                         "rectangle",
                                         "box",
                                         "disc",
                                         "vertical cylinder",
                                         "sphere",
                                         "cylinder along the length",
                                         "cylinder along the width",
                                         "vertical disc" };
    return names[s];
}

/* A line `TILT =` is in every LM-63 file. */
static bool has_tilt_line(scanner c)
{
    scanned_line l, value;
    while (scan_line(&c, &l))
        if (ies_tilt_line(&l, &value))
            return true;
    return false;
}

/* The beginning of the first line that is not blank. In EULUMDAT one blank line may be the company
 * that was left out. */
static scanner after_blank_lines(const scanner *c)
{
    scanner next = *c, out = *c;
    scanned_line l;
    scan_left(&next);
    while (out.line < next.line && scan_line(&out, &l))
        ;
    return out;
}

static bool begins_as_ies(scanner c)
{
    return scan_left(&c) && scan_begins(c.at, (size_t)(c.end - c.at), "IES");
}

/* Lines 2 to 4 of EULUMDAT are whole numbers: 0..3, 0..4, 1 and more. */
static bool begins_as_eulumdat(scanner c)
{
    scanned_line l;
    double value;
    static const double most[] = { 3, 4, 1e6 };
    if (!scan_line(&c, &l))
        return false;
    for (int i = 0; i < 3; i++)
        if (!scan_line_number(&c, "", false, &value, NULL) || !(value >= 0.0 && value <= most[i]))
            return false;
    return true;
}

static bool refuse_zero(scanner c, const char *zero, lux_error *err)
{
    const char *start = c.at;
    int line          = c.line;
    for (scanned_line l; scan_line(&c, &l) && l.text <= zero;)
        start = l.text, line = l.line;
    return failed(err, ERR_FORMAT, "%s:%d:%ld: found a byte 0, expected a text file", c.path, line,
                  (long)(zero - start) + 1);
}

/* Sets the cursor on text: a byte order mark goes, so does what follows Ctrl-Z. */
static bool open_text(scanner *c, size_t size, lux_error *err)
{
    if (size > MOST_BYTES)
        return failed(err, ERR_FORMAT, "%s: has %zu bytes, at most %d were expected", c->path, size,
                      MOST_BYTES);
    if (size >= 2 && (!memcmp(c->at, "\xff\xfe", 2) || !memcmp(c->at, "\xfe\xff", 2)))
        return failed(err, ERR_FORMAT, "%s:1:1: found UTF-16, expected plain text or UTF-8",
                      c->path);
    if (size >= 3 && !memcmp(c->at, "\xef\xbb\xbf", 3))
        c->at += 3;
    const char *ctrl_z = memchr(c->at, 0x1a, (size_t)(c->end - c->at));
    c->end             = ctrl_z ? ctrl_z : c->end;
    c->line_start      = c->at;
    const char *zero   = memchr(c->at, '\0', (size_t)(c->end - c->at));
    if (zero)
        return refuse_zero(*c, zero, err);
    scanner left = *c;
    if (!scan_left(&left))
        return failed(err, ERR_FORMAT, "%s:1:1: found an empty file, expected LM-63 or EULUMDAT",
                      c->path);
    c->shift_jis = text_is_shift_jis(c->at, (size_t)(c->end - c->at));
    return true;
}

const photometry *photometry_parse(arena *a, const char *path, const char *bytes, size_t size,
                                   notices *n, lux_error *err)
{
    scanner c = { path, bytes, bytes + size, bytes, 1, n, a };
    if (!open_text(&c, size, err))
        return NULL;

    photometry *p = arena_new(a, photometry, err);
    if (!p)
        return NULL;
    p->manufacturer = p->catalog = p->name = p->lamp = p->report = p->date = "";

    scanner start = after_blank_lines(&c);
    bool read;
    if (begins_as_eulumdat(c) && !(begins_as_ies(c) && has_tilt_line(c)))
        read = photometry_read_eulumdat(p, &c, err); /* whose labels may be anything */
    else if (has_tilt_line(c) || begins_as_ies(c))
        read = photometry_read_ies(p, &c, err);
    else if (begins_as_eulumdat(start)) {
        notice_add(n, "%s:1: blank lines before the first: passed over", path);
        read = photometry_read_eulumdat(p, &start, err);
    } else
        return failed(err, ERR_FORMAT,
                      "%s:1:1: neither LM-63 (no line 'TILT=') nor EULUMDAT (lines 2 to "
                      "4 are no type, symmetry and number of planes)",
                      path);
    if (!read)
        return NULL;
    p->luminaire_lumens = photometry_flux(p, 0.0, 180.0);
    if (!(p->luminaire_lumens > 0.0))
        notice_add(n, "%s: the luminaire is dark: all its intensities are 0", path);
    return p;
}

const photometry *photometry_read(arena *a, const char *path, notices *n, lux_error *err)
{
    size_t size;
    const char *bytes = file_read(a, path, MOST_BYTES, &size, err);
    return bytes ? photometry_parse(a, path, bytes, size, n, err) : NULL;
}
