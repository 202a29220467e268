/* tests/cli/test_extremes.c -- numbers that are allowed and hurt: tiny and huge rooms, lamps in
 * walls and at sensors, thousands of lamps. Results are finite and not negative: csv_read() sees to
 * that.
 */
#include "tests/folder.h"
#include "tests/program.h"
#include "tests/test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define ROOM                                                                                       \
    "lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: 0.5}\naccuracy: 20%\n"                        \
    "grids: [{name: g, on: room, height: 0.75, spacing: 1}]\n"

/* The CSV of the study's grid g, to be freed. */
static csv *result_of(const char *yaml)
{
    char *folder     = folder_of_study(yaml);
    csv *c           = malloc(sizeof *c);
    program_result r = { 0 };
    LUX4(folder, 0, &r, "grid", "study.yaml");
    csv_read(path_in(folder, "out/g.csv"), c);
    assert_true(c->count > 0);
    program_free(&r);
    folder_free(folder);
    return c;
}

/* A cube of this side with a lamp of 0.25 cd m^-2 times the side squared, so that all is alike. */
static csv *result_of_cube(double side)
{
    char yaml[600];
    double half = 0.5 * side;
    snprintf(yaml, sizeof yaml,
             "lux4: 1\nroom: {size: [%g, %g, %g], reflectance: 0.5}\naccuracy: 5%%\n"
             "lights: [{type: point, at: [%g, %g, %g], intensity: %g}]\n"
             "grids: [{name: g, origin: [0, 0, %g], u: [%g, 0, 0], v: [0, %g, 0], spacing: %g}]\n",
             side, side, side, half, half, 0.75 * side, 0.25 * side * side, 0.25 * side, side, side,
             half);
    return result_of(yaml);
}

TEST(a_room_of_any_size_is_lit_alike)
{
    csv *metre = result_of_cube(1.0), *micron = result_of_cube(1e-6), *large = result_of_cube(1e6);
    assert_int_equal(metre->count, 4);
    /* d^2 = 3/8, cos = 1/2 / d */
    assert_near(metre->row[0][DIRECT], 0.25 * 0.5 / pow(0.375, 1.5), 1e-5);
    for (int k = 0; k < 4; k++) {
        assert_near(micron->row[k][DIRECT], metre->row[k][DIRECT], 1e-4);
        assert_near(large->row[k][DIRECT], metre->row[k][DIRECT], 1e-4);
        assert_near(micron->row[k][INDIRECT], metre->row[k][INDIRECT], 0.15); /* 3 times 5 % */
        assert_near(large->row[k][INDIRECT], metre->row[k][INDIRECT], 0.15);
    }
    free(metre);
    free(micron);
    free(large);
}

/* A room of reflectance 1 has no finite light: it is taken as 0.995, and the run ends. */
TEST(a_room_that_absorbs_nothing_comes_to_an_end)
{
    char *folder = folder_of_study(
        "lux4: 1\nroom: {size: [2, 2, 2], reflectance: 1}\naccuracy: 30%\n"
        "lights: [{type: point, at: [1, 1, 1], intensity: 1}]\n"
        "grids: [{name: g, on: room, height: 1.5, spacing: 2}]\n"
        "views: [{name: v, eye: [0.1, 0.1, 1], target: [1, 1, 1], size: [8, 6]}]\n");
    csv *c           = malloc(sizeof *c);
    program_result r = { 0 };
    LUX4(folder, 0, &r, "grid", "study.yaml");
    assert_non_null(strstr(
        r.err,
        "3 materials reflect more than 99.5 %, as no real surface does, first \"room: ceiling\""));
    csv_read(path_in(folder, "out/g.csv"), c);
    assert_near(c->row[0][ALL], 4.0 * 3.14159265 / (24.0 * 0.005), 0.6); /* twice 30 % */
    LUX4(folder, 3, &r, "render", "study.yaml", "--time", "0.5", "--accuracy=0.1%");
    assert_true(r.seconds < 15.0);
    free(c);
    program_free(&r);
    folder_free(folder);
}

