/* sim/seen_lamps.h -- which lamps the rays of a batch may see: those in the cone around them. */
#ifndef SIM_SEEN_LAMPS_H
#define SIM_SEEN_LAMPS_H

#include "sim/scene.h"

typedef struct seen_lamps {
    const int32_t *lamps; /* as scene.lights counts */
    int count;
} seen_lamps;

/* All lamps that can be seen at all, in a; NULL lamps, with *err, if memory is out. */
seen_lamps lamps_that_show(arena *a, const scene *s, lux_error *err);

/* Those of `all` that some ray of the batch may meet, into list, which has room for all.count: no
 * ray meets another. How many. */
int lamps_before(const scene *s, const seen_lamps *all, const vray *rays, const vmask *active,
                 int packets, int32_t *list);

#endif
