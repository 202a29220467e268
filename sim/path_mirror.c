/* sim/path_mirror.c -- light that paths find by way of plane mirrors and panes (mirrors.h).
 *
 * Where a path stands, x, a chain of mirrors is drawn, and a light is asked as if x were where the
 * chain images it, x'. The bent way from x is then traced: each plane of the chain must be what its
 * ray meets next, thin glass and holes apart. What is found so and by the path's own rays, from x
 * by the same mirrors to a light with extent, counts by the power heuristic; suns are found by
 * asking alone.
 *
 * Away from a path's beginning faint mirrors, as panes are, are asked now and then only.
 */
#include "core/color.h"
#include "sim/path_parts.h"
#include "sim/sensor.h"
#include "sim/shading.h"

enum { SELDOM = 4 /* places, of which one asks for faint mirrors */, PASSES = 8 };

static const float rounding = 0x1p-16f; /* of a bent way's length, and where it has been bent */
static const float faint    = 0.5f;     /* the largest share of a chain, below which they are */

/* The bent ways of some packets. */
typedef struct bent_ways {
    vint image[DIRECT_PACKETS], leg[DIRECT_PACKETS];
    vmask going[DIRECT_PACKETS], arrived[DIRECT_PACKETS];
    vrgb share[DIRECT_PACKETS];
    vfloat left[DIRECT_PACKETS]; /* m, to the light */
    vsurface last[DIRECT_PACKETS];
    vray rays[DIRECT_PACKETS];
} bent_ways;

static uint32_t turns_of(const path_tracer *t, bool beginning)
{
    return beginning || t->s->mirror_images->most > faint ? 1 : SELDOM;
}

void path_set_base(path_tracer *t, int k, vmask set, bool beginning, vvec3 place, vvec3 side,
                   vmask around, vfloat pdf)
{
    int first  = k * LANES;
    int bits   = beginning ? NOWHERE : 0;
    vint state = vload_int(t->state + first);
    vint round = vselect_int(around, vsplat_int(ALL_ROUND), vsplat_int(0));
    vint now   = (state & ~(NOWHERE | ALL_ROUND)) | round | bits;
    vstore_int(t->state + first, vselect_int(set, now, state));
    vstore_int(t->image + first, vselect_int(set, vsplat_int(0), images_of(t, k)));
    store3(t, BASE, k, vselect3(set, place, load3(t, BASE, k)));
    store3(t, BASE_SIDE, k, vselect3(set, side, load3(t, BASE_SIDE, k)));
    store(t, BASE_PDF, k, vselect(set, pdf, load(t, BASE_PDF, k)));
}

vfloat path_image_share(const path_tracer *t, int k, int l, vint emitter, vmask seen)
{
    const scene *s   = t->s;
    const mirrors *m = s->mirror_images;
    vint image       = images_of(t, k);
    seen             = seen & (image > 0);
    if (!vany(seen))
        return vsplat(1.0f);
    vmask around = state_has(t, k, ALL_ROUND);
    vvec3 base   = load3(t, BASE, k);
    vvec3 side   = load3(t, BASE_SIDE, k);
    vvec3 n      = vselect3(around, (vvec3){ 0 }, side);
    vvec3 wi     = load3(t, WAY, k);
    vsurface at  = { .position = mirrors_place(m, image, &base),
                     .normal   = mirrors_turn(m, image, &side) };
    vfloat of    = l >= 0 ? direct_lamp_pdf(s, &at, &wi, l, around, seen)
                          : direct_glow_pdf(s, &at, &wi, emitter, false, around, seen);
    vfloat other = of * mirrors_chance(s, MIRROR_LAMPS, &base, &n, image, seen);
    vmask first  = state_has(t, k, NOWHERE);
    other        = other * vselect(first, vsplat(1.0f), vsplat(1.0f / (float)turns_of(t, false)));
    return vselect(seen, power_heuristic(load(t, BASE_PDF, k), other), vsplat(1.0f));
}

/* ---- the way from a place by its mirrors to a light ------------------------------------------ */

