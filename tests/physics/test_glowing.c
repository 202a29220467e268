/* tests/physics/test_glowing.c -- glowing surfaces of glTF files, small, large, far, close, against
 * Lambert's formula; and dimmed, placed many times, within a room that gives light back.
 *
 * Each sensor must lie within its interval, and be as sure as asked for: a small light that is only
 * met by chance would be neither.
 */
#include "tests/folder.h"
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

/* ---- bodies ---------------------------------------------------------------------------------- */

enum { RINGS = 12, SECTORS = 24, FACETS = RINGS * SECTORS };

static dvec3 on_globe(double radius, int ring, int sector)
{
    double low = M_PI * ring / RINGS, turn = 2.0 * M_PI * (sector % SECTORS) / SECTORS;
    double across = ring % RINGS ? radius * sin(low) : 0.0;
    return (dvec3){ across * cos(turn), across * sin(turn), radius * cos(low) };
}

static void globe(double radius, quad out[FACETS])
{
    for (int i = 0; i < FACETS; i++) {
        int r = i / SECTORS, s = i % SECTORS;
        out[i] = (quad){ { on_globe(radius, r, s), on_globe(radius, r + 1, s),
                           on_globe(radius, r + 1, s + 1), on_globe(radius, r, s + 1) } };
    }
}

/* Of a convex body, the facets that face the point. */
static double facets_lux(const quad *q, int count, dvec3 at, dvec3 normal)
{
    double sum = 0.0;
    for (int i = 0; i < count; i++) {
        const dvec3 *c = q[i].corner;
        dvec3 out      = d3_cross(d3_sub(c[2], c[0]), d3_sub(c[3], c[1]));
        if (d3_dot(out, d3_sub(at, c[0])) > 0.0)
            sum += polygon_lux(c, 4, at, normal);
    }
    return sum;
}

/* 576 triangles, of which half hide the others, and many are seen all but edge on; a globe of
 * radius R and, far from its facets, of luminance L gives pi L (R / D)^2 cos i. */
TEST(a_glowing_globe_hides_its_own_back)
{
    enum { N = 5 };
    static quad facet[FACETS];
    lab l;
    lab_open(&l);
    globe(0.3, facet);
    lab_quads(&l, "glow.gltf", facet, FACETS, lab_glow(&l, 5000.0));
    const dvec3 middle = { 3.1, 2.3, 1.7 };
    lab_probe p[N]     = { { { 3.1, 2.3, 0 }, up },
                           { { 1, 1, 0.5 }, { 0.6, 0.8, 0 } },
                           { { 3.4, 2.9, 1.9 }, { -1, -1, 0 } },
                           { { 5.5, 0.5, 3 }, down },
                           { { 3.1, 2.3, 2.02 }, down } };
    double want[N];
    for (int i = 0; i < N; i++)
        want[i] = 5000.0 * facets_lux(facet, FACETS, d3_sub(p[i].at, middle), p[i].normal);
    assert_near(want[0], M_PI * 5000.0 * 0.09 / (1.7 * 1.7),
                0.03); /* the globe is not quite round */
    grid_result r;
    lab_measure(&l, "scene: {file: glow.gltf, at: [3.1, 2.3, 1.7]}\n", NULL, p, N,
                &(run_options){ .accuracy = 0.02 }, &r);
    lab_check("globe", &r, want, 1e-4, 0.02);
    lab_close(&l);
}

/* Mirrored and stretched by its node: a level quad of 0.4 x 0.2 m, tilted, then flattened. */
TEST(a_stretched_and_mirrored_mesh_glows_as_it_is_seen)
{
    lab l;
    lab_open(&l);
    quad q = {
        { { -0.1, -0.1, -0.1 }, { -0.1, 0.1, -0.1 }, { 0.1, 0.1, 0.1 }, { 0.1, -0.1, 0.1 } }
    };
    lab_write(&l, "glow.gltf",
              "{\"asset\":{\"version\":\"2.0\"},\"extensionsUsed\":["
              "\"KHR_materials_emissive_strength\"],\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{"
              "\"mesh\":0,\"scale\":[-3,0.5,2],\"translation\":[3,2,-2]}],\"materials\":[{%s}],%s}",
              lab_glow(&l, 3000.0), lab_mesh(&l, &q, 1, NULL, 0));
    dvec3 corner[4];
    for (int i = 0; i < 4; i++) /* x, y, z of ours are x, -z, y of glTF's */
        corner[i] = (dvec3){ 3.0 - 3.0 * q.corner[i].x, 2.0 + 2.0 * q.corner[i].y,
                             2.0 + 0.5 * q.corner[i].z };
    const lab_probe p[] = { { { 2, 1, 0 }, up }, { { 5, 2, 2.1 }, { -1, 0, 0 } } };
    double want[2];
    for (int i = 0; i < 2; i++)
        want[i] = 3000.0 * polygon_lux(corner, 4, p[i].at, p[i].normal);
    grid_result r;
    lab_measure(&l, dark_room, NULL, p, 2, &(run_options){ .accuracy = 0.01 }, &r);
    lab_check("stretched", &r, want, 1e-4, 0.01);
    lab_close(&l);
}

