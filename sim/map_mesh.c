/* sim/map_mesh.c -- see map_parts.h: smooth pieces of a mesh, and the order of their triangles.
 *
 * Two triangles that share an edge are of one piece if they are of one material and their normals
 * are at most 20 degrees apart. Corners at the same place are the same. Triangles of a piece are in
 * the order of a Morton curve through their middles: of each range of them, halves at the curve's
 * largest step lie side by side.
 */
#include "sim/map_parts.h"

#include <stdlib.h>
#include <string.h>

static const double crease_cosine = 0.9396926207859084; /* of 20 degrees */

typedef struct corner_place {
    float p[3];
    uint32_t corner;
} corner_place;

typedef struct mesh_edge {
    uint32_t low, high; /* its ends */
    int32_t triangle;
} mesh_edge;

typedef struct ranked {
    int32_t piece, triangle;
    uint64_t code;
} ranked;

static int compare_places(const void *a, const void *b)
{
    const corner_place *p = a, *q = b;
    for (int k = 0; k < 3; k++)
        if (p->p[k] != q->p[k])
            return p->p[k] < q->p[k] ? -1 : 1;
    return 0;
}

static int compare_edges(const void *a, const void *b)
{
    const mesh_edge *e = a, *f = b;
    if (e->low != f->low)
        return e->low < f->low ? -1 : 1;
    if (e->high != f->high)
        return e->high < f->high ? -1 : 1;
    return e->triangle < f->triangle ? -1 : e->triangle > f->triangle;
}

static int compare_ranked(const void *a, const void *b)
{
    const ranked *r = a, *q = b;
    if (r->piece != q->piece)
        return r->piece < q->piece ? -1 : 1;
    if (r->code != q->code)
        return r->code < q->code ? -1 : 1;
    return r->triangle < q->triangle ? -1 : r->triangle > q->triangle;
}

/* ---- pieces ---------------------------------------------------------------------------------- */

static int32_t find(int32_t *parent, int32_t t)
{
    while (parent[t] != t)
        t = parent[t] = parent[parent[t]];
    return t;
}

/* The same number for corners at the same place. */
static uint32_t *join_corners(arena *scratch, const world *w, int32_t instance, lux_error *err)
{
    size_t n            = 3 * (size_t)world_triangles(w, instance);
    corner_place *place = arena_array(scratch, corner_place, n, err);
    uint32_t *id        = arena_array(scratch, uint32_t, n, err);
    if (!place || !id)
        return NULL;
    for (size_t i = 0; i < n; i++) {
        dvec3 c[3];
        world_triangle(w, instance, (int32_t)(i / 3), c);
        vec3 p   = d3_to_float(c[i % 3]);
        place[i] = (corner_place){ { p.x, p.y, p.z }, (uint32_t)i };
    }
    if (n > 0)
        qsort(place, n, sizeof *place, compare_places);
    for (size_t i = 0; i < n; i++) {
        bool same           = i > 0 && compare_places(&place[i - 1], &place[i]) == 0;
        id[place[i].corner] = same ? id[place[i - 1].corner] : place[i].corner;
    }
    return id;
}

static dvec3 normal_of(const dvec3 c[3])
{
    dvec3 n       = d3_cross(d3_sub(c[1], c[0]), d3_sub(c[2], c[0]));
    double length = d3_length(n);
    return length > 0.0 ? d3_scale(n, 1.0 / length) : (dvec3){ 0, 0, 0 };
}

static bool goes_on(const world *w, int32_t instance, int32_t t, int32_t other)
{
    dvec3 a[3], b[3];
    uint32_t made_of = world_triangle(w, instance, t, a);
    return world_triangle(w, instance, other, b) == made_of &&
           d3_dot(normal_of(a), normal_of(b)) >= crease_cosine;
}

static bool join_triangles(arena *scratch, const world *w, int32_t instance, int32_t *parent,
                           lux_error *err)
{
    size_t n        = 3 * (size_t)world_triangles(w, instance);
    uint32_t *id    = join_corners(scratch, w, instance, err);
    mesh_edge *edge = id ? arena_array(scratch, mesh_edge, n, err) : NULL;
    if (!edge)
        return false;
    for (size_t i = 0; i < n; i++) {
        uint32_t p = id[i], q = id[i % 3 == 2 ? i - 2 : i + 1];
        edge[i] = (mesh_edge){ p < q ? p : q, p < q ? q : p, (int32_t)(i / 3) };
    }
    if (n > 0)
        qsort(edge, n, sizeof *edge, compare_edges);
    for (size_t i = 0; i < n; i++) /* more than two may share an edge: each with each */
        for (size_t j = i + 1; j < n && j < i + 4; j++) {
            if (edge[j].low != edge[i].low || edge[j].high != edge[i].high)
                break;
            if (goes_on(w, instance, edge[i].triangle, edge[j].triangle)) {
                int32_t a = find(parent, edge[i].triangle), b = find(parent, edge[j].triangle);
                parent[a > b ? a : b] = a > b ? b : a;
            }
        }
    return true;
}

