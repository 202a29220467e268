/* tests/hard/watertight.h -- rays that try to leave closed rooms; each returns how many did.
 *
 * For test_watertight.c (a sample) and long_watertight.c (ten million).
 */
#ifndef TESTS_HARD_WATERTIGHT_H
#define TESTS_HARD_WATERTIGHT_H

#include "core/world.h"
#include "tests/shapes.h"
#include "tests/test.h"

#include <stdlib.h>

typedef struct room {
    shape s;
    transform place; /* of the one instance */
    vec3 inside;     /* a point from which all corners are seen, in the mesh's coordinates */
    float spread;    /* origins are so far from it at most */
    triangle_test test;
} room;

static inline world *room_world(arena *a, const room *r)
{
    world_instance i = { .place = r->place };
    mesh m           = shape_mesh(&r->s);
    lux_error err    = { 0 };
    world *w         = world_new(a, &(world_desc){ &m, 1, &i, 1, r->test, 1 }, &err);
    if (!w)
        fail_msg("%s", err.text);
    return w;
}

static inline vec3 placed_point(const room *r, vec3 p)
{
    return d3_to_float(transform_point(&r->place, d3_from(p)));
}

/* A corner, a point of an edge, or one of a triangle of the room. */
static inline vec3 aim_at(const room *r, uint32_t *seed)
{
    uint32_t n        = (uint32_t)(random_unit(seed) * (float)r->s.triangle_count);
    const uint32_t *c = &r->s.corners[3 * (n < r->s.triangle_count ? n : 0)];
    vec3 a = r->s.positions[c[0]], b = r->s.positions[c[1]], p = r->s.positions[c[2]];
    float kind = random_unit(seed), u = random_unit(seed), v = random_unit(seed);
    if (kind < 0.4f)
        return a;
    if (kind < 0.6f)
        u = 0.5f;
    if (kind < 0.8f)
        v = 0.0f;
    return (vec3){ a.x + u * (b.x - a.x + v * (p.x - b.x)), a.y + u * (b.y - a.y + v * (p.y - b.y)),
                   a.z + u * (b.z - a.z + v * (p.z - b.z)) };
}

/* Rays from about the inside to corners, edges and faces. */
static inline int leaks_of_aimed_rays(const room *r, int rays, uint32_t seed)
{
    enum { BATCH = 256 / LANES };
    arena a        = { 0 };
    const world *w = room_world(&a, r);
    int leaks      = 0;
    vray ray[BATCH];
    vmask active[BATCH];
    vhit hit[BATCH];
    for (int n = 0; n < rays; n += BATCH * LANES) {
        for (int i = 0; i < BATCH * LANES; i++) {
            vec3 o = r->inside, to = aim_at(r, &seed);
            if (random_unit(&seed) < 0.75f) {
                vec3 off = random_offset(r->spread, &seed);
                o        = (vec3){ o.x + off.x, o.y + off.y, o.z + off.z };
            }
            o = placed_point(r, o), to = placed_point(r, to);
            vec3 d = { to.x - o.x, to.y - o.y, to.z - o.z };
            ray_set(&ray[i / LANES], i % LANES, o, v3_scale(d, 1.0f / v3_length(d)), INFINITY);
            active[i / LANES] = ALL_LANES;
        }
        world_first_hit(w, ray, active, BATCH, RAYS_INCOHERENT, hit);
        for (int i = 0; i < BATCH; i++)
            leaks += __builtin_popcount((unsigned)vbits(hit[i].instance < vsplat_int(0)));
    }
    arena_clear(&a);
    return leaks;
}

/* How paths that bounce about inside go wrong. */
typedef struct strays {
    int left, again; /* left the room; met the triangle that they had just left */
} strays;

static inline vvec3 bounce_direction(const vsurface *at, vvec3 from, uint32_t *seed)
{
    float x[LANES], y[LANES], z[LANES];
    for (int i = 0; i < LANES; i++) {
        vec3 d    = random_direction(seed);
        float s   = random_unit(seed);
        vec3 n    = { lane(at->normal.x, i), lane(at->normal.y, i), lane(at->normal.z, i) };
        float cos = v3_dot(n, d);
        if (s < 0.3f) { /* grazing */
            d = (vec3){ d.x - 0.999f * cos * n.x, d.y - 0.999f * cos * n.y,
                        d.z - 0.999f * cos * n.z };
            d = v3_scale(d, 1.0f / v3_length(d));
        }
        x[i] = d.x, y[i] = d.y, z[i] = d.z;
    }
    vvec3 d     = { vload(x), vload(y), vload(z) };
    vmask along = vabs(vdot(at->normal, d)) < 1e-6f; /* to which side, none can tell */
    d           = vselect3(along, at->normal, d);
    vfloat side = vdot(at->normal, from) * vdot(at->normal, d); /* back to where it came from */
    return vselect3(side > 0.0f, vneg(d), d);
}

static inline strays strays_of_paths(const room *r, int paths, int bounces, uint32_t seed)
{
    arena a        = { 0 };
    const world *w = room_world(&a, r);
    strays s       = { 0 };
    for (int n = 0; n < paths; n += LANES) {
        vray ray   = { 0 };
        vmask left = ALL_LANES;
        vint last  = vsplat_int(-1);
        for (int i = 0; i < LANES; i++)
            ray_set(&ray, i, placed_point(r, r->inside), random_direction(&seed), INFINITY);
        for (int k = 0; k < bounces && vany(left); k++) {
            vhit hit;
            vsurface at;
            world_first_hit(w, &ray, &left, 1, RAYS_COHERENT, &hit);
            vmask met = left & (hit.instance >= vsplat_int(0));
            s.left += __builtin_popcount((unsigned)vbits(left & ~met));
            s.again += __builtin_popcount((unsigned)vbits(met & (hit.triangle == last)));
            left = met;
            last = hit.triangle;
            world_surface(w, &hit, met, &at);
            ray.direction = bounce_direction(&at, ray.direction, &seed);
            ray.origin    = vray_start(&at, &ray.direction);
        }
    }
    arena_clear(&a);
    return s;
}

/* The rooms. Mirrored, sheared, stretched, and a kilometre away. */
static const transform room_places[] = {
    { { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 } } },
    { { { -0.8, 0.3, 0.1, 1.7 }, { 0, 2.5, 0.4, -3.1 }, { 0.2, 0, 0.6, 0.9 } } },
    { { { 1, 0, 0, 1000 }, { 0, 1, 0, -700 }, { 0, 0, 1, 300 } } },
};
enum { ROOMS = 9 };

static inline room room_make(int number, int cells)
{
    room r = { .place = room_places[number / 3], .spread = 0.4f };
    if (number % 3 == 0) {
        r.inside = (vec3){ 0.37f, -0.21f, 0.11f };
        shape_sphere(&r.s, r.inside, 1.0f, 3 * cells);
    } else if (number % 3 == 1) { /* rays from its middle go exactly through corners */
        r.inside = (vec3){ 1.0f, 0.5f, 0.25f };
        shape_box(&r.s, (vec3){ 0, -0.5f, -0.75f }, (vec3){ 2, 1.5f, 1.25f }, 2 * cells);
    } else { /* slivers: a thousand times as high as wide */
        r.inside = (vec3){ 0.37f, -0.21f, 0.11f };
        shape_sphere(&r.s, r.inside, 1.0f, cells);
        for (uint32_t i = 0; i < r.s.position_count; i++)
            r.s.positions[i].z = 0.11f + 1000.0f * (r.s.positions[i].z - 0.11f);
    }
    return r;
}

#endif
