/* core/image_oiio.h -- what liblux4_oiio.so does for image_picture.c, which looks the functions up
 * by name. No other file may call them: nothing is linked with that library.
 */
#ifndef CORE_IMAGE_OIIO_H
#define CORE_IMAGE_OIIO_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct oiio_message {
    char text[256]; /* why it failed; one line */
} oiio_message;

typedef struct oiio_picture {
    const char *name; /* by whose ending the format is chosen */
    int width, height;
    const uint8_t *rgb; /* sRGB, top row first */
} oiio_picture;

/* Where the bytes of the encoded file go. */
typedef struct oiio_sink {
    bool (*put)(void *context, const void *bytes, size_t size);
    void *context;
} oiio_sink;

typedef struct oiio_source {
    const char *name;  /* of the file, if bytes is NULL */
    const void *bytes; /* a PNG, JPEG, ... in memory: told by how it begins */
    size_t size;
    bool srgb;     /* whether integers are sRGB rather than linear */
    bool radiance; /* colours alone, and each fourth float 0 */
} oiio_source;

/* Where a picture goes: make() gives room for width * height * 4 floats, or NULL. */
typedef struct oiio_place {
    float *(*make)(void *context, int width, int height);
    void *context;
} oiio_place;

/* All return false, with *why, on failure; none lets an exception out. Any thread. */
typedef bool oiio_encode_function(const oiio_picture *picture, oiio_sink to, oiio_message *why);
typedef bool oiio_load_function(const oiio_source *from, oiio_place to, oiio_message *why);

oiio_encode_function lux4_oiio_encode;
oiio_load_function lux4_oiio_load;

#ifdef __cplusplus
}
#endif

#endif
