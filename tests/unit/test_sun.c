/* tests/unit/test_sun.c -- sky/sun.h: against ERFA without our short cuts, and by geometry. */
#include "sky/sun.h"
#include "tests/moment.h"

#include <erfa.h>
#include <string.h>

static const double RADIAN       = 180.0 / 3.14159265358979324;
static const double PARALLAX_DEG = 8.794148 / 3600.0; /* Earth's equatorial radius at 1 au */

/* ---- the twin: everything at the moment itself ---------------------------------------------- */

static sun_place twin(const site *s, double moment, double tt_less_ut)
{
    double ut = (moment - 946684800.0) / 86400.0, tt = ut + tt_less_ut / 86400.0;
    double axis[3][3], x, y, from_sun[2][3], from_centre[2][3], proper[3], turned[3], v[5];
    eraPnm06a(2451544.5, tt, axis);
    eraBpn2xy(axis, &x, &y);
    eraEpv00(2451544.5, tt, from_sun, from_centre);

    eraASTROM a;
    eraApco(2451544.5, tt, from_centre, from_sun[0], x, y, eraS06(2451544.5, tt, x, y),
            eraEra00(2451544.5, ut), s->longitude_deg / RADIAN, s->latitude_deg / RADIAN,
            s->altitude_m, 0, 0, 0, 0, 0, &a);
    double toward[3] = { -a.eh[0], -a.eh[1], -a.eh[2] }, ascension, declination;
    eraAb(toward, a.v, a.em, a.bm1, proper);
    eraRxp(a.bpn, proper, turned);
    eraC2s(turned, &ascension, &declination);
    eraAtioq(ascension, declination, &a, &v[0], &v[1], &v[2], &v[3], &v[4]);
    return (sun_place){ .azimuth_deg = v[0] * RADIAN, .elevation_deg = 90.0 - v[1] * RADIAN };
}

/* Nutation's curve between two days: 0.01", and that of Earth's path far less. */
TEST(interpolating_between_days_costs_nothing)
{
    const site s        = { 55.7558, 37.6173, 150.0 };
    const sun_air empty = { 0.0, 0.0 };
    sun_series series   = { 0 };
    for (double m = 1577836800.0; m < 1640995200.0; m += 86400.0 * 0.737) { /* 2020, 2021: 37 s */
        sun_place one, next, want = twin(&s, m, 69.184);
        lux_error err;
        assert_true(sun_at(&s, &empty, m, &one, &err));
        assert_true(sun_at_next(&series, &s, &empty, m, &next, &err));
        assert_memory_equal(&one, &next, sizeof one);
        double off =
            sky_angle_deg(one.azimuth_deg, one.elevation_deg, want.azimuth_deg, want.elevation_deg);
        if (!(off < 0.012 / 3600.0))
            fail_msg("%g seconds of arc", off * 3600.0);
    }
}

/* ---- geometry ------------------------------------------------------------------------------- */

/* sin(elevation) = sin(lat) sin(dec) + cos(lat) cos(dec) cos(hour angle), but for the parallax and
 * diurnal aberration. */
TEST(elevation_follows_from_hour_angle_and_declination)
{
    for (double lat = -90.0; lat <= 90.0; lat += 7.5)
        for (double m = 1.7e9; m < 1.73e9; m += 1234567.0) {
            sun_place p = sun_bare(lat, lat, m);
            double dec = p.declination_deg / RADIAN, h = p.hour_angle_deg / RADIAN;
            double sine     = sin(lat / RADIAN) * sin(dec) + cos(lat / RADIAN) * cos(dec) * cos(h);
            double off      = asin(sine) * RADIAN - p.elevation_deg;
            double parallax = PARALLAX_DEG * cos(p.elevation_deg / RADIAN) / p.distance_au;
            assert_true(fabs(off - parallax) < 1.2e-4); /* 0.32", and 1/149 of the parallax */
        }
}

TEST(at_noon_it_stands_as_high_as_latitude_and_declination_say)
{
    for (double lat = -80.0; lat <= 80.0; lat += 10.0) {
        const site s = { lat, 12.5, 0.0 };
        sun_day d    = sun_on(&s, "+01:00", 2026, 4, 20);
        sun_place p  = sun_bare(lat, 12.5, d.transit);
        double noon  = 90.0 - fabs(lat - p.declination_deg);
        assert_true(fabs(p.hour_angle_deg) < 1e-5 && fabs(p.solar_time_h - 12.0) < 1e-6);
        assert_true(fabs(d.transit_elevation_deg - noon) < PARALLAX_DEG + 2e-5);
        double azimuth = lat > p.declination_deg ? 180.0 : 0.0;
        double off     = fabs(remainder(p.azimuth_deg - azimuth, 360.0));
        assert_true(off * cos(p.elevation_deg / RADIAN) < 1.2e-4); /* diurnal aberration */
    }
}

