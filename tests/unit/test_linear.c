/* tests/unit/test_linear.c -- the line: closed forms, quadrature in double, its sampler. */
#include "core/sampler.h"
#include "core/transform.h"
#include "lights/light.h"
#include "tests/shapes.h"
#include "tests/test.h"

static const double pi = 3.14159265358979324;

static const light *make(arena *a, vec3 from, vec3 to)
{
    linear_desc d  = { from, to, { 1, 2, 3 } };
    const light *l = light_linear(a, &d, NULL);
    assert_non_null(l);
    return l;
}

/* The red channel of the closed form, in W/m^2, for 1 W/sr */
static double closed(const light *l, vec3 at, vec3 normal)
{
    vvec3 p = vspread(at), n = vspread(normal);
    vrgb e = l->type->irradiance(l, &p, &n, ALL_LANES);
    assert_true(lane(e.z, 0) == 3 * lane(e.x, 0) || fabsf(lane(e.z, 0) / lane(e.x, 0) - 3) < 1e-5f);
    return (double)lane(e.x, 0);
}

/* By the midpoint rule over the angle; *facing: of each element on a surface that faces it. */
static double by_quadrature(vec3 from, vec3 to, vec3 at, vec3 normal, double *facing)
{
    enum { N = 4000 };
    dvec3 b = d3_from(from), p = d3_from(at), n = d3_from(normal);
    dvec3 t       = d3_add(d3_from(to), d3_scale(b, -1));
    double length = d3_length(t);
    t             = d3_scale(t, 1 / length);
    dvec3 start   = d3_add(b, d3_scale(p, -1));
    double u0     = d3_dot(start, t);
    dvec3 foot    = d3_add(start, d3_scale(t, -u0));
    double h      = d3_length(foot);
    double a0 = atan2(u0, h), a1 = atan2(u0 + length, h), sum = 0;
    *facing = 0;
    for (int i = 0; i < N; i++) {
        double a = a0 + (a1 - a0) * (i + 0.5) / N;
        dvec3 w  = d3_add(d3_scale(foot, cos(a) / h), d3_scale(t, sin(a)));
        double e = cos(a) * (a1 - a0) / N / (h * length);
        *facing += e;
        sum += e * fmax(d3_dot(n, w), 0);
    }
    return sum;
}

/* The mean of 64 samples. */
static double by_samples(const light *l, vec3 at, vec3 normal, uint32_t seed)
{
    vvec3 p = vspread(at), n = vspread(normal);
    double sum = 0;
    for (uint32_t i = 0; i < 64; i += LANES) {
        vsample4 u = vsobol4(vunsigned(vlane_index()) + i, vsplat_uint(seed));
        vlight_sample s;
        light_sample(l, &p, u.x, u.y, ALL_LANES, &s);
        sum += (double)vsum(s.e.x * vmax(vdot(n, s.wi), vsplat(0)));
    }
    return sum / 64;
}

TEST(closed_forms_of_the_reference_come_out)
{
    arena a        = { 0 };
    const light *l = make(&a, (vec3){ 0, 0, 2 }, (vec3){ 1.2f, 0, 2 });
    vec3 o = { 0, 0, 0 }, up = { 0, 0, 1 };
    assert_near(1.2 * closed(l, o, up), 0.245399, 3e-6); /* of 1 W/(sr m): its digits */
    double facing, alpha = atan(1.2 / 2);
    assert_near(by_quadrature((vec3){ 0, 0, 2 }, (vec3){ 1.2f, 0, 2 }, o, up, &facing) * 1.2,
                (alpha + sin(alpha) * cos(alpha)) / 4, 1e-7);
    /* Receivers across the line: (i0 / 2h) sin^2 alpha, half of it above the horizon */
    const light *even = make(&a, (vec3){ -1.2f, 0, 2 }, (vec3){ 1.2f, 0, 2 });
    double want       = sin(alpha) * sin(alpha) / (2 * 2 * 2.4);
    assert_near(closed(even, o, (vec3){ 1, 0, 0 }), want, 1e-6);
    assert_near(closed(even, o, (vec3){ -1, 0, 0 }), want, 1e-6);
    assert_true(closed(l, o, (vec3){ 0, 0, -1 }) == 0);
    arena_clear(&a);
}

