/* sim/direct_sensor.c -- see direct_sensor.h. */
#include "sim/direct_sensor.h"

#include "core/color.h"
#include "core/sampler.h"
#include "sim/direct.h"

#include <math.h>
#include <string.h>

enum {
    TAIL_RAYS  = 16, /* a sensor and layer, for all weak lamps together */
    BUCKETS    = 1024,
    SAMPLE_SET = 0x1a3b, /* the samples of lamps, beside those of paths */
};

/* Shares of the accuracy asked for: of all weak lamps, and of all lamps taken as points. */
static const float tail_share  = 0.1f;
static const float point_share = 0.1f;

/* A lamp as the sensors of a packet see it. */
typedef struct candidate {
    vvec3 wi;
    vfloat dist;
    vfloat e;      /* W/m^2 as luminance, as a point or by its closed form; nothing in between */
    vfloat error;  /* bound of what that is off */
    vfloat weight; /* about what it gives; above 0 wherever it does */
} candidate;

typedef struct direct_sensor {
    const scene *s;
    sensor_ask ask;
    int layers; /* each judged by itself */
    int64_t ray_count;
    candidate *lamps;
    vfloat *total, *count; /* of a layer: the sum of weights, and how many are above 0 */
    vfloat *weakest;       /* of a layer: lamps that give less are its tail */
    vfloat *tail;          /* their sum */

    /* Lamps to be sampled, lane by lane: their running sums of weights */
    int32_t *listed[LANES], listed_count[LANES];
    float *running[LANES];
    vsurface at;

    vray rays[DIRECT_PACKETS];
    vmask asked[DIRECT_PACKETS], blocked[DIRECT_PACKETS];
    vint spare[DIRECT_PACKETS], light[DIRECT_PACKETS];
    vfloat e[DIRECT_PACKETS];
    int batched;
} direct_sensor;

direct_sensor *direct_sensor_new(arena *a, const scene *s, const sensor_ask *ask, lux_error *err)
{
    size_t lamps     = (size_t)s->light_count + 1;
    direct_sensor *w = arena_new(a, direct_sensor, err);
    if (!w)
        return NULL;
    w->s          = s;
    w->ask        = *ask;
    w->layers     = s->layered ? s->group_count : 1;
    size_t layers = (size_t)w->layers + 1;
    w->lamps      = arena_array(a, candidate, lamps, err);
    w->total      = arena_array(a, vfloat, 4 * layers, err);
    bool good     = w->lamps && w->total;
    for (int i = 0; good && i < LANES; i++) {
        w->listed[i]  = arena_array(a, int32_t, lamps, err);
        w->running[i] = arena_array(a, float, lamps, err);
        good          = w->listed[i] && w->running[i];
    }
    if (!good)
        return NULL;
    w->count   = w->total + layers;
    w->weakest = w->count + layers;
    w->tail    = w->weakest + layers;
    return w;
}

int64_t direct_sensor_rays(const direct_sensor *w) { return w->ray_count; }

static int layer_of(const direct_sensor *w, int l)
{
    return w->s->layered ? w->s->light_info[l].group : 0;
}

static bool is_clear(const direct_sensor *w, int l)
{
    return w->ask.in_room && w->s->light_info[l].clear;
}

static bool has_closed_form(const direct_sensor *w, int l)
{
    return w->s->lights[l]->type->irradiance && !quantity_is_round(w->ask.quantity) &&
           is_clear(w, l);
}

/* ---- what each lamp would give --------------------------------------------------------------- */

/* The normal by which a lamp is weighed; where light from all around counts, as it faces it. */
static vvec3 facing(const direct_sensor *w, const light *l, const vsurface *at)
{
    if (!quantity_is_round(w->ask.quantity))
        return at->normal;
    light_bounds b = light_bounds_of(l);
    vvec3 middle   = vscale(vadd(vspread(b.low), vspread(b.high)), vsplat(0.5f));
    vvec3 to       = b.far ? vneg(vspread(b.axis)) : vsub(middle, at->position);
    vfloat length  = vlength(to);
    return vselect3(length > 0.0f, vscale(to, 1.0f / length), at->normal);
}

