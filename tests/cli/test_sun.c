/* tests/cli/test_sun.c -- lux4 sun: published places and times, clocks, tables, wrong words. */
#include "tests/folder.h"
#include "tests/program.h"
#include "tests/test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MOSCOW "--place", "55.7558N 37.6173E", "--zone", "Europe/Moscow"
#define SYDNEY "--place", "33.87S 151.22E", "--zone", "Australia/Sydney"
#define BERLIN "--place", "52.52N 13.405E", "--zone", "Europe/Berlin"
#define TROMSO "--place", "69.65N 18.96E", "--zone", "Europe/Oslo"

static void assert_says(const char *text, const char *what)
{
    if (!strstr(text, what))
        fail_msg("nothing of `%s` in:\n%s", what, text);
}

static void assert_json(const char *out, const char *path, const char *value)
{
    const char *at = json_at(out, path);
    if (!at || strncmp(at, value, strlen(value)) != 0)
        fail_msg("%s is %.40s, not %s", path, at ? at : "(none)", value);
}

/* A number of the answer, within an absolute error. */
static void assert_number(const program_result *r, const char *path, double want, double within)
{
    double got = json_number_at(r->out, path);
    if (!(fabs(got - want) <= within))
        fail_msg("%s is %.9g, not %.9g within %g", path, got, want, within);
}

/* "2015-01-02T07:21:55-07:00": the seconds since midnight; and the date is this one. */
static double seconds_at(const char *out, const char *path, const char *date)
{
    int hour = 0, minute = 0, second = 0;
    const char *at = json_at(out, path);
    if (!at || strncmp(at + 1, date, 10) != 0 ||
        sscanf(at + 12, "%d:%d:%d", &hour, &minute, &second) < 2)
        fail_msg("%s is %.40s, no time on %s", path, at ? at : "(none)", date);
    return 3600.0 * hour + 60.0 * minute + second;
}

static int times(const char *text, const char *what)
{
    int count = 0;
    for (const char *c = strstr(text, what); c; c = strstr(c + 1, what))
        count++;
    return count;
}

/* ---- published values ------------------------------------------------------------------------ */

/* NREL/TP-560-34302 (Reda and Andreas 2004), the worked example; 0.001 degrees asked for. */
TEST(the_worked_example_of_nrel_is_met)
{
    program_result r = { 0 };
    LUX4(NULL, 0, &r, "sun", "--json", "--place", "39.742476 -105.1786", "--altitude", "1830.14",
         "--pressure", "820", "--temperature", "11", "--time", "2003-10-17T12:30:30-07:00");
    assert_string_equal(r.err, "");
    assert_true(json_is_valid(r.out));
    assert_json(r.out, "time", "\"2003-10-17T12:30:30-07:00\"");
    assert_number(&r, "azimuth_deg", 194.34024, 0.001);
    assert_number(&r, "elevation_deg", 90.0 - 50.12795, 0.001);
    assert_number(&r, "apparent_elevation_deg", 90.0 - 50.11162, 0.001);
    assert_number(&r, "declination_deg", -9.31434, 0.001);
    assert_number(&r, "equation_of_time_min", 14.64, 0.01);
    assert_number(&r, "distance_au", 0.9965422974, 1e-5);
    assert_number(&r, "diameter_deg", 0.534754, 1e-5); /* 2 * 695,700 km (IAU 2015), so far off */
    /* Apparent solar time is the hour angle, 11.10590 degrees, beyond noon: 12:44:25 */
    assert_json(r.out, "solar_time", "\"12:44:2");
    /* 900 hPa: pvlib's test_solarposition.py */
    LUX4(NULL, 0, &r, "sun", "--json", "--place", "39.742476 -105.1786", "--altitude=1830.14",
         "--pressure=900", "--temperature=11", "--time=2003-10-17T19:30:30Z");
    assert_number(&r, "apparent_elevation_deg", 90.0 - 50.11003, 0.001);
    assert_number(&r, "elevation_deg", 90.0 - 50.12795, 0.001);
    program_free(&r);
}

