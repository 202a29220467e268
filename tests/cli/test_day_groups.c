/* tests/cli/test_day_groups.c -- sun and sky as groups: layers, mixtures, and what maintenance
 * leaves alone; and where and when results say they are of. */
#include "core/image.h"
#include "tests/folder.h"
#include "tests/gltf_text.h"
#include "tests/program.h"
#include "tests/test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_ROWS = 16, LAYERS = 3 };

/* Relative: float roundings of a layer, of their sum, of the mixture. */
static const double rounding = 8 * 0x1p-24;

/* The sun shines in; the hole has no pane, so that no light is left to chance. */
static const char room[] =
    "lux4: 1\n"
    "room: {size: [4, 3, 2.5], reflectance: 0.5, windows: [{wall: south, at: [1, 0.8], size: [2, "
    "1.2]}]}\n"
    "site: {place: 52N 13E, altitude: 34, zone: Europe/Berlin}\n"
    "when: 2026-06-21T12:30\n"
    "sky: {model: clear}\n"
    "maintenance: 0.8\n"
    "lights: [{type: disk, at: [2, 2, 2.4], radius: 0.2, lumens: 50000, group: lamp, dimming: "
    "0.5}]\n"
    "grids: [{name: plane, on: room, height: 0.7, spacing: 1}]\n"
    "views: [{name: view, eye: [0.3, 2.7, 1.5], target: [2, 0, 1.2], fov: 80, size: [16, 12]}]\n"
    "variants:\n"
    "  dimmed: {sky: {horizontal: 5000, sun_illuminance: 0.001}, dimming: {lamp: 0}}\n"
    "  full: {sky: {horizontal: 10000, sun_illuminance: 0.001}, dimming: {lamp: 0}}\n"
    "  nowhere: {site: ~, when: ~, sky: ~}\n"
    "  by-hand: {site: ~, when: ~, sky: {sun_at: {azimuth: 180, elevation: 50}}}\n"
    "  unlit: {when: {date: 2026-12-21, from: \"06:00\"}, lights: ~}\n"
    "  series: {when: {date: 2026-12-21, from: \"11:00\", to: \"12:00\"}}\n";

static char *folder;
static arena memory;

static int begin(void **state)
{
    (void)state;
    folder = folder_of_study(room);
    return 0;
}

static int end(void **state)
{
    (void)state;
    folder_free(folder);
    arena_clear(&memory);
    return 0;
}

static void run(const char *command, const char *variant, const char *to, const char *more)
{
    program_result r = { 0 };
    if (variant)
        LUX4(folder, 0, &r, command, "study.yaml", "--accuracy", "20%", "-o", to, more, "--variant",
             variant, "--overwrite");
    else
        LUX4(folder, 0, &r, command, "study.yaml", "--accuracy", "20%", "-o", to, more,
             "--overwrite");
    program_free(&r);
}

/* A column of a table by its name; how many rows it has. */
static int column(const char *path, const char *name, double out[MOST_ROWS])
{
    size_t size;
    char *text = bytes_of(path_in(folder, path), &size), *line_end, *line;
    int which = -1, at = 0, rows = 0;
    for (char *word = strtok_r(text, "\n", &line_end), *rest, *cell = strtok_r(word, ",", &rest);
         cell; cell = strtok_r(NULL, ",", &rest), at++)
        which = strcmp(cell, name) ? which : at;
    assert_true(which >= 0);
    while ((line = strtok_r(NULL, "\n", &line_end)) && rows < MOST_ROWS) {
        for (int c = 0; c < which; c++)
            line = strchr(line, ',') + 1;
        out[rows++] = strtod(line, NULL);
    }
    free(text);
    return rows;
}

static image part_of(const char *path, int part)
{
    image im;
    lux_error err = { 0 };
    if (!image_read_exr_part(path_in(folder, path), part, &memory, &im, &err))
        fail_msg("%s", err.text);
    return im;
}

static const float *channel(const image *im, const char *name)
{
    for (int c = 0; c < im->channel_count; c++)
        if (!strcmp(im->channels[c].name, name))
            return im->channels[c].values;
    fail_msg("no channel %s", name);
    return NULL;
}

/* ---- layers ---------------------------------------------------------------------------------- */

static const char *const layers[LAYERS] = { "sun", "sky", "lamp" };

static void assert_sums(const image *im, const char *name, const double factors[LAYERS])
{
    const float *whole = channel(im, name);
    for (int i = 0; i < im->width * im->height; i++) {
        double sum = 0.0;
        for (int l = 0; l < LAYERS; l++)
            sum += factors[l] *
                   (double)channel(im, text_of(&memory, "group.%s.%s", layers[l], name))[i];
        assert_near(whole[i], sum, rounding);
    }
}

