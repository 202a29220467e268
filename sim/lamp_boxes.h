/* sim/lamp_boxes.h -- which lamps a packet of rays may meet, of many: those whose boxes it meets.
 */
#ifndef SIM_LAMP_BOXES_H
#define SIM_LAMP_BOXES_H

#include "sim/seen_lamps.h"

typedef struct lamp_boxes lamp_boxes;

/* Of all these lamps, in a; NULL, with *err, if memory is out. `all` must live as long. */
const lamp_boxes *lamp_boxes_new(arena *a, const scene *s, const seen_lamps *all, lux_error *err);

/* Those that some ray may meet within its reach, in ascending order, into list, which has room for
 * all.count: no ray meets another. How many. */
int lamp_boxes_met(const lamp_boxes *b, const vray *rays, vmask active, int32_t *list);

#endif
