/* sim/map_parts.h -- what the files of illumination_map.h share: map_mesh.c puts the triangles of
 * meshes in order, map_cells.c grows trees of cells over them, map_outline.c knows where these lie,
 * map_walls.c sees what stands on them, map_aim*.c aims particles of focused light, map_trace.c
 * follows all, map_portals.c sends them toward portals, map_sensors.c watches them pass, map_look.c
 * answers, map_file.c keeps maps.
 *
 * A smooth piece of a mesh is a range of its triangles in an order along a space-filling curve. A
 * side of it in one instance is a sheet; each sheet to which particles came has a tree of cells:
 *
 *     range of triangles          split: the first of the second child, in that order
 *     |-- range                   split at the curve's largest step
 *     |   |-- one triangle        split: ~edge, which is bisected, 0: from corner 0 to 1 ...
 *     |   |   |-- half, on the side of the edge's first corner
 *     |   |   `-- half
 *     |   `-- ...
 *     `-- ...
 */
#ifndef SIM_MAP_PARTS_H
#define SIM_MAP_PARTS_H

#include "sim/emission.h"
#include "sim/illumination_map.h"

/* The triangles of a mesh: each one's piece, and its number in the order in which those of a piece
 * follow each other. */
typedef struct map_mesh {
    int32_t count, pieces;
    const int32_t *piece, *rank; /* of a triangle */
    const int32_t *first;        /* of a piece, and one more: its first rank */
    const int32_t *order;        /* the triangle of a rank; while building */
    const uint64_t *code;        /* where it lies along the curve; while building */
} map_mesh;

typedef struct map_node {
    double area;    /* m^2, in the world */
    int32_t child;  /* the first of two; 0: a leaf */
    int32_t split;  /* see above */
    int32_t parent; /* -1: none */
    int32_t walled; /* something stands on it: as a leaf it has no value */
} map_node;

/* What `walled` says */
enum { NODE_FREE, NODE_WALLED };

/* Trees, by what they lie on: open addressing; root -1: empty. */
typedef struct map_sheet {
    int32_t instance, piece, front, root;
} map_sheet;

typedef struct map_cells {
    map_mesh *meshes; /* as world_mesh() counts them */
    uint32_t mesh_count;
    map_sheet *sheets;
    uint32_t sheet_room; /* a power of two */
    map_node *nodes;
    int32_t node_count;
} map_cells;

/* A place where a particle came to a surface, for the pilots. */
typedef struct map_mark {
    int32_t instance, triangle, front;
    int32_t piece; /* while growing */
    float u, v;    /* of corners 1 and 2 */
    float weight;  /* W, as luminance */
} map_mark;

typedef struct map_growth {
    const scene *s;
    map_mark *marks;
    size_t mark_count;
    double scale;  /* particles to come, of all maps, for one pilot */
    double least;  /* of those to come, that a cell of a large one is to get */
    double fewest; /* of those to come, that a sheet must have to get cells */
    size_t most;   /* cells */
} map_growth;

/* The meshes of the scene in order. */
bool map_meshes_new(arena *a, const scene *s, map_cells *out, lux_error *err);
bool map_mesh_new(arena *a, const world *w, int32_t instance, map_mesh *out, lux_error *err);

/* Grows trees where pilots came. Reorders the marks. */
bool map_cells_grow(arena *a, const map_growth *g, map_cells *c, lux_error *err);

/* m^2: of the sheets to which pilots came, each by its share of their light: F^2 / sum (F_i^2 /
 * A_i), which of evenly lit ones is their area. Reorders the marks. */
double map_lit_area(const map_growth *g, const map_cells *c);

/* The leaf at a place, or -1: no cell, or one without a value. */
int32_t map_cells_find(const map_cells *c, uint32_t placed, const map_mark *at);

/* ---- parts of a mesh ------------------------------------------------------------------------- */

/* What a tree lies on: one side of a mesh where it stands. */
typedef struct map_ground {
    const world *world;
    const map_mesh *mesh;
    int32_t instance;
    bool front, mirrors; /* the side; the place turns it over */
    transform place;
    double rounding; /* m: what coordinates are off by */
} map_ground;

/* What a cell lies on. */
typedef struct map_part {
    int32_t low, high; /* ranks; of one triangle high = low + 1 */
    bool single;
    dvec3 corner[3]; /* m, in the world; of a single one or of a part of it */
} map_part;

/* The corners of the triangle of a rank, m, in the world; what it is made of. */
uint32_t map_triangle_at(const map_ground *on, int32_t rank, dvec3 c[3]);

/* The edge at which a triangle is bisected, and half of it. */
int map_longest_edge(const dvec3 c[3], double *length);
void map_halve(dvec3 c[3], int edge, int half);

double map_part_area(const map_ground *on, const map_part *p); /* m^2 */
double map_part_size(const map_ground *on,
                     const map_part *p); /* m, the longest way across, about */

/* The mean normal; false where those of its triangles are too far apart for one cell. */
bool map_part_normal(const map_ground *on, const map_part *p, dvec3 *mean);

/* ---- walls ----------------------------------------------------------------------------------- */

