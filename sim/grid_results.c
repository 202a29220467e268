/* sim/grid_results.c -- what the samples of a grid come to: values, half-widths, a summary. */
#include "sim/grid_parts.h"

#include <float.h>

static bool make_moments(arena *a, const grid_run_state *g, grid_result *out, lux_error *err)
{
    size_t n          = (size_t)out->sensor_count;
    out->moment_count = g->moments;
    out->moments      = arena_array(a, grid_moment, (size_t)g->moments + 1, err);
    for (int h = 0; out->moments && h < g->moments; h++) {
        grid_moment *to = &out->moments[h];
        to->illuminance = arena_array(a, double, n, err);
        to->direct      = to->illuminance ? arena_array(a, double, n, err) : NULL;
        to->half_width  = to->direct ? arena_array(a, double, n, err) : NULL;
        to->sun         = to->half_width ? arena_array(a, double, n, err) : NULL;
        if (!to->sun)
            return false;
    }
    return out->moments != NULL;
}

static bool make_layers(arena *a, const grid_run_state *g, grid_result *out, lux_error *err)
{
    size_t n         = (size_t)out->sensor_count;
    out->layer_count = g->moments ? 0 : g->layers;
    out->layers      = arena_array(a, grid_layer, (size_t)g->layers + 1, err);
    for (int l = 0; out->layers && l < out->layer_count; l++) {
        grid_layer *to  = &out->layers[l];
        to->illuminance = arena_array(a, double, n, err);
        to->direct      = to->illuminance ? arena_array(a, double, n, err) : NULL;
        to->half_width  = to->direct ? arena_array(a, double, n, err) : NULL;
        if (!to->half_width)
            return false;
    }
    return out->layers != NULL;
}

bool grid_make_results(arena *a, const grid_run_state *g, grid_result *out, lux_error *err)
{
    double **all[] = { &out->illuminance,
                       &out->direct,
                       &out->indirect,
                       &out->half_width,
                       g->channels.outside >= 0 ? &out->outside : NULL,
                       g->channels.smoothed >= 0 ? &out->smooth : NULL,
                       g->channels.electric >= 0 ? &out->electric : NULL };
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        if (all[i] && !(*all[i] = arena_array(a, double, (size_t)out->sensor_count, err)))
            return false;
    return make_layers(a, g, out, err) && make_moments(a, g, out, err);
}

void grid_summarise(grid_result *r)
{
    double sum = 0.0;
    int over   = 0; /* sensors */
    r->minimum = HUGE_VAL;
    r->maximum = 0.0;
    for (int k = 0; k < r->sensor_count; k++) {
        sum += r->illuminance[k];
        r->minimum = fmin(r->minimum, r->illuminance[k]);
        r->maximum = fmax(r->maximum, r->illuminance[k]);
    }
    r->average    = sum / r->sensor_count;
    r->uniformity = r->average > 0.0 ? r->minimum / r->average : 0.0;
    for (int k = 0; k < r->sensor_count; k++) {
        double against      = fmax(r->illuminance[k], 0.1 * r->average);
        double ratio        = r->half_width[k] > 0.0 ? r->half_width[k] / against : 0.0;
        r->worst_half_width = fmax(r->worst_half_width, ratio);
        over += ratio > r->asked;
    }
    bool sampled = !isnan(r->reached);
    if (sampled && !r->smoothed && (r->moment_count || !r->layer_count))
        return;
    r->missed  = over; /* as the bounds say; or of layers, which alone were held to the accuracy */
    r->reached = fmax(r->reached, r->worst_half_width);
    if (!sampled && over)
        r->end = RUN_HELD_UP;
}

grid_summary grid_initial(const grid_result *r, double maintenance)
{
    double sum     = 0.0;
    grid_summary g = { .minimum = HUGE_VAL };
    for (int k = 0; k < r->sensor_count; k++) {
        double electric = r->electric ? r->electric[k] : r->illuminance[k];
        double initial  = r->illuminance[k] - electric + electric / maintenance;
        sum += initial;
        g.minimum = fmin(g.minimum, initial);
        g.maximum = fmax(g.maximum, initial);
    }
    g.average = sum / r->sensor_count;
    return g;
}

bool grid_all_finite(const scene *s, const grid_result *r, lux_error *err)
{
    for (int k = 0; k < r->sensor_count; k++) {
        const dvec3 *at = &r->sensors[k].at;
        if (!isfinite(r->illuminance[k]) || !isfinite(r->half_width[k]) ||
            r->illuminance[k] > (double)FLT_MAX)
            return study_failed(s->study, r->grid->where, err, ERR_ARGUMENT,
                                "grid `%s`: the sensor at (%g, %g, %g) m has no finite "
                                "illuminance: a light is all but at it, or far too strong",
                                r->grid->name, at->x, at->y, at->z);
    }
    return true;
}

