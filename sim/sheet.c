/* sim/sheet.c -- see sheet.h. */
#include "sim/sheet.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

double sheet_aspect(const grid_result *r)
{
    const study_grid *g = r->grid;
    if (g->points)
        return (double)r->rows / r->columns;
    return d3_length(g->v) / d3_length(g->u);
}

/* ---- a plan ---------------------------------------------------------------------------------- */

/* Cells of one band, runs of them in a row as one rectangle each: a plan of 10,000 cells stays a
 * few kilobytes. Cells stand in rows, as sensors do. */
static void draw_band(FILE *out, const grid_result *r, const double *values,
                      const color_scale *scale, int band)
{
    bool any = false;
    for (int k = 0, end; k < r->sensor_count; k = end) {
        int first = r->cell[k], row = first / r->columns;
        end = k + 1;
        if (color_scale_band(scale, values[k]) != band)
            continue;
        while (end < r->sensor_count && r->cell[end] == r->cell[end - 1] + 1 &&
               r->cell[end] / r->columns == row && color_scale_band(scale, values[end]) == band)
            end++;
        if (!any) {
            uint8_t rgb[3];
            color_scale_color(scale, band, rgb);
            fprintf(out, "<path fill=\"#%02x%02x%02x\" d=\"", rgb[0], rgb[1], rgb[2]);
        }
        int run = end - k;
        fprintf(out, "M%d %dh%dv1h%dz", first % r->columns, r->rows - 1 - row, run, -run);
        any = true;
    }
    if (any)
        fputs("\"/>\n", out);
}

void sheet_plan(FILE *out, const sheet_box *at, const grid_result *r, const double *values,
                const color_scale *scale)
{
    fprintf(out,
            "<g transform=\"translate(%.2f %.2f) scale(%.6g %.6g)\" "
            "shape-rendering=\"crispEdges\">\n"
            "<rect width=\"%d\" height=\"%d\" fill=\"#e4e4e4\"/>\n",
            at->x, at->y, at->width / r->columns, at->height / r->rows, r->columns, r->rows);
    for (int band = 0; band < scale->bands; band++)
        draw_band(out, r, values, scale, band);
    fprintf(out,
            "</g>\n<rect x=\"%.2f\" y=\"%.2f\" width=\"%.2f\" height=\"%.2f\" fill=\"none\" "
            "stroke=\"#303030\"/>\n",
            at->x, at->y, at->width, at->height);
}

static const double least_number = 9.0; /* px, of digits that can be read */

/* Every so many cells, so that a number of `digits` and a little space fit. */
static int apart(double cell, double wanted) { return (int)fmax(1.0, ceil(wanted / cell - 1e-9)); }

static int number_text(char text[32], double value)
{
    return snprintf(text, 32, "%.*f", value < 9.95 ? 2 : value < 99.5 ? 1 : 0, value);
}

/* Whether black is read better than white on it (Rec. 709 weights of the coded values). */
static bool is_light(const uint8_t rgb[3])
{
    return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2] > 120.0;
}

void sheet_numbers(FILE *out, const sheet_box *at, const grid_result *r, const double *values,
                   const color_scale *scale)
{
    double width = at->width / r->columns, height = at->height / r->rows;
    int longest = 0;
    for (int k = 0; k < r->sensor_count; k++) {
        char text[32];
        int digits = number_text(text, values[k]);
        longest    = digits > longest ? digits : longest;
    }
    double wide = least_number * 0.6 * (longest + 1), high = least_number * 1.4;
    int across = apart(width, wide), up = apart(height, high);
    if (wide > at->width || high > at->height)
        return;
    double size = fmin(13.0, least_number * fmin(across * width / wide, up * height / high));
    fprintf(out, "<g font-size=\"%.1f\" text-anchor=\"middle\">\n", size);
    for (int k = 0; k < r->sensor_count; k++) {
        int column = r->cell[k] % r->columns, row = r->rows - 1 - r->cell[k] / r->columns;
        if (column % across != (across - 1) / 2 || row % up != (up - 1) / 2)
            continue;
        char text[32];
        uint8_t rgb[3];
        number_text(text, values[k]);
        color_scale_color(scale, color_scale_band(scale, values[k]), rgb);
        fprintf(out, "<text x=\"%.1f\" y=\"%.1f\" fill=\"%s\">%s</text>\n",
                at->x + (column + 0.5) * width, at->y + (row + 0.5) * height + 0.36 * size,
                is_light(rgb) ? "black" : "white", text);
    }
    fputs("</g>\n", out);
}

/* ---- beside it ------------------------------------------------------------------------------- */

void sheet_write(FILE *out, const sheet_text *at, const char *format, ...)
{
    char text[256];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    fprintf(out, "<text x=\"%.2f\" y=\"%.2f\" font-size=\"%g\" fill=\"%s\"%s%s>%s</text>\n", at->x,
            at->y, at->size, at->fill, at->middle ? " text-anchor=\"middle\"" : "",
            at->bold ? " font-weight=\"bold\"" : "", text);
}

void sheet_legend(FILE *out, double x, double y, double width, const color_scale *scale,
                  const char *unit)
{
    double band = width / scale->bands;
    for (int i = 0; i < scale->bands; i++) {
        uint8_t rgb[3];
        color_scale_color(scale, i, rgb);
        fprintf(out,
                "<rect x=\"%.2f\" y=\"%.2f\" width=\"%.2f\" height=\"14\" fill=\"#%02x%02x%02x\" "
                "stroke=\"#303030\" stroke-width=\"0.5\"/>\n",
                x + band * i, y, band, rgb[0], rgb[1], rgb[2]);
    }
    for (int i = 0; i <= scale->bands; i++)
        sheet_write(out, &(sheet_text){ x + band * i, y + 28.0, 11.0, "#404040", true, false },
                    "%.10g", scale->limit[i]);
    sheet_write(out, &(sheet_text){ x + width + 16.0, y + 12.0, 12.0, "#404040", false, false },
                "%s", unit);
}

void sheet_north(FILE *out, double x, double y, const grid_result *r, double north_deg)
{
    const study_grid *g = r->grid;
    if (g->points || g->u.z != 0.0 || g->v.z != 0.0)
        return;
    double turn  = north_deg * M_PI / 180.0;
    dvec3 north  = { sin(turn), cos(turn), 0.0 };
    double right = d3_dot(north, g->u) / d3_length(g->u);
    double up    = d3_dot(north, g->v) / d3_length(g->v);
    double angle = atan2(right, up) * 180.0 / M_PI;
    fprintf(out,
            "<g transform=\"translate(%.2f %.2f)\"><circle r=\"15\" fill=\"none\" "
            "stroke=\"#909090\"/><g transform=\"rotate(%.4g)\"><path d=\"M0 -14L5 8L0 4L-5 8z\" "
            "fill=\"#303030\"/><text y=\"-18\" font-size=\"11\" text-anchor=\"middle\" "
            "fill=\"#303030\">N</text></g></g>\n",
            x, y, angle);
}
