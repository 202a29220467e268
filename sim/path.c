/* sim/path.c -- see path.h. The living paths stay packed at the front of the arrays. */
#include "sim/path.h"

#include "core/color.h"
#include "core/sampler.h"
#include "sim/direct.h"
#include "sim/seen_lamps.h"
#include "sim/sensor.h"
#include "sim/shading.h"

#include <string.h>

enum { PACKETS = PATHS / LANES };

enum { ASKED_LAMPS = 16 }; /* that are all asked where a path begins, if one would not do */

/* Survival is never certain, so that a path ends even in a room that absorbs nothing. */
static const float surest_survival = 0.995f;

/* rad: the beam that a ray stands for which was drawn from all around. Of a thousand such, each
 * has a thousandth of the hemisphere. */
static const float wide_spread = 0.03f;

/* What a living path carries; vectors are three fields. Those that a scene does not need come last
 * and are left out. */
enum {
    PLACE        = 0,            /* m: where its ray begins */
    WAY          = PLACE + 3,    /* unit: the ray's direction */
    WORTH        = WAY + 3,      /* by channel, 1 at the beginning */
    PLAIN_FIELDS = WORTH + 3,    /* the next where rays find light: */
    LEFT         = PLAIN_FIELDS, /* m: where the path was last, straight passages apart */
    SIDE         = LEFT + 3,     /* the normal there */
    PDF = SIDE + 3, /* 1/sr, with which it left in its direction: what it then finds that glows
                       has been asked for too. INFINITY: it has not; ALREADY: by that alone */
    LAMP_PDF,       /* the same, of lamps */
    WIDTH,          /* m, of the beam; the next where there are textures */
    SPREAD,         /* rad, of the beam */
    FIELDS
};
#define ALREADY (-1.0f)

/* Of a living path, bits. */
enum {
    SCATTERED = 1, /* it has left its beginning other than straight on */
    AROUND    = 2, /* where it was last, light from below the horizon counts */
};

typedef struct path_tracer {
    const scene *s;
    const path_options *o;
    direct_scratch *direct;
    seen_lamps shown; /* that rays may find */
    int64_t ray_count;
    path_bundle *b;
    int alive, fields;  /* of those below that are carried */
    float first[PATHS]; /* sr: response / pdf of each path's first direction; from the eye 1 */

    /* Of each living path: whose it is, bits, what it carries */
    int32_t id[PATHS], state[PATHS];
    float carried[FIELDS][PATHS];

    /* And what it has met */
    int32_t instance[PATHS], triangle[PATHS];
    float distance[PATHS], u[PATHS], v[PATHS];

    /* Of one step, by packet: where the paths stand */
    vsurface at[PACKETS];
    vshading shading[PACKETS];
    vmask active[PACKETS], asks[PACKETS], around[PACKETS];
    vint does[PACKETS];
    vsample4 sample[PACKETS], light_sample[PACKETS];
    direct_pick lights[PACKETS];
    vray rays[PACKETS];
    vhit hits[PACKETS];
} path_tracer;

/* Whether the paths' own rays find light. */
static bool finds_light(const scene *s) { return s->glows || s->narrow || s->hollow; }

path_tracer *path_tracer_new(arena *a, const scene *s, lux_error *err)
{
    path_tracer *t = arena_new(a, path_tracer, err);
    if (!t)
        return NULL;
    t->s      = s;
    t->fields = s->textured ? FIELDS : finds_light(s) ? WIDTH : PLAIN_FIELDS;
    t->direct = direct_scratch_new(a, err);
    t->shown  = lamps_that_show(a, s, err);
    return t->direct && t->shown.lamps ? t : NULL;
}

int64_t path_rays(const path_tracer *t) { return t->ray_count + direct_rays(t->direct); }

static int packets_of(const path_tracer *t) { return (t->alive + LANES - 1) / LANES; }

static vmask living(const path_tracer *t, int k) { return (vlane_index() + k * LANES) < t->alive; }

static vfloat load(const path_tracer *t, int field, int k)
{
    return vload(t->carried[field] + k * LANES);
}

static void store(path_tracer *t, int field, int k, vfloat v)
{
    vstore(t->carried[field] + k * LANES, v);
}

static vvec3 load3(const path_tracer *t, int field, int k)
{
    return (vvec3){ load(t, field, k), load(t, field + 1, k), load(t, field + 2, k) };
}

