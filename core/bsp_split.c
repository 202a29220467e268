/* core/bsp_split.c -- see bsp_events.h: which plane is best, and what comes to lie where. */
#include "core/bsp_events.h"

#include <stdlib.h>

/* ---- sorting: merged runs ------------------------------------------------------------------- */

enum { RUN = 16 };

static void insertion_sort(event *list, uint32_t count)
{
    for (uint32_t i = 1; i < count; i++) {
        event e    = list[i];
        uint32_t k = i;
        for (; k > 0 && list[k - 1] > e; k--)
            list[k] = list[k - 1];
        list[k] = e;
    }
}

static void merge(const event *a, uint32_t na, const event *b, uint32_t nb, event *to)
{
    while (na > 0 && nb > 0) {
        bool first = *a < *b;
        *to++      = first ? *a : *b;
        a += first, na -= first;
        b += !first, nb -= !first;
    }
    memcpy(to, a, na * sizeof *a);
    memcpy(to + na, b, nb * sizeof *b);
}

void events_sort(event *list, event *spare, uint32_t count)
{
    for (uint32_t i = 0; i < count; i += RUN)
        insertion_sort(list + i, count - i < RUN ? count - i : RUN);

    event *from = list, *to = spare;
    for (uint64_t run = RUN; run < count; run *= 2) {
        for (uint64_t i = 0; i < count; i += 2 * run) {
            uint64_t middle = i + run < count ? i + run : count;
            uint64_t end    = middle + run < count ? middle + run : count;
            merge(from + i, (uint32_t)(middle - i), from + middle, (uint32_t)(end - middle),
                  to + i);
        }
        event *swap = from;
        from        = to;
        to          = swap;
    }
    if (from != list)
        memcpy(list, from, count * sizeof *list);
}

/* ---- memory --------------------------------------------------------------------------------- */

enum { STACK_BLOCK = 1 << 20 };

typedef struct stack_block {
    struct stack_block *below;
    size_t used, capacity;
    size_t unused; /* so that what follows is aligned to 16 */
} stack_block;

void *stack_take(stack *s, size_t bytes)
{
    bytes = (bytes + 15) & ~(size_t)15;
    if (!s->top || s->top->capacity - s->top->used < bytes) {
        size_t capacity = bytes > STACK_BLOCK ? bytes : STACK_BLOCK;
        stack_block *b  = aligned_alloc(64, (sizeof *b + capacity + 63) & ~(size_t)63);
        if (!b)
            return NULL;
        *b     = (stack_block){ s->top, 0, capacity, 0 };
        s->top = b;
    }
    void *p = (char *)(s->top + 1) + s->top->used;
    s->top->used += bytes;
    return p;
}

stack_mark stack_here(const stack *s) { return (stack_mark){ s->top, s->top ? s->top->used : 0 }; }

void stack_back(stack *s, stack_mark m)
{
    while (s->top != m.top) {
        stack_block *below = s->top->below;
        free(s->top);
        s->top = below;
    }
    if (s->top)
        s->top->used = m.used;
}

/* ---- the surface area heuristic ------------------------------------------------------------- */

/* A cell with nothing in it is worth more than the rays that cross it say: they get past the
 * rest sooner. (Wald and Havran, section 3.3) */
static const double empty_bonus = 0.8;

typedef struct sweep {
    double traverse;     /* cost of a step down */
    double caps, around; /* area of the ends, and of the sides a metre, over the cell's area */
    double low, high;    /* of the cell on this axis */
    uint32_t below, flat, above;
} sweep;

/* What a ray that meets the cell is expected to cost if it is split at `at`. */
static double split_cost(const sweep *s, double at, bool flat_below)
{
    uint32_t below = s->below + (flat_below ? s->flat : 0);
    uint32_t above = s->above + (flat_below ? 0 : s->flat);
    double p_below = s->caps + s->around * (at - s->low);
    double p_above = s->caps + s->around * (s->high - at);
    double cost    = s->traverse + p_below * below + p_above * above;
    return below == 0 || above == 0 ? empty_bonus * cost : cost;
}

static void sweep_axis(const cell *c, int axis, sweep s, plane *best, double *least)
{
    const event *e   = c->events[axis];
    const event *end = e + c->event_count[axis];
    while (e < end) {
        uint32_t counts[4] = { 0 };
        event here         = *e >> 32;
        float at           = event_position(*e);
        for (; e < end && *e >> 32 == here; e++)
            counts[event_kind(*e)]++;

        s.flat = counts[EVENT_FLAT];
        s.above -= counts[EVENT_FLAT] + counts[EVENT_END];
        if (at > c->box.low[axis] && at < c->box.high[axis]) {
            double if_below = split_cost(&s, (double)at, true);
            double if_above = split_cost(&s, (double)at, false);
            bool flat_below = if_below <= if_above;
            double cost     = flat_below ? if_below : if_above;
            if (cost < *least) {
                *least = cost;
                *best  = (plane){ axis, at, flat_below, 0, 0 };
            }
        }
        s.below += counts[EVENT_FLAT] + counts[EVENT_START];
    }
}

plane cell_best_plane(const cell *c, double traverse)
{
    plane best   = { .axis = -1 };
    double least = c->things; /* to test them all */
    double side[3];
    for (int axis = 0; axis < 3; axis++)
        side[axis] = (double)c->box.high[axis] - (double)c->box.low[axis];
    double area = side[0] * side[1] + side[1] * side[2] + side[2] * side[0];
    if (!(area > 0.0))
        return best;

    for (int axis = 0; axis < 3; axis++) {
        double a = side[(axis + 1) % 3], b = side[(axis + 2) % 3];
        sweep s = { traverse,
                    a * b / area,
                    (a + b) / area,
                    (double)c->box.low[axis],
                    (double)c->box.high[axis],
                    0,
                    0,
                    c->things };
        sweep_axis(c, axis, s, &best, &least);
    }
    return best;
}

