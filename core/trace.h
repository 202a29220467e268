/* core/trace.h -- inside a world: its parts, and what both ways of walking them share.
 *
 * Packets are walked as they come (trace_packet.c), or a batch is first put into packets of rays
 * that go the same way (trace_sorted.c). What a ray does never depends on those beside it: it
 * visits the same leaves in the same order and so finds the same hit, to the bit.
 *
 * Planes have a width. The watertight test is exact, for triangles whose corners are rounded
 * after they were moved to the ray: a ray may so meet a triangle by a hair's breadth outside of
 * its cell. Rays go on both sides of a plane while they are within TRACE_WIDTH times the
 * largest coordinate about (of box or origin) from it. Of 2^-24 times that, rounding of the
 * distance to a plane makes up to 8 and of a corner up to 10 (three roundings each of |a - o|
 * and of its shear, each of twice the coordinate).
 */
#ifndef CORE_TRACE_H
#define CORE_TRACE_H

#include "core/bsp.h"
#include "core/world.h"

#define TRACE_WIDTH 0x1p-19f

/* Wald's record of a triangle: its plane solved for the coordinate k, and what gives the
 * weights of corners 1 and 2 from the other two coordinates. */
typedef struct projection {
    float n_u, n_v, n_d;
    int32_t k;
    float b_u, b_v, b_d, c_u, c_v, c_d;
} projection;

typedef struct solid {
    bsp tree;
    const float *corners;          /* 9 a triangle */
    const projection *projections; /* for TRIANGLE_PROJECTION, else NULL */
    const uint32_t *material;      /* NULL: all 0 */
    const float *texcoord[2];      /* 6 a triangle, or NULL */
    const float *normals;          /* 9 a triangle, or NULL */
    uint32_t triangle_count;
} solid;

/* What queries tell instances apart by */
enum { TRAIT_OWNED = 1, TRAIT_HOLLOW = 2, TRAIT_SOLID = 4 /* not hollow */ };

typedef struct placed {
    float to_mesh[3][4], to_world[3][4];
    uint32_t mesh;
    int32_t owner; /* 0: nobody's */
    uint32_t traits;
    bool identity; /* rays need not be transformed */
    bool mirrors;  /* the determinant is negative */
} placed;

struct world {
    bsp tree; /* of instances */
    const placed *instances;
    uint32_t instance_count;
    const solid *meshes;
    triangle_test test;
    bool hollow; /* some instance is */
    world_stats stats;
};

typedef enum query_kind { FIRST_HIT, ANY_HIT, ALL_HITS } query_kind;

typedef enum list_kind {
    LIST_TO_SOLID, /* up to the first that is not hollow */
    LIST_HOLLOW,   /* as if what is not hollow were not there */
    LIST_EVERY,    /* as if all were hollow */
} list_kind;

/* The hits of one packet for world_all_hits and its like: hits[k] is hit k. */
typedef struct hit_list {
    vhit *hits;
    int most;
    list_kind kind;
    int count[LANES];
    bool stopped[LANES]; /* the last is not hollow */
    bool dropped[LANES]; /* there was one more than `most` */
} hit_list;

typedef struct one_hit {
    float t, u, v;
    int32_t instance, triangle;
    bool hollow;
} one_hit;

/* Where it belongs, unless it is there or lies behind one that is not hollow. */
void hit_list_add(hit_list *l, int lane_number, const one_hit *h);
void hit_list_clear(vhit *hit, int lane_number); /* a miss */

/* Instances that a packet went through already. A few: of those about, it is the large ones
 * that come again in many leaves. */
enum { MAILBOXES = 8 };

/* One packet (trace_packet.c). */
void trace_packet_first(const world *w, const vray *ray, vmask active, vhit *hit);
vmask trace_packet_any(const world *w, const vray *ray, vmask active, vint spare);
void trace_packet_all(const world *w, const vray *ray, vmask active, vint spare, hit_list *list);

/* A batch, in packets of rays that go the same way (trace_sorted.c). */
void trace_sorted_first(const world *w, const vray *rays, const vmask *active, int packets,
                        vhit *hits);
void trace_sorted_any(const world *w, const vray *rays, const vmask *active, const vint *spare,
                      int packets, vmask *blocked);

/* Signs of a direction (bits 0 to 2), and which of x, y, z is its largest (bits 3 and 4). */
static inline vint direction_code(vvec3 d)
{
    vfloat x = vabs(d.x), y = vabs(d.y), z = vabs(d.z);
    vmask of_x = (x >= y) & (x >= z);
    vmask of_z = ~of_x & ~(y >= z);
    vint code  = vselect_int(of_x, vsplat_int(0), vselect_int(of_z, vsplat_int(16), vsplat_int(8)));
    code |= vkeep_int(vas_int(d.x) < 0, vsplat_int(1));
    code |= vkeep_int(vas_int(d.y) < 0, vsplat_int(2));
    code |= vkeep_int(vas_int(d.z) < 0, vsplat_int(4));
    return code;
}
enum { DIRECTION_CODES = 24 };

void projection_make(const float *corners, projection *p);

#endif
