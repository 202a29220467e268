/* lights/photometry_text.c -- lines, words and numbers of photometric files; see
 * photometry_parts.h. The bytes end in a NUL, so one byte beyond any other may be looked at. */
#include "core/text.h"
#include "lights/photometry_parts.h"

#include <stdio.h>
#include <string.h>

enum {
    LONGEST_SHOWN  = 32, /* bytes of a word in a message */
    LONGEST_NUMBER = 64, /* bytes of a number with a decimal comma */
};

static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\f' || c == '\v'; }
static bool is_line_end(char c) { return c == '\n' || c == '\r'; }
static bool is_separator(char c) { return is_blank(c) || is_line_end(c) || c == ','; }

static char lower(char c) { return c >= 'A' && c <= 'Z' ? (char)(c + 'a' - 'A') : c; }

/* Steps over one line end: LF, CR, CR LF, and CR CR LF, which a second conversion of the line ends
 * makes of CR LF. */
static void next_line(scanner *c)
{
    ptrdiff_t left = c->end - c->at, length = 1;
    if (left > 1 && !memcmp(c->at, "\r\n", 2))
        length = 2;
    if (left > 2 && !memcmp(c->at, "\r\r\n", 3))
        length = 3;
    c->at += length;
    c->line_start = c->at;
    c->line++;
}

int scan_column(const scanner *c) { return (int)(c->at - c->line_start) + 1; }

void *scan_wrong(const scanner *c, const char *expected, lux_error *err)
{
    const char *word = c->at, *last = c->at;
    while (last < c->end && !is_separator(*last) && last - word < LONGEST_SHOWN)
        last++;
    char shown[LONGEST_SHOWN + 1] = { 0 };
    for (ptrdiff_t i = 0; i < last - word; i++) /* control characters have no place in a message */
        shown[i] = word[i] < ' ' && word[i] >= 0 ? '?' : word[i];

    int column = scan_column(c);
    if (c->at == c->end)
        return failed(err, ERR_FORMAT, "%s:%d:%d: found the end of the file, expected %s", c->path,
                      c->line, column, expected);
    if (last == word)
        return failed(err, ERR_FORMAT, "%s:%d:%d: found nothing, expected %s", c->path, c->line,
                      column, expected);
    return failed(err, ERR_FORMAT, "%s:%d:%d: found '%s', expected %s", c->path, c->line, column,
                  shown, expected);
}

bool scan_line(scanner *c, scanned_line *out)
{
    if (c->at == c->end)
        return false;
    const char *text = c->at;
    while (c->at < c->end && !is_line_end(*c->at))
        c->at++;
    *out = (scanned_line){ text, (size_t)(c->at - text), c->line };
    if (c->at < c->end)
        next_line(c);
    return true;
}

bool scan_left(scanner *c)
{
    while (c->at < c->end && is_separator(*c->at)) {
        if (is_line_end(*c->at))
            next_line(c);
        else
            c->at++;
    }
    return c->at < c->end;
}

bool scan_number(scanner *c, const char *what, double *out, lux_error *err)
{
    const char *last;
    if (!scan_left(c) || !text_number(c->at, &last, out))
        return scan_wrong(c, what, err);
    if (last > c->end || (last < c->end && !is_separator(*last)))
        return scan_wrong(c, what, err);
    c->at = last;
    return true;
}

/* A value as a whole number within its bounds, for the place `at`. */
static bool whole(scanner *c, const char *at, double value, const char *what, int bounds[2],
                  int *out, lux_error *err)
{
    if (!(value >= bounds[0] && value <= bounds[1] && value == (double)(int)value)) {
        char expected[160];
        snprintf(expected, sizeof expected, "%s, a whole number from %d to %d", what, bounds[0],
                 bounds[1]);
        c->at = at;
        return scan_wrong(c, expected, err);
    }
    *out = (int)value;
    return true;
}

bool scan_count(scanner *c, const char *what, int least, int most, int *out, lux_error *err)
{
    double value;
    scan_left(c);
    const char *at = c->at; /* a number never crosses a line: column and line hold for it */
    return scan_number(c, what, &value, err) &&
           whole(c, at, value, what, (int[2]){ least, most }, out, err);
}

/* The word from `at` on as a number, its comma a point; a blank or `end` ends it. */
static bool number_with_comma(const char *at, const char *end, double *out)
{
    char number[LONGEST_NUMBER] = { 0 };
    size_t length               = 0;
    for (; at < end && !is_blank(*at); at++) {
        if (length + 1 == sizeof number)
            return false;
        number[length++] = *at == ',' ? '.' : *at;
    }
    const char *last;
    return text_number(number, &last, out) && *last == '\0';
}

bool scan_line_number(scanner *c, const char *what, bool blank_is_0, double *out, lux_error *err)
{
    while (c->at < c->end && is_blank(*c->at))
        c->at++;
    scanner start = *c;
    scanned_line l;
    if (!scan_line(c, &l))
        return scan_wrong(&start, what, err);
    if (l.length == 0 && blank_is_0) {
        notice_add(c->n, "%s:%d: an empty line is taken as 0: %s", c->path, l.line, what);
        *out = 0.0;
        return true;
    }

    if (!number_with_comma(l.text, l.text + l.length, out))
        return scan_wrong(&start, what, err);
    return true;
}

/* To the next value of a table; how many blank lines lie before it. */
static int skip_to_value(scanner *c)
{
    int ends = c->at == c->line_start ? 1 : 0; /* of lines, from the value before on */
    for (; c->at < c->end && (is_blank(*c->at) || is_line_end(*c->at));) {
        if (is_line_end(*c->at)) {
            next_line(c);
            ends++;
        } else {
            c->at++;
        }
    }
    return ends > 1 ? ends - 1 : 0;
}

bool scan_value(scanner *c, const char *what, scanner *start, double *out, lux_error *err)
{
    bool within = c->at != c->line_start; /* behind another value */
    int line    = c->line;
    int blanks  = skip_to_value(c);
    if (blanks > 0 && c->at < c->end && !c->noted_blank) {
        notice_add(c->n, "%s:%d: a blank line among the values: passed over", c->path, c->line - 1);
        c->noted_blank = true;
    }
    if (within && c->line == line && c->at < c->end && !c->noted_crowded) {
        notice_add(c->n, "%s:%d: several values on a line, where EULUMDAT has one: all are read",
                   c->path, line);
        c->noted_crowded = true;
    }

    *start           = *c;
    const char *last = c->at;
    while (last < c->end && !is_blank(*last) && !is_line_end(*last))
        last++;
    if (!number_with_comma(c->at, last, out))
        return scan_wrong(c, what, err);
    c->at = last;
    return true;
}

bool scan_line_count(scanner *c, const char *what, int least, int most, int *out, lux_error *err)
{
    double value;
    scanner start = *c;
    if (!scan_line_number(c, what, false, &value, err))
        return false;
    return whole(&start, start.at, value, what, (int[2]){ least, most }, out, err);
}

bool scan_begins(const char *text, size_t length, const char *word)
{
    size_t n = strlen(word);
    if (length < n)
        return false;
    for (size_t i = 0; i < n; i++)
        if (lower(text[i]) != lower(word[i]))
            return false;
    return true;
}
