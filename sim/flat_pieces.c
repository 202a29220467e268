/* sim/flat_pieces.c -- see flat_pieces.h. */
#include "sim/flat_pieces.h"

#include <stdlib.h>
#include <string.h>

static const double parallel = 0.99996; /* cosine of half a degree */

enum { MOST_TURNS = 48 }; /* edges that a rectangle is tried along */

typedef struct corner {
    dvec3 at;
    uint32_t of; /* 3 * triangle + which */
} corner;

typedef struct edge {
    uint32_t low, high, triangle; /* places */
} edge;

typedef struct piece_work {
    arena *scratch;
    const dvec3 *corners;
    const uint32_t *tags;
    uint32_t count;
    uint32_t *place_of; /* of each corner: equal for equal places */
    uint32_t *parent;   /* of each triangle: union and find */
    uint32_t *order;    /* triangles by their piece */
    dvec3 *normal;      /* of each triangle, as long as twice its area */
} piece_work;

/* ---- what hangs together --------------------------------------------------------------------- */

static int by_number(double a, double b) { return (a > b) - (a < b); }

static int by_place(const void *one, const void *other)
{
    const corner *a = one, *b = other;
    int x = by_number(a->at.x, b->at.x), y = by_number(a->at.y, b->at.y);
    int z = by_number(a->at.z, b->at.z);
    return x ? x : y ? y : z ? z : (a->of > b->of) - (a->of < b->of);
}

