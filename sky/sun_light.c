/* sky/sun_light.c -- the sun as a lamp: a cone of even radiance, infinitely far away.
 *
 * Of a disk of the angular radius R, which gives a plane square to it e = pi L sin^2 R, samples are
 * even in solid angle: with (r, phi) an even place in the unit disk, 1 - cos theta = r^2 (1 - cos
 * R).
 *
 * A surface whose normal is at the angle t to the centre sees all of it where t <= pi/2 - R, and
 * gets e cos t. Where its horizon cuts the disk, of the rim the part within h of its highest place
 * is above, cos h = -cot t cot R, and Lambert's contour integral along that arc and back along the
 * horizon (which subtends 2 atan q) is
 *
 *     E = L (h cos t sin^2 R - sin t sin R cos R sin h + atan q),   q = tan R sin h sin t
 *       = e (h cos t + q - (q - atan q) / sin^2 R) / pi
 *
 * the second form without the difference of numbers that are near each other if R is small.
 */
#include "sky/sun_light.h"

#include "core/color.h"
#include "core/warp.h"

#include <math.h>

typedef struct sun_light {
    light base;
    vec3 axis, u, v;    /* unit: toward its centre, and across */
    vec3 irradiance;    /* W/m^2, square to it: e */
    vec3 radiance;      /* W/(sr m^2): L */
    float sin_r, cos_r; /* of the disk's angular radius */
    float versine;      /* 1 - cos R */
    float pdf, one_pdf; /* 1/sr; sr */
    float cut;          /* of L, sr: half a disk that stands on the horizon */
} sun_light;

static vmask sun_sample(const light *self, const vvec3 *p, vfloat s, vfloat t, vmask active,
                        vlight_sample *out)
{
    const sun_light *l = (const sun_light *)self;
    (void)p; /* the same everywhere */

    vfloat x, y;
    vsquare_to_disk(s, t, &x, &y);
    vfloat drop   = l->versine * (x * x + y * y);
    vfloat across = vsqrt(l->versine * (2.0f - drop)); /* sin theta / r */
    vvec3 wi      = vadd(vadd(vscale(vspread(l->u), across * x), vscale(vspread(l->v), across * y)),
                         vscale(vspread(l->axis), 1.0f - drop));

    out->wi   = vkeep3(active, wi);
    out->dist = vkeep(active, vsplat(INFINITY));
    out->e    = vscale(vspread(l->radiance), vkeep(active, vsplat(l->one_pdf)));
    out->pdf  = vkeep(active, vsplat(l->pdf));
    return active;
}

/* The chord from the centre's direction is at most that of the rim: |wi - axis|^2 <= 2 (1 - cos R).
 */
static vmask sun_hit(const light *self, const vvec3 *p, const vvec3 *wi, vmask active,
                     vlight_hit *out)
{
    const sun_light *l = (const sun_light *)self;
    (void)p;
    vvec3 chord   = vsub(*wi, vspread(l->axis));
    vmask met     = active & (vdot(chord, chord) <= 2.0f * l->versine);
    out->dist     = vkeep(met, vsplat(INFINITY));
    out->radiance = vkeep3(met, vspread(l->radiance));
    out->pdf      = vkeep(met, vsplat(l->pdf));
    return met;
}

/* q - atan(q) for q >= 0: by its series where the difference would cancel. */
static vfloat q_less_atan(vfloat q)
{
    vfloat q2     = q * q;
    vfloat series = q * q2 * (0.333333333f - q2 * (0.2f - q2 * (0.142857143f - q2 * 0.111111111f)));
    return vselect(q < 0.1f, series, q - vatan2(q, vsplat(1.0f)));
}

static vrgb sun_irradiance(const light *self, const vvec3 *p, const vvec3 *n, vmask active)
{
    const sun_light *l = (const sun_light *)self;
    (void)p;
    vvec3 axis   = vspread(l->axis);
    vfloat cos_t = vdot(*n, axis);
    vvec3 cross  = vcross(*n, axis);
    vfloat sin_t = vlength(cross);

    /* Where the horizon meets the rim */
    vfloat cos_h = -cos_t * l->cos_r / vmax(sin_t * l->sin_r, vsplat(1e-30f));
    cos_h        = vmin(vmax(cos_h, vsplat(-1.0f)), vsplat(1.0f));
    vfloat sin_h = vsqrt((1.0f - cos_h) * (1.0f + cos_h));
    vfloat q     = (l->sin_r / l->cos_r) * sin_h * sin_t;
    vfloat rest  = q_less_atan(q) * (1.0f / (l->sin_r * l->sin_r));
    vfloat cut   = 0.318309886f * (cos_t * vacos(cos_h) + (q - rest));
    cut          = vmin(vmax(cut, vsplat(0.0f)), vsplat(1.0f));

    vfloat seen = vselect(cos_t >= l->sin_r, cos_t, cut);
    vmask lit   = active & (cos_t > -l->sin_r);
    return vscale(vspread(l->irradiance), vkeep(lit, seen));
}

