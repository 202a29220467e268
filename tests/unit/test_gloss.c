/* tests/unit/test_gloss.c -- glTF's metals and glossy dielectrics: energy, reciprocity, sampling,
 * and packets beside a twin in double. */
#include "core/sampler.h"
#include "materials/ggx.h"
#include "tests/ggx_twin.h"
#include "tests/material_checks.h"
#include "tests/test.h"

#include <string.h>

static const double pi = 3.14159265358979324;

static const gloss_desc plain = { .base_color     = { 0.8f, 0.5f, 0.2f },
                                  .roughness      = 0.5f,
                                  .ior            = 1.5f,
                                  .specular       = 1.0f,
                                  .specular_color = { 1, 1, 1 } };

static gloss_desc rough(gloss_desc d, float roughness)
{
    d.roughness = roughness;
    return d;
}

static gloss_desc white_metal(float roughness)
{
    gloss_desc d = rough(plain, roughness);
    d.base_color = (vec3){ 1, 1, 1 };
    d.metallic   = 1.0f;
    return d;
}

static gloss_desc clear(float roughness)
{
    gloss_desc d   = rough(plain, roughness);
    d.transmission = 0.7f;
    return d;
}

/* ---- energy -----------------------------------------------------------------------------------
 *
 * Quadrature of reflect() over two grids at once: of facets, whose angle t from n is even in
 * log(1 + t / alpha), and of directions, whose cosine m is even in log(1 + m / 1e-4); both with
 * their azimuth from wo's plane, over half of it. With d1 and d2 points for a steradian about a
 * point it stands for d1 / (d1^2 + d2^2) or d2 / (d1^2 + d2^2) steradians (Veach's power
 * heuristic), so that each grid serves where it is the denser.
 */

enum { STEPS = 128, TURNS = 64 };

typedef struct dir {
    double x, y, z;
} dir;

typedef struct grids {
    dir wo;
    double alpha;
} grids;

static const double low = 1e-4;
static double facet_step(const grids *g) { return log(1.0 + 0.5 * pi / g->alpha) / STEPS; }
static double cosine_step(void) { return log(1.0 + 1.0 / low) / STEPS; }

/* sr: what a point of either grid stands for, on both sides of wo's plane. */
static double weight_of(const grids *g, bool facets, dir wi)
{
    dir h        = { g->wo.x + wi.x, g->wo.y + wi.y, g->wo.z + wi.z };
    double along = hypot(h.x, h.y), size = hypot(along, h.z), t = atan2(along, h.z);
    double d1 = TURNS / pi / (2.0 * size * sin(t) * (g->alpha + t) * facet_step(g));
    double d2 = TURNS / pi / ((low + wi.z) * cosine_step());
    return 2.0 * (facets ? d1 : d2) / (d1 * d1 + d2 * d2);
}

/* A point of the grid of facets, or of that of directions; z = 0: none. */
static dir point_of(const grids *g, bool facets, int i, int j)
{
    double phi = pi * (j + 0.5) / TURNS;
    if (!facets) {
        double z = low * (exp((i + 0.5) * cosine_step()) - 1.0), side = sqrt(1.0 - z * z);
        return (dir){ side * cos(phi), side * sin(phi), z };
    }
    double t = g->alpha * (exp((i + 0.5) * facet_step(g)) - 1.0);
    dir h    = { sin(t) * cos(phi), sin(t) * sin(phi), cos(t) };
    double o = g->wo.x * h.x + g->wo.z * h.z, z = 2.0 * o * h.z - g->wo.z;
    bool up = o > 0.0 && z > 0.0;
    return up ? (dir){ 2.0 * o * h.x - g->wo.x, 2.0 * o * h.y, z } : (dir){ 0 };
}

