/* sim/map_tracer.h -- what the files that follow particles share: map_trace.c, in whose batches
 * they are, map_arrive.c, where they come to, map_scatter.c, where they go on to, map_split.c.
 */
#ifndef SIM_MAP_TRACER_H
#define SIM_MAP_TRACER_H

#include "sim/map_aim.h"

enum { MAP_PACKETS = MAP_BATCH / LANES };

/* What a living particle carries; vectors are three fields. */
enum {
    PLACE   = 0,           /* m: where its ray begins */
    WAY     = PLACE + 3,   /* unit: the ray's direction */
    FLUX    = WAY + 3,     /* W */
    FULL    = FLUX + 3,    /* W: the largest channel of what it set out with */
    EVEN    = FULL + 1,    /* W: the same of those that portals let in */
    DIMMING = EVEN + 1,    /* of its source */
    AIMED   = DIMMING + 1, /* m: how far it is from where it is to turn first (map_aim.h) */
    FIELDS
};

/* And bits */
enum {
    SCATTERED = 1,  /* it has left a surface other than straight on, */
    SPREAD    = 2,  /* once in a direction drawn from many, */
    NO_IMAGE  = 4,  /* once other than a mirror image that paths ask for; */
    FROM_MATT = 8,  /* the last was such a one */
    LOST      = 16, /* within a plate of glass it was reflected: paths leave that out, too */
    COPY      = 32, /* where it stands, another has left the light */
    TO_TURN   = 64, /* it has not come to where it is aimed at */
};

/* A particle with what it has come to. */
typedef struct map_copy {
    int32_t image, index, group, spare, state, instance, triangle;
    float distance, u, v, carried[FIELDS];
} map_copy;

struct map_tracer {
    const map_job *job;
    uint32_t seed, depth;
    int alive;
    map_list *out;
    map_balance *balance;
    map_list copies; /* that wait */

    int32_t image[MAP_BATCH]; /* mirrors since it set out (mirrors.h); -1: it is no image */
    int32_t index[MAP_BATCH], group[MAP_BATCH], spare[MAP_BATCH], state[MAP_BATCH];
    int32_t aim_instance[MAP_BATCH], aim_triangle[MAP_BATCH], aim_cell[MAP_BATCH];
    float carried[FIELDS][MAP_BATCH];

    /* What they have met */
    int32_t instance[MAP_BATCH], triangle[MAP_BATCH];
    float distance[MAP_BATCH], u[MAP_BATCH], v[MAP_BATCH];

    /* Of one step, by packet */
    vray rays[MAP_PACKETS];
    vmask active[MAP_PACKETS];
    vhit hits[MAP_PACKETS];
    vsurface at[MAP_PACKETS];
    vshading shading[MAP_PACKETS];
};

static inline int packets_of(const map_tracer *t) { return (t->alive + LANES - 1) / LANES; }

static inline vmask living(const map_tracer *t, int k)
{
    return (vlane_index() + k * LANES) < t->alive;
}

static inline vfloat load(const map_tracer *t, int field, int k)
{
    return vload(t->carried[field] + k * LANES);
}

static inline vvec3 load3(const map_tracer *t, int field, int k)
{
    return (vvec3){ load(t, field, k), load(t, field + 1, k), load(t, field + 2, k) };
}

static inline void store3(map_tracer *t, int field, int k, vvec3 v)
{
    vstore(t->carried[field] + k * LANES, v.x);
    vstore(t->carried[field + 1] + k * LANES, v.y);
    vstore(t->carried[field + 2] + k * LANES, v.z);
}

static inline void add_up(double to[3], vmask lanes, vrgb flux)
{
    for (int bits = vbits(lanes); bits; bits &= bits - 1) {
        int i = __builtin_ctz((unsigned)bits);
        to[0] += (double)lane(flux.x, i);
        to[1] += (double)lane(flux.y, i);
        to[2] += (double)lane(flux.z, i);
    }
}

static inline vhit hit_of(const map_tracer *t, int k, vmask active)
{
    int i = k * LANES;
    return (vhit){ vload(t->distance + i), vkeep_int(active, vload_int(t->instance + i)),
                   vkeep_int(active, vload_int(t->triangle + i)), vload(t->u + i),
                   vload(t->v + i) };
}

/* |a . ns| / |a . ng| */
static inline vfloat tilt(const vshading *s, const vvec3 *a)
{
    return vabs(vdot(*a, s->n)) / vmax(vabs(vdot(*a, s->flat)), vsplat(1e-6f));
}

static inline bool is_matt(int32_t does)
{
    return (does & (DOES_ASK | DOES_NARROW | DOES_AROUND | DOES_HOLLOW)) == DOES_ASK;
}

/* Those of a scene with portals are aimed and split. */
static inline bool aims(const map_tracer *t)
{
    return t->job->s->portal_count > 0 && t->job->kind == MAP_INDIRECT;
}

static inline vmask matt_lanes(const map_tracer *t, int k, vmask active)
{
    vint does = vgather_int(t->job->s->material_does, vkeep_int(active, t->at[k].material));
    return active & ((does & (DOES_ASK | DOES_NARROW | DOES_AROUND | DOES_HOLLOW)) == DOES_ASK);
}

/* Keeps the particles of `goes` of packet k, behind those kept before. */
int map_keep(map_tracer *t, int k, vmask goes, int kept);

/* Light of the map's kind. */
vmask map_counts(const map_tracer *t, int k);

/* What packet k has come to, where it leaves its light; the living lanes. */
vmask map_arrive(map_tracer *t, int k);

/* Draws where they go on, or that they end; *next: as drawn. The lanes that go. */
vmask map_scatter(map_tracer *t, int k, vmask active, vscatter *next);

/* Divides those that would bring a room too much at once; the other parts wait, with COPY, until
 * map_take_copies() puts them where they stood, once no other is alive. */
void map_split(map_tracer *t, int k, vmask active);
bool map_take_copies(map_tracer *t);

#endif
