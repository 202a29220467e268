/* sky/sun.c -- see sun.h: the apparent topocentric place of the sun, by ERFA.
 *
 * Earth from VSOP2000 (eraEpv00: 0.005" for 1900 ... 2100), its axis from IAU 2006/2000A
 * (eraPnm06a, eraEors), aberration by the velocity of the place itself (eraAb; so eraApco switches
 * off the diurnal term of eraAtioq), parallax by the place on WGS84. ERFA's refraction, made for
 * zeniths under 80 degrees, is given 0; ours is that of NREL's SPA.
 *
 * Left out: UT1 is taken for UTC (at most 0.9 s, 0.004 degrees along the sun's daily path); polar
 * motion (0.0001 degrees); the sun's own motion while its light travels (0.01"). Where Earth is and
 * how its axis stands is known for 0h of each day and in between interpolated: positions by a
 * cubic, from their velocities, to 0.0002" (the moon swings Earth); the axis by a line, to 0.01"
 * (the fastest large term of nutation, 0.23" in 13.7 days: (2 pi / 13.7)^2 / 8 of it).
 */
#include "sky/sun.h"

#include "sky/sun_time.h"

#include <erfa.h>
#include <erfam.h>
#include <math.h>

static const double SUN_RADIUS_M = 695700e3; /* IAU 2015 resolution B3 */

static const double FIRST_MOMENT = -2209075200.0; /* 1899-12-31 */
static const double LAST_MOMENT  = 4134067200.0;  /* 2101-01-02 */

/* The same angle in [-180, 180) */
static double half_turn(double deg) { return deg - 360.0 * floor((deg + 180.0) / 360.0); }

/* ---- Earth ---------------------------------------------------------------------------------- */

/* JD 2451544.5 + day, of terrestrial time. */
static const sun_earth *earth_on(sun_series *series, int day)
{
    sun_earth *e = &series->at[day & 3];
    if (e->known && e->day == day)
        return e;
    double x, y;
    eraPnm06a(ERFA_DJ00 - 0.5, day, e->axis);
    eraBpn2xy(e->axis, &x, &y);
    e->locator = eraS06(ERFA_DJ00 - 0.5, day, x, y);
    eraEpv00(ERFA_DJ00 - 0.5, day, e->from_sun, e->from_centre);
    e->day   = day;
    e->known = true;
    return e;
}

/* Hermite's cubic through positions and velocities, a day apart. */
static void move(double out[2][3], const double a[2][3], const double b[2][3], double t)
{
    for (int i = 0; i < 3; i++) {
        double mean = b[0][i] - a[0][i];
        double c2   = 3.0 * mean - 2.0 * a[1][i] - b[1][i];
        double c3   = a[1][i] + b[1][i] - 2.0 * mean;
        out[0][i]   = a[0][i] + t * (a[1][i] + t * (c2 + t * c3));
        out[1][i]   = a[1][i] + t * (2.0 * c2 + t * 3.0 * c3);
    }
}

static void earth_at(sun_series *series, double tt, sun_earth *out)
{
    int day            = (int)floor(tt);
    double t           = tt - day;
    const sun_earth *a = earth_on(series, day), *b = earth_on(series, day + 1);
    move(out->from_sun, a->from_sun, b->from_sun, t);
    move(out->from_centre, a->from_centre, b->from_centre, t);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            out->axis[i][j] = a->axis[i][j] + t * (b->axis[i][j] - a->axis[i][j]);
    out->locator = a->locator + t * (b->locator - a->locator);
}

/* ---- the sun -------------------------------------------------------------------------------- */

/* Where an observer who moves sees the sun's centre, in the axes of `frame`. */
static void look(eraASTROM *o, double frame[3][3], double *longitude, double *latitude)
{
    double geometric[3] = { -o->eh[0], -o->eh[1], -o->eh[2] }, proper[3], turned[3];
    eraAb(geometric, o->v, o->em, o->bm1, proper);
    eraRxp(frame, proper, turned);
    eraC2s(turned, longitude, latitude);
}

/* From Earth's centre: declination, right ascension, and what follows from them. ut: days of UT1
 * since 2000-01-01. */
static void look_from_centre(sun_earth *e, const site *s, double ut, double tt, sun_place *out)
{
    eraASTROM centre;
    double ascension, declination;
    eraApcg(ERFA_DJ00 - 0.5, tt, e->from_centre, e->from_sun[0], &centre);
    look(&centre, e->axis, &ascension, &declination);

    double turned   = eraEra00(ERFA_DJ00 - 0.5, ut) - eraEors(e->axis, e->locator);
    double hour_deg = half_turn((turned - ascension) * ERFA_DR2D + s->longitude_deg);
    double mean_deg = 360.0 * (ut - floor(ut)) - 180.0 + s->longitude_deg;

    out->declination_deg      = declination * ERFA_DR2D;
    out->right_ascension_deg  = eraAnp(ascension) * ERFA_DR2D;
    out->hour_angle_deg       = hour_deg > -180.0 ? hour_deg : 180.0;
    out->equation_of_time_min = 4.0 * half_turn(hour_deg - mean_deg);
    out->solar_time_h         = fmod(12.0 + hour_deg / 15.0, 24.0);
    out->distance_au          = centre.em;
    out->diameter_deg         = 2.0 * ERFA_DR2D * asin(SUN_RADIUS_M / (centre.em * ERFA_DAU));
}

