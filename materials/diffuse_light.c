/* materials/diffuse_light.c -- see diffuse_light.h. With c = x^4 the steps are narrow near grazing,
 * where glass changes most: rho = 8 integral of a x^7 dx, by the midpoints of 1024 steps. */
#include "materials/diffuse_light.h"

#include "materials/material_parts.h"

enum { STEPS = 1024 };

static vlook mean_look(const material *m)
{
    vlook look = look_plain(m);
    look.color = vspread(v3_mul(m->look.color, textures_mean_color(m->textures)));
    return look;
}

static vec3 mean(const material *m, vrgb (*share)(const material *, const vshading *, vmask))
{
    double sum[3] = { 0 };
    vvec3 up      = vspread((vec3){ 0, 0, 1 });
    for (int i = 0; i < STEPS; i += LANES) {
        vfloat x = (vto_float(vlane_index() + i) + 0.5f) / STEPS;
        vfloat c = x * x * x * x;

        vshading s   = { .wo       = { vsqrt(1.0f - c * c), vsplat(0.0f), c },
                         .n        = up,
                         .flat     = up,
                         .front    = ALL_LANES,
                         .distance = vsplat(1.0f),
                         .look     = mean_look(m) };
        vrgb a       = share(m, &s, ALL_LANES);
        vfloat width = 8.0f / STEPS * x * x * x * c;
        for (int k = 0; k < LANES; k++) {
            double w = (double)lane(width, k);
            sum[0] += w * (double)lane(a.x, k);
            sum[1] += w * (double)lane(a.y, k);
            sum[2] += w * (double)lane(a.z, k);
        }
    }
    return (vec3){ (float)fmin(sum[0], 1.0), (float)fmin(sum[1], 1.0), (float)fmin(sum[2], 1.0) };
}

vec3 diffuse_light_reflected(const material *m) { return mean(m, m->type->albedo); }

vec3 diffuse_light_through(const material *m)
{
    return m->type->through ? mean(m, m->type->through) : (vec3){ 0, 0, 0 };
}
