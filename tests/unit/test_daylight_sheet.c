/* tests/unit/test_daylight_sheet.c -- sheets of plans: what is on them, and where. */
#include "sim/daylight_sheet.h"
#include "sim/sheet.h"
#include "tests/folder.h"
#include "tests/made_series.h"
#include "tests/program.h"
#include "tests/test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static arena memory;
static char *folder, *svg;

static int begin(void **state)
{
    (void)state;
    folder = folder_new();
    return 0;
}

static int end(void **state)
{
    (void)state;
    arena_clear(&memory);
    folder_free(folder);
    free(svg);
    return 0;
}

static int count_of(const char *what)
{
    int count = 0;
    for (const char *c = svg; (c = strstr(c, what)); c++)
        count++;
    return count;
}

static void draw(const daylight_series *s)
{
    size_t size;
    free(svg);
    assert_true(daylight_sheet_write(path_in(folder, "a.svg"), s, NULL));
    svg = bytes_of(path_in(folder, "a.svg"), &size);
}

/* Where the text stands. */
static void place_of(const char *text, double *x, double *y)
{
    char what[64];
    snprintf(what, sizeof what, ">%s</text>", text);
    const char *at = strstr(svg, what);
    assert_non_null(at);
    while (strncmp(at, "<text", 5) != 0)
        at--;
    assert_int_equal(sscanf(at, "<text x=\"%lf\" y=\"%lf\"", x, y), 2);
}

#define PLAN "crispEdges"

TEST(a_day_has_a_plan_an_hour_and_one_of_the_sun)
{
    daylight_series s;
    made_series(&memory, 1, 4, &s);
    draw(&s);
    assert_int_equal(count_of(PLAN), 5);
    assert_non_null(strstr(svg, "desk, 2026-06-21</text>"));
    assert_non_null(strstr(svg, ">13:00</text>"));
    assert_non_null(strstr(svg, ">avg 402 lx</text>"));
    assert_non_null(strstr(svg, ">avg 2.4 h</text>"));
    double x[2], y[2];
    place_of("10:00", &x[0], &y[0]);
    place_of("11:00", &x[1], &y[1]);
    assert_true(x[1] > x[0] && y[1] == y[0]);
}

TEST(of_several_dates_each_has_a_row_and_equal_hours_a_column)
{
    daylight_series s;
    made_series(&memory, 3, 4, &s);
    draw(&s);
    assert_int_equal(count_of(PLAN), 13);
    assert_int_equal(count_of(">11:00</text>"), 3);
    double x[2], y[2];
    place_of("2026-06-22", &x[0], &y[0]);
    place_of("2026-06-23", &x[1], &y[1]);
    assert_true(x[0] == x[1] && y[1] > y[0]);
    assert_non_null(strstr(svg, "desk, 2026-06-21 to 2026-06-23"));
    assert_non_null(strstr(svg, "h a day"));
}

TEST(of_one_time_a_day_the_dates_stand_under_the_plans)
{
    daylight_series s;
    made_series(&memory, 5, 1, &s);
    draw(&s);
    assert_int_equal(count_of(PLAN), 6);
    double x[2], y[2];
    place_of("2026-06-22", &x[0], &y[0]);
    place_of("2026-06-23", &x[1], &y[1]);
    assert_true(x[1] > x[0] && y[1] == y[0]);
}

TEST(a_year_of_days_is_thinned_out_and_says_so)
{
    daylight_series s;
    made_series(&memory, 365, 10, &s);
    draw(&s);
    assert_true(count_of(PLAN) <= MOST_PLANS + 1 && count_of(PLAN) > MOST_PLANS / 2);
    assert_non_null(strstr(svg, "one date of 10 is drawn"));
}

TEST(an_hour_that_clocks_show_twice_has_two_plans)
{
    daylight_series s;
    made_series(&memory, 2, 3, &s);
    moment own[6]; /* 10, 11, 11 */
    memcpy(own, s.moments, sizeof own);
    own[2].local.hour = 11;
    memcpy(own[2].text + 11, "11", 2);
    s.moments = own;
    draw(&s);
    assert_int_equal(count_of(">11:00 (2nd)</text>"), 1);
    assert_int_equal(count_of(">11:00</text>"), 2);
}

TEST(cells_without_a_sensor_stay_empty)
{
    daylight_series s;
    made_series(&memory, 1, 1, &s);
    char *text;
    size_t size;
    FILE *to         = open_memstream(&text, &size);
    double values[]  = { 10, 10, 10, 10, 10 };
    color_scale even = color_scale_125(RAMP_LIGHT, 0.0, 10.0);
    sheet_plan(to, &(sheet_box){ 0, 0, 300, 200 }, &s.plan, values, &even);
    fclose(to);
    /* The lower row is one run; of the upper, left and right. */
    assert_non_null(strstr(text, "d=\"M0 1h3v1h-3zM0 0h1v1h-1zM2 0h1v1h-1z\""));
    free(text);
}

TEST(the_arrow_points_to_true_north_by_the_axes_of_the_plan)
{
    /* u east, v north; u north, v west: north is to the right; site.north turned by 30. */
    const struct {
        dvec3 u, v;
        double north, turn;
    } cases[] = { { { 1, 0, 0 }, { 0, 1, 0 }, 0.0, 0.0 },
                  { { 0, 1, 0 }, { -1, 0, 0 }, 0.0, 90.0 },
                  { { 1, 0, 0 }, { 0, 1, 0 }, 30.0, 30.0 } };
    for (int i = 0; i < 3; i++) {
        study_grid g  = { .u = cases[i].u, .v = cases[i].v };
        grid_result r = { .grid = &g };
        char *text;
        size_t size;
        double turn = (double)NAN;
        FILE *to    = open_memstream(&text, &size);
        sheet_north(to, 0.0, 0.0, &r, cases[i].north);
        fclose(to);
        assert_int_equal(sscanf(strstr(text, "rotate("), "rotate(%lf)", &turn), 1);
        assert_near(turn, cases[i].turn, 1e-4); /* four digits */
        free(text);
    }
}

TEST(a_plan_of_factors_has_its_numbers)
{
    daylight_series s;
    made_series(&memory, 1, 1, &s);
    double all[]      = { 0.5, 12.34, 123.4, 2.0, 3.0 };
    daylight_factor f = { .plan = &s.plan, .all = all, .minimum = 0.5, .maximum = 123.4 };
    size_t size;
    free(svg);
    assert_true(daylight_factor_sheet_write(path_in(folder, "f.svg"), &f, "a sky", NULL));
    svg = bytes_of(path_in(folder, "f.svg"), &size);
    assert_non_null(strstr(svg, "desk, daylight factor in %"));
    assert_non_null(strstr(svg, ">0.50</text>"));
    assert_non_null(strstr(svg, ">12.3</text>"));
    assert_non_null(strstr(svg, ">123</text>"));
    assert_non_null(strstr(svg, "a sky"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_day_has_a_plan_an_hour_and_one_of_the_sun),
        cmocka_unit_test(of_several_dates_each_has_a_row_and_equal_hours_a_column),
        cmocka_unit_test(of_one_time_a_day_the_dates_stand_under_the_plans),
        cmocka_unit_test(a_year_of_days_is_thinned_out_and_says_so),
        cmocka_unit_test(an_hour_that_clocks_show_twice_has_two_plans),
        cmocka_unit_test(cells_without_a_sensor_stay_empty),
        cmocka_unit_test(the_arrow_points_to_true_north_by_the_axes_of_the_plan),
        cmocka_unit_test(a_plan_of_factors_has_its_numbers),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
