/* sim/sun_seen.h -- what sensors get straight from suns.
 *
 * A sun is a small disk or a point: most sensors see all of it or nothing. So a sensor first looks
 * at it by a few rays, and what they find counts as known; samples then ask again, each one sun of
 * all, and add what is different: nothing, but for sensors in a half shadow. The sum has no bias,
 * and what the first rays missed shows in the interval.
 */
#ifndef SIM_SUN_SEEN_H
#define SIM_SUN_SEEN_H

#include "core/sampler.h"
#include "sim/scene.h"
#include "sim/sensor.h"

enum { SUN_RAYS = 16 /* at first; 1 for a sun that is a point */, SUN_PACKETS = 256 };

/* Scratch of one thread. */
typedef struct sun_seen sun_seen;
sun_seen *sun_seen_new(arena *a, const scene *s, study_quantity q, lux_error *err);

/* Sun number `sun` < scene.sun_count by the first rays: the mean luminance, W/m^2, and the share of
 * the disk that nothing opaque hides, [0, 1]. `first`: what tells the sensors' numbers apart. */
void sun_look(sun_seen *w, const vsurface *at, int sun, uint32_t seed, vuint sensor, vmask active,
              vfloat *e, vfloat *open);

/* One ray of each lane, toward suns of its own: as luminance, W/m^2. packets <= SUN_PACKETS. */
void sun_ask(sun_seen *w, const vsurface *at, const vint *sun, const vsample4 *u,
             const vmask *active, int packets, vfloat *e);

int64_t sun_rays(const sun_seen *w);

#endif
