/* tests/physics/test_glowing.c -- glowing surfaces of glTF files, small, large, far, close, against
 * Lambert's formula; and dimmed, placed many times, within a room that gives light back.
 *
 * Each sensor must lie within its interval, and be as sure as asked for: a small light that is only
 * met by chance would be neither.
 */
#include "tests/gltf_text.h"
#include "tests/lab.h"
#include "tests/test.h"

#include <stdio.h>

static const dvec3 up = { 0, 0, 1 }, down = { 0, 0, -1 };

/* A level quad about (x, y, z). */
static quad level(double x, double y, double z, double size)
{
    double h = 0.5 * size;
    return (quad){
        { { x - h, y - h, z }, { x - h, y + h, z }, { x + h, y + h, z }, { x + h, y - h, z } }
    };
}

static const char dark_room[] = "room: {size: [6, 4, 3], reflectance: 0}\nscene: glow.gltf\n";

/* Sensors all over the floor of the room; the rays that they took. */
static int64_t quad_over_floor(double size, double z, double accuracy)
{
    enum { N = 24 };
    lab l;
    lab_open(&l);
    quad q = level(2.2, 1.7, z, size);
    lab_quads(&l, "glow.gltf", &q, 1, lab_glow(&l, 3000.0));
    lab_probe p[N];
    double want[N];
    for (int i = 0; i < N; i++) {
        p[i]    = (lab_probe){ { i % 6 + 0.5, i / 6 + 0.5, 0.01 }, up };
        want[i] = 3000.0 * polygon_lux(q.corner, 4, p[i].at, p[i].normal);
    }
    grid_result r;
    lab_measure(&l, dark_room, NULL, p, N, &(run_options){ .accuracy = accuracy }, &r);
    lab_check("glowing quad", &r, want, 5e-5, accuracy);
    assert_null(r.left_to_chance);
    lab_close(&l);
    return r.rays;
}

/* 10 cm: a ray meets it once in some thousand; 16 sensors would want millions of rays to be sure to
 * 2 % by chance. Every sensor took two rays a sample, of 16 scrambles of at least 16 samples. */
TEST(a_small_quad_is_found_by_few_rays)
{
    assert_true(quad_over_floor(0.1, 2.5, 0.02) < 24 * 2 * 16 * 64);
}
TEST(a_tiny_quad_is_found_by_few_rays)
{
    assert_true(quad_over_floor(0.001, 2.5, 0.02) < 24 * 2 * 16 * 64);
}
TEST(a_large_quad_gives_what_lambert_says) { quad_over_floor(3.0, 2.9, 0.01); }
TEST(a_quad_close_to_the_sensors_gives_what_lambert_says) { quad_over_floor(1.0, 0.05, 0.01); }

TEST(a_quad_far_away_gives_what_lambert_says)
{
    lab l;
    lab_open(&l);
    quad q = level(300, 400, 1200, 2.0);
    lab_quads(&l, "glow.gltf", &q, 1, lab_glow(&l, 1e6));
    const lab_probe p[] = { { { 0, 0, 0 }, up }, { { 1, 2, 0 }, { 0, 0.6, 0.8 } } };
    double want[2];
    for (int i = 0; i < 2; i++)
        want[i] = 1e6 * polygon_lux(q.corner, 4, p[i].at, p[i].normal);
    grid_result r;
    lab_measure(&l, "scene: glow.gltf\n", NULL, p, 2, &(run_options){ .accuracy = 0.01 }, &r);
    lab_check("far quad", &r, want, 5e-5, 0.01);
    assert_true(r.rays < 2 * 2 * 16 * 64);
    lab_close(&l);
}

/* What lies below a sensor's horizon is cut off; quads may stand at any angle. */
TEST(tilted_sensors_see_what_is_above_their_horizon)
{
    enum { N = 6 };
    lab l;
    lab_open(&l);
    quad q = { { { 2, 0.5, 1 }, { 2, 2.5, 1 }, { 3, 2.5, 2.5 }, { 3, 0.5, 2.5 } } };
    lab_quads(&l, "glow.gltf", &q, 1, lab_glow(&l, 3000.0));
    lab_probe p[N] = { { { 4, 1, 1 }, { -1, 0, 0 } },      { { 1, 1.5, 2 }, { 1, 0, 0 } },
                       { { 2.6, 1, 0.5 }, { 0, 0, 1 } },   { { 4, 2, 2.2 }, { 0, 0, -1 } },
                       { { 1, 3, 1.5 }, { 0.6, 0, 0.8 } }, { { 2.5, 3.5, 1.5 }, { 1, -1, 0 } } };
    double want[N];
    for (int i = 0; i < N; i++)
        want[i] = 3000.0 * polygon_lux(q.corner, 4, p[i].at, p[i].normal);
    grid_result r;
    lab_measure(&l, dark_room, NULL, p, N, &(run_options){ .accuracy = 0.01 }, &r);
    lab_check("tilted", &r, want, 5e-5, 0.01);
    lab_close(&l);
}

