/* sim/cost_plot.c -- error against time as SVG; see cost_write.h.
 *
 *     +------------------------------+
 *     | *--.       o ----------------+--- --no mirrors      The ladder of accuracy is a line with
 *     |     `*-.   o ----------------+--- bounces 1         its labels below it; all others are
 *     |         `*                   |                      named at the right, in the order of
 *     +------------------------------+                      their errors.
 */
#include "core/file.h"
#include "sim/cost_write.h"
#include "sim/output.h"
#include "sim/svg.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double WIDTH = 860.0, HEIGHT = 600.0; /* px, of the picture */
static const double LEFT = 74.0, RIGHT = 640.0, TOP = 76.0, BOTTOM = 500.0;
static const double NAMES = 664.0, NAME_STEP = 14.0, NAME_SIZE = 11.0;
enum { MOST_NAMES = 96 };

typedef struct log_axis {
    double low, high; /* > 0 */
    double from, to;  /* px, of these */
} log_axis;

typedef struct cost_picture {
    FILE *out;
    const cost_result *r;
    log_axis x, y; /* s; % */
} cost_picture;

static double place(const log_axis *a, double value)
{
    return a->from + (a->to - a->from) * log(value / a->low) / log(a->high / a->low);
}

static bool is_drawn(const cost_row *r)
{
    return r->seconds > 0.0 && r->rms > 0.0 && isfinite(r->rms);
}

static double x_of(const cost_picture *p, const cost_row *r) { return place(&p->x, r->seconds); }
static double y_of(const cost_picture *p, const cost_row *r)
{
    return place(&p->y, 100.0 * r->rms);
}

/* ---- axes ------------------------------------------------------------------------------------ */

/* From 1, 2 or 5 times a power of ten to another such, half a decade apart at least. */
static double step_down(double x)
{
    double power = pow(10.0, floor(log10(x) + 1e-9)), m = x / power;
    return power * (m >= 5.0 - 1e-6 ? 5.0 : m >= 2.0 - 1e-6 ? 2.0 : 1.0);
}

static double step_up(double x)
{
    double low = step_down(x), power = pow(10.0, floor(log10(low) + 1e-9));
    return low >= 5.0 * power * (1.0 - 1e-6)   ? 10.0 * power
           : low >= 2.0 * power * (1.0 - 1e-6) ? 5.0 * power
                                               : 2.0 * power;
}

static void take(log_axis *a, double value)
{
    a->low  = fmin(a->low, value);
    a->high = fmax(a->high, value);
}

static void round_axis(log_axis *a)
{
    if (!(a->low <= a->high)) /* nothing is drawn */
        a->low = 0.1, a->high = 10.0;
    a->low  = step_down(a->low / 1.2);
    a->high = step_up(a->high * 1.2);
}

static void find_axes(cost_picture *p)
{
    p->x = (log_axis){ HUGE_VAL, 0.0, LEFT, RIGHT };
    p->y = (log_axis){ HUGE_VAL, 0.0, BOTTOM, TOP };
    for (int i = 0; i < p->r->row_count; i++)
        if (is_drawn(&p->r->rows[i])) {
            take(&p->x, p->r->rows[i].seconds);
            take(&p->y, 100.0 * p->r->rows[i].rms);
        }
    round_axis(&p->x);
    round_axis(&p->y);
}

static void draw_text(FILE *out, double x, double y, double size, const char *anchor,
                      const char *text)
{
    fprintf(out,
            "<text x=\"%.1f\" y=\"%.1f\" font-size=\"%g\" text-anchor=\"%s\" stroke=\"white\" "
            "stroke-width=\"3\" paint-order=\"stroke\">%s</text>\n",
            x, y, size, anchor, text);
}

static void draw_line(FILE *out, const double from[2], const double to[2], const char *style)
{
    fprintf(out, "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" %s/>\n", from[0], from[1],
            to[0], to[1], style);
}

/* Lines and numbers at 1, 2 and 5 times powers of ten. */
static void draw_axis(const cost_picture *p, const log_axis *a, bool across)
{
    bool crowded = a->high / a->low > 3e4; /* then powers alone have numbers */
    for (double v = a->low; v <= a->high * 1.001; v = step_up(v)) {
        double at = place(a, v), whole = log10(v) - floor(log10(v) + 1e-9);
        bool power    = whole < 1e-6;
        double from[] = { across ? at : LEFT, across ? TOP : at };
        double to[]   = { across ? at : RIGHT, across ? BOTTOM : at };
        char text[32];
        snprintf(text, sizeof text, "%g", v);
        draw_line(p->out, from, to, power ? "stroke=\"#b0b0b0\"" : "stroke=\"#e4e4e4\"");
        if ((power || !crowded) && across)
            draw_text(p->out, at, BOTTOM + 17.0, 12.0, "middle", text);
        else if (power || !crowded)
            draw_text(p->out, LEFT - 7.0, at + 4.0, 12.0, "end", text);
    }
}

