/* sim/sun_plot.c -- the sun-path diagram as SVG; see sun_report.h, and sun_diagram.h. */
#include "core/file.h"
#include "sim/sun_diagram.h"
#include "sim/svg.h"

#include <math.h>

static const double WIDTH = 760.0, HEIGHT = 780.0; /* px, of the picture */
static const double CENTRE_X = 380.0, CENTRE_Y = 378.0, RADIUS = 256.0;
static const double BAND = 32.0; /* around the rim, with azimuths */
static const double DEG  = M_PI / 180.0;

static const char HALO[] = "text-anchor=\"middle\" stroke=\"white\" stroke-width=\"3\" "
                           "paint-order=\"stroke\"";

/* ---- pieces ---------------------------------------------------------------------------------- */

static void draw_line(FILE *out, sun_point a, sun_point b, const char *color)
{
    fprintf(out, "<line x1=\"%.2f\" y1=\"%.2f\" x2=\"%.2f\" y2=\"%.2f\" stroke=\"%s\"/>\n", a.x,
            a.y, b.x, b.y, color);
}

static void draw_circle(FILE *out, double radius, const char *style)
{
    fprintf(out, "<circle cx=\"%g\" cy=\"%g\" r=\"%.2f\" fill=\"none\" %s/>\n", CENTRE_X, CENTRE_Y,
            radius, style);
}

/* Text with its middle at p, on a white ground. */
static void draw_label(FILE *out, sun_point p, double size, const char *color, const char *text)
{
    fprintf(out, "<text x=\"%.2f\" y=\"%.2f\" font-size=\"%g\" fill=\"%s\" %s>%s</text>\n", p.x,
            p.y + 4.0, size, color, HALO, text);
}

/* The parts of a track that are above the horizon, up to the rim. Whether there are any. */
static bool draw_track(FILE *out, const sun_diagram *d, const sun_point *p, int count,
                       const char *style)
{
    bool open = false, any = false;
    for (int i = 0; i < count; i++) {
        bool up      = sun_point_up(&p[i]);
        bool crosses = i > 0 && up != sun_point_up(&p[i - 1]);
        if (up && !open)
            fprintf(out, "<polyline fill=\"none\" stroke-linejoin=\"round\" %s points=\"", style);
        if (crosses) {
            sun_point rim = sun_diagram_rim(d, &p[i - 1], &p[i]);
            fprintf(out, " %.2f,%.2f", rim.x, rim.y);
        }
        if (up)
            fprintf(out, " %.2f,%.2f", p[i].x, p[i].y);
        if (open && !up)
            fputs("\"/>\n", out);
        open = up;
        any |= up;
    }
    if (open)
        fputs("\"/>\n", out);
    return any;
}

/* ---- the horizon, azimuths, elevations ------------------------------------------------------- */

static void draw_azimuths(FILE *out, const sun_diagram *d)
{
    static const char *const names[] = { "N", "E", "S", "W" };
    for (int a = 0; a < 360; a += 10) {
        bool spoke     = a % 30 == 0;
        sun_point from = sun_diagram_point(d, a, spoke ? sun_diagram_radius(d, 80.0) : RADIUS);
        sun_point to   = sun_diagram_point(d, a, spoke ? RADIUS : RADIUS + 5.0);
        draw_line(out, from, to, spoke ? "#dcdcdc" : "#808080");
    }
    for (int a = 0; a < 360; a += 30) {
        char text[16];
        sun_point p = sun_diagram_point(d, a, RADIUS + 0.5 * BAND);
        snprintf(text, sizeof text, "%d°", a);
        draw_label(out, p, a % 90 ? 10.0 : 14.0, "#303030", a % 90 ? text : names[a / 90]);
    }
}

static void draw_sky(FILE *out, const sun_diagram *d)
{
    for (int h = 10; h < 90; h += 10)
        draw_circle(out, sun_diagram_radius(d, h), "stroke=\"#dcdcdc\"");
    draw_azimuths(out, d);
    draw_circle(out, RADIUS, "stroke=\"#404040\" stroke-width=\"1.5\"");
    draw_circle(out, RADIUS + BAND, "stroke=\"#808080\"");
}

/* That of 80 degrees would stand among the hours. */
static void label_elevations(FILE *out, const sun_diagram *d)
{
    for (int h = 10; h < 80; h += 10) {
        char text[16];
        snprintf(text, sizeof text, "%d°", h);
        draw_label(out, sun_diagram_point(d, d->spare_deg, sun_diagram_radius(d, h)), 10.0,
                   "#606060", text);
    }
}

