/* sim/path_patch.c -- light of the patches that suns light through portals (sun_patch.h).
 *
 * Paths meet a patch seldom, and a bright strip of wall beside it as well. So where they stand, x,
 * a point y of each sun's patches is asked for light as a lamp would be, and one, z, that such a
 * point lights:
 *
 *     E(x) = f(x) c(x, y) L(y, x) c(y, x) / |x - y|^2 * area / c(y, w)
 *     E(x) = f(x) c(x, z) L(z, x) c(z, x) / |x - z|^2 * area
 *
 * with L what the point gives back toward x, and c cosines. The same light is found in three ways:
 *
 *     x -> z -> y    both by the path's own rays, of densities a(x, z), a(z, y)
 *     x -> z,  y     y asked for from z, drawn with density b(z)
 *     x,  z <- y     z asked for from x: y drawn with density b(x), z from y with a(y, z)
 *
 * each of which counts with the power heuristic of all three products of densities.
 */
#include "core/color.h"
#include "sim/path_parts.h"
#include "sim/sensor.h"
#include "sim/shading.h"

static vfloat squared(vfloat a) { return a * a; }

/* The cosine, with its sign, of a way that is not of unit length. */
static vfloat cosine_of(const vvec3 *way, vfloat distance2, const vvec3 *normal)
{
    return vdot(*way, *normal) / vsqrt(distance2);
}

/* Maps hold what patches of the second generation send on. */
static vmask asks_second(const path_tracer *t) { return t->indirect ? (vmask){ 0 } : ALL_LANES; }

vfloat path_onto(const path_tracer *t, int k, vmask active)
{
    vfloat pdf = load(t, PDF, k);
    active     = active & (pdf > 0.0f) & (pdf < INFINITY);
    if (has_hollow(t->s))
        active = active & ((t->does[k] & DOES_HOLLOW) == 0);
    vvec3 way        = vsub(t->at[k].position, load3(t, LEFT, k));
    vfloat distance2 = vdot(way, way);
    vfloat cosine    = vabs(cosine_of(&way, distance2, &t->at[k].normal));
    return vkeep(active & (distance2 > 0.0f), pdf * cosine / distance2);
}

vfloat path_patch_share(const path_tracer *t, int k, int sun, const vvec3 *wi, vmask active)
{
    const vfloat one  = vsplat(1.0f);
    const vsurface *y = &t->at[k];
    vfloat pdf        = load(t, PDF, k);
    active            = active & (path_onto(t, k, active) > 0.0f);
    if (!vany(active))
        return one;
    vvec3 z          = load3(t, LEFT, k);
    vvec3 way        = vsub(y->position, z);
    vfloat distance2 = vdot(way, way);
    vfloat from_y    = -cosine_of(&way, distance2, &y->normal);
    vfloat from_z    = vabs(vdot(way, load3(t, SIDE, k))) / vsqrt(distance2);
    vfloat to_sun    = vabs(vdot(*wi, y->normal));

    /* By their way of finding it: y asked for from z; z from where they were before */
    vfloat square = sun_patch_density(t->patches, sun, &z, &y->position, wi, active);
    vfloat asked  = square * to_sun * distance2 / (from_y * pdf);
    vfloat onto   = load(t, ONTO, k);
    vmask second  = active & (onto > 0.0f) & (vdot(*wi, y->normal) > 0.0f) & asks_second(t);
    vfloat other  = { 0 };
    if (vany(second)) {
        vvec3 x = load3(t, FARTHER, k);
        square  = sun_patch_density(t->patches, sun, &x, &y->position, wi, second);
        other   = square * to_sun * from_z * (1.0f / WARP_PI) / (pdf * onto);
    }
    vfloat all = one + squared(asked) + vkeep(second, squared(other));
    return vselect(active & (from_y > 0.0f), one / all, one);
}

/* L of a point toward x, against wi; where it is z, in *pdf the density with which a path from x
 * would go on to y. */
