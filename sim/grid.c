/* sim/grid.c -- see grid.h. Lamps are summed exactly at each sensor; the rest is sampled. */
#include "sim/grid.h"

#include "core/color.h"
#include "core/parallel.h"
#include "core/sampler.h"
#include "sim/accuracy.h"
#include "sim/direct.h"
#include "sim/path.h"
#include "sim/probes.h"

#include <float.h>
#include <string.h>

/* Of accuracy_run(): all that is sampled, what of it is direct, what sees a reflecting surface. */
enum { SAMPLED, GLOW, MET, CHANNELS };

typedef struct thread_scratch {
    direct_scratch *direct;
    path_tracer *paths;
    path_bundle bundle;
    vsurface at[DIRECT_PACKETS]; /* for direct_all() */
    vmask active[DIRECT_PACKETS];
    vrgb e[DIRECT_PACKETS];
} thread_scratch;

typedef struct grid_run_state {
    const scene *s;
    const run_options *o;
    const grid_result *r;
    thread_scratch *threads;
    double *direct; /* lx, initial, from lamps */
    uint32_t seed;  /* of this grid */
} grid_run_state;

/* ---- sensors --------------------------------------------------------------------------------- */

static bool plane_sensors(arena *a, const study_grid *g, grid_result *out, lux_error *err)
{
    double along_u, along_v;
    study_grid_counts(g, &along_u, &along_v);
    out->columns         = (int)along_u;
    out->rows            = (int)along_v;
    out->sensor_count    = out->columns * out->rows;
    grid_sensor *sensors = arena_array(a, grid_sensor, (size_t)out->sensor_count, err);
    if (!sensors)
        return false;
    dvec3 n = d3_cross(g->u, g->v);
    n       = d3_scale(n, 1.0 / d3_length(n));
    for (int k = 0; k < out->sensor_count; k++) {
        double s   = (k % out->columns + 0.5) / out->columns;
        double t   = (k / out->columns + 0.5) / out->rows;
        dvec3 off  = d3_add(d3_scale(g->u, s), d3_scale(g->v, t));
        sensors[k] = (grid_sensor){ d3_add(g->origin, off), n };
    }
    out->sensors = sensors;
    return true;
}

static bool point_sensors(arena *a, const study_grid *g, grid_result *out, lux_error *err)
{
    probes p;
    if (!probes_read(a, g->points, &p, err))
        return false;
    grid_sensor *sensors = arena_array(a, grid_sensor, (size_t)p.count, err);
    if (!sensors)
        return false;
    for (int k = 0; k < p.count; k++)
        sensors[k] = (grid_sensor){ p.position[k], p.normal[k] };
    out->columns = out->sensor_count = p.count;
    out->rows                        = 1;
    out->sensors                     = sensors;
    return true;
}

bool grid_sensors(arena *a, const study_grid *g, grid_result *out, lux_error *err)
{
    *out = (grid_result){ .grid = g };
    if (g->quantity != QUANTITY_PLANAR || !isnan(g->require_maximum))
        return failed(err, ERR_UNSUPPORTED,
                      "grid %s: `quantity` and `maximum` are not simulated yet", g->name);
    return g->points ? point_sensors(a, g, out, err) : plane_sensors(a, g, out, err);
}

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
static vmask place_sensors(const grid_run_state *g, int first, vsurface *at)
{
    float p[3][LANES], n[3][LANES], error[LANES];
    for (int i = 0; i < LANES; i++) {
        int j                  = first + i < g->r->sensor_count ? first + i : first;
        const grid_sensor *one = &g->r->sensors[j];
        vec3 place = scene_place(g->s, one->at), normal = d3_to_float(one->normal);
        p[0][i] = place.x, p[1][i] = place.y, p[2][i] = place.z;
        n[0][i] = normal.x, n[1][i] = normal.y, n[2][i] = normal.z;
        error[i] = place_error(g->s, place);
    }
    *at = (vsurface){ .position = { vload(p[0]), vload(p[1]), vload(p[2]) },
                      .normal   = { vload(n[0]), vload(n[1]), vload(n[2]) },
                      .error    = vload(error) };
    return (vlane_index() + first) < g->r->sensor_count;
}

