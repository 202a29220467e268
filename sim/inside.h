/* sim/inside.h -- which places lie inside something solid: where no sensor is to be.
 *
 * A place is inside if all ways out of it leave through the back of a surface. Along each of many
 * directions, spread evenly, the surfaces that a ray meets are counted: a back is one way out, a
 * front one way in, and the place is closed in toward there once the ways out outnumber the
 * ways in. So solids may stand inside of, beside and through each other, and on the floor.
 * Surfaces that lie in one plane (a cupboard's foot and the floor) count backs first.
 *
 * Inside is what closed surfaces hold whose front is outside: furniture as it should be modelled.
 * Not inside: a room whose surfaces face into it, an open box, what is below a table or between
 * two walls, and places on a surface, to within rounding. Not judged, and so not inside: solids
 * of which some surface faces the wrong way, those with a hole as wide as a 64th of what is seen
 * from the place, those that reach through an open surface (a cupboard sunk into the floor), and
 * places from which more than 32 surfaces would have to be counted.
 */
#ifndef SIM_INSIDE_H
#define SIM_INSIDE_H

#include "core/world.h"

/* For each place (m, in the scene's frame) whether it is inside; returns how many are. If more
 * than half of the places would be, then it is the shell of the building that faces outward, and
 * tells nothing: none is, and *shell_outward is true. Any number of threads may ask. */
int inside_find(const world *w, const vec3 *places, int count, bool *inside, bool *shell_outward);

#endif