static void set_out(const path_tracer *t, int first, int n, bent_ways *w)
{
    const mirrors *m = t->s->mirror_images;
    for (int i = 0; i < n; i++) {
        const direct_pick *l = &t->lights[first + i];
        vvec3 wi             = mirrors_back(m, w->image[i], &l->wi);
        w->going[i]          = t->asked[first + i] & (l->light >= 0);
        w->arrived[i]        = (vmask){ 0 };
        w->leg[i]            = vsplat_int(0);
        w->share[i]          = vspread((vec3){ 1, 1, 1 });
        w->left[i]           = l->dist;
        w->last[i]           = t->at[first + i];
        w->rays[i]           = (vray){ vray_start(&w->last[i], &wi), wi, vsplat(INFINITY) };
    }
}

static vvec3 mirrored_in(const mirrors *m, vint plane, const vvec3 *w, vmask lanes)
{
    vvec3 out = *w;
    while (vany(lanes)) {
        int p;
        vmask same = vtake_same(plane, &lanes, &p);
        vvec3 n    = vspread(m->planes[p].normal);
        out        = vselect3(same, vsub(*w, vscale(n, 2.0f * vdot(n, *w))), out);
    }
    return out;
}

/* One surface more: the mirror that is wanted, glass to go straight through, or the end. */
static void meet(const path_tracer *t, int i, const vhit *hit, bent_ways *w)
{
    const scene *s   = t->s;
    const mirrors *m = s->mirror_images;
    vmask met        = w->going[i] & (hit->instance >= 0) & (hit->distance < w->left[i]);
    vsurface at;
    vshading shading;
    scene_shade(s, hit, &w->rays[i].direction, vsplat(0.0f), met, &at, &shading);
    vint chain = w->image[i]; /* where its planes begin */
    vint first = { 0 };
    vint depth = { 0 };
    vmask left = met;
    while (vany(left)) {
        int g;
        vmask same = vtake_same(chain, &left, &g);
        first      = vselect_int(same, vsplat_int(m->images[g].first), first);
        depth      = vselect_int(same, vsplat_int(m->images[g].depth), depth);
    }
    vint wanted  = vgather_int(m->chains, vkeep_int(met, first + w->leg[i]));
    vmask mirror = met & (mirrors_plane(m, hit, met) == wanted);
    vmask passes = met & ~mirror;
    vrgb share   = { 0 };
    if (vany(mirror))
        share = materials_mirrored(s->materials, at.material, &shading, mirror);
    if (has_hollow(s) && vany(passes))
        share = vadd(share, materials_through(s->materials, at.material, &shading, passes));
    w->share[i] = vselect3(met, vmul(w->share[i], share), w->share[i]);

    vvec3 way            = mirrored_in(m, wanted, &w->rays[i].direction, mirror);
    w->left[i]           = vselect(met, w->left[i] - hit->distance, w->left[i]);
    w->leg[i]            = vselect_int(mirror, w->leg[i] + 1, w->leg[i]);
    w->last[i]           = (vsurface){ .position = vselect3(met, at.position, w->last[i].position),
                                       .normal   = vselect3(met, at.normal, w->last[i].normal),
                                       .error    = vselect(met, at.error, w->last[i].error) };
    w->rays[i].origin    = vselect3(met, vray_start(&at, &way), w->rays[i].origin);
    w->rays[i].direction = vselect3(met, way, w->rays[i].direction);
    vmask lit            = met & (vrgb_luminance(w->share[i]) > 0.0f);
    w->arrived[i]        = w->arrived[i] | (lit & mirror & (w->leg[i] >= depth));
    w->going[i]          = lit & ~w->arrived[i];
}

/* From mirror to mirror; how many rays that took. */
static int64_t follow_mirrors(const path_tracer *t, int n, int most, bent_ways *w)
{
    int64_t count = 0;
    vhit hits[DIRECT_PACKETS];
    for (int round = 0; round < most + PASSES; round++) {
        int64_t going = 0;
        for (int i = 0; i < n; i++)
            going += __builtin_popcount((unsigned)vbits(w->going[i]));
        if (going == 0)
            break;
        count += going;
        world_first_hit(t->s->world, w->rays, w->going, n, RAYS_INCOHERENT, hits);
        for (int i = 0; i < n; i++)
            if (vany(w->going[i]))
                meet(t, i, &hits[i], w);
    }
    return count;
}

