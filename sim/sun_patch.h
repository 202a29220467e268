/* sim/sun_patch.h -- the patches that suns light through portals, as points that light a room; and
 * what lies beside them, lit by them.
 *
 * Places o are spread evenly over each portal that a sun shines through, and the sunlight through
 * each is followed to the first surface y that lets no light straight through. Where the sun sees
 * y, a point is kept; those of one portal stand for all the sunlight that comes in by it,
 *
 *                 o         the portal                w: toward the sun
 *        -----=========-----                          c: cosines
 *              \   \   \
 *               \   \   \          A c(o, w) * kept / cast      [m^2, square to w]
 *                \   \   \
 *         ------- ============
 *                 y   the patch
 *
 * with A the portal's area. There are SCRAMBLES sets of points, each of a scramble of its own: who
 * asks set r for its own scramble r finds the error of the points in its interval.
 *
 * Immutable once made: any thread may ask.
 */
#ifndef SIM_SUN_PATCH_H
#define SIM_SUN_PATCH_H

#include "sim/accuracy.h"
#include "sim/scene.h"

typedef struct sun_patches sun_patches;

/* Those of all suns of the scene, good enough for that accuracy (relative). *out is NULL where no
 * sun lights anything through a portal. False, with *err, if memory is out. */
bool sun_patches_new(arena *a, const scene *s, uint32_t seed, double accuracy, int threads,
                     const sun_patches **out, lux_error *err);

/* The suns that light some patch: how many, and the number of each, < scene.sun_count. */
int sun_patch_suns(const sun_patches *w);
int sun_patch_sun(const sun_patches *w, int i);

/* Whether all surfaces of the scene are matt, and points hold what they give back. */
bool sun_patches_matt(const sun_patches *w);

/* Points of patches, y, one a lane; or points z that such a point lights, in a direction drawn from
 * y as a matt surface sends light. */
typedef enum patch_generation { PATCH_FIRST, PATCH_SECOND } patch_generation;
typedef struct patch_point {
    vsurface at;  /* y or z: its place, and its normal on the side that is lit */
    vvec3 before; /* unit: toward the sun; from z toward y */
    vrgb light;   /* where all surfaces are matt what it gives back on its lit side, W/(sr m^2):
                     f(y) c(y, w) e, with e the sunlight that arrives square to w; of z, f(z) pi f(y)
                     e. Else what arrives: e, W/m^2; of z, pi f(y) e */
    vhit hit;     /* where not all are matt; without its distance */
    vfloat area;  /* m^2, square to w: what the point stands for, by the chance of its draw */
    vfloat part;  /* 1/m^2: what of sun_patch_density() is by the portal that it was drawn by; where
                     others lie behind or before that, all of them have points of the same light */

    /* Of z alone */
    vvec3 patch;       /* m: y */
    vvec3 to_sun;      /* unit: w */
    vfloat patch_cos;  /* c(y, w) */
    vfloat patch_thin; /* c(y, z) / |y - z|^2, 1/m^2 */
    vfloat drawn;      /* the density of z as drawn from y, 1/m^2 */
} patch_point;

/* A point of what sun number `sun` lights, by two numbers in [0, 1): one portal of all in
 * proportion to its sunlight, the less the farther it is from x. The lanes that have one. */
vmask sun_patch_draw(const sun_patches *w, patch_generation which, int sun, vint set,
                     const vvec3 *x, vfloat u, vfloat v, vmask active, patch_point *out);

/* The density, 1/m^2, on a plane square to wi, with which points at y are drawn for x; wi: from y
 * toward that sun. */
vfloat sun_patch_density(const sun_patches *w, int sun, const vvec3 *x, const vvec3 *y,
                         const vvec3 *wi, vmask active);

#endif