/* ---- splitting ------------------------------------------------------------------------------ */

enum { SIDE_BOTH, SIDE_BELOW, SIDE_ABOVE };

/* Each thing's side, and how many lie wholly below and above. */
static void classify(const cell *c, plane *p, uint8_t *sides)
{
    const event *list = c->events[p->axis];
    uint32_t count    = c->event_count[p->axis];
    for (uint32_t i = 0; i < count; i++)
        sides[event_thing(list[i])] = SIDE_BOTH;

    for (uint32_t i = 0; i < count; i++) {
        float at       = event_position(list[i]);
        uint8_t *side  = &sides[event_thing(list[i])];
        int kind       = event_kind(list[i]);
        bool flat_here = kind == EVENT_FLAT && at == p->at;
        if (flat_here ? p->flat_below : kind != EVENT_START && at <= p->at) {
            *side = SIDE_BELOW;
            p->below++;
        } else if (flat_here ? !p->flat_below : kind != EVENT_END && at >= p->at) {
            *side = SIDE_ABOVE;
            p->above++;
        }
    }
}

/* What a cell gets of the things that the plane cuts: their events, anew. */
typedef struct cuts {
    event *events[3]; /* each ends with EVENT_LAST */
    uint32_t count[3];
    uint32_t things;
} cuts;

static void add_cut(const bsp_desc *d, uint32_t thing, const bsp_box *box, cuts *to)
{
    bsp_box part;
    if (d->corners) {
        if (!bsp_clip(d->corners + (size_t)9 * thing, box, &part))
            return;
    } else {
        part = d->boxes[thing];
        for (int k = 0; k < 3; k++) {
            part.low[k]  = part.low[k] > box->low[k] ? part.low[k] : box->low[k];
            part.high[k] = part.high[k] < box->high[k] ? part.high[k] : box->high[k];
            if (part.low[k] > part.high[k])
                return;
        }
    }
    to->things++;
    for (int k = 0; k < 3; k++) {
        event *end = to->events[k] + to->count[k];
        if (part.low[k] < part.high[k]) {
            end[0] = event_make(part.low[k], EVENT_START, thing);
            end[1] = event_make(part.high[k], EVENT_END, thing);
            to->count[k] += 2;
        } else {
            end[0] = event_make(part.low[k], EVENT_FLAT, thing);
            to->count[k]++;
        }
    }
}

static bool cut_things(const bsp_desc *d, const cell *c, const uint8_t *sides, uint32_t cut,
                       int axis, const cell children[2], cuts to[2], stack *s)
{
    size_t room  = (size_t)2 * cut + 1;
    event *space = stack_take(s, 7 * room * sizeof *space);
    if (!space)
        return false;
    for (int i = 0; i < 6; i++)
        to[i / 3].events[i % 3] = space + (size_t)i * room;

    const event *list = c->events[axis];
    for (uint32_t i = 0; i < c->event_count[axis] && cut > 0; i++) {
        uint32_t thing = event_thing(list[i]);
        if (event_kind(list[i]) != EVENT_START || sides[thing] != SIDE_BOTH)
            continue;
        for (int k = 0; k < 2; k++)
            add_cut(d, thing, &children[k].box, &to[k]);
    }
    for (int i = 0; i < 6; i++) {
        cuts *t = &to[i / 3];
        events_sort(t->events[i % 3], space + 6 * room, t->count[i % 3]);
        t->events[i % 3][t->count[i % 3]] = EVENT_LAST;
    }
    return true;
}

/* The cell's events of those that lie wholly on the child's side, and those of the cuts. */
static uint32_t gather_events(const cell *c, int axis, const uint8_t *sides, int side,
                              const event *cut, event *to)
{
    const event *list = c->events[axis];
    const event *end  = list + c->event_count[axis];
    event *start      = to;
    for (; list < end; list++) {
        if (sides[event_thing(*list)] != side)
            continue;
        while (*cut < *list)
            *to++ = *cut++;
        *to++ = *list;
    }
    while (*cut != EVENT_LAST)
        *to++ = *cut++;
    return (uint32_t)(to - start);
}

bool cell_split(const bsp_desc *d, const cell *c, plane p, uint8_t *sides, stack *s,
                cell children[2])
{
    for (int k = 0; k < 2; k++)
        children[k] = (cell){ .depth = c->depth + 1, .box = c->box };
    children[0].box.high[p.axis] = p.at;
    children[1].box.low[p.axis]  = p.at;
    classify(c, &p, sides);

    /* What the children get stays on the stack, below what only this needs */
    uint32_t whole[2] = { p.below, p.above };
    uint32_t cut      = c->things - p.below - p.above;
    for (int i = 0; i < 6; i++) {
        size_t most                   = (size_t)2 * (whole[i / 3] + cut);
        children[i / 3].events[i % 3] = stack_take(s, most * sizeof(event));
        if (!children[i / 3].events[i % 3])
            return false;
    }

    stack_mark here = stack_here(s);
    cuts both[2]    = { 0 };
    if (!cut_things(d, c, sides, cut, p.axis, children, both, s))
        return false;
    for (int i = 0; i < 6; i++) {
        cell *child               = &children[i / 3];
        child->event_count[i % 3] = gather_events(c, i % 3, sides, i / 3 ? SIDE_ABOVE : SIDE_BELOW,
                                                  both[i / 3].events[i % 3], child->events[i % 3]);
        child->things             = whole[i / 3] + both[i / 3].things;
    }
    stack_back(s, here);
    return true;
}
