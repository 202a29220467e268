/* materials/shading_normal.h -- normals that are not the triangle's: kept to what can be seen. */
#ifndef MATERIALS_SHADING_NORMAL_H
#define MATERIALS_SHADING_NORMAL_H

#include "core/packet.h"

/* How far the mirror direction is lifted above the surface: its cosine with the triangle's normal.
 * Below, the sum of two directions that nearly cancel, of 2^-23 each, would no longer have one. */
#define NORMAL_LEAST_RISE 1e-3f

/* A normal between those of the corners, or of a normal map, may look away from the eye, or mirror
 * it into the surface: light would come through the back of what is opaque, and energy be lost.
 * Such an n is turned, in the plane of the mirror direction and the triangle's normal, until the
 * mirror direction r of wo is just above the triangle:
 *
 *     r  = 2 (wo . n) n - wo
 *     r' = r + (least - r . flat) flat, made unit
 *     n' = wo + r', made unit
 *
 * All others come back as they are, to the bit. wo, n and flat are unit, and dot(wo, flat) >= 0;
 * then dot(wo, n') > 0, and the mirror direction about n' is above the triangle, for all n. Where
 * wo itself is lower than twice NORMAL_LEAST_RISE, half as high as wo is enough: the triangle's
 * own normal is never turned. */
static inline vvec3 vnormal_keep_valid(vvec3 wo, vvec3 n, vvec3 flat)
{
    vfloat cos_n = vdot(wo, n);
    vfloat cos_f = vdot(wo, flat);
    vfloat rise  = 2.0f * cos_n * vdot(n, flat) - cos_f;
    vmask valid  = (cos_n > 0.0f) & (rise >= vmin(0.5f * cos_f, vsplat(NORMAL_LEAST_RISE)));

    vvec3 r      = vsub(vscale(n, 2.0f * cos_n), wo);
    vfloat lift  = vmax(NORMAL_LEAST_RISE - rise, vsplat(0.0f));
    vvec3 lifted = vnormalize(valong(r, flat, lift));
    return vselect3(valid, n, vnormalize(vadd(wo, lifted)));
}

#endif
