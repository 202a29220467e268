/* tests/other_times.h -- benchmarks beside the same program of another packet width. */
#ifndef TESTS_OTHER_TIMES_H
#define TESTS_OTHER_TIMES_H

/* Runs `program --times`, which prints nanoseconds of each of so many cases, and lowers best[] to
 * them. Ends the program if there is no such answer. */
void other_times(const char *program, int count, double *best);

#endif
