/* data/office/model.h -- shapes placed by a tree of nodes, cameras, and how they become a .glb.
 *
 * Metres, x east, y north, z up; written as glTF's y up: (x, y, z) -> (x, z, -y).
 */
#ifndef OFFICE_MODEL_H
#define OFFICE_MODEL_H

#include "data/office/solid.h"

#include <stdio.h>

enum { NO_SHAPE = -1, NO_PARENT = -1, SHAPE_MAX = 64, NODE_MAX = 1024, CAMERA_MAX = 4 };

typedef struct node {
    char name[32];
    int shape, parent; /* parents come before their children */
    point at;          /* m, in the parent's frame */
    double turn_deg;   /* counter-clockwise about z */
    bool mirror;       /* x to -x, before the turn */
} node;

typedef struct camera {
    const char *name;
    point eye, target; /* m */
    double yfov_deg;
} camera;

/* Clear with model_clear(). What does not fit sets `overflow`; writing then fails. */
typedef struct model {
    shape shapes[SHAPE_MAX];
    node nodes[NODE_MAX];
    camera cameras[CAMERA_MAX];
    int shape_count, node_count, camera_count;
    bool overflow;
} model;

/* Both return the index. The model takes the shape over. */
int model_add_shape(model *m, shape s);
int model_add_node(model *m, node n);
void model_add_camera(model *m, camera c);
void model_clear(model *m);

/* Triangles as placed: a shape counts as often as nodes show it. */
uint32_t model_triangles(const model *m);

/* All that is placed as one shape in the world's frame: every triangle is there by itself. */
shape model_baked(const model *m);

/* Writes the model as binary glTF 2.0. False: something did not fit, or writing failed. */
bool model_write_glb(const model *m, FILE *to);

/* What the materials are called and what they reflect, linear red, green, blue. */
typedef struct paint {
    const char *name;
    double color[3];
} paint;
const paint *paint_of(material m);

#endif
