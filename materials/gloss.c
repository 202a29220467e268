/* materials/gloss.c -- glTF's metals and glossy dielectrics: rough facets over a base.
 *
 * The parameters are those of glTF 2.0, appendix B, and of KHR_materials_ior, _specular and
 * _transmission. With alpha = roughness^2 and d = ((ior - 1) / (ior + 1))^2, facets reflect
 *
 *     F   = F0 + (F90 - F0) (1 - o.h)^5                                            (Schlick)
 *     F0  = mix(specular min(d specular_color, 1), base, metallic)
 *     F90 = mix(specular, 1, metallic)
 *
 * The reflected light that meets several facets, and what enters the base, are what glTF leaves
 * open. Both are made of products of one function of each direction, so that they are the same
 * both ways and add up exactly: with loss() and schlick() of materials/ggx.h, their means over
 * diffuse light in bars, and of light from o
 *
 *     once(o)     = F0 (1 - loss - schlick) + F90 schlick      off one facet
 *     M           = Fm^2 (1 - loss') / (1 - Fm loss'),         loss' = mean of loss
 *     Fm          = F0 + (F90 - F0) / 21                       (the mean of F)
 *     enters(o)   = 1 - once - M loss                          into the base
 *
 * (Kulla & Conty 2017: M is what comes back of the lost light), a surface reflects and lets through
 *
 *     f_r = F D V       + M loss(o) loss(i) / (pi loss') + matt enters(o) enters(i) / (pi enters')
 *     f_t = clear ((1 - F) D V + (1 - M) loss(o) loss(i) / (pi loss'))
 *     matt  = base (1 - metallic) (1 - transmission)
 *     clear = base (1 - metallic) transmission
 *
 * f_t stands for i mirrored to o's side: thin walls do not bend light. So the share
 * once + M loss + matt enters of light from o comes back, clear enters goes through, and a surface
 * with base 1 loses nothing.
 */
#include "core/color.h"
#include "core/warp.h"
#include "materials/ggx.h"
#include "materials/material_parts.h"

#include <math.h>

typedef struct gloss {
    material base;
    float dielectric; /* d */
} gloss;

/* ---- the surface, and what becomes of light from one direction ------------------------------- */

typedef struct vgloss {
    vggx ggx;
    vrgb f0;
    vfloat f90;
    vrgb several;     /* M */
    vrgb matt, clear; /* of what enters */
    vrgb enters;      /* of diffuse light */
} vgloss;

typedef struct vgloss_side {
    vfloat cosine;
    vggx_share share;
    vrgb enters;
} vgloss_side;

static vrgb grey(vfloat a) { return (vrgb){ a, a, a }; }
static vrgb complement(vrgb a) { return vsub(grey(vsplat(1.0f)), a); }
static vrgb mix(vrgb a, vrgb b, vfloat t)
{
    return (vrgb){ vlerp(a.x, b.x, t), vlerp(a.y, b.y, t), vlerp(a.z, b.z, t) };
}

static vrgb at_most_one(vrgb a)
{
    vfloat one = vsplat(1.0f);
    return (vrgb){ vmin(a.x, one), vmin(a.y, one), vmin(a.z, one) };
}

/* Off one facet: of what facets reflect between f0 and f90. */
static vrgb once(vrgb f0, vfloat f90, vggx_share s)
{
    return vadd(vscale(f0, 1.0f - s.loss - s.schlick), grey(f90 * s.schlick));
}

/* Added up of what is lost each time, not as 1 less all else: of white metal it is 0 exactly. */
static vrgb entering(const vgloss *g, vggx_share s)
{
    vrgb past_one = once(complement(g->f0), 1.0f - g->f90, s);
    return at_most_one(vadd(past_one, vscale(complement(g->several), s.loss)));
}

static vfloat several_of(vfloat f0, vfloat f90, vfloat loss)
{
    vfloat mean = f0 + (f90 - f0) * (1.0f / 21.0f);
    return mean * mean * (1.0f - loss) / (1.0f - mean * loss);
}

static vgloss surface_of(const gloss *m, const vlook *look, vmask active)
{
    vgloss g        = { .ggx = vggx_of(look->roughness, active) };
    vrgb dielectric = at_most_one(vscale(look->specular, vsplat(m->dielectric)));
    g.f0            = mix(vscale(dielectric, look->specular_weight), look->color, look->metallic);
    g.f90           = vlerp(look->specular_weight, vsplat(1.0f), look->metallic);
    vfloat loss     = g.ggx.mean.loss;
    g.several       = (vrgb){ several_of(g.f0.x, g.f90, loss), several_of(g.f0.y, g.f90, loss),
                              several_of(g.f0.z, g.f90, loss) };
    vrgb base       = vscale(look->color, 1.0f - look->metallic);
    g.clear         = vscale(base, look->transmission);
    g.matt          = vscale(base, 1.0f - look->transmission);
    g.enters        = entering(&g, g.ggx.mean);
    return g;
}

