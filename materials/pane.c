/* materials/pane.c -- a thin pane of clear glass as one surface (materials/fresnel.h: the slab).
 *
 * A pane is told by what it lets through as a whole at normal incidence, T. What of the light is
 * left after one way through its inside, a, then follows from T = e^2 a / (1 - r^2 a^2), where
 * r = ((n - 1) / (n + 1))^2 and e = 1 - r:
 *
 *     a = 2 T / (e^2 + sqrt(e^4 + 4 r^2 T^2))
 *
 * At other angles the way is longer, a^(1 / cos t). Light goes on straight, for the shift by the
 * pane's thickness is small where panes are taken for surfaces.
 */
#include "materials/diffuse_light.h"
#include "materials/fresnel.h"
#include "materials/material_parts.h"

typedef struct pane {
    material base; /* look.color, white but for textures, tints what passes */
    float ior;
    vec3 log2_inner; /* log2 of a, [-inf, 0] */
    bool box;
} pane;

static const pane *as_pane(const material *m) { return (const pane *)(const void *)m; }

typedef struct vpane {
    vrgb passed, reflected;
} vpane;

static vpane pane_at(const material *self, const vshading *s, vmask active)
{
    /* At grazing incidence itself nothing passes, which would be 0 / 0 */
    const float grazing = 0x1p-30f;
    const pane *p       = as_pane(self);
    vfloat cos_i        = vmin(vmax(vdot(s->wo, s->n), vsplat(grazing)), vsplat(1.0f));
    vfresnel border     = vfresnel_border(cos_i, vsplat(p->ior));
    vslab red           = vslab_whole(&border, vsplat(p->log2_inner.x));
    vslab green         = vslab_whole(&border, vsplat(p->log2_inner.y));
    vslab blue          = vslab_whole(&border, vsplat(p->log2_inner.z));

    vrgb tint  = look_color(self, s);
    vpane all  = { { red.passed * tint.x, green.passed * tint.y, blue.passed * tint.z },
                   { red.reflected, green.reflected, blue.reflected } };
    vmask acts = p->box ? s->front : ALL_LANES;
    return (vpane){ vkeep3(active, vselect3(acts, all.passed, vspread((vec3){ 1, 1, 1 }))),
                    vkeep3(active & acts, all.reflected) };
}

static vmask pane_scatter(const material *self, const vshading *s, vfloat u, vfloat v, vfloat pick,
                          vmask active, vscatter *out)
{
    (void)u, (void)v;
    vpane all     = pane_at(self, s, active);
    vfloat passed = all.passed.x + all.passed.y + all.passed.z;
    vfloat back   = all.reflected.x + all.reflected.y + all.reflected.z;
    vmask both    = back > 0.0f; /* of index 1 nothing comes back, and all may be absorbed */
    vfloat chance = vselect(both, passed / (passed + back), vsplat(1.0f));
    vmask passes  = active & (pick < chance);
    vmask mirrors = active & ~passes;

    vrgb through  = vscale(all.passed, 1.0f / chance);
    vrgb mirrored = vscale(all.reflected, 1.0f / (1.0f - chance));
    out->wi       = vkeep3(active, vselect3(passes, vneg(s->wo), vmirrored(s)));
    out->weight   = vkeep3(active, vselect3(passes, through, mirrored));
    out->pdf      = vkeep(active, vsplat(INFINITY));
    out->straight = passes;
    out->bent     = (vmask){ 0 };
    return passes | mirrors;
}

static vrgb pane_through(const material *self, const vshading *s, vmask active)
{
    return pane_at(self, s, active).passed;
}

static vrgb pane_albedo(const material *self, const vshading *s, vmask active)
{
    return pane_at(self, s, active).reflected;
}

static const material_type pane_type = { .name     = "pane",
                                         .scatter  = pane_scatter,
                                         .through  = pane_through,
                                         .mirrored = pane_albedo,
                                         .albedo   = pane_albedo };

/* ---- making ------------------------------------------------------------------------------------
 */

static double reflected_square(double ior)
{
    double r = (ior - 1.0) / (ior + 1.0);
    return r * r;
}

double pane_most(double ior)
{
    double r = reflected_square(ior);
    return (1.0 - r) / (1.0 + r);
}

/* The most may be met only to a float's rounding: no more is left than came. */
static float log2_inner(double ior, double transmittance)
{
    double r = reflected_square(ior), e2 = (1.0 - r) * (1.0 - r), t = transmittance;
    double a = 2.0 * t / (e2 + sqrt(e2 * e2 + 4.0 * r * r * t * t));
    return (float)fmin(log2(a), 0.0);
}

static bool valid(const pane_desc *d, lux_error *err)
{
    static const char name[] = "glass pane";
    if (!(d->ior >= 1.0f && d->ior <= 4.0f))
        return failed(err, ERR_ARGUMENT, "%s: an ior of %g is not in [1, 4]", name, (double)d->ior);
    vec3 t        = d->transmittance;
    double most   = pane_most((double)d->ior);
    float largest = (float)(most * (1.0 + 1e-6)); /* given as a float */
    if (!v3_nonnegative(t) || !(t.x <= largest && t.y <= largest && t.z <= largest))
        return failed(err, ERR_ARGUMENT,
                      "%s: transmittance %g %g %g is not in [0, %.4f]: no pane of ior %g lets "
                      "through more",
                      name, (double)t.x, (double)t.y, (double)t.z, floor(most * 1e4) / 1e4,
                      (double)d->ior);
    return extra_valid(name, &d->extra, err);
}

const material *material_pane(arena *a, const pane_desc *d, lux_error *err)
{
    if (!valid(d, err))
        return NULL;
    pane *m = arena_new(a, pane, err);
    if (!m)
        return NULL;
    material_begin(&m->base, &pane_type, (vec3){ 1, 1, 1 }, &d->extra);
    m->ior                = d->ior;
    m->box                = d->box;
    m->log2_inner         = (vec3){ log2_inner((double)d->ior, (double)d->transmittance.x),
                                    log2_inner((double)d->ior, (double)d->transmittance.y),
                                    log2_inner((double)d->ior, (double)d->transmittance.z) };
    m->base.reflectance   = diffuse_light_reflected(&m->base);
    m->base.transmittance = diffuse_light_through(&m->base);
    return &m->base;
}
