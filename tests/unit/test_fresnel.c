/* tests/unit/test_fresnel.c -- borders and slabs of glass: Fresnel's formulae in double, and tables
 * of the transmittance of a pane. */
#include "materials/fresnel.h"
#include "tests/test.h"

static const double pi = 3.14159265358979324;

/* ---- the scalar twin ----------------------------------------------------------------------------
 */

typedef struct fresnel {
    double s, p, cos_t; /* reflected shares of power; the cosine is 0 at total reflection */
} fresnel;

/* Hecht, Optics, 4.34 and 4.40: by the angles themselves. */
static fresnel border(double cos_i, double eta)
{
    double i = acos(cos_i), sin_t = sin(i) / eta;
    if (sin_t >= 1.0)
        return (fresnel){ 1, 1, 0 };
    double t = asin(sin_t);
    if (i < 1e-4) /* where both formulae are 0 / 0 */
        return (fresnel){ pow((eta - 1) / (eta + 1), 2), pow((eta - 1) / (eta + 1), 2), cos(t) };
    return (fresnel){ pow(sin(i - t) / sin(i + t), 2), pow(tan(i - t) / tan(i + t), 2), cos(t) };
}

/* Passages one by one, until nothing is left. */
static void slab(double r, double a, double *passed, double *reflected)
{
    double inside = (1.0 - r) * a;
    *passed       = 0.0;
    *reflected    = r;
    for (int i = 0; i < 200000 && inside > 1e-16; i++) {
        *(i % 2 ? reflected : passed) += (1.0 - r) * inside;
        inside *= r * a;
    }
}

static double slab_passed(double theta_deg, double ior, double tau)
{
    fresnel f = border(cos(theta_deg * pi / 180), ior);
    double a  = pow(tau, 1.0 / f.cos_t), s, p, back;
    slab(f.s, a, &s, &back);
    slab(f.p, a, &p, &back);
    return 0.5 * (s + p);
}

/* -------------------------------------------------------------------------------------------------
 */

/* To 1e-6 of what the twin says for a cosine of a rounding more or less: near the critical angle
 * the root of a small difference is taken. */
static void expect_border(double cos_i, double eta)
{
    double step = 3e-7;
    fresnel low = border(fmax(cos_i - step, 0.0), eta), at = border(cos_i, eta),
            high   = border(fmin(cos_i + step, 1.0), eta);
    vfresnel got   = vfresnel_border(vsplat((float)cos_i), vsplat((float)eta));
    double error_s = 1e-6 + fabs(high.s - low.s), error_p = 1e-6 + fabs(high.p - low.p);
    assert_true(fabs((double)lane(got.reflected.s, 0) - at.s) <= error_s);
    assert_true(fabs((double)lane(got.reflected.p, 0) - at.p) <= error_p);
    assert_true(fabs((double)lane(got.passed.s, 0) - (1.0 - at.s)) <= error_s);
    assert_true(fabs((double)lane(got.passed.p, 0) - (1.0 - at.p)) <= error_p);
    assert_true(fabs((double)lane(got.cos_t, 0) - at.cos_t) <= 1e-6 + fabs(high.cos_t - low.cos_t));
}

TEST(borders_reflect_as_fresnel_says)
{
    static const float etas[] = { 1.0001f, 1.33f, 1.52f, 4, 1 / 1.33f, 1 / 1.52f, 0.25f };
    for (size_t k = 0; k < sizeof etas / sizeof *etas; k++)
        for (int i = 0; i <= 20000; i++) {
            double x = i / 20000.0;
            expect_border((double)(float)(x * x * x), (double)etas[k]); /* most of them grazing */
        }
}

/* At Brewster's angle, tan = n, light polarised along the plane of incidence passes wholly; the
 * rest is reflected by ((n^2 - 1) / (n^2 + 1))^2. */
TEST(at_brewsters_angle_one_polarisation_passes)
{
    for (double n = 1.1; n < 4; n += 0.3) {
        double across = pow((n * n - 1) / (n * n + 1), 2);
        vfresnel f    = vfresnel_border(vsplat((float)(1.0 / sqrt(1.0 + n * n))), vsplat((float)n));
        assert_true((double)lane(f.reflected.p, 0) < 1e-12);
        assert_near(lane(f.passed.p, 0), 1.0, 1e-6);
        assert_near(lane(f.reflected.s, 0), across, 1e-5);
    }
}

/* With and against a border light of one and the same ray is reflected alike (Stokes). */
TEST(borders_reflect_alike_from_both_sides)
{
    for (double c = 0.01; c < 1; c += 1e-3) {
        vfresnel in  = vfresnel_border(vsplat((float)c), vsplat(1.5f));
        vfresnel out = vfresnel_border(in.cos_t, vsplat(1.0f / 1.5f));
        /* A rounding of cos_t moves cos_i by 1e-7 / c, and R by 6 times as much */
        assert_near(lane(vunpolarised(out.reflected), 0), lane(vunpolarised(in.reflected), 0),
                    1e-6 / c + 1e-6);
    }
}

TEST(beyond_the_critical_angle_all_is_reflected)
{
    double critical = asin(1 / 1.5);
    for (double i = critical + 1e-6; i < pi / 2; i += 1e-3) {
        vfresnel f = vfresnel_border(vsplat((float)cos(i)), vsplat(1.0f / 1.5f));
        assert_true(vall(f.reflected.s == 1.0f) && vall(f.passed.p == 0.0f) &&
                    vall(f.cos_t == 0.0f));
    }
    vfresnel grazing = vfresnel_border(vsplat(0.0f), vsplat(1.0f / 1.5f));
    assert_true(vall(grazing.reflected.s == 1.0f) && vall(grazing.reflected.p == 1.0f));
    grazing = vfresnel_border(vsplat(0.0f), vsplat(1.5f));
    assert_true(vall(grazing.reflected.s == 1.0f) && vall(grazing.passed.p == 0.0f));
}