static void store3(path_tracer *t, int field, int k, vvec3 v)
{
    store(t, field, k, v.x);
    store(t, field + 1, k, v.y);
    store(t, field + 2, k, v.z);
}

static vmask state_has(const path_tracer *t, int k, int bit)
{
    return (vload_int(t->state + k * LANES) & bit) != 0;
}

/* Keeps the paths of `goes` of packet k, behind those kept before; they move down in place. */
static int keep(path_tracer *t, int k, vmask goes, int kept)
{
    for (int bits = vbits(goes); bits; bits &= bits - 1, kept++) {
        int from       = k * LANES + __builtin_ctz((unsigned)bits);
        t->id[kept]    = t->id[from];
        t->state[kept] = t->state[from];
        for (int f = 0; f < t->fields; f++)
            t->carried[f][kept] = t->carried[f][from];
    }
    return kept;
}

/* ---- what is found --------------------------------------------------------------------------- */

/* Adds what each path of packet k found, e, of light number `which` (-1: of none); it came straight
 * to those that `straight` says. */
static void add(path_tracer *t, vmask straight, int k, vrgb e, vint which)
{
    const scene *s = t->s;
    float of[3][LANES];
    vstore(of[0], e.x);
    vstore(of[1], e.y);
    vstore(of[2], e.z);
    for (int i = 0; i < LANES && k * LANES + i < t->alive; i++) {
        int id = t->id[k * LANES + i], l = lane(which, i);
        if (l < 0)
            continue;
        bool is_straight = vbits(straight) >> i & 1;
        path_sums *sums  = is_straight ? &t->b->direct : &t->b->indirect;
        bool lamp        = l < s->light_count;
        float dimming    = lamp ? s->light_info[l].dimming : s->glow_dimming;
        int group        = lamp ? s->light_info[l].group : s->glow_group;
        for (int c = 0; c < 3; c++) {
            (*sums)[c][id] += dimming * of[c][i];
            if (!t->b->layers)
                continue;
            t->b->layers[group][c][id] += of[c][i];
            if (is_straight)
                t->b->layers[s->group_count + group][c][id] += of[c][i];
        }
    }
}

static vfloat first_of(const path_tracer *t, int k)
{
    return vgather(t->first, vload_int(t->id + k * LANES));
}

/* p_a^2 / (p_a^2 + p_b^2), and 1 where there is no other way, b = 0, even to a direction that is as
 * good as never drawn. */
static vfloat power_heuristic(vfloat a, vfloat b)
{
    vfloat ratio = b / a;
    return vselect(b > 0.0f, 1.0f / (1.0f + ratio * ratio), vsplat(1.0f));
}

/* Light that was asked for where paths begin. */
static void add_first_lights(path_tracer *t, int k)
{
    const direct_pick *l = &t->lights[k];
    const vvec3 *n       = &t->at[k].normal;
    vmask glows          = t->active[k] & (l->light >= t->s->light_count);
    vfloat response      = vsensor_response(t->o->quantity, n, &l->wi);
    if (vany(glows)) {
        vfloat pdf = vsensor_pdf(t->o->quantity, n, &l->wi);
        response   = response * vselect(glows, power_heuristic(l->pdf, pdf), vsplat(1.0f));
    }
    add(t, ALL_LANES, k, vkeep3(t->active[k], vscale(l->e, response)), l->light);
}

/* Where surfaces have normals other than their own: not what would pass through an opaque one. */
static vmask on_one_side(const vshading *s, const vvec3 *wi)
{
    return (vdot(*wi, s->n) > 0.0f) == (vdot(*wi, s->flat) > 0.0f);
}

/* And later: what of it the surface gives on, and how much it counts where rays find it too. */
static void add_lights(path_tracer *t, int k)
{
    const scene *s       = t->s;
    const direct_pick *l = &t->lights[k];
    vmask found          = t->asks[k] & (l->light >= s->light_count);
    if (s->narrow)
        found = found | (t->asks[k] & ((t->does[k] & DOES_NARROW) != 0));
    bool both = vany(found);
    vfloat pdf;
    vrgb f = materials_reflect(s->materials, t->at[k].material, &t->shading[k], &l->wi, t->asks[k],
                               both ? &pdf : NULL);
    vrgb all = vscale(vmul(load3(t, WORTH, k), vmul(f, l->e)), first_of(t, k));
    if (s->smooth || s->textured)
        all = vkeep3(on_one_side(&t->shading[k], &l->wi), all);
    if (both)
        all = vscale(all, vselect(found, power_heuristic(l->pdf, pdf), vsplat(1.0f)));
    add(t, (vmask){ 0 }, k, vkeep3(t->asks[k], all), l->light);
}

