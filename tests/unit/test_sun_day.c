/* tests/unit/test_sun_day.c -- sky/sun_day.c: days of every kind. */
#include "tests/moment.h"

#include <stdio.h>

#include <string.h>

/* Hours of the date [from, to) that it is up, counted each minute. */
static double counted(const site *s, double from, double to)
{
    sun_series series   = { 0 };
    const sun_air empty = { 0.0, 0.0 };
    int minutes         = 0;
    for (double m = from + 30.0; m < to; m += 60.0) {
        sun_place p;
        assert_true(sun_at_next(&series, s, &empty, m, &p, NULL));
        minutes += p.elevation_deg > -0.8333;
    }
    return minutes / 60.0;
}

/* Around the solstice, where the day becomes one of 24 hours; each crossing costs a minute. */
TEST(length_is_the_time_that_it_is_up_near_polar_day)
{
    const double latitudes[] = { 65.8, 66.2, 70.0, 89.9, -66.5, -89.99 };
    for (int i = 0; i < 6; i++)
        for (int k = 0; k < 14; k++) {
            const site s = { latitudes[i], 25.0, 0.0 };
            sun_day d    = sun_on(&s, "+05:00", 2026, 1 + k * 10 % 12, 1 + 2 * k);
            char text[40];
            snprintf(text, sizeof text, "2026-%02d-%02dT00:00+05:00", 1 + k * 10 % 12, 1 + 2 * k);
            double from = moment_of(text), hours = counted(&s, from, from + 86400.0);
            if (!(fabs(d.length_h - hours) <= 3.0 / 60.0))
                fail_msg("%g N, %s: %g h, counted %g", s.latitude_deg, text, d.length_h, hours);
            assert_int_equal(d.always_up, hours == 24.0 && d.length_h > 23.999);
            assert_int_equal(d.always_down, hours == 0.0 && d.length_h == 0.0);
            if (d.always_up || d.always_down)
                assert_true(isnan(d.sunrise) && isnan(d.sunset));
        }
}

/* At midsummer, south of polar day by hundredths of a degree. */
TEST(nights_of_minutes_are_found)
{
    int shortest    = 0;
    const char *day = "2026-06-21T00:00+05:00";
    for (int i = 0; i < 12; i++) {
        const site s = { 65.69 + 0.005 * i, 25.0, 0.0 };
        sun_day d    = sun_on(&s, "+05:00", 2026, 6, 21);
        double hours = counted(&s, moment_of(day), moment_of(day) + 86400.0);
        assert_true(fabs(d.length_h - hours) <= 2.5 / 60.0);
        shortest += hours < 24.0 && hours > 23.5;
        assert_int_equal(d.always_up, isnan(d.sunset));
    }
    assert_in_range(shortest, 2, 11);
}

static void check_horizon(const site *s, double moment, bool rises)
{
    double before = sun_bare(s->latitude_deg, s->longitude_deg, moment - 1.0).elevation_deg;
    double after  = sun_bare(s->latitude_deg, s->longitude_deg, moment + 1.0).elevation_deg;
    assert_true(rises ? before < -0.8333 && after > -0.8333 : before > -0.8333 && after < -0.8333);
}

TEST(sunrise_and_sunset_cross_the_horizon_within_a_second)
{
    const site places[] = { { 0.0, 0.0, 0.0 }, { 55.0, 37.0, 0.0 }, { -41.0, 174.0, 0.0 } };
    const char *zones[] = { "UTC", "Europe/Moscow", "Pacific/Auckland" };
    for (int i = 0; i < 3; i++)
        for (int month = 1; month <= 12; month++) {
            sun_day d = sun_on(&places[i], zones[i], 2026, month, 28);
            check_horizon(&places[i], d.sunrise, true);
            check_horizon(&places[i], d.sunset, false);
            assert_true(d.sunrise < d.transit && d.transit < d.sunset);
            assert_true(fabs(d.length_h - (d.sunset - d.sunrise) / 3600.0) < 1e-5);
            assert_true(!d.always_up && !d.always_down);
        }
}

/* Where clocks are put forward or back, days of 23 and 25 h: at the South Pole all light or dark.
 */
TEST(days_of_23_and_25_hours_are_as_long)
{
    const site pole = { -90.0, 0.0, 2835.0 }, north = { 89.0, 0.0, 0.0 };
    sun_day spring = sun_on(&pole, "Pacific/Auckland", 2026, 9, 27);
    assert_true(spring.always_up && fabs(spring.length_h - 23.0) < 1e-9);
    sun_day autumn = sun_on(&pole, "Pacific/Auckland", 2026, 4, 5);
    assert_true(autumn.always_down && autumn.length_h == 0.0);
    sun_day back = sun_on(&north, "Pacific/Auckland", 2026, 4, 5);
    assert_true(back.always_up && fabs(back.length_h - 25.0) < 1e-9);
}

/* Lebanon's clocks go from 24:00 to 01:00: its date begins at 01:00, one hour late. */
TEST(a_date_without_midnight_begins_when_clocks_show_it)
{
    const site pole = { 90.0, 0.0, 0.0 };
    sun_day d       = sun_on(&pole, "Asia/Beirut", 2021, 3, 28);
    assert_true(d.always_up && fabs(d.length_h - 23.0) < 1e-9);
}

