/* sim/map_aim_make.c -- see map_aim.h: in what shares cells are drawn, as pilots tell. */
#include "sim/map_aim_parts.h"

#include "core/color.h"
#include "core/distribution.h"
#include "core/parallel.h"

#include <string.h>

enum {
    CELLS        = 1 << 14, /* of all sources together, about, */
    MOST_BLOCKS  = 1 << 12, /* of one at most, */
    LEAST_BLOCKS = 4,       /* and at least */
    ROUNDS       = 3,
    LEAST_CHUNKS = 64, /* of pilots, in a round, */
    PILOT_SHARE  = 16, /* else one pilot of a round for so many particles */
    BASE_PLACES  = 2,  /* of a cell, where it is asked what comes from a source */
    AIM_SEED     = 0xa13d,
};
static const double plain_share  = 0.15; /* of particles: as sources shine on cells, */
static const double matt_share   = 0.25; /* and by what came to surfaces; to sensors the rest */
static const double before_share = 0.25; /* as rounds before have learned, by wider squares */
static const double least_base   = 0.05; /* of a cell: of what all have on average */
static const double unseen_share = 1e-3; /* of a source's flux, about, where none of it was found */
/* Wide first: few pilots come to small squares before it is known where from. */
static const map_widths round_widths[ROUNDS] = { { 6.0f, 4.0f }, { 3.0f, 0.8f }, { 1.6f, 0.0f } };

/* ---- shares ---------------------------------------------------------------------------------- */

/* By which light of a source counts in what is asked for. */
static double counts_by(const scene *s, int source)
{
    return s->layered ? 1.0 : (double)s->light_info[source].dimming * scene_maintenance(s, source);
}

static uint32_t place_hash(const aim_learner *l, int block, int k)
{
    return hash_combine_u32(hash_combine_u32(hash_combine_u32(l->d->seed, AIM_SEED), (uint32_t)k),
                            (uint32_t)block);
}

/* W, as luminance: what number `number` of the sources shines on blocks from `first` on, by one
 * place of each. */
static vfloat shone_on(const aim_learner *l, int number, int first, int k, vmask *active)
{
    const map_aim *m = l->m;
    int32_t piece[LANES];
    float a[LANES], b[LANES], area[LANES];
    for (int i = 0; i < LANES; i++) {
        int block     = first + i < m->cut.blocks ? first + i : m->cut.blocks - 1;
        uint32_t hash = place_hash(l, block, k);
        int count     = m->cut.first[block + 1] - m->cut.first[block];
        piece[i]      = m->cut.first[block] + (int32_t)(hash % (uint32_t)count);
        a[i]          = (float)(hash_u32(hash) >> 8) * 0x1p-24f;
        b[i]          = (float)(hash_u32(~hash) >> 8) * 0x1p-24f;
        area[i]       = (float)m->cut.area[block];
    }
    vvec3 normal, q = aim_place(&m->cut, vload_int(piece), vload(a), vload(b), &normal);
    vlight_sample of;
    *active   = (vlane_index() + first) < m->cut.blocks;
    vmask lit = light_sample(m->s->lights[m->source[number]], &q, vload(a), vload(b), *active, &of);
    vfloat got = vrgb_luminance(of.e) * vabs(vdot(normal, of.wi)) * vload(area);
    return vkeep(lit & (got < INFINITY), got);
}

