/* core/parallel.h -- the same work on many items, on as many threads as were asked for. */
#ifndef CORE_PARALLEL_H
#define CORE_PARALLEL_H

#include <stdbool.h>

/* Calls work(context, item, thread) once for each item in 0 .. items - 1, on `threads` threads
 * (>= 1; thread is 0 .. threads - 1, the caller's being 0), items being handed out in order.
 * Returns when all are done. Once *stop is true (NULL: never) no further item is begun; false
 * then. Where the machine will start no more threads, fewer do the work. */
bool parallel_for(int items, int threads, void (*work)(void *context, int item, int thread),
                  void *context, const volatile bool *stop);

/* Processors of this machine that this process may use, >= 1. */
int parallel_processors(void);

#endif
