/* tests/material_checks.c -- see material_checks.h. */
#include "tests/material_checks.h"

#include "core/sampler.h"
#include "tests/material_points.h"

#include <stdio.h>

/* ---- asking ---------------------------------------------------------------------------------- */

static dir direction(double theta_deg, double phi_deg, bool front)
{
    double theta = theta_deg * pi / 180.0, phi = phi_deg * pi / 180.0;
    double z = cos(theta);
    return (dir){ sin(theta) * cos(phi), sin(theta) * sin(phi), front ? z : -z };
}

vshading material_seen_from(const material *m, double theta_deg, double phi_deg, bool front)
{
    return seen_from(m, direction(theta_deg, phi_deg, front));
}

/* Independent numbers in [0,1). */
static vfloat even(uint32_t n, uint32_t seed)
{
    vuint bits = vhash_combine(vsplat_uint(seed), vunsigned(vlane_index()) + n);
    return vto_float(vsigned(bits >> 8)) * 0x1p-24f;
}

/* ---- quadrature of reflect() on one side of the surface ---------------------------------------
 */

enum { ROWS = 16, COLUMNS = 32, FINE = 24, CELLS = ROWS * COLUMNS };

/* The energy (if not NULL), and the integral of the pdf over each of ROWS * COLUMNS cells in polar
 * coordinates: FINE * FINE points in each. */
static void integrate(const material *m, dir wo, bool transmitted, double *rgb, double *share)
{
    const double dx = 1.0 / (ROWS * FINE), dphi = 2.0 * pi / (COLUMNS * FINE);
    vshading s  = seen_from(m, wo);
    polar about = polar_about(wo, transmitted);
    double sign = (wo.z < 0.0) == transmitted ? 1.0 : -1.0; /* of the z that count */
    for (int i = 0; i < ROWS * FINE; i++) {
        double x = (i + 0.5) * dx, omega = polar_solid_angle(x, dx, dphi);
        for (int j = 0; j < COLUMNS * FINE; j += LANES) {
            float to[3][LANES];
            for (int k = 0; k < LANES; k++) {
                dir d    = polar_direction(&about, x, (j + k + 0.5) * dphi);
                to[0][k] = (float)d.x;
                to[1][k] = (float)d.y;
                to[2][k] = (float)d.z;
            }
            vvec3 wi     = { vload(to[0]), vload(to[1]), vload(to[2]) };
            vmask inside = wi.z * (float)sign > 0.0f;
            if (!vany(inside))
                continue;
            vfloat pdf;
            vrgb f = materials_reflect(&m, vsplat_int(0), &s, &wi, inside, &pdf);
            for (int k = 0; k < LANES; k++) {
                for (int c = 0; c < 3; c++)
                    rgb[c] += omega * lane_channel(&f, k, c);
                share[i / FINE * COLUMNS + (j + k) / FINE] += omega * (double)lane(pdf, k);
            }
        }
    }
}

/* ---- what scatter() draws ---------------------------------------------------------------------
 */

enum { ROUNDS = 16, DRAWS = 4096 };

/* The mean weight of one round, on either side; of single directions alone, and of those straight
 * on. */
typedef struct drawn {
    energy all, single;
    double straight[3];
} drawn;

static void draw_round(const material *m, const vshading *s, uint32_t seed, drawn *d)
{
    *d = (drawn){ 0 };
    for (uint32_t i = 0; i < DRAWS; i += LANES) {
        vscatter out;
        vsample4 p = vsobol4(vunsigned(vlane_index()) + i, vsplat_uint(seed));
        vmask goes = materials_scatter(&m, vsplat_int(0), s, p.x, p.y, p.z, ALL_LANES, &out);
        vmask back = vdot(out.wi, s->n) > 0.0f;
        for (int k = 0; k < LANES; k++)
            for (int c = 0; c < 3 && (lane(goes, k) & 1); c++) {
                double w    = lane_channel(&out.weight, k, c) / DRAWS;
                bool single = lane(out.pdf, k) == INFINITY;
                bool up     = lane(back, k) & 1;
                *(up ? &d->all.reflected[c] : &d->all.transmitted[c]) += w;
                if (single)
                    *(up ? &d->single.reflected[c] : &d->single.transmitted[c]) += w;
                if (lane(out.straight, k) & 1)
                    d->straight[c] += w;
            }
    }
}

