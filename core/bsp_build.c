/* core/bsp_build.c -- see bsp.h.
 *
 * The upper cells are split one after the other until enough are left that each makes a small
 * part of the work; those are built side by side, and put together in the order in which they
 * were found. What is found does not depend on how many threads build it.
 */
#include "core/bsp.h"
#include "core/bsp_events.h"
#include "core/parallel.h"

#include <math.h>
#include <stdlib.h>

enum {
    SMALL_TREE  = 8192, /* things: not worth a second thread */
    SMALL_PARTS = 12,   /* a cell with a 12th of the things is one thread's work */
    MOST_PARTS  = 1024, /* a plane of the upper tree may cut many things: its bound */
    EMPTY_CELL  = 0 << 2 | BSP_LEAF,
};

/* A tree as it grows. */
typedef struct growth {
    bsp_node *nodes;
    uint32_t *items;
    size_t nodes_used, nodes_room, items_used, items_room;
} growth;

typedef struct part {
    cell c;
    stack lists;   /* where its events are */
    uint32_t node; /* of the upper tree, whose place its root takes */
    growth tree;
    bool built;
} part;

typedef struct build {
    const bsp_desc *d;
    int most_depth;
    uint32_t small; /* a cell of so many things is left to be built as a part; 0: none is */
    part *parts;
    int part_count, threads;
    uint8_t *sides; /* a byte a thing for each thread */
} build;

static bool grow(void **array, size_t *room, size_t want, size_t size)
{
    if (want <= *room)
        return true;
    size_t more = want > 2 * *room ? want : 2 * *room;
    void *moved = more <= SIZE_MAX / size ? realloc(*array, more * size) : NULL;
    if (!moved)
        return false;
    *array = moved;
    *room  = more;
    return true;
}

static bool add_nodes(growth *g, uint32_t count)
{
    if (g->nodes_used + count > BSP_MOST_NODES ||
        !grow((void **)&g->nodes, &g->nodes_room, g->nodes_used + count, sizeof *g->nodes))
        return false;
    for (uint32_t i = 0; i < count; i++)
        g->nodes[g->nodes_used++] = (bsp_node){ .link = EMPTY_CELL };
    return true;
}

