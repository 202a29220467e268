/* sim/scene_world_parts.h -- between scene_world.c and scene_bake.c: what a world is made of. */
#ifndef SIM_SCENE_WORLD_PARTS_H
#define SIM_SCENE_WORLD_PARTS_H

#include "sim/room.h"
#include "sim/scene_build.h"

/* What lets light straight through is met by other rays, and stands in meshes of its own. */
enum { OPAQUE, HOLLOW, HALVES };

typedef struct baked {
    vec3 *positions, *normals; /* normals, texcoord: as in a mesh, NULL where none has them */
    uint32_t *corners, *material;
    float *texcoord[2];
    uint32_t position_count, triangle_count;
} baked;

typedef struct world_parts {
    const bool *hollow;   /* of each material of the scene */
    bool texcoord[2];     /* some used material goes by texture coordinates of that set */
    room_mesh room;       /* of the study; no triangles: it has none */
    baked common[HALVES]; /* what stands in one place */
    mesh *meshes;         /* the common ones first */
    uint32_t mesh_count;
    list instances;
} world_parts;

/* The triangles of a mesh that go into one half. */
typedef struct half {
    const mesh *of;
    const uint32_t *made_of; /* the scene's number of each material of its file */
    uint32_t count;          /* of triangles */
    int which;
} half;

static inline uint32_t half_material(const half *h, uint32_t t)
{
    return h->made_of[h->of->material ? h->of->material[t] : 0];
}

static inline bool half_has(const world_parts *w, const half *h, uint32_t t)
{
    return w->hollow[half_material(h, t)] == (h->which == HOLLOW);
}

half half_of(const world_parts *w, const mesh *m, const uint32_t *made_of, int which);

/* Whether a mesh of scene i's file goes into the common meshes, in all its places. */
bool mesh_is_baked(const scene_build *b, int i, uint32_t mesh_index);

/* What corner `from` of a mesh says, as the next triangle's corner c has it; normals by the inverse
 * of the mesh's place. */
void bake_corner(baked *to, int c, const mesh *m, size_t from, const transform *inverse);

/* Into the common meshes, which have room: scene i's file; the room of the study. */
void bake_file(scene_build *b, world_parts *w, int i);
void bake_room(scene_build *b, world_parts *w);

#endif
