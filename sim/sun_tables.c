/* sim/sun_tables.c -- the sun's hours of a day and days of a year; see sun_report.h. */
#include "sim/sun_print.h"

#include <math.h>

/* ---- a day ----------------------------------------------------------------------------------- */

enum { MOST_HOURS = 48 }; /* each clock hour twice */

typedef struct sun_hours {
    int count;
    double moment[MOST_HOURS];
    sun_place place[MOST_HOURS];
} sun_hours;

static bool find_hours(const sun_question *q, sun_hours *h, lux_error *err)
{
    sun_series series = { 0 };
    h->count          = 0;
    for (int hour = 0; hour < 24; hour++) {
        civil_time t = {
            .year = q->date.year, .month = q->date.month, .day = q->date.day, .hour = hour
        };
        double shown[2];
        int times = clock_moments(q->zone, &t, shown);
        for (int i = 0; i < times; i++, h->count++) {
            h->moment[h->count] = shown[i];
            if (!sun_at_next(&series, &q->at, &q->air, shown[i], &h->place[h->count], err))
                return false;
        }
    }
    return true;
}

static void print_hours(FILE *out, const sun_question *q, const sun_hours *h)
{
    fprintf(out, "\n  %-12s %9s %9s %9s  %-9s %9s\n", "time", "azimuth", "elevation", "apparent",
            "solar", "direct lx");
    for (int i = 0; i < h->count; i++) {
        const sun_place *s = &h->place[i];
        char time[SUN_CLOCK_TEXT], solar[SUN_HOURS_TEXT], light[24] = "-";
        sun_clock_print(time, q->zone, h->moment[i]);
        sun_hours_print(solar, s->solar_time_h);
        if (sun_height_of(s) != SUN_BELOW)
            snprintf(light, sizeof light, "%.0f", sun_direct_lx(q, s));
        fprintf(out, "  %-12s %9.3f %9.3f %9.3f  %-9s %9s\n", time, s->azimuth_deg,
                s->elevation_deg, s->apparent_elevation_deg, solar, light);
    }
}

static void print_day(FILE *out, const sun_question *q, const sun_hours *h, const sun_day *d)
{
    fprintf(out, "%04d-%02d-%02d\n", q->date.year, q->date.month, q->date.day);
    sun_print_place(out, q);
    sun_print_air(out, q);
    sun_print_events(out, q, d);
    print_hours(out, q, h);
    fputs("\nAngles in degrees, azimuth clockwise from true north; apparent: the elevation as "
          "refracted.\nSolar time is apparent. -: the sun is below the horizon.\n",
          out);
    sun_print_notes(out, q, true);
}

static void json_day(FILE *out, const sun_question *q, const sun_hours *h, const sun_day *d)
{
    fprintf(out, "{\"date\":\"%04d-%02d-%02d\",", q->date.year, q->date.month, q->date.day);
    sun_json_site(out, q, true);
    fputc(',', out);
    sun_json_day(out, q, d);
    fputs(",\"hours\":[", out);
    for (int i = 0; i < h->count; i++) {
        fputs(i ? ",{" : "{", out);
        sun_json_moment(out, "time", q->zone, h->moment[i]);
        sun_json_place(out, q, &h->place[i]);
        fputc('}', out);
    }
    fputs("]}\n", out);
}

bool sun_report_day(FILE *out, const sun_question *q, lux_error *err)
{
    sun_hours h;
    sun_day d;
    if (!sun_day_of(&q->at, q->zone, &q->date, &d, err) || !find_hours(q, &h, err))
        return false;
    if (q->json)
        json_day(out, q, &h, &d);
    else
        print_day(out, q, &h, &d);
    return true;
}

/* ---- a year ---------------------------------------------------------------------------------- */

enum { MOST_DAYS = 366 };

typedef struct sun_days {
    int count;
    civil_time date[MOST_DAYS];
    sun_day day[MOST_DAYS];
} sun_days;

/* A date that clocks there never showed: where the date line was moved, a day was left out. */
static bool is_shown(const clock_zone *zone, const civil_time *date)
{
    double moment[2];
    civil_time noon = *date;
    noon.hour       = 12;
    return clock_moments(zone, &noon, moment) > 0;
}

static bool find_days(const sun_question *q, sun_days *y, lux_error *err)
{
    civil_time first = { .year = q->date.year, .month = 1, .day = 1 };
    double begin     = clock_from_civil(&first);
    y->count         = 0;
    for (int i = 0; i < MOST_DAYS; i++) {
        civil_time date = clock_local(NULL, begin + 86400.0 * i);
        if (date.year != q->date.year)
            break;
        if (!is_shown(q->zone, &date))
            continue;
        if (!sun_day_of(&q->at, q->zone, &date, &y->day[y->count], err))
            return false;
        y->date[y->count++] = date;
    }
    return true;
}

static void print_cell(FILE *out, const sun_question *q, double moment, const char *without)
{
    char text[SUN_CLOCK_TEXT];
    if (!isnan(moment))
        sun_clock_print(text, q->zone, moment);
    fprintf(out, "  %-11s", isnan(moment) ? without : text);
}

static void print_row(FILE *out, const sun_question *q, const civil_time *date, const sun_day *d)
{
    int minutes   = (int)lround(d->length_h * 60.0);
    char noon[24] = "-";
    if (!isnan(d->transit_elevation_deg))
        snprintf(noon, sizeof noon, "%.2f", d->transit_elevation_deg);
    fprintf(out, "  %04d-%02d-%02d", date->year, date->month, date->day);
    print_cell(out, q, d->sunrise, d->always_up ? "up all day" : d->always_down ? "down" : "none");
    print_cell(out, q, d->transit, "none");
    print_cell(out, q, d->sunset, d->always_up ? "up all day" : d->always_down ? "down" : "none");
    fprintf(out, "  %2d h %02d min  %8s\n", minutes / 60, minutes % 60, noon);
}

static void print_year(FILE *out, const sun_question *q, const sun_days *y)
{
    fprintf(out, "%04d\n", q->date.year);
    sun_print_place(out, q);
    for (int i = 0; i < y->count; i++) {
        if (i == 0 || y->date[i].month != y->date[i - 1].month)
            fprintf(out, "\n  %-10s  %-11s  %-11s  %-11s  %-11s  %8s\n", "date", "sunrise",
                    "transit", "sunset", "day length", "noon deg");
        print_row(out, q, &y->date[i], &y->day[i]);
    }
    fputs("\nnoon deg: the true elevation at transit. up all day: polar day; down: polar night.\n"
          "none: not on that date of the clock.\n",
          out);
    sun_print_notes(out, q, false);
}

static void json_year(FILE *out, const sun_question *q, const sun_days *y)
{
    fprintf(out, "{\"year\":%d,", q->date.year);
    sun_json_site(out, q, false);
    fputs(",\"days\":[", out);
    for (int i = 0; i < y->count; i++) {
        fprintf(out, "%s{\"date\":\"%04d-%02d-%02d\",", i ? "," : "", y->date[i].year,
                y->date[i].month, y->date[i].day);
        sun_json_day(out, q, &y->day[i]);
        fputc('}', out);
    }
    fputs("]}\n", out);
}

bool sun_report_year(FILE *out, const sun_question *q, lux_error *err)
{
    sun_days y;
    if (!find_days(q, &y, err))
        return false;
    if (q->json)
        json_year(out, q, &y);
    else
        print_year(out, q, &y);
    return true;
}