/* On the date line: the same instant of noon, a date apart; Samoa left out 2011-12-30. */
TEST(dates_are_those_of_the_zone)
{
    const site line = { 1.87, -157.43, 0.0 };
    sun_day a       = sun_on(&line, "Pacific/Kiritimati", 2026, 6, 21);
    sun_day b       = sun_on(&line, "Pacific/Honolulu", 2026, 6, 20);
    assert_true(fabs(a.transit - b.transit) < 1e-3 && fabs(a.sunset - b.sunset) < 1e-2);
    assert_true(a.sunrise > moment_of("2026-06-21T06:00+14:00") &&
                a.sunrise < moment_of("2026-06-21T07:00+14:00"));

    arena room          = { 0 };
    lux_error err       = { 0 };
    const clock_zone *z = clock_zone_new(&room, "Pacific/Apia", &err);
    const site apia     = { -13.8, -171.8, 0.0 };
    assert_false(
        sun_day_of(&apia, z, &(civil_time){ .year = 2011, .month = 12, .day = 30 }, &a, &err));
    assert_non_null(strstr(err.text, "2011-12-30 was left out"));
    arena_clear(&room);
    assert_true(sun_on(&apia, "Pacific/Apia", 2011, 12, 31).length_h > 12.0);
}

/* Clocks 12 h from the sun: it sets, rises, and passes the meridian around midnight. */
TEST(a_sunset_may_come_first_and_a_transit_be_missing)
{
    const site s  = { 50.0, 180.0, 0.0 };
    sun_day d     = sun_on(&s, "UTC", 2026, 6, 21);
    int transits  = 0;
    double before = 0.0;
    assert_true(d.sunset < d.sunrise);
    assert_true(fabs(d.length_h - 16.37) < 0.05); /* as at 50 N everywhere */
    for (int day = 1; day <= 30; day++) {
        sun_day t = sun_on(&s, "UTC", 2026, 9, day);
        assert_true(isnan(t.transit) == isnan(t.transit_elevation_deg));
        if (isnan(t.transit))
            continue;
        assert_true(!transits || t.transit - before < 1.01 * 86400.0 + 86400.0);
        before = t.transit;
        transits++;
    }
    /* September gains 9 minutes on the clock: it passes midnight once, and one date has two */
    assert_true(transits == 30 || transits == 29);
}

/* At 66 N the sun sets for minutes around its midnight, before and after polar day. 5 degrees west
 * of these clocks' meridian that is 00:25, and sunsets move past 00:00: one date has two of them;
 * 5 degrees east, sunrises do. */
static int dates_with_two(double longitude_deg, int month)
{
    const site s = { 66.0, longitude_deg, 0.0 };
    int two      = 0;
    for (int day = 1; day <= 30; day++) {
        sun_day d = sun_on(&s, "+00:00", 2026, month, day);
        if (isnan(d.sunrise) || isnan(d.sunset))
            continue;
        check_horizon(&s, d.sunrise, true);
        check_horizon(&s, d.sunset, false);
        double once = d.sunset - d.sunrise + (d.sunset < d.sunrise ? 86400.0 : 0.0);
        two += d.length_h - once / 3600.0 > 1e-4;
        assert_true(d.length_h - once / 3600.0 > -1e-4 && d.length_h <= 24.0);
    }
    return two;
}

TEST(of_two_sunrises_the_first_of_two_sunsets_the_last_counts)
{
    assert_int_equal(dates_with_two(-5.0, 7), 1);
    assert_int_equal(dates_with_two(5.0, 6) + dates_with_two(5.0, 5), 1);
}

TEST(what_is_no_date_is_refused)
{
    const site s          = { 0 };
    const civil_time no[] = { { 2026, 2, 29, 0, 0, 0 },
                              { 2026, 13, 1, 0, 0, 0 },
                              { 2026, 0, 1, 0, 0, 0 },
                              { 1899, 12, 31, 0, 0, 0 },
                              { 2101, 1, 1, 0, 0, 0 },
                              { 2147483647, 2147483647, 1, 0, 0, 0 },
                              { 2026, 2147483647, -2147483647, 0, 0, 0 },
                              { 1970, 0, 1, 0, 0, 0 } };
    for (int i = 0; i < 8; i++) {
        sun_day d;
        lux_error err = { 0 };
        assert_false(sun_day_of(&s, NULL, &no[i], &d, &err));
        assert_int_equal(err.code, ERR_ARGUMENT);
    }
    sun_day d;
    const site nowhere = { 91.0, 0.0, 0.0 };
    assert_false(
        sun_day_of(&nowhere, NULL, &(civil_time){ .year = 2026, .month = 1, .day = 1 }, &d, NULL));
    assert_true(sun_on(&s, "-12:00", 2100, 12, 31).length_h > 12.0);
    assert_true(sun_on(&s, "+14:00", 1900, 1, 1).length_h > 12.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(length_is_the_time_that_it_is_up_near_polar_day),
        cmocka_unit_test(nights_of_minutes_are_found),
        cmocka_unit_test(sunrise_and_sunset_cross_the_horizon_within_a_second),
        cmocka_unit_test(days_of_23_and_25_hours_are_as_long),
        cmocka_unit_test(a_date_without_midnight_begins_when_clocks_show_it),
        cmocka_unit_test(dates_are_those_of_the_zone),
        cmocka_unit_test(a_sunset_may_come_first_and_a_transit_be_missing),
        cmocka_unit_test(of_two_sunrises_the_first_of_two_sunsets_the_last_counts),
        cmocka_unit_test(what_is_no_date_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
