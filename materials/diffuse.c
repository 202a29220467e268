/* materials/diffuse.c -- the ideal matt surface: equally bright from everywhere (Lambert).
 *
 *     f = rho / pi        [1/sr]
 *
 * Directions are drawn in proportion to the cosine, pdf = cos / pi, so that the weight is rho.
 */
#include "core/warp.h"
#include "materials/material.h"

typedef struct diffuse {
    material base;
    vec3 reflectance; /* [0, 1] */
} diffuse;

static vmask diffuse_scatter(const material *self, const vvec3 *wo, const vvec3 *n, vfloat s,
                             vfloat t, vmask active, vscatter *out)
{
    (void)wo;
    out->wi     = vkeep3(active, vwarp_cosine_about(*n, s, t));
    out->weight = vkeep3(active, vspread(((const diffuse *)self)->reflectance));
    return active;
}

static vrgb diffuse_reflect(const material *self, const vvec3 *wo, const vvec3 *wi, const vvec3 *n,
                            vmask active)
{
    (void)wo;
    vfloat cosine = vdot(*wi, *n);
    vmask lit     = active & (cosine > 0.0f);
    vrgb rho      = vspread(((const diffuse *)self)->reflectance);
    return vkeep3(lit, vscale(rho, 0.318309886f * cosine));
}

static vfloat diffuse_pdf(const material *self, const vvec3 *wo, const vvec3 *wi, const vvec3 *n,
                          vmask active)
{
    (void)self, (void)wo;
    return vkeep(active, vwarp_cosine_pdf(vdot(*wi, *n)));
}

static vec3 diffuse_albedo(const material *self) { return ((const diffuse *)self)->reflectance; }

static const material_type diffuse_type = { .name    = "diffuse",
                                            .scatter = diffuse_scatter,
                                            .reflect = diffuse_reflect,
                                            .pdf     = diffuse_pdf,
                                            .albedo  = diffuse_albedo };

const material *material_diffuse(arena *a, const diffuse_desc *d, lux_error *err)
{
    vec3 r = d->reflectance;
    if (!(v3_nonnegative(r) && r.x <= 1 && r.y <= 1 && r.z <= 1))
        return failed(err, ERR_ARGUMENT, "diffuse material: reflectance %g %g %g is not in [0, 1]",
                      (double)r.x, (double)r.y, (double)r.z);
    if (!v3_nonnegative(d->emission))
        return failed(err, ERR_ARGUMENT, "diffuse material: an emission is not >= 0 W/(sr m^2)");

    diffuse *m = arena_new(a, diffuse, err);
    if (!m)
        return NULL;
    m->base        = (material){ &diffuse_type, d->emission };
    m->reflectance = r;
    return &m->base;
}