/* ladybug's tests (by NOAA's formulae, apparent) and astral's: reference.md 3.6. */
TEST(other_places_are_as_published)
{
    static const struct place {
        const char *place, *time;
        double elevation, azimuth, within;
    } places[] = {
        { "40.72 -74.02", "2017-09-15T16:00Z", 50.35, 159.72, 0.03 },
        { "40.72 -74.02", "2017-03-21T14:30Z", 36.90, 129.23, 0.03 },
        { "-33.87 151.22", "2017-11-15T01:00Z", 72.26, 32.37, 0.03 },
        { "-33.87 151.22", "2019-06-20T23:00Z", 18.99, 42.54, 0.03 },
        { "28.61 77.22", "2001-06-21T13:11Z", 7.41, 292.76, 0.1 },
    };
    program_result r = { 0 };
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        LUX4(NULL, 0, &r, "sun", "--json", "--place", places[i].place, "--time", places[i].time);
        assert_number(&r, "apparent_elevation_deg", places[i].elevation, places[i].within);
        assert_number(&r, "azimuth_deg", places[i].azimuth, places[i].within);
    }
    program_free(&r);
}

/* NREL's SPA web page (through pvlib's tests), to the second; it counts days of UT, so that a
 * sunset after 24h UT, given for August 2, is that of August 1 on clocks there. 0: not given. Ours
 * sees the sun from the ground and not from the Earth's centre: 8.8" lower, a second later or
 * earlier; and whole seconds. */
TEST(sunrise_and_sunset_are_as_published)
{
    static const struct day {
        const char *place, *zone, *date;
        double rise, transit, set; /* h min s as hhmmss */
    } days[] = {
        { "39.742476 -105.1786", "-07:00", "2015-01-02", 72155, 120445, 164743 },
        { "39.742476 -105.1786", "-07:00", "2015-08-02", 50027, 120658, 0 },
        { "39.742476 -105.1786", "-07:00", "2015-08-01", 0, 0, 191358 },
        { "-35 0", "UTC", "1996-07-05", 70815, 120436, 170104 },
        { "-35 0", "UTC", "2004-12-04", 43857, 115022, 190203 },
    };
    static const double SECONDS = 4.0;
    program_result r            = { 0 };
    for (size_t i = 0; i < sizeof days / sizeof *days; i++) {
        const struct day *d    = &days[i];
        const double clock[]   = { d->rise, d->transit, d->set };
        const char *const at[] = { "sunrise", "transit", "sunset" };
        LUX4(NULL, 0, &r, "sun", "--json", "--day", "--place", d->place, "--zone", d->zone,
             "--time", d->date);
        for (int k = 0; k < 3; k++) {
            int hms     = (int)clock[k];
            double want = hms / 10000 * 3600.0 + hms / 100 % 100 * 60.0 + hms % 100;
            double got  = seconds_at(r.out, at[k], d->date);
            if (hms && !(fabs(got - want) <= SECONDS))
                fail_msg("%s of %s at %s is %g s off", at[k], d->date, d->place, got - want);
        }
    }
    program_free(&r);
}

/* ---- a moment -------------------------------------------------------------------------------- */

TEST(a_moment_is_told_one_value_a_line)
{
    static const char *const lines[] = {
        "2026-06-21T10:00+03:00\n",
        "  UTC                               2026-06-21T07:00",
        "  place                             55.755800 N, 37.617300 E, 150 m\n",
        "  clocks                            Europe/Moscow\n",
        "  azimuth (deg)                     ",
        "  elevation, true (deg)             ",
        "  elevation, apparent (deg)         ",
        "  air                               995.36 hPa (standard), 20.0 C\n",
        "  declination (deg)                 23.4",
        "  equation of time (min)            -1.",
        "  solar time                        09:28:",
        "  distance (au)                     1.016",
        "  diameter (deg)                    0.524",
        "  direct normal illuminance (lx)    ",
        "  sunrise                           2026-06-21T03:45+03:00\n",
        "  transit                           2026-06-21T12:31+03:00  57.6",
        "  sunset                            2026-06-21T21:18+03:00\n",
        "  day length                        17 h 34 min\n",
        "Direct normal illuminance: clear sky, ",
        "turbidity 3",
        "UT1 is taken as UTC",
    };
    program_result r = { 0 };
    LUX4(NULL, 0, &r, "sun", MOSCOW, "--time", "2026-06-21T10:00", "--altitude", "150",
         "--temperature", "20");
    assert_string_equal(r.err, "");
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++)
        assert_says(r.out, lines[i]);
    assert_null(strstr(r.out, "below the horizon"));
    program_free(&r);
}

