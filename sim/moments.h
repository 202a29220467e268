/* sim/moments.h -- the moments of a study: when it is, and where the sun then stands. */
#ifndef SIM_MOMENTS_H
#define SIM_MOMENTS_H

#include "sim/study.h"
#include "sky/sun.h"

typedef struct moment {
    char text[CLOCK_TEXT]; /* "2026-06-21T10:00+03:00"; "" where nothing depends on the time */
    double at;             /* clock.h; NAN where nothing does */
    civil_time local;      /* as clocks of the site show it; where text is not "" */
    bool sun_known;        /* what follows holds: by site and time, or `sun_at` */
    sun_place sun;         /* of `sun_at`: azimuth and elevations alone, all else 0 (1 au) */
    vec3 to_sun;           /* unit, in the scene's frame, apparent */
} moment;

/* The one moment of a study; ERR_ARGUMENT if its `when` is a series, if its sky needs to know where
 * the sun is and site or time are missing, or a time is none (clock.h), naming file and line. */
bool moment_of(const study *s, moment *out, lux_error *err);

enum { MOST_MOMENTS = 10000 };

/* The series of `when` (a single time is a series of one), in a, ascending. Hours that clocks skip
 * are left out, those they show twice are there twice. */
moment *moments_of(arena *a, const study *s, const study_when *when, int *count, notices *n,
                   lux_error *err);

/* Reads "2026-03-21", "2026-03-21..2026-06-21" and "08:00" as `when` and options have them, for
 * messages that begin with `what`. */
bool when_read_dates(const char *text, const char *what, civil_time *first, civil_time *last,
                     lux_error *err);
bool when_read_minute(const char *text, const char *what, int *minute, lux_error *err);

#endif
