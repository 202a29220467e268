/* sim/map_trace.c -- see map_parts.h: particles, from their source to where they end.
 *
 * As in path.c the living ones stay packed at the front of the arrays, in their order: what comes
 * of a particle does not depend on those beside it. Materials are asked with the way back to where
 * the particle came from in the eye's place; that gives what they do to flux, as all of them treat
 * both ways alike, but for normals that are not the triangle's own. With ns such a normal, ng the
 * triangle's, a the way back and b the way on, flux is worth (Veach 1997, 5.3.2)
 *
 *     f(a, b) |b . ns| / pdf    times    |a . ns| |b . ng| / (|a . ng| |b . ns|)
 *
 * and where it is laid down |a . ns| / |a . ng| of it makes the irradiance about ns, by which
 * materials reflect.
 */
#include "sim/map_parts.h"

#include "core/color.h"
#include "sim/shading.h"

#include <stdlib.h>

/* As in path.c */
static const float surest_survival = 0.995f;
static const float wide_spread     = 0.03f; /* rad */

/* Times what portals let in at once: what may come in by one after a reflection. */
static const float too_heavy = 2.0f;
enum { MOST_PARTS = 256 };

enum { MAP_PACKETS = MAP_BATCH / LANES };

/* What a living particle carries; vectors are three fields. */
enum {
    PLACE   = 0,         /* m: where its ray begins */
    WAY     = PLACE + 3, /* unit: the ray's direction */
    FLUX    = WAY + 3,   /* W */
    FULL    = FLUX + 3,  /* W: the largest channel of what it set out with */
    EVEN    = FULL + 1,  /* W: the same of those that portals let in */
    DIMMING = EVEN + 1,  /* of its source */
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
};

/* One that stands where light comes to, and goes on apart from the one that it was copied from. */
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

static int packets_of(const map_tracer *t) { return (t->alive + LANES - 1) / LANES; }

static vmask living(const map_tracer *t, int k) { return (vlane_index() + k * LANES) < t->alive; }

static vfloat load(const map_tracer *t, int field, int k)
{
    return vload(t->carried[field] + k * LANES);
}

static vvec3 load3(const map_tracer *t, int field, int k)
{
    return (vvec3){ load(t, field, k), load(t, field + 1, k), load(t, field + 2, k) };
}

static void store3(map_tracer *t, int field, int k, vvec3 v)
{
    vstore(t->carried[field] + k * LANES, v.x);
    vstore(t->carried[field + 1] + k * LANES, v.y);
    vstore(t->carried[field + 2] + k * LANES, v.z);
}

static int keep(map_tracer *t, int k, vmask goes, int kept)
{
    for (int bits = vbits(goes); bits; bits &= bits - 1, kept++) {
        int from       = k * LANES + __builtin_ctz((unsigned)bits);
        t->index[kept] = t->index[from];
        t->group[kept] = t->group[from];
        t->spare[kept] = t->spare[from];
        t->state[kept] = t->state[from];
        t->image[kept] = t->image[from];
        for (int f = 0; f < FIELDS; f++)
            t->carried[f][kept] = t->carried[f][from];
    }
    return kept;
}

static void add_up(double to[3], vmask lanes, vrgb flux)
{
    for (int bits = vbits(lanes); bits; bits &= bits - 1) {
        int i = __builtin_ctz((unsigned)bits);
        to[0] += (double)lane(flux.x, i);
        to[1] += (double)lane(flux.y, i);
        to[2] += (double)lane(flux.z, i);
    }
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
    vstore_int(t->state + i, vsplat_int(0));
}

static void begin(map_tracer *t, uint32_t first, int count)
{
    int kept = 0;
    for (int k = 0; k * LANES < count; k++) {
        vuint index  = vunsigned(vlane_index() + k * LANES) + first;
        vmask active = (vlane_index() + k * LANES) < count;
        vparticle p;
        vmask drawn = emission_draw(t->job->light, index, vsplat_uint(t->seed), active, &p);
        if (t->job->kind == MAP_FOCUSED) /* what shines else, rays that meet glass find */
            drawn = drawn & (p.source >= 0) & (p.source < t->job->s->light_count);
        p.flux = vscale(p.flux, maintained(t->job->s, p.source, drawn));
        vstore_int(t->index + k * LANES, vsigned(index));
        set_out(t, k, &p);
        for (int bits = vbits(drawn); bits; bits &= bits - 1) {
            int i                              = __builtin_ctz((unsigned)bits);
            t->carried[DIMMING][k * LANES + i] = dimming_of(t->job->s, lane(p.source, i));
        }
        add_up(t->balance->emitted, drawn, p.flux);
        kept = keep(t, k, drawn, kept);
    }
    t->alive = kept;
}

