/* tests/cli/test_schedule.c -- lux4 grid --schedule: figures worked out by hand. */
#include "tests/box_gltf.h"
#include "tests/folder.h"
#include "tests/program.h"
#include "tests/test.h"

#include <stdlib.h>
#include <string.h>

/* 100 cd all around, 400 pi lm, from a point, by 25 W. */
static const char lamp[]        = "IESNA:LM-63-2002\n[TEST] 1\n[TESTLAB] x\n[ISSUEDATE] x\n"
                                  "[MANUFAC] Maker\n[LUMCAT] L-1\nTILT=NONE\n"
                                  "1 -1 1 2 1 1 2 0 0 0\n1 1 25\n0 180\n0\n100 100\n";
static const double lamp_lumens = 400.0 * M_PI, lamp_watts = 25.0;

/* Of a plane of 4 m by 2 m, whose cells are 1 m, and of things that have no load. */
#define GRIDS                                                                                      \
    "grids:\n  - {name: work, origin: [0, 0, 0.5], u: [4, 0, 0], v: [0, 2, 0], spacing: 1}\n"      \
    "  - {name: wall, origin: [4, 0.5, 0.5], u: [-4, 0, 0], v: [0, 0, 1], spacing: 1}\n"           \
    "  - {name: round, origin: [0, 0, 1], u: [4, 0, 0], v: [0, 3, 0], spacing: 2, "                \
    "quantity: cylindrical}\n"
#define LAMPS                                                                                      \
    "luminaires:\n"                                                                                \
    "  - {name: pair, photometry: lamp.ies, at: [[1, 1, 2], [3, 2, 2]], dimming: 0.5, group: a}\n" \
    "  - {photometry: lamp.ies, at: [2, 1.5, 2], lumens: 1000, watts: 20}\n"                       \
    "lights:\n  - {name: bulb, type: point, at: [2, 1, 2], lumens: 200, group: b}\n"               \
    "  - {type: parallel, aim: [0, 0, -1], illuminance: 3}\n"
#define ROOM "lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: 0}\nmaintenance: 0.8\n"

static const double bulb_lumens = 200.0, floor_area = 12.0;

static char *folder_of(const char *text)
{
    char *folder = folder_of_study(text);
    folder_write(folder, "lamp.ies", lamp);
    return folder;
}

static void assert_text_at(const char *json, const char *path, const char *want)
{
    const char *at = json_at(json, path);
    if (!at || strncmp(at, want, strlen(want)) != 0)
        fail_msg("%s is %.40s, not %s", path, at ? at : "missing", want);
}

static void run_json(const char *folder, program_result *r)
{
    LUX4(folder, 0, r, "grid", "study.yaml", "--json", "--schedule", "--overwrite");
    if (!json_is_valid(r->out))
        fail_msg("no JSON: %s", r->out);
}

/* ---- rows and totals ------------------------------------------------------------------------- */

static void assert_rows(const char *json)
{
    assert_text_at(json, "schedule.rows.0.name", "\"pair\"");
    assert_text_at(json, "schedule.rows.0.manufacturer", "\"Maker\"");
    assert_text_at(json, "schedule.rows.0.catalog", "\"L-1\"");
    assert_near(json_number_at(json, "schedule.rows.0.count"), 2.0, 0.0);
    assert_near(json_number_at(json, "schedule.rows.0.lumens_each"), lamp_lumens, 1e-6);
    assert_near(json_number_at(json, "schedule.rows.0.watts_each"), lamp_watts, 0.0);
    assert_near(json_number_at(json, "schedule.rows.0.efficacy_lm_w"), lamp_lumens / 25.0, 1e-6);
    assert_near(json_number_at(json, "schedule.rows.0.dimming"), 0.5, 0.0);
    assert_near(json_number_at(json, "schedule.rows.0.lumens"), 2.0 * lamp_lumens, 1e-6);
    assert_near(json_number_at(json, "schedule.rows.0.watts"), 50.0, 0.0);
    assert_text_at(json, "schedule.rows.1.name", "\"lamp.ies\"");
    assert_near(json_number_at(json, "schedule.rows.1.lumens_each"), 1000.0, 1e-6);
    assert_near(json_number_at(json, "schedule.rows.1.efficacy_lm_w"), 50.0, 1e-6);
    assert_text_at(json, "schedule.rows.2.name", "\"bulb\"");
    assert_near(json_number_at(json, "schedule.rows.2.lumens"), bulb_lumens, 1e-6);
    assert_text_at(json, "schedule.rows.2.watts_each", "null");
    assert_text_at(json, "schedule.rows.2.efficacy_lm_w", "null");
    assert_text_at(json, "schedule.rows.3.name", "\"parallel\"");
    assert_text_at(json, "schedule.rows.3.lumens_each", "null");
    assert_null(json_at(json, "schedule.rows.4"));
}

