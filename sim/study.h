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
#include "sky/clock.h"
#include "sky/site.h"

/* Where in the study something stands, for messages: "FILE:LINE:COLUMN: " with where_text(). */
typedef struct study_where {
    int line, column; /* from 1 */
} study_where;

/* What a sensor's plane, or a window, lies on or in. */
typedef enum study_side {
    SIDE_NONE, /* a plane of its own, or points */
    SIDE_ROOM, /* over the floor */
    SIDE_FLOOR,
    SIDE_CEILING,
    SIDE_SOUTH, /* walls: the one at y = 0, */
    SIDE_EAST,  /* at x = size.x, */
    SIDE_NORTH, /* at y = size.y, */
    SIDE_WEST,  /* at x = 0 */
} study_side;

/* An opening in a wall of the room. All of it lies in the wall, off its edges; no two overlap. */
typedef struct study_window {
    study_where where;
    study_side wall;
    double at[2];   /* m: from the wall's left end seen from inside; the sill above the floor */
    double size[2]; /* m, > 0: width, height */
    double transmittance; /* of its pane at normal incidence, (0, pane_most(1.52)]; 1: no pane */
} study_window;

typedef struct study_room {
    study_where where;
    bool given;
    dvec3 size;                 /* m, > 0; a corner at the origin */
    vec3 ceiling, walls, floor; /* reflectance, [0, 1] */
    study_window *windows;
    int window_count;
} study_room;

typedef struct study_scene {
    study_where where;
    const char *file; /* absolute or relative to the working folder: ready to open */
    double scale;     /* 1 */
    bool lights;      /* on */
    dvec3 *at;        /* m; one of {0,0,0} if not given */
    int at_count;
    double rotate_deg;                /* 0; counter-clockwise seen from above */
    const char **exterior, **portals; /* patterns of nodes, or of materials */
    int exterior_count, portal_count;
} study_scene;

/* Where the scene stands on Earth. */
typedef struct study_site {
    study_where where;
    bool given;
    site at;
    const clock_zone *zone; /* of local times; NULL: times need an offset of their own */
    double north_deg;       /* 0: where true north lies, clockwise from +y seen from above */
} study_site;

/* One moment, or a series: on every day, or each seventh, or the same day of each month, from the
 * first date to the last, times of day from `from` to `to`, both included, `step` apart. */
typedef enum study_every { EVERY_DAY, EVERY_WEEK, EVERY_MONTH } study_every;
typedef struct study_when {
    study_where where;
    bool given, series;
    clock_text at;          /* of one moment */
    civil_time first, last; /* dates, of a series */
    int from_min, to_min;   /* minutes of the day, [0, 1439], from <= to */
    double step_min;        /* > 0; 60 */
    study_every every;
} study_when;

typedef enum study_sky_model {
    STUDY_SKY_NONE,
    STUDY_SKY_CIE, /* uniform, overcast, intermediate, clear too: see `type` */
    STUDY_SKY_PEREZ,
    STUDY_SKY_PANORAMA,
} study_sky_model;

typedef enum study_sun {
    STUDY_SUN_MODEL, /* not given: as the model has it */
    STUDY_SUN_OFF,
    STUDY_SUN_ON, /* a disk or a point, as the plan finds */
    STUDY_SUN_DISK,
    STUDY_SUN_POINT,
} study_sun;

typedef struct study_sky {
    study_where where;
    bool given;
    study_sky_model model;
    const char *name; /* of the model as written: "clear" */
    int type;         /* as cie_desc.type */
    study_sun sun;
    double turbidity;       /* 3, Linke's, [1, 20] */
    double horizontal;      /* lx, of the sky alone (of a panorama: all of it); NAN */
    double sun_illuminance; /* lx, square to the beam; NAN */
    bool sun_at_given;
    double sun_azimuth_deg, sun_elevation_deg; /* in place of site and when */
    vec3 ground;                               /* reflectance below the horizon, [0, 1]: 0.2 */
    double direct_normal, diffuse_horizontal;  /* perez: W/m^2 */
    double dew_point_c;                        /* perez; NAN */
    const char *file;                          /* panorama, ready to open */
    double rotate_deg;                         /* panorama: clockwise; 0 */
    double scale;                              /* panorama: W/(sr m^2) of 1.0; NAN */
} study_sky;

/* What luminaires and lights share. */
typedef struct study_emission {
    vec3 color;        /* luminance 1: {1,1,1} if not given; temperatures are converted */
    double dimming;    /* 1; >= 0 */
    const char *group; /* NULL: "other" */
} study_emission;

/* Places in a row or in a grid, x before y before z: count of them from `from` to `to`; where the
 * count is 1, the middle. */
