/* sim/path_light.c -- the light that paths find: by asking lights where they stand, and by the way.
 */
#include "core/color.h"
#include "sim/path_parts.h"
#include "sim/sensor.h"
#include "sim/shadow.h"

enum { ASKED_LAMPS = 16 }; /* that are all asked where a path begins, if one would not do */

/* The sums of one lane: number id, what it found, whether that came straight, and whether by way of
 * what is outside. */
static void add_lane(path_tracer *t, int id, const float of[3], bool straight, bool outside,
                     const path_layer *l)
{
    path_bundle *b   = t->b;
    int groups       = t->s->group_count;
    bool is_straight = straight && !l->ground;
    path_sums *sums  = is_straight ? &b->direct : &b->indirect;
    for (int c = 0; c < CHANNELS; c++) {
        (*sums)[c][id] += l->dimming * of[c];
        if (b->mirrored && l->mirrored)
            (*b->mirrored)[c][id] += l->dimming * of[c];
        if (b->outside && !is_straight && (outside || straight))
            (*b->outside)[c][id] += l->dimming * of[c];
        if (b->daylight && l->day)
            (*b->daylight)[c][id] += of[c];
        if (!b->layers)
            continue;
        b->layers[l->group][c][id] += of[c];
        if (is_straight)
            b->layers[groups + l->group][c][id] += of[c];
    }
}

void path_add(path_tracer *t, int k, vmask lanes, vmask straight, vrgb e, const path_layer *l)
{
    float of[3][LANES];
    vmask outside = state_has(t, k, OUTDOORS);
    vstore(of[0], e.x);
    vstore(of[1], COLOR ? e.y : e.x);
    vstore(of[2], COLOR ? e.z : e.x);
    for (int bits = vbits(lanes & living(t, k)); bits; bits &= bits - 1) {
        int i            = __builtin_ctz((unsigned)bits);
        const float v[3] = { of[0][i], of[1][i], of[2][i] };
        add_lane(t, t->id[k * LANES + i], v, vbits(straight) >> i & 1, vbits(outside) >> i & 1, l);
    }
}

path_layer path_layer_of(const scene *s, int l)
{
    bool lamp = l < s->light_count;
    return (path_layer){ .group   = lamp ? s->light_info[l].group : s->glow_group,
                         .dimming = lamp ? s->light_info[l].dimming : s->glow_dimming,
                         .day     = lamp && s->light_info[l].sun };
}

/* The same of light number `which` (-1: of none) in each lane: a lamp or a glowing surface. */
static void add(path_tracer *t, vmask straight, vmask mirrored, int k, vrgb e, vint which)
{
    const scene *s = t->s;
    vmask left     = living(t, k) & (which >= 0);
    while (vany(left)) {
        int l;
        vmask same    = vtake_same(which, &left, &l);
        path_layer to = path_layer_of(s, l);
        vrgb kept     = vscale(e, vsplat((float)scene_maintenance(s, l)));
        path_add(t, k, same & ~mirrored, straight, kept, &to);
        to.mirrored = true;
        if (vany(same & mirrored))
            path_add(t, k, same & mirrored, straight, kept, &to);
    }
}

/* Light that a ray has met: which it has come to by mirrors alone. */
static vmask by_mirrors(const path_tracer *t, int k)
{
    if (!has_mirror_images(t->s))
        return (vmask){ 0 };
    return state_has(t, k, NOWHERE) & (images_of(t, k) > 0);
}

vrgb path_worth(const path_tracer *t, int k, const vvec3 *wi, bool beginning, vmask active,
                vfloat *pdf)
{
    const scene *s = t->s;
    if (beginning) {
        const vvec3 *n = &t->at[k].normal;
        if (pdf)
            *pdf = vsensor_pdf(t->o->quantity, n, wi);
        vfloat response = vkeep(active, vsensor_response(t->o->quantity, n, wi));
        return (vrgb){ response, response, response };
    }
    vrgb f   = materials_reflect(s->materials, t->at[k].material, &t->shading[k], wi, active, pdf);
    vrgb all = as_known(vscale(vmul(worth_of(t, k), f), first_of(t, k)));
    if (pdf && t->indirect)
        *pdf = vkeep(~t->ends[k], *pdf);
    if (has_smooth(s) || has_textures(s))
        all = vkeep3(on_one_side(&t->shading[k], wi), all);
    return vkeep3(active, all);
}

