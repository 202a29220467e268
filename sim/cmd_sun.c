/* sim/cmd_sun.c -- lux4 sun: where the sun stands, at a moment, on a day, in a year; drawn. */
#include "sim/command.h"
#include "sim/sun_report.h"

#include <string.h>

/* What sky/ refuses, with the option that it was given by. */
static void *refused(const char *option, lux_error *err)
{
    lux_error why = *err;
    return failed(err, why.code, "%s: %s", option, why.text);
}

/* A year alone: four digits. */
static bool is_year(const char *text)
{
    return strlen(text) == 4 && strspn(text, "0123456789") == 4;
}

static bool read_time(const sun_line *l, clock_text *out, lux_error *err)
{
    if (!l->time)
        return failed(err, ERR_ARGUMENT, "--time: which %s? (%s)",
                      l->year  ? "year"
                      : l->day ? "date"
                               : "date and time",
                      l->year  ? "--time 2026"
                      : l->day ? "--time 2026-06-21"
                               : "--time 2026-06-21T10:00");
    if (is_year(l->time)) {
        if (!l->year)
            return failed(err, ERR_ARGUMENT, "--time %s: expected a %s; a year alone is for --year",
                          l->time, l->day ? "date, 2026-06-21" : "date and time, 2026-06-21T10:00");
        int year = 0;
        for (const char *c = l->time; *c; c++)
            year = 10 * year + (*c - '0');
        *out = (clock_text){ .time = { .year = year, .month = 1, .day = 1 } };
        return true;
    }
    if (!clock_read(out, l->time, err))
        return refused("--time", err);
    if (!out->has_time && !l->day && !l->year)
        return failed(err, ERR_ARGUMENT,
                      "--time %s: expected a time of day, too (%sT10:00); a date alone is for "
                      "--day, or for --year",
                      l->time, l->time);
    return true;
}

/* The zone that the user names; without one, the offset of the time. */
static bool read_zone(arena *a, const sun_line *l, const clock_text *t, sun_question *out,
                      lux_error *err)
{
    char offset[SUN_OFFSET_TEXT];
    if (!l->zone && !t->has_offset)
        return failed(err, ERR_ARGUMENT,
                      "--zone: whose clocks? --time %s has no offset; expected --zone with an IANA "
                      "name (Europe/Moscow) or an offset (+03:00)",
                      l->time);
    sun_offset_print(offset, t->offset);
    const char *text = l->zone ? l->zone : offset;
    char *kept       = arena_array(a, char, strlen(text) + 1, err);
    if (!kept)
        return false;
    strcpy(kept, text);
    out->zone_name = kept;
    out->zone      = clock_zone_new(a, kept, err);
    return out->zone || refused("--zone", err);
}

static bool read_place(const sun_line *l, sun_question *out, lux_error *err)
{
    if (!l->place)
        return failed(err, ERR_ARGUMENT, "--place: where? (--place \"55.7558N 37.6173E\")");
    out->place = l->place;
    if (!site_read(&out->at, l->place, err))
        return refused("--place", err);
    if (!isnan(l->altitude_m))
        out->at.altitude_m = l->altitude_m;
    sun_air given          = { .pressure_hpa = l->pressure_hpa, .temperature_c = l->temperature_c };
    out->air               = sun_air_standard(out->at.altitude_m, &given);
    out->pressure_given    = !isnan(given.pressure_hpa);
    out->temperature_given = !isnan(given.temperature_c);
    out->turbidity         = isnan(l->turbidity) ? 3.0 : l->turbidity;
    return true;
}

