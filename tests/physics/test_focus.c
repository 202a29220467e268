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
    const quad wall = { { { 1, -1, -1 }, { 1, 1, -1 }, { 1, 1, 1 }, { 1, -1, 1 } } };
    lab_quads(&l, "wall.gltf", &wall, 1, "\"name\":\"Wall\"");
    snprintf(yaml, sizeof yaml,
             "scene: wall.gltf\nmaterials: [{match: Wall, %s}]\nlights: [{%s}]\n", surface, lamp);
    const lab_probe up = { { 0, 0, 0 }, { 0, 0, 1 } };
    grid_result r;
    lab_measure(&l, yaml, NULL, &up, 1,
                &(run_options){ .accuracy = 0.2, .threads = 1, .direct_only = direct_only }, &r);
    const char *why = r.left_to_chance; /* a text of the program */
    lab_close(&l);
    return why;
}

#define POINT "type: point, at: [0, 0, 1], intensity: 100"
#define DISK  "type: disk, at: [0, 0, 1], radius: 0.3, luminance: 100"

static bool names_mirrors(const char *why) { return why && strstr(why, "by way of mirrors"); }

TEST(light_of_points_by_way_of_mirrors_is_not_found_and_that_is_said)
{
    assert_true(names_mirrors(said(POINT, "mirror: 0.9", false)));
    assert_true(names_mirrors(said(POINT, "transmittance: 0.8", false)));
    assert_true(
        names_mirrors(said(POINT, "reflectance: 0.2, specular: 0.1, exponent: 5000", false)));
    assert_true(names_mirrors(
        said("type: parallel, aim: [1, 0, -1], illuminance: 10", "mirror: 0.9", false)));
    assert_true(names_mirrors(
        said("type: disk, at: [0, 0, 1], radius: 0.01, luminance: 100", "mirror: 0.9", false)));
}

TEST(what_rays_find_is_not_spoken_of)
{
    assert_false(names_mirrors(said(DISK, "mirror: 0.9", false)));
    assert_false(names_mirrors(said(POINT, "reflectance: 0.9", false)));
    assert_false(
        names_mirrors(said(POINT, "reflectance: 0.2, specular: 0.1, exponent: 10", false)));
    assert_false(names_mirrors(said(POINT, "mirror: 0.9", true)));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(light_of_points_by_way_of_mirrors_is_not_found_and_that_is_said),
        cmocka_unit_test(what_rays_find_is_not_spoken_of),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