/* ---- on their way ---------------------------------------------------------------------------- */

static vhit hit_of(const map_tracer *t, int k, vmask active)
{
    int i = k * LANES;
    return (vhit){ vload(t->distance + i), vkeep_int(active, vload_int(t->instance + i)),
                   vkeep_int(active, vload_int(t->triangle + i)), vload(t->u + i),
                   vload(t->v + i) };
}

/* Whether a deflection is one that paths ask for by mirror images (mirrors.h); -1 in image from
 * where it is not on. Light of skies is not asked for so. */
static vmask follow_images(map_tracer *t, int k, vmask single, vmask wide)
{
    const mirrors *m = t->job->s->mirror_images;
    if (!m)
        return (vmask){ 0 };
    vint image = vload_int(t->image + k * LANES);
    vhit hit   = hit_of(t, k, single);
    vint next  = mirrors_precede(m, image, &hit, single);
    image      = vselect_int(single, next, vselect_int(wide, vsplat_int(-1), image));
    vstore_int(t->image + k * LANES, image);
    return single & (next > 0);
}

/* Light of the map's kind. */
static vmask counts(const map_tracer *t, int k)
{
    vint state = vload_int(t->state + k * LANES);
    vmask some = ((state & NO_IMAGE) != 0) & ((state & LOST) == 0);
    return t->job->kind == MAP_INDIRECT ? some : some & ((state & SPREAD) == 0);
}

static void watch(map_tracer *t, int k)
{
    vmask passes = t->active[k] & counts(t, k);
    if (!vany(passes))
        return;
    vray ray  = t->rays[k];
    ray.reach = t->hits[k].distance;
    vrgb flux = load3(t, FLUX, k);
    map_watch_pass(t->job->watch, &ray, passes, &flux, vload_int(t->group + k * LANES),
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
        kept = keep(t, k, met, kept);
    }
    t->alive = kept;
}

/* ---- where they come to ---------------------------------------------------------------------- */

static bool is_matt(int32_t does)
{
    return (does & (DOES_ASK | DOES_NARROW | DOES_AROUND | DOES_HOLLOW)) == DOES_ASK;
}

/* |a . ns| / |a . ng| */
static vfloat tilt(const vshading *s, const vvec3 *a)
{
    return vabs(vdot(*a, s->n)) / vmax(vabs(vdot(*a, s->flat)), vsplat(1e-6f));
}

static void note_way(map_tracer *t, int i)
{
    if (!(t->state[i] & FROM_MATT))
        return;
    double d = (double)t->distance[i];
    t->balance->way2 += d * d;
    t->balance->ways++;
}

static void lay_down(map_tracer *t, int i, int32_t front, vec3 flux)
{
    const map_job *job = t->job;
    map_mark mark      = { .instance = t->instance[i],
                           .triangle = t->triangle[i],
                           .front    = front,
                           .u        = t->u[i],
                           .v        = t->v[i],
                           .weight   = rgb_luminance(flux) };
    if (!job->cells) {
        map_mark *to = map_list_add(t->out);
        if (to)
            *to = mark;
        note_way(t, i);
        return;
    }
    int32_t bin = map_cells_find(job->cells, world_mesh(job->s->world, mark.instance), &mark);
    if (bin < 0) {
        const float missed[3] = { flux.x, flux.y, flux.z };
        for (int c = 0; c < 3; c++)
            t->balance->unplaced[c] += (double)missed[c];
        return;
    }
    map_deposit *to = map_list_add(t->out);
    if (to)
        *to = (map_deposit){ bin, t->group[i], t->carried[DIMMING][i], flux };
}