vvec3 path_horizon(const path_tracer *t, int k, bool beginning)
{
    vmask around = t->around[k];
    if (beginning)
        around = quantity_is_round(t->o->quantity) ? ALL_LANES : (vmask){ 0 };
    return vselect3(around, (vvec3){ 0 }, t->at[k].normal);
}

/* Light that was asked for: what of it counts, and how much where rays find it too: glowing
 * surfaces, and after a path's beginning lamps by way of what is not matt. */
static void add_lights(path_tracer *t, int k, bool beginning)
{
    const scene *s       = t->s;
    const direct_pick *l = &t->lights[k];
    vmask active         = t->asks[k] & (l->light >= 0);
    vmask found          = active & (l->light >= s->light_count);
    if (has_narrow(s) && !beginning)
        found = found | (active & ((t->does[k] & DOES_NARROW) != 0));
    vfloat pdf;
    bool both  = vany(found);
    vrgb worth = path_worth(t, k, &l->wi, beginning, active, both ? &pdf : NULL);
    vrgb all   = as_known(vmul(worth, l->e));
    if (both)
        all = vscale(all, vselect(found, power_heuristic(l->pdf, pdf), vsplat(1.0f)));
    add(t, beginning ? ALL_LANES : (vmask){ 0 }, (vmask){ 0 }, k, vkeep3(active, all), l->light);
}

/* One that is drawn by its luminance would do, but for colour and for groups: a mixture's luminance
 * can be sure while its colour, or a group's share, is not. */
static bool asks_all_lamps(const path_tracer *t)
{
    const scene *s = t->s;
    return s->emitter_count == 0 && scene_lamp_count(s) <= ASKED_LAMPS &&
           (s->lights_differ || t->b->layers);
}

/* Next-event estimation where the paths stand. */
void path_ask_lights(path_tracer *t, bool beginning)
{
    const scene *s = t->s;
    bool lamps     = (!beginning || t->o->lamps) && scene_lamp_count(s) > 0;
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
                           .around     = !beginning && has_narrow(s) ? t->around + first : NULL };
        for (int l = 0; l < (all ? scene_lamp_count(s) : 1); l++) {
            if (all)
                direct_lamp(s, t->direct, l, &b, t->lights + first);
            else
                direct_one(s, t->direct, &b, t->lights + first);
            for (int k = first; k < first + b.packets; k++)
                add_lights(t, k, beginning);
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
    bool no_lamps   = scene_lamp_count(s) == 0;
    vfloat pdf      = { 0 };
    if (vany(first))
        pdf = direct_glow_pdf(s, &before, &wi, emitter, no_lamps || !t->o->lamps, round, first);
    if (vany(later))
        pdf = pdf + direct_glow_pdf(s, &before, &wi, emitter, no_lamps,
                                    later & state_has(t, k, AROUND), later);
    return pdf;
}

/* What shines by itself where the paths have come to. */
void path_add_glow(path_tracer *t)
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
        if (has_mirror_images(s) && t->o->bounce)
            share = share * path_image_share(t, k, -1, emitters_met(t, k, bright), bright);
        vrgb all = vscale(vmul(worth_of(t, k), as_known(glow)), share);
        add(t, ~state_has(t, k, SCATTERED), by_mirrors(t, k), k, vkeep3(bright, all),
            vsplat_int(s->light_count));
    }
}

/* How much lamp l counts, met by rays that may have been drawn as the lamp was asked for. */
static vfloat lamp_share(const path_tracer *t, int k, int l, vmask seen)
{
    vfloat pdf  = load(t, LAMP_PDF, k);
    vmask asked = seen & (pdf < INFINITY);
    if (!vany(asked))
        return first_of(t, k);
    vsurface before = place_before(t, k);
    vvec3 wi        = t->rays[k].direction;
    vfloat other    = direct_lamp_pdf(t->s, &before, &wi, l, state_has(t, k, AROUND), asked);
    return first_of(t, k) * power_heuristic(pdf, vkeep(asked, other));
}

/* Which of the lanes that meet a lamp with a body see it as they would if they asked for it: all
 * the way from where they were last, as if its body were not there. */
