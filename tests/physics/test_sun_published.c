/* tests/physics/test_sun_published.c -- where others say that the sun is.
 *
 * NREL SPA: I. Reda, A. Andreas, NREL/TP-560-34302, with its worked example, and what its program
 * and ports of it give. They take delta T = 67 s for 2003, where it was 64.2, which moves the sun
 * by 0.00003 degrees; leave out diurnal aberration, up to 0.0001; and promise 0.0003.
 */
#include "tests/moment.h"

#include <stdio.h>

typedef struct published {
    site place;
    const char *moment;
    sun_air air;
    double zenith_deg, azimuth_deg; /* apparent where there is air; NAN: not given */
    double tolerance_deg;
} published;

#define GOLDEN                                                                                     \
    {                                                                                              \
        39.742476, -105.1786, 1830.14                                                              \
    }
#define NO_AIR                                                                                     \
    {                                                                                              \
        0.0, 0.0                                                                                   \
    }
#define USUAL                                                                                      \
    {                                                                                              \
        1010.0, 10.0                                                                               \
    }

static const double SPA = 0.0002;

static void check(const published *p)
{
    sun_place got;
    lux_error err = { 0 };
    if (!sun_at(&p->place, &p->air, moment_of(p->moment), &got, &err))
        fail_msg("%s", err.text);
    double zenith = 90.0 - got.apparent_elevation_deg;
    double high   = isnan(p->zenith_deg) ? zenith : p->zenith_deg;
    double off    = sky_angle_deg(got.azimuth_deg, 90.0 - zenith, p->azimuth_deg, 90.0 - high);
    if (!(off <= p->tolerance_deg))
        fail_msg("%s at %g %g: zenith %.6f, azimuth %.6f, off by %.6f", p->moment,
                 p->place.latitude_deg, p->place.longitude_deg, zenith, got.azimuth_deg, off);
}

TEST(it_is_where_nrel_says)
{
    const published all[] = {
        { GOLDEN, "2003-10-17T19:30:30Z", { 820, 11 }, 50.11162, 194.34024, SPA },
        { GOLDEN, "2003-10-17T19:30:30Z", NO_AIR, 50.12795, 194.34024, SPA },
        { GOLDEN, "2003-10-17T19:30:30Z", { 900, 11 }, 50.11003, 194.34024, SPA },
        { GOLDEN, "2003-10-18T19:30:30Z", { 820, 11 }, 50.47826, 194.311132, SPA },
        { { 40, -80, 0 }, "2019-01-01T00:00Z", NO_AIR, (double)NAN, 257.26969, SPA },
        { { -3.107, -60.025, 100 }, "2015-06-12T13:34:11Z", { 1000, 20 }, 44.1425, 51.608, SPA },
        { { 52.509663, 13.376481, 0 },
          "2015-06-28T17:45:12Z",
          { 1000, 20 },
          76.799924,
          291.232854,
          SPA },
        /* with delta T = 0: 67 s of the sun's 0.041" a second */
        { { -41, 0, 100 }, "2012-12-22T12:00Z", { 1000, 20 }, 17.5658, 359.08592, 0.001 },
        { { -3, 0, 100 }, "2012-12-22T12:00Z", { 1000, 20 }, 20.4285, 180.790356, 0.001 },
    };
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        check(&all[i]);
}

/* NOAA's formulae, good to 0.01 degrees and printed with two digits (reference: ladybug's and
 * astral's tests). */
TEST(it_is_where_noaa_says)
{
    const published all[] = {
        { { 40.72, -74.02, 0 }, "2017-09-15T16:00Z", USUAL, 90 - 50.35, 159.72, 0.03 },
        { { 40.72, -74.02, 0 }, "2017-03-21T14:30Z", USUAL, 90 - 36.90, 129.23, 0.03 },
        { { -33.87, 151.22, 0 }, "2017-11-15T01:00Z", USUAL, 90 - 72.26, 32.37, 0.03 },
        { { -33.87, 151.22, 0 }, "2019-06-20T23:00Z", USUAL, 90 - 18.99, 42.54, 0.03 },
        { { 28.61, 77.22, 0 }, "2001-06-21T13:11Z", USUAL, 90 - 7.41, 292.76, 0.1 },
        { { 28.61, 77.22, 0 }, "2001-06-21T13:11Z", NO_AIR, 90 - 7.29, 292.76, 0.1 },
    };
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        check(&all[i]);
}

