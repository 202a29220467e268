/* lights/parallel.c -- light from so far away that it has one direction and one strength. */
#include "core/color.h"
#include "lights/light.h"

typedef struct parallel_light {
    light base;
    vec3 toward;     /* unit, from the lit point to the light */
    vec3 irradiance; /* W/m^2, square to it */
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

static vec3 parallel_flux(const light *self)
{
    (void)self;
    return (vec3){ INFINITY, INFINITY, INFINITY };
}

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
                                          .flux   = parallel_flux,
                                          .bounds = parallel_bounds };

const light *light_parallel(arena *a, const parallel_desc *d, lux_error *err)
{
    float length = v3_length(d->aim);
    if (!(length > 0.0f && length < INFINITY))
        return failed(err, ERR_ARGUMENT, "parallel light: the aim has no length");
    if (!v3_nonnegative(d->irradiance))
        return failed(err, ERR_ARGUMENT, "parallel light: an irradiance is not >= 0 W/m^2");

    parallel_light *l = arena_new(a, parallel_light, err);
    if (!l)
        return NULL;
    l->base       = (light){ &parallel_type };
    l->toward     = v3_scale(d->aim, -1.0f / length);
    l->irradiance = d->irradiance;
    return &l->base;
}
