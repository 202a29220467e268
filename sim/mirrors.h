/* sim/mirrors.h -- plane mirrors and panes of a scene, and the images that light has in them.
 *
 * Light that reaches a place by way of plane mirrors alone comes from a lamp's mirror image: as
 * strong, and from where, it would come to the place's own image from the lamp itself. For a
 * chain of planes p1, p2, ... pk, in the order in which a ray from the place meets them,
 *
 *          p1    x' = Mk ... M2 M1 x, with M the reflection in a plane
 *       x   |
 *        \  |    what falls on x by way of the chain is what falls from the lamp on x', if the
 *    p2 --\-|--  bent way is clear, by what the mirrors give back: reflections change neither
 *          \|    lengths nor solid angles
 *      lamp *
 *
 * so that lights are asked at x' by the same samplers as at x. Chains are kept as long as their
 * mirrors give back a share that matters; which of them a place asks for is drawn by what lamps
 * would give it by way of each, if nothing stood between.
 */
#ifndef SIM_MIRRORS_H
#define SIM_MIRRORS_H

#include "core/arena.h"
#include "core/error.h"
#include "core/mesh.h"
#include "core/packet.h"
#include "core/transform.h"
#include "core/world.h"
#include "materials/material.h"

struct scene;

/* All triangles in one plane that reflect as mirrors do, to both sides. */
typedef struct mirror_plane {
    vec3 normal;       /* unit */
    float offset;      /* m: dot(normal, p) of its places, in the scene's frame */
    vec3 centre, u, v; /* m: of a rectangle around all; half of its sides, square to each other */
    double area;       /* m^2 */
    float share;       /* of diffuse light, that comes back as from a mirror, as luminance */
} mirror_plane;

/* A chain of planes. Number 0 is the empty one. */
typedef struct mirror_image {
    int32_t before; /* the chain without its last plane */
    int32_t after;  /* and without its first one, which is kept, too */
    int32_t first;  /* in mirrors.chains: its planes, p1 first */
    int32_t depth;  /* how many they are */
    float share;    /* what the mirrors give back, about */
    vec3 row[3];    /* x' = row x + move: rotation or reflection, */
    vec3 move;      /* m */
} mirror_image;

enum { MOST_MIRROR_PLANES = 64, MOST_MIRROR_IMAGES = 128 };

typedef struct mirrors {
    int plane_count, image_count; /* images: the empty chain included */
    const mirror_plane *planes;
    const mirror_image *images;
    const int32_t *chains;
    const int32_t *next;     /* [image * plane_count + plane]: the longer chain; -1: not kept */
    const int32_t *earlier;  /* the same, put before the chain */
    const int64_t *first_of; /* of an instance: where its triangles begin in plane_of; -1 */
    const int32_t *plane_of; /* of a triangle; -1: it is in none */
    float most;              /* the largest share of an image */
} mirrors;

/* A material's triangles that are mirrors, placed in the scene's frame: plane by plane. NULL in
 * *out, and true, where there are none. */
bool mirrors_find(arena *a, const mesh *meshes, const world_instance *instances, uint32_t count,
                  const material *const *materials, const mirrors **out, lux_error *err);

/* The chain that `image` (-1: none) becomes by a reflection at the hit; -1: it is not kept. */
vint mirrors_follow(const mirrors *m, vint image, const vhit *hit, vmask active);

/* The same where light itself is followed, from the lamp on: the hit's plane comes before the
 * others. */
vint mirrors_precede(const mirrors *m, vint image, const vhit *hit, vmask active);

/* The plane that a hit is in, -1: none. */
vint mirrors_plane(const mirrors *m, const vhit *hit, vmask active);

/* A place as an image has it; and a direction, which comes back by mirrors_back(). */
vvec3 mirrors_place(const mirrors *m, vint image, const vvec3 *p);
vvec3 mirrors_turn(const mirrors *m, vint image, const vvec3 *w);
vvec3 mirrors_back(const mirrors *m, vint image, const vvec3 *w);

/* Which lights are asked by way of mirrors. */
typedef enum mirror_lights { MIRROR_LAMPS, MIRROR_SUNS } mirror_lights;

/* Draws a chain for each lane's place, whose error is not looked at; the normal is 0 where light
 * from all around counts. *chance: with which that one is drawn. -1: none gives light. */
vint mirrors_choose(const struct scene *s, mirror_lights which, const vvec3 *p, const vvec3 *n,
                    vfloat pick, vmask active, vfloat *chance);

/* The chance of a given one. */
vfloat mirrors_chance(const struct scene *s, mirror_lights which, const vvec3 *p, const vvec3 *n,
                      vint image, vmask active);

#endif