static void assert_totals(const char *json)
{
    double rated = 2.0 * lamp_lumens + 1000.0;
    assert_near(json_number_at(json, "schedule.count"), 4.0, 0.0);
    assert_near(json_number_at(json, "schedule.without_watts"), 1.0, 0.0);
    assert_near(json_number_at(json, "schedule.lumens"), rated + bulb_lumens, 1e-6);
    assert_near(json_number_at(json, "schedule.watts"), 70.0, 1e-9);
    assert_near(json_number_at(json, "schedule.efficacy_lm_w"), rated / 70.0, 1e-6);
    assert_near(json_number_at(json, "schedule.dimmed_lumens"), lamp_lumens + 1200.0, 1e-6);
    assert_near(json_number_at(json, "schedule.dimmed_watts"), 45.0, 1e-9);
}

TEST(rows_and_totals_are_those_of_the_study)
{
    char *folder     = folder_of(ROOM LAMPS GRIDS);
    program_result r = { 0 };
    run_json(folder, &r);
    assert_rows(r.out);
    assert_totals(r.out);
    assert_string_equal(r.err, ""); /* scaled, but with watts of its own */
    program_free(&r);
    folder_free(folder);
}

TEST(lm_per_W_is_that_of_lamps_with_watts)
{
    char *folder     = folder_of(ROOM "luminaires: [{photometry: bare.ies, at: [1, 1, 2]}, "
                                          "{photometry: lamp.ies, at: [1, 2, 2]}]\n" GRIDS);
    program_result r = { 0 };
    char *bare       = strdup(lamp);
    memcpy(strstr(bare, "1 1 25"), "1 1 0 ", 6);
    folder_write(folder, "bare.ies", bare);
    run_json(folder, &r);
    assert_text_at(r.out, "schedule.rows.0.watts_each", "null");
    assert_near(json_number_at(r.out, "schedule.lumens"), 2.0 * lamp_lumens, 1e-6);
    assert_near(json_number_at(r.out, "schedule.efficacy_lm_w"), lamp_lumens / 25.0, 1e-6);
    free(bare);
    program_free(&r);
    folder_free(folder);
}

TEST(layers_of_groups_change_nothing)
{
    char *folder     = folder_of(ROOM LAMPS GRIDS);
    program_result r = { 0 };
    LUX4(folder, 0, &r, "grid", "study.yaml", "--json", "--schedule", "--groups");
    assert_rows(r.out);
    assert_totals(r.out);
    program_free(&r);
    folder_free(folder);
}

TEST(without_being_asked_for_there_is_none)
{
    char *folder     = folder_of(ROOM LAMPS GRIDS);
    program_result r = { 0 };
    LUX4(folder, 0, &r, "grid", "study.yaml", "--json");
    assert_null(json_at(r.out, "schedule"));
    LUX4_FAILS(folder, 2, "--schedule has no meaning", "check", "study.yaml", "--schedule");
    program_free(&r);
    folder_free(folder);
}

/* ---- loads ----------------------------------------------------------------------------------- */

/* lx at the middle of a cell, maintained, by all of LAMPS: I h / d^3 and the beam. */
static double work_average(void)
{
    static const struct {
        double x, y, cd;
    } all[]    = { { 1, 1, 50 }, { 3, 2, 50 }, { 2, 1.5, 250 / M_PI }, { 2, 1, 50 / M_PI } };
    double sum = 0.0, h = 1.5;
    for (int k = 0; k < 8; k++)
        for (int i = 0; i < 4; i++) {
            double x = k % 4 + 0.5 - all[i].x, y = k / 4 + 0.5 - all[i].y;
            sum += all[i].cd * h / pow(x * x + y * y + h * h, 1.5);
        }
    return sum / 8.0;
}

