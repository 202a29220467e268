/* sim/terminal.h -- one line on a terminal that shows how far the work has come.
 *
 *     render corner [########----------------]  33%  0:12, 0:25 left, accuracy 14%
 */
#ifndef SIM_TERMINAL_H
#define SIM_TERMINAL_H

#include "core/progress.h"

#include <stddef.h>
#include <stdio.h>

typedef struct terminal {
    FILE *stream; /* NULL: nothing is ever drawn */
    char label[64];
    double began_s; /* when the present label appeared */
    bool drawn;     /* something stands on the line */
} terminal;

/* Draws on stderr if that is a terminal that can erase a line, and unless quiet. */
terminal terminal_open(bool quiet);

/* A progress that draws on t, which must outlive it. */
progress terminal_progress(terminal *t, const volatile bool *stop);

/* Empties the line. To be called before anything else is printed, and at the end. */
void terminal_clear(terminal *t);

/* The line itself, at most `columns` - 1 characters of it, with a NUL, in line[size]: for a share
 * in [0, 1], an accuracy in percent or NAN, and seconds since the beginning. */
void terminal_line(char *line, size_t size, int columns, const char *label, double share,
                   double accuracy_percent, double elapsed_s);

#endif
