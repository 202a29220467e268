/* core/bsp_events.h -- where things begin and end along the axes: what a cell is split by.
 *
 * For each axis a cell has a sorted list of events: a thing that is flat there has one, any
 * other two. An event is one whole number, so that sorting needs no rule: its position in an
 * order-keeping code, what happens there, and to whom:
 *
 *     63         position        32 | 31 30 kind | 29        thing         0
 *
 * Shared by bsp_build.c and bsp_split.c alone.
 */
#ifndef CORE_BSP_EVENTS_H
#define CORE_BSP_EVENTS_H

#include "core/bsp.h"

#include <string.h>

typedef uint64_t event;
enum { EVENT_END, EVENT_FLAT, EVENT_START }; /* at one position, they come in this order */

#define EVENT_LAST UINT64_MAX /* behind every event */

static inline event event_make(float at, int kind, uint32_t thing)
{
    uint32_t bits;
    at += 0.0f; /* -0 lies where +0 does */
    memcpy(&bits, &at, sizeof bits);
    bits = bits >> 31 ? ~bits : bits | 0x80000000u;
    return (event)bits << 32 | (event)kind << 30 | thing;
}
static inline float event_position(event e)
{
    uint32_t bits = (uint32_t)(e >> 32);
    bits          = bits >> 31 ? bits & 0x7fffffffu : ~bits;
    float at;
    memcpy(&at, &bits, sizeof at);
    return at;
}
static inline int event_kind(event e) { return (int)(e >> 30 & 3); }
static inline uint32_t event_thing(event e) { return (uint32_t)e & 0x3fffffffu; }

void events_sort(event *list, event *spare, uint32_t count);

/* A cell, and the lists of what lies in it. */
typedef struct cell {
    event *events[3];
    uint32_t event_count[3];
    uint32_t things;
    int depth;
    bsp_box box;
} cell;

typedef struct plane {
    int axis; /* -1: the cell is better left whole */
    float at;
    bool flat_below;       /* what lies in the plane goes to the cell below it */
    uint32_t below, above; /* things that lie wholly there */
} plane;

/* The plane by which a ray is expected to do the least work in the cell. */
plane cell_best_plane(const cell *c, double traverse);

/* Memory given back in the opposite order. Zeros are an empty one. */
typedef struct stack {
    struct stack_block *top;
} stack;
typedef struct stack_mark {
    struct stack_block *top;
    size_t used;
} stack_mark;
void *stack_take(stack *s, size_t bytes); /* NULL if memory is out */
stack_mark stack_here(const stack *s);
void stack_back(stack *s, stack_mark m); /* frees what was taken since */

/* Fills in both children's lists, taken from s. sides is scratch, a byte a thing. false if
 * memory is out. */
bool cell_split(const bsp_desc *d, const cell *c, plane p, uint8_t *sides, stack *s,
                cell children[2]);

#endif
