/* tests/unit/test_study_materials.c -- `materials` of a study: what keys come to, which go
 * together.
 */
#include "tests/study_text.h"
#include "tests/test.h"

#include <stdio.h>

static arena memory;

static int forget(void **state)
{
    (void)state;
    arena_clear(&memory);
    return 0;
}

/* The one material of a study that says so much of it, on line 2. */
static const study_material *material_of(const char *says)
{
    char text[400];
    snprintf(text, sizeof text, "lux4: 1\nmaterials: [{match: a, %s}]\n", says);
    const study *s = study_of_text(&memory, NULL, text);
    assert_int_equal(s->material_count, 1);
    return s->materials;
}

static void assert_rgb(vec3 c, double r, double g, double b)
{
    assert_near(c.x, r, 1e-6); /* floats */
    assert_near(c.y, g, 1e-6);
    assert_near(c.z, b, 1e-6);
}

TEST(a_matt_material_has_no_lobe)
{
    const study_material *m = material_of("reflectance: [0.1, 0.2, 0.3]");
    assert_int_equal(m->surface, SURFACE_MATT);
    assert_rgb(m->reflectance, 0.1, 0.2, 0.3);
    assert_rgb(m->specular, 0, 0, 0);
    assert_true(isnan(m->exponent));
    assert_int_equal(m->where.line, 2);
    assert_int_equal(m->where.column, 13);
}

TEST(a_lobe_has_a_colour_and_an_exponent)
{
    const study_material *m =
        material_of("exponent: 80, reflectance: 0.3, specular: [0.04, 0.05, 0.7]");
    assert_int_equal(m->surface, SURFACE_MATT);
    assert_rgb(m->specular, 0.04, 0.05, 0.7);
    assert_near(m->exponent, 80.0, 0.0);
    assert_near(material_of("reflectance: 0, specular: 1, exponent: 1e6")->exponent, 1e6, 0.0);
    assert_near(material_of("reflectance: 1, specular: 0, exponent: 1")->exponent, 1.0, 0.0);
}

/* 0.7f + 0.3f and the like are 1 to a float's rounding. */
TEST(shares_in_decimals_may_add_up_to_one)
{
    for (int i = 0; i <= 100; i++) {
        char says[80];
        snprintf(says, sizeof says, "reflectance: %g, specular: %g, exponent: 5", i / 100.0,
                 1.0 - i / 100.0);
        material_of(says);
    }
}

TEST(mirrors_and_tables_are_told_by_their_key)
{
    const study_material *m = material_of("mirror: 0.9");
    assert_int_equal(m->surface, SURFACE_MIRROR);
    assert_rgb(m->mirror, 0.9, 0.9, 0.9);

    m = material_of("brdf: paint.brdf");
    assert_int_equal(m->surface, SURFACE_TABLE);
    assert_string_equal(m->brdf, "job/paint.brdf");
    assert_true(m->up.x == 0.0 && m->up.y == 0.0 && m->up.z == 1.0);

    m = material_of("brdf: /abs/blue.binary, up: [0, 2, -1]");
    assert_int_equal(m->surface, SURFACE_TABLE);
    assert_string_equal(m->brdf, "/abs/blue.binary");
    assert_true(m->up.x == 0.0 && m->up.y == 2.0 && m->up.z == -1.0);
}

TEST(files_of_xml_have_a_front)
{
    const study_material *m = material_of("brdf: blind.xml");
    assert_int_equal(m->surface, SURFACE_BSDF);
    assert_false(m->front_outside);
    assert_true(material_of("brdf: a.b/Blind.XML, front: outside")->front_outside);
    assert_false(material_of("front: inside, brdf: blind.xml, up: [1, 0, 0]")->front_outside);
    assert_int_equal(material_of("brdf: xml")->surface, SURFACE_TABLE);
}

/* (1 - R) / (1 + R) = 2 n / (n^2 + 1): 0.918 of n = 1.52, 0.8 of n = 2 */
TEST(a_pane_has_a_transmittance_up_to_what_its_index_leaves)
{
    const study_material *m = material_of("transmittance: 0.918");
    assert_int_equal(m->surface, SURFACE_PANE);
    assert_rgb(m->transmittance, 0.918, 0.918, 0.918);
    assert_near(m->ior, 1.52, 0.0);
    assert_false(m->box);

    m = material_of("transmittance: [0, 0.4, 0.79], ior: 2, pane: box");
    assert_rgb(m->transmittance, 0, 0.4, 0.79);
    assert_near(m->ior, 2.0, 0.0);
    assert_true(m->box);
    assert_false(material_of("transmittance: 0.5, pane: single")->box);
    material_of("transmittance: 0.8, ior: 2"); /* the most, which is a bit more as a float */
}

