/* sim/cost_subject.c -- what lux4 cost runs: a grid, or a view made small. */
#include "core/color.h"
#include "sim/cost_parts.h"
#include "sim/render.h"

#include <math.h>

enum { MOST_PIXELS = 64 * 48 };

bool cost_subject_of(const study *s, double accuracy, cost_subject *out, lux_error *err)
{
    *out = (cost_subject){ 0 };
    if (s->grid_count > 0) {
        out->grid  = &s->grids[0];
        out->name  = out->grid->name;
        out->asked = !isnan(accuracy)      ? accuracy
                     : !isnan(s->accuracy) ? s->accuracy
                                           : GRID_DEFAULT_PERCENT / 100.0;
        return true;
    }
    if (s->view_count == 0)
        return failed(err, ERR_ARGUMENT, "%s: the study has neither `grids` nor `views`", s->path);
    out->view  = s->views[0];
    out->name  = out->view.name;
    out->asked = isnan(accuracy) ? VIEW_DEFAULT_PERCENT / 100.0 : accuracy;
    double w = out->view.width, h = out->view.height;
    double less      = fmin(sqrt(MOST_PIXELS / (w * h)), 1.0);
    out->view.width  = (int)fmax(floor(w * less), 1.0);
    out->view.height = (int)fmax(floor(h * less), 1.0);
    return true;
}

static bool make_arrays(arena *a, int count, cost_sample *out, lux_error *err)
{
    out->count      = count;
    out->value      = arena_array(a, float, (size_t)count, err);
    out->half_width = out->value ? arena_array(a, float, (size_t)count, err) : NULL;
    return out->half_width != NULL;
}

static bool take_grid(arena *a, arena *scratch, const scene *s, const study_grid *g,
                      const run_options *o, cost_sample *out, lux_error *err)
{
    grid_result r;
    if (!grid_run(scratch, s, g, o, &r, err) || !make_arrays(a, r.sensor_count, out, err))
        return false;
    for (int k = 0; k < r.sensor_count; k++) {
        out->value[k]      = (float)r.illuminance[k];
        out->half_width[k] = (float)r.half_width[k];
    }
    out->floor          = 0.1 * r.average;
    out->reached        = r.reached;
    out->seconds        = r.seconds;
    out->rays           = r.rays;
    out->end            = r.end;
    out->left_to_chance = r.left_to_chance;
    return true;
}

static bool take_view(arena *a, arena *scratch, const scene *s, const study_view *v,
                      const run_options *o, cost_sample *out, lux_error *err)
{
    view_result r;
    if (!view_run(scratch, s, v, o, &r, err) || !make_arrays(a, r.width * r.height, out, err))
        return false;
    for (int k = 0; k < r.width * r.height; k++) {
        vec3 l             = { r.radiance[0][k], r.radiance[1][k], r.radiance[2][k] };
        out->value[k]      = (float)LUMENS_PER_WATT * rgb_luminance(l);
        out->half_width[k] = r.half_width[k];
    }
    out->floor          = 0.1 * r.log_average;
    out->reached        = r.reached;
    out->seconds        = r.seconds;
    out->rays           = r.rays;
    out->end            = r.end;
    out->left_to_chance = r.left_to_chance;
    return true;
}

bool cost_sample_take(arena *a, const scene *s, const cost_subject *of, const run_options *o,
                      cost_sample *out, lux_error *err)
{
    arena scratch = { 0 };
    *out          = (cost_sample){ 0 };
    bool good     = of->grid ? take_grid(a, &scratch, s, of->grid, o, out, err)
                             : take_view(a, &scratch, s, &of->view, o, out, err);
    arena_clear(&scratch);
    return good;
}
