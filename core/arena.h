/* core/arena.h -- memory that is given back all at once.
 *
 * Whatever a scene is made of lives in the scene's arena and dies with it: nothing in
 * lights/, materials/ or sky/ has a free function. An arena of zeros is an empty one. Not
 * thread-safe: one arena belongs to one thread until the scene is complete.
 */
#ifndef CORE_ARENA_H
#define CORE_ARENA_H

#include "core/error.h"

#include <stdalign.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct arena {
    struct arena_block *newest;
} arena;

/* count things of size bytes, all zero, the first at a multiple of align (a power of two, 64
 * at most). NULL, with *err, if the machine has not so much memory; a is then as it was. */
void *arena_alloc(arena *a, size_t count, size_t size, size_t align, lux_error *err)
    __attribute__((warn_unused_result));

/* Frees everything ever allocated from a, and leaves it empty. */
void arena_clear(arena *a);

#define arena_new(a, type, err) ((type *)arena_alloc(a, 1, sizeof(type), alignof(type), err))
#define arena_array(a, type, count, err)                                                           \
    ((type *)arena_alloc(a, count, sizeof(type), alignof(type), err))

#ifdef __cplusplus
}
#endif

#endif
