/* sim/direct.c -- see direct.h. */
#include "sim/direct.h"

#include "core/color.h"
#include "core/without.h"
#include "sim/shadow.h"

#include <float.h>

struct direct_scratch {
    vray rays[DIRECT_PACKETS];
    vmask asked[DIRECT_PACKETS], blocked[DIRECT_PACKETS];
    vint spare[DIRECT_PACKETS];
    vpassed passed[DIRECT_PACKETS];
    int64_t ray_count;
};

direct_scratch *direct_scratch_new(arena *a, lux_error *err)
{
    return arena_new(a, direct_scratch, err);
}

int64_t direct_rays(const direct_scratch *w) { return w->ray_count; }

static vfloat largest(vvec3 v) { return vmax(vabs(v.x), vmax(vabs(v.y), vabs(v.z))); }

/* Aimed anew from where it starts: near a lamp, the step off the surface is seen. It ends before
 * the surface in which the lamp may lie. That is rounded to a few times what a float resolves at
 * the larger of both places, square to it; seen at a grazing angle with cosine c, 1 / c times as
 * much along the ray. Down to a cosine of 1/32 no light is lost: a tenth of a millimetre in a room
 * of 10 m. */
vray direct_shadow_ray(const vsurface *at, const vvec3 *wi, vfloat dist)
{
    const float roundings = 8.0f * 32.0f * 0x1p-24f;
    vvec3 start           = vray_start(at, wi);
    vmask far             = dist == INFINITY;
    vvec3 place           = valong(at->position, *wi, dist);
    vvec3 to              = vsub(place, start);
    vfloat length         = vlength(to);
    vfloat before         = roundings * vmax(largest(place), vmax(largest(start), length));
    return (vray){ .origin    = start,
                   .direction = vselect3(far, *wi, vscale(to, 1.0f / length)),
                   .reach     = vselect(far, dist, length - vmin(before, 0.5f * length)) };
}

/* The points that the glowing surface l shines on from the place that was drawn, and how far shadow
 * rays may go that are not to meet it. Places as drawn and as traced are off its plane by some
 * roundings of the coordinates; along the ray by more, the flatter it comes in: by that over the
 * cosine to the normal, the axis of its bounds. A point so close to the plane lies in it, and gets
 * nothing, where by a rounding it might be lit by what it lies in. */
static vmask glow_reaches(const light *l, const vsurface *at, const vlight_sample *to, vfloat *dist)
{
    const float roundings = 16.0f * 0x1p-24f;
    light_bounds box      = light_bounds_of(l);
    vfloat corners        = vmax(largest(vspread(box.low)), largest(vspread(box.high)));
    vfloat off            = roundings * vmax(corners, largest(at->position));
    vfloat cosine         = vabs(vdot(to->wi, vspread(box.axis)));
    *dist                 = to->dist - vmin(off / vmax(cosine, vsplat(FLT_MIN)), 0.5f * to->dist);
    return cosine * to->dist > off;
}

static const scene_light *info_of(const scene *s, int l)
{
    static const scene_light glow = { .dimming = 1.0f };
    return l < s->light_count ? &s->light_info[l] : &glow;
}

/* Lanes of packet k to which light from below the horizon counts. */
static vmask around(const direct_batch *b, int k)
{
    return b->all_around ? ALL_LANES : b->around ? b->around[k] : (vmask){ 0 };
}

/* Takes over what light l gives the lanes of packet k, and sets out their shadow rays. */
static void take(const scene *s, direct_scratch *w, const direct_batch *b, int k, int l,
                 vmask lanes, vfloat chance, direct_pick *out)
{
    const vsurface *at = &b->at[k];
    vlight_sample lamp;
    vmask lit   = light_sample(s->lights[l], &at->position, b->u[k].x, b->u[k].y, lanes, &lamp);
    lit         = lit & (around(b, k) | (vdot(lamp.wi, at->normal) > 0.0f));
    vfloat dist = lamp.dist;
    if (l >= s->light_count)
        lit = lit & glow_reaches(s->lights[l], at, &lamp, &dist);
    vray ray   = direct_shadow_ray(at, &lamp.wi, dist);
    out->wi    = vselect3(lit, lamp.wi, out->wi);
    out->e     = vselect3(lit, vscale(lamp.e, 1.0f / chance), out->e);
    out->pdf   = vselect(lit, lamp.pdf * chance, out->pdf);
    out->dist  = vselect(lit, dist, out->dist);
    out->light = vselect_int(lit, vsplat_int(l), out->light);

    w->rays[k].origin    = vselect3(lit, ray.origin, w->rays[k].origin);
    w->rays[k].direction = vselect3(lit, ray.direction, w->rays[k].direction);
    w->rays[k].reach     = vselect(lit, ray.reach, w->rays[k].reach);
    w->spare[k]          = vselect_int(lit, vsplat_int(info_of(s, l)->owner), w->spare[k]);
    if (!info_of(s, l)->clear)
        w->asked[k] = w->asked[k] | lit;
}

