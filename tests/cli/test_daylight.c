/* tests/cli/test_daylight.c -- lux4 daylight: series through the day, hours of sun, the daylight
 * factor, and what it says of what cannot be.
 */
#define _GNU_SOURCE
#include "core/image.h"
#include "tests/folder.h"
#include "tests/program.h"
#include "tests/test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static char *folder;
static arena memory;
static program_result r;

static int begin(void **state)
{
    (void)state;
    folder = folder_new();
    return 0;
}

static int end(void **state)
{
    (void)state;
    folder_free(folder);
    arena_clear(&memory);
    program_free(&r);
    return 0;
}

/* A line of a table by its number, the header being 0; NULL behind the last. */
static const char *line_of(const char *file, int number)
{
    static char line[1024];
    FILE *f = fopen(path_in(folder, file), "r");
    assert_non_null(f);
    bool there = true;
    for (int i = 0; i <= number && there; i++)
        there = fgets(line, sizeof line, f) != NULL;
    fclose(f);
    return there ? line : NULL;
}

static int count_rows(const char *file)
{
    int rows = 0;
    while (line_of(file, rows + 1))
        rows++;
    return rows;
}

/* The numbers of a row, behind so many columns of text. */
static void row_of(const char *file, int number, int texts, double *out, int count)
{
    const char *c = line_of(file, number);
    assert_non_null(c);
    for (int i = 0; i < texts; i++)
        c = strchr(c, ',') + 1;
    for (int i = 0; i < count; i++) {
        char *after;
        out[i] = strtod(c, &after);
        assert_true(after > c && *after == (i + 1 < count ? ',' : '\n'));
        c = after + 1;
    }
}

static double json(const char *path) { return json_number_at(r.out, path); }

#define ROOM    "lux4: 1\nroom: {size: [4, 4, 3], reflectance: 0"
#define MOSCOW  "site: {place: \"55.7558N 37.6173E\", zone: Europe/Moscow}\n"
#define BERLIN  "site: {place: \"52.5N 13.4E\", zone: Europe/Berlin}\n"
#define OUTSIDE "grids: [{name: out, points: out.csv}]\n"

/* Above the roof, where nothing but the sky is seen; and in the closed room. */
static void write_outside(void)
{
    folder_write(folder, "out.csv", "x,y,z,nx,ny,nz\n2,2,10,0,0,1\n2,2,1,0,0,1\n");
}

/* ---- the daylight factor --------------------------------------------------------------------- */

/* CIE 171:2006, 5.11, a window of 2 m by 1 m, ground of 0.30, traditional overcast sky: exact
 * values to three decimals. Floor and ceiling at x = 2, y = 3.75 to 0.25; the wall that faces the
 * window, z = 2.75 to 0.25. */
static const double floor_exact[]   = { .945, 1.376, 2.066, 3.188, 4.966, 7.421, 9.112, 5.037 };
static const double ceiling_exact[] = { .380, .526, .746, 1.077, 1.555, 2.134, 2.398, 1.238 };
static const double wall_exact[]    = { .951, 1.063, 1.274, 1.706, 2.059, 2.143 };
enum { FLOOR = 8, CEILING = 8, WALL = 6 };
enum { FACTOR = 6, SKY, EXTERNAL, INTERNAL, HALF, FACTOR_COLUMNS };

static void write_cie_points(void)
{
    char text[2048] = "x,y,z,nx,ny,nz\n", *to = text + strlen(text);
    for (int i = 0; i < FLOOR; i++)
        to += sprintf(to, "2,%g,0.00001,0,0,1\n", 3.75 - 0.5 * i);
    for (int i = 0; i < CEILING; i++)
        to += sprintf(to, "2,%g,2.99999,0,0,-1\n", 3.75 - 0.5 * i);
    for (int i = 0; i < WALL; i++)
        to += sprintf(to, "2,3.99999,%g,0,-1,0\n", 2.75 - 0.5 * i);
    folder_write(folder, "cie.csv", text);
}

static void assert_exact(const double *row, double want)
{
    /* 95 % intervals of 22 points, each doubled; and half of the last digit. */
    if (fabs(row[FACTOR] - want) > 2.0 * row[HALF] + 0.0005)
        fail_msg("daylight factor %g +- %g %%, not %g", row[FACTOR], row[HALF], want);
    assert_near(row[SKY] + row[EXTERNAL] + row[INTERNAL], row[FACTOR], 1e-8);
    assert_true(row[INTERNAL] <= 1e-6 * want); /* the room is black; float roundings */
}

