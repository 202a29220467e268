/* tests/unit/test_sun_light.c -- the sun's disk: closed forms, quadrature in double, its sampler.
 */
#include "core/sampler.h"
#include "core/transform.h"
#include "sky/sun_light.h"
#include "tests/shapes.h"
#include "tests/test.h"

static const double pi = 3.14159265358979324;

static const light *make(arena *a, vec3 to_sun, double diameter_deg)
{
    sun_light_desc d = { to_sun, { 1, 2, 3 }, diameter_deg };
    const light *l   = light_sun(a, &d, NULL);
    assert_non_null(l);
    return l;
}

static double closed(const light *l, vec3 normal)
{
    vvec3 p = vspread((vec3){ 5, 6, 7 }), n = vspread(normal);
    return (double)lane(l->type->irradiance(l, &p, &n, ALL_LANES).x, 0);
}

static double by_samples(const light *l, vec3 normal, int count)
{
    vvec3 p = vspread((vec3){ 0, 0, 0 }), n = vspread(normal);
    double sum = 0;
    for (int i = 0; i < count; i += LANES) {
        vsample4 u = vsobol4(vunsigned(vlane_index() + i), vsplat_uint(9));
        vlight_sample s;
        light_sample(l, &p, u.x, u.y, ALL_LANES, &s);
        sum += (double)vsum(s.e.x * vmax(vdot(n, s.wi), vsplat(0)));
    }
    return sum / count;
}

/* The disk of the radius R, its centre t off the normal, for e = 1: by rings around the centre, of
 * which the part above the horizon is known: over phi in [-h, h] the integral of
 * cos x cos t + sin x sin t cos phi. */
static double by_quadrature(double t, double radius)
{
    enum { N = 20000 };
    double sum = 0;
    for (int i = 0; i < N; i++) {
        double x = radius * (i + 0.5) / N, c = cos(x) * cos(t), s = sin(x) * sin(t);
        double h = c >= s ? pi : c <= -s ? 0 : acos(-c / s);
        sum += sin(x) * (2 * h * c + 2 * s * sin(h)) * radius / N;
    }
    return sum / (pi * sin(radius) * sin(radius));
}

/* 2e-6 of e: cosines in float, and the midpoints of the rings */
TEST(irradiance_is_that_of_quadrature_also_where_the_horizon_cuts)
{
    arena a                 = { 0 };
    static const double d[] = { 0.533, 0.533, 2, 10, 60 };
    uint32_t seed           = 7;
    int cut                 = 0;
    double worst            = 0;
    for (int k = 0; k < 5; k++) {
        double radius = d[k] * pi / 360;
        for (int i = 0; i < 60; i++) {
            vec3 way = random_direction(&seed), u, v;
            v3_frame(way, &u, &v);
            double t    = i < 40 ? pi / 2 + radius * (i - 20) / 18.0 : pi * (i - 40) / 20;
            vec3 n      = { (float)(cos(t) * (double)way.x + sin(t) * (double)u.x),
                            (float)(cos(t) * (double)way.y + sin(t) * (double)u.y),
                            (float)(cos(t) * (double)way.z + sin(t) * (double)u.z) };
            double real = acos(fmin(fmax(d3_dot(d3_from(n), d3_from(way)), -1), 1));
            double want = by_quadrature(real, radius);
            double got  = closed(make(&a, way, d[k]), n);
            worst       = fmax(worst, fabs(got - want));
            if (k > 1 && i % 4 == 0)
                assert_true(fabs(by_samples(make(&a, way, d[k]), n, 4096) - want) < 1e-3);
            cut += fabs(real - pi / 2) < radius;
        }
    }
    print_message("           worst: %.2g\n", worst);
    assert_true(worst < 2e-6);
    assert_true(cut > 100);
    arena_clear(&a);
}

