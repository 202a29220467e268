/* sim/direct_sensor.h -- light straight from all lamps but suns at the sensors of a grid, as
 * luminances, maintenance applied.
 *
 * What needs no samples is summed here for good: over lamps without extent, one shadow ray each,
 * and over all lamps where nothing can stand between, by their closed forms or, where their bound
 * allows, as points (light.h). Of more than a few lamps only the strongest are asked one by one,
 * until those that are left give less than a tenth of the accuracy asked for; of these 16 rays are
 * drawn. All other lamps with extent are left to samples, of which each asks one lamp, drawn by
 * what it would give if nothing stood between.
 *
 * Everything is summed twice: as dimmed, and undimmed by group in a layered scene.
 */
#ifndef SIM_DIRECT_SENSOR_H
#define SIM_DIRECT_SENSOR_H

#include "sim/scene.h"
#include "sim/sensor.h"

/* So many lamps are asked one by one, whatever they give. */
enum { ASKED_LAMPS = 16 };

typedef struct sensor_ask {
    study_quantity quantity;
    double accuracy; /* relative, that is asked for */
    bool in_room;    /* the sensors are where nothing hides lamps that are `clear` */
    uint32_t seed;
} sensor_ask;

/* W/m^2, as luminance: what lamps give, and at most how far off that is. */
typedef struct sensor_sum {
    vfloat e, bound;
} sensor_sum;

/* Scratch of one thread. */
typedef struct direct_sensor direct_sensor;
direct_sensor *direct_sensor_new(arena *a, const scene *s, const sensor_ask *ask, lux_error *err);

/* The part that needs no samples, for a packet of sensors, whose numbers begin with `first`:
 * sums[0] as dimmed, sums[1 + g] of group g if the scene is layered. The lanes whose sensor has
 * another part, too. */
vmask direct_sensor_sum(direct_sensor *w, const vsurface *at, vmask active, uint32_t first,
                        sensor_sum *sums);

/* Looks at a packet of sensors whose other part is to be sampled. */
void direct_sensor_prepare(direct_sensor *w, const vsurface *at, vmask active);

/* Samples of sensor i of that packet: number index[j] of the set seed[j] names, j < count. In e[j]
 * the luminance, W/m^2, undimmed in a layered scene, and in lamp[j] the lamp, -1 for none. */
void direct_sensor_draw(direct_sensor *w, int i, const uint32_t *index, const uint32_t *seed,
                        int count, float *e, int32_t *lamp);

/* Shadow rays traced so far. */
int64_t direct_sensor_rays(const direct_sensor *w);

#endif
