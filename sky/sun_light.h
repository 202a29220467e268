/* sky/sun_light.h -- the sun as a lamp: a disk of even radiance, infinitely far away.
 *
 * sample() draws evenly by solid angle in the cone of the disk; hit() finds it with that density;
 * as_point() is exact where all of the disk is above the horizon: E = e cos(a), with
 * e = pi L sin^2(radius) and a the angle to its centre. Bounds: far.
 */
#ifndef SKY_SUN_LIGHT_H
#define SKY_SUN_LIGHT_H

#include "lights/light.h"

typedef struct sun_light_desc {
    vec3 to_sun;         /* toward its centre; any length but 0 */
    vec3 irradiance;     /* W/m^2, on a plane square to it, >= 0 */
    double diameter_deg; /* (0, 60] */
} sun_light_desc;

const light *light_sun(arena *a, const sun_light_desc *d, lux_error *err);

#endif
