/* core/notice.h -- what the user should know though nothing failed: the warnings of a run.
 *
 * Whoever reads a file or builds a scene adds lines; sim/main.c prints them to stderr, once
 * each, with the program's name before them. Like an error, a notice names the file and line.
 */
#ifndef CORE_NOTICE_H
#define CORE_NOTICE_H

#include "core/arena.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct notice {
    struct notice *next;
    char text[]; /* one line, no newline */
} notice;

typedef struct notices {
    arena *a; /* where the lines are kept */
    notice *first, *last;
    int count;
} notices;

/* Adds a line, unless the same line stands there already. `n` may be NULL: then nothing. A
 * notice for which there is no memory is lost: the next thing allocated will say so. */
void notice_add(notices *n, const char *format, ...) __attribute__((format(printf, 2, 3), cold));

#ifdef __cplusplus
}
#endif

#endif
