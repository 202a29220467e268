/* materials/fresnel.h -- what smooth borders of clear bodies do: where light goes, and how much.
 *
 *                wo   n   wi (mirrored)      eta = index on the far side / index on wo's side
 *                  \  |  /                   sin t = sin i / eta               (Snell)
 *                   \i|i/
 *            --------\|/--------             r_s = (cos i - eta cos t) / (cos i + eta cos t)
 *                     |\                     r_p = (eta cos i - cos t) / (eta cos i + cos t)
 *                     |t\
 *                     |  wi (refracted)      shares of power: R = r^2, T = 1 - R     (Fresnel)
 *
 * s is light polarised across the plane of incidence, p along it; unpolarised light is half of each
 * (Born & Wolf, Principles of Optics, 1.5.2 and 1.5.3). 1 - R is worked out on its own,
 * 4 a b / (a + b)^2 for R = (a - b)^2 / (a + b)^2: near grazing it is small and must not be a
 * difference.
 */
#ifndef MATERIALS_FRESNEL_H
#define MATERIALS_FRESNEL_H

#include "core/packet_math.h"
#include "materials/material.h"

/* Shares of power, [0, 1]. */
typedef struct vpolarised {
    vfloat s, p;
} vpolarised;

typedef struct vfresnel {
    vpolarised reflected, passed; /* their sum is 1 to rounding */
    vfloat cos_t;                 /* 0 at total reflection */
} vfresnel;

static inline vfloat vunpolarised(vpolarised a) { return 0.5f * (a.s + a.p); }

/* Of one border: cos_i in [0, 1], eta > 0. From the denser side beyond the critical angle all is
 * reflected. */
static inline vfresnel vfresnel_border(vfloat cos_i, vfloat eta)
{
    /* 1 - (1 - cos_i^2) / eta^2, of an eta near 1 as well */
    vfloat cos2_t = ((eta - 1.0f) * (eta + 1.0f) + cos_i * cos_i) / (eta * eta);
    vmask passes  = cos2_t > 0.0f;
    vfloat cos_t  = vsqrt(vkeep(passes, cos2_t));

    vfloat far = eta * cos_t, near = eta * cos_i;
    vfloat sum_s = cos_i + far, r_s = (cos_i - far) / sum_s;
    vfloat sum_p = near + cos_t, r_p = (near - cos_t) / sum_p;

    vfloat one         = vsplat(1.0f);
    vpolarised back    = { vselect(passes, r_s * r_s, one), vselect(passes, r_p * r_p, one) };
    vpolarised through = { vkeep(passes, 4.0f * (cos_i / sum_s) * (far / sum_s)),
                           vkeep(passes, 4.0f * (near / sum_p) * (cos_t / sum_p)) };
    return (vfresnel){ back, through, cos_t };
}

/* ---- a plate with plane faces, all passages to and fro added up --------------------------------
 */

typedef struct vslab {
    vfloat passed, reflected; /* shares of power, [0, 1] */
} vslab;

/* Of one polarisation: r is what a face reflects, e = 1 - r, a what of the light is left after one
 * way through the inside:
 *
 *     T = e^2 a / (1 - r^2 a^2)        R = r (1 + a T)
 *
 * 1 - r a is 1 - a + e a: where r and a are nearly 1, it is a sum of two small numbers. */
static inline vslab vslab_polarised(vfloat r, vfloat e, vfloat a)
{
    vfloat ends   = (1.0f - a + e * a) * (1.0f + r * a);
    vfloat passed = e * (e * a / ends);
    return (vslab){ passed, r * (1.0f + a * passed) };
}

/* Of unpolarised light; border is that of the outer face, log2_inner the logarithm of what is left
 * after the way square through the inside, in [-inf, 0]. */
static inline vslab vslab_whole(const vfresnel *border, vfloat log2_inner)
{
    vfloat a = vexp2(log2_inner / border->cos_t);
    vslab s  = vslab_polarised(border->reflected.s, border->passed.s, a);
    vslab p  = vslab_polarised(border->reflected.p, border->passed.p, a);
    return (vslab){ 0.5f * (s.passed + p.passed), 0.5f * (s.reflected + p.reflected) };
}

/* ---- where light goes ---------------------------------------------------------------------------
 */

/* wo, mirrored in the shading normal. Where that would lead into the triangle, it is mirrored in
 * the triangle besides, so that nothing leaks through. */
static inline vvec3 vmirrored(const vshading *s)
{
    vvec3 wi   = vsub(vscale(s->n, 2.0f * vdot(s->n, s->wo)), s->wo);
    vfloat dip = vmin(vdot(wi, s->flat), vsplat(0.0f));
    return vsub(wi, vscale(s->flat, 2.0f * dip));
}

/* wo, refracted to the other side; likewise out of the triangle. cos_i and cos_t are those of the
 * shading normal. */
static inline vvec3 vrefracted(const vshading *s, vfloat cos_i, vfloat cos_t, vfloat eta)
{
    vvec3 along = vsub(vscale(s->n, cos_i), s->wo);
    vvec3 wi    = vsub(vscale(along, 1.0f / eta), vscale(s->n, cos_t));
    vfloat rise = vmax(vdot(wi, s->flat), vsplat(0.0f));
    return vnormalize(vsub(wi, vscale(s->flat, 2.0f * rise)));
}

#endif
