/* sky/sun_day.c -- see sun.h: when the sun is up on a date.
 *
 * The date is cut where the sun stands highest or lowest, and each half hour: between two cuts it
 * only rises or only falls, so that two signs tell whether it crosses the horizon, and halving
 * finds where. That holds at every latitude, where formulae by hour angle fail near polar day.
 */
#include "sky/sun.h"

#include <math.h>

static const double STEP      = 1800.0;  /* s */
static const double HORIZON   = -0.8333; /* degrees: as sun.h says */
static const double HOUR      = 3600.0;
static const double EXTREME_S = 1.0; /* the sun then stands 1e-8 degrees from its highest */
static const double CROSS_S   = 1e-3;

typedef struct watch {
    sun_series series;
    const site *s;
} watch;

static sun_place sun_seen(watch *w, double moment)
{
    sun_place p         = { 0 };
    const sun_air empty = { 0.0, 0.0 };
    sun_at_next(&w->series, w->s, &empty, moment, &p, NULL); /* site and years were checked */
    return p;
}

static double height(watch *w, double moment)
{
    return sun_seen(w, moment).elevation_deg - HORIZON;
}

/* ---- from midnight to midnight -------------------------------------------------------------- */

/* The first moment at which clocks show that date or, where they leave out its 00:00, a later
 * time. */
static double date_begins(const clock_zone *z, double midnight)
{
    civil_time t = clock_local(NULL, midnight);
    double moment[2];
    if (clock_moments(z, &t, moment))
        return moment[0];

    double before = midnight - 2.0 * 24.0 * HOUR, after = midnight + 2.0 * 24.0 * HOUR;
    while (after - before > 1.0) { /* changes are at whole seconds */
        double middle = floor((before + after) / 2.0);
        if (middle + clock_offset(z, middle) < midnight)
            before = middle;
        else
            after = middle;
    }
    return after;
}

static bool date_bounds(const clock_zone *z, const civil_time *date, double bound[2],
                        lux_error *err)
{
    if (date->year < 1900 || date->year > 2100)
        return failed(err, ERR_ARGUMENT, "year %d: 1900 to 2100 is expected", date->year);

    civil_time day  = { .year = date->year, .month = date->month, .day = date->day };
    bool month_is   = day.month >= 1 && day.month <= 12;
    double midnight = month_is ? clock_from_civil(&day) : 0.0;
    civil_time same = clock_local(NULL, midnight);
    if (same.year != day.year || same.month != day.month || same.day != day.day)
        return failed(err, ERR_ARGUMENT, "%04d-%02d-%02d is no date of the calendar", date->year,
                      date->month, date->day);

    bound[0] = date_begins(z, midnight);
    bound[1] = date_begins(z, midnight + 24.0 * HOUR);
    if (!(bound[1] > bound[0]))
        return failed(err, ERR_ARGUMENT, "%04d-%02d-%02d was left out by clocks there", date->year,
                      date->month, date->day);
    return true;
}

/* ---- crossings ------------------------------------------------------------------------------ */

/* The moment in (a, b) at which the sun, highest (or lowest: up -1) between them, is so. Golden
 * section. */
static double extreme(watch *w, double a, double b, double up)
{
    const double part = 0.3819660112501051; /* (3 - sqrt(5)) / 2 */
    double p = a + part * (b - a), q = b - part * (b - a);
    double hp = up * height(w, p), hq = up * height(w, q);
    while (b - a > EXTREME_S) {
        if (hp > hq) {
            b = q, q = p, hq = hp;
            p  = a + part * (b - a);
            hp = up * height(w, p);
        } else {
            a = p, p = q, hp = hq;
            q  = b - part * (b - a);
            hq = up * height(w, q);
        }
    }
    return (a + b) / 2.0;
}

/* Where it crosses the horizon between a and b, of which one is above. */
static double crossing(watch *w, double a, double b)
{
    bool up = height(w, a) > 0.0;
    while (b - a > CROSS_S) {
        double middle = (a + b) / 2.0;
        if ((height(w, middle) > 0.0) == up)
            a = middle;
        else
            b = middle;
    }
    return (a + b) / 2.0;
}

/* Counts the stretch from a to b, within which it only rises or only falls. */
static void count_stretch(watch *w, double a, double b, sun_day *out)
{
    bool before = height(w, a) > 0.0, after = height(w, b) > 0.0;
    out->always_up &= before && after;
    out->always_down &= !before && !after;
    if (before && after)
        out->length_h += (b - a) / HOUR;
    if (before == after)
        return;

    double t = crossing(w, a, b);
    out->length_h += (before ? t - a : b - t) / HOUR;
    if (before)
        out->sunset = t;
    else if (isnan(out->sunrise))
        out->sunrise = t;
}

/* Cuts each step at a highest or lowest point within it. */
static void count_day(watch *w, const double bound[2], sun_day *out)
{
    double begin = bound[0], t = begin, h[3] = { height(w, t - STEP), height(w, t), 0.0 };
    while (begin < bound[1]) {
        h[2]     = height(w, t + STEP);
        bool top = h[1] > h[0] && h[1] >= h[2], bottom = h[1] < h[0] && h[1] <= h[2];
        double cut = top || bottom ? extreme(w, t - STEP, t + STEP, top ? 1.0 : -1.0) : t;
        double end = fmin(fmax(cut, begin), bound[1]);
        if (end > begin)
            count_stretch(w, begin, end, out);
        begin = end;
        t += STEP;
        h[0] = h[1], h[1] = h[2];
    }
}

/* ---- the meridian --------------------------------------------------------------------------- */

/* The first passage from `begin` on; the hour angle grows by 360 degrees a day, less or more half a
 * minute. */
static double passage(watch *w, double begin)
{
    double hour_deg = sun_seen(w, begin).hour_angle_deg;
    double t        = begin + (hour_deg > 0.0 ? 360.0 - hour_deg : -hour_deg) / 15.0 * HOUR;
    for (int i = 0; i < 3; i++)
        t -= sun_seen(w, t).hour_angle_deg / 15.0 * HOUR;
    return fmax(t, begin);
}

bool sun_day_of(const site *s, const clock_zone *z, const civil_time *date, sun_day *out,
                lux_error *err)
{
    double bound[2] = { 0.0 };
    sun_place first;
    watch w = { .s = s };
    if (!date_bounds(z, date, bound, err) ||
        !sun_at_next(&w.series, s, NULL, bound[0], &first, err))
        return false;

    *out = (sun_day){ .sunrise               = (double)NAN,
                      .sunset                = (double)NAN,
                      .transit               = (double)NAN,
                      .transit_elevation_deg = (double)NAN,
                      .always_up             = true,
                      .always_down           = true };
    count_day(&w, bound, out);

    double transit = passage(&w, bound[0]);
    if (transit < bound[1]) {
        out->transit               = transit;
        out->transit_elevation_deg = sun_seen(&w, transit).elevation_deg;
    }
    return true;
}