TEST(the_sun_below_the_horizon_is_said)
{
    program_result r = { 0 };
    LUX4(NULL, 0, &r, "sun", MOSCOW, "--time", "2026-12-21T22:00");
    assert_says(r.out, "2026-12-21T22:00+03:00: the sun is below the horizon\n");
    assert_says(r.out, "direct normal illuminance (lx)    0\n");
    LUX4(NULL, 0, &r, "sun", MOSCOW, "--time", "2026-12-21T22:00", "--json");
    assert_number(&r, "direct_normal_lx", 0.0, 0.0);
    LUX4(NULL, 0, &r, "sun", MOSCOW, "--time", "2026-06-21T03:45");
    assert_says(r.out, ": the sun is on the horizon, part of its disk up\n");
    program_free(&r);
}

TEST(polar_day_and_night_are_said_in_words)
{
    program_result r = { 0 };
    LUX4(NULL, 0, &r, "sun", TROMSO, "--time", "2026-06-21T12:00");
    assert_says(r.out, "none: the sun is up all day (polar day)\n");
    assert_says(r.out, "day length                        24 h 00 min\n");
    LUX4(NULL, 0, &r, "sun", TROMSO, "--time", "2026-12-21T12:00");
    assert_says(r.out, "none: the sun stays down all day (polar night)\n");
    assert_says(r.out, "day length                        0 h 00 min\n");
    LUX4(NULL, 0, &r, "sun", TROMSO, "--time", "2026-12-21T12:00", "--json");
    assert_true(json_is_valid(r.out));
    assert_json(r.out, "sunrise", "null");
    assert_json(r.out, "sunset", "null");
    assert_json(r.out, "always_down", "true");
    assert_number(&r, "day_length_h", 0.0, 0.0);
    seconds_at(r.out, "transit", "2026-12-21");
    program_free(&r);
}

/* There true elevation is the declination, less the parallax of 8.8" cos(23.4 degrees). */
TEST(at_the_poles_the_sun_stands_as_high_as_its_declination)
{
    program_result r = { 0 };
    LUX4(NULL, 0, &r, "sun", "--place", "90N 0E", "--time", "2026-06-21T10:00Z", "--json");
    assert_number(&r, "elevation_deg", json_number_at(r.out, "declination_deg") - 0.00224, 1e-4);
    LUX4(NULL, 0, &r, "sun", "--place", "90S 0E", "--time", "2026-06-21T10:00Z", "--json");
    assert_number(&r, "elevation_deg", -json_number_at(r.out, "declination_deg") - 0.00224, 1e-4);
    assert_json(r.out, "always_down", "true");
    program_free(&r);
}

TEST(air_bends_and_haze_dims)
{
    program_result r = { 0 };
    LUX4(NULL, 0, &r, "sun", MOSCOW, "--time", "2026-06-21T05:00", "--json", "--pressure", "0");
    double true_deg = json_number_at(r.out, "elevation_deg");
    double clear    = json_number_at(r.out, "direct_normal_lx");
    assert_number(&r, "apparent_elevation_deg", true_deg, 1e-9);
    LUX4(NULL, 0, &r, "sun", MOSCOW, "--time", "2026-06-21T05:00", "--json");
    assert_number(&r, "elevation_deg", true_deg, 1e-9);
    assert_true(json_number_at(r.out, "apparent_elevation_deg") > true_deg + 0.05);
    LUX4(NULL, 0, &r, "sun", MOSCOW, "--time", "2026-06-21T05:00", "--json", "--turbidity", "6",
         "--pressure", "0");
    assert_true(json_number_at(r.out, "direct_normal_lx") < 0.8 * clear);
    assert_number(&r, "turbidity", 6.0, 0.0);
    program_free(&r);
}

/* The same point in decimal degrees, in degrees, minutes and seconds, in UTM and in MGRS. */
TEST(places_are_read_in_any_notation)
{
    static const char *const places[] = { "40.446195, -79.948862", "40:26:46.302N 79:56:55.903W",
                                          "17N 589138 4477813", "17TNE8913877813" };
    program_result r                  = { 0 };
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        LUX4(NULL, 0, &r, "sun", "--place", places[i], "--time", "2026-06-21T10:00-04:00",
             "--json");
        assert_number(&r, "latitude_deg", 40.446195, 3e-5); /* 1 m is 1e-5 degrees */
        assert_number(&r, "longitude_deg", -79.948862, 3e-5);
    }
    program_free(&r);
}

/* ---- zones and clocks ------------------------------------------------------------------------ */

