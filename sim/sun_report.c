/* sim/sun_report.c -- one moment of the sun as text and JSON; see sun_report.h. */
#include "sim/sun_print.h"

#include <math.h>

/* The standard atmosphere, ISO 2533:1975, up to 11 km: T = 288.15 K - 6.5 K/km, and the pressure
 * that a column of such air has. */
sun_air sun_air_standard(double altitude_m, const sun_air *given)
{
    const double lapse = 0.0065, sea_k = 288.15, sea_hpa = 1013.25, exponent = 5.25588;
    double kelvin = sea_k - lapse * altitude_m;
    sun_air air   = *given;
    if (isnan(air.pressure_hpa))
        air.pressure_hpa = sea_hpa * pow(kelvin / sea_k, exponent);
    if (isnan(air.temperature_c))
        air.temperature_c = kelvin - 273.15;
    return air;
}

sun_height sun_height_of(const sun_place *s)
{
    double radius = 0.5 * s->diameter_deg;
    if (s->apparent_elevation_deg < -radius)
        return SUN_BELOW;
    return s->apparent_elevation_deg < radius ? SUN_ON_HORIZON : SUN_UP;
}

static void print_moment(FILE *out, const sun_question *q, const sun_place *s, const sun_day *d)
{
    static const char *const heights[] = { "the sun is below the horizon",
                                           "the sun is on the horizon, part of its disk up", "" };
    char local[CLOCK_TEXT], utc[CLOCK_TEXT], hours[SUN_HOURS_TEXT], height[80] = "";
    clock_print(local, q->zone, q->moment);
    clock_print(utc, NULL, q->moment);
    sun_hours_print(hours, s->solar_time_h);
    if (sun_height_of(s) != SUN_UP)
        snprintf(height, sizeof height, ": %s", heights[sun_height_of(s)]);

    fprintf(out, "%s%s\n", local, height);
    sun_words(out, "UTC", utc, "");
    sun_print_place(out, q);
    sun_number(out, "azimuth (deg)", 3, s->azimuth_deg, "clockwise from true north");
    sun_number(out, "elevation, true (deg)", 3, s->elevation_deg, "");
    sun_number(out, "elevation, apparent (deg)", 3, s->apparent_elevation_deg, "refracted");
    sun_print_air(out, q);
    sun_number(out, "declination (deg)", 3, s->declination_deg, "");
    sun_number(out, "equation of time (min)", 2, s->equation_of_time_min, "");
    sun_words(out, "solar time", hours, "apparent");
    sun_number(out, "distance (au)", 6, s->distance_au, "");
    sun_number(out, "diameter (deg)", 4, s->diameter_deg, "");
    sun_number(out, "direct normal illuminance (lx)", 0, sun_direct_lx(q, s), "");
    sun_print_events(out, q, d);
    sun_print_notes(out, q, true);
}

bool sun_report_moment(FILE *out, const sun_question *q, lux_error *err)
{
    sun_place s;
    sun_day d;
    if (!sun_at(&q->at, &q->air, q->moment, &s, err) ||
        !sun_day_of(&q->at, q->zone, &q->date, &d, err))
        return false;
    if (!q->json) {
        print_moment(out, q, &s, &d);
        return true;
    }
    fputc('{', out);
    sun_json_moment(out, "time", q->zone, q->moment);
    sun_json_place(out, q, &s);
    fputc(',', out);
    sun_json_day(out, q, &d);
    fputc(',', out);
    sun_json_site(out, q, true);
    fputs("}\n", out);
    return true;
}
