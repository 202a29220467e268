/* sim/svg.h -- what the diagrams of the program are drawn with: SVG by hand, readable in print.
 *
 * Lengths are in px of the picture; y grows downward.
 */
#ifndef SIM_SVG_H
#define SIM_SVG_H

#include <stdbool.h>
#include <stdio.h>

/* Everything else stands between these two. */
void svg_begin(FILE *out, double width, double height);
void svg_end(FILE *out);

/* Text of the user's or a file's, middle at x: as large as fits in `width`; too long, it is cut. */
void svg_title(FILE *out, double x, double y, double width, const char *title);

/* The same of a given size and at full length. */
void svg_words(FILE *out, double x, double y, double size, const char *words);

/* 1, 2, 2.5 or 5 times a power of ten, so that at most six steps hold `most` (> 0). */
double svg_step(double most);

/* A polar diagram: the radius is a value, the angle is counted from straight down, to the right. */
typedef struct svg_polar {
    double x, y, radius; /* of its centre; of `top` */
    double top, step;    /* in its unit; between rings */
    double labels_deg;   /* where the rings are labelled */
    bool from_normal;    /* spokes tell the angle from the nearer vertical, not from down */
    bool upper;          /* its upper half alone */
} svg_polar;

/* Top and step for values up to `most`. */
void svg_polar_scale(svg_polar *p, double most);

/* Where a value at an angle is drawn. */
void svg_polar_place(const svg_polar *p, double value, double angle_deg, double *x, double *y);

/* Rings and spokes, and what they are. */
void svg_polar_grid(FILE *out, const svg_polar *p);

#endif
