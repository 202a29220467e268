/* tests/bench/plain_texture.h -- textures as plain C has them: a look-up at a time, with libm.
 *
 * What packets are measured against, and what they are checked with: the mathematics is that of
 * materials/texture.h for pictures that repeat and whose sides are powers of two.
 */
#ifndef TESTS_BENCH_PLAIN_TEXTURE_H
#define TESTS_BENCH_PLAIN_TEXTURE_H

enum { PLAIN_LEVELS = 16 };

typedef struct plain_texture {
    int levels;
    int side[PLAIN_LEVELS];           /* texels, of a square */
    const float *texel[PLAIN_LEVELS]; /* four floats each, top row first */
} plain_texture;

void plain_texture_lookup(const plain_texture *t, float u, float v, float width, float rgba[4]);

/* The sums of each channel over so many look-ups. */
void plain_texture_sum(const plain_texture *t, const float *u, const float *v, const float *width,
                       int count, float rgba[4]);

#endif
