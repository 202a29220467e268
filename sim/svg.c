/* sim/svg.c -- see svg.h. */
#include "sim/svg.h"

#include "core/utf8.h"

#include <math.h>
#include <string.h>

static const double DEG = M_PI / 180.0;

void svg_begin(FILE *out, double width, double height)
{
    fprintf(out,
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" "
            "width=\"%g\" height=\"%g\" viewBox=\"0 0 %g %g\" font-family=\"sans-serif\">\n"
            "<rect width=\"100%%\" height=\"100%%\" fill=\"white\"/>\n",
            width, height, width, height);
}

void svg_end(FILE *out) { fprintf(out, "</svg>\n"); }

double svg_step(double most)
{
    enum { MOST_STEPS = 6 };
    static const double steps[] = { 1.0, 2.0, 2.5, 5.0, 10.0 };
    double power                = pow(10.0, floor(log10(most / MOST_STEPS)));
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++)
        if (MOST_STEPS * steps[i] * power >= most * (1.0 - 1e-9))
            return steps[i] * power;
    return 10.0 * power;
}

/* ---- text ------------------------------------------------------------------------------- */

static const double LARGEST_TITLE = 16.0, SMALLEST_TITLE = 10.0;

/* The width of text in its own size, roughly: of a capital, or of a character of two cells. */
static double text_width(const char *s, size_t bytes)
{
    double width = 0.0;
    for (size_t i = 0; i < bytes; i++)
        width += (s[i] & 0xc0) == 0x80 ? 0.0 : (s[i] & 0xf0) == 0xe0 ? 1.0 : 0.68;
    return width;
}

/* The bytes of the title that fit where it is drawn smallest. */
static size_t title_fits(const char *s, double width)
{
    size_t n = strlen(s);
    while (n > 0 && ((s[n] & 0xc0) == 0x80 || text_width(s, n) * SMALLEST_TITLE > width))
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

void svg_title(FILE *out, double x, double y, double width, const char *title)
{
    size_t bytes = title_fits(title, width);
    double size  = fmin(LARGEST_TITLE, width / fmax(text_width(title, bytes), 1.0));
    fprintf(out, "<text x=\"%g\" y=\"%g\" font-size=\"%.1f\" text-anchor=\"middle\">", x, y, size);
    xml_text(out, title, bytes);
    fprintf(out, "%s</text>\n", title[bytes] ? "…" : "");
}

void svg_words(FILE *out, double x, double y, double size, const char *words)
{
    fprintf(out, "<text x=\"%g\" y=\"%g\" font-size=\"%g\" text-anchor=\"middle\">", x, y, size);
    xml_text(out, words, strlen(words));
    fprintf(out, "</text>\n");
}

/* ---- polar diagrams --------------------------------------------------------------------- */

void svg_polar_scale(svg_polar *p, double most)
{
    most    = most > 0.0 ? most : 1.0; /* a dark one: an empty diagram */
    p->step = svg_step(most);
    p->top  = p->step * fmax(1.0, ceil(most / p->step - 1e-9));
}

static void place(const svg_polar *p, double radius, double angle_deg, double *x, double *y)
{
    *x = p->x + radius * sin(angle_deg * DEG);
    *y = p->y + radius * cos(angle_deg * DEG);
}

void svg_polar_place(const svg_polar *p, double value, double angle_deg, double *x, double *y)
{
    place(p, p->radius * value / p->top, angle_deg, x, y);
}

static int rings_of(const svg_polar *p) { return (int)lround(p->top / p->step); }

static bool is_drawn(const svg_polar *p, int t) { return !p->upper || (t >= 90 && t <= 270); }

static void draw_lines(FILE *out, const svg_polar *p)
{
    int rings = rings_of(p);
    fprintf(out, "<g fill=\"none\" stroke=\"#c8c8c8\" stroke-width=\"1\">\n");
    for (int i = 1; i <= rings; i++) {
        double r = p->radius * i / rings;
        if (p->upper)
            fprintf(out, "<path d=\"M %.2f %g A %.2f %.2f 0 0 1 %.2f %g\"/>\n", p->x - r, p->y, r,
                    r, p->x + r, p->y);
        else
            fprintf(out, "<circle cx=\"%g\" cy=\"%g\" r=\"%.2f\"/>\n", p->x, p->y, r);
    }
    for (int t = 0; t < 360; t += 30) {
        double x, y;
        place(p, p->radius, t, &x, &y);
        if (is_drawn(p, t))
            fprintf(out, "<line x1=\"%g\" y1=\"%g\" x2=\"%.2f\" y2=\"%.2f\"/>\n", p->x, p->y, x, y);
    }
    fprintf(out, "</g>\n");
}

static int spoke_name(const svg_polar *p, int t)
{
    int from_down = t <= 180 ? t : 360 - t;
    return p->from_normal && from_down > 90 ? 180 - from_down : from_down;
}

void svg_polar_grid(FILE *out, const svg_polar *p)
{
    int rings = rings_of(p);
    draw_lines(out, p);
    fprintf(out, "<g fill=\"#404040\" font-size=\"12\" text-anchor=\"middle\">\n");
    for (int t = 0; t < 360; t += 30) {
        double x, y;
        place(p, p->radius + 18.0, t, &x, &y);
        if (is_drawn(p, t))
            fprintf(out, "<text x=\"%.2f\" y=\"%.2f\">%d°</text>\n", x, y + 4.0, spoke_name(p, t));
    }
    fprintf(out, "</g>\n<g fill=\"#404040\" font-size=\"11\">\n");
    for (int i = 1; i <= rings; i++) { /* between the spokes, on a white ground */
        double x, y;
        place(p, p->radius * i / rings, p->labels_deg, &x, &y);
        fprintf(out,
                "<text x=\"%.2f\" y=\"%.2f\" text-anchor=\"middle\" stroke=\"white\" "
                "stroke-width=\"3\" paint-order=\"stroke\">%g</text>\n",
                x, y + 4.0, p->step * i);
    }
    fprintf(out, "</g>\n");
}
