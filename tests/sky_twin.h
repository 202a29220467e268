/* tests/sky_twin.h -- skies for the tests of who draws from them. */
#ifndef TESTS_SKY_TWIN_H
#define TESTS_SKY_TWIN_H

#include "sky/sky.h"

typedef enum twin_kind {
    TWIN_BLACK,
    TWIN_EVEN,   /* 1 everywhere */
    TWIN_SMOOTH, /* 2 + x + z/2: no direction like another */
    TWIN_SUNNY,  /* a clear sky with a glow about a place, 0 below the horizon */
    TWIN_PIXELS, /* a panorama: pixel[row * columns + column], laid as brightness.h says */
} twin_kind;

typedef struct sky_twin {
    sky base;
    twin_kind kind;
    const float *pixel;
} sky_twin;

/* columns, rows: 0 but for TWIN_PIXELS. */
sky_twin sky_twin_of(twin_kind kind, const float *pixel, int columns, int rows);

/* Twins that cannot be told by rounding: luminance in double, in a unit direction. */
double sky_twin_luminance(const sky_twin *s, const double w[3]);

/* Even numbers in [0, 1), multiples of 2^-24. */
static inline double twin_even(uint32_t *state)
{
    *state     = *state * 1664525u + 1013904223u;
    uint32_t a = *state;
    a          = (a ^ (a >> 16)) * 0x7feb352d;
    a          = (a ^ (a >> 15)) * 0x846ca68b;
    return (double)((a ^ (a >> 16)) >> 8) * 0x1p-24;
}

#endif
