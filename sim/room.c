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

/* ---- windows --------------------------------------------------------------------------------- */

/* From the wall's left end, seen from inside; of floor and ceiling from the origin, as a plan has
 * it. */
room_opening room_opening_of(dvec3 size, const study_window *w)
{
    double from = w->at[0], to = w->at[0] + w->size[0];
    double low = w->at[1], high = w->at[1] + w->size[1];
    switch (w->wall) {
    case SIDE_SOUTH:
        return (room_opening){ { size.x - to, 0, low }, { size.x - from, 0, high }, { 0, -1, 0 } };
    case SIDE_NORTH:
        return (room_opening){ { from, size.y, low }, { to, size.y, high }, { 0, 1, 0 } };
    case SIDE_WEST:
        return (room_opening){ { 0, from, low }, { 0, to, high }, { -1, 0, 0 } };
    case SIDE_EAST:
        return (room_opening){ { size.x, size.y - to, low },
                               { size.x, size.y - from, high },
                               { 1, 0, 0 } };
    case SIDE_CEILING:
        return (room_opening){ { from, low, size.z }, { to, high, size.z }, { 0, 0, 1 } };
    default:
        return (room_opening){ { from, low, 0 }, { to, high, 0 }, { 0, 0, -1 } };
    }
}

int room_pane(const study_room *r, int i)
{
    const study_window *w = r->windows;
    int found             = 0;
    if (w[i].transmittance == 1.0)
        return -1;
    for (int j = 0; j < i; j++) {
        if (w[j].transmittance == w[i].transmittance)
            return room_pane(r, j);
        bool first = w[j].transmittance < 1.0;
        for (int k = 0; k < j && first; k++)
            first = w[k].transmittance != w[j].transmittance;
        found += first;
    }
    return found;
}

bool room_goes_out(const study_room *r, dvec3 from, dvec3 direction)
{
    for (int i = 0; i < r->window_count; i++) {
        room_opening o = room_opening_of(r->size, &r->windows[i]);
        double across  = d3_dot(direction, o.outward);
        double t       = d3_dot(d3_sub(o.low, from), o.outward) / across;
        dvec3 p        = d3_add(from, d3_scale(direction, t));
        dvec3 out = { fabs(o.outward.x), fabs(o.outward.y), fabs(o.outward.z) }; /* counts not */
        if (across > 0.0 && (out.x > 0.0 || (p.x >= o.low.x && p.x <= o.high.x)) &&
            (out.y > 0.0 || (p.y >= o.low.y && p.y <= o.high.y)) &&
            (out.z > 0.0 || (p.z >= o.low.z && p.z <= o.high.z)))
            return true;
    }
    return false;
}
