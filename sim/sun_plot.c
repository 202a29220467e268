/* sim/sun_plot.c -- the sun-path diagram as SVG; see sun_report.h.
 *
 * Stereographic, from the nadir: a direction z degrees off the zenith is drawn tan(z / 2) of the
 * rim's radius from the middle, so that circles in the sky (parallels of elevation, days) are
 * circles on paper, and angles are true.
 *
 * Lines of an hour are drawn at one offset from UTC, that of the date asked for: over the year the
 * sun makes a figure of eight there, by the equation of time. Paths near the same declination, six
 * months apart about a solstice, are drawn once.
 */
#include "core/file.h"
#include "sim/sun_report.h"
#include "sim/svg.h"

#include <math.h>
#include <string.h>

static const double WIDTH = 760.0, HEIGHT = 780.0; /* px, of the picture */
static const double CENTRE_X = 380.0, CENTRE_Y = 378.0, RADIUS = 262.0;
static const double BAND = 24.0; /* around the rim, with azimuths */
static const double DEG = M_PI / 180.0, DAY_S = 86400.0, HOUR_S = 3600.0;

typedef struct sun_diagram {
    FILE *out;
    const sun_question *q;
    int offset; /* s, at which hours count */
    int summer; /* the month of whose 21st the paths at this latitude are the highest */
} sun_diagram;

/* ---- places ---------------------------------------------------------------------------------- */

typedef struct plot_point {
    double x, y, elevation_deg; /* px */
} plot_point;

static plot_point point_at(double azimuth_deg, double radius)
{
    return (plot_point){ .x = CENTRE_X + radius * sin(azimuth_deg * DEG),
                         .y = CENTRE_Y - radius * cos(azimuth_deg * DEG) };
}

static double radius_of(double elevation_deg)
{
    return RADIUS * tan(0.5 * (90.0 - elevation_deg) * DEG);
}

/* Where the sun is drawn at a moment. */
static bool find_point(const sun_diagram *d, double moment, plot_point *out, lux_error *err)
{
    sun_place s;
    if (!sun_at(&d->q->at, &d->q->air, moment, &s, err))
        return false;
    /* The nadir is infinitely far away: what is down is cut off anyway */
    double elevation   = fmax(s.apparent_elevation_deg, -60.0);
    *out               = point_at(s.azimuth_deg, radius_of(elevation));
    out->elevation_deg = s.apparent_elevation_deg;
    return true;
}

static double azimuth_of(const plot_point *p)
{
    return atan2(p->x - CENTRE_X, CENTRE_Y - p->y) / DEG;
}

/* Where the way from a to b meets the rim, one of them above and one below the horizon. */
static plot_point rim_between(const plot_point *a, const plot_point *b)
{
    double t     = a->elevation_deg / (a->elevation_deg - b->elevation_deg);
    plot_point p = { .x = a->x + t * (b->x - a->x), .y = a->y + t * (b->y - a->y) };
    return point_at(azimuth_of(&p), RADIUS);
}

static double moment_of_date(const sun_diagram *d, int month, int day, double hour)
{
    civil_time t = { .year = d->q->date.year, .month = month, .day = day };
    return clock_from_civil(&t) + hour * HOUR_S - d->offset;
}

/* ---- lines ----------------------------------------------------------------------------------- */

/* The parts of a track that are above the horizon, up to the rim. */
static void draw_track(FILE *out, const plot_point *p, int count, const char *style)
{
    bool open = false;
    for (int i = 0; i < count; i++) {
        bool up      = p[i].elevation_deg >= 0.0;
        bool crosses = i > 0 && up != (p[i - 1].elevation_deg >= 0.0);
        if (up && !open)
            fprintf(out, "<polyline fill=\"none\" stroke-linejoin=\"round\" %s points=\"", style);
        if (crosses) {
            plot_point rim = rim_between(&p[i - 1], &p[i]);
            fprintf(out, " %.2f,%.2f", rim.x, rim.y);
        }
        if (up)
            fprintf(out, " %.2f,%.2f", p[i].x, p[i].y);
        if (open && !up)
            fputs("\"/>\n", out);
        open = up;
    }
    if (open)
        fputs("\"/>\n", out);
}