TEST(black_rooms_and_dark_lamps_give_zeros)
{
    static const char *const studies[] = {
        ROOM,
        ROOM "lights: [{type: point, at: [2, 1.5, 2], intensity: 0}]\n",
        ROOM "lights: [{type: point, at: [2, 1.5, 2], intensity: 100, dimming: 0}]\n",
        ROOM "lights: [{type: point, at: [1e12, 1e12, 1e12], intensity: 1}]\n",
    };
    for (int i = 0; i < 4; i++) {
        csv *c = result_of(studies[i]);
        for (int k = 0; k < c->count; k++)
            assert_near(c->row[k][ALL], 0.0, 1e-20);
        free(c);
    }
}

TEST(lamps_in_odd_places_give_finite_light)
{
    static const char *const places[] = {
        "[0, 1.5, 2]",           "[2, 1.5, 2.5]",      "[0, 0, 0]",      "[4, 3, 2.5]",
        "[1.5, 1.5, 0.75]",      "[1.5, 1.5, 0.7501]", "[2, 1.5, 1e-9]", "[2, 1.5, 0]",
        "[1.5, 1.5, 0.7500001]", "[-1, -1, -1]",       "[2, 1.5, -0.01]"
    };
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        char yaml[512];
        snprintf(yaml, sizeof yaml, "%slights: [{type: point, at: %s, intensity: 100}]\n", ROOM,
                 places[i]);
        free(result_of(yaml));
    }
}

/* What a lamp sheds on a surface beside it comes back from a patch that paths hardly ever meet:
 * with a uniform lamp that is half of its light, with a downlight under the ceiling nothing. */
TEST(a_lamp_beside_a_surface_that_it_lights_has_no_valid_interval)
{
    static const struct {
        const char *lamp, *valid;
    } tries[] = {
        { "lights: [{type: point, at: [2, 1.5, 2.0], intensity: 100}]", "true" },
        { "lights: [{type: point, at: [2, 1.5, 2.49], intensity: 100}]", "false" },
        { "lights: [{type: point, at: [0.001, 1.5, 2.0], intensity: 100}]", "false" },
        { "luminaires: [{photometry: downlight.ies, at: [2, 1.5, 2.49]}]", "true" },
        { "luminaires: [{photometry: downlight.ies, at: [2, 1.5, 2.49], aim: [0, 0, 1]}]",
          "false" },
    };
    size_t size;
    char *web        = bytes_of(path_in(project_root(), "data/office/downlight.ies"), &size);
    program_result r = { 0 };
    for (size_t i = 0; i < sizeof tries / sizeof *tries; i++) {
        char yaml[512];
        snprintf(yaml, sizeof yaml, "%s%s\n", ROOM, tries[i].lamp);
        char *folder = folder_of_study(yaml);
        folder_write(folder, "downlight.ies", web);
        program_run(&(program_desc){ .folder = folder,
                                     .words  = { "grid", "study.yaml", "--json", "--time=0.2" } },
                    &r);
        assert_true(r.code == 0 || r.code == 3); /* it may take long to see such a patch */
        const char *valid = json_at(r.out, "interval_valid");
        if (strncmp(valid, tries[i].valid, 4) != 0 ||
            !strstr(r.err, "are not valid") != (*valid == 't'))
            fail_msg("%s: interval_valid is %s%s", tries[i].lamp, valid, r.err);
        LUX4(folder, 0, &r, "grid", "study.yaml", "--json", "--direct-only");
        assert_memory_equal(json_at(r.out, "interval_valid"), "true", 4);
        folder_free(folder);
    }
    program_free(&r);
    free(web);
}

