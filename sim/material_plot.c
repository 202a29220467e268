/* sim/material_plot.c -- the lobes of a measured material and its albedo, as SVG.
 *
 * On the left f cos in the plane of incidence, 1/sr, each curve for a beam from the upper left:
 * what of it leaves into a unit of solid angle, above the surface reflected, below it let through,
 * as a share of the curve's largest value: lobes at grazing incidence are a hundred times others.
 * On the right what of a beam is reflected and let through in all, against its angle. A layer has
 * such a row for each side, in the vertical plane; an anisotropic table one for each of two planes.
 */
#include "core/color.h"
#include "core/file.h"
#include "materials/material_figures.h"
#include "sim/material_report.h"
#include "sim/svg.h"

#include <math.h>

static const double WIDTH = 900.0, TOP = 40.0, BOTTOM = 10.0; /* px */
static const double POLAR_X = 225.0, RADIUS = 165.0;
static const double CHART_X = 510.0, CHART_WIDTH = 340.0, CHART_HEIGHT = 165.0;
static const double STEP_DEG = 0.25, HORIZON_DEG = 89.75;

enum { BEAMS = 4 };
static const double beams_deg[BEAMS] = { 0.0, 30.0, 60.0, 80.0 };

/* Told apart in grey, too. */
static const char *const styles[BEAMS] = {
    "stroke=\"#202020\"",
    "stroke=\"#2040c0\" stroke-dasharray=\"9 3\"",
    "stroke=\"#c02020\" stroke-dasharray=\"3 2\"",
    "stroke=\"#107030\" stroke-dasharray=\"9 3 2 3\"",
};

/* What a row of the picture shows. */
typedef struct row {
    FILE *out;
    const measured *m;
    const char *title;
    double sign, azimuth_deg; /* of the beams */
    svg_polar polar;
    double most[BEAMS]; /* 1/sr, of each beam's lobe */
    double chart_y;     /* of its lower edge */
} row;

/* ---- lobes ----------------------------------------------------------------------------------- */

/* Toward an angle from the normal, positive on the mirror's side. */
static double lobe(const row *r, double beam_deg, double angle_deg, bool below)
{
    return material_lobe(r->m->made, beam_from(r->sign, r->azimuth_deg, beam_deg),
                         beam_from(below ? -r->sign : r->sign, r->azimuth_deg + 180.0, angle_deg));
}

static double largest_lobe(const row *r, double beam_deg)
{
    double most = 0.0;
    for (double a = -HORIZON_DEG; a <= HORIZON_DEG; a += STEP_DEG)
        for (int below = 0; below <= (r->m->layer != NULL); below++)
            most = fmax(most, lobe(r, beam_deg, a, below != 0));
    return most;
}

static void draw_lobe(const row *r, int beam, bool below)
{
    fprintf(r->out,
            "<polyline fill=\"none\" stroke-width=\"1.6\" stroke-linejoin=\"round\" %s points=\""
            " %g,%g",
            styles[beam], r->polar.x, r->polar.y);
    for (double a = -HORIZON_DEG; a <= HORIZON_DEG; a += STEP_DEG) {
        double x, y;
        double value = lobe(r, beams_deg[beam], a, below) / fmax(r->most[beam], 1e-30);
        svg_polar_place(&r->polar, value, below ? a : 180.0 - a, &x, &y);
        fprintf(r->out, " %.2f,%.2f", x, y);
    }
    fprintf(r->out, " %g,%g\"/>\n", r->polar.x, r->polar.y);
}

/* An arrow at the rim, along the beam. */
static void draw_beam(const row *r, int beam)
{
    double x[4], y[4], from = 180.0 + beams_deg[beam], top = r->polar.top;
    svg_polar_place(&r->polar, top, from, &x[0], &y[0]);
    svg_polar_place(&r->polar, 0.90 * top, from, &x[1], &y[1]);
    svg_polar_place(&r->polar, 0.94 * top, from - 1.2, &x[2], &y[2]);
    svg_polar_place(&r->polar, 0.94 * top, from + 1.2, &x[3], &y[3]);
    fprintf(r->out,
            "<path fill=\"none\" stroke-width=\"1.6\" %s d=\"M %.2f %.2f L %.2f %.2f\"/>\n"
            "<path fill=\"none\" stroke-width=\"1.6\" %.16s d=\"M %.2f %.2f L %.2f %.2f L %.2f "
            "%.2f\"/>\n",
            styles[beam], x[0], y[0], x[1], y[1], styles[beam], x[2], y[2], x[1], y[1], x[3], y[3]);
}

