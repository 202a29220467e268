/* materials/material.c -- packets of several materials: those lanes that agree go together. Holes
 * are dealt with here, so that no kind of material needs to know of them. */
#include "materials/material_parts.h"

#include <stdio.h>

static vrgb join(vrgb a, vrgb b) { return vadd(a, b); } /* of disjoint lanes, zero elsewhere */

/* ---- holes ----------------------------------------------------------------------------------- */

static bool has_holes(const material *m)
{
    return HAS_MIRRORS &&
           (m->look.openness > 0.0f || (has_textures(m) && m->textures->alpha != ALPHA_OPAQUE));
}

static vfloat openness_of(const material *m, const vshading *s)
{
    return has_textures(m) ? s->look.openness : vsplat(m->look.openness);
}

/* As often as there is a hole the path goes on through it. */
static vmask scatter_one(const material *m, const vshading *s, vfloat u, vfloat v, vfloat pick,
                         vmask active, vscatter *out)
{
    if (!has_holes(m))
        return m->type->scatter(m, s, u, v, pick, active, out);
    vfloat open  = openness_of(m, s);
    vmask passes = active & (pick < open);
    vfloat rest  = vmax((pick - open) / (1.0f - open), vsplat(0.0f));
    vmask goes   = m->type->scatter(m, s, u, v, rest, active & ~passes, out);
    out->wi      = vselect3(passes, vneg(s->wo), out->wi);
    out->weight  = vselect3(passes, vspread((vec3){ 1, 1, 1 }), out->weight);
    out->pdf     = vselect(passes, vsplat(INFINITY), out->pdf * (1.0f - open));
    out->straight |= passes;
    return goes | passes;
}

static vrgb reflect_one(const material *m, const vshading *s, const vvec3 *wi, vmask active,
                        vfloat *pdf)
{
    if (!m->type->reflect) {
        if (pdf)
            *pdf = vsplat(0.0f);
        return (vrgb){ 0 };
    }
    vrgb f = m->type->reflect(m, s, wi, active, pdf);
    if (!has_holes(m))
        return f;
    vfloat there = 1.0f - openness_of(m, s);
    if (pdf)
        *pdf = *pdf * there;
    return vscale(f, there);
}

static vrgb through_one(const material *m, const vshading *s, vmask active)
{
    vrgb straight = m->type->through ? m->type->through(m, s, active) : (vrgb){ 0 };
    if (!has_holes(m))
        return straight;
    vfloat open = openness_of(m, s);
    vvec3 whole = { open, open, open };
    return vkeep3(active, vadd(whole, vscale(straight, 1.0f - open)));
}

static vrgb albedo_one(const material *m, const vshading *s, vmask active)
{
    vrgb back = m->type->albedo(m, s, active);
    return has_holes(m) ? vkeep3(active, vscale(back, 1.0f - openness_of(m, s))) : back;
}

static vrgb mirrored_one(const material *m, const vshading *s, vmask active)
{
    if (!m->type->mirrored)
        return (vrgb){ 0 };
    vrgb back = m->type->mirrored(m, s, active);
    return has_holes(m) ? vkeep3(active, vscale(back, 1.0f - openness_of(m, s))) : back;
}

static vrgb emission_one(const material *m, const vshading *s, vmask active)
{
    vrgb glow = has_textures(m) ? s->look.emission : vspread(m->look.emission);
    if (has_holes(m))
        glow = vscale(glow, 1.0f - openness_of(m, s));
    return vkeep3(active, glow);
}

/* ---- packets --------------------------------------------------------------------------------- */

vmask materials_scatter(const material *const *all, vint index, const vshading *s, vfloat u,
                        vfloat v, vfloat pick, vmask active, vscatter *out)
{
    *out       = (vscatter){ 0 };
    vmask goes = { 0 };
    while (vany(active)) {
        int m;
        vmask same = vtake_same(index, &active, &m);
        vscatter part;
        goes        = goes | scatter_one(all[m], s, u, v, pick, same, &part);
        out->wi     = join(out->wi, part.wi);
        out->weight = join(out->weight, part.weight);
        out->pdf    = out->pdf + part.pdf;
        out->straight |= part.straight;
        out->bent |= part.bent;
    }
    return goes;
}

