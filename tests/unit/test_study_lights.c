/* tests/unit/test_study_lights.c -- lamps of a study: every kind, where layouts put them, groups.
 */
#include "tests/study_text.h"
#include "tests/test.h"

#include <stdio.h>
#include <string.h>

static arena memory;

static const study *good(const char *text) { return study_of_text(&memory, NULL, text); }

static int forget(void **state)
{
    (void)state;
    arena_clear(&memory);
    return 0;
}

static void assert_place(dvec3 p, double x, double y, double z)
{
    if (!(fabs(p.x - x) < 1e-12 && fabs(p.y - y) < 1e-12 && fabs(p.z - z) < 1e-12)) /* roundings */
        fail_msg("(%g, %g, %g), not (%g, %g, %g)", p.x, p.y, p.z, x, y, z);
}

/* ---- kinds ---------------------------------------------------------------------------------- */

TEST(each_kind_of_light_is_read_as_the_contract_writes_it)
{
    const study *s = good(
        "lux4: 1\n"
        "lights:\n"
        "  - {type: point, at: [0, 0, 3], intensity: 100}\n"
        "  - {type: cone, at: [0, 0, 3], aim: [0, 0, -1], intensity: 100, inner: 20, outer: 30}\n"
        "  - {type: cosine, at: [0, 0, 3], aim: [1, 0, -1], intensity: 100, exponent: 4}\n"
        "  - {type: parallel, aim: [0, 1, -1], illuminance: 1000}\n"
        "  - {type: linear, from: [0, 0, 3], to: [2, 0, 3], lumens: 1000}\n"
        "  - {type: disk, at: [0, 0, 3], aim: [0, 0, -1], radius: 0.2, luminance: 5000}\n"
        "  - {type: rect, at: [0, 0, 3], aim: [0, 0, -1], up: [0, 1, 0], size: [1.2, 0.3],\n"
        "     lumens: 3000}\n");
    assert_int_equal(s->light_count, 7);
    const study_light *l = s->lights;
    for (int i = 0; i < 7; i++) /* kinds are in the contract's order */
        assert_int_equal(l[i].kind, STUDY_POINT + i);

    assert_true(l[0].intensity == 100.0 && isnan(l[0].lumens) && isnan(l[0].luminance));
    assert_true(l[1].inner_deg == 20.0 && l[1].outer_deg == 30.0 && l[1].intensity == 100.0);
    assert_true(l[2].exponent == 4.0);
    assert_place(l[2].aim, 1, 0, -1);
    assert_place(l[3].aim, 0, 1, -1);
    assert_true(l[3].illuminance == 1000.0 && l[3].at_count == 0 && isnan(l[3].radius));
    assert_int_equal(l[4].at_count, 1);
    assert_place(l[4].at[0], 1, 0, 3);
    assert_place(l[4].along, 2, 0, 0);
    assert_true(l[4].lumens == 1000.0 && !l[4].photometry);
    assert_true(l[5].radius == 0.2 && l[5].luminance == 5000.0 && isnan(l[5].lumens));
    assert_true(l[6].size[0] == 1.2 && l[6].size[1] == 0.3 && l[6].lumens == 3000.0);
    assert_place(l[6].up, 0, 1, 0);
    assert_true(l[6].up_given && l[6].where.line == 9 && l[6].where.column == 5);
}

TEST(what_a_light_is_not_told_has_its_default)
{
    const study *s =
        good("lux4: 1\n"
             "lights:\n"
             "  - {type: cone, at: [0, 0, 3], lumens: 5, outer: 180}\n"
             "  - {type: cosine, at: [0, 0, 3], lumens: 5}\n"
             "  - {type: parallel, aim: [0, 0, -1], illuminance: 0, at: [1, 2, 3],\n"
             "     radius: 0.5}\n"
             "  - {type: linear, from: [0, 0, 3], to: [2, 0, 3], photometry: a.ies}\n"
             "  - {type: disk, at: [0, 0, 3], radius: 1, photometry: a.ies, lumens: 9}\n"
             "  - {type: rect, at: [0, 0, 3], size: [1, 1], lumens: 1}\n"
             "  - {type: rect, at: [0, 0, 3], size: [1, 1], lumens: 1, aim: [0, 9, 0]}\n");
    const study_light *l = s->lights;
    assert_true(l[0].inner_deg == 0.0 && l[0].outer_deg == 180.0);
    assert_place(l[0].aim, 0, 0, -1);
    assert_true(l[1].exponent == 1.0 && l[1].emission.dimming == 1.0 && !l[1].emission.group);
    assert_true(l[2].radius == 0.5 && l[2].at_count == 1);
    assert_place(l[2].at[0], 1, 2, 3);
    assert_string_equal(l[3].photometry, "job/a.ies");
    assert_true(isnan(l[3].lumens) && isnan(l[3].intensity));
    assert_true(l[4].lumens == 9.0 && l[4].photometry);
    assert_place(l[5].up, 0, 1, 0);
    assert_place(l[6].up, 1, 0, 0); /* aim is north, which cannot be up */
    assert_false(l[5].up_given || l[6].up_given);
}

