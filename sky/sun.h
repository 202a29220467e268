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

/* What bends the light. */
typedef struct sun_air {
    double pressure_hpa;  /* [0, 1200]; NAN: of the standard atmosphere at the site's altitude */
    double temperature_c; /* [-100, 70]; NAN: 15 at the sea, less 6.5 a km (ISO 2533) */
} sun_air;

typedef struct sun_place {
    double azimuth_deg;                           /* [0, 360) */
    double elevation_deg, apparent_elevation_deg; /* [-90, 90] */
    double declination_deg, right_ascension_deg;  /* geocentric, apparent, of date */
    double hour_angle_deg;                        /* (-180, 180], west positive */
    double equation_of_time_min;                  /* apparent less mean solar time */
    double solar_time_h;                          /* [0, 24): apparent */
    double distance_au;
    double diameter_deg; /* angular, of the disk */
} sun_place;

/* False, with *err, for a moment outside of the years above. */
bool sun_at(const site *s, const sun_air *air, double moment, sun_place *out, lux_error *err);

/* Sunrise and sunset are when the upper limb appears at the level horizon: the centre at a true
 * elevation of -0.8333 degrees (34' of refraction, 16' of the disk), whatever air or altitude. */
typedef struct sun_day {
    double sunrise, sunset; /* moments; NAN where it has none on that date */
    double transit;         /* when it stands highest */
    double transit_elevation_deg;
    double length_h; /* of the time on that date that it is up: [0, 24 or as long as the day is] */
    bool always_up, always_down;
} sun_day;

/* Of the date (year, month, day) of `date`, from midnight to midnight as clocks of the zone show
 * it. */
bool sun_day_of(const site *s, const clock_zone *z, const civil_time *date, sun_day *out,
                lux_error *err);

/* The direction toward a place of the sky in a scene: x, y, z with z up. north_deg: where true
 * north lies, clockwise from +y seen from above. */
void sky_direction(double azimuth_deg, double elevation_deg, double north_deg, double out[3]);

#endif
