/* sim/grid.c -- see grid.h. Lamps are summed exactly at each sensor; the rest is sampled. */
#include "sim/grid.h"

#include "core/color.h"
#include "core/parallel.h"
#include "core/sampler.h"
#include "sim/grid_parts.h"
#include "sim/probes.h"

#include <float.h>

/* ---- a run ----------------------------------------------------------------------------------- */

static bool make_bundle(const grid_run_state *g, arena *a, path_bundle *b, lux_error *err)
{
    const grid_channels *c = &g->channels;
    if (g->layers && !(b->layers = arena_array(a, path_sums, 2 * (size_t)g->layers, err)))
        return false;
    if (c->smoothed >= 0 && !(b->smoothed = arena_array(a, float, PATHS, err)))
        return false;
    if (c->classes >= 0 && g->s->mirror_images && !(b->mirrored = arena_new(a, path_sums, err)))
        return false;
    if (c->outside >= 0 && !(b->outside = arena_new(a, path_sums, err)))
        return false;
    return c->electric < 0 || (b->daylight = arena_new(a, path_sums, err));
}

static bool make_threads(grid_run_state *g, arena *a, lux_error *err)
{
    bool in_room = true;
    for (int k = 0; k < g->r->sensor_count && in_room; k++)
        in_room = scene_is_in_room(g->s, g->r->sensors[k].at);
    const sun_patches *patches = NULL;
    if (!g->o->direct_only &&
        !sun_patches_new(a, g->s, g->seed, g->r->asked, g->o->threads, &patches, err))
        return false;
    sensor_ask ask = { g->r->grid->quantity, g->r->asked, in_room, g->seed };
    size_t layers  = (size_t)g->layers + 1;
    g->threads     = arena_array(a, thread_scratch, (size_t)g->o->threads, err);
    for (int t = 0; g->threads && t < g->o->threads; t++) {
        thread_scratch *w  = &g->threads[t];
        w->direct          = direct_sensor_new(a, g->s, &ask, err);
        w->suns            = w->direct ? sun_seen_new(a, g->s, ask.quantity, err) : NULL;
        w->paths           = w->suns ? path_tracer_new(a, g->s, err) : NULL;
        w->sums            = w->paths ? arena_array(a, sensor_sum, layers, err) : NULL;
        w->of_layer        = w->sums ? arena_array(a, float, layers, err) : NULL;
        w->direct_of_layer = w->of_layer ? arena_array(a, float, layers, err) : NULL;
        if (!w->direct_of_layer || !make_bundle(g, a, &w->bundle, err))
            return false;
        path_use_patches(w->paths, patches);
    }
    return g->threads != NULL;
}

/* Where the channels stand. */
/* Whether daylight and other light are told apart. */
static bool splits(const grid_run_state *g)
{
    return g->s->moment_count > 0 && !g->moments && (scene_lamp_count(g->s) > 0 || g->s->glows) &&
           g->s->study->maintenance != 1.0;
}

