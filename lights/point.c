/* lights/point.c -- a light without extent: illuminance falls with the square of distance.
 *
 *     E = I / d^2        [W/m^2], I in W/sr, d in m, on a surface facing the light
 */
#include "core/color.h"
#include "core/warp.h"
#include "lights/light.h"

typedef struct point_light {
    light base;
    vec3 position;  /* m */
    vec3 intensity; /* W/sr */
} point_light;

static vmask point_sample(const light *self, const vvec3 *p, vfloat s, vfloat t, vmask active,
                          vlight_sample *out)
{
    const point_light *l = (const point_light *)self;
    (void)s, (void)t; /* there is but one place to draw */

    vvec3 to     = vsub(vspread(l->position), *p);
    vfloat dist2 = vdot(to, to);
    vfloat dist  = vsqrt(dist2);
    vmask lit    = active & (dist2 > 0.0f);

    out->wi   = vkeep3(lit, vscale(to, 1.0f / dist));
    out->dist = vkeep(lit, dist);
    out->e    = vscale(vspread(l->intensity), vkeep(lit, 1.0f / dist2));
    out->pdf  = vkeep(lit, vsplat(INFINITY));
    return lit;
}

static vmask point_emit(const light *self, const light_target *to, vfloat s, vfloat t, vfloat u,
                        vfloat v, vmask active, vlight_ray *out)
{
    const point_light *l = (const point_light *)self;
    (void)to, (void)s, (void)t;
    out->origin    = vkeep3(active, vspread(l->position));
    out->direction = vkeep3(active, vwarp_sphere(u, v));
    out->flux      = vkeep3(active, vspread(v3_scale(l->intensity, 4.0f * (float)M_PI)));
    return active;
}

static vec3 point_flux(const light *self)
{
    return v3_scale(((const point_light *)self)->intensity, 4.0f * (float)M_PI);
}

static light_bounds point_bounds(const light *self)
{
    const point_light *l = (const point_light *)self;
    return (light_bounds){ .low        = l->position,
                           .high       = l->position,
                           .axis       = { 0, 0, 1 },
                           .cos_spread = -1.0f,
                           .cos_reach  = -1.0f,
                           .peak       = rgb_luminance(l->intensity) };
}

static const light_type point_type = { .name   = "point",
                                       .sample = point_sample,
                                       .emit   = point_emit,
                                       .flux   = point_flux,
                                       .bounds = point_bounds };

const light *light_point(arena *a, const point_desc *d, lux_error *err)
{
    if (!v3_nonnegative(d->intensity))
        return failed(err, ERR_ARGUMENT, "point light: an intensity is not >= 0 W/sr");

    point_light *l = arena_new(a, point_light, err);
    if (!l)
        return NULL;
    l->base      = (light){ &point_type };
    l->position  = d->position;
    l->intensity = d->intensity;
    return &l->base;
}