TEST(a_thousand_places_and_tilts_agree_with_quadrature)
{
    arena a             = { 0 };
    uint32_t seed       = 11;
    double worst_closed = 0, worst_sampled = 0;
    for (int i = 0; i < 1000; i++) {
        vec3 from = random_point(&seed), to = random_point(&seed);
        const light *l = make(&a, from, to);
        float far      = i % 3 ? 2.0f : 50.0f;
        vec3 at        = v3_scale(random_point(&seed), far);
        vec3 n         = random_direction(&seed);
        double facing, want = by_quadrature(from, to, at, n, &facing);
        worst_closed  = fmax(worst_closed, fabs(closed(l, at, n) - want) / facing);
        worst_sampled = fmax(worst_sampled, fabs(by_samples(l, at, n, seed) - want) / facing);
    }
    assert_true(worst_closed < 1e-5);
    assert_true(worst_sampled < 5e-3);
    arena_clear(&a);
}

/* Beyond the ends, h / r from 0.1 down to 1e-3: there the angle is small, its cosine smaller */
TEST(near_the_axis_beyond_the_ends_it_stays_exact)
{
    arena a   = { 0 };
    vec3 from = { 0, 0, 0 }, to = { 0, 0, 1 };
    const light *l = make(&a, from, to);
    for (float h = 0.4f; h > 2e-3f; h *= 0.7f) {
        vec3 at = { h, 0, 4 }, n = { 0.6f, 0, -0.8f }, side = { -1, 0, 0 };
        double facing, want = by_quadrature(from, to, at, n, &facing);
        assert_near(closed(l, at, n), want, 1e-5);
        assert_near(by_samples(l, at, n, 5), want, 2e-3);
        want = by_quadrature(from, to, at, side, &facing);
        assert_near(closed(l, at, side), want, 1e-5);
        assert_near(by_samples(l, at, side, 5), want, 2e-3);
    }
    vec3 on_axis = { 0, 0, 4 }, inside = { 0, 0, 0.5f };
    assert_true(closed(l, on_axis, (vec3){ 0, 0, -1 }) == 0);
    assert_true(by_samples(l, on_axis, (vec3){ 0, 0, -1 }, 5) == 0);
    assert_true(closed(l, inside, (vec3){ 1, 0, 0 }) == 0);
    assert_true(by_samples(l, inside, (vec3){ 1, 0, 0 }, 5) == 0);
    arena_clear(&a);
}

/* At a distance of h an endless line gives (i0 / h) pi / 2; far away it is a point. */
TEST(close_and_far_limits_hold)
{
    arena a        = { 0 };
    const light *l = make(&a, (vec3){ 0, -1, 0 }, (vec3){ 0, 1, 0 });
    for (float h = 1e-6f; h < 2e-3f; h *= 10)
        assert_near(closed(l, (vec3){ h, 0, 0 }, (vec3){ -1, 0, 0 }), 0.5 * pi / (2 * (double)h),
                    1e-5);
    for (float d = 1e3f; d < 1e7f; d *= 10) {
        assert_near(closed(l, (vec3){ d, 0, 0 }, (vec3){ -1, 0, 0 }), pow((double)d, -2), 2e-6);
        assert_near(by_samples(l, (vec3){ d, 0, 0 }, (vec3){ -1, 0, 0 }, 1), pow((double)d, -2),
                    2e-6);
    }
    arena_clear(&a);
}

