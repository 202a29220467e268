/* sim/swatch.h -- a picture of a material: a ball of it in a room that is always the same.
 *
 * The room is 6 x 6 x 3 m, its walls and ceiling reflect 50 %; a lamp of 2 x 1 m stands above and
 * behind who looks, on the left, a small bright one on the right. The ball, 1 m across, lies on a
 * floor with a pattern of squares of 25 cm that reflect 60 and 15 %. A table's azimuth 0 and a
 * file's up run toward the top of the ball; of a BSDF, the ball's outside is the room's side.
 */
#ifndef SIM_SWATCH_H
#define SIM_SWATCH_H

#include "sim/grid.h"

enum { SWATCH_SIZE = 256 }; /* pixels, along both sides */

/* Renders it into an 8-bit sRGB picture (PNG by its name), by default to an accuracy of 100 %: some
 * 32 samples a pixel. The same bytes on any machine, unless there is a deadline. False, with *err,
 * for a material that cannot be made or a place that cannot be written, or (ERR_INTERRUPTED) if the
 * user stopped it. */
bool swatch_write(const study_material *m, const char *picture, const run_options *o,
                  lux_error *err);

#endif