TEST(above_the_horizon_it_gives_e_cos)
{
    arena a        = { 0 };
    vec3 sun       = { 0, -0.6f, 0.8f };
    const light *l = make(&a, v3_scale(sun, 20), 0.533);
    assert_near(closed(l, (vec3){ 0, 0, 1 }), 0.8, 1e-6);
    assert_near(closed(l, (vec3){ 0, -1, 0 }), 0.6, 1e-6);
    assert_near(closed(l, sun), 1, 1e-6);
    assert_true(closed(l, (vec3){ 0, 0, -1 }) == 0);
    assert_near(by_samples(l, (vec3){ 0, 0, 1 }, 4096), 0.8, 1e-5);

    /* Its radiance times 6.797e-5 sr (reference.md 3.3) is e, but for sin^2 R against 2 - 2 cos R
     */
    vvec3 p = vspread((vec3){ 0, 0, 0 }), wi = vspread(sun);
    vlight_hit h;
    assert_true(vall(l->type->hit(l, &p, &wi, ALL_LANES, &h)));
    assert_near((double)lane(h.radiance.y, 0) * 6.797e-5, 2, 1e-4);
    assert_near(lane(h.pdf, 0), 1 / 6.797e-5, 1e-4);
    assert_true(lane(h.dist, 0) == INFINITY);
    arena_clear(&a);
}

/* Cells even in solid angle: rings of even versine, sectors. */
static double chi_square_of(double diameter_deg, vec3 sun)
{
    enum { RINGS = 12, SECTORS = 16, CELLS = RINGS * SECTORS, SAMPLES = 1 << 16 };
    arena a        = { 0 };
    const light *l = make(&a, sun, diameter_deg);
    vec3 u, v;
    v3_frame(sun, &u, &v);
    dvec3 axis = d3_from(sun), du = d3_from(u), dv = d3_from(v);
    double radius = diameter_deg * pi / 360, versine = 2 * pow(sin(radius / 2), 2);
    static double expected[CELLS];
    static int count[CELLS];
    for (int c = 0; c < CELLS; c++) {
        expected[c] = (double)SAMPLES / CELLS;
        count[c]    = 0;
    }
    uint32_t seed = 77;
    vvec3 p       = vspread((vec3){ 1, 2, 3 });
    for (int i = 0; i < SAMPLES; i++) {
        vlight_sample s;
        float x = random_unit(&seed), y = random_unit(&seed);
        light_sample(l, &p, vsplat(x), vsplat(y), ALL_LANES, &s);
        vec3 way    = { lane(s.wi.x, 0), lane(s.wi.y, 0), lane(s.wi.z, 0) };
        dvec3 chord = d3_add(d3_from(way), d3_scale(axis, -1));
        double ring = 0.5 * d3_dot(chord, chord) / versine * RINGS;
        double turn = atan2(d3_dot(d3_from(way), dv), d3_dot(d3_from(way), du)) / (2 * pi) + 0.5;
        int r = (int)fmin(ring, RINGS - 1), c = (int)fmin(turn * SECTORS, SECTORS - 1);
        assert_true(ring < RINGS * (1 + 1e-4));
        count[r * SECTORS + c]++;
    }
    arena_clear(&a);
    return chi_square_test(expected, count, CELLS);
}

TEST(samples_are_even_in_the_cone)
{
    assert_true(chi_square_of(0.533, (vec3){ 0.6f, 0, 0.8f }) > 0.01);
    assert_true(chi_square_of(60, (vec3){ 0, 0, 1 }) > 0.01);
    assert_true(chi_square_of(10, (vec3){ 0.48f, 0.64f, -0.6f }) > 0.01);
}

