/* sky/clock.c -- see clock.h: the calendar, and what clocks show.
 *
 * A clock shows moment + offset, the offset that of the last change of its zone. Put back, it shows
 * some times under two offsets; put forward, some under none:
 *
 *     offset a          | offset b > a            offset a          | offset b < a
 *     ... 01:58 01:59   | 03:00 03:01 ...         ... 02:58 02:59   | 02:00 02:01 ...
 */
#include "sky/clock_parts.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { DAY = 86400 };

/* ---- the calendar --------------------------------------------------------------------------- */

/* Days from 1970-01-01 to the first of a month: years begin in March, so that leap days end them,
 * and months of 31, 30, 31, 30, 31 days recur every 153. */
static double days_to_month(int year, int month)
{
    double y = year - (month <= 2);
    int m    = (month + 9) % 12;
    return 365.0 * y + floor(y / 4.0) - floor(y / 100.0) + floor(y / 400.0) + (153 * m + 2) / 5 -
           719468.0;
}

double clock_from_civil(const civil_time *t)
{
    double days = days_to_month(t->year, t->month) + t->day - 1.0;
    return days * DAY + t->hour * 3600.0 + t->minute * 60.0 + t->second;
}

static civil_time civil_from(double seconds)
{
    if (!(fabs(seconds) < 1e13)) /* no year of a calendar */
        return (civil_time){ 0 };

    double days = floor(seconds / DAY), rest = seconds - days * DAY;
    if (rest >= DAY) /* less than a double's last digit before midnight */
        days++, rest = 0.0;
    int year = 1970 + (int)floor(days / 365.2425);
    year += days >= days_to_month(year + 1, 1);
    year -= days < days_to_month(year, 1);
    int month = 1;
    while (month < 12 && days >= days_to_month(year, month + 1))
        month++;

    int minutes = (int)(rest / 60.0);
    return (civil_time){ .year   = year,
                         .month  = month,
                         .day    = 1 + (int)(days - days_to_month(year, month)),
                         .hour   = minutes / 60,
                         .minute = minutes % 60,
                         .second = rest - minutes * 60.0 };
}

/* ---- what clocks show ----------------------------------------------------------------------- */

static int change_at(const clock_zone *z, double moment)
{
    int low = 0, high = z->count;
    while (high - low > 1) {
        int middle = (low + high) / 2;
        if (z->change[middle].moment <= moment)
            low = middle;
        else
            high = middle;
    }
    return low;
}

int clock_offset(const clock_zone *z, double moment)
{
    return z ? z->change[change_at(z, moment)].offset : 0;
}

civil_time clock_local(const clock_zone *z, double moment)
{
    return civil_from(moment + clock_offset(z, moment));
}

int clock_moments(const clock_zone *z, const civil_time *t, double moment[2])
{
    double shown = clock_from_civil(t);
    if (!z) {
        moment[0] = shown;
        return 1;
    }
    int count = 0;
    for (int i = 0; i < z->count && count < 2; i++) {
        double m    = shown - z->change[i].offset;
        double ends = i + 1 < z->count ? z->change[i + 1].moment : (double)INFINITY;
        if (m >= z->change[i].moment && m < ends)
            moment[count++] = m;
    }
    return count;
}

/* ---- in words ------------------------------------------------------------------------------- */

static void print_offset(char out[CLOCK_TEXT], int offset)
{
    int s = abs(offset), length = snprintf(out, CLOCK_TEXT, "%c%02d:%02d", offset < 0 ? '-' : '+',
                                           s / 3600 % 100, s / 60 % 60);
    if (s % 60)
        snprintf(out + length, (size_t)(CLOCK_TEXT - length), ":%02d", s % 60);
}

/* What clocks show, without the offset. Returns its length. */
static int print_shown(char out[CLOCK_TEXT], double shown)
{
    civil_time t = civil_from(shown);
    int length   = snprintf(out, CLOCK_TEXT, "%04d-%02d-%02dT%02d:%02d", t.year, t.month, t.day,
                            t.hour, t.minute);
    if (t.second >= 1.0)
        length += snprintf(out + length, (size_t)(CLOCK_TEXT - length), ":%02.0f", t.second);
    return length;
}

static void print_with(char out[CLOCK_TEXT], double moment, int offset)
{
    char east[CLOCK_TEXT];
    int length = print_shown(out, moment + offset);
    print_offset(east, offset);
    snprintf(out + length, (size_t)(CLOCK_TEXT - length), "%s", east);
}

void clock_print(char out[CLOCK_TEXT], const clock_zone *z, double moment)
{
    double whole = floor(moment + 0.5);
    if (!(fabs(whole) < 1e11)) /* no year of four digits */
        out[0] = 0;
    else if (z)
        print_with(out, whole, clock_offset(z, whole));
    else
        snprintf(out + print_shown(out, whole), 2, "Z");
}

/* Where clocks are put past what they never show. */
static bool failed_unshown(const clock_zone *z, double shown, lux_error *err)
{
    int i = 1;
    while (i < z->count - 1 && shown - z->change[i].offset >= z->change[i].moment)
        i++;
    char time[CLOCK_TEXT], before[CLOCK_TEXT], after[CLOCK_TEXT];
    print_shown(time, shown);
    print_with(before, z->change[i].moment, z->change[i - 1].offset);
    print_with(after, z->change[i].moment, z->change[i].offset);
    return failed(err, ERR_ARGUMENT,
                  "%s is shown by no clock there: they are put forward from %s to %s", time, before,
                  after);
}

static bool failed_twice(const clock_zone *z, double shown, const double moment[2], lux_error *err)
{
    char time[CLOCK_TEXT], first[CLOCK_TEXT], second[CLOCK_TEXT];
    print_shown(time, shown);
    clock_print(first, z, moment[0]);
    clock_print(second, z, moment[1]);
    return failed(err, ERR_ARGUMENT,
                  "%s is shown twice by clocks there, which are put back: %s or %s is expected",
                  time, first, second);
}

bool clock_moment(const clock_zone *z, const clock_text *t, double *moment, lux_error *err)
{
    double shown = clock_from_civil(&t->time), m[2];
    if (t->has_offset) {
        *moment = shown - t->offset;
        return true;
    }
    if (!z) {
        char time[CLOCK_TEXT];
        print_shown(time, shown);
        return failed(err, ERR_ARGUMENT,
                      "%s says no offset from UTC, and there is no zone: %sZ or %s+03:00, or a "
                      "zone, is expected",
                      time, time, time);
    }
    int count = clock_moments(z, &t->time, m);
    if (count == 0)
        return failed_unshown(z, shown, err);
    if (count == 2)
        return failed_twice(z, shown, m, err);
    *moment = m[0];
    return true;
}