/* The share of light from the angle theta that goes to each side, red channel. */
static double share_by_quadrature(const material *m, double theta_deg, double alpha, bool through)
{
    double theta = theta_deg * pi / 180.0, sum = 0.0;
    grids g    = { { sin(theta), 0.0, cos(theta) }, alpha };
    vshading s = material_seen_from(m, theta_deg, 0, true);
    for (int i = 0; i < 2 * STEPS; i++)
        for (int j = 0; j < TURNS; j += LANES) {
            float to[3][LANES];
            double weight[LANES];
            for (int k = 0; k < LANES; k++) {
                dir d     = point_of(&g, i < STEPS, i % STEPS, j + k);
                weight[k] = d.z > 0.0 ? weight_of(&g, i < STEPS, d) : 0.0;
                to[0][k]  = (float)d.x;
                to[1][k]  = (float)d.y;
                to[2][k]  = (float)(through ? -d.z : d.z);
            }
            vvec3 wi = { vload(to[0]), vload(to[1]), vload(to[2]) };
            vrgb f   = materials_reflect(&m, vsplat_int(0), &s, &wi, ALL_LANES, NULL);
            for (int k = 0; k < LANES; k++)
                sum += weight[k] * (double)lane(f.x, k);
        }
    return sum;
}

static const float roughnesses[] = { 0.0f, 0.05f, 0.2f, 0.5f, 1.0f };
static const double thetas[]     = { 0, 30, 60, 80, 89, 89.99 };

/* Fails unless albedo() and the quadrature are the same, and what goes through its share of what
 * enters: (1 - albedo) is that of light which is neither reflected nor let through if base is 1. */
static void check_energy(const gloss_desc *d)
{
    arena a           = { 0 };
    const material *m = material_gloss(&a, d, NULL);
    assert_non_null(m);
    double r     = fmax((double)d->roughness, (double)GGX_LEAST_ROUGHNESS);
    double glass = (double)(d->base_color.x * (1.0f - d->metallic));
    for (int i = 0; i < 6; i++) {
        vshading s  = material_seen_from(m, thetas[i], 0, true);
        double said = (double)lane(materials_albedo(&m, vsplat_int(0), &s, ALL_LANES).x, 0);
        double is   = share_by_quadrature(m, thetas[i], r * r, false);
        assert_true(said <= 1.0 + 1e-6);
        if (!(fabs(said - is) <= 1e-3))
            fail_msg("roughness %g metallic %g base %g at %g: %f, not %f", (double)d->roughness,
                     (double)d->metallic, (double)d->base_color.x, thetas[i], said, is);
        if (d->transmission == 0.0f)
            continue;
        double t      = (double)d->transmission;
        double enters = (1.0 - said) / (1.0 - glass * (1.0 - t));
        double past   = share_by_quadrature(m, thetas[i], r * r, true);
        if (!(fabs(past - glass * t * enters) <= 1e-3))
            fail_msg("roughness %g at %g: %f goes through, not %f", (double)d->roughness, thetas[i],
                     past, glass * t * enters);
    }
    arena_clear(&a);
}

TEST(albedo_is_the_integral_at_every_roughness)
{
    static const float base[] = { 0.0f, 0.3f, 1.0f }, metallic[] = { 0.0f, 0.5f, 1.0f };
    for (int r = 0; r < 5; r++)
        for (int k = 0; k < 9; k++) {
            gloss_desc d   = rough(plain, roughnesses[r]);
            d.base_color.x = base[k / 3];
            d.metallic     = metallic[k % 3];
            check_energy(&d);
        }
}

TEST(transmission_takes_what_the_base_would)
{
    for (int r = 0; r < 5; r++) {
        gloss_desc d = clear(roughnesses[r]);
        check_energy(&d);
        d.transmission = 1.0f;
        d.metallic     = 0.25f;
        check_energy(&d);
    }
}

TEST(every_f0_adds_up)
{
    for (int r = 0; r < 5; r++) {
        gloss_desc d = rough(plain, roughnesses[r]);
        d.ior        = 0.0f; /* F0 = 1 */
        check_energy(&d);
        d.specular = 0.5f;
        check_energy(&d);
        d.ior              = 2.4f;
        d.specular_color.x = 3.0f;
        check_energy(&d);
        d.specular = 0.0f; /* a matt one */
        check_energy(&d);
    }
}

static double albedo_at(const material *m, double theta)
{
    vshading s = material_seen_from(m, theta, 0, true);
    return (double)lane(materials_albedo(&m, vsplat_int(0), &s, ALL_LANES).x, 0);
}

