/* sim/mix_csv.c -- see mix.h: a grid's table, read and written row by row.
 *
 * Fields that stay what they are go through as they are written, to the digit.
 */
#include "sim/mix.h"

#include "core/file.h"
#include "core/text.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define MOST_BYTES ((size_t)1 << 30)
enum { PLACE_COLUMNS = 6, MOST_COLUMNS = 1024 };

/* What a grid's CSV begins with; the last three are in no mixture. */
static const char *const fixed[] = {
    "x", "y", "z", "nx", "ny", "nz", "illuminance_lx", "direct_lx", "indirect_lx", "half_width_lx"
};
enum { FIXED = sizeof fixed / sizeof *fixed };

typedef struct table {
    const char *path, *line_start, *at;
    int line;
    lux_error *err;
} table;

static size_t field_length(const char *at) { return strcspn(at, ",\r\n"); }

static bool line_ended(const char *at)
{
    return !*at || *at == '\n' || (*at == '\r' && at[1] == '\n');
}

static bool field_is(const char *at, const char *word)
{
    return field_length(at) == strlen(word) && !strncmp(at, word, strlen(word));
}

/* "expected WANTED, found `...`", where it stands. */
static void *unexpected(const table *t, const char *wanted)
{
    char found[24] = "";
    size_t length  = field_length(t->at);
    snprintf(found, sizeof found, "%.*s", length < 20 ? (int)length : 20, t->at);
    for (char *c = found; *c; c++)
        if ((unsigned char)*c < ' ')
            *c = '?';
    return failed(t->err, ERR_FORMAT, "%s:%d:%d: expected %s, found `%s`", t->path, t->line,
                  (int)(t->at - t->line_start) + 1, wanted, found);
}

static void next_line(table *t)
{
    t->at += strcspn(t->at, "\n");
    t->at += *t->at == '\n';
    t->line_start = t->at;
    t->line++;
}

/* Past the comma behind a field; false, and where it was, at the end of the line. */
static bool next_field(table *t)
{
    const char *end = t->at + field_length(t->at);
    if (*end != ',')
        return false;
    t->at = end + 1;
    return true;
}

static bool is_fixed(table t, int from, int to)
{
    for (int i = from; i < to; i++)
        if (!field_is(t.at, fixed[i]) || (!next_field(&t) && i + 1 < to))
            return false;
    return true;
}

static bool read_header(arena *a, mix *m, table *t)
{
    static const char wanted[] = "a grid's header: x,y,z,nx,ny,nz,illuminance_lx, ...";
    if (!is_fixed(*t, 0, PLACE_COLUMNS + 1))
        return unexpected(t, wanted);
    m->first_group = PLACE_COLUMNS + 1;
    for (int i = 0; i < PLACE_COLUMNS; i++)
        next_field(t);
    bool more = next_field(t);
    if (more && is_fixed(*t, PLACE_COLUMNS + 1, FIXED)) {
        m->first_group = FIXED;
        for (int i = PLACE_COLUMNS + 1; i < FIXED; i++)
            more = next_field(t);
    }

    m->groups = arena_array(a, mix_group, MOST_COLUMNS, t->err);
    for (int count = 0; m->groups && more; count++) {
        size_t length = field_length(t->at), end = strlen("_lx");
        if (length <= end || strncmp(t->at + length - end, "_lx", end) != 0)
            return unexpected(t, "a column NAME_lx of a group");
        if (count == MOST_COLUMNS)
            return unexpected(t, "no more than 1024 groups");
        int g = mix_group_add(a, m, t->at, length - end, t->err);
        if (g < 0)
            return false;
        if (g != count)
            return unexpected(t, "each group once");
        more = next_field(t);
    }
    if (m->groups && !line_ended(t->at + field_length(t->at)))
        return unexpected(t, "the end of the line behind the header");
    return m->groups;
}

