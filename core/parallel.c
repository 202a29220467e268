/* core/parallel.c -- see parallel.h. */
#define _GNU_SOURCE
#include "core/parallel.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>

enum { MOST_THREADS = 256 };

typedef struct job {
    atomic_int next;
    int items;
    void (*work)(void *, int, int);
    void *context;
    const volatile bool *stop;
} job;

static bool stopped(const volatile bool *stop)
{
    return stop && __atomic_load_n(stop, __ATOMIC_RELAXED);
}

typedef struct worker {
    job *j;
    int thread;
} worker;

static void *run(void *argument)
{
    const worker *w = argument;
    job *j          = w->j;
    while (!stopped(j->stop)) {
        int item = atomic_fetch_add(&j->next, 1);
        if (item >= j->items)
            break;
        j->work(j->context, item, w->thread);
    }
    return NULL;
}

bool parallel_for(int items, int threads, void (*work)(void *, int, int), void *context,
                  const volatile bool *stop)
{
    job j = { .items = items, .work = work, .context = context, .stop = stop };
    pthread_t handles[MOST_THREADS];
    worker workers[MOST_THREADS];
    int most    = threads < items ? threads : items;
    int started = 0; /* beside the caller */
    for (int t = 1; t < most && t < MOST_THREADS; t++) {
        workers[t] = (worker){ &j, t };
        if (pthread_create(&handles[t], NULL, run, &workers[t]))
            break;
        started = t;
    }
    workers[0] = (worker){ &j, 0 };
    run(&workers[0]);
    for (int t = 1; t <= started; t++)
        pthread_join(handles[t], NULL);
    return !stopped(stop);
}

int parallel_processors(void)
{
    cpu_set_t set;
    return sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
}