/* What the lobes are, and what they come to at the rim. */
static void draw_legend(const row *r)
{
    double y = r->polar.y + (r->polar.upper ? 0.0 : r->polar.radius) + 42.0;
    fprintf(r->out, "<g font-size=\"12\"><text x=\"30\" y=\"%g\">beam, rim in 1/sr:</text>\n", y);
    for (int i = 0; i < BEAMS; i++) {
        double x = 30.0 + 105.0 * i;
        fprintf(r->out,
                "<line x1=\"%g\" y1=\"%g\" x2=\"%g\" y2=\"%g\" stroke-width=\"1.6\" %s/>"
                "<text x=\"%g\" y=\"%g\">%g°: %.3g</text>\n",
                x, y + 14.0, x + 30.0, y + 14.0, styles[i], x + 34.0, y + 18.0, beams_deg[i],
                r->most[i]);
    }
    fprintf(r->out, "</g>\n");
}

static void draw_polar(const row *r)
{
    const svg_polar *p = &r->polar;
    svg_polar_grid(r->out, p);
    fprintf(r->out, "<line x1=\"%g\" y1=\"%g\" x2=\"%g\" y2=\"%g\" stroke=\"#404040\"/>\n",
            p->x - p->radius, p->y, p->x + p->radius, p->y);
    for (int i = 0; i < BEAMS; i++) {
        draw_beam(r, i);
        draw_lobe(r, i, false);
        if (r->m->layer)
            draw_lobe(r, i, true);
    }
    draw_legend(r);
    fprintf(r->out,
            "<text x=\"30\" y=\"%g\" font-size=\"12\" font-weight=\"bold\">f cos θ</text>\n",
            p->y - p->radius - 18.0);
    fprintf(r->out, "<text x=\"%g\" y=\"%g\" font-size=\"13\" text-anchor=\"middle\">%s</text>\n",
            0.5 * WIDTH, p->y - p->radius - 44.0, r->title);
}

/* ---- albedo ---------------------------------------------------------------------------------- */

/* A layer's beams come from below, too: at negative angles. */
static double least_angle(const row *r) { return r->m->layer ? -90.0 : 0.0; }

static double chart_x(const row *r, double angle_deg)
{
    double least = least_angle(r);
    return CHART_X + CHART_WIDTH * (angle_deg - least) / (90.0 - least);
}

static void draw_axes(const row *r)
{
    double bottom = r->chart_y, top = bottom - CHART_HEIGHT;
    fprintf(r->out, "<g stroke=\"#c8c8c8\" font-size=\"12\" fill=\"#404040\">\n");
    for (double a = least_angle(r); a <= 90.0; a += r->m->layer ? 30.0 : 15.0)
        fprintf(r->out,
                "<line x1=\"%.2f\" y1=\"%g\" x2=\"%.2f\" y2=\"%g\"/>"
                "<text x=\"%.2f\" y=\"%g\" text-anchor=\"middle\" stroke=\"none\">%g°</text>\n",
                chart_x(r, a), bottom, chart_x(r, a), top, chart_x(r, a), bottom + 17.0, a);
    for (int i = 0; i <= 5; i++) {
        double y = bottom - CHART_HEIGHT * i / 5.0;
        fprintf(r->out,
                "<line x1=\"%g\" y1=\"%g\" x2=\"%g\" y2=\"%g\"/>"
                "<text x=\"%g\" y=\"%g\" text-anchor=\"end\" stroke=\"none\">%g</text>\n",
                CHART_X, y, CHART_X + CHART_WIDTH, y, CHART_X - 6.0, y + 4.0, 0.2 * i);
    }
    fprintf(r->out, "<text x=\"%g\" y=\"%g\" stroke=\"none\" font-weight=\"bold\">%s</text>\n",
            CHART_X, top - 14.0, r->m->layer ? "share of a beam" : "albedo");
    fprintf(r->out, "<text x=\"%g\" y=\"%g\" text-anchor=\"end\" stroke=\"none\">%s</text>\n</g>\n",
            CHART_X + CHART_WIDTH, bottom + 35.0,
            r->m->layer ? "angle of the beam off the normal; below 0: from below"
                        : "angle of the beam off the normal");
}

enum { POINTS = 73, LINES = 4 };

typedef struct chart {
    double angle[POINTS], value[LINES][POINTS]; /* R, G, B or their luminance first; through */
    bool colored;
} chart;

