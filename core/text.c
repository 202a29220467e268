/* core/text.c -- see text.h. */
#define _GNU_SOURCE
#include "core/text.h"

#include <locale.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool digit(char c) { return c >= '0' && c <= '9'; }

/* Behind the number that s begins with; NULL if it begins with none. */
static const char *number_end(const char *s)
{
    int digits = 0;
    s += *s == '+' || *s == '-';
    for (; digit(*s); s++)
        digits++;
    s += *s == '.';
    for (; digit(*s); s++)
        digits++;
    if (digits == 0)
        return NULL;
    if (*s == 'e' || *s == 'E') {
        const char *exponent = s + 1 + (s[1] == '+' || s[1] == '-');
        if (digit(*exponent))
            for (s = exponent; digit(*s);)
                s++;
    }
    return s;
}

bool text_number(const char *s, const char **end, double *out)
{
    /* strtod takes no more than what was found: all forms found are its own, and it stops where
     * they stop, except in the hexadecimals: those end behind their first zero. */
    const char *last = number_end(s);
    if (!last)
        return false;
    const char *sign = s + (*s == '+' || *s == '-');
    if (sign[0] == '0' && (sign[1] == 'x' || sign[1] == 'X')) {
        *out = *s == '-' ? -0.0 : 0.0;
    } else {
        locale_t c = newlocale(LC_ALL_MASK, "C", NULL); /* glibc's own constant: cheap */
        if (!c)
            return false;
        double value = strtod_l(s, NULL, c);
        freelocale(c);
        if (!isfinite(value))
            return false;
        *out = value;
    }
    if (end)
        *end = last;
    return true;
}

static int least(int a, int b) { return a < b ? a : b; }

/* Optimal string alignment. */
int text_distance(const char *a, const char *b)
{
    enum { MOST = 31 };
    int d[MOST + 1][MOST + 1];
    int rows = (int)strnlen(a, MOST), columns = (int)strnlen(b, MOST);
    for (int i = 0; i <= rows; i++)
        d[i][0] = i;
    for (int j = 0; j <= columns; j++)
        d[0][j] = j;
    for (int i = 1; i <= rows; i++)
        for (int j = 1; j <= columns; j++) {
            int change = d[i - 1][j - 1] + (a[i - 1] != b[j - 1]);
            d[i][j]    = least(change, least(d[i - 1][j], d[i][j - 1]) + 1);
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                d[i][j] = least(d[i][j], d[i - 2][j - 2] + 1);
        }
    return d[rows][columns];
}

const char *text_quote(char out[TEXT_QUOTE], const char *s)
{
    int length = 0;
    for (; s[length] && length < TEXT_QUOTE - 4; length++) {
        unsigned char c = (unsigned char)s[length];
        out[length]     = c < ' ' || c == 127 ? '?' : s[length];
    }
    strcpy(out + length, s[length] ? "..." : "");
    return out;
}