TEST(white_metal_and_white_dielectrics_lose_nothing)
{
    for (int r = 0; r < 5; r++) {
        arena a          = { 0 };
        gloss_desc metal = white_metal(roughnesses[r]), paint = metal, glass;
        paint.metallic     = 0.0f;
        glass              = paint;
        glass.transmission = 0.6f;
        const material *m  = material_gloss(&a, &metal, NULL);
        const material *p  = material_gloss(&a, &paint, NULL);
        const material *g  = material_gloss(&a, &glass, NULL);
        for (int i = 0; i < 6; i++) {
            assert_near(albedo_at(m, thetas[i]), 1.0, 1e-6);
            assert_near(albedo_at(p, thetas[i]), 1.0, 1e-6);
        }
        assert_near(m->reflectance.x, 1.0, 1e-6);
        assert_near(p->reflectance.x, 1.0, 1e-6);
        assert_near(g->reflectance.x + g->transmittance.x, 1.0, 1e-6);
        assert_true(g->two_sided && !p->two_sided && !m->solid);
        arena_clear(&a);
    }
}

/* Of diffuse light: the mean of albedo() over it, by Simpson's rule in the square of the cosine. */
TEST(reflectance_is_the_mean_albedo)
{
    enum { CUTS = 2000 };
    for (int r = 0; r < 5; r++) {
        arena a           = { 0 };
        gloss_desc d      = rough(plain, roughnesses[r]);
        const material *m = material_gloss(&a, &d, NULL);
        double sum        = 0.0;
        for (int k = 0; k <= CUTS; k++) {
            double x = (double)k / CUTS; /* the cosine is x^2 */
            double w = (k == 0 || k == CUTS ? 1.0 : k % 2 ? 4.0 : 2.0) / (3.0 * CUTS);
            sum += w * 4.0 * x * x * x * albedo_at(m, acos(x * x) * 180.0 / pi);
        }
        assert_near(m->reflectance.x, sum, 1e-4);
        arena_clear(&a);
    }
}

/* Closed forms: a mirror of F0 = 1 sends all the light there; a dielectric at normal incidence
 * (n - 1)^2 / (n + 1)^2 = 0.04. */
TEST(the_smoothest_is_a_mirror)
{
    arena a          = { 0 };
    gloss_desc metal = white_metal(0.0f), glass = rough(plain, 0.0f);
    glass.base_color.x = 0.0f;
    const material *m  = material_gloss(&a, &metal, NULL);
    const material *g  = material_gloss(&a, &glass, NULL);
    vshading s         = material_seen_from(m, 40, 0, true);
    vscatter out;
    int near = 0, draws = 0;
    for (uint32_t n = 0; n < 4096; n += LANES) {
        vsample4 p = vsobol4(vunsigned(vlane_index()) + n, vsplat_uint(1));
        vmask goes = materials_scatter(&m, vsplat_int(0), &s, p.x, p.y, p.z, ALL_LANES, &out);
        vfloat c   = out.wi.z * s.wo.z - out.wi.x * s.wo.x - out.wi.y * s.wo.y;
        draws += __builtin_popcount((unsigned)vbits(goes));
        near += __builtin_popcount((unsigned)vbits(goes & (c > 0.99993f))); /* within 0.68 deg */
        assert_true(vall(~(goes & (c > 0.99993f)) | (vabs(out.weight.x - 1.0f) < 1e-3f)));
    }
    assert_true(draws == 4096 && near > 4096 * 0.96); /* all but alpha^2 / tan^2(0.34 deg) = 3 % */
    assert_true(fabs(albedo_at(g, 0) - 0.04) < 1e-3);
    assert_true(fabs(albedo_at(g, 60) - (0.04 + 0.96 / 32.0)) < 1e-3);
    arena_clear(&a);
}

/* ---- what every material holds to -------------------------------------------------------------
 */

static void with_material(const gloss_desc *d, void (*check)(const material *))
{
    arena a           = { 0 };
    const material *m = material_gloss(&a, d, NULL);
    assert_non_null(m);
    check(m);
    arena_clear(&a);
}

static void reciprocal(const material *m) { material_check_reciprocity(m, 1e-5); }

TEST(paths_may_be_walked_backwards)
{
    for (int r = 0; r < 5; r++) {
        gloss_desc d = clear(roughnesses[r]), metal = white_metal(roughnesses[r]);
        with_material(&d, reciprocal);
        with_material(&metal, reciprocal);
    }
}

TEST(a_white_furnace_holds_frosted_glass)
{
    gloss_desc d = clear(0.3f);
    d.metallic   = 0.2f;
    with_material(&d, material_check_furnace);
}

