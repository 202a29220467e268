/* sim/study_read.h -- the parts of a study, each in a file of its own behind study.c. */
#ifndef SIM_STUDY_READ_H
#define SIM_STUDY_READ_H

#include "sim/study_node.h"

/* Values of top-level keys, read into a study. */
study_read_fn study_read_room, study_read_scenes, study_read_materials; /* study_scene.c */
study_read_fn study_read_luminaires, study_read_lights;                 /* study_light.c */
study_read_fn study_read_grids;                                         /* study_grid.c */
study_read_fn study_read_views;                                         /* study_view.c */

/* Once all is read: the planes of grids `on: room`, the spacings by standard, the counts. */
bool study_finish_grids(const study *s, lux_error *err);

#endif