TEST(half_hour_zones_and_the_date_line_are_right)
{
    static const char *const same[][2] = {
        { "Asia/Kolkata", "2026-06-21T15:30" },
        { "Asia/Kathmandu", "2026-06-21T15:45" },
        { "+05:30", "2026-06-21T15:30" },
        { "Pacific/Kiritimati", "2026-06-22T00:00" },
        { "Pacific/Pago_Pago", "2026-06-20T23:00" },
        { "UTC", "2026-06-21T10:00" },
        { "Australia/Lord_Howe", "2026-06-21T20:30" },
    };
    program_result r = { 0 };
    double azimuth   = 0.0;
    for (size_t i = 0; i < sizeof same / sizeof *same; i++) {
        LUX4(NULL, 0, &r, "sun", "--place", "28.61 77.22", "--zone", same[i][0], "--time",
             same[i][1], "--json");
        azimuth = i ? azimuth : json_number_at(r.out, "azimuth_deg");
        assert_number(&r, "azimuth_deg", azimuth, 0.0);
        assert_memory_equal(json_at(r.out, "time") + 1, same[i][1], 16);
    }
    /* A time with an offset of its own is shown as clocks of the zone have it */
    LUX4(NULL, 0, &r, "sun", "--place", "28.61 77.22", "--zone", "Asia/Kolkata", "--time",
         "2026-06-21T10:00Z", "--json");
    assert_json(r.out, "time", "\"2026-06-21T15:30+05:30\"");
    program_free(&r);
}

/* Samoa went over the date line: 2011-12-30 was no day there. */
TEST(a_day_that_clocks_left_out_is_none)
{
    program_result r = { 0 };
    LUX4_FAILS(NULL, 2, "2011-12-30", "sun", "--place", "13.83S 171.77W", "--zone", "Pacific/Apia",
               "--day", "--time", "2011-12-30");
    LUX4(NULL, 0, &r, "sun", "--place", "13.83S 171.77W", "--zone", "Pacific/Apia", "--year",
         "--time", "2011", "--json");
    assert_json(r.out, "days.362.date", "\"2011-12-29\"");
    assert_json(r.out, "days.363.date", "\"2011-12-31\"");
    assert_null(json_at(r.out, "days.364"));
    program_free(&r);
}

TEST(a_time_that_clocks_skip_or_repeat_shows_both_readings)
{
    static const char *const times[][3] = {
        { "2026-03-29T02:30", "2026-03-29T02:00+01:00", "2026-03-29T03:00+02:00" },
        { "2026-10-25T02:30", "2026-10-25T02:30+02:00", "2026-10-25T02:30+01:00" },
    };
    for (int i = 0; i < 2; i++) {
        LUX4_FAILS(NULL, 2, times[i][1], "sun", BERLIN, "--time", times[i][0]);
        LUX4_FAILS(NULL, 2, times[i][2], "sun", BERLIN, "--time", times[i][0]);
    }
}

TEST(days_of_23_and_25_hours_have_as_many)
{
    program_result r = { 0 };
    LUX4(NULL, 0, &r, "sun", BERLIN, "--day", "--time", "2026-03-29", "--json");
    assert_json(r.out, "hours.1.time", "\"2026-03-29T01:00+01:00\"");
    assert_json(r.out, "hours.2.time", "\"2026-03-29T03:00+02:00\"");
    assert_non_null(json_at(r.out, "hours.22"));
    assert_null(json_at(r.out, "hours.23"));
    LUX4(NULL, 0, &r, "sun", BERLIN, "--day", "--time", "2026-10-25", "--json");
    assert_json(r.out, "hours.2.time", "\"2026-10-25T02:00+02:00\"");
    assert_json(r.out, "hours.3.time", "\"2026-10-25T02:00+01:00\"");
    assert_non_null(json_at(r.out, "hours.24"));
    assert_null(json_at(r.out, "hours.25"));
    LUX4(NULL, 0, &r, "sun", SYDNEY, "--day", "--time", "2026-04-05");
    assert_int_equal(times(r.out, "\n  02:00+1"), 2);
    program_free(&r);
}

/* ---- tables ---------------------------------------------------------------------------------- */