static const char HALO[] = "stroke=\"white\" stroke-width=\"3\" paint-order=\"stroke\"";

static void draw_label(FILE *out, double x, double y, const char *style, const char *text)
{
    fprintf(out, "<text x=\"%.2f\" y=\"%.2f\" %s>%s</text>\n", x, y + 4.0, style, text);
}

/* ---- the horizon, azimuths, elevations ------------------------------------------------------- */

static void draw_azimuths(FILE *out)
{
    static const char *const names[] = { "N", "E", "S", "W" };
    for (int a = 0; a < 360; a += 10) {
        plot_point from = point_at(a, a % 30 ? RADIUS : radius_of(80.0));
        plot_point to   = point_at(a, RADIUS + (a % 30 ? 5.0 : 0.0));
        fprintf(out, "<line x1=\"%.2f\" y1=\"%.2f\" x2=\"%.2f\" y2=\"%.2f\" stroke=\"%s\"/>\n",
                from.x, from.y, to.x, to.y, a % 30 ? "#808080" : "#dcdcdc");
    }
    for (int a = 0; a < 360; a += 30) {
        char text[16];
        snprintf(text, sizeof text, "%d°", a);
        plot_point p = point_at(a, RADIUS + 0.5 * BAND + 1.0);
        draw_label(out, p.x, p.y,
                   a % 90 ? "font-size=\"11\" fill=\"#404040\""
                          : "font-size=\"14\" font-weight=\"bold\" fill=\"#202020\"",
                   a % 90 ? text : names[a / 90]);
    }
}

static void draw_sky(FILE *out)
{
    fputs("<g fill=\"none\" text-anchor=\"middle\">\n", out);
    for (int h = 10; h < 90; h += 10)
        fprintf(out, "<circle cx=\"%g\" cy=\"%g\" r=\"%.2f\" stroke=\"#dcdcdc\"/>\n", CENTRE_X,
                CENTRE_Y, radius_of(h));
    draw_azimuths(out);
    fprintf(out, "<circle cx=\"%g\" cy=\"%g\" r=\"%g\" stroke=\"#404040\" stroke-width=\"1.5\"/>\n",
            CENTRE_X, CENTRE_Y, RADIUS);
    fprintf(out, "<circle cx=\"%g\" cy=\"%g\" r=\"%g\" stroke=\"#808080\"/>\n</g>\n", CENTRE_X,
            CENTRE_Y, RADIUS + BAND);
}

/* Elevations are told where the sun comes last: below the pole, between two lines of hours. */
static bool draw_elevations(const sun_diagram *d, lux_error *err)
{
    double solar_midnight =
        moment_of_date(d, d->summer, 21, 0.0) + d->offset - d->q->at.longitude_deg / 15.0 * HOUR_S;
    double hour = round((solar_midnight + d->offset) / HOUR_S) * HOUR_S - d->offset;
    plot_point p;
    if (!find_point(d, hour + 0.5 * HOUR_S, &p, err))
        return false;
    char style[160];
    snprintf(style, sizeof style, "font-size=\"10\" fill=\"#606060\" text-anchor=\"middle\" %s",
             HALO);
    for (int h = 10; h < 90; h += 10) {
        char text[16];
        snprintf(text, sizeof text, "%d°", h);
        plot_point at = point_at(azimuth_of(&p), radius_of(h));
        draw_label(d->out, at.x, at.y, style, text);
    }
    return true;
}

/* ---- days ------------------------------------------------------------------------------------ */

enum { DAY_POINTS = 145, PATHS = 7 }; /* each 10 minutes */