static vrgb given_back(const path_tracer *t, patch_generation which, const patch_point *y,
                       const vvec3 *wi, vfloat distance, vmask active, vfloat *pdf)
{
    const scene *s = t->s;
    vfloat cosine  = vdot(y->before, y->at.normal);
    if (sun_patches_matt(t->patches)) {
        *pdf = cosine * (1.0f / WARP_PI);
        return vkeep3(active & (vdot(*wi, y->at.normal) < 0.0f), y->light);
    }
    vhit hit     = y->hit;
    hit.distance = distance;
    hit.instance = vselect_int(active, hit.instance, vsplat_int(-1));
    vsurface at;
    vshading shading;
    scene_shade(s, &hit, wi, vsplat(0.0f), active, &at, &shading);
    vrgb f = materials_reflect(s->materials, at.material, &shading, &y->before, active, pdf);
    f      = vmul(f, y->light);
    return which == PATCH_FIRST ? f : vscale(f, 1.0f / cosine);
}

/* The light of a point that may be drawn by several portals, one behind the other, counts by the
 * balance heuristic. Where rounding has put it beside the portal, it is left to the paths. */
static vfloat by_portal(const patch_point *y, vfloat square)
{
    return vkeep(square > 0.0f, y->part / square);
}

/* How much of a point's light counts, and what it stands for: `pdf` is that of x toward it, `back`
 * its cosine toward x, `on` the density with which a path would go on from z to y. */
static vfloat count_first(const path_tracer *t, int k, int sun, const patch_point *y, vfloat pdf,
                          vfloat back, vfloat distance2, bool beginning, vmask active)
{
    const vsurface *z = &t->at[k];
    vvec3 way         = vsub(y->at.position, z->position);
    vfloat to_sun     = vabs(vdot(y->before, y->at.normal));
    vfloat square =
        sun_patch_density(t->patches, sun, &z->position, &y->at.position, &y->before, active);
    vfloat own   = pdf * back / (square * to_sun * distance2);
    vfloat onto  = beginning ? (vfloat){ 0 } : path_onto(t, k, active);
    vmask second = active & (onto > 0.0f) & (vdot(way, y->at.normal) < 0.0f) &
                   (vdot(y->before, y->at.normal) > 0.0f) & asks_second(t);
    vfloat other = { 0 };
    if (vany(second)) {
        vvec3 x       = load3(t, LEFT, k);
        vfloat far    = sun_patch_density(t->patches, sun, &x, &y->at.position, &y->before, second);
        vfloat from_z = vabs(cosine_of(&way, distance2, &z->normal));
        vfloat onto_z = back * (1.0f / WARP_PI) * from_z / distance2;
        other         = far / square * onto_z / onto;
    }
    vfloat share = 1.0f / (1.0f + squared(own) + vkeep(second, squared(other)));
    return share * by_portal(y, square) * y->area * back / (to_sun * distance2);
}

static vfloat count_second(const path_tracer *t, int k, int sun, const patch_point *z, vfloat pdf,
                           vfloat on, vfloat back, vfloat distance2, vmask active)
{
    const vvec3 *x = &t->at[k].position;
    vfloat to_z    = pdf * back / distance2;
    vfloat to_y    = on * z->patch_thin;
    vfloat square  = sun_patch_density(t->patches, sun, x, &z->patch, &z->to_sun, active);
    vfloat from_x  = square * z->patch_cos;
    vfloat from_z =
        sun_patch_density(t->patches, sun, &z->at.position, &z->patch, &z->to_sun, active) *
        z->patch_cos;
    vfloat this  = from_x * z->drawn;
    vfloat share = 1.0f / (1.0f + squared(to_z * to_y / this) + squared(to_z * from_z / this));
    return share * by_portal(z, square) * z->area * back / distance2;
}

/* Of several suns each is asked at one place of four, and counts as often more: but for patches
 * that a path's beginning sees, which are most of what is found. */
enum { TURNS = 4 };

