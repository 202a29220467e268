/* sim/render.h -- what a view shows: radiance, and beside it what a designer asks of a picture. */
#ifndef SIM_RENDER_H
#define SIM_RENDER_H

#include "sim/camera.h"
#include "sim/grid.h"

enum {
    VIEW_DEFAULT_PERCENT = 10,
    VIEW_NEEDED_PERCENT  = 98, /* of pixels, that must be as accurate as asked for */
    VIEW_FIRST_SAMPLES   = 1,  /* rays a pixel and scramble, in the first round */
};

/* What one group of lamps gives, undimmed: as in view_result. */
typedef struct view_layer {
    float *radiance[3], *illuminance, *half_width;
} view_layer;

/* Pixel means, top row first. */
typedef struct view_result {
    const study_view *view;
    int width, height;
    float *radiance[3]; /* W/(sr m^2), maintenance applied */
    float *illuminance; /* lx, on the surface seen */
    float *half_width;  /* cd/m^2, of the luminance: half of its 95 % interval */
    float *distance;    /* m, along the ray; 0 where nothing is seen */
    float *normal[3];   /* unit, toward the eye; 0 where nothing is seen */
    float *albedo[3];

    int layer_count;
    view_layer *layers; /* of the scene's groups, if it is layered */

    double asked, reached;      /* accuracy: what was asked, what 98 % of the pixels have */
    double log_average;         /* cd/m^2, of the pixels that are not black */
    run_end end;                /* why it ended; what is here is complete all the same */
    const char *left_to_chance; /* why the intervals are not valid; NULL: they are */
    double seconds;
    int64_t rays;
} view_result;

/* Runs a view of the scene's study. False, with *err, if memory is out or (ERR_INTERRUPTED) the
 * user stopped it before every pixel had a first value. */
bool view_run(arena *a, const scene *s, const study_view *v, const run_options *o, view_result *out,
              lux_error *err);

/* The radiometric picture: the channels of interface.md. */
bool view_write_exr(const char *path, const scene *s, const view_result *r, bool half, notices *n,
                    lux_error *err);

/* The preview: tone-mapped, 8-bit sRGB. */
bool view_write_png(const char *path, const view_result *r, double exposure_ev, lux_error *err);

#endif
