/* tests/cli/test_judged.c -- a study judged: what is required of grids, variants, and sensors that
 * furniture leaves no place for.
 */
#include "core/image.h"
#include "tests/box_gltf.h"
#include "tests/folder.h"
#include "tests/program.h"
#include "tests/test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- requirements ---------------------------------------------------------------------------- */

/* Sensors right below a lamp of 400 cd at 2 m, and 2 m aside: 100 lx and 100 / 2 sqrt 2 lx. */
static void write_study(const char *folder, const char *require, const char *reflectance)
{
    char text[1024];
    snprintf(text, sizeof text,
             "lux4: 1\nroom: {size: [8, 8, 3], reflectance: %s}\n"
             "lights: [{type: point, at: [4, 4, 2], intensity: 400}]\n"
             "grids: [{name: g, origin: [3, 3, 0], u: [4, 0, 0], v: [0, 2, 0], spacing: 2,\n"
             "         require: %s}]\n",
             reflectance, require);
    folder_write(folder, "study.yaml", text);
}

TEST(requirements_are_met_or_missed)
{
    static const struct {
        const char *require, *says;
        bool met;
    } cases[] = {
        { "{average: 67.6}", "average    asked 67.6 lx, got 67.68 +- 0 lx: met", true },
        { "{average: 67.7}", "average    asked 67.7 lx, got 67.68 +- 0 lx: MISSED", false },
        { "{minimum: 35.3}", "minimum    asked 35.3 lx, got 35.36 +- 0 lx: met", true },
        { "{minimum: 35.4}", "minimum    asked 35.4 lx, got 35.36 +- 0 lx: MISSED", false },
        { "{maximum: 100.1}", "maximum    asked at most 100.1 lx, got 100 +- 0 lx: met", true },
        { "{maximum: 99.9}", "maximum    asked at most 99.9 lx, got 100 +- 0 lx: MISSED", false },
        { "{uniformity: 0.52}", "uniformity asked 0.52, got 0.5224 +- 0: met", true },
        { "{uniformity: 0.53}", "uniformity asked 0.53, got 0.5224 +- 0: MISSED", false },
    };
    char *folder     = folder_new();
    program_result r = { 0 };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        write_study(folder, cases[i].require, "0");
        LUX4(folder, 0, &r, "grid", "study.yaml", "--overwrite");
        if (!strstr(r.out, cases[i].says))
            fail_msg("no `%s` in\n%s", cases[i].says, r.out);
        assert_null(strstr(r.out, "not decided"));
        LUX4(folder, 0, &r, "grid", "study.yaml", "--overwrite", "--json");
        assert_true(json_is_valid(r.out));
        const char *met = json_at(r.out, "grids.0.requirements.0.met");
        assert_memory_equal(met, cases[i].met ? "true" : "false", 4);
        assert_memory_equal(json_at(r.out, "grids.0.requirements.0.decided"), "true", 4);
        assert_null(json_at(r.out, "grids.0.requirements.1"));
    }
    program_free(&r);
    folder_free(folder);
}

/* 160 times the light: 16000 lx below the lamp, and 5656.9 lx aside. */
TEST(much_light_is_told_without_exponents)
{
    char *folder     = folder_new();
    program_result r = { 0 };
    folder_write(folder, "study.yaml",
                 "lux4: 1\nroom: {size: [8, 8, 3], reflectance: 0.5}\n"
                 "lights: [{type: point, at: [4, 4, 2], intensity: 64000}]\n"
                 "grids: [{name: g, origin: [3, 3, 0], u: [4, 0, 0], v: [0, 2, 0], spacing: 2,\n"
                 "         require: {average: 2000000, maximum: 16000}}]\n");
    LUX4(folder, 0, &r, "grid", "study.yaml");
    assert_non_null(strstr(r.out, "asked 2000000 lx, got 1"));
    assert_null(strstr(r.out, "e+0"));
    program_free(&r);
    folder_free(folder);
}

