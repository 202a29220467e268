/* core/text.h -- numbers as people and files write them, and words that they misspell. */
#ifndef CORE_TEXT_H
#define CORE_TEXT_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The decimal number that s begins with: sign, digits with at most one point among them, e or E
 * with an exponent; no spaces before it, no hexadecimals, no "inf" or "nan", and the point is a
 * point whatever the locale. False if there is none or if it is too large for a double; else
 * *out is the nearest double and *end, unless NULL, the first byte behind the number. */
bool text_number(const char *s, const char **end, double *out);

/* How many characters must be inserted, dropped, changed or swapped with their neighbours to make
 * b of a. Of each, 31 bytes are looked at. */
int text_distance(const char *a, const char *b);

enum { TEXT_QUOTE = 72 };
/* s as a message quotes it: on one line, without control characters, cut where it is long. Returns
 * out. */
const char *text_quote(char out[TEXT_QUOTE], const char *s);

#ifdef __cplusplus
}
#endif

#endif
