/* sim/render.c -- see render.h. */
#include "sim/render.h"

#include "core/color.h"
#include "core/sampler.h"
#include "sim/render_parts.h"

#include <string.h>

static bool make_planes(arena *a, view_result *out, lux_error *err)
{
    float **planes[] = { &out->radiance[0], &out->radiance[1], &out->radiance[2], &out->illuminance,
                         &out->half_width,  &out->distance,    &out->normal[0],   &out->normal[1],
                         &out->normal[2],   &out->albedo[0],   &out->albedo[1],   &out->albedo[2] };
    for (size_t i = 0; i < sizeof planes / sizeof *planes; i++) {
        *planes[i] = arena_array(a, float, (size_t)out->width *(size_t)out->height, err);
        if (!*planes[i])
            return false;
    }
    out->layers = arena_array(a, view_layer, (size_t)out->layer_count + 1, err);
    for (int l = 0; out->layers && l < out->layer_count; l++) {
        view_layer *layer = &out->layers[l];
        float **own[]     = { &layer->radiance[0], &layer->radiance[1], &layer->radiance[2],
                              &layer->illuminance, &layer->half_width };
        for (size_t i = 0; i < sizeof own / sizeof *own; i++) {
            *own[i] = arena_array(a, float, (size_t)out->width *(size_t)out->height, err);
            if (!*own[i])
                return false;
        }
    }
    return out->layers != NULL;
}

/* The layers of pixel i, which is number `to` of the picture. */
static void take_layers(const view_run_state *v, const accuracy_result *got, view_result *out,
                        size_t i, size_t to)
{
    size_t n    = (size_t)(out->width * out->height);
    double seen = got->mean[(size_t)(SEEN + before_plain(v)) * n + i];
    for (int l = 0; l < v->layers; l++) {
        view_layer *layer = &out->layers[l];
        const double *mean =
            got->mean + (size_t)(CHANNELS + before_plain(v) + OF_LAYER * l) * n + i;
        for (size_t c = 0; c < 3; c++)
            layer->radiance[c][to] = (float)(mean[c * n]);
        layer->illuminance[to] = seen > 0.0 ? (float)(mean[3 * n] / seen) : 0.0f;
        layer->half_width[to]  = (float)(got->half_width[(size_t)(FIRST_LAYER + l) * n + i]);
    }
}

/* What the plan left out may be that far off, of max(luminance, a tenth of the log-average). */
static void widen(const view_run_state *v, const accuracy_result *got, view_result *out)
{
    for (int i = 0; v->o->bound > 0.0 && i < out->width * out->height; i++) {
        int x, y;
        view_pixel(&v->camera, (uint32_t)i, &x, &y);
        double against = fmax(got->mean[i], 0.1 * out->log_average);
        out->half_width[y * out->width + x] += (float)(v->o->bound * against);
    }
}

static void take_pixels(const view_run_state *v, const accuracy_result *got, view_result *out)
{
    int items          = out->width * out->height;
    const double *mean = got->mean + (size_t)(before_plain(v) * items); /* as plain_of() */
    double logs = 0.0, bright = 0.0;
    for (int i = 0; i < items; i++) {
        int x, y;
        view_pixel(&v->camera, (uint32_t)i, &x, &y);
        size_t to = (size_t)y * (size_t)out->width + (size_t)x, n = (size_t)items, from = (size_t)i;
        double seen = mean[SEEN * n + from], length2 = 0.0;
        for (size_t c = 0; c < 3; c++) {
            out->radiance[c][to] = (float)(mean[(RED + c) * n + from]);
            out->albedo[c][to] = seen > 0.0 ? (float)(mean[(ALBEDO + c) * n + from] / seen) : 0.0f;
            length2 += mean[(NORMAL + c) * n + from] * mean[(NORMAL + c) * n + from];
        }
        for (size_t c = 0; c < 3; c++)
            out->normal[c][to] =
                length2 > 0.0 ? (float)(mean[(NORMAL + c) * n + from] / sqrt(length2)) : 0.0f;
        out->illuminance[to] = seen > 0.0 ? (float)(mean[ILLUMINANCE * n + from] / seen) : 0.0f;
        out->distance[to]    = seen > 0.0 ? (float)(mean[DISTANCE * n + from] / seen) : 0.0f;
        out->half_width[to] =
            (float)(got->half_width[i] +
                    (v->o->pilot ? 0.0 : STEPS_SMOOTHED * fabs(mean[SMOOTHED * n + from])));
        double luminance = got->mean[LUMINANCE * n + from];
        take_layers(v, got, out, from, to);
        if (luminance > 0.0)
            logs += log(luminance), bright += 1.0;
    }
    out->log_average = bright > 0.0 ? exp(logs / bright) : 0.0;
    widen(v, got, out);
    out->reached = got->reached + v->o->bound;
    out->end     = got->end;
}

