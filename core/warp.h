/* core/warp.h -- even numbers in the square, mapped onto directions and triangles.
 *
 * (s, t) is in [0,1)^2. Stratified (s, t) stay stratified: each map is one-to-one, and
 * continuous but for seams. Where (s, t) is even, results have the density that the twin
 * named _pdf states. Results are finite for every (s, t) of the range.
 */
#ifndef CORE_WARP_H
#define CORE_WARP_H

#include "core/packet_math.h"

#define WARP_PI 3.14159265f

/* A direction about +z, denser by its cosine with +z, which is its z: in [0, 1]; 0 is rare and
 * its pdf 0. Unit length to 2^-22 (Malley's method: straight up from an even disk). */
static inline vvec3 vwarp_cosine(vfloat s, vfloat t)
{
    vvec3 w;
    vsquare_to_disk(s, t, &w.x, &w.y);
    w.z = vsqrt(vmax(1.0f - w.x * w.x - w.y * w.y, vsplat(0.0f)));
    return w;
}
/* The same about the unit vector n. */
static inline vvec3 vwarp_cosine_about(vvec3 n, vfloat s, vfloat t)
{
    vvec3 u, v, w = vwarp_cosine(s, t);
    vframe(n, &u, &v);
    return vadd(vscale(n, w.z), vadd(vscale(u, w.x), vscale(v, w.y)));
}
/* 1/sr; 0 where cos_z is not above 0. */
static inline vfloat vwarp_cosine_pdf(vfloat cos_z)
{
    return vmax(cos_z, vsplat(0.0f)) * (1.0f / WARP_PI);
}

/* A direction, even over the whole sphere (Archimedes: even in z), unit length to 2^-22. */
static inline vvec3 vwarp_sphere(vfloat s, vfloat t)
{
    vfloat phi = (2.0f * WARP_PI) * t;
    vfloat r   = 2.0f * vsqrt(s * (1.0f - s)); /* sqrt(1 - z^2), exact near the poles too */
    return (vvec3){ r * vcos(phi), r * vsin(phi), 1.0f - 2.0f * s };
}
#define WARP_SPHERE_PDF (0.25f / WARP_PI) /* 1/sr */

/* The direction at the angle a to the unit vector n, 1 - cos a = less in [0, 2], turned about it by
 * t of a whole turn. Even in `less` is even in solid angle; small angles keep their digits. */
static inline vvec3 vwarp_about(vvec3 n, vfloat less, vfloat t)
{
    vvec3 u, v;
    vfloat phi = (2.0f * WARP_PI) * t;
    vfloat r   = vsqrt(vmax(less * (2.0f - less), vsplat(0.0f)));
    vframe(n, &u, &v);
    return vadd(vscale(n, 1.0f - less), vadd(vscale(u, r * vcos(phi)), vscale(v, r * vsin(phi))));
}

/* A place even in area on a triangle: the weights u, v >= 0 of its corners 1 and 2, that of
 * corner 0 being 1 - u - v, >= 0 to rounding. The pdf is one over the triangle's area, 1/m^2 (Turk,
 * "Generating random points in triangles", Graphics Gems 1990). */
static inline void vwarp_triangle(vfloat s, vfloat t, vfloat *u, vfloat *v)
{
    vfloat root = vsqrt(s);
    *u          = root * (1.0f - t);
    *v          = root - *u;
}

#endif
