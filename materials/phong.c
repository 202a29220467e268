/* materials/phong.c -- a matt surface with a lobe about the mirror direction (Phong, as modified by
 * Lafortune & Willems, "Using the modified Phong reflectance model for physically based
 * rendering", Leuven 1994).
 *
 *     f = rho / pi + ks (n + 2) / (2 pi) cos^n a        [1/sr],  a the angle of wi from the mirror
 *                                                       direction r of wo, lobe 0 beyond 90 degrees
 *
 * At normal incidence the lobe gives back ks, at others less, ks M(cos theta): M is tabulated. a
 * is found by the chord between wi and r, without which a lobe of exponent 10^6, 1e-3 rad wide,
 * would drown in roundings; chord^2 = along^2 + (n.wi - n.wo)^2, along being what wi + wo has
 * along the surface, is the same to the bit when wi and wo change places.
 *
 * The lobe is drawn in proportion to cos^n a, and what falls below the surface is mirrored in it:
 *
 *     pdf = (n + 1) / (2 pi) (cos^n a + cos^n a')       [1/sr],  a' of wi mirrored in the surface
 */
#include "core/warp.h"
#include "materials/diffuse_light.h"
#include "materials/material_parts.h"

enum { STEPS = 128 }; /* of M, in the root of the cosine: narrow near grazing */

typedef struct phong {
    material base; /* look.specular is ks */
    float exponent;
    float lobe[STEPS + 1]; /* M((i / STEPS)^2) */
} phong;

static const phong *as_phong(const material *m) { return (const phong *)(const void *)m; }

static vrgb specular_of(const material *m, const vshading *s)
{
    return has_textures(m) ? s->look.specular : vspread(m->look.specular);
}

static vfloat sum_of(vrgb a) { return a.x + a.y + a.z; }

static vfloat lobe_albedo(const phong *p, const vshading *s, vmask active)
{
    vfloat cosine = vmin(vmax(vdot(s->wo, s->n), vsplat(0.0f)), vsplat(1.0f));
    vfloat x      = vkeep(active, vsqrt(cosine) * STEPS);
    vint i        = vto_int(vmin(x, vsplat(STEPS - 0.5f)));
    return vlerp(vgather(p->lobe, i), vgather(p->lobe, i + 1), x - vto_float(i));
}

/* The share of draws that the lobe gets: that of what it gives back. */
static vfloat lobe_chance(const phong *p, const vshading *s, vmask active)
{
    vfloat lobe = sum_of(specular_of(&p->base, s)) * lobe_albedo(p, s, active);
    vfloat all  = lobe + sum_of(look_color(&p->base, s));
    return vkeep(active & (all > 0.0f), lobe / all);
}

/* cos^n a for half_chord2 = 1 - cos a. The logarithm is that of what 1 - half_chord2 rounds to,
 * and what was lost by rounding. */
static vfloat lobe_at(float exponent, vfloat half_chord2)
{
    const float log2_e = 1.44269504f;
    vfloat cosine      = 1.0f - half_chord2;
    vfloat lost        = half_chord2 - (1.0f - cosine);
    vfloat log2_cosine = vlog2(cosine) - log2_e * lost / cosine;
    return vkeep(cosine > 0.0f, vexp2(exponent * log2_cosine));
}

/* f cos, of wi above the surface. */
static vrgb phong_density(const phong *p, const vshading *s, const vvec3 *wi, vmask active,
                          vfloat *pdf)
{
    vvec3 both    = vadd(*wi, s->wo);
    vfloat up     = vdot(s->n, both);
    vfloat apart  = vdot(s->n, vsub(*wi, s->wo));
    vvec3 along   = vsub(both, vscale(s->n, up));
    vfloat along2 = vdot(along, along);
    vfloat near   = lobe_at(p->exponent, 0.5f * (along2 + apart * apart));
    vfloat folded = lobe_at(p->exponent, 0.5f * (along2 + up * up));

    vfloat cosine = vdot(s->n, *wi);
    vmask lit     = active & (cosine > 0.0f);
    vfloat chance = lobe_chance(p, s, active);
    vfloat drawn  = (p->exponent + 1.0f) * (0.5f / WARP_PI) * (near + folded);
    *pdf          = vkeep(lit, vlerp(vwarp_cosine_pdf(cosine), drawn, chance));

    vrgb matt = vscale(look_color(&p->base, s), vsplat(1.0f / WARP_PI));
    vrgb lobe = vscale(specular_of(&p->base, s), (p->exponent + 2.0f) * (0.5f / WARP_PI) * near);
    return vkeep3(lit, vscale(vadd(matt, lobe), cosine));
}

/* ---- drawing ----------------------------------------------------------------------------------
 */

/* 1 - 2^y for y <= 0, near 0 by its series: z + z^2/2 + ... + z^5/120, z = y ln 2 > -0.07. */
static vfloat one_minus_exp2(vfloat y)
{
    vfloat z     = 0.693147181f * y;
    vfloat small = 1.0f + z * (0.5f + z * (1.0f / 6 + z * (1.0f / 24 + z * (1.0f / 120))));
    return vselect(y > -0.1f, -z * small, 1.0f - vexp2(y));
}

