/* sim/accuracy.h -- how many samples are enough, and how far off a result may be.
 *
 * Many unknowns (the illuminances of a grid's sensors, the luminances of a picture's pixels) are
 * each the mean of random samples. Each unknown is estimated by SCRAMBLES independent scrambles
 * of one low-discrepancy set, n samples each; their SCRAMBLES means m are independent and
 * unbiased, so that
 *
 *     half width = t s / sqrt(SCRAMBLES),    s^2 = sum (m - mean)^2 / (SCRAMBLES - 1)
 *
 * with t the 97.5 % quantile of Student's distribution of SCRAMBLES - 1 degrees of freedom, is
 * half of a 95 % confidence interval (Owen, "Monte Carlo theory, methods and examples", 17.2). n
 * doubles from round to round, and after the second an unknown is done when its half width is at
 * most
 *
 *     accuracy * max(|mean|, floor)
 *
 * Bounds of what the samples leave out are added to half widths.
 *
 * Instead of one quantity of an unknown, a second and parts of that may be judged: all light
 * undimmed, and the layers of its groups. They are held to PARTS_SHARE of the accuracy, against
 * max(|mean|, floor of the second), so that sums of the parts in other shares have the accuracy,
 * too, unless they are but a little of it all. The first quantity, such a sum, then has its half
 * width and no say: how many samples there are does not depend on the shares.
 *
 * Who stops at the first small interval stops too early too often, and low: samples that missed
 * what is rare and bright are few, dim and alike. So an unknown is never taken to be much surer
 * than the others are: where its own relative variance v_i (of a sample) is below their mean v, the
 * mean of both counts. Nor than it was itself at the look before, after half the samples, which is
 * what corrects for looking after each round: where v_i has fallen since, the mean of both counts.
 * Among many unknowns that costs some 5 % more samples; quantiles of 1 - 0.025 / looks, which hold
 * no more of the truth, cost 20 to 60 %. What this buys is measured: for one unknown alone in
 * tests/unit/test_accuracy.c, in whole scenes in tests/physics/long_scene_coverage.c.
 *
 * Where samples of a scramble share errors, the half of the samples that is a round's and the half
 * that was there before tell of them: with r the correlation of their means over the scrambles, the
 * square of the half width has 2 r / (1 + r) of itself to stay however many samples follow. At
 * r > 0.9 that is believed: of independent halves 16 pairs show it once in 10^6 times (Fisher
 * 1921).
 *
 * The mean over all items has a half width by the same formula: what a scramble says of it is the
 * mean of what it says of each. Whatever items share, as errors of a map, is in that; where they
 * are independent, their half widths h_i tell the same with less noise, sqrt(sum h_i^2) / items,
 * and hold what guards against stopping early. The larger one counts,
 * and a twentieth of the mean half width more: what stopping early takes from each is no noise that
 * would average out. The mean half width itself is the most that it can be.
 *
 * Results depend on the seed and not on threads: rounds are common to all, samples are summed by
 * number. Only a deadline, or the user's Ctrl-C, cuts a round short.
 */
#ifndef SIM_ACCURACY_H
#define SIM_ACCURACY_H

#include "core/arena.h"
#include "core/error.h"
#include "core/progress.h"

#include <stdint.h>

enum {
    SCRAMBLES    = 16,
    BUNDLE       = 1024,    /* samples that are asked for at once, at most */
    MOST_SAMPLES = 1 << 20, /* a scramble: 16 million an unknown */
    LEAST_ROUNDS = 2,       /* before an unknown is done */
};
#define PARTS_SHARE 0.8

typedef struct sample_id {
    uint32_t item, scramble, index; /* index of the sample in its scrambled set */
} sample_id;

/* Which mean sets the floor below which accuracy is not relative any more. */
typedef enum floor_kind {
    FLOOR_MEAN,     /* a tenth of the mean of all items */
    FLOOR_LOG_MEAN, /* a tenth of the geometric mean of those above 0 */
} floor_kind;

typedef struct accuracy_desc {
    int items, channels;
    int judged; /* the first so many channels have half widths; 0: one. If more than one, the
                   first is not held to the accuracy: see above */
    int told;   /* so many more, behind those, have half widths, too, and no say; each has a floor
                   of its own, and nothing of it is known besides */
    bool apart; /* of several: each has a say of its own, against a floor of its own */
    const double *exact; /* what is known of those besides: judged * items; NULL: 0 */
    const double *bound; /* how far off the rest may be at most, >= 0: judged * items; NULL: 0 */
    const double *fixed; /* half widths that stay however many samples there are, as all of a
                            scramble share what makes them: judged * items; NULL: 0 */
    bool common; /* samples of a scramble may share errors (as of one map) that more of them do not
                    lower: an unknown of which that is left is given up */
    double accuracy; /* > 0, relative */
    double needed;   /* share of the items that must be done, (0, 1] */
    floor_kind floor;
    int first_samples;  /* a scramble, in the first round; a power of two <= BUNDLE */
    int only_samples;   /* an item takes so many and no more, in as many scrambles as divide them,
                           whatever that makes of the accuracy; 0: as many as it takes */
    int dark_samples;   /* a scramble, at least, before samples that were all 0 are believed */
    int threads;        /* >= 1 */
    double deadline;    /* s, on clock_seconds(); HUGE_VAL: none. Two sets an item come first. */
    progress *progress; /* may be NULL; its stop ends the work */

    /* Fills in values[channel * BUNDLE + i] of sample i, for i < count <= BUNDLE. */
    void (*sample)(void *context, int thread, const sample_id *ids, int count, float *values);
    void *context;
} accuracy_desc;

/* Why a run ended, and what that is called in results: NULL for RUN_DONE. */
typedef enum run_end {
    RUN_DONE,        /* the accuracy asked for is reached */
    RUN_INTERRUPTED, /* the user stopped it */
    RUN_LATE,        /* its time was out */
    RUN_EXHAUSTED,   /* MOST_SAMPLES are not enough */
    RUN_HELD_UP,     /* no number of samples would be */
} run_end;
const char *run_end_text(run_end end);

typedef struct accuracy_result {
    double *mean;       /* items * channels, channel by channel; without `exact` */
    double *half_width; /* (judged + told) * items, channel by channel; bounds included */
    double *of_average; /* judged + told: half width of the mean over all items, without bounds */
    uint32_t *samples;  /* an item: all its samples */
    int missed;         /* items that are not done */
    double floor;       /* what `floor` came to, of channel 0 */
    double reached;     /* the accuracy that all but the items beyond `needed` have */
    run_end end;        /* RUN_DONE: the share needed is done */
    bool complete;      /* every item has at least two of its SCRAMBLES sets */
} accuracy_result;

/* Samples until enough is done, or time or the user ends it. False, with *err, if memory is out.
 * The result is allocated in a. */
bool accuracy_run(arena *a, const accuracy_desc *d, accuracy_result *out, lux_error *err);

/* Half of the 95 % interval of the mean of so many independent values, <= SCRAMBLES, as above, and
 * that mean. Less than two tell nothing: HUGE_VAL. */
double accuracy_half_width(const double *values, int count, double *mean);

/* Seconds since some moment, steadily growing. */
double clock_seconds(void);

/* The deadline of the next of `left` runs that share what is left until one for all. */
double deadline_share(double deadline, int left);

#endif
