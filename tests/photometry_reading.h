/* tests/photometry_reading.h -- reading photometric files from texts in tests. */
#ifndef TESTS_PHOTOMETRY_READING_H
#define TESTS_PHOTOMETRY_READING_H

#include "lights/photometry.h"
#include "tests/test.h"

#include <stdlib.h>
#include <string.h>

/* What came of reading a text. */
typedef struct reading {
    arena a;
    notices n;
    lux_error err;
    const photometry *p;
} reading;

static reading r; /* of the test that runs */

static const photometry *read_bytes(const char *text, size_t size)
{
    arena_clear(&r.a);
    memset(&r, 0, sizeof r);
    r.n.a      = &r.a;
    char *copy = malloc(size + 1); /* just as large: the sanitizer sees each byte too many */
    memcpy(copy, text, size);
    copy[size] = '\0';
    r.p        = photometry_parse(&r.a, "t", copy, size, &r.n, &r.err);
    free(copy);
    return r.p;
}

static inline const photometry *read_text(const char *text)
{
    return read_bytes(text, strlen(text));
}

static inline bool noticed(const char *part)
{
    for (const notice *n = r.n.first; n; n = n->next)
        if (strstr(n->text, part))
            return true;
    return false;
}

/* The text is refused, and says this. */
#define assert_refused(bytes, message)                                                             \
    do {                                                                                           \
        assert_null(read_text(bytes));                                                             \
        assert_string_equal(r.err.text, message);                                                  \
        assert_int_equal(r.err.code, ERR_FORMAT);                                                  \
    } while (0)

static inline double at(double plane, double gamma)
{
    return photometry_candela(r.p, plane, gamma);
}

static inline int finish(void **state)
{
    (void)state;
    arena_clear(&r.a);
    memset(&r, 0, sizeof r);
    return 0;
}

#endif