typedef struct study_layout {
    study_where where;
    bool given, fill;   /* fill: the room, half the spacing to its walls, at height z */
    double z;           /* m; NAN */
    dvec3 from, to;     /* m */
    int count[3], axes; /* axes: 1: a row along the line, 2: in x and y, 3: in x, y and z */
} study_layout;

typedef struct study_luminaire {
    study_where where;
    const char *name;       /* NULL */
    const char *photometry; /* ready to open */
    dvec3 *at;              /* m; those of `layout` are worked out; NULL: at `nodes` */
    int at_count;
    study_layout layout;
    const char *nodes; /* pattern of glTF nodes; NULL */
    bool aim_given, aim_at_given;
    dvec3 aim;                  /* {0,0,-1}; at nodes, if not given: as the node is turned */
    dvec3 aim_at;               /* m, a place, in place of aim */
    double rotate_deg;          /* 0 */
    double lumens, lamp_lumens; /* NAN: as the file has it; never both */
    double watts;               /* NAN: as the file has it */
    study_emission emission;
} study_luminaire;

typedef enum study_light_kind {
    STUDY_POINT,
    STUDY_CONE,
    STUDY_COSINE,
    STUDY_PARALLEL,
    STUDY_LINEAR,
    STUDY_DISK,
    STUDY_RECT,
} study_light_kind;

/* Exactly one of the strengths that its kind has is given; with photometry only lumens may be, and
 * need not. What a kind has no key for is as it is initialised. */
typedef struct study_light {
    study_where where;
    const char *name; /* NULL */
    study_light_kind kind;
    dvec3 *at; /* m; of linear: the middles; of parallel: one or none */
    int at_count;
    dvec3 along; /* m, of linear: from `from` to `to`; there is one line only */
    bool aim_at_given, up_given;
    dvec3 aim;      /* {0,0,-1}; of one light at several places: see study_light_aim() */
    dvec3 aim_at;   /* m, a place, in place of aim */
    dvec3 up;       /* rect: {0,1,0}, or {1,0,0} if aim is parallel to that: study_light_up() */
    double size[2]; /* m, rect: across, along up */
    double radius;  /* m, disk; parallel: of the beam, NAN: everywhere */
    double inner_deg, outer_deg;                      /* cone */
    double exponent;                                  /* cosine: 1 */
    double intensity, lumens, luminance, illuminance; /* cd, lm, cd/m^2, lx; NAN: not given */
    const char *photometry; /* linear, disk, rect: ready to open; NULL: Lambertian */
    study_emission emission;
} study_light;

typedef enum study_surface {
    SURFACE_MATT,   /* reflectance; with specular and exponent a lobe on it */
    SURFACE_MIRROR, /* mirror */
    SURFACE_TABLE,  /* brdf */
    SURFACE_BSDF,   /* brdf, a file *.xml */
    SURFACE_PANE,   /* transmittance */
} study_surface;

/* What its surface has no key for is as it is initialised. */
typedef struct study_material {
    study_where where;
    const char *match; /* * and ? */
    study_surface surface;
    vec3 reflectance;   /* diffuse, [0, 1] */
    vec3 specular;      /* [0, 1], the sum of both too; {0,0,0} */
    double exponent;    /* [1, 1e6]; NAN: no lobe */
    vec3 mirror;        /* [0, 1] */
    const char *brdf;   /* ready to open; NULL */
    dvec3 up;           /* where the table's azimuth 0, or a file's up, points to; {0,0,1} */
    bool front_outside; /* the triangles' front looks out, not into the room */
    vec3 transmittance; /* of the whole pane at normal incidence, [0, pane_most(ior)] */
    double ior;         /* (1, 4]; 1.52 */
    bool box;           /* of a closed box of glass; not: of one surface */
} study_material;

/* What a sensor measures. With the light's direction w, its angle e to the vertical and its azimuth
 * a from where the sensor faces, of the radiance L that comes from all around:
 *
 *     planar            integral of L max(0, n . w) dw                  n: the grid's normal
 *     vertical          the same, n being where the sensor faces
 *     cylindrical       integral of L sin(e) / pi dw                    (EN 12464-1)
 *     semicylindrical   integral of L sin(e) (1 + cos(a)) / pi dw       (EN 13201-3)
 */
typedef enum study_quantity {
    QUANTITY_PLANAR,
    QUANTITY_VERTICAL,
    QUANTITY_CYLINDRICAL,
    QUANTITY_SEMICYLINDRICAL,
} study_quantity;