TEST(a_light_at_several_places_aims_from_each)
{
    const study *s       = good("lux4: 1\n"
                                      "lights: [{type: rect, at: [[0, 0, 3], [0, -2, 1]], aim_at: [0, 1, 1],\n"
                                      "          size: [1, 1], luminance: 1}]\n");
    const study_light *l = s->lights;
    assert_true(l->aim_at_given);
    assert_place(study_light_aim(l, 0), 0, 1, -2);
    assert_place(study_light_aim(l, 1), 0, 3, 0);
    assert_place(study_light_up(l, 0), 0, 1, 0);
    assert_place(study_light_up(l, 1), 1, 0, 0);
}

TEST(lights_that_lack_or_have_too_much_are_refused)
{
    static const broken_study table[] = {
        { "lights: [{type: cone, at: [0, 0, 3], intensity: 1}]",
          "2:10: a cone light needs the key `outer`" },
        { "lights: [{type: cone, at: [0, 0, 3], outer: 9}]",
          "2:10: a cone light takes either `intensity` or `lumens`, found neither" },
        { "lights: [{type: cosine, at: [0, 0, 3], intensity: 1, lumens: 1}]",
          "2:10: a cosine light takes either `intensity` or `lumens`, found both" },
        { "lights: [{type: parallel, aim: [0, 0, -1]}]",
          "2:10: a parallel light needs the key `illuminance`" },
        { "lights: [{type: parallel, illuminance: 1}]",
          "2:10: a parallel light needs the key `aim`" },
        { "lights: [{type: linear, from: [0, 0, 3], lumens: 1}]",
          "2:10: a linear light needs the key `to`" },
        { "lights: [{type: linear, from: [0, 0, 3], to: [1, 0, 3]}]",
          "2:10: a linear light takes either `intensity` or `lumens`, found neither" },
        { "lights: [{type: disk, at: [0, 0, 3], lumens: 1}]",
          "2:10: a disk light needs the key `radius`" },
        { "lights: [{type: disk, at: [0, 0, 3], radius: 1}]",
          "2:10: a disk light takes either `luminance` or `lumens`, found neither" },
        { "lights: [{type: rect, at: [0, 0, 3], lumens: 1}]",
          "2:10: a rect light needs the key `size`" },
        { "lights: [{type: rect, at: [0, 0, 3], size: [1, 1], lumens: 1, luminance: 1}]",
          "2:10: a rect light takes either `luminance` or `lumens`, found both" },
        { "lights: [{type: rect, at: [0, 0, 3], size: [1, 1], photometry: a, luminance: 1}]",
          "2:10: `luminance` does not go with `photometry`" },
        { "lights: [{type: linear, from: [0, 0, 3], to: [1, 0, 3], photometry: a, intensity: 1}]",
          "2:10: `intensity` does not go with `photometry`" },
        { "lights: [{type: point, at: [0, 0, 3], luminance: 1}]",
          "2:39: unknown key `luminance`: did you mean `lumens`?" },
        { "lights: [{type: cone, at: [0, 0, 3], photometry: a}]",
          "2:38: unknown key `photometry`: a cone light has name, color, dimming, group, type, "
          "at, aim, aim_at, intensity, lumens, inner, outer" },
        { "lights: [{at: [0, 0, 3]}]", "2:10: a point light needs the key `type`" },
    };
    ALL_REFUSED(table, ERR_FORMAT);
}

