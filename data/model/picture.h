/* data/model/picture.h -- pictures computed from a formula, and how they become PNG.
 *
 * No library writes them: the same bytes everywhere.
 */
#ifndef MODEL_PICTURE_H
#define MODEL_PICTURE_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

/* at() gives red, green, blue and alpha, [0, 1], as stored (sRGB, or a normal map's 0.5 (n + 1)),
 * at u to the right and v down, [0, 1]. */
typedef struct picture {
    const char *name;
    int width, height;
    bool has_alpha;
    void (*at)(double u, double v, double rgba[4]);
} picture;

/* False: no memory, or writing failed. */
bool picture_write_png(const picture *p, FILE *to);

/* The bytes of zlib's format (RFC 1950, 1951) that stand for these, by fixed codes. */
bool deflate_write(const unsigned char *bytes, size_t size, FILE *to);

/* Of a number that goes over and over, [0, 1). */
double fraction(double x);

/* Noise: smooth in u and v, [0, 1], repeating after `period` units of both, mean 0.5. */
double noise(double u, double v, int period, uint32_t seed);

/* Of four octaves, each half as strong and twice as fine. */
double clouds(double u, double v, int period, uint32_t seed);

#endif
