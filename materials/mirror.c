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

static const material_type mirror_type = {
    .name = "mirror", .scatter = mirror_scatter, .mirrored = mirror_albedo, .albedo = mirror_albedo
};

const material *material_mirror(arena *a, const mirror_desc *d, lux_error *err)
{
    return material_reflecting(a, &mirror_type, d->reflectance, &d->extra, err);
}
