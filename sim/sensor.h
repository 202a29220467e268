/* sim/sensor.h -- how a sensor weighs the light that reaches it: the quantities of study.h.
 *
 *     E = integral of L(w) response(w) dw        [W/m^2]
 *
 * A sensor is a surface of core/world.h whose normal is that of the plane or, of a semicylinder,
 * where it faces. A path that begins at it takes its direction with the pdf given here.
 */
#ifndef SIM_SENSOR_H
#define SIM_SENSOR_H

#include "core/warp.h"
#include "core/world.h"
#include "sim/study.h"

/* Whether light from all around counts, not from one side alone. */
static inline bool quantity_is_round(study_quantity q)
{
    return q == QUANTITY_CYLINDRICAL || q == QUANTITY_SEMICYLINDRICAL;
}

/* Of light that arrives against wi; [0, 1]. With e the angle of wi to the vertical and a its
 * azimuth from where the sensor faces, sin(e) is the horizontal part of wi and sin(e) cos(a) its
 * part along that direction. */
static inline vfloat vsensor_response(study_quantity q, const vvec3 *normal, const vvec3 *wi)
{
    vfloat cosine = vdot(*normal, *wi);
    if (!quantity_is_round(q))
        return vmax(cosine, vsplat(0.0f));
    vfloat sine = vsqrt(wi->x * wi->x + wi->y * wi->y);
    if (q == QUANTITY_SEMICYLINDRICAL)
        sine = vmax(sine + wi->x * normal->x + wi->y * normal->y, vsplat(0.0f));
    return sine * (1.0f / WARP_PI);
}

/* A direction, its pdf in *pdf (1/sr), and response / pdf in *worth (sr). */
static inline vvec3 vsensor_direction(study_quantity q, const vvec3 *normal, vfloat s, vfloat t,
                                      vfloat *pdf, vfloat *worth)
{
    if (!quantity_is_round(q)) {
        vvec3 wi = vwarp_cosine_about(*normal, s, t);
        *pdf     = vwarp_cosine_pdf(vdot(wi, *normal));
        *worth   = vsplat(WARP_PI);
        return wi;
    }
    vvec3 wi = vwarp_sphere(s, t);
    *pdf     = vsplat(WARP_SPHERE_PDF);
    *worth   = vsensor_response(q, normal, &wi) * (1.0f / WARP_SPHERE_PDF);
    return wi;
}

static inline vfloat vsensor_pdf(study_quantity q, const vvec3 *normal, const vvec3 *wi)
{
    return quantity_is_round(q) ? vsplat(WARP_SPHERE_PDF) : vwarp_cosine_pdf(vdot(*wi, *normal));
}

#endif
