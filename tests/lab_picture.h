/* tests/lab_picture.h -- quads with pictures on them, for studies as in lab.h. */
#ifndef TESTS_LAB_PICTURE_H
#define TESTS_LAB_PICTURE_H

#include "tests/lab.h"

/* 8-bit sRGB and alpha, top row first. */
typedef struct picture {
    int width, height; /* at most 60 x 60 */
    const uint8_t *rgba;
    const char *sampler; /* its members: "" for smooth ones that repeat */
} picture;

/* Members of a sampler that takes the nearest texel. */
#define NEAREST_TEXEL "\"magFilter\":9728,\"minFilter\":9728"

/* A file of the quad at one node, of a material with these members; its texture 0 is the picture,
 * laid upright: its upper left corner is corner 3 of the quad, its lower left one corner 0. */
void lab_picture(lab *l, const char *name, const quad *q, const picture *p, const char *made_of);

#endif
