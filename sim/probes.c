/* sim/probes.c -- see probes.h. */
#include "sim/probes.h"

#include "core/file.h"
#include "core/text.h"

#include <stdio.h>
#include <string.h>

enum { COLUMNS = 6, MOST_PROBES = 4000000 };
#define MOST_BYTES ((size_t)1 << 29)

static const char *const column_names[COLUMNS] = { "x", "y", "z", "nx", "ny", "nz" };

typedef struct csv {
    const char *path, *line_start, *at;
    int line;
    int column_of_field[COLUMNS]; /* which of column_names each field of a row is */
    lux_error *err;
} csv;

/* "expected WANTED, found `...`", where c->at stands. */
static void *csv_unexpected(const csv *c, const char *wanted)
{
    char found[24]  = "";
    size_t length   = strcspn(c->at, ",\r\n");
    size_t at_most  = length < sizeof found ? length : sizeof found - 1;
    const char *end = c->at + length;
    for (size_t i = 0; i < at_most; i++)
        found[i] = (unsigned char)c->at[i] < 0x20 ? '?' : c->at[i];
    bool none = strspn(c->at, " \t") >= length;
    return failed(c->err, ERR_FORMAT, "%s:%d:%d: expected %s, found %s%s%s", c->path, c->line,
                  (int)(c->at - c->line_start) + 1, wanted, none ? "" : "`",
                  !none         ? found
                  : *end == ',' ? "nothing before the comma"
                                : "the end of the line",
                  none ? "" : "`");
}

static void skip_spaces(csv *c) { c->at += strspn(c->at, " \t"); }

static bool at_line_end(const csv *c) { return c->at[strspn(c->at, "\r")] == '\n' || !*c->at; }

static void next_line(csv *c)
{
    c->at += strcspn(c->at, "\n");
    c->at += *c->at == '\n';
    c->line_start = c->at;
    c->line++;
}

/* To the first character of the next line that says something; false at the end. */
static bool find_row(csv *c)
{
    for (; *c->at; next_line(c)) {
        skip_spaces(c);
        if (!at_line_end(c) && *c->at != '#')
            return true;
    }
    return false;
}

/* Past the comma behind field i, or at the end of the line behind the last. */
static bool field_end(csv *c, int i)
{
    skip_spaces(c);
    if (i == COLUMNS - 1)
        return at_line_end(c) || csv_unexpected(c, "the end of the line after six columns");
    if (*c->at != ',')
        return csv_unexpected(c, "a comma (columns x,y,z,nx,ny,nz)");
    c->at++;
    skip_spaces(c);
    return true;
}

static bool read_header(csv *c)
{
    bool seen[COLUMNS] = { false };
    if (!find_row(c))
        return failed(c->err, ERR_FORMAT, "%s: nothing in it, expected a row x,y,z,nx,ny,nz",
                      c->path);
    for (int i = 0; i < COLUMNS; i++) {
        size_t length = strcspn(c->at, ", \t\r\n");
        int column    = 0;
        while (column < COLUMNS && (strlen(column_names[column]) != length ||
                                    strncmp(c->at, column_names[column], length) != 0))
            column++;
        if (column == COLUMNS || seen[column])
            return csv_unexpected(c, "each of the columns x,y,z,nx,ny,nz once");
        seen[column]          = true;
        c->column_of_field[i] = column;
        c->at += length;
        if (!field_end(c, i))
            return false;
    }
    next_line(c);
    return true;
}

static bool read_row(csv *c, dvec3 *position, dvec3 *normal)
{
    double value[COLUMNS];
    for (int i = 0; i < COLUMNS; i++) {
        const char *end;
        double x;
        if (!text_number(c->at, &end, &x) || !strchr(", \t\r\n", *end))
            return csv_unexpected(c, "a number");
        if (!(fabs(x) <= 1e12))
            return csv_unexpected(c, "a number of at most 1e12");
        value[c->column_of_field[i]] = x;
        c->at                        = end;
        if (!field_end(c, i))
            return false;
    }

    /* Scaled first: the square of 1e-300 is 0 */
    dvec3 n    = { value[3], value[4], value[5] };
    double big = fmax(fabs(n.x), fmax(fabs(n.y), fabs(n.z)));
    if (!(big >= 1e-300))
        return failed(c->err, ERR_FORMAT, "%s:%d:1: the normal has no length", c->path, c->line);
    n         = (dvec3){ n.x / big, n.y / big, n.z / big };
    *normal   = d3_scale(n, 1.0 / d3_length(n));
    *position = (dvec3){ value[0], value[1], value[2] };
    next_line(c);
    return true;
}

static bool count_rows(csv c, int *rows)
{
    for (*rows = 0; find_row(&c); next_line(&c))
        if (++*rows > MOST_PROBES)
            return failed(c.err, ERR_FORMAT, "%s:%d:1: more than %d rows", c.path, c.line,
                          MOST_PROBES);
    return *rows > 0 ||
           failed(c.err, ERR_FORMAT, "%s: no row below the header, expected at least one", c.path);
}

bool probes_parse(arena *a, const char *path, const char *text, probes *out, lux_error *err)
{
    text += !strncmp(text, "\xef\xbb\xbf", 3) ? 3 : 0;
    csv c = { .path = path, .line_start = text, .at = text, .line = 1, .err = err };
    int rows;
    if (!read_header(&c) || !count_rows(c, &rows))
        return false;

    out->position = arena_array(a, dvec3, (size_t)rows, err);
    out->normal   = arena_array(a, dvec3, (size_t)rows, err);
    if (!out->position || !out->normal)
        return false;
    for (out->count = 0; out->count < rows; out->count++) {
        find_row(&c);
        if (!read_row(&c, &out->position[out->count], &out->normal[out->count]))
            return false;
    }
    return true;
}

bool probes_read(arena *a, const char *path, probes *out, lux_error *err)
{
    arena scratch = { 0 };
    size_t size   = 0;
    char *text    = file_read(&scratch, path, MOST_BYTES, &size, err);
    bool good =
        text &&
        (strlen(text) == size || failed(err, ERR_FORMAT, "%s: a NUL byte, expected text", path)) &&
        probes_parse(a, path, text, out, err);
    arena_clear(&scratch);
    return good;
}
