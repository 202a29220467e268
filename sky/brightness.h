/* sky/brightness.h -- several skies as one table of luminance, for those who draw by it.
 *
 * Cells are equal steps of azimuth and of the angle from the zenith, as the pixels of a panorama:
 * column 0 begins in -y and goes on to -x, +y, +x; row 0 begins at the zenith.
 */
#ifndef SKY_BRIGHTNESS_H
#define SKY_BRIGHTNESS_H

#include "sky/sky.h"

typedef struct brightness {
    int columns, rows;
    double mean; /* W/(sr m^2), over the whole sphere; 0: all is black */
    /* W/(sr m^2), row by row: the mean of the skies, and over the pixels where a panorama has more
     * than a cell; at least a quarter of what lies left and right of it, since pixels may be turned
     * against cells by part of one. */
    float *luminance;
} brightness;

/* Lives as long as a does. False, with *err, without memory. */
bool brightness_of(arena *a, brightness *b, const sky *const *skies, int count, lux_error *err);

#endif