/* One that is drawn by its luminance would do, but for colour and for groups: a mixture's luminance
 * can be sure while its colour, or a group's share, is not. */
static bool asks_all_lamps(const path_tracer *t)
{
    const scene *s = t->s;
    return s->emitter_count == 0 && s->light_count <= ASKED_LAMPS &&
           (s->lights_differ || t->b->layers);
}

/* Next-event estimation where the paths stand. */
static void ask_lights(path_tracer *t, bool beginning)
{
    const scene *s = t->s;
    bool lamps     = (!beginning || t->o->lamps) && s->light_count > 0;
    bool all       = beginning && lamps && asks_all_lamps(t);
    if (!lamps && s->emitter_count == 0)
        return;
    for (int first = 0; first < packets_of(t); first += DIRECT_PACKETS) {
        int n          = packets_of(t) - first;
        direct_batch b = { .at         = t->at + first,
                           .active     = t->asks + first,
                           .u          = t->light_sample + first,
                           .packets    = n < DIRECT_PACKETS ? n : DIRECT_PACKETS,
                           .glow_alone = !lamps,
                           .all_around = beginning && quantity_is_round(t->o->quantity),
                           .around     = !beginning && s->narrow ? t->around + first : NULL };
        for (int l = 0; l < (all ? s->light_count : 1); l++) {
            if (all)
                direct_lamp(s, t->direct, l, &b, t->lights + first);
            else
                direct_one(s, t->direct, &b, t->lights + first);
            for (int k = first; k < first + b.packets; k++)
                beginning ? add_first_lights(t, k) : add_lights(t, k);
        }
    }
}

/* Where the paths of packet k were last, as who asks lights there knows it. */
static vsurface place_before(const path_tracer *t, int k)
{
    return (vsurface){ .position = load3(t, LEFT, k), .normal = load3(t, SIDE, k) };
}

/* The emitters that what the paths of packet k met is, -1 for none. */
static vint emitters_met(const path_tracer *t, int k, vmask active)
{
    const scene *s = t->s;
    int32_t of[LANES];
    for (int i = 0; i < LANES; i++) {
        of[i] = -1;
        if (!(vbits(active) >> i & 1) || !s->first_emitter)
            continue;
        int64_t first = s->first_emitter[t->instance[k * LANES + i]];
        if (first >= 0)
            of[i] = s->emitter_of[first + t->triangle[k * LANES + i]];
    }
    return vload_int(of);
}

/* The density with which lights were asked for what packet k has met, at those that still are at
 * their beginning and at the others. */
static vfloat glow_pdf(const path_tracer *t, int k, vmask bright)
{
    const scene *s  = t->s;
    vsurface before = place_before(t, k);
    vvec3 wi        = load3(t, WAY, k);
    vint emitter    = emitters_met(t, k, bright);
    vmask later     = bright & state_has(t, k, SCATTERED);
    vmask first     = bright & ~later;
    vmask round     = quantity_is_round(t->o->quantity) ? first : (vmask){ 0 };
    bool no_lamps   = s->light_count == 0;
    vfloat pdf      = { 0 };
    if (vany(first))
        pdf = direct_glow_pdf(s, &before, &wi, emitter, no_lamps || !t->o->lamps, round, first);
    if (vany(later))
        pdf = pdf + direct_glow_pdf(s, &before, &wi, emitter, no_lamps,
                                    later & state_has(t, k, AROUND), later);
    return pdf;
}

/* What shines by itself where the paths have come to. */
static void add_glow(path_tracer *t)
{
    const scene *s = t->s;
    if (!s->glows)
        return;
    for (int k = 0; k < packets_of(t); k++) {
        vfloat pdf   = load(t, PDF, k);
        vmask active = t->active[k] & (pdf >= 0.0f);
        vrgb glow    = materials_emission(s->materials, t->at[k].material, &t->shading[k], active);
        vmask bright = active & ((glow.x > 0.0f) | (glow.y > 0.0f) | (glow.z > 0.0f));
        if (!vany(bright))
            continue;
        vmask asked  = bright & (pdf < INFINITY);
        vfloat other = vany(asked) ? glow_pdf(t, k, asked) : (vfloat){ 0 };
        vfloat share = power_heuristic(pdf, vkeep(asked, other)) * first_of(t, k);
        vrgb all     = vscale(vmul(load3(t, WORTH, k), glow), share);
        add(t, ~state_has(t, k, SCATTERED), k, vkeep3(bright, all), vsplat_int(s->light_count));
    }
}