static void find_chart(const row *r, chart *c)
{
    double least = least_angle(r);
    for (int i = 0; i < POINTS; i++) {
        double a         = least + (90.0 - least) * i / (POINTS - 1);
        a                = fmin(fmax(a, -HORIZON_DEG), HORIZON_DEG);
        material_share s = material_share_of(r->m->made, beam_from(r->sign, r->azimuth_deg, a));
        vec3 v           = s.reflected;
        c->angle[i]      = a;
        c->value[0][i]   = (double)v.x;
        c->value[1][i]   = (double)v.y;
        c->value[2][i]   = (double)v.z;
        c->value[3][i]   = (double)rgb_luminance(s.through);
        c->colored |= v.x != v.y || v.x != v.z;
    }
}

static const char *const line_styles[LINES] = {
    "stroke=\"#c02020\"",
    "stroke=\"#107030\" stroke-dasharray=\"9 3\"",
    "stroke=\"#2040c0\" stroke-dasharray=\"3 2\"",
    "stroke=\"#2040c0\" stroke-dasharray=\"9 3 2 3\"",
};
static const char GREY[] = "stroke=\"#202020\"";

/* Line `number` of those that there are, its name under the one before. */
static void draw_line(const row *r, const chart *c, int line, int number, const char *name)
{
    const char *style = c->colored || line == 3 ? line_styles[line] : GREY;
    fprintf(r->out,
            "<polyline fill=\"none\" stroke-width=\"1.6\" stroke-linejoin=\"round\" %s points=\"",
            style);
    for (int i = 0; i < POINTS; i++)
        fprintf(r->out, " %.2f,%.2f", chart_x(r, c->angle[i]),
                r->chart_y - CHART_HEIGHT * c->value[line][i]);
    double x = CHART_X + 130.0 + 100.0 * number, y = r->chart_y - CHART_HEIGHT - 18.0;
    fprintf(r->out,
            "\"/>\n<line x1=\"%g\" y1=\"%g\" x2=\"%g\" y2=\"%g\" stroke-width=\"1.6\" %s/>"
            "<text x=\"%g\" y=\"%g\" font-size=\"12\">%s</text>\n",
            x, y, x + 30.0, y, style, x + 35.0, y + 4.0, name);
}

static void draw_chart(const row *r)
{
    chart c = { 0 };
    find_chart(r, &c);
    draw_axes(r);
    if (c.colored) {
        draw_line(r, &c, 0, 0, "R");
        draw_line(r, &c, 1, 1, "G");
        draw_line(r, &c, 2, 2, "B");
        return;
    }
    draw_line(r, &c, 0, 0, "reflected");
    if (r->m->layer)
        draw_line(r, &c, 3, 1, "let through");
}

/* ---- the picture ----------------------------------------------------------------------------- */

static double row_height(const measured *m) { return (m->layer ? 2.0 : 1.0) * RADIUS + 150.0; }

static int rows_of(const beams *b) { return b->side_count > 1 ? b->side_count : b->plane_count; }

static void draw_row(FILE *out, const measured *m, const beams *b, int number)
{
    static const char *const sides[] = { "light from outside (front), vertical plane, from above",
                                         "light from the room (back), vertical plane, from above" };
    bool by_side                     = b->side_count > 1;
    double y                         = TOP + row_height(m) * number + 75.0 + RADIUS;
    row r                            = { .out         = out,
                                         .m           = m,
                                         .title       = by_side ? sides[number] : b->planes[number].name,
                                         .sign        = b->sides[by_side ? number : 0].sign,
                                         .azimuth_deg = b->planes[by_side ? 0 : number].azimuth_deg,
                                         .polar       = { .x           = POLAR_X,
                                                          .y           = y,
                                                          .radius      = RADIUS,
                                                          .labels_deg  = 225.0,
                                                          .from_normal = true,
                                                          .upper       = !m->layer },
                                         .chart_y     = m->layer ? y + 0.5 * CHART_HEIGHT : y };
    svg_polar_scale(&r.polar, 1.0);
    for (int i = 0; i < BEAMS; i++)
        r.most[i] = largest_lobe(&r, beams_deg[i]);
    draw_polar(&r);
    draw_chart(&r);
}

bool material_plot(const measured *m, const char *title, const char *path, lux_error *err)
{
    output_file file;
    if (!file_create(&file, path, err))
        return false;
    beams b       = beams_of(m);
    double height = TOP + row_height(m) * rows_of(&b) + BOTTOM;
    svg_begin(file.stream, WIDTH, height);
    svg_title(file.stream, 0.5 * WIDTH, 28.0, WIDTH - 60.0, title);
    for (int i = 0; i < rows_of(&b); i++)
        draw_row(file.stream, m, &b, i);
    svg_end(file.stream);
    return file_commit(&file, err);
}
