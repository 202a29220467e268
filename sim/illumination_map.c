/* sim/illumination_map.c -- see illumination_map.h: pilots, cells, particles, and what is asked.
 *
 * Particles come in chunks, a wave of them at a time: each set of SCRAMBLES has the same number of
 * chunks, and each chunk its own list of deposits. Lists are added up set by set in the order of
 * chunks, so that sums do not depend on who traced what.
 */
#include "sim/map_aim.h"

#include "core/color.h"
#include "core/parallel.h"

#include <string.h>

enum {
    WAVE_CHUNKS      = 4 * SCRAMBLES,
    FIRST_PILOTS     = 1 << 16,
    MOST_PILOTS      = 1 << 18,
    PILOT_CHUNKS     = SCRAMBLES, /* at once */
    PILOT_SHARE      = 8,         /* one pilot for so many particles */
    ENOUGH_MARKS     = 1 << 20,   /* that pilots leave, however few they are */
    LEAST_CHUNKS     = 4,         /* of a set, whose particles are deposited once each */
    CELL_PARTICLES   = 512,       /* that a cell gets at most, where memory allows */
    FEWEST_PARTICLES = 32,        /* that a sheet is to get to have cells */
};
static const double most_bytes   = 768e6; /* of values while they are added up */
static const double gather_share = 0.5;   /* of the accuracy: the maps' noise in a gather */

typedef struct map_run {
    const map_options *o;
    illumination_map *m;
    map_job job;
    map_tracer **tracers;
    map_list lists[WAVE_CHUNKS];
    map_balance chunk[WAVE_CHUNKS], all;
    uint32_t seeds[SCRAMBLES], pilot_seed;
    uint32_t first; /* chunk of each set, or of pilots */
    double *sums;   /* W, of particles that carry all of it: like values */
} map_run;

static void *no_memory(lux_error *err)
{
    return failed(err, ERR_MEMORY, "illumination maps: memory is out");
}

static const volatile bool *stop_of(const map_options *o)
{
    return o->progress ? o->progress->stop : NULL;
}

/* ---- chunks ---------------------------------------------------------------------------------- */

static void trace_chunk(void *context, int item, int thread)
{
    map_run *r     = context;
    bool pilots    = r->job.cells == NULL;
    uint32_t chunk = r->first + (uint32_t)(pilots ? item : item / SCRAMBLES);
    uint32_t seed  = pilots ? r->pilot_seed : r->seeds[item % SCRAMBLES];
    r->chunk[item] = (map_balance){ 0 };
    map_trace(r->tracers[thread], &r->job, chunk * MAP_BATCH, MAP_BATCH, seed, &r->lists[item],
              &r->chunk[item]);
}

static void add_balance(map_balance *to, const map_balance *b)
{
    for (int c = 0; c < 3; c++) {
        to->emitted[c] += b->emitted[c];
        to->absorbed[c] += b->absorbed[c];
        to->escaped[c] += b->escaped[c];
        to->unplaced[c] += b->unplaced[c];
    }
    to->rays += b->rays;
    to->way2 += b->way2;
    to->ways += b->ways;
}

static bool trace_wave(map_run *r, int chunks, lux_error *err)
{
    for (int i = 0; i < chunks; i++)
        r->lists[i].count = 0;
    if (!parallel_for(chunks, r->o->threads, trace_chunk, r, stop_of(r->o)))
        return failed(err, ERR_INTERRUPTED, "illumination maps: interrupted");
    for (int i = 0; i < chunks; i++) {
        if (r->lists[i].lost)
            return no_memory(err);
        add_balance(&r->all, &r->chunk[i]);
    }
    return true;
}

/* ---- pilots ---------------------------------------------------------------------------------- */

/* Adds pilots until there are so many, or until they have left enough, as where each is reflected a
 * hundred times. */