/* ---- days ------------------------------------------------------------------------------------ */

/* As sun_path_months has them; from winter's blue to summer's red. */
static const struct path_look {
    const char *name, *color;
} looks[SUN_PATHS] = {
    { "Dec", "#2040a0" },      { "Jan, Nov", "#2878b8" }, { "Feb, Oct", "#1890a0" },
    { "Mar, Sep", "#30904c" }, { "Apr, Aug", "#88901c" }, { "May, Jul", "#b8741c" },
    { "Jun", "#b83020" },
};

/* The month's name outside of the band, where the path meets the rim. */
static void label_at_rim(FILE *out, const sun_diagram *d, const struct path_look *look,
                         sun_point rim)
{
    double a       = sun_diagram_azimuth(d, &rim);
    double side    = sin(a * DEG);
    double lowered = 4.0 - 4.0 * cos(a * DEG); /* over the picture it stands on its place */
    sun_point at   = sun_diagram_point(d, a, RADIUS + BAND + 9.0);
    draw_line(out, sun_diagram_point(d, a, RADIUS + BAND - 4.0),
              sun_diagram_point(d, a, RADIUS + BAND + 4.0), look->color);
    fprintf(out,
            "<text x=\"%.2f\" y=\"%.2f\" font-size=\"11\" fill=\"%s\" text-anchor=\"%s\">%s"
            "</text>\n",
            at.x, at.y + lowered, look->color,
            side > 0.03    ? "start"
            : side < -0.03 ? "end"
                           : "middle",
            look->name);
}

/* A path that never meets the rim is named on its way; if it runs along the rim, inside. */
static void label_day(FILE *out, const sun_diagram *d, int k)
{
    static const double ALONG_RIM_DEG = 3.0, INWARD_PX = 28.0;
    const sun_point *p = d->days[k];
    bool meets         = false;
    for (int i = 1; i < SUN_DAY_POINTS; i++)
        if (sun_point_up(&p[i]) != sun_point_up(&p[i - 1])) {
            label_at_rim(out, d, &looks[k], sun_diagram_rim(d, &p[i - 1], &p[i]));
            meets = true;
        }
    sun_point name = d->names[k];
    if (name.elevation_deg < ALONG_RIM_DEG)
        name = sun_diagram_point(d, sun_diagram_azimuth(d, &name), RADIUS - INWARD_PX);
    if (!meets && sun_point_up(&p[0]))
        draw_label(out, name, 10.0, looks[k].color, looks[k].name);
}

static void draw_days(FILE *out, const sun_diagram *d)
{
    for (int k = 0; k < SUN_PATHS; k++) {
        char style[80];
        snprintf(style, sizeof style, "stroke-width=\"1.4\" stroke=\"%s\"", looks[k].color);
        draw_track(out, d, d->days[k], SUN_DAY_POINTS, style);
    }
}

/* ---- hours ----------------------------------------------------------------------------------- */

static sun_point toward(const sun_point *from, double dx, double dy, double px)
{
    double length = fmax(hypot(dx, dy), 1e-6);
    return (sun_point){ .x = from->x + px * dx / length, .y = from->y + px * dy / length };
}

/* Beyond the summer's end of the line; where that is down, or so near the rim that it would stand
 * in the band, above what there is of it. */
static void label_hour(FILE *out, const sun_diagram *d, int hour)
{
    static const double PX = 11.0, LEAST_DEG = 1.0;
    const sun_point *p      = d->hours[hour];
    const sun_point *summer = &p[d->december ? SUN_DECEMBER_21 : SUN_JUNE_21];
    const sun_point *spring = &p[SUN_MARCH_21], *top = p;
    for (int i = 1; i < SUN_HOUR_POINTS; i++)
        top = p[i].elevation_deg > top->elevation_deg ? &p[i] : top;
    if (top->elevation_deg < LEAST_DEG)
        return;
    sun_point at = toward(summer, summer->x - spring->x, summer->y - spring->y, PX);
    if (!sun_point_up(summer) || hypot(at.x - CENTRE_X, at.y - CENTRE_Y) > RADIUS - PX)
        at = toward(top, CENTRE_X - top->x, CENTRE_Y - top->y, PX);
    char text[64];
    snprintf(text, sizeof text, "<tspan font-weight=\"bold\">%d</tspan>", hour);
    draw_label(out, at, 11.0, "#303030", text);
}

