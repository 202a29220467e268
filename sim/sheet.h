/* sim/sheet.h -- what sheets of plans are drawn with: grids in false colours, legend, north.
 *
 * Lengths are px of the picture, y grows downward; a plan has the grid's u to the right and v up.
 */
#ifndef SIM_SHEET_H
#define SIM_SHEET_H

#include "sim/color_scale.h"
#include "sim/grid.h"

#include <stdio.h>

typedef struct sheet_box {
    double x, y, width, height;
} sheet_box;

/* Height by width of a grid's plan: of points, a square for each. */
double sheet_aspect(const grid_result *r);

/* Cells in the colours of their values (by sensor), those without a sensor grey, in a frame. */
void sheet_plan(FILE *out, const sheet_box *at, const grid_result *r, const double *values,
                const color_scale *scale);

/* The values as numbers over such a plan, of every n-th sensor both ways so that they can be read;
 * nothing where the plan is too small. Numbers of a hundred or more are whole. */
void sheet_numbers(FILE *out, const sheet_box *at, const grid_result *r, const double *values,
                   const color_scale *scale);

/* The bands in a row with their limits below and the unit behind; SHEET_LEGEND px high. */
enum { SHEET_LEGEND = 34 };
void sheet_legend(FILE *out, double x, double y, double width, const color_scale *scale,
                  const char *unit);

/* An arrow to true north in a circle of that middle; nothing unless the grid lies level. */
void sheet_north(FILE *out, double x, double y, const grid_result *r, double north_deg);

/* A line of text that begins (or with `middle`, whose middle is) at x. */
typedef struct sheet_text {
    double x, y, size;
    const char *fill; /* "#404040" */
    bool middle, bold;
} sheet_text;
void sheet_write(FILE *out, const sheet_text *at, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