static void draw_frame(const cost_picture *p)
{
    draw_axis(p, &p->x, true);
    draw_axis(p, &p->y, false);
    fprintf(p->out,
            "<rect x=\"%g\" y=\"%g\" width=\"%g\" height=\"%g\" fill=\"none\" "
            "stroke=\"#404040\"/>\n",
            LEFT, TOP, RIGHT - LEFT, BOTTOM - TOP);
    svg_words(p->out, 0.5 * (LEFT + RIGHT), BOTTOM + 37.0, 13.0, "time / s");
    fprintf(p->out,
            "<text x=\"22\" y=\"%g\" font-size=\"13\" text-anchor=\"middle\" "
            "transform=\"rotate(-90 22 %g)\">RMS error / %%</text>\n",
            0.5 * (TOP + BOTTOM), 0.5 * (TOP + BOTTOM));
}

/* ---- the ladder of accuracy ------------------------------------------------------------------ */

static void draw_ladder_line(const cost_picture *p)
{
    fprintf(p->out, "<polyline fill=\"none\" stroke=\"#1050a0\" stroke-width=\"2\" points=\"");
    for (int i = 0; i < p->r->row_count; i++)
        if (p->r->rows[i].ladder == COST_ACCURACY && is_drawn(&p->r->rows[i]))
            fprintf(p->out, " %.1f,%.1f", x_of(p, &p->r->rows[i]), y_of(p, &p->r->rows[i]));
    fputs("\"/>\n", p->out);
}

/* Rungs that all but coincide share a label. */
static void label_rungs(const cost_picture *p)
{
    static const double near_px = 20.0;
    char text[120]              = "";
    double x = 0.0, y = 0.0;
    for (int i = 0; i < p->r->row_count; i++) {
        const cost_row *r = &p->r->rows[i];
        if (r->ladder != COST_ACCURACY || !is_drawn(r))
            continue;
        bool same = text[0] && hypot(x_of(p, r) - x, y_of(p, r) - y) < near_px;
        if (text[0] && !same) {
            draw_text(p->out, x - 6.0, y + 15.0, 12.0, "end", text);
            text[0] = '\0';
        }
        size_t n = strlen(text);
        x        = same ? fmin(x, x_of(p, r)) : x_of(p, r);
        y        = same ? fmax(y, y_of(p, r)) : y_of(p, r);
        snprintf(text + n, sizeof text - n, "%s%g %%", n ? ", " : "", 100.0 * r->accuracy);
    }
    if (text[0])
        draw_text(p->out, x - 6.0, y + 15.0, 12.0, "end", text);
}

/* ---- all others ------------------------------------------------------------------------------ */

static void draw_mark(const cost_picture *p, const cost_row *r)
{
    static const struct mark_look {
        const char *shape, *color;
    } looks[COST_LADDERS] = {
        [COST_ACCURACY]  = { "M -4.5 0 a 4.5 4.5 0 1 0 9 0 a 4.5 4.5 0 1 0 -9 0 z", "#1050a0" },
        [COST_BOUNCES]   = { "M -4 -4 h 8 v 8 h -8 z", "#b05010" },
        [COST_TRANSPORT] = { "M -5 0 h 10 M 0 -5 v 10", "#404040" },
        [COST_EFFECTS]   = { "M 0 -5.5 l 5 5.5 l -5 5.5 l -5 -5.5 z", "#207838" },
        [COST_RECKONING] = { "M 0 -5 l 5 9 h -10 z", "#903090" },
        [COST_RAYS]      = { "M -4 -4 l 8 8 M -4 4 l 8 -8", "#a02020" },
    };
    const struct mark_look *look = &looks[r->ladder];
    fprintf(p->out,
            "<path transform=\"translate(%.1f %.1f)\" d=\"%s\" stroke=\"%s\" "
            "stroke-width=\"1.6\" fill=\"%s\"/>\n",
            x_of(p, r), y_of(p, r), look->shape, look->color,
            r->ladder == COST_ACCURACY ? look->color : "white");
}

/* A name at the right: what of, and at which height. */
typedef struct cost_name {
    const cost_row *row;
    double wanted, y; /* px */
} cost_name;