static void draw_hours(FILE *out, const sun_diagram *d)
{
    static const char FULL[]   = "stroke=\"#707070\"";
    static const char BROKEN[] = "stroke=\"#707070\" stroke-dasharray=\"4 3\"";
    for (int hour = 0; hour < 24; hour++) {
        const sun_point *p = d->hours[hour];
        draw_track(out, d, p, SUN_FIRST_HALF + 1, FULL);
        draw_track(out, d, p + SUN_FIRST_HALF, SUN_HOUR_POINTS - SUN_FIRST_HALF, BROKEN);
    }
}

/* ---- words ----------------------------------------------------------------------------------- */

static void draw_head(FILE *out, const sun_question *q)
{
    char where[SUN_SITE_TEXT], line[256];
    sun_site_print(where, &q->at);
    snprintf(line, sizeof line, "%s, %g m · %s · %04d", where, q->at.altitude_m, q->zone_name,
             q->date.year);
    svg_title(out, CENTRE_X, 28.0, WIDTH - 60.0, q->place);
    svg_words(out, CENTRE_X, 48.0, 12.0, line);
}

static void draw_foot(FILE *out, const sun_diagram *d)
{
    char line[200], offset[SUN_OFFSET_TEXT];
    const civil_time *date = &d->q->date;
    sun_offset_print(offset, d->offset);
    int n = snprintf(line, sizeof line, "hours: civil time at UTC%s", offset);
    if (d->clocks_change)
        snprintf(line + n, sizeof line - (size_t)n,
                 ", as on %04d-%02d-%02d; clocks change in this year", date->year, date->month,
                 date->day);
    svg_words(out, CENTRE_X, HEIGHT - 58.0, 12.0, line);
    svg_words(out, CENTRE_X, HEIGHT - 40.0, 12.0,
              "paths of the 21st of each month; lines of hours: full January to June, broken July "
              "to December");
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

/* ---- what was asked for ---------------------------------------------------------------------- */

static bool draw_date(FILE *out, const sun_diagram *d)
{
    return d->q->has_date &&
           draw_track(out, d, d->date, SUN_DAY_POINTS, "stroke=\"#f09000\" stroke-width=\"2.6\"");
}

/* The sun where it is up, and in words. */
static void draw_asked(FILE *out, const sun_diagram *d, bool path)
{
    const sun_question *q = d->q;
    const sun_place *s    = &d->sun;
    char line[240], when[CLOCK_TEXT];
    if (!q->has_date)
        return;
    int n =
        snprintf(line, sizeof line,
                 path ? "orange: path of %04d-%02d-%02d" : "the sun stays down on %04d-%02d-%02d",
                 q->date.year, q->date.month, q->date.day);
    if (q->has_moment) {
        bool up     = sun_height_of(s) != SUN_BELOW;
        double r    = sun_diagram_radius(d, fmax(s->apparent_elevation_deg, 0.0));
        sun_point p = sun_diagram_point(d, s->azimuth_deg, r);
        clock_print(when, q->zone, q->moment);
        snprintf(line + n, sizeof line - (size_t)n, "; sun at %s: azimuth %.1f°, elevation %.1f°%s",
                 when, s->azimuth_deg, s->apparent_elevation_deg, up ? "" : ", below the horizon");
        if (up)
            draw_sun(out, p.x, p.y);
    }
    svg_words(out, CENTRE_X, HEIGHT - 18.0, 12.0, line);
}

static void draw(FILE *out, const sun_diagram *d)
{
    svg_begin(out, WIDTH, HEIGHT);
    draw_head(out, d->q);
    draw_sky(out, d);
    draw_hours(out, d);
    draw_days(out, d);
    bool path = draw_date(out, d);
    label_elevations(out, d);
    for (int k = 0; k < SUN_PATHS; k++)
        label_day(out, d, k);
    for (int hour = 0; hour < 24; hour++)
        label_hour(out, d, hour);
    draw_asked(out, d, path);
    draw_foot(out, d);
    svg_end(out);
}

bool sun_plot(const sun_question *q, const char *path, lux_error *err)
{
    sun_diagram d = { .q = q, .x = CENTRE_X, .y = CENTRE_Y, .radius = RADIUS };
    output_file file;
    if (!sun_diagram_find(&d, err) || !file_create(&file, path, err))
        return false;
    draw(file.stream, &d);
    return file_commit(&file, err);
}