/* A cell as its outline and places on it: m, in the world, on the side that is lit. */
enum { MOST_RING = 8, MOST_FEET = 12 };
typedef struct map_outline {
    dvec3 ring[MOST_RING]; /* around it */
    dvec3 feet[MOST_FEET]; /* on it */
    int rings, foots;
    dvec3 normal; /* unit, of the lit side */
    double bulge; /* m: how far it reaches above the first ring's place along normal */
    double size;  /* m, the longest way across */
} map_outline;

/* All of it but the normal, which stands there. */
void map_part_outline(const map_ground *on, const map_part *p, double size, map_outline *o);

/* Whether something stands on the cell or lies on a part of it. */
bool map_is_walled(const scene *s, const map_outline *o);

/* ---- particles ------------------------------------------------------------------------------- */

enum { MAP_BATCH = 1024 }; /* particles at once */

/* Where the light of a particle came to: a bin is a leaf (its node), or a sensor's square behind
 * them. */
typedef struct map_deposit {
    int32_t bin, group;
    float dimming;
    vec3 flux; /* W, of one of all particles */
} map_deposit;

typedef struct map_list {
    void *items;
    size_t count, room, size;
    bool lost; /* memory was out */
} map_list;
void *map_list_add(map_list *l); /* NULL: memory is out */
void map_list_free(map_list *l);

typedef struct map_balance {
    double emitted[3], absorbed[3], escaped[3], unplaced[3];
    int64_t rays;
    double way2; /* m^2: sum over matt bounces of the distance squared, and how many */
    int64_t ways;
} map_balance;

typedef struct map_watch map_watch; /* sensors in the air */
typedef struct map_aim map_aim;     /* map_aim.h */

typedef struct map_tracer map_tracer;
typedef struct map_job {
    const scene *s;
    const emission *light;
    const map_cells *cells; /* NULL: pilots */
    const map_watch *watch; /* NULL */
    const map_aim *aim;     /* MAP_FOCUSED */
    uint32_t learns; /* not 0: deposits are to have the aim's cell for their group, and bin -1 where
                        they lie on surfaces */
    map_light kind;
    int32_t first_sensor_bin;
} map_job;

/* Scratch of a thread. */
map_tracer *map_tracer_new(arena *a, lux_error *err);
void map_tracer_free(map_tracer *t); /* NULL: nothing */

/* Follows `count` particles from number `first` on of the set that `seed` names; adds map_marks of
 * pilots, else map_deposits, in an order that depends on nothing else. */
void map_trace(map_tracer *t, const map_job *job, uint32_t first, int count, uint32_t seed,
               map_list *out, map_balance *balance);

/* Draws anew where the lanes of `active` go on from before a portal, in some cases toward it; the
 * lanes that go on. *rarer, (0, 1]: by how much less than others a particle carries by that alone.
 */
vmask map_toward_portals(const scene *s, const vsurface *at, const vshading *h, const vsample4 *u,
                         vmask active, vmask goes, vscatter *next, vfloat *rarer);

/* What of a particle's flux is in one that is aimed at a portal from there, at most, about. */
vfloat map_portal_share(const scene *s, const vsurface *at, const vshading *h, vmask active);

/* ---- sensors --------------------------------------------------------------------------------- */

/* Squares are so many times as wide as the sensors say, and at least so many times their `side`. */
typedef struct map_widths {
    float times, least;
} map_widths;
const map_watch *map_watch_new(arena *a, const map_sensors *m, map_widths w, lux_error *err);

/* Adds deposits of particles that go from `from` along `way` as far as `reach`. */
void map_watch_pass(const map_watch *w, const vray *ray, vmask active, const vrgb *flux, vint group,
                    vfloat dimming, int32_t first_bin, map_list *out);

/* ---- the map --------------------------------------------------------------------------------- */

/* By what a scene's light is told from that of others, for files. */
enum { PRINT_GEOMETRY, PRINT_MATERIALS, PRINT_LIGHTS, PRINT_RUN, PRINTS };

struct illumination_map {
    const scene *s;
    map_light kind;
    uint32_t seed;
    map_cells cells;
    int slots; /* all light, then each group if the scene is layered */
    int sensors;
    double calls_for; /* particles, for an accuracy of 1 */
    double deposits;  /* that one leaves, about */
    float *values;    /* W/m^2: of each bin, slot, set, 3 */
    float *smoothed;  /* W/m^2: of each node, slot, 3: by how much less its parent has; 0: none */
    float *dimming;   /* of each group; NAN: its lamps differ */
    map_figures figures;
    uint64_t print[PRINTS];
};

static inline size_t map_bins(const illumination_map *m)
{
    return (size_t)m->cells.node_count + 2 * (size_t)m->sensors;
}
static inline size_t map_value_at(const illumination_map *m, size_t bin, int slot, int set)
{
    return ((bin * (size_t)m->slots + (size_t)slot) * SCRAMBLES + (size_t)set) * 3;
}

/* Fills in m->smoothed, once there are values (map_look.c). */
bool map_find_smoothing(arena *a, illumination_map *m, lux_error *err);

bool map_prints(const scene *s, const map_options *o, uint64_t print[PRINTS], lux_error *err);

/* Of each group: what all of its light is dimmed to. */
bool map_dimmings(arena *a, const scene *s, float **out, lux_error *err);

#endif
