/* tests/bench/plain_sky.h -- skies as plain C has them: a direction at a time, with libm.
 *
 * What packets are measured against, and what they are checked with. The mathematics is that of
 * sky/, but the angle to the sun, which is the arc cosine that one writes first.
 */
#ifndef TESTS_BENCH_PLAIN_SKY_H
#define TESTS_BENCH_PLAIN_SKY_H

#include "core/vec3.h"

#include <stdbool.h>

typedef struct plain_sky {
    float a, b, f0, c, d, e; /* (1 + a exp(b / cos Z)) (f0 + c exp(d chi) + e cos^2 chi) */
    bool overcast;           /* 1 + 2 cos Z, times scale / 3 */
    vec3 scale, to_sun;
    const float *rgba; /* of a panorama, or NULL; the top row first */
    int width, height;
} plain_sky;

vec3 plain_sky_radiance(const plain_sky *s, vec3 wi);

/* The sum over so many directions. */
vec3 plain_sky_sum(const plain_sky *s, const vec3 *wi, int count);

#endif