TEST(a_day_has_a_row_an_hour)
{
    program_result r = { 0 };
    LUX4(NULL, 0, &r, "sun", SYDNEY, "--day", "--time", "2026-12-21");
    assert_string_equal(r.err, "");
    assert_says(r.out, "2026-12-21\n");
    assert_int_equal(times(r.out, ":00+11:00  "), 24);
    assert_says(r.out, "\n  00:00+11:00    194.");
    assert_says(r.out, "  sunrise                           2026-12-21T05:4");
    assert_int_equal(times(r.out, "       -\n"), 9); /* hours of night */
    /* A row is what the moment is */
    program_result at = { 0 };
    LUX4(NULL, 0, &r, "sun", SYDNEY, "--day", "--time", "2026-12-21", "--json");
    LUX4(NULL, 0, &at, "sun", SYDNEY, "--time", "2026-12-21T13:00", "--json");
    assert_true(json_is_valid(r.out));
    assert_json(r.out, "hours.13.time", "\"2026-12-21T13:00+11:00\"");
    assert_number(&r, "hours.13.azimuth_deg", json_number_at(at.out, "azimuth_deg"), 1e-5);
    assert_number(&r, "hours.13.elevation_deg", json_number_at(at.out, "elevation_deg"), 1e-5);
    assert_number(&r, "day_length_h", json_number_at(at.out, "day_length_h"), 1e-9);
    program_free(&r);
    program_free(&at);
}

TEST(a_year_has_a_row_a_day)
{
    program_result r = { 0 };
    LUX4(NULL, 0, &r, "sun", TROMSO, "--year", "--time", "2026");
    assert_string_equal(r.err, "");
    assert_int_equal(times(r.out, "\n  2026-"), 365);
    assert_int_equal(times(r.out, "\n  date "), 12);
    assert_says(r.out, "\n  2026-06-21  up all day   12:4");
    assert_says(r.out, "  up all day   24 h 00 min ");
    assert_says(r.out, "\n  2026-12-21  down         11:4");
    assert_says(r.out, "  down          0 h 00 min ");
    LUX4(NULL, 0, &r, "sun", MOSCOW, "--year", "--time", "2024-07-01", "--json");
    assert_true(json_is_valid(r.out));
    assert_number(&r, "year", 2024.0, 0.0);
    assert_json(r.out, "days.59.date", "\"2024-02-29\"");
    assert_json(r.out, "days.365.date", "\"2024-12-31\"");
    assert_null(json_at(r.out, "days.366"));
    seconds_at(r.out, "days.59.sunrise", "2024-02-29");
    program_free(&r);
}

/* Moscow's longest day: 57.69 degrees, 90 - 55.7558 + 23.44, less 8.8" cos h. */
TEST(noon_of_midsummer_is_latitude_and_obliquity)
{
    program_result r = { 0 };
    LUX4(NULL, 0, &r, "sun", MOSCOW, "--year", "--time", "2026", "--json");
    assert_number(&r, "days.171.transit_elevation_deg", 90.0 - 55.7558 + 23.436 - 0.0013, 0.002);
    program_free(&r);
}

/* Clocks are up to 14 h ahead of UTC, and 12 h behind. */
TEST(the_first_and_the_last_day_are_there_on_all_clocks)
{
    static const char *const days[][2] = { { "+14:00", "1900-01-01" },
                                           { "-12:00", "1900-01-01" },
                                           { "+14:00", "2100-12-31" },
                                           { "-12:00", "2100-12-31" } };
    char *folder                       = folder_new();
    program_result r                   = { 0 };
    for (int i = 0; i < 4; i++) {
        LUX4(folder, 0, &r, "sun", "--place", "0 0", "--zone", days[i][0], "--day", "--time",
             days[i][1], "--plot", "edge.svg", "--overwrite");
        assert_int_equal(times(r.out, i % 2 ? "-12:00  " : "+14:00  "), 25);
    }
    LUX4_FAILS(NULL, 2, "1900", "sun", "--place", "0 0", "--time", "1899-12-30T10:00Z");
    LUX4_FAILS(NULL, 2, "2100", "sun", "--place", "0 0", "--time", "2101-01-02T10:00Z");
    LUX4_FAILS(NULL, 2, "1900", "sun", "--place", "0 0", "--zone", "UTC", "--year", "--time",
               "1899");
    program_free(&r);
    folder_free(folder);
}

/* ---- wrong words ----------------------------------------------------------------------------- */

#define SUN_FAILS(says, ...) LUX4_FAILS(NULL, 2, says, "sun", __VA_ARGS__)