TEST(a_surface_is_of_one_kind)
{
    static const broken_study table[] = {
        { "materials: [{match: a}]", "2:13: a material needs one of the keys `reflectance`, "
                                     "`mirror`, `brdf` and `transmittance`" },
        { "materials:\n  - match: a\n    mirror: 0.5\n    reflectance: 0.5",
          "4:13: `mirror` does not go with `reflectance`" },
        { "materials: [{match: a, brdf: b, mirror: 0}]", "2:30: `brdf` does not go with `mirror`" },
        { "materials: [{match: a, transmittance: 0, brdf: b}]",
          "2:39: `transmittance` does not go with `brdf`" },
    };
    ALL_REFUSED(table, ERR_FORMAT);
}

TEST(keys_of_one_kind_do_not_go_with_another)
{
    static const broken_study table[] = {
        { "materials: [{match: a, reflectance: 1, exponent: 5}]",
          "2:50: `exponent` needs the key `specular`" },
        { "materials: [{match: a, reflectance: 0, specular: 0.5}]",
          "2:50: `specular` needs the key `exponent`" },
        { "materials: [{match: a, mirror: 0, specular: 0.5, exponent: 5}]",
          "2:45: `specular` needs the key `reflectance`" },
        { "materials: [{match: a, mirror: 0, up: [0, 0, 1]}]", "2:39: `up` needs the key `brdf`" },
        { "materials: [{match: a, mirror: 0, front: inside}]",
          "2:42: `front` needs the key `brdf`" },
        { "materials: [{match: a, brdf: b.brdf, front: inside}]",
          "2:45: `front` does not go with this `brdf`: only a file *.xml has a front" },
        { "materials: [{match: a, mirror: 0, ior: 2}]",
          "2:40: `ior` needs the key `transmittance`" },
        { "materials: [{match: a, reflectance: 0, pane: box}]",
          "2:46: `pane` needs the key `transmittance`" },
    };
    ALL_REFUSED(table, ERR_FORMAT);
}

TEST(more_light_than_there_is_is_refused)
{
    static const broken_study table[] = {
        { "materials: [{match: a, reflectance: [0.2, 0.8, 0], specular: 0.3, exponent: 5}]",
          "2:62: `reflectance` and `specular` add up to 1.1: expected at most 1" },
        { "materials: [{match: a, transmittance: 0.92}]",
          "2:39: expected a `transmittance` of at most 0.9183, found 0.92 (a pane of `ior: 1.52` "
          "reflects the rest)" },
        { "materials: [{match: a, transmittance: [0, 0, 0.81], ior: 2}]",
          "2:39: expected a `transmittance` of at most 0.8, found 0.81 (a pane of `ior: 2` "
          "reflects the rest)" },
    };
    ALL_REFUSED(table, ERR_FORMAT);
}

TEST(values_out_of_range_are_refused)
{
    static const broken_study table[] = {
        { "materials: [{match: a, mirror: 1.1}]", "2:32: expected a number from 0 to 1, found "
                                                  "`1.1`" },
        { "materials: [{match: a, mirror: [1, 1]}]",
          "2:32: expected a number from 0 to 1 or [r, g, b], found a list of 2" },
        { "materials: [{match: a, exponent: 0.5}]",
          "2:34: expected a number from 1 to 1e6, found `0.5`" },
        { "materials: [{match: a, exponent: 2e6}]",
          "2:34: expected a number from 1 to 1e6, found `2e6`" },
        { "materials: [{match: a, ior: 1}]",
          "2:29: expected a refractive index > 1 and at most 4, found `1`" },
        { "materials: [{match: a, ior: 1.00000001}]",
          "2:29: expected a refractive index > 1 and at most 4, found `1.00000001`" },
        { "materials: [{match: a, ior: 4.1}]",
          "2:29: expected a refractive index > 1 and at most 4, found `4.1`" },
        { "materials: [{match: a, up: [0, 0, 0]}]", "2:28: expected a direction, found no length" },
        { "materials: [{match: a, brdf: ''}]",
          "2:30: expected the name of a file, found an empty text" },
        { "materials: [{match: a, pane: double}]", "2:30: expected single or box, found `double`" },
        { "materials: [{match: a, front: back}]",
          "2:31: expected inside or outside, found `back`" },
    };
    ALL_REFUSED(table, ERR_FORMAT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(a_matt_material_has_no_lobe, forget),
        cmocka_unit_test_teardown(a_lobe_has_a_colour_and_an_exponent, forget),
        cmocka_unit_test_teardown(shares_in_decimals_may_add_up_to_one, forget),
        cmocka_unit_test_teardown(mirrors_and_tables_are_told_by_their_key, forget),
        cmocka_unit_test_teardown(files_of_xml_have_a_front, forget),
        cmocka_unit_test_teardown(a_pane_has_a_transmittance_up_to_what_its_index_leaves, forget),
        cmocka_unit_test(a_surface_is_of_one_kind),
        cmocka_unit_test(keys_of_one_kind_do_not_go_with_another),
        cmocka_unit_test(more_light_than_there_is_is_refused),
        cmocka_unit_test(values_out_of_range_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
