/* sim/map_split.c -- see map_tracer.h: particles that carry too much, divided.
 *
 * Light that comes from all around is drawn seldom beside what portals let in, and a particle of it
 * carries more. Most of these are aimed (map_portals.c) and then carry as little as others; what
 * lies so close before a window that much of its light comes in has particles divided first, so
 * that what comes in is alike.
 */
#include "sim/map_tracer.h"

/* Times what portals let in at once: what may come in by one after a reflection. */
static const float too_heavy = 2.0f;
enum { MOST_PARTS = 256 };

static map_copy copy_of(const map_tracer *t, int i)
{
    map_copy c = { t->image[i],    t->index[i],    t->group[i],    t->spare[i], t->state[i] | COPY,
                   t->instance[i], t->triangle[i], t->distance[i], t->u[i],     t->v[i] };
    for (int f = 0; f < FIELDS; f++)
        c.carried[f] = t->carried[f][i];
    return c;
}

static void split(map_tracer *t, int i, int parts)
{
    for (int f = FLUX; f <= FULL; f++)
        t->carried[f][i] /= (float)parts;
    map_copy c = copy_of(t, i);
    for (int n = 1; n < parts; n++) {
        c.index =
            (int32_t)hash_combine_u32((uint32_t)t->index[i], (uint32_t)n + t->depth * MOST_PARTS);
        map_copy *to = map_list_add(&t->copies);
        if (to)
            *to = c;
        t->out->lost |= !to;
    }
}

void map_split(map_tracer *t, int k, vmask active)
{
    vfloat flux  = vmax(load(t, FLUX, k), vmax(load(t, FLUX + 1, k), load(t, FLUX + 2, k)));
    vfloat share = map_portal_share(t->job->s, &t->at[k], &t->shading[k], active);
    vfloat heavy = vkeep(active, flux * share / (too_heavy * load(t, EVEN, k)));
    vmask copies = (vload_int(t->state + k * LANES) & COPY) != 0;
    for (int bits = vbits(active & ~copies & (heavy > 1.0f)); bits; bits &= bits - 1) {
        int j = __builtin_ctz((unsigned)bits);
        split(t, k * LANES + j, (int)fminf(ceilf(lane(heavy, j)), (float)MOST_PARTS));
    }
}

bool map_take_copies(map_tracer *t)
{
    map_list *from = &t->copies;
    for (t->alive = 0; t->alive < MAP_BATCH && from->count > 0; t->alive++) {
        const map_copy *c = (const map_copy *)from->items + --from->count;
        int i             = t->alive;
        t->image[i]       = c->image;
        t->index[i]       = c->index;
        t->group[i]       = c->group;
        t->spare[i]       = c->spare;
        t->state[i]       = c->state;
        t->instance[i]    = c->instance;
        t->triangle[i]    = c->triangle;
        t->distance[i]    = c->distance;
        t->u[i]           = c->u;
        t->v[i]           = c->v;
        for (int f = 0; f < FIELDS; f++)
            t->carried[f][i] = c->carried[f];
    }
    return t->alive > 0;
}
