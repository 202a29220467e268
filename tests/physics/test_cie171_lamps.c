/* tests/physics/test_cie171_lamps.c -- CIE 171:2006, 5.2 to 5.4, 5.6, 5.7: light from lamps.
 *
 * Values are exact, from independent quadrature; where the tables of the publication differ from
 * them, as in 5.7, it is known to be wrong (I. Ashdown's errata). Rooms are 4 x 4 x 3 m; points A-F
 * are on the wall y = 0 at x = 2, G-N on the floor (5.3, 5.7) or ceiling (5.6).
 * Tolerance: 0.5 %, and the interval.
 */
#include "tests/lab.h"
#include "tests/test.h"

enum { WALL = 6, FLOOR = 8 };

static const dvec3 up = { 0, 0, 1 }, down = { 0, 0, -1 }, north = { 0, 1, 0 };

static const double down_the_wall[WALL] = { 2.75, 2.25, 1.75, 1.25, 0.75, 0.25 };

/* ---- 5.2: point sources above a plane -------------------------------------------------------- */

static void points_3_m_below(const char *lamp, const double want[10])
{
    static const double at[10][2] = {
        { 0, 0 },   { 0.5, 0 },   { 1, 0 }, { 1.5, 0 }, { 0.5, 0.5 },
        { 1, 0.5 }, { 1.5, 0.5 }, { 1, 1 }, { 1.5, 1 }, { 1.5, 1.5 }
    };
    lab l;
    lab_open(&l);
    lab_probe p[10];
    grid_result r;
    for (int i = 0; i < 10; i++)
        p[i] = (lab_probe){ { at[i][0], at[i][1], 0 }, up };
    lab_measure(&l, lamp, NULL, p, 10, &(run_options){ 0 }, &r);
    for (int i = 0; i < 10; i++)
        assert_near(r.illuminance[i], want[i], 1e-5);
    lab_close(&l);
}

TEST(case_5_2_a_lambertian_point)
{
    points_3_m_below("lights: [{type: cosine, at: [0, 0, 3], intensity: 1000, exponent: 1}]",
                     (const double[]){ 111.111, 105.186, 90.000, 71.111, 99.723, 85.663, 68.053,
                                       74.380, 59.975, 49.383 });
}

TEST(case_5_2_an_isotropic_point)
{
    points_3_m_below("lights: [{type: point, at: [0, 0, 3], intensity: 1000}]",
                     (const double[]){ 111.111, 106.637, 94.868, 79.505, 102.456, 91.419, 76.926,
                                       82.230, 69.971, 60.481 });
}

/* ---- 5.3: a square luminaire in the ceiling -------------------------------------------------- */

static const double square_luminaire[WALL + FLOOR] = { 32.677,  75.194, 81.323, 69.061, 53.404,
                                                       40.002,  61.424, 79.255, 95.667, 105.778,
                                                       105.778, 95.667, 79.255, 61.424 };

static void wall_and_floor(lab_probe p[WALL + FLOOR])
{
    for (int i = 0; i < WALL; i++)
        p[i] = (lab_probe){ { 2, 0, down_the_wall[i] }, north };
    for (int i = 0; i < FLOOR; i++)
        p[WALL + i] = (lab_probe){ { 2, 0.25 + 0.5 * i, 0 }, up };
}

/* Black walls, the ceiling 1 cm above: nothing stands between, so that the closed form serves */
TEST(case_5_3_a_square_luminaire_in_a_room)
{
    lab l;
    lab_open(&l);
    lab_probe p[WALL + FLOOR];
    grid_result r;
    wall_and_floor(p);
    lab_measure(&l,
                "room: {size: [4, 4, 3.01], reflectance: 0}\n"
                "lights: [{type: rect, at: [2, 2, 3], size: [1, 1], luminance: 1000}]",
                NULL, p, WALL + FLOOR, &(run_options){ 0 }, &r);
    for (int i = 0; i < WALL + FLOOR; i++)
        assert_near(r.illuminance[i], square_luminaire[i], 2e-5);
    lab_check("5.3", &r, square_luminaire, 2e-5, 0.0);
    lab_close(&l);
}

/* The same, as a light that things could hide: sampled */
TEST(case_5_3_a_square_luminaire_among_things)
{
    lab l;
    lab_open(&l);
    lab_probe p[WALL + FLOOR];
    grid_result r;
    wall_and_floor(p);
    lab_speck(&l, "speck.gltf");
    lab_measure(&l,
                "scene: speck.gltf\n"
                "lights: [{type: rect, at: [2, 2, 3], size: [1, 1], luminance: 1000}]",
                NULL, p, WALL + FLOOR, &(run_options){ .accuracy = 0.005 }, &r);
    lab_check("5.3 sampled", &r, square_luminaire, 2e-5, 0.005);
    lab_close(&l);
}

/* ---- 5.4: what leaves the lamp arrives ------------------------------------------------------- */

TEST(case_5_4_the_flux_of_a_lamp_arrives_at_the_walls)
{
    lab l;
    lab_open(&l);
    const scene *s = lab_scene(&l, "lux4: 1\nroom: {size: [4, 4, 3], reflectance: 0}\n"
                                   "lights: [{type: point, at: [2, 2, 1.5], lumens: 10000}]\n"
                                   "grids:\n  - {name: floor, on: floor, spacing: 0.1}\n"
                                   "  - {name: ceiling, on: ceiling, spacing: 0.1}\n"
                                   "  - {name: walls, on: walls, spacing: 0.1}\n");
    double flux    = 0.0;
    assert_int_equal(s->study->grid_count, 6);
    for (int g = 0; g < 6; g++) {
        grid_result r;
        run_options o = { .accuracy = (double)NAN, .deadline = HUGE_VAL, .seed = 1, .threads = 1 };
        assert_true(grid_run(&l.a, s, &s->study->grids[g], &o, &r, NULL));
        flux += r.average * (double)r.sensor_count * 0.01;
    }
    assert_near(flux, 10000.0, 3e-4); /* the midpoint rule: 0.1 m^2 / 24 of the slopes at edges */
    lab_close(&l);
}

