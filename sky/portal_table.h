/* sky/portal_table.h -- the light of half a sky, seen through rectangles of one orientation.
 *
 * In the frame of a portal, z along its outward normal, a direction (x, y, z) has the coordinates
 *
 *     a = x / (z + sqrt(x^2 + z^2))    b = y / (z + sqrt(y^2 + z^2))
 *
 * in [-1, 1], the tangents of half the angles about the portal's sides, in which every portal is a
 * rectangle from everywhere (Bitterli, Novak and Jarosz 2015 take the angles themselves: these
 * need no arc). With X = x / z and Y = y / z
 *
 *     d omega / (da db) = 4 (1 + X^2) (1 + Y^2) / ((1 + a^2) (1 + b^2) (1 + X^2 + Y^2)^(3/2))
 *
 * Sums over cells are whole numbers, so that differences of them are exact however small.
 */
#ifndef SKY_PORTAL_TABLE_H
#define SKY_PORTAL_TABLE_H

#include "core/packet.h"
#include "sky/brightness.h"

typedef struct portal_table {
    vec3 u, v, outward;  /* unit */
    int cells;           /* along a side */
    float unit;          /* sr of the sky's mean luminance, that a count of 1 is worth */
    const int32_t *sums; /* (cells + 1) along a, for each of cells + 1 steps of b: of the counts
                            before both; every cell has one at least */
} portal_table;

/* False, with *err, without memory. Makes sums; u, v, outward and cells are the caller's. */
bool portal_table_fill(arena *a, portal_table *t, const brightness *b, lux_error *err);

/* A rectangle as seen from a point: [x - half_x, x + half_x] x [y - half_y, y + half_y] at the
 * height z. */
typedef struct portal_view {
    vfloat x, y, z, half_x, half_y; /* m */
} portal_view;

/* Along one of the sides, in cells: widths of the first, and of the last where there are two; all
 * between count in full. */
typedef struct portal_span {
    vint edge[4]; /* of the first, its end, of the last, its end */
    vfloat low;   /* the coordinate where it begins */
    vfloat width;
    vfloat first, last;
} portal_span;

typedef struct portal_box {
    portal_span a, b;
    vmask seen;   /* from its inner side, and wide enough to be told from a line */
    vfloat light; /* about what comes from there, in units of the table's; > 0 where seen */
} portal_box;

/* Lanes that are not active are not seen. */
void portal_table_box(const portal_table *t, const portal_view *v, vmask active, portal_box *box);

/* A direction through the box, not of unit length, in the frame of the portal. */
vvec3 portal_table_draw(const portal_table *t, const portal_box *box, vfloat s, vfloat q);

/* 1/sr, of the unit direction w within the box, in the frame of the portal; > 0. */
vfloat portal_table_density(const portal_table *t, const portal_box *box, const vvec3 *w,
                            vmask active);

#endif
