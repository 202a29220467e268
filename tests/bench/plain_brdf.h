/* tests/bench/plain_brdf.h -- a table of four angles as plain C has it: a pair at a time, libm. */
#ifndef TESTS_BENCH_PLAIN_BRDF_H
#define TESTS_BENCH_PLAIN_BRDF_H

#include "core/vec3.h"

typedef struct plain_axis {
    const float *at; /* rad, ascending */
    int count;
    bool periodic;
} plain_axis;

typedef struct plain_table {
    plain_axis axes[4];  /* theta_out, phi_out, theta_in, phi_in */
    const float *values; /* 4 a place */
} plain_table;

vec3 plain_value(const plain_table *t, vec3 wo, vec3 wi);
vec3 plain_value_387(const plain_table *t, vec3 wo, vec3 wi);

/* The sum over pairs. */
typedef vec3 plain_sum(const plain_table *t, const vec3 *wo, const vec3 *wi, int count);
plain_sum plain_sum_brdf;
plain_sum plain_sum_brdf_387; /* the same source with the x87's arithmetic */

#endif