TEST(sun_and_sky_are_layers_as_lamps_are)
{
    static const double dimmed[LAYERS] = { 1, 1, 0.5 };
    double all[MOST_ROWS], own[LAYERS][MOST_ROWS];
    run("grid", NULL, "day", "--groups");
    run("render", NULL, "day", "--groups");
    int rows = column("day/plane.csv", "illuminance_lx", all), lit = 0;
    assert_int_equal(rows, 12);
    for (int l = 0; l < LAYERS; l++)
        assert_int_equal(column("day/plane.csv", text_of(&memory, "%s_lx", layers[l]), own[l]),
                         rows);
    for (int k = 0; k < rows; k++) {
        assert_true(own[0][k] > 0.0 && own[1][k] > 0.0 && own[2][k] > 0.0);
        assert_near(all[k], own[0][k] + own[1][k] + 0.5 * own[2][k], rounding);
        lit += own[0][k] > 10000.0;
    }
    assert_in_range(lit, 1, 4); /* the sun, 61 degrees high, reaches 1 m into the room */
    image plane = part_of("day/plane.exr", 0), view = part_of("day/view.exr", 0);
    assert_sums(&plane, "Y", dimmed);
    assert_sums(&plane, "direct.Y", dimmed);
    assert_sums(&view, "R", dimmed);
    assert_sums(&view, "illuminance.Y", dimmed);
}

TEST(daylight_is_mixed_afterwards)
{
    program_result r = { 0 };
    double mixed[MOST_ROWS], own[LAYERS][MOST_ROWS];
    run("grid", NULL, "mix", "--groups");
    LUX4(folder, 0, &r, "mix", "mix/plane.csv", "sky=0.5", "sun=0", "lamp=2", "-o", "mix/m.csv");
    LUX4(folder, 0, &r, "mix", "mix/plane.exr", "sky=0.5", "sun=0", "lamp=2", "-o", "mix/m.exr");
    int rows = column("mix/m.csv", "illuminance_lx", mixed);
    for (int l = 0; l < LAYERS; l++)
        column("mix/plane.csv", text_of(&memory, "%s_lx", layers[l]), own[l]);
    image m = part_of("mix/m.exr", 0);
    for (int k = 0; k < rows; k++) {
        double want = 0.5 * own[1][k] + 2.0 * own[2][k];
        assert_near(mixed[k], want, rounding);
        assert_near(channel(&m, "Y")[(2 - k / 4) * 4 + k % 4], want, rounding);
    }
    program_free(&r);
}

TEST(half_of_a_sky_is_a_sky_of_half_the_lux)
{
    double full[MOST_ROWS], half[MOST_ROWS], all[MOST_ROWS], near[2][MOST_ROWS];
    run("grid", "full", "full", "--groups");
    run("grid", "dimmed", "half", "--quiet");
    int rows = column("full/plane.csv", "sky_lx", full), off = 0;
    column("full/plane.csv", "illuminance_lx", all);
    column("full/plane.csv", "half_width_lx", near[0]);
    column("half/plane.csv", "illuminance_lx", half);
    column("half/plane.csv", "half_width_lx", near[1]);
    for (int k = 0; k < rows; k++) {
        assert_near(full[k], all[k], 1e-3); /* hardly any sun */
        off += fabs(0.5 * full[k] - half[k]) > 0.5 * near[0][k] + near[1][k];
    }
    assert_int_equal(off, 0); /* of 12, each has 0.6 % */
}

/* ---- maintenance ----------------------------------------------------------------------------- */

/* The first row of the grid's table, and the initial values below it, give these averages. */
TEST(only_electric_light_wants_cleaning)
{
    program_result r = { 0 };
    double all[MOST_ROWS], beam[MOST_ROWS], above[MOST_ROWS], lamp[MOST_ROWS], got[3],
        want[3] = { 0 };
    LUX4(folder, 0, &r, "grid", "study.yaml", "--accuracy", "20%", "-o", "kept", "--groups");
    int rows = column("kept/plane.csv", "illuminance_lx", all);
    column("kept/plane.csv", "sun_lx", beam);
    column("kept/plane.csv", "sky_lx", above);
    column("kept/plane.csv", "lamp_lx", lamp);
    want[1] = HUGE_VAL;
    for (int k = 0; k < rows; k++) {
        double initial = beam[k] + above[k] + 0.5 * lamp[k] / 0.8;
        want[0] += initial / rows;
        want[1] = fmin(want[1], initial);
        want[2] = fmax(want[2], initial);
    }
    const char *line = strstr(r.out, "  initial");
    assert_non_null(line);
    assert_int_equal(sscanf(line, " initial %lf %lf %lf", &got[0], &got[1], &got[2]), 3);
    for (int i = 0; i < 3; i++)
        assert_true(fabs(got[i] - want[i]) < 0.051 + rounding * want[i]); /* a decimal is printed */
    program_free(&r);
}