/* The cosine at the disk's highest place, a little above it: samples on the rim are rounded. */
static vfloat sun_weight(const light *self, const vvec3 *p, const vvec3 *n, vmask active)
{
    const float rounding = 2e-6f;
    const sun_light *l   = (const sun_light *)self;
    (void)p;
    vfloat cos_t = vdot(*n, vspread(l->axis));
    vfloat sin_t = vsqrt(vmax(1.0f - cos_t * cos_t, vsplat(0.0f)));
    vfloat top   = vselect(cos_t >= l->cos_r, vsplat(1.0f), cos_t * l->cos_r + sin_t * l->sin_r);
    return rgb_luminance(l->irradiance) * vkeep(active, vmax(top + rounding, vsplat(0.0f)));
}

/* Off only where the horizon cuts the disk: most where it halves it, by L times the integral of
 * cos over half a disk, R - sin R cos R. */
static vmask sun_as_point(const light *self, const vvec3 *p, vmask active, vlight_sample *out,
                          vfloat *error)
{
    const sun_light *l = (const sun_light *)self;
    (void)p;
    out->wi   = vkeep3(active, vspread(l->axis));
    out->dist = vkeep(active, vsplat(INFINITY));
    out->e    = vkeep3(active, vspread(l->irradiance));
    out->pdf  = vkeep(active, vsplat(INFINITY));
    *error    = vkeep(active, vsplat(rgb_luminance(l->radiance) * l->cut));
    return active;
}

/* Rays of one direction w carry L pi r^2 dw through the target's sphere. */
static vmask sun_emit(const light *self, const light_target *to, vfloat s, vfloat t, vfloat u,
                      vfloat v, vmask active, vlight_ray *out)
{
    const sun_light *l = (const sun_light *)self;
    float r            = to->radius;
    vlight_sample from;
    sun_sample(self, NULL, u, v, active, &from);

    vvec3 across, up;
    vfloat x, y;
    vframe(from.wi, &across, &up);
    vsquare_to_disk(s, t, &x, &y);
    vvec3 off = vadd(vadd(vscale(across, x), vscale(up, y)), from.wi);

    out->origin    = vkeep3(active, valong(vspread(to->centre), off, vsplat(r)));
    out->direction = vneg(from.wi);
    out->flux = vscale(vspread(l->radiance), vkeep(active, vsplat(l->one_pdf * WARP_PI * r * r)));
    return active;
}

static vec3 sun_flux(const light *self)
{
    (void)self;
    return (vec3){ INFINITY, INFINITY, INFINITY };
}

static light_bounds sun_bounds(const light *self)
{
    const sun_light *l = (const sun_light *)self;
    return (light_bounds){ .axis       = v3_scale(l->axis, -1.0f),
                           .cos_spread = 1.0f,
                           .cos_reach  = l->cos_r,
                           .peak       = rgb_luminance(l->irradiance),
                           .far        = true };
}

static const light_type sun_type = { .name       = "sun",
                                     .sample     = sun_sample,
                                     .hit        = sun_hit,
                                     .irradiance = sun_irradiance,
                                     .weight     = sun_weight,
                                     .as_point   = sun_as_point,
                                     .emit       = sun_emit,
                                     .flux       = sun_flux,
                                     .bounds     = sun_bounds };

const light *light_sun(arena *a, const sun_light_desc *d, lux_error *err)
{
    float length = v3_length(d->to_sun);
    if (!(length > 0.0f && length < INFINITY))
        return failed(err, ERR_ARGUMENT, "sun: the direction to it has no length");
    if (!v3_nonnegative(d->irradiance) ||
        !(d->irradiance.x + d->irradiance.y + d->irradiance.z < INFINITY))
        return failed(err, ERR_ARGUMENT, "sun: an irradiance is not >= 0 W/m^2");
    if (!(d->diameter_deg >= 1e-3 && d->diameter_deg <= 60.0))
        return failed(err, ERR_ARGUMENT, "sun: a diameter of %g degrees, wanted 0.001 to 60",
                      d->diameter_deg);
    sun_light *l = arena_new(a, sun_light, err);
    if (!l)
        return NULL;

    double radius  = 0.5 * d->diameter_deg * (M_PI / 180.0);
    double half    = sin(0.5 * radius);
    double versine = 2.0 * half * half;
    double sr      = 2.0 * M_PI * versine;
    l->base        = (light){ &sun_type };
    l->axis        = v3_scale(d->to_sun, 1.0f / length);
    l->irradiance  = d->irradiance;
    l->radiance    = v3_scale(d->irradiance, (float)(1.0 / (M_PI * sin(radius) * sin(radius))));
    l->sin_r       = (float)sin(radius);
    l->cos_r       = (float)cos(radius);
    l->versine     = (float)versine;
    l->pdf         = (float)(1.0 / sr);
    l->one_pdf     = (float)sr;
    l->cut         = (float)(radius - sin(radius) * cos(radius));
    v3_frame(l->axis, &l->u, &l->v);
    return &l->base;
}
