/* tests/made_series.h -- a series of made-up light, for what writes and draws it. */
#ifndef TESTS_MADE_SERIES_H
#define TESTS_MADE_SERIES_H

#include "sim/daylight.h"

/* A level grid of 3 x 2 cells of 1 m, the one at column 1 of row 1 left out: five sensors. */
enum { MADE_COLUMNS = 3, MADE_ROWS = 2, MADE_SENSORS = 5 };

/* Hours 10, 11, ... of that many days from 2026-06-21 on; at hour h of all, sensor k has
 * 100 (h + 1) + k lx, half of it direct, and sees (k + 1) / 5 of the sun. An hour a step. */
void made_series(arena *a, int days, int hours, daylight_series *out);

#endif
