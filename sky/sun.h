/* sky/sun.h -- the sun as it is seen from a place on Earth: where, how large, when it is up.
 *
 * Azimuth counts clockwise from true north, elevation up from the horizon, both topocentric. True
 * (geometric) elevation is that without air; apparent elevation is refracted. Moments as in
 * clock.h, from 1900-01-01 to 2100-12-31.
 */
#ifndef SKY_SUN_H
#define SKY_SUN_H

#include "sky/clock.h"
#include "sky/site.h"

/* What bends the light; a NULL of it is one of two NAN. */
typedef struct sun_air {
    double pressure_hpa;  /* [0, 1200]; NAN: of the standard atmosphere at the site's altitude */
    double temperature_c; /* [-100, 70]; NAN: 15 at the sea, less 6.5 a km (ISO 2533) */
} sun_air;

/* At a pole, directions are those of the meridian that the site's longitude names: from the North
 * Pole the sun stands in the south (180) when it crosses that meridian, from the South Pole in the
 * north (0). */
typedef struct sun_place {
    double azimuth_deg;                           /* [0, 360) */
    double elevation_deg, apparent_elevation_deg; /* [-90, 90] */
    double declination_deg, right_ascension_deg;  /* geocentric, apparent, of date */
    double hour_angle_deg;                        /* (-180, 180], west positive; geocentric */
    double equation_of_time_min;                  /* apparent less mean solar time */
    double solar_time_h;                          /* [0, 24): apparent */
    double distance_au;                           /* of Earth's centre */
    double diameter_deg; /* angular, of the disk (radius 695,700 km: IAU 2015) at that distance */
} sun_place;

/* False, with *err, for a moment outside of the years above (a day more is allowed at both ends:
 * clocks may be ahead or behind), or a site or air outside of its ranges. */
bool sun_at(const site *s, const sun_air *air, double moment, sun_place *out, lux_error *err);

/* Where Earth is and how its axis stands, at 0h of terrestrial time of a few days: what sun_at
 * interpolates, and what takes it long. All zero at first, and then one thread's own. */
typedef struct sun_earth {
    bool known;
    int day;                  /* since 2000-01-01 */
    double axis[3][3];        /* from the celestial frame to the true equator and equinox of date */
    double locator;           /* of the celestial intermediate origin, rad */
    double from_sun[2][3];    /* position, velocity: au, au a day */
    double from_centre[2][3]; /* of the solar system's mass */
} sun_earth;
typedef struct sun_series {
    sun_earth at[4];
} sun_series;

/* The very same answers, quicker where moments of the same or the next days follow. */
bool sun_at_next(sun_series *series, const site *s, const sun_air *air, double moment,
                 sun_place *out, lux_error *err);

/* Sunrise and sunset are when the upper limb appears at the level horizon: the centre at a true
 * elevation of -0.8333 degrees (34' of refraction, 16' of the disk), whatever air or altitude.
 * Almanacs mean the elevation from Earth's centre, which is greater by the parallax, 0.0024
 * degrees: their day is longer by a second or two.
 *
 * A date may have two of either (near polar day, or where clocks are far from the sun): sunrise is
 * then the first, sunset the last. A sunset may come before the sunrise of the same date, where the
 * sun goes down after midnight. */
typedef struct sun_day {
    double sunrise, sunset;       /* moments; NAN where it has none on that date */
    double transit;               /* first passage of the meridian (hour angle 0); NAN: none */
    double transit_elevation_deg; /* true; NAN: no transit */
    double length_h; /* of the time on that date that it is up: [0, 24 or as long as the day is] */
    bool always_up, always_down;
} sun_day;

/* Of the date (year, month, day) of `date`, from midnight to midnight as clocks of the zone (NULL:
 * UTC) show it: 23 or 25 h where they are put forward or back. False, with *err, for a date that is
 * none, outside of the years above, or that clocks there left out (Samoa's 2011-12-30). */
bool sun_day_of(const site *s, const clock_zone *z, const civil_time *date, sun_day *out,
                lux_error *err);

/* The direction toward a place of the sky in a scene: x, y, z with z up. north_deg: where true
 * north lies, clockwise from +y seen from above. */
void sky_direction(double azimuth_deg, double elevation_deg, double north_deg, double out[3]);

#endif