/* All five parts in one. */
TEST(directions_follow_their_pdf)
{
    gloss_desc d = clear(0.4f);
    d.metallic   = 0.3f;
    with_material(&d, material_check_sampling);
}

TEST(packets_are_finite_and_masked)
{
    gloss_desc d = clear(0.0f), metal = white_metal(0.0f), black = rough(plain, 1.0f);
    black.base_color = (vec3){ 0, 0, 0 };
    black.specular   = 0.0f;
    with_material(&d, material_check_packets);
    with_material(&metal, material_check_packets);
    with_material(&black, material_check_packets);
}

/* From incidences up to `most`, most of them near it. */
static void expect_light_draws(const gloss_desc *d, double most)
{
    arena a           = { 0 };
    const material *m = material_gloss(&a, d, NULL);
    for (uint32_t n = 0; n < 20000; n += LANES) {
        vscatter out;
        vsample4 p = vsobol4(vunsigned(vlane_index()) + n, vsplat_uint(2));
        vshading s = material_seen_from(m, most * (1.0 - pow(hash_u32(n) * 0x1p-32, 3.0)), 0, true);
        materials_scatter(&m, vsplat_int(0), &s, p.x, p.y, p.z, ALL_LANES, &out);
        assert_true(vall(out.weight.x < 8.0f));
    }
    arena_clear(&a);
}

/* What scatter() gives back is never much more than what came (5.7 was the most of 400,000): no
 * fireflies. Of smooth glass that is seen from beyond 89 degrees they are up to 40, of the few per
 * mille of light that still go through. */
TEST(no_draw_weighs_much)
{
    for (int r = 0; r < 5; r++) {
        gloss_desc d = rough(plain, roughnesses[r]), glass = clear(roughnesses[r]);
        expect_light_draws(&d, 90.0);
        d.metallic = 0.5f;
        expect_light_draws(&d, 90.0);
        expect_light_draws(&glass, 89.0);
    }
}

/* ---- beside the twin --------------------------------------------------------------------------
 */

typedef struct random_numbers {
    uint32_t state;
} random_numbers;

static double next(random_numbers *r) { return hash_u32(r->state++) * 0x1p-32; }

/* Unit, z > 0: a third of them grazing, a tenth all but straight up. */
static void random_direction(random_numbers *r, double d[3])
{
    double kind = next(r), z = next(r), phi = 2.0 * pi * next(r);
    z = kind < 0.33 ? 1e-5 + 0.01 * z * z * z : kind < 0.43 ? 1.0 - 1e-6 * z : 0.001 + z * 0.999;
    double side = sqrt(1.0 - z * z);
    d[0]        = side * cos(phi);
    d[1]        = side * sin(phi);
    d[2]        = z;
}

/* Half of them mirrored by a facet near n. */
static void random_partner(random_numbers *r, const double o[3], double alpha, double d[3])
{
    random_direction(r, d);
    if (next(r) < 0.5) {
        double t = alpha * pow(next(r), -0.5), phi = 2.0 * pi * next(r);
        double c = 1.0 / sqrt(1.0 + t * t), h[3] = { c * t * cos(phi), c * t * sin(phi), c };
        double o_h = o[0] * h[0] + o[1] * h[1] + o[2] * h[2];
        for (int k = 0; k < 3; k++)
            d[k] = 2.0 * o_h * h[k] - o[k];
    }
    d[2] = (next(r) < 0.3 ? -1.0 : 1.0) * fmax(fabs(d[2]), 1e-5);
}

/* A share, its ends included. */
static float random_share(random_numbers *r)
{
    double kind = next(r), u = next(r);
    return kind < 0.1 ? 0.0f : kind < 0.2 ? 1.0f : (float)u;
}

typedef struct question {
    gloss_desc d;
    double n[3], wo[3], wi[3];
} question;

/* As packets know it, but unit. */
static void as_floats(double d[3])
{
    double size = 0.0;
    for (int k = 0; k < 3; k++) {
        d[k] = (double)(float)d[k];
        size += d[k] * d[k];
    }
    for (int k = 0; k < 3; k++)
        d[k] /= sqrt(size);
}

/* About x, and then about z. */
static void turn(question *q, double x, double z)
{
    double *all[] = { q->n, q->wo, q->wi };
    for (int k = 0; k < 3; k++) {
        double *d = all[k], y = cos(x) * d[1] - sin(x) * d[2], up = sin(x) * d[1] + cos(x) * d[2];
        double e[3] = { cos(z) * d[0] - sin(z) * y, sin(z) * d[0] + cos(z) * y, up };
        memcpy(d, e, sizeof e);
    }
}