TEST(what_the_accuracy_does_not_decide_is_told)
{
    char *folder     = folder_new(), require[64];
    program_result r = { 0 };
    write_study(folder, "{average: 1}", "0.5");
    LUX4(folder, 0, &r, "grid", "study.yaml", "--json", "--accuracy", "20%");
    double average = json_number_at(r.out, "grids.0.average_lx");
    double half    = json_number_at(r.out, "grids.0.requirements.0.half_width");
    assert_true(half > 0.0 && half < 0.2 * average);
    assert_near(json_number_at(r.out, "grids.0.requirements.0.got"), average, 0.0);
    assert_near(json_number_at(r.out, "grids.0.average_half_width_lx"), half, 1e-9);
    assert_memory_equal(json_at(r.out, "grids.0.requirements.0.decided"), "true", 4);

    snprintf(require, sizeof require, "{average: %.9g}", average + 0.5 * half);
    write_study(folder, require, "0.5");
    LUX4(folder, 0, &r, "grid", "study.yaml", "--overwrite", "--accuracy", "20%");
    assert_non_null(strstr(r.out, "lx: MISSED (not decided at this accuracy: ask for more)"));
    LUX4(folder, 0, &r, "grid", "study.yaml", "--overwrite", "--accuracy", "20%", "--json");
    assert_memory_equal(json_at(r.out, "grids.0.requirements.0.met"), "false", 5);
    assert_memory_equal(json_at(r.out, "grids.0.requirements.0.decided"), "false", 5);
    program_free(&r);
    folder_free(folder);
}

TEST(lamps_that_are_out_are_no_doubt)
{
    char *folder     = folder_of_study("lux4: 1\nroom: {size: [4, 4, 3], reflectance: 0.5}\n"
                                           "lights: [{type: point, at: [2, 2, 2], lumens: 0}]\n"
                                           "grids: [{name: g, on: room, height: 0, spacing: 1}]\n");
    program_result r = { 0 };
    LUX4(folder, 0, &r, "grid", "study.yaml", "--json");
    assert_memory_equal(json_at(r.out, "interval_valid"), "true", 4);
    assert_near(json_number_at(r.out, "grids.0.average_lx"), 0.0, 0.0);
    program_free(&r);
    folder_free(folder);
}

/* ---- variants -------------------------------------------------------------------------------- */

static const char varied[] =
    "lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: {ceiling: 0.7, walls: %s, floor: 0.2}}\n"
    "maintenance: 0.8\n"
    "lights:\n"
    "  - {type: rect, at: [1, 1, 2.4], size: [0.3, 1.2], lumens: 1000, group: general}\n"
    "  - {type: point, at: [3, 2, 2.2], lumens: 700}\n"
    "dimming: {general: %s}\n"
    "grids: [{name: g, on: room, height: 0.5, spacing: 1}]\n"
    "views: [{name: v, eye: [0.3, 0.3, 1.5], target: [3, 2, 1.4], size: [9, 7]}]\n%s";

TEST(a_variant_is_the_study_edited_to_the_bit)
{
    char *folder     = folder_new(), text[2048];
    program_result r = { 0 };
    snprintf(text, sizeof text, varied, "0.5", "1",
             "variants:\n  evening: {room: {reflectance: {walls: 0.3}}, dimming: {general: 0.25}}\n"
             "  day: {dimming: ~}\n");
    folder_write(folder, "study.yaml", text);
    snprintf(text, sizeof text, varied, "0.3", "0.25", "");
    folder_write(folder, "edited.yaml", text);
    static const char *const names[] = { "study.yaml", "edited.yaml" };
    for (int i = 0; i < 2; i++) {
        const char *out = i ? "edited" : "varied", *option = i ? "--quiet" : "--variant";
        const char *variant = i ? NULL : "evening";
        LUX4(folder, 0, &r, "grid", names[i], "-o", out, "--accuracy", "10%", option, variant);
        LUX4(folder, 0, &r, "render", names[i], "-o", out, "--accuracy", "40%", option, variant);
    }
    assert_same_bytes(path_in(folder, "varied/g.csv"), path_in(folder, "edited/g.csv"));
    assert_same_bytes(path_in(folder, "varied/v.png"), path_in(folder, "edited/v.png"));

    LUX4_FAILS(folder, 2, "evning", "grid", "study.yaml", "--variant", "evning");
    LUX4_FAILS(folder, 2, "evening", "grid", "edited.yaml", "--variant", "evening");
    LUX4_FAILS(folder, 2, "--variant", "grid", "study.yaml", "--variant");
    program_free(&r);
    folder_free(folder);
}