/* A channel's mean at sensor k; nothing was sampled: 0. */
static double mean_of(const grid_run_state *g, const accuracy_result *got, int channel, size_t k)
{
    return got ? got->mean[(size_t)channel * (size_t)g->r->sensor_count + k] : 0.0;
}

static double half_width_of(const grid_run_state *g, const accuracy_result *got, int channel,
                            size_t k)
{
    size_t at = (size_t)channel * (size_t)g->r->sensor_count + k;
    return got ? got->half_width[at] : g->bound[at];
}

static double known_of(const grid_run_state *g, int channel, size_t k)
{
    return g->known[(size_t)channel * (size_t)g->r->sensor_count + k];
}

static void take_moments(const grid_run_state *g, const accuracy_result *got, size_t k)
{
    const scene *s = g->s;
    grid_result *r = g->r;
    for (int h = 0; h < g->moments; h++) {
        grid_moment *to    = &r->moments[h];
        double known       = known_of(g, h, k);
        double all         = known + mean_of(g, got, h, k);
        to->illuminance[k] = fmax(all, 0.0);
        to->direct[k]      = known + mean_of(g, got, g->channels.straight + h, k);
        to->half_width[k]  = half_width_of(g, got, h, k);
    }
    for (int i = 0; i < s->sun_count; i++) {
        int h                = s->light_info[scene_lamp_count(s) + i].group - 1;
        r->moments[h].sun[k] = g->sun_share[(size_t)i * (size_t)r->sensor_count + k];
    }
    r->illuminance[k] = r->moments[0].illuminance[k];
    r->direct[k]      = r->moments[0].direct[k];
    r->half_width[k]  = r->moments[0].half_width[k];
}

static void take_layers(const grid_run_state *g, const accuracy_result *got, size_t k)
{
    for (int l = 0; l < g->layers; l++) {
        const grid_layer *to = &g->r->layers[l];
        double known         = known_of(g, LAYERS + l, k);
        to->illuminance[k]   = known + mean_of(g, got, LAYERS + l, k);
        to->direct[k]        = known + mean_of(g, got, g->channels.straight + 1 + l, k);
        to->half_width[k]    = half_width_of(g, got, LAYERS + l, k);
    }
}

/* Of a series at no moment: at some it may be night. */
static bool found_nothing(const grid_run_state *g, const accuracy_result *got, size_t k)
{
    bool nothing = true;
    for (int h = 0; h < g->moments || h == 0; h++)
        nothing = nothing && mean_of(g, got, SAMPLED + h, k) == 0.0;
    return nothing;
}

/* lx: how far off what cells of surfaces smooth may make all light as dimmed at sensor k. */
static double smoothed_by_cells(const grid_run_state *g, const accuracy_result *got, size_t k)
{
    int c = g->channels.smoothed;
    return c < 0 ? 0.0 : STEPS_SMOOTHED * fabs(mean_of(g, got, c, k));
}

/* The same of channel q, which has `share` of all light, with what squares smooth. */
static double smoothed_of(const grid_run_state *g, const accuracy_result *got, int q, size_t k,
                          double share)
{
    double squares = g->focus ? g->focus[(size_t)q * (size_t)g->r->sensor_count + k].smoothed : 0.0;
    return squares + share * smoothed_by_cells(g, got, k);
}

bool grid_is_smoothed(const grid_run_state *g, const accuracy_result *got)
{
    size_t n    = (size_t)g->r->sensor_count;
    double mean = 0.0;
    int over    = 0;
    for (int pass = 0; pass < 2 && g->channels.smoothed >= 0; pass++)
        for (size_t k = 0; k < n; k++) {
            double all  = known_of(g, SAMPLED, k) + mean_of(g, got, SAMPLED, k);
            double half = half_width_of(g, got, SAMPLED, k) + smoothed_of(g, got, SAMPLED, k, 1.0);
            double most = (g->r->asked - g->o->bound) * fmax(all, 0.1 * mean);
            if (pass == 0)
                mean += all / (double)n;
            else
                over += half > most;
        }
    return over > 0;
}

/* What the plan left out may be that far off, of max(value, a tenth of the average); by how much
 * that is on average. */
static double widen(const grid_run_state *g, const double *e, double *half_width)
{
    int n          = g->r->sensor_count;
    double average = 0.0, added = 0.0;
    for (int k = 0; k < n; k++)
        average += e[k] / n;
    for (int k = 0; k < n; k++) {
        double more = g->o->bound * fmax(e[k], 0.1 * average);
        half_width[k] += more;
        added += more / n;
    }
    return added;
}

static void widen_all(const grid_run_state *g, grid_result *r)
{
    if (g->o->bound == 0.0)
        return;
    r->average_half_width += widen(g, r->illuminance, r->half_width);
    for (int l = 0; l < r->layer_count; l++)
        widen(g, r->layers[l].illuminance, r->layers[l].half_width);
    for (int h = 0; h < r->moment_count; h++)
        widen(g, r->moments[h].illuminance, r->moments[h].half_width);
}