TEST(a_sensor_at_a_lamp_is_refused_or_finite)
{
    static const struct {
        const char *distance;
        int code;
    } tries[] = { { "0", 0 }, { "1e-30", 0 }, { "1e-16", 2 }, { "1e-9", 0 }, { "0.001", 0 } };
    for (size_t i = 0; i < sizeof tries / sizeof *tries; i++) {
        char yaml[512];
        snprintf(yaml, sizeof yaml,
                 "lux4: 1\nlights: [{type: point, at: [0.5, 0.5, %s], intensity: 1e12}]\n"
                 "grids: [{name: g, origin: [0, 0, 0], u: [1, 0, 0], v: [0, 1, 0], spacing: 1}]\n",
                 tries[i].distance);
        char *folder     = folder_of_study(yaml);
        program_result r = { 0 };
        LUX4(folder, tries[i].code, &r, "grid", "study.yaml");
        if (tries[i].code)
            assert_one_line(&r, "study.yaml:3:9: grid `g`: the sensor at (0.5, 0.5, 0) m has no "
                                "finite illuminance");
        assert_int_equal(count_names(path_in(folder, "out")), tries[i].code ? 0 : 2);
        program_free(&r);
        folder_free(folder);
    }
}

TEST(sensors_in_odd_places_get_finite_light)
{
    static const char *const planes[] = {
        "origin: [0, 0, 0], u: [4, 0, 0], v: [0, 3, 0]",    /* on the floor */
        "origin: [0, 0, 0], u: [0, 3, 0], v: [4, 0, 0]",    /* the same, looking down */
        "origin: [0, 0, 2.5], u: [0, 3, 0], v: [4, 0, 0]",  /* on the ceiling */
        "origin: [-0.5, 0, 0], u: [1, 0, 0], v: [0, 0, 1]", /* on an edge of the room */
        "origin: [1e9, 0, 0], u: [1, 0, 0], v: [0, 1, 0]",  /* far away */
        "origin: [1, 1, 1], u: [1e-9, 0, 0], v: [0, 1e-9, 0]",
    };
    for (size_t i = 0; i < sizeof planes / sizeof *planes; i++) {
        char yaml[512];
        snprintf(yaml, sizeof yaml,
                 "lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: 0.5}\naccuracy: 50%%\n"
                 "lights: [{type: point, at: [2, 1.5, 2], intensity: 100}]\n"
                 "grids: [{name: g, %s, spacing: 1}]\n",
                 planes[i]);
        free(result_of(yaml));
    }
}

TEST(lamps_add_up_however_many_and_strong)
{
    csv *one  = result_of(ROOM "lights: [{type: point, at: [2, 1.5, 2], intensity: 100}]\n");
    csv *two  = result_of(ROOM "lights: [{type: point, at: [[2, 1.5, 2], [2, 1.5, 2]], "
                                "intensity: 50}]\n");
    csv *most = result_of(ROOM "lights: [{type: point, at: [2, 1.5, 2], intensity: 1e12}]\n");

    char *yaml = malloc(1 << 17), *c = yaml;
    c += sprintf(c, "%slights: [{type: point, intensity: 0.025, at: [", ROOM);
    for (int i = 0; i < 4000; i++)
        c += sprintf(c, "%s[2, 1.5, 2]", i ? ", " : "");
    sprintf(c, "]}]\n");
    csv *many = result_of(yaml);
    for (int k = 0; k < one->count; k++) {
        assert_near(two->row[k][DIRECT], one->row[k][DIRECT], 1e-6);
        assert_near(many->row[k][DIRECT], one->row[k][DIRECT], 1e-4);
        assert_near(most->row[k][DIRECT], 1e10 * one->row[k][DIRECT], 1e-6);
        assert_near(two->row[k][ALL], one->row[k][ALL], 0.4);
        assert_near(many->row[k][ALL], one->row[k][ALL], 0.4);
    }
    free(yaml);
    free(one);
    free(two);
    free(most);
    free(many);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_room_of_any_size_is_lit_alike),
        cmocka_unit_test(a_room_that_absorbs_nothing_comes_to_an_end),
        cmocka_unit_test(black_rooms_and_dark_lamps_give_zeros),
        cmocka_unit_test(lamps_in_odd_places_give_finite_light),
        cmocka_unit_test(a_lamp_beside_a_surface_that_it_lights_has_no_valid_interval),
        cmocka_unit_test(a_sensor_at_a_lamp_is_refused_or_finite),
        cmocka_unit_test(sensors_in_odd_places_get_finite_light),
        cmocka_unit_test(lamps_add_up_however_many_and_strong),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