/* What of a point's light would reach packet k, if nothing stands between, and the ray that is to
 * tell. */
static void connect(path_tracer *t, int k, int sun, patch_generation which, bool beginning,
                    const vsample4 *u)
{
    const vsurface *x = &t->at[k];
    bool in_turn      = sun_patch_suns(t->patches) > TURNS && !(beginning && which == PATCH_FIRST);
    vmask open        = beginning || !t->indirect ? ALL_LANES : ~t->ends[k];
    vmask asks        = t->asks[k] & open & (in_turn ? path_in_turn(t, k, sun, TURNS) : ALL_LANES);
    t->asked[k]       = (vmask){ 0 };
    if (!vany(asks))
        return;
    vint set  = vgather_int((const int32_t *)t->b->set, vload_int(t->id + k * LANES));
    vfloat u0 = which == PATCH_FIRST ? u->x : u->z, u1 = which == PATCH_FIRST ? u->y : u->w;
    patch_point y;
    vmask active = sun_patch_draw(t->patches, which, sun, set, &x->position, u0, u1, asks, &y);

    vvec3 way        = vsub(y.at.position, x->position);
    vfloat distance2 = vdot(way, way), distance = vsqrt(distance2);
    vvec3 wi     = vscale(way, 1.0f / distance);
    vfloat back  = vabs(vdot(wi, y.at.normal));
    vvec3 n      = path_horizon(t, k, beginning);
    vmask around = (n.x == 0.0f) & (n.y == 0.0f) & (n.z == 0.0f);
    active = active & (distance > 0.0f) & (back > 0.0f) & (around | (vdot(wi, x->normal) > 0.0f));
    if (!vany(active))
        return;

    vfloat pdf, on;
    vrgb worth   = path_worth(t, k, &wi, beginning, active, &pdf);
    vrgb given   = given_back(t, which, &y, &wi, distance, active, &on);
    vfloat count = which == PATCH_FIRST
                       ? count_first(t, k, sun, &y, pdf, back, distance2, beginning, active)
                       : count_second(t, k, sun, &y, pdf, on, back, distance2, active);
    vrgb found   = vkeep3(active, vscale(vmul(worth, given), in_turn ? count * TURNS : count));

    t->lights[k].e = found;
    t->asked[k]    = active & (vrgb_luminance(found) > 0.0f);
    t->rays[k]     = direct_shadow_ray(x, &wi, distance);
}

/* Light that has come through solids is left to paths, which find it bent. */
static void take(path_tracer *t, int k, const path_layer *of)
{
    vmask open = t->asked[k] & ~t->blocked[k];
    vrgb found = t->lights[k].e;
    if (has_hollow(t->s)) {
        open  = open & ~t->passed[k].solids;
        found = vmul(found, t->passed[k].share);
    }
    if (vany(open))
        path_add(t, k, open, (vmask){ 0 }, vkeep3(open, found), of);
}

void path_ask_patches(path_tracer *t, bool beginning)
{
    const scene *s = t->s;
    int n          = packets_of(t);
    vsample4 u[PACKETS]; /* of all suns alike */
    for (int k = 0; k < n; k++)
        u[k] = path_numbers(t, k, OF_PATCH);
    for (int i = 0; i < 2 * sun_patch_suns(t->patches); i++) {
        patch_generation which = i % 2 ? PATCH_SECOND : PATCH_FIRST;
        if (which == PATCH_SECOND && t->indirect)
            continue;
        int sun                 = sun_patch_sun(t->patches, i / 2);
        const scene_light *info = &s->light_info[scene_lamp_count(s) + sun];
        path_layer of           = { info->group, info->dimming, true, false };
        for (int k = 0; k < n; k++)
            connect(t, k, sun, which, beginning, &u[k]);
        t->ray_count += shadow_trace(s, t->rays, t->asked, t->nobody, n, RAYS_INCOHERENT,
                                     t->blocked, t->passed);
        for (int k = 0; k < n; k++)
            take(t, k, &of);
    }
}