TEST(lights_of_no_shape_or_direction_are_refused)
{
    static const broken_study table[] = {
        { "lights: [{type: cone, at: [0, 0, 3], lumens: 1, inner: 30, outer: 30}]",
          "2:10: expected `inner` < `outer` (half angles), found 30 and 30" },
        { "lights: [{type: cone, outer: 180.5}]",
          "2:30: expected an angle from 0 to 180 degrees, found `180.5`" },
        { "lights: [{type: cone, inner: -1}]", "2:30: expected a number >= 0, found `-1`" },
        { "lights: [{type: cosine, exponent: 10001}]",
          "2:35: expected a number from 0 to 10000, found `10001`" },
        { "lights: [{type: cosine, exponent: -1}]", "2:35: expected a number >= 0, found `-1`" },
        { "lights: [{type: parallel, aim: [0, 0, -1], illuminance: 1, radius: 1}]",
          "2:10: a parallel light takes both `at` and `radius` (a beam) or neither" },
        { "lights: [{type: parallel, aim: [0, 0, -1], illuminance: 1, at: [0, 0, 0]}]",
          "2:10: a parallel light takes both `at` and `radius` (a beam) or neither" },
        { "lights: [{type: parallel, at: [[0, 0, 0]]}]",
          "2:31: expected [x, y, z], found a list of 1" },
        { "lights: [{type: linear, from: [1, 2, 3], to: [1, 2, 3], lumens: 1}]",
          "2:10: `from` and `to` are at the same place" },
        { "lights: [{type: disk, radius: 0}]", "2:31: expected a number > 0, found `0`" },
        { "lights: [{type: rect, size: 5}]", "2:29: expected [across, along up], found `5`" },
        { "lights: [{type: rect, size: [1, 0]}]", "2:33: expected a number > 0, found `0`" },
        { "lights: [{type: rect, at: [0, 0, 3], size: [1, 1], lumens: 1, up: [0, 0, 2]}]",
          "2:10: `up` is parallel to `aim`" },
        { "lights: [{type: rect, at: [[1, 0, 3], [0, 0, 3]], size: [1, 1], lumens: 1, "
          "up: [0, 0, 2], aim_at: [0, 0, 9]}]",
          "2:10: `up` is parallel to `aim_at`" },
        { "lights: [{type: disk, at: [0, 0, 3], radius: 1, lumens: 1, aim_at: [0, 0, 3]}]",
          "2:10: `aim_at` is where the light is" },
        { "lights: [{type: disk, at: [0, 0, 3], radius: 1, lumens: 1, aim_at: [0, 0, 1], "
          "aim: [0, 0, 1]}]",
          "2:10: a light takes `aim` or `aim_at`, not both" },
        { "lights: [{type: point, group: a b}]",
          "2:31: expected a name of a-z, A-Z, 0-9, _, - and . that does not begin with - or . "
          "(it names files), found `a b`" },
    };
    ALL_REFUSED(table, ERR_FORMAT);
}

/* ---- luminaires ----------------------------------------------------------------------------- */

TEST(luminaires_stand_at_places_in_a_layout_or_at_nodes)
{
    const study *s = good(
        "lux4: 1\n"
        "luminaires:\n"
        "  - {photometry: a.ies, nodes: \"Spot.*\", aim_at: [3, 2, 1.5], group: g, rotate: 90}\n"
        "  - {photometry: a.ies, nodes: Lamp, aim: [1, 0, 0]}\n"
        "  - {photometry: a.ies, at: [0, 0, 3]}\n");
    const study_luminaire *l = s->luminaires;
    assert_string_equal(l->nodes, "Spot.*");
    assert_true(l->aim_at_given && !l->aim_given && !l->at && l->at_count == 0);
    assert_place(l->aim_at, 3, 2, 1.5);
    assert_string_equal(l->emission.group, "g");
    assert_true(l[1].aim_given && !l[1].aim_at_given);
    assert_true(!l[2].nodes && !l[2].aim_given && !l[2].layout.given && l[2].at_count == 1);
}

TEST(a_layout_fills_the_room_half_the_spacing_from_its_walls)
{
    const study *s           = good("lux4: 1\n"
                                              "luminaires:\n"
                                              "  - {photometry: p.ldt, layout: {fill: room, z: 2.8, count: [4, 3]}}\n"
                                              "room: {size: [10, 6, 3], reflectance: 0.5}\n"); /* known only then */
    const study_luminaire *l = s->luminaires;
    assert_int_equal(l->at_count, 12);
    for (int k = 0; k < 12; k++) /* x first: at 1.25 m, 2.5 m apart; y at 1 m, 2 m apart */
        assert_place(l->at[k], 1.25 + 2.5 * (k % 4), 1.0 + 2.0 * (k / 4), 2.8);
}