/* The declination's drift of 0.4 degrees a day is what they may differ by. */
TEST(morning_mirrors_evening)
{
    const site s = { 48.0, 11.0, 0.0 };
    sun_day d    = sun_on(&s, "+01:00", 2026, 6, 21); /* the solstice: no drift */
    for (double h = 0.5; h < 10.0; h += 0.5) {
        sun_place a = sun_bare(48.0, 11.0, d.transit - h * 3600.0);
        sun_place b = sun_bare(48.0, 11.0, d.transit + h * 3600.0);
        assert_true(fabs(a.elevation_deg - b.elevation_deg) < 3e-3);
        assert_true(fabs(a.azimuth_deg + b.azimuth_deg - 360.0) < 5e-3);
    }
}

/* From the poles elevation is the declination, and azimuth the hour angle of the longitude. */
TEST(poles_have_the_directions_of_their_longitude)
{
    for (double m = 1.78e9; m < 1.8e9; m += 987654.0) {
        sun_place n = sun_bare(90.0, 30.0, m), s = sun_bare(-90.0, 30.0, m);
        assert_true(fabs(n.elevation_deg - n.declination_deg) < PARALLAX_DEG * 1.02);
        assert_true(fabs(s.elevation_deg + s.declination_deg) < PARALLAX_DEG * 1.02);
        assert_true(fabs(remainder(n.azimuth_deg - 180.0 - n.hour_angle_deg, 360.0)) < 1e-4);
        assert_true(fabs(remainder(s.azimuth_deg + s.hour_angle_deg, 360.0)) < 1e-4);
    }
}

TEST(both_sides_of_the_date_line_see_the_same)
{
    sun_place a = sun_bare(-17.0, 180.0, 1.78e9), b = sun_bare(-17.0, -180.0, 1.78e9);
    assert_true(sky_angle_deg(a.azimuth_deg, a.elevation_deg, b.azimuth_deg, b.elevation_deg) <
                1e-9);
    assert_true(fabs(remainder(a.solar_time_h - b.solar_time_h, 24.0)) < 1e-9);
    assert_true(fabs(a.equation_of_time_min - b.equation_of_time_min) < 1e-9);
}

/* Parallax grows by altitude over Earth's radius; so does diurnal aberration, by 4 % of that. */
TEST(altitude_lowers_it_by_its_parallax)
{
    const site low = { 10.0, 20.0, 0.0 }, high = { 10.0, 20.0, 9000.0 };
    const sun_air empty = { 0.0, 0.0 };
    double m            = moment_of("2026-03-20T07:00Z");
    sun_place a, b;
    lux_error err;
    assert_true(sun_at(&low, &empty, m, &a, &err) && sun_at(&high, &empty, m, &b, &err));
    double shift = PARALLAX_DEG * 9.0 / 6378.137 * cos(a.elevation_deg / RADIAN) / a.distance_au;
    assert_near(a.elevation_deg - b.elevation_deg, shift, 0.05);
}

/* In perihelion and aphelion: 1 -+ 0.0167 au. 2 asin(695700 km / 149597870.7 km) = 0.53290. */
TEST(the_disk_is_as_large_as_its_distance_says)
{
    sun_place near = sun_bare(0.0, 0.0, moment_of("2026-01-03T17:00Z"));
    sun_place far  = sun_bare(0.0, 0.0, moment_of("2026-07-06T17:00Z"));
    assert_true(fabs(near.distance_au - 0.98330) < 5e-5 && fabs(far.distance_au - 1.01664) < 5e-5);
    assert_near(near.diameter_deg, 0.532903 / near.distance_au, 1e-5);
    assert_near(far.diameter_deg, 0.532903 / far.distance_au, 1e-5);
}

/* ---- air ------------------------------------------------------------------------------------ */

static sun_place through(double pressure_hpa, double temperature_c, double altitude_m, double m)
{
    const site s      = { 0.0, 0.0, altitude_m };
    const sun_air air = { pressure_hpa, temperature_c };
    sun_place p;
    lux_error err = { 0 };
    if (!sun_at(&s, &air, m, &p, &err))
        fail_msg("%s", err.text);
    return p;
}

