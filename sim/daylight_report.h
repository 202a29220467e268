/* sim/daylight_report.h -- the daylight of a study in words: where, when, the sun, the sky. */
#ifndef SIM_DAYLIGHT_REPORT_H
#define SIM_DAYLIGHT_REPORT_H

#include "sim/moment_sky.h"
#include "sim/scene.h"

typedef struct daylight_report {
    bool given;
    moment at;          /* of a series the first */
    moment last;        /* of a series */
    int count;          /* of a series; 0: it is none */
    moment_light light; /* of a panorama: what it gives without its sun */
} daylight_report;

/* Of the scene of one moment of study s, which has a series or not; what it needs is made in a.
 * False, with *err. */
bool daylight_report_of(arena *a, const study *s, const scene *made, daylight_report *out,
                        lux_error *err);

/* On stdout: lines for people; a member ("\"daylight\":...") of a JSON object. */
void daylight_report_print(const study *s, const daylight_report *r);
void daylight_report_json(const study *s, const daylight_report *r);

#endif
