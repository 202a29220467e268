/* sim/mix.h -- a result's group layers put together anew: other dimmings without another run.
 *
 * With --groups, results hold a layer for each group of lights: what it gives undimmed, with
 * maintenance applied. Light adds up, so that any mixture is the sum of factor x layer. Sums are
 * done in double and rounded once. Half widths are added, too: that of a sum is at most that.
 *
 *     GRID.csv    x,y,z,nx,ny,nz,illuminance_lx[,direct_lx,indirect_lx,half_width_lx],NAME_lx...
 *     GRID.exr    group.NAME.Y  .direct.Y  .halfWidth.Y
 *     VIEW.exr    group.NAME.R  .G  .B  .illuminance.Y  .halfWidth.Y
 *
 * The layers themselves are kept, so that a mixture can be mixed again. A channel is left out
 * where its layers are missing, as are direct, indirect and half width from a CSV.
 */
#ifndef SIM_MIX_H
#define SIM_MIX_H

#include "core/image.h"

typedef enum mix_kind { MIX_GRID_CSV, MIX_GRID_EXR, MIX_VIEW_EXR } mix_kind;

typedef struct mix_group {
    const char *name;
    double factor; /* >= 0; 1 unless it was set */
} mix_group;

typedef struct mix {
    const char *path;
    mix_kind kind;
    int group_count; /* >= 1 */
    mix_group *groups;

    image im;         /* of an EXR: as read, all values finite */
    const char *rows; /* of a CSV: from its second line on */
    int first_group;  /* the column */
} mix;

/* Reads a result into a, which m goes on using. False, with *err naming file and place, if it
 * is none, holds what is no finite number, or has no group layers. */
bool mix_read(arena *a, const char *path, mix *m, lux_error *err);

/* Takes "NAME=FACTOR". False, with *err, if there is no such group or the factor is none. */
bool mix_set(mix *m, const char *word, lux_error *err);

/* The mixture of an EXR, in a: the channels and attributes of the result, but for what is mixed,
 * and lux4:mix, which says how. *average_lx: of a grid; NAN for a view. */
bool mix_image(const mix *m, arena *a, image *out, double *average_lx, lux_error *err);

/* Writes the mixture of a CSV. False, with *err naming file, line and column where the CSV breaks
 * its form, or if it cannot be written: then no file appears. */
bool mix_write_csv(const mix *m, const char *path, double *average_lx, notices *n, lux_error *err);

/* The two kinds of file, for mix_read: these find the groups. */
bool mix_read_exr(arena *a, mix *m, lux_error *err);
bool mix_read_csv(arena *a, mix *m, lux_error *err);

/* Adds a group, unless it is there; which one it is, or -1, with *err, if memory is out. */
int mix_group_add(arena *a, mix *m, const char *name, size_t length, lux_error *err);

#endif