/* NREL/TP-560-34302, equation 42, written out at the equator for all hours of a day. */
TEST(air_lifts_it_as_nrel_says)
{
    double last = -90.0;
    for (double m = moment_of("2026-03-20T00:10Z"); m < moment_of("2026-03-20T12:00Z"); m += 60.0) {
        sun_place p = through(820.0, 11.0, 0.0, m);
        double e0 = p.elevation_deg, lift = 0.0;
        if (e0 >= -0.83337)
            lift = 820.0 / 1010.0 * 283.0 / 284.0 * 1.02 /
                   (60.0 * tan((e0 + 10.3 / (e0 + 5.11)) / RADIAN));
        assert_true(fabs(p.apparent_elevation_deg - fmin(90.0, e0 + lift)) < 1e-12);
        assert_true(p.apparent_elevation_deg > last && p.apparent_elevation_deg <= 90.0);
        last = p.apparent_elevation_deg;
    }
}

/* ISO 2533: 1013.25 hPa and 15 degrees at the sea, 701.21 hPa and -4.491 at 3000 m (geometric). */
TEST(air_is_that_of_the_standard_atmosphere_by_default)
{
    double m       = moment_of("2026-03-20T06:30Z");
    const double n = (double)NAN;
    sun_place low = through(n, n, 0.0, m), low_said = through(1013.25, 15.0, 0.0, m);
    sun_place high = through(n, n, 3000.0, m), high_said = through(701.21, -4.491, 3000.0, m);
    assert_near(low.apparent_elevation_deg, low_said.apparent_elevation_deg, 1e-12);
    assert_near(high.apparent_elevation_deg, high_said.apparent_elevation_deg, 1e-6);
    const site sea = { 0.0, 0.0, 0.0 };
    sun_place none;
    assert_true(sun_at(&sea, NULL, m, &none, NULL));
    assert_true(none.apparent_elevation_deg == low.apparent_elevation_deg);
}

/* ---- refusals ------------------------------------------------------------------------------- */

TEST(what_cannot_be_told_is_refused)
{
    const double n        = (double)NAN;
    const site place[]    = { { 90.1, 0, 0 }, { 0, 180.1, 0 }, { n, 0, 0 },    { 0, n, 0 },
                              { 0, 0, n },    { 0, 0, 9001 },  { 0, 0, -501 }, { 0, 0, 0 },
                              { 0, 0, 0 },    { 0, 0, 0 },     { 0, 0, 0 },    { 0, 0, 0 } };
    const sun_air air[12] = { [7]  = { -1, 0 },
                              [8]  = { 1201, 0 },
                              [9]  = { 1000, -101 },
                              [10] = { 1000, 71 },
                              [11] = { (double)INFINITY, 0 } };
    sun_place p;
    for (int i = 0; i < 12; i++) {
        lux_error err = { 0 };
        assert_false(sun_at(&place[i], &air[i], 0.0, &p, &err));
        assert_int_equal(err.code, ERR_ARGUMENT);
    }
    const site s          = { 0 };
    const double moment[] = { n, (double)INFINITY, -1e300, -2209075201.0, 4134067201.0 };
    for (int i = 0; i < 5; i++)
        assert_false(sun_at(&s, NULL, moment[i], &p, NULL));
    assert_true(sun_at(&s, NULL, moment_of("1900-01-01T00:00+14:00"), &p, NULL));
    assert_true(sun_at(&s, NULL, moment_of("2100-12-31T23:59-12:00"), &p, NULL));
}

/* ---- scenes --------------------------------------------------------------------------------- */

TEST(directions_turn_with_north)
{
    double d[3];
    const double want[][6] = { { 0, 0, 0, 0, 1, 0 },    { 90, 0, 0, 1, 0, 0 },
                               { 180, 0, 0, 0, -1, 0 }, { 0, 90, 0, 0, 0, 1 },
                               { 0, 0, 90, 1, 0, 0 },   { 90, 0, -90, 0, 1, 0 } };
    for (int i = 0; i < 6; i++) {
        sky_direction(want[i][0], want[i][1], want[i][2], d);
        for (int k = 0; k < 3; k++)
            assert_true(fabs(d[k] - want[i][3 + k]) < 1e-15);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(interpolating_between_days_costs_nothing),
        cmocka_unit_test(elevation_follows_from_hour_angle_and_declination),
        cmocka_unit_test(at_noon_it_stands_as_high_as_latitude_and_declination_say),
        cmocka_unit_test(morning_mirrors_evening),
        cmocka_unit_test(poles_have_the_directions_of_their_longitude),
        cmocka_unit_test(both_sides_of_the_date_line_see_the_same),
        cmocka_unit_test(altitude_lowers_it_by_its_parallax),
        cmocka_unit_test(the_disk_is_as_large_as_its_distance_says),
        cmocka_unit_test(air_lifts_it_as_nrel_says),
        cmocka_unit_test(air_is_that_of_the_standard_atmosphere_by_default),
        cmocka_unit_test(what_cannot_be_told_is_refused),
        cmocka_unit_test(directions_turn_with_north),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