static void begin_pick(direct_scratch *w, int k, direct_pick *out)
{
    *out        = (direct_pick){ .light = vsplat_int(-1) };
    w->asked[k] = (vmask){ 0 };
    w->rays[k]  = (vray){ 0 };
    w->spare[k] = vsplat_int(0);
}

/* What paths find behind solids they do not count: light that was asked for there has no other
 * way. */
static void take_passed(const vpassed *p, vmask asked, direct_pick *out)
{
    out->e   = vselect3(asked, vmul(out->e, p->share), out->e);
    out->pdf = vselect(asked & p->solids, vsplat(INFINITY), out->pdf);
}

static void end_picks(const scene *s, direct_scratch *w, int packets, ray_hint hint,
                      direct_pick *out)
{
    w->ray_count +=
        shadow_trace(s, w->rays, w->asked, w->spare, packets, hint, w->blocked, w->passed);
    for (int k = 0; k < packets; k++) {
        vmask blocked = w->asked[k] & w->blocked[k];
        if (HAS_MIRRORS && s->hollow)
            take_passed(&w->passed[k], w->asked[k], &out[k]);
        out[k].e = vkeep3(~blocked, out[k].e);
    }
}

void direct_lamp(const scene *s, direct_scratch *w, int l, const direct_batch *b, direct_pick *out)
{
    for (int k = 0; k < b->packets; k++) {
        begin_pick(w, k, &out[k]);
        take(s, w, b, k, l, b->active[k], vsplat(1.0f), &out[k]);
    }
    if (b->unshadowed)
        return;
    end_picks(s, w, b->packets, RAYS_COHERENT, out);
}

/* ---- one of many ----------------------------------------------------------------------------- */

vfloat direct_weight(const light *l, const vvec3 *p, const vvec3 *n, vmask active)
{
    if (l->type->weight)
        return l->type->weight(l, p, n, active);
    vlight_sample lamp;
    vmask lit     = light_sample(l, p, vsplat(0.5f), vsplat(0.5f), active, &lamp);
    vfloat cosine = vdot(lamp.wi, *n);
    return vkeep(lit & (cosine > 0.0f), vrgb_luminance(lamp.e) * cosine);
}

vvec3 direct_facing(const light *l, const vsurface *at)
{
    light_bounds b = light_bounds_of(l);
    vvec3 middle   = vscale(vadd(vspread(b.low), vspread(b.high)), vsplat(0.5f));
    vvec3 to       = b.far ? vneg(vspread(b.axis)) : vsub(middle, at->position);
    vfloat length  = vlength(to);
    return vselect3(length > 0.0f, vscale(to, 1.0f / length), at->normal);
}

/* The normal by which lamp l is weighed. */
static vvec3 weighing_normal(const light *l, const vsurface *at, vmask around)
{
    if (!vany(around))
        return at->normal;
    return vselect3(around, direct_facing(l, at), at->normal);
}

/* Which lamp of a set of few each lane draws, -1 for none, and with what probability. */
static vint choose_of_few(const scene *s, const light_set *set, const direct_batch *b, int k,
                          vmask active, vfloat pick, vfloat *chance)
{
    const vsurface *at = &b->at[k];
    vfloat weight[FEW_LAMPS], total = { 0 };
    for (int i = 0; i < set->lamps; i++) {
        const light *l = s->lights[set->lights[i]];
        vvec3 n        = weighing_normal(l, at, around(b, k));
        weight[i]      = direct_weight(l, &at->position, &n, active);
        total          = total + weight[i];
    }

    /* The first lamp at which the running sum reaches pick * total: it reaches all of it at last */
    vint drawn   = vsplat_int(-1);
    vfloat share = { 0 }, sum = { 0 }, threshold = pick * total;
    for (int i = 0; i < set->lamps; i++) {
        sum        = sum + weight[i];
        vmask this = active & (drawn < 0) & (weight[i] > 0.0f) & (sum >= threshold);
        drawn      = vselect_int(this, vsplat_int(set->lights[i]), drawn);
        share      = vselect(this, weight[i], share);
    }
    *chance = vkeep(drawn >= 0, share / total);
    return drawn;
}

/* The normal by which a tree chooses: none where light from all around counts. */
static vvec3 horizon_of(const vsurface *at, vmask around)
{
    return vselect3(around, (vvec3){ 0 }, at->normal);
}

