/* sim/daylight_report.c -- see daylight_report.h. */
#include "sim/daylight_report.h"

#include "core/color.h"
#include "sim/command.h"

#include <limits.h>

bool daylight_report_of(arena *a, const study *s, const scene *made, daylight_report *out,
                        lux_error *err)
{
    notices unheard = { .a = a }; /* they were heard when the scene was made */
    *out            = (daylight_report){ .given = study_has_daylight(s) };
    if (!out->given)
        return true;
    out->at = made->moments[0];
    if (s->when.given && s->when.series) {
        const moment *all = moments_of(a, s, &s->when, &out->count, &unheard, err);
        if (!all)
            return false;
        out->last = all[out->count - 1];
    }
    if (s->sky.model != STUDY_SKY_PANORAMA)
        return moment_light_of(a, made->study, &out->at, &out->light, err);
    vec3 picture = made->sky_count ? made->skies[0].sky->horizontal : (vec3){ 0, 0, 0 };
    out->light   = (moment_light){ .sky_lx = LUMENS_PER_WATT * (double)rgb_luminance(picture),
                                   .sky_by = isnan(s->sky.horizontal) ? "the picture" : "as given" };
    return true;
}

/* ---- for people ------------------------------------------------------------------------------ */

static void print_site(const study_site *place)
{
    if (!place->given)
        return;
    printf("  place      %.5f, %.5f degrees (north, east), %g m; true north %g degrees clockwise "
           "of +y\n",
           place->at.latitude_deg, place->at.longitude_deg, place->at.altitude_m, place->north_deg);
}

static void print_time(const study_site *place, const char *what, const moment *m)
{
    char utc[CLOCK_TEXT];
    if (isnan(m->at))
        return;
    clock_print(utc, NULL, m->at);
    printf("  %-10s %s%s%s, UTC %.16s\n", what, m->text, place->zone_name ? " " : "",
           place->zone_name ? place->zone_name : "", utc);
}

static void print_sun(const study *s, const daylight_report *r)
{
    const sun_place *sun = &r->at.sun;
    if (!r->at.sun_known || s->sky.model == STUDY_SKY_PANORAMA)
        return;
    printf("  sun        azimuth %.2f, elevation %.2f degrees, apparent %.2f", sun->azimuth_deg,
           sun->elevation_deg, sun->apparent_elevation_deg);
    if (!study_has_sun(s))
        puts("; off");
    else if (r->light.night)
        puts("; below the horizon");
    else
        printf("; %.0f lx square to it (%s)\n", r->light.sun_lx, r->light.sun_by);
}

static void print_sky(const study *s, const daylight_report *r)
{
    printf("  sky        %s", s->sky.name);
    if (s->sky.model == STUDY_SKY_CIE && s->sky.type >= 1 && s->sky.type <= 15)
        printf(", CIE type %d", s->sky.type);
    if (s->sky.model == STUDY_SKY_PANORAMA) {
        putchar(' ');
        print_words(stdout, s->sky.file, 0, INT_MAX);
    }
    printf("; %.0f lx on level ground (%s)\n", r->light.sky_lx, r->light.sky_by);
    if (s->sky.model == STUDY_SKY_PEREZ && r->light.sky)
        printf("             clearness %.3f, brightness %.3f%s\n", r->light.perez.clearness,
               r->light.perez.brightness,
               r->light.perez.clamped ? ": beyond what the model was made from, taken at its border"
                                      : "");
}

void daylight_report_print(const study *s, const daylight_report *r)
{
    if (!r->given)
        return;
    puts("daylight");
    print_site(&s->site);
    if (r->count)
        printf("  series     %d moments; sun and sky are those of the first\n", r->count);
    print_time(&s->site, r->count ? "first" : "time", &r->at);
    if (r->count)
        print_time(&s->site, "last", &r->last);
    print_sun(s, r);
    print_sky(s, r);
}

/* ---- for programs ---------------------------------------------------------------------------- */

static void json_text(const char *key, const char *text)
{
    printf("\"%s\":", key);
    if (text && *text)
        json_string(stdout, text);
    else
        fputs("null", stdout);
    putchar(',');
}

static void json_value(const char *key, bool known, double value)
{
    printf("\"%s\":", key);
    json_number(stdout, known ? value : (double)NAN);
    putchar(',');
}

static void json_site(const study_site *place)
{
    json_value("latitude_deg", place->given, place->at.latitude_deg);
    json_value("longitude_deg", place->given, place->at.longitude_deg);
    json_value("altitude_m", place->given, place->at.altitude_m);
    json_value("north_deg", true, place->north_deg);
    json_text("zone", place->zone_name);
}

static void json_sun(const study *s, const daylight_report *r)
{
    const sun_place *sun = &r->at.sun;
    bool pictured        = s->sky.model == STUDY_SKY_PANORAMA;
    json_value("sun_azimuth_deg", r->at.sun_known, sun->azimuth_deg);
    json_value("sun_elevation_deg", r->at.sun_known, sun->elevation_deg);
    json_value("sun_apparent_elevation_deg", r->at.sun_known, sun->apparent_elevation_deg);
    json_value("sun_lx", !pictured, r->light.sun_lx);
    json_text("sun_formula", study_has_sun(s) ? r->light.sun_by : NULL);
}

void daylight_report_json(const study *s, const daylight_report *r)
{
    char utc[CLOCK_TEXT] = "";
    fputs("\"daylight\":", stdout);
    if (!r->given) {
        fputs("null", stdout);
        return;
    }
    putchar('{');
    json_site(&s->site);
    if (!isnan(r->at.at))
        clock_print(utc, NULL, r->at.at);
    json_text("time", r->at.text);
    json_text("time_utc", utc);
    json_text("last", r->count ? r->last.text : NULL);
    printf("\"moments\":%d,", r->count ? r->count : 1);
    json_sun(s, r);
    json_text("sky", s->sky.name);
    json_value("cie_type", s->sky.model == STUDY_SKY_CIE && s->sky.type >= 1 && s->sky.type <= 15,
               s->sky.type);
    json_text("sky_formula", r->light.sky_by);
    fputs("\"sky_lx\":", stdout);
    json_number(stdout, r->light.sky_lx);
    putchar('}');
}
