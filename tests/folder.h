/* tests/folder.h -- what tests of studies need: a folder for files, scenes, results. */
#ifndef TESTS_FOLDER_H
#define TESTS_FOLDER_H

#include "sim/grid.h"

/* A new empty folder; its path is freed, and all in it removed, by folder_free(). */
char *folder_new(void);
void folder_free(char *path);
void folder_write(const char *folder, const char *name, const char *text);

/* The scene of a study that stands alone; the test fails where it cannot be read. */
const scene *scene_of_text(arena *a, const char *yaml);

/* Runs one of its grids; zeros in *o are defaults. */
void grid_of_scene(arena *a, const scene *s, int grid, const run_options *o, grid_result *out);

/* lx: that of the average of sensors whose errors are independent, with nothing for how they stop:
 * closer than grid_result.average_half_width. */
double independent_half_width(const grid_result *r);

#endif
