/* sim/room.c -- see room.h. Corner i lies at x, y, z = bits 0, 1, 2 of i.
 *
 *        6------7
 *       /|     /|      z y
 *      4------5 |      |/
 *      | 2----|-3      +--x
 *      |/     |/
 *      0------1
 */
#include "sim/room.h"

#include <string.h>

static const uint32_t faces[6][4] = {
    /* counter-clockwise as seen from inside */
    { 0, 1, 3, 2 }, /* floor */
    { 4, 6, 7, 5 }, /* ceiling */
    { 0, 4, 5, 1 }, /* south */
    { 2, 3, 7, 6 }, /* north */
    { 0, 2, 6, 4 }, /* west */
    { 1, 5, 7, 3 }, /* east */
};
static const uint32_t face_material[6] = { ROOM_FLOOR, ROOM_CEILING, ROOM_WALLS,
                                           ROOM_WALLS, ROOM_WALLS,   ROOM_WALLS };

void room_box(dvec3 size, dvec3 positions[ROOM_POSITIONS], uint32_t corners[3 * ROOM_TRIANGLES],
              uint32_t material[ROOM_TRIANGLES])
{
    for (int i = 0; i < ROOM_POSITIONS; i++)
        positions[i] = (dvec3){ i & 1 ? size.x : 0, i & 2 ? size.y : 0, i & 4 ? size.z : 0 };
    for (int f = 0; f < 6; f++) {
        const uint32_t *q = faces[f];
        uint32_t two[6]   = { q[0], q[1], q[2], q[0], q[2], q[3] };
        memcpy(corners + 6 * f, two, sizeof two);
        material[2 * f] = material[2 * f + 1] = face_material[f];
    }
}
