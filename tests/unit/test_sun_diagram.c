/* tests/unit/test_sun_diagram.c -- the lines of a sun-path diagram, against their geometry. */
#include "sim/sun_diagram.h"

#include "tests/test.h"

static const double DEG = M_PI / 180.0;

/* Without air: apparent places are true ones. Mean solar and clock time are the same at 0 E. */
static sun_question question(arena *a, double latitude_deg, int month, int day)
{
    lux_error err = { 0 };
    return (sun_question){ .place     = "here",
                           .at        = { .latitude_deg = latitude_deg },
                           .zone      = clock_zone_new(a, "UTC", &err),
                           .zone_name = "UTC",
                           .turbidity = 3.0,
                           .has_date  = true,
                           .date      = { .year = 2026, .month = month, .day = day } };
}

static void find(sun_diagram *d, const sun_question *q)
{
    lux_error err = { 0 };
    *d            = (sun_diagram){ .q = q, .x = 300.0, .y = 400.0, .radius = 200.0 };
    if (!sun_diagram_find(d, &err))
        fail_msg("%s", err.text);
}

TEST(the_zenith_is_the_middle_and_the_horizon_the_rim)
{
    sun_diagram d = { .x = 300.0, .y = 400.0, .radius = 200.0 };
    assert_near(sun_diagram_radius(&d, 90.0), 0.0, 1e-12);
    assert_near(sun_diagram_radius(&d, 0.0), 200.0, 1e-12);
    assert_near(sun_diagram_radius(&d, 30.0), 200.0 / sqrt(3.0), 1e-12); /* tan 30 degrees */
}

TEST(north_is_up_and_east_on_the_right)
{
    sun_diagram d   = { .x = 300.0, .y = 400.0, .radius = 200.0 };
    sun_point north = sun_diagram_point(&d, 0.0, 100.0), east = sun_diagram_point(&d, 90.0, 100.0);
    assert_near(north.x, 300.0, 1e-12);
    assert_near(north.y, 300.0, 1e-12);
    assert_near(east.x, 400.0, 1e-12);
    assert_near(east.y, 400.0, 1e-12);
    for (int a = -170; a < 180; a += 20) {
        sun_point p = sun_diagram_point(&d, a, 50.0);
        assert_near(sun_diagram_azimuth(&d, &p), a, 1e-9);
    }
}

/* A track crosses the rim in proportion of the elevations at its ends. */
TEST(what_meets_the_rim_lies_on_it)
{
    sun_diagram d   = { .radius = 100.0 };
    sun_point up    = { .x = 90.0, .y = 0.0, .elevation_deg = 5.0 };
    sun_point down  = { .x = 110.0, .y = 0.0, .elevation_deg = -5.0 };
    sun_point there = sun_diagram_rim(&d, &up, &down), back = sun_diagram_rim(&d, &down, &up);
    assert_near(there.x, 100.0, 1e-12);
    assert_near(there.y, 0.0, 1e-9);
    assert_near(back.x, there.x, 1e-12);
    assert_near(there.elevation_deg, 0.0, 0.0);
}

/* A parallel of declination is a circle about R cos f / (sin f + sin d) north of the zenith, of the
 * radius R cos d / (sin f + sin d). From midnight to midnight about a solstice declination changes
 * by 0.001 degrees; parallax moves the sun by 0.0024: 0.02 px here. */
TEST(the_path_of_a_solstice_is_a_circle)
{
    static const double latitudes[] = { 55.75, 23.4, 70.0, 90.0 };
    for (int i = 0; i < 4; i++) {
        arena a = { 0 };
        sun_diagram d;
        sun_question q = question(&a, latitudes[i], 6, 21);
        find(&d, &q);
        double f = latitudes[i] * DEG, decl = 23.438 * DEG;
        double y      = 400.0 - 200.0 * cos(f) / (sin(f) + sin(decl));
        double radius = 200.0 * cos(decl) / (sin(f) + sin(decl));
        for (int k = 0; k < SUN_DAY_POINTS; k++) {
            const sun_point *p = &d.days[SUN_PATHS - 1][k];
            if (sun_point_up(p) && !(fabs(hypot(p->x - 300.0, p->y - y) - radius) < 0.04))
                fail_msg("%g N, point %d: %g px off", latitudes[i], k,
                         hypot(p->x - 300.0, p->y - y) - radius);
        }
        arena_clear(&a);
    }
}