static void assert_cie_factors(const char *csv_file)
{
    double row[FACTOR_COLUMNS];
    assert_string_equal(line_of(csv_file, 0),
                        "x,y,z,nx,ny,nz,daylight_factor_percent,sky_percent,external_percent,"
                        "internal_percent,half_width_percent\n");
    for (int i = 0; i < FLOOR; i++) {
        row_of(csv_file, 1 + i, 0, row, FACTOR_COLUMNS);
        assert_exact(row, floor_exact[i]);
        assert_true(row[EXTERNAL] == 0.0);
    }
    for (int i = 0; i < CEILING; i++) {
        row_of(csv_file, 1 + FLOOR + i, 0, row, FACTOR_COLUMNS);
        assert_exact(row, ceiling_exact[i]);
        assert_true(row[SKY] == 0.0);
    }
    for (int i = 0; i < WALL; i++) {
        row_of(csv_file, 1 + FLOOR + CEILING + i, 0, row, FACTOR_COLUMNS);
        assert_exact(row, wall_exact[i]);
    }
    assert_null(line_of(csv_file, 1 + FLOOR + CEILING + WALL));
}

#define CIE_ROOM                                                                                   \
    ROOM ", windows: [{wall: south, at: [1, 1], size: [2, 1], transmittance: 1}]}\n"               \
         "grids: [{name: cie, points: cie.csv}]\n"

TEST(daylight_factors_of_a_window_are_the_exact_ones)
{
    write_cie_points();
    folder_write(folder, "cie.yaml", CIE_ROOM "sky: {model: overcast, ground: 0.3}\n");
    LUX4(folder, 0, &r, "daylight", "cie.yaml", "--factor", "--accuracy", "1%", "-o", "cie");
    assert_non_null(strstr(r.out, "daylight factor: traditional overcast sky"));
    assert_string_equal(r.err, "");
    assert_cie_factors("cie/cie.csv");
    assert_true(there_is(folder, "cie/cie.svg"));
}

TEST(lamps_and_sun_are_off_and_the_time_does_not_matter)
{
    write_cie_points();
    folder_write(folder, "lit.yaml",
                 CIE_ROOM MOSCOW "when: {date: 2026-06-21, from: \"08:00\", to: \"18:00\"}\n"
                                 "sky: {model: clear, ground: 0.3}\n"
                                 "lights: [{type: point, at: [1, 1, 2], intensity: 1000}]\n");
    LUX4(folder, 0, &r, "daylight", "lit.yaml", "--factor", "--accuracy", "1%", "-o", "lit");
    assert_cie_factors("lit/cie.csv");
}

TEST(the_daylight_factor_as_json_has_its_parts)
{
    write_cie_points();
    folder_write(folder, "one.yaml", CIE_ROOM "sky: {model: cie, type: 1, ground: 0.3}\n");
    LUX4(folder, 0, &r, "daylight", "one.yaml", "--factor", "--json", "-o", "one");
    assert_true(json_is_valid(r.out));
    double average = json("grids.0.average_percent");
    assert_near(json("grids.0.average_sky_percent") + json("grids.0.average_external_percent") +
                    json("grids.0.average_internal_percent"),
                average, 1e-7);
    /* CIE type 1: the window's row of the appendix, floor and wall; the ceiling as above. */
    double sum = .873 + 1.308 + 2.021 + 3.198 + 5.072 + 7.637 + 9.324 + 5.089 + .951 + 1.063 +
                 1.250 + 1.508 + 1.700 + 1.856;
    for (int i = 0; i < CEILING; i++)
        sum += ceiling_exact[i];
    assert_near(average, sum / 22.0, 0.02); /* the accuracy asked for */
    assert_true(json("grids.0.share_at_2_percent") > 0.3);
    assert_string_equal(json_at(r.out, "interval_valid"), "true}\n");
}

/* ---- a series -------------------------------------------------------------------------------- */

