/* tests/sky_twin.h -- skies of two angles in double, and integrals over what skies give. */
#ifndef TESTS_SKY_TWIN_H
#define TESTS_SKY_TWIN_H

#include "sky/sky.h"

/* a, b, c, d, e of (1 + a exp(b / cos Z)) (f0 + c exp(d chi) + e cos^2 chi) */
typedef struct sky_twin {
    double a, b, f0, c, d, e;
    double sun[3];
} sky_twin;

/* Toward the sun at this elevation, some way around. */
vec3 sky_twin_sun(double elevation_deg);
/* At a direction, >= 0; 0 below the horizon. */
double sky_twin_at(const sky_twin *t, const double way[3]);
/* On level ground, by the midpoints of rings x 2 rings cells, even in solid angle times cosine. */
double sky_twin_level(const sky_twin *t, int rings);

/* One lane's green channel of a sky. */
double sky_green(const sky *s, vec3 way);
/* W/m^2, green, on a surface tilted by so many degrees toward x: by midpoints over the sphere. */
double sky_on_tilted(const sky *s, double tilt_deg, int rows);

#endif