/* The steps of NREL's example that are ours, too. It gives the equation of time to 0.01 min. */
TEST(its_steps_are_those_of_nrels_example)
{
    const site s = GOLDEN;
    sun_place p;
    assert_true(sun_at(&s, NULL, moment_of("2003-10-17T12:30:30-07:00"), &p, NULL));
    assert_true(fabs(p.right_ascension_deg - 202.227408) < 5e-5);
    assert_true(fabs(p.declination_deg + 9.31434) < 5e-5);
    assert_true(fabs(p.hour_angle_deg - 11.10590) < 5e-5);
    assert_true(fabs(p.equation_of_time_min - 14.64) < 0.005);
    assert_true(fabs(p.distance_au - 0.9965422974) < 1e-6);
    assert_true(fabs(p.solar_time_h - (12.0 + 11.10590 / 15.0)) < 1e-5);
}

/* J. Meeus, Astronomical Algorithms, example 25.b by all of VSOP87; 0h of terrestrial time
 * is 59.184 s ahead of UTC. It has nutation of 1980: 0.05" between them, and it is rounded to
 * 0.01". */
TEST(it_is_where_meeus_says)
{
    sun_place p = sun_bare(0.0, 0.0, moment_of("1992-10-13T00:00Z") - 59.184);
    double ra = 15.0 * (13 + 13 / 60.0 + 30.749 / 3600.0), dec = -(7 + 47 / 60.0 + 1.74 / 3600.0);
    assert_true(fabs(p.right_ascension_deg - ra) < 0.1 / 3600.0);
    assert_true(fabs(p.declination_deg - dec) < 0.1 / 3600.0);
    assert_true(fabs(p.distance_au - 0.99760853) < 2e-7);
}

/* ---- sunrise, transit, sunset --------------------------------------------------------------- */

typedef struct published_day {
    site place;
    const char *zone;
    int year, month, day;
    const char *sunrise, *transit, *sunset; /* with seconds, or to the minute; NULL: not given */
    bool sunset_is_eve; /* NREL's program answers by dates of UTC: the sunset is the day before's */
} published_day;

/* Seconds that parallax, which almanacs leave out, puts off sunrise: 8.794" by the rate at which
 * the sun rises, 15" cos(lat) cos(dec) sin(hour angle). */
static double parallax_s(const site *s, double moment)
{
    const double radian = 180.0 / 3.14159265358979324;
    sun_place p         = sun_bare(s->latitude_deg, s->longitude_deg, moment);
    return 8.794 / (15.0 * cos(s->latitude_deg / radian) * cos(p.declination_deg / radian) *
                    fabs(sin(p.hour_angle_deg / radian)));
}

static double clock_seconds(const char *text)
{
    int h = 0, m = 0, s = 0;
    assert_true(sscanf(text, "%d:%d:%d", &h, &m, &s) >= 2);
    return h * 3600.0 + m * 60.0 + s;
}

/* later: how many parallaxes later than published */
static void check_time(const published_day *d, double got, const char *want, double later,
                       double tolerance_s)
{
    if (!want)
        return;
    double later_s = later * parallax_s(&d->place, got);
    arena a        = { 0 };
    civil_time t   = clock_local(clock_zone_new(&a, d->zone, NULL), got);
    double off     = t.hour * 3600.0 + t.minute * 60.0 + t.second - later_s - clock_seconds(want);
    arena_clear(&a);
    if (!(fabs(off) <= tolerance_s))
        fail_msg("%d-%02d-%02d at %g %g: off %s by %.2f s", d->year, d->month, d->day,
                 d->place.latitude_deg, d->place.longitude_deg, want, off);
}

