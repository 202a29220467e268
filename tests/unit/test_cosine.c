/* tests/unit/test_cosine.c -- the directional source I0 cos^n against libm and its flux. */
#include "lights/light.h"
#include "tests/shapes.h"
#include "tests/test.h"

static const double pi = 3.14159265358979324;

static const light *make(arena *a, float exponent)
{
    cosine_desc d  = { .position  = { 1, 2, 3 },
                       .aim       = { 2, -1, -2 },
                       .intensity = { 1, 10, 100 },
                       .exponent  = exponent };
    const light *l = light_cosine(a, &d, NULL);
    assert_non_null(l);
    return l;
}

/* Lane 0 of the green channel at `at` */
static double seen(const light *l, vec3 at)
{
    vvec3 p = vspread(at);
    vlight_sample s;
    bool lit = vany(light_sample(l, &p, vsplat(0.5f), vsplat(0.5f), ALL_LANES, &s));
    assert_true(lit || lane(s.e.y, 0) == 0); /* a lit place may get less than floats tell from 0 */
    return (double)lane(s.e.y, 0);
}

TEST(it_falls_with_the_power_of_the_cosine)
{
    static const float exponents[] = { 0, 1, 2, 3, 7, 0.5f, 1.7f, 12.5f, 30, 100, 99.5f };
    arena a                        = { 0 };
    uint32_t seed                  = 7;
    for (size_t k = 0; k < sizeof exponents / sizeof *exponents; k++) {
        const light *l = make(&a, exponents[k]);
        for (int i = 0; i < 1000; i++) {
            vec3 way = v3_scale(random_point(&seed), 4);
            vec3 at  = { 1 + way.x, 2 + way.y, 3 + way.z };
            double x = (double)at.x - 1, y = (double)at.y - 2, z = (double)at.z - 3;
            double r2    = x * x + y * y + z * z;
            double cos_a = (2 * x - y - 2 * z) / (3 * sqrt(r2));
            double want  = cos_a > 0 ? 10 * pow(cos_a, (double)exponents[k]) / r2 : 0;
            double most  = 10 / r2;
            if (fabs(cos_a) < 1e-6)
                continue;
            double bound = 1e-6 + 2.5e-7 * (double)exponents[k]; /* of cos_a, two roundings */
            assert_true(fabs(seen(l, at) - want) <= most * bound);
        }
    }
    arena_clear(&a);
}

TEST(behind_it_is_dark)
{
    arena a = { 0 };
    for (float n = 0; n < 3; n += 0.5f) {
        assert_true(seen(make(&a, n), (vec3){ -1, 3, 5 }) == 0);
        assert_true(seen(make(&a, n), (vec3){ 1, 2, 3 }) == 0); /* at the lamp itself */
    }
    assert_near(seen(make(&a, 0), (vec3){ 3, 1, 1 }), 10.0 / 9.0, 1e-6);
    assert_near(seen(make(&a, 9999.5f), (vec3){ 3, 1, 1 }), 10.0 / 9.0, 1e-3);
    arena_clear(&a);
}

/* Over the sphere by its heights, even in area (Archimedes) */
TEST(the_flux_is_that_of_its_intensities)
{
    static const float exponents[] = { 0, 1, 2.5f, 20, 33.3f };
    arena a                        = { 0 };
    for (size_t k = 0; k < sizeof exponents / sizeof *exponents; k++) {
        cosine_desc d  = { .aim = { 0, 0, 1 }, .intensity = { 1, 1, 1 }, .exponent = exponents[k] };
        const light *l = light_cosine(&a, &d, NULL);
        double sum     = 0;
        enum { N = 2000 };
        for (int i = 0; i < N; i++) {
            double z = (i + 0.5) / N;
            sum += 2 * pi / N * seen(l, (vec3){ (float)sqrt(1 - z * z), 0, (float)z });
        }
        assert_near(sum, light_flux(l).x, 1e-4);
    }
    arena_clear(&a);
}

TEST(bounds_and_peak_are_those_of_the_axis)
{
    arena a        = { 0 };
    const light *l = make(&a, 4);
    light_bounds b = light_bounds_of(l);
    vec3 toward, most = l->type->peak(l, &toward);
    assert_true(b.low.x == 1 && b.high.z == 3 && b.cos_spread == 1 && b.cos_reach == 0 && !b.far);
    assert_near(b.peak, 0.2126 + 7.152 + 7.22, 1e-6);
    assert_near(toward.x, 2.0 / 3.0, 1e-6);
    assert_true(most.z == 100);
    assert_false(light_has_extent(l));
    arena_clear(&a);
}

TEST(dead_lanes_are_zero)
{
    arena a        = { 0 };
    const light *l = make(&a, 2.5f);
    vvec3 p        = vspread((vec3){ 3, 1, 1 });
    vlight_sample s;
    assert_int_equal(vbits(light_sample(l, &p, vsplat(0), vsplat(0), vlane_index() < 1, &s)), 1);
    for (int i = 1; i < LANES; i++)
        assert_true(lane(s.e.x, i) == 0 && lane(s.dist, i) == 0 && lane(s.pdf, i) == 0 &&
                    lane(s.wi.x, i) == 0);
    arena_clear(&a);
}

TEST(what_makes_no_sense_is_refused)
{
    arena a                = { 0 };
    lux_error err          = { 0 };
    const cosine_desc good = { .aim = { 0, 0, -1 }, .intensity = { 1, 1, 1 }, .exponent = 1 };
    cosine_desc d          = good;
    d.exponent             = -1;
    assert_null(light_cosine(&a, &d, &err));
    assert_int_equal(err.code, ERR_ARGUMENT);
    d.exponent = 1.1e4f;
    assert_null(light_cosine(&a, &d, &err));
    d.exponent = NAN;
    assert_null(light_cosine(&a, &d, &err));
    d     = good;
    d.aim = (vec3){ 0, 0, 0 };
    assert_null(light_cosine(&a, &d, &err));
    d             = good;
    d.intensity.y = -1;
    assert_null(light_cosine(&a, &d, &err));
    memory_is_out = true;
    arena none    = { 0 };
    assert_null(light_cosine(&none, &good, &err));
    memory_is_out = false;
    assert_int_equal(err.code, ERR_MEMORY);
    arena_clear(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_falls_with_the_power_of_the_cosine),
        cmocka_unit_test(behind_it_is_dark),
        cmocka_unit_test(the_flux_is_that_of_its_intensities),
        cmocka_unit_test(bounds_and_peak_are_those_of_the_axis),
        cmocka_unit_test(dead_lanes_are_zero),
        cmocka_unit_test(what_makes_no_sense_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
