/* sim/sky_picture.h -- the skies and suns of a scene as a picture, nothing else in it. */
#ifndef SIM_SKY_PICTURE_H
#define SIM_SKY_PICTURE_H

#include "sim/camera.h"

/* Radiance in the directions of a camera's pixels, W/(sr m^2), top row first: of all skies and suns
 * at the middle of each pixel; 0 where the camera sees nothing. */
bool sky_picture(arena *a, const scene *s, const camera *c, float *rgb[3], lux_error *err);

/* All around, as a sky is read from a file: `width` columns, half as many rows. Each sun's pixels
 * hold its share of them, and together its whole energy. */
bool sky_panorama_picture(arena *a, const scene *s, int width, float *rgb[3], lux_error *err);

/* Where a sun is, and what it gives a surface square to it, W/m^2. */
typedef struct sun_figures {
    vec3 to_sun; /* unit */
    vec3 irradiance;
    double diameter_deg; /* 0: a point */
} sun_figures;
sun_figures sun_figures_of(const light *sun);

#endif
