/* lights/parallel.c -- light of one direction and one strength: everywhere, or in a round beam.
 *
 * Everywhere, it comes from infinitely far away. A beam begins in the disk of its radius about
 * `at`, which it leaves squarely: a point is lit if it is in front of that disk and
 *
 *     |v - (v . a) a| <= radius,    v from `at` to the point, a the unit axis
 *
 * and what stands before the disk shadows it, but nothing behind. It carries pi radius^2 E watts.
 */
#include "core/color.h"
#include "core/packet_math.h"
#include "lights/light.h"

typedef struct parallel_light {
    light base;
    vec3 toward;     /* unit, from the lit point to the light */
    vec3 irradiance; /* W/m^2, square to it */
    vec3 at;         /* m, of a beam */
    float radius;    /* m, of a beam; else 0 */
} parallel_light;

static vmask parallel_sample(const light *self, const vvec3 *p, vfloat s, vfloat t, vmask active,
                             vlight_sample *out)
{
    const parallel_light *l = (const parallel_light *)self;
    (void)p, (void)s, (void)t; /* the same everywhere */

    out->wi   = vkeep3(active, vspread(l->toward));
    out->dist = vkeep(active, vsplat(INFINITY));
    out->e    = vkeep3(active, vspread(l->irradiance));
    out->pdf  = vkeep(active, vsplat(INFINITY));
    return active;
}

static vmask beam_sample(const light *self, const vvec3 *p, vfloat s, vfloat t, vmask active,
                         vlight_sample *out)
{
    const parallel_light *l = (const parallel_light *)self;
    (void)s, (void)t; /* there is but one place to draw */

    /* How far the point is from where the beam begins, and from the beam's middle */
    vvec3 toward = vspread(l->toward);
    vvec3 to     = vsub(vspread(l->at), *p);
    vfloat along = vdot(to, toward);
    vvec3 across = vsub(to, vscale(toward, along));
    vmask lit    = active & (along > 0.0f) & (vdot(across, across) <= l->radius * l->radius);

    out->wi   = vkeep3(lit, toward);
    out->dist = vkeep(lit, along);
    out->e    = vkeep3(lit, vspread(l->irradiance));
    out->pdf  = vkeep(lit, vsplat(INFINITY));
    return lit;
}

/* From an even place of the disk of that radius about `centre`, square to the light. */
static vmask emit_from_disk(const parallel_light *l, vvec3 centre, float radius, vfloat s, vfloat t,
                            vmask active, vlight_ray *out)
{
    vvec3 u, v, toward = vspread(l->toward);
    vfloat x, y;
    vframe(toward, &u, &v);
    vsquare_to_disk(s, t, &x, &y);
    vvec3 off = vadd(vscale(u, radius * x), vscale(v, radius * y));

    out->origin    = vkeep3(active, vadd(centre, off));
    out->direction = vkeep3(active, vneg(toward));
    out->flux = vkeep3(active, vspread(v3_scale(l->irradiance, (float)M_PI * radius * radius)));
    return active;
}

static vmask parallel_emit(const light *self, const light_target *to, vfloat s, vfloat t, vfloat u,
                           vfloat v, vmask active, vlight_ray *out)
{
    const parallel_light *l = (const parallel_light *)self;
    (void)u, (void)v; /* there is but one direction */
    vvec3 before = valong(vspread(to->centre), vspread(l->toward), vsplat(to->radius));
    return emit_from_disk(l, before, to->radius, s, t, active, out);
}

static vmask beam_emit(const light *self, const light_target *to, vfloat s, vfloat t, vfloat u,
                       vfloat v, vmask active, vlight_ray *out)
{
    const parallel_light *l = (const parallel_light *)self;
    (void)to, (void)u, (void)v;
    return emit_from_disk(l, vspread(l->at), l->radius, s, t, active, out);
}

static vec3 parallel_flux(const light *self)
{
    (void)self;
    return (vec3){ INFINITY, INFINITY, INFINITY };
}

static vec3 beam_flux(const light *self)
{
    const parallel_light *l = (const parallel_light *)self;
    return v3_scale(l->irradiance, (float)M_PI * l->radius * l->radius);
}

/* A beam's irradiance does not fall with distance, so that it too has no bound but this. */
static light_bounds parallel_bounds(const light *self)
{
    const parallel_light *l = (const parallel_light *)self;
    return (light_bounds){ .axis       = v3_scale(l->toward, -1.0f),
                           .cos_spread = 1.0f,
                           .cos_reach  = 1.0f,
                           .peak       = rgb_luminance(l->irradiance),
                           .far        = true };
}

static const light_type parallel_type = { .name   = "parallel",
                                          .sample = parallel_sample,
                                          .emit   = parallel_emit,
                                          .flux   = parallel_flux,
                                          .bounds = parallel_bounds };

static const light_type beam_type = { .name   = "parallel",
                                      .sample = beam_sample,
                                      .emit   = beam_emit,
                                      .flux   = beam_flux,
                                      .bounds = parallel_bounds };

const light *light_parallel(arena *a, const parallel_desc *d, lux_error *err)
{
    float length = v3_length(d->aim);
    if (!(length > 0.0f && length < INFINITY))
        return failed(err, ERR_ARGUMENT, "parallel light: the aim has no length");
    if (!v3_nonnegative(d->irradiance))
        return failed(err, ERR_ARGUMENT, "parallel light: an irradiance is not >= 0 W/m^2");

    if (!(d->radius >= 0.0f && d->radius < INFINITY))
        return failed(err, ERR_ARGUMENT, "parallel light: a radius of %g m, wanted >= 0",
                      (double)d->radius);

    parallel_light *l = arena_new(a, parallel_light, err);
    if (!l)
        return NULL;
    l->base       = (light){ d->radius > 0.0f ? &beam_type : &parallel_type };
    l->toward     = v3_scale(d->aim, -1.0f / length);
    l->irradiance = d->irradiance;
    l->at         = d->at;
    l->radius     = d->radius;
    return &l->base;
}
