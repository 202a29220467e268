/* sim/grid.h -- how much light arrives at the sensors of a grid. */
#ifndef SIM_GRID_H
#define SIM_GRID_H

#include "core/progress.h"
#include "sim/accuracy.h"
#include "sim/scene.h"

/* How interreflected light is found. */
typedef enum transport {
    TRANSPORT_AUTO, /* as the plan says (plan.h); where there is none, by paths */
    TRANSPORT_PATH,
    TRANSPORT_MAPS, /* illumination_map.h */
} transport;

/* Light by the way that it has come, whoever found it: each light is of one class. */
typedef enum light_class {
    CLASS_DIRECT,    /* straight from lamp, sun or sky, thin glass between or not */
    CLASS_REFLECTED, /* all that is none of the others */
    CLASS_MIRRORED,  /* from a lamp or sun by way of plane mirrors and panes alone (mirrors.h) */
    CLASS_FOCUSED,   /* from a lamp or sun by way of other mirrors and of solids that refract */
    LIGHT_CLASSES
} light_class;

/* What is asked of a run, grids and views alike. */
typedef struct run_options {
    double accuracy; /* relative, > 0; NAN: the study's, or else the default of the command */
    double deadline; /* s, on clock_seconds(); INFINITY: none */
    uint32_t seed;
    int threads; /* >= 1 */
    bool direct_only;
    bool outside; /* grids: tell grid_result.outside */
    transport transport;
    const char *maps; /* file of illumination maps: read if it is there, else made; NULL */
    const struct illumination_map *indirect; /* made before, for TRANSPORT_MAPS; NULL */
    bool bounded;                            /* `bounces` counts */
    int bounces;        /* reflections at most, >= 0: what comes after more is left out */
    int roulette_from;  /* reflections before which no path is ended by chance */
    int only_samples;   /* a sensor or pixel, neither fewer nor more; 0: as accuracy asks */
    bool pilot;         /* a trial (plan_pilot.c): focused light, for which there are maps in any
                           case, is left out, and half widths are without what maps smooth */
    int most_sensors;   /* of a grid, spread over it; 0: all */
    double bound;       /* relative: how far off what the plan left out may make a result */
    progress *progress; /* may be NULL */
} run_options;

typedef struct grid_sensor {
    dvec3 at;     /* m, in the user's frame */
    dvec3 normal; /* unit */
} grid_sensor;

/* What one group of lamps gives, undimmed: lx, a sensor. */
typedef struct grid_layer {
    double *illuminance, *direct, *half_width;
} grid_layer;

/* What one moment of a series gives, all lamps included: lx, a sensor. */
typedef struct grid_moment {
    double *illuminance, *direct, *half_width;
    double *sun; /* [0, 1]: the share of the sun's disk that is seen, glass or not */
} grid_moment;

/* All light is in lux, maintenance applied to what is no daylight. */
typedef struct grid_result {
    const study_grid *grid;
    int columns, rows; /* cells along u and v; a list of points has one row */
    int sensor_count;
    const grid_sensor *sensors; /* in the order of their cells */
    const int *cell;            /* of each: row * columns + column */
    int left_out;               /* cells whose sensor would lie inside something solid */
    bool shell_outward;         /* nearly all would: what encloses them shows them its back */
    double *illuminance, *direct, *indirect, *half_width; /* lx, a sensor */
    int layer_count;
    grid_layer *layers; /* of the scene's groups, if it is layered */
    int moment_count;   /* of a series, else 0: `illuminance` and all that follows are then of the
                           first moment, `missed` and `reached` of all */
    grid_moment *moments;
    struct {
        double average, half_width; /* lx, of the grid's average */
    } classes[LIGHT_CLASSES];
    double *outside;  /* lx, a sensor, if asked for: of `indirect` */
    double *smooth;   /* lx, a sensor: what illumination maps may smooth; NULL: there are none */
    double *electric; /* lx, a sensor: what is not daylight, where a scene has both; NULL */

    double average, minimum, maximum, uniformity; /* lx, lx, lx; minimum / average, 0 if dark */
    double average_half_width;                    /* lx: all errors that sensors share counted */
    double worst_half_width;    /* relative to max(illuminance, a tenth of the average) */
    double asked;               /* the accuracy that was asked for */
    int missed;                 /* sensors whose half width is beyond it */
    double left_out_lm;         /* lm: of light that maps are to find, what they do not hold */
    bool smoothed;              /* half widths hold what illumination maps smooth */
    int in_doubt;               /* that see surfaces, and by way of them no light at all */
    double reached;             /* the accuracy that every sensor has */
    run_end end;                /* why it ended; what is here is complete all the same */
    const char *left_to_chance; /* why the intervals are not valid; NULL: they are */
    double seconds;
    int64_t rays, known_rays; /* and those of them that no number of samples adds to */
} grid_result;

enum { GRID_DEFAULT_PERCENT = 2 };

/* The sensors of a grid in a, in rows and columns, but for those of a plane that lie inside
 * something solid (inside.h). False, with *err, for a bad points file, or if no sensor is left. */
bool grid_sensors(arena *a, const scene *s, const study_grid *g, grid_result *out, lux_error *err);

/* Whether its grids go by paths whatever is asked for: maps tell of all light together, moments of
 * a series, or daylight and other light that has another maintenance, are told apart. */
bool grid_needs_paths(const scene *s);

/* Runs grid g of the scene's study. False, with *err, if memory is out, a points file is bad, or
 * (ERR_INTERRUPTED) the user stopped it before there was anything to tell. */
bool grid_run(arena *a, const scene *s, const study_grid *g, const run_options *o, grid_result *out,
              lux_error *err);

/* Average, minimum and maximum with `maintenance` taken back: of electric light alone where there
 * is daylight, too. */
typedef struct grid_summary {
    double average, minimum, maximum; /* lx */
} grid_summary;
grid_summary grid_initial(const grid_result *r, double maintenance);

/* "illuminance", "cylindrical illuminance", ... */
const char *grid_quantity_name(study_quantity q);

/* One requirement of the study against what was got. */
typedef struct grid_requirement {
    const char *name; /* "average", ... */
    const char *unit; /* "lx" or "" */
    double asked, got;
    double half_width; /* how far `got` may be off */
    bool met;
    bool decided; /* whatever the truth within that: else more accuracy is needed to tell */
} grid_requirement;
enum { MOST_REQUIREMENTS = 4 };
int grid_requirements(const grid_result *r, grid_requirement out[MOST_REQUIREMENTS]);

#endif
