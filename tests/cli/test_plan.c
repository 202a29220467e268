/* tests/cli/test_plan.c -- lux4 plan, and how --no, --only and --transport rule other commands. */
#include "sim/effects.h"
#include "tests/folder.h"
#include "tests/lab_sphere.h"
#include "tests/program.h"
#include "tests/test.h"

#include <stdio.h>
#include <string.h>

static const char room[] =
    "lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: 0.3}\naccuracy: 20%\n"
    "lights: [{type: disk, at: [2, 1.5, 2], radius: 0.1, lumens: 1000}]\n"
    "sky: {model: overcast, horizontal: 5000}\n"
    "grids: [{name: g, on: room, height: 0.75, spacing: 1}]\n"
    "views: [{name: v, eye: [0.5, 0.5, 1.5], target: [4, 3, 1], fov: 60, size: [8, 6]}]\n";

static const char *member(const char *json, effect e, const char *what)
{
    static char path[80];
    snprintf(path, sizeof path, "effects.%d.%s", (int)e, what);
    const char *found = json_at(json, path);
    if (!found)
        fail_msg("no %s in %s", path, json);
    return found;
}

static bool is_true(const char *json, effect e, const char *what)
{
    return !strncmp(member(json, e, what), "true", 4);
}

TEST(a_plan_is_a_table_with_reasons_and_closing_lines)
{
    char *folder     = folder_of_study(room);
    program_result r = { 0 };
    LUX4(folder, 0, &r, "plan", "study.yaml");
    for (int e = 0; e < EFFECTS; e++)
        assert_non_null(strstr(r.out, effect_name((effect)e)));
    assert_non_null(strstr(r.out, "the room has no opening, and all sensors are within"));
    assert_non_null(strstr(r.out, "1 of 1 lamp is more than a point"));
    assert_non_null(strstr(r.out, "bounds: all that is off changes results by at most 0 %; 4 % is "
                                  "allowed, a fifth of the accuracy asked for (20 %)"));
    assert_non_null(strstr(r.out, "transport: path: paths reach 20 % after about "));
    assert_non_null(strstr(r.out, "antialiasing of views: on: 32 rays all over each pixel"));
    assert_non_null(strstr(r.out, "transport of views: path: paths reach 10 % after about "));
    assert_int_equal(count_names(folder), 1);
    program_free(&r);
    folder_free(folder);
}

TEST(a_plan_as_json_has_all_effects_in_their_order)
{
    char *folder     = folder_of_study(room);
    program_result r = { 0 };
    LUX4(folder, 0, &r, "plan", "study.yaml", "--json", "--accuracy", "5%");
    assert_true(json_is_valid(r.out));
    for (int e = 0; e < EFFECTS; e++) {
        const char *name = effect_name((effect)e);
        assert_int_equal(strncmp(member(r.out, (effect)e, "name") + 1, name, strlen(name)), 0);
        assert_true(strlen(member(r.out, (effect)e, "why")) > 2);
    }
    assert_true(is_true(r.out, EFFECT_INTERREFLECTION, "on"));
    assert_false(is_true(r.out, EFFECT_SKY, "on"));
    assert_near(json_number_at(r.out, "accuracy_percent"), 5.0, 1e-9);
    assert_near(json_number_at(r.out, "effects.5.bound_percent"), 0.0, 0.0);
    assert_int_equal(strncmp(json_at(r.out, "transport"), "\"path\"", 6), 0);
    program_free(&r);
    folder_free(folder);
}

