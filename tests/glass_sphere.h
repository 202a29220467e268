/* tests/glass_sphere.h -- what becomes of parallel light that falls on a sphere of glass, in
 * double.
 */
#ifndef TESTS_GLASS_SPHERE_H
#define TESTS_GLASS_SPHERE_H

enum { SPHERE_ORDERS = 64 };

/* Shares of the flux of an even, unpolarised beam as wide as the sphere. */
typedef struct glass_sphere {
    double reflected;             /* by its outside */
    double leaves[SPHERE_ORDERS]; /* after so many reflections within; [0]: passed */
    double absorbed;
} glass_sphere;

/* Of index n > 1, in air; of light along its diameter `inner` is left, in (0, 1]. */
glass_sphere glass_sphere_of(double n, double inner);

/* Of `order` reflections within: the share of the beam that leaves within so many radians of where
 * the beam went (order 0: forward), absorption of `inner` counted. */
double glass_sphere_within(double n, double inner, int order, double angle);

/* The share of the beam that `order` reflections within bring to a disk of so many radii, square to
 * the axis, so many radii behind the sphere's centre, >= 1; what misses the sphere does not count.
 */
double glass_sphere_on_disk(double n, double inner, int order, double distance, double radius);

#endif