static bool same_place(dvec3 a, dvec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

static bool find_places(piece_work *w, lux_error *err)
{
    size_t n    = 3 * (size_t)w->count;
    corner *all = arena_array(w->scratch, corner, n, err);
    w->place_of = arena_array(w->scratch, uint32_t, n, err);
    if (!all || !w->place_of)
        return false;
    for (size_t i = 0; i < n; i++)
        all[i] = (corner){ w->corners[i], (uint32_t)i };
    qsort(all, n, sizeof *all, by_place);
    uint32_t place = 0;
    for (size_t i = 0; i < n; i++) {
        place += i > 0 && !same_place(all[i].at, all[i - 1].at);
        w->place_of[all[i].of] = place;
    }
    return true;
}

static int by_ends(const void *one, const void *other)
{
    const edge *a = one, *b = other;
    if (a->low != b->low)
        return a->low < b->low ? -1 : 1;
    if (a->high != b->high)
        return a->high < b->high ? -1 : 1;
    return (a->triangle > b->triangle) - (a->triangle < b->triangle);
}

static uint32_t find(uint32_t *parent, uint32_t t)
{
    while (parent[t] != t)
        t = parent[t] = parent[parent[t]];
    return t;
}

static bool lie_in_one_plane(const piece_work *w, uint32_t a, uint32_t b)
{
    double lengths = d3_length(w->normal[a]) * d3_length(w->normal[b]);
    return w->tags[a] == w->tags[b] && lengths > 0.0 &&
           fabs(d3_dot(w->normal[a], w->normal[b])) > parallel * lengths;
}

static void join(piece_work *w, uint32_t a, uint32_t b)
{
    uint32_t one = find(w->parent, a), other = find(w->parent, b);
    if (lie_in_one_plane(w, a, b)) /* the lower one stays: the order of joins tells nothing */
        w->parent[one > other ? one : other] = one < other ? one : other;
}

static bool join_all(piece_work *w, lux_error *err)
{
    const size_t few = 8; /* at one edge: more are no window */
    size_t n         = 3 * (size_t)w->count;
    edge *all        = arena_array(w->scratch, edge, n, err);
    w->parent        = arena_array(w->scratch, uint32_t, w->count, err);
    if (!all || !w->parent)
        return false;
    for (uint32_t t = 0; t < w->count; t++)
        w->parent[t] = t;
    for (size_t i = 0; i < n; i++) {
        uint32_t a = w->place_of[i], b = w->place_of[i % 3 == 2 ? i - 2 : i + 1];
        all[i] = (edge){ a < b ? a : b, a < b ? b : a, (uint32_t)(i / 3) };
    }
    qsort(all, n, sizeof *all, by_ends);
    for (size_t i = 0; i < n; i++)
        for (size_t k = i; k-- > 0 && i - k <= few;) {
            if (all[k].low != all[i].low || all[k].high != all[i].high)
                break;
            join(w, all[k].triangle, all[i].triangle);
        }
    return true;
}

/* Triangles sorted by their piece: counted, then put in. */
static bool sort_by_piece(piece_work *w, lux_error *err)
{
    uint32_t *first = arena_array(w->scratch, uint32_t, (size_t)w->count + 1, err);
    w->order        = arena_array(w->scratch, uint32_t, w->count, err);
    if (!first || !w->order)
        return false;
    for (uint32_t t = 0; t < w->count; t++)
        first[find(w->parent, t) + 1]++;
    for (uint32_t t = 0; t < w->count; t++)
        first[t + 1] += first[t];
    for (uint32_t t = 0; t < w->count; t++)
        w->order[first[find(w->parent, t)]++] = t;
    return true;
}

/* ---- the rectangle around a piece ------------------------------------------------------------ */

typedef struct extent {
    double low, high;
} extent;

static extent extent_along(const piece_work *w, const uint32_t *triangles, uint32_t count, dvec3 d)
{
    extent e = { HUGE_VAL, -HUGE_VAL };
    for (uint32_t i = 0; i < 3 * count; i++) {
        double x = d3_dot(w->corners[3 * (size_t)triangles[i / 3] + i % 3], d);
        e        = (extent){ fmin(e.low, x), fmax(e.high, x) };
    }
    return e;
}

/* Along d, of unit length in the plane of n. */
static flat_piece rectangle(const piece_work *w, const uint32_t *triangles, uint32_t count, dvec3 n,
                            dvec3 d)
{
    dvec3 side = d3_cross(n, d);
    extent a   = extent_along(w, triangles, count, d);
    extent b   = extent_along(w, triangles, count, side);
    extent c   = extent_along(w, triangles, count, n);
    dvec3 mid = d3_add(d3_scale(d, 0.5 * (a.low + a.high)), d3_scale(side, 0.5 * (b.low + b.high)));
    return (flat_piece){ .centre = d3_add(mid, d3_scale(n, 0.5 * (c.low + c.high))),
                         .u      = d3_scale(d, 0.5 * (a.high - a.low)),
                         .v      = d3_scale(side, 0.5 * (b.high - b.low)),
                         .normal = n,
                         .tag    = w->tags[triangles[0]] };
}

/* The mean normal of a piece, as long as twice its area; to the side of its first triangle's. */
static dvec3 normal_of(const piece_work *w, const uint32_t *triangles, uint32_t count)
{
    dvec3 sum = { 0, 0, 0 };
    for (uint32_t i = 0; i < count; i++) {
        dvec3 n = w->normal[triangles[i]];
        sum     = d3_dot(n, w->normal[triangles[0]]) < 0.0 ? d3_sub(sum, n) : d3_add(sum, n);
    }
    return sum;
}

static bool piece_of(const piece_work *w, const uint32_t *triangles, uint32_t count,
                     flat_piece *out)
{
    dvec3 n       = normal_of(w, triangles, count);
    double twice  = d3_length(n);
    bool found    = false;
    uint32_t step = 3 * count / MOST_TURNS + 1;
    if (!(twice > 0.0 && isfinite(twice)))
        return false;
    n = d3_scale(n, 1.0 / twice);
    for (uint32_t i = 0; i < 3 * count; i += step) {
        const dvec3 *p = &w->corners[3 * (size_t)triangles[i / 3]];
        dvec3 d        = d3_sub(p[(i + 1) % 3], p[i % 3]);
        d              = d3_sub(d, d3_scale(n, d3_dot(d, n)));
        if (!(d3_length(d) > 0.0))
            continue;
        flat_piece r = rectangle(w, triangles, count, n, d3_scale(d, 1.0 / d3_length(d)));
        if (!found || flat_piece_face(&r) < flat_piece_face(out))
            *out = r;
        found = true;
    }
    out->area = 0.5 * twice;
    return found && flat_piece_face(out) > 0.0;
}

static int by_face(const void *one, const void *other)
{
    const flat_piece *a = one, *b = other;
    int face = by_number(flat_piece_face(b), flat_piece_face(a));
    int x = by_number(a->centre.x, b->centre.x), y = by_number(a->centre.y, b->centre.y);
    int z = by_number(a->centre.z, b->centre.z);
    return face ? face : x ? x : y ? y : z ? z : (a->tag > b->tag) - (a->tag < b->tag);
}

static bool find_pieces(piece_work *w, arena *a, flat_piece **out, uint32_t *count, lux_error *err)
{
    w->normal = arena_array(w->scratch, dvec3, w->count, err);
    if (!w->normal || !find_places(w, err))
        return false;
    for (uint32_t t = 0; t < w->count; t++) {
        const dvec3 *p = &w->corners[3 * (size_t)t];
        w->normal[t]   = d3_cross(d3_sub(p[1], p[0]), d3_sub(p[2], p[0]));
    }
    if (!join_all(w, err) || !sort_by_piece(w, err))
        return false;
    *out = arena_array(a, flat_piece, w->count, err);
    for (uint32_t i = 0, end; *out && i < w->count; i = end) {
        end = i + 1;
        while (end < w->count && find(w->parent, w->order[end]) == find(w->parent, w->order[i]))
            end++;
        *count += piece_of(w, w->order + i, end - i, &(*out)[*count]);
    }
    if (*out)
        qsort(*out, *count, sizeof **out, by_face);
    return *out != NULL;
}

bool flat_pieces_of(arena *a, const dvec3 *corners, const uint32_t *tags, uint32_t triangle_count,
                    flat_piece **out, uint32_t *count, lux_error *err)
{
    arena scratch = { 0 };
    piece_work w  = {
         .scratch = &scratch, .corners = corners, .tags = tags, .count = triangle_count
    };
    *count    = 0;
    bool good = find_pieces(&w, a, out, count, err);
    arena_clear(&scratch);
    return good;
}
