/* sim/room_cut.c -- a room with windows as triangles: see room.h.
 *
 * Each side is cut into strips at the sills and heads of its windows, each strip into rectangles
 * beside and between them:
 *
 *     +-----------------+     A rectangle is given every corner of others that lies on its border,
 *     |                 |     those of the wall around the corner of the room too, and is a fan
 *     +---+----+--+--+--+     about its middle where it has more than four. So triangles meet edge
 *     |   |    |  |  |  |     to edge, which is what keeps rays from slipping through.
 *     +---+----+--+--+--+
 *     |                 |
 *     +-----------------+
 */
#include "sim/room.h"

#include <stdlib.h>

typedef struct face {
    study_side side;
    int axis;      /* square to it: 0, 1, 2 for x, y, z */
    bool high;     /* at the room's size along it, not at 0 */
    uint32_t made; /* of ROOM_* */
} face;

static const face faces[] = {
    { SIDE_FLOOR, 2, false, ROOM_FLOOR }, { SIDE_CEILING, 2, true, ROOM_CEILING },
    { SIDE_SOUTH, 1, false, ROOM_WALLS }, { SIDE_NORTH, 1, true, ROOM_WALLS },
    { SIDE_WEST, 0, false, ROOM_WALLS },  { SIDE_EAST, 0, true, ROOM_WALLS },
};
enum { FACES = sizeof faces / sizeof *faces };

/* In a face: from low to high along the other two axes, in their order. */
typedef struct piece {
    const face *in;
    double depth; /* m, along the face's axis */
    double low[2], high[2];
    uint32_t made;
} piece;

typedef struct cutting {
    arena *scratch;
    const study_room *room;
    piece *pieces;
    dvec3 *corners; /* of pieces, sorted, none twice */
    size_t piece_count, corner_count;
} cutting;

