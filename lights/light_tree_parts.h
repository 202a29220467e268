/* lights/light_tree_parts.h -- what a light tree is made of, for light_tree.c and its maker. */
#ifndef LIGHTS_LIGHT_TREE_PARTS_H
#define LIGHTS_LIGHT_TREE_PARTS_H

#include "lights/light_tree.h"

/* The numbers of a node, one cache line */
enum {
    NODE_X,
    NODE_Y,
    NODE_Z,
    NODE_RADIUS, /* m, > 0 */
    NODE_AXIS_X,
    NODE_AXIS_Y,
    NODE_AXIS_Z,
    NODE_COS_SPREAD,
    NODE_SIN_SPREAD,
    NODE_COS_REACH,
    NODE_FLOOR, /* what counts of the peak at the rim of the reach */
    NODE_PEAK,  /* of all lights below, in units of the tree's brightest; > 0 */
    NODE_NUMBERS = 16
};

typedef struct tree_node {
    alignas(64) float number[NODE_NUMBERS];
} tree_node;

typedef struct far_light {
    vec3 axis;                /* where the light goes */
    float cos_wide, sin_wide; /* of how far from the axis it goes at most */
    float peak;               /* in the units of the near ones */
    int light;
} far_light;

enum { DARK_PLACE = -1, FAR_PLACE = -2 };

struct light_tree {
    const tree_node *nodes; /* the first child of nodes[i] is nodes[i + 1] */
    const int32_t *links;   /* the second child; ~light of a leaf */
    const far_light *far;
    const int32_t *places; /* of each light: its leaf, DARK_PLACE, or FAR_PLACE - its far light */
    int node_count, far_count, light_count;
};

#endif
