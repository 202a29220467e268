/* sim/study_read.h -- the parts of a study, each in a file of its own behind study.c. */
#ifndef SIM_STUDY_READ_H
#define SIM_STUDY_READ_H

#include "sim/study_node.h"

/* Values of top-level keys, read into a study. */
study_read_fn study_read_room, study_read_scenes; /* study_scene.c */
study_read_fn study_read_site;                    /* study_site.c: study_site */
study_read_fn study_read_when;                    /* study_when.c: study_when */
study_read_fn study_read_sky;                     /* study_sky.c: study_sky */
study_read_fn study_read_materials;               /* study_material.c */
study_read_fn study_read_luminaires;              /* study_luminaire.c */
study_read_fn study_read_lights;                  /* study_light.c */
study_read_fn study_read_dimmings;                /* study_group.c */
study_read_fn study_read_grids;                   /* study_grid.c */
study_read_fn study_read_views;                   /* study_view.c */
study_read_fn study_read_variants;                /* study_variant.c */

/* `windows` of a room, into a study_room; and, once its size is known, whether they fit: `list` is
 * where they stand (NULL: there are none). */
study_read_fn study_read_windows; /* study_window.c */
bool study_check_windows(const study_reader *r, const study_room *room, const yaml_node_t *list);

/* What luminaires and lights share: their name, and what is in their `emission`. */
/* clang-format off */
#define STUDY_EMITTER_KEYS(record) \
    { "name", STUDY_OPTIONAL, study_read_name, offsetof(record, name) }, \
    { "color", STUDY_OPTIONAL, study_read_color, offsetof(record, emission.color) }, \
    { "dimming", STUDY_OPTIONAL, study_read_nonnegative, offsetof(record, emission.dimming) }, \
    { "group", STUDY_OPTIONAL, study_read_group, offsetof(record, emission.group) }
#define STUDY_EMISSION_PLAIN { .color = { 1, 1, 1 }, .dimming = 1.0 }
/* clang-format on */

/* Once all is read. The places of luminaires with `layout`, and whether each can look at `aim_at`;
 * whether groups are there to be dimmed; the planes of grids on surfaces of the room, and counts;
 * whether the sun is to be found in one way. */
bool study_finish_luminaires(study *s, arena *a, lux_error *err);
bool study_finish_dimmings(const study *s, lux_error *err);
bool study_finish_grids(const study *s, lux_error *err);
bool study_finish_when(study *s, arena *a, lux_error *err);

/* The plane of a grid `on: ...` (study_grid_place.c). */
bool study_grid_place(const study *s, study_grid *g, lux_error *err);

/* ---- variants: study_variant.c -------------------------------------------------------------- */

/* Of the study's `variants`, which study_read_variants() called good: the number of them, the name
 * of one, and the index in the tree of a study with that one merged over it: < 0, with the error,
 * if that cannot be. The last moves nodes: pointers to nodes are no longer good. */
int study_variant_count(const study_reader *r);
const char *study_variant_name(const study_reader *r, int i);
int study_variant_merge(const study_reader *r, int i);

/* Which of them is called that: < 0, with the error, if none is. */
int study_variant_find(const study_reader *r, const char *name);

#endif