static candidate weigh(const direct_sensor *w, int i, const vsurface *at, vmask active)
{
    const light *l = w->s->lights[i];
    candidate c    = { 0 };
    vlight_sample lamp;
    if (has_closed_form(w, i)) {
        vrgb all = l->type->irradiance(l, &at->position, &at->normal, active);
        c.e = c.weight = vrgb_luminance(all);
        return c;
    }
    vfloat middle = vsplat(0.5f);
    vmask lit = light_has_extent(l) ? l->type->as_point(l, &at->position, active, &lamp, &c.error)
                                    : light_sample(l, &at->position, middle, middle, active, &lamp);
    vfloat response = vsensor_response(w->ask.quantity, &at->normal, &lamp.wi);
    c.wi            = lamp.wi;
    c.dist          = lamp.dist;
    c.e             = vkeep(lit, vrgb_luminance(lamp.e) * response);
    c.weight        = c.e;
    if (light_has_extent(l)) {
        vvec3 n  = facing(w, l, at);
        c.weight = direct_weight(l, &at->position, &n, active);
    }
    return c;
}

static void weigh_all(direct_sensor *w, const vsurface *at, vmask active)
{
    memset(w->total, 0, sizeof(vfloat) * 4 * ((size_t)w->layers + 1));
    for (int l = 0; l < w->s->light_count; l++) {
        candidate *c    = &w->lamps[l];
        int layer       = layer_of(w, l);
        *c              = weigh(w, l, at, active);
        w->total[layer] = w->total[layer] + c->weight;
        w->count[layer] = w->count[layer] + vkeep(c->weight > 0.0f, vsplat(1.0f));
    }
}

/* Where lamp l may be taken as a point: nothing hides a part of it, the horizon neither, and its
 * bound small against what it, or the mean of its layer's lamps, gives. The bounds of all add up to
 * the share at most. */
static vmask as_a_point(const direct_sensor *w, int l, const vsurface *at, vmask active)
{
    const candidate *c = &w->lamps[l];
    int layer          = layer_of(w, l);
    if (!light_has_extent(w->s->lights[l]) || has_closed_form(w, l))
        return ALL_LANES;
    if (!is_clear(w, l) || quantity_is_round(w->ask.quantity))
        return (vmask){ 0 };
    light_bounds box = light_bounds_of(w->s->lights[l]);
    vmask whole      = vlight_is_whole(&box, &at->position, &at->normal, active);
    vfloat mean      = w->total[layer] / vmax(w->count[layer], vsplat(1.0f));
    vfloat least     = vmax(c->weight, mean);
    return whole & (c->error <= 0.5f * point_share * (float)w->ask.accuracy * least);
}

/* ---- rays ------------------------------------------------------------------------------------ */

/* One or all of the sums that a lamp's light belongs to. */
static void add(const direct_sensor *w, sensor_sum *sums, int l, vfloat e, vfloat bound)
{
    float dimming = w->s->light_info[l].dimming;
    sums[0].e     = sums[0].e + dimming * e;
    sums[0].bound = sums[0].bound + dimming * bound;
    if (w->s->layered) {
        sensor_sum *layer = &sums[1 + w->s->light_info[l].group];
        layer->e          = layer->e + e;
        layer->bound      = layer->bound + bound;
    }
}

static void trace_batch(direct_sensor *w, ray_hint hint)
{
    for (int k = 0; k < w->batched; k++)
        w->ray_count += __builtin_popcount((unsigned)vbits(w->asked[k]));
    if (w->batched)
        world_any_hit(w->s->world, w->rays, w->asked, w->s->owners ? w->spare : NULL, w->batched,
                      hint, w->blocked);
}

/* Ends the rays of whole packets to one lamp each. */
static void end_batch(direct_sensor *w, sensor_sum *sums)
{
    trace_batch(w, RAYS_COHERENT);
    for (int k = 0; k < w->batched; k++)
        add(w, sums, lane(w->light[k], 0), vkeep(w->asked[k] & ~w->blocked[k], w->e[k]),
            (vfloat){ 0 });
    w->batched = 0;
}