TEST(a_sample_is_a_hit_of_the_same_density)
{
    arena a       = { 0 };
    uint32_t seed = 3;
    int missed    = 0;
    for (int i = 0; i < 4000; i++) {
        double diameter = i % 2 ? 0.533 : 0.01 + 59 * (double)random_unit(&seed);
        const light *l  = make(&a, random_direction(&seed), diameter);
        vvec3 p         = vspread(random_point(&seed));
        vlight_sample s;
        vlight_hit h;
        light_sample(l, &p, vsplat(random_unit(&seed)), vsplat(random_unit(&seed)), ALL_LANES, &s);
        assert_near(lane(vlength(s.wi), 0), 1, 1e-6);
        missed += !vany(l->type->hit(l, &p, &s.wi, ALL_LANES, &h));
        if (lane(h.pdf, 0) == 0)
            continue; /* only next to the rim */
        assert_true(lane(h.pdf, 0) == lane(s.pdf, 0) && lane(h.dist, 0) == INFINITY);
        assert_near((double)lane(s.e.z, 0) * (double)lane(h.pdf, 0), (double)lane(h.radiance.z, 0),
                    1e-6);
        vvec3 back = vneg(s.wi);
        assert_false(vany(l->type->hit(l, &p, &back, ALL_LANES, &h)));
        assert_true(lane(h.pdf, 0) == 0 && lane(h.radiance.x, 0) == 0 && lane(h.dist, 0) == 0);
    }
    assert_true(missed < 4);
    arena_clear(&a);
}

TEST(just_outside_of_the_disk_there_is_nothing)
{
    arena a        = { 0 };
    const light *l = make(&a, (vec3){ 0, 0, 1 }, 0.5);
    vvec3 p        = vspread((vec3){ 0, 0, 0 });
    vlight_hit h;
    for (int i = 0; i < 8; i++) {
        float turn = 0.8f * (float)i;
        for (int side = 0; side < 2; side++) {
            float off = (float)((side ? 0.2502 : 0.2498) * pi / 180);
            vvec3 wi = vspread((vec3){ sinf(off) * cosf(turn), sinf(off) * sinf(turn), cosf(off) });
            assert_true(vany(l->type->hit(l, &p, &wi, ALL_LANES, &h)) == !side);
        }
    }
    arena_clear(&a);
}

TEST(as_a_point_it_is_off_by_no_more_than_its_bound)
{
    arena a                 = { 0 };
    static const double d[] = { 0.533, 10, 60 };
    for (int k = 0; k < 3; k++) {
        const light *l = make(&a, (vec3){ 0, 0, 1 }, d[k]);
        vvec3 p        = vspread((vec3){ 0, 0, 0 });
        vlight_sample s;
        vfloat bound;
        assert_true(vall(l->type->as_point(l, &p, ALL_LANES, &s, &bound)));
        assert_true(lane(s.e.y, 0) == 2 && lane(s.pdf, 0) == INFINITY);
        assert_true(lane(s.wi.z, 0) == 1 && lane(s.dist, 0) == INFINITY);
        double white = 0.2126 + 0.7152 * 2 + 0.0722 * 3, most = 0;
        for (int i = 0; i <= 400; i++) {
            double t   = pi * i / 400;
            double off = fabs(by_quadrature(t, d[k] * pi / 360) - fmax(cos(t), 0)) * white;
            most       = fmax(most, off);
            assert_true(off <= (double)lane(bound, 0) * (1 + 1e-5) + 1e-7);
        }
        assert_near(most, (double)lane(bound, 0), 1e-3); /* at the horizon it is that */
    }
    arena_clear(&a);
}

TEST(the_weight_is_positive_wherever_a_sample_lights)
{
    arena a       = { 0 };
    uint32_t seed = 71;
    for (int i = 0; i < 4000; i++) {
        vec3 way        = random_direction(&seed), u, v;
        double diameter = i % 2 ? 0.533 : 60 * (double)random_unit(&seed) + 1e-3;
        float radius    = (float)(diameter * pi / 360);
        const light *l  = make(&a, way, diameter);
        v3_frame(way, &u, &v);
        float t = 1.5707963f + radius * (2.2f * random_unit(&seed) - 1.1f);
        vec3 at = { cosf(t) * way.x + sinf(t) * u.x, cosf(t) * way.y + sinf(t) * u.y,
                    cosf(t) * way.z + sinf(t) * u.z };
        vvec3 p = vspread(random_point(&seed)), n = vspread(at);
        vfloat w = l->type->weight(l, &p, &n, ALL_LANES);
        assert_true(vall((w >= 0) & (w < 10)));
        for (int k = 0; k < 16; k++) {
            vlight_sample s;
            light_sample(l, &p, vsplat(random_unit(&seed)), vsplat(random_unit(&seed)), ALL_LANES,
                         &s);
            assert_true(vall((w > 0) | ~(vdot(n, s.wi) > 0)));
        }
    }
    arena_clear(&a);
}

