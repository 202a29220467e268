/* sim/grid_parts.h -- what the files of grid.h share: grid.c runs a grid, grid_sample.c finds what
 * its sensors get, grid_results.c what that comes to.
 */
#ifndef SIM_GRID_PARTS_H
#define SIM_GRID_PARTS_H

#include "sim/accuracy.h"
#include "sim/direct_sensor.h"
#include "sim/grid.h"
#include "sim/light_maps.h"
#include "sim/path.h"
#include "sim/sun_seen.h"

#include <stdatomic.h>

/* Of accuracy_run(). First what is judged: all light as dimmed and, in a layered scene, the same
 * undimmed, and of each layer; of a series instead all light of each moment. What of each of these
 * (but not of FULL) is direct stands in the same order from `straight` on. */
enum { SAMPLED, FULL, LAYERS };
typedef struct grid_channels {
    int judged;
    int classes; /* LIGHT_CLASSES, of all as dimmed; -1: of a series not asked for */
    int straight, straight_count;
    int met;      /* what sees a reflecting surface */
    int smoothed; /* by how much maps would be off if they were coarser; -1: there are none */
    int outside;  /* -1: not asked for; so are the next */
    int electric; /* what is no daylight */
    int count;
} grid_channels;

typedef struct thread_scratch {
    direct_sensor *direct;
    sun_seen *suns;
    path_tracer *paths;
    path_bundle bundle;
    sensor_sum *sums;
    float lamp_e[BUNDLE]; /* W/m^2 of each sample, and which lamp's it is */
    int32_t lamp[BUNDLE];
    float
        sun_e[BUNDLE]; /* W/m^2, of each sample, beside what is known, and which sun's; -1: none */
    int32_t sun[BUNDLE];
    float *of_layer, *direct_of_layer; /* lx, of one sample, one a group */
} thread_scratch;

/* Squares about sensors, as they are fitted to what their light calls for. */
typedef struct grid_squares {
    map_sensors of;
    float *side, *allowed;
} grid_squares;

/* What maps know of a square's light, lx. */
typedef struct grid_focus {
    double lux;
    double smoothed; /* how far off that may make it, */
    double own;      /* and as the square alone tells; */
    double doubt;    /* what of that may be noise */
} grid_focus;

typedef struct grid_run_state {
    double begun; /* s, on clock_seconds() */
    const scene *s;
    const run_options *o;
    grid_result *r;
    thread_scratch *threads;
    int layers;            /* groups, if the scene is layered; else 0 */
    int moments;           /* of a series; else 0 */
    double *known, *bound; /* lx: of each layer, or of all; [layer * sensors + sensor] */
    double *fixed;         /* lx: half widths that are of maps alone, in the same order; NULL */
    grid_focus *focus;     /* of focused light, in the same order; NULL */
    double *sun_known;     /* lx: of each sun, [sun * sensors + sensor]; NAN: samples add nothing */
    double *sun_share;     /* what of it is seen */
    const double *rough;   /* lx, in the same order: see grid_find_rough() */
    light_maps maps;
    int refined; /* times */
    bool disks;  /* some sun is more than a point */
    grid_channels channels;
    path_options paths;
    atomic_bool lamps_left; /* some lamps take samples */
    uint32_t seed;          /* of this grid */
} grid_run_state;

/* Maps of the run, and g->fixed (grid_maps.c). */
bool grid_make_maps(grid_run_state *g, arena *a, lux_error *err);

/* Squares of the first map of focused light, in a; then maps, until they are good enough or take
 * too long: g->maps.focused, g->fixed, g->focus (grid_focus.c). */
bool grid_squares_new(const grid_run_state *g, arena *a, grid_squares *q, lux_error *err);
bool grid_grow_focused(grid_run_state *g, arena *a, grid_squares *q, lux_error *err);

/* g->rough, which tells how good maps have to be. */
bool grid_find_rough(grid_run_state *g, arena *a, lux_error *err);

/* *finer: the map of interreflected light was made anew, of four times the particles, as it alone
 * keeps sensors from the accuracy asked for. That is done once at most, where there is time; not
 * with maps of a file or of other runs. If the user stops it *got is what there is. */
bool grid_refine_maps(grid_run_state *g, arena *a, accuracy_result *got, bool *finer,
                      lux_error *err);

/* Of parallel_for(): sensors item * GRID_CHUNK and so on, whose known light is summed. */
enum { GRID_CHUNK = 64 };
void grid_sum_chunk(void *context, int item, int thread);

/* Of accuracy_run(); context is a grid_run_state. */
void grid_sample(void *context, int thread, const sample_id *ids, int count, float *values);

/* Room for results, which g->channels tells of; in a. */
bool grid_make_results(arena *a, const grid_run_state *g, grid_result *out, lux_error *err);

/* Whether some sensor is not as accurate as asked, with what maps smooth. */
bool grid_is_smoothed(const grid_run_state *g, const accuracy_result *got);

/* Once: what was sampled (NULL: nothing was) and what was known before. */
void grid_take_results(const grid_run_state *g, const accuracy_result *got, grid_result *r);

/* Extremes and means, and how many sensors are not as accurate as asked. */
void grid_summarise(grid_result *r);

/* At a lamp itself illuminance has no bound: false, with *err. */
bool grid_all_finite(const scene *s, const grid_result *r, lux_error *err);

#endif
