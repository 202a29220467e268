/* sim/grid.c -- see grid.h. Lamps are summed exactly at each sensor; the rest is sampled. */
#include "sim/grid.h"

#include "core/color.h"
#include "core/parallel.h"
#include "core/sampler.h"
#include "sim/accuracy.h"
#include "sim/direct_sensor.h"
#include "sim/path.h"
#include "sim/probes.h"

#include <float.h>
#include <stdatomic.h>
#include <string.h>

/* Of accuracy_run(): all that is sampled, as dimmed; and in a layered scene the same undimmed, and
 * of each layer; what of it, as dimmed, is direct; what sees a reflecting surface; what of each
 * layer is direct. */
enum { SAMPLED, FULL, LAYERS };

typedef struct thread_scratch {
    direct_sensor *direct;
    path_tracer *paths;
    path_bundle bundle;
    sensor_sum *sums;
    float lamp_e[BUNDLE]; /* W/m^2 of each sample, and which lamp's it is */
    int32_t lamp[BUNDLE];
} thread_scratch;

typedef struct grid_run_state {
    const scene *s;
    const run_options *o;
    grid_result *r;
    thread_scratch *threads;
    int layers;            /* 0 unless the scene is layered */
    double *known, *bound; /* lx, initial: of everything, then of each layer, sensor by sensor */
    path_options paths;
    atomic_bool lamps_left; /* some lamps take samples */
    uint32_t seed;          /* of this grid */
} grid_run_state;

static int judged_count(const grid_run_state *g) { return g->layers ? LAYERS + g->layers : 1; }
static int straight_channel(const grid_run_state *g) { return judged_count(g); }
static int met_channel(const grid_run_state *g) { return straight_channel(g) + 1; }
static int layer_straight_channel(const grid_run_state *g, int layer)
{
    return met_channel(g) + 1 + layer;
}
static int channel_count(const grid_run_state *g) { return layer_straight_channel(g, g->layers); }

/* How far a sensor may be off, and a surface that it lies on: a few roundings of the farthest
 * corner of the scene. */
static float place_error(const scene *s, vec3 p)
{
    float most  = fmaxf(fabsf(p.x), fmaxf(fabsf(p.y), fabsf(p.z)));
    dvec3 off   = d3_scale(d3_sub(s->high, s->low), 0.5);
    double half = s->low.x <= s->high.x ? fmax(off.x, fmax(off.y, off.z)) : 0.0;
    return 8.0f * 0x1p-24f * fmaxf(most, fmaxf((float)half, 0x1p-6f));
}

/* ---- light that needs no samples ------------------------------------------------------------- */

/* A packet of sensors, of which those behind the last are asleep. */
static vmask place_sensors(const grid_run_state *g, const int *which, int count, vsurface *at)
{
    float p[3][LANES], n[3][LANES], error[LANES];
    for (int i = 0; i < LANES; i++) {
        const grid_sensor *one = &g->r->sensors[which[i < count ? i : 0]];
        vec3 place = scene_place(g->s, one->at), normal = d3_to_float(one->normal);
        p[0][i] = place.x, p[1][i] = place.y, p[2][i] = place.z;
        n[0][i] = normal.x, n[1][i] = normal.y, n[2][i] = normal.z;
        error[i] = place_error(g->s, place);
    }
    *at = (vsurface){ .position = { vload(p[0]), vload(p[1]), vload(p[2]) },
                      .normal   = { vload(n[0]), vload(n[1]), vload(n[2]) },
                      .error    = vload(error) };
    return vlane_index() < count;
}

enum { CHUNK = 64 }; /* sensors */

