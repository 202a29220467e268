/* data/office/parts.h -- the things in the office, each modelled once, standing on z = 0.
 *
 * detail multiplies the segments of all round parts. Feet keep 1 mm off the floor, what rests on
 * something is sunk into it by some millimetres: no two faces lie in one plane.
 */
#ifndef OFFICE_PARTS_H
#define OFFICE_PARTS_H

#include "data/office/paints.h"

#include <stddef.h>

/* desk_parts.c: a workplace; its user looks along +y, the desk's middle is the origin. */
shape desk(double detail);
shape pedestal(double detail); /* its front looks along -y */
shape monitor(double detail);  /* stands on z = 0, its screen looks along -y */
shape keyboard(double detail); /* with mouse, right-handed */
shape office_chair(double detail);
shape desk_screen(double detail); /* 3.2 m along y */
shape waste_bin(double detail);

/* room_parts.c: what else stands about. */
shape meeting_table(double detail);
shape meeting_chair(double detail);
shape bookshelf(double detail, uint32_t seed); /* 0.9 m along y, its front looks along -x */
shape coat_stand(double detail);
shape plant(double detail);
shape column(double detail);
shape radiator(double detail);   /* along x, its front looks along -y */
shape whiteboard(double detail); /* along x, its front looks along +y, its back on y = 0 */
shape wall_clock(double detail); /* looks along +x, its back on x = 0 */

/* building.c: the shell, 10.8 x 7.2 x 2.9 m, a corner of its floor at the origin. */
shape shell(double detail);
shape skirting(double detail);
shape window_frame(double detail); /* of one opening; its middle at x = 0, the wall's face y = 0 */
shape door(double detail);         /* hinged in x = 0, looks along -x, its middle at y = 0 */
shape tile_row(double detail);     /* along x from 0, its underside on z = 0 */
shape runner(double detail, double length); /* along x from 0, T profile, underside on z = 0 */
shape panel(double detail);                 /* 0.6 x 0.6 m, its frame's underside on z = 0 */
shape downlight(double detail);

#endif