TEST(what_is_forced_off_is_told_of)
{
    char *folder     = folder_of_study(room);
    program_result r = { 0 };
    LUX4(folder, 0, &r, "plan", "study.yaml", "--json", "--no", "sky,area-lights", "--no=color");
    assert_non_null(strstr(r.err, "the study calls for it: area-lights: results change"));
    assert_true(is_true(r.out, EFFECT_AREA_LIGHTS, "missed"));
    assert_false(is_true(r.out, EFFECT_SKY, "missed"));
    LUX4(folder, 0, &r, "grid", "study.yaml", "--json", "--no", "interreflection");
    assert_non_null(strstr(r.err, "the study calls for it: interreflection: results change"));
    assert_null(strstr(r.out, "\"interreflection\""));
    LUX4(folder, 0, &r, "render", "study.yaml", "--only", "interreflection,antialiasing");
    assert_non_null(strstr(r.err, "calls for it: area-lights: results change"));
    LUX4(folder, 0, &r, "plan", "study.yaml", "--direct-only");
    assert_null(strstr(r.err, "results change"));
    program_free(&r);
    folder_free(folder);
}

TEST(all_forced_on_is_no_warning_and_the_same_within_intervals)
{
    char *folder       = folder_of_study(room);
    program_result one = { 0 }, all = { 0 };
    LUX4(folder, 0, &one, "grid", "study.yaml", "--json");
    LUX4(folder, 0, &all, "grid", "study.yaml", "--json", "--only", "all", "--overwrite");
    assert_null(strstr(all.err, "results change"));
    for (int e = 0; e < EFFECTS; e++)
        assert_non_null(strstr(all.out, effect_name((effect)e)));
    assert_null(strstr(one.out, "\"sky\""));
    double a = json_number_at(one.out, "grids.0.average_lx");
    double b = json_number_at(all.out, "grids.0.average_lx");
    assert_near(a, b, 0.2); /* each sensor is within 20 %, their average better */
    program_free(&one);
    program_free(&all);
    folder_free(folder);
}

TEST(words_that_are_no_effect_or_transport_are_refused)
{
    LUX4_FAILS(NULL, 2, "`moon` is no effect (lux4 plan lists them)", "plan", "none.yaml", "--no",
               "sun,moon");
    LUX4_FAILS(NULL, 2, "`` is no effect", "grid", "none.yaml", "--no", "sun,");
    LUX4_FAILS(NULL, 2, "`all` is no effect", "grid", "none.yaml", "--no", "all");
    LUX4_FAILS(NULL, 2, "expected path, maps or auto", "grid", "none.yaml", "--transport", "rays");
    LUX4_FAILS(NULL, 2, "which study?", "plan");
    LUX4_FAILS(NULL, 2, "none.yaml", "plan", "none.yaml");
}

/* In a room with a window, which is dark at night; three moments of one day. */
TEST(a_series_is_planned_for_as_a_whole)
{
    char *folder = folder_of_study(
        "lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: 0.3, windows: [{wall: south, at: [1, 1], "
        "size: [2, 1]}]}\naccuracy: 30%\nsite: {place: \"50N 0E\", zone: \"+00:00\"}\n"
        "when: {date: 2026-03-21, from: \"04:00\", to: \"12:00\", step: 240}\n"
        "sky: {model: clear}\ngrids: [{name: g, on: room, height: 0.75, spacing: 1}]\n");
    program_result r = { 0 };
    LUX4(folder, 0, &r, "plan", "study.yaml");
    assert_non_null(strstr(r.out, "it shines at 2 of 3 moments"));
    assert_non_null(strstr(r.out, "all moments of a series are weighed from the same paths"));
    LUX4(folder, 0, &r, "daylight", "study.yaml", "--no", "sky,sun");
    assert_non_null(strstr(r.err, "calls for it: sun, sky"));
    assert_non_null(strstr(r.err, "no daylight arrives at any time"));
    program_free(&r);
    folder_free(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_plan_is_a_table_with_reasons_and_closing_lines),
        cmocka_unit_test(a_plan_as_json_has_all_effects_in_their_order),
        cmocka_unit_test(what_is_forced_off_is_told_of),
        cmocka_unit_test(all_forced_on_is_no_warning_and_the_same_within_intervals),
        cmocka_unit_test(words_that_are_no_effect_or_transport_are_refused),
        cmocka_unit_test(a_series_is_planned_for_as_a_whole),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