/* ---- their order ----------------------------------------------------------------------------- */

/* Every third bit. */
static uint64_t spread_bits(uint64_t a)
{
    a &= 0x1fffff;
    a = (a | a << 32) & 0x001f00000000ffff;
    a = (a | a << 16) & 0x001f0000ff0000ff;
    a = (a | a << 8) & 0x100f00f00f00f00f;
    a = (a | a << 4) & 0x10c30c30c30c30c3;
    return (a | a << 2) & 0x1249249249249249;
}

static uint64_t code_of(const dvec3 c[3], dvec3 low, double scale)
{
    dvec3 middle = d3_scale(d3_add(c[0], d3_add(c[1], c[2])), 1.0 / 3.0);
    dvec3 at     = d3_scale(d3_sub(middle, low), scale);
    return spread_bits((uint64_t)at.x) << 2 | spread_bits((uint64_t)at.y) << 1 |
           spread_bits((uint64_t)at.z);
}

static void put_in_order(const world *w, int32_t instance, const int32_t *parent, ranked *to)
{
    int32_t n = world_triangles(w, instance);
    dvec3 low = { HUGE_VAL, HUGE_VAL, HUGE_VAL }, high = { -HUGE_VAL, -HUGE_VAL, -HUGE_VAL };
    dvec3 c[3];
    for (int32_t t = 0; t < n; t++) {
        world_triangle(w, instance, t, c);
        for (int k = 0; k < 3; k++) {
            low  = (dvec3){ fmin(low.x, c[k].x), fmin(low.y, c[k].y), fmin(low.z, c[k].z) };
            high = (dvec3){ fmax(high.x, c[k].x), fmax(high.y, c[k].y), fmax(high.z, c[k].z) };
        }
    }
    double most  = fmax(high.x - low.x, fmax(high.y - low.y, high.z - low.z));
    double scale = most > 0.0 ? 0x1fffff / most : 0.0;
    for (int32_t t = 0; t < n; t++) {
        world_triangle(w, instance, t, c);
        to[t] = (ranked){ parent[t], t, code_of(c, low, scale) };
    }
    qsort(to, (size_t)n, sizeof *to, compare_ranked);
}

/* Numbers pieces by the least of their triangles. */
static bool number_pieces(arena *a, const ranked *in_order, int32_t n, map_mesh *out,
                          lux_error *err)
{
    int32_t *piece = arena_array(a, int32_t, (size_t)n, err);
    int32_t *rank  = arena_array(a, int32_t, (size_t)n, err);
    int32_t *order = arena_array(a, int32_t, (size_t)n, err);
    uint64_t *code = arena_array(a, uint64_t, (size_t)n, err);
    int32_t *first = arena_array(a, int32_t, (size_t)n + 1, err);
    if (!piece || !rank || !order || !code || !first)
        return false;
    int32_t pieces = 0;
    for (int32_t r = 0; r < n; r++) {
        const ranked *at = &in_order[r];
        if (r == 0 || at->piece != in_order[r - 1].piece)
            first[pieces++] = r;
        piece[at->triangle] = pieces - 1;
        rank[at->triangle]  = r;
        order[r]            = at->triangle;
        code[r]             = at->code;
    }
    first[pieces] = n;
    *out          = (map_mesh){ n, pieces, piece, rank, first, order, code };
    return true;
}

bool map_mesh_new(arena *a, const world *w, int32_t instance, map_mesh *out, lux_error *err)
{
    arena scratch    = { 0 };
    int32_t n        = world_triangles(w, instance);
    int32_t *parent  = arena_array(&scratch, int32_t, (size_t)n, err);
    ranked *in_order = parent ? arena_array(&scratch, ranked, (size_t)n, err) : NULL;
    bool done        = in_order != NULL;
    for (int32_t t = 0; done && t < n; t++)
        parent[t] = t;
    done = done && join_triangles(&scratch, w, instance, parent, err);
    for (int32_t t = 0; done && t < n; t++)
        parent[t] = find(parent, t);
    if (done) {
        put_in_order(w, instance, parent, in_order);
        done = number_pieces(a, in_order, n, out, err);
    }
    arena_clear(&scratch);
    return done;
}

bool map_meshes_new(arena *a, const scene *s, map_cells *out, lux_error *err)
{
    const world *w = s->world;
    uint32_t count = 0;
    int32_t placed = world_instances(w);
    for (int32_t i = 0; i < placed; i++)
        count = world_mesh(w, i) >= count ? world_mesh(w, i) + 1 : count;
    map_mesh *meshes = arena_array(a, map_mesh, (size_t)count + 1, err);
    if (!meshes)
        return false;
    for (int32_t i = 0; i < placed; i++) {
        map_mesh *m = &meshes[world_mesh(w, i)];
        if (!m->piece && !map_mesh_new(a, w, i, m, err))
            return false;
    }
    out->meshes     = meshes;
    out->mesh_count = count;
    return true;
}