static void ask_lamp(direct_sensor *w, const vsurface *at, int l, vmask asked, sensor_sum *sums)
{
    const candidate *c = &w->lamps[l];
    int k              = w->batched++;
    w->rays[k]         = direct_shadow_ray(at, &c->wi, c->dist);
    w->asked[k]        = asked;
    w->spare[k]        = vsplat_int(w->s->light_info[l].owner);
    w->light[k]        = vsplat_int(l);
    w->e[k]            = c->e;
    if (w->batched == DIRECT_PACKETS)
        end_batch(w, sums);
}

/* ---- many lamps: the strongest and the tail -------------------------------------------------- */

/* Lamps that have a shadow ray of their own, or belong to the tail. */
static bool is_asked(const direct_sensor *w, int l)
{
    return !light_has_extent(w->s->lights[l]) && !is_clear(w, l);
}

/* The e below which all lamps of the layer together give less than the share of all: found by
 * sorting them into buckets by exponent and two bits of the fraction. */
static float weakest_of(const direct_sensor *w, int layer, int i)
{
    double sums[BUCKETS] = { 0 };
    for (int l = 0; l < w->s->light_count; l++) {
        float e = lane(w->lamps[l].e, i);
        if (!is_asked(w, l) || layer_of(w, l) != layer || !(e > 0.0f))
            continue;
        uint32_t bits;
        memcpy(&bits, &e, sizeof bits);
        sums[bits >> 21] += (double)e;
    }
    double left     = (double)tail_share * w->ask.accuracy * (double)lane(w->total[layer], i);
    uint32_t bucket = 0;
    while (bucket < BUCKETS - 1 && sums[bucket] <= left)
        left -= sums[bucket++];
    uint32_t bits = bucket << 21;
    float weakest;
    memcpy(&weakest, &bits, sizeof weakest);
    return weakest;
}

static void find_weakest(direct_sensor *w, vmask active)
{
    for (int layer = 0; layer < w->layers; layer++) {
        float weakest[LANES] = { 0 };
        for (int bits = vbits(active); bits && w->s->light_count > ASKED_LAMPS; bits &= bits - 1) {
            int i      = __builtin_ctz((unsigned)bits);
            weakest[i] = weakest_of(w, layer, i);
        }
        w->weakest[layer] = vload(weakest);
    }
}

/* The lamps that a lane's tail rays go to: at even steps through the running sum, from u on. */
static void pick_tail(const direct_sensor *w, int layer, int i, float u, int32_t picks[TAIL_RAYS])
{
    double step = (double)lane(w->tail[layer], i) / TAIL_RAYS, sum = 0.0;
    int j = 0;
    for (int l = 0; l < w->s->light_count && j < TAIL_RAYS; l++) {
        float e = lane(w->lamps[l].e, i);
        if (!is_asked(w, l) || layer_of(w, l) != layer || !(e > 0.0f) ||
            e >= lane(w->weakest[layer], i))
            continue;
        for (sum += (double)e; j < TAIL_RAYS && (j + (double)u) * step < sum; j++)
            picks[j] = l;
        picks[TAIL_RAYS - 1] = j < TAIL_RAYS ? l : picks[TAIL_RAYS - 1];
    }
    for (int last = j ? picks[j - 1] : 0; j < TAIL_RAYS; j++) /* what rounding left over */
        picks[j] = last;
}

/* The rays of one layer's tail: unbiased, and off by at most the spread of TAIL_RAYS draws that are
 * all or nothing: t / 2 sqrt(TAIL_RAYS) with Student's t of 15 degrees of freedom. */
