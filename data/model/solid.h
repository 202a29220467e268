/* data/model/solid.h -- closed solids of triangles: boxes, slabs with holes, lathe work, tubes.
 *
 * Metres, z up, corners counter-clockwise seen from outside. Every solid is a closed surface
 * whose triangles share corners by index, so that each edge is used once in either direction.
 * Coordinates are rounded to 10 micrometres: libraries of other machines that differ in the last
 * bit of a sine still give the same bytes.
 */
#ifndef MODEL_SOLID_H
#define MODEL_SOLID_H

#include "data/model/point.h"

#include <stdbool.h>
#include <stdint.h>

#define COUNT(array) (int)(sizeof(array) / sizeof *(array))

enum { INK_MAX = 32 }; /* materials of a model */

/* The triangles of one material. */
typedef struct patch {
    float *xyz;        /* m, 3 a vertex */
    uint32_t *corners; /* 3 a triangle */
    uint32_t vertex_count, vertex_room, triangle_count, triangle_room;
} patch;

/* A thing that is placed as a whole; clear with solid_clear(). What is set here (ink, frame, warp)
 * holds for the solids that are added after. */
typedef struct shape {
    char name[32];
    patch patches[INK_MAX];
    int ink;                /* index of the material of what is added */
    double detail;          /* > 0: multiplies the number of segments of what is round */
    point origin, axis[3];  /* frame: where solids are put, orthonormal, right-handed */
    void (*warp)(point *p); /* bends what is added, before the frame; NULL: nothing */
    bool out_of_memory;     /* something is missing */
} shape;

shape shape_new(const char *name, double detail);
void solid_clear(shape *s);

/* Sets the frame: at p, turned by degrees counter-clockwise about z, tipped before that about x. */
void shape_at(shape *s, point p, double turn_deg, double tip_deg);

/* Single corners and faces of the current ink; the corner's index within it. */
uint32_t add_vertex(shape *s, point p);
void add_triangle(shape *s, uint32_t a, uint32_t b, uint32_t c);

/* Between two opposite corners, a below b in each coordinate. */
void add_box(shape *s, point a, point b);

/* A plate of thickness w0..w1 along `across` (0: x, 1: y, 2: z) over a raster of lines
 * u[nu], v[nv], ascending (u, v: the other two axes in the order x, y, z). Cells where
 * cells[j * (nu - 1) + i] is a blank are holes; holes must not touch at a corner alone. */
typedef struct plate {
    int across, nu, nv;
    const double *u, *v;
    const char *cells;
    double w0, w1;
} plate;
void add_plate(shape *s, const plate *p);

/* Turned about z: a profile r[i], z[i] from the lowest pole (r = 0) up the outside to the highest
 * (r = 0), or, if closed, a loop that keeps clear of the axis, upwards on its outside. */
typedef struct lathe {
    const double (*rz)[2];
    int count, segments;
    bool closed;
} lathe;
void add_lathe(shape *s, const lathe *l);

/* The same, the profile being a curve with `per` points between knots: see curve_points(). A
 * profile of 512 points has no room and adds nothing. */
void add_turned(shape *s, const lathe *l, int per);
void add_cylinder(shape *s, point base, double radius, double height, int segments);

/* Around a path of count >= 2 points, capped at both ends. */
typedef struct tube {
    const point *path;
    int count, segments;
    double radius, end_radius; /* m; end_radius 0: the same */
} tube;
void add_tube(shape *s, const tube *t);

/* A cushion: |x/a|^(2/e)... with half sizes h; e near 0 is a box, 1 an ellipsoid. rings >= 3. */
typedef struct cushion {
    point centre, half;
    double squareness;   /* e of the horizontal section, (0, 1] */
    double edge;         /* e of the vertical section, (0, 1] */
    int segments, rings; /* segments: a multiple of 4 */
    bool ruled;          /* flat sides of strips along x that a warp along y bends evenly */
} cushion;
void add_cushion(shape *s, const cushion *c);

uint32_t shape_triangles(const shape *s);

/* Uniform cubic B-splines: smooth curves near their knots, which they reach at both ends and where
 * three knots coincide. At most (count + 1) * per + 1 points; returns how many. */
int curve_points(const double (*knots)[2], int count, int per, double (*out)[2]);

/* The height at x of such a curve over knots that are `step` apart, from `first` on. */
double curve_at(const double *knots, int count, double first, double step, double x);

/* The next of a sequence of numbers in [0, 1), the same everywhere. */
double draw(uint32_t *seed);

#endif
