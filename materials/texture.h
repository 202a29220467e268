/* materials/texture.h -- pictures on surfaces: colours by place, averaged over what a ray sees.
 *
 * A texture is a pyramid of ever smaller pictures, each texel the mean of those below it (Williams,
 * "Pyramidal Parametrics", SIGGRAPH 1983); a look-up blends the two levels about the width that was
 * asked for, each bilinear. Texels are four floats side by side (red, green, blue, alpha), one
 * 16-byte load a corner. (0, 0) is the upper left corner of the upper left texel, u grows to the
 * right, v downward, as in glTF.
 */
#ifndef MATERIALS_TEXTURE_H
#define MATERIALS_TEXTURE_H

#include "core/arena.h"
#include "core/error.h"
#include "core/packet.h"

typedef struct texture texture;

typedef enum texture_wrap { WRAP_REPEAT, WRAP_CLAMP, WRAP_MIRROR } texture_wrap;

typedef struct texture_desc {
    const char *name;  /* for messages */
    int width, height; /* >= 1, at most 32768 */
    const float *rgba; /* width * height * 4, linear, top row first; copied */
    texture_wrap wrap_u, wrap_v;
    bool nearest; /* take the nearest texel of the full picture, always (glTF's NEAREST) */
} texture_desc;

/* NULL, with *err, for sizes out of range and for texels that are NaN, infinite or beyond 1e30. */
const texture *texture_new(arena *a, const texture_desc *d, lux_error *err);

typedef struct vtexel {
    vfloat red, green, blue, alpha;
} vtexel;

/* At (u, v), averaged over a square of that width, in units of the coordinates (a texture's whole
 * width is 1; of one that is no square the longer side decides the level). Where all texels are
 * the same, so is the result, to the bit. Coordinates of any size, NaN and infinities included,
 * read a texel that is there; lanes outside active come back zero. */
vtexel vtexture_lookup(const texture *t, vfloat u, vfloat v, vfloat width, vmask active);

/* The mean over the picture: that of its last level too. */
void texture_mean(const texture *t, float rgba[4]);
/* The least and largest of each channel in the full picture. */
void texture_range(const texture *t, float low[4], float high[4]);
/* What share of the full picture's texels has at least that alpha, [0, 1]. */
double texture_share(const texture *t, float alpha);
/* All that it keeps in memory; and texture_desc.rgba, which is needed besides while it is made. */
uint64_t texture_bytes(const texture *t);
uint64_t texture_picture_bytes(const texture *t);

#endif
