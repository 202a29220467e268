/* sim/path.c -- see path.h. The living paths stay packed at the front of the arrays. */
#include "sim/path.h"

#include "core/color.h"
#include "core/sampler.h"
#include "sim/path_parts.h"
#include "sim/sensor.h"
#include "sim/shading.h"

#include <string.h>

/* Survival is never certain, so that a path ends even in a room that absorbs nothing. */
static const float surest_survival = 0.995f;

/* rad: the beam that a ray stands for which was drawn from all around. Of a thousand such, each
 * has a thousandth of the hemisphere. */
static const float wide_spread = 0.03f;

/* Keeps the paths of `goes` of packet k, behind those kept before; they move down in place. */
static int keep(path_tracer *t, int k, vmask goes, int kept)
{
    for (int bits = vbits(goes); bits; bits &= bits - 1, kept++) {
        int from       = k * LANES + __builtin_ctz((unsigned)bits);
        t->id[kept]    = t->id[from];
        t->state[kept] = t->state[from];
        t->image[kept] = t->image[from];
        for (int f = FIRST_FIELD; f < t->fields; f++)
            t->carried[f][kept] = t->carried[f][from];
    }
    return kept;
}

/* ---- a step of all living paths -------------------------------------------------------------- */

/* Whether the paths stand where numbers go with those of their first direction. From the eye more
 * was drawn before. */
static bool goes_with_first(const path_tracer *t) { return t->depth == 1 && !t->o->eye; }

vsample4 path_numbers(const path_tracer *t, int k, uint32_t purpose)
{
    vint id     = vload_int(t->id + k * LANES);
    vuint index = vunsigned(vgather_int((const int32_t *)t->b->index, id));
    vuint seed  = vunsigned(vgather_int((const int32_t *)t->b->seed, id));
    if (purpose == 0 && goes_with_first(t))
        return vsobol4_more(index, vhash_combine(seed, vsplat_uint(0)));
    return vsobol4(index, vhash_combine(seed, vsplat_uint(purpose ^ t->depth)));
}

vmask path_in_turn(const path_tracer *t, int k, int which, uint32_t turns)
{
    enum { ALIKE = 3 }; /* bits of their number */
    vint id     = vload_int(t->id + k * LANES);
    vuint index = vunsigned(vgather_int((const int32_t *)t->b->index, id));
    vuint seed  = vunsigned(vgather_int((const int32_t *)t->b->seed, id));
    vuint turn  = vhash_combine(seed, vsplat_uint(t->depth)) + (index >> ALIKE);
    return ((turn + (uint32_t)which) & (turns - 1)) == 0;
}

/* Of a place. Lights have numbers of their own only where they need them: not where the numbers go
 * with those of the beginning, which is worth more. What lights give and what the path finds
 * farther on are added, not multiplied. */
static void draw_numbers(path_tracer *t)
{
    bool own =
        !goes_with_first(t) && (t->s->extended || t->s->emitter_count > 0 || has_narrow(t->s));
    for (int k = 0; k < packets_of(t); k++) {
        t->sample[k]       = path_numbers(t, k, 0);
        t->light_sample[k] = own ? path_numbers(t, k, (uint32_t)OF_LIGHT) : t->sample[k];
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
        if (has_patches(t))
            store(t, ONTO, k, vsplat(0.0f));
        if (has_mirror_images(t->s)) {
            vmask round = quantity_is_round(t->o->quantity) ? ALL_LANES : (vmask){ 0 };
            path_set_base(t, k, ALL_LANES, true, t->at[k].position, t->at[k].normal, round,
                          load(t, PDF, k));
        }
        store3(t, PLACE, k, vray_start(&t->at[k], &wi));
        store3(t, WAY, k, wi);
    }
}