/* cos a = (1 - u)^(1 / (n + 1)) about the mirror direction. */
static vvec3 lobe_direction(const phong *p, const vshading *s, vfloat u, vfloat v)
{
    vfloat log2_cos = vlog2(1.0f - u) / (p->exponent + 1.0f);
    vfloat cos_a    = vexp2(log2_cos);
    vfloat sin_a    = vsqrt(vmax(one_minus_exp2(2.0f * log2_cos), vsplat(0.0f)));
    vfloat phi      = 2.0f * WARP_PI * v;

    vvec3 r = vsub(vscale(s->n, 2.0f * vdot(s->n, s->wo)), s->wo);
    vvec3 x, y;
    vframe(r, &x, &y);
    vvec3 across = vadd(vscale(x, sin_a * vcos(phi)), vscale(y, sin_a * vsin(phi)));
    vvec3 wi     = vadd(vscale(r, cos_a), across);
    vfloat below = vmin(vdot(wi, s->n), vsplat(0.0f));
    return vsub(wi, vscale(s->n, 2.0f * below));
}

static vmask phong_scatter(const material *self, const vshading *s, vfloat u, vfloat v, vfloat pick,
                           vmask active, vscatter *out)
{
    const phong *p = as_phong(self);
    vmask in_lobe  = pick < lobe_chance(p, s, active);
    vvec3 wi       = vselect3(in_lobe, lobe_direction(p, s, u, v), vwarp_cosine_about(s->n, u, v));

    vfloat pdf;
    vrgb f     = phong_density(p, s, &wi, active, &pdf);
    vmask goes = active & (pdf > 0.0f);

    out->wi       = vkeep3(goes, wi);
    out->weight   = vkeep3(goes, vscale(f, 1.0f / pdf));
    out->pdf      = vkeep(goes, pdf);
    out->straight = out->bent = (vmask){ 0 };
    return goes;
}

static vrgb phong_reflect(const material *self, const vshading *s, const vvec3 *wi, vmask active,
                          vfloat *pdf)
{
    vfloat density;
    vrgb f = phong_density(as_phong(self), s, wi, active, &density);
    if (pdf)
        *pdf = density;
    return f;
}

static vrgb phong_albedo(const material *self, const vshading *s, vmask active)
{
    vfloat lobe = lobe_albedo(as_phong(self), s, active);
    return vkeep3(active, vadd(look_color(self, s), vscale(specular_of(self, s), lobe)));
}

static const material_type phong_type = {
    .name = "phong", .scatter = phong_scatter, .reflect = phong_reflect, .albedo = phong_albedo
};

/* ---- making ------------------------------------------------------------------------------------
 *
 * M(cos t) = (n + 2) / (2 pi) integral of cos^n a max(cos i, 0) over the directions about r, where
 * cos i = cos a cos t + sin a sin t cos phi. That over phi is closed; that over a is taken by
 * midpoints of w, cos^(n+1) a = 1 - w^2, in which the lobe is as wide as w's range.
 */

enum { LOBE_POINTS = 512 };

/* The mean of max(p + q cos phi, 0) over phi; q >= 0. */
static double mean_above(double p, double q)
{
    const double pi = 3.14159265358979324;
    if (q <= fabs(p))
        return p > 0.0 ? p : 0.0;
    double last = acos(-p / q);
    return (p * last + q * sin(last)) / pi;
}

static void tabulate_lobe(phong *m)
{
    double n = (double)m->exponent, cos_a[LOBE_POINTS], sin_a[LOBE_POINTS], weight[LOBE_POINTS];
    for (int k = 0; k < LOBE_POINTS; k++) {
        double w     = (k + 0.5) / LOBE_POINTS;
        double log_c = log1p(-w * w) / (n + 1.0);
        cos_a[k]     = exp(log_c);
        sin_a[k]     = sqrt(-expm1(2.0 * log_c));
        weight[k]    = (n + 2.0) / (n + 1.0) * 2.0 * w / LOBE_POINTS;
    }
    for (int i = 0; i <= STEPS; i++) {
        double x = (double)i / STEPS, cos_t = x * x, sin_t = sqrt(1.0 - cos_t * cos_t);
        double sum = 0.0;
        for (int k = 0; k < LOBE_POINTS; k++)
            sum += weight[k] * mean_above(cos_a[k] * cos_t, sin_a[k] * sin_t);
        m->lobe[i] = (float)fmin(sum, 1.0);
    }
}

static bool valid(const phong_desc *d, lux_error *err)
{
    static const char name[] = "phong material";
    vec3 r = d->reflectance, s = d->specular;
    if (!(d->exponent >= 1.0f && d->exponent <= 1e6f))
        return failed(err, ERR_ARGUMENT, "%s: an exponent of %g is not in [1, 1e6]", name,
                      (double)d->exponent);
    if (!share_valid(name, "reflectance", r, err) || !share_valid(name, "specular", s, err))
        return false;
    float most = 1.0f + 1e-6f; /* 0.9 + 0.1 may be rounded above 1 */
    if (r.x + s.x > most || r.y + s.y > most || r.z + s.z > most)
        return failed(err, ERR_ARGUMENT,
                      "%s: reflectance %g %g %g and specular %g %g %g are more than 1 together",
                      name, (double)r.x, (double)r.y, (double)r.z, (double)s.x, (double)s.y,
                      (double)s.z);
    return extra_valid(name, &d->extra, err);
}

const material *material_phong(arena *a, const phong_desc *d, lux_error *err)
{
    const float wide = 2.0f; /* exponents of lobes hardly narrower than the cosine */
    if (!valid(d, err))
        return NULL;
    phong *m = arena_new(a, phong, err);
    if (!m)
        return NULL;
    material_begin(&m->base, &phong_type, d->reflectance, &d->extra);
    m->base.look.specular = d->specular;
    m->exponent           = d->exponent;
    tabulate_lobe(m);
    m->base.reflectance = diffuse_light_reflected(&m->base);
    m->base.matt        = d->exponent <= wide || v3_length(d->specular) == 0.0f;
    return &m->base;
}