static int by_number(const void *a, const void *b)
{
    uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

static bool make_leaf(growth *g, const cell *c, uint32_t node)
{
    if (c->things == 0) /* as nodes are made */
        return true;
    if (g->items_used + c->things > UINT32_MAX ||
        !grow((void **)&g->items, &g->items_room, g->items_used + c->things, sizeof *g->items))
        return false;
    uint32_t *items = g->items + g->items_used;
    uint32_t count  = 0;
    for (uint32_t i = 0; i < c->event_count[0]; i++)
        if (event_kind(c->events[0][i]) != EVENT_END)
            items[count++] = event_thing(c->events[0][i]);
    if (count > 1)
        qsort(items, count, sizeof *items, by_number);
    g->nodes[node].link  = count << 2 | BSP_LEAF;
    g->nodes[node].first = (uint32_t)g->items_used;
    g->items_used += count;
    return true;
}

/* ---- one cell after the other --------------------------------------------------------------- */

static bool build_cell(const build *b, growth *g, stack *s, uint8_t *sides, const cell *c,
                       uint32_t node)
{
    plane p = { .axis = -1 };
    if (c->depth < b->most_depth)
        p = cell_best_plane(c, b->d->traverse);
    if (p.axis < 0)
        return make_leaf(g, c, node);

    uint32_t child = (uint32_t)g->nodes_used;
    if (!add_nodes(g, 2))
        return false;
    g->nodes[node].link  = child << 3 | (uint32_t)p.axis;
    g->nodes[node].split = p.at;

    /* As deep as the tree, which is bounded */
    stack_mark here = stack_here(s);
    cell children[2];
    bool done = cell_split(b->d, c, p, sides, s, children) &&
                build_cell(b, g, s, sides, &children[0], child) &&
                build_cell(b, g, s, sides, &children[1], child + 1);
    stack_back(s, here);
    return done;
}

static void build_part(void *context, int item, int thread)
{
    const build *b = context;
    part *p        = &b->parts[item];
    stack s        = { 0 };
    p->built       = add_nodes(&p->tree, 2) &&
               build_cell(b, &p->tree, &s, b->sides + (size_t)thread * b->d->count, &p->c, 0);
    stack_back(&s, (stack_mark){ 0 });
    stack_back(&p->lists, (stack_mark){ 0 });
}

/* The upper tree: p is split, or left as a part. Its lists are freed as soon as split. */
static bool build_upper(build *b, growth *g, part *p, uint32_t node)
{
    if (p->c.things <= b->small || b->part_count + 2 * p->c.depth >= MOST_PARTS) {
        p->node                   = node;
        b->parts[b->part_count++] = *p;
        return true;
    }
    plane best = { .axis = -1 };
    if (p->c.depth < b->most_depth)
        best = cell_best_plane(&p->c, b->d->traverse);
    uint32_t child = (uint32_t)g->nodes_used;
    if (best.axis < 0 || !add_nodes(g, 2)) {
        bool done = best.axis < 0 && make_leaf(g, &p->c, node);
        stack_back(&p->lists, (stack_mark){ 0 });
        return done;
    }
    g->nodes[node].link  = child << 3 | (uint32_t)best.axis;
    g->nodes[node].split = best.at;

    /* Each child's lists on a stack of its own, since they end at different times */
    part halves[2] = { 0 };
    cell children[2];
    stack both = { 0 };
    bool done  = cell_split(b->d, &p->c, best, b->sides, &both, children);
    for (int k = 0; k < 2 && done; k++) {
        halves[k].c = children[k];
        for (int axis = 0; axis < 3 && done; axis++) {
            size_t bytes = children[k].event_count[axis] * sizeof(event);
            event *own   = stack_take(&halves[k].lists, bytes);
            if ((done = own != NULL))
                memcpy(own, children[k].events[axis], bytes);
            halves[k].c.events[axis] = own;
        }
    }
    stack_back(&both, (stack_mark){ 0 });
    stack_back(&p->lists, (stack_mark){ 0 });

    for (int k = 0; k < 2; k++) {
        if (done)
            done = build_upper(b, g, &halves[k], child + (uint32_t)k);
        else
            stack_back(&halves[k].lists, (stack_mark){ 0 });
    }
    return done;
}

/* ---- the root ------------------------------------------------------------------------------- */

static bool has_area(const float *p)
{
    dvec3 a = { (double)p[3] - (double)p[0], (double)p[4] - (double)p[1],
                (double)p[5] - (double)p[2] };
    dvec3 b = { (double)p[6] - (double)p[0], (double)p[7] - (double)p[1],
                (double)p[8] - (double)p[2] };
    dvec3 n = d3_cross(a, b);
    return n.x != 0.0 || n.y != 0.0 || n.z != 0.0;
}

static bsp_box thing_box(const bsp_desc *d, uint32_t thing)
{
    if (!d->corners)
        return d->boxes[thing];
    const float *p = d->corners + (size_t)9 * thing;
    bsp_box box;
    for (int k = 0; k < 3; k++) {
        box.low[k]  = fminf(fminf(p[k], p[k + 3]), p[k + 6]);
        box.high[k] = fmaxf(fmaxf(p[k], p[k + 3]), p[k + 6]);
    }
    return box;
}

static void enclose(bsp_box *all, const bsp_box *one)
{
    for (int k = 0; k < 3; k++) {
        all->low[k]  = fminf(all->low[k], one->low[k]);
        all->high[k] = fmaxf(all->high[k], one->high[k]);
    }
}

typedef struct sorting {
    part *root;
    event *spare[3];
} sorting;

static void sort_axis(void *context, int axis, int thread)
{
    (void)thread;
    const sorting *s = context;
    events_sort(s->root->c.events[axis], s->spare[axis], s->root->c.event_count[axis]);
}

static bool make_root(const bsp_desc *d, part *root)
{
    stack spare = { 0 };
    sorting s   = { .root = root };
    for (int k = 0; k < 3; k++) {
        root->c.events[k] = stack_take(&root->lists, (size_t)2 * d->count * sizeof(event));
        s.spare[k]        = stack_take(&spare, (size_t)2 * d->count * sizeof(event));
        if (!root->c.events[k] || !s.spare[k]) {
            stack_back(&spare, (stack_mark){ 0 });
            return false;
        }
        root->c.box.low[k]  = INFINITY;
        root->c.box.high[k] = -INFINITY;
    }
    for (uint32_t i = 0; i < d->count; i++) {
        if (d->corners && !has_area(d->corners + (size_t)9 * i))
            continue;
        bsp_box box = thing_box(d, i);
        enclose(&root->c.box, &box);
        root->c.things++;
        for (int k = 0; k < 3; k++) {
            event *end = root->c.events[k] + root->c.event_count[k];
            bool flat  = box.low[k] == box.high[k];
            end[0]     = event_make(box.low[k], flat ? EVENT_FLAT : EVENT_START, i);
            if (!flat)
                end[1] = event_make(box.high[k], EVENT_END, i);
            root->c.event_count[k] += flat ? 1 : 2;
        }
    }
    parallel_for(3, d->threads, sort_axis, &s, NULL);
    stack_back(&spare, (stack_mark){ 0 });
    return true;
}

/* ---- putting it together -------------------------------------------------------------------- */

/* The part's root takes its place in the upper tree, all else comes behind. */
static bool append(growth *g, const part *p)
{
    uint32_t nodes = (uint32_t)p->tree.nodes_used - 2, at = (uint32_t)g->nodes_used;
    uint32_t items = (uint32_t)p->tree.items_used, first = (uint32_t)g->items_used;
    if (!add_nodes(g, nodes) || g->items_used + items > UINT32_MAX ||
        !grow((void **)&g->items, &g->items_room, first + (size_t)items, sizeof *g->items))
        return false;
    if (items > 0)
        memcpy(g->items + first, p->tree.items, items * sizeof *g->items);
    g->items_used += items;
    for (uint32_t i = 0; i < nodes + 2; i++) {
        bsp_node n = p->tree.nodes[i];
        if ((n.link & 3) == BSP_LEAF)
            n.first += first;
        else
            n.link += (at - 2) << 3;
        if (i != 1)
            g->nodes[i == 0 ? p->node : at + i - 2] = n;
    }
    return true;
}

static bool build_all(build *b, part *root, growth *g)
{
    bool done = add_nodes(g, 2) && make_root(b->d, root);
    if (!done) {
        stack_back(&root->lists, (stack_mark){ 0 });
        return false;
    }
    b->most_depth = 8 + (int)(1.3 * log2((double)root->c.things + 1.0));
    b->small      = root->c.things > SMALL_TREE ? root->c.things / SMALL_PARTS : SMALL_TREE;
    if (root->c.things == 0) {
        stack_back(&root->lists, (stack_mark){ 0 });
        return true;
    }
    done = build_upper(b, g, root, 0);
    if (done)
        parallel_for(b->part_count, b->threads, build_part, b, NULL);
    for (int i = 0; i < b->part_count; i++) {
        part *p = &b->parts[i];
        stack_back(&p->lists, (stack_mark){ 0 }); /* where it was never begun */
        done = done && p->built && append(g, p);
        free(p->tree.nodes);
        free(p->tree.items);
    }
    return done;
}

static bool keep(arena *a, const growth *g, bsp *tree, lux_error *err)
{
    bsp_node *nodes = arena_alloc(a, g->nodes_used, sizeof *nodes, 64, err);
    uint32_t *items = nodes ? arena_array(a, uint32_t, g->items_used, err) : NULL;
    if (!items)
        return false;
    memcpy(nodes, g->nodes, g->nodes_used * sizeof *nodes);
    if (g->items_used > 0)
        memcpy(items, g->items, g->items_used * sizeof *items);
    tree->nodes      = nodes;
    tree->items      = items;
    tree->item_count = g->items_used;
    tree->bytes      = g->nodes_used * sizeof *nodes + g->items_used * sizeof *items;
    return true;
}

bool bsp_build(arena *a, const bsp_desc *d, bsp *tree, lux_error *err)
{
    if (d->count > BSP_MOST_ITEMS)
        return failed(err, ERR_MEMORY, "%u triangles in one mesh, at most %d can be traced",
                      d->count, BSP_MOST_ITEMS);
    int threads  = d->threads < 1 ? 1 : d->count < SMALL_TREE ? 1 : d->threads;
    build b      = { .d = d, .threads = threads };
    growth g     = { 0 };
    part root    = { 0 };
    arena memory = { 0 };
    b.parts      = arena_array(&memory, part, MOST_PARTS, err);
    b.sides      = b.parts ? arena_alloc(&memory, (size_t)threads, d->count, 1, err) : NULL;
    bool done    = b.sides && build_all(&b, &root, &g);
    if (done) {
        tree->low  = (vec3){ root.c.box.low[0], root.c.box.low[1], root.c.box.low[2] };
        tree->high = (vec3){ root.c.box.high[0], root.c.box.high[1], root.c.box.high[2] };
        for (int k = 0; k < 3; k++)
            tree->largest =
                fmaxf(tree->largest, fmaxf(fabsf(root.c.box.low[k]), fabsf(root.c.box.high[k])));
        done = keep(a, &g, tree, err);
    } else if (b.sides) {
        failed(err, ERR_MEMORY, "out of memory: a tree of %u triangles", d->count);
    }
    free(g.nodes);
    free(g.items);
    arena_clear(&memory);
    return done;
}
