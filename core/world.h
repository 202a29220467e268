/* core/world.h -- what rays meet: placed meshes in a two-level BSP tree.
 *
 * Each mesh has a tree of its own, made once; the upper tree holds its instances, each placed
 * by a matrix. Rays come as a batch of packets, with a hint of how alike they are: how the
 * batch is walked is the world's affair, and changes no result. Incoherent rays want batches of
 * 64 and better 256 rays, which are put in order by direction; coherent ones may come alone.
 *
 * A ray leaves `origin` along `direction` (unit length) and sees what lies at a distance t with
 * 0 < t < reach. Of several surfaces at the same distance the one with the lower instance, then
 * the lower triangle, is met. A ray that goes through an edge or vertex shared within one mesh
 * meets one of the triangles there: a closed mesh has no leak. Lanes outside `active` are not
 * looked at and come back as misses.
 *
 * Immutable once built: any number of threads may ask.
 */
#ifndef CORE_WORLD_H
#define CORE_WORLD_H

#include "core/arena.h"
#include "core/error.h"
#include "core/mesh.h"
#include "core/packet.h"
#include "core/transform.h"

typedef struct world world;

typedef struct world_instance {
    uint32_t mesh;   /* < mesh_count */
    transform place; /* mesh to world; any mirroring or scale, determinant not 0 */
    bool hollow;     /* its triangles let light through: any_hit does not see them, and all_hits
                        goes on behind them */
    int32_t owner; /* >= 1: part of the body of that number, which any_hit may spare; 0: of none */
} world_instance;

typedef enum triangle_test {
    TRIANGLE_WATERTIGHT, /* Woop, Benthin, Wald, JCGT 2(1) 2013: no ray slips through an edge */
    TRIANGLE_PROJECTION, /* Wald's, 2004: faster, and leaks; to measure both */
} triangle_test;

typedef struct world_desc {
    const mesh *meshes;
    uint32_t mesh_count;
    const world_instance *instances;
    uint32_t instance_count;
    triangle_test test;
    int threads; /* to build with, >= 1 */
} world_desc;

/* Copies what it needs of the meshes, so that their arrays may go. NULL, with *err, if memory
 * is out (of which building takes several times what is kept, for a while). Degenerate triangles
 * are never hit. A world of no triangles is a world. The same world for any number of threads. */
world *world_new(arena *a, const world_desc *d, lux_error *err);

typedef struct world_stats {
    uint64_t triangles, placed_triangles; /* in meshes; in instances */
    uint64_t bytes;                       /* all that the world keeps */
    double build_seconds;
} world_stats;
world_stats world_statistics(const world *w);

/* What there is, for those who look at all of it: instances, the triangles of each, who owns it
 * (world_instance.owner), and which mesh it places. */
int32_t world_instances(const world *w);
int32_t world_triangles(const world *w, int32_t instance);
int32_t world_owner(const world *w, int32_t instance);
uint32_t world_mesh(const world *w, int32_t instance);

/* The corners of a triangle, m, in its mesh, which world_place() takes to the world; returns
 * its material. */
uint32_t world_triangle(const world *w, int32_t instance, int32_t triangle, dvec3 corner[3]);
transform world_place(const world *w, int32_t instance);

/* The box around everything, m. Empty (low > high) where there is nothing. */
void world_bounds(const world *w, vec3 *low, vec3 *high);

typedef struct vray {
    vvec3 origin;    /* m */
    vvec3 direction; /* unit length */
    vfloat reach;    /* m, > 0, may be INFINITY */
} vray;

typedef struct vhit {
    vfloat distance; /* m; INFINITY for a miss */
    vint instance;   /* -1 for a miss */
    vint triangle;   /* of the instance's mesh */
    vfloat u, v;     /* barycentric weights of corners 1 and 2 */
} vhit;

typedef enum ray_hint {
    RAYS_COHERENT,   /* packets of near directions or near ends: camera, shadow */
    RAYS_INCOHERENT, /* bounces */
} ray_hint;

/* The nearest surface that each ray meets. */
void world_first_hit(const world *w, const vray *rays, const vmask *active, int packets,
                     ray_hint hint, vhit *hits);

/* Whether each ray meets any surface that is not hollow: in blocked, only lanes of active.
 * Instances whose owner is that in the ray's lane of spare do not count, so that a lamp's light
 * leaves its own body; 0 spares nothing, and nor does spare NULL. */
void world_any_hit(const world *w, const vray *rays, const vmask *active, const vint *spare,
                   int packets, ray_hint hint, vmask *blocked);

/* Up to `most` hits of each ray in order of distance, hollow ones up to and including the first
 * that is not hollow: hits[packet * most + k] is hit k, a miss behind the last. Returns false
 * if some ray meets more than `most` before it is stopped: it then has the nearest ones. */
bool world_all_hits(const world *w, const vray *rays, const vmask *active, int packets, int most,
                    vhit *hits);

/* Hollow instances alone, as if the others were not there, nor those that `spare` names, as for
 * any_hit. */
bool world_hollow_hits(const world *w, const vray *rays, const vmask *active, const vint *spare,
                       int packets, int most, vhit *hits);

/* The same as if all instances were hollow: whatever lies on the ray's line within its reach. */
bool world_every_hit(const world *w, const vray *rays, const vmask *active, int packets, int most,
                     vhit *hits);

/* Where and what a hit is. */
typedef struct vsurface {
    vvec3 position; /* m, on the triangle by its corners, and off its edges by the error */
    vfloat error;   /* m, how far position may be off the plane in each coordinate */
    vvec3 normal;   /* unit, of the triangle's plane, on the front side: where the matrix takes
                       the mesh's front, mirrored or not */
    vint material;  /* as the mesh has it */
} vsurface;

/* Lanes outside active, or without a hit, are zero. */
void world_surface(const world *w, const vhit *hit, vmask active, vsurface *out);

/* What else the mesh says of a hit's place. */
typedef struct vdetail {
    vfloat u[2], v[2]; /* texture coordinates of each set; 0 where the mesh has none */
    vfloat scale[2];   /* how many units of set k a metre along the surface is: the root of the
                          triangle's area in texture coordinates over its area in m^2; 0: none */
    vvec3 normal;      /* unit, on the front side: between those of the corners; the triangle's own
                          where the mesh has none */
    vvec3 along_u[2];  /* unit, in the triangle's plane, where set k's u grows; 0 where that is
                          nowhere */
    vmask mirrored[2]; /* set k lies on the front side as in a mirror: v grows along
                          normal x along_u; else against it (a picture upright has v downward) */
} vdetail;

/* Lanes outside active, or without a hit, are zero. */
void world_detail(const world *w, const vhit *hit, vmask active, vdetail *out);

/* Where a ray toward `direction` may start without meeting the surface that it leaves: moved off
 * along the normal, to the side of direction, by what the error of the position needs. A ray to
 * a point must be aimed from here: take its direction, this start, then direction and reach
 * anew. (Where direction runs along the surface to 1e-6 or so, its side is anyone's guess.) */
vvec3 vray_start(const vsurface *from, const vvec3 *direction);

#endif
