/* sim/render_parts.h -- what the files of render.h share: render.c runs a view, render_sample.c
 * takes samples of its pixels.
 */
#ifndef SIM_RENDER_PARTS_H
#define SIM_RENDER_PARTS_H

#include "sim/accuracy.h"
#include "sim/camera.h"
#include "sim/light_maps.h"
#include "sim/path.h"
#include "sim/render.h"
#include "sim/seen_lamps.h"

/* What accuracy_run() averages. The luminance comes first: it is held to the accuracy. */
enum {
    LUMINANCE,
    RED,
    GREEN,
    BLUE,
    ILLUMINANCE,
    SEEN, /* 1 where the ray meets a surface; the next are 0 elsewhere */
    DISTANCE,
    NORMAL,
    ALBEDO   = NORMAL + 3,
    SMOOTHED = ALBEDO + 3, /* cd/m^2, by which it would be less if maps were coarser by a step */
    CHANNELS,
};

/* In a layered scene the luminances of all light undimmed and of groups, which are judged as well,
 * stand between the first and the others; behind all stand, for each group, red, green, blue and
 * illuminance. */
enum { FULL_LUMINANCE = 1, FIRST_LAYER = 2, OF_LAYER = 4 };

enum { PACKETS = BUNDLE / LANES, TILE = 8 /* pixels a side, sampled together */ };
_Static_assert((int)BUNDLE <= (int)PATHS, "what is asked for at once fits a path bundle");

typedef struct view_scratch {
    path_tracer *paths;
    path_bundle bundle, eye; /* from what is seen; from the eye, where that is called for */
    vray rays[PACKETS];
    vmask active[PACKETS];
    vmask passed[PACKETS]; /* through glass or holes, before what is seen */
    vhit hits[PACKETS];
    int32_t sample_of[BUNDLE], eye_sample_of[BUNDLE]; /* of each path */
    int32_t *lamps;                                   /* that the rays may meet */
    int before;
    int64_t ray_count;
} view_scratch;

typedef struct view_run_state {
    const scene *s;
    const run_options *o;
    camera camera;
    view_scratch *threads;
    light_maps maps;
    path_options paths, eye_paths;
    int layers; /* 0 unless the scene is layered */
    seen_lamps shown;
    double asked; /* the accuracy */
    uint32_t seed;
} view_run_state;

/* How many channels a layered scene has between LUMINANCE and the others. */
static inline int before_plain(const view_run_state *v)
{
    return v->layers ? FIRST_LAYER - 1 + v->layers : 0;
}

/* Where the channels above begin: all but LUMINANCE. */
static inline float *plain_of(const view_run_state *v, float *values)
{
    return values + before_plain(v) * BUNDLE;
}

/* Red, green, blue and illuminance of a layer. */
static inline float *layer_of(const view_run_state *v, float *values, int layer)
{
    return plain_of(v, values) + (CHANNELS + OF_LAYER * layer) * BUNDLE;
}

/* Items are pixels tile by tile, so that those sampled together see the same things. */
void view_pixel(const camera *c, uint32_t item, int *x, int *y);

/* Values of samples, as accuracy_run() asks for them: context is a view_run_state. */
void view_sample(void *context, int thread, const sample_id *ids, int count, float *values);

#endif
