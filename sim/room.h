/* sim/room.h -- the plain box room of a study: six walls without a modelling program. */
#ifndef SIM_ROOM_H
#define SIM_ROOM_H

#include "core/mesh.h"
#include "core/transform.h"

enum { ROOM_CEILING, ROOM_WALLS, ROOM_FLOOR, ROOM_MATERIALS };
enum { ROOM_POSITIONS = 8, ROOM_TRIANGLES = 12 };

/* The box [0, size.x] x [0, size.y] x [0, size.z] m, seen from inside: fills in the corners and,
 * per triangle, three indices of them (counter-clockwise from inside) and ROOM_* as material. */
void room_box(dvec3 size, dvec3 positions[ROOM_POSITIONS], uint32_t corners[3 * ROOM_TRIANGLES],
              uint32_t material[ROOM_TRIANGLES]);

#endif