static void or_state(path_tracer *t, int k, vmask lanes, int bits)
{
    vint state = vload_int(t->state + k * LANES);
    vstore_int(t->state + k * LANES, vselect_int(lanes, state | bits, state));
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
    vmask lens     = (t->does[k] & DOES_LENS) != 0;
    vmask began    = state_has(t, k, WIDE); /* somewhere where lights were asked for */
    vmask bent     = began & (state_has(t, k, BENT) | (next->bent & ~lens));
    vfloat of_pdf  = vselect(single, vselect(bent, already, sole), next->pdf);
    vfloat of_lamp = vselect(single, of_pdf, vselect(narrow, next->pdf, already));
    or_state(t, k, left & single & bent, BENT);
    if (has_patches(t)) {
        store(t, ONTO, k, vselect(left, path_onto(t, k, left), load(t, ONTO, k)));
        store3(t, FARTHER, k, vselect3(left, load3(t, LEFT, k), load3(t, FARTHER, k)));
    }
    store(t, PDF, k, vselect(left, of_pdf, pdf));
    store(t, LAMP_PDF, k, vselect(left, of_lamp, lamp));
    store3(t, LEFT, k, vselect3(left, t->at[k].position, load3(t, LEFT, k)));
    store3(t, SIDE, k, vselect3(left, t->at[k].normal, load3(t, SIDE, k)));
}

/* A new base, or one mirror more. */
static void leave_base(path_tracer *t, int k, const vscatter *next)
{
    vmask left   = t->active[k] & ~next->straight;
    vmask single = left & (next->pdf == INFINITY);
    vmask inside = ((t->does[k] & DOES_SOLID) != 0) & ~t->shading[k].front;
    vint image   = images_of(t, k);
    vhit hit     = { .instance = vkeep_int(single, vload_int(t->instance + k * LANES)),
                     .triangle = vkeep_int(single, vload_int(t->triangle + k * LANES)) };
    vmask mirror = single & ~next->bent & ~inside;
    vint longer  = mirrors_follow(t->s->mirror_images, image, &hit, mirror);
    vstore_int(t->image + k * LANES, vselect_int(single, longer, image));
    path_set_base(t, k, left & ~single, false, t->at[k].position, t->at[k].normal, t->around[k],
                  next->pdf);
}

/* What maps find of lamps that the path meets from here on by single directions alone, as seen from
 * matt surfaces. */
static void leave_to_maps(path_tracer *t, int k, const vscatter *next)
{
    vmask single = t->active[k] & ~next->straight & (next->pdf == INFINITY);
    vmask plate  = next->bent & ((t->does[k] & DOES_LENS) == 0);
    vmask images = (vmask){ 0 };
    if (has_mirror_images(t->s))
        images = images_of(t, k) > 0;
    vmask mapped  = state_has(t, k, WIDE) & ~state_has(t, k, GLOSSY);
    vmask focused = single & ~plate & ~images & mapped;
    or_state(t, k, focused, FOCUSED);
    vmask skip = t->active[k] & state_has(t, k, FOCUSED);
    store(t, LAMP_PDF, k, vselect(skip, vsplat(ALREADY), load(t, LAMP_PDF, k)));
}

static void note_scattered(path_tracer *t, int k, const vscatter *next)
{
    vint before = vload_int(t->state + k * LANES);
    vint around = vselect_int(t->around[k], vsplat_int(AROUND), vsplat_int(0));
    vmask matt  = (t->does[k] & (DOES_NARROW | DOES_AROUND | DOES_HOLLOW)) == 0;
    vint glossy = vselect_int(matt, vsplat_int(0), vsplat_int(GLOSSY));
    vint wide   = vselect_int(next->pdf < INFINITY, WIDE | glossy, vsplat_int(0));
    vint single =
        vselect_int(next->pdf == INFINITY, vsplat_int(BENT | FOCUSED | GLOSSY), vsplat_int(0));
    vint kept  = before & (WIDE | OUTDOORS | NOWHERE | ALL_ROUND | single);
    vint after = kept | wide | around | SCATTERED;
    vstore_int(t->state + k * LANES, vselect_int(next->straight, before | PASSED, after));
    if (t->fields < FIELDS)
        return;
    vmask drawn   = ~next->straight & (next->pdf < INFINITY);
    vfloat spread = load(t, SPREAD, k);
    store(t, SPREAD, k, vselect(drawn, vmax(spread, vsplat(wide_spread)), spread));
}

