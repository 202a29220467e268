/* core/progress.h -- how far long work has come, told by the work and drawn by whoever started it.
 *
 * sim/main.c fills draw, context and stop, and passes one progress down; the stages call
 * progress_begin() and progress_update(). Everywhere p may be NULL, and draw NULL: then nothing
 * is drawn. Updates may come from any thread, as often as it suits the work.
 */
#ifndef CORE_PROGRESS_H
#define CORE_PROGRESS_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct progress {
    /* Called by one thread at a time, about ten times a second: a label, the share that is done
     * in [0, 1], never falling under one label, and the accuracy so far in percent, NAN as long as
     * there is none. */
    void (*draw)(void *context, const char *label, double share, double accuracy_percent);
    void *context;
    const volatile bool *stop; /* NULL, or becomes true when the work should end early */

    const char *label; /* those from here on belong to progress.c */
    double share;
    int64_t due_ms; /* no drawing before */
    int busy;
} progress;

/* A stage begins, at share 0. Not while another thread may be updating p. The label must live until
 * the next stage begins. */
void progress_begin(progress *p, const char *label);

void progress_update(progress *p, double share, double accuracy_percent);

/* Whether the work should end early. */
static inline bool progress_stopped(const progress *p)
{
    return p && p->stop && __atomic_load_n(p->stop, __ATOMIC_RELAXED);
}

#ifdef __cplusplus
}
#endif

#endif
