/* sim/cost.h -- what accuracy costs in time: a study run by many settings, against a reference. */
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

typedef struct cost_row {
    cost_ladder ladder;
    char setting[64];
    double seconds; /* median of three runs */
    int64_t rays;
    double rms, worst;    /* relative error against the reference, its own noise taken off */
    double half_width;    /* as stated: root of the mean of squares, relative */
    double seconds_for_1; /* to reach 1 % RMS, by the fitted slope; NAN: it never would */
    bool reaches;         /* the study's accuracy */
} cost_row;

typedef struct cost_options {
    run_options run; /* threads, seed, deadline, progress */
    plan_options plan;
} cost_options;

typedef struct cost_result {
    int row_count;
    const cost_row *rows;
    double slope; /* of log error against log rays along the ladder of accuracy; NAN: not known */
    double asked; /* the study's accuracy */
    double reference_half_width; /* relative */
    double reference_seconds;
    char advice[240];
    run_end end; /* RUN_LATE: some rows are missing */
} cost_result;

/* False, with *err. */
bool cost_run(arena *a, const study *s, const cost_options *o, cost_result *out, notices *n,
              lux_error *err);

#endif
