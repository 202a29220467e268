/* core/image.h -- pictures: named channels of floats, and the files they are kept in.
 *
 * EXR goes through OpenEXR's C API (image_exr.c); every other format goes through OpenImageIO,
 * which is loaded when the first such picture is asked for (image_oiio.cpp).
 */
#ifndef CORE_IMAGE_H
#define CORE_IMAGE_H

#include "core/arena.h"
#include "core/error.h"
#include "core/notice.h"

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct image_channel {
    const char *name; /* "R", "direct.Y", ...; in an EXR at most 255 bytes */
    float *values;    /* width * height, the top row first, left to right */
} image_channel;

typedef enum attribute_type { ATTRIBUTE_STRING, ATTRIBUTE_FLOAT } attribute_type;

typedef struct image_attribute {
    const char *name; /* "whiteLuminance", "lux4:seed", ... */
    attribute_type type;
    const char *text; /* of a string */
    float number;     /* of a float */
} image_attribute;

typedef struct image {
    int width, height; /* >= 1 */
    int channel_count;
    image_channel *channels;
    int attribute_count;
    image_attribute *attributes;
    const char *part; /* written: its name in a file of several; read, it is attribute "name" */
} image;

/* Writes an EXR: scanlines, ZIP, float channels, or half if `half` (values that half cannot hold
 * are clamped and noticed). NaN or infinite values are an error: no such file is written. Every
 * file carries the chromaticities of Rec. 709 with D65. Bytes depend on the contents alone. */
bool image_write_exr(const char *path, const image *im, bool half, notices *n, lux_error *err);

/* The same for several in one file, each a part by its own name: float channels. */
bool image_write_exr_parts(const char *path, const image *parts, int count, lux_error *err);

/* Reads any scanline or tiled single-part EXR into floats, with its string and float attributes. */
bool image_read_exr(const char *path, arena *a, image *out, lux_error *err);

/* The same for part number `part` (from 0) of a file with any number of them. False, with
 * ERR_ARGUMENT, where there is no such part. */
bool image_read_exr_part(const char *path, int part, arena *a, image *out, lux_error *err);

/* Writes an 8-bit sRGB picture (PNG by its name) of width * height * 3 bytes, top row first. */
bool image_write_rgb8(const char *path, int width, int height, const uint8_t *rgb, lux_error *err);

/* Whether pictures other than EXR can be read and written here; else false with *err, to be told
 * before long work rather than after it. */
bool image_pictures_ready(lux_error *err);

/* A whole picture in any format OpenImageIO reads, as texture.h wants it: (*rgba)[4 * (y * *width +
 * x) + c] in a, the top row first. From memory if bytes is not NULL (`path` then names it in
 * errors), else from the file at path. Integers are decoded from sRGB if `srgb`, alpha never;
 * floats are taken as linear. Grey is all three channels, alpha where there is none 1; of more than
 * four channels the first four count. Colours are not multiplied by alpha, unless the file has only
 * such ones (EXR). False, with *err, for what is no picture, is cut off where its format tells, has
 * a number that is not finite, more than 32768 pixels a side, or more than 4 GB as four floats. */
bool image_load_rgba(const char *path, const void *bytes, size_t size, bool srgb, arena *a,
                     int *width, int *height, float **rgba, lux_error *err);

/* A whole picture of light, as panoramas are: (*rgb0)[4 * (y * *width + x) + c], as above but that
 * channels R, G and B count, or one alone, and no other, alpha neither, whatever they hold: each
 * fourth float is 0; some may be negative. Integers are decoded from sRGB. False, with *err, also
 * for a picture that is cut out of a larger one, lies in its file turned or mirrored, or has
 * luminance and chroma in place of colours. */
bool image_load_radiance(const char *path, arena *a, int *width, int *height, float **rgb0,
                         lux_error *err);

#ifdef __cplusplus
}
#endif

#endif
