/* sim/moments.c -- see moments.h. */
#include "sim/moments.h"

#include "core/text.h"
#include "sim/moment_sky.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double seconds_of_day = 86400.0;

/* ---- texts ----------------------------------------------------------------------------------- */

/* A date alone, of `length` bytes. */
static bool read_date(const char *text, size_t length, const char *what, civil_time *date,
                      lux_error *err)
{
    char copy[32] = "";
    clock_text is = { 0 };
    lux_error why = { 0 };
    int shown     = (int)(length < 40 ? length : 40);
    bool fits     = length < sizeof copy;
    if (fits)
        memcpy(copy, text, length);
    bool reads = fits && clock_read(&is, copy, &why);
    if (!reads && length == strlen("2026-06-21"))
        return failed(err, why.code, "%s: %s", what, why.text);
    if (!reads)
        return failed(err, ERR_FORMAT,
                      "%s: expected a date as 2026-06-21, or two as 2026-06-21..2026-06-30, "
                      "found `%.*s`",
                      what, shown, text);
    if (is.has_time)
        return failed(err, ERR_FORMAT, "%s: expected a date without a time, found `%s`", what,
                      copy);
    *date = is.time;
    return true;
}

bool when_read_dates(const char *text, const char *what, civil_time *first, civil_time *last,
                     lux_error *err)
{
    const char *dots   = strstr(text, "..");
    const char *second = dots ? dots + 2 : text;
    size_t length      = dots ? (size_t)(dots - text) : strlen(text);
    if (!read_date(text, length, what, first, err) ||
        !read_date(second, strlen(second), what, last, err))
        return false;
    return clock_from_civil(first) <= clock_from_civil(last) ||
           failed(err, ERR_FORMAT, "%s: expected the earlier date first, found `%.40s`", what,
                  text);
}

static bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool when_read_minute(const char *text, const char *what, int *minute, lux_error *err)
{
    bool shaped = strlen(text) == 5 && is_digit(text[0]) && is_digit(text[1]) && text[2] == ':' &&
                  is_digit(text[3]) && is_digit(text[4]);
    int hour = shaped ? 10 * (text[0] - '0') + text[1] - '0' : 24;
    int rest = shaped ? 10 * (text[3] - '0') + text[4] - '0' : 60;
    if (hour > 23 || rest > 59)
        return failed(err, ERR_FORMAT, "%s: expected a time from 00:00 to 23:59, found `%.40s`",
                      what, text);
    *minute = 60 * hour + rest;
    return true;
}

/* ---- where the sun stands -------------------------------------------------------------------- */

static vec3 direction(const study *s, double azimuth_deg, double elevation_deg)
{
    double d[3];
    sky_direction(azimuth_deg, elevation_deg, s->site.north_deg, d);
    return (vec3){ (float)d[0], (float)d[1], (float)d[2] };
}

static bool place_sun(const study *s, moment *m, lux_error *err)
{
    const study_sky *k = &s->sky;
    if (k->sun_at_given) {
        m->sun = (sun_place){ .azimuth_deg            = k->sun_azimuth_deg,
                              .elevation_deg          = k->sun_elevation_deg,
                              .apparent_elevation_deg = k->sun_elevation_deg };
    } else {
        sun_air standard = { (double)NAN, (double)NAN };
        if (!s->site.given || isnan(m->at))
            return true;
        if (!sun_at(&s->site.at, &standard, m->at, &m->sun, err))
            return false;
    }
    m->sun_known = true;
    m->to_sun    = direction(s, m->sun.azimuth_deg, m->sun.apparent_elevation_deg);
    return true;
}

static bool fill(const study *s, double at, moment *out, lux_error *err)
{
    *out = (moment){ .at = at };
    if (!isnan(at)) {
        out->local = clock_local(s->site.zone, at);
        clock_print(out->text, s->site.zone, at);
    }
    return place_sun(s, out, err);
}

/* ---- one moment ------------------------------------------------------------------------------ */

static bool pass_on(const study *s, study_where where, const lux_error *why, lux_error *err)
{
    return study_failed(s, where, err, why->code, "%s", why->text);
}

