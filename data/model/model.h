/* data/model/model.h -- shapes placed by a tree of nodes, cameras, and how they become a .glb.
 *
 * Metres, x east, y north, z up; written as glTF's y up: (x, y, z) -> (x, z, -y).
 */
#ifndef MODEL_MODEL_H
#define MODEL_MODEL_H

#include "data/model/picture.h"
#include "data/model/solid.h"

#include <stdio.h>

enum { NO_SHAPE = -1, NO_PARENT = -1, SHAPE_MAX = 64, NODE_MAX = 1024, CAMERA_MAX = 4 };

/* Where texture coordinates come from: of a corner at (x, y, z) of its shape, in metres by `tile`.
 * The picture's top is up, or north on what looks up. */
typedef enum mapping {
    MAP_NONE,
    MAP_BOX,  /* seen along the axis that the face looks along most */
    MAP_FIT,  /* so too, and the whole picture once over all of the patch */
    MAP_SIDE, /* seen from the south, whatever way the face looks */
    MAP_TURN, /* u around z, of which `tile` is the part that a picture covers, a turn being 1 */
} mapping;

/* What a material is called and does with light, as glTF has it. All that is 0 is matt paint. */
typedef struct paint {
    const char *name;
    double color[3]; /* linear red, green, blue: reflectance, or what clear glass is tinted with */
    double metallic, gloss;        /* [0, 1]; roughness is 1 - gloss */
    double emission;               /* cd/m^2 of white */
    double transmission;           /* [0, 1] */
    double ior;                    /* 0: not said, which is 1.5 */
    double thickness;              /* m; > 0: the border of a solid that refracts */
    double tint[3], tint_distance; /* m; what of white light is left after that way; 0: all */
    double crease_deg;             /* faces that meet by less than this are smooth; 0: flat */

    const picture *base, *relief; /* base colour, to be multiplied with color; normal map; NULL */
    mapping map;
    double tile;         /* m, of MAP_TURN turns, > 0: what a picture covers; by 0 it is 1 */
    double turn_deg;     /* pictures are turned by KHR_texture_transform, and shrunk */
    double shrink;       /* by this; 0: not */
    double cutoff;       /* > 0: what has less alpha in the picture is cut out */
    bool seen_from_both; /* doubleSided, which viewers want to be told of sheets */
} paint;

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
    const char *title, *maker; /* of the scene; the program */
    const paint *paints;       /* by a shape's ink */
    int paint_count;           /* <= INK_MAX */
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

/* Places a shape by a node of its name; returns the node. */
int model_put(model *m, int shape_index, point at, double turn_deg);
int model_put_new(model *m, shape s, point at, double turn_deg);

/* Triangles as placed: a shape counts as often as nodes show it. */
uint32_t model_triangles(const model *m);

/* All that is placed as one shape in the world's frame: every triangle is there by itself. */
shape model_baked(const model *m);

/* Writes the model as binary glTF 2.0. False: something did not fit, or writing failed. */
bool model_write_glb(const model *m, FILE *to);

/* Makes folder/name by write(). EXIT_SUCCESS, or EXIT_FAILURE having told why. */
int model_make_file(const char *folder, const char *name, bool (*write)(FILE *to));

/* The same of a model, with a line about its size; and a whole program that takes the folder. */
int model_make(const char *folder, const char *name, void (*build)(model *m));
int model_main(int argc, char **argv, const char *name, void (*build)(model *m));

/* ---- parts of model_write_glb() ---- */

/* The corners of a patch as glTF wants them: one for each normal and pair of coordinates. */
typedef struct drawn {
    float *xyz, *normals, *uv; /* 3, 3 and 2 a vertex; normals and uv may be NULL */
    uint32_t *corners;         /* 3 a triangle */
    uint32_t vertex_count, triangle_count;
    bool own; /* xyz and corners are not the patch's */
} drawn;
bool draw_patch(const patch *t, const paint *p, drawn *out);
void drawn_clear(drawn *d);

/* The pictures that paints have, each once; returns how many. */
int model_pictures(const model *m, const picture *list[2 * INK_MAX]);

/* "materials", and the "textures" and "images" they need, of which the first is in buffer view
 * `view`; ends with a comma. */
void paints_json(FILE *to, const model *m, int view);

#endif