static void find_base_of(aim_learner *l, int number)
{
    const map_aim *m = l->m;
    double *base     = l->base + (size_t)number * (size_t)l->most;
    double sum = 0.0, all = 0.0,
           flux = (double)rgb_luminance(light_flux(m->s->lights[m->source[number]]));
    for (int b = 0; b < m->cut.blocks; b++) {
        base[b] = 0.0;
        all += m->cut.area[b];
    }
    for (int k = 0; k < BASE_PLACES; k++)
        for (int b = 0; b < m->cut.blocks; b += LANES) {
            vmask active;
            vfloat got = shone_on(l, number, b, k, &active);
            for (int i = 0; i < LANES && b + i < m->cut.blocks; i++)
                base[b + i] += (double)lane(got, i) / BASE_PLACES;
        }
    for (int b = 0; b < m->cut.blocks; b++)
        sum += base[b];
    double least = fmax(sum, isfinite(flux) ? unseen_share * flux : 1e-30);
    double by    = counts_by(m->s, m->source[number]);
    for (int b = 0; b < m->cut.blocks; b++)
        base[b] = by * (base[b] + least_base * least * m->cut.area[b] / all);
}

/* Makes cells' shares add up to 1; in layered scenes those of each group to the same. */
static bool make_even(const aim_learner *l, double *of)
{
    const map_aim *m = l->m;
    const scene *s   = m->s;
    double all = 0.0, groups = 0.0;
    for (int g = 0; g < (s->layered ? s->group_count : 1); g++) {
        double sum = 0.0;
        for (int pass = 0; pass < 2; pass++)
            for (int i = 0; i < m->sources; i++) {
                if (s->layered && s->light_info[m->source[i]].group != g)
                    continue;
                double *row = of + (size_t)i * (size_t)l->most;
                for (int b = 0; b < m->cut.blocks; b++)
                    if (pass == 0)
                        sum += row[b];
                    else if (sum > 0.0)
                        row[b] /= sum;
            }
        groups += sum > 0.0;
        all += sum;
    }
    for (int i = 0; all > 0.0 && i < m->sources; i++)
        for (int b = 0; b < m->cut.blocks; b++)
            of[(size_t)i * (size_t)l->most + (size_t)b] /= groups;
    return all > 0.0;
}

/* Tables to draw from, by the plain shares and those learned. */
static bool make_tables(aim_learner *l, arena *a, bool learned, lux_error *err)
{
    map_aim *m     = l->m;
    size_t sources = (size_t)m->sources, blocks = (size_t)m->cut.blocks;
    float *rows  = arena_array(a, float, sources *(blocks + 1), err);
    float *cdf   = rows ? arena_array(a, float, sources + 1, err) : NULL;
    double *sums = cdf ? arena_array(&l->scratch, double, sources, err) : NULL;
    if (!sums)
        return false;
    for (int i = 0; i < m->sources; i++)
        find_base_of(l, i);
    bool some = make_even(l, l->base);
    for (size_t i = 0; i < sources; i++) {
        double *to = l->share + i * (size_t)l->most;
        for (size_t b = 0; b < blocks; b++) {
            size_t at = i * (size_t)l->most + b;
            to[b]     = learned ? plain_share * l->base[at] + (1.0 - plain_share) * l->learned[at]
                                : l->base[at];
        }
        sums[i] = distribution_make(rows + i * (blocks + 1), to, (int)blocks);
    }
    distribution_make(cdf, sums, m->sources);
    m->source_cdf = cdf;
    m->block_cdf  = rows;
    m->sources    = some ? m->sources : 0;
    return true;
}

/* ---- learning -------------------------------------------------------------------------------- */

static void trace_round(void *context, int item, int thread)
{
    aim_learner *l = context;
    l->came[item]  = (map_balance){ 0 };
    map_trace(l->d->tracers[thread], &l->job, (uint32_t)item * MAP_BATCH, MAP_BATCH, l->job.learns,
              &l->lists[item], &l->came[item]);
}

/* Of flux at a sensor, 1/m^2: so that squares add up to the variance of its irradiance, by what it
 * may be. */
static double worth_of(const map_sensors *m, int sensor)
{
    double side = (double)map_sensor_side(m, sensor);
    return 1.0 / (side * side * (m->allowed ? (double)m->allowed[sensor] : 1.0));
}

