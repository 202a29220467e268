/* sim/accuracy_parts.h -- what rounds of samples and the judge between them share; for
 * sim/accuracy*.c alone.
 */
#ifndef SIM_ACCURACY_PARTS_H
#define SIM_ACCURACY_PARTS_H

#include "sim/accuracy.h"

#include <stdatomic.h>

typedef struct by_scramble {
    float sum[SCRAMBLES];
} by_scramble;

/* n h^2, of n samples and half width h, at the last two looks at an item: after so many samples */
typedef struct look {
    float before, now;
    float common; /* correlation of the last round with all before it, where that is asked for */
    uint32_t samples;
} look;

/* Of a whole run. */
typedef struct accuracy_state {
    const accuracy_desc *d;
    accuracy_result *r;
    int judged;         /* channels */
    int spread;         /* those and the ones that are only told: whose spread is known */
    double *total;      /* items * channels, channel by channel */
    by_scramble *parts; /* an item, of each of those: item * spread + channel */
    double *floors;     /* of each of those */
    look *looks;        /* as parts */
    float *values;      /* a thread: channels * BUNDLE */

    /* This round: n new samples for each scramble of the active items, beginning with number
     * `first`. Work is handed out as `together` items at a time or, if pieces > 1, as one item's
     * scrambles in that many pieces. */
    int *active, active_count, together, pieces;
    uint32_t n, first;
    int from, to;  /* scrambles of this pass; all of them, but for the passes of the first round */
    int scrambles; /* that every item has had, of SCRAMBLES */
    int rounds;    /* that are over */
    double *new_total;       /* (piece * active_count + j) * channels + channel */
    by_scramble *new_parts;  /* an active item: as parts */
    atomic_int *pieces_done; /* an active item */
    bool may_cut;            /* the deadline counts: once every item has two scrambles */
    atomic_llong samples_done;
    double samples_before, samples_predicted, reached;
    bool halt; /* by __atomic alone */
} accuracy_state;

/* Judges all items by the samples that they have had: half widths, floors and what was reached, in
 * *s->r; leaves those that are to be sampled on in s->active. False, with *err, if memory is out.
 */
bool accuracy_judge(accuracy_state *s, lux_error *err);

/* Half widths of the mean over all items, once all is judged: s->r->of_average. */
void accuracy_judge_average(const accuracy_state *s);

#endif
