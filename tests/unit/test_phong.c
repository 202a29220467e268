/* tests/unit/test_phong.c -- the Phong lobe over a matt base: what all materials have to hold to,
 * and its formula in double. */
#include "tests/material_checks.h"
#include "tests/test.h"

static const double pi = 3.14159265358979324;

static const material *make(arena *a, vec3 reflectance, vec3 specular, float exponent)
{
    phong_desc d      = { .reflectance = reflectance, .specular = specular, .exponent = exponent };
    const material *m = material_phong(a, &d, NULL);
    assert_non_null(m);
    return m;
}

static const float exponents[] = { 1, 2.5f, 20, 300, 1e4f, 1e6f };
enum { EXPONENTS = sizeof exponents / sizeof *exponents };

TEST(energy_is_kept_at_every_angle)
{
    arena a = { 0 };
    for (int i = 0; i < EXPONENTS; i++) {
        material_check_furnace(
            make(&a, (vec3){ 0.5f, 0.25f, 0 }, (vec3){ 0.5f, 0.5f, 1 }, exponents[i]));
    }
    material_check_furnace(make(&a, (vec3){ 0, 0, 0 }, (vec3){ 1, 1, 1 }, 50));
    material_check_furnace(make(&a, (vec3){ 0, 0, 0 }, (vec3){ 0, 0, 0 }, 50));
    arena_clear(&a);
}

TEST(directions_follow_their_pdf)
{
    arena a = { 0 };
    for (int i = 0; i < EXPONENTS; i += 2)
        material_check_sampling(
            make(&a, (vec3){ 0.5f, 0.25f, 0 }, (vec3){ 0.5f, 0.5f, 1 }, exponents[i]));
    material_check_sampling(make(&a, (vec3){ 0, 0, 0 }, (vec3){ 1, 1, 1 }, 300));
    material_check_sampling(make(&a, (vec3){ 0, 0, 0 }, (vec3){ 1, 1, 1 }, 1e6f));
    arena_clear(&a);
}

TEST(light_goes_both_ways_alike)
{
    arena a = { 0 };
    for (int i = 0; i < EXPONENTS; i++)
        material_check_reciprocity(
            make(&a, (vec3){ 0.5f, 0.25f, 0 }, (vec3){ 0.5f, 0.5f, 1 }, exponents[i]), 1e-5);
    arena_clear(&a);
}

TEST(every_lane_stands_for_itself)
{
    arena a = { 0 };
    for (int i = 0; i < EXPONENTS; i++)
        material_check_packets(
            make(&a, (vec3){ 0.5f, 0.25f, 0 }, (vec3){ 0.5f, 0.5f, 1 }, exponents[i]));
    material_check_packets(make(&a, (vec3){ 0, 0, 0 }, (vec3){ 0, 0, 0 }, 10));
    arena_clear(&a);
}

/* A lobe that lies wholly above the surface gives back (n + 2) / (n + 1) cos theta; at normal
 * incidence every lobe ks. M is interpolated in steps h = 1/128 of the cosine's root: between
 * nodes it is off by h^2 / 4 = 1.5e-5 at most where it is the cosine. */
TEST(the_lobe_gives_back_what_its_integral_says)
{
    arena a           = { 0 };
    const material *m = make(&a, (vec3){ 0, 0, 0 }, (vec3){ 0.7f, 0.5f, 0.1f }, 1e6f);
    for (double theta = 0; theta < 89; theta += 8) {
        vshading s  = material_seen_from(m, theta, 10, true);
        vrgb back   = m->type->albedo(m, &s, ALL_LANES);
        double want = cos(theta * pi / 180);
        assert_true(fabs((double)lane(back.x, 0) - 0.7 * want) <= 2e-5);
        assert_true(fabs((double)lane(back.z, 0) - 0.1 * want) <= 2e-5);
    }
    for (int i = 0; i < EXPONENTS; i++) {
        m          = make(&a, (vec3){ 0.3f, 0, 0 }, (vec3){ 0.7f, 0.5f, 0.1f }, exponents[i]);
        vshading s = material_seen_from(m, 0, 0, true);
        vrgb back  = m->type->albedo(m, &s, ALL_LANES);
        assert_near(lane(back.x, 0), 1.0, 1e-4);
        assert_near(lane(back.y, 0), 0.5, 1e-4);
    }
    arena_clear(&a);
}

/* Of diffuse light: a lobe narrow enough to be a mirror of cos theta gives back
 * 2 integral of c^2 dc = 2/3 */
TEST(reflectance_is_that_of_diffuse_light)
{
    arena a           = { 0 };
    const material *m = make(&a, (vec3){ 0.25f, 0, 1 }, (vec3){ 0.75f, 1, 0 }, 1e6f);
    assert_near(m->reflectance.x, 0.25 + 0.5, 1e-4);
    assert_near(m->reflectance.y, 2.0 / 3.0, 1e-4);
    assert_near(m->reflectance.z, 1.0, 1e-5);
    assert_true(m->transmittance.x == 0 && !m->matt && !m->two_sided && !m->solid);
    assert_true(make(&a, (vec3){ 1, 1, 1 }, (vec3){ 0, 0, 0 }, 1e6f)->matt);
    arena_clear(&a);
}

TEST(what_makes_no_sense_is_refused)
{
    arena a               = { 0 };
    lux_error err         = { 0 };
    const phong_desc good = { .reflectance = { 0.9f, 0, 0 },
                              .specular    = { 0.1f, 1, 0 },
                              .exponent    = 1e6f };
    assert_non_null(material_phong(&a, &good, &err));
    phong_desc d = good;
    d.exponent   = 0.9f;
    assert_null(material_phong(&a, &d, &err));
    assert_int_equal(err.code, ERR_ARGUMENT);
    d.exponent = 1.1e6f;
    assert_null(material_phong(&a, &d, &err));
    d.exponent = NAN;
    assert_null(material_phong(&a, &d, &err));
    d            = good;
    d.specular.x = 0.11f;
    assert_null(material_phong(&a, &d, &err));
    d               = good;
    d.reflectance.y = -0.1f;
    assert_null(material_phong(&a, &d, &err));
    d                = good;
    d.extra.openness = 2;
    assert_null(material_phong(&a, &d, &err));
    memory_is_out = true;
    arena none    = { 0 };
    assert_null(material_phong(&none, &good, &err));
    memory_is_out = false;
    assert_int_equal(err.code, ERR_MEMORY);
    arena_clear(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(energy_is_kept_at_every_angle),
        cmocka_unit_test(directions_follow_their_pdf),
        cmocka_unit_test(light_goes_both_ways_alike),
        cmocka_unit_test(every_lane_stands_for_itself),
        cmocka_unit_test(the_lobe_gives_back_what_its_integral_says),
        cmocka_unit_test(reflectance_is_that_of_diffuse_light),
        cmocka_unit_test(what_makes_no_sense_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
