/* sim/map_trace.c -- see map_parts.h: particles, from their source to where they end.
 *
 * As in path.c the living ones stay packed at the front of the arrays, in their order: what comes
 * of a particle does not depend on those beside it.
 */
#include "sim/map_tracer.h"

#include <stdlib.h>

map_tracer *map_tracer_new(arena *a, lux_error *err)
{
    map_tracer *t = arena_new(a, map_tracer, err);
    if (t)
        t->copies.size = sizeof(map_copy);
    return t;
}

void map_tracer_free(map_tracer *t)
{
    if (t)
        map_list_free(&t->copies);
}

void *map_list_add(map_list *l)
{
    if (l->count == l->room) {
        size_t room = l->room ? 2 * l->room : 256;
        void *items = room <= SIZE_MAX / l->size ? realloc(l->items, room * l->size) : NULL;
        if (!items) {
            l->lost = true;
            return NULL;
        }
        l->items = items;
        l->room  = room;
    }
    return (char *)l->items + l->size * l->count++;
}

void map_list_free(map_list *l)
{
    free(l->items);
    l->items = NULL;
    l->count = l->room = 0;
}

int map_keep(map_tracer *t, int k, vmask goes, int kept)
{
    for (int bits = vbits(goes); bits; bits &= bits - 1, kept++) {
        int from       = k * LANES + __builtin_ctz((unsigned)bits);
        t->index[kept] = t->index[from];
        t->group[kept] = t->group[from];
        t->spare[kept] = t->spare[from];
        t->state[kept] = t->state[from];
        t->image[kept] = t->image[from];
        if (t->job->aim) {
            t->aim_instance[kept] = t->aim_instance[from];
            t->aim_triangle[kept] = t->aim_triangle[from];
            t->aim_cell[kept]     = t->aim_cell[from];
        }
        for (int f = 0; f < FIELDS; f++)
            t->carried[f][kept] = t->carried[f][from];
    }
    return kept;
}

/* ---- setting out ----------------------------------------------------------------------------- */

static float dimming_of(const scene *s, int source)
{
    if (source < 0)
        return 1.0f;
    return source < s->light_count ? s->light_info[source].dimming : s->glow_dimming;
}

static vfloat maintained(const scene *s, vint source, vmask drawn)
{
    float of[LANES];
    for (int i = 0; i < LANES; i++) {
        int l = vbits(drawn) >> i & 1 ? lane(source, i) : -1;
        of[i] = l < 0 ? 1.0f : (float)scene_maintenance(s, l);
    }
    return vload(of);
}

static void set_out(map_tracer *t, int k, const vparticle *p)
{
    int i = k * LANES;
    store3(t, PLACE, k, p->ray.origin);
    store3(t, WAY, k, p->ray.direction);
    store3(t, FLUX, k, p->flux);
    vfloat full = vmax(p->flux.x, vmax(p->flux.y, p->flux.z));
    vstore(t->carried[FULL] + i, full);
    vstore(t->carried[EVEN] + i, full * p->even);
    vstore_int(t->group + i, p->group);
    vstore_int(t->spare + i, p->spare);
    vstore_int(t->image + i, vselect_int(p->source < 0, vsplat_int(-1), vsplat_int(0)));
    vstore_int(t->state + i, vsplat_int(t->job->aim ? TO_TURN : 0));
}

/* Of light that comes from lamps and suns: what shines else, rays that meet glass find. */
static vmask draw_aimed(map_tracer *t, int k, vuint index, vmask active, vparticle *p)
{
    vaimed to;
    vmask drawn = map_aim_draw(t->job->aim, index, vsplat_uint(t->seed), active, p, &to);
    p->even     = vsplat(1.0f);
    vstore(t->carried[AIMED] + k * LANES, to.distance);
    vstore_int(t->aim_instance + k * LANES, to.instance);
    vstore_int(t->aim_triangle + k * LANES, to.triangle);
    vstore_int(t->aim_cell + k * LANES, to.cell);
    return drawn;
}