/* A closed globe that glows and gives back half has L = L_e / (1 - rho) within, whatever its facets
 * are. Places on them are off their planes by roundings: facets must not light themselves. */
TEST(a_globe_is_a_furnace)
{
    enum { N = 3 };
    static quad facet[FACETS];
    lab l;
    lab_open(&l);
    globe(1.0, facet);
    lab_quads(&l, "glow.gltf", facet, FACETS, lab_glow(&l, 100.0));
    const lab_probe p[N] = { { { 3.1, 2.3, 1.7 }, up },
                             { { 3.5, 2.1, 2.1 }, { 0.6, 0.8, 0 } },
                             { { 2.5, 1.9, 1.5 }, { -1, -1, 0 } } };
    double want[N];
    for (int i = 0; i < N; i++)
        want[i] = 200.0 * M_PI;
    grid_result r;
    lab_measure(&l,
                "scene: {file: glow.gltf, at: [3.1, 2.3, 1.7], rotate: 10}\n"
                "materials: [{match: Glow, reflectance: 0.5}]\n",
                NULL, p, N, &(run_options){ .accuracy = 0.005 }, &r);
    lab_check("furnace", &r, want, 1e-5, 0.005);
    lab_close(&l);
}

/* ---- groups, rooms --------------------------------------------------------------------------- */

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

/* A millimetre before a wall that glows and gives nothing back, in a room that does, there is pi L
 * and no more straight from it. */
TEST(close_before_a_glowing_wall_of_a_room_seeds_agree)
{
    lab l;
    lab_open(&l);
    quad wall = {
        { { 0.5, 3.99, 0.5 }, { 5.5, 3.99, 0.5 }, { 5.5, 3.99, 2.5 }, { 0.5, 3.99, 2.5 } }
    };
    lab_quads(&l, "glow.gltf", &wall, 1, lab_glow(&l, 100.0));
    const lab_probe p[] = { { { 3, 3.989, 1.5 }, { 0, 1, 0 } }, { { 1, 3.989, 1 }, { 0, 1, 0 } } };
    grid_result r[2];
    for (uint32_t seed = 0; seed < 2; seed++) {
        lab_measure(&l, "room: {size: [6, 4, 3], reflectance: 0.5}\nscene: glow.gltf\n", NULL, p, 2,
                    &(run_options){ .accuracy = 0.01, .seed = 1 + seed }, &r[seed]);
        for (int i = 0; i < 2; i++)
            assert_near(r[seed].illuminance[i], 100.0 * M_PI, 0.015);
    }
    lab_close(&l);
}

/* A ceiling with a square of 0.4 m in it that glows, in a room of one reflectance: the mean over
 * all surfaces is pi L A / (S (1 - rho)), by the balance of energy, wherever the square is. */
static void square_balances(const char *lamps, double more)
{
    const double w = 0.7, e = 1.1, s = 1.3, n = 1.7, rho = 0.5,
                 lumens = M_PI * 20000.0 * 0.16 + more;
    lab l;
    lab_open(&l);
    quad side[9], glow = { { { w, s, 2 }, { e, s, 2 }, { e, n, 2 }, { w, n, 2 } } };
    quads_of_box((dvec3){ 0, 0, 0 }, (dvec3){ 3, 2, 2 }, side);
    side[1] = (quad){ { { 0, 0, 2 }, { w, 0, 2 }, { w, 2, 2 }, { 0, 2, 2 } } };
    side[6] = (quad){ { { e, 0, 2 }, { 3, 0, 2 }, { 3, 2, 2 }, { e, 2, 2 } } };
    side[7] = (quad){ { { w, 0, 2 }, { e, 0, 2 }, { e, s, 2 }, { w, s, 2 } } };
    side[8] = (quad){ { { w, n, 2 }, { e, n, 2 }, { e, 2, 2 }, { w, 2, 2 } } };
    lab_quads(&l, "walls.gltf", side, 9, "\"name\":\"Wall\"");
    lab_quads(&l, "glow.gltf", &glow, 1, lab_glow(&l, 20000.0));
    const scene *made = lab_scene(
        &l,
        text_of(&l.a,
                "lux4: 1\n%s\nscene: [walls.gltf, glow.gltf]\n"
                "materials: [{match: '*', reflectance: 0.5}]\ngrids:\n"
                "  - {name: floor, origin: [0, 0, 0], u: [3, 0, 0], v: [0, 2, 0], spacing: 0.2}\n"
                "  - {name: top, origin: [0, 0, 2], u: [0, 2, 0], v: [3, 0, 0], spacing: 0.2}\n"
                "  - {name: south, origin: [0, 0, 0], u: [0, 0, 2], v: [3, 0, 0], spacing: 0.2}\n"
                "  - {name: north, origin: [0, 2, 0], u: [3, 0, 0], v: [0, 0, 2], spacing: 0.2}\n"
                "  - {name: west, origin: [0, 0, 0], u: [0, 2, 0], v: [0, 0, 2], spacing: 0.2}\n"
                "  - {name: east, origin: [3, 0, 0], u: [0, 0, 2], v: [0, 2, 0], spacing: 0.2}\n",
                lamps));
    double flux = 0.0, half = 0.0;
    for (int g = 0; g < 6; g++) {
        grid_result r;
        run_options o = { .accuracy = 0.1, .deadline = HUGE_VAL, .seed = 1, .threads = 1 };
        assert_true(grid_run(&l.a, made, &made->study->grids[g], &o, &r, NULL));
        double area = g < 2 ? 6.0 : g < 4 ? 6.0 : 4.0;
        flux += r.average * area;
        half = hypot(half, independent_half_width(&r) * area);
    }
    /* Cells of 0.2 m: 1e-3, as in test_furnace.c */
    double want = lumens / (1.0 - rho);
    if (!(fabs(flux - want) <= 1e-3 * want + 2.0 * half))
        fail_msg("%.6g lm, not %.6g, +- %.2g", flux, want, half);
    lab_close(&l);
}

