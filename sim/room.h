/* sim/room.h -- the plain box room of a study: six walls without a modelling program, and the
 * windows in them.
 */
#ifndef SIM_ROOM_H
#define SIM_ROOM_H

#include "core/mesh.h"
#include "core/transform.h"
#include "sim/study.h"

enum { ROOM_CEILING, ROOM_WALLS, ROOM_FLOOR, ROOM_MATERIALS /* and on: panes */ };
enum { ROOM_POSITIONS = 8, ROOM_TRIANGLES = 12 };

/* The box [0, size.x] x [0, size.y] x [0, size.z] m, seen from inside: fills in the corners and,
 * per triangle, three indices of them (counter-clockwise from inside) and ROOM_* as material. */
void room_box(dvec3 size, dvec3 positions[ROOM_POSITIONS], uint32_t corners[3 * ROOM_TRIANGLES],
              uint32_t material[ROOM_TRIANGLES]);

/* Triangles as room_box() has them; panes, too, have their front inside. */
typedef struct room_mesh {
    dvec3 *positions;   /* m, in the user's frame */
    uint32_t *corners;  /* 3 a triangle */
    uint32_t *material; /* ROOM_*; from ROOM_MATERIALS on as room_pane() counts */
    uint32_t position_count, triangle_count;
} room_mesh;

/* The room of a study with holes where its windows are, and panes in those that have some. No edge
 * of a triangle ends within another's: nothing leaks between them. False without memory. */
bool room_make(arena *a, const study_room *r, room_mesh *out, lux_error *err);

/* Panes of one transmittance are of one material: which, in the order in which they are first met;
 * -1: window i is an open hole. */
int room_pane(const study_room *r, int i);

/* The rectangle of a window: two corners (m, in the user's frame, equal in the coordinate to
 * which its wall is square), and where outside is. */
typedef struct room_opening {
    dvec3 low, high, outward;
} room_opening;
room_opening room_opening_of(dvec3 size, const study_window *w);

/* Whether a ray from within the room goes out by a window, with a pane or without. */
bool room_goes_out(const study_room *r, dvec3 from, dvec3 direction);

#endif
