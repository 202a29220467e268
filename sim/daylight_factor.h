/* sim/daylight_factor.h -- the daylight factor: what an overcast day gives inside, by outside.
 *
 *     D = 100 E / E_hz   [%]
 *
 * with E_hz on level ground under the whole sky, sun and lamps off (CIE 16, EN 17037 B.2). Its
 * parts (CIE 171, 5.9 to 5.14): light that comes straight from the sky; that whose last surface
 * before the sensor is outside, the ground among them; all else.
 */
#ifndef SIM_DAYLIGHT_FACTOR_H
#define SIM_DAYLIGHT_FACTOR_H

#include "sim/grid.h"

typedef struct daylight_factor {
    const grid_result *plan;                                /* what it was made from */
    double *all, *sky, *external, *internal, *half_width;   /* %, a sensor */
    double average, minimum, maximum, median;               /* %, over the sensors */
    double uniformity;                                      /* minimum / average, 0 if dark */
    double average_half_width;                              /* % */
    double average_sky, average_external, average_internal; /* % */
    double share; /* [0, 1]: sensors that have FACTOR_LEAST or more */
} daylight_factor;

#define FACTOR_LEAST 2.0 /* % */

/* The study under an overcast sky: its own if that is one (CIE types 1 and 3, which are the same
 * all around), else the traditional one, (1 + 2 sin h) / 3; ground as the study has it; neither
 * sun nor time. NULL if memory is out. The scene is to be made with lamps_off. */
const study *daylight_factor_study(arena *a, const study *s, lux_error *err);

/* What that sky is called. */
const char *daylight_factor_sky(const study *overcast);

/* Of a run on that scene with run_options.outside; lives in a. False if memory is out. */
bool daylight_factor_of(arena *a, const grid_result *r, daylight_factor *out, lux_error *err);

#endif
