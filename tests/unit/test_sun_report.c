/* tests/unit/test_sun_report.c -- air, offsets, places and times as lux4 sun prints them. */
#include "sim/sun_print.h"

#include "tests/test.h"

/* ISO 2533:1975, table 1 (geopotential altitude). */
TEST(air_is_that_of_the_standard_atmosphere)
{
    static const struct {
        double altitude_m, pressure_hpa, temperature_c;
    } rows[] = {
        { -500.0, 1074.78, 18.25 }, { 0.0, 1013.25, 15.0 },     { 1000.0, 898.746, 8.5 },
        { 3000.0, 701.085, -4.5 },  { 5000.0, 540.199, -17.5 }, { 9000.0, 307.425, -43.5 }
    };
    static const sun_air none = { (double)NAN, (double)NAN };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        sun_air air = sun_air_standard(rows[i].altitude_m, &none);
        assert_near(air.pressure_hpa, rows[i].pressure_hpa, 1e-5);
        assert_near(air.temperature_c, rows[i].temperature_c, 1e-9);
    }
}

TEST(air_that_is_given_is_kept)
{
    sun_air cold = sun_air_standard(1000.0, &(sun_air){ (double)NAN, -20.0 });
    assert_near(cold.pressure_hpa, 898.746, 1e-5);
    assert_near(cold.temperature_c, -20.0, 0.0);
    sun_air none = sun_air_standard(1000.0, &(sun_air){ 0.0, (double)NAN });
    assert_near(none.pressure_hpa, 0.0, 0.0);
    assert_near(none.temperature_c, 8.5, 1e-9);
}

TEST(offsets_are_written_as_iso_8601_has_them)
{
    static const struct {
        int offset;
        const char *text;
    } offsets[] = { { 0, "+00:00" },       { 10800, "+03:00" },    { -12600, "-03:30" },
                    { 20700, "+05:45" },   { -1800, "-00:30" },    { 50400, "+14:00" },
                    { 9017, "+02:30:17" }, { -17762, "-04:56:02" } };
    for (size_t i = 0; i < sizeof offsets / sizeof *offsets; i++) {
        char text[SUN_OFFSET_TEXT];
        sun_offset_print(text, offsets[i].offset);
        assert_string_equal(text, offsets[i].text);
    }
}

TEST(places_are_written_with_their_sides)
{
    char text[SUN_SITE_TEXT];
    sun_site_print(text, &(site){ .latitude_deg = 55.7558, .longitude_deg = 37.6173 });
    assert_string_equal(text, "55.755800 N, 37.617300 E");
    sun_site_print(text, &(site){ .latitude_deg = -90.0, .longitude_deg = -180.0 });
    assert_string_equal(text, "90.000000 S, 180.000000 W");
}

TEST(hours_are_written_to_the_second_and_never_as_24)
{
    char text[SUN_HOURS_TEXT];
    sun_hours_print(text, 12.5 + 1.0 / 3600.0);
    assert_string_equal(text, "12:30:01");
    sun_hours_print(text, 23.99999);
    assert_string_equal(text, "00:00:00");
}

/* Half of the disk is 0.266 degrees. */
TEST(the_disk_is_down_cut_or_up)
{
    sun_place s = { .diameter_deg = 0.532, .apparent_elevation_deg = -0.27 };
    assert_int_equal(sun_height_of(&s), SUN_BELOW);
    s.apparent_elevation_deg = -0.26;
    assert_int_equal(sun_height_of(&s), SUN_ON_HORIZON);
    s.apparent_elevation_deg = 0.26;
    assert_int_equal(sun_height_of(&s), SUN_ON_HORIZON);
    s.apparent_elevation_deg = 0.27;
    assert_int_equal(sun_height_of(&s), SUN_UP);
}

TEST(minutes_are_the_nearest_ones)
{
    char text[SUN_CLOCK_TEXT];
    lux_error err          = { 0 };
    arena a                = { 0 };
    const clock_zone *zone = clock_zone_new(&a, "+05:30", &err);
    double ten             = clock_from_civil(&(civil_time){ 2026, 6, 21, 10, 0, 0.0 });
    sun_clock_print(text, zone, ten + 29.9);
    assert_string_equal(text, "15:30+05:30");
    sun_clock_print(text, zone, ten + 30.1);
    assert_string_equal(text, "15:31+05:30");
    arena_clear(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(air_is_that_of_the_standard_atmosphere),
        cmocka_unit_test(air_that_is_given_is_kept),
        cmocka_unit_test(offsets_are_written_as_iso_8601_has_them),
        cmocka_unit_test(places_are_written_with_their_sides),
        cmocka_unit_test(hours_are_written_to_the_second_and_never_as_24),
        cmocka_unit_test(the_disk_is_down_cut_or_up),
        cmocka_unit_test(minutes_are_the_nearest_ones),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