/* Lamp l, where the rays of packet k meet it before what they met. */
static void add_lamp_met(path_tracer *t, int k, int l, vmask looking)
{
    const scene *s    = t->s;
    const light *lamp = s->lights[l];
    vlight_hit hit;
    vvec3 wi   = t->rays[k].direction;
    vmask seen = lamp->type->hit(lamp, &t->rays[k].origin, &wi, looking, &hit);
    seen       = seen & (hit.dist < t->hits[k].distance);
    if (!vany(seen))
        return;
    vfloat pdf   = load(t, LAMP_PDF, k);
    vfloat share = first_of(t, k);
    vmask asked  = seen & (pdf < INFINITY);
    if (vany(asked)) {
        vsurface before = place_before(t, k);
        vfloat other    = direct_lamp_pdf(s, &before, &wi, l, state_has(t, k, AROUND), asked);
        share           = share * power_heuristic(pdf, vkeep(asked, other));
    }
    vrgb all = vscale(vmul(load3(t, WORTH, k), hit.radiance), share);
    add(t, ~state_has(t, k, SCATTERED), k, vkeep3(seen, all), vsplat_int(l));
}

/* Lamps that the rays meet on their way. */
static void add_lamps_met(path_tracer *t)
{
    for (int k = 0; k < packets_of(t); k++) {
        vmask looking = t->active[k] & (load(t, LAMP_PDF, k) >= 0.0f);
        for (int i = 0; vany(looking) && i < t->shown.count; i++)
            add_lamp_met(t, k, t->shown.lamps[i], looking);
    }
}

/* Which paths see something that could give light on. */
static void note_what_is_met(path_tracer *t)
{
    for (int k = 0; k < packets_of(t); k++) {
        vint which  = t->at[k].material;
        vfloat back = vrgb_luminance(materials_reflectance(t->s->materials, which, t->active[k]));
        vmask gives = t->active[k] & (back > 0.0f);
        if (t->s->narrow || t->s->hollow)
            gives = t->active[k];
        for (int bits = vbits(gives); bits; bits &= bits - 1)
            t->b->met[t->id[k * LANES + __builtin_ctz((unsigned)bits)]] = 1.0f;
    }
}

/* ---- a step of all living paths -------------------------------------------------------------- */

/* Random numbers of a place. Lights have numbers of their own only where they need them. */
static void draw_numbers(path_tracer *t, uint32_t depth)
{
    bool own = t->s->extended || t->s->emitter_count > 0 || t->s->narrow;
    for (int k = 0; k < packets_of(t); k++) {
        vint id            = vload_int(t->id + k * LANES);
        vuint index        = vunsigned(vgather_int((const int32_t *)t->b->index, id));
        vuint seed         = vunsigned(vgather_int((const int32_t *)t->b->seed, id));
        vuint of_bounce    = vhash_combine(seed, vunsigned(vsplat_int((int)depth)));
        vuint of_light     = vhash_combine(seed, vunsigned(vsplat_int(~(int)depth)));
        t->sample[k]       = vsobol4(index, of_bounce);
        t->light_sample[k] = own ? vsobol4(index, of_light) : t->sample[k];
    }
}

/* Draws where a path begins to go; what its direction is worth is kept by its number. */
static vvec3 begin_direction(path_tracer *t, int k)
{
    const vsample4 *u = &t->sample[k];
    float worth[LANES];
    vfloat first, pdf;
    vvec3 wi = vsensor_direction(t->o->quantity, &t->at[k].normal, u->x, u->y, &pdf, &first);
    vstore(worth, first);
    for (int i = 0; i < LANES && k * LANES + i < t->alive; i++)
        t->first[t->id[k * LANES + i]] = worth[i];
    if (t->fields > PLAIN_FIELDS) {
        store(t, PDF, k, pdf);
        store(t, LAMP_PDF, k, vsplat(ALREADY)); /* all lamps are asked there */
    }
    return wi;
}