static vmask see_past_body(const path_tracer *t, int k, int l, const vlight_hit *hit, vmask met,
                           vpassed *passed)
{
    const float before = 1.0f - 0x1p-14f; /* the surface that it may lie in */
    vint own           = vsplat_int(t->s->light_info[l].owner);
    vray ray           = t->rays[k];
    vmask blocked      = { 0 };
    vmask first        = met & ~state_has(t, k, PASSED);
    ray.reach          = vselect(first, hit->dist * before, vsplat(1.0f));
    passed->share      = vspread((vec3){ 1, 1, 1 });
    passed->solids     = (vmask){ 0 };
    shadow_trace(t->s, &ray, &first, &own, 1, RAYS_INCOHERENT, &blocked, passed);
    return first & ~blocked & ~passed->solids;
}

/* A far lamp is before nothing at all. */
static vmask is_before(vfloat distance, const vhit *hit)
{
    return (distance < hit->distance) | ((distance == INFINITY) & (hit->instance < 0));
}

/* Lamp l, where the rays of packet k meet it before what they met. A sun is too small to be met by
 * chance: it is, by way of mirrors, from the eye alone. */
static void add_lamp_met(path_tracer *t, int k, int l, vmask looking)
{
    const light *lamp = t->s->lights[l];
    vlight_hit hit;
    if (t->s->light_info[l].sun)
        looking = looking & ~((load(t, LAMP_PDF, k) == INFINITY) & state_has(t, k, WIDE));
    vvec3 wi       = t->rays[k].direction;
    vmask met      = lamp->type->hit(lamp, &t->rays[k].origin, &wi, looking, &hit);
    vmask seen     = met & is_before(hit.dist, &t->hits[k]);
    vpassed passed = { .share = vspread((vec3){ 1, 1, 1 }) };
    vmask asked    = met & (load(t, LAMP_PDF, k) < INFINITY);
    if (t->s->light_info[l].owner && vany(asked))
        seen = (seen & ~asked) | see_past_body(t, k, l, &hit, asked, &passed);
    if (!vany(seen))
        return;
    vrgb radiance = vmul(hit.radiance, vselect3(asked, passed.share, vspread((vec3){ 1, 1, 1 })));
    vfloat share  = lamp_share(t, k, l, seen);
    if (has_mirror_images(t->s) && t->o->bounce)
        share = share * path_image_share(t, k, l, vsplat_int(-1), seen);
    vrgb all = vscale(vmul(worth_of(t, k), as_known(radiance)), share);
    add(t, ~state_has(t, k, SCATTERED), by_mirrors(t, k), k, vkeep3(seen, all), vsplat_int(l));
}

/* Lamps that the rays meet on their way. */
void path_add_lamps_met(path_tracer *t)
{
    for (int k = 0; k < packets_of(t); k++) {
        vmask looking = t->active[k] & (load(t, LAMP_PDF, k) >= 0.0f);
        if (!vany(looking))
            continue;
        vray ray = t->rays[k];
        if (!t->s->owners) /* whose bodies may hide them */
            ray.reach = t->hits[k].distance;
        int count = lamp_boxes_met(t->boxes, &ray, looking, t->list);
        for (int i = 0; i < count; i++)
            add_lamp_met(t, k, t->list[i], looking);
    }
}

/* Which paths see something that could give light back: matt or gloss, behind glass or in a mirror,
 * too. Glass and mirrors themselves do not count: what they show of lamps is found by other means,
 * or said to be left to chance. */
void path_note_met(path_tracer *t)
{
    for (int k = 0; k < packets_of(t); k++) {
        vint id    = vload_int(t->id + k * LANES);
        vmask open = t->active[k] & (vgather(t->b->met, id) == 0.0f);
        if (!vany(open))
            continue;
        vint which  = t->at[k].material;
        vfloat back = vrgb_luminance(materials_reflectance(t->s->materials, which, open));
        vmask gives = open & (back > 0.0f);
        if (has_narrow(t->s) || has_hollow(t->s)) {
            vmask more = open & ((t->does[k] & (DOES_NARROW | DOES_AROUND)) != 0);
            gives      = (gives | more) & ((t->does[k] & DOES_ASK) != 0);
        }
        for (int bits = vbits(gives); bits; bits &= bits - 1)
            t->b->met[lane(id, __builtin_ctz((unsigned)bits))] = 1.0f;
    }
}
