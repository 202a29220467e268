/* sky/clock.h -- civil time: what clocks show somewhere, and the moment that it is.
 *
 * A moment is a number of seconds since 1970-01-01T00:00:00 UTC, every day having 86,400 of them
 * (POSIX). The calendar is the Gregorian one. Zones are those of the IANA data base, with all
 * changes from 1900 to 2100 that ICU knows of, or a fixed offset. Zones are immutable once
 * made: any thread may ask them.
 */
#ifndef SKY_CLOCK_H
#define SKY_CLOCK_H

#include "core/arena.h"
#include "core/error.h"

typedef struct civil_time {
    int year, month, day; /* 1 ... 12, 1 ... 31 */
    int hour, minute;     /* 0 ... 23, 0 ... 59 */
    double second;        /* [0, 60) */
} civil_time;

/* What a text in ISO 8601 says. */
typedef struct clock_text {
    civil_time time;
    bool has_time;   /* else a date alone, at 00:00 */
    bool has_offset; /* "Z", "+03:00", "+0530", "-08" */
    int offset;      /* s east of UTC, if has_offset */
} clock_text;

/* "2026-06-21", "2026-06-21T10:00", "2026-06-21T10:00:30.5+03:00", "20260621T1000Z"; a blank may
 * stand for the T. False, with *err, for what is none, or no date (2026-02-29), or 24:00, or a leap
 * second (23:59:60: said why). */
bool clock_read(clock_text *out, const char *text, lux_error *err);

typedef struct clock_zone clock_zone;

/* The zone of an IANA name ("Europe/Moscow", "UTC") or an offset ("+03:00", "-0330", "Z"). Lives as
 * long as a does. NULL, with *err, which for a misspelt name names the nearest one. */
const clock_zone *clock_zone_new(arena *a, const char *text, lux_error *err);

/* s east of UTC, in force at that moment, daylight saving time included. */
int clock_offset(const clock_zone *z, double moment);

/* What clocks show at that moment: there, or (z NULL) in UTC. */
civil_time clock_local(const clock_zone *z, double moment);

/* The moments at which clocks there show that, ascending: one; none where they were put forward;
 * two where they were put back. How many. */
int clock_moments(const clock_zone *z, const civil_time *t, double moment[2]);

/* The moment that a text means; without an offset of its own, as clocks of the zone show it (z
 * NULL: such a text is an error). False, with *err, where clocks never show that, or show it twice:
 * then both readings stand in it, with their offsets, ready to be copied. */
bool clock_moment(const clock_zone *z, const clock_text *t, double *moment, lux_error *err);

/* Of a date and time of the calendar, as if it were UTC; the reverse is clock_local(NULL, ...). */
double clock_from_civil(const civil_time *t);

enum { CLOCK_TEXT = 40 };
/* "2026-06-21T10:00+03:00" (seconds where there are any, to the whole one), as clocks of the zone
 * show it. */
void clock_print(char out[CLOCK_TEXT], const clock_zone *z, double moment);

#endif
