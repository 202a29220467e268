/* sim/daylight_sheet.h -- daylight studies on one sheet (SVG), to be printed and pinned to a wall.
 *
 * Of one date the plans stand in rows as a text does, the hour under each; of several dates each
 * has a row, and equal hours stand below each other; of one time a day the dates stand in rows. The
 * legend is common to all.
 */
#ifndef SIM_DAYLIGHT_SHEET_H
#define SIM_DAYLIGHT_SHEET_H

#include "sim/daylight.h"
#include "sim/daylight_factor.h"

/* Beyond so many plans only each n-th date (or time) is drawn, and the sheet says so. */
enum { MOST_PLANS = 400 };

/* All moments, and the hours of sun if there are such. s->count > 0. */
bool daylight_sheet_write(const char *path, const daylight_series *s, lux_error *err);

/* One plan with its numbers; `under` names the sky. */
bool daylight_factor_sheet_write(const char *path, const daylight_factor *f, const char *under,
                                 lux_error *err);

#endif
