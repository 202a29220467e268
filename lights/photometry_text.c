/* lights/photometry_text.c -- lines, words and numbers of photometric files; see
 * photometry_parts.h. The bytes end in a NUL, so one byte beyond any other may be looked at. */
#include "core/text.h"
#include "core/utf8.h"
#include "lights/photometry_parts.h"

#include <stdio.h>
#include <string.h>

enum {
    LONGEST_SHOWN  = 32,  /* bytes of a word in a message */
    LONGEST_WORDS  = 512, /* bytes of a label that are kept: LM-63 allows 256 */
    LONGEST_NUMBER = 64,  /* bytes of a number with a decimal comma */
};

static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\f' || c == '\v'; }
static bool is_line_end(char c) { return c == '\n' || c == '\r'; }
static bool is_separator(char c) { return is_blank(c) || is_line_end(c) || c == ','; }

static char lower(char c) { return c >= 'A' && c <= 'Z' ? (char)(c + 'a' - 'A') : c; }

/* Steps over one line end, in any of its three forms. */
static void next_line(scanner *c)
{
    bool both = c->at[0] == '\r' && c->at + 1 < c->end && c->at[1] == '\n';
    c->at += both ? 2 : 1;
    c->line_start = c->at;
    c->line++;
}

void *scan_wrong(const scanner *c, const char *expected, lux_error *err)
{
    const char *word = c->at, *last = c->at;
    while (last < c->end && !is_separator(*last) && last - word < LONGEST_SHOWN)
        last++;
    char shown[LONGEST_SHOWN + 1] = { 0 };
    for (ptrdiff_t i = 0; i < last - word; i++) /* control characters have no place in a message */
        shown[i] = word[i] < ' ' && word[i] >= 0 ? '?' : word[i];

    long column = (long)(c->at - c->line_start) + 1;
    if (c->at == c->end)
        return failed(err, ERR_FORMAT, "%s:%d:%ld: found the end of the file, expected %s", c->path,
                      c->line, column, expected);
    if (last == word)
        return failed(err, ERR_FORMAT, "%s:%d:%ld: found nothing, expected %s", c->path, c->line,
                      column, expected);
    return failed(err, ERR_FORMAT, "%s:%d:%ld: found '%s', expected %s", c->path, c->line, column,
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

    /* The first word, its comma a point */
    char number[LONGEST_NUMBER] = { 0 };
    size_t length               = 0;
    for (; length < l.length && length + 1 < sizeof number && !is_blank(l.text[length]); length++)
        number[length] = l.text[length] == ',' ? '.' : l.text[length];
    const char *last;
    if (!text_number(number, &last, out) || *last != '\0')
        return scan_wrong(&start, what, err);
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

static bool is_utf8(const char *text, size_t length)
{
    for (size_t i = 0; i < length;) {
        size_t n = utf8_length(text + i, length - i);
        if (n == 0)
            return false;
        i += n;
    }
    return true;
}

const char *scan_words(arena *a, const char *text, size_t length)
{
    while (length > 0 && is_separator(text[0]))
        text++, length--;
    while (length > 0 && is_separator(text[length - 1]))
        length--;
    bool utf8   = is_utf8(text, length);
    bool cut    = length > LONGEST_WORDS;
    size_t kept = cut ? LONGEST_WORDS : length;
    while (cut && utf8 && (text[kept] & 0xc0) == 0x80) /* not within a character */
        kept--;

    char *out = arena_array(a, char, 2 * kept + 1, NULL);
    if (!out)
        return "";
    size_t n = 0;
    for (size_t i = 0; i < kept; i++) {
        unsigned char b = (unsigned char)text[i];
        if (utf8 || b < 0x80) {
            out[n++] = (char)(b < ' ' || b == 0x7f ? ' ' : b);
        } else { /* Latin-1: C1 controls are blanks, the others two bytes */
            out[n++] = (char)(b < 0xa0 ? ' ' : 0xc0 | (b >> 6));
            if (b >= 0xa0)
                out[n++] = (char)(0x80 | (b & 0x3f));
        }
    }
    return out;
}
