/* tests/box.h -- a box [0, size] m as a scene: materials by ROOM_*, emission in W/(sr m^2). */
#ifndef TESTS_BOX_H
#define TESTS_BOX_H

#include "sim/room.h"
#include "sim/scene.h"

const scene *box_scene(arena *a, dvec3 size, const vec3 reflectance[ROOM_MATERIALS],
                       const vec3 emission[ROOM_MATERIALS], bool lid);

#endif