static bool make_threads(view_run_state *v, arena *a, lux_error *err)
{
    const sun_patches *patches = NULL;
    if (!v->o->direct_only &&
        !sun_patches_new(a, v->s, v->seed, v->asked, v->o->threads, &patches, err))
        return false;
    if (!light_maps_make(a, v->s, v->o, v->asked, NULL, &v->maps, err))
        return false;
    bool maps  = v->maps.indirect || v->maps.focused;
    v->shown   = lamps_that_show(a, v->s, err);
    v->threads = v->shown.lamps ? arena_array(a, view_scratch, (size_t)v->o->threads, err) : NULL;
    for (int t = 0; v->threads && t < v->o->threads; t++) {
        view_scratch *w = &v->threads[t];
        w->paths        = path_tracer_new(a, v->s, err);
        if (v->layers) {
            w->bundle.layers = arena_array(a, path_sums, 2 * (size_t)v->layers, err);
            w->eye.layers    = arena_array(a, path_sums, 2 * (size_t)v->layers, err);
        }
        if (maps) {
            w->bundle.smoothed = arena_array(a, float, PATHS, err);
            w->eye.smoothed    = arena_array(a, float, PATHS, err);
        }
        w->lamps = arena_array(a, int32_t, (size_t)v->shown.count + 1, err);
        if (!w->paths || !w->lamps || (maps && !(w->bundle.smoothed && w->eye.smoothed)) ||
            (v->layers && !(w->bundle.layers && w->eye.layers)))
            return false;
        path_use_patches(w->paths, patches);
        path_use_maps(w->paths, v->maps.indirect, v->maps.focused);
        if (v->o->pilot && scene_focuses(v->s))
            path_leave_focused(w->paths);
    }
    return v->threads != NULL;
}

static bool run(arena *a, arena *scratch, view_run_state *v, view_result *out, lux_error *err)
{
    if (!make_planes(a, out, err) || !make_threads(v, scratch, err))
        return false;
    accuracy_desc d = { .items    = out->width * out->height,
                        .channels = CHANNELS + before_plain(v) + OF_LAYER * v->layers,
                        .judged   = 1 + before_plain(v),
                        .common   = v->maps.indirect || v->maps.focused,
                        .accuracy = (out->asked - v->o->bound) * (v->maps.indirect ? 0.9 : 1.0),
                        .needed   = VIEW_NEEDED_PERCENT / 100.0,
                        .floor    = FLOOR_LOG_MEAN,
                        .first_samples = VIEW_FIRST_SAMPLES,
                        .only_samples  = v->o->only_samples,
                        .threads       = v->o->threads,
                        .deadline      = v->o->deadline,
                        .progress      = v->o->progress,
                        .sample        = view_sample,
                        .context       = v };
    accuracy_result got;
    if (!accuracy_run(scratch, &d, &got, err))
        return false;
    if (!got.complete)
        return failed(err, ERR_INTERRUPTED, "interrupted before view %s had its first picture",
                      out->view->name);
    take_pixels(v, &got, out);
    return true;
}

bool view_run(arena *a, const scene *s, const study_view *view, const run_options *o,
              view_result *out, lux_error *err)
{
    double begun     = clock_seconds();
    arena scratch    = { 0 };
    uint32_t seed    = hash_text_u32(hash_u32(~o->seed), view->name);
    view_run_state v = { .s      = s,
                         .o      = o,
                         .paths  = { .lamps         = true,
                                     .bounce        = !o->direct_only,
                                     .bounded       = o->bounded,
                                     .bounces       = o->bounces,
                                     .roulette_from = o->roulette_from },
                         .layers = s->layered ? s->group_count : 0,
                         .seed   = seed };
    if (!camera_of_view(s, view, &v.camera, err))
        return false;
    v.eye_paths        = v.paths;
    v.eye_paths.eye    = true;
    v.eye_paths.spread = v.camera.spread;
    *out               = (view_result){ .view        = view,
                                        .layer_count = v.layers,
                                        .width       = v.camera.width,
                                        .height      = v.camera.height,
                                        .asked = isnan(o->accuracy) ? VIEW_DEFAULT_PERCENT / 100.0 : o->accuracy,
                                        .left_to_chance = scene_left_to_chance(s, o->direct_only) };
    v.asked            = out->asked;
    progress_begin(o->progress, view->name);
    bool good = run(a, &scratch, &v, out, err);
    if (!good && err->code == ERR_INTERRUPTED)
        failed(err, ERR_INTERRUPTED, "interrupted before view %s had its first picture",
               view->name);
    out->rays = v.maps.rays;
    for (int t = 0; good && t < o->threads; t++)
        out->rays += v.threads[t].ray_count + path_rays(v.threads[t].paths);
    out->seconds = clock_seconds() - begun;
    arena_clear(&scratch);
    return good;
}
