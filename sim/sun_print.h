/* sim/sun_print.h -- what the reports of `lux4 sun` are printed with. */
#ifndef SIM_SUN_PRINT_H
#define SIM_SUN_PRINT_H

#include "sim/sun_report.h"

/* lx, square to the beam, under the clear sky of the question. */
double sun_direct_lx(const sun_question *q, const sun_place *s);

/* "03:44+03:00", to the nearest minute, as clocks of the zone show it. */
enum { SUN_CLOCK_TEXT = 32 };
void sun_clock_print(char out[SUN_CLOCK_TEXT], const clock_zone *zone, double at);

/* "09:28:35" of hours in [0, 24]. */
enum { SUN_HOURS_TEXT = 16 };
void sun_hours_print(char out[SUN_HOURS_TEXT], double hours);

/* A line: what it is, its value, and unless "" a note behind. */
void sun_words(FILE *out, const char *label, const char *value, const char *note);
void sun_number(FILE *out, const char *label, int digits, double value, const char *note);

/* Lines: place and clocks; air; sunrise, transit, sunset, day length; how all is meant (`lit`:
 * of the light, too). */
void sun_print_place(FILE *out, const sun_question *q);
void sun_print_air(FILE *out, const sun_question *q);
void sun_print_events(FILE *out, const sun_question *q, const sun_day *d);
void sun_print_notes(FILE *out, const sun_question *q, bool lit);

/* Members of a JSON object, "key":value with a comma behind; null where not finite. */
void sun_json_number(FILE *out, const char *key, double value);
void sun_json_moment(FILE *out, const char *key, const clock_zone *zone, double at);
/* The same, several, without the last comma. */
void sun_json_day(FILE *out, const sun_question *q, const sun_day *d);
void sun_json_place(FILE *out, const sun_question *q, const sun_place *s);
void sun_json_site(FILE *out, const sun_question *q, bool lit);

#endif