/* The lanes that go on from where they are. */
static vmask arrive(map_tracer *t, int k)
{
    const scene *s = t->job->s;
    vmask active   = living(t, k);
    vhit hit       = hit_of(t, k, active);
    vvec3 way      = load3(t, WAY, k);
    scene_shade(s, &hit, &way, wide_spread * hit.distance, active, &t->at[k], &t->shading[k]);

    vint does = vgather_int(s->material_does, vkeep_int(active, t->at[k].material));
    vfloat turned =
        s->smooth || s->textured ? tilt(&t->shading[k], &t->shading[k].wo) : vsplat(1.0f);
    vrgb flux    = vscale(load3(t, FLUX, k), turned);
    vmask copies = (vload_int(t->state + k * LANES) & COPY) != 0;
    for (int bits = vbits(active & counts(t, k) & ~copies); bits; bits &= bits - 1) {
        int j = __builtin_ctz((unsigned)bits), i = k * LANES + j;
        if (is_matt(lane(does, j)))
            lay_down(t, i, vbits(t->shading[k].front) >> j & 1,
                     (vec3){ lane(flux.x, j), lane(flux.y, j), lane(flux.z, j) });
    }
    return active;
}

/* The lamp's own body, which does not see its light. */
static bool is_spared(const map_tracer *t, int i)
{
    return t->spare[i] && !(t->state[i] & SCATTERED) &&
           world_owner(t->job->s->world, t->instance[i]) == t->spare[i];
}

/* Straight on through the body of their own lamp. */
static vmask spared(const map_tracer *t, int k, vmask active)
{
    int32_t is[LANES] = { 0 };
    for (int bits = vbits(active); bits; bits &= bits - 1) {
        int j = __builtin_ctz((unsigned)bits);
        is[j] = is_spared(t, k * LANES + j);
    }
    return vload_int(is) != 0;
}

static vmask on_one_side(const vshading *s, const vvec3 *wi)
{
    return (vdot(*wi, s->n) > 0.0f) == (vdot(*wi, s->flat) > 0.0f);
}

/* What normals that are not the triangle's own make of flux. */
static vfloat adjoint(const vshading *s, const vvec3 *wi)
{
    return tilt(s, &s->wo) * vabs(vdot(*wi, s->flat)) / vmax(vabs(vdot(*wi, s->n)), vsplat(1e-6f));
}

static void note_scattered(map_tracer *t, int k, vmask active, const vscatter *next)
{
    vint does    = vgather_int(t->job->s->material_does, vkeep_int(active, t->at[k].material));
    vint before  = vload_int(t->state + k * LANES) & ~COPY;
    vmask single = next->pdf == INFINITY;
    vmask plate  = ((does & DOES_SOLID) != 0) & ((does & DOES_LENS) == 0);
    vmask inner  = single & plate & ~next->bent & ~t->shading[k].front;
    vmask on     = next->straight | (single & plate & next->bent); /* as shadow rays pass it */
    vmask image  = follow_images(t, k, single & ~on & ~inner & ~next->bent,
                                 ~on & (~single | next->bent | inner));
    vint bits =
        vselect_int(single, vsplat_int(SCATTERED), vsplat_int(SCATTERED | SPREAD | FROM_MATT));
    bits       = vselect_int(image, bits, bits | NO_IMAGE);
    bits       = vselect_int(inner, bits | LOST, bits);
    vint kept  = vselect_int(single, before, before & ~LOST);
    vint after = (kept & ~FROM_MATT) | bits;
    vstore_int(t->state + k * LANES, vselect_int(on, before, after));
}

static bool aims(const map_tracer *t)
{
    return t->job->s->portal_count > 0 && t->job->kind == MAP_INDIRECT;
}

static vmask matt_lanes(const map_tracer *t, int k, vmask active)
{
    vint does = vgather_int(t->job->s->material_does, vkeep_int(active, t->at[k].material));
    return active & ((does & (DOES_ASK | DOES_NARROW | DOES_AROUND | DOES_HOLLOW)) == DOES_ASK);
}

/* From matt surfaces before portals. What carries less as it was aimed does not end by that. */
static vmask aim(map_tracer *t, int k, vmask active, vmask goes, vscatter *next)
{
    const scene *s = t->job->s;
    uint32_t seed  = hash_combine_u32(hash_combine_u32(t->seed, 0xa13d), t->depth);
    vsample4 u     = vsobol4(vunsigned(vload_int(t->index + k * LANES)), vsplat_uint(seed));
    vfloat rarer;
    goes = map_aim(s, &t->at[k], &t->shading[k], &u, matt_lanes(t, k, active), goes, next, &rarer);
    vstore(t->carried[FULL] + k * LANES, load(t, FULL, k) * rarer);
    return goes;
}

