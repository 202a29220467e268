/* materials/diffuse.c -- the ideal matt surface: equally bright from everywhere (Lambert).
 *
 *     f = rho / pi        [1/sr]
 *
 * Directions are drawn in proportion to the cosine, pdf = cos / pi, so that the weight is rho.
 */
#include "core/warp.h"
#include "materials/material_parts.h"

static vmask diffuse_scatter(const material *self, const vshading *s, vfloat u, vfloat v,
                             vfloat pick, vmask active, vscatter *out)
{
    (void)pick;
    vvec3 wi      = vwarp_cosine_about(s->n, u, v);
    vfloat cosine = vdot(wi, s->n);
    vmask goes    = active & (cosine > 0.0f); /* at the rim of the square it may not be */
    out->wi       = vkeep3(goes, wi);
    out->weight   = vkeep3(goes, look_color(self, s));
    out->pdf      = vkeep(goes, vwarp_cosine_pdf(cosine));
    out->straight = out->bent = (vmask){ 0 };
    return goes;
}

static vrgb diffuse_reflect(const material *self, const vshading *s, const vvec3 *wi, vmask active,
                            vfloat *pdf)
{
    vfloat cosine = vdot(*wi, s->n);
    vmask lit     = active & (cosine > 0.0f);
    if (pdf)
        *pdf = vkeep(lit, vwarp_cosine_pdf(cosine));
    return vkeep3(lit, vscale(look_color(self, s), 0.318309886f * cosine));
}

static vrgb diffuse_albedo(const material *self, const vshading *s, vmask active)
{
    return vkeep3(active, look_color(self, s));
}

static const material_type diffuse_type = { .name    = "diffuse",
                                            .scatter = diffuse_scatter,
                                            .reflect = diffuse_reflect,
                                            .albedo  = diffuse_albedo };

const material *material_diffuse(arena *a, const diffuse_desc *d, lux_error *err)
{
    material *m = material_reflecting(a, &diffuse_type, d->reflectance, &d->extra, err);
    if (m)
        m->matt = true;
    return m;
}
