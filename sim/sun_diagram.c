/* sim/sun_diagram.c -- see sun_diagram.h. */
#include "sim/sun_diagram.h"

#include <math.h>

static const double DEG = M_PI / 180.0, DAY_S = 86400.0, HOUR_S = 3600.0;

const int sun_path_months[SUN_PATHS] = { 12, 1, 2, 3, 4, 5, 6 };

/* ---- places ---------------------------------------------------------------------------------- */

double sun_diagram_radius(const sun_diagram *d, double elevation_deg)
{
    return d->radius * tan(0.5 * (90.0 - elevation_deg) * DEG);
}

sun_point sun_diagram_point(const sun_diagram *d, double azimuth_deg, double radius)
{
    return (sun_point){ .x = d->x + radius * sin(azimuth_deg * DEG),
                        .y = d->y - radius * cos(azimuth_deg * DEG) };
}

double sun_diagram_azimuth(const sun_diagram *d, const sun_point *p)
{
    return atan2(p->x - d->x, d->y - p->y) / DEG;
}

sun_point sun_diagram_rim(const sun_diagram *d, const sun_point *a, const sun_point *b)
{
    double t    = a->elevation_deg / (a->elevation_deg - b->elevation_deg);
    sun_point p = { .x = a->x + t * (b->x - a->x), .y = a->y + t * (b->y - a->y) };
    return sun_diagram_point(d, sun_diagram_azimuth(d, &p), d->radius);
}

static bool find_point(sun_diagram *d, double moment, sun_point *out, lux_error *err)
{
    static const double LOWEST_DEG = -60.0; /* the nadir is infinitely far off; cut off anyway */
    sun_place s;
    if (!sun_at_next(&d->series, &d->q->at, &d->q->air, moment, &s, err))
        return false;
    double elevation   = fmax(s.apparent_elevation_deg, LOWEST_DEG);
    *out               = sun_diagram_point(d, s.azimuth_deg, sun_diagram_radius(d, elevation));
    out->elevation_deg = s.apparent_elevation_deg;
    return true;
}

/* ---- times ----------------------------------------------------------------------------------- */

/* On clocks at the diagram's offset. */
static double clock_hour(const sun_diagram *d, int month, int day, double hour)
{
    civil_time t = { .year = d->q->date.year, .month = month, .day = day };
    return clock_from_civil(&t) + hour * HOUR_S - d->offset;
}

/* By mean solar time. */
static double solar_hour(const sun_diagram *d, int month, int day, double hour)
{
    civil_time t = { .year = d->q->date.year, .month = month, .day = day };
    return clock_from_civil(&t) + (hour - d->q->at.longitude_deg / 15.0) * HOUR_S;
}

/* Half past an hour of the clock, near a moment: between two lines of hours. */
static double half_past(const sun_diagram *d, double moment)
{
    return (floor((moment + d->offset) / HOUR_S) + 0.5) * HOUR_S - d->offset;
}

/* ---- lines ----------------------------------------------------------------------------------- */

static bool find_day(sun_diagram *d, double from, sun_point p[SUN_DAY_POINTS], lux_error *err)
{
    for (int i = 0; i < SUN_DAY_POINTS; i++)
        if (!find_point(d, from + DAY_S * i / (SUN_DAY_POINTS - 1), &p[i], err))
            return false;
    return true;
}

/* Names stand in the morning, each on another hour. */
static bool find_days(sun_diagram *d, lux_error *err)
{
    for (int k = 0; k < SUN_PATHS; k++) {
        double hour = 6.0 + 1.5 * (k - SUN_PATHS / 2);
        double name = half_past(d, solar_hour(d, sun_path_months[k], 21, hour));
        if (!find_day(d, solar_hour(d, sun_path_months[k], 21, 0.0), d->days[k], err) ||
            !find_point(d, name, &d->names[k], err))
            return false;
    }
    const civil_time *date = &d->q->date;
    return !d->q->has_date || find_day(d, clock_hour(d, date->month, date->day, 0.0), d->date, err);
}

/* Day by day: the sun's series has then little to find anew. */
static bool find_hours(sun_diagram *d, lux_error *err)
{
    for (int i = 0; i + 1 < SUN_HOUR_POINTS; i++)
        for (int hour = 0; hour < 24; hour++) {
            double at = clock_hour(d, 1, 2, hour) + DAY_S * SUN_HOUR_STEP * i;
            if (!find_point(d, at, &d->hours[hour][i], err))
                return false;
        }
    for (int hour = 0; hour < 24; hour++)
        d->hours[hour][SUN_HOUR_POINTS - 1] = d->hours[hour][0];
    return true;
}

/* Below the pole, where the sun comes last; in the tropics, where the numbers of hours stand there,
 * on the other side. */
static bool find_spare(sun_diagram *d, lux_error *err)
{
    static const double TROPICS_DEG = 20.0;
    sun_point p;
    double midnight = half_past(d, solar_hour(d, d->december ? 12 : 6, 21, 0.0));
    if (!find_point(d, midnight, &p, err))
        return false;
    d->spare_deg = sun_diagram_azimuth(d, &p);
    if (fabs(d->q->at.latitude_deg) < TROPICS_DEG)
        d->spare_deg += 180.0;
    return true;
}

/* The offset in force at the moment, or at noon of the date. */
static void find_offset(sun_diagram *d)
{
    civil_time noon = d->q->date;
    noon.hour       = 12;
    double at       = clock_from_civil(&noon);
    double moment   = d->q->has_moment ? d->q->moment : at - clock_offset(d->q->zone, at);
    d->offset       = clock_offset(d->q->zone, moment);
    for (int month = 1; month <= 12; month++)
        if (clock_offset(d->q->zone, clock_hour(d, month, 15, 12.0)) != d->offset)
            d->clocks_change = true;
}

bool sun_diagram_find(sun_diagram *d, lux_error *err)
{
    const sun_question *q = d->q;
    d->december           = q->at.latitude_deg < 0.0;
    find_offset(d);
    return find_hours(d, err) && find_days(d, err) && find_spare(d, err) &&
           (!q->has_moment || sun_at(&q->at, &q->air, q->moment, &d->sun, err));
}
