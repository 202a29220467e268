/* core/mesh.h -- triangles, as they come: corners, who shares them, what they are made of. */
#ifndef CORE_MESH_H
#define CORE_MESH_H

#include "core/vec3.h"

#include <stdint.h>

/* Front is the side from which the corners run counter-clockwise. The arrays belong to whoever
 * filled them in and live as long as what is built of them. */
typedef struct mesh {
    const vec3 *positions;    /* m, finite */
    const uint32_t *corners;  /* 3 a triangle, each < position_count */
    const uint32_t *material; /* 1 a triangle; NULL: all 0 */
    uint32_t position_count, triangle_count;

    /* Of each corner of each triangle, 3 a triangle; NULL: none */
    const float *texcoord[2]; /* (u, v) of each set, finite */
    const vec3 *normals;      /* unit, toward the front; (0, 0, 0): the triangle's own */
} mesh;

#endif