TEST(what_is_missing_is_asked_for)
{
    SUN_FAILS("--place: where?", "--time", "2026-06-21T10:00Z");
    SUN_FAILS("--time: which date and time? (--time 2026-06-21T10:00)", MOSCOW);
    SUN_FAILS("--time: which date?", MOSCOW, "--day");
    SUN_FAILS("--time: which year?", MOSCOW, "--year");
    SUN_FAILS("expected a time of day, too (2026-06-21T10:00)", MOSCOW, "--time", "2026-06-21");
    SUN_FAILS("--time 2026: expected a date and time", MOSCOW, "--time", "2026");
    SUN_FAILS("--time 2026: expected a date, ", MOSCOW, "--day", "--time", "2026");
    SUN_FAILS("--zone: whose clocks?", "--place", "0 0", "--time", "2026-06-21T10:00");
    SUN_FAILS("--zone: whose clocks?", "--place", "0 0", "--time", "2026", "--year");
    SUN_FAILS("one of them at a time", MOSCOW, "--time", "2026-06-21", "--day", "--year");
    SUN_FAILS("37.6E: lux4 sun takes options alone", "--place", "55.7N", "37.6E", "--time",
              "2026-06-21T10:00Z");
}

TEST(wrong_values_are_refused)
{
    static const char *const values[][3] = {
        { "--altitude", "high", "metres from -500 to 9000" },
        { "--altitude", "9001", "metres from -500 to 9000" },
        { "--altitude", "-501", "metres from -500 to 9000" },
        { "--altitude", "", "metres from -500 to 9000" },
        { "--pressure", "-1", "hPa from 0 to 1200" },
        { "--pressure", "101325", "hPa from 0 to 1200" },
        { "--pressure", "nan", "hPa from 0 to 1200" },
        { "--temperature", "71", "degrees Celsius from -100 to 70" },
        { "--temperature", "15C", "degrees Celsius from -100 to 70" },
        { "--turbidity", "0.9", "from 1 to 20" },
        { "--turbidity", "21", "from 1 to 20" },
        { "--zone", "Europe/Moskow", "Europe/Moscow" },
        { "--zone", "", "--zone: " },
        { "--zone", "+25:00", "+25:00" },
        { "--place", "", "--place: " },
        { "--place", "Moscow", "Moscow" },
        { "--place", "91N 0E", "91N 0E" },
        { "--place", "nan nan", "nan nan" },
        { "--time", "", "--time: " },
        { "--time", "now", "now" },
        { "--time", "2026-02-29T10:00", "2026-02-29" },
        { "--time", "2026-06-21T24:00", "24:00" },
        { "--time", "2016-12-31T23:59:60Z", "leap second" },
        { "--time", "21.06.2026", "21.06.2026" },
    };
    for (size_t i = 0; i < sizeof values / sizeof *values; i++)
        SUN_FAILS(values[i][2], MOSCOW, "--time", "2026-06-21T10:00", values[i][0], values[i][1]);
    SUN_FAILS("--altitude: expected M behind it", MOSCOW, "--altitude");
    SUN_FAILS("--day takes no value", MOSCOW, "--day=2026-06-21");
    SUN_FAILS("--plot x.png: expected a file *.svg", MOSCOW, "--time", "2026-06-21T10:00", "--plot",
              "x.png");
    SUN_FAILS("--write has no meaning", MOSCOW, "--write", "x");
    LUX4_FAILS(NULL, 2, "--place has no meaning", "grid", "none.yaml", "--place", "0 0");
    /* Elsewhere --time is seconds still */
    LUX4_FAILS(NULL, 2, "--time 2026-06-21: expected seconds", "grid", "none.yaml", "--time",
               "2026-06-21");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_worked_example_of_nrel_is_met),
        cmocka_unit_test(other_places_are_as_published),
        cmocka_unit_test(sunrise_and_sunset_are_as_published),
        cmocka_unit_test(a_moment_is_told_one_value_a_line),
        cmocka_unit_test(the_sun_below_the_horizon_is_said),
        cmocka_unit_test(polar_day_and_night_are_said_in_words),
        cmocka_unit_test(at_the_poles_the_sun_stands_as_high_as_its_declination),
        cmocka_unit_test(air_bends_and_haze_dims),
        cmocka_unit_test(places_are_read_in_any_notation),
        cmocka_unit_test(half_hour_zones_and_the_date_line_are_right),
        cmocka_unit_test(a_day_that_clocks_left_out_is_none),
        cmocka_unit_test(a_time_that_clocks_skip_or_repeat_shows_both_readings),
        cmocka_unit_test(days_of_23_and_25_hours_have_as_many),
        cmocka_unit_test(a_day_has_a_row_an_hour),
        cmocka_unit_test(a_year_has_a_row_a_day),
        cmocka_unit_test(noon_of_midsummer_is_latitude_and_obliquity),
        cmocka_unit_test(the_first_and_the_last_day_are_there_on_all_clocks),
        cmocka_unit_test(what_is_missing_is_asked_for),
        cmocka_unit_test(wrong_values_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