static void ask_tail(direct_sensor *w, const vsurface *at, int layer, uint32_t first,
                     sensor_sum *sums)
{
    const float half_width          = 2.1314f * 0.125f;
    int32_t picks[LANES][TAIL_RAYS] = { 0 };
    vmask active                    = w->tail[layer] > 0.0f;
    for (int bits = vbits(active); bits; bits &= bits - 1) {
        int i = __builtin_ctz((unsigned)bits);
        float u =
            0x1p-24f *
            (float)(hash_combine_u32(w->ask.seed + (uint32_t)layer, first + (uint32_t)i) >> 8);
        pick_tail(w, layer, i, u, picks[i]);
    }
    for (int j = 0; j < TAIL_RAYS; j++) {
        vmask left  = active;
        vvec3 wi    = { 0 };
        vfloat dist = { 0 };
        int32_t of[LANES];
        for (int i = 0; i < LANES; i++)
            of[i] = picks[i][j];
        w->light[j] = vload_int(of);
        w->spare[j] = vsplat_int(0);
        while (vany(left)) {
            int l       = lane(w->light[j], __builtin_ctz((unsigned)vbits(left)));
            vmask same  = left & (w->light[j] == l);
            left        = left & ~same;
            wi          = vselect3(same, w->lamps[l].wi, wi);
            dist        = vselect(same, w->lamps[l].dist, dist);
            w->spare[j] = vselect_int(same, vsplat_int(w->s->light_info[l].owner), w->spare[j]);
        }
        w->rays[j]  = direct_shadow_ray(at, &wi, dist);
        w->asked[j] = active;
    }
    w->batched = TAIL_RAYS;
    trace_batch(w, RAYS_INCOHERENT);
    w->batched = 0;
    for (int j = 0; j < TAIL_RAYS; j++) {
        vmask lit = w->asked[j] & ~w->blocked[j];
        vfloat e  = vkeep(lit, w->tail[layer] * (1.0f / TAIL_RAYS));
        for (vmask left = lit; vany(left);) {
            int l      = lane(w->light[j], __builtin_ctz((unsigned)vbits(left)));
            vmask same = left & (w->light[j] == l);
            left       = left & ~same;
            add(w, sums, l, vkeep(same, e), (vfloat){ 0 });
        }
    }
    vfloat bound  = vkeep(active, half_width * w->tail[layer]);
    sums[0].bound = sums[0].bound + bound;
    if (w->s->layered)
        sums[1 + layer].bound = sums[1 + layer].bound + bound;
}

vmask direct_sensor_sum(direct_sensor *w, const vsurface *at, vmask active, uint32_t first,
                        sensor_sum *sums)
{
    memset(sums, 0, sizeof *sums * (size_t)(w->s->layered ? 1 + w->s->group_count : 1));
    vmask pending = { 0 };
    weigh_all(w, at, active);
    find_weakest(w, active);
    for (int l = 0; l < w->s->light_count; l++) {
        const candidate *c = &w->lamps[l];
        int layer          = layer_of(w, l);
        vmask gives        = active & (c->e > 0.0f);
        if (is_asked(w, l)) {
            vmask strong   = gives & (c->e >= w->weakest[layer]);
            w->tail[layer] = w->tail[layer] + vkeep(gives & ~strong, c->e);
            if (vany(strong))
                ask_lamp(w, at, l, strong, sums);
            continue;
        }
        vmask known = active & as_a_point(w, l, at, active);
        pending     = pending | (active & ~known & (c->weight > 0.0f));
        add(w, sums, l, vkeep(known, c->e), vkeep(known, c->error));
    }
    end_batch(w, sums);
    for (int layer = 0; layer < w->layers; layer++)
        if (vany(w->tail[layer] > 0.0f))
            ask_tail(w, at, layer, first, sums);
    return pending;
}

/* ---- lamps that take samples ----------------------------------------------------------------- */

void direct_sensor_prepare(direct_sensor *w, const vsurface *at, vmask active)
{
    double sum[LANES] = { 0 };
    memset(w->listed_count, 0, sizeof w->listed_count);
    w->at = *at;
    if (!w->s->extended)
        return;
    weigh_all(w, at, active);
    for (int l = 0; l < w->s->light_count; l++) {
        if (!light_has_extent(w->s->lights[l]))
            continue;
        vmask sampled = active & ~as_a_point(w, l, at, active) & (w->lamps[l].weight > 0.0f);
        for (int bits = vbits(sampled); bits; bits &= bits - 1) {
            int i = __builtin_ctz((unsigned)bits), n = w->listed_count[i]++;
            sum[i] += (double)lane(w->lamps[l].weight, i);
            w->listed[i][n]  = l;
            w->running[i][n] = (float)sum[i];
        }
    }
}

