/* tests/physics/test_direct.c -- lamps against the laws of Lambert and of the inverse square. */
#include "tests/folder.h"
#include "tests/test.h"

#include <stdio.h>

/* E = I h / d^3 on a plane h below a point of I cd, no walls. The
 * offsets and values are those published for CIE 171:2006 test case 5.2 (isotropic source). */
TEST(a_point_follows_the_inverse_square_and_the_cosine)
{
    arena a = { 0 };
    const scene *s =
        scene_of_text(&a, "lux4: 1\n"
                          "lights: [{type: point, at: [0, 0, 3], intensity: 1000}]\n"
                          "grids: [{name: plane, origin: [-0.25, -0.25, 0], u: [2, 0, 0],"
                          " v: [0, 2, 0], spacing: 0.5}]\n");
    grid_result r;
    grid_of_scene(&a, s, 0, &(run_options){ .seed = 1 }, &r);
    assert_int_equal(r.sensor_count, 16);
    const struct {
        int column, row;
        double lux;
    } published[] = { { 0, 0, 111.111 }, { 1, 0, 106.637 }, { 2, 0, 94.868 }, { 3, 0, 79.505 },
                      { 1, 1, 102.456 }, { 2, 1, 91.419 },  { 3, 1, 76.926 }, { 2, 2, 82.230 },
                      { 3, 2, 69.971 },  { 3, 3, 60.481 } };
    for (size_t i = 0; i < sizeof published / sizeof *published; i++)
        assert_near(r.illuminance[published[i].row * 4 + published[i].column], published[i].lux,
                    1e-5);
    for (int k = 0; k < r.sensor_count; k++) {
        double x = 0.5 * (k % 4), y = 0.5 * (k / 4), d2 = x * x + y * y + 9.0;
        assert_near(r.illuminance[k], 1000.0 * 3.0 / (d2 * sqrt(d2)), 1e-5);
        assert_near(r.half_width[k], 0.0, 0.0); /* nothing was left to chance */
    }
    arena_clear(&a);
}

/* A tilted sensor: E = I cos(i) / d^2; one that looks away gets nothing. */
TEST(a_tilted_sensor_follows_the_cosine)
{
    arena a      = { 0 };
    char *folder = folder_new(), path[4096];
    folder_write(folder, "tilted.csv",
                 "x,y,z,nx,ny,nz\n0,0,0,0,0,1\n0,0,0,0,1,1\n0,0,0,1,0,0\n"
                 "0,0,0,0,0,-1\n0,0,0,0,-3,4\n");
    folder_write(folder, "study.yaml",
                 "lux4: 1\nlights: [{type: point, at: [0, 0, 2], lumens: 1256.6370614359172}]\n"
                 "grids: [{name: tilted, points: tilted.csv}]\n");
    snprintf(path, sizeof path, "%s/study.yaml", folder);
    const study *st = study_read(&a, path, NULL, NULL, NULL);
    const scene *s  = scene_new(&a, st, &(scene_options){ .threads = 1 }, NULL, NULL);
    grid_result r;
    grid_of_scene(&a, s, 0, &(run_options){ .seed = 1 }, &r);
    const double cosine[] = { 1.0, sqrt(0.5), 0.0, 0.0, 0.8 };
    for (int k = 0; k < 5; k++)
        assert_near(r.illuminance[k], 100.0 / 4.0 * cosine[k], cosine[k] > 0.0 ? 1e-5 : 0.0);
    folder_free(folder);
    arena_clear(&a);
}

/* Maintenance and dimming are factors; several lamps add up. */
TEST(lamps_add_up_and_are_dimmed)
{
    arena a        = { 0 };
    const scene *s = scene_of_text(
        &a, "lux4: 1\nmaintenance: 0.8\n"
            "lights: [{type: point, at: [[0, 0, 2], [0, 0, 4]], intensity: 100, dimming: 0.5, "
            "color: 3000K}]\n"
            "grids: [{name: g, origin: [-1, -1, 0], u: [2, 0, 0], v: [0, 2, 0], spacing: 2}]\n");
    grid_result r;
    grid_of_scene(&a, s, 0, &(run_options){ .seed = 1 }, &r);
    assert_int_equal(r.sensor_count, 1);
    assert_near(r.illuminance[0], 0.8 * 0.5 * (100.0 / 4.0 + 100.0 / 16.0), 1e-5);
    arena_clear(&a);
}

/* In a country's grid, 5000 km from its origin, light is what it is at the origin. */
TEST(places_far_from_the_origin_lose_nothing)
{
    arena a        = { 0 };
    const scene *s = scene_of_text(
        &a, "lux4: 1\nlights: [{type: point, at: [500000.25, 5400000.5, 103], intensity: 1000}]\n"
            "grids: [{name: g, origin: [499999.75, 5400000, 100], u: [2, 0, 0], v: [0, 1, 0], "
            "spacing: 1}]\n");
    grid_result r;
    grid_of_scene(&a, s, 0, &(run_options){ .seed = 1 }, &r);
    assert_int_equal(r.sensor_count, 2);
    assert_near(r.illuminance[0], 1000.0 / 9.0, 1e-5);
    assert_near(r.illuminance[1], 1000.0 * 3.0 / (10.0 * sqrt(10.0)), 1e-5);
    arena_clear(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_point_follows_the_inverse_square_and_the_cosine),
        cmocka_unit_test(a_tilted_sensor_follows_the_cosine),
        cmocka_unit_test(lamps_add_up_and_are_dimmed),
        cmocka_unit_test(places_far_from_the_origin_lose_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
