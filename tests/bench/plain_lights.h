/* tests/bench/plain_lights.h -- the lights of lights/ as plain C has them: a point at a time, libm.
 *
 * What packets are measured against, and what their samples are checked with. The mathematics is
 * that of lights/: what differs is only how it is worked out.
 */
#ifndef TESTS_BENCH_PLAIN_LIGHTS_H
#define TESTS_BENCH_PLAIN_LIGHTS_H

#include "core/vec3.h"

typedef enum plain_kind {
    PLAIN_POINT,
    PLAIN_CONE,
    PLAIN_PARALLEL,
    PLAIN_COSINE,
    PLAIN_LINEAR,
    PLAIN_DISK,
    PLAIN_RECT,
    PLAIN_LUMINAIRE,
    PLAIN_KINDS
} plain_kind;

typedef struct plain_sample {
    vec3 wi;    /* unit, toward the light */
    float dist; /* m */
    vec3 e;     /* W/m^2, on a surface facing wi */
    float pdf;  /* 1/sr */
} plain_sample;

typedef struct plain_light {
    plain_kind kind;
    vec3 position, axis, u, v; /* m; unit */
    vec3 strength;             /* W/sr, W/m^2, W/(sr m) or W/(sr m^2) */
    float length, width;       /* m: of a line, the radius of a disk, the sides along v and u */
    float cos_inner, cos_outer, exponent;
    const float *plane, *gamma, *candela; /* rad, nearly even; cd */
    int planes, gammas;
    float plane_density, gamma_density; /* 1/rad */
} plain_light;

/* One sample at p; false and zeros where it is dark. */
bool plain_sample_light(const plain_light *l, vec3 p, float s, float t, plain_sample *out);

/* The sum over points with the unit normals n of what one sample each gives to them, W/m^2. */
typedef vec3 plain_sum(const plain_light *l, const vec3 *p, const vec3 *n, const float *s,
                       const float *t, int count);
plain_sum plain_sum_lights;
plain_sum plain_sum_lights_387; /* the same source with the x87's arithmetic */

#endif