/* The cosine at which rays come to the glowing triangles that they are aimed at: what places are
 * off square to these is more along the ray. */
static vfloat flatness(const path_tracer *t, int k, const vvec3 *way, vmask glows)
{
    vfloat cosine = vsplat(1.0f);
    while (vany(glows)) {
        int l;
        vmask same = vtake_same(t->lights[k].light, &glows, &l);
        vvec3 axis = vspread(light_bounds_of(t->s->lights[l]).axis);
        cosine     = vselect(same, vmax(vabs(vdot(*way, axis)), vsplat(1e-3f)), cosine);
    }
    return cosine;
}

/* From the last mirror to the light; to before a surface that glows, as closely as a bent way is
 * known. */
static void arrive(path_tracer *t, int first, int n, bent_ways *w)
{
    const scene *s = t->s;
    for (int i = 0; i < n; i++) {
        int k       = first + i;
        t->asked[k] = w->arrived[i];
        vmask glows = t->lights[k].light >= s->light_count;
        vvec3 bend  = w->last[i].position;
        vfloat size = t->lights[k].dist + vmax(vabs(bend.x), vmax(vabs(bend.y), vabs(bend.z)));
        vfloat flat = vkeep(glows, size * rounding) / flatness(t, k, &w->rays[i].direction, glows);
        vfloat left = w->left[i] - vmin(flat, 0.5f * w->left[i]);
        t->rays[k]  = direct_shadow_ray(&w->last[i], &w->rays[i].direction, left);
        vint owner  = vsplat_int(0);
        vmask owned = s->owners ? w->arrived[i] : (vmask){ 0 };
        while (vany(owned)) {
            int l;
            vmask same = vtake_same(t->lights[k].light, &owned, &l);
            if (l < s->light_count)
                owner = vselect_int(same, vsplat_int(s->light_info[l].owner), owner);
        }
        t->spare[k] = owner;
    }
    t->ray_count += shadow_trace(s, t->rays + first, t->asked + first, t->spare + first, n,
                                 RAYS_INCOHERENT, t->blocked + first, t->passed + first);
}

/* What has come, where it belongs. */
static void take(path_tracer *t, int k, const bent_ways *w, int i, vfloat chance, bool beginning,
                 bool found)
{
    const scene *s       = t->s;
    const direct_pick *l = &t->lights[k];
    vmask lit            = t->asked[k] & ~t->blocked[k];
    if (!vany(lit))
        return;
    uint32_t turns = turns_of(t, beginning);
    vvec3 wi       = mirrors_back(s->mirror_images, w->image[i], &l->wi);
    vfloat pdf;
    vrgb worth   = path_worth(t, k, &wi, beginning, lit, &pdf);
    vfloat asked = l->pdf * chance * (1.0f / (float)turns);
    vmask both   = lit & (l->pdf < INFINITY) & (found ? ALL_LANES : (vmask){ 0 });
    vfloat share = vselect(both, power_heuristic(asked, pdf), vsplat(1.0f));
    vrgb e       = vmul(l->e, w->share[i]);
    if (has_hollow(s))
        e = vmul(e, t->passed[k].share);
    e          = vmul(vscale(worth, share * (float)turns / chance), e);
    vmask left = lit;
    while (vany(left)) {
        int at;
        vmask same    = vtake_same(l->light, &left, &at);
        path_layer to = path_layer_of(s, at);
        to.mirrored   = beginning;
        path_add(t, k, same, (vmask){ 0 },
                 vkeep3(same, vscale(e, vsplat((float)scene_maintenance(s, at)))), &to);
    }
}

