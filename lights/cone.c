/* lights/cone.c -- a point that shines into a cone, with a soft rim.
 *
 *     I(a) = I0 clamp((cos a - cos outer) / (cos inner - cos outer), 0, 1)^2        [W/sr]
 *
 * with a the angle to the axis: the ramp of KHR_lights_punctual (glTF). It sends out
 * 2 pi I0 ((1 - cos inner) + (cos inner - cos outer) / 3) watts. Drawn by intensity, the ramp in
 * the rim has the density 3 ramp^2: it is the cubic root of an even number.
 */
#include "core/color.h"
#include "core/warp.h"
#include "lights/light.h"

typedef struct cone_light {
    light base;
    vec3 position, axis;        /* m; unit */
    vec3 intensity;             /* W/sr */
    float cos_inner, cos_outer; /* cos_inner > cos_outer */
} cone_light;

static vmask cone_sample(const light *self, const vvec3 *p, vfloat s, vfloat t, vmask active,
                         vlight_sample *out)
{
    const cone_light *l = (const cone_light *)self;
    (void)s, (void)t; /* there is but one place to draw */

    vvec3 to     = vsub(vspread(l->position), *p);
    vfloat dist2 = vdot(to, to);
    vfloat dist  = vsqrt(dist2);
    vvec3 wi     = vscale(to, 1.0f / dist);

    /* How far inside the rim */
    vfloat cos_a = -vdot(wi, vspread(l->axis));
    vfloat ramp  = (cos_a - l->cos_outer) / (l->cos_inner - l->cos_outer);
    vfloat share = vmin(ramp * ramp, vsplat(1.0f));
    vmask lit    = active & (dist2 > 0.0f) & (ramp > 0.0f);

    out->wi   = vkeep3(lit, wi);
    out->dist = vkeep(lit, dist);
    out->e    = vscale(vspread(l->intensity), vkeep(lit, share / dist2));
    out->pdf  = vkeep(lit, vsplat(INFINITY));
    return lit;
}

static vec3 cone_flux(const light *self)
{
    const cone_light *l = (const cone_light *)self;
    float full          = 1.0f - l->cos_inner;
    float rim           = (l->cos_inner - l->cos_outer) / 3.0f;
    return v3_scale(l->intensity, 2.0f * (float)M_PI * (full + rim));
}

static vmask cone_emit(const light *self, const light_target *to, vfloat s, vfloat t, vfloat u,
                       vfloat v, vmask active, vlight_ray *out)
{
    const cone_light *l = (const cone_light *)self;
    (void)to, (void)s, (void)t;
    float inner = 1.0f - l->cos_inner;
    float outer = 1.0f - l->cos_outer;
    float rim   = (outer - inner) / 3.0f;

    vfloat at   = u * (inner + rim);
    vfloat even = vmin(vmax((at - inner) / rim, vsplat(0.0f)), vsplat(1.0f));
    vfloat ramp = vexp2(vlog2(even) * (1.0f / 3));
    vfloat less = vselect(at < inner, at, outer - ramp * (outer - inner));

    out->origin    = vkeep3(active, vspread(l->position));
    out->direction = vkeep3(active, vwarp_about(vspread(l->axis), less, v));
    out->flux      = vkeep3(active, vspread(cone_flux(self)));
    return active;
}

static vec3 cone_peak(const light *self, vec3 *toward)
{
    *toward = ((const cone_light *)self)->axis;
    return ((const cone_light *)self)->intensity;
}

static light_bounds cone_bounds(const light *self)
{
    const cone_light *l = (const cone_light *)self;
    return (light_bounds){ .low        = l->position,
                           .high       = l->position,
                           .axis       = l->axis,
                           .cos_spread = 1.0f,
                           .cos_reach  = l->cos_outer,
                           .peak       = rgb_luminance(l->intensity) };
}

static const light_type cone_type = { .name   = "cone",
                                      .sample = cone_sample,
                                      .emit   = cone_emit,
                                      .flux   = cone_flux,
                                      .peak   = cone_peak,
                                      .bounds = cone_bounds };

const light *light_cone(arena *a, const cone_desc *d, lux_error *err)
{
    float length = v3_length(d->aim);
    if (!(length > 0.0f && length < INFINITY))
        return failed(err, ERR_ARGUMENT, "cone light: the aim has no length");
    if (!(d->inner >= 0.0f && d->outer > d->inner && d->outer <= (float)M_PI))
        return failed(err, ERR_ARGUMENT,
                      "cone light: half angles %g and %g rad, wanted 0 <= inner "
                      "< outer <= pi",
                      (double)d->inner, (double)d->outer);
    if (!v3_nonnegative(d->intensity))
        return failed(err, ERR_ARGUMENT, "cone light: an intensity is not >= 0 W/sr");

    cone_light *l = arena_new(a, cone_light, err);
    if (!l)
        return NULL;
    l->base      = (light){ &cone_type };
    l->position  = d->position;
    l->axis      = v3_scale(d->aim, 1.0f / length);
    l->intensity = d->intensity;
    l->cos_inner = (float)cos((double)d->inner);
    l->cos_outer = (float)cos((double)d->outer);
    if (!(l->cos_inner > l->cos_outer)) /* a rim thinner than a float: the ramp stays finite */
        l->cos_outer = nextafterf(l->cos_inner, -2.0f);
    return &l->base;
}
