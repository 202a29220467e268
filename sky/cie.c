/* sky/cie.c -- the CIE standard general sky (ISO 15469:2004 / CIE S 011/E:2003), the uniform one
 * and the traditional overcast one.
 *
 *     L / L_z = g(Z) f(chi) / (g(0) f(Z_s)),    g(Z)   = 1 + a exp(b / cos Z)
 *                                               f(chi) = 1 + c (exp(d chi) - exp(d pi/2))
 *                                                          + e cos^2 chi
 *
 * with the five numbers of each type below. The traditional overcast sky of Moon and Spencer 1942
 * is (1 + 2 cos Z) / 3 of its zenith, and gives 7 pi / 9 L_z to level ground.
 */
#include "core/color.h"
#include "sky/gradation.h"

#include <math.h>

enum { CIE_TYPES = 15 };

/* a, b of the gradation; c, d, e of the indicatrix */
static const double table[CIE_TYPES + 1][5] = {
    { 0, -1, 0, -1, 0 },           /* uniform */
    { 4, -0.7, 0, -1, 0 },         /* 1: overcast, steep gradation, alike all around */
    { 4, -0.7, 2, -1.5, 0.15 },    /* 2: overcast, steep, brighter toward the sun */
    { 1.1, -0.8, 0, -1, 0 },       /* 3: overcast, moderate gradation */
    { 1.1, -0.8, 2, -1.5, 0.15 },  /* 4: overcast, moderate, brighter toward the sun */
    { 0, -1, 0, -1, 0 },           /* 5: uniform */
    { 0, -1, 2, -1.5, 0.15 },      /* 6: partly cloudy, slightly brighter toward the sun */
    { 0, -1, 5, -2.5, 0.30 },      /* 7: partly cloudy, bright around the sun */
    { 0, -1, 10, -3, 0.45 },       /* 8: partly cloudy, a distinct corona */
    { -1, -0.55, 2, -1.5, 0.15 },  /* 9: partly cloudy, the sun hidden */
    { -1, -0.55, 5, -2.5, 0.30 },  /* 10: partly cloudy, bright around the sun */
    { -1, -0.55, 10, -3, 0.45 },   /* 11: white-blue, a distinct corona */
    { -1, -0.32, 10, -3, 0.45 },   /* 12: clear, little turbidity */
    { -1, -0.32, 16, -3, 0.30 },   /* 13: clear, polluted */
    { -1, -0.15, 16, -3, 0.30 },   /* 14: cloudless, turbid, a broad corona */
    { -1, -0.15, 24, -2.8, 0.15 }, /* 15: white-blue, turbid, a broad corona */
};

static gradation shape_of(int type)
{
    const double *t = table[type];
    return (gradation){ .a  = t[0],
                        .b  = t[1],
                        .f0 = 1.0 - t[2] * exp(t[3] * 0.5 * M_PI),
                        .c  = t[2],
                        .d  = t[3],
                        .e  = t[4] };
}

/* ---- the traditional overcast sky --------------------------------------------------------------
 */

typedef struct overcast_sky {
    sky base;
    vec3 third; /* W/(sr m^2): a third of the zenith's radiance */
} overcast_sky;

static vrgb overcast_radiance(const sky *self, const vvec3 *wi, vmask active)
{
    const overcast_sky *s = (const overcast_sky *)self;
    vmask up              = active & (wi->z >= 0.0f);
    return vscale(vspread(s->third), vkeep(up, 1.0f + 2.0f * wi->z));
}

static const sky_type overcast_type = { .name = "overcast", .radiance = overcast_radiance };

static const sky *traditional(arena *a, const cie_desc *d, lux_error *err)
{
    float luminance = rgb_luminance(d->color);
    if (!(d->horizontal >= 0.0 && d->horizontal <= 1e9))
        return failed(err, ERR_ARGUMENT, "overcast sky: %g W/m^2 on level ground, wanted 0 to 1e9",
                      d->horizontal);
    if (!v3_nonnegative(d->color) || !(fabsf(luminance - 1.0f) <= 1e-3f))
        return failed(err, ERR_ARGUMENT,
                      "overcast sky: a colour of the luminance %g, wanted 1 and none < 0",
                      (double)luminance);
    overcast_sky *s = arena_new(a, overcast_sky, err);
    if (!s)
        return NULL;
    s->base  = (sky){ .type       = &overcast_type,
                      .horizontal = v3_scale(d->color, (float)d->horizontal),
                      .columns    = 16,
                      .rows       = 64 };
    s->third = v3_scale(d->color, (float)(d->horizontal * (9.0 / (21.0 * M_PI))));
    return &s->base;
}

/* ---- all of them -------------------------------------------------------------------------------
 */

const sky *sky_cie(arena *a, const cie_desc *d, lux_error *err)
{
    if (d->type < 0 || d->type > SKY_TRADITIONAL)
        return failed(err, ERR_ARGUMENT, "CIE sky: type %d, wanted 1 to 15", d->type);
    if (d->type == SKY_TRADITIONAL)
        return traditional(a, d, err);
    gradation shape = shape_of(d->type);
    bool sun        = shape.c != 0.0;
    bool even       = !sun && shape.a == 0.0;
    return gradation_sky(a,
                         &(gradation_desc){ .what       = "CIE sky",
                                            .shape      = shape,
                                            .to_sun     = d->to_sun,
                                            .horizontal = d->horizontal,
                                            .color      = d->color,
                                            .columns    = even  ? 0
                                                          : sun ? 256
                                                                : 16,
                                            .rows       = even ? 0 : 128 },
                         err);
}

double sky_cie_zenith(int type, double sun_elevation_deg)
{
    if (type == SKY_TRADITIONAL)
        return 9.0 / (7.0 * M_PI);
    if (type < 0 || type > SKY_TRADITIONAL)
        return 0.0;
    gradation g       = shape_of(type);
    double elevation  = fmin(fmax(sun_elevation_deg, 0.0), 90.0);
    double sun_zenith = (90.0 - elevation) * (M_PI / 180.0);
    return gradation_at(&g, 0.0, sun_zenith) / gradation_irradiance(&g, sun_zenith);
}