TEST(outside_there_is_the_sky_and_the_sun_by_its_sine)
{
    write_outside();
    folder_write(folder, "sine.yaml",
                 ROOM
                 "}\n" MOSCOW OUTSIDE
                 "when: {date: 2026-03-21, from: \"05:00\", to: \"20:00\", step: 60}\n"
                 "sky: {model: uniform, sun: on, horizontal: 10000, sun_illuminance: 50000}\n");
    LUX4(folder, 0, &r, "daylight", "sine.yaml", "--json", "-o", "sine");
    assert_true(json_is_valid(r.out));
    double row[10], hours[7], sun = 0.0;
    for (int h = 0; h < 16; h++) {
        char path[64];
        snprintf(path, sizeof path, "grids.0.moments.%d.sun_apparent_elevation_deg", h);
        double sine = sin(json(path) * M_PI / 180.0);
        row_of("sine/out.csv", 1 + 2 * h, 1, row, 10);
        double direct = sine > 0.0 ? 50000.0 * sine : 0.0;
        /* a disk of 0.53 degrees that the horizon cuts is no point: not looked at */
        if (fabs(sine) > 0.01)
            assert_true(fabs(row[ALL] - 10000.0 - direct) <= 2.0 * row[HALF_WIDTH] + 1.0);
        assert_near(row[DIRECT] + row[INDIRECT], row[ALL], 1e-8);
        row_of("sine/out.csv", 2 + 2 * h, 1, row, 10);
        assert_true(row[ALL] == 0.0);
        sun += sine > 0.01;
    }
    assert_null(line_of("sine/out.csv", 33));
    assert_string_equal(line_of("sine/out-sun.csv", 0), "x,y,z,nx,ny,nz,sun_hours\n");
    row_of("sine/out-sun.csv", 1, 0, hours, 7);
    assert_true(fabs(hours[6] - sun) <= 1e-6 && sun >= 11.0);
    row_of("sine/out-sun.csv", 2, 0, hours, 7);
    assert_true(hours[6] == 0.0);
    assert_near(json("grids.0.sun_hours.maximum_h"), sun, 1e-6);
}

TEST(before_sunrise_it_is_dark_and_that_is_said)
{
    write_outside();
    folder_write(folder, "dawn.yaml",
                 ROOM "}\n" MOSCOW OUTSIDE "when: 2026-12-21T12:00\nsky: {model: clear}\n");
    LUX4(folder, 0, &r, "daylight", "dawn.yaml", "--from", "07:00", "--to", "11:00", "-o", "dawn");
    assert_non_null(strstr(r.err, "the sun is below the horizon at 3 of 5 moments"));
    double row[10];
    for (int h = 0; h < 5; h++) { /* the sun's centre rises at 09:04 */
        row_of("dawn/out.csv", 1 + 2 * h, 1, row, 10);
        assert_true(h < 3 ? row[ALL] == 0.0 : row[ALL] > 100.0);
    }
    assert_non_null(strstr(r.out, "2026-12-21T07:00+03:00"));
}

/* Nobody finds light by night: that says nothing of the samples of the day. */
TEST(an_interval_stays_valid_where_a_series_begins_by_night)
{
    folder_write(folder, "in.csv", "x,y,z,nx,ny,nz\n2,2,1,0,0,1\n");
    folder_write(folder, "early.yaml",
                 "lux4: 1\nroom: {size: [4, 4, 3], reflectance: 0.5, windows: "
                 "[{wall: south, at: [1, 1], size: [2, 1]}]}\n" MOSCOW
                 "grids: [{name: in, points: in.csv}]\nsky: {model: clear}\n"
                 "when: {date: 2026-12-21, from: \"07:00\", to: \"11:00\", step: 240}\n");
    LUX4(folder, 0, &r, "daylight", "early.yaml", "--accuracy", "50%", "-o", "early");
    assert_non_null(strstr(r.err, "below the horizon at 1 of 2 moments"));
    assert_null(strstr(r.out, "not valid"));
}

static int moments_on(const char *date)
{
    LUX4(folder, 0, &r, "daylight", "clock.yaml", "--date", date, "-o", "clock", "--overwrite",
         "--accuracy", "50%");
    return count_rows("clock/out.csv") / 2;
}

TEST(an_hour_that_clocks_skip_is_left_out_and_one_they_show_twice_is_there_twice)
{
    write_outside();
    folder_write(folder, "clock.yaml",
                 ROOM "}\n" BERLIN OUTSIDE
                      "when: {date: 2026-06-21, from: \"00:00\", to: \"04:00\", step: 60}\n"
                      "sky: {model: overcast, horizontal: 10000}\n");
    assert_int_equal(moments_on("2026-03-28"), 5);
    assert_int_equal(moments_on("2026-03-29"), 4);
    assert_non_null(strstr(r.err, "clocks are put forward"));
    assert_int_equal(moments_on("2026-10-25"), 6);
    assert_non_null(strstr(r.out, "2026-10-25T02:00+02:00"));
    assert_non_null(strstr(r.out, "2026-10-25T02:00+01:00"));
    assert_int_equal(moments_on("2026-10-24..2026-10-26"), 16);
}

