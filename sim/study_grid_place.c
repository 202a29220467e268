/* sim/study_grid_place.c -- grids over and on the surfaces of the room, and how many sensors a grid
 * has.
 *
 * Of each surface the corner at its lower left is known, seen from inside, and which way is right
 * and up: so a grid's picture looks as the surface does to one who stands before it, and u x v
 * points into the room.
 *
 *     the north wall    v +-----+         the ceiling, to     v +-----+
 *     (left: west)        | . . |         one who looks up      | . . |
 *                  corner +-----+ u       (left: east)   corner +-----+ u
 */
#include "sim/study_read.h"

/* The corner in sizes of the room. */
typedef struct surface {
    const char *what;
    dvec3 corner, right, up;
} surface;

static const surface surfaces[] = {
    [SIDE_ROOM]    = { "room", { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } },
    [SIDE_FLOOR]   = { "floor", { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } },
    [SIDE_CEILING] = { "ceiling", { 1, 0, 1 }, { -1, 0, 0 }, { 0, 1, 0 } },
    [SIDE_SOUTH]   = { "wall", { 1, 0, 0 }, { -1, 0, 0 }, { 0, 0, 1 } },
    [SIDE_EAST]    = { "wall", { 1, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 } },
    [SIDE_NORTH]   = { "wall", { 0, 1, 0 }, { 1, 0, 0 }, { 0, 0, 1 } },
    [SIDE_WEST]    = { "wall", { 0, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } },
};

bool study_grid_place(const study *s, study_grid *g, lux_error *err)
{
    const study_room *room = &s->room;
    const surface *on      = &surfaces[g->on];
    if (!room->given)
        return study_failed(s, g->where, err, ERR_FORMAT,
                            "a grid with `on` needs a room, but there is no `room`");
    if (g->on == SIDE_ROOM && !(g->height < room->size.z))
        return study_failed(s, g->where, err, ERR_FORMAT,
                            "`height: %g` is not below the ceiling at %g m", g->height,
                            room->size.z);

    double across = fabs(d3_dot(on->right, room->size));
    double high   = fabs(d3_dot(on->up, room->size));
    double u      = across - 2.0 * g->margin;
    double v      = high - 2.0 * g->margin;
    if (!(u > 0.0 && v > 0.0))
        return study_failed(s, g->where, err, ERR_FORMAT,
                            "`margin: %g` leaves nothing of a %s of %g by %g m", g->margin,
                            on->what, across, high);

    dvec3 corner = { on->corner.x * room->size.x, on->corner.y * room->size.y,
                     on->corner.z * room->size.z };
    dvec3 in     = d3_scale(d3_add(on->right, on->up), g->margin);
    g->origin    = d3_add(corner, in);
    g->origin.z += g->on == SIDE_ROOM ? g->height : 0.0;
    g->u = d3_scale(on->right, u);
    g->v = d3_scale(on->up, v);
    return true;
}

/* ---- how many ------------------------------------------------------------------------------- */

/* Of a length of x cells: the odd number nearest to it. */
static double odd_near(double x) { return fmax(2.0 * round((x - 1.0) / 2.0) + 1.0, 1.0); }

static double odd_at_least(double x) { return 2.0 * ceil((x - 1.0) / 2.0) + 1.0; }

double study_counts_en12464(double side, double other, double *along_side, double *along_other)
{
    double longer  = fmax(side, other);
    double shorter = fmin(side, other);
    double d       = longer / shorter >= 2.0 ? shorter : longer;
    double p       = fmin(0.2 * pow(5.0, log10(d)), 10.0);
    double cells   = odd_at_least(d / p - 1e-9); /* 9 m at 1 m: 9, whatever pow() rounds to */
    double spacing = d / cells;
    *along_side    = side == d ? cells : odd_near(side / spacing);
    *along_other   = other == d ? cells : odd_near(other / spacing);
    return spacing;
}

void study_grid_counts(const study_grid *g, double *along_u, double *along_v)
{
    bool counted = g->count[0] > 0;
    *along_u     = counted ? g->count[0] : fmax(1.0, round(d3_length(g->u) / g->spacing));
    *along_v     = counted ? g->count[1] : fmax(1.0, round(d3_length(g->v) / g->spacing));
}