static bool send_pilots(map_run *r, size_t count, map_list *marks, lux_error *err)
{
    size_t chunks = count / MAP_BATCH;
    for (int i = 0; i < WAVE_CHUNKS; i++)
        r->lists[i].size = sizeof(map_mark);
    while (r->first < chunks && marks->count < ENOUGH_MARKS) {
        size_t left = chunks - r->first;
        int some    = left < PILOT_CHUNKS ? (int)left : PILOT_CHUNKS;
        if (!trace_wave(r, some, err))
            return false;
        for (int i = 0; i < some; i++)
            for (size_t k = 0; k < r->lists[i].count; k++) {
                map_mark *to = map_list_add(marks);
                if (!to)
                    return no_memory(err);
                *to = ((map_mark *)r->lists[i].items)[k];
            }
        r->first += (uint32_t)some;
    }
    return true;
}

/* How many particles of all sets the accuracy calls for. Light is gathered from about the square of
 * how far one sees, pi d^2, of all the area A that is lit. A gather that weighs the n deposits
 * there unlike each other, by about as much again as they differ among themselves, has the variance
 * 2 (sum w^2 / (sum w)^2) = 2 c / n of its square:
 *
 *     n = 2 c / (accuracy / 2)^2          on pi d^2, hence n A / (pi d^2) in all
 *
 * for an accuracy of 1; 0: it is dark.
 */
static double particles_for_one(const map_run *r, const map_growth *g)
{
    double sum = 0.0, square = 0.0, count = (double)g->mark_count;
    for (size_t i = 0; i < g->mark_count; i++) {
        double w = (double)g->marks[i].weight;
        sum += w;
        square += w * w;
    }
    if (!(sum > 0.0))
        return 0.0;
    double n     = 2.0 * count * square / (sum * sum) / (gather_share * gather_share);
    double seen  = r->all.ways > 0 ? M_PI * r->all.way2 / (double)r->all.ways : HUGE_VAL;
    double rooms = fmax(1.0, map_lit_area(g, &r->m->cells) / seen);
    return n * rooms * (double)r->first * MAP_BATCH / count;
}

static int64_t particles_for(const illumination_map *m, double accuracy)
{
    double least = LEAST_CHUNKS / fmax(1.0, m->deposits) * MAP_BATCH * SCRAMBLES;
    double most  = (double)MAP_MOST_PARTICLES;
    return (int64_t)fmin(fmax(m->calls_for / (accuracy * accuracy), least), most);
}

/* Chunks of a set for so many particles; where the number is free a power of two, as evenness
 * likes it. */
static uint32_t chunks_for(int64_t particles, bool free)
{
    int64_t of_wave = (int64_t)MAP_BATCH * SCRAMBLES;
    int64_t chunks  = particles / of_wave + (particles % of_wave > 0);
    chunks          = chunks < 1 ? 1 : chunks > 1 << 20 ? 1 << 20 : chunks;
    int64_t power   = 1;
    while (power < chunks)
        power *= 2;
    return (uint32_t)(free ? power : chunks);
}

/* Particles that find the cells of so many. */
static double pilots_for(double particles) { return fmin(particles / PILOT_SHARE, MOST_PILOTS); }

int64_t illumination_map_calls_for(const illumination_map *m, double accuracy, int64_t *pilots)
{
    uint32_t chunks   = chunks_for(particles_for(m, accuracy), true);
    int64_t particles = (int64_t)chunks * MAP_BATCH * SCRAMBLES;
    if (pilots)
        *pilots = (int64_t)fmax(pilots_for((double)particles), FIRST_PILOTS);
    return particles;
}

/* ---- values ---------------------------------------------------------------------------------- */

static void add_deposit(const map_run *r, const map_deposit *d, int set)
{
    const illumination_map *m = r->m;
    const float flux[3]       = { d->flux.x, d->flux.y, d->flux.z };
    double *all               = r->sums + map_value_at(m, (size_t)d->bin, 0, set);
    for (int c = 0; c < 3; c++)
        all[c] += (double)d->dimming * (double)flux[c];
    if (m->slots == 1)
        return;
    double *group = r->sums + map_value_at(m, (size_t)d->bin, 1 + d->group, set);
    for (int c = 0; c < 3; c++)
        group[c] += (double)flux[c];
}