/* ---- where and when -------------------------------------------------------------------------- */

static const image_attribute *attribute_of(const image *im, const char *name)
{
    for (int i = 0; i < im->attribute_count; i++)
        if (!strcmp(im->attributes[i].name, name))
            return &im->attributes[i];
    return NULL;
}

static double number_of(const image *im, const char *name)
{
    const image_attribute *at = attribute_of(im, name);
    if (!at)
        fail_msg("no attribute %s", name);
    return (double)at->number;
}

static void assert_place(const image *im)
{
    assert_near(number_of(im, "latitude"), 52.0, 0.0);
    assert_near(number_of(im, "longitude"), 13.0, 0.0);
    assert_near(number_of(im, "altitude"), 34.0, 0.0);
}

static void assert_time(const image *im, const char *date, double offset)
{
    assert_non_null(attribute_of(im, "capDate"));
    assert_string_equal(attribute_of(im, "capDate")->text, date);
    assert_near(number_of(im, "utcOffset"), offset, 0.0);
}

TEST(grids_and_views_say_where_and_when_they_are_of)
{
    static const char *const files[] = { "where/plane.exr", "where/view.exr" };
    run("grid", NULL, "where", "--quiet");
    run("render", NULL, "where", "--quiet");
    for (int i = 0; i < 2; i++) {
        image im = part_of(files[i], 0);
        assert_place(&im);
        assert_time(&im, "2026:06:21 12:30:00", -7200.0); /* UTC = local + utcOffset */
        assert_non_null(attribute_of(&im, "lux4:study"));
    }
}

TEST(each_part_of_a_series_says_its_own_time)
{
    run("daylight", "series", "hours", "--quiet");
    for (int h = 0; h < 2; h++) {
        image im = part_of("hours/plane.exr", h);
        assert_place(&im);
        assert_time(&im, h ? "2026:12:21 12:00:00" : "2026:12:21 11:00:00", -3600.0);
        assert_string_equal(attribute_of(&im, "lux4:variant")->text, "series");
        assert_non_null(attribute_of(&im, "lux4:sunElevation"));
    }
}

TEST(a_night_in_a_series_leaves_nothing_to_chance)
{
    program_result r = { 0 };
    LUX4(folder, 0, &r, "daylight", "study.yaml", "--accuracy", "20%", "-o", "night", "--variant",
         "unlit", "--from", "06:00", "--to", "12:00", "--step", "360");
    assert_non_null(strstr(r.out, "2 of 2 moments"));
    assert_non_null(strstr(r.err, "the sun is below the horizon at 1 of 2 moments"));
    assert_null(strstr(r.out, "interval not valid"));
    program_free(&r);
}

TEST(daylight_factors_are_of_a_place_and_no_time)
{
    run("daylight", NULL, "factor", "--factor");
    image im = part_of("factor/plane.exr", 0);
    assert_place(&im);
    assert_null(attribute_of(&im, "capDate"));
    assert_null(attribute_of(&im, "utcOffset"));
}

TEST(what_is_not_known_is_not_said)
{
    static const char *const variants[] = { "nowhere", "by-hand" };
    static const char *const names[]    = { "latitude", "longitude", "altitude", "capDate",
                                            "utcOffset" };
    for (int v = 0; v < 2; v++) {
        run("grid", variants[v], "nowhere", "--quiet");
        image im = part_of("nowhere/plane.exr", 0);
        for (int i = 0; i < 5; i++)
            assert_null(attribute_of(&im, names[i]));
        assert_string_equal(attribute_of(&im, "lux4:variant")->text, variants[v]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sun_and_sky_are_layers_as_lamps_are),
        cmocka_unit_test(daylight_is_mixed_afterwards),
        cmocka_unit_test(half_of_a_sky_is_a_sky_of_half_the_lux),
        cmocka_unit_test(only_electric_light_wants_cleaning),
        cmocka_unit_test(grids_and_views_say_where_and_when_they_are_of),
        cmocka_unit_test(each_part_of_a_series_says_its_own_time),
        cmocka_unit_test(a_night_in_a_series_leaves_nothing_to_chance),
        cmocka_unit_test(daylight_factors_are_of_a_place_and_no_time),
        cmocka_unit_test(what_is_not_known_is_not_said),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
