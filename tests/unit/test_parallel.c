/* tests/unit/test_parallel.c -- light of one direction: everywhere, and in a beam. */
#include "lights/light.h"
#include "tests/shapes.h"
#include "tests/test.h"

static const parallel_desc beam = {
    .aim = { 0, 3, -4 }, .irradiance = { 1, 2, 3 }, .at = { 1, 2, 5 }, .radius = 0.5f
};

static bool lights(const light *l, vec3 at, vlight_sample *s)
{
    vvec3 p   = vspread(at);
    vmask lit = light_sample(l, &p, vsplat(0.5f), vsplat(0.5f), ALL_LANES, s);
    assert_true(vall(lit) || !vany(lit));
    return vany(lit);
}

/* A place `along` the beam from where it begins and `across` it; the beam lies in a plane of x. */
static vec3 in_beam(float along, float across_x, float across)
{
    return (vec3){ 1 + across_x, 2 + 0.6f * along + 0.8f * across,
                   5 - 0.8f * along + 0.6f * across };
}

TEST(without_a_radius_it_is_the_same_everywhere)
{
    arena a         = { 0 };
    parallel_desc d = beam;
    d.radius        = 0;
    const light *l  = light_parallel(&a, &d, NULL);
    vlight_sample s;
    assert_true(lights(l, (vec3){ 1e6f, -1e6f, 1e6f }, &s));
    assert_true(lane(s.dist, 0) == INFINITY && lane(s.pdf, 0) == INFINITY);
    assert_true(lane(s.e.x, 0) == 1 && lane(s.e.z, 0) == 3);
    assert_near(lane(s.wi.y, 0), -0.6, 1e-6);
    assert_near(lane(s.wi.z, 0), 0.8, 1e-6);
    assert_true(light_flux(l).y == INFINITY);
    arena_clear(&a);
}

TEST(a_beam_lights_its_cylinder_alone)
{
    arena a        = { 0 };
    const light *l = light_parallel(&a, &beam, NULL);
    vlight_sample s;
    assert_true(lights(l, in_beam(7, 0.3f, -0.39f), &s)); /* 0.492 m off the middle */
    assert_near(lane(s.dist, 0), 7.0, 1e-6);
    assert_true(lane(s.e.y, 0) == 2);
    assert_false(lights(l, in_beam(7, 0.3f, -0.41f), &s)); /* 0.508 m */
    assert_true(lights(l, in_beam(1e-3f, 0, 0.49f), &s));
    assert_false(lights(l, in_beam(-1e-3f, 0, 0), &s)); /* behind where it begins */
    assert_true(lane(s.e.y, 0) == 0 && lane(s.wi.z, 0) == 0 && lane(s.dist, 0) == 0);
    assert_true(lights(l, in_beam(1000, 0, 0.49f), &s)); /* as strong there */
    arena_clear(&a);
}

TEST(the_flux_of_a_beam_is_what_its_section_carries)
{
    arena a        = { 0 };
    const light *l = light_parallel(&a, &beam, NULL);
    assert_near(light_flux(l).y, 3.14159265358979 * 0.25 * 2.0, 1e-6);
    uint32_t seed = 3;
    int lit       = 0;
    vlight_sample s;
    for (int i = 0; i < 100000; i++) {
        float x = random_unit(&seed) - 0.5f, y = random_unit(&seed) - 0.5f;
        lit += lights(l, in_beam(2, 1.2f * x, 1.2f * y), &s);
    }
    double area = 1.2 * 1.2 * lit / 100000;
    assert_near(2.0 * area, light_flux(l).y, 0.01); /* four standard errors of the count */
    arena_clear(&a);
}

TEST(a_beam_is_bounded_by_its_irradiance)
{
    arena a        = { 0 };
    light_bounds b = light_bounds_of(light_parallel(&a, &beam, NULL));
    assert_true(b.far && b.cos_spread == 1 && b.cos_reach == 1);
    assert_near(b.peak, 0.2126 + 0.7152 * 2 + 0.0722 * 3, 1e-6);
    assert_near(b.axis.z, -0.8, 1e-6);
    arena_clear(&a);
}

TEST(dead_lanes_are_zero)
{
    arena a        = { 0 };
    const light *l = light_parallel(&a, &beam, NULL);
    vvec3 p        = vspread(in_beam(1, 0, 0));
    vlight_sample s;
    assert_int_equal(vbits(light_sample(l, &p, vsplat(0), vsplat(0), vlane_index() < 1, &s)), 1);
    for (int i = 1; i < LANES; i++)
        assert_true(lane(s.e.x, i) == 0 && lane(s.dist, i) == 0 && lane(s.pdf, i) == 0);
    arena_clear(&a);
}

TEST(what_makes_no_sense_is_refused)
{
    arena a         = { 0 };
    lux_error err   = { 0 };
    parallel_desc d = beam;
    d.radius        = -1;
    assert_null(light_parallel(&a, &d, &err));
    assert_int_equal(err.code, ERR_ARGUMENT);
    d.radius = INFINITY;
    assert_null(light_parallel(&a, &d, &err));
    d     = beam;
    d.aim = (vec3){ 0, 0, 0 };
    assert_null(light_parallel(&a, &d, &err));
    d              = beam;
    d.irradiance.x = NAN;
    assert_null(light_parallel(&a, &d, &err));
    arena_clear(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(without_a_radius_it_is_the_same_everywhere),
        cmocka_unit_test(a_beam_lights_its_cylinder_alone),
        cmocka_unit_test(the_flux_of_a_beam_is_what_its_section_carries),
        cmocka_unit_test(a_beam_is_bounded_by_its_irradiance),
        cmocka_unit_test(dead_lanes_are_zero),
        cmocka_unit_test(what_makes_no_sense_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