/* ---- 5.6: a floor in the light of the sky's hole --------------------------------------------- */

static const char matt[] = "\"name\":\"Matt\",\"pbrMetallicRoughness\":{\"metallicFactor\":0}";

/* As percent of rho E. Points A-F go up the wall here, and A is left out as it is there. */
TEST(case_5_6_light_comes_back_from_a_floor)
{
    static const double percent[5 + FLOOR] = { 35.901, 27.992, 21.639, 16.716, 12.967,
                                               26.795, 30.939, 33.976, 35.567, 35.567,
                                               33.976, 30.939, 26.795 };
    const double rho = 0.3, lux = 1000.0;
    lab l;
    lab_open(&l);
    quad floor = { { { 0, 0, 0 }, { 4, 0, 0 }, { 4, 4, 0 }, { 0, 4, 0 } } };
    lab_quads(&l, "floor.gltf", &floor, 1, matt);
    lab_probe p[5 + FLOOR];
    double want[5 + FLOOR];
    for (int i = 0; i < 5; i++)
        p[i] = (lab_probe){ { 2, 0, 0.75 + 0.5 * i }, north };
    for (int i = 0; i < FLOOR; i++)
        p[5 + i] = (lab_probe){ { 2, 0.25 + 0.5 * i, 3 }, down };
    for (int i = 0; i < 5 + FLOOR; i++)
        want[i] = percent[i] / 100.0 * rho * lux;
    grid_result r;
    lab_measure(&l,
                "scene: floor.gltf\nmaterials: [{match: Matt, reflectance: 0.3}]\n"
                "lights: [{type: parallel, aim: [0, 0, -1], illuminance: 1000}]",
                NULL, p, 5 + FLOOR, &(run_options){ .accuracy = 0.005 }, &r);
    lab_check("5.6", &r, want, 5e-5, 0.005);
    for (int i = 0; i < 5 + FLOOR; i++)
        assert_near(r.direct[i], 0.0, 1e-6);
    lab_close(&l);
}

/* ---- 5.7: a wall behind an obstacle ---------------------------------------------------------- */

/* The wall y = 4 (4 x 3 m) is lit at 45 deg from above the points; a plate high above the floor
 * keeps that light from the floor. A black box, 1 m high, stands on the floor at y 2.5 to 2.7. */
TEST(case_5_7_light_comes_back_from_a_wall_past_a_box)
{
    static const double percent[WALL + 5] = { 16.071, 16.330, 15.399, 13.322, 10.317, 7.079,
                                              3.382,  3.629,  3.013,  0,      0 };
    const double rho = 0.6, lux = 1000.0;
    lab l;
    lab_open(&l);
    quad wall = { { { 0, 4, 0 }, { 4, 4, 0 }, { 4, 4, 3 }, { 0, 4, 3 } } }, box[7];
    quads_of_box((dvec3){ 0, 2.5, 0 }, (dvec3){ 4, 2.7, 1 }, box);
    box[6] = (quad){ { { -50, -11, 10 }, { 50, -11, 10 }, { 50, -6.5, 10 }, { -50, -6.5, 10 } } };
    lab_quads(&l, "wall.gltf", &wall, 1, matt);
    lab_quads(&l, "box.gltf", box, 7, "\"name\":\"Black\"");
    lab_probe p[WALL + 5];
    double want[WALL + 5];
    for (int i = 0; i < WALL; i++)
        p[i] = (lab_probe){ { 2, 0, down_the_wall[i] }, north };
    for (int i = 0; i < 5; i++)
        p[WALL + i] = (lab_probe){ { 2, 0.25 + 0.5 * i, 0 }, up };
    for (int i = 0; i < WALL + 5; i++)
        want[i] = percent[i] / 100.0 * rho * lux * sqrt(0.5);
    grid_result r;
    lab_measure(&l,
                "scene: [wall.gltf, box.gltf]\n"
                "materials: [{match: Matt, reflectance: 0.6}, {match: Black, reflectance: 0}]\n"
                "lights: [{type: parallel, aim: [0, 1, -1], illuminance: 1000}]",
                NULL, p, WALL + 5, &(run_options){ .accuracy = 0.01 }, &r);
    lab_check("5.7", &r, want, 2e-4, 0.01);
    for (int i = 0; i < WALL + 5; i++)
        assert_near(r.direct[i], 0.0, 1e-6);
    lab_close(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(case_5_2_a_lambertian_point),
        cmocka_unit_test(case_5_2_an_isotropic_point),
        cmocka_unit_test(case_5_3_a_square_luminaire_in_a_room),
        cmocka_unit_test(case_5_3_a_square_luminaire_among_things),
        cmocka_unit_test(case_5_4_the_flux_of_a_lamp_arrives_at_the_walls),
        cmocka_unit_test(case_5_6_light_comes_back_from_a_floor),
        cmocka_unit_test(case_5_7_light_comes_back_from_a_wall_past_a_box),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
