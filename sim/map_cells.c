/* sim/map_cells.c -- see map_parts.h: trees of cells, grown where pilot particles came.
 *
 * A cell is divided while it can expect more particles than one needs, and on while its halves
 * differ by more than their noise; then while something stands on it. Irradiance of a cell E = S/A
 * with S the sum of its pilots' flux w has the variance of about sum w^2 / A^2.
 */
#include "sim/map_parts.h"

#include "core/sampler.h"

#include <stdlib.h>
#include <string.h>

static const double differ_sigmas = 3.0;
static const double fewest        = 8.0;  /* particles to come: a cell of fewer is not divided */
static const double few_that_tell = 12.0; /* pilots of a half: of fewer, noise is not known */
static const double walled_size   = 0.02; /* m: cells under walls are divided so far, */
static const double walled_share  = 1.0 / 64.0; /* or to this share of the piece's width */
static const double least_size    = 1e-3;       /* m: no cell is divided below */

typedef struct part {
    map_part of;
    int32_t node;
    size_t from, to; /* its marks */
} part;

typedef struct grower {
    const map_growth *g;
    map_list nodes;
    map_ground on;
    double walled_size; /* m */
} grower;

/* ---- growing -----------------------------------------------------------------------------------
 */

/* The half that a place is in; its weights become those of that half's corners. */
static int descend(float w[3], int edge)
{
    int i = edge, j = (edge + 1) % 3;
    if (w[i] >= w[j]) {
        w[i] = w[i] - w[j];
        w[j] = 2.0f * w[j];
        return 0;
    }
    w[j] = w[j] - w[i];
    w[i] = 2.0f * w[i];
    return 1;
}

static map_node *node_at(grower *w, int32_t node) { return (map_node *)w->nodes.items + node; }

static int32_t add_node(grower *w, int32_t parent)
{
    map_node *n = map_list_add(&w->nodes);
    if (!n)
        return -1;
    *n = (map_node){ .parent = parent };
    return (int32_t)w->nodes.count - 1;
}

/* The first rank of the second half, at the curve's largest step. */
static int32_t split_rank(const map_mesh *m, int32_t low, int32_t high)
{
    uint64_t first = m->code[low], last = m->code[high - 1];
    if (first == last)
        return low + (high - low) / 2;
    uint64_t step = UINT64_C(1) << (63 - __builtin_clzll(first ^ last));
    int32_t l = low, h = high - 1; /* l is below the step, h is not */
    while (h - l > 1) {
        int32_t mid = l + (h - l) / 2;
        if ((m->code[mid] ^ first) & step)
            h = mid;
        else
            l = mid;
    }
    return h;
}

/* Which half a mark is in, and there. */
static int half_of(const grower *w, const part *p, int32_t split, const map_mark *mark, float to[3])
{
    to[0] = 1.0f - mark->u - mark->v, to[1] = mark->u, to[2] = mark->v;
    if (p->of.single)
        return descend(to, ~split);
    return w->on.mesh->rank[mark->triangle] >= split;
}

/* The halves of p; the marks of the first come first. */
static void divide(grower *w, const part *p, int32_t split, part half[2])
{
    map_mark *marks = w->g->marks;
    size_t next     = p->from;
    for (size_t i = p->from; i < p->to; i++) {
        float to[3];
        int second    = half_of(w, p, split, &marks[i], to);
        map_mark mark = marks[i];
        if (p->of.single)
            mark.u = to[1], mark.v = to[2];
        marks[i] = mark;
        if (!second) {
            marks[i]      = marks[next];
            marks[next++] = mark;
        }
    }
    for (int k = 0; k < 2; k++) {
        half[k]      = *p;
        half[k].from = k ? next : p->from;
        half[k].to   = k ? p->to : next;
        if (p->of.single) {
            map_halve(half[k].of.corner, ~split, k);
            continue;
        }
        half[k].of.low    = k ? split : p->of.low;
        half[k].of.high   = k ? p->of.high : split;
        half[k].of.single = half[k].of.high - half[k].of.low == 1;
        if (half[k].of.single)
            map_triangle_at(&w->on, half[k].of.low, half[k].of.corner);
    }
}

/* Whether the light of both halves differs by more than chance. */
static bool light_differs(grower *w, const part *p, int32_t split)
{
    double sum[2] = { 0, 0 }, square[2] = { 0, 0 };
    size_t count[2] = { 0, 0 };
    for (size_t i = p->from; i < p->to; i++) {
        float to[3];
        double weight = (double)w->g->marks[i].weight;
        int k         = half_of(w, p, split, &w->g->marks[i], to);
        sum[k] += weight;
        square[k] += weight * weight;
        count[k]++;
    }
    if ((double)(count[0] + count[1]) < 2.0 * few_that_tell)
        return false;
    double whole    = node_at(w, p->node)->area;
    double share[2] = { 0.5, 0.5 };
    if (!p->of.single) {
        map_part first = p->of;
        first.high     = split;
        share[0]       = map_part_area(&w->on, &first) / whole;
        share[1]       = 1.0 - share[0];
    }
    if (!(share[0] > 0.0 && share[1] > 0.0))
        return false;
    double off   = sum[0] / share[0] - sum[1] / share[1];
    double noise = square[0] / (share[0] * share[0]) + square[1] / (share[1] * share[1]);
    return off * off > differ_sigmas * differ_sigmas * noise;
}