static void draw_first_directions(path_tracer *t)
{
    for (int k = 0; k < packets_of(t); k++) {
        vvec3 wi = begin_direction(t, k);
        if (t->fields > PLAIN_FIELDS) {
            store3(t, LEFT, k, t->at[k].position);
            store3(t, SIDE, k, t->at[k].normal);
        }
        store3(t, PLACE, k, vray_start(&t->at[k], &wi));
        store3(t, WAY, k, wi);
    }
}

/* What lights that were asked where the path was mean for what it finds next. A single direction
 * that was refracted is one that shadow rays have followed straight on. */
static void leave(path_tracer *t, int k, const vscatter *next)
{
    vmask left   = ~next->straight;
    vmask single = next->pdf == INFINITY;
    vmask narrow = (t->does[k] & DOES_NARROW) != 0;
    vfloat pdf = load(t, PDF, k), lamp = load(t, LAMP_PDF, k);
    vfloat sole = vsplat(INFINITY), already = vsplat(ALREADY);
    vfloat of_pdf =
        vselect(single, vselect(next->bent & (pdf < INFINITY), already, sole), next->pdf);
    vfloat of_lamp = vselect(single, vselect(next->bent & (lamp < INFINITY), already, sole),
                             vselect(narrow, next->pdf, already));
    store(t, PDF, k, vselect(left, of_pdf, pdf));
    store(t, LAMP_PDF, k, vselect(left, of_lamp, lamp));
    store3(t, LEFT, k, vselect3(left, t->at[k].position, load3(t, LEFT, k)));
    store3(t, SIDE, k, vselect3(left, t->at[k].normal, load3(t, SIDE, k)));
}

static void note_scattered(path_tracer *t, int k, const vscatter *next)
{
    vint before = vload_int(t->state + k * LANES);
    vint around = vselect_int(t->around[k], vsplat_int(AROUND), vsplat_int(0));
    vstore_int(t->state + k * LANES, vselect_int(next->straight, before, around | SCATTERED));
    if (t->fields < FIELDS)
        return;
    vmask wide    = ~next->straight & (next->pdf < INFINITY);
    vfloat spread = load(t, SPREAD, k);
    store(t, SPREAD, k, vselect(wide, vmax(spread, vsplat(wide_spread)), spread));
}

/* Draws where a path goes on, or that it ends. */
static vmask next_direction(path_tracer *t, int k, vscatter *next)
{
    const scene *s    = t->s;
    const vsample4 *u = &t->sample[k];
    vmask goes = materials_scatter(s->materials, t->at[k].material, &t->shading[k], u->x, u->y,
                                   u->z, t->active[k], next);
    if (s->smooth || s->textured)
        goes = goes & (next->straight | on_one_side(&t->shading[k], &next->wi));
    if (!t->o->bounce)
        goes = goes & next->straight;
    vrgb worth = vmul(load3(t, WORTH, k), next->weight);

    /* Roulette: a path goes on as often as it is worth going */
    vfloat most     = vmax(worth.x, vmax(worth.y, worth.z));
    vfloat survival = vmin(most, vsplat(surest_survival));
    goes            = goes & (u->w < survival);
    store3(t, WORTH, k, vscale(worth, 1.0f / survival));
    return goes;
}

static void draw_directions(path_tracer *t)
{
    int n = packets_of(t), kept = 0;
    for (int k = 0; k < n; k++) {
        vscatter next;
        vmask goes = next_direction(t, k, &next);
        if (t->fields > PLAIN_FIELDS)
            leave(t, k, &next);
        note_scattered(t, k, &next);
        store3(t, PLACE, k, vray_start(&t->at[k], &next.wi));
        store3(t, WAY, k, next.wi);
        kept = keep(t, k, goes, kept);
    }
    t->alive = kept;
}

/* Keeps the hits of `met` of packet k, as keep() keeps paths. */
static int keep_hits(path_tracer *t, int k, vmask met, int kept)
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
    return kept;
}

/* What packet k has met, and what its materials do. */
static void arrive(path_tracer *t, int k)
{
    const scene *s = t->s;
    int i          = k * LANES;
    vmask active   = living(t, k);
    vhit hit       = { vload(t->distance + i), vkeep_int(active, vload_int(t->instance + i)),
                       vkeep_int(active, vload_int(t->triangle + i)), vload(t->u + i), vload(t->v + i) };
    vvec3 way      = load3(t, WAY, k);
    vfloat width   = { 0 };
    if (t->fields == FIELDS) {
        width = load(t, WIDTH, k) + load(t, SPREAD, k) * hit.distance;
        store(t, WIDTH, k, width);
    }
    scene_shade(s, &hit, &way, width, active, &t->at[k], &t->shading[k]);
    t->active[k] = t->asks[k] = active;
    if (!s->narrow)
        return;
    vint does    = vgather_int(s->material_does, vkeep_int(active, t->at[k].material));
    t->does[k]   = does;
    t->asks[k]   = active & ((does & DOES_ASK) != 0);
    t->around[k] = active & ((does & DOES_AROUND) != 0);
}

