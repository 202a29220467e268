/* sim/daylight_print.h -- daylight studies on stdout: as tables for people, as JSON for programs.
 */
#ifndef SIM_DAYLIGHT_PRINT_H
#define SIM_DAYLIGHT_PRINT_H

#include "sim/daylight.h"
#include "sim/daylight_factor.h"

/* A grid through its moments: a line each. */
void daylight_print(const daylight_series *s);
void daylight_factor_print(const daylight_factor *f, bool first, int name_width);

/* An element of the list "grids". */
void daylight_print_json(const daylight_series *s, bool first);
void daylight_factor_print_json(const daylight_factor *f, bool first);

#endif
