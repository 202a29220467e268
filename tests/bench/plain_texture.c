/* tests/bench/plain_texture.c -- see plain_texture.h; built without the compiler's vectoriser. */
#include "tests/bench/plain_texture.h"

#include <math.h>

static float lerp(float a, float b, float t) { return a + t * (b - a); }

/* Bilinear in one level; u and v in [0, 1] */
static void bilinear(const plain_texture *t, int level, float u, float v, float rgba[4])
{
    int side = t->side[level];
    float x  = u * (float)side - 0.5f;
    float y  = v * (float)side - 0.5f;
    float x0 = floorf(x), y0 = floorf(y);
    float s = x - x0;
    float r = y - y0;

    /* Sides are powers of two: the mask repeats the picture */
    int left            = (int)x0 & (side - 1);
    int right           = ((int)x0 + 1) & (side - 1);
    const float *top    = t->texel[level] + 4 * side * ((int)y0 & (side - 1));
    const float *bottom = t->texel[level] + 4 * side * (((int)y0 + 1) & (side - 1));
    const float *a = top + 4 * left, *b = top + 4 * right;
    const float *c = bottom + 4 * left, *d = bottom + 4 * right;
    for (int k = 0; k < 4; k++)
        rgba[k] = lerp(lerp(a[k], b[k], s), lerp(c[k], d[k], s), r);
}

void plain_texture_lookup(const plain_texture *t, float u, float v, float width, float rgba[4])
{
    u -= floorf(u);
    v -= floorf(v);
    float size = width * (float)t->side[0];
    if (!(size > 1.0f)) {
        bilinear(t, 0, u, v, rgba);
        return;
    }
    float place = log2f(size);
    int level   = (int)place;
    if (level >= t->levels - 1) {
        bilinear(t, t->levels - 1, u, v, rgba);
        return;
    }
    float far[4], between = place - (float)level;
    bilinear(t, level, u, v, rgba);
    bilinear(t, level + 1, u, v, far);
    for (int k = 0; k < 4; k++)
        rgba[k] = lerp(rgba[k], far[k], between);
}

void plain_texture_sum(const plain_texture *t, const float *u, const float *v, const float *width,
                       int count, float rgba[4])
{
    for (int k = 0; k < 4; k++)
        rgba[k] = 0.0f;
    for (int i = 0; i < count; i++) {
        float one[4];
        plain_texture_lookup(t, u[i], v[i], width[i], one);
        for (int k = 0; k < 4; k++)
            rgba[k] += one[k];
    }
}
