/* tests/lab_sphere.h -- spheres of flat pieces, for tests of physics. */
#ifndef TESTS_LAB_SPHERE_H
#define TESTS_LAB_SPHERE_H

#include "tests/lab.h"

/* Writes a file of a sphere whose corners lie on the radius: pieces face outward, 180 / rings
 * degrees high and wide, of a material with these members. Gives its surface, m^2. */
double lab_sphere(lab *l, const char *name, dvec3 centre, double radius, int rings,
                  const char *made_of);

#endif