static bool read_question(const command_context *c, sun_question *out, lux_error *err)
{
    const sun_line *l = &c->line->sun;
    clock_text t;
    if (c->line->file_count)
        return failed(err, ERR_ARGUMENT,
                      "%s: lux4 sun takes options alone; a value with a blank needs quotes: "
                      "--place \"55.7558N 37.6173E\"",
                      c->line->files[0]);
    if (l->day && l->year)
        return failed(err, ERR_ARGUMENT, "--day, --year: one of them at a time, please");
    if (!read_place(l, out, err) || !read_time(l, &t, err) || !read_zone(c->a, l, &t, out, err))
        return false;
    out->json       = c->line->json;
    out->has_moment = t.has_time;
    out->has_date   = !is_year(l->time);
    out->date       = t.time;
    if (!t.has_time)
        return true;
    if (!clock_moment(out->zone, &t, &out->moment, err))
        return refused("--time", err);
    out->date = clock_local(out->zone, out->moment);
    return true;
}

static bool plot(const sun_question *q, const command_line *l, lux_error *err)
{
    const char *end = strrchr(l->plot, '.');
    if (!end || strcmp(end, ".svg") != 0)
        return failed(err, ERR_ARGUMENT, "--plot %s: expected a file *.svg", l->plot);
    return output_free(l->plot, l->place.overwrite, err) && sun_plot(q, l->plot, err);
}

static int sun_command(const command_context *c, lux_error *err)
{
    const sun_line *l = &c->line->sun;
    sun_question q    = { 0 };
    if (!read_question(c, &q, err))
        return exit_code_of(err, true);
    if (c->line->plot && !plot(&q, c->line, err))
        return exit_code_of(err, false);
    bool good = l->year  ? sun_report_year(stdout, &q, err)
                : l->day ? sun_report_day(stdout, &q, err)
                         : sun_report_moment(stdout, &q, err);
    if (good && c->line->plot && !q.json)
        printf("written: %s\n", c->line->plot);
    return good ? EXIT_DONE : exit_code_of(err, true);
}

const command command_sun = {
    .name    = "sun",
    .files   = "--place PLACE --time TIME",
    .summary = "where the sun stands at a place: a moment, a day, a year, a sun-path diagram",
    .help =
        "    lux4 sun --place \"55.7558N 37.6173E\" --zone Europe/Moscow --time 2026-06-21T10:00\n"
        "    lux4 sun --place \"33:52:00S 151:13:00E\" --zone Australia/Sydney --day --time "
        "2026-12-21\n"
        "    lux4 sun --place \"37N 413000 6180000\" --zone +03:00 --year --time 2026 --plot "
        "paths.svg\n\n"
        "Places: latitude first; decimal degrees, degrees minutes seconds, UTM or UPS, MGRS.\n"
        "Without --zone the time needs an offset (2026-06-21T10:00+03:00), and is shown at it.\n"
        "A time that clocks skip, or show twice, is refused, and both readings are told.\n"
        "Years 1900 to 2100.\n\n"
        "Azimuth counts clockwise from true north. True elevation is that without air, apparent\n"
        "elevation is refracted; both are topocentric, of the disk's centre. Sunrise and sunset:\n"
        "the upper limb at the level horizon, true elevation of the centre -0.8333 degrees,\n"
        "whatever air or altitude; on days without, JSON has null. Direct normal illuminance is\n"
        "that of the sun square to its beam under a clear sky, by the formula that is named.\n"
        "--day: each full hour that clocks show on that date. --year: each day. JSON then has\n"
        "`hours` or `days`, with the fields that it has for a moment: azimuth_deg, elevation_deg,\n"
        "apparent_elevation_deg, declination_deg, equation_of_time_min, solar_time, distance_au,\n"
        "diameter_deg, direct_normal_lx; sunrise, transit, sunset, day_length_h.\n"
        "--plot: the sun's paths of the 21st of each month and of the date asked for, and where\n"
        "it stands at each hour over that year (full lines January to June, broken July to\n"
        "December). As on a map north is up and east on the right; stereographic, the horizon\n"
        "its rim. Hours are those of clocks, at one offset, which is named. With a time of day "
        "the\n"
        "sun is drawn where it stands.\n",
    .options = " --place --time --zone --altitude --pressure --temperature --turbidity --day "
               "--year --plot --overwrite --json --quiet ",
    .run     = sun_command,
};
