/* core/place.h -- inside a world: the triangle that each lane has met, and where it is placed. */
#ifndef CORE_PLACE_H
#define CORE_PLACE_H

#include "core/trace.h"

typedef struct vplace {
    vfloat corner[9]; /* m, in the mesh */
    vfloat to_world[3][4], to_mesh[3][4];
    vint material;
    vmask
        identity; /* the matrices need not be applied, and are not: so too where other lanes' are */
    vmask mirrors; /* to_world does */
} vplace;

/* Active lanes have a hit; the others come back zero, identity apart. */
void place_find(const world *w, const vhit *hit, vmask active, vplace *out);

/* A normal of the triangle on its front side, in the mesh, of a length from 0.03 to 2 (degenerate
 * triangles apart). `height`, m: what the triangle's least height may be, in the mesh. */
vvec3 place_front(const vplace *p, vmask active, vfloat *height);

/* A normal of the mesh, of any length, as it is in the world: unit. The transposed inverse so takes
 * the front side to where the matrix takes it, mirrored or not. */
vvec3 place_normal(const vplace *p, vvec3 n);

/* A vector of the mesh, in the world. */
vvec3 place_vector(const vplace *p, vvec3 a);

static inline vvec3 place_corner(const vplace *p, int i)
{
    return (vvec3){ p->corner[3 * i], p->corner[3 * i + 1], p->corner[3 * i + 2] };
}
static inline vfloat place_largest(vvec3 a) { return vmax(vabs(a.x), vmax(vabs(a.y), vabs(a.z))); }

/* m a, and m's column 3 `one` times. */
static inline vfloat place_row(const vfloat m[4], vvec3 a, vfloat one)
{
    return m[0] * a.x + m[1] * a.y + m[2] * a.z + m[3] * one;
}
static inline vvec3 place_moved(const vfloat m[3][4], vvec3 a, vfloat one)
{
    return (vvec3){ place_row(m[0], a, one), place_row(m[1], a, one), place_row(m[2], a, one) };
}

#endif