/* Which of the listed lamps of sensor i the numbers u pick, and with what probability. */
static vint pick_listed(const direct_sensor *w, int i, vfloat u, vfloat *chance)
{
    const float *running = w->running[i];
    int count            = w->listed_count[i];
    vfloat target        = u * running[count - 1];
    vint low             = vsplat_int(0); /* of the lamps before it the running sum is <= target */
    for (int left = count; left > 1; left -= left / 2) {
        vint middle = low + left / 2;
        low         = vselect_int(vgather(running, middle - 1) <= target, middle, low);
    }
    vfloat before = vkeep(low > 0, vgather(running, vselect_int(low > 0, low - 1, low)));
    *chance       = (vgather(running, low) - before) / running[count - 1];
    return vgather_int(w->listed[i], low);
}

/* One ray of each lane of packet k toward the lamp that it drew. */
static void draw_packet(direct_sensor *w, int i, int k, vuint index, vuint seed, vmask active)
{
    const scene *s = w->s;
    float p[3]     = { lane(w->at.position.x, i), lane(w->at.position.y, i),
                       lane(w->at.position.z, i) };
    float n[3]     = { lane(w->at.normal.x, i), lane(w->at.normal.y, i), lane(w->at.normal.z, i) };
    vsurface at    = { .position = { vsplat(p[0]), vsplat(p[1]), vsplat(p[2]) },
                       .normal   = { vsplat(n[0]), vsplat(n[1]), vsplat(n[2]) },
                       .error    = vsplat(lane(w->at.error, i)) };
    vsample4 u     = vsobol4(index, vhash_combine(seed, vsplat_uint(SAMPLE_SET)));
    vfloat chance;
    w->light[k] = pick_listed(w, i, u.z, &chance);
    w->asked[k] = (vmask){ 0 };
    w->e[k]     = (vfloat){ 0 };
    w->spare[k] = vsplat_int(0);
    vvec3 wi    = { 0 };
    vfloat dist = { 0 };
    for (vmask left = active & (chance > 0.0f); vany(left);) {
        int l      = lane(w->light[k], __builtin_ctz((unsigned)vbits(left)));
        vmask same = left & (w->light[k] == l);
        left       = left & ~same;
        vlight_sample lamp;
        vmask lit       = light_sample(s->lights[l], &at.position, u.x, u.y, same, &lamp);
        vfloat response = vsensor_response(w->ask.quantity, &at.normal, &lamp.wi);
        vfloat e        = vrgb_luminance(lamp.e) * response / chance;
        lit             = lit & (e > 0.0f);
        wi              = vselect3(lit, lamp.wi, wi);
        dist            = vselect(lit, lamp.dist, dist);
        w->e[k]         = vselect(lit, e, w->e[k]);
        w->spare[k]     = vselect_int(lit, vsplat_int(s->light_info[l].owner), w->spare[k]);
        if (!is_clear(w, l))
            w->asked[k] = w->asked[k] | lit;
    }
    w->rays[k] = direct_shadow_ray(&at, &wi, dist);
}

void direct_sensor_draw(direct_sensor *w, int i, const uint32_t *index, const uint32_t *seed,
                        int count, float *e, int32_t *lamp)
{
    for (int j = 0; j < count; j++)
        e[j] = 0.0f, lamp[j] = -1;
    if (!w->listed_count[i])
        return;
    for (int from = 0; from < count; from += DIRECT_PACKETS * LANES) {
        int to = count - from < DIRECT_PACKETS * LANES ? count : from + DIRECT_PACKETS * LANES;
        for (int j = from; j < to; j += LANES) {
            int32_t x[LANES] = { 0 }, y[LANES] = { 0 };
            for (int k = 0; k < LANES && j + k < to; k++)
                x[k] = (int32_t)index[j + k], y[k] = (int32_t)seed[j + k];
            draw_packet(w, i, w->batched++, vunsigned(vload_int(x)), vunsigned(vload_int(y)),
                        (vlane_index() + j) < to);
        }
        trace_batch(w, RAYS_COHERENT);
        for (int j = from; j < to; j++) {
            int k = (j - from) / LANES, at = (j - from) % LANES;
            bool hidden = vbits(w->asked[k] & w->blocked[k]) >> at & 1;
            e[j]        = hidden ? 0.0f : lane(w->e[k], at);
            lamp[j]     = lane(w->light[k], at);
        }
        w->batched = 0;
    }
}
