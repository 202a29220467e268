/* sim/scene_glass.c -- whether panes are modelled as one surface, or as closed plates of glass.
 *
 * Surfaces hang together at an edge that exactly two triangles of a material share, one running it
 * to and the other fro; corners at the same place are one. A body all of whose edges are such is
 * closed, and
 *
 *     V = 1/6 |sum of a . (b x c)|,   A = 1/2 sum of |(b - a) x (c - a)|      [m^3, m^2]
 *
 * say what it is: a plate is 2 V / A thick, little against its size. Bottles and bulbs are no
 * plates: their walls are panes, one on each side of what is within.
 */
#include "sim/scene_build.h"

#include <stdlib.h>
#include <string.h>

static const double thickest = 0.1;  /* of a plate, by its longest extent */
static const double thinnest = 1e-7; /* the same: what has less encloses nothing */

typedef struct corner {
    vec3 at;
    uint32_t vertex;
} corner;

typedef struct edge {
    uint32_t made_of, low, high; /* material, places */
    uint32_t triangle;
    bool up; /* runs from low to high */
} edge;

typedef struct body {
    double volume, area; /* six times, and twice */
    dvec3 from, to;      /* m, its box */
    bool open;
} body;

/* One mesh, those of its triangles that may be panes. */
typedef struct plate_work {
    const mesh *m;
    const transform *place;
    uint32_t *place_of; /* of each vertex: the number of its place */
    uint32_t *chosen, count;
    uint32_t *parent; /* of the chosen: union and find */
    body *bodies;     /* of the chosen, at those that are their own parents */
} plate_work;

static uint32_t material_of(const mesh *m, uint32_t t) { return m->material ? m->material[t] : 0; }

/* ---- places ---------------------------------------------------------------------------------- */

static int by_place(const void *one, const void *other)
{
    const corner *a = one, *b = other;
    const float p[3] = { a->at.x, a->at.y, a->at.z }, q[3] = { b->at.x, b->at.y, b->at.z };
    for (int c = 0; c < 3; c++)
        if (p[c] != q[c])
            return p[c] < q[c] ? -1 : 1;
    return a->vertex < b->vertex ? -1 : a->vertex > b->vertex;
}

static bool number_places(plate_work *w, arena *a, lux_error *err)
{
    uint32_t n      = w->m->position_count;
    corner *corners = arena_array(a, corner, (size_t)n + 1, err);
    w->place_of     = arena_array(a, uint32_t, (size_t)n + 1, err);
    if (!corners || !w->place_of)
        return false;
    for (uint32_t v = 0; v < n; v++)
        corners[v] = (corner){ w->m->positions[v], v };
    qsort(corners, n, sizeof *corners, by_place);
    for (uint32_t i = 0; i < n; i++) {
        vec3 p = corners[i].at, q = corners[i ? i - 1 : 0].at;
        bool same                      = i > 0 && p.x == q.x && p.y == q.y && p.z == q.z;
        w->place_of[corners[i].vertex] = same ? w->place_of[corners[i - 1].vertex] : i;
    }
    return true;
}

/* ---- bodies ---------------------------------------------------------------------------------- */

static uint32_t root_of(plate_work *w, uint32_t i)
{
    while (w->parent[i] != i)
        i = w->parent[i] = w->parent[w->parent[i]];
    return i;
}

static int by_edge(const void *one, const void *other)
{
    const edge *a = one, *b = other;
    if (a->made_of != b->made_of)
        return a->made_of < b->made_of ? -1 : 1;
    if (a->low != b->low)
        return a->low < b->low ? -1 : 1;
    if (a->high != b->high)
        return a->high < b->high ? -1 : 1;
    return a->triangle < b->triangle ? -1 : a->triangle > b->triangle;
}

static bool is_same_edge(const edge *a, const edge *b)
{
    return a->made_of == b->made_of && a->low == b->low && a->high == b->high;
}

static edge *make_edges(const plate_work *w, arena *a, lux_error *err)
{
    edge *edges = arena_array(a, edge, 3 * (size_t)w->count + 1, err), *next = edges;
    for (uint32_t i = 0; edges && i < w->count; i++) {
        const uint32_t *c = &w->m->corners[3 * (size_t)w->chosen[i]];
        for (int k = 0; k < 3; k++) {
            uint32_t p = w->place_of[c[k]], q = w->place_of[c[(k + 1) % 3]];
            *next++ =
                (edge){ material_of(w->m, w->chosen[i]), p < q ? p : q, p < q ? q : p, i, p < q };
        }
    }
    if (edges)
        qsort(edges, 3 * (size_t)w->count, sizeof *edges, by_edge);
    return edges;
}

