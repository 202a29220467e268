/* sky/panorama.h -- an HDR panorama as a sky: equirectangular, .exr, .hdr and all else that
 * OpenImageIO reads.
 *
 * The centre column looks along +y of the scene, azimuth grows to the right (to +x); the top row
 * is the zenith. A pixel's radiance is constant over it.
 */
#ifndef SKY_PANORAMA_H
#define SKY_PANORAMA_H

#include "core/notice.h"
#include "sky/sky.h"

typedef struct panorama_desc {
    const char *path;
    double rotate_deg; /* clockwise, seen from above */
    double scale;      /* W/(sr m^2) of 1.0, > 0; NAN: by horizontal, or 1 if that is NAN, too */
    double horizontal; /* W/m^2 as luminance, > 0, sun and sky together on level ground; NAN */
    bool keep_sun;     /* it is not split off, however bright */
} panorama_desc;

/* A sun that was found in it and taken out, to be put in as a lamp of the same energy (Voloboy,
 * Galaktionov, Kopylov, Shapiro 2006). */
typedef struct panorama_sun {
    bool found;
    vec3 to_sun;         /* unit: the centre of its light */
    vec3 irradiance;     /* W/m^2, square to it: what was taken out */
    double diameter_deg; /* of a disk of that brightness and energy, at least the sun's own */
    bool clipped;        /* its brightest pixels all have one value: the camera saw no more */
} panorama_sun;

/* Notices say what was found: the sun, where, how much light; that it is clipped; lamps that are
 * none; that the picture is not twice as wide as high. Numbers that are not finite or are negative
 * are an error that names the pixel, but for small negative ones beside bright pixels, which
 * resampling leaves there: their light is taken from those. NULL, with *err naming the file. */
const sky *sky_panorama(arena *a, const panorama_desc *d, panorama_sun *sun, notices *n,
                        lux_error *err);

#endif
