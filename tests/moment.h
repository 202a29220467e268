/* tests/moment.h -- moments and suns for tests, from texts. */
#ifndef TESTS_MOMENT_H
#define TESTS_MOMENT_H

#include "sky/sun.h"
#include "tests/test.h"

/* "2003-10-17T19:30:30Z" */
static inline double moment_of(const char *text)
{
    clock_text t;
    lux_error err = { 0 };
    double moment = 0.0;
    if (!clock_read(&t, text, &err) || !clock_moment(NULL, &t, &moment, &err))
        fail_msg("%s: %s", text, err.text);
    return moment;
}

/* From the place at altitude 0, without air. */
static inline sun_place sun_bare(double latitude_deg, double longitude_deg, double moment)
{
    const site s        = { latitude_deg, longitude_deg, 0.0 };
    const sun_air empty = { 0.0, 0.0 };
    sun_place p         = { 0 };
    lux_error err       = { 0 };
    if (!sun_at(&s, &empty, moment, &p, &err))
        fail_msg("%s", err.text);
    return p;
}

static inline sun_day sun_on(const site *s, const char *zone, int year, int month, int day)
{
    arena a             = { 0 };
    lux_error err       = { 0 };
    sun_day d           = { 0 };
    const civil_time t  = { .year = year, .month = month, .day = day };
    const clock_zone *z = clock_zone_new(&a, zone, &err);
    if (!z || !sun_day_of(s, z, &t, &d, &err))
        fail_msg("%s", err.text);
    arena_clear(&a);
    return d;
}

/* Degrees between two directions on the sky. */
static inline double sky_angle_deg(double azimuth_a, double elevation_a, double azimuth_b,
                                   double elevation_b)
{
    double a[3], b[3], sum = 0.0;
    sky_direction(azimuth_a, elevation_a, 0.0, a);
    sky_direction(azimuth_b, elevation_b, 0.0, b);
    for (int i = 0; i < 3; i++)
        sum += (a[i] - b[i]) * (a[i] - b[i]);
    return 2.0 * asin(0.5 * sqrt(sum)) * 180.0 / 3.14159265358979324;
}

#endif