static double along(dvec3 p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

/* The two axes of a face. */
static int axis_of(const face *f, int k) { return k == 0 ? f->axis == 0 : f->axis == 2 ? 1 : 2; }

static dvec3 place_in(const piece *p, double a, double b)
{
    switch (p->in->axis) {
    case 0:
        return (dvec3){ p->depth, a, b };
    case 1:
        return (dvec3){ a, p->depth, b };
    default:
        return (dvec3){ a, b, p->depth };
    }
}

/* ---- rectangles ------------------------------------------------------------------------------ */

static int by_size(const void *one, const void *other)
{
    double a = *(const double *)one, b = *(const double *)other;
    return (a > b) - (a < b);
}

static int by_left(const void *one, const void *other)
{
    return by_size(&((const piece *)one)->low[0], &((const piece *)other)->low[0]);
}

static piece whole(const cutting *c, const face *f)
{
    double depth = f->high ? along(c->room->size, f->axis) : 0.0;
    return (piece){ .in    = f,
                    .depth = depth,
                    .high  = { along(c->room->size, axis_of(f, 0)),
                               along(c->room->size, axis_of(f, 1)) },
                    .made  = f->made };
}

static piece opening_in(const cutting *c, const face *f, int window)
{
    room_opening o = room_opening_of(c->room->size, &c->room->windows[window]);
    piece p        = whole(c, f);
    for (int k = 0; k < 2; k++) {
        p.low[k]  = along(o.low, axis_of(f, k));
        p.high[k] = along(o.high, axis_of(f, k));
    }
    return p;
}

/* Those of a face, from left to right; their panes are pieces. */
static int add_windows(cutting *c, const face *f, piece *out)
{
    int count = 0;
    for (int i = 0; i < c->room->window_count; i++) {
        int pane = room_pane(c->room, i);
        if (c->room->windows[i].wall != f->side)
            continue;
        out[count] = opening_in(c, f, i);
        if (pane >= 0) {
            c->pieces[c->piece_count]        = out[count];
            c->pieces[c->piece_count++].made = (uint32_t)(ROOM_MATERIALS + pane);
        }
        count++;
    }
    qsort(out, (size_t)count, sizeof *out, by_left);
    return count;
}

/* Windows may overlap by a rounding, where they touch. */
static void add_strip(cutting *c, const piece *strip, const piece *windows, int count)
{
    piece rest = *strip;
    double mid = 0.5 * (strip->low[1] + strip->high[1]);
    for (int i = 0; i <= count; i++) {
        if (i < count && !(windows[i].low[1] < mid && mid < windows[i].high[1]))
            continue;
        rest.high[0] = i < count ? windows[i].low[0] : strip->high[0];
        if (rest.low[0] < rest.high[0])
            c->pieces[c->piece_count++] = rest;
        if (i < count)
            rest.low[0] = windows[i].high[0];
    }
}

static bool add_face(cutting *c, const face *f, lux_error *err)
{
    size_t room    = (size_t)c->room->window_count + 1;
    piece *windows = arena_array(c->scratch, piece, room, err);
    double *levels = arena_array(c->scratch, double, 2 * room, err);
    if (!windows || !levels)
        return false;
    piece strip = whole(c, f);
    int count = add_windows(c, f, windows), n = 0;
    levels[n++] = 0.0;
    levels[n++] = strip.high[1];
    for (int i = 0; i < count; i++) {
        levels[n++] = windows[i].low[1];
        levels[n++] = windows[i].high[1];
    }
    qsort(levels, (size_t)n, sizeof *levels, by_size);
    for (int i = 0; i + 1 < n; i++) {
        strip.low[1]  = levels[i];
        strip.high[1] = levels[i + 1];
        if (strip.low[1] < strip.high[1])
            add_strip(c, &strip, windows, count);
    }
    return true;
}

/* Of w windows in a face at most 2 w + 1 strips of w + 1 pieces each, and w panes. */
static bool cut(cutting *c, lux_error *err)
{
    size_t most = 0;
    for (int f = 0; f < FACES; f++) {
        size_t w = 0;
        for (int i = 0; i < c->room->window_count; i++)
            w += c->room->windows[i].wall == faces[f].side;
        most += (2 * w + 1) * (w + 1) + w;
    }
    c->pieces = arena_array(c->scratch, piece, most, err);
    for (int f = 0; c->pieces && f < FACES; f++)
        if (!add_face(c, &faces[f], err))
            return false;
    return c->pieces != NULL;
}

/* ---- corners --------------------------------------------------------------------------------- */

static int by_place(const void *one, const void *other)
{
    const dvec3 *a = one, *b = other;
    int x = by_size(&a->x, &b->x), y = by_size(&a->y, &b->y);
    return x ? x : y ? y : by_size(&a->z, &b->z);
}

static bool find_corners(cutting *c, lux_error *err)
{
    dvec3 *all   = arena_array(c->scratch, dvec3, 4 * c->piece_count, err);
    size_t count = 0;
    if (!all)
        return false;
    for (size_t i = 0; i < c->piece_count; i++)
        for (int k = 0; k < 4; k++) {
            const piece *p = &c->pieces[i];
            all[4 * i + (size_t)k] =
                place_in(p, k & 1 ? p->high[0] : p->low[0], k & 2 ? p->high[1] : p->low[1]);
        }
    qsort(all, 4 * c->piece_count, sizeof *all, by_place);
    for (size_t i = 0; i < 4 * c->piece_count; i++)
        if (count == 0 || by_place(&all[i], &all[count - 1]) != 0)
            all[count++] = all[i];
    c->corners      = all;
    c->corner_count = count;
    return true;
}

/* How far around a piece's border a place is, counter-clockwise from its low corner: [0, 4) sides;
 * < 0: it is not on it. */
static double around(const piece *p, dvec3 at)
{
    double a = along(at, axis_of(p->in, 0)), b = along(at, axis_of(p->in, 1));
    double u = (a - p->low[0]) / (p->high[0] - p->low[0]);
    double v = (b - p->low[1]) / (p->high[1] - p->low[1]);
    if (along(at, p->in->axis) != p->depth || !(u >= 0.0 && u <= 1.0 && v >= 0.0 && v <= 1.0))
        return -1.0;
    if (b == p->low[1] && a < p->high[0])
        return u;
    if (a == p->high[0] && b < p->high[1])
        return 1.0 + v;
    if (b == p->high[1] && a > p->low[0])
        return 3.0 - u;
    return a == p->low[0] ? 4.0 - v : -1.0;
}

typedef struct on_border {
    double around;
    uint32_t corner;
} on_border;

static int by_way_around(const void *one, const void *other)
{
    return by_size(&((const on_border *)one)->around, &((const on_border *)other)->around);
}

static uint32_t find_border(const cutting *c, const piece *p, on_border *out)
{
    uint32_t count = 0;
    for (size_t i = 0; i < c->corner_count; i++) {
        double way = around(p, c->corners[i]);
        if (way >= 0.0)
            out[count++] = (on_border){ way, (uint32_t)i };
    }
    qsort(out, count, sizeof *out, by_way_around);
    return count;
}

/* ---- triangles ------------------------------------------------------------------------------- */

static void add_triangle(room_mesh *to, const piece *p, const uint32_t corners[3])
{
    bool turn     = p->in->high != (p->in->axis == 1); /* counter-clockwise is seen from outside */
    uint32_t *out = &to->corners[3 * (size_t)to->triangle_count];
    out[0] = corners[0], out[1] = corners[turn ? 2 : 1], out[2] = corners[turn ? 1 : 2];
    to->material[to->triangle_count++] = p->made;
}

static void add_piece(room_mesh *to, const piece *p, const on_border *border, uint32_t count)
{
    uint32_t middle = to->position_count;
    if (count == 4) {
        uint32_t b[4] = { border[0].corner, border[1].corner, border[2].corner, border[3].corner };
        add_triangle(to, p, (uint32_t[]){ b[0], b[1], b[2] });
        add_triangle(to, p, (uint32_t[]){ b[0], b[2], b[3] });
        return;
    }
    to->positions[to->position_count++] =
        place_in(p, 0.5 * (p->low[0] + p->high[0]), 0.5 * (p->low[1] + p->high[1]));
    for (uint32_t i = 0; i < count; i++)
        add_triangle(to, p,
                     (uint32_t[]){ middle, border[i].corner, border[(i + 1) % count].corner });
}

static bool make(const cutting *c, arena *a, room_mesh *out, lux_error *err)
{
    on_border *border = arena_array(c->scratch, on_border, c->corner_count, err);
    size_t triangles  = 0;
    for (size_t i = 0; border && i < c->piece_count; i++)
        triangles += find_border(c, &c->pieces[i], border);
    if (!border)
        return false;
    *out = (room_mesh){ .positions = arena_array(a, dvec3, c->corner_count + c->piece_count, err),
                        .corners   = arena_array(a, uint32_t, 3 * triangles, err),
                        .material  = arena_array(a, uint32_t, triangles, err) };
    if (!out->positions || !out->corners || !out->material)
        return false;
    for (size_t i = 0; i < c->corner_count; i++)
        out->positions[out->position_count++] = c->corners[i];
    for (size_t i = 0; i < c->piece_count; i++)
        add_piece(out, &c->pieces[i], border, find_border(c, &c->pieces[i], border));
    return true;
}

static bool make_bare(arena *a, const study_room *r, room_mesh *out, lux_error *err)
{
    *out = (room_mesh){ .positions      = arena_array(a, dvec3, ROOM_POSITIONS, err),
                        .corners        = arena_array(a, uint32_t, 3 * ROOM_TRIANGLES, err),
                        .material       = arena_array(a, uint32_t, ROOM_TRIANGLES, err),
                        .position_count = ROOM_POSITIONS,
                        .triangle_count = ROOM_TRIANGLES };
    if (!out->positions || !out->corners || !out->material)
        return false;
    room_box(r->size, out->positions, out->corners, out->material);
    return true;
}

bool room_make(arena *a, const study_room *r, room_mesh *out, lux_error *err)
{
    arena scratch = { 0 };
    cutting c     = { .scratch = &scratch, .room = r };
    if (r->window_count == 0)
        return make_bare(a, r, out, err);
    bool made = cut(&c, err) && find_corners(&c, err) && make(&c, a, out, err);
    arena_clear(&scratch);
    return made;
}
