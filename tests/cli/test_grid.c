/* tests/cli/test_grid.c -- lux4 grid: its table, its JSON, and the files that it writes. */
#define _GNU_SOURCE
#include "core/image.h"
#include "tests/folder.h"
#include "tests/program.h"
#include "tests/test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* A lamp of 100 cd, 2 m above the middle sensor of a 3 x 5 grid, in a room that gives back half. */
static const char room[] =
    "lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: 0.5}\n"
    "lights: [{type: point, at: [1.75, 1.5, 2.25], intensity: 100}]\n"
    "grids:\n  - {name: floor-1, origin: [0.25, 1, 0.25], u: [3, 0, 0], v: [0, 1, 0], "
    "spacing: 1, require: {average: 10, minimum: 1000, uniformity: 0.01}}\n"
    "  - {name: probes, points: probes.csv}\naccuracy: 20%\n";
static const char probes[] = "x,y,z,nx,ny,nz\n1.75,1.5,0.25,0,0,1\n1,1,1,0,0.6,0.8\n";

static char *folder_of_room(void)
{
    char *folder = folder_of_study(room);
    folder_write(folder, "probes.csv", probes);
    return folder;
}

static const image_channel *channel_of(const image *im, const char *name)
{
    for (int i = 0; i < im->channel_count; i++)
        if (!strcmp(im->channels[i].name, name))
            return &im->channels[i];
    fail_msg("no channel %s", name);
    return NULL;
}

static const image_attribute *attribute_of(const image *im, const char *name)
{
    for (int i = 0; i < im->attribute_count; i++)
        if (!strcmp(im->attributes[i].name, name))
            return &im->attributes[i];
    fail_msg("no attribute %s", name);
    return NULL;
}

TEST(a_csv_has_a_row_for_each_sensor)
{
    char *folder     = folder_of_room();
    program_result r = { 0 };
    csv *c           = malloc(sizeof *c);
    LUX4(folder, 0, &r, "grid", "study.yaml");
    assert_string_equal(r.err, "");
    csv_read(path_in(folder, "out/floor-1.csv"), c);
    assert_int_equal(c->count, 3); /* 3 m by 1 m, at 1 m */
    assert_false(c->partial);
    for (int k = 0; k < 3; k++) {
        assert_near(c->row[k][X], 0.75 + k, 1e-12);
        assert_near(c->row[k][Y], 1.5, 1e-12);
        assert_near(c->row[k][Z], 0.25, 1e-12);
        assert_near(c->row[k][NZ], 1.0, 1e-12);
        assert_true(c->row[k][INDIRECT] > 0.0 && c->row[k][HALF_WIDTH] > 0.0);
    }
    assert_near(c->row[1][DIRECT], 100.0 / 4.0, 1e-6);                 /* I / d^2 */
    assert_near(c->row[0][DIRECT], 100.0 * 2.0 / pow(5.0, 1.5), 1e-6); /* I h / d^3 */

    csv_read(path_in(folder, "out/probes.csv"), c);
    assert_int_equal(c->count, 2);
    assert_near(c->row[0][DIRECT], 25.0, 1e-6);
    assert_near(c->row[1][NY], 0.6, 1e-7);
    free(c);
    program_free(&r);
    folder_free(folder);
}

TEST(an_exr_holds_what_the_csv_holds)
{
    char *folder     = folder_of_room();
    program_result r = { 0 };
    csv *c           = malloc(sizeof *c);
    arena a          = { 0 };
    lux_error err    = { 0 };
    image im;
    folder_write(folder, "rows.yaml",
                 "lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: 0.5}\naccuracy: 50%\n"
                 "lights: [{type: point, at: [0.5, 1.5, 2.25], intensity: 100}]\n"
                 "grids: [{name: rows, on: room, height: 1, spacing: 1}]\n");
    LUX4(folder, 0, &r, "grid", "rows.yaml");
    csv_read(path_in(folder, "out/rows.csv"), c);
    assert_true(image_read_exr(path_in(folder, "out/rows.exr"), &a, &im, &err));
    assert_int_equal(im.width, 4);
    assert_int_equal(im.height, 3);
    assert_int_equal(im.channel_count, 4);
    static const struct {
        const char *name;
        int column;
    } layers[] = { { "Y", ALL },
                   { "direct.Y", DIRECT },
                   { "indirect.Y", INDIRECT },
                   { "halfWidth.Y", HALF_WIDTH } };
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 12; k++) /* the top row has the largest v */
            assert_near(channel_of(&im, layers[i].name)->values[(2 - k / 4) * 4 + k % 4],
                        c->row[k][layers[i].column], 1e-6);
    assert_near(attribute_of(&im, "whiteLuminance")->number, 179.0, 0.0);
    assert_string_equal(attribute_of(&im, "lux4:study")->text, "rows.yaml");
    assert_string_equal(attribute_of(&im, "lux4:interval")->text, "valid");
    arena_clear(&a);
    free(c);
    program_free(&r);
    folder_free(folder);
}

