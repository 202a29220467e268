/* sim/direct_parts.h -- what the files of direct_sensor.h share: direct_sensor.c weighs all lamps
 * and sums what it can, direct_tail.c asks the strongest of many and draws of the weak ones,
 * direct_draw.c takes the samples.
 */
#ifndef SIM_DIRECT_PARTS_H
#define SIM_DIRECT_PARTS_H

#include "sim/direct.h"
#include "sim/direct_sensor.h"
#include "sim/shadow.h"

/* A lamp as the sensors of a packet see it. */
typedef struct candidate {
    vvec3 wi;
    vfloat dist;
    vfloat e;      /* W/m^2 as luminance, as a point or by its closed form; nothing in between */
    vfloat error;  /* bound of what that is off; INFINITY: it takes samples */
    vfloat weight; /* about what it gives; above 0 wherever it does */
} candidate;

struct direct_sensor {
    const scene *s;
    sensor_ask ask;
    int layers; /* each judged by itself */
    int64_t ray_count;
    candidate *lamps;
    vfloat *lost; /* of sums: what they have lost to rounding */

    /* Of a layer */
    vfloat *total;   /* the sum of weights */
    vfloat *sure;    /* what it gives at least, if nothing stands between */
    vfloat *count;   /* how many weights are above 0 */
    vfloat *weakest; /* lamps that give less are its tail */
    vfloat *most;    /* those that give as much have been asked before */
    vfloat *arrived; /* of their light, and of lamps that nothing can shadow */
    vfloat *tail;    /* the sum of what is left to be drawn of */
    vfloat *sampled; /* the weights of those that take samples */

    /* Lamps to be sampled, lane by lane: their running sums of weights */
    int32_t *listed[LANES], listed_count[LANES];
    float *running[LANES];
    vsurface at;
    vmask prepared; /* the lanes that this is true of */

    vray rays[DIRECT_PACKETS];
    vmask asked[DIRECT_PACKETS], blocked[DIRECT_PACKETS];
    vint spare[DIRECT_PACKETS], light[DIRECT_PACKETS];
    vfloat e[DIRECT_PACKETS];
    vpassed passed[DIRECT_PACKETS]; /* in a scene with hollow surfaces */
    int batched;
};

static inline int direct_layer(const direct_sensor *w, int l)
{
    return w->s->layered ? w->s->light_info[l].group : 0;
}

static inline bool direct_is_clear(const direct_sensor *w, int l)
{
    return w->ask.in_room && w->s->light_info[l].clear;
}

/* Fills in w->lamps, and what layers have of it. */
void direct_weigh(direct_sensor *w, const vsurface *at, vmask active);

/* Where lamp l takes no samples, and no shadow ray. */
vmask direct_is_known(const direct_sensor *w, int l);

/* One or all of the sums that a lamp's light belongs to. */
void direct_add(direct_sensor *w, sensor_sum *sums, int l, vfloat e, vfloat bound);

/* Traces the rays of the batch: what of the light passes is then known. */
void direct_trace(direct_sensor *w, ray_hint hint);

/* What arrives of e along the rays of packet k, toward the lamps in w->light; of lanes that have
 * not asked, all. */
vfloat direct_arrives(const direct_sensor *w, int k, vfloat e);

/* All lamps without extent that something may shadow: by rays of their own, or as the tail. `first`
 * is the number of the first sensor; sums hold what is known before. */
void direct_ask(direct_sensor *w, const vsurface *at, vmask active, uint32_t first,
                sensor_sum *sums);

#endif
