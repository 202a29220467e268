/* materials/dielectric.c -- the smooth border of a solid of glass, water or the like.
 *
 * What the border reflects (materials/fresnel.h) is drawn as often as it is reflected; the rest is
 * refracted, and what of it passes is tinted. Inside, behind the front side, light fades by Beer's
 * law: of a way of d metres
 *
 *     exp(-sigma d)
 *
 * is left, which is reckoned at the end of the way that lies toward wo.
 *
 * Shadow rays do not bend. They pass each face with what it would let through of a ray that comes
 * from outside at the angle that they have to the normal: in a plate with plane faces that is what
 * the bent ray loses at both, and no ray that gets in is held back by total reflection as the
 * straight one would be.
 */
#include "materials/diffuse_light.h"
#include "materials/fresnel.h"
#include "materials/material_parts.h"

typedef struct dielectric {
    material base; /* look.color is the tint */
    float ior;
} dielectric;

static const dielectric *as_dielectric(const material *m)
{
    return (const dielectric *)(const void *)m;
}

static vfloat facing(const vshading *s)
{
    return vmin(vmax(vdot(s->wo, s->n), vsplat(0.0f)), vsplat(1.0f));
}

/* What is left of light after its way to here along wo. */
static vrgb left_inside(const material *m, const vshading *s)
{
    const float log2_e = 1.44269504f;
    vfloat way         = vmin(s->distance, vsplat(0x1p126f)) * log2_e; /* 0 * inf is no number */
    vrgb left          = { vexp2(-m->absorption.x * way), vexp2(-m->absorption.y * way),
                           vexp2(-m->absorption.z * way) };
    return vselect3(s->front, vspread((vec3){ 1, 1, 1 }), left);
}

static vfloat relative_index(const dielectric *d, const vshading *s)
{
    return vselect(s->front, vsplat(d->ior), vsplat(1.0f / d->ior));
}

static vmask dielectric_scatter(const material *self, const vshading *s, vfloat u, vfloat v,
                                vfloat pick, vmask active, vscatter *out)
{
    (void)u, (void)v;
    vfloat eta      = relative_index(as_dielectric(self), s);
    vfloat cos_i    = facing(s);
    vfresnel border = vfresnel_border(cos_i, eta);
    vmask mirrors   = pick < vunpolarised(border.reflected);

    vvec3 bent  = vrefracted(s, cos_i, border.cos_t, eta);
    vrgb tint   = look_color(self, s);
    vrgb left   = left_inside(self, s);
    vrgb passed = { left.x * tint.x, left.y * tint.y, left.z * tint.z };

    out->wi       = vkeep3(active, vselect3(mirrors, vmirrored(s), bent));
    out->weight   = vkeep3(active, vselect3(mirrors, left, passed));
    out->pdf      = vkeep(active, vsplat(INFINITY));
    out->bent     = active & ~mirrors;
    out->straight = (vmask){ 0 };
    return active;
}

static vrgb dielectric_through(const material *self, const vshading *s, vmask active)
{
    vfresnel border = vfresnel_border(facing(s), vsplat(as_dielectric(self)->ior));
    return vkeep3(active, vscale(look_color(self, s), vunpolarised(border.passed)));
}

static vrgb dielectric_albedo(const material *self, const vshading *s, vmask active)
{
    vfresnel border = vfresnel_border(facing(s), relative_index(as_dielectric(self), s));
    return vkeep3(active, vscale(left_inside(self, s), vunpolarised(border.reflected)));
}

/* Off its outside: within, light has come bent. */
static vrgb dielectric_mirrored(const material *self, const vshading *s, vmask active)
{
    return dielectric_albedo(self, s, active & s->front);
}

static const material_type dielectric_type = { .name     = "dielectric",
                                               .scatter  = dielectric_scatter,
                                               .through  = dielectric_through,
                                               .mirrored = dielectric_mirrored,
                                               .albedo   = dielectric_albedo };

static bool valid(const dielectric_desc *d, lux_error *err)
{
    static const char name[] = "dielectric material";
    vec3 absorption          = d->absorption;
    if (!(d->ior > 1.0f && d->ior <= 4.0f))
        return failed(err, ERR_ARGUMENT, "%s: an ior of %g is not in (1, 4]", name, (double)d->ior);
    if (!v3_nonnegative(absorption) || !isfinite(absorption.x + absorption.y + absorption.z))
        return failed(err, ERR_ARGUMENT, "%s: absorption %g %g %g is not >= 0 1/m", name,
                      (double)absorption.x, (double)absorption.y, (double)absorption.z);
    return share_valid(name, "tint", d->tint, err) && extra_valid(name, &d->extra, err);
}

const material *material_dielectric(arena *a, const dielectric_desc *d, lux_error *err)
{
    if (!valid(d, err))
        return NULL;
    dielectric *m = arena_new(a, dielectric, err);
    if (!m)
        return NULL;
    material_begin(&m->base, &dielectric_type, d->tint, &d->extra);
    m->ior                = d->ior;
    m->base.absorption    = d->absorption;
    m->base.solid         = true;
    m->base.reflectance   = diffuse_light_reflected(&m->base);
    m->base.transmittance = diffuse_light_through(&m->base);
    return &m->base;
}