vrgb materials_reflect(const material *const *all, vint index, const vshading *s, const vvec3 *wi,
                       vmask active, vfloat *pdf)
{
    vrgb sum = { 0 };
    if (pdf)
        *pdf = vsplat(0.0f);
    while (vany(active)) {
        int m;
        vfloat part;
        vmask same = vtake_same(index, &active, &m);
        sum        = join(sum, reflect_one(all[m], s, wi, same, pdf ? &part : NULL));
        if (pdf)
            *pdf = *pdf + part;
    }
    return sum;
}

/* One of the above, of each lane's own material. */
#define EACH_MATERIAL(name, one)                                                                   \
    vrgb name(const material *const *all, vint index, const vshading *s, vmask active)             \
    {                                                                                              \
        vrgb sum = { 0 };                                                                          \
        while (vany(active)) {                                                                     \
            int m;                                                                                 \
            vmask same = vtake_same(index, &active, &m);                                           \
            sum        = join(sum, one(all[m], s, same));                                          \
        }                                                                                          \
        return sum;                                                                                \
    }
EACH_MATERIAL(materials_through, through_one)
EACH_MATERIAL(materials_mirrored, mirrored_one)
EACH_MATERIAL(materials_albedo, albedo_one)
EACH_MATERIAL(materials_emission, emission_one)

vrgb materials_reflectance(const material *const *all, vint index, vmask active)
{
    vrgb sum = { 0 };
    while (vany(active)) {
        int m;
        vmask same = vtake_same(index, &active, &m);
        sum        = join(sum, vkeep3(same, vspread(all[m]->reflectance)));
    }
    return sum;
}

/* ---- for makers ------------------------------------------------------------------------------ */

bool share_valid(const char *material_name, const char *what, vec3 share, lux_error *err)
{
    if (v3_nonnegative(share) && share.x <= 1 && share.y <= 1 && share.z <= 1)
        return true;
    return failed(err, ERR_ARGUMENT, "%s: %s %g %g %g is not in [0, 1]", material_name, what,
                  (double)share.x, (double)share.y, (double)share.z);
}

bool extra_valid(const char *material_name, const material_extra *extra, lux_error *err)
{
    if (!v3_nonnegative(extra->emission))
        return failed(err, ERR_ARGUMENT, "%s: an emission is not >= 0 W/(sr m^2)", material_name);
    if (!(extra->openness >= 0.0f && extra->openness <= 1.0f))
        return failed(err, ERR_ARGUMENT, "%s: an openness of %g is not in [0, 1]", material_name,
                      (double)extra->openness);
    return true;
}

void material_begin(material *m, const material_type *type, vec3 color, const material_extra *extra)
{
    m->type     = type;
    m->textures = extra->textures;
    m->look     = (material_look){ .color           = color,
                                   .emission        = extra->emission,
                                   .specular        = { 1, 1, 1 },
                                   .openness        = extra->openness,
                                   .metallic        = 1.0f,
                                   .roughness       = 1.0f,
                                   .transmission    = 1.0f,
                                   .specular_weight = 1.0f };
}

material *material_reflecting(arena *a, const material_type *type, vec3 reflectance,
                              const material_extra *extra, lux_error *err)
{
    char name[64];
    snprintf(name, sizeof name, "%s material", type->name);
    if (!share_valid(name, "reflectance", reflectance, err) || !extra_valid(name, extra, err))
        return NULL;
    material *m = arena_new(a, material, err);
    if (!m)
        return NULL;
    material_begin(m, type, reflectance, extra);
    m->reflectance = v3_mul(reflectance, textures_mean_color(extra->textures));
    return m;
}