TEST(samples_are_even_in_the_angle)
{
    enum { CELLS = 64, N = 1 << 17 };
    arena a          = { 0 };
    const light *l   = make(&a, (vec3){ -1, 0, 0.3f }, (vec3){ 2, 0, 0.3f });
    vvec3 p          = vspread((vec3){ 0, 0, 0 });
    int count[CELLS] = { 0 };
    double expected[CELLS];
    double a0 = atan2(-1, 0.3), a1 = atan2(2, 0.3);
    for (int i = 0; i < CELLS; i++)
        expected[i] = (double)N / CELLS;
    uint32_t seed = 99;
    for (int n = 0; n < N; n += LANES) {
        float r[LANES];
        for (int i = 0; i < LANES; i++)
            r[i] = random_unit(&seed);
        vlight_sample s;
        light_sample(l, &p, vload(r), vsplat(0), ALL_LANES, &s);
        for (int i = 0; i < LANES; i++) {
            double angle = atan2((double)lane(s.wi.x, i), (double)lane(s.wi.z, i));
            int cell     = (int)(CELLS * (angle - a0) / (a1 - a0));
            count[cell < 0 ? 0 : cell >= CELLS ? CELLS - 1 : cell]++;
            assert_true(lane(s.pdf, i) == INFINITY);
            assert_near(lane(s.dist, i) * lane(s.wi.z, i), 0.3, 1e-5); /* it is on the line */
        }
    }
    assert_true(chi_square_test(expected, count, CELLS) > 0.01);
    assert_null(l->type->hit);
    arena_clear(&a);
}

/* The largest error over many tilts, the edge-on ones among them, against the bound */
TEST(as_a_point_it_is_off_by_no_more_than_its_bound)
{
    arena a         = { 0 };
    uint32_t seed   = 21;
    double tightest = 0;
    for (int i = 0; i < 300; i++) {
        vec3 from = random_point(&seed), to = random_point(&seed);
        const light *l = make(&a, from, to);
        vec3 at        = v3_scale(random_point(&seed), 2.0f + (float)(i % 10) * 4.0f);
        vvec3 p        = vspread(at);
        vlight_sample s;
        vfloat bound;
        l->type->as_point(l, &p, ALL_LANES, &s, &bound);
        assert_true(lane(bound, 0) > 0);
        if (lane(bound, 0) == INFINITY)
            continue;
        double white = 0.2126 + 0.7152 * 2 + 0.0722 * 3;
        for (int k = 0; k < 40; k++) {
            vec3 n   = random_direction(&seed);
            vec3 way = { lane(s.wi.x, 0), lane(s.wi.y, 0), lane(s.wi.z, 0) };
            if (k % 2) { /* nearly edge-on */
                vec3 side = v3_cross(n, way);
                n         = v3_scale(side, 1 / v3_length(side));
            }
            double facing, want = by_quadrature(from, to, at, n, &facing);
            double cos_n = d3_dot(d3_from(n), d3_from(way));
            double off   = white * fabs(want - (double)lane(s.e.x, 0) * fmax(cos_n, 0));
            double least = (double)lane(bound, 0) + 1e-6 * white * facing; /* of floats */
            assert_true(off <= least);
            tightest = fmax(tightest, off / least);
        }
    }
    assert_true(tightest > 0.9); /* and so not a rough one */
    vvec3 near_ = vspread((vec3){ 0.1f, 0, 0 });
    vlight_sample s;
    vfloat bound;
    const light *l = make(&a, (vec3){ 0, -1, 0 }, (vec3){ 0, 1, 0 });
    l->type->as_point(l, &near_, ALL_LANES, &s, &bound);
    assert_true(lane(bound, 0) == INFINITY);
    arena_clear(&a);
}

TEST(the_weight_is_positive_wherever_a_sample_lights)
{
    arena a       = { 0 };
    uint32_t seed = 31;
    for (int i = 0; i < 2000; i++) {
        const light *l = make(&a, random_point(&seed), random_point(&seed));
        vvec3 p        = vspread(v3_scale(random_point(&seed), 3));
        vvec3 n        = vspread(random_direction(&seed));
        vfloat w       = l->type->weight(l, &p, &n, ALL_LANES);
        assert_true(vall((w >= 0) & (w < INFINITY)));
        for (float t = 0; t < 1; t += 0.24f) {
            vlight_sample s;
            light_sample(l, &p, vsplat(t), vsplat(0), ALL_LANES, &s);
            assert_true(vall((w > 0) | ~(vdot(n, s.wi) > 1e-6f)));
        }
    }
    arena_clear(&a);
}

