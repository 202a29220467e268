/* sim/path.h -- light that reaches a point after any number of reflections.
 *
 * Path tracing with next-event estimation: from the point a direction is drawn as the sensor
 * weighs light (in proportion to the cosine, on a plane); at each surface met, one light is drawn
 * and asked directly, a direction is drawn as the material reflects, and Russian roulette ends the
 * path without bias. No number of bounces ends it otherwise. Samples are Owen-scrambled Sobol
 * points, eight dimensions a bounce:
 *
 *     E(x) = E_lights(x) + response / pdf L(x, w)                for the w that is drawn
 *     L(x, w) = L_emitted(y) + sum of f cos E_lights(y) + weight L(y, w')   at what w meets, y
 *
 * What is found in both ways, by asking lights and by the path's own rays, counts with the power
 * heuristic of both pdfs, p_a^2 / (p_a^2 + p_b^2) (Veach and Guibas, SIGGRAPH 1995): glowing
 * surfaces always, lamps with extent by way of all that is not matt. Plane mirrors
 * and panes show lights again, which are asked for as well (mirrors.h); what other mirrors and
 * lenses focus is left to maps where there are any, and else counts in full where a ray meets it.
 * Through thin glass and holes a path goes straight as if it had not met them; shadow rays have
 * passed there too. So they have through plates of glass that refract: what a path finds behind
 * these, bent, counts only if it began at the eye. No shadow ray passes other solids.
 *
 * A path is worked out alone, whatever packet it travels in: its result depends on its sample
 * number and seed only.
 */
#ifndef SIM_PATH_H
#define SIM_PATH_H

#include "sim/illumination_map.h"
#include "sim/scene.h"
#include "sim/sun_patch.h"

enum { PATHS = 1024 }; /* most at once; a multiple of every packet width */

/* What paths find, W/m^2, by channel. */
typedef float path_sums[3][PATHS];

/* One bundle of paths, as arrays of `count` numbers. Filled in by the caller: where they begin
 * (from the eye: and which way) and their sample. Given back: what they found, by the order in
 * which they began. */
typedef struct path_bundle {
    int count;
    float x[PATHS], y[PATHS], z[PATHS];    /* m, where they begin */
    float error[PATHS];                    /* m, of that place */
    float nx[PATHS], ny[PATHS], nz[PATHS]; /* unit normal of the lit side, or where it faces; from
                                              the eye the direction */
    uint32_t index[PATHS], seed[PATHS];    /* which sample of which scrambled set */
    uint32_t set[PATHS];                   /* and the number of that, < SCRAMBLES */

    path_sums direct;    /* straight from lamps, if asked for, and from glowing surfaces, thin glass
                            between or not */
    path_sums indirect;  /* after at least one reflection */
    path_sums *layers;   /* NULL; or of each group, undimmed: both; behind them: direct alone */
    path_sums *mirrored; /* NULL; or what of `indirect` came from lamps and suns by way of plane
                            mirrors alone, as asked for there */
    path_sums *outside;  /* NULL; or what of `indirect` came last from the ground or from a surface
                            that is outside */
    path_sums *daylight; /* NULL; or what is of suns and skies */
    float *smoothed;  /* NULL; or of PATHS: W/m^2, as luminance, by which it would be less if maps
                         were coarser by a step */
    float met[PATHS]; /* 1 if a surface that gives light back was seen, else 0 */
} path_bundle;

typedef struct path_options {
    study_quantity quantity; /* what the beginning is */
    bool lamps;              /* ask lamps where they begin; glowing surfaces are always found */
    bool bounce;             /* go on from there; false: straight light alone (--direct-only) */
    bool eye;     /* they begin with a ray from the eye: sums are the radiance that comes along it,
                     W/(sr m^2); lamps with extent are seen */
    float spread; /* rad: of the beam that a ray from the eye stands for */
    bool bounded; /* go on at most so many times; what lets light straight through counts too */
    int bounces;
    int roulette_from; /* times before which no path is ended by chance */
} path_options;

typedef struct path_tracer path_tracer; /* scratch of one thread */
path_tracer *path_tracer_new(arena *a, const scene *s, lux_error *err);

/* From now on sunlit patches are asked for light, too; they must outlive t. */
void path_use_patches(path_tracer *t, const sun_patches *patches);

/* From now on maps are asked (NULL: none of that kind); they must outlive t. Focused light is found
 * by its map alone, and no more by rays that meet lamps behind glass or round mirrors. */
void path_use_maps(path_tracer *t, const illumination_map *indirect,
                   const illumination_map *focused);

/* From now on focused light is left out, as if a map were there that holds none. */
void path_leave_focused(path_tracer *t);

/* Fills in what the paths of b find: estimates of what their sensor measures, one a path. */
void path_trace(path_tracer *t, path_bundle *b, const path_options *o);

/* Rays traced so far. */
int64_t path_rays(const path_tracer *t);

#endif
