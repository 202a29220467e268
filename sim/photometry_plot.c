/* sim/photometry_plot.c -- the polar diagram of a luminaire as SVG, as data sheets have it.
 *
 * The radius is the intensity, the angle is gamma from straight down; half planes C0 and C90 lie
 * on the right, C180 and C270 on the left. Between the angles of the file the web is linear, and
 * so drawn in steps of a degree at most.
 */
#include "core/file.h"
#include "sim/photometry_report.h"
#include "sim/svg.h"

#include <math.h>

static const double WIDTH = 520.0, HEIGHT = 600.0; /* px, of the picture */
static const double CENTRE_X = 260.0, CENTRE_Y = 300.0, RADIUS = 210.0;
static const double TITLE_WIDTH = 490.0;

/* What a picture is drawn with. */
typedef struct polar_plot {
    FILE *out;
    const photometry *p;
    double factor; /* of the unit for each cd */
    svg_polar polar;
} polar_plot;

/* The value of one half plane at gamma. */
static void draw_point(const polar_plot *d, double plane, double gamma, double side)
{
    double x, y;
    double value = photometry_candela(d->p, plane, gamma) * d->factor;
    svg_polar_place(&d->polar, value, side * gamma, &x, &y);
    fprintf(d->out, " %.2f,%.2f", x, y);
}

/* One half plane, outward from gamma 0 or back to it; it ends at the centre where it is dark. */
static void draw_half(const polar_plot *d, double plane, double side, bool back)
{
    const photometry *p = d->p;
    int n               = p->gamma_count;
    if (back && p->gamma_deg[n - 1] < 180.0f)
        fprintf(d->out, " %g,%g", CENTRE_X, CENTRE_Y);
    for (int i = 0; i + 1 < n; i++) {
        int cell   = back ? n - 2 - i : i;
        double low = (double)p->gamma_deg[cell], high = (double)p->gamma_deg[cell + 1];
        int parts = (int)ceil(high - low);
        for (int k = 0; k < parts; k++) {
            double t = (double)k / parts;
            draw_point(d, plane, back ? high + t * (low - high) : low + t * (high - low), side);
        }
    }
    draw_point(d, plane, (double)p->gamma_deg[back ? 0 : n - 1], side);
    if (!back && p->gamma_deg[n - 1] < 180.0f)
        fprintf(d->out, " %g,%g", CENTRE_X, CENTRE_Y);
}

static void draw_curve(const polar_plot *d, double plane, const char *style)
{
    fprintf(d->out,
            "<polyline fill=\"none\" stroke-width=\"2\" stroke-linejoin=\"round\" %s points=\"",
            style);
    if (d->p->gamma_deg[0] > 0.0f)
        fprintf(d->out, " %g,%g", CENTRE_X, CENTRE_Y);
    draw_half(d, plane, 1.0, false);
    draw_half(d, plane + 180.0, -1.0, true);
    if (d->p->gamma_deg[0] > 0.0f)
        fprintf(d->out, " %g,%g", CENTRE_X, CENTRE_Y);
    fprintf(d->out, "\"/>\n");
}

static const char *const FULL   = "stroke=\"#c02020\"";
static const char *const BROKEN = "stroke=\"#2040c0\" stroke-dasharray=\"7 4\"";

/* Where the curves leave most room for labels: of the angles between the spokes, that with the
 * least light on the right within the width of a label; the first, of equal ones. */
static double room_for_labels(const photometry *p)
{
    double best = 15.0, least = HUGE_VAL;
    for (double t = 15.0; t < 180.0; t += 30.0) {
        double most = 0.0;
        for (double g = t - 14.0; g <= t + 14.0; g += 1.0)
            most = fmax(most, fmax(photometry_candela(p, 0.0, g), photometry_candela(p, 90.0, g)));
        if (most < least)
            best = t, least = most;
    }
    return best;
}

/* One line for all planes where these are equal. */
static void draw_legend(const polar_plot *d, const char *title, const char *unit)
{
    bool one = d->p->plane_count == 1;
    svg_title(d->out, CENTRE_X, 28.0, TITLE_WIDTH, title);
    fprintf(d->out, "<g font-size=\"12\">\n");
    fprintf(d->out, "<line x1=\"30\" y1=\"566\" x2=\"70\" y2=\"566\" stroke-width=\"2\" %s/>\n",
            FULL);
    fprintf(d->out, "<text x=\"78\" y=\"570\">%s</text>\n",
            one ? "C0 – C180, C90 – C270: all planes are the same" : "C0 – C180 (C0 right)");
    if (!one)
        fprintf(d->out,
                "<line x1=\"220\" y1=\"566\" x2=\"260\" y2=\"566\" stroke-width=\"2\" %s/>\n"
                "<text x=\"268\" y=\"570\">C90 – C270 (C90 right)</text>\n",
                BROKEN);
    fprintf(d->out,
            "<text x=\"490\" y=\"570\" text-anchor=\"end\" font-weight=\"bold\">%s</text>\n", unit);
    fprintf(d->out, "</g>\n");
}

static void draw(const polar_plot *d, const char *title, const char *unit)
{
    svg_begin(d->out, WIDTH, HEIGHT);
    svg_polar_grid(d->out, &d->polar);
    draw_curve(d, 0.0, FULL);
    if (d->p->plane_count > 1)
        draw_curve(d, 90.0, BROKEN);
    draw_legend(d, title, unit);
    svg_end(d->out);
}

bool photometry_plot(const photometry *p, const char *title, const char *path, lux_error *err)
{
    bool relative        = p->lamp_lumens > 0.0;
    photometry_figures f = photometry_figure(p, path, NULL);
    polar_plot d         = { .p      = p,
                             .factor = relative ? 1000.0 / p->lamp_lumens : 1.0,
                             .polar  = { .x          = CENTRE_X,
                                         .y          = CENTRE_Y,
                                         .radius     = RADIUS,
                                         .labels_deg = room_for_labels(p) } };
    svg_polar_scale(&d.polar, f.maximum_cd * d.factor);

    output_file file;
    if (!file_create(&file, path, err))
        return false;
    d.out = file.stream;
    draw(&d, title, relative ? "cd/klm" : "cd");
    return file_commit(&file, err);
}
