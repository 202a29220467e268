/* tests/cli/test_cost.c -- lux4 cost: its table, its JSON, its files. Times are never tested. */
#include "tests/folder.h"
#include "tests/program.h"
#include "tests/test.h"

#include <stdlib.h>
#include <string.h>

static const char room[] =
    "lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: 0.5}\n"
    "lights: [{type: point, at: [1.75, 1.5, 2.25], intensity: 100}]\n"
    "grids: [{name: floor, origin: [0.25, 1, 0.25], u: [3, 0, 0], v: [0, 1, 0], spacing: 1}]\n"
    "accuracy: 10%\n";
static const char view[] =
    "lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: 0.5}\n"
    "lights: [{type: point, at: [1.75, 1.5, 2.25], intensity: 100}]\n"
    "views: [{name: hall, eye: [0.5, 0.5, 1.2], target: [3, 2, 1], size: [32, 24]}]\n";

/* On a slow machine the time may be out before the study's accuracy is reached, exit code 3:
 * results are there all the same. */
static void run_cost(const program_desc *d, program_result *r)
{
    program_free(r);
    program_run(d, r);
    if (r->code != 0 && r->code != 3)
        fail_msg("lux4 cost exits with %d: %s", r->code, r->err);
}
#define LUX4_COST(folder_, r_, ...)                                                                \
    run_cost(&(program_desc){ .folder = (folder_), .words = { "cost", __VA_ARGS__ } }, r_)

TEST(a_room_gets_a_table_and_files)
{
    char *folder     = folder_of_study(room);
    program_result r = { 0 };
    LUX4_COST(folder, &r, "study.yaml", "--time", "10");
    assert_non_null(strstr(r.out, "grid floor, accuracy 10 %"));
    assert_non_null(strstr(r.out, "--accuracy 20%"));
    assert_non_null(strstr(r.out, "bounces unlimited"));
    assert_non_null(strstr(r.out, "the cheapest setting that meets 10 %"));
    size_t size;
    char *text = bytes_of(path_in(folder, "out/cost.csv"), &size);
    assert_non_null(strstr(text, "ladder,setting,seconds,rays,rms_percent"));
    assert_non_null(strstr(text, "\nbounces,bounces 1,"));
    assert_true(there_is(folder, "out/cost.svg"));
    free(text);
    program_free(&r);
    folder_free(folder);
}

TEST(json_has_rows_and_advice)
{
    char *folder     = folder_of_study(room);
    program_result r = { 0 };
    LUX4_COST(folder, &r, "study.yaml", "--time", "2", "--json");
    assert_true(json_is_valid(r.out));
    assert_non_null(json_at(r.out, "rows.0.setting"));
    assert_true(json_number_at(r.out, "rows.0.rays") > 0.0);
    assert_true(json_number_at(r.out, "rows.0.rms_percent") >= 0.0);
    assert_non_null(json_at(r.out, "rows.0.half_width_percent"));
    assert_non_null(json_at(r.out, "advice"));
    program_free(&r);
    folder_free(folder);
}

TEST(the_same_study_replaces_its_own_results_and_no_others)
{
    char *folder     = folder_of_study(room);
    program_result r = { 0 };
    LUX4_COST(folder, &r, "study.yaml", "--time", "1");
    LUX4_COST(folder, &r, "study.yaml", "--time", "1");
    folder_write(folder, "other.yaml", room);
    LUX4_FAILS(folder, 2, "is there already", "cost", "other.yaml", "--time", "1");
    program_free(&r);
    folder_free(folder);
}

TEST(a_study_of_views_is_run_by_rays_a_pixel_too)
{
    char *folder     = folder_of_study(view);
    program_result r = { 0 };
    LUX4_COST(folder, &r, "study.yaml", "--time", "5", "--accuracy", "50%");
    assert_non_null(strstr(r.out, "view hall"));
    assert_non_null(strstr(r.out, "1 ray a pixel"));
    assert_non_null(strstr(r.out, "25 rays a pixel"));
    program_free(&r);
    folder_free(folder);
}

/* Where it is when it is interrupted hangs on the machine: before the reference there is nothing to
 * write, then there is what has been run. */
TEST(an_interrupted_run_writes_all_or_nothing)
{
    char *folder     = folder_of_study(room);
    program_result r = { 0 };
    program_expect(130,
                   &(program_desc){ .folder = folder,
                                    .until  = path_in(folder, "out"),
                                    .then_s = 0.7,
                                    .words  = { "cost", "study.yaml", "--accuracy", "1%" } },
                   &r);
    assert_one_line(&r, "interrupted");
    int written = count_names(path_in(folder, "out"));
    assert_true(written == 0 || written == 2);
    if (written) {
        size_t size;
        char *text = bytes_of(path_in(folder, "out/cost.csv"), &size);
        assert_non_null(strstr(text, "\n# partial: "));
        assert_true(there_is(folder, "out/cost.svg"));
        free(text);
    }
    program_free(&r);
    folder_free(folder);
}

TEST(files_that_grow_too_large_are_not_left_in_part)
{
    char *folder     = folder_of_study(room);
    program_result r = { 0 };
    program_expect(1,
                   &(program_desc){ .folder          = folder,
                                    .out             = "/dev/null", /* or it is too large itself */
                                    .most_file_bytes = 64,
                                    .words = { "cost", "study.yaml", "--time=1", "--quiet" } },
                   &r);
    assert_one_line(&r, "out/cost.csv: cannot write");
    assert_int_equal(count_names(path_in(folder, "out")), 0);
    program_free(&r);
    folder_free(folder);
}

TEST(a_study_with_nothing_to_run_is_refused)
{
    char *folder = folder_of_study("lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: 0.5}\n");
    LUX4_FAILS(folder, 2, "neither `grids` nor `views`", "cost", "study.yaml");
    folder_free(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_room_gets_a_table_and_files),
        cmocka_unit_test(json_has_rows_and_advice),
        cmocka_unit_test(the_same_study_replaces_its_own_results_and_no_others),
        cmocka_unit_test(a_study_of_views_is_run_by_rays_a_pixel_too),
        cmocka_unit_test(an_interrupted_run_writes_all_or_nothing),
        cmocka_unit_test(files_that_grow_too_large_are_not_left_in_part),
        cmocka_unit_test(a_study_with_nothing_to_run_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