/* The sky needs the sun: what is there to find it by? */
static bool sun_can_be_found(const study *s, lux_error *err)
{
    bool needs = study_needs_sun(s) && !s->sky.sun_at_given;
    bool timed = s->when.given;
    if (needs && !s->site.given)
        return study_failed(s, s->sky.where, err, ERR_ARGUMENT,
                            "the sky model `%s` needs to know where the sun stands: `site` with "
                            "its `place`%s, or `sun_at` of the sky",
                            s->sky.name, timed ? "" : ", and `when`");
    if (needs && !timed)
        return study_failed(s, s->sky.where, err, ERR_ARGUMENT,
                            "the sky model `%s` needs to know where the sun stands: `when`, as "
                            "2026-06-21T10:00, or `sun_at` of the sky",
                            s->sky.name);
    return !needs || s->site.zone || s->when.at.has_offset ||
           study_failed(s, s->when.where, err, ERR_ARGUMENT,
                        "a local time needs the `zone` of `site`, as Europe/Moscow, or its own "
                        "offset, as 2026-06-21T10:00+03:00");
}

bool moment_of(const study *s, moment *out, lux_error *err)
{
    const study_when *w = &s->when;
    if (w->given && w->series)
        return study_failed(s, w->where, err, ERR_ARGUMENT,
                            "`when` is a series of times, which `lux4 daylight` runs; here one is "
                            "needed, as %04d-%02d-%02dT%02d:%02d",
                            w->first.year, w->first.month, w->first.day, w->from_min / 60,
                            w->from_min % 60);
    if (!sun_can_be_found(s, err))
        return false;
    double at     = (double)NAN;
    lux_error why = { 0 };
    bool timed    = w->given && (s->site.zone || w->at.has_offset);
    if (timed && !clock_moment(s->site.zone, &w->at, &at, &why))
        return pass_on(s, w->where, &why, err);
    return fill(s, at, out, &why) || pass_on(s, w->given ? w->where : s->sky.where, &why, err);
}

/* ---- a series -------------------------------------------------------------------------------- */

typedef struct series {
    const study *s;
    const study_when *w;
    arena *a;
    lux_error *err;
    moment *list;
    int count, room;
    int skipped;           /* times that clocks never show */
    civil_time first_skip; /* the first of them */
} series;

/* Times of one day, at most more than are allowed. */
static int times_of_day(const study_when *w)
{
    double span = (double)(w->to_min - w->from_min) / w->step_min;
    return 1 + (int)fmin(floor(span + 1e-9), MOST_MOMENTS); /* rounding of a step that fits */
}

static bool add(series *r, double at)
{
    lux_error why = { 0 };
    if (r->count == r->room)
        return study_failed(r->s, r->w->where, r->err, ERR_ARGUMENT,
                            "a series of more than %d moments", MOST_MOMENTS);
    return fill(r->s, at, &r->list[r->count++], &why) || pass_on(r->s, r->w->where, &why, r->err);
}

static bool add_time(series *r, const civil_time *date, double second_of_day)
{
    double hour   = floor(second_of_day / 3600.0);
    double minute = floor((second_of_day - 3600.0 * hour) / 60.0);
    civil_time t  = *date;
    t.hour        = (int)hour;
    t.minute      = (int)minute;
    t.second      = second_of_day - 3600.0 * hour - 60.0 * minute;
    double at[2];
    int shown = clock_moments(r->s->site.zone, &t, at);
    if (shown == 0 && r->skipped++ == 0)
        r->first_skip = t;
    for (int i = 0; i < shown; i++)
        if (!add(r, at[i]))
            return false;
    return true;
}

static bool add_day(series *r, const civil_time *date)
{
    int times = times_of_day(r->w);
    for (int k = 0; k < times; k++) {
        /* To the millisecond: a third of a minute is no double */
        double second = 60.0 * (r->w->from_min + k * r->w->step_min);
        if (!add_time(r, date, round(second * 1000.0) / 1000.0))
            return false;
    }
    return true;
}