typedef struct estimate {
    double mean, error; /* standard error of the mean */
} estimate;

/* Of one figure of each round. */
static estimate over_rounds(const drawn *rounds, const double *of_first)
{
    double sum = 0.0, squares = 0.0;
    size_t offset = (size_t)((const char *)of_first - (const char *)rounds);
    for (int r = 0; r < ROUNDS; r++)
        sum += *(const double *)(const void *)((const char *)(rounds + r) + offset);
    double mean = sum / ROUNDS;
    for (int r = 0; r < ROUNDS; r++) {
        double x = *(const double *)(const void *)((const char *)(rounds + r) + offset);
        squares += (x - mean) * (x - mean);
    }
    return (estimate){ mean, sqrt(squares / (ROUNDS * (ROUNDS - 1))) };
}

static void draw_rounds(const material *m, const vshading *s, drawn rounds[ROUNDS])
{
    for (uint32_t r = 0; r < ROUNDS; r++)
        draw_round(m, s, r, &rounds[r]);
}

static energy integral(const material *m, dir wo, const drawn *rounds)
{
    energy e            = { 0 };
    double share[CELLS] = { 0 };
    integrate(m, wo, false, e.reflected, share);
    integrate(m, wo, true, e.transmitted, share);
    for (int c = 0; c < 3; c++) {
        e.reflected[c] += over_rounds(rounds, &rounds->single.reflected[c]).mean;
        e.transmitted[c] += over_rounds(rounds, &rounds->single.transmitted[c]).mean;
    }
    return e;
}

energy material_albedo_integral(const material *m, double theta_deg, double phi_deg, bool front)
{
    drawn rounds[ROUNDS];
    dir wo     = direction(theta_deg, phi_deg, front);
    vshading s = seen_from(m, wo);
    draw_rounds(m, &s, rounds);
    return integral(m, wo, rounds);
}

/* ---- the white furnace ------------------------------------------------------------------------
 */

/* The mean weight has a standard error of its own, of 15 degrees of freedom: t = 6.5 is passed once
 * in 10^5. Quadrature and albedo share 1e-3. */
static void expect_weight(const material *m, const char *where, const char *what,
                          const drawn *rounds, const double *figure, double want)
{
    estimate e = over_rounds(rounds, figure);
    if (!(fabs(e.mean - want) <= 1e-3 + 6.5 * e.error))
        fail_msg("%s, %s: %s by scatter() is %.6f +- %.6f, not %.6f", m->type->name, where, what,
                 e.mean, e.error, want);
}

static void check_furnace_at(const material *m, double theta, bool front)
{
    char where[64];
    snprintf(where, sizeof where, "%g deg on its %s", theta, front ? "front" : "back");
    drawn rounds[ROUNDS];
    dir wo     = direction(theta, 20, front);
    vshading s = seen_from(m, wo);
    draw_rounds(m, &s, rounds);
    energy e     = integral(m, wo, rounds);
    vrgb albedo  = materials_albedo(&m, vsplat_int(0), &s, ALL_LANES);
    vrgb through = materials_through(&m, vsplat_int(0), &s, ALL_LANES);
    for (int c = 0; c < 3; c++) {
        double a = lane_channel(&albedo, 0, c), sum = e.reflected[c] + e.transmitted[c];
        if (!(a >= 0.0 && a <= 1.0 + 1e-5))
            fail_msg("%s, %s: an albedo of %.7f", m->type->name, where, a);
        if (!(sum <= 1.0 + 1e-3))
            fail_msg("%s, %s: %.6f of the light leaves", m->type->name, where, sum);
        if (!(fabs(a - e.reflected[c]) <= 1e-3))
            fail_msg("%s, %s: albedo() is %.6f, its integral %.6f", m->type->name, where, a,
                     e.reflected[c]);
        expect_weight(m, where, "reflected", rounds, &rounds->all.reflected[c], e.reflected[c]);
        expect_weight(m, where, "let through", rounds, &rounds->all.transmitted[c],
                      e.transmitted[c]);
        if (!m->solid)
            expect_weight(m, where, "straight on", rounds, &rounds->straight[c],
                          lane_channel(&through, 0, c));
    }
}