static const char *attribute_of(const image *im, const char *name)
{
    for (int i = 0; i < im->attribute_count; i++)
        if (!strcmp(im->attributes[i].name, name))
            return im->attributes[i].text;
    fail_msg("no attribute %s", name);
    return NULL;
}

TEST(more_moments_than_a_batch_holds_are_all_there_in_their_order)
{
    enum { MOMENTS = 61 };
    write_outside();
    folder_write(folder, "many.yaml",
                 ROOM "}\n" MOSCOW OUTSIDE "sky: {model: overcast, horizontal: 10000}\n");
    LUX4(folder, 0, &r, "daylight", "many.yaml", "--date", "2026-06-21", "--from", "10:00", "--to",
         "11:00", "--step", "1", "--accuracy", "50%");
    assert_int_equal(count_rows("out/out.csv"), 2 * MOMENTS);
    for (int h = 0; h < MOMENTS; h += 20) {
        char want[64];
        image im;
        lux_error err = { 0 };
        snprintf(want, sizeof want, "2026-06-21T%02d:%02d+03:00", 10 + h / 60, h % 60);
        assert_memory_equal(line_of("out/out.csv", 1 + 2 * h), want, strlen(want));
        if (!image_read_exr_part(path_in(folder, "out/out.exr"), h, &memory, &im, &err))
            fail_msg("%s", err.text);
        assert_string_equal(attribute_of(&im, "name"), want);
        assert_string_equal(attribute_of(&im, "lux4:study"), "many.yaml");
        assert_int_equal(im.channel_count, 5);
        assert_int_equal(im.width, 2);
    }
    /* The same study may write into its own folder again, another one may not. */
    LUX4(folder, 0, &r, "daylight", "many.yaml", "--date", "2026-06-21", "--from", "10:00",
         "--accuracy", "50%");
    assert_int_equal(count_rows("out/out.csv"), 2);
    assert_null(strstr(r.out, "direct sun")); /* a single time has no length */
    folder_write(folder, "other.yaml", ROOM "}\n" OUTSIDE "sky: {model: overcast}\n");
    LUX4_FAILS(folder, 2, "is there already", "daylight", "other.yaml", "--factor");
}

TEST(lamps_shine_through_the_night)
{
    folder_write(folder, "night.yaml",
                 ROOM "}\n" MOSCOW "grids: [{name: g, on: room, height: 0, spacing: 4}]\n"
                      "lights: [{type: point, at: [2, 2, 2], intensity: 400}]\n"
                      "when: {date: 2026-12-21, from: \"00:00\", to: \"02:00\"}\n"
                      "sky: {model: clear}\n");
    LUX4(folder, 0, &r, "daylight", "night.yaml", "--json", "-o", "night");
    for (int h = 0; h < 3; h++) {
        double row[10];
        row_of("night/g.csv", 1 + h, 1, row, 10);
        assert_near(row[ALL], 100.0, 1e-5); /* 400 cd / (2 m)^2 */
    }
}

/* ---- its end --------------------------------------------------------------------------------- */

static const char slow[] =
    "lux4: 1\nroom: {size: [4, 4, 3], reflectance: 0.5, "
    "windows: [{wall: south, at: [1, 1], size: [2, 1], transmittance: 1}]}\n" MOSCOW
    "grids: [{name: g, on: room, height: 0.5, spacing: 1}]\n"
    "when: {date: 2026-06-21, from: \"10:00\", to: \"12:00\"}\nsky: {model: clear}\n";

TEST(a_run_that_is_late_says_so_and_writes_what_it_has)
{
    folder_write(folder, "slow.yaml", slow);
    LUX4(folder, 3, &r, "daylight", "slow.yaml", "--time", "0", "--accuracy", "0.01%", "-o",
         "late");
    assert_one_line(&r, "grid g");
    assert_int_equal(count_rows("late/g.csv"), 3 * 16);
}

TEST(an_interrupted_run_marks_what_it_writes_as_partial)
{
    folder_write(folder, "slow.yaml", slow);
    program_expect(130,
                   &(program_desc){
                       .folder = folder,
                       .until  = path_in(folder, "stop"),
                       .then_s = 2.0,
                       .words  = { "daylight", "slow.yaml", "--accuracy", "0.01%", "-o", "stop" } },
                   &r);
    assert_one_line(&r, "interrupted");
    assert_int_equal(count_rows("stop/g.csv"), 3 * 16 + 1);
    assert_non_null(strstr(line_of("stop/g.csv", 3 * 16 + 1), "# partial: "));
    size_t size;
    char *sheet = bytes_of(path_in(folder, "stop/g.svg"), &size);
    assert_non_null(strstr(sheet, "partial"));
    free(sheet);
}

