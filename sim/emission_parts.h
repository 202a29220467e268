/* sim/emission_parts.h -- what the files of emission share; only they include it.
 *
 * Daylight comes along straight lines from far away, drawn in two ways: open, over all of the
 * sphere around the scene, and through portals. With L the radiance, S(w) the area of all portals
 * as seen along w, N how many a line goes in by, and
 *
 *     A = integral of L pi R^2 dw    B = integral of L S(w) dw    [W]
 *
 * the former draws lines with the density L / A, the latter with L N / B, in the shares
 * k A / (k A + B) and B / (k A + B) of cases. Then all lines together have that of
 *
 *     L (k + N) / (k A + B)
 *
 * and so, whatever shines, light that comes in by a portal has even weights, and the rest is only
 * rarer by k. Nothing is counted twice or lost, whatever else is open. k is 0 only where portals
 * are all that light comes in by.
 */
#ifndef SIM_EMISSION_PARTS_H
#define SIM_EMISSION_PARTS_H

#include "sim/emission.h"

/* The skies of one group, or all of a scene that is not layered. */
typedef struct sky_source {
    int group;            /* -1: all */
    const int32_t *skies; /* as scene.skies counts */
    int count;
    const dome *open, *through; /* by L; by L S(w); NULL without portals */
} sky_source;

/* Of a source that is far away, W as luminance: A and B of above. */
typedef struct far_flux {
    double open, through;
} far_flux;

/* Sources are drawn from in two steps, blocks of them first: of a million emitters beside a strong
 * lamp each has a share that one table of floats would round to none. */
enum { BLOCK = 1024 };

struct emission {
    const scene *s;
    light_target around; /* all surfaces */
    float area;          /* m^2, of the sphere as seen from far away */
    const portal *portals;
    int portal_count;
    double rare; /* k */

    int light_count; /* sources: as scene.lights counts, then skies */
    int sky_count;
    const sky_source *skies;
    const float *through; /* of each source: the share of cases in which it is drawn by portals */
    int blocks, block;    /* how many, of how many sources each */
    const float *block_cdf;
    const float *source_cdf; /* of each block */
    double flux;             /* W */
};

/* What a lane draws by. */
typedef struct emission_numbers {
    vsample4 u; /* of place and direction */
    vfloat way, portal;
} emission_numbers;

/* Skies and what of them comes in, in groups if the scene is layered (emission_sky.c); room for
 * as many as there are groups in *flux. */
bool emission_make_skies(arena *a, emission *e, far_flux **flux, lux_error *err);

/* The same of a light that is far away. */
far_flux emission_far_flux(const emission *e, const light *l);

/* Source number `which`, a far light or a sky: the lanes that have a particle (emission_far.c). */
vmask emission_draw_light(const emission *e, int which, const emission_numbers *n, vmask active,
                          vparticle *out);
vmask emission_draw_sky(const emission *e, int which, const emission_numbers *n, vmask active,
                        vparticle *out);

/* m^2, S(w): of light that comes from wi. */
vfloat emission_portals_seen(const emission *e, const vvec3 *wi);

#endif
