/* lights/cosine.c -- a point that shines by a power of the cosine, into one half of space.
 *
 *     I(a) = I0 cos^n a        [W/sr], a the angle to the axis, a < pi/2
 *
 * the directional source of Barladian et al. (2007). n = 0 fills the hemisphere evenly, n = 1 is a
 * small matt surface. It sends out 2 pi I0 / (n + 1) watts. A cosine is good to 2^-23, its power
 * to n times that.
 */
#include "core/color.h"
#include "core/warp.h"
#include "lights/light.h"

typedef struct cosine_light {
    light base;
    vec3 position, axis; /* m; unit */
    vec3 intensity;      /* W/sr, along the axis */
    float exponent;
    int whole; /* the exponent, if it is a whole number: products cost less than a power; else -1 */
} cosine_light;

static vfloat power_of(const cosine_light *l, vfloat cos_a)
{
    if (l->whole < 0)
        return vexp2(l->exponent * vlog2(cos_a)); /* of 0: 0 */
    vfloat power = vsplat(1.0f);
    for (int n = l->whole; n > 0; n >>= 1, cos_a *= cos_a)
        if (n & 1)
            power *= cos_a;
    return power;
}

static vmask cosine_sample(const light *self, const vvec3 *p, vfloat s, vfloat t, vmask active,
                           vlight_sample *out)
{
    const cosine_light *l = (const cosine_light *)self;
    (void)s, (void)t; /* there is but one place to draw */

    vvec3 to     = vsub(vspread(l->position), *p);
    vfloat dist2 = vdot(to, to);
    vfloat dist  = vsqrt(dist2);
    vfloat per_m = 1.0f / dist;
    vvec3 wi     = vscale(to, per_m);

    vfloat cos_a = -vdot(wi, vspread(l->axis));
    vmask ahead  = active & (dist2 > 0.0f) & (cos_a > 0.0f);
    vfloat share = power_of(l, vkeep(ahead, vmin(cos_a, vsplat(1.0f))));
    vmask lit    = ahead & (share > 0.0f);

    out->wi   = vkeep3(lit, wi);
    out->dist = vkeep(lit, dist);
    out->e    = vscale(vspread(l->intensity), vkeep(lit, share * per_m * per_m));
    out->pdf  = vkeep(lit, vsplat(INFINITY));
    return lit;
}

static vec3 cosine_flux(const light *self)
{
    const cosine_light *l = (const cosine_light *)self;
    return v3_scale(l->intensity, 2.0f * (float)M_PI / (l->exponent + 1.0f));
}

/* By intensity, the power n + 1 of the cosine is even. */
static vmask cosine_emit(const light *self, const light_target *to, vfloat s, vfloat t, vfloat u,
                         vfloat v, vmask active, vlight_ray *out)
{
    const cosine_light *l = (const cosine_light *)self;
    (void)to, (void)s, (void)t;
    vfloat cos_a   = vexp2(vlog2(1.0f - u) * (1.0f / (l->exponent + 1.0f)));
    out->origin    = vkeep3(active, vspread(l->position));
    out->direction = vkeep3(active, vwarp_about(vspread(l->axis), 1.0f - cos_a, v));
    out->flux      = vkeep3(active, vspread(cosine_flux(self)));
    return active;
}

static vec3 cosine_peak(const light *self, vec3 *toward)
{
    *toward = ((const cosine_light *)self)->axis;
    return ((const cosine_light *)self)->intensity;
}

static light_bounds cosine_bounds(const light *self)
{
    const cosine_light *l = (const cosine_light *)self;
    return (light_bounds){ .low        = l->position,
                           .high       = l->position,
                           .axis       = l->axis,
                           .cos_spread = 1.0f,
                           .cos_reach  = 0.0f,
                           .peak       = rgb_luminance(l->intensity) };
}

static const light_type cosine_type = { .name   = "cosine",
                                        .sample = cosine_sample,
                                        .emit   = cosine_emit,
                                        .flux   = cosine_flux,
                                        .peak   = cosine_peak,
                                        .bounds = cosine_bounds };

const light *light_cosine(arena *a, const cosine_desc *d, lux_error *err)
{
    float length = v3_length(d->aim);
    if (!(length > 0.0f && length < INFINITY))
        return failed(err, ERR_ARGUMENT, "cosine light: the aim has no length");
    if (!(d->exponent >= 0.0f && d->exponent <= 1e4f))
        return failed(err, ERR_ARGUMENT, "cosine light: an exponent of %g, wanted 0 to 10000",
                      (double)d->exponent);
    if (!v3_nonnegative(d->intensity))
        return failed(err, ERR_ARGUMENT, "cosine light: an intensity is not >= 0 W/sr");

    cosine_light *l = arena_new(a, cosine_light, err);
    if (!l)
        return NULL;
    l->base      = (light){ &cosine_type };
    l->position  = d->position;
    l->axis      = v3_scale(d->aim, 1.0f / length);
    l->intensity = d->intensity;
    l->exponent  = d->exponent;
    l->whole     = d->exponent == floorf(d->exponent) ? (int)d->exponent : -1;
    return &l->base;
}