bool mix_read_csv(arena *a, mix *m, lux_error *err)
{
    size_t size;
    m->kind          = MIX_GRID_CSV;
    const char *text = file_read(a, m->path, MOST_BYTES, &size, err);
    if (!text)
        return false;
    if (strlen(text) != size)
        return failed(err, ERR_FORMAT, "%s: a NUL byte, expected text", m->path);
    text += strncmp(text, "\xef\xbb\xbf", 3) ? 0 : 3;
    table t = { .path = m->path, .line_start = text, .at = text, .line = 1, .err = err };
    if (!read_header(a, m, &t))
        return false;
    next_line(&t);
    m->rows = t.at;
    return true;
}

/* ---- the mixture ----------------------------------------------------------------------------- */

/* The sum of a row, and where its fields of groups begin and end; t->at is at its end then. */
static bool mix_row(const mix *m, table *t, double *sum, const char **groups)
{
    int columns = m->first_group + m->group_count;
    *sum        = 0.0;
    for (int i = 0; i < columns; i++) {
        const char *end;
        double value;
        if (!text_number(t->at, &end, &value) || end != t->at + field_length(t->at))
            return unexpected(t, "a number");
        if (i == m->first_group)
            *groups = t->at;
        if (i >= m->first_group)
            *sum += m->groups[i - m->first_group].factor * value;
        t->at = end;
        if (i + 1 < columns && *end != ',')
            return unexpected(t, "as many numbers as the header has columns");
        t->at += i + 1 < columns;
    }
    if (!line_ended(t->at))
        return unexpected(t, "the end of the line, as the header has no more columns");
    return isfinite(*sum) || failed(t->err, ERR_ARGUMENT,
                                    "%s:%d: the mixture is too large a number", t->path, t->line);
}

/* The first PLACE_COLUMNS fields of a line, the comma behind them not included. */
static size_t place_length(const char *line)
{
    const char *end = line;
    for (int i = 0; i < PLACE_COLUMNS; i++)
        end += field_length(end) + (i + 1 < PLACE_COLUMNS);
    return (size_t)(end - line);
}

static void write_header(FILE *to, const mix *m)
{
    for (int i = 0; i <= PLACE_COLUMNS; i++)
        fprintf(to, "%s%s", i ? "," : "", fixed[i]);
    for (int g = 0; g < m->group_count; g++)
        fprintf(to, ",%s_lx", m->groups[g].name);
    putc('\n', to);
}

static bool write_rows(FILE *to, const mix *m, table *t, double *average)
{
    double total = 0.0;
    int64_t rows = 0;
    for (; *t->at; next_line(t)) {
        const char *line = t->at, *groups = NULL;
        double sum;
        if (line_ended(line))
            continue;
        if (*line == '#') {
            fprintf(to, "%.*s\n", (int)strcspn(line, "\r\n"), line);
            continue;
        }
        if (!mix_row(m, t, &sum, &groups))
            return false;
        fprintf(to, "%.*s,%.9g,%.*s\n", (int)place_length(line), line, sum, (int)(t->at - groups),
                groups);
        total += sum;
        rows++;
    }
    *average = total / (double)rows;
    return rows > 0 || failed(t->err, ERR_FORMAT, "%s: no row below the header", m->path);
}

bool mix_write_csv(const mix *m, const char *path, double *average_lx, notices *n, lux_error *err)
{
    table t = { .path = m->path, .line_start = m->rows, .at = m->rows, .line = 2, .err = err };
    output_file f;
    if (!file_create(&f, path, err))
        return false;
    write_header(f.stream, m);
    if (!write_rows(f.stream, m, &t, average_lx)) {
        file_discard(&f);
        return false;
    }
    if (m->first_group == FIXED)
        notice_add(n,
                   "%s: direct, indirect and half width cannot be told from a CSV and are left out "
                   "(from an EXR they can)",
                   path);
    return file_commit(&f, err);
}
