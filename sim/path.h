/* sim/path.h -- light that reaches a point after any number of reflections.
 *
 * Path tracing with next-event estimation: from the point a direction is drawn in proportion to
 * the cosine; at each surface met, one lamp is drawn and asked directly, a direction is drawn as
 * the material reflects, and Russian roulette ends the path without bias. No number of bounces
 * ends it otherwise. Samples are Owen-scrambled Sobol points, four dimensions a bounce:
 *
 *     E(x) = E_lamps(x) + pi L(x, w),      w drawn with pdf cos / pi
 *     L(x, w) = L_emitted(y) + sum of f cos E_lamp(y) + weight L(y, w')     at what w meets, y
 *
 * A path is worked out alone, whatever packet it travels in: its result depends on its sample
 * number and seed only.
 */
#ifndef SIM_PATH_H
#define SIM_PATH_H

#include "sim/scene.h"

enum { PATHS = 1024 }; /* at most at once; a multiple of every packet width */

/* One bundle of paths, as arrays of `count` numbers. Filled in by the caller: where they begin
 * and their sample. Given back: what they found, by the order in which they began. */
typedef struct path_bundle {
    int count;
    float x[PATHS], y[PATHS], z[PATHS];    /* m, where they begin */
    float error[PATHS];                    /* m, of that place */
    float nx[PATHS], ny[PATHS], nz[PATHS]; /* unit normal of the lit side */
    uint32_t index[PATHS], seed[PATHS];    /* which sample of which scrambled set */

    float lamp[3][PATHS];     /* W/m^2 straight from lamps, if asked for */
    float glow[3][PATHS];     /* W/m^2 straight from glowing surfaces */
    float indirect[3][PATHS]; /* W/m^2 after at least one reflection */
    float met[PATHS];         /* 1 if the first ray met a surface that reflects, else 0 */
} path_bundle;

typedef struct path_tracer path_tracer; /* scratch of one thread */
path_tracer *path_tracer_new(arena *a, const scene *s, lux_error *err);

/* Fills in what the paths of b find: irradiance estimates, one a path. `lamps`: also ask one lamp
 * at the beginning. `bounce` false: nothing after that (--direct-only; glow is still found). */
void path_trace(path_tracer *t, path_bundle *b, bool lamps, bool bounce);

/* Rays traced so far. */
int64_t path_rays(const path_tracer *t);

#endif