static void begin(map_tracer *t, uint32_t first, int count)
{
    int kept = 0;
    for (int k = 0; k * LANES < count; k++) {
        vuint index  = vunsigned(vlane_index() + k * LANES) + first;
        vmask active = (vlane_index() + k * LANES) < count;
        vparticle p;
        vmask drawn = t->job->aim
                          ? draw_aimed(t, k, index, active, &p)
                          : emission_draw(t->job->light, index, vsplat_uint(t->seed), active, &p);
        p.flux      = vscale(p.flux, maintained(t->job->s, p.source, drawn));
        vstore_int(t->index + k * LANES, vsigned(index));
        set_out(t, k, &p);
        for (int bits = vbits(drawn); bits; bits &= bits - 1) {
            int i                              = __builtin_ctz((unsigned)bits);
            t->carried[DIMMING][k * LANES + i] = dimming_of(t->job->s, lane(p.source, i));
        }
        add_up(t->balance->emitted, drawn, p.flux);
        kept = map_keep(t, k, drawn, kept);
    }
    t->alive = kept;
}

/* ---- on their way ---------------------------------------------------------------------------- */

static void watch(map_tracer *t, int k)
{
    vmask passes = t->active[k] & map_counts(t, k);
    if (!vany(passes))
        return;
    vray ray             = t->rays[k];
    ray.reach            = t->hits[k].distance;
    vrgb flux            = load3(t, FLUX, k);
    const int32_t *group = t->job->learns ? t->aim_cell : t->group;
    map_watch_pass(t->job->watch, &ray, passes, &flux, vload_int(group + k * LANES),
                   load(t, DIMMING, k), t->job->first_sensor_bin, t->out);
}

static void keep_hits(map_tracer *t, int k, vmask met, int kept)
{
    const vhit *hit = &t->hits[k];
    for (int bits = vbits(met); bits; bits &= bits - 1, kept++) {
        int i             = __builtin_ctz((unsigned)bits);
        t->instance[kept] = lane(hit->instance, i);
        t->triangle[kept] = lane(hit->triangle, i);
        t->distance[kept] = lane(hit->distance, i);
        t->u[kept]        = lane(hit->u, i);
        t->v[kept]        = lane(hit->v, i);
    }
}

/* Traces the rays, and moves the particles to what they meet. */
static void go_on(map_tracer *t)
{
    int n = packets_of(t), kept = 0;
    for (int k = 0; k < n; k++) {
        t->active[k] = living(t, k);
        t->rays[k]   = (vray){ load3(t, PLACE, k), load3(t, WAY, k), vsplat(INFINITY) };
    }
    t->balance->rays += t->alive;
    world_first_hit(t->job->s->world, t->rays, t->active, n, RAYS_INCOHERENT, t->hits);
    for (int k = 0; k < n; k++) {
        if (t->job->watch)
            watch(t, k);
        vmask met = t->active[k] & (t->hits[k].instance >= 0);
        add_up(t->balance->escaped, t->active[k] & ~met, load3(t, FLUX, k));
        keep_hits(t, k, met, kept);
        kept = map_keep(t, k, met, kept);
    }
    t->alive = kept;
}

static void draw_directions(map_tracer *t)
{
    int n = packets_of(t), kept = 0;
    for (int k = 0; k < n; k++) {
        vscatter next;
        vmask active = map_arrive(t, k);
        if (aims(t))
            map_split(t, k, active & matt_lanes(t, k, active));
        vmask goes = map_scatter(t, k, active, &next);
        kept       = map_keep(t, k, goes, kept);
    }
    t->alive = kept;
}

void map_trace(map_tracer *t, const map_job *job, uint32_t first, int count, uint32_t seed,
               map_list *out, map_balance *balance)
{
    t->job          = job;
    t->seed         = seed;
    t->out          = out;
    t->balance      = balance;
    t->depth        = 0;
    t->copies.count = 0;
    begin(t, first, count);
    do {
        while (t->alive > 0) {
            go_on(t);
            draw_directions(t);
            t->depth++;
        }
        if (map_take_copies(t))
            draw_directions(t);
        t->depth++;
    } while (t->alive > 0 || t->copies.count > 0);
}
