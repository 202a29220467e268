/* sim/path_patch.c -- light of the patches that suns light through portals (sun_patch.h).
 *
 * Paths meet a patch seldom. So where they stand, x, a point y of each sun's patches is asked for
 * light as a lamp would be:
 *
 *     E(x) = f(x) c(x, y) L(y, x) c(y, x) / |x - y|^2 * area / c(y, w)
 *
 * with L what y gives back toward x of the sunlight from w, and c cosines. What paths find in
 * patches by themselves counts with the power heuristic of both densities, so that neither a patch
 * close by nor one that no portal lights costs more than noise.
 */
#include "core/color.h"
#include "sim/path_parts.h"
#include "sim/sensor.h"
#include "sim/shading.h"

void path_use_patches(path_tracer *t, const sun_patches *patches) { t->patches = patches; }

/* The density, 1/sr, by which y is drawn from x: `cosine` of y toward the sun, `back` of y toward
 * x.
 */
static vfloat by_direction(vfloat square, vfloat cosine, vfloat back, vfloat distance2)
{
    return square * cosine * distance2 / back;
}

vfloat path_patch_pdf(const path_tracer *t, int k, int sun, const vvec3 *wi, vmask active)
{
    if (t->s->hollow)
        active = active & ((t->does[k] & DOES_HOLLOW) == 0);
    if (!vany(active))
        return (vfloat){ 0 };
    const vsurface *y = &t->at[k];
    vvec3 x           = load3(t, LEFT, k);
    vvec3 way         = vsub(y->position, x);
    vfloat distance2  = vdot(way, way);
    vfloat to_sun     = vabs(vdot(*wi, y->normal));
    vfloat to_x       = vabs(vdot(way, y->normal)) / vsqrt(distance2);
    vfloat square     = sun_patch_density(t->patches, sun, &x, &y->position, wi, active);
    return vkeep(active & (to_x > 0.0f), by_direction(square, to_sun, to_x, distance2));
}

/* What y gives back toward x, against wi. */
static vrgb given_back(const path_tracer *t, const patch_point *y, const vvec3 *wi, vfloat distance,
                       vmask active)
{
    const scene *s = t->s;
    if (!s->narrow && !s->textured && !s->smooth)
        return vkeep3(active & (vdot(*wi, y->at.normal) < 0.0f), y->radiance);
    vhit hit     = y->hit;
    hit.distance = distance;
    hit.instance = vselect_int(active, hit.instance, vsplat_int(-1));
    vsurface at;
    vshading shading;
    scene_shade(s, &hit, wi, vsplat(0.0f), active, &at, &shading);
    vrgb f = materials_reflect(s->materials, at.material, &shading, &y->to_sun, active, NULL);
    return vmul(f, y->e);
}

/* What of a patch's light would reach packet k, if nothing stands between, and the ray that is to
 * tell. */
static void connect(path_tracer *t, int k, int sun, bool beginning)
{
    const vsurface *x = &t->at[k];
    vint set          = vgather_int((const int32_t *)t->b->set, vload_int(t->id + k * LANES));
    vsample4 u        = path_numbers(t, k, OF_PATCH + ((uint32_t)sun << 16));
    patch_point y;
    vmask active = sun_patch_draw(t->patches, sun, set, &x->position, u.x, u.y, t->asks[k], &y);

    vvec3 way       = vsub(y.at.position, x->position);
    vfloat distance = vlength(way);
    vvec3 wi        = vscale(way, 1.0f / distance);
    vfloat to_x     = vabs(vdot(wi, y.at.normal));
    vfloat to_sun   = vabs(vdot(y.to_sun, y.at.normal));
    vvec3 n         = path_horizon(t, k, beginning);
    vmask around    = (n.x == 0.0f) & (n.y == 0.0f) & (n.z == 0.0f);
    active          = active & (distance > 0.0f) & (to_x > 0.0f) & (to_sun > 0.0f) &
             (around | (vdot(wi, x->normal) > 0.0f));
    t->asked[k] = (vmask){ 0 };
    if (!vany(active))
        return;

    vfloat pdf;
    vrgb worth = path_worth(t, k, &wi, beginning, active, &pdf);
    vrgb back  = given_back(t, &y, &wi, distance, active);
    vfloat square =
        sun_patch_density(t->patches, sun, &x->position, &y.at.position, &y.to_sun, active);
    vfloat other    = by_direction(square, to_sun, to_x, distance * distance);
    vfloat count    = power_heuristic(other, pdf) * y.area * to_x / (to_sun * distance * distance);
    vrgb found      = vkeep3(active, vscale(vmul(worth, back), count));
    t->lights[k].e  = found;
    t->lights[k].wi = wi;
    t->asked[k]     = active & (vrgb_luminance(found) > 0.0f);
    t->rays[k]      = direct_shadow_ray(x, &wi, distance);
}

/* Light that has come through solids is left to paths, which find it bent. */
static void take(path_tracer *t, int k, const path_layer *of)
{
    vmask open = t->asked[k] & ~t->blocked[k];
    vrgb found = t->lights[k].e;
    if (t->s->hollow) {
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
    for (int i = 0; i < sun_patch_suns(t->patches); i++) {
        int sun                 = sun_patch_sun(t->patches, i);
        const scene_light *info = &s->light_info[scene_lamp_count(s) + sun];
        path_layer of           = { info->group, info->dimming, true, false };
        for (int k = 0; k < n; k++)
            connect(t, k, sun, beginning);
        t->ray_count += shadow_trace(s, t->rays, t->asked, t->nobody, n, RAYS_INCOHERENT,
                                     t->blocked, t->passed);
        for (int k = 0; k < n; k++)
            take(t, k, &of);
    }
}
