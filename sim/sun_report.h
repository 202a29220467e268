/* sim/sun_report.h -- what `lux4 sun` says of the sun at a place: a moment, a day, a year.
 *
 * Each prints to `out` labelled figures or a table, or with q->json one object, as `lux4 help sun`
 * has it; nothing before all is known. False, with *err, for what sky/sun.h refuses.
 */
#ifndef SIM_SUN_REPORT_H
#define SIM_SUN_REPORT_H

#include "sky/sun.h"

#include <stdio.h>

typedef struct sun_question {
    const char *place; /* as the user wrote it */
    site at;
    sun_air air;                            /* nothing left to be assumed: no NAN */
    bool pressure_given, temperature_given; /* else those of the standard atmosphere */
    const clock_zone *zone;                 /* whose clocks are shown */
    const char *zone_name;
    double turbidity; /* Linke's, [1, 20] */
    double moment;    /* the one asked for, if has_moment */
    bool has_moment;  /* else a date alone, or */
    bool has_date;    /* a year alone */
    civil_time date;  /* on clocks of the zone: year, month, day */
    bool json;
} sun_question;

/* What is not given is that of the standard atmosphere (ISO 2533) at the altitude. */
sun_air sun_air_standard(double altitude_m, const sun_air *given);

bool sun_report_moment(FILE *out, const sun_question *q, lux_error *err);

/* Every full hour that clocks show on the date, twice where they show it twice. */
bool sun_report_day(FILE *out, const sun_question *q, lux_error *err);

/* Sunrise, transit, sunset, day length and noon elevation of each day. */
bool sun_report_year(FILE *out, const sun_question *q, lux_error *err);

/* Draws the sun's paths over the year of the date, stereographic, north up: of the 21st of each
 * month, of the date, and for each hour of the day; the sun where it stands at the moment. The
 * horizon is the rim, the zenith the middle; elevations are apparent. */
bool sun_plot(const sun_question *q, const char *path, lux_error *err);

/* ---- between report and plot ----------------------------------------------------------------- */

/* "+03:00"; of zones of old with seconds "+02:30:17". */
enum { SUN_OFFSET_TEXT = 16 };
void sun_offset_print(char out[SUN_OFFSET_TEXT], int offset_s);

/* "55.755800 N, 37.617300 E". */
enum { SUN_SITE_TEXT = 64 };
void sun_site_print(char out[SUN_SITE_TEXT], const site *at);

/* How the sun stands to the horizon. */
typedef enum sun_height { SUN_BELOW, SUN_ON_HORIZON, SUN_UP } sun_height;
sun_height sun_height_of(const sun_place *s);

#endif