/* Of the 21st; of Dec and Jun alone, else of the first of two months. */
static const struct path_style {
    int month;
    const char *name, *color;
} paths[PATHS] = {
    { 12, "Dec", "#2040a0" },     { 1, "Jan, Nov", "#2878b8" }, { 2, "Feb, Oct", "#1890a0" },
    { 3, "Mar, Sep", "#30904c" }, { 4, "Apr, Aug", "#88901c" }, { 5, "May, Jul", "#b8741c" },
    { 6, "Jun", "#b83020" },
};

static bool find_day(const sun_diagram *d, double from, plot_point p[DAY_POINTS], lux_error *err)
{
    for (int i = 0; i < DAY_POINTS; i++)
        if (!find_point(d, from + DAY_S * i / (DAY_POINTS - 1), &p[i], err))
            return false;
    return true;
}

/* The month's name outside of the band, where the path meets the rim. */
static void label_at_rim(const sun_diagram *d, const struct path_style *path, plot_point rim)
{
    double a = azimuth_of(&rim), side = sin(a * DEG);
    plot_point in = point_at(a, RADIUS + BAND - 4.0), end = point_at(a, RADIUS + BAND + 4.0);
    plot_point at  = point_at(a, RADIUS + BAND + 9.0);
    double lowered = -4.0 * cos(a * DEG); /* above the picture it stands on the line, below under */
    char style[120];
    fprintf(d->out,
            "<line x1=\"%.2f\" y1=\"%.2f\" x2=\"%.2f\" y2=\"%.2f\" stroke=\"%s\" "
            "stroke-width=\"1.5\"/>\n",
            in.x, in.y, end.x, end.y, path->color);
    snprintf(style, sizeof style, "font-size=\"11\" fill=\"%s\" text-anchor=\"%s\"", path->color,
             side > 0.03    ? "start"
             : side < -0.03 ? "end"
                            : "middle");
    draw_label(d->out, at.x, at.y + lowered, style, path->name);
}

/* On a path that never meets the rim: in the morning, each somewhere else. */
static void label_on_path(const sun_diagram *d, int number, const plot_point p[DAY_POINTS])
{
    char style[160];
    int i = DAY_POINTS / 4 + 9 * (number - PATHS / 2);
    snprintf(style, sizeof style, "font-size=\"10\" fill=\"%s\" text-anchor=\"middle\" %s",
             paths[number].color, HALO);
    draw_label(d->out, p[i].x, p[i].y, style, paths[number].name);
}

static bool draw_days(const sun_diagram *d, bool labels, lux_error *err)
{
    plot_point p[DAY_POINTS];
    for (int k = 0; k < PATHS; k++) {
        char style[80];
        double solar_midnight = moment_of_date(d, paths[k].month, 21, 0.0) + d->offset -
                                d->q->at.longitude_deg / 15.0 * HOUR_S;
        if (!find_day(d, solar_midnight, p, err))
            return false;
        if (!labels) {
            snprintf(style, sizeof style, "stroke-width=\"1.4\" stroke=\"%s\"", paths[k].color);
            draw_track(d->out, p, DAY_POINTS, style);
            continue;
        }
        int ends = 0;
        for (int i = 1; i < DAY_POINTS; i++)
            if ((p[i].elevation_deg >= 0.0) != (p[i - 1].elevation_deg >= 0.0)) {
                label_at_rim(d, &paths[k], rim_between(&p[i - 1], &p[i]));
                ends++;
            }
        if (ends == 0 && p[0].elevation_deg >= 0.0)
            label_on_path(d, k, p);
    }
    return true;
}

/* ---- hours ----------------------------------------------------------------------------------- */

/* From day 1 to day 361 of the year, counted from 0, in steps of 5, and back at the first. */
enum { HOUR_POINTS = 74, HOUR_STEP = 5, FIRST_HALF = 37 };

