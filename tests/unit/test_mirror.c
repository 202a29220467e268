/* tests/unit/test_mirror.c -- mirrors: one direction, the same share at all angles. */
#include "tests/material_checks.h"
#include "tests/test.h"

static const material *make(arena *a, vec3 reflectance, float openness)
{
    mirror_desc d     = { .reflectance = reflectance, .extra.openness = openness };
    const material *m = material_mirror(a, &d, NULL);
    assert_non_null(m);
    return m;
}

TEST(mirrors_hold_to_what_all_materials_do)
{
    arena a = { 0 };
    for (int i = 0; i < 2; i++) {
        const material *m = make(&a, (vec3){ 1, 0.8f, 0 }, i ? 0.3f : 0);
        material_check_furnace(m);
        material_check_packets(m);
    }
    arena_clear(&a);
}

TEST(light_comes_from_the_mirror_direction)
{
    arena a           = { 0 };
    const material *m = make(&a, (vec3){ 0.9f, 0.8f, 0.1f }, 0);
    for (double theta = 0; theta < 90; theta += 4.9) {
        vscatter out;
        vshading s = material_seen_from(m, theta, 77, theta < 45);
        vfloat any = vsplat(0.5f);
        assert_true(vall(m->type->scatter(m, &s, any, any, any, ALL_LANES, &out)));
        assert_true(vall((out.wi.x == -s.wo.x) & (out.wi.y == -s.wo.y) & (out.wi.z == s.wo.z)));
        assert_true(vall((out.weight.x == 0.9f) & (out.weight.z == 0.1f)));
        assert_true(vall(out.pdf == INFINITY) && !vany(out.straight | out.bent));
    }
    assert_null(m->type->reflect);
    assert_true(m->reflectance.y == 0.8f && !m->matt && !m->solid && !m->two_sided);
    arena_clear(&a);
}

TEST(what_makes_no_sense_is_refused)
{
    arena a       = { 0 };
    lux_error err = { 0 };
    mirror_desc d = { .reflectance = { 0, NAN, 0 } };
    assert_null(material_mirror(&a, &d, &err));
    assert_int_equal(err.code, ERR_ARGUMENT);
    d = (mirror_desc){ .extra.emission = { -1, 0, 0 } };
    assert_null(material_mirror(&a, &d, &err));
    d             = (mirror_desc){ 0 };
    memory_is_out = true;
    arena none    = { 0 };
    assert_null(material_mirror(&none, &d, &err));
    memory_is_out = false;
    assert_int_equal(err.code, ERR_MEMORY);
    arena_clear(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(mirrors_hold_to_what_all_materials_do),
        cmocka_unit_test(light_comes_from_the_mirror_direction),
        cmocka_unit_test(what_makes_no_sense_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