static void add_set(void *context, int set, int thread)
{
    (void)thread;
    map_run *r = context;
    for (int i = set; i < WAVE_CHUNKS; i += SCRAMBLES) {
        const map_deposit *d = r->lists[i].items;
        for (size_t k = 0; k < r->lists[i].count; k++)
            add_deposit(r, &d[k], set);
        r->lists[i].count = 0;
    }
}

/* m^2. */
static double bin_area(const map_run *r, size_t bin)
{
    size_t nodes = (size_t)r->m->cells.node_count;
    if (bin < nodes)
        return r->m->cells.nodes[bin].area;
    double side = (double)map_sensor_side(r->o->sensors, (int)((bin - nodes) / 2));
    return (bin - nodes) % 2 ? 2.0 * side * side : side * side;
}

/* Parents by summing, then W/m^2. */
static void make_values(map_run *r)
{
    illumination_map *m = r->m;
    size_t one          = (size_t)m->slots * SCRAMBLES * 3;
    double each         = (double)r->first * MAP_BATCH; /* particles of a set */
    for (int32_t n = m->cells.node_count - 1; n >= 0; n--) {
        int32_t parent = m->cells.nodes[n].parent;
        for (size_t i = 0; parent >= 0 && i < one; i++)
            r->sums[(size_t)parent * one + i] += r->sums[(size_t)n * one + i];
    }
    for (size_t bin = 0; bin < map_bins(m); bin++) {
        double area  = bin_area(r, bin);
        double scale = area > 0.0 ? 1.0 / (area * each) : 0.0;
        for (size_t i = 0; i < one; i++)
            m->values[bin * one + i] = (float)(scale * r->sums[bin * one + i]);
    }
}

static bool send_particles(map_run *r, uint32_t chunks, lux_error *err)
{
    for (int i = 0; i < WAVE_CHUNKS; i++) {
        map_list_free(&r->lists[i]);
        r->lists[i].size = sizeof(map_deposit);
    }
    r->first = 0;
    r->all   = (map_balance){ .rays = r->all.rays };
    while (r->first < chunks) {
        uint32_t left = chunks - r->first, most = WAVE_CHUNKS / SCRAMBLES;
        uint32_t some = left < most ? left : most;
        if (!trace_wave(r, (int)some * SCRAMBLES, err))
            return false;
        parallel_for(SCRAMBLES, r->o->threads, add_set, r, NULL);
        r->first += some;
        progress_update(r->o->progress, (double)r->first / (double)chunks, (double)NAN);
        if (clock_seconds() > r->o->deadline)
            break;
    }
    return true;
}

/* ---- making ---------------------------------------------------------------------------------- */

bool map_dimmings(arena *a, const scene *s, float **out, lux_error *err)
{
    float *d = arena_array(a, float, (size_t)s->group_count + 1, err);
    if (!d)
        return false;
    for (int g = 0; g < s->group_count; g++)
        d[g] = -1.0f;
    for (int l = 0; l <= s->light_count; l++) {
        bool glow = l == s->light_count;
        int g     = glow ? s->glow_group : s->light_info[l].group;
        if (g < 0 || g >= s->group_count || (glow && !s->glows))
            continue;
        float to = glow ? s->glow_dimming : s->light_info[l].dimming;
        d[g]     = d[g] == -1.0f || d[g] == to ? to : NAN;
    }
    for (int g = 0; g < s->group_count; g++)
        d[g] = d[g] == -1.0f ? 1.0f : d[g];
    *out = d;
    return true;
}