TEST(a_load_is_related_to_the_floor_of_the_room)
{
    char *folder     = folder_of(ROOM LAMPS GRIDS);
    program_result r = { 0 };
    run_json(folder, &r);
    double e = 0.8 * work_average(); /* the beam comes from beyond the ceiling */
    assert_near(json_number_at(r.out, "grids.0.average_lx"), e, 1e-5);
    assert_near(json_number_at(r.out, "schedule.area_m2"), floor_area, 1e-9);
    assert_near(json_number_at(r.out, "schedule.power_density_w_m2"), 70.0 / 12.0, 1e-8);
    assert_text_at(r.out, "schedule.grids.0.name", "\"work\"");
    assert_near(json_number_at(r.out, "schedule.grids.0.area_m2"), floor_area, 1e-9);
    assert_near(json_number_at(r.out, "schedule.grids.0.w_m2_per_100lx"), 70.0 / 12.0 / (e / 100.0),
                1e-5);
    assert_near(json_number_at(r.out, "schedule.grids.0.dimmed_w_m2_per_100lx"),
                45.0 / 12.0 / (e / 100.0), 1e-5);
    assert_null(json_at(r.out, "schedule.grids.1")); /* a wall and a cylinder have none */
    program_free(&r);
    folder_free(folder);
}

TEST(without_a_room_a_load_is_related_to_the_grid)
{
    char *folder     = folder_of("lux4: 1\nluminaires: [{photometry: lamp.ies, at: [1, 1, 2]}]\n"
                                     "grids: [{name: g, origin: [0, 0, 0], u: [2, 0, 0], v: [0, 2, 0], "
                                     "spacing: 2}]\n");
    program_result r = { 0 };
    run_json(folder, &r);
    assert_text_at(r.out, "schedule.area_m2", "null");
    assert_text_at(r.out, "schedule.power_density_w_m2", "null");
    assert_near(json_number_at(r.out, "schedule.grids.0.area_m2"), 4.0, 1e-9);
    assert_near(json_number_at(r.out, "schedule.grids.0.w_m2_per_100lx"), /* 100 cd from 2 m */
                25.0 / 4.0 / 0.25, 1e-6);
    LUX4(folder, 0, &r, "grid", "study.yaml", "--schedule");
    assert_non_null(strstr(r.out, "connected load 25.0 W, on each grid's own area"));
    program_free(&r);
    folder_free(folder);
}

TEST(a_model_in_place_of_a_room_has_its_box)
{
    char *folder     = folder_of("lux4: 1\nscene: hall.gltf\n"
                                     "luminaires: [{photometry: lamp.ies, at: [1, 1, 2]}]\n"
                                     "grids: [{name: g, origin: [0.5, 0.5, 0], u: [1, 0, 0], v: [0, 1, 0], "
                                     "spacing: 1}]\n");
    program_result r = { 0 };
    box_gltf_write(folder, "hall.gltf", (double[]){ 0, 0, -0.5 }, (double[]){ 5, 4, -0.1 }, 0.0);
    run_json(folder, &r);
    assert_near(json_number_at(r.out, "schedule.area_m2"), 20.0, 1e-6);
    assert_near(json_number_at(r.out, "schedule.power_density_w_m2"), 25.0 / 20.0, 1e-6);
    program_free(&r);
    folder_free(folder);
}

/* ---- the table ------------------------------------------------------------------------------- */

TEST(the_table_says_what_is_left_out)
{
    char *folder     = folder_of(ROOM LAMPS GRIDS);
    program_result r = { 0 };
    LUX4(folder, 0, &r, "grid", "study.yaml", "--schedule");
    assert_non_null(strstr(r.out, "Maker, L-1\n"));
    assert_non_null(strstr(r.out, "1 of 4 luminaires without watts: left out"));
    assert_non_null(strstr(r.out, "connected load 70.0 W, on the room's floor of 12.00 m2: 5.83"));
    assert_non_null(strstr(r.out, "\nas dimmed "));
    assert_null(strstr(r.out, " nan"));
    assert_null(strstr(r.out, " inf"));
    program_free(&r);
    folder_free(folder);
}

