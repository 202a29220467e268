/* core/progress.c -- see progress.h. */
#define _GNU_SOURCE
#include "core/progress.h"

#include <time.h>

enum { PAUSE_MS = 100 };

static int64_t now_ms(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (int64_t)t.tv_sec * 1000 + t.tv_nsec / 1000000;
}

void progress_begin(progress *p, const char *label)
{
    if (!p)
        return;
    p->label  = label;
    p->share  = 0.0;
    p->due_ms = now_ms() + PAUSE_MS;
    if (p->draw)
        p->draw(p->context, label, 0.0, __builtin_nan(""));
}

void progress_update(progress *p, double share, double accuracy_percent)
{
    if (!p || !p->draw)
        return;
    int64_t now = now_ms();
    if (now < __atomic_load_n(&p->due_ms, __ATOMIC_RELAXED))
        return;
    if (__atomic_exchange_n(&p->busy, 1, __ATOMIC_ACQUIRE))
        return; /* another thread is drawing: the next update will do */
    if (now >= p->due_ms && share >= p->share) { /* shares of other threads may come late */
        p->share = share < 1.0 ? share : 1.0;
        p->draw(p->context, p->label, p->share, accuracy_percent);
        __atomic_store_n(&p->due_ms, now_ms() + PAUSE_MS, __ATOMIC_RELAXED);
    }
    __atomic_store_n(&p->busy, 0, __ATOMIC_RELEASE);
}
