/* sky/gradation.h -- skies whose luminance depends on two angles alone, each by itself.
 *
 *     L = scale g(Z) f(chi),   g(Z)   = 1 + a exp(b / cos Z)            the gradation
 *                              f(chi) = f0 + c exp(d chi) + e cos^2 chi the indicatrix
 *
 * with Z the angle to the zenith and chi that to the sun; below the horizon, and where that is
 * negative, L is 0. Such are the skies of CIE S 011 and of Perez 1993.
 */
#ifndef SKY_GRADATION_H
#define SKY_GRADATION_H

#include "sky/sky.h"

typedef struct gradation {
    double a, b;        /* b <= 0: finite at the horizon */
    double f0, c, d, e; /* d in 1/rad */
} gradation;

/* Of scale 1: at a zenith angle (rad, <= pi/2) and an angle to the sun (rad), not below 0. */
double gradation_at(const gradation *g, double zenith, double chi);

/* What scale 1 gives to level ground, the sun being `sun_zenith` off the zenith, in [0, pi/2] rad;
 * where the luminance is nowhere negative to 1e-9 of it, else to 1e-5. */
double gradation_irradiance(const gradation *g, double sun_zenith);

/* A sky of that shape, made so that level ground gets `horizontal` (W/m^2 as luminance, >= 0).
 * to_sun: unit, z >= 0 but for rounding; not looked at where f is a constant. What is not so is an
 * error, whose text begins with `what`. */
typedef struct gradation_desc {
    const char *what;
    gradation shape;
    vec3 to_sun;
    double horizontal;
    vec3 color; /* of luminance 1 */
    int columns, rows;
} gradation_desc;
const sky *gradation_sky(arena *a, const gradation_desc *d, lux_error *err);

#endif
