/* sky/panorama_parts.h -- what the files of panorama.h share: panorama.c makes the sky,
 * panorama_sun.c finds a sun in it. Directions here are of the picture: its middle looks along +y.
 */
#ifndef SKY_PANORAMA_PARTS_H
#define SKY_PANORAMA_PARTS_H

#include "sky/panorama.h"

typedef struct panorama_map {
    const char *path;
    int width, height;
    float *rgb0; /* red, green, blue and 0 of each pixel, finite, >= 0 once panorama_clean() has
                    been over it; top row first */
} panorama_map;

/* What pixels of a row have in common. With longitude f (from the picture's middle to the right)
 * and polar angle t, the direction is w = (sin t sin f, sin t cos f, cos t), dw = sin t dt df. */
typedef struct panorama_row {
    double polar;       /* rad, of the middle */
    double solid_angle; /* sr, of a pixel */
    double up;          /* sr: of w.z dw over a pixel */
    double above;       /* the same of what is above the horizon */
    double out;         /* sr: of w dw over a pixel, along the horizontal through its middle */
} panorama_row;

panorama_row panorama_row_of(const panorama_map *m, int row);

static inline double panorama_longitude(const panorama_map *m, int column)
{
    return 2.0 * M_PI * ((column + 0.5) / m->width - 0.5);
}

static inline float *panorama_pixel(const panorama_map *m, int column, int row)
{
    return m->rgb0 + 4 * ((size_t)row * (size_t)m->width + (size_t)column);
}

/* Makes negative numbers positive where they can be explained; else false, with *err. */
bool panorama_clean(const panorama_map *m, lux_error *err);

/* Finds the sun, if there is one, takes it out of the map and puts its surroundings in its place;
 * what is found is as bright as the map's numbers are. */
void panorama_split_sun(const panorama_map *m, panorama_sun *out, notices *n);

#endif