/* Traces the rays, and moves the paths to what they meet. */
static void go_on(path_tracer *t)
{
    int n = packets_of(t), kept = 0;
    for (int k = 0; k < n; k++) {
        t->active[k] = living(t, k);
        t->rays[k]   = (vray){ load3(t, PLACE, k), load3(t, WAY, k), vsplat(INFINITY) };
    }
    t->ray_count += t->alive;
    world_first_hit(t->s->world, t->rays, t->active, n, RAYS_INCOHERENT, t->hits);
    if (t->fields > PLAIN_FIELDS && t->shown.count > 0)
        add_lamps_met(t);
    for (int k = 0; k < n; k++) {
        vmask met = t->active[k] & (t->hits[k].instance >= 0);
        keep_hits(t, k, met, kept);
        kept = keep(t, k, met, kept);
    }
    t->alive = kept;
    for (int k = 0; k < packets_of(t); k++)
        arrive(t, k);
}

/* ---- from beginning to end ------------------------------------------------------------------- */

/* Where sensors stand. */
static void begin_sensors(path_tracer *t)
{
    const path_bundle *b = t->b;
    for (int k = 0; k < packets_of(t); k++) {
        int i    = k * LANES;
        t->at[k] = (vsurface){ .position = { vload(b->x + i), vload(b->y + i), vload(b->z + i) },
                               .normal   = { vload(b->nx + i), vload(b->ny + i), vload(b->nz + i) },
                               .error    = vload(b->error + i) };
        t->active[k] = t->asks[k] = living(t, k);
        t->does[k]                = vsplat_int(0);
        t->around[k]              = (vmask){ 0 };
    }
}

/* The rays from the eye: nothing has been asked for there. */
static void begin_eye(path_tracer *t)
{
    const path_bundle *b = t->b;
    for (int k = 0; k < packets_of(t); k++) {
        int i = k * LANES;
        store3(t, PLACE, k, (vvec3){ vload(b->x + i), vload(b->y + i), vload(b->z + i) });
        store3(t, WAY, k, (vvec3){ vload(b->nx + i), vload(b->ny + i), vload(b->nz + i) });
    }
    for (int i = 0; i < PATHS; i++) {
        t->first[i]             = 1.0f;
        t->carried[PDF][i]      = INFINITY;
        t->carried[LAMP_PDF][i] = INFINITY;
    }
}

static void begin(path_tracer *t, path_bundle *b, const path_options *o)
{
    t->b     = b;
    t->o     = o;
    t->alive = b->count;
    memset(b->direct, 0, sizeof b->direct);
    memset(b->indirect, 0, sizeof b->indirect);
    memset(b->met, 0, sizeof b->met);
    if (b->layers)
        memset(b->layers, 0, 2 * (size_t)t->s->group_count * sizeof *b->layers);
    for (int i = 0; i < PATHS; i++) {
        t->id[i]    = i < b->count ? i : 0; /* those behind the last are read, and dropped */
        t->state[i] = 0;
        for (int c = 0; c < 3; c++)
            t->carried[WORTH + c][i] = 1.0f;
        t->carried[WIDTH][i]  = 0.0f;
        t->carried[SPREAD][i] = o->eye ? o->spread : wide_spread;
    }
}

void path_trace(path_tracer *t, path_bundle *b, const path_options *o)
{
    const scene *s = t->s;
    uint32_t depth = 0;
    begin(t, b, o);
    if (o->eye) {
        begin_eye(t);
    } else {
        begin_sensors(t);
        draw_numbers(t, depth++);
        ask_lights(t, true);
        if (!o->bounce && !s->glows)
            return;
        draw_first_directions(t);
    }
    for (bool first = true; t->alive > 0; first = false, depth++) {
        go_on(t);
        add_glow(t);
        if (first)
            note_what_is_met(t);
        if (!o->bounce && !s->hollow)
            return;
        draw_numbers(t, depth);
        if (o->bounce)
            ask_lights(t, false);
        draw_directions(t);
    }
}
