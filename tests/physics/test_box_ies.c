/* tests/physics/test_box_ies.c -- a room with four measured downlights against an independent
 * Monte Carlo program and closed-form direct light (../shared/data/reference/box_ies, where
 * present). */
#include "tests/box_ies.h"
#include "tests/folder.h"
#include "tests/test.h"

#include <stdio.h>
#include <stdlib.h>

static void assert_agrees(const grid_result *r, const double *direct, const double *total)
{
    double squares = 0.0, got = 0.0, want = 0.0;
    assert_int_equal(r->sensor_count, BOX_IES_SENSORS);
    for (int k = 0; k < BOX_IES_SENSORS; k++) {
        double off = r->illuminance[k] / total[k] - 1.0;
        squares += off * off;
        got += r->illuminance[k];
        want += total[k];
        assert_near(r->direct[k], direct[k], 1e-5);
        assert_near(r->indirect[k], r->illuminance[k] - r->direct[k], 1e-9);
    }
    double rms = sqrt(squares / BOX_IES_SENSORS);
    if (!(rms <= 0.005 && fabs(got / want - 1.0) <= 0.002))
        fail_msg("RMS %.3f %% (0.5 wanted), mean %.3f %% off (0.2 wanted)", 100.0 * rms,
                 100.0 * (got / want - 1.0));
}

TEST(the_room_as_gltf_agrees_with_the_independent_solution)
{
    arena a = { 0 };
    box_ies b;
    if (!box_ies_read(&a, &b))
        skip();
    grid_result r;
    grid_of_scene(&a, b.scene, 0, &(run_options){ .accuracy = 0.005, .seed = 1, .threads = 2 }, &r);
    assert_agrees(&r, b.direct, b.total);
    assert_true(r.end == RUN_DONE && r.missed == 0);
    arena_clear(&a);
}

TEST(a_plain_room_gives_the_same)
{
    arena a = { 0 };
    double direct[BOX_IES_SENSORS], total[BOX_IES_SENSORS];
    if (!box_ies_expected(direct, total))
        skip();
    char text[4096], *ies = realpath(BOX_IES_FOLDER "/dl3000.ies", NULL);
    snprintf(
        text, sizeof text,
        "lux4: 1\nroom: {size: [10, 6, 3], reflectance: {ceiling: 0.7, walls: 0.5, floor: 0.2}}\n"
        "luminaires: [{name: d, photometry: \"%s\", at: [[2.5, 1.5, 2.99], [7.5, 1.5, 2.99], "
        "[2.5, 4.5, 2.99], [7.5, 4.5, 2.99]]}]\n"
        "grids: [{name: desk, origin: [0, 0, 0.75], u: [10, 0, 0], v: [0, 6, 0], spacing: 0.5}]\n",
        ies);
    free(ies);
    const scene *s = scene_of_text(&a, text);
    grid_result r;
    grid_of_scene(&a, s, 0, &(run_options){ .accuracy = 0.005, .seed = 2, .threads = 2 }, &r);
    assert_agrees(&r, direct, total);
    arena_clear(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_room_as_gltf_agrees_with_the_independent_solution),
        cmocka_unit_test(a_plain_room_gives_the_same),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
