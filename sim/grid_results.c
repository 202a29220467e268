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

/* What of the average is of each class. Sensors have samples of their own, whose errors are
 * independent; maps are common to all, and so are their errors. */
static void take_classes(const grid_run_state *g, const accuracy_result *got, grid_result *r)
{
    size_t n = (size_t)r->sensor_count;
    for (int c = 0; c < LIGHT_CLASSES; c++) {
        double sum = 0.0, bounds = 0.0, square = 0.0;
        bool shared = c != CLASS_DIRECT && (g->maps.indirect || g->maps.focused);
        for (size_t k = 0; k < n; k++) {
            if (c == CLASS_DIRECT) {
                sum += g->known[k];
                bounds += g->bound[k];
            }
            if (!got || g->channels.classes < 0)
                continue;
            size_t at = (size_t)(g->channels.classes + c) * n + k;
            sum += got->mean[at];
            if (shared)
                bounds += got->half_width[at];
            else
                square += got->half_width[at] * got->half_width[at];
        }
        r->classes[c].average    = sum / (double)n;
        r->classes[c].half_width = (bounds + sqrt(square)) / (double)n;
    }
}

void grid_summarise(grid_result *r)
{
    double sum = 0.0, halves = 0.0;
    int over   = 0; /* sensors */
    r->minimum = HUGE_VAL;
    r->maximum = 0.0;
    for (int k = 0; k < r->sensor_count; k++) {
        sum += r->illuminance[k];
        halves += r->half_width[k];
        r->minimum = fmin(r->minimum, r->illuminance[k]);
        r->maximum = fmax(r->maximum, r->illuminance[k]);
    }
    r->average            = sum / r->sensor_count;
    r->average_half_width = halves / r->sensor_count;
    r->uniformity         = r->average > 0.0 ? r->minimum / r->average : 0.0;
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

bool grid_is_smoothed(const grid_run_state *g, const accuracy_result *got)
{
    size_t n    = (size_t)g->r->sensor_count;
    double mean = 0.0;
    int over    = 0;
    for (int pass = 0; pass < 2 && g->channels.smoothed >= 0; pass++)
        for (size_t k = 0; k < n; k++) {
            double all  = known_of(g, SAMPLED, k) + mean_of(g, got, SAMPLED, k);
            double half = half_width_of(g, got, SAMPLED, k) +
                          STEPS_SMOOTHED * fabs(mean_of(g, got, g->channels.smoothed, k));
            double most = (g->r->asked - g->o->bound) * fmax(all, 0.1 * mean);
            if (pass == 0)
                mean += all / (double)n;
            else
                over += half > most;
        }
    return over > 0;
}

/* What the plan left out may be that far off, of max(value, a tenth of the average). */
static void widen(const grid_run_state *g, const double *e, double *half_width)
{
    int n          = g->r->sensor_count;
    double average = 0.0;
    for (int k = 0; k < n; k++)
        average += e[k] / n;
    for (int k = 0; k < n; k++)
        half_width[k] += g->o->bound * fmax(e[k], 0.1 * average);
}

static void widen_all(const grid_run_state *g, grid_result *r)
{
    if (g->o->bound == 0.0)
        return;
    widen(g, r->illuminance, r->half_width);
    for (int l = 0; l < r->layer_count; l++)
        widen(g, r->layers[l].illuminance, r->layers[l].half_width);
    for (int h = 0; h < r->moment_count; h++)
        widen(g, r->moments[h].illuminance, r->moments[h].half_width);
}

/* What of all undimmed light at sensor k is of layer l. */
static double share_of_layer(const grid_result *r, int l, size_t k)
{
    double all = 0.0;
    for (int i = 0; i < r->layer_count; i++)
        all += r->layers[i].illuminance[k];
    return all > 0.0 ? r->layers[l].illuminance[k] / all : 1.0;
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
        double smoothed = got && c->smoothed >= 0 ? mean_of(g, got, c->smoothed, k) : 0.0;
        if (r->smooth)
            r->smooth[k] = STEPS_SMOOTHED * fabs(smoothed);
        r->half_width[k] += g->o->pilot ? 0.0 : STEPS_SMOOTHED * fabs(smoothed);
        for (int l = 0; l < r->layer_count; l++)
            r->layers[l].half_width[k] += STEPS_SMOOTHED * fabs(smoothed) * share_of_layer(r, l, k);
        for (int h = 0; h < g->moments; h++)
            r->moments[h].half_width[k] += STEPS_SMOOTHED * fabs(smoothed);
        r->indirect[k]    = fmax(r->illuminance[k] - r->direct[k], 0.0);
        r->illuminance[k] = r->direct[k] + r->indirect[k];
        if (r->outside)
            r->outside[k] = mean_of(g, got, c->outside, k);
        if (r->electric)
            r->electric[k] += mean_of(g, got, c->electric, k);
    }
    r->smoothed = got && c->smoothed >= 0;
    widen_all(g, r);
}