void material_check_furnace(const material *m)
{
    static const double theta[] = { 0, 30, 60, 80, 89, 89.99 };
    for (size_t i = 0; i < sizeof theta / sizeof *theta; i++) {
        check_furnace_at(m, theta[i], true);
        check_furnace_at(m, theta[i], false);
    }
}

/* ---- sampling against the pdf ------------------------------------------------------------------
 */

static void check_against_reflect(const material *m, const vshading *s, const vscatter *out,
                                  vmask wide)
{
    vfloat pdf;
    vrgb f = materials_reflect(&m, vsplat_int(0), s, &out->wi, wide, &pdf);
    for (int k = 0; k < LANES; k++) {
        if (!(lane(wide, k) & 1))
            continue;
        double said = (double)lane(out->pdf, k), is = (double)lane(pdf, k);
        if (!(is > 0.0 && fabs(said - is) <= 1e-4 * is))
            fail_msg("%s: scatter() says a pdf of %.9g, reflect() of %.9g", m->type->name, said,
                     is);
        for (int c = 0; c < 3; c++) {
            double w = lane_channel(&out->weight, k, c), want = lane_channel(&f, k, c) / is;
            if (!(fabs(w - want) <= 1e-4 * want + 1e-7))
                fail_msg("%s: a weight of %.9g, where f cos / pdf is %.9g", m->type->name, w, want);
        }
    }
}

/* The last cell takes what goes to single directions and what is lost. */
static void count_draws(const material *m, dir wo, uint32_t draws, int count[2 * CELLS + 1])
{
    vshading s     = seen_from(m, wo);
    polar about[2] = { polar_about(wo, false), polar_about(wo, true) };
    for (uint32_t n = 0; n < draws; n += LANES) {
        vscatter out;
        vmask goes = materials_scatter(&m, vsplat_int(0), &s, even(n, 1), even(n, 2), even(n, 3),
                                       ALL_LANES, &out);
        vmask wide = goes & (out.pdf < INFINITY);
        check_against_reflect(m, &s, &out, wide);
        vfloat side = vdot(out.wi, s.n);
        for (int k = 0; k < LANES; k++) {
            double x, phi;
            int half = lane(side, k) < 0.0f;
            polar_of(&about[half], lane_dir(&out.wi, k), &x, &phi);
            int row    = (int)fmin(x * ROWS, ROWS - 1);
            int column = (int)fmin(phi / (2.0 * pi) * COLUMNS, COLUMNS - 1);
            count[lane(wide, k) & 1 ? half * CELLS + row * COLUMNS + column : 2 * CELLS]++;
        }
    }
}

static void check_sampling_at(const material *m, double theta, bool front)
{
    enum { SAMPLES = 1 << 17 };
    dir wo                         = direction(theta, 30, front);
    double rgb[3]                  = { 0 };
    double expected[2 * CELLS + 1] = { 0 }, sum = 0.0;
    int count[2 * CELLS + 1] = { 0 };
    integrate(m, wo, false, rgb, expected);
    integrate(m, wo, true, rgb, expected + CELLS);
    for (int i = 0; i < 2 * CELLS; i++)
        sum += expected[i];
    if (!(sum <= 1.0 + 1e-3))
        fail_msg("%s at %g deg: the pdf's integral is %.6f", m->type->name, theta, sum);
    expected[2 * CELLS] = fmax(1.0 - sum, 0.0);
    for (int i = 0; i <= 2 * CELLS; i++)
        expected[i] *= SAMPLES / fmax(sum, 1.0);

    count_draws(m, wo, SAMPLES, count);
    double chance = chi_square_test(expected, count, 2 * CELLS + 1);
    if (!(chance > 1e-5))
        fail_msg("%s at %g deg on its %s: directions follow their pdf with a chance of %g",
                 m->type->name, theta, front ? "front" : "back", chance);
}

void material_check_sampling(const material *m)
{
    static const double theta[] = { 0, 45, 80, 89 };
    for (size_t i = 0; i < sizeof theta / sizeof *theta; i++) {
        check_sampling_at(m, theta[i], true);
        check_sampling_at(m, theta[i], false);
    }
}