static vgloss_side side_of(const vgloss *g, vfloat cosine, vmask active)
{
    vgloss_side s = { .cosine = vkeep(active, vabs(cosine)) };
    s.share       = vggx_shares(&g->ggx, s.cosine, active);
    s.enters      = entering(g, s.share);
    return s;
}

/* ---- the parts that directions are drawn of ---------------------------------------------------
 */

/* Off one facet and off several, back and through, and out of the base: the chance of each. */
typedef struct vgloss_parts {
    vfloat once, once_through, several, several_through, matt;
    vmask any; /* else all are 0 */
} vgloss_parts;

/* In proportion to the light that goes there. */
static vgloss_parts parts_of(const vgloss *g, const vgloss_side *o)
{
    vgloss_parts p;
    vrgb past_one     = once(complement(g->f0), 1.0f - g->f90, o->share);
    p.once            = vrgb_luminance(once(g->f0, g->f90, o->share));
    p.once_through    = vrgb_luminance(vmul(g->clear, past_one));
    p.several         = vrgb_luminance(g->several) * o->share.loss;
    p.several_through = vrgb_luminance(vmul(g->clear, complement(g->several))) * o->share.loss;
    p.matt            = vrgb_luminance(vmul(g->matt, o->enters));

    vfloat sum        = p.once + p.once_through + p.several + p.several_through + p.matt;
    p.any             = sum > 1e-20f; /* below it there is nothing to see */
    p.once            = vkeep(p.any, p.once / sum);
    p.once_through    = vkeep(p.any, p.once_through / sum);
    p.several         = vkeep(p.any, p.several / sum);
    p.several_through = vkeep(p.any, p.several_through / sum);
    p.matt            = vkeep(p.any, p.matt / sum);
    return p;
}

/* The lanes whose facets do not send them below the horizon, and their wi. */
static vmask draw(const vgloss *g, const vgloss_parts *p, const vshading *s, vfloat cosine,
                  const vfloat uv[2], vfloat pick, vvec3 *out)
{
    vfloat u = uv[0], v = uv[1];
    vvec3 x, y;
    vframe(s->n, &x, &y);
    vvec3 wo = { vdot(s->wo, x), vdot(s->wo, y), cosine };

    /* Which part */
    vfloat facets = p->once + p->once_through;
    vfloat rough  = facets + p->several + p->several_through;
    vmask facet   = pick < facets;
    vmask matt    = pick >= rough;
    vmask through = (facet & (pick >= p->once)) | (~(facet | matt) & (pick >= facets + p->several));

    /* Its direction, through the surface as if mirrored back */
    vvec3 h       = vggx_draw_facet(&g->ggx, wo, u, v);
    vvec3 off     = vsub(vscale(h, 2.0f * vdot(wo, h)), wo);
    vvec3 even    = vwarp_cosine(u, v);
    vfloat m      = vggx_draw_lossy(&g->ggx, u);
    vfloat across = vsqrt(1.0f - m * m), phi = 6.28318531f * v;
    vvec3 lossy = { across * vcos(phi), across * vsin(phi), m };
    vvec3 wi    = vselect3(facet, off, vselect3(matt, even, lossy));
    vfloat z    = vselect(through, -wi.z, wi.z);
    *out        = vadd(vscale(s->n, z), vadd(vscale(x, wi.x), vscale(y, wi.y)));
    vmask below = vdot(*out, s->n) < 0.0f;
    return p->any & ((below & through) | ~(below | through));
}

/* ---- f and pdf --------------------------------------------------------------------------------
 */

/* The square of the part of o + i along the surface, o and i unit. Where both graze it, that is far
 * shorter than they are: the difference of their lengths along it, a - b, is then that of the
 * squared cosines over a + b, which rounding does not touch. */
static vfloat along_surface2(vvec3 n, vvec3 o, vvec3 i, vfloat m_o, vfloat m_i)
{
    vvec3 o_side = vcross(n, o), i_side = vcross(n, i), sum = vadd(o_side, i_side);
    vfloat a = vlength(o_side), b = vlength(i_side);
    vmask graze   = 2.0f * (m_o + m_i) < a + b;
    vfloat longer = (m_i - m_o) * (m_i + m_o) / (a + b);
    vvec3 turn    = vadd(vscale(o_side, 1.0f / a), vscale(i_side, 1.0f / b));
    return vselect(graze, longer * longer + a * b * vdot(turn, turn), vdot(sum, sum));
}

/* The facet between o and i, or i mirrored to o's side: D, and F. The part of h along the surface
 * is that of o + i either way; that across it is the sum of the cosines. */