static vint choose_of_set(const scene *s, const light_set *set, const direct_batch *b, int k,
                          vmask active, vfloat pick, vfloat *chance)
{
    if (!set->tree)
        return choose_of_few(s, set, b, k, active, pick, chance);
    vlight_choice drawn;
    vvec3 n   = horizon_of(&b->at[k], around(b, k));
    vmask any = vlight_tree_choose(set->tree, &b->at[k].position, &n, pick, active, &drawn);
    *chance   = drawn.probability;
    return vselect_int(any, vgather_int(set->lights, vkeep_int(any, drawn.index)), vsplat_int(-1));
}

/* Of the layers of a scene one is taken, each as often as another: a small one is not to be noisy
 * for the sake of a large one. */
static vint choose(const scene *s, const direct_batch *b, int k, vfloat *chance)
{
    if (b->glow_alone)
        return choose_of_set(s, &s->glow_set, b, k, b->active[k], b->u[k].z, chance);
    vfloat scaled = b->u[k].z * (float)s->set_count;
    vint which    = vto_int(scaled);
    vfloat pick   = scaled - vto_float(which);
    vint drawn    = vsplat_int(-1);
    *chance       = vsplat(0.0f);
    for (int i = 0; i < s->set_count; i++) {
        vmask here = b->active[k] & (which == i);
        if (!vany(here))
            continue;
        vfloat own;
        vint one = choose_of_set(s, &s->sets[i], b, k, here, pick, &own);
        drawn    = vselect_int(here, one, drawn);
        *chance  = vselect(here, own * (1.0f / (float)s->set_count), *chance);
    }
    return drawn;
}

void direct_one(const scene *s, direct_scratch *w, const direct_batch *b, direct_pick *out)
{
    for (int k = 0; k < b->packets; k++) {
        vfloat chance;
        vint drawn = choose(s, b, k, &chance);
        vmask left = b->active[k] & (drawn >= 0);
        begin_pick(w, k, &out[k]);
        while (vany(left)) {
            int l;
            vmask same = vtake_same(drawn, &left, &l);
            take(s, w, b, k, l, same, chance, &out[k]);
        }
    }
    if (b->unshadowed)
        return;
    end_picks(s, w, b->packets, RAYS_INCOHERENT, out);
}

static const light_set *set_of(const scene *s, int group)
{
    return &s->sets[s->layered ? s->set_of_group[group] : 0];
}

vfloat direct_glow_pdf(const scene *s, const vsurface *at, const vvec3 *wi, vint emitter,
                       bool glow_alone, vmask around, vmask active)
{
    const light_set *set = glow_alone ? &s->glow_set : set_of(s, s->glow_group);
    vmask left           = active & (emitter >= 0);
    if (s->emitter_count == 0 || !vany(left))
        return (vfloat){ 0 };
    vvec3 n       = horizon_of(at, around);
    vint index    = vkeep_int(left, emitter + set->lamps); /* emitters stand behind the lamps */
    vfloat chance = vlight_tree_probability(set->tree, &at->position, &n, index, left);
    vfloat pdf    = { 0 };
    while (vany(left)) {
        int e;
        vmask same = vtake_same(emitter, &left, &e);
        vlight_hit hit;
        const light *l = s->lights[s->light_count + e];
        vmask met      = l->type->hit(l, &at->position, wi, same, &hit);
        pdf            = vselect(met, hit.pdf, pdf);
    }
    return pdf * chance * (glow_alone ? 1.0f : 1.0f / (float)s->set_count);
}

/* Where lamp l stands in its set. */
static int place_in_set(const light_set *set, int l)
{
    int i = 0;
    while (set->lights[i] != l)
        i++;
    return i;
}

vfloat direct_lamp_pdf(const scene *s, const vsurface *at, const vvec3 *wi, int l, vmask around,
                       vmask active)
{
    const light_set *set = set_of(s, s->light_info[l].group);
    const light *lamp    = s->lights[l];
    vlight_hit hit;
    vmask met = lamp->type->hit(lamp, &at->position, wi, active, &hit);
    vfloat chance;
    if (s->light_info[l].sun) /* asked besides all others */
        return vkeep(met, hit.pdf);
    if (set->tree) {
        vvec3 n    = horizon_of(at, around);
        vint index = vsplat_int(place_in_set(set, l));
        chance     = vlight_tree_probability(set->tree, &at->position, &n, index, met);
    } else {
        vfloat own = { 0 }, total = { 0 };
        for (int i = 0; i < set->lamps; i++) {
            const light *other = s->lights[set->lights[i]];
            vvec3 n            = weighing_normal(other, at, around);
            vfloat weight      = direct_weight(other, &at->position, &n, met);
            total              = total + weight;
            own                = set->lights[i] == l ? weight : own;
        }
        chance = vkeep(total > 0.0f, own / total);
    }
    return vkeep(met, hit.pdf * chance * (1.0f / (float)s->set_count));
}