typedef struct study_grid {
    study_where where;
    const char *name;
    dvec3 origin, u, v; /* m, if points is NULL */
    double spacing;     /* m, > 0; of "en12464" that of the side which the standard looks at */
    int count[2];       /* sensors along u and v; 0: by spacing (a grid that no study made) */
    const char *points; /* a CSV file, ready to open (sim/probes.h); NULL: a plane */
    study_quantity quantity;
    dvec3 facing; /* horizontal, unit; of vertical and semicylindrical; else 0 */
    double require_average, require_minimum, require_maximum, require_uniformity; /* lx, lx, lx, 1;
                                                                                NAN: not asked */
    study_side on; /* how it was written: the plane above is what it comes to */
    bool en12464;
    double height, margin; /* m: above the floor, of `on: room`; from the edges, 0 */
} study_grid;

typedef enum study_projection {
    PROJECTION_PERSPECTIVE,
    PROJECTION_ORTHOGRAPHIC,
    PROJECTION_FISHEYE,  /* 180 degrees, equidistant */
    PROJECTION_PANORAMA, /* equirectangular, level whatever the target's height */
} study_projection;

typedef struct study_view {
    study_where where;
    const char *name;
    const char *camera; /* NULL: eye, target and so on */
    dvec3 eye, target;  /* m */
    double fov_deg;     /* horizontal; 60 */
    double width_m;     /* orthographic; else NAN */
    study_projection projection;
    int width, height; /* pixels; 1024, 768; fisheye: 768, 768; panorama: 1024, 512 */
    bool size_given;
} study_view;

/* The whole of a group dimmed, besides what its lights say: `dimming` at the top of a study. Lights
 * without a group, those of glTF files among them, are of the group STUDY_GROUP_OTHER. */
#define STUDY_GROUP_OTHER "other"
typedef struct study_dimming {
    study_where where;
    const char *group;
    double factor; /* >= 0 */
} study_dimming;

typedef struct study {
    const char *path;   /* as given */
    const char *folder; /* of the study: "." or "a/b" */
    study_room room;
    study_site site;
    study_when when;
    study_sky sky;
    study_scene *scenes;
    study_luminaire *luminaires;
    study_light *lights;
    study_material *materials;
    study_grid *grids;
    study_view *views;
    study_dimming *dimmings;
    int scene_count, luminaire_count, light_count, material_count, grid_count, view_count,
        dimming_count;
    const char *variant; /* the one that was merged over the study; NULL */
    double maintenance;  /* 1 */
    bool maintenance_given;
    double accuracy; /* 0.02 for 2%; NAN: not given */
} study;

/* Reads and checks the study at path into a, with its variant of that name (NULL: as it is) merged
 * over it: mappings by key, all else replaced. NULL, with *err naming file, line and column. */
const study *study_read(arena *a, const char *path, const char *variant, notices *n,
                        lux_error *err);

/* The same for a text in memory, of `size` bytes; path is for messages and for what the study
 * names. */
const study *study_parse(arena *a, const char *path, const char *variant, const char *text,
                         size_t size, notices *n, lux_error *err);

/* Sensors of a plane grid along u and along v: as the study asks; of a grid that no study made (all
 * of count 0), max(1, round(length / spacing)). */
void study_grid_counts(const study_grid *g, double *along_u, double *along_v);

/* Sensors along the sides of an area (m, > 0) as EN 12464-1:2011, 4.4, asks for their spacing, and
 * EN 12193 for odd numbers of them, so that one lies in the middle:
 *
 *     p = 0.2 * 5^(log10 d)        [m], at most 10 m
 *
 * with d the longer side or, if that is twice the shorter or more, the shorter one. p is the
 * largest cell allowed: d has the least odd number of cells that is d / p or more; the other side
 * the odd number nearest to its length by the cells of d. Returns d / its number, m. */
double study_counts_en12464(double side, double other, double *along_side, double *along_other);

/* Where the light's place number k shines, not of unit length: its aim, or from there to aim_at;
 * and which way is up in its rectangle, never parallel to that. */
dvec3 study_light_aim(const study_light *l, int k);
dvec3 study_light_up(const study_light *l, int k);

/* What `dimming` at the top of the study says of a group (NULL: STUDY_GROUP_OTHER): 1, if
 * nothing. */
double study_group_factor(const study *s, const char *group);

/* For messages of later stages about a piece of the study: fills *err like failed(), with
 * "PATH:LINE:COLUMN: " before the text (and the variant, if there is one), and returns NULL. */
void *study_failed(const study *s, study_where where, lux_error *err, error_code code,
                   const char *format, ...) __attribute__((format(printf, 5, 6), cold));

/* Whether the whole name matches a pattern with * (any characters, or none) and ? (any one). */
bool study_match(const char *pattern, const char *name);

#endif
