/* sim/grid_write.h -- the result of a grid as files: a table (CSV) and a picture (EXR). */
#ifndef SIM_GRID_WRITE_H
#define SIM_GRID_WRITE_H

#include "core/notice.h"
#include "sim/grid.h"
#include "sim/output.h"

#include <stdio.h>

/* The columns that tables of grids begin with, x,y,z,nx,ny,nz, to 12 digits, no comma behind. */
void grid_write_place(FILE *to, const grid_sensor *at);

/* Values by sensor (NULL: `all` for each) as pixels of a picture, the top row having the largest v;
 * cells without a sensor are 0. NULL, with *err, if memory is out. */
float *grid_pixels(arena *a, const grid_result *r, const double *values, double all,
                   lux_error *err);

/* A row a sensor: x,y,z,nx,ny,nz to 12 digits, illuminance_lx,direct_lx,indirect_lx,half_width_lx
 * to 9, and in a layered scene NAME_lx of each group, undimmed. A run that was interrupted ends
 * with a line "# partial: ...". */
bool grid_write_csv(const char *path, const scene *s, const grid_result *r, lux_error *err);

/* A pixel a sensor, the top row has the largest v: Y, direct.Y, indirect.Y, halfWidth.Y in lux, and
 * in a layered scene group.NAME.Y, group.NAME.direct.Y, group.NAME.halfWidth.Y of each group,
 * undimmed. Cells without a sensor are 0 and, where there are any, leftOut.Y is 1 in them. */
bool grid_write_exr(const char *path, const scene *s, const grid_result *r, notices *n,
                    lux_error *err);

#endif
