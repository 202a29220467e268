/* tests/one_lane_texture.h -- a look-up as it is at width 1, whatever the width of the rest. */
#ifndef TESTS_ONE_LANE_TEXTURE_H
#define TESTS_ONE_LANE_TEXTURE_H

#include "materials/texture.h"

void one_lane_lookup(const texture *t, float u, float v, float width, float rgba[4]);

#endif
