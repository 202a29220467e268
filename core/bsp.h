/* core/bsp.h -- a BSP tree of planes across the axes, by the surface area heuristic.
 *
 * A node is 8 bytes; its two children stand side by side, in one cache line:
 *
 *     inner   link = child << 3 | axis         split   where the plane is
 *             nodes[child] is what lies below it on the axis, nodes[child + 1] what lies above;
 *             child is even, so that child << 3 is how many bytes it lies behind nodes[0]
 *     leaf    link = count << 2 | BSP_LEAF     first   its items: items[first .. first + count)
 *
 * nodes[0] is the root and nodes[1] is not used, so that all pairs are aligned. The items of a
 * leaf ascend.
 *
 * Built after Wald and Havran, "On building fast kd-trees for ray tracing, and on doing that in
 * O(N log N)", 2006, with perfect splits: a triangle counts with what of it lies in the cell.
 */
#ifndef CORE_BSP_H
#define CORE_BSP_H

#include "core/arena.h"
#include "core/transform.h"
#include "core/vec3.h"

#include <stdint.h>

enum { BSP_LEAF = 3, BSP_STACK = 64, BSP_MOST_ITEMS = 1 << 29, BSP_MOST_NODES = 1 << 29 };

typedef struct bsp_node {
    uint32_t link;
    union {
        float split;
        uint32_t first;
    };
} bsp_node;

typedef struct bsp {
    const bsp_node *nodes;
    const uint32_t *items;
    vec3 low, high;             /* what it holds lies between */
    float largest;              /* of their coordinates, without sign */
    uint64_t item_count, bytes; /* bytes: of nodes and items */
} bsp;

typedef struct bsp_box {
    float low[3], high[3];
} bsp_box;

/* Either triangles or boxes. Coordinates finite. Triangles without area are left out. */
typedef struct bsp_desc {
    const float *corners; /* 9 a triangle; NULL: the things are boxes */
    const bsp_box *boxes;
    uint32_t count;  /* <= BSP_MOST_ITEMS */
    double traverse; /* cost of a step down, that of testing a thing being 1 */
    int threads;     /* >= 1; the tree does not depend on it */
} bsp_desc;

/* Fills in *tree, its arrays in a. false, with *err, if memory is out. */
bool bsp_build(arena *a, const bsp_desc *d, bsp *tree, lux_error *err);

/* What of a triangle (9 floats) lies in *cell, as a box; false if nothing does. */
bool bsp_clip(const float *corners, const bsp_box *cell, bsp_box *part);

#endif