typedef struct vgloss_facet {
    vfloat density;
    vrgb fresnel;
} vgloss_facet;

static vgloss_facet facet_between(const vgloss *g, const vshading *s, const vvec3 *wi, vfloat m_o,
                                  vfloat m_i)
{
    vfloat along2 = along_surface2(s->n, s->wo, *wi, m_o, m_i);
    vfloat up2    = (m_o + m_i) * (m_o + m_i);
    vfloat h2     = vmax(along2 + up2, vsplat(1e-30f));
    vfloat steep  = vmax(1.0f - 0.5f * vsqrt(h2), vsplat(0.0f)); /* |o + i| = 2 o.h */
    vfloat steep2 = steep * steep;
    vfloat weight = steep2 * steep2 * steep;
    return (vgloss_facet){ vggx_density(&g->ggx, along2 / h2, up2 / h2),
                           mix(g->f0, grey(g->f90), weight) };
}

/* f, 1/sr, and the pdf of wi on the side that `through` says. */
static vrgb density_of(const vgloss *g, const vgloss_parts *p, const vgloss_side *o,
                       const vgloss_side *i, vgloss_facet h, vmask through, vfloat *pdf)
{
    const float per_pi = 0.318309886f;
    vfloat single      = h.density * vggx_visibility(&g->ggx, o->cosine, i->cosine);
    vfloat lost = per_pi * o->share.loss * i->share.loss / vmax(g->ggx.mean.loss, vsplat(1e-20f));

    vrgb back = vadd(vscale(h.fresnel, single), vscale(g->several, lost));
    vrgb past = vadd(vscale(complement(h.fresnel), single), vscale(complement(g->several), lost));
    vrgb both = vmul(o->enters, i->enters); /* of white metal 0, as the mean is */
    vrgb matt = { both.x / vmax(g->enters.x, vsplat(1e-20f)),
                  both.y / vmax(g->enters.y, vsplat(1e-20f)),
                  both.z / vmax(g->enters.z, vsplat(1e-20f)) };
    back      = vadd(back, vmul(g->matt, vscale(matt, vsplat(per_pi))));

    if (pdf) {
        vfloat off   = vggx_facet_pdf(&g->ggx, h.density, o->cosine);
        vfloat lossy = vggx_lossy_pdf(&g->ggx, i->cosine);
        vfloat same  = p->once * off + p->several * lossy + p->matt * per_pi * i->cosine;
        vfloat other = p->once_through * off + p->several_through * lossy;
        *pdf         = vselect(through, other, same);
    }
    return vselect3(through, vmul(g->clear, past), back);
}

/* f |cos|, and *pdf unless it is NULL. */
static vrgb evaluate(const vgloss *g, const vgloss_side *o, const vshading *s, const vvec3 *wi,
                     vmask active, vfloat *pdf)
{
    vfloat cosine  = vdot(*wi, s->n);
    vmask through  = cosine < 0.0f;
    vmask seen     = active & (cosine != 0.0f);
    vgloss_parts p = parts_of(g, o);
    vgloss_side i  = side_of(g, cosine, seen);
    vgloss_facet h = facet_between(g, s, wi, o->cosine, i.cosine);
    vrgb f         = density_of(g, &p, o, &i, h, through, pdf);
    if (pdf)
        *pdf = vkeep(seen, *pdf);
    return vkeep3(seen, vscale(f, i.cosine));
}

/* ---- the material -----------------------------------------------------------------------------
 */

static vfloat seen_cosine(const vshading *s) { return vmax(vdot(s->wo, s->n), vsplat(0.0f)); }

static vmask gloss_scatter(const material *self, const vshading *s, vfloat u, vfloat v, vfloat pick,
                           vmask active, vscatter *out)
{
    vlook look     = look_of(self, s);
    vgloss g       = surface_of((const gloss *)self, &look, active);
    vgloss_side o  = side_of(&g, seen_cosine(s), active);
    vgloss_parts p = parts_of(&g, &o);
    vvec3 wi;
    vmask drawn = draw(&g, &p, s, o.cosine, (vfloat[]){ u, v }, pick, &wi);
    vfloat pdf;
    vrgb f        = evaluate(&g, &o, s, &wi, active & drawn, &pdf);
    vmask goes    = pdf > 0.0f;
    out->wi       = vkeep3(goes, wi);
    out->weight   = vkeep3(goes, vscale(f, 1.0f / pdf));
    out->pdf      = vkeep(goes, pdf);
    out->straight = out->bent = (vmask){ 0 };
    return goes;
}