/* Draws where particles go on, or that they end. */
static vmask next_direction(map_tracer *t, int k, vmask active, vscatter *next)
{
    const scene *s    = t->job->s;
    vuint index       = vunsigned(vload_int(t->index + k * LANES));
    uint32_t seed     = hash_combine_u32(hash_combine_u32(t->seed, 0xb0ce), t->depth);
    vsample4 u        = vsobol4(index, vsplat_uint(seed));
    const vshading *h = &t->shading[k];
    vmask goes = materials_scatter(s->materials, t->at[k].material, h, u.x, u.y, u.z, active, next);
    if (aims(t))
        goes = aim(t, k, active, goes, next);
    if (s->smooth || s->textured) {
        vmask turned = goes & ~next->straight;
        goes         = goes & (next->straight | on_one_side(h, &next->wi));
        next->weight = vselect3(turned, vscale(next->weight, adjoint(h, &next->wi)), next->weight);
    }
    if (s->owners) {
        vmask through  = spared(t, k, active);
        next->wi       = vselect3(through, load3(t, WAY, k), next->wi);
        next->weight   = vselect3(through, vspread((vec3){ 1, 1, 1 }), next->weight);
        next->straight = next->straight | through;
        goes           = goes | through;
    }
    if (t->job->kind == MAP_FOCUSED)
        goes = goes & (next->straight | (next->pdf == INFINITY));

    /* Roulette: it goes on as often as it is worth going. Straight on it ends by itself. */
    vrgb flux       = vmul(load3(t, FLUX, k), next->weight);
    vfloat most     = vmax(flux.x, vmax(flux.y, flux.z)) / load(t, FULL, k);
    vfloat surest   = vselect(next->straight, vsplat(1.0f), vsplat(surest_survival));
    vfloat survival = vmin(most, surest);
    goes            = goes & (most > 0.0f) & (u.w < survival);
    vrgb before     = load3(t, FLUX, k);
    vrgb after      = vkeep3(goes, vscale(flux, 1.0f / survival));
    add_up(t->balance->absorbed, active, vsub(before, after));
    store3(t, FLUX, k, after);
    return goes;
}

/* ---- splitting ------------------------------------------------------------------------------- */

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

/* Particles that would bring a room too much at once. */
static void split_heavy(map_tracer *t, int k, vmask active)
{
    vfloat flux  = vmax(load(t, FLUX, k), vmax(load(t, FLUX + 1, k), load(t, FLUX + 2, k)));
    vfloat share = map_aim_share(t->job->s, &t->at[k], &t->shading[k], active);
    vfloat heavy = vkeep(active, flux * share / (too_heavy * load(t, EVEN, k)));
    vmask copies = (vload_int(t->state + k * LANES) & COPY) != 0;
    for (int bits = vbits(active & ~copies & (heavy > 1.0f)); bits; bits &= bits - 1) {
        int j = __builtin_ctz((unsigned)bits);
        split(t, k * LANES + j, (int)fminf(ceilf(lane(heavy, j)), (float)MOST_PARTS));
    }
}

/* Copies take the place of those that have all come to their end. */
static void take_copies(map_tracer *t)
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
}

static void draw_directions(map_tracer *t)
{
    int n = packets_of(t), kept = 0;
    for (int k = 0; k < n; k++) {
        vscatter next;
        vmask active = arrive(t, k);
        if (aims(t))
            split_heavy(t, k, active & matt_lanes(t, k, active));
        vmask goes = next_direction(t, k, active, &next);
        note_scattered(t, k, active, &next);
        store3(t, PLACE, k, vray_start(&t->at[k], &next.wi));
        store3(t, WAY, k, next.wi);
        kept = keep(t, k, goes, kept);
    }
    t->alive = kept;
}

void map_trace(map_tracer *t, const map_job *job, uint32_t first, int count, uint32_t seed,
               map_list *out, map_balance *balance)
{
    t->job     = job;
    t->seed    = seed;
    t->out     = out;
    t->balance = balance;
    begin(t, first, count);
    for (t->depth = 0; t->alive > 0; t->depth++) {
        go_on(t);
        draw_directions(t);
        if (t->alive == 0 && t->copies.count > 0) {
            take_copies(t);
            t->depth++;
            draw_directions(t);
        }
    }
}
