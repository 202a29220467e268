/* sim/sun_diagram.h -- where the lines of a sun-path diagram lie on paper: all that is drawn.
 *
 * Stereographic, from the nadir: a direction z degrees off the zenith is drawn tan(z / 2) of the
 * rim's radius from the middle, so that circles in the sky (parallels of elevation, days) are
 * circles on paper, and angles are true. North is up, east on the right. Lengths in px of the
 * picture, y downward.
 *
 * Lines of an hour are those of clocks at one offset from UTC, that of the date asked for: over
 * the year the sun makes a figure of eight there, by the equation of time.
 */
#ifndef SIM_SUN_DIAGRAM_H
#define SIM_SUN_DIAGRAM_H

#include "sim/sun_report.h"

typedef struct sun_point {
    double x, y;          /* px */
    double elevation_deg; /* apparent; < 0: it is not drawn */
} sun_point;

/* A day's line from midnight (mean solar; of the date asked for: the clock's) each 10 minutes; an
 * hour's from January 2 each 5 days, and back at its beginning; up to the index of FIRST_HALF it is
 * June or before. */
enum { SUN_PATHS = 7, SUN_DAY_POINTS = 145, SUN_HOUR_POINTS = 74, SUN_HOUR_STEP = 5 };
enum { SUN_FIRST_HALF = 36, SUN_MARCH_21 = 16, SUN_JUNE_21 = 34, SUN_DECEMBER_21 = 70 };

/* Of the 21st of these months; the paths of two months, as far from a solstice, lie together and
 * are drawn once. */
extern const int sun_path_months[SUN_PATHS];

typedef struct sun_diagram {
    const sun_question *q;
    double x, y, radius; /* of the zenith; of the horizon */
    int offset;          /* s east of UTC, at which hours count */
    bool clocks_change;  /* in that year */
    bool december;       /* the sun is highest there in December, not in June */
    double spare_deg;    /* an azimuth between two hours' lines, where the sun comes last */
    sun_point days[SUN_PATHS][SUN_DAY_POINTS], date[SUN_DAY_POINTS];
    sun_point hours[24][SUN_HOUR_POINTS];
    sun_point names[SUN_PATHS]; /* on the days' lines, between two hours' */
    sun_place sun;              /* at the moment, if the question has one */
    sun_series series;          /* while it is found */
} sun_diagram;

/* Fills all behind q, x, y and radius. False, with *err, for what sun_at() refuses. */
bool sun_diagram_find(sun_diagram *d, lux_error *err);

double sun_diagram_radius(const sun_diagram *d, double elevation_deg);
sun_point sun_diagram_point(const sun_diagram *d, double azimuth_deg, double radius);
double sun_diagram_azimuth(const sun_diagram *d, const sun_point *p);

/* Where the way from a to b meets the rim, one of them above and one below the horizon. */
sun_point sun_diagram_rim(const sun_diagram *d, const sun_point *a, const sun_point *b);

static inline bool sun_point_up(const sun_point *p) { return p->elevation_deg >= 0.0; }

#endif
