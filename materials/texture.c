/* materials/texture.c -- see texture.h. */
#include "materials/texture.h"

#include <string.h>

struct texture {
    int width, height;
    float mean[4];
};

void texture_mean(const texture *t, float rgba[4]) { memcpy(rgba, t->mean, sizeof t->mean); }
