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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(light_of_small_lamps_by_way_of_narrow_lobes_is_said_to_be_found_rarely),
        cmocka_unit_test(what_rays_and_mirror_images_find_is_not_spoken_of),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