/* Which chain each lane of packet k asks for, and x' in *at. */
static void choose(path_tracer *t, int k, mirror_lights which, bool beginning, const vsample4 *u,
                   vint *image, vfloat *chance, vsurface *at)
{
    const mirrors *m = t->s->mirror_images;
    vvec3 n          = path_horizon(t, k, beginning);
    vmask asks       = t->asks[k];
    uint32_t turns   = turns_of(t, beginning);
    if (turns > 1)
        asks = asks & path_in_turn(t, k, which == MIRROR_SUNS, turns);
    *image      = (vint){ 0 };
    *chance     = vsplat(0.0f);
    t->asked[k] = asks;
    if (!vany(asks))
        return;
    *image       = mirrors_choose(t->s, which, &t->at[k].position, &n, u->w, asks, chance);
    t->asked[k]  = asks & (*image > 0);
    *image       = vkeep_int(t->asked[k], *image);
    *at          = t->at[k];
    at->position = mirrors_place(m, *image, &at->position);
    at->normal   = mirrors_turn(m, *image, &at->normal);
}

static void pick_sun(path_tracer *t, const direct_batch *b, int first)
{
    const scene *s = t->s;
    vmask active[DIRECT_PACKETS];
    direct_pick of[DIRECT_PACKETS];
    direct_batch one = *b;
    one.active       = active;
    for (int i = 0; i < b->packets; i++)
        t->lights[first + i] = (direct_pick){ .light = vsplat_int(-1) };
    for (int sun = 0; sun < s->sun_count; sun++) {
        bool any = false;
        for (int i = 0; i < b->packets; i++) {
            active[i] = b->active[i] & (vto_int(b->u[i].z * (float)s->sun_count) == sun);
            any       = any || vany(active[i]);
        }
        if (!any)
            continue;
        direct_lamp(s, t->direct, scene_lamp_count(s) + sun, &one, of);
        for (int i = 0; i < b->packets; i++) {
            direct_pick *to = &t->lights[first + i];
            vmask lit       = active[i] & (of[i].light >= 0);
            to->wi          = vselect3(lit, of[i].wi, to->wi);
            to->e           = vselect3(lit, vscale(of[i].e, vsplat((float)s->sun_count)), to->e);
            to->dist        = vselect(lit, of[i].dist, to->dist);
            to->light       = vselect_int(lit, of[i].light, to->light);
        }
    }
}

static void ask(path_tracer *t, mirror_lights which, bool beginning)
{
    const scene *s = t->s;
    vsurface at[DIRECT_PACKETS];
    vsample4 u[DIRECT_PACKETS];
    vfloat chance[DIRECT_PACKETS];
    bent_ways w;
    int most = 0;
    for (int i = 0; i < s->mirror_images->image_count; i++)
        most = s->mirror_images->images[i].depth > most ? s->mirror_images->images[i].depth : most;
    for (int first = 0; first < packets_of(t); first += DIRECT_PACKETS) {
        int n = packets_of(t) - first < DIRECT_PACKETS ? packets_of(t) - first : DIRECT_PACKETS;
        for (int i = 0; i < n; i++) {
            int k = first + i;
            at[i] = t->at[k];
            u[i]  = path_numbers(t, k, which == MIRROR_SUNS ? OF_SUN_IMAGE : OF_IMAGE);
            choose(t, k, which, beginning, &u[i], &w.image[i], &chance[i], &at[i]);
        }
        direct_batch b = { .at         = at,
                           .active     = t->asked + first,
                           .u          = u,
                           .packets    = n,
                           .unshadowed = true,
                           .all_around = beginning && quantity_is_round(t->o->quantity),
                           .around     = !beginning && has_narrow(s) ? t->around + first : NULL };
        if (which == MIRROR_SUNS)
            pick_sun(t, &b, first);
        else
            direct_one(s, t->direct, &b, t->lights + first);
        set_out(t, first, n, &w);
        t->ray_count += follow_mirrors(t, n, most, &w);
        arrive(t, first, n, &w);
        for (int i = 0; i < n; i++)
            take(t, first + i, &w, i, chance[i], beginning, which == MIRROR_LAMPS);
    }
}

void path_ask_images(path_tracer *t, bool beginning)
{
    if (scene_lamp_count(t->s) + t->s->emitter_count > 0)
        ask(t, MIRROR_LAMPS, beginning);
    if (has_suns(t->s))
        ask(t, MIRROR_SUNS, beginning);
}
