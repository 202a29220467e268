/* sim/daylight.h -- grids through the day: a series of moments, run in batches.
 *
 * All moments of a batch are weighed from the same paths (grid.h); a batch has a scene of its own,
 * which holds the skies and suns of its moments and no others.
 */
#ifndef SIM_DAYLIGHT_H
#define SIM_DAYLIGHT_H

#include "sim/grid.h"

enum { MOST_MOMENTS_A_BATCH = 48 };

/* One grid at one moment. */
typedef struct daylight_figures {
    double average, minimum, maximum; /* lx */
    double uniformity;                /* minimum / average, 0 if dark */
    double average_half_width;        /* lx */
    double worst_half_width;          /* relative to max(illuminance, a tenth of the average) */
    double sun;                       /* [0, 1]: mean over the sensors of grid_moment.sun */
} daylight_figures;

/* One grid through all moments. */
typedef struct daylight_series {
    grid_result plan; /* what grid_sensors() says; all light is in what follows */
    const moment *moments;
    int count;             /* of those that were run, the first ones of */
    int wanted;            /* so many */
    grid_moment *light;    /* of each of the first `count` */
    daylight_figures *of;  /* the same */
    double north_deg;      /* where true north lies, clockwise from +y */
    char under[160];       /* where and under which sky, for people; "" if it is not known */
    double step_h;         /* of the series; NAN: a single time a day, which has no length */
    double *sun_hours;     /* h, a sensor: step * grid_moment.sun, over all moments, by date: the
                              mean of a day. NULL: no step, or nothing looked for the sun */
    int dates;             /* of those that were run */
    double asked, reached; /* as of grid_result, over all moments */
    int missed;            /* sensors, in the batch where they are most */
    run_end end;           /* not RUN_DONE if that of some batch is not, or if some are missing */
    const char *left_to_chance;
    double seconds;
    int64_t rays;
} daylight_series;

typedef struct daylight {
    arena *a; /* of the results */
    const study *study;
    const moment *moments;
    int moment_count;
    int batches;
    int threads;
    notices *notices;
    uint32_t off, on;        /* as in scene_options */
    const scene *scene;      /* of the first batch until daylight_run() ends */
    arena of_scene;          /* of that and the ones that follow */
    daylight_series *series; /* of study->grids */
} daylight;

/* Makes the scene of the first batch. Fill in all above `batches`, threads and notices; step_h as
 * in the series. False, with *err: as scene_new() and grid_sensors(), or if the study has no
 * daylight. */
bool daylight_begin(daylight *d, double step_h, lux_error *err);

/* Makes the scene of the first batch anew, and all others, without effects and with others: `off`
 * and `on` of scene_options. False, with *err. */
bool daylight_plan(daylight *d, uint32_t off, uint32_t on, lux_error *err);

/* Runs all grids at all moments; o->deadline is shared among them. What there was when the user
 * stopped it is there. False, with *err, if something fails, or if there was nothing yet. */
bool daylight_run(daylight *d, const run_options *o, lux_error *err);

/* Gives the scene back; to be called after daylight_begin(), whatever became of it. */
void daylight_end(daylight *d);

/* Figures of one moment, of n sensors. */
daylight_figures daylight_figures_of(const grid_moment *m, int n);

/* Sets sun_hours (in a) and dates from the other fields; false, with *err, if memory is out. */
bool daylight_sum_sun(arena *a, daylight_series *s, lux_error *err);

/* Whether two moments are of one date, as clocks there show it. */
bool daylight_same_date(const moment *a, const moment *b);

#endif
