/* sim/direct.h -- light that reaches a point straight from lamps and glowing surfaces.
 *
 * Points are surfaces of core/world.h (sensors too): a position with its error, and the normal
 * of the side that is lit. Lanes outside `active` come back zero. In a layered scene everything is
 * undimmed: who adds up multiplies by scene_light.dimming.
 */
#ifndef SIM_DIRECT_H
#define SIM_DIRECT_H

#include "core/sampler.h"
#include "sim/scene.h"

/* Scratch of one thread for batches of at most DIRECT_PACKETS packets. */
enum { DIRECT_PACKETS = 256 };
typedef struct direct_scratch direct_scratch;
direct_scratch *direct_scratch_new(arena *a, lux_error *err);

/* Points that ask, and the random numbers that they do it by: u.x and u.y pick the place on a
 * light, u.z the light. */
typedef struct direct_batch {
    const vsurface *at;
    const vmask *active;
    const vsample4 *u;
    int packets;
    bool glow_alone;     /* glowing surfaces, no lamps */
    bool unshadowed;     /* who asks looks after what stands between: no shadow ray is traced */
    bool all_around;     /* light from below the horizon counts too */
    const vmask *around; /* or that of some lanes alone; NULL */
} direct_batch;

/* Light from one place, as drawn for each point. */
typedef struct direct_pick {
    vvec3 wi;
    vrgb e;      /* W/m^2, facing wi, divided by all probabilities; 0 in shadow; tinted by glass */
    vfloat dist; /* m, along wi, which must be clear; INFINITY: far away */
    vint light;  /* of scene.lights; -1: none */
    vfloat pdf; /* 1/sr, with which wi is drawn; INFINITY: paths do not find the light themselves */
} direct_pick;

/* Lamp l for all points. */
void direct_lamp(const scene *s, direct_scratch *w, int l, const direct_batch *b, direct_pick *out);

/* One light drawn for each point, by what the lights would give if nothing stood between (few
 * lamps) or by their places and directions (light_tree.h): an unbiased estimate of the sum of all
 * by one shadow ray. */
void direct_one(const scene *s, direct_scratch *w, const direct_batch *b, direct_pick *out);

/* The density with which direct_one() draws the direction wi to the emitter, or to lamp l, at
 * points with those normals, 1/sr. `around`: lanes to which light from below the horizon counts. */
vfloat direct_glow_pdf(const scene *s, const vsurface *at, const vvec3 *wi, vint emitter,
                       bool glow_alone, vmask around, vmask active);
vfloat direct_lamp_pdf(const scene *s, const vsurface *at, const vvec3 *wi, int l, vmask around,
                       vmask active);

/* About what lamp l gives a surface with normal n at p, as luminance, W/m^2, nothing in between;
 * above 0 wherever it may give light. */
vfloat direct_weight(const light *l, const vvec3 *p, const vvec3 *n, vmask active);

/* The normal of a surface that faces the light's middle: by it a light is weighed where light from
 * all around counts. */
vvec3 direct_facing(const light *l, const vsurface *at);

/* A ray from the point to just before the place that was drawn. */
vray direct_shadow_ray(const vsurface *at, const vvec3 *wi, vfloat dist);

/* Shadow rays that were traced with w so far. */
int64_t direct_rays(const direct_scratch *w);

#endif