TEST(an_exr_names_the_variant_that_it_is_of)
{
    char *folder     = folder_of_room(), *text;
    program_result r = { 0 };
    arena a          = { 0 };
    lux_error err    = { 0 };
    image im;
    assert_true(asprintf(&text, "%svariants: {old: {maintenance: 0.5}}\n", room) > 0);
    folder_write(folder, "study.yaml", text);
    LUX4(folder, 0, &r, "grid", "study.yaml", "--variant", "old");
    assert_true(image_read_exr(path_in(folder, "out/floor-1.exr"), &a, &im, &err));
    assert_string_equal(attribute_of(&im, "lux4:variant")->text, "old");
    LUX4(folder, 0, &r, "grid", "study.yaml");
    assert_true(image_read_exr(path_in(folder, "out/floor-1.exr"), &a, &im, &err));
    for (int i = 0; i < im.attribute_count; i++)
        assert_string_not_equal(im.attributes[i].name, "lux4:variant");
    free(text);
    arena_clear(&a);
    program_free(&r);
    folder_free(folder);
}

TEST(the_table_says_what_is_met_and_where_files_lie)
{
    char *folder     = folder_of_room();
    program_result r = { 0 };
    LUX4(folder, 0, &r, "grid", "study.yaml");
    assert_non_null(strstr(r.out, "average    asked 10 lx"));
    assert_non_null(strstr(r.out, ": met\n"));
    assert_non_null(strstr(r.out, "minimum    asked 1000 lx"));
    assert_non_null(strstr(r.out, ": MISSED\n"));
    assert_non_null(strstr(r.out, "out/floor-1.csv"));
    assert_non_null(strstr(r.out, "out/probes.exr"));
    program_free(&r);
    folder_free(folder);
}

TEST(json_has_what_the_contract_names)
{
    char *folder     = folder_of_room();
    program_result r = { 0 };
    csv *c           = malloc(sizeof *c);
    LUX4(folder, 0, &r, "grid", "--json", "study.yaml");
    if (!json_is_valid(r.out))
        fail_msg("no JSON: %s", r.out);
    csv_read(path_in(folder, "out/floor-1.csv"), c);
    double sum = c->row[0][ALL] + c->row[1][ALL] + c->row[2][ALL];
    double low = fmin(c->row[0][ALL], c->row[2][ALL]);
    assert_memory_equal(json_at(r.out, "grids.0.name"), "\"floor-1\"", 9);
    assert_memory_equal(json_at(r.out, "grids.1.name"), "\"probes\"", 8);
    assert_near(json_number_at(r.out, "grids.0.sensors"), 3.0, 0.0);
    assert_near(json_number_at(r.out, "grids.0.average_lx"), sum / 3.0, 1e-7);
    assert_near(json_number_at(r.out, "grids.0.minimum_lx"), low, 1e-7);
    assert_near(json_number_at(r.out, "grids.0.maximum_lx"), c->row[1][ALL], 1e-7);
    assert_near(json_number_at(r.out, "grids.0.uniformity"), low / (sum / 3.0), 1e-7);
    assert_true(json_number_at(r.out, "grids.0.average_half_width_lx") > 0.0);
    assert_true(json_number_at(r.out, "grids.0.worst_half_width_percent") <= 20.0);
    assert_near(json_number_at(r.out, "grids.0.sensors_missed"), 0.0, 0.0);
    assert_near(json_number_at(r.out, "grids.0.requirements.1.asked"), 1000.0, 0.0);
    assert_near(json_number_at(r.out, "grids.0.requirements.1.got"), low, 1e-7);
    assert_memory_equal(json_at(r.out, "grids.0.requirements.0.met"), "true", 4);
    assert_memory_equal(json_at(r.out, "grids.0.requirements.1.met"), "false", 5);
    assert_memory_equal(json_at(r.out, "grids.0.requirements.2.name"), "\"uniformity\"", 12);
    assert_memory_equal(json_at(r.out, "grids.1.requirements"), "[]", 2);
    assert_true(json_number_at(r.out, "seconds") > 0.0);
    assert_true(json_number_at(r.out, "rays") > 100.0);
    assert_memory_equal(json_at(r.out, "effects.0"), "\"", 1);
    assert_memory_equal(json_at(r.out, "interval_valid"), "true", 4);
    free(c);
    program_free(&r);
    folder_free(folder);
}

TEST(results_of_others_are_not_replaced_unasked)
{
    char *folder     = folder_of_room();
    program_result r = { 0 };
    LUX4(folder, 0, &r, "grid", "study.yaml");
    LUX4(folder, 0, &r, "grid", "study.yaml"); /* the same study, into the default folder */
    folder_write(folder, "other.yaml", room);
    LUX4_FAILS(folder, 2, "is there already: --overwrite replaces it", "grid", "other.yaml");
    LUX4(folder, 0, &r, "grid", "other.yaml", "--overwrite");
    LUX4_FAILS(folder, 2, "is there already", "grid", "study.yaml");
    LUX4(folder, 0, &r, "grid", "study.yaml", "-o", "results/of/today");
    assert_true(there_is(folder, "results/of/today/floor-1.csv"));
    LUX4_FAILS(folder, 2, "is there already", "grid", "study.yaml", "-o", "results/of/today");
    LUX4(folder, 0, &r, "grid", "study.yaml", "-o", "results/of/today", "--overwrite");

    folder_write(folder, "out/floor-1.exr", "somebody's own");
    LUX4_FAILS(folder, 2, "is there already", "grid", "other.yaml");
    assert_int_equal(count_names(path_in(folder, "out")), 4);
    program_free(&r);
    folder_free(folder);
}

