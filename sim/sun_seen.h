/* sim/sun_seen.h -- what sensors get straight from suns.
 *
 * A sun is a small disk or a point: most sensors see all of it or nothing. So a sensor first looks
 * at it by a few rays. Where these differ it lies in a half shadow, and as many more are cast, by
 * SCRAMBLES scrambles, as its share of the accuracy asked for needs: half of their 95 % interval is
 * a bound. Where they agree, what they find counts as known; samples then ask again, each one sun
 * of all, and add what is different: mostly nothing. That sum has no bias, and what the first rays
 * missed shows in the interval.
 */
#ifndef SIM_SUN_SEEN_H
#define SIM_SUN_SEEN_H

#include "core/sampler.h"
#include "sim/scene.h"
#include "sim/sensor.h"

enum {
    SUN_RAYS      = 16, /* at first; 1 for a sun that is a point */
    MOST_SUN_RAYS = 1 << 20,
    SUN_PACKETS   = 256,
};

/* Scratch of one thread. */
typedef struct sun_seen sun_seen;
sun_seen *sun_seen_new(arena *a, const scene *s, study_quantity q, lux_error *err);

/* What a sensor knows of a sun. */
typedef struct sun_look {
    vfloat e;     /* W/m^2, as luminance */
    vfloat bound; /* how far off that may be: of those in a half shadow, else 0 */
    vfloat open;  /* [0, 1]: the share of the disk that nothing opaque hides */
    vmask mixed;  /* it lies in a half shadow: samples need not ask again */
} sun_look;

/* Of sun number `sun` < scene.sun_count; `sensor` tells the numbers of sensors apart. */
sun_look sun_look_at(sun_seen *w, const vsurface *at, int sun, uint32_t seed, vuint sensor,
                     double accuracy, vmask active);

/* One ray of each lane, toward suns of its own: as luminance, W/m^2. packets <= SUN_PACKETS. */
void sun_ask(sun_seen *w, const vsurface *at, const vint *sun, const vsample4 *u,
             const vmask *active, int packets, vfloat *e);

int64_t sun_rays(const sun_seen *w);

#endif