TEST(lines_of_hours_close_and_cross_the_days)
{
    arena a = { 0 };
    sun_diagram d;
    sun_question q = question(&a, 50.0, 6, 21);
    find(&d, &q);
    for (int hour = 0; hour < 24; hour++) {
        const sun_point *p = d.hours[hour];
        assert_near(p[SUN_HOUR_POINTS - 1].x, p[0].x, 0.0);
        assert_near(p[SUN_HOUR_POINTS - 1].y, p[0].y, 0.0);
        /* UTC is mean solar time at 0 E: six points of the day's line an hour */
        const sun_point *june = &d.days[SUN_PATHS - 1][6 * hour];
        assert_true(fabs(p[SUN_JUNE_21].x - june->x) < 1e-6);
        assert_true(fabs(p[SUN_JUNE_21].y - june->y) < 1e-6);
        assert_near(d.date[6 * hour].x, june->x, 1e-12); /* and the date asked for is that day */
    }
    arena_clear(&a);
}

TEST(hours_count_by_the_clock_of_the_date)
{
    lux_error err = { 0 };
    arena a       = { 0 };
    sun_diagram d;
    sun_question q = question(&a, 52.5, 6, 21);
    q.zone         = clock_zone_new(&a, "Europe/Berlin", &err);
    find(&d, &q);
    assert_int_equal(d.offset, 7200);
    assert_true(d.clocks_change);
    sun_diagram utc; /* where it is 12:00 when it is 14:00 in Berlin */
    sun_question same = question(&a, 52.5, 6, 21);
    find(&utc, &same);
    assert_near(d.hours[14][SUN_JUNE_21].x, utc.hours[12][SUN_JUNE_21].x, 1e-12);
    assert_near(d.hours[14][SUN_JUNE_21].y, utc.hours[12][SUN_JUNE_21].y, 1e-12);
    q.date.month = 1;
    find(&d, &q);
    assert_int_equal(d.offset, 3600);
    q.zone = clock_zone_new(&a, "Asia/Kolkata", &err);
    find(&d, &q);
    assert_int_equal(d.offset, 19800);
    assert_false(d.clocks_change);
    arena_clear(&a);
}

TEST(elevations_are_told_where_the_sun_comes_last)
{
    static const struct {
        double latitude_deg, azimuth_deg;
    } sites[] = { { 55.75, 0.0 }, { 70.0, 0.0 }, { -33.9, 180.0 }, { 0.0, 180.0 }, { -10.0, 0.0 } };
    for (int i = 0; i < 5; i++) {
        arena a = { 0 };
        sun_diagram d;
        sun_question q = question(&a, sites[i].latitude_deg, 6, 21);
        find(&d, &q);
        assert_true(fabs(remainder(d.spare_deg - sites[i].azimuth_deg, 360.0)) < 20.0);
        arena_clear(&a);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_zenith_is_the_middle_and_the_horizon_the_rim),
        cmocka_unit_test(north_is_up_and_east_on_the_right),
        cmocka_unit_test(what_meets_the_rim_lies_on_it),
        cmocka_unit_test(the_path_of_a_solstice_is_a_circle),
        cmocka_unit_test(lines_of_hours_close_and_cross_the_days),
        cmocka_unit_test(hours_count_by_the_clock_of_the_date),
        cmocka_unit_test(elevations_are_told_where_the_sun_comes_last),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