static void sum_packet(grid_run_state *g, thread_scratch *w, int first)
{
    int which[LANES], n = g->r->sensor_count, count = n - first < LANES ? n - first : LANES;
    for (int i = 0; i < LANES; i++)
        which[i] = first + (i < count ? i : 0);
    vsurface at;
    vmask active  = place_sensors(g, which, count, &at);
    vmask pending = direct_sensor_sum(w->direct, &at, active, (uint32_t)first, w->sums);
    if (vany(pending))
        atomic_store(&g->lamps_left, true);
    for (int i = 0; i < count; i++) {
        size_t k    = (size_t)(first + i);
        g->known[k] = LUMENS_PER_WATT * (double)lane(w->sums[0].e, i);
        g->bound[k] = LUMENS_PER_WATT * (double)lane(w->sums[0].bound, i);
        for (int l = 0; l < g->layers; l++) {
            size_t to = (size_t)(LAYERS + l) * (size_t)n + k, full = (size_t)FULL * (size_t)n + k;
            g->known[to] = LUMENS_PER_WATT * (double)lane(w->sums[1 + l].e, i);
            g->bound[to] = LUMENS_PER_WATT * (double)lane(w->sums[1 + l].bound, i);
            g->known[full] += g->known[to];
            g->bound[full] += g->bound[to];
        }
    }
}

static void sum_chunk(void *context, int item, int thread)
{
    grid_run_state *g = context;
    int end           = (item + 1) * CHUNK;
    for (int first = item * CHUNK; first < end && first < g->r->sensor_count; first += LANES)
        sum_packet(g, &g->threads[thread], first);
}

/* ---- light that is sampled ------------------------------------------------------------------- */

/* Lamps that take samples: those of the same sensor stand one after the other, and a packet of
 * sensors is looked at together. */
static void sample_lamps(grid_run_state *g, thread_scratch *w, const sample_id *ids, int count)
{
    for (int from = 0, to; from < count; from = to) {
        int which[LANES], begin[LANES + 1], sensors = 0;
        for (to = from; to < count; to++) {
            if (to > from && ids[to].item == ids[to - 1].item)
                continue;
            if (sensors == LANES)
                break;
            begin[sensors]   = to;
            which[sensors++] = (int)ids[to].item;
        }
        begin[sensors] = to;
        vsurface at;
        vmask active = place_sensors(g, which, sensors, &at);
        direct_sensor_prepare(w->direct, &at, active);
        for (int i = 0; i < sensors; i++) {
            int at_i = begin[i];
            direct_sensor_draw(w->direct, i, w->bundle.index + at_i, w->bundle.seed + at_i,
                               begin[i + 1] - at_i, w->lamp_e + at_i, w->lamp + at_i);
        }
    }
}

static float lux_of(const path_sums *sums, int i)
{
    vec3 e = { (*sums)[0][i], (*sums)[1][i], (*sums)[2][i] };
    return (float)LUMENS_PER_WATT * rgb_luminance(e);
}

static void take_sample(const grid_run_state *g, const thread_scratch *w, int i, float *values)
{
    const path_bundle *b = &w->bundle;
    int lamp             = w->lamp[i];
    float lux            = lamp < 0 ? 0.0f : (float)LUMENS_PER_WATT * w->lamp_e[i];
    float dimming        = lamp < 0 ? 1.0f : g->s->light_info[lamp].dimming;
    float straight       = dimming * lux + lux_of(&b->direct, i);

    values[SAMPLED * BUNDLE + i]             = straight + lux_of(&b->indirect, i);
    values[straight_channel(g) * BUNDLE + i] = straight;
    values[met_channel(g) * BUNDLE + i]      = b->met[i];
    if (g->layers)
        values[FULL * BUNDLE + i] = 0.0f;
    for (int l = 0; l < g->layers; l++) {
        float own = lamp >= 0 && g->s->light_info[lamp].group == l ? lux : 0.0f;
        float all = own + lux_of(&b->layers[l], i);

        values[(LAYERS + l) * BUNDLE + i] = all;
        values[FULL * BUNDLE + i] += all;
        values[layer_straight_channel(g, l) * BUNDLE + i] =
            own + lux_of(&b->layers[g->layers + l], i);
    }
}

static void sample_sensors(void *context, int thread, const sample_id *ids, int count,
                           float *values)
{
    grid_run_state *g = context;
    thread_scratch *w = &g->threads[thread];
    path_bundle *b    = &w->bundle;
    b->count          = count;
    for (int i = 0; i < count; i++) {
        const grid_sensor *one = &g->r->sensors[ids[i].item];
        uint32_t cell          = (uint32_t)g->r->cell[ids[i].item];
        vec3 place = scene_place(g->s, one->at), normal = d3_to_float(one->normal);
        b->x[i] = place.x, b->y[i] = place.y, b->z[i] = place.z;
        b->nx[i] = normal.x, b->ny[i] = normal.y, b->nz[i] = normal.z;
        b->error[i] = place_error(g->s, place);
        b->index[i] = ids[i].index;
        b->seed[i]  = hash_combine_u32(hash_combine_u32(g->seed, cell), ids[i].scramble);
    }
    if (atomic_load(&g->lamps_left))
        sample_lamps(g, w, ids, count);
    else
        memset(w->lamp, -1, sizeof w->lamp);
    path_trace(w->paths, b, &g->paths);
    for (int i = 0; i < count; i++)
        take_sample(g, w, i, values);
}

