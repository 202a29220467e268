/* tests/two_angle_twin.h -- skies of two angles in double, and integrals over what skies give. */
#ifndef TESTS_TWO_ANGLE_TWIN_H
#define TESTS_TWO_ANGLE_TWIN_H

#include "sky/sky.h"

/* a, b, c, d, e of (1 + a exp(b / cos Z)) (f0 + c exp(d chi) + e cos^2 chi) */
typedef struct angle_twin {
    double a, b, f0, c, d, e;
    double sun[3];
} angle_twin;

/* Toward the sun at this elevation, some way around. */
vec3 angle_twin_sun(double elevation_deg);
/* At a direction, >= 0; 0 below the horizon. */
double angle_twin_at(const angle_twin *t, const double way[3]);
/* On level ground, by the midpoints of rings x 2 rings cells, even in solid angle times cosine. */
double angle_twin_level(const angle_twin *t, int rings);

/* One lane's green channel of a sky. */
double sky_green(const sky *s, vec3 way);
/* W/m^2, green, on a surface tilted by so many degrees toward x: by midpoints over the sphere. */
double sky_on_tilted(const sky *s, double tilt_deg, int rows);

#endif