typedef enum verdict { VERDICT_LEAF, VERDICT_DIVIDE, VERDICT_NO_VALUE } verdict;

static verdict judge(grower *w, const part *p, int32_t split)
{
    double size     = map_part_size(&w->on, &p->of);
    double expected = w->g->scale * (double)(p->to - p->from);
    bool can =
        expected >= fewest && (!p->of.single || size > least_size) && w->nodes.count < w->g->most;
    if (can &&
        (expected > w->g->least || (expected > 0.25 * w->g->least && light_differs(w, p, split))))
        return VERDICT_DIVIDE;

    map_outline o;
    bool flat = map_part_normal(&w->on, &p->of, &o.normal);
    if (!flat)
        return can ? VERDICT_DIVIDE : VERDICT_NO_VALUE;
    map_part_outline(&w->on, &p->of, size, &o);
    if (!map_is_walled(w->g->s, &o))
        return VERDICT_LEAF;
    return can && size > w->walled_size ? VERDICT_DIVIDE : VERDICT_NO_VALUE;
}

static bool grow(grower *w, const part *p)
{
    double longest;
    int32_t split             = p->of.single ? ~(int32_t)map_longest_edge(p->of.corner, &longest)
                                             : split_rank(w->on.mesh, p->of.low, p->of.high);
    node_at(w, p->node)->area = map_part_area(&w->on, &p->of);
    verdict v                 = judge(w, p, split);
    if (v != VERDICT_DIVIDE) {
        node_at(w, p->node)->walled = v == VERDICT_NO_VALUE ? NODE_WALLED : NODE_FREE;
        return true;
    }
    part half[2];
    divide(w, p, split, half);
    half[0].node = add_node(w, p->node);
    half[1].node = add_node(w, p->node);
    if (half[0].node < 0 || half[1].node < 0)
        return false;
    node_at(w, p->node)->child = half[0].node;
    node_at(w, p->node)->split = split;
    if (!grow(w, &half[0]) || !grow(w, &half[1]))
        return false;
    int32_t walled = node_at(w, half[0].node)->walled | node_at(w, half[1].node)->walled;
    node_at(w, p->node)->walled = walled;
    return true;
}

/* ---- sheets ---------------------------------------------------------------------------------- */

static uint32_t slot_of(const map_cells *c, int32_t instance, int32_t piece, int32_t front)
{
    uint32_t h =
        hash_combine_u32(hash_combine_u32((uint32_t)instance, (uint32_t)piece), (uint32_t)front);
    uint32_t i = h & (c->sheet_room - 1);
    for (;; i = (i + 1) & (c->sheet_room - 1)) {
        const map_sheet *at = &c->sheets[i];
        if (at->root < 0 || (at->instance == instance && at->piece == piece && at->front == front))
            return i;
    }
}

/* The sheet of a mark, all of it. */
static map_part find_sheet(const scene *s, const map_cells *c, const map_mark *mark, map_ground *on)
{
    on->world    = s->world;
    on->instance = mark->instance;
    on->front    = mark->front != 0;
    on->mesh     = &c->meshes[world_mesh(s->world, mark->instance)];
    on->place    = world_place(s->world, mark->instance);
    on->mirrors  = transform_determinant(&on->place) < 0.0;
    map_part p = { .low = on->mesh->first[mark->piece], .high = on->mesh->first[mark->piece + 1] };
    p.single   = p.high - p.low == 1;
    if (p.single)
        map_triangle_at(on, p.low, p.corner);
    return p;
}

static bool grow_sheet(grower *w, const map_cells *c, size_t from, size_t to)
{
    const map_mark *mark = &w->g->marks[from];
    part p               = { find_sheet(w->g->s, c, mark, &w->on), .from = from, .to = to };
    double width         = map_part_area(&w->on, &p.of) / map_part_size(&w->on, &p.of);
    w->walled_size       = fmax(fmin(walled_size, walled_share * width), least_size);
    p.node               = add_node(w, -1);
    if (p.node < 0)
        return false;
    c->sheets[slot_of(c, mark->instance, mark->piece, mark->front)] =
        (map_sheet){ mark->instance, mark->piece, mark->front, p.node };
    return grow(w, &p);
}

