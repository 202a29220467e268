/* sim/photometry_plot.c -- the polar diagram of a luminaire as SVG, as data sheets have it.
 *
 * The radius is the intensity, the angle is gamma from straight down; half planes C0 and C90 lie
 * on the right, C180 and C270 on the left. Between the angles of the file the web is linear, and
 * so drawn in steps of a degree at most.
 */
#include "core/file.h"
#include "core/utf8.h"
#include "sim/photometry_report.h"

#include <math.h>
#include <string.h>

enum { MOST_RINGS = 6 };

static const double WIDTH = 520.0, HEIGHT = 600.0; /* px, of the picture */
static const double CENTRE_X = 260.0, CENTRE_Y = 300.0, RADIUS = 210.0;
static const double TITLE_WIDTH = 490.0, LARGEST_TITLE = 16.0, SMALLEST_TITLE = 10.0;
static const double DEG = M_PI / 180.0;

/* What a picture is drawn with. */
typedef struct polar_plot {
    FILE *out;
    const photometry *p;
    double factor; /* of the unit for each cd */
    double top;    /* in the unit, at RADIUS */
    double step;   /* between rings */
    double labels; /* deg, where the rings are labelled, on the right */
} polar_plot;

/* 1, 2, 2.5 or 5 times a power of ten, so that at most MOST_RINGS rings hold `most`. */
static double ring_step(double most)
{
    static const double steps[] = { 1.0, 2.0, 2.5, 5.0, 10.0 };
    double power                = pow(10.0, floor(log10(most / MOST_RINGS)));
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++)
        if (MOST_RINGS * steps[i] * power >= most * (1.0 - 1e-9))
            return steps[i] * power;
    return 10.0 * power;
}

/* The width of text in its own size, roughly: of a capital, or of a character of two cells. */
static double text_width(const char *s, size_t bytes)
{
    double width = 0.0;
    for (size_t i = 0; i < bytes; i++)
        width += (s[i] & 0xc0) == 0x80 ? 0.0 : (s[i] & 0xf0) == 0xe0 ? 1.0 : 0.68;
    return width;
}

/* The bytes of the title that fit where it is drawn smallest. */
static size_t title_fits(const char *s)
{
    size_t n = strlen(s);
    while (n > 0 && ((s[n] & 0xc0) == 0x80 || text_width(s, n) * SMALLEST_TITLE > TITLE_WIDTH))
        n--;
    return n;
}

/* Text within XML; control characters and what is no UTF-8 become '?'. */
static void xml_text(FILE *out, const char *s, size_t left)
{
    while (left > 0) {
        size_t n = utf8_length(s, left);
        if (n == 0 || *s == 0x7f || (n == 1 && *s < ' '))
            fputc('?', out);
        else if (*s == '<' || *s == '>' || *s == '&')
            fprintf(out, "&#%d;", *s);
        else
            fwrite(s, 1, n, out);
        n = n ? n : 1;
        s += n, left -= n;
    }
}

/* As large as it fits; one that is too long is cut. */
static void draw_title(FILE *out, const char *title)
{
    size_t bytes = title_fits(title);
    double size  = fmin(LARGEST_TITLE, TITLE_WIDTH / fmax(text_width(title, bytes), 1.0));
    fprintf(out, "<text x=\"%g\" y=\"28\" font-size=\"%.1f\" text-anchor=\"middle\">", CENTRE_X,
            size);
    xml_text(out, title, bytes);
    fprintf(out, "%s</text>\n", title[bytes] ? "…" : "");
}

/* Where a value at the angle t from straight down, to the right, is drawn. */
static void place(double radius, double t_deg, double *x, double *y)
{
    *x = CENTRE_X + radius * sin(t_deg * DEG);
    *y = CENTRE_Y + radius * cos(t_deg * DEG);
}

static void draw_grid(const polar_plot *d)
{
    int rings = (int)lround(d->top / d->step);
    fprintf(d->out, "<g fill=\"none\" stroke=\"#c8c8c8\" stroke-width=\"1\">\n");
    for (int i = 1; i <= rings; i++)
        fprintf(d->out, "<circle cx=\"%g\" cy=\"%g\" r=\"%.2f\"/>\n", CENTRE_X, CENTRE_Y,
                RADIUS * i / rings);
    for (int t = 0; t < 360; t += 30) {
        double x, y;
        place(RADIUS, t, &x, &y);
        fprintf(d->out, "<line x1=\"%g\" y1=\"%g\" x2=\"%.2f\" y2=\"%.2f\"/>\n", CENTRE_X, CENTRE_Y,
                x, y);
    }
    fprintf(d->out, "</g>\n<g fill=\"#404040\" font-size=\"12\" text-anchor=\"middle\">\n");
    for (int t = 0; t < 360; t += 30) {
        double x, y;
        place(RADIUS + 18.0, t, &x, &y);
        fprintf(d->out, "<text x=\"%.2f\" y=\"%.2f\">%d°</text>\n", x, y + 4.0,
                t <= 180 ? t : 360 - t);
    }
    fprintf(d->out, "</g>\n<g fill=\"#404040\" font-size=\"11\">\n");
    for (int i = 1; i <= rings; i++) { /* between the spokes, on a white ground */
        double x, y;
        place(RADIUS * i / rings, d->labels, &x, &y);
        fprintf(d->out,
                "<text x=\"%.2f\" y=\"%.2f\" text-anchor=\"middle\" stroke=\"white\" "
                "stroke-width=\"3\" paint-order=\"stroke\">%g</text>\n",
                x, y + 4.0, d->step * i);
    }
    fprintf(d->out, "</g>\n");
}

/* The value of one half plane at gamma. */
static void draw_point(const polar_plot *d, double plane, double gamma, double side)
{
    double x, y;
    double value = photometry_candela(d->p, plane, gamma) * d->factor;
    place(RADIUS * value / d->top, side * gamma, &x, &y);
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
    draw_title(d->out, title);
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
    fprintf(d->out,
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" "
            "width=\"%g\" height=\"%g\" viewBox=\"0 0 %g %g\" font-family=\"sans-serif\">\n"
            "<rect width=\"100%%\" height=\"100%%\" fill=\"white\"/>\n",
            WIDTH, HEIGHT, WIDTH, HEIGHT);
    draw_grid(d);
    draw_curve(d, 0.0, FULL);
    if (d->p->plane_count > 1)
        draw_curve(d, 90.0, BROKEN);
    draw_legend(d, title, unit);
    fprintf(d->out, "</svg>\n");
}

bool photometry_plot(const photometry *p, const char *title, const char *path, lux_error *err)
{
    bool relative        = p->lamp_lumens > 0.0;
    photometry_figures f = photometry_figure(p, path, NULL);
    polar_plot d         = { .p      = p,
                             .factor = relative ? 1000.0 / p->lamp_lumens : 1.0,
                             .labels = room_for_labels(p) };
    double most          = f.maximum_cd * d.factor;
    most                 = most > 0.0 ? most : 1.0; /* a dark one: an empty diagram */
    d.step               = ring_step(most);
    d.top                = d.step * fmax(1.0, ceil(most / d.step - 1e-9));

    output_file file;
    if (!file_create(&file, path, err))
        return false;
    d.out = file.stream;
    draw(&d, title, relative ? "cd/klm" : "cd");
    return file_commit(&file, err);
}