/* Draws where a path goes on, or that it ends. */
static vmask next_direction(path_tracer *t, int k, vscatter *next)
{
    const scene *s    = t->s;
    const vsample4 *u = &t->sample[k];
    vmask goes = materials_scatter(s->materials, t->at[k].material, &t->shading[k], u->x, u->y,
                                   u->z, t->active[k], next);
    if (has_smooth(s) || has_textures(s))
        goes = goes & (next->straight | on_one_side(&t->shading[k], &next->wi));
    if (!t->o->bounce || (t->o->bounded && t->depth > (uint32_t)t->o->bounces))
        goes = goes & next->straight;
    vrgb worth = as_known(vmul(worth_of(t, k), next->weight));

    /* Roulette: a path goes on as often as it is worth going. Straight on it ends by itself. */
    vfloat most     = COLOR ? vmax(worth.x, vmax(worth.y, worth.z)) : worth.x;
    vfloat surest   = vselect(next->straight, vsplat(1.0f), vsplat(surest_survival));
    vfloat survival = vmin(most, surest);
    if (t->depth < (uint32_t)t->o->roulette_from)
        survival = vsplat(1.0f);
    goes = goes & (most > 0.0f) & (u->w < survival);
    store_worth(t, k, vscale(worth, 1.0f / survival));
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
        if (has_mirror_images(t->s))
            leave_base(t, k, &next);
        if (t->focused || t->leaves_focused)
            leave_to_maps(t, k, &next);
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

/* Of paths that have met no surface before but such as let them through. */
static void note_outdoors(path_tracer *t, int k, vint does)
{
    vint state  = vload_int(t->state + k * LANES);
    vmask first = (state & SCATTERED) == 0;
    vint now    = state & ~OUTDOORS;
    now         = vselect_int((does & DOES_EXTERIOR) != 0, now | OUTDOORS, now);
    vstore_int(t->state + k * LANES, vselect_int(first, now, state));
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
    if (!has_narrow(s) && !has_hollow(s) && !has_exteriors(s))
        return;
    vint does  = vgather_int(s->material_does, vkeep_int(active, t->at[k].material));
    t->does[k] = does;
    if (has_exteriors(s))
        note_outdoors(t, k, does);
    if (!has_narrow(s))
        return;
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
        path_add_lamps_met(t);
    if (has_skies(t->s))
        path_add_sky(t);
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

static void begin(path_tracer *t)
{
    const path_bundle *b  = t->b;
    const path_options *o = t->o;
    t->depth              = 0;
    t->alive              = b->count;
    for (int i = 0; i < PATHS; i++) {
        t->id[i]    = i < b->count ? i : 0; /* those behind the last are read, and dropped */
        t->state[i] = o->eye ? 0 : WIDE;
        t->image[i] = -1;
        for (int c = 0; c < 3; c++)
            t->carried[WORTH + c][i] = 1.0f;
        t->carried[WIDTH][i]  = 0.0f;
        t->carried[SPREAD][i] = o->eye ? o->spread : wide_spread;
    }
}

/* Whether light may be reflected so many times more where the paths stand. */
static bool goes_on(const path_tracer *t, int times)
{
    return !t->o->bounded || t->depth + (uint32_t)times <= (uint32_t)t->o->bounces;
}

static void ask(path_tracer *t, bool beginning)
{
    path_ask_lights(t, beginning);
    if (has_mirror_images(t->s) && t->o->bounce && goes_on(t, 1))
        path_ask_images(t, beginning);
    if (has_skies(t->s))
        path_ask_sky(t, beginning);
    if (has_suns(t->s) && (!beginning || t->o->lamps))
        path_ask_suns(t, beginning);
    if (has_patches(t) && t->o->bounce && goes_on(t, 1))
        path_ask_patches(t, beginning);
}

void path_follow(path_tracer *t)
{
    const scene *s        = t->s;
    const path_options *o = t->o;
    begin(t);
    if (o->eye) {
        begin_eye(t);
    } else {
        begin_sensors(t);
        draw_numbers(t);
        ask(t, true);
        t->depth++;
        if (!o->bounce && !s->glows && !has_skies(s))
            return;
        draw_first_directions(t);
    }
    for (bool first = true; t->alive > 0; first = false, t->depth++) {
        go_on(t);
        path_add_glow(t);
        if (first || has_narrow(s) || has_hollow(s))
            path_note_met(t);
        if (!o->bounce && !has_hollow(s))
            return;
        draw_numbers(t);
        if ((t->indirect || t->focused) && o->bounce)
            path_take_maps(t);
        if (o->bounce && goes_on(t, 0))
            ask(t, false);
        draw_directions(t);
    }
}