static int by_height(const void *a, const void *b)
{
    const cost_name *p = a, *q = b;
    return (p->wanted > q->wanted) - (p->wanted < q->wanted);
}

/* Moves names apart by as little as can be, in the mean of squares: those that would cover each
 * other stand together about the middle of where they belong (pool adjacent violators). */
static void spread_names(cost_name *names, int count)
{
    double step = count > 1 ? fmin(NAME_STEP, (BOTTOM - TOP) / (count - 1)) : NAME_STEP;
    double sum[MOST_NAMES]; /* of wanted - i step, in each pool */
    int size[MOST_NAMES], pools = 0, at = 0;
    qsort(names, (size_t)count, sizeof *names, by_height);
    for (int i = 0; i < count; i++) {
        sum[pools]    = names[i].wanted - i * step;
        size[pools++] = 1;
        while (pools > 1 && sum[pools - 2] * size[pools - 1] > sum[pools - 1] * size[pools - 2]) {
            sum[pools - 2] += sum[pools - 1];
            size[pools - 2] += size[pools - 1];
            pools--;
        }
    }
    for (int k = 0; k < pools; k++)
        for (int i = 0; i < size[k]; i++, at++) {
            double y    = fmin(sum[k] / size[k], BOTTOM - (count - 1) * step);
            names[at].y = fmax(y, TOP) + at * step;
        }
}

static void draw_names(const cost_picture *p)
{
    cost_name names[MOST_NAMES];
    int count = 0;
    for (int i = 0; i < p->r->row_count && count < MOST_NAMES; i++) {
        const cost_row *r = &p->r->rows[i];
        if (r->ladder != COST_ACCURACY && is_drawn(r))
            names[count++] = (cost_name){ .row = r, .wanted = y_of(p, r) };
    }
    spread_names(names, count);
    for (int i = 0; i < count; i++) {
        double from[] = { x_of(p, names[i].row), names[i].wanted }, bend[] = { RIGHT, names[i].y };
        double to[] = { NAMES - 4.0, names[i].y };
        draw_line(p->out, from, bend, "stroke=\"#909090\" stroke-width=\"0.7\"");
        draw_line(p->out, bend, to, "stroke=\"#909090\" stroke-width=\"0.7\"");
    }
    for (int i = 0; i < count; i++)
        draw_text(p->out, NAMES, names[i].y + 4.0, NAME_SIZE, "start", names[i].row->setting);
}

/* ---- words ----------------------------------------------------------------------------------- */

static void draw_head(const cost_picture *p, const study *s)
{
    char line[200];
    const cost_result *r = p->r;
    int n = snprintf(line, sizeof line, "What accuracy costs in time: %s, ", output_study_name(s));
    snprintf(line + n, sizeof line - (size_t)n, "%s %s", r->view ? "view" : "grid", r->what);
    svg_title(p->out, 0.5 * WIDTH, 28.0, WIDTH - 60.0, line);
    n = snprintf(line, sizeof line, "line: --accuracy; its values are promised half widths");
    if (isfinite(r->slope))
        snprintf(line + n, sizeof line - (size_t)n, "; its error falls as rays^%.2f", r->slope);
    svg_words(p->out, 0.5 * WIDTH, 50.0, 12.0, line);
}

/* The advice, on two lines where one would be too long. */
static void draw_foot(const cost_picture *p)
{
    enum { FITS = 120 };
    char first[sizeof p->r->advice];
    snprintf(first, sizeof first, "%s", p->r->advice);
    size_t cut = strlen(first);
    while (cut > FITS || (first[cut] && first[cut] != ' '))
        cut--;
    const char *rest = first[cut] ? first + cut + 1 : "";
    first[cut]       = '\0';
    svg_words(p->out, 0.5 * WIDTH, HEIGHT - 36.0, 12.0, first);
    svg_words(p->out, 0.5 * WIDTH, HEIGHT - 18.0, 12.0, rest);
}

bool cost_plot(const char *path, const study *s, const cost_result *r, lux_error *err)
{
    output_file file;
    if (!file_create(&file, path, err))
        return false;
    cost_picture p = { .out = file.stream, .r = r };
    find_axes(&p);
    svg_begin(p.out, WIDTH, HEIGHT);
    draw_head(&p, s);
    draw_frame(&p);
    draw_names(&p);
    draw_ladder_line(&p);
    for (int i = 0; i < r->row_count; i++)
        if (is_drawn(&r->rows[i]))
            draw_mark(&p, &r->rows[i]);
    label_rungs(&p);
    draw_foot(&p);
    svg_end(p.out);
    return file_commit(&file, err);
}
