/* tests/flat_twin.h -- the light of flat polygons in double precision, one point at a time. */
#ifndef TESTS_FLAT_TWIN_H
#define TESTS_FLAT_TWIN_H

#include "core/transform.h"
#include "lights/light.h"

/* A convex polygon of radiance 1, counter-clockwise about the side that shines. */
typedef struct flat_twin {
    dvec3 corner[4];
    int corners;
    bool two_sided;
} flat_twin;

dvec3 twin_centre(const flat_twin *f);
double twin_size(const flat_twin *f); /* m, the widest */

/* Irradiance at p with unit normal n: the polygon clipped at the horizon, then Lambert's sum. */
double twin_irradiance(const flat_twin *f, dvec3 p, dvec3 n);

/* The same by the midpoint rule, on side x side cells of the two triangles or the one. */
double twin_quadrature(const flat_twin *f, dvec3 p, dvec3 n, int side);

/* The irradiance of a surface at p that faces the centre. */
double twin_facing(const flat_twin *f, dvec3 p);

/* Even numbers in [0,1), by a hash of the count. */
double twin_random(uint32_t *state);
dvec3 twin_direction(uint32_t *state);

/* A place from which the light is seen, at `near_` to `far` sizes from its centre, and a direction
 * of any kind, not wholly below the horizon of which the light is. */
void twin_place(const flat_twin *f, double near_, double far, uint32_t *state, dvec3 *p, dvec3 *n);

/* What a light of radiance 1 in all channels gives, in the packet's first lane or, if they differ
 * between lanes, a failed test. */
double light_closed_form(const light *l, dvec3 p, dvec3 n);

/* The mean over `count` samples of vsobol4, stratified. */
double light_sampled(const light *l, dvec3 p, dvec3 n, int count, uint32_t seed);

/* The probability that samples seen from p follow the pdf of hit(), by chi-square over cells of an
 * even map of all directions; pdfs of samples and hits, and the places of both, are compared. */
double light_follows_its_pdf(const light *l, const flat_twin *f, dvec3 p);

/* Makes a random light of radiance 1 and its twin. */
typedef const light *(*twin_maker)(arena *a, uint32_t *state, flat_twin *f);

/* Each at 1000 random places at `near_` to `far` sizes from random lights. The closed form is
 * within 1e-5 of the value that faces the light, and what the rounding of a height makes of it. */
void check_closed_form(twin_maker make, double near_, double far);

/* 64 samples are within 5e-3 of the value that faces the light. */
void check_sampled(twin_maker make, double near_, double far);

/* Against the quadrature, for random tilts and such whose horizon cuts the light through the
 * middle: the bound holds, and on average over places the worst tilt takes a quarter of it. */
void check_as_point(twin_maker make);

/* weight() is > 0 and finite at places from which anything is seen, and within a factor of 100. */
void check_weight(twin_maker make);

/* From 1 m to 1 um above a place of it and in its plane: nothing above pi L, nothing that is no
 * number; the closed form is its twin's within 1e-5 of pi L and what 1e-7 m of the place make of
 * it, and 1024 samples are within `tolerance` of pi L. */
void check_near(const light *l, const flat_twin *f, dvec3 at, dvec3 up, double tolerance);

/* Of no lane but the first anything is told, and of that nothing at `behind`, if that is dark. */
void check_lanes(const light *l, dvec3 lit, const dvec3 *behind);

#endif
