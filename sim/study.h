/* sim/study.h -- a study file as written: every key checked, nothing looked up yet.
 *
 * Field for field what interface.md promises, in the user's units. A number that was not given
 * is the default that the comment names; where there is none, NAN (a quantity) or NULL (a name).
 * Keys of the contract that this version does not simulate are refused by name.
 */
#ifndef SIM_STUDY_H
#define SIM_STUDY_H

#include "core/arena.h"
#include "core/error.h"
#include "core/notice.h"
#include "core/transform.h"

/* Where in the study something stands, for messages: "FILE:LINE:COLUMN: " with where_text(). */
typedef struct study_where {
    int line, column; /* from 1 */
} study_where;

typedef struct study_room {
    study_where where;
    bool given;
    dvec3 size;                 /* m, > 0; a corner at the origin */
    vec3 ceiling, walls, floor; /* reflectance, [0, 1] */
} study_room;

typedef struct study_scene {
    study_where where;
    const char *file; /* absolute or relative to the working folder: ready to open */
    double scale;     /* 1 */
    bool lights;      /* on */
    dvec3 *at;        /* m; one of {0,0,0} if not given */
    int at_count;
    double rotate_deg; /* 0; counter-clockwise seen from above */
} study_scene;

/* What luminaires and lights share. */
typedef struct study_emission {
    vec3 color;        /* luminance 1: {1,1,1} if not given; temperatures are converted */
    double dimming;    /* 1; >= 0 */
    const char *group; /* NULL */
} study_emission;

typedef struct study_luminaire {
    study_where where;
    const char *name;       /* NULL */
    const char *photometry; /* ready to open */
    dvec3 *at;
    int at_count;
    dvec3 aim;                  /* {0,0,-1} */
    double rotate_deg;          /* 0 */
    double lumens, lamp_lumens; /* NAN: as the file has it; never both */
    double watts;               /* NAN */
    study_emission emission;
} study_luminaire;

typedef struct study_light {
    study_where where;
    const char *name; /* NULL */
    dvec3 *at;
    int at_count;
    double intensity; /* cd; lumens were converted */
    study_emission emission;
} study_light; /* type: point, the one kind so far */

typedef struct study_material {
    study_where where;
    const char *match; /* * and ? */
    vec3 reflectance;
} study_material;

typedef struct study_grid {
    study_where where;
    const char *name;
    dvec3 origin, u, v; /* m, if points is NULL */
    double spacing;     /* m, > 0; of "en12464" what study_spacing_en12464() says */
    const char *points; /* a CSV file, ready to open (sim/probes.h); NULL: a plane */
    double require_average, require_minimum, require_uniformity; /* lx, lx, 1; NAN: not asked */
    bool on_room, en12464; /* how it was written: the plane above is what it comes to */
    double height, margin; /* m, of `on: room`: above the floor; from the walls, 0 */
} study_grid;

typedef enum study_projection { PROJECTION_PERSPECTIVE, PROJECTION_ORTHOGRAPHIC } study_projection;

typedef struct study_view {
    study_where where;
    const char *name;
    const char *camera; /* NULL: eye, target and so on */
    dvec3 eye, target;  /* m */
    double fov_deg;     /* horizontal; 60 */
    double width_m;     /* orthographic; else NAN */
    study_projection projection;
    int width, height; /* pixels; 1024, 768 */
    bool size_given;
} study_view;

typedef struct study {
    const char *path;   /* as given */
    const char *folder; /* of the study: "." or "a/b" */
    study_room room;
    study_scene *scenes;
    study_luminaire *luminaires;
    study_light *lights;
    study_material *materials;
    study_grid *grids;
    study_view *views;
    int scene_count, luminaire_count, light_count, material_count, grid_count, view_count;
    double maintenance; /* 1 */
    bool maintenance_given;
    double accuracy; /* 0.02 for 2%; NAN: not given */
} study;

/* Reads and checks the study at path into a. NULL, with *err naming file, line and column. */
const study *study_read(arena *a, const char *path, notices *n, lux_error *err);

/* The same for a text in memory, of `size` bytes; path is for messages and for what the study
 * names. */
const study *study_parse(arena *a, const char *path, const char *text, size_t size, notices *n,
                         lux_error *err);

/* Sensors of a plane grid along u and along v: max(1, round(length / spacing)). */
void study_grid_counts(const study_grid *g, double *along_u, double *along_v);

/* The spacing of a grid over an area of these sides (m, > 0) as EN 12464-1:2011, 4.4,
 * asks:
 *
 *     p = 0.2 * 5^(log10 d)        [m], at most 10 m
 *
 * with d the longer side or, if that is twice the shorter or more, the shorter one; p is the
 * largest cell allowed, so that d is cut into the next whole number of d / p. What comes back is
 * d / that number; the other side has the whole number nearest to its length / spacing. */
double study_spacing_en12464(double side, double other);

/* For messages of later stages about a piece of the study: fills *err like failed(), with
 * "PATH:LINE:COLUMN: " before the text, and returns NULL. */
void *study_failed(const study *s, study_where where, lux_error *err, error_code code,
                   const char *format, ...) __attribute__((format(printf, 5, 6), cold));

/* Whether the whole name matches a pattern with * (any characters, or none) and ? (any one). */
bool study_match(const char *pattern, const char *name);

#endif