TEST(a_layout_goes_from_the_first_to_the_last)
{
    const study *s =
        good("lux4: 1\n"
             "luminaires:\n"
             "  - {photometry: a, layout: {from: [1, 2, 3], to: [4, 5, 9], count: 4}}\n"
             "  - {photometry: a, layout: {from: [1, 2, 3], to: [4, 5, 9], count: 1}}\n"
             "  - {photometry: a, layout: {from: [0, 0, 1], to: [4, 5, 3], count: [3, 2]}}\n"
             "  - {photometry: a, layout: {from: [0, 0, 1], to: [4, 5, 3], count: [1, 2, 3]}}\n"
             "  - {photometry: a, layout: {from: [1, 1, 1], to: [1, 1, 1], count: 1}}\n"
             "  - {photometry: a, layout: {from: [1, 2, 3], to: [3, 2, 1], count: [2]}}\n");
    const study_luminaire *l = s->luminaires;
    assert_int_equal(l[0].at_count, 4); /* on the line */
    for (int k = 0; k < 4; k++)
        assert_place(l[0].at[k], 1 + k, 2 + k, 3 + 2 * k);
    assert_place(l[1].at[0], 2.5, 3.5, 6);
    assert_int_equal(l[2].at_count, 6);
    for (int k = 0; k < 6; k++)
        assert_place(l[2].at[k], 2 * (k % 3), 5 * (k / 3), 2);
    assert_int_equal(l[3].at_count, 6);
    for (int k = 0; k < 6; k++)
        assert_place(l[3].at[k], 2, 5 * (k % 2), 1 + k / 2);
    assert_place(l[4].at[0], 1, 1, 1);
    assert_int_equal(l[5].at_count, 2);
    assert_place(l[5].at[1], 3, 2, 1);
}

#define LAYOUT(text) "luminaires: [{photometry: a, layout: {" text "}}]"

TEST(luminaires_that_stand_nowhere_are_refused)
{
    static const broken_study table[] = {
        { "luminaires: [{photometry: a}]",
          "2:14: a luminaire takes one of `at`, `layout` and `nodes`" },
        { "luminaires: [{photometry: a, at: [0, 0, 0], nodes: b}]",
          "2:14: a luminaire takes one of `at`, `layout` and `nodes`" },
        { "luminaires: [{photometry: a, at: [0, 0, 0], aim: [1, 0, 0], aim_at: [1, 0, 0]}]",
          "2:14: a luminaire takes `aim` or `aim_at`, not both" },
        { "luminaires: [{photometry: a, at: [[1, 0, 0], [0, 0, 0]], aim_at: [0, 0, 0]}]",
          "2:14: `aim_at` is where the luminaire is" },
        { LAYOUT("fill: room, z: 2, count: [1, 1]"), "2:38: `fill: room`, but there is no `room`" },
        { "room: {size: [4, 3, 2], reflectance: 0}\n" LAYOUT("fill: room, z: 2, count: [1, 1]"),
          "3:38: `z: 2` is not below the ceiling at 2 m" },
        { LAYOUT("fill: hall"), "2:45: expected room, found `hall`" },
        { LAYOUT("fill: room, z: 2"), "2:38: a layout needs the key `count`" },
        { LAYOUT("fill: room, z: 2, count: 3"), "2:64: expected [along x, along y], found `3`" },
        { LAYOUT("fill: room, count: [1, 1]"),
          "2:38: a layout needs `fill: room` and `z`, or `from` and `to`" },
        { LAYOUT("count: 3"), "2:38: a layout needs `fill: room` and `z`, or `from` and `to`" },
        { LAYOUT("from: [0, 0, 0], count: 3"),
          "2:38: a layout needs `fill: room` and `z`, or `from` and `to`" },
        { LAYOUT("from: [0, 0, 0], to: [1, 0, 0], z: 1, count: 3"),
          "2:74: `z` does not go with `from`" },
        { LAYOUT("fill: room, z: 2, to: [1, 0, 0], count: [3, 3]"),
          "2:61: `to` does not go with `fill`" },
        { LAYOUT("from: [1, 0, 0], to: [1, 0, 0], count: 2"),
          "2:78: `from` and `to` are at the same place" },
        { LAYOUT("from: [1, 0, 0], to: [2, 0, 0], count: [3, 2]"),
          "2:78: 2 along y, but `from` and `to` have the same y" },
        { LAYOUT("count: 0"), "2:46: expected one to three whole numbers from 1 to 100000, found "
                              "`0`" },
        { LAYOUT("count: 1.5"), "2:46: expected one to three whole numbers from 1 to 100000, found "
                                "`1.5`" },
        { LAYOUT("count: [1, 0]"), "2:50: expected one to three whole numbers from 1 to 100000, "
                                   "found `0`" },
        { LAYOUT("count: [1, 1, 1, 1]"), "2:46: expected one to three whole numbers from 1 to "
                                         "100000, found a list of 4" },
        { LAYOUT("from: [0, 0, 0], to: [1, 1, 1], count: [100000, 100000, 100000]"),
          "2:38: 1000000000000000 luminaires, expected at most 100000" },
    };
    ALL_REFUSED(table, ERR_FORMAT);
}

