/* sim/sun_print.c -- see sun_print.h. */
#include "sim/sun_print.h"

#include "sim/command.h"
#include "sky/sky.h"

#include <math.h>
#include <string.h>

double sun_direct_lx(const sun_question *q, const sun_place *s)
{
    return sky_sun_lx(s->apparent_elevation_deg, q->at.altitude_m, q->turbidity, s->distance_au);
}

/* ---- pieces of text -------------------------------------------------------------------------- */

void sun_offset_print(char out[SUN_OFFSET_TEXT], int offset_s)
{
    int size = offset_s < 0 ? -offset_s : offset_s, seconds = size % 60;
    int n = snprintf(out, SUN_OFFSET_TEXT, "%c%02d:%02d", offset_s < 0 ? '-' : '+', size / 3600,
                     size / 60 % 60);
    if (seconds)
        snprintf(out + n, (size_t)(SUN_OFFSET_TEXT - n), ":%02d", seconds);
}

void sun_site_print(char out[SUN_SITE_TEXT], const site *at)
{
    snprintf(out, SUN_SITE_TEXT, "%.6f %c, %.6f %c", fabs(at->latitude_deg),
             at->latitude_deg < 0.0 ? 'S' : 'N', fabs(at->longitude_deg),
             at->longitude_deg < 0.0 ? 'W' : 'E');
}

void sun_clock_print(char out[SUN_CLOCK_TEXT], const clock_zone *zone, double at)
{
    double minute = 60.0 * floor(at / 60.0 + 0.5);
    civil_time t  = clock_local(zone, minute);
    char offset[SUN_OFFSET_TEXT];
    sun_offset_print(offset, clock_offset(zone, minute));
    snprintf(out, SUN_CLOCK_TEXT, "%02d:%02d%s", t.hour, t.minute, offset);
}

void sun_hours_print(char out[SUN_HOURS_TEXT], double hours)
{
    int seconds = (int)lround(hours * 3600.0) % 86400;
    snprintf(out, SUN_HOURS_TEXT, "%02d:%02d:%02d", seconds / 3600, seconds / 60 % 60,
             seconds % 60);
}

void sun_words(FILE *out, const char *label, const char *value, const char *note)
{
    fprintf(out, "  %-34s%s%s%s\n", label, value, note[0] ? "  " : "", note);
}

void sun_number(FILE *out, const char *label, int digits, double value, const char *note)
{
    char text[32];
    snprintf(text, sizeof text, "%.*f", digits, value);
    sun_words(out, label, text, note);
}

void sun_print_air(FILE *out, const sun_question *q)
{
    char text[80];
    snprintf(text, sizeof text, "%.2f hPa%s, %.1f C%s", q->air.pressure_hpa,
             q->pressure_given ? "" : " (standard)", q->air.temperature_c,
             q->temperature_given ? "" : " (standard)");
    sun_words(out, "air", text, "");
}

void sun_print_place(FILE *out, const sun_question *q)
{
    char text[SUN_SITE_TEXT + 32];
    sun_site_print(text, &q->at);
    size_t n = strlen(text);
    snprintf(text + n, sizeof text - n, ", %g m", q->at.altitude_m);
    sun_words(out, "place", text, "");
    sun_words(out, "clocks", q->zone_name, "");
}

void sun_print_notes(FILE *out, const sun_question *q, bool lit)
{
    if (lit)
        fprintf(out, "Direct normal illuminance: clear sky, %s, Linke turbidity %g.\n",
                sky_sun_formula(), q->turbidity);
    fputs("Sunrise and sunset: the upper limb at the level horizon, air of 34' refraction.\n"
          "UT1 is taken as UTC: worth 0.004 degrees at most.\n",
          out);
}

static void print_event(FILE *out, const char *label, const sun_question *q, double at,
                        const char *note)
{
    char text[CLOCK_TEXT];
    if (isnan(at)) {
        sun_words(out, label, "none on this date", "");
        return;
    }
    clock_print(text, q->zone, 60.0 * floor(at / 60.0 + 0.5));
    sun_words(out, label, text, note);
}