static int compare_marks(const void *a, const void *b)
{
    const map_mark *p = a, *q = b;
    if (p->instance != q->instance)
        return p->instance < q->instance ? -1 : 1;
    if (p->piece != q->piece)
        return p->piece < q->piece ? -1 : 1;
    if (p->front != q->front)
        return p->front < q->front ? -1 : 1;
    if (p->triangle != q->triangle)
        return p->triangle < q->triangle ? -1 : 1;
    if (p->u != q->u)
        return p->u < q->u ? -1 : 1;
    if (p->v != q->v)
        return p->v < q->v ? -1 : 1;
    return p->weight < q->weight ? -1 : p->weight > q->weight;
}

/* The end of the marks of one sheet. */
static size_t end_of_sheet(const map_growth *g, size_t from)
{
    const map_mark *m = g->marks;
    size_t to         = from + 1;
    while (to < g->mark_count && m[to].instance == m[from].instance &&
           m[to].piece == m[from].piece && m[to].front == m[from].front)
        to++;
    return to;
}

static bool make_table(arena *a, const map_growth *g, map_cells *c, lux_error *err)
{
    size_t sheets = 0;
    for (size_t from = 0; from < g->mark_count; from = end_of_sheet(g, from))
        sheets++;
    uint32_t room = 2;
    while (room < 2 * sheets)
        room *= 2;
    c->sheets = arena_array(a, map_sheet, room, err);
    if (!c->sheets)
        return false;
    c->sheet_room = room;
    for (uint32_t i = 0; i < room; i++)
        c->sheets[i].root = -1;
    return true;
}

/* How far off coordinates of the scene are, m. */
static double rounding_of(const scene *s)
{
    vec3 low, high;
    world_bounds(s->world, &low, &high);
    float most =
        fmaxf(fmaxf(fabsf(low.x), fabsf(high.x)),
              fmaxf(fmaxf(fabsf(low.y), fabsf(high.y)), fmaxf(fabsf(low.z), fabsf(high.z))));
    return 16.0 * 0x1p-24 * fmax((double)most, 0x1p-6);
}

static void sort_marks(const map_growth *g, const map_cells *c)
{
    for (size_t i = 0; i < g->mark_count; i++) {
        map_mark *m = &g->marks[i];
        m->piece    = c->meshes[world_mesh(g->s->world, m->instance)].piece[m->triangle];
    }
    if (g->mark_count > 0)
        qsort(g->marks, g->mark_count, sizeof *g->marks, compare_marks);
}

double map_lit_area(const map_growth *g, const map_cells *c)
{
    sort_marks(g, c);
    double flux = 0.0, flux2 = 0.0;
    for (size_t from = 0, to; from < g->mark_count; from = to) {
        map_ground on = { 0 };
        map_part p    = find_sheet(g->s, c, &g->marks[from], &on);
        double sum = 0.0, area = map_part_area(&on, &p);
        to = end_of_sheet(g, from);
        for (size_t i = from; i < to; i++)
            sum += (double)g->marks[i].weight;
        flux += sum;
        flux2 += area > 0.0 ? sum * sum / area : 0.0;
    }
    return flux2 > 0.0 ? flux * flux / flux2 : 0.0;
}

bool map_cells_grow(arena *a, const map_growth *g, map_cells *c, lux_error *err)
{
    sort_marks(g, c);
    if (!make_table(a, g, c, err))
        return false;
    grower w  = { .g     = g,
                  .nodes = { .size = sizeof(map_node) },
                  .on    = { .rounding = rounding_of(g->s) } };
    bool done = true;
    for (size_t from = 0, to; done && from < g->mark_count; from = to) {
        to = end_of_sheet(g, from);
        if (g->scale * (double)(to - from) >= g->fewest)
            done = grow_sheet(&w, c, from, to);
    }
    c->node_count = (int32_t)w.nodes.count;
    c->nodes      = done ? arena_array(a, map_node, w.nodes.count + 1, err) : NULL;
    if (!done)
        failed(err, ERR_MEMORY, "illumination maps: no memory for cells");
    if (c->nodes && w.nodes.count > 0)
        memcpy(c->nodes, w.nodes.items, w.nodes.count * sizeof *c->nodes);
    map_list_free(&w.nodes);
    return c->nodes != NULL;
}

int32_t map_cells_find(const map_cells *c, uint32_t placed, const map_mark *at)
{
    const map_mesh *m = &c->meshes[placed];
    uint32_t slot     = slot_of(c, at->instance, m->piece[at->triangle], at->front);
    int32_t node      = c->sheets[slot].root;
    if (node < 0)
        return -1;
    int32_t rank = m->rank[at->triangle];
    float u = at->u, v = at->v;
    while (c->nodes[node].child) {
        const map_node *n = &c->nodes[node];
        int half          = rank >= n->split;
        if (n->split < 0) {
            float w[3] = { 1.0f - u - v, u, v };
            half       = descend(w, ~n->split);
            u = w[1], v = w[2];
        }
        node = n->child + half;
    }
    return c->nodes[node].walled ? -1 : node;
}