TEST(both_sides_glow)
{
    lab l;
    lab_open(&l);
    quad q = level(3, 2, 1.5, 0.5);
    lab_quads(&l, "glow.gltf", &q, 1, lab_glow(&l, 3000.0));
    const lab_probe p[] = { { { 2.5, 2, 0.5 }, up }, { { 2.5, 2, 2.5 }, down } };
    double e            = 3000.0 * polygon_lux(q.corner, 4, p[0].at, p[0].normal);
    grid_result r;
    lab_measure(&l, dark_room, NULL, p, 2, &(run_options){ .accuracy = 0.01 }, &r);
    lab_check("both sides", &r, (double[]){ e, e }, 5e-5, 0.01);
    lab_close(&l);
}

/* Half of a quad behind another, black one. */
TEST(what_stands_before_a_quad_hides_it)
{
    enum { N = 7 };
    lab l;
    lab_open(&l);
    quad q      = level(3, 2, 2.5, 0.8);
    quad screen = { { { 3, -5, 1.25 }, { 9, -5, 1.25 }, { 9, 9, 1.25 }, { 3, 9, 1.25 } } };
    lab_quads(&l, "glow.gltf", &q, 1, lab_glow(&l, 3000.0));
    lab_quads(&l, "screen.gltf", &screen, 1, "\"name\":\"Black\"");
    lab_probe p[N];
    double want[N];
    for (int i = 0; i < N; i++) {
        double x = 2.6 + 0.1 * i, edge = fmin(6.0 - x, 3.4);
        p[i]         = (lab_probe){ { x, 1.8, 0 }, up };
        dvec3 left[] = {
            { 2.6, 1.6, 2.5 }, { edge, 1.6, 2.5 }, { edge, 2.4, 2.5 }, { 2.6, 2.4, 2.5 }
        };
        want[i] = 3000.0 * polygon_lux(left, 4, p[i].at, up);
    }
    grid_result r;
    lab_measure(&l,
                "scene: [glow.gltf, screen.gltf]\nmaterials: [{match: Black, reflectance: 0}]\n",
                NULL, p, N, &(run_options){ .accuracy = 0.02 }, &r);
    lab_check("half hidden", &r, want, 5e-5, 0.02);
    lab_close(&l);
}

/* pi L, a millimetre and a micrometre before a wall of 4 x 3 m: all of the hemisphere but 1e-6. */
TEST(close_before_a_glowing_wall_there_is_pi_l)
{
    lab l;
    lab_open(&l);
    quad wall = { { { 0, 4, 0 }, { 4, 4, 0 }, { 4, 4, 3 }, { 0, 4, 3 } } };
    lab_quads(&l, "glow.gltf", &wall, 1, lab_glow(&l, 100.0));
    const lab_probe p[] = { { { 2, 3.999, 1.5 }, { 0, 1, 0 } },
                            { { 0.5, 3.999, 0.4 }, { 0, 1, 0 } },
                            { { 1.3, 3.9999, 2.2 }, { 0, 1, 0 } } };
    const double want[] = { 100.0 * M_PI, 100.0 * M_PI, 100.0 * M_PI };
    grid_result r;
    lab_measure(&l, "scene: glow.gltf\n", NULL, p, 3, &(run_options){ .accuracy = 0.01 }, &r);
    lab_check("before a wall", &r, want, 1e-4, 0.01);
    lab_close(&l);
}

/* Copies by `at` and by EXT_mesh_gpu_instancing, against the sum of all. */
TEST(copies_of_a_glowing_mesh_glow_each)
{
    enum { N = 4 };
    lab l;
    lab_open(&l);
    quad q              = level(0, 0, 0, 0.2);
    const dvec3 place[] = { { 1, 1, 2.5 }, { 3, 2, 2 }, { 5, 3, 2.8 } };
    lab_probe p[N];
    double want[N] = { 0 };
    for (int i = 0; i < N; i++) {
        p[i] = (lab_probe){ { 0.5 + 1.5 * i, 0.5 + 0.8 * i, 0 }, up };
        for (int k = 0; k < 3; k++)
            want[i] += 3000.0 * polygon_lux(q.corner, 4, d3_sub(p[i].at, place[k]), up);
    }
    lab_quads(&l, "glow.gltf", &q, 1, lab_glow(&l, 3000.0));
    grid_result r;
    lab_measure(&l,
                "room: {size: [6, 4, 3], reflectance: 0}\n"
                "scene: {file: glow.gltf, at: [[1, 1, 2.5], [3, 2, 2], [5, 3, 2.8]]}\n",
                NULL, p, N, &(run_options){ .accuracy = 0.01 }, &r);
    lab_check("three places", &r, want, 5e-5, 0.01);

    lab_write(&l, "glow.gltf",
              "{\"asset\":{\"version\":\"2.0\"},\"extensionsUsed\":["
              "\"KHR_materials_emissive_strength\",\"EXT_mesh_gpu_instancing\"],\"scenes\":[{"
              "\"nodes\":[0]}],\"nodes\":[{\"mesh\":0,\"extensions\":{\"EXT_mesh_gpu_instancing\":{"
              "\"attributes\":{\"TRANSLATION\":2}}}}],\"materials\":[{%s}],%s}",
              lab_glow(&l, 3000.0), lab_mesh(&l, &q, 1, place, 3));
    lab_measure(&l, dark_room, NULL, p, N, &(run_options){ .accuracy = 0.01 }, &r);
    lab_check("three instances", &r, want, 5e-5, 0.01);
    lab_close(&l);
}