static bool find_hour(const sun_diagram *d, int hour, plot_point p[HOUR_POINTS], lux_error *err)
{
    for (int i = 0; i + 1 < HOUR_POINTS; i++)
        if (!find_point(d, moment_of_date(d, 1, 2, hour) + DAY_S * HOUR_STEP * i, &p[i], err))
            return false;
    p[HOUR_POINTS - 1] = p[0];
    return true;
}

static plot_point toward(double x, double y, double dx, double dy, double px)
{
    double length = fmax(hypot(dx, dy), 1e-6);
    return (plot_point){ .x = x + px * dx / length, .y = y + px * dy / length };
}

/* Beyond the summer's end of the line; where that is down, above what there is of it. */
static void label_hour(const sun_diagram *d, int hour, const plot_point p[HOUR_POINTS])
{
    enum { JUNE = 34, MARCH = 16, DECEMBER = 70 }; /* of the 21st */
    static const double PX   = 11.0;
    const plot_point *summer = &p[d->summer == 6 ? JUNE : DECEMBER], *spring = &p[MARCH];
    plot_point at;
    if (summer->elevation_deg >= 0.0) {
        at = toward(summer->x, summer->y, summer->x - spring->x, summer->y - spring->y, PX);
    } else {
        const plot_point *top = &p[0];
        for (int i = 1; i < HOUR_POINTS; i++)
            top = p[i].elevation_deg > top->elevation_deg ? &p[i] : top;
        if (top->elevation_deg < 1.0)
            return;
        at = toward(top->x, top->y, CENTRE_X - top->x, CENTRE_Y - top->y, PX);
    }
    char style[160], text[16];
    snprintf(text, sizeof text, "%d", hour);
    snprintf(style, sizeof style,
             "font-size=\"11\" font-weight=\"bold\" fill=\"#303030\" text-anchor=\"middle\" %s",
             HALO);
    draw_label(d->out, at.x, at.y, style, text);
}

static bool draw_hours(const sun_diagram *d, bool labels, lux_error *err)
{
    static const char FULL[]   = "stroke=\"#707070\"";
    static const char BROKEN[] = "stroke=\"#707070\" stroke-dasharray=\"4 3\"";
    plot_point p[HOUR_POINTS];
    for (int hour = 0; hour < 24; hour++) {
        if (!find_hour(d, hour, p, err))
            return false;
        if (labels) {
            label_hour(d, hour, p);
        } else {
            draw_track(d->out, p, FIRST_HALF, FULL);
            draw_track(d->out, p + FIRST_HALF - 1, HOUR_POINTS - FIRST_HALF + 1, BROKEN);
        }
    }
    return true;
}

/* ---- what was asked for ---------------------------------------------------------------------- */

static bool draw_date(const sun_diagram *d, lux_error *err)
{
    plot_point p[DAY_POINTS];
    if (!find_day(d, moment_of_date(d, d->q->date.month, d->q->date.day, 0.0), p, err))
        return false;
    draw_track(d->out, p, DAY_POINTS, "stroke=\"#f09000\" stroke-width=\"2.6\"");
    return true;
}

static void draw_sun(FILE *out, double x, double y)
{
    fputs("<g stroke=\"#c06000\" stroke-width=\"1.6\">\n", out);
    for (int a = 0; a < 360; a += 45)
        fprintf(out, "<line x1=\"%.2f\" y1=\"%.2f\" x2=\"%.2f\" y2=\"%.2f\"/>\n",
                x + 9.5 * sin(a * DEG), y + 9.5 * cos(a * DEG), x + 13.5 * sin(a * DEG),
                y + 13.5 * cos(a * DEG));
    fprintf(out, "<circle cx=\"%.2f\" cy=\"%.2f\" r=\"7\" fill=\"#ffd830\"/>\n</g>\n", x, y);
}

/* ---- words ----------------------------------------------------------------------------------- */