/* The deposits' squares, by cell. */
static void take_deposits(aim_learner *l)
{
    int blocks = l->m->cut.blocks;
    for (int k = 0; k < 2; k++)
        memset(l->moment[k], 0, sizeof(double) * (size_t)l->m->sources * (size_t)l->most);
    for (int c = 0; c < l->chunks; c++) {
        const map_deposit *d = l->lists[c].items;
        for (size_t i = 0; i < l->lists[c].count; i++) {
            int sensor = d[i].bin >= 0;
            if (sensor && d[i].bin % 2 == 0)
                continue; /* the square within: it is in the other, too */
            size_t at =
                (size_t)(d[i].group / blocks) * (size_t)l->most + (size_t)(d[i].group % blocks);
            double came =
                (double)rgb_luminance(d[i].flux) * (l->m->s->layered ? 1.0 : (double)d[i].dimming);
            came *= sensor ? worth_of(l->d->sensors, d[i].bin / 2) : 1.0;
            l->moment[sensor][at] += came * came;
        }
        l->lists[c].count = 0;
    }
}

/* A cell's best share goes as the root of the mean square of what a pilot tells of it, which is its
 * flux times the share that it was drawn with. */
static void make_root(const aim_learner *l, double *squares)
{
    int blocks = l->m->cut.blocks;
    for (int i = 0; i < l->m->sources; i++) {
        double *row = squares + (size_t)i * (size_t)l->most, before = 0.0;
        const double *share = l->share + (size_t)i * (size_t)l->most;
        for (int b = 0; b < blocks; b++)
            row[b] *= share[b];
        for (int b = 0; b < blocks; b++) {
            double here = row[b], after = b + 1 < blocks ? row[b + 1] : here;
            row[b] = sqrt(0.25 * (b ? before : here) + 0.5 * here + 0.25 * after);
            before = here;
        }
    }
}

/* False: nothing came anywhere. */
static bool learn_shares(aim_learner *l, double kept)
{
    take_deposits(l);
    make_root(l, l->moment[0]);
    make_root(l, l->moment[1]);
    bool matt = make_even(l, l->moment[0]), seen = make_even(l, l->moment[1]);
    double by_matt = seen ? (matt ? matt_share / (1.0 - plain_share) : 0.0) : 1.0;
    for (size_t i = 0; i < (size_t)l->m->sources * (size_t)l->most; i++)
        l->learned[i] = kept * l->learned[i] + (1.0 - kept) * (by_matt * l->moment[0][i] +
                                                               (1.0 - by_matt) * l->moment[1][i]);
    return matt || seen;
}

static bool learn_round(aim_learner *l, int round, bool *some, lux_error *err)
{
    const aim_desc *d = l->d;
    l->job.watch      = NULL;
    if (d->sensors &&
        !(l->job.watch = map_watch_new(&l->scratch, d->sensors, round_widths[round], err)))
        return false;
    if (!make_tables(l, &l->scratch, *some, err))
        return false;
    if (l->m->sources == 0)
        return true;
    l->job.learns = hash_combine_u32(hash_combine_u32(d->seed, AIM_SEED), (uint32_t)round);
    if (!parallel_for(l->chunks, d->threads, trace_round, l, d->stop))
        return failed(err, ERR_INTERRUPTED, "illumination maps: interrupted");
    for (int c = 0; c < l->chunks; c++) {
        l->m->rays += l->came[c].rays;
        if (l->lists[c].lost)
            return aim_no_memory(err);
    }
    *some = learn_shares(l, *some ? before_share : 0.0);
    return true;
}

static bool learn(aim_learner *l, arena *a, lux_error *err)
{
    bool some = false;
    for (int round = 0; round < ROUNDS; round++)
        if ((some && !aim_cut_anew(l, err)) || !learn_round(l, round, &some, err))
            return false;
    return l->m->sources == 0 || make_tables(l, a, some, err);
}

/* ---- making ---------------------------------------------------------------------------------- */