/* What particles set out by. */
static bool find_light(arena *a, map_run *r, lux_error *err)
{
    const map_options *o = r->o;
    illumination_map *m  = r->m;
    if (m->kind == MAP_INDIRECT)
        return (r->job.light = emission_new(a, m->s, err)) != NULL;
    aim_desc d = { m->s,      o->seed,    o->threads, o->particles,
                   &m->cells, r->tracers, o->sensors, stop_of(o) };
    return (r->job.aim = map_aim_new(a, &d, err)) != NULL;
}

static bool prepare(arena *a, arena *scratch, map_run *r, lux_error *err)
{
    const map_options *o = r->o;
    illumination_map *m  = r->m;
    r->pilot_seed        = hash_combine_u32(o->seed, 0x9170);
    for (uint32_t i = 0; i < SCRAMBLES; i++)
        r->seeds[i] = hash_combine_u32(hash_combine_u32(o->seed, 0x3a95), i);
    r->job     = (map_job){ .s = m->s, .kind = m->kind };
    r->tracers = arena_array(scratch, map_tracer *, (size_t)o->threads, err);
    if (!r->tracers || !map_meshes_new(a, m->s, &m->cells, err))
        return false;
    for (int i = 0; i < o->threads; i++)
        if (!(r->tracers[i] = map_tracer_new(scratch, err)))
            return false;
    return map_dimmings(a, m->s, &m->dimming, err) && find_light(scratch, r, err);
}

/* Cells, and how many chunks a set is to have. */
static bool find_cells(arena *a, map_run *r, map_list *marks, uint32_t *chunks, lux_error *err)
{
    illumination_map *m = r->m;
    int64_t particles   = r->o->particles;
    bool free           = particles <= 0;
    size_t first        = free || particles > FIRST_PILOTS ? FIRST_PILOTS : (size_t)particles;
    if (!send_pilots(r, first, marks, err))
        return false;
    map_growth g = { .s = m->s, .marks = marks->items, .mark_count = marks->count };
    m->calls_for = particles_for_one(r, &g);
    m->deposits  = (double)marks->count / ((double)r->first * MAP_BATCH);
    if (free)
        particles = particles_for(m, r->o->accuracy);
    *chunks    = chunks_for(particles, free);
    double all = (double)*chunks * MAP_BATCH * SCRAMBLES;
    if (!send_pilots(r, (size_t)pilots_for(all), marks, err))
        return false;

    double bytes = (double)m->slots * SCRAMBLES * 3 * (sizeof(float) + sizeof(double));
    g.marks      = marks->items;
    g.mark_count = marks->count;
    g.scale      = all / ((double)r->first * MAP_BATCH);
    g.most       = (size_t)fmax(1.0, most_bytes / (bytes + sizeof(map_node)));
    g.least      = fmax(CELL_PARTICLES, 4.0 * g.scale * (double)g.mark_count / (double)g.most);
    /* Focused light that no cell takes is lost; other light paths find by themselves */
    g.fewest = m->kind == MAP_FOCUSED ? 1.0 : FEWEST_PARTICLES;
    return map_cells_grow(a, &g, &m->cells, err);
}

static bool make_map(arena *a, arena *scratch, map_run *r, map_list *marks, lux_error *err)
{
    illumination_map *m  = r->m;
    const map_sensors *s = r->o->sensors;
    uint32_t chunks      = 0;
    if (!prepare(a, scratch, r, err) || !find_cells(a, r, marks, &chunks, err))
        return false;
    map_list_free(marks);
    m->sensors = s && m->kind == MAP_FOCUSED ? s->count : 0;
    size_t n   = map_bins(m) * (size_t)m->slots * SCRAMBLES * 3;
    m->values  = arena_array(a, float, n + 1, err);
    r->sums    = arena_array(scratch, double, n + 1, err);
    if (!m->values || !r->sums)
        return false;
    r->job.cells            = &m->cells;
    r->job.first_sensor_bin = m->cells.node_count;
    if (m->sensors > 0 &&
        !(r->job.watch = map_watch_new(scratch, s, (map_widths){ .times = 1.0f }, err)))
        return false;
    if (!send_particles(r, chunks, err))
        return false;
    make_values(r);
    return map_find_smoothing(a, m, err);
}