static void direct_chunk(void *context, int item, int thread)
{
    grid_run_state *g = context;
    thread_scratch *w = &g->threads[thread];
    int first = item * DIRECT_PACKETS * LANES, packets = 0;
    for (; packets < DIRECT_PACKETS && first + packets * LANES < g->r->sensor_count; packets++)
        w->active[packets] = place_sensors(g, first + packets * LANES, &w->at[packets]);
    direct_all(g->s, w->direct, w->at, w->active, packets, w->e);
    for (int j = 0; j < packets * LANES && first + j < g->r->sensor_count; j++)
        g->direct[first + j] =
            LUMENS_PER_WATT * (double)lane(vrgb_luminance(w->e[j / LANES]), j % LANES);
}

/* ---- light that is sampled ------------------------------------------------------------------- */

static void sample_sensors(void *context, int thread, const sample_id *ids, int count,
                           float *values)
{
    grid_run_state *g = context;
    path_bundle *b    = &g->threads[thread].bundle;
    b->count          = count;
    for (int i = 0; i < count; i++) {
        const grid_sensor *one = &g->r->sensors[ids[i].item];
        vec3 place = scene_place(g->s, one->at), normal = d3_to_float(one->normal);
        b->x[i] = place.x, b->y[i] = place.y, b->z[i] = place.z;
        b->nx[i] = normal.x, b->ny[i] = normal.y, b->nz[i] = normal.z;
        b->error[i] = place_error(g->s, place);
        b->index[i] = ids[i].index;
        b->seed[i]  = hash_combine_u32(hash_combine_u32(g->seed, ids[i].item), ids[i].scramble);
    }
    path_trace(g->threads[thread].paths, b, false, !g->o->direct_only);
    for (int i = 0; i < count; i++) {
        vec3 glow                    = { b->glow[0][i], b->glow[1][i], b->glow[2][i] };
        vec3 rest                    = { b->indirect[0][i], b->indirect[1][i], b->indirect[2][i] };
        float straight               = (float)LUMENS_PER_WATT * rgb_luminance(glow);
        values[MET * BUNDLE + i]     = b->met[i];
        values[GLOW * BUNDLE + i]    = straight;
        values[SAMPLED * BUNDLE + i] = straight + (float)LUMENS_PER_WATT * rgb_luminance(rest);
    }
}

/* ---- a run ----------------------------------------------------------------------------------- */

static bool make_threads(grid_run_state *g, arena *a, lux_error *err)
{
    g->threads = arena_array(a, thread_scratch, (size_t)g->o->threads, err);
    if (!g->threads)
        return false;
    for (int t = 0; t < g->o->threads; t++) {
        g->threads[t].direct = direct_scratch_new(a, g->s, err);
        g->threads[t].paths  = g->threads[t].direct ? path_tracer_new(a, g->s, err) : NULL;
        if (!g->threads[t].paths)
            return false;
    }
    return true;
}

static void summarise(grid_result *r)
{
    double sum = 0.0, halves = 0.0;
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
    }
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