/* ---- a run ----------------------------------------------------------------------------------- */

static bool make_threads(grid_run_state *g, arena *a, lux_error *err)
{
    bool in_room = true;
    for (int k = 0; k < g->r->sensor_count && in_room; k++)
        in_room = scene_is_in_room(g->s, g->r->sensors[k].at);
    sensor_ask ask = { g->r->grid->quantity, g->r->asked, in_room, g->seed };
    g->threads     = arena_array(a, thread_scratch, (size_t)g->o->threads, err);
    for (int t = 0; g->threads && t < g->o->threads; t++) {
        thread_scratch *w = &g->threads[t];
        w->direct         = direct_sensor_new(a, g->s, &ask, err);
        w->paths          = w->direct ? path_tracer_new(a, g->s, err) : NULL;
        w->sums = w->paths ? arena_array(a, sensor_sum, (size_t)(1 + g->layers), err) : NULL;
        if (g->layers)
            w->bundle.layers = arena_array(a, path_sums, 2 * (size_t)g->layers, err);
        if (!w->sums || (g->layers && !w->bundle.layers))
            return false;
    }
    return g->threads != NULL;
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
    if (sampled && !r->layer_count)
        return;
    r->missed  = over; /* as the bounds say; or of layers, which alone were held to the accuracy */
    r->reached = fmax(r->reached, r->worst_half_width);
    if (!sampled && over)
        r->end = RUN_EXHAUSTED;
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

static void take_results(const grid_run_state *g, const accuracy_result *got, grid_result *r)
{
    double maintenance = g->s->study->maintenance;
    size_t n           = (size_t)r->sensor_count;
    for (size_t k = 0; k < n; k++) {
        double straight   = got ? got->mean[(size_t)straight_channel(g) * n + k] : 0.0;
        double all        = got ? got->mean[SAMPLED * n + k] : 0.0;
        double half       = got ? got->half_width[k] : g->bound[k];
        r->direct[k]      = maintenance * (g->known[k] + straight);
        r->indirect[k]    = maintenance * fmax(all - straight, 0.0);
        r->illuminance[k] = r->direct[k] + r->indirect[k];
        r->half_width[k]  = maintenance * half;
        r->in_doubt += got && all == 0.0 && got->mean[(size_t)met_channel(g) * n + k] > 0.0;
        for (int l = 0; l < g->layers; l++) {
            size_t at            = (size_t)(LAYERS + l) * n + k;
            size_t straight_at   = (size_t)layer_straight_channel(g, l) * n + k;
            const grid_layer *to = &r->layers[l];
            to->illuminance[k]   = maintenance * (g->known[at] + (got ? got->mean[at] : 0.0));
            to->direct[k]     = maintenance * (g->known[at] + (got ? got->mean[straight_at] : 0.0));
            to->half_width[k] = maintenance * (got ? got->half_width[at] : g->bound[at]);
        }
    }
}

/* Lamps may all be out: then darkness is no doubt. */
static bool anything_shines(const scene *s)
{
    bool shines = s->glows && s->glow_dimming > 0.0f;
    for (int l = 0; l < s->light_count && !shines; l++)
        shines = s->light_info[l].lumens > 0.0;
    return shines;
}

static bool sample_rest(arena *a, grid_run_state *g, grid_result *r, lux_error *err)
{
    accuracy_desc d = { .items         = r->sensor_count,
                        .channels      = channel_count(g),
                        .judged        = judged_count(g),
                        .exact         = g->known,
                        .bound         = g->bound,
                        .accuracy      = r->asked,
                        .needed        = 1.0,
                        .floor         = FLOOR_MEAN,
                        .first_samples = g->s->mirrors ? MIRROR_SAMPLES / SCRAMBLES : 8,
                        .dark_samples  = 256,
                        .threads       = g->o->threads,
                        .deadline      = g->o->deadline,
                        .progress      = g->o->progress,
                        .sample        = sample_sensors,
                        .context       = g };
    accuracy_result got;
    if (!accuracy_run(a, &d, &got, err))
        return false;
    if (!got.complete)
        return failed(err, ERR_INTERRUPTED, "interrupted before grid %s had its first results",
                      r->grid->name);
    take_results(g, &got, r);
    r->missed = got.missed;
    if (r->in_doubt && !r->left_to_chance && !g->o->direct_only && anything_shines(g->s))
        r->left_to_chance = "some sensors see surfaces from where no sample found any light back";
    r->end     = got.end;
    r->reached = got.reached;
    return true;
}

static bool make_results(arena *a, const grid_run_state *g, grid_result *out, lux_error *err)
{
    size_t n         = (size_t)out->sensor_count;
    double **all[]   = { &out->illuminance, &out->direct, &out->indirect, &out->half_width };
    out->layer_count = g->layers;
    out->layers      = arena_array(a, grid_layer, (size_t)g->layers + 1, err);
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        if (!out->layers || !(*all[i] = arena_array(a, double, n, err)))
            return false;
    for (int l = 0; l < g->layers; l++) {
        grid_layer *to  = &out->layers[l];
        to->illuminance = arena_array(a, double, n, err);
        to->direct      = to->illuminance ? arena_array(a, double, n, err) : NULL;
        to->half_width  = to->direct ? arena_array(a, double, n, err) : NULL;
        if (!to->half_width)
            return false;
    }
    return true;
}

static bool run(arena *a, grid_run_state *g, grid_result *out, lux_error *err)
{
    const scene *s = g->s;
    int chunks     = (out->sensor_count + CHUNK - 1) / CHUNK;
    progress_begin(g->o->progress, out->grid->name);
    parallel_for(chunks, g->o->threads, sum_chunk, g, g->o->progress ? g->o->progress->stop : NULL);
    if (progress_stopped(g->o->progress))
        return failed(err, ERR_INTERRUPTED, "interrupted before grid %s had its first results",
                      out->grid->name);
    bool lit      = s->light_count > 0 || s->glows;
    bool reflects = s->reflects && lit && !g->o->direct_only;
    if (s->glows || reflects || atomic_load(&g->lamps_left))
        return sample_rest(a, g, out, err);
    take_results(g, NULL, out);
    out->reached = (double)NAN; /* as the bounds say: see summarise() */
    return true;
}

bool grid_run(arena *a, const scene *s, const study_grid *grid, const run_options *o,
              grid_result *out, lux_error *err)
{
    double begun     = clock_seconds();
    arena scratch    = { 0 };
    uint32_t seed    = hash_text_u32(hash_u32(o->seed), grid->name);
    grid_run_state g = { .s      = s,
                         .o      = o,
                         .r      = out,
                         .layers = s->layered ? s->group_count : 0,
                         .paths  = { .quantity = grid->quantity, .bounce = !o->direct_only },
                         .seed   = seed };

    bool good           = grid_sensors(a, s, grid, out, err);
    size_t n            = (size_t)out->sensor_count * (size_t)judged_count(&g);
    out->asked          = !isnan(o->accuracy)          ? o->accuracy
                          : !isnan(s->study->accuracy) ? s->study->accuracy
                                                       : GRID_DEFAULT_PERCENT / 100.0;
    out->left_to_chance = scene_left_to_chance(s, o->direct_only);
    good                = good && make_results(a, &g, out, err);
    g.known             = good ? arena_array(&scratch, double, n, err) : NULL;
    g.bound             = g.known ? arena_array(&scratch, double, n, err) : NULL;
    good                = g.bound && make_threads(&g, &scratch, err) && run(a, &g, out, err) &&
           all_finite(s, out, err);
    if (good) {
        summarise(out);
        for (int t = 0; t < o->threads; t++)
            out->rays += direct_sensor_rays(g.threads[t].direct) + path_rays(g.threads[t].paths);
        out->seconds = clock_seconds() - begun;
    }
    arena_clear(&scratch);
    return good;
}