static void look_from_site(sun_earth *e, const site *s, double ut, double tt, sun_place *out)
{
    eraASTROM here;
    double x, y, ascension, declination, azimuth, zenith, unused[3];
    eraBpn2xy(e->axis, &x, &y);
    eraApco(ERFA_DJ00 - 0.5, tt, e->from_centre, e->from_sun[0], x, y, e->locator,
            eraEra00(ERFA_DJ00 - 0.5, ut), s->longitude_deg * ERFA_DD2R,
            s->latitude_deg * ERFA_DD2R, s->altitude_m, 0.0, 0.0, 0.0, 0.0, 0.0, &here);
    look(&here, here.bpn, &ascension, &declination);
    eraAtioq(ascension, declination, &here, &azimuth, &zenith, &unused[0], &unused[1], &unused[2]);

    double azimuth_deg = eraAnp(azimuth) * ERFA_DR2D;
    out->azimuth_deg   = azimuth_deg < 360.0 ? azimuth_deg : 0.0;
    out->elevation_deg = 90.0 - zenith * ERFA_DR2D;
}

/* ---- air ------------------------------------------------------------------------------------ */

/* ISO 2533, up to 11 km: a fall of 6.5 K a km of geopotential altitude from 15 degrees Celsius and
 * 1013.25 hPa; the exponent is g / (R 0.0065 K/m). */
static sun_air air_at(const site *s, const sun_air *given)
{
    double altitude = 6356766.0 * s->altitude_m / (6356766.0 + s->altitude_m);
    double kelvin   = 288.15 - 0.0065 * altitude;
    sun_air air     = given ? *given : (sun_air){ (double)NAN, (double)NAN };
    if (isnan(air.pressure_hpa))
        air.pressure_hpa = 1013.25 * pow(kelvin / 288.15, 9.80665 / (287.05287 * 0.0065));
    if (isnan(air.temperature_c))
        air.temperature_c = kelvin - 273.15;
    return air;
}

/* Reda and Andreas, NREL/TP-560-34302, equation 42: 0 below the elevation at which the upper limb
 * still shows. Degrees. */
static double refraction(double elevation_deg, const sun_air *air)
{
    if (elevation_deg < -(0.26667 + 0.5667))
        return 0.0;
    double bent = (elevation_deg + 10.3 / (elevation_deg + 5.11)) * ERFA_DD2R;
    return air->pressure_hpa / 1010.0 * 283.0 / (273.0 + air->temperature_c) * 1.02 /
           (60.0 * tan(bent));
}

/* ---- all of it ------------------------------------------------------------------------------ */

static bool within(double v, double least, double most) { return v >= least && v <= most; }

static bool site_is_one(const site *s, lux_error *err)
{
    if (!within(s->latitude_deg, -90.0, 90.0) || !within(s->longitude_deg, -180.0, 180.0))
        return failed(err, ERR_ARGUMENT,
                      "latitude %g, longitude %g: -90 to 90 and -180 to 180 are expected",
                      s->latitude_deg, s->longitude_deg);
    if (!within(s->altitude_m, -500.0, 9000.0))
        return failed(err, ERR_ARGUMENT, "altitude %g m: -500 to 9000 is expected", s->altitude_m);
    return true;
}

static bool air_is_one(const sun_air *air, lux_error *err)
{
    if (!within(air->pressure_hpa, 0.0, 1200.0))
        return failed(err, ERR_ARGUMENT, "pressure %g hPa: 0 to 1200 is expected",
                      air->pressure_hpa);
    if (!within(air->temperature_c, -100.0, 70.0))
        return failed(err, ERR_ARGUMENT, "temperature %g C: -100 to 70 is expected",
                      air->temperature_c);
    return true;
}

bool sun_at_next(sun_series *series, const site *s, const sun_air *air, double moment,
                 sun_place *out, lux_error *err)
{
    if (!site_is_one(s, err))
        return false;
    sun_air here = air_at(s, air);
    if (!air_is_one(&here, err))
        return false;
    if (!within(moment, FIRST_MOMENT, LAST_MOMENT))
        return failed(err, ERR_ARGUMENT, "the sun's place is known from 1900 to 2100 alone");

    sun_earth e;
    double ut = sun_universal_days(moment), tt = sun_terrestrial_days(moment);
    earth_at(series, tt, &e);
    look_from_centre(&e, s, ut, tt, out);
    look_from_site(&e, s, ut, tt, out);
    out->apparent_elevation_deg =
        fmin(90.0, out->elevation_deg + refraction(out->elevation_deg, &here));
    return true;
}

bool sun_at(const site *s, const sun_air *air, double moment, sun_place *out, lux_error *err)
{
    return sun_at_next(&(sun_series){ 0 }, s, air, moment, out, err);
}

void sky_direction(double azimuth_deg, double elevation_deg, double north_deg, double out[3])
{
    double turn = (azimuth_deg + north_deg) * ERFA_DD2R, up = elevation_deg * ERFA_DD2R;
    out[0] = sin(turn) * cos(up);
    out[1] = cos(turn) * cos(up);
    out[2] = sin(up);
}