TEST(a_small_glowing_square_balances_in_a_room) { square_balances("", 0.0); }

/* Of all of them bounces choose. */
TEST(a_small_glowing_square_balances_beside_lamps)
{
    square_balances("lights: [{type: point, at: [1.2, 0.8, 1.1], lumens: 4000},"
                    " {type: rect, at: [2, 1.2, 1.5], size: [0.6, 0.3], lumens: 6000}]",
                    10000.0);
}

/* One layer a group, undimmed, each with its own closed form. */
TEST(layers_hold_each_group_undimmed)
{
    lab l;
    lab_open(&l);
    quad q = level(3, 2, 2.5, 0.5);
    lab_quads(&l, "glow.gltf", &q, 1, lab_glow(&l, 3000.0));
    const dvec3 panel[] = { { 1, 1, 2.5 }, { 2, 1, 2.5 }, { 2, 2, 2.5 }, { 1, 2, 2.5 } };
    const lab_probe p   = { { 2, 1, 0 }, { 0, 0, 1 } };
    const double glow   = 3000.0 * polygon_lux(q.corner, 4, p.at, up);
    const double rect   = 800.0 * polygon_lux(panel, 4, p.at, up);
    const double lamp   = 500.0 * 2.0 / pow(1 + 1 + 4, 1.5);
    lab_write(&l, "p.csv", "x,y,z,nx,ny,nz\n2,1,0,0,0,1\n");
    const scene *plain = lab_scene(
        &l, "lux4: 1\nroom: {size: [6, 4, 3], reflectance: 0}\nscene: glow.gltf\nmaintenance: 0.8\n"
            "lights: [{type: point, at: [1, 2, 2], intensity: 500, group: spots},\n"
            "  {type: rect, at: [1.5, 1.5, 2.5], size: [1, 1], luminance: 800, group: panels}]\n"
            "dimming: {other: 0.5, spots: 3, panels: 0}\ngrids: [{name: p, points: p.csv}]\n");
    lux_error err  = { 0 };
    const scene *s = scene_new(&l.a, plain->study, &(scene_options){ 1, true }, NULL, &err);
    run_options o  = { .accuracy = 0.01, .deadline = HUGE_VAL, .seed = 1, .threads = 1 };
    grid_result r;
    assert_non_null(s);
    assert_true(grid_run(&l.a, s, &s->study->grids[0], &o, &r, &err));
    lab_check("all", &r, (double[]){ 0.8 * (0.5 * glow + 3.0 * lamp) }, 5e-5, 0.05);
    assert_int_equal(r.layer_count, 3);
    for (int g = 0; g < 3; g++) {
        const grid_layer *layer = &r.layers[g];
        double want = 0.8 * (s->groups[g][0] == 'o' ? glow : s->groups[g][0] == 's' ? lamp : rect);
        double off  = fabs(layer->illuminance[0] - want);
        if (!(off <= fmax(4.0728 / 2.1314 * layer->half_width[0], 0.01 * want)))
            fail_msg("%s: %g lx, not %g", s->groups[g], layer->illuminance[0], want);
        assert_near(layer->direct[0], layer->illuminance[0], 1e-6);
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
        cmocka_unit_test(a_glowing_globe_hides_its_own_back),
        cmocka_unit_test(a_globe_is_a_furnace),
        cmocka_unit_test(a_stretched_and_mirrored_mesh_glows_as_it_is_seen),
        cmocka_unit_test(in_a_room_that_gives_light_back_seeds_agree),
        cmocka_unit_test(close_before_a_glowing_wall_of_a_room_seeds_agree),
        cmocka_unit_test(a_small_glowing_square_balances_in_a_room),
        cmocka_unit_test(a_small_glowing_square_balances_beside_lamps),
        cmocka_unit_test(layers_hold_each_group_undimmed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