static void check_day(const published_day *d, double tolerance_s)
{
    sun_day got = sun_on(&d->place, d->zone, d->year, d->month, d->day);
    check_time(d, got.sunrise, d->sunrise, 1.0, tolerance_s);
    check_time(d, got.transit, d->transit, 0.0, tolerance_s);
    if (d->sunset_is_eve)
        got = sun_on(&d->place, d->zone, d->year, d->month, d->day - 1);
    check_time(d, got.sunset, d->sunset, -1.0, tolerance_s);
}

/* Rounded to seconds, by three days' places interpolated. */
TEST(it_rises_and_sets_when_nrel_says)
{
    const published_day all[] = {
        { GOLDEN, "-07:00", 2003, 10, 17, "06:12:43", "11:46:04", "17:20:19", true },
        { GOLDEN, "-07:00", 2015, 1, 2, "07:21:55", "12:04:45", "16:47:43", false },
        { GOLDEN, "-07:00", 2015, 8, 2, "05:00:27", "12:06:58", "19:13:58", true },
        { { -35, 0, 0 }, "UTC", 1996, 7, 5, "07:08:15", "12:04:36", "17:01:04", false },
        { { -35, 0, 0 }, "UTC", 2004, 12, 4, "04:38:57", "11:50:22", "19:02:03", false },
        { { 35, 0, 0 }, "UTC", 1994, 1, 2, "07:08:12", NULL, "16:59:55", false },
    };
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        check_day(&all[i], 1.0);
}

/* Of ports of it, whose remarks name NOAA: near polar day, far east, and as clocks change. */
TEST(it_rises_and_sets_on_odd_days_as_ports_of_nrels_program_say)
{
    const site berlin         = { 52.33, 13.3, 0 };
    const published_day all[] = {
        { { 70.978056, 25.974722, 0 }, "+02:00", 2015, 6, 17, NULL, "12:16:55", NULL, false },
        { { -36.8406, 174.74, 0 }, "+12:00", 2015, 6, 17, NULL, NULL, "17:11:04", false },
        { { -36.8406, 174.74, 0 }, "+12:00", 2015, 6, 18, "07:32:45", NULL, NULL, false },
        { berlin, "Europe/Berlin", 2015, 10, 25, "06:49:00", "11:50:55", "16:52:02", false },
        { berlin, "Europe/Berlin", 2016, 3, 27, "06:52:19", "13:12:02", "19:32:49", false },
    };
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        check_day(&all[i], 4.0);
    assert_true(sun_on(&all[0].place, "+02:00", 2015, 6, 17).always_up);
}

/* The US Naval Observatory, to the minute. */
TEST(it_rises_and_sets_when_the_naval_observatory_says)
{
    const site boulder = { 39, -105, 0 }, beijing = { 39.917, 116.383, 0 };
    const published_day all[] = {
        { boulder, "-07:00", 2015, 1, 2, "07:19", NULL, "16:49", false },
        { boulder, "-07:00", 2015, 4, 2, "05:43", NULL, "18:24", false },
        { boulder, "-07:00", 2015, 8, 2, "05:01", NULL, "19:10", false },
        { boulder, "-07:00", 2015, 12, 2, "07:01", NULL, "16:38", false },
        { beijing, "+08:00", 2015, 1, 2, "07:36", NULL, "17:00", false },
        { beijing, "+08:00", 2015, 4, 2, "05:58", NULL, "18:39", false },
        { beijing, "+08:00", 2015, 8, 2, "05:13", NULL, "19:28", false },
        { beijing, "+08:00", 2015, 12, 2, "07:17", NULL, "16:50", false },
    };
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        check_day(&all[i], 31.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_is_where_nrel_says),
        cmocka_unit_test(it_is_where_noaa_says),
        cmocka_unit_test(its_steps_are_those_of_nrels_example),
        cmocka_unit_test(it_is_where_meeus_says),
        cmocka_unit_test(it_rises_and_sets_when_nrel_says),
        cmocka_unit_test(it_rises_and_sets_on_odd_days_as_ports_of_nrels_program_say),
        cmocka_unit_test(it_rises_and_sets_when_the_naval_observatory_says),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