static bool clocks_change(const sun_diagram *d)
{
    for (int month = 1; month <= 12; month++)
        if (clock_offset(d->q->zone, moment_of_date(d, month, 15, 12.0)) != d->offset)
            return true;
    return false;
}

static void draw_head(const sun_diagram *d)
{
    const sun_question *q = d->q;
    char where[SUN_SITE_TEXT], line[256];
    sun_site_print(where, &q->at);
    snprintf(line, sizeof line, "%s, %g m · %s · %04d", where, q->at.altitude_m, q->zone_name,
             q->date.year);
    svg_title(d->out, CENTRE_X, 28.0, WIDTH - 60.0, q->place);
    svg_words(d->out, CENTRE_X, 48.0, 12.0, line);
}

static void draw_foot(const sun_diagram *d)
{
    char line[200], offset[SUN_OFFSET_TEXT], date[24];
    const sun_question *q = d->q;
    sun_offset_print(offset, d->offset);
    snprintf(date, sizeof date, "%04d-%02d-%02d", q->date.year, q->date.month, q->date.day);
    snprintf(line, sizeof line, "hours: civil time at UTC%s%s%s%s", offset,
             clocks_change(d) ? ", as on " : "", clocks_change(d) ? date : "",
             clocks_change(d) ? "; clocks change in this year" : "");
    svg_words(d->out, CENTRE_X, HEIGHT - 58.0, 12.0, line);
    svg_words(d->out, CENTRE_X, HEIGHT - 40.0, 12.0,
              "paths of the 21st of each month; lines of hours: full January to June, broken July "
              "to December");
}

/* The date's line of the legend, and the sun if it is up. */
static bool draw_asked(const sun_diagram *d, lux_error *err)
{
    const sun_question *q = d->q;
    char line[160], when[CLOCK_TEXT];
    if (!q->has_date)
        return true;
    snprintf(line, sizeof line, "path of %04d-%02d-%02d", q->date.year, q->date.month, q->date.day);
    if (q->has_moment) {
        sun_place s;
        if (!sun_at(&q->at, &q->air, q->moment, &s, err))
            return false;
        bool up      = sun_height_of(&s) != SUN_BELOW;
        plot_point p = point_at(s.azimuth_deg, radius_of(fmax(s.apparent_elevation_deg, 0.0)));
        clock_print(when, q->zone, q->moment);
        snprintf(line, sizeof line, "sun at %s: azimuth %.1f°, elevation %.1f°%s", when,
                 s.azimuth_deg, s.apparent_elevation_deg, up ? "" : ", below the horizon");
        if (up)
            draw_sun(d->out, p.x, p.y);
    }
    svg_words(d->out, CENTRE_X, HEIGHT - 18.0, 12.0, line);
    return true;
}

static bool draw(const sun_diagram *d, lux_error *err)
{
    svg_begin(d->out, WIDTH, HEIGHT);
    draw_head(d);
    draw_sky(d->out);
    bool good = draw_hours(d, false, err) && draw_days(d, false, err) &&
                (!d->q->has_date || draw_date(d, err)) && draw_elevations(d, err) &&
                draw_days(d, true, err) && draw_hours(d, true, err) && draw_asked(d, err);
    draw_foot(d);
    svg_end(d->out);
    return good;
}

bool sun_plot(const sun_question *q, const char *path, lux_error *err)
{
    civil_time noon = q->date;
    noon.hour       = 12;
    double at       = clock_from_civil(&noon);
    double moment   = q->has_moment ? q->moment : at - clock_offset(q->zone, at);
    sun_diagram d   = { .q      = q,
                        .offset = clock_offset(q->zone, moment),
                        .summer = q->at.latitude_deg < 0.0 ? 12 : 6 };
    output_file file;
    if (!file_create(&file, path, err))
        return false;
    d.out = file.stream;
    if (draw(&d, err))
        return file_commit(&file, err);
    file_discard(&file);
    return false;
}
