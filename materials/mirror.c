/* materials/mirror.c -- a mirror that gives back the same share at all angles. */
#include "materials/fresnel.h"
#include "materials/material_parts.h"

static vmask mirror_scatter(const material *self, const vshading *s, vfloat u, vfloat v,
                            vfloat pick, vmask active, vscatter *out)
{
    (void)u, (void)v, (void)pick;
    out->wi       = vkeep3(active, vmirrored(s));
    out->weight   = vkeep3(active, look_color(self, s));
    out->pdf      = vkeep(active, vsplat(INFINITY));
    out->straight = out->bent = (vmask){ 0 };
    return active;
}

static vrgb mirror_albedo(const material *self, const vshading *s, vmask active)
{
    return vkeep3(active, look_color(self, s));
}

static const material_type mirror_type = { .name    = "mirror",
                                           .scatter = mirror_scatter,
                                           .albedo  = mirror_albedo };

const material *material_mirror(arena *a, const mirror_desc *d, lux_error *err)
{
    static const char name[] = "mirror material";
    if (!share_valid(name, "reflectance", d->reflectance, err) ||
        !extra_valid(name, &d->extra, err))
        return NULL;
    material *m = arena_new(a, material, err);
    if (!m)
        return NULL;
    material_begin(m, &mirror_type, d->reflectance, &d->extra);
    m->reflectance = v3_mul(d->reflectance, textures_mean_color(d->extra.textures));
    return m;
}