static grid_channels lay_out(const grid_run_state *g)
{
    grid_channels c = { .judged   = g->moments  ? g->moments
                                    : g->layers ? LAYERS + g->layers
                                                : 1,
                        .classes  = g->moments ? -1 : 0,
                        .smoothed = -1,
                        .outside  = -1,
                        .electric = -1 };
    c.straight      = c.judged;
    if (c.classes == 0) {
        c.classes = c.judged;
        c.straight += LIGHT_CLASSES;
    }
    c.straight_count = g->moments ? g->moments : 1 + g->layers;
    c.met            = c.straight + c.straight_count;
    c.count          = c.met + 1;
    if (g->o->transport == TRANSPORT_MAPS || scene_focuses(g->s, g->r->asked))
        c.smoothed = c.count++;
    if (g->o->outside)
        c.outside = c.count++;
    if (splits(g))
        c.electric = c.count++;
    return c;
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

static void summarise(grid_result *r)
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

/* At a lamp itself illuminance has no bound. */
static bool all_finite(const scene *s, const grid_result *r, lux_error *err)
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

static void take_results(const grid_run_state *g, const accuracy_result *got, grid_result *r)
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
        r->half_width[k] += STEPS_SMOOTHED * fabs(smoothed);
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

/* Lamps may all be out: then darkness is no doubt. */
static bool anything_shines(const scene *s)
{
    bool shines = s->sky_count > 0 || (s->glows && s->glow_dimming > 0.0f);
    for (int l = 0; l < s->light_count && !shines; l++)
        shines = s->light_info[l].lumens > 0.0;
    return shines;
}

/* The share of the accuracy that is left for what maps smooth. */
static double room_for_smoothing(const grid_run_state *g) { return g->maps.indirect ? 0.15 : 0.0; }

/* A scramble; more where some light comes by way of what is nearly a mirror: it is met rarely. */
static int first_samples(const scene *s)
{
    return s->by_lamps.narrow > SHARE_THAT_MATTERS ? MIRROR_SAMPLES / SCRAMBLES : 8;
}

static bool interrupted(const grid_result *r, lux_error *err)
{
    return failed(err, ERR_INTERRUPTED, "interrupted before grid %s had its first results",
                  r->grid->name);
}

static bool sample_rest(arena *a, grid_run_state *g, grid_result *r, lux_error *err)
{
    accuracy_desc d = { .items         = r->sensor_count,
                        .channels      = g->channels.count,
                        .judged        = g->channels.judged,
                        .told          = g->channels.classes >= 0 ? LIGHT_CLASSES : 0,
                        .apart         = g->moments > 0,
                        .exact         = g->known,
                        .bound         = g->bound,
                        .fixed         = g->fixed,
                        .common        = g->maps.indirect || g->maps.focused,
                        .accuracy      = (r->asked - g->o->bound) * (1.0 - room_for_smoothing(g)),
                        .needed        = 1.0,
                        .floor         = FLOOR_MEAN,
                        .first_samples = first_samples(g->s),
                        .dark_samples  = 256,
                        .only_samples  = g->o->only_samples,
                        .threads       = g->o->threads,
                        .deadline      = g->o->deadline,
                        .progress      = g->o->progress,
                        .sample        = grid_sample,
                        .context       = g };
    accuracy_result got;
    if (!accuracy_run(a, &d, &got, err))
        return false;
    if (!got.complete)
        return interrupted(r, err);
    take_results(g, &got, r);
    r->missed = got.missed;
    if (r->in_doubt && !r->left_to_chance && !g->o->direct_only && anything_shines(g->s))
        r->left_to_chance = "some sensors see surfaces from where no sample found any light back";
    r->end     = got.end;
    r->reached = got.reached + g->o->bound;
    return true;
}

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

static bool make_results(arena *a, const grid_run_state *g, grid_result *out, lux_error *err)
{
    double **all[] = { &out->illuminance,
                       &out->direct,
                       &out->indirect,
                       &out->half_width,
                       g->channels.outside >= 0 ? &out->outside : NULL,
                       g->channels.electric >= 0 ? &out->electric : NULL };
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        if (all[i] && !(*all[i] = arena_array(a, double, (size_t)out->sensor_count, err)))
            return false;
    return make_layers(a, g, out, err) && make_moments(a, g, out, err);
}

static bool run(arena *a, arena *scratch, grid_run_state *g, grid_result *out, lux_error *err)
{
    const scene *s = g->s;
    int chunks     = (out->sensor_count + GRID_CHUNK - 1) / GRID_CHUNK;
    progress_begin(g->o->progress, out->grid->name);
    parallel_for(chunks, g->o->threads, grid_sum_chunk, g,
                 g->o->progress ? g->o->progress->stop : NULL);
    if (progress_stopped(g->o->progress))
        return interrupted(out, err);
    if (!grid_make_maps(g, scratch, err))
        return err->code == ERR_INTERRUPTED ? interrupted(out, err) : false;
    bool lit      = scene_is_lit(s);
    bool reflects = s->reflects && lit && !g->o->direct_only;
    if (s->glows || s->sky_count > 0 || g->disks || reflects || atomic_load(&g->lamps_left))
        return sample_rest(a, g, out, err);
    take_results(g, NULL, out);
    out->reached = (double)NAN; /* as the bounds say: see summarise() */
    return true;
}

static bool make_known(arena *a, grid_run_state *g, lux_error *err)
{
    size_t n = (size_t)g->r->sensor_count, judged = (size_t)g->channels.judged;
    size_t suns  = (size_t)g->s->sun_count + 1;
    g->known     = arena_array(a, double, n *judged, err);
    g->bound     = g->known ? arena_array(a, double, n *judged, err) : NULL;
    g->sun_known = g->bound ? arena_array(a, double, n *suns, err) : NULL;
    g->sun_share = g->sun_known ? arena_array(a, double, n *suns, err) : NULL;
    return g->sun_share != NULL;
}

bool grid_run(arena *a, const scene *s, const study_grid *grid, const run_options *o,
              grid_result *out, lux_error *err)
{
    double begun     = clock_seconds();
    arena scratch    = { 0 };
    uint32_t seed    = hash_text_u32(hash_u32(o->seed), grid->name);
    run_options own  = *o;
    grid_run_state g = { .s       = s,
                         .o       = &own,
                         .r       = out,
                         .layers  = s->layered ? s->group_count : 0,
                         .moments = s->by_moment ? s->moment_count : 0,
                         .paths   = { .quantity      = grid->quantity,
                                      .bounce        = !o->direct_only,
                                      .bounded       = o->bounded,
                                      .bounces       = o->bounces,
                                      .roulette_from = o->roulette_from },
                         .seed    = seed };
    if (g.moments || splits(&g)) /* maps tell of all light together */
        own.transport = TRANSPORT_PATH;
    for (int i = 0; i < s->sun_count; i++)
        g.disks |= light_has_extent(s->lights[scene_lamp_count(s) + i]);

    bool good           = grid_sensors(a, s, grid, out, err);
    out->asked          = !isnan(o->accuracy)          ? o->accuracy
                          : !isnan(s->study->accuracy) ? s->study->accuracy
                                                       : GRID_DEFAULT_PERCENT / 100.0;
    out->left_to_chance = scene_left_to_chance(s, o->direct_only);
    out->unfocused      = scene_left_unfocused(s, out->asked, o->direct_only);
    g.channels          = lay_out(&g);
    good                = good && make_results(a, &g, out, err) && make_known(&scratch, &g, err) &&
           make_threads(&g, &scratch, err) && run(a, &scratch, &g, out, err) &&
           all_finite(s, out, err);
    if (good) {
        summarise(out);
        out->rays        = g.maps.rays;
        out->left_out_lm = g.maps.left_out_lm;
        if (g.maps.matters && !out->left_to_chance)
            out->left_to_chance =
                "some light that maps are to find comes where they have no cells, "
                "or from glowing pictures";
        for (int t = 0; t < o->threads; t++)
            out->rays += direct_sensor_rays(g.threads[t].direct) + sun_rays(g.threads[t].suns) +
                         path_rays(g.threads[t].paths);
        out->seconds = clock_seconds() - begun;
    }
    arena_clear(&scratch);
    return good;
}
