/* tests/brdf_twin.h -- tables of reflection filled from closed forms, and looked up in double. */
#ifndef TESTS_BRDF_TWIN_H
#define TESTS_BRDF_TWIN_H

#include "materials/brdf.h"

/* A direction, and what a surface does between two of them, 1/sr; z is up. */
typedef struct dvec {
    double x, y, z;
} dvec;
typedef double closed_form(dvec in, dvec out);

dvec direction_of(double theta, double phi); /* rad */

/* Ward's anisotropic lobe ("Measuring and Modeling Anisotropic Reflection", SIGGRAPH 1992), 0.3
 * along x and 0.5 along y, and Phong's of exponent 12, each over a diffuse base. Ward's has no
 * limit at the horizon: tables of it end at 85 degrees. */
double ward(dvec in, dvec out);
double phong(dvec in, dvec out);

/* The numbers of a table of `f` at places `at`, counts[k] of them along each axis; malloc'ed. */
float *fill_closed_form(brdf_kind kind, const int counts[4], const double *const deg[4],
                        closed_form *f);

/* A table with steps of `step` degrees in every angle; the colours are f times 1, 1/2, 1/4. */
const brdf *table_of_form(arena *a, brdf_kind kind, double step, closed_form *f, notices *n);

/* What linear interpolation between the places of *d makes of red, in double. */
double twin_value(const brdf_data *d, dvec in, dvec out);

#endif