static vec3 watts(const double sum[3], double particles)
{
    return d3_to_float((dvec3){ sum[0] / particles, sum[1] / particles, sum[2] / particles });
}

static void note_figures(map_run *r, double begun)
{
    illumination_map *m = r->m;
    double particles    = (double)r->first * MAP_BATCH * SCRAMBLES;
    size_t values       = map_bins(m) * (size_t)m->slots * SCRAMBLES * 3;
    uint64_t bytes      = values * sizeof(float) + (size_t)m->cells.node_count * sizeof(map_node) +
                     m->cells.sheet_room * sizeof(map_sheet);
    for (uint32_t i = 0; i < m->cells.mesh_count; i++)
        bytes += (size_t)m->cells.meshes[i].count * (3 * sizeof(int32_t) + sizeof(uint64_t));
    m->figures = (map_figures){ .particles = (int64_t)particles,
                                .rays      = r->all.rays,
                                .cells     = m->cells.node_count,
                                .bytes     = (int64_t)bytes,
                                .seconds   = clock_seconds() - begun,
                                .emitted   = watts(r->all.emitted, particles),
                                .absorbed  = watts(r->all.absorbed, particles),
                                .escaped   = watts(r->all.escaped, particles),
                                .unplaced  = watts(r->all.unplaced, particles) };
    if (r->job.aim)
        m->figures.rays += map_aim_rays(r->job.aim);
    m->figures.sources = r->job.aim ? map_aim_flux(r->job.aim) : m->figures.emitted;
}

const illumination_map *illumination_map_new(arena *a, const scene *s, const map_options *o,
                                             lux_error *err)
{
    double begun        = clock_seconds();
    arena scratch       = { 0 };
    illumination_map *m = arena_new(a, illumination_map, err);
    map_run *r          = m ? arena_new(&scratch, map_run, err) : NULL;
    if (!r)
        return NULL;
    *m = (illumination_map){
        .s = s, .kind = o->light, .seed = o->seed, .slots = s->layered ? 1 + s->group_count : 1
    };
    r->o           = o;
    r->m           = m;
    map_list marks = { .size = sizeof(map_mark) };
    progress_begin(o->progress, "maps");
    bool done = make_map(a, &scratch, r, &marks, err);
    if (done)
        note_figures(r, begun);
    done = done && map_prints(s, o, m->print, err);
    for (int i = 0; i < WAVE_CHUNKS; i++)
        map_list_free(&r->lists[i]);
    map_list_free(&marks);
    for (int i = 0; r->tracers && i < o->threads; i++)
        map_tracer_free(r->tracers[i]);
    arena_clear(&scratch);
    return done ? m : NULL;
}

double illumination_map_noise(const illumination_map *m)
{
    const double student_t = 2.1314; /* 97.5 %, of SCRAMBLES - 1 degrees of freedom */
    double of[SCRAMBLES] = { 0 }, mean = 0.0, square = 0.0;
    for (int32_t n = 0; n < m->cells.node_count; n++)
        for (int set = 0; set < SCRAMBLES && m->cells.nodes[n].child == 0; set++) {
            const float *v = m->values + map_value_at(m, (size_t)n, 0, set);
            of[set] += m->cells.nodes[n].area * (double)rgb_luminance((vec3){ v[0], v[1], v[2] });
        }
    for (int set = 0; set < SCRAMBLES; set++)
        mean += of[set] / SCRAMBLES;
    for (int set = 0; set < SCRAMBLES; set++)
        square += (of[set] - mean) * (of[set] - mean);
    return mean > 0.0 ? student_t * sqrt(square / (SCRAMBLES - 1) / SCRAMBLES) / mean : 0.0;
}

map_figures illumination_map_figures(const illumination_map *m) { return m->figures; }