TEST(without_any_watts_nothing_is_made_up)
{
    char *folder = folder_of(ROOM "lights: [{type: point, at: [2, 1, 2], lumens: 200}]\n" GRIDS);
    program_result r = { 0 };
    run_json(folder, &r);
    assert_text_at(r.out, "schedule.watts", "null");
    assert_text_at(r.out, "schedule.efficacy_lm_w", "null");
    assert_text_at(r.out, "schedule.power_density_w_m2", "null");
    assert_text_at(r.out, "schedule.grids.0.w_m2_per_100lx", "null");
    LUX4(folder, 0, &r, "grid", "study.yaml", "--schedule");
    assert_non_null(strstr(r.out, "1 of 1 luminaire without watts"));
    assert_null(strstr(r.out, "W/m2"));
    assert_null(strstr(r.out, " nan"));
    program_free(&r);
    folder_free(folder);
}

TEST(watts_that_do_not_follow_scaled_light_are_told)
{
    char *folder = folder_of(ROOM "luminaires: [{name: big, photometry: lamp.ies, at: [2, 1, 2], "
                                  "lumens: 5000}]\n" GRIDS);
    program_result r = { 0 };
    LUX4(folder, 0, &r, "grid", "study.yaml", "--schedule");
    assert_non_null(strstr(r.err, "study.yaml:4:14: the light of big is scaled, its 25 W are not"));
    LUX4(folder, 0, &r, "grid", "study.yaml");
    assert_string_equal(r.err, "");
    program_free(&r);
    folder_free(folder);
}

/* Three nodes: two carry one light, whose rows are joined though another stands between. */
TEST(equal_gltf_lights_share_a_row)
{
    char *folder     = folder_of("lux4: 1\nscene: s.gltf\ngrids: [{name: g, origin: [0, 0, 0], "
                                     "u: [2, 0, 0], v: [0, 2, 0], spacing: 2}]\n");
    program_result r = { 0 };
    folder_write(
        folder, "s.gltf",
        "{\"asset\":{\"version\":\"2.0\"},\"extensionsUsed\":[\"KHR_lights_punctual\"],"
        "\"extensions\":{\"KHR_lights_punctual\":{\"lights\":["
        "{\"type\":\"point\",\"name\":\"a\\u001bb\",\"intensity\":10},"
        "{\"type\":\"point\",\"name\":\"c\",\"intensity\":20}]}},"
        "\"scene\":0,\"scenes\":[{\"nodes\":[0,1,2]}],\"nodes\":["
        "{\"translation\":[0,2,0],\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}},"
        "{\"translation\":[1,2,0],\"extensions\":{\"KHR_lights_punctual\":{\"light\":1}}},"
        "{\"translation\":[2,2,0],\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}}]}");
    run_json(folder, &r);
    assert_near(json_number_at(r.out, "schedule.rows.0.count"), 2.0, 0.0);
    assert_near(json_number_at(r.out, "schedule.rows.0.lumens"), 80.0 * M_PI, 1e-6);
    assert_text_at(r.out, "schedule.rows.1.name", "\"c\"");
    assert_null(json_at(r.out, "schedule.rows.2"));
    LUX4(folder, 0, &r, "grid", "study.yaml", "--schedule");
    assert_non_null(strstr(r.out, "a?b")); /* what it is called cannot steer a terminal */
    assert_null(strchr(r.out, '\033'));
    program_free(&r);
    folder_free(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_and_totals_are_those_of_the_study),
        cmocka_unit_test(lm_per_W_is_that_of_lamps_with_watts),
        cmocka_unit_test(layers_of_groups_change_nothing),
        cmocka_unit_test(without_being_asked_for_there_is_none),
        cmocka_unit_test(a_load_is_related_to_the_floor_of_the_room),
        cmocka_unit_test(without_a_room_a_load_is_related_to_the_grid),
        cmocka_unit_test(a_model_in_place_of_a_room_has_its_box),
        cmocka_unit_test(the_table_says_what_is_left_out),
        cmocka_unit_test(without_any_watts_nothing_is_made_up),
        cmocka_unit_test(watts_that_do_not_follow_scaled_light_are_told),
        cmocka_unit_test(equal_gltf_lights_share_a_row),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
