/* sim/grid.c -- see grid.h. Lamps are summed exactly at each sensor; the rest is sampled. */
#include "sim/grid.h"

#include "core/color.h"
#include "core/parallel.h"
#include "core/sampler.h"
#include "sim/grid_parts.h"
#include "sim/probes.h"

/* ---- a run ----------------------------------------------------------------------------------- */

enum { ROUGH_SAMPLES = 64 }; /* a sensor */

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

/* Whether daylight and other light are told apart. */
static bool splits(const scene *s)
{
    return s->moment_count > 0 && !s->by_moment && (scene_lamp_count(s) > 0 || s->glows) &&
           s->study->maintenance != 1.0;
}

bool grid_needs_paths(const scene *s) { return (s->by_moment && s->moment_count > 0) || splits(s); }

/* Where the channels stand. */
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
    if (g->o->transport == TRANSPORT_MAPS || scene_focuses(g->s))
        c.smoothed = c.count++;
    if (g->o->outside)
        c.outside = c.count++;
    if (splits(g->s))
        c.electric = c.count++;
    return c;
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
static double room_for_smoothing(const grid_run_state *g)
{
    return g->maps.indirect || g->maps.focused ? 0.15 : 0.0;
}

/* A scramble; more where some light comes by way of what is nearly a mirror: it is met rarely. */
static int first_samples(const scene *s)
{
    return scene_is_rarely_met(s) ? MIRROR_SAMPLES / SCRAMBLES : 8;
}

static bool interrupted(const grid_result *r, lux_error *err)
{
    return failed(err, ERR_INTERRUPTED, "interrupted before grid %s had its first results",
                  r->grid->name);
}

/* Of a run with the maps that there are. */
static accuracy_desc desc_of(grid_run_state *g)
{
    const grid_result *r = g->r;
    return (accuracy_desc){ .items    = r->sensor_count,
                            .channels = g->channels.count,
                            .judged   = g->channels.judged,
                            .told     = g->channels.classes >= 0 ? LIGHT_CLASSES : 0,
                            .apart    = g->moments > 0,
                            .exact    = g->known,
                            .bound    = g->bound,
                            .fixed    = g->fixed,
                            .common   = g->maps.indirect || g->maps.focused,
                            .accuracy = (r->asked - g->o->bound) * (1.0 - room_for_smoothing(g)),
                            .needed   = 1.0,
                            .floor    = FLOOR_MEAN,
                            .first_samples = first_samples(g->s),
                            .dark_samples  = 256,
                            .only_samples  = g->o->only_samples,
                            .threads       = g->o->threads,
                            .deadline      = g->o->deadline,
                            .progress      = g->o->progress,
                            .sample        = grid_sample,
                            .context       = g };
}

/* lx, of each sensor: all light but what is known and what maps of focused light know, roughly. */
bool grid_find_rough(grid_run_state *g, arena *a, lux_error *err)
{
    const illumination_map *focused = g->maps.focused;
    accuracy_desc d                 = desc_of(g);
    accuracy_result got;
    d.only_samples  = ROUGH_SAMPLES;
    d.progress      = NULL;
    g->maps.focused = NULL;
    bool good       = accuracy_run(a, &d, &got, err);
    g->maps.focused = focused;
    if (good)
        g->rough = got.mean;
    return good;
}

static int64_t rays_so_far(const grid_run_state *g)
{
    int64_t rays = g->maps.rays;
    for (int t = 0; t < g->o->threads; t++)
        rays += direct_sensor_rays(g->threads[t].direct) + sun_rays(g->threads[t].suns) +
                path_rays(g->threads[t].paths);
    return rays;
}

static bool sample_rest(arena *a, arena *scratch, grid_run_state *g, grid_result *r, lux_error *err)
{
    accuracy_desc d = desc_of(g);
    accuracy_result got;
    bool finer = false;
    do {
        if (!accuracy_run(a, &d, &got, err))
            return false;
        if (!got.complete)
            return interrupted(r, err);
        if (!grid_refine_maps(g, scratch, &got, &finer, err))
            return false;
    } while (finer);
    grid_take_results(g, &got, r);
    r->missed = got.missed;
    if (r->in_doubt && !r->left_to_chance && !g->o->direct_only && anything_shines(g->s))
        r->left_to_chance = "some sensors see surfaces from where no sample found any light back";
    r->end     = got.end;
    r->reached = got.reached + g->o->bound;
    return true;
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
    out->known_rays = rays_so_far(g);
    bool lit        = scene_is_lit(s);
    bool reflects   = s->reflects && lit && !g->o->direct_only;
    if (s->glows || s->sky_count > 0 || g->disks || reflects || atomic_load(&g->lamps_left))
        return sample_rest(a, scratch, g, out, err);
    grid_take_results(g, NULL, out);
    out->reached = (double)NAN; /* as the bounds say: see grid_summarise() */
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

/* Keeps so many sensors, one of each so many, though not always the same of a row. */
static bool thin_out(arena *a, int most, grid_result *r, lux_error *err)
{
    const double golden = 0.6180339887498949;
    if (most == 0 || r->sensor_count <= most)
        return true;
    grid_sensor *sensors = arena_array(a, grid_sensor, (size_t)most, err);
    int *cell            = sensors ? arena_array(a, int, (size_t)most, err) : NULL;
    double each          = (double)r->sensor_count / most;
    for (int k = 0; cell && k < most; k++) {
        int from   = (int)((k + fmod(k * golden, 1.0)) * each);
        sensors[k] = r->sensors[from];
        cell[k]    = r->cell[from];
    }
    r->sensors      = sensors;
    r->cell         = cell;
    r->sensor_count = most;
    return cell != NULL;
}

static const char lost_to_maps[] = "some light that maps are to find comes where they have no "
                                   "cells, or from glowing pictures";

bool grid_run(arena *a, const scene *s, const study_grid *grid, const run_options *o,
              grid_result *out, lux_error *err)
{
    double begun     = clock_seconds();
    arena scratch    = { 0 };
    uint32_t seed    = hash_text_u32(hash_u32(o->seed), grid->name);
    run_options own  = *o;
    grid_run_state g = { .begun   = begun,
                         .s       = s,
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
    if (grid_needs_paths(s))
        own.transport = TRANSPORT_PATH;
    for (int i = 0; i < s->sun_count; i++)
        g.disks |= light_has_extent(s->lights[scene_lamp_count(s) + i]);

    bool good  = grid_sensors(a, s, grid, out, err) && thin_out(a, o->most_sensors, out, err);
    out->asked = !isnan(o->accuracy)          ? o->accuracy
                 : !isnan(s->study->accuracy) ? s->study->accuracy
                                              : GRID_DEFAULT_PERCENT / 100.0;
    out->left_to_chance = scene_left_to_chance(s, o->direct_only);
    g.channels          = lay_out(&g);
    good = good && grid_make_results(a, &g, out, err) && make_known(&scratch, &g, err) &&
           make_threads(&g, &scratch, err) && run(a, &scratch, &g, out, err) &&
           grid_all_finite(s, out, err);
    if (good) {
        grid_summarise(out);
        out->rays        = rays_so_far(&g);
        out->left_out_lm = g.maps.left_out_lm;
        if (g.maps.matters && !out->left_to_chance)
            out->left_to_chance = lost_to_maps;
        out->seconds = clock_seconds() - begun;
    }
    arena_clear(&scratch);
    return good;
}