static bool find_sources(arena *a, map_aim *m, lux_error *err)
{
    const scene *s  = m->s;
    int32_t *source = arena_array(a, int32_t, (size_t)s->light_count + 1, err);
    for (int i = 0; source && i < s->light_count; i++)
        if (counts_by(s, i) > 0.0)
            source[m->sources++] = i;
    m->source = source;
    return source != NULL;
}

static bool find_room(aim_learner *l, lux_error *err)
{
    int sources = l->m->sources > 0 ? l->m->sources : 1;
    int blocks  = CELLS / sources;
    blocks    = blocks > MOST_BLOCKS ? MOST_BLOCKS : blocks < LEAST_BLOCKS ? LEAST_BLOCKS : blocks;
    l->wanted = blocks;
    l->most   = 2 * blocks + 2;
    size_t cells = (size_t)sources * (size_t)l->most;
    arena *a     = &l->scratch;
    return (l->learned = arena_array(a, double, cells, err)) &&
           (l->base = arena_array(a, double, cells, err)) &&
           (l->share = arena_array(a, double, cells, err)) &&
           (l->moment[0] = arena_array(a, double, cells, err)) &&
           (l->moment[1] = arena_array(a, double, cells, err));
}

static int chunks_for(int64_t particles)
{
    int64_t n = particles / ((int64_t)PILOT_SHARE * MAP_BATCH);
    return (int)(n < LEAST_CHUNKS ? LEAST_CHUNKS : n > MOST_AIM_CHUNKS ? MOST_AIM_CHUNKS : n);
}

const map_aim *map_aim_new(arena *a, const aim_desc *d, lux_error *err)
{
    map_aim *m = arena_new(a, map_aim, err);
    if (!m)
        return NULL;
    vec3 low, high;
    world_bounds(d->s->world, &low, &high);
    vec3 far      = { fmaxf(fabsf(low.x), fabsf(high.x)), fmaxf(fabsf(low.y), fabsf(high.y)),
                      fmaxf(fabsf(low.z), fabsf(high.z)) };
    *m            = (map_aim){ .s = d->s, .radius = 1.001f * v3_length(far) };
    aim_learner l = { .d = d, .m = m, .job = { .s = d->s, .aim = m, .kind = MAP_FOCUSED } };
    l.chunks      = chunks_for(d->particles);
    for (int c = 0; c < MOST_AIM_CHUNKS; c++)
        l.lists[c].size = sizeof(map_deposit);
    bool good = find_sources(a, m, err) && find_room(&l, err) && aim_first_cut(&l, err);
    if (good && m->cut.blocks == 0)
        m->sources = 0;
    good = good && (m->sources == 0 || learn(&l, a, err)) && aim_keep_cut(a, m, err);
    for (int c = 0; c < MOST_AIM_CHUNKS; c++)
        map_list_free(&l.lists[c]);
    arena_clear(&l.scratch);
    return good ? m : NULL;
}

int64_t map_aim_rays(const map_aim *m) { return m->rays; }

vec3 map_aim_flux(const map_aim *m)
{
    const scene *s = m->s;
    vec3 sum       = { 0, 0, 0 };
    vvec3 centre   = vspread((vec3){ 0, 0, 0 });
    for (int i = 0; i < m->sources; i++) {
        const light *l = s->lights[m->source[i]];
        vec3 flux      = light_flux(l);
        float by       = (float)scene_maintenance(s, m->source[i]);
        if (isinf(rgb_luminance(flux))) { /* onto the sphere around the scene */
            vlight_sample of;
            light_sample(l, &centre, vsplat(0.5f), vsplat(0.5f), ALL_LANES, &of);
            vec3 e = { lane(of.e.x, 0), lane(of.e.y, 0), lane(of.e.z, 0) };
            flux   = v3_scale(e, (float)M_PI * m->radius * m->radius);
        }
        sum = (vec3){ sum.x + by * flux.x, sum.y + by * flux.y, sum.z + by * flux.z };
    }
    return sum;
}