/* What layer l, undimmed, is of all light as dimmed at sensor k. */
static double share_of_layer(const grid_result *r, int l, size_t k)
{
    return r->illuminance[k] > 0.0 ? r->layers[l].illuminance[k] / r->illuminance[k] : 0.0;
}

/* What of the light of all moments together at sensor k is that of moment h, at most: what they
 * share, as lamps that are always on, is no more than the least of them. */
static double share_of_moment(const grid_result *r, int h, size_t k)
{
    double sum = 0.0, least = HUGE_VAL;
    for (int i = 0; i < r->moment_count; i++) {
        sum += r->moments[i].illuminance[k];
        least = fmin(least, r->moments[i].illuminance[k]);
    }
    double all = sum - (r->moment_count - 1) * least;
    return all > 0.0 ? r->moments[h].illuminance[k] / all : 0.0;
}

static void widen_by_smoothing(const grid_run_state *g, const accuracy_result *got, grid_result *r,
                               size_t k)
{
    for (int l = 0; l < r->layer_count; l++)
        r->layers[l].half_width[k] += smoothed_of(g, got, LAYERS + l, k, share_of_layer(r, l, k));
    for (int h = 0; h < r->moment_count; h++)
        r->moments[h].half_width[k] += smoothed_of(g, got, h, k, share_of_moment(r, h, k));
    double share = r->moment_count ? share_of_moment(r, 0, k) : 1.0;
    r->half_width[k] += smoothed_of(g, got, SAMPLED, k, share);
}

static double mean_bound(const grid_run_state *g)
{
    double sum = 0.0;
    for (int k = 0; k < g->r->sensor_count; k++)
        sum += g->bound[k];
    return sum / g->r->sensor_count;
}

/* How far off what cells, or squares, smooth may make the average: of many squares those count as
 * they are that happen to tell too little. */
static double mean_smoothed_by_cells(const grid_run_state *g, const accuracy_result *got)
{
    double sum = 0.0;
    for (int k = 0; k < g->r->sensor_count; k++)
        sum += smoothed_by_cells(g, got, (size_t)k);
    return sum / g->r->sensor_count;
}

static double mean_smoothed_by_squares(const grid_run_state *g)
{
    double sum = 0.0;
    for (int k = 0; g->focus && k < g->r->sensor_count; k++)
        sum += g->focus[k].own;
    return sum / g->r->sensor_count;
}

/* What of the average is of each class. */
static void take_classes(const grid_run_state *g, const accuracy_result *got, grid_result *r)
{
    size_t n = (size_t)r->sensor_count;
    for (size_t k = 0; k < n; k++)
        r->classes[CLASS_DIRECT].average += g->known[k] / (double)n;
    r->classes[CLASS_DIRECT].half_width = mean_bound(g);
    if (!got || g->channels.classes < 0)
        return;
    for (int c = 0; c < LIGHT_CLASSES; c++) {
        for (size_t k = 0; k < n; k++)
            r->classes[c].average += mean_of(g, got, g->channels.classes + c, k) / (double)n;
        r->classes[c].half_width += got->of_average[g->channels.classes + c];
    }
    r->classes[CLASS_REFLECTED].half_width += mean_smoothed_by_cells(g, got);
    r->classes[CLASS_FOCUSED].half_width += mean_smoothed_by_squares(g);
}

void grid_take_results(const grid_run_state *g, const accuracy_result *got, grid_result *r)
{
    const grid_channels *c = &g->channels;
    take_classes(g, got, r);
    for (size_t k = 0; k < (size_t)r->sensor_count; k++) {
        double all = mean_of(g, got, SAMPLED, k);
        r->in_doubt += got && found_nothing(g, got, k) && mean_of(g, got, c->met, k) > 0.0;
        if (g->moments) {
            take_moments(g, got, k);
        } else {
            r->direct[k]      = known_of(g, SAMPLED, k) + mean_of(g, got, c->straight, k);
            r->illuminance[k] = known_of(g, SAMPLED, k) + all;
            r->half_width[k]  = half_width_of(g, got, SAMPLED, k);
            take_layers(g, got, k);
        }
        if (r->smooth)
            r->smooth[k] = smoothed_of(g, got, SAMPLED, k, 1.0);
        if (!g->o->pilot)
            widen_by_smoothing(g, got, r, k);
        r->indirect[k]    = fmax(r->illuminance[k] - r->direct[k], 0.0);
        r->illuminance[k] = r->direct[k] + r->indirect[k];
        if (r->outside)
            r->outside[k] = mean_of(g, got, c->outside, k);
        if (r->electric)
            r->electric[k] += mean_of(g, got, c->electric, k);
    }
    r->smoothed           = got && c->smoothed >= 0;
    r->average_half_width = mean_bound(g) + (got ? got->of_average[SAMPLED] : 0.0) +
                            mean_smoothed_by_cells(g, got) + mean_smoothed_by_squares(g);
    widen_all(g, r);
}