static question random_question(random_numbers *r)
{
    question q         = { .d = plain };
    q.d.base_color     = (vec3){ random_share(r), random_share(r), random_share(r) };
    q.d.specular_color = (vec3){ 2.0f * random_share(r), random_share(r), random_share(r) };
    q.d.metallic       = random_share(r);
    q.d.roughness      = random_share(r);
    q.d.transmission   = random_share(r);
    q.d.specular       = random_share(r);
    double roughness   = fmax((double)q.d.roughness, (double)GGX_LEAST_ROUGHNESS);
    random_direction(r, q.wo);
    random_partner(r, q.wo, roughness * roughness, q.wi);
    q.n[2] = 1.0;
    if (next(r) < 0.5)
        turn(&q, 2.0 * pi * next(r), 2.0 * pi * next(r));
    as_floats(q.n);
    as_floats(q.wo);
    as_floats(q.wi);
    return q;
}

/* One of the vectors of each lane. */
static vvec3 vectors(const question *q, size_t offset)
{
    float d[3][LANES];
    for (int i = 0; i < LANES; i++)
        for (int k = 0; k < 3; k++)
            d[k][i] = (float)((const double *)(const void *)((const char *)(q + i) + offset))[k];
    return (vvec3){ vload(d[0]), vload(d[1]), vload(d[2]) };
}

/* One field of each lane's description. */
static vfloat field(const question *q, size_t offset)
{
    float a[LANES];
    for (int i = 0; i < LANES; i++)
        a[i] = *(const float *)(const void *)((const char *)&q[i].d + offset);
    return vload(a);
}

#define FIELD(q, name) field(q, offsetof(gloss_desc, name))

static vrgb rgb_field(const question *q, size_t offset)
{
    return (vrgb){ field(q, offset), field(q, offset + sizeof(float)),
                   field(q, offset + 2 * sizeof(float)) };
}

static vlook looks(const question *q)
{
    return (vlook){ .color           = rgb_field(q, offsetof(gloss_desc, base_color)),
                    .specular        = rgb_field(q, offsetof(gloss_desc, specular_color)),
                    .metallic        = FIELD(q, metallic),
                    .roughness       = FIELD(q, roughness),
                    .transmission    = FIELD(q, transmission),
                    .specular_weight = FIELD(q, specular) };
}

/* How far a float may be off: a share of 1e-5; by the rounding of wo + wi, 2^-24 in each
 * coordinate, which turns a short sum about (D goes with the fourth power of its slope); and by
 * that of the cosines, where the normal is along no axis. */
static double allowed(const question *q)
{
    double r = fmax((double)q->d.roughness, (double)GGX_LEAST_ROUGHNESS), alpha = r * r;
    double m_o = 0.0, m_i = 0.0, along2 = 0.0;
    for (int k = 0; k < 3; k++) {
        m_o += q->n[k] * q->wo[k];
        m_i += q->n[k] * q->wi[k];
    }
    for (int k = 0; k < 3; k++) {
        double away = q->wo[k] + q->wi[k] - (m_o + m_i) * q->n[k];
        along2 += away * away;
    }
    m_i           = fabs(m_i);
    bool level    = q->n[2] == 1.0;
    double turned = (level ? 8.0 : 24.0) * 0x1p-24 / (sqrt(along2) + alpha * (m_o + m_i));
    return 1e-5 + turned + (level ? 0.0 : 4.0 * 0x1p-24 * (1.0 / m_o + 1.0 / m_i));
}