/* Published for 6 mm clear glass: without absorption, n = 1.52, and n = 1.53 of which the inside
 * lets 0.964 through, which is the pane of CIE 171:2006, 5.10; four digits. */
static const double angles[]     = { 0, 10, 20, 30, 40, 50, 60, 70, 80, 85 };
static const double clear_152[]  = { .9183, .9183, .9179, .9160, .9095,
                                     .8912, .8435, .7247, .4560, .2456 };
static const double cie_pane[]   = { .8828, .8826, .8816, .8786, .8709,
                                     .8515, .8036, .6876, .4268, .2217 };
static const double half_a_digit = 0.5e-4 + 1e-6;

static vslab slab_at(double theta_deg, float ior, double tau)
{
    vfresnel f = vfresnel_border(vsplat((float)cos(theta_deg * pi / 180)), vsplat(ior));
    return vslab_whole(&f, vsplat((float)log2(tau)));
}

TEST(panes_let_through_what_the_tables_say)
{
    for (size_t i = 0; i < sizeof angles / sizeof *angles; i++) {
        assert_true(fabs((double)lane(slab_at(angles[i], 1.52f, 1).passed, 0) - clear_152[i]) <=
                    half_a_digit);
        assert_true(fabs((double)lane(slab_at(angles[i], 1.53f, 0.964).passed, 0) - cie_pane[i]) <=
                    half_a_digit);
    }
}

TEST(passages_add_up)
{
    static const double taus[] = { 1, 0.999999, 0.964, 0.5, 1e-6, 0 };
    for (size_t k = 0; k < sizeof taus / sizeof *taus; k++)
        for (double theta = 0; theta < 89.95; theta += 0.7) {
            vslab got = slab_at(theta, 1.5f, taus[k]);
            assert_true(fabs((double)lane(got.passed, 0) - slab_passed(theta, 1.5, taus[k])) <=
                        2e-6);
            double all = (double)lane(got.passed, 0) + (double)lane(got.reflected, 0);
            assert_true(all <= 1.0 + 1e-6);
            if (taus[k] == 1)
                assert_near(all, 1.0, 1e-6);
        }
}

/* T -> 2 e / 2 per polarisation as e = 1 - R -> 0 */
TEST(grazing_slabs_lose_no_digits)
{
    for (double c = 1e-3; c > 1e-9; c *= 0.1) {
        vfresnel f = vfresnel_border(vsplat((float)c), vsplat(1.5f));
        vslab got  = vslab_whole(&f, vsplat(0.0f));
        double t = sqrt(1.0 - 1.0 / 2.25), s = 4 * c / (1.5 * t), p = 4 * 1.5 * c / t;
        assert_near(lane(got.passed, 0), 0.25 * (s + p), 10 * c + 1e-6);
    }
}

/* Nowhere a mirror where both are bent the same way: a refracted way keeps n sin, in double. */
TEST(light_is_bent_as_snell_says)
{
    for (double i = 0; i < pi / 2; i += 0.01) {
        vshading s = { .wo = vspread((vec3){ (float)sin(i), 0, (float)cos(i) }),
                       .n  = vspread((vec3){ 0, 0, 1 }) };
        s.flat     = s.n;
        for (int k = 0; k < 2; k++) {
            float eta      = k ? 1.52f : 1 / 1.52f;
            vfresnel f     = vfresnel_border(s.wo.z, vsplat(eta));
            double sin_t   = sin(i) / (double)eta;
            vvec3 mirrored = vmirrored(&s), wi = vrefracted(&s, s.wo.z, f.cos_t, eta + 0 * s.wo.z);
            assert_true(vall(mirrored.x == -s.wo.x) && vall(mirrored.z == s.wo.z));
            if (sin_t > 0.9999)
                continue; /* the cosine is a root of what is left of rounding */
            assert_true(fabs((double)lane(wi.x, 0) + sin_t) <= 3e-6);
            assert_true(fabs((double)lane(wi.z, 0) + sqrt(1 - sin_t * sin_t)) <= 1e-5);
        }
    }
}

/* A shading normal that leans away from the eye mirrors and bends to the wrong side of the
 * triangle: that is put right. */
TEST(nothing_leaks_through_a_triangle)
{
    vshading s = { .flat = vspread((vec3){ 0, 0, 1 }),
                   .wo   = vnormalize(vspread((vec3){ 10, 0, 1 })),
                   .n    = vnormalize(vspread((vec3){ -1.5f, 0, 20 })) };
    vvec3 wi   = vmirrored(&s);
    assert_true(vall(vdot(wi, s.flat) > 0.0f));
    assert_near(lane(vlength(wi), 0), 1.0, 1e-6);
    s.n = vnormalize(vspread((vec3){ 1, 0, -0.5f }));
    wi  = vrefracted(&s, vdot(s.wo, s.n), vsplat(0.9f), vsplat(1.5f));
    assert_true(vall(vdot(wi, s.flat) < 0.0f));
    assert_near(lane(vlength(wi), 0), 1.0, 1e-6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(borders_reflect_as_fresnel_says),
        cmocka_unit_test(at_brewsters_angle_one_polarisation_passes),
        cmocka_unit_test(borders_reflect_alike_from_both_sides),
        cmocka_unit_test(beyond_the_critical_angle_all_is_reflected),
        cmocka_unit_test(panes_let_through_what_the_tables_say),
        cmocka_unit_test(passages_add_up),
        cmocka_unit_test(grazing_slabs_lose_no_digits),
        cmocka_unit_test(light_is_bent_as_snell_says),
        cmocka_unit_test(nothing_leaks_through_a_triangle),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