/* Ten of the largest layouts in a line or two would take 24 MB each. */
TEST(layouts_together_are_bounded)
{
    char text[4000] = "lux4: 1\nluminaires:\n- &a {photometry: a, layout: {from: [0, 0, 0], "
                      "to: [1, 0, 0], count: 100000}}\n";
    for (int i = 0; i < 11; i++)
        strcat(text, "- *a\n");
    assert_study_refused(NULL, text, ERR_FORMAT, "3:3: more than 1000000 luminaires in layouts");
}

/* ---- groups --------------------------------------------------------------------------------- */

TEST(a_group_is_dimmed_besides_what_its_lights_say)
{
    const study *s = good("lux4: 1\n"
                          "dimming: {general: 0.3, desk: 0, other: 2}\n"
                          "lights:\n"
                          "  - {type: point, at: [0, 0, 3], intensity: 1, group: general}\n"
                          "  - {type: point, at: [0, 0, 3], intensity: 1, dimming: 0.5}\n"
                          "luminaires: [{photometry: a, at: [0, 0, 0], group: desk}]\n");
    assert_int_equal(s->dimming_count, 3);
    assert_string_equal(s->dimmings[0].group, "general");
    assert_true(s->dimmings[0].where.line == 2 && s->dimmings[0].where.column == 11);
    assert_true(study_group_factor(s, "general") == 0.3);
    assert_true(study_group_factor(s, "desk") == 0.0);
    assert_true(study_group_factor(s, NULL) == 2.0 && study_group_factor(s, "other") == 2.0);
    assert_true(study_group_factor(s, "none") == 1.0);
    assert_string_equal(s->lights[0].emission.group, "general");

    /* Lamps of files have no group */
    s = good("lux4: 1\nscene: a.glb\ndimming: {other: 0.5}");
    assert_true(study_group_factor(s, NULL) == 0.5);
}

TEST(groups_that_no_light_has_are_refused)
{
    static const broken_study table[] = {
        { "dimming: {genral: 1}\nlights: [{type: point, at: [0, 0, 3], lumens: 1, group: "
          "general}]",
          "2:11: no light is of the group `genral`: did you mean `general`?" },
        { "dimming: {a: 1}", "2:11: no light is of the group `a`" },
        { "dimming: {other: 1}\nlights: [{type: point, at: [0, 0, 3], lumens: 1, group: g}]",
          "2:11: no light is of the group `other`" },
        { "dimming: {a: 1,\n a: 2}", "3:2: the key `a` stands in line 2 already" },
        { "dimming: {a: -1}", "2:14: expected a number >= 0, found `-1`" },
        { "dimming: {[a]: 1}", "2:11: expected the name of a key, found a list of 1" },
        { "dimming: 0.5", "2:10: expected a mapping (key: value), found `0.5`" },
        { "dimming: {sun: 1}",
          "2:11: `sun` cannot be a group of lamps: results call other light so" },
        { "dimming: {desk.direct: 1}",
          "2:11: `desk.direct` cannot be a group of lamps: channels of results end so" },
        { "lights: [{type: point, group: direct}]",
          "2:31: `direct` cannot be a group of lamps: results call other light so" },
    };
    ALL_REFUSED(table, ERR_FORMAT);

    char text[2000] = "lux4: 1\ndimming: {";
    for (int i = 0; i < 65; i++)
        sprintf(text + strlen(text), "g%d: 1, ", i);
    strcat(text, "}");
    assert_study_refused(NULL, text, ERR_FORMAT, "2:10: a mapping of 65 keys, expected at most 64");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(each_kind_of_light_is_read_as_the_contract_writes_it, forget),
        cmocka_unit_test_teardown(what_a_light_is_not_told_has_its_default, forget),
        cmocka_unit_test_teardown(a_light_at_several_places_aims_from_each, forget),
        cmocka_unit_test(lights_that_lack_or_have_too_much_are_refused),
        cmocka_unit_test(lights_of_no_shape_or_direction_are_refused),
        cmocka_unit_test_teardown(luminaires_stand_at_places_in_a_layout_or_at_nodes, forget),
        cmocka_unit_test_teardown(a_layout_fills_the_room_half_the_spacing_from_its_walls, forget),
        cmocka_unit_test_teardown(a_layout_goes_from_the_first_to_the_last, forget),
        cmocka_unit_test(luminaires_that_stand_nowhere_are_refused),
        cmocka_unit_test(layouts_together_are_bounded),
        cmocka_unit_test_teardown(a_group_is_dimmed_besides_what_its_lights_say, forget),
        cmocka_unit_test(groups_that_no_light_has_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