/* ---- what cannot be -------------------------------------------------------------------------- */

TEST(what_makes_no_sense_is_refused)
{
    write_outside();
    folder_write(folder, "wrong.yaml",
                 ROOM "}\n" MOSCOW OUTSIDE
                      "when: {date: 2026-06-21, from: \"10:00\", to: \"12:00\"}\n"
                      "sky: {model: clear}\n"
                      "views: [{name: v, eye: [1, 1, 1], target: [2, 2, 1]}]\n");
    folder_write(folder, "timeless.yaml", ROOM "}\n" MOSCOW OUTSIDE "sky: {model: clear}\n");
    folder_write(folder, "dark.yaml", ROOM "}\n" MOSCOW OUTSIDE "when: 2026-06-21T10:00\n");
    folder_write(folder, "bare.yaml", ROOM "}\n" MOSCOW "sky: {model: clear}\n");
    folder_write(folder, "named.yaml",
                 ROOM "}\n" MOSCOW "sky: {model: clear}\nwhen: 2026-06-21T10:00\n"
                      "grids: [{name: out, points: out.csv}, {name: out-sun, points: out.csv}]\n");
#define WRONG(says, ...) LUX4_FAILS(folder, 2, says, "daylight", __VA_ARGS__)
    WRONG("--date: expected a date", "wrong.yaml", "--date", "2026-06-21T10:00");
    WRONG("or two as 2026-06-21..2026-06-30", "wrong.yaml", "--date", "2026-06-21-2026-06-30");
    WRONG("2026-02-30", "wrong.yaml", "--date", "2026-02-30");
    WRONG("expected the earlier date first", "wrong.yaml", "--date", "2026-06-22..2026-06-21");
    WRONG("--from: expected a time from 00:00 to 23:59", "wrong.yaml", "--from", "24:00");
    WRONG("--to: expected a time", "wrong.yaml", "--to", "noon");
    WRONG("from 13:00 to 12:00: expected the earlier time first", "wrong.yaml", "--from", "13:00");
    WRONG("--step 0: expected minutes", "wrong.yaml", "--step", "0");
    WRONG("--step nan: expected minutes", "wrong.yaml", "--step", "nan");
    WRONG("--factor is the same at any time", "wrong.yaml", "--factor", "--step", "30");
    WRONG("--groups has no meaning for lux4 daylight", "wrong.yaml", "--groups");
    WRONG("a series of more than 10000 moments", "wrong.yaml", "--date", "2026-01-01..2026-12-31",
          "--step", "1");
    WRONG("--date and --from are needed", "timeless.yaml", "--date", "2026-06-21");
    WRONG("needs `when`", "timeless.yaml");
    WRONG("no daylight", "dark.yaml");
    WRONG("no `grids`", "bare.yaml");
    WRONG("hours of sun of grid `out`", "named.yaml");
    LUX4_FAILS(folder, 2, "lux4 daylight", "grid", "wrong.yaml");
    LUX4_FAILS(folder, 2, "lux4 daylight", "render", "wrong.yaml");
    LUX4_FAILS(folder, 2, "--factor has no meaning for lux4 grid", "grid", "wrong.yaml",
               "--factor");
    assert_false(there_is(folder, "out/out.svg"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_makes_no_sense_is_refused),
        cmocka_unit_test(daylight_factors_of_a_window_are_the_exact_ones),
        cmocka_unit_test(lamps_and_sun_are_off_and_the_time_does_not_matter),
        cmocka_unit_test(the_daylight_factor_as_json_has_its_parts),
        cmocka_unit_test(outside_there_is_the_sky_and_the_sun_by_its_sine),
        cmocka_unit_test(before_sunrise_it_is_dark_and_that_is_said),
        cmocka_unit_test(an_interval_stays_valid_where_a_series_begins_by_night),
        cmocka_unit_test(
            an_hour_that_clocks_skip_is_left_out_and_one_they_show_twice_is_there_twice),
        cmocka_unit_test(more_moments_than_a_batch_holds_are_all_there_in_their_order),
        cmocka_unit_test(lamps_shine_through_the_night),
        cmocka_unit_test(a_run_that_is_late_says_so_and_writes_what_it_has),
        cmocka_unit_test(an_interrupted_run_marks_what_it_writes_as_partial),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