static vrgb gloss_reflect(const material *self, const vshading *s, const vvec3 *wi, vmask active,
                          vfloat *pdf)
{
    vlook look    = look_of(self, s);
    vgloss g      = surface_of((const gloss *)self, &look, active);
    vgloss_side o = side_of(&g, seen_cosine(s), active);
    return evaluate(&g, &o, s, wi, active, pdf);
}

static vrgb gloss_albedo(const material *self, const vshading *s, vmask active)
{
    vlook look    = look_of(self, s);
    vgloss g      = surface_of((const gloss *)self, &look, active);
    vgloss_side o = side_of(&g, seen_cosine(s), active);
    vrgb back     = vadd(complement(o.enters), vmul(g.matt, o.enters));
    return vkeep3(active, back);
}

static const material_type gloss_type = {
    .name = "gloss", .scatter = gloss_scatter, .reflect = gloss_reflect, .albedo = gloss_albedo
};

/* ---- making one -------------------------------------------------------------------------------
 */

static bool number_valid(const char *material_name, const char *what, float value, lux_error *err)
{
    if (value >= 0.0f && value <= 1.0f)
        return true;
    return failed(err, ERR_ARGUMENT, "%s: %s of %g is not in [0, 1]", material_name, what,
                  (double)value);
}

static bool desc_valid(const char *name, const gloss_desc *d, lux_error *err)
{
    vec3 c = d->specular_color;
    if (!share_valid(name, "base color", d->base_color, err) ||
        !number_valid(name, "a metallic", d->metallic, err) ||
        !number_valid(name, "a roughness", d->roughness, err) ||
        !number_valid(name, "a transmission", d->transmission, err) ||
        !number_valid(name, "a specular", d->specular, err) || !extra_valid(name, &d->extra, err))
        return false;
    if (!(d->ior == 0.0f || (d->ior >= 1.0f && d->ior <= 4.0f)))
        return failed(err, ERR_ARGUMENT, "%s: an ior of %g is neither 0 nor in [1, 4]", name,
                      (double)d->ior);
    if (!v3_nonnegative(c) || !(c.x < INFINITY && c.y < INFINITY && c.z < INFINITY))
        return failed(err, ERR_ARGUMENT, "%s: specular color %g %g %g is not >= 0", name,
                      (double)c.x, (double)c.y, (double)c.z);
    return true;
}

static float mean_of(const texture_slot *slot, int channel)
{
    float mean[4] = { 1, 1, 1, 1 };
    if (slot->texture)
        texture_mean(slot->texture, mean);
    return mean[channel];
}

/* The look with each texture as even as its mean. */
static vlook mean_look(const material *m)
{
    static const material_textures none = { 0 };
    const material_textures *t          = m->textures ? m->textures : &none;
    const texture_slot *specular        = &t->specular_color;
    vec3 color                          = v3_mul(m->look.color, textures_mean_color(m->textures));
    vec3 tint = { mean_of(specular, 0), mean_of(specular, 1), mean_of(specular, 2) };
    return (vlook){ .color        = vspread(color),
                    .specular     = vspread(v3_mul(m->look.specular, tint)),
                    .metallic     = vsplat(m->look.metallic * mean_of(&t->surface, 2)),
                    .roughness    = vsplat(m->look.roughness * mean_of(&t->surface, 1)),
                    .transmission = vsplat(m->look.transmission * mean_of(&t->transmission, 0)),
                    .specular_weight =
                        vsplat(m->look.specular_weight * mean_of(&t->specular_weight, 3)) };
}

static vec3 first_lane(vrgb a) { return (vec3){ lane(a.x, 0), lane(a.y, 0), lane(a.z, 0) }; }

const material *material_gloss(arena *a, const gloss_desc *d, lux_error *err)
{
    static const char name[] = "gloss material";
    if (!desc_valid(name, d, err))
        return NULL;
    gloss *m = arena_new(a, gloss, err);
    if (!m)
        return NULL;
    material_begin(&m->base, &gloss_type, d->base_color, &d->extra);
    m->base.look.metallic        = d->metallic;
    m->base.look.roughness       = d->roughness;
    m->base.look.transmission    = d->transmission;
    m->base.look.specular_weight = d->specular;
    m->base.look.specular        = d->specular_color;
    float root                   = d->ior > 0.0f ? (d->ior - 1.0f) / (d->ior + 1.0f) : 1.0f;
    m->dielectric                = root * root;

    /* What becomes of diffuse light */
    vlook look            = mean_look(&m->base);
    vgloss g              = surface_of(m, &look, ALL_LANES);
    vrgb back             = vadd(complement(g.enters), vmul(g.matt, g.enters));
    m->base.reflectance   = first_lane(back);
    m->base.transmittance = first_lane(vmul(g.clear, g.enters));
    m->base.two_sided     = d->transmission > 0.0f && d->metallic < 1.0f;
    return &m->base;
}
