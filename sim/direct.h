/* sim/direct.h -- light that reaches a point straight from the lamps.
 *
 * Points are surfaces of core/world.h (sensors too): a position with its error, and the normal
 * of the side that is lit. Results are irradiance, W/m^2. Lanes outside `active` come back zero.
 */
#ifndef SIM_DIRECT_H
#define SIM_DIRECT_H

#include "sim/scene.h"

/* Scratch of one thread for batches of at most DIRECT_PACKETS packets. */
enum { DIRECT_PACKETS = 256 };
typedef struct direct_scratch direct_scratch;
direct_scratch *direct_scratch_new(arena *a, const scene *s, lux_error *err);

/* The sum over all lamps, each with its own shadow rays: without noise, since every lamp of this
 * version is a point or far away. */
void direct_all(const scene *s, direct_scratch *w, const vsurface *at, const vmask *active,
                int packets, vrgb *e);

/* One lamp drawn for each point, in proportion to the irradiance (luminance) it would give if
 * nothing stood between: an unbiased estimate of the sum by one shadow ray. `pick` in [0,1)
 * draws. Of the lamp: the direction to it and e / p on a surface facing it, shadow applied. */
typedef struct direct_pick {
    vvec3 wi;
    vrgb e; /* W/m^2, facing wi, divided by the probability of the choice; 0 in shadow */
} direct_pick;
void direct_one(const scene *s, direct_scratch *w, const vsurface *at, const vmask *active,
                const vfloat *pick, int packets, direct_pick *out);

/* Shadow rays that were traced with w so far. */
int64_t direct_rays(const direct_scratch *w);

#endif