/* A sphere around it, even in area, receives pi^2 I. */
TEST(flux_peak_and_bounds_agree)
{
    arena a        = { 0 };
    const light *l = make(&a, (vec3){ 0, 0, -0.5f }, (vec3){ 0, 0, 0.5f });
    assert_near(light_flux(l).y, 2 * pi * pi, 1e-6);
    enum { N = 4000 };
    double sum = 0;
    for (int i = 0; i < N; i++) {
        double z = (2 * i + 1.0) / N - 1, r = sqrt(1 - z * z);
        vec3 out = { (float)r, 0, (float)z };
        sum += closed(l, v3_scale(out, 2), v3_scale(out, -1)) * 16 * pi / N;
    }
    assert_near(sum, pi * pi, 1e-4);
    vec3 toward, most = l->type->peak(l, &toward);
    assert_true(most.z == 3 && fabsf(toward.z) < 1e-6f);
    light_bounds b = light_bounds_of(l);
    assert_true(b.low.z == -0.5f && b.high.z == 0.5f && b.cos_spread == -1 && !b.far);
    assert_near(b.peak, 0.2126 + 0.7152 * 2 + 0.0722 * 3, 1e-6);
    arena_clear(&a);
}

TEST(dead_lanes_are_zero)
{
    arena a        = { 0 };
    const light *l = make(&a, (vec3){ 0, 0, 2 }, (vec3){ 1, 0, 2 });
    vvec3 p = vspread((vec3){ 0, 0, 0 }), n = vspread((vec3){ 0, 0, 1 });
    vmask one = vlane_index() < 1;
    vlight_sample s, c;
    vfloat bound;
    assert_int_equal(vbits(light_sample(l, &p, vsplat(0), vsplat(0), one, &s)), 1);
    assert_int_equal(vbits(l->type->as_point(l, &p, one, &c, &bound)), 1);
    vrgb e   = l->type->irradiance(l, &p, &n, one);
    vfloat w = l->type->weight(l, &p, &n, one);
    for (int i = 1; i < LANES; i++) {
        assert_true(lane(s.e.x, i) == 0 && lane(s.dist, i) == 0 && lane(s.pdf, i) == 0);
        assert_true(lane(c.e.x, i) == 0 && lane(c.dist, i) == 0 && lane(bound, i) == 0);
        assert_true(lane(e.y, i) == 0 && lane(w, i) == 0);
    }
    arena_clear(&a);
}

TEST(what_makes_no_sense_is_refused)
{
    arena a                = { 0 };
    lux_error err          = { 0 };
    const linear_desc good = { { 0, 0, 0 }, { 0, 0, 1 }, { 1, 1, 1 } };
    linear_desc d          = good;
    d.to                   = d.from;
    assert_null(light_linear(&a, &d, &err));
    assert_int_equal(err.code, ERR_ARGUMENT);
    d.to.x = NAN;
    assert_null(light_linear(&a, &d, &err));
    d             = good;
    d.intensity.z = -1;
    assert_null(light_linear(&a, &d, &err));
    memory_is_out = true;
    arena none    = { 0 };
    assert_null(light_linear(&none, &good, &err));
    memory_is_out = false;
    assert_int_equal(err.code, ERR_MEMORY);
    arena_clear(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(closed_forms_of_the_reference_come_out),
        cmocka_unit_test(a_thousand_places_and_tilts_agree_with_quadrature),
        cmocka_unit_test(near_the_axis_beyond_the_ends_it_stays_exact),
        cmocka_unit_test(close_and_far_limits_hold),
        cmocka_unit_test(samples_are_even_in_the_angle),
        cmocka_unit_test(as_a_point_it_is_off_by_no_more_than_its_bound),
        cmocka_unit_test(the_weight_is_positive_wherever_a_sample_lights),
        cmocka_unit_test(flux_peak_and_bounds_agree),
        cmocka_unit_test(dead_lanes_are_zero),
        cmocka_unit_test(what_makes_no_sense_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
