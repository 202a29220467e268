/* tests/unit/test_diffuse.c -- the matt surface, with and without holes, against what all materials
 * have to hold to and against Lambert. */
#include "tests/material_checks.h"
#include "tests/test.h"

static const double pi = 3.14159265358979324;

static const material *make(arena *a, vec3 reflectance, float openness)
{
    diffuse_desc d    = { .reflectance = reflectance, .extra.openness = openness };
    const material *m = material_diffuse(a, &d, NULL);
    assert_non_null(m);
    return m;
}

TEST(energy_and_sampling_agree)
{
    arena a           = { 0 };
    const material *m = make(&a, (vec3){ 1, 0.5f, 0 }, 0);
    material_check_furnace(m);
    material_check_sampling(m);
    material_check_reciprocity(m, 1e-6);
    material_check_packets(m);
    arena_clear(&a);
}

TEST(holes_let_their_share_through)
{
    arena a           = { 0 };
    const material *m = make(&a, (vec3){ 1, 0.5f, 0 }, 0.25f);
    material_check_furnace(m);
    material_check_sampling(m);
    material_check_reciprocity(m, 1e-6);
    material_check_packets(m);

    energy e = material_albedo_integral(m, 30, 40, true);
    assert_near(e.reflected[0], 0.75, 1e-4); /* 384 * 768 cells about a smooth function */
    assert_near(e.reflected[1], 0.375, 1e-4);
    assert_near(e.transmitted[2], 0.25, 1e-3); /* as often as 65536 draws say */
    arena_clear(&a);
}

/* f = rho / pi, whatever the directions */
TEST(it_is_equally_bright_from_everywhere)
{
    arena a           = { 0 };
    const material *m = make(&a, (vec3){ 0.8f, 0.5f, 0.2f }, 0);
    for (double theta = 0; theta < 90; theta += 7.3) {
        vshading s = material_seen_from(m, theta, 3 * theta, true);
        vvec3 wi   = vspread((vec3){ 0.6f, 0, 0.8f });
        vrgb f     = m->type->reflect(m, &s, &wi, ALL_LANES, NULL);
        assert_near(lane(f.x, 0), 0.8 * 0.8 / pi, 1e-6);
        assert_near(lane(f.y, 0), 0.5 * 0.8 / pi, 1e-6);
        assert_near(lane(f.z, 0), 0.2 * 0.8 / pi, 1e-6);
        wi = vneg(wi); /* nothing from below */
        f  = m->type->reflect(m, &s, &wi, ALL_LANES, NULL);
        assert_true(lane(f.x, 0) == 0);
    }
    arena_clear(&a);
}

TEST(what_makes_no_sense_is_refused)
{
    arena a        = { 0 };
    lux_error err  = { 0 };
    diffuse_desc d = { .reflectance = { 1.01f, 0, 0 } };
    assert_null(material_diffuse(&a, &d, &err));
    assert_int_equal(err.code, ERR_ARGUMENT);
    d = (diffuse_desc){ .extra.openness = NAN };
    assert_null(material_diffuse(&a, &d, &err));
    d = (diffuse_desc){ .extra.emission = { 0, -1, 0 } };
    assert_null(material_diffuse(&a, &d, &err));
    d             = (diffuse_desc){ 0 };
    memory_is_out = true;
    arena none    = { 0 };
    assert_null(material_diffuse(&none, &d, &err));
    memory_is_out = false;
    assert_int_equal(err.code, ERR_MEMORY);
    arena_clear(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(energy_and_sampling_agree),
        cmocka_unit_test(holes_let_their_share_through),
        cmocka_unit_test(it_is_equally_bright_from_everywhere),
        cmocka_unit_test(what_makes_no_sense_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