void sun_print_events(FILE *out, const sun_question *q, const sun_day *d)
{
    char note[48], length[48];
    snprintf(note, sizeof note, "%.2f degrees high", d->transit_elevation_deg);
    if (d->always_up)
        sun_words(out, "sunrise, sunset", "none: the sun is up all day (polar day)", "");
    else if (d->always_down)
        sun_words(out, "sunrise, sunset", "none: the sun stays down all day (polar night)", "");
    else
        print_event(out, "sunrise", q, d->sunrise, "");
    print_event(out, "transit", q, d->transit, note);
    if (!d->always_up && !d->always_down)
        print_event(out, "sunset", q, d->sunset, "");
    int minutes = (int)lround(d->length_h * 60.0);
    snprintf(length, sizeof length, "%d h %02d min", minutes / 60, minutes % 60);
    sun_words(out, "day length", length, "");
}

/* ---- JSON ------------------------------------------------------------------------------------ */

void sun_json_number(FILE *out, const char *key, double value)
{
    if (isfinite(value))
        fprintf(out, "\"%s\":%.9g,", key, value);
    else
        fprintf(out, "\"%s\":null,", key);
}

void sun_json_moment(FILE *out, const char *key, const clock_zone *zone, double at)
{
    char text[CLOCK_TEXT];
    if (isnan(at)) {
        fprintf(out, "\"%s\":null,", key);
        return;
    }
    clock_print(text, zone, at);
    fprintf(out, "\"%s\":\"%s\",", key, text);
}

void sun_json_day(FILE *out, const sun_question *q, const sun_day *d)
{
    sun_json_moment(out, "sunrise", q->zone, d->sunrise);
    sun_json_moment(out, "transit", q->zone, d->transit);
    sun_json_moment(out, "sunset", q->zone, d->sunset);
    sun_json_number(out, "transit_elevation_deg", d->transit_elevation_deg);
    sun_json_number(out, "day_length_h", d->length_h);
    fprintf(out, "\"always_up\":%s,\"always_down\":%s", d->always_up ? "true" : "false",
            d->always_down ? "true" : "false");
}

void sun_json_place(FILE *out, const sun_question *q, const sun_place *s)
{
    char hours[SUN_HOURS_TEXT];
    sun_hours_print(hours, s->solar_time_h);
    sun_json_number(out, "azimuth_deg", s->azimuth_deg);
    sun_json_number(out, "elevation_deg", s->elevation_deg);
    sun_json_number(out, "apparent_elevation_deg", s->apparent_elevation_deg);
    sun_json_number(out, "declination_deg", s->declination_deg);
    sun_json_number(out, "equation_of_time_min", s->equation_of_time_min);
    fprintf(out, "\"solar_time\":\"%s\",", hours);
    sun_json_number(out, "distance_au", s->distance_au);
    sun_json_number(out, "diameter_deg", s->diameter_deg);
    fprintf(out, "\"direct_normal_lx\":%.6g", sun_direct_lx(q, s));
}

void sun_json_site(FILE *out, const sun_question *q, bool lit)
{
    sun_json_number(out, "latitude_deg", q->at.latitude_deg);
    sun_json_number(out, "longitude_deg", q->at.longitude_deg);
    sun_json_number(out, "altitude_m", q->at.altitude_m);
    fputs("\"zone\":", out);
    json_string(out, q->zone_name);
    if (!lit)
        return;
    fputc(',', out);
    sun_json_number(out, "pressure_hpa", q->air.pressure_hpa);
    sun_json_number(out, "temperature_c", q->air.temperature_c);
    sun_json_number(out, "turbidity", q->turbidity);
    fputs("\"direct_normal_formula\":", out);
    json_string(out, sky_sun_formula());
}