/* Joins what shares an edge, well or badly, then marks bodies that have a bad one. */
static void join_at_edges(plate_work *w, const edge *edges)
{
    size_t all = 3 * (size_t)w->count;
    for (size_t i = 1; i < all; i++)
        if (is_same_edge(&edges[i - 1], &edges[i]))
            w->parent[root_of(w, edges[i].triangle)] = root_of(w, edges[i - 1].triangle);
    for (size_t i = 0, same; i < all; i += same) {
        for (same = 1; i + same < all && is_same_edge(&edges[i], &edges[i + same]);)
            same++;
        bool good = same == 2 && edges[i].up != edges[i + 1].up;
        if (!good)
            w->bodies[root_of(w, edges[i].triangle)].open = true;
    }
}

static void measure(plate_work *w, uint32_t i)
{
    const uint32_t *c = &w->m->corners[3 * (size_t)w->chosen[i]];
    body *to          = &w->bodies[root_of(w, i)];
    dvec3 p[3];
    for (int k = 0; k < 3; k++) {
        p[k] = transform_point(w->place, d3_from(w->m->positions[c[k]]));
        if (to->area == 0.0 && k == 0)
            to->from = to->to = p[0];
        to->from =
            (dvec3){ fmin(to->from.x, p[k].x), fmin(to->from.y, p[k].y), fmin(to->from.z, p[k].z) };
        to->to = (dvec3){ fmax(to->to.x, p[k].x), fmax(to->to.y, p[k].y), fmax(to->to.z, p[k].z) };
    }
    /* From the body's own corner, so that what is far away loses no digits */
    const uint32_t *o = &w->m->corners[3 * (size_t)w->chosen[root_of(w, i)]];
    dvec3 from        = transform_point(w->place, d3_from(w->m->positions[o[0]]));
    dvec3 u = d3_sub(p[0], from), v = d3_sub(p[1], from), x = d3_sub(p[2], from);
    to->volume += d3_dot(u, d3_cross(v, x));
    to->area += d3_length(d3_cross(d3_sub(p[1], p[0]), d3_sub(p[2], p[0])));
}

static void count_body(const body *b, glass_shapes *to)
{
    dvec3 size     = d3_sub(b->to, b->from);
    double longest = fmax(size.x, fmax(size.y, size.z));
    double thick   = 2.0 * (fabs(b->volume) / 6.0) / (b->area / 2.0);
    if (b->open || !(thick > thinnest * longest))
        to->open++;
    else if (thick < thickest * longest)
        to->plates++;
    else
        to->bodies++;
}

/* ---- files ----------------------------------------------------------------------------------- */

static bool choose(plate_work *w, const bool *candidate, arena *a, lux_error *err)
{
    for (uint32_t t = 0; t < w->m->triangle_count; t++)
        w->count += candidate[material_of(w->m, t)];
    if (!w->count)
        return true;
    w->chosen = arena_array(a, uint32_t, w->count, err);
    w->parent = arena_array(a, uint32_t, w->count, err);
    w->bodies = arena_array(a, body, w->count, err);
    if (!w->chosen || !w->parent || !w->bodies)
        return false;
    uint32_t n = 0;
    for (uint32_t t = 0; t < w->m->triangle_count; t++)
        if (candidate[material_of(w->m, t)])
            w->chosen[n++] = t;
    for (uint32_t i = 0; i < n; i++)
        w->parent[i] = i;
    return number_places(w, a, err);
}

static bool look_at_mesh(const mesh *m, const transform *place, const bool *candidate,
                         glass_shapes *found, lux_error *err)
{
    arena scratch = { 0 };
    plate_work w  = { .m = m, .place = place };
    bool good     = choose(&w, candidate, &scratch, err);
    edge *edges   = good && w.count ? make_edges(&w, &scratch, err) : NULL;
    if (edges) {
        join_at_edges(&w, edges);
        for (uint32_t i = 0; i < w.count; i++)
            measure(&w, i);
        for (uint32_t i = 0; i < w.count; i++)
            if (w.parent[i] == i)
                count_body(&w.bodies[i], &found[material_of(m, w.chosen[i])]);
    }
    good = good && (edges || !w.count);
    arena_clear(&scratch);
    return good;
}

const glass_shapes *glass_shapes_of(scene_build *b, const gltf *g, const bool *candidate)
{
    glass_shapes *found = arena_array(b->a, glass_shapes, g->material_count, b->err);
    const transform **placed =
        arena_array(b->a, const transform *, (size_t)g->mesh_count + 1, b->err);
    if (!found || !placed)
        return NULL;
    for (uint32_t k = g->placement_count; k > 0; k--)
        placed[g->placements[k - 1].mesh] = &g->placements[k - 1].place;
    for (uint32_t m = 0; m < g->mesh_count; m++)
        if (placed[m] &&
            !look_at_mesh(&g->meshes[m].triangles, placed[m], candidate, found, b->err))
            return NULL;
    return found;
}
