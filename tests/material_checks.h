/* tests/material_checks.h -- what every material has to hold to, asked through its interface alone.
 *
 * The surface is the plane z = 0, its front up; directions are given by their angle from the normal
 * of their own side and their azimuth from x. Textures count as white. Each check fails the running
 * test with a sentence that names the material, the direction and both figures.
 */
#ifndef TESTS_MATERIAL_CHECKS_H
#define TESTS_MATERIAL_CHECKS_H

#include "materials/material.h"

/* A point of that surface seen from (theta, phi), degrees, 1 m away: the same in all lanes. */
vshading material_seen_from(const material *m, double theta_deg, double phi_deg, bool front);

/* What becomes of a beam from (theta, phi): red, green, blue, [0, 1]. */
typedef struct energy {
    double reflected[3], transmitted[3];
} energy;

/* By quadrature of reflect() over both half spaces, in double: polar about the mirror direction and
 * about the straight one, ever finer toward them (lobes of 1e-3 rad to 1e-4 of their energy); and
 * with what scatter() says of single directions. */
energy material_albedo_integral(const material *m, double theta_deg, double phi_deg, bool front);

/* At incidence 0, 30, 60, 80, 89 and 89.99 degrees on both sides: albedo() is at most 1 and the
 * integral's to 1e-3, all that leaves is at most 1; the mean weight of scatter() is the integral's
 * on each side, and that of what goes straight is through(), save of solids. */
void material_check_furnace(const material *m);

/* Directions of scatter() fall as reflect() says that they do (chi-square, on both sides of the
 * surface); their pdf and weight are reflect()'s to 1e-4. */
void material_check_sampling(const material *m);

/* f(wo, wi) = f(wi, wo) to that share of the larger, in random directions, in grazing ones, and
 * about the mirror direction and the straight one. */
void material_check_reciprocity(const material *m, double tolerance);

/* 10^5 lanes of grazing, normal and random directions and normals, with lanes masked at random:
 * those come back zero although there is NaN in them, the others finite and in range. */
void material_check_packets(const material *m);

#endif