TEST(bounds_say_that_it_is_far)
{
    arena a        = { 0 };
    const light *l = make(&a, (vec3){ 0, 0, 1 }, 0.533);
    light_bounds b = light_bounds_of(l);
    assert_true(b.far && b.cos_spread == 1 && b.axis.z == -1);
    assert_near(b.cos_reach, cos(0.2665 * pi / 180), 1e-6);
    assert_near(b.peak, 0.2126 + 0.7152 * 2 + 0.0722 * 3, 1e-6);
    assert_true(light_flux(l).x == INFINITY && light_has_extent(l));
    arena_clear(&a);
}

TEST(dead_lanes_are_zero)
{
    arena a        = { 0 };
    const light *l = make(&a, (vec3){ 0, 0, 2 }, 0.5);
    vvec3 p = vspread((vec3){ 0, 0, 0 }), n = vspread((vec3){ 0, 0, 1 });
    vmask one = vlane_index() < 1;
    vlight_sample s, c;
    vlight_hit h;
    vfloat bound;
    assert_int_equal(vbits(light_sample(l, &p, vsplat(0), vsplat(0), one, &s)), 1);
    assert_int_equal(vbits(l->type->as_point(l, &p, one, &c, &bound)), 1);
    assert_int_equal(vbits(l->type->hit(l, &p, &n, one, &h)), 1);
    vrgb e   = l->type->irradiance(l, &p, &n, one);
    vfloat w = l->type->weight(l, &p, &n, one);
    for (int i = 1; i < LANES; i++) {
        assert_true(lane(s.e.x, i) == 0 && lane(s.dist, i) == 0 && lane(s.pdf, i) == 0);
        assert_true(lane(c.e.x, i) == 0 && lane(c.dist, i) == 0 && lane(bound, i) == 0);
        assert_true(lane(h.pdf, i) == 0 && lane(h.dist, i) == 0 && lane(h.radiance.y, i) == 0);
        assert_true(lane(e.y, i) == 0 && lane(w, i) == 0 && lane(s.wi.z, i) == 0);
    }
    arena_clear(&a);
}

TEST(what_makes_no_sense_is_refused)
{
    arena a                   = { 0 };
    lux_error err             = { 0 };
    const sun_light_desc good = { { 0, 0, 1 }, { 1, 1, 1 }, 0.5 };
    sun_light_desc d          = good;
    d.to_sun                  = (vec3){ 0, 0, 0 };
    assert_null(light_sun(&a, &d, &err));
    assert_int_equal(err.code, ERR_ARGUMENT);
    d              = good;
    d.irradiance.y = -1;
    assert_null(light_sun(&a, &d, &err));
    d.irradiance.y = INFINITY;
    assert_null(light_sun(&a, &d, &err));
    static const double diameters[] = { 0, -1, 61, (double)NAN };
    for (int i = 0; i < 4; i++) {
        d              = good;
        d.diameter_deg = diameters[i];
        assert_null(light_sun(&a, &d, &err));
    }
    memory_is_out = true;
    arena none    = { 0 };
    assert_null(light_sun(&none, &good, &err));
    memory_is_out = false;
    assert_int_equal(err.code, ERR_MEMORY);
    arena_clear(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(irradiance_is_that_of_quadrature_also_where_the_horizon_cuts),
        cmocka_unit_test(above_the_horizon_it_gives_e_cos),
        cmocka_unit_test(samples_are_even_in_the_cone),
        cmocka_unit_test(a_sample_is_a_hit_of_the_same_density),
        cmocka_unit_test(just_outside_of_the_disk_there_is_nothing),
        cmocka_unit_test(as_a_point_it_is_off_by_no_more_than_its_bound),
        cmocka_unit_test(the_weight_is_positive_wherever_a_sample_lights),
        cmocka_unit_test(bounds_say_that_it_is_far),
        cmocka_unit_test(dead_lanes_are_zero),
        cmocka_unit_test(what_makes_no_sense_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