/* ---- furniture ------------------------------------------------------------------------------- */

TEST(sensors_inside_a_cupboard_are_left_out)
{
    char *folder = folder_of_study(
        "lux4: 1\nroom: {size: [5, 4, 2.8], reflectance: 0.5}\nscene: box.gltf\naccuracy: 20%\n"
        "lights: [{type: point, at: [4, 3, 2.5], lumens: 1000}]\n"
        "grids:\n  - {name: g, on: room, height: 0.5, spacing: 1}\n"
        "  - {name: above, on: room, height: 1.5, spacing: 1}\n");
    program_result r = { 0 };
    csv *rows        = calloc(1, sizeof *rows);
    box_gltf_write(folder, "box.gltf", (double[]){ 1.1, 1.2, 0 }, (double[]){ 2.9, 1.8, 1 }, 0.0);
    LUX4(folder, 0, &r, "grid", "study.yaml");
    assert_non_null(strstr(r.out, "2 sensors left out: inside furniture"));
    csv_read(path_in(folder, "out/g.csv"), rows);
    assert_int_equal(rows->count, 5 * 4 - 2); /* at 1.5 and 2.5 m east, 1.5 m north */
    for (int k = 0; k < rows->count; k++)
        assert_false(rows->row[k][Y] == 1.5 && (rows->row[k][X] == 1.5 || rows->row[k][X] == 2.5));
    csv_read(path_in(folder, "out/above.csv"), rows);
    assert_int_equal(rows->count, 5 * 4);

    LUX4(folder, 0, &r, "grid", "study.yaml", "--json", "--overwrite");
    assert_near(json_number_at(r.out, "grids.0.sensors"), 18.0, 0.0);
    assert_near(json_number_at(r.out, "grids.0.sensors_left_out"), 2.0, 0.0);
    assert_null(json_at(r.out, "grids.1.sensors_left_out"));

    /* A mixture's average is that of the sensors, in the table as in the picture */
    double average[2];
    LUX4(folder, 0, &r, "grid", "study.yaml", "--groups", "--overwrite", "--quiet");
    for (int i = 0; i < 2; i++) {
        LUX4(folder, 0, &r, "mix", i ? "out/g.exr" : "out/g.csv", "--json");
        average[i] = json_number_at(r.out, "average_lx");
    }
    assert_near(average[1], average[0], 1e-6);

    arena a       = { 0 };
    lux_error err = { 0 };
    image im;
    assert_true(image_read_exr(path_in(folder, "out/g.exr"), &a, &im, &err));
    const float *left_out = NULL, *all = NULL;
    for (int c = 0; c < im.channel_count; c++) {
        left_out = strcmp(im.channels[c].name, "leftOut.Y") ? left_out : im.channels[c].values;
        all      = strcmp(im.channels[c].name, "Y") ? all : im.channels[c].values;
    }
    assert_non_null(left_out);
    for (int i = 0; i < 5 * 4; i++) { /* the top row is the farthest north */
        bool out = i == 2 * 5 + 1 || i == 2 * 5 + 2;
        assert_near(left_out[i], out ? 1.0 : 0.0, 0.0);
        assert_true((all[i] > 0.0f) == !out);
    }
    arena_clear(&a);
    free(rows);
    program_free(&r);
    folder_free(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(requirements_are_met_or_missed),
        cmocka_unit_test(much_light_is_told_without_exponents),
        cmocka_unit_test(what_the_accuracy_does_not_decide_is_told),
        cmocka_unit_test(lamps_that_are_out_are_no_doubt),
        cmocka_unit_test(a_variant_is_the_study_edited_to_the_bit),
        cmocka_unit_test(sensors_inside_a_cupboard_are_left_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
