/* sim/cost_write.h -- what lux4 cost found, as a table, as JSON, as CSV and as a picture. */
#ifndef SIM_COST_WRITE_H
#define SIM_COST_WRITE_H

#include "sim/cost.h"

#include <stdio.h>

void cost_print(FILE *to, const cost_result *r);
void cost_print_json(FILE *to, const cost_result *r);

/* One row a setting; behind them, as comments, of what study they are. */
bool cost_write_csv(const char *path, const study *s, const cost_result *r, lux_error *err);

/* Whether the file at path is such a one of this study. */
bool cost_csv_is_of(const char *path, const study *s);

/* Error against time, both logarithmic, as SVG (cost_plot.c). */
bool cost_plot(const char *path, const study *s, const cost_result *r, lux_error *err);

#endif
