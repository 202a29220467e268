/* sim/cost.h -- what accuracy costs in time: a study run by many settings, against a reference.
 *
 * All settings run on the study's first grid or, where it has views alone, on its first view made
 * small. With e the error of a sensor relative to max(reference, a tenth of the reference's
 * average), K runs of different seeds, and s the reference's own standard error:
 *
 *     RMS^2   = mean over sensors and runs of e^2 - mean of s^2
 *     noise^2 = mean over sensors of the variance of e between runs
 *     bias^2  = mean over sensors of (mean of e over runs)^2 - noise^2 / K - mean of s^2,
 *               0 where that is less than two of its standard errors
 *
 * More time lowers noise and leaves bias as it is.
 */
#ifndef SIM_COST_H
#define SIM_COST_H

#include "core/progress.h"
#include "sim/plan.h"

typedef enum cost_ladder {
    COST_ACCURACY,  /* targets: 20 % ... 0.5 % */
    COST_BOUNCES,   /* 0, 1, 2, 4, 8, unlimited */
    COST_TRANSPORT, /* paths, maps */
    COST_EFFECTS,   /* each of the plan, off and on */
    COST_RECKONING, /* scene_measures */
    COST_RAYS,      /* of views: 1, 4, 9, 25 a pixel */
    COST_LADDERS
} cost_ladder;
const char *cost_ladder_name(cost_ladder l); /* "accuracy" */

typedef struct cost_row {
    cost_ladder ladder;
    char setting[64];     /* as an option where there is one */
    double accuracy;      /* relative, that it was run for */
    double seconds;       /* median of the runs */
    int64_t rays;         /* the same */
    double rms, worst;    /* relative error against the reference, its own noise taken off */
    double noise, bias;   /* what RMS is made of */
    double half_width;    /* as stated: root of the mean of squares, relative; NAN: none is */
    double within;        /* [0, 1]: the share of the sensors that has the study's accuracy */
    double seconds_for_1; /* to reach 1 % RMS, by the fitted slope; NAN: it never would */
    int runs;
    bool reaches;  /* the study's accuracy: 95 % of the sensors have it */
    bool promises; /* so do 95 % of the stated half widths */
} cost_row;

typedef struct cost_options {
    run_options run;   /* threads, seed, progress; the deadline bounds the whole */
    plan_options plan; /* as the user asks */
} cost_options;

typedef struct cost_result {
    const char *what; /* the name of the grid or view */
    bool view;
    int row_count;
    const cost_row *rows;
    double slope; /* of log error against log rays along the ladder of accuracy; NAN: not known */
    double asked; /* the study's accuracy */
    double reference_accuracy;   /* that it was run for; relative */
    double reference_half_width; /* relative, root of the mean of squares */
    double reference_seconds;
    const char *left_to_chance; /* why the reference's intervals are not valid; NULL: they are */
    int dropped_count;          /* settings for which there was no time */
    const char *const *dropped;
    char advice[320];
    run_end end; /* RUN_LATE: time was out earlier than was planned, runs are missing */
} cost_result;

/* Runs each setting three times, in turns. The deadline is kept by leaving out the costliest
 * settings. False, with *err; also (ERR_INTERRUPTED) if the user stopped it before there was a
 * reference, and if there was no time even for that. */
bool cost_run(arena *a, const study *s, const cost_options *o, cost_result *out, notices *n,
              lux_error *err);

#endif