TEST(direct_only_leaves_interreflection_out)
{
    char *folder     = folder_of_room();
    program_result r = { 0 };
    csv *c           = malloc(sizeof *c);
    LUX4(folder, 0, &r, "grid", "--direct-only", "--json", "study.yaml");
    csv_read(path_in(folder, "out/floor-1.csv"), c);
    assert_near(c->row[1][ALL], 25.0, 1e-6);
    for (int k = 0; k < 3; k++) {
        assert_near(c->row[k][INDIRECT], 0.0, 0.0);
        assert_near(c->row[k][HALF_WIDTH], 0.0, 0.0);
    }
    assert_null(strstr(r.out, "interreflection"));
    free(c);
    program_free(&r);
    folder_free(folder);
}

TEST(a_seed_decides_the_samples_and_threads_do_not)
{
    char *folder     = folder_of_room();
    program_result r = { 0 };
    LUX4(folder, 0, &r, "grid", "study.yaml", "-o", "one", "--threads", "1");
    LUX4(folder, 0, &r, "grid", "study.yaml", "-o", "two", "--threads", "2", "--seed", "1");
    LUX4(folder, 0, &r, "grid", "study.yaml", "-o", "many", "--threads", "7", "--json");
    LUX4(folder, 0, &r, "grid", "study.yaml", "-o", "other", "--seed", "2");
    static const char *const names[] = { "floor-1.csv", "floor-1.exr", "probes.csv", "probes.exr" };
    for (int i = 0; i < 4; i++) {
        const char *one = path_in(path_in(folder, "one"), names[i]);
        assert_same_bytes(path_in(path_in(folder, "two"), names[i]), one);
        assert_same_bytes(path_in(path_in(folder, "many"), names[i]), one);
        assert_false(same_bytes(path_in(path_in(folder, "other"), names[i]), one));
    }
    program_free(&r);
    folder_free(folder);
}

TEST(without_time_the_first_results_are_written_whole)
{
    char *folder     = folder_of_room();
    program_result r = { 0 };
    csv *c           = malloc(sizeof *c);
    LUX4(folder, 3, &r, "grid", "study.yaml", "--time", "0", "--accuracy", "0.01%");
    assert_one_line(&r, "time was out before the accuracy asked for was reached");
    assert_non_null(strstr(r.out, "3 of 3 sensors are not within 0.01 % yet"));
    csv_read(path_in(folder, "out/floor-1.csv"), c);
    assert_int_equal(c->count, 3);
    assert_false(c->partial);
    csv_read(path_in(folder, "out/probes.csv"), c);
    assert_int_equal(c->count, 2);
    LUX4(folder, 3, &r, "grid", "study.yaml", "--time", "0.2", "--accuracy", "0.01%", "--json");
    assert_true(json_is_valid(r.out));
    assert_true(json_number_at(r.out, "grids.0.sensors_missed") > 0.0);
    LUX4(folder, 0, &r, "grid", "study.yaml", "--time", "1000", "--accuracy", "50%");
    free(c);
    program_free(&r);
    folder_free(folder);
}

TEST(a_quiet_run_is_silent_on_stderr)
{
    /* A lamp outside the room is worth a warning */
    char *folder     = folder_of_study("lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: 0.5}\n"
                                           "lights: [{type: point, at: [9, 9, 9], intensity: 1}]\n"
                                           "grids: [{name: g, on: room, height: 1, spacing: 1}]\n");
    program_result r = { 0 };
    LUX4(folder, 0, &r, "grid", "study.yaml");
    assert_memory_equal(r.err, "lux4: warning: ", 15);
    LUX4(folder, 0, &r, "grid", "study.yaml", "--quiet");
    assert_string_equal(r.err, "");
    assert_non_null(strstr(r.out, "average/lx")); /* results are not noise */
    program_free(&r);
    folder_free(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_csv_has_a_row_for_each_sensor),
        cmocka_unit_test(an_exr_holds_what_the_csv_holds),
        cmocka_unit_test(an_exr_names_the_variant_that_it_is_of),
        cmocka_unit_test(the_table_says_what_is_met_and_where_files_lie),
        cmocka_unit_test(json_has_what_the_contract_names),
        cmocka_unit_test(results_of_others_are_not_replaced_unasked),
        cmocka_unit_test(direct_only_leaves_interreflection_out),
        cmocka_unit_test(a_seed_decides_the_samples_and_threads_do_not),
        cmocka_unit_test(without_time_the_first_results_are_written_whole),
        cmocka_unit_test(a_quiet_run_is_silent_on_stderr),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
