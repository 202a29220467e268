/* tests/physics/test_focus.c -- what no sampler reaches is said to be so. */
#include "tests/lab.h"
#include "tests/test.h"

#include <stdio.h>
#include <string.h>

/* A mirror beside a sensor, and a lamp of some kind. */
static const char *said(const char *lamp, const char *surface, bool direct_only)
{
    lab l;
    char yaml[600];
    lab_open(&l);
    const quad wall  = { { { 1, -1, -1 }, { 1, 1, -1 }, { 1, 1, 1 }, { 1, -1, 1 } } };
    const quad floor = { { { -2, -2, -1 }, { 2, -2, -1 }, { 2, 2, -1 }, { -2, 2, -1 } } };
    lab_quads(&l, "wall.gltf", &wall, 1, "\"name\":\"Wall\"");
    lab_quads(&l, "floor.gltf", &floor, 1, "\"name\":\"Floor\"");
    snprintf(yaml, sizeof yaml,
             "scene: [wall.gltf, floor.gltf]\nmaterials: [{match: Wall, %s}, {match: Floor, "
             "reflectance: 0.5}]\nlights: [{%s}]\n",
             surface, lamp);
    const lab_probe up = { { 0, 0, 0 }, { 0, 0, 1 } };
    grid_result r;
    lab_measure(&l, yaml, NULL, &up, 1,
                &(run_options){ .accuracy = 0.2, .threads = 1, .direct_only = direct_only }, &r);
    const char *why = r.left_to_chance; /* a text of the program */
    lab_close(&l);
    return why;
}

#define POINT "type: point, at: [0, 0, 1], intensity: 100"
#define BELOW "type: point, at: [0, 0, -2.5], intensity: 100"
#define DISK  "type: disk, at: [0, 0, 1], radius: 0.3, luminance: 100"

static bool names_lobes(const char *why) { return why && strstr(why, "not quite mirrors"); }

TEST(light_of_small_lamps_by_way_of_narrow_lobes_is_said_to_be_found_rarely)
{
    static const char narrow[] = "reflectance: 0.2, specular: 0.1, exponent: 5000";
    assert_true(names_lobes(said(POINT, narrow, false)));
    assert_true(names_lobes(
        said("type: disk, at: [0, 0, 1], radius: 0.01, luminance: 100", narrow, false)));
    assert_false(names_lobes(said(POINT, narrow, true)));
}

TEST(what_rays_and_mirror_images_find_is_not_spoken_of)
{
    assert_null(said(DISK, "mirror: 0.9", false));
    assert_null(said(POINT, "mirror: 0.9", false));
    assert_null(said(POINT, "transmittance: 0.8", false));
    assert_null(said("type: parallel, aim: [1, 0, -1], illuminance: 10", "mirror: 0.9", false));
    assert_false(names_lobes(said(POINT, "reflectance: 0.9", false)));
    assert_false(names_lobes(said(POINT, "reflectance: 0.2, specular: 0.1, exponent: 10", false)));
}

/* ---- darkness ------------------------------------------------------------------------------- */

static bool doubts(const char *why) { return why && strstr(why, "no sample found any light back"); }

/* A sensor looks down, through or by way of what lies between, on a floor below which the only lamp
 * lights the only other surface. */
static const char *said_above(const char *between, const char *floor)
{
    lab l;
    char yaml[600];
    lab_open(&l);
    const quad level[] = { { { { -4, -4, -1 }, { 4, -4, -1 }, { 4, 4, -1 }, { -4, 4, -1 } } },
                           { { { -4, -4, -2 }, { 4, -4, -2 }, { 4, 4, -2 }, { -4, 4, -2 } } },
                           { { { -2, -2, -3 }, { 2, -2, -3 }, { 2, 2, -3 }, { -2, 2, -3 } } } };
    lab_quads(&l, "between.gltf", &level[0], 1, "\"name\":\"Between\"");
    lab_quads(&l, "floor.gltf", &level[1], 1, "\"name\":\"Floor\"");
    lab_quads(&l, "hidden.gltf", &level[2], 1, "\"name\":\"Hidden\"");
    snprintf(yaml, sizeof yaml,
             "scene: [%sfloor.gltf, hidden.gltf]\nmaterials: [%s%s{match: Floor, reflectance: %s}, "
             "{match: Hidden, reflectance: 0.5}]\nlights: [{" BELOW "}]\n",
             between ? "between.gltf, " : "", between ? between : "", between ? ", " : "", floor);
    const lab_probe down = { { 0, 0, 0 }, { 0, 0, -1 } };
    grid_result r;
    lab_measure(&l, yaml, NULL, &down, 1, &(run_options){ .accuracy = 0.2, .threads = 1 }, &r);
    assert_true(r.average == 0.0);
    const char *why = r.left_to_chance;
    lab_close(&l);
    return why;
}

TEST(what_gives_nothing_back_is_no_doubt)
{
    static const char *const clear[] = { NULL, "{match: Between, transmittance: 0.8}",
                                         "{match: Between, mirror: 0.8}" };
    for (size_t i = 0; i < sizeof clear / sizeof *clear; i++)
        assert_null(said_above(clear[i], "0"));
}

TEST(what_could_give_light_back_and_was_not_seen_to_is_in_doubt)
{
    assert_true(doubts(said_above(NULL, "0.01")));
    assert_true(doubts(said_above("{match: Between, transmittance: 0.8}", "0.01")));
    assert_true(doubts(said_above("{match: Between, reflectance: 0.01}", "0")));
}

/* Through a hole of 4 mm lit by a lamp outside that the sensor does not see. */
TEST(a_room_lit_through_a_keyhole_is_in_doubt)
{
    lab l;
    lab_open(&l);
    const lab_probe p = { { 3, 1, 1 }, { 1, 0, 0 } };
    grid_result r;
    lab_measure(&l,
                "room: {size: [4, 4, 3], reflectance: 0.5, windows: [{wall: south, at: [2, 1.5], "
                "size: [0.004, 0.004]}]}\nlights: [{type: point, at: [2, -3, 1.5], intensity: 100}]"
                "\n",
                NULL, &p, 1, &(run_options){ .accuracy = 0.2, .threads = 1 }, &r);
    assert_true(r.average > 0.0 || doubts(r.left_to_chance));
    lab_close(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(light_of_small_lamps_by_way_of_narrow_lobes_is_said_to_be_found_rarely),
        cmocka_unit_test(what_rays_and_mirror_images_find_is_not_spoken_of),
        cmocka_unit_test(what_gives_nothing_back_is_no_doubt),
        cmocka_unit_test(what_could_give_light_back_and_was_not_seen_to_is_in_doubt),
        cmocka_unit_test(a_room_lit_through_a_keyhole_is_in_doubt),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
