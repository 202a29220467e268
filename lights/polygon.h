/* lights/polygon.h -- flat convex Lambertian surfaces: what the rectangle and the triangle share.
 *
 * The polygon lies in the plane of its frame (u, v), around its centroid; a point is seen from its
 * foot in that plane and its height above it. Radiance is constant, so all is said for L = 1.
 */
#ifndef LIGHTS_POLYGON_H
#define LIGHTS_POLYGON_H

#include "core/packet_math.h"
#include "core/transform.h"
#include "lights/light.h"

enum { POLYGON_CORNERS = 4 };

/* Immutable once made. */
typedef struct polygon {
    vec3 centre;              /* m, the centroid */
    vec3 u, v, n;             /* unit, right-handed; n is the normal */
    int corners;              /* 3 or 4, counter-clockwise about n */
    float x[POLYGON_CORNERS]; /* m, along u from the centroid */
    float y[POLYGON_CORNERS]; /* m, along v */
    float area;               /* m^2 */
    float reach;              /* m, from the centroid to the farthest corner */
    float deviation;          /* m, standard deviation from the centroid, in the widest direction */
    float moment;             /* m^2, mean square distance from the centroid */
} polygon;

/* From corners in a plane square to the unit vector n, counter-clockwise about it, in double. The
 * frame's v is as given: unit, square to n. */
void polygon_make(polygon *g, const dvec3 *corner, int corners, dvec3 v, dvec3 n);

/* The box and the axis; a hemisphere about each direction. */
light_bounds polygon_bounds(const polygon *g);

/* A direction or a difference of places in the frame of g. */
static inline vvec3 vpolygon_turn(const polygon *g, vvec3 a)
{
    return (vvec3){ vdot(a, vspread(g->u)), vdot(a, vspread(g->v)), vdot(a, vspread(g->n)) };
}
static inline vvec3 vpolygon_turn_back(const polygon *g, vvec3 a)
{
    return vadd(vadd(vscale(vspread(g->u), a.x), vscale(vspread(g->v), a.y)),
                vscale(vspread(g->n), a.z));
}
/* The place p in the frame of g, its origin the centroid: z is the height. */
static inline vvec3 vpolygon_place(const polygon *g, const vvec3 *p)
{
    return vpolygon_turn(g, vsub(*p, vspread(g->centre)));
}

/* E / L, in [0, pi] sr: the irradiance at `place` (of the frame, height >= 0) of a surface with the
 * unit normal n (of the frame), the part below its horizon left out. 0 at height 0. */
vfloat vpolygon_irradiance(const polygon *g, vvec3 place, vvec3 n);

/* The cosine, to a surface at `place` with normal n, of whatever of the corners and the centroid
 * is nearest to its normal: > 0 where any part of g is above the horizon (or by a rounding below),
 * at most 1. */
vfloat vpolygon_highest(const polygon *g, vvec3 place, vvec3 n);

/* As light_type.as_point, for a place in the frame of g and its radiance: above it where
 * `sides` is 1, above and below where it is 2. */
vmask vpolygon_as_point(const polygon *g, vvec3 place, vec3 radiance, int sides, vmask active,
                        vlight_sample *out, vfloat *error);

#endif
