/* tests/widths.h -- the programs of every packet width that are built, for what compares them. */
#ifndef TESTS_WIDTHS_H
#define TESTS_WIDTHS_H

#include <stdbool.h>
#include <stddef.h>

/* The widths that there are: for (int w = 1; w; w = width_after(w)). */
int width_after(int width);

/* The path of lux4 as built for that width; whether it is there, can be run here and is none of
 * yesterday: those older than a source are no builds of it. */
bool program_of_width(int width, char *path, size_t size);

#endif
