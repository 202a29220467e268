/* core/error.h -- how a function says that it could not do what was asked.
 *
 * What can fail at run time (files, scene descriptions, what a user typed, memory) takes a
 * `lux_error *err` last, returns false or NULL, and says why in *err, once, where it happened:
 *
 *     if (angles < 2)
 *         return failed(err, ERR_FORMAT, "%s:%d: %d vertical angles, 2 or more wanted",
 *                       path, line, angles);
 *
 * The text names file and line where there are any, what was found and what was wanted.
 * Callers pass it up untouched; sim/main.c alone prints it. A bug is not an error: assert().
 */
#ifndef CORE_ERROR_H
#define CORE_ERROR_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" { /* the shims fail, too */
#endif

typedef enum error_code {
    ERR_NONE,
    ERR_ARGUMENT,    /* a value outside its stated range */
    ERR_IO,          /* a file that cannot be read or written */
    ERR_FORMAT,      /* a file that breaks its own format */
    ERR_UNSUPPORTED, /* a valid file that asks for what is not built */
    ERR_MEMORY,      /* more than the machine will give */
    ERR_INTERRUPTED, /* the user pressed Ctrl-C */
} error_code;

typedef struct lux_error { /* the plain name is a function of glibc */
    error_code code;
    char text[480]; /* one line, no newline */
} lux_error;

/* Fills *err (unless err is NULL) and returns NULL, which is false as well: for use in the
 * return statement of a function that gives a pointer or a bool. */
void *failed(lux_error *err, error_code code, const char *format, ...)
    __attribute__((format(printf, 3, 4), cold));

#ifdef __cplusplus
}
#endif

#endif
