/* sim/flat_pieces.h -- the flat pieces that triangles make up, each with a rectangle around it. */
#ifndef SIM_FLAT_PIECES_H
#define SIM_FLAT_PIECES_H

#include "core/arena.h"
#include "core/error.h"
#include "core/transform.h"

#include <stdint.h>

typedef struct flat_piece {
    dvec3 centre, u, v; /* m, of the rectangle: to the middles of two sides, square to each other */
    dvec3 normal;       /* unit */
    double area;        /* m^2, of the triangles */
    uint32_t tag;
} flat_piece;

/* Triangles hang together at edges that they share, to the bit, if they have one tag and lie within
 * half a degree of one plane; those without area count for nothing. Corners: 3 a triangle, m,
 * finite. The rectangle is the smallest along some edge. In a, the largest rectangle first; what is
 * curved gives rectangles that lie about as it does. False without memory. */
bool flat_pieces_of(arena *a, const dvec3 *corners, const uint32_t *tags, uint32_t triangle_count,
                    flat_piece **out, uint32_t *count, lux_error *err);

/* m^2, of the rectangle. */
static inline double flat_piece_face(const flat_piece *p)
{
    return 4.0 * d3_length(p->u) * d3_length(p->v);
}

#endif
