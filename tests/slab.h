/* tests/slab.h -- what stands between a glowing quad and who sees it, in double: glass as a slab,
 * and integrals over the quad.
 */
#ifndef TESTS_SLAB_H
#define TESTS_SLAB_H

#include "tests/lab.h"

typedef struct slab {
    double passed, reflected; /* of unpolarised light, all passages within added up */
} slab;

/* Of index n, of which one way through at normal incidence leaves `inner`; c: cosine outside. */
slab slab_of(double n, double inner, double c);

/* What `inner` makes the slab pass so much at normal incidence, by bisection. */
double slab_inner(double n, double transmittance);

/* f(context, wi) times the solid angle of the quad, a parallelogram, as seen from p; wi: unit. By
 * Gauss's rule of two points a side on side x side cells: an error of about (cell / distance)^4 /
 * 4000. */
typedef double quad_integrand(const void *context, dvec3 wi);
double quad_integral(const quad *q, dvec3 p, int side, quad_integrand *f, const void *context);

/* Level, size x size m about (x, y, z). */
quad quad_level(double x, double y, double z, double size);

#endif