/* Glowing surfaces are of the group `other`. */
TEST(glowing_surfaces_are_dimmed_with_their_group)
{
    lab l;
    lab_open(&l);
    quad q = level(3, 2, 2.5, 0.5);
    lab_quads(&l, "glow.gltf", &q, 1, lab_glow(&l, 3000.0));
    const lab_probe p[] = { { { 2, 1, 0 }, up } };
    double e            = 3000.0 * polygon_lux(q.corner, 4, p[0].at, up);
    double lamp         = 500.0 * 2.0 / pow(1 + 1 + 4, 1.5);
    grid_result r;
    lab_measure(&l,
                "room: {size: [6, 4, 3], reflectance: 0}\nscene: glow.gltf\nmaintenance: 0.8\n"
                "lights: [{type: point, at: [1, 2, 2], intensity: 500, group: spots}]\n"
                "dimming: {other: 0.5, spots: 3}\n",
                NULL, p, 1, &(run_options){ .accuracy = 0.01 }, &r);
    lab_check("dimmed", &r, (double[]){ 0.8 * (0.5 * e + 3.0 * lamp) }, 5e-5, 0.01);
    lab_close(&l);
}

/* No closed form: runs of different seeds must agree, and direct light with it. */
TEST(in_a_room_that_gives_light_back_seeds_agree)
{
    enum { N = 6 };
    lab l;
    lab_open(&l);
    quad q = level(2.2, 1.7, 2.5, 0.1);
    lab_quads(&l, "glow.gltf", &q, 1, lab_glow(&l, 30000.0));
    lab_probe p[N];
    grid_result r[2];
    double direct;
    for (int i = 0; i < N; i++)
        p[i] = (lab_probe){ { i + 0.5, 0.5 + 0.5 * i, 0.8 }, up };
    for (uint32_t seed = 0; seed < 2; seed++)
        lab_measure(&l, "room: {size: [6, 4, 3], reflectance: 0.5}\nscene: glow.gltf\n", NULL, p, N,
                    &(run_options){ .accuracy = 0.02, .seed = 1 + seed }, &r[seed]);
    for (int i = 0; i < N; i++) {
        /* Twice 99.9 % of an interval of both */
        double both = hypot(r[0].half_width[i], r[1].half_width[i]);
        double off  = fabs(r[0].illuminance[i] - r[1].illuminance[i]);
        if (!(off <= 4.0728 / 2.1314 * both))
            fail_msg("sensor %d: %g and %g lx, +- %g", i, r[0].illuminance[i], r[1].illuminance[i],
                     both);
        direct = 30000.0 * polygon_lux(q.corner, 4, p[i].at, up);
        assert_true(r[0].half_width[i] <= 0.021 * r[0].illuminance[i]);
        assert_true(fabs(r[0].direct[i] - direct) <= 4.0728 / 2.1314 * r[0].half_width[i]);
        assert_true(r[0].indirect[i] > 0.0);
    }
    lab_close(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_small_quad_is_found_by_few_rays),
        cmocka_unit_test(a_tiny_quad_is_found_by_few_rays),
        cmocka_unit_test(a_large_quad_gives_what_lambert_says),
        cmocka_unit_test(a_quad_close_to_the_sensors_gives_what_lambert_says),
        cmocka_unit_test(a_quad_far_away_gives_what_lambert_says),
        cmocka_unit_test(tilted_sensors_see_what_is_above_their_horizon),
        cmocka_unit_test(both_sides_glow),
        cmocka_unit_test(what_stands_before_a_quad_hides_it),
        cmocka_unit_test(close_before_a_glowing_wall_there_is_pi_l),
        cmocka_unit_test(copies_of_a_glowing_mesh_glow_each),
        cmocka_unit_test(glowing_surfaces_are_dimmed_with_their_group),
        cmocka_unit_test(in_a_room_that_gives_light_back_seeds_agree),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