/* Of the month after that: its day is kept where the month has it. */
static bool month_has_day(const civil_time *date)
{
    double at      = clock_from_civil(&(civil_time){ date->year, date->month, 1, 0, 0, 0.0 });
    civil_time got = clock_local(NULL, at + seconds_of_day * (date->day - 1));
    return got.month == date->month;
}

static bool add_months(series *r, notices *n)
{
    civil_time date = r->w->first;
    double last     = clock_from_civil(&r->w->last);
    int without     = 0;
    for (;;) {
        civil_time first = { date.year, date.month, 1, 0, 0, 0.0 };
        if (clock_from_civil(&first) > last)
            break;
        if (!month_has_day(&date))
            without++;
        else if (clock_from_civil(&date) <= last && !add_day(r, &date))
            return false;
        date.year += date.month == 12;
        date.month = date.month % 12 + 1;
    }
    if (without > 0)
        notice_add(n, "%s:%d:%d: months without a day %d are left out: %d", r->s->path,
                   r->w->where.line, r->w->where.column, date.day, without);
    return true;
}

static bool add_days(series *r, int apart)
{
    double first = clock_from_civil(&r->w->first), last = clock_from_civil(&r->w->last);
    int days = (int)round((last - first) / seconds_of_day);
    for (int day = 0; day <= days; day += apart) {
        civil_time date = clock_local(NULL, first + seconds_of_day * day);
        if (!add_day(r, &date))
            return false;
    }
    return true;
}

/* Where clocks are put back, what they show twice stands beside what they show once. */
static int by_time(const void *left, const void *right)
{
    double a = ((const moment *)left)->at, b = ((const moment *)right)->at;
    return (a > b) - (a < b);
}

static bool add_series(series *r, notices *n)
{
    const study_when *w = r->w;
    if (w->every == EVERY_MONTH ? !add_months(r, n) : !add_days(r, w->every == EVERY_WEEK ? 7 : 1))
        return false;
    qsort(r->list, (size_t)r->count, sizeof *r->list, by_time);
    if (r->skipped > 0)
        notice_add(n,
                   "%s:%d:%d: clocks are put forward: %d time%s that they skip %s left out "
                   "(%04d-%02d-%02dT%02d:%02d)",
                   r->s->path, w->where.line, w->where.column, r->skipped,
                   r->skipped == 1 ? "" : "s", r->skipped == 1 ? "is" : "are", r->first_skip.year,
                   r->first_skip.month, r->first_skip.day, r->first_skip.hour,
                   r->first_skip.minute);
    return r->count > 0 ||
           study_failed(r->s, w->where, r->err, ERR_ARGUMENT, "a series without a single moment");
}

static bool series_can_be(const study *s, const study_when *w, lux_error *err)
{
    if (!s->site.given || !s->site.zone)
        return study_failed(s, s->site.given ? s->site.where : w->where, err, ERR_ARGUMENT,
                            "a series of times needs `site` with its `zone`, as Europe/Moscow or "
                            "+03:00");
    return !s->sky.sun_at_given ||
           study_failed(s, s->sky.where, err, ERR_ARGUMENT,
                        "`sun_at` holds the sun in one place: a series of times moves it");
}

moment *moments_of(arena *a, const study *s, const study_when *when, int *count, notices *n,
                   lux_error *err)
{
    *count = 0;
    if (!when->given)
        return failed(err, ERR_ARGUMENT,
                      "%s: a series of times needs `when`, as {date: 2026-03-21, from: \"08:00\", "
                      "to: \"18:00\", step: 60}",
                      s->path);
    if (!when->series) {
        study one   = *s;
        moment *out = arena_new(a, moment, err);
        one.when    = *when;
        *count      = 1;
        return out && moment_of(&one, out, err) ? out : NULL;
    }
    if (!series_can_be(s, when, err))
        return NULL;
    series r = { .s = s, .w = when, .a = a, .err = err, .room = MOST_MOMENTS };
    r.list   = arena_array(a, moment, MOST_MOMENTS, err);
    if (!r.list || !add_series(&r, n))
        return NULL;
    *count = r.count;
    return r.list;
}