static void compare(const question *q, const vrgb *f, const vrgb *albedo, vfloat pdf, int i)
{
    gloss_twin want      = gloss_twin_of(&q->d, q->n, q->wo, q->wi);
    const double got[3]  = { (double)lane(f->x, i), (double)lane(f->y, i), (double)lane(f->z, i) };
    const double back[3] = { (double)lane(albedo->x, i), (double)lane(albedo->y, i),
                             (double)lane(albedo->z, i) };
    double most          = allowed(q);
    for (int c = 0; c < 3; c++) {
        if (!(fabs(got[c] - want.f_cos[c]) <= most * want.f_cos[c] + 1e-6))
            fail_msg("f cos is %.9g, not %.9g (off %.2g, allowed %.2g): roughness %g, from %g %g "
                     "%g to %g %g %g",
                     got[c], want.f_cos[c], got[c] / want.f_cos[c] - 1.0, most,
                     (double)q->d.roughness, q->wi[0], q->wi[1], q->wi[2], q->wo[0], q->wo[1],
                     q->wo[2]);
        assert_true(fabs(back[c] - want.albedo[c]) <= fmin(most, 1e-3));
    }
    most += 4e-7 / fmax(want.left, 1e-12); /* of surfaces all but black the parts are roundings */
    if (!(fabs((double)lane(pdf, i) - want.pdf) <= most * want.pdf + 1e-6))
        fail_msg(
            "the pdf is %.9g, not %.9g (allowed %.2g): roughness %g, from %g %g %g to %g %g %g",
            (double)lane(pdf, i), want.pdf, most, (double)q->d.roughness, q->wi[0], q->wi[1],
            q->wi[2], q->wo[0], q->wo[1], q->wo[2]);
}

/* A million lanes, each of a look of its own, as textures would have it. */
TEST(packets_agree_with_a_scalar_twin)
{
    static const material_textures even = { .normal_scale = 1.0f };
    arena a                             = { 0 };
    gloss_desc d                        = plain;
    d.extra.textures                    = &even;
    const material *m                   = material_gloss(&a, &d, NULL);
    random_numbers r                    = { 5 };
    for (int n = 0; n < 1000000; n += LANES) {
        question q[LANES];
        for (int i = 0; i < LANES; i++)
            q[i] = random_question(&r);
        vvec3 normal = vectors(q, offsetof(question, n)), wi = vectors(q, offsetof(question, wi));
        vshading s = { .wo       = vectors(q, offsetof(question, wo)),
                       .n        = normal,
                       .flat     = normal,
                       .front    = ALL_LANES,
                       .distance = vsplat(1.0f),
                       .look     = looks(q) };
        vfloat pdf;
        vrgb f      = materials_reflect(&m, vsplat_int(0), &s, &wi, ALL_LANES, &pdf);
        vrgb albedo = materials_albedo(&m, vsplat_int(0), &s, ALL_LANES);
        for (int i = 0; i < LANES; i++)
            compare(&q[i], &f, &albedo, pdf, i);
    }
    arena_clear(&a);
}

/* ---- what is refused --------------------------------------------------------------------------
 */

TEST(values_out_of_range_are_refused)
{
    arena a                 = { 0 };
    gloss_desc bad[]        = { plain, plain, plain, plain, plain, plain, plain, plain, plain };
    bad[0].base_color.y     = 1.1f;
    bad[1].metallic         = -0.1f;
    bad[2].roughness        = NAN;
    bad[3].transmission     = 2.0f;
    bad[4].ior              = 0.5f;
    bad[5].ior              = 5.0f;
    bad[6].specular         = 1.5f;
    bad[7].specular_color.z = -1.0f;
    bad[8].specular_color.x = INFINITY;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        lux_error err = { 0 };
        assert_null(material_gloss(&a, &bad[i], &err));
        assert_int_equal(err.code, ERR_ARGUMENT);
    }
    lux_error err = { 0 };
    memory_is_out = true;
    assert_null(material_gloss(&a, &plain, &err));
    memory_is_out = false;
    assert_int_equal(err.code, ERR_MEMORY);
    arena_clear(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(albedo_is_the_integral_at_every_roughness),
        cmocka_unit_test(transmission_takes_what_the_base_would),
        cmocka_unit_test(every_f0_adds_up),
        cmocka_unit_test(white_metal_and_white_dielectrics_lose_nothing),
        cmocka_unit_test(reflectance_is_the_mean_albedo),
        cmocka_unit_test(the_smoothest_is_a_mirror),
        cmocka_unit_test(paths_may_be_walked_backwards),
        cmocka_unit_test(a_white_furnace_holds_frosted_glass),
        cmocka_unit_test(directions_follow_their_pdf),
        cmocka_unit_test(packets_are_finite_and_masked),
        cmocka_unit_test(no_draw_weighs_much),
        cmocka_unit_test(packets_agree_with_a_scalar_twin),
        cmocka_unit_test(values_out_of_range_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