static bool sample_rest(arena *a, grid_run_state *g, grid_result *r, lux_error *err)
{
    accuracy_desc d = { .items         = r->sensor_count,
                        .channels      = CHANNELS,
                        .exact         = g->direct,
                        .accuracy      = r->asked,
                        .needed        = 1.0,
                        .floor         = FLOOR_MEAN,
                        .first_samples = 8,
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
    double maintenance = g->s->study->maintenance;
    for (int k = 0; k < r->sensor_count; k++) {
        double glow       = got.mean[GLOW * r->sensor_count + k];
        double all        = got.mean[SAMPLED * r->sensor_count + k];
        r->direct[k]      = maintenance * (g->direct[k] + glow);
        r->indirect[k]    = maintenance * fmax(all - glow, 0.0);
        r->illuminance[k] = r->direct[k] + r->indirect[k];
        r->half_width[k]  = maintenance * got.half_width[k];
        r->in_doubt += all == 0.0 && got.mean[MET * r->sensor_count + k] > 0.0;
    }
    r->missed = got.missed;
    if (r->in_doubt && !r->left_to_chance && !g->o->direct_only)
        r->left_to_chance = "some sensors see surfaces from where no sample found any light back";
    r->end     = got.end;
    r->reached = got.reached;
    return true;
}

static void take_direct_alone(const grid_run_state *g, grid_result *r)
{
    for (int k = 0; k < r->sensor_count; k++)
        r->illuminance[k] = r->direct[k] = g->s->study->maintenance * g->direct[k];
    r->end = RUN_DONE;
}

bool grid_run(arena *a, const scene *s, const study_grid *grid, const run_options *o,
              grid_result *out, lux_error *err)
{
    double begun     = clock_seconds();
    arena scratch    = { 0 };
    uint32_t seed    = hash_text_u32(hash_u32(o->seed), grid->name);
    grid_run_state g = { .s = s, .o = o, .r = out, .seed = seed };

    bool good           = grid_sensors(a, grid, out, err);
    size_t n            = (size_t)out->sensor_count;
    out->asked          = !isnan(o->accuracy)          ? o->accuracy
                          : !isnan(s->study->accuracy) ? s->study->accuracy
                                                       : GRID_DEFAULT_PERCENT / 100.0;
    out->left_to_chance = scene_left_to_chance(s, o->direct_only);
    out->illuminance    = good ? arena_array(a, double, n, err) : NULL;
    out->direct         = out->illuminance ? arena_array(a, double, n, err) : NULL;
    out->indirect       = out->direct ? arena_array(a, double, n, err) : NULL;
    out->half_width     = out->indirect ? arena_array(a, double, n, err) : NULL;
    g.direct            = out->half_width ? arena_array(&scratch, double, n, err) : NULL;
    good                = g.direct && make_threads(&g, &scratch, err);

    if (good) {
        int per = DIRECT_PACKETS * LANES, chunks = (out->sensor_count + per - 1) / per;
        progress_begin(o->progress, grid->name);
        parallel_for(chunks, o->threads, direct_chunk, &g, o->progress ? o->progress->stop : NULL);
        bool reflects      = s->reflects && s->light_count > 0 && !o->direct_only;
        bool needs_samples = s->glows || reflects;
        if (progress_stopped(o->progress))
            good = failed(err, ERR_INTERRUPTED, "interrupted before grid %s had its first results",
                          grid->name);
        else if (needs_samples)
            good = sample_rest(a, &g, out, err);
        else
            take_direct_alone(&g, out);
    }
    good = good && all_finite(s, out, err);
    if (good) {
        summarise(out);
        for (int t = 0; t < o->threads; t++)
            out->rays += direct_rays(g.threads[t].direct) + path_rays(g.threads[t].paths);
        out->seconds = clock_seconds() - begun;
    }
    arena_clear(&scratch);
    return good;
}

int grid_requirements(const grid_result *r, grid_requirement out[MOST_REQUIREMENTS])
{
    const grid_requirement all[MOST_REQUIREMENTS] = {
        { "average", "lx", r->grid->require_average, r->average, false },
        { "minimum", "lx", r->grid->require_minimum, r->minimum, false },
        { "uniformity", "", r->grid->require_uniformity, r->uniformity, false },
    };
    int count = 0;
    for (int k = 0; k < MOST_REQUIREMENTS; k++) {
        if (isnan(all[k].asked))
            continue;
        out[count]     = all[k];
        out[count].met = all[k].got >= all[k].asked;
        count++;
    }
    return count;
}
