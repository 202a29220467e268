/* sim/grid_sample.c -- what sensors of a grid get: what is known of it, and samples of the rest. */
#include "core/color.h"
#include "core/sampler.h"
#include "sim/grid_parts.h"

#include <string.h>

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

/* Adds to what is known of all that the light of a group belongs to: lx. */
static void add_known(grid_run_state *g, size_t sensor, int group, double dimmed, double lux,
                      double bound)
{
    size_t n = (size_t)g->r->sensor_count;
    for (int h = 0; h < g->moments; h++)
        if (group <= 0 || group == 1 + h) {
            g->known[(size_t)h * n + sensor] += lux;
            g->bound[(size_t)h * n + sensor] += bound;
        }
    if (g->moments)
        return;
    g->known[sensor] += dimmed * lux;
    g->bound[sensor] += dimmed * bound;
    if (!g->layers)
        return;
    g->known[FULL * n + sensor] += lux;
    g->bound[FULL * n + sensor] += bound;
    g->known[(size_t)(LAYERS + group) * n + sensor] += lux;
    g->bound[(size_t)(LAYERS + group) * n + sensor] += bound;
}

/* Lamps: a layered scene tells their groups apart. */
static void take_lamps(grid_run_state *g, const thread_scratch *w, size_t sensor, int i)
{
    const double unit = LUMENS_PER_WATT;
    if (g->r->electric)
        g->r->electric[sensor] = unit * (double)lane(w->sums[0].e, i);
    if (g->layers == 0) {
        add_known(g, sensor, -1, 1.0, unit * (double)lane(w->sums[0].e, i),
                  unit * (double)lane(w->sums[0].bound, i));
        return;
    }
    for (int l = 0; l < g->layers; l++)
        add_known(g, sensor, l, 0.0, unit * (double)lane(w->sums[1 + l].e, i),
                  unit * (double)lane(w->sums[1 + l].bound, i));
    g->known[sensor] += g->moments ? 0.0 : unit * (double)lane(w->sums[0].e, i);
    g->bound[sensor] += g->moments ? 0.0 : unit * (double)lane(w->sums[0].bound, i);
}

static void look_at_suns(grid_run_state *g, thread_scratch *w, const vsurface *at, vmask active,
                         int first)
{
    vuint sensor = vunsigned(vlane_index() + first);
    for (int sun = 0; sun < g->s->sun_count; sun++) {
        const scene_light *info = &g->s->light_info[scene_lamp_count(g->s) + sun];
        sun_look of = sun_look_at(w->suns, at, sun, g->seed, sensor, g->r->asked, active);
        for (int bits = vbits(active); bits; bits &= bits - 1) {
            int i    = __builtin_ctz((unsigned)bits);
            size_t k = (size_t)(first + i);
            size_t j = (size_t)sun * (size_t)g->r->sensor_count + k;

            double lux      = LUMENS_PER_WATT * (double)lane(of.e, i);
            double bound    = LUMENS_PER_WATT * (double)lane(of.bound, i);
            bool mixed      = vbits(of.mixed) >> i & 1;
            g->sun_known[j] = mixed ? (double)NAN : lux;
            g->sun_share[j] = (double)lane(of.open, i);
            add_known(g, k, info->group, (double)info->dimming, lux, bound);
        }
    }
}

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
    for (int i = 0; i < count; i++)
        take_lamps(g, w, (size_t)(first + i), i);
    look_at_suns(g, w, &at, active, first);
}

void grid_sum_chunk(void *context, int item, int thread)
{
    grid_run_state *g = context;
    int end           = (item + 1) * GRID_CHUNK;
    for (int first = item * GRID_CHUNK; first < end && first < g->r->sensor_count; first += LANES)
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

enum { SUN_SET = 0x50a5 /* the samples of suns, beside those of others */ };

/* A packet of what begins at sensors: number first and so on of the bundle. */
static vsurface surface_of(const path_bundle *b, int first)
{
    return (
        vsurface){ .position = { vload(b->x + first), vload(b->y + first), vload(b->z + first) },
                   .normal   = { vload(b->nx + first), vload(b->ny + first), vload(b->nz + first) },
                   .error    = vload(b->error + first) };
}

/* Suns that are disks: one of all is asked for each sample, and counts for all, less what is known
 * of it. */
static void sample_suns(grid_run_state *g, thread_scratch *w, const sample_id *ids, int count)
{
    const scene *s       = g->s;
    const path_bundle *b = &w->bundle;
    vsurface at[SUN_PACKETS];
    vint which[SUN_PACKETS];
    vsample4 u[SUN_PACKETS];
    vmask active[SUN_PACKETS];
    vfloat e[SUN_PACKETS];
    for (int from = 0; from < count; from += SUN_PACKETS * LANES) {
        int left    = count - from < SUN_PACKETS * LANES ? count - from : SUN_PACKETS * LANES;
        int packets = (left + LANES - 1) / LANES;
        for (int k = 0; k < packets; k++) {
            int i      = from + k * LANES;
            vuint seed = vunsigned(vload_int((const int32_t *)b->seed + i));
            u[k]       = vsobol4(vunsigned(vload_int((const int32_t *)b->index + i)),
                                 vhash_combine(seed, vsplat_uint(SUN_SET)));
            active[k]  = (vlane_index() + i) < count;
            which[k]   = vkeep_int(active[k], vto_int(u[k].z * (float)s->sun_count));
            at[k]      = surface_of(b, i);
        }
        sun_ask(w->suns, at, which, u, active, packets, e);
        for (int i = from; i < from + left; i++) {
            int k = (i - from) / LANES, sun = lane(which[k], (i - from) % LANES);
            size_t j     = (size_t)sun * (size_t)g->r->sensor_count + ids[i].item;
            float lux    = (float)LUMENS_PER_WATT * lane(e[k], (i - from) % LANES);
            double known = g->sun_known[j];
            w->sun[i]    = sun;
            w->sun_e[i]  = isnan(known) ? 0.0f : (float)s->sun_count * (lux - (float)known);
        }
    }
}

static float lux_of(const path_sums *sums, int i)
{
    vec3 e = { (*sums)[0][i], (*sums)[1][i], (*sums)[2][i] };
    return (float)LUMENS_PER_WATT * rgb_luminance(e);
}

/* Adds light that came straight from lamp l. */
static void add_straight(const grid_run_state *g, thread_scratch *w, int l, float lux,
                         float *straight)
{
    const scene_light *info = &g->s->light_info[l];
    *straight += info->dimming * lux;
    if (g->layers) {
        w->of_layer[info->group] += lux;
        w->direct_of_layer[info->group] += lux;
    }
}

static void put(const grid_run_state *g, const thread_scratch *w, int i, float all, float straight,
                float *values)
{
    const grid_channels *c = &g->channels;
    float *direct          = values + c->straight * BUNDLE + i;
    float full             = 0.0f;
    for (int h = 0; h < g->moments; h++) {
        values[h * BUNDLE + i] = w->of_layer[0] + w->of_layer[1 + h];
        direct[h * BUNDLE]     = w->direct_of_layer[0] + w->direct_of_layer[1 + h];
    }
    if (g->moments)
        return;
    values[SAMPLED * BUNDLE + i] = all;
    direct[0]                    = straight;
    for (int l = 0; l < g->layers; l++) {
        full += w->of_layer[l];
        values[(LAYERS + l) * BUNDLE + i] = w->of_layer[l];
        direct[(1 + l) * BUNDLE]          = w->direct_of_layer[l];
    }
    if (g->layers)
        values[FULL * BUNDLE + i] = full;
}

/* lx, of all light that maps of focused light know at a sensor, as dimmed; of each layer, too. */
static float focused_at(const grid_run_state *g, thread_scratch *w, int i, const sample_id *id)
{
    const scene *s       = g->s;
    const path_bundle *b = &w->bundle;
    float all            = 0.0f;
    for (int l = g->layers ? 0 : -1; l < g->layers; l++) {
        vec3 coarse, fine = illumination_map_at_sensor(g->maps.focused, (int)id->item,
                                                       (int)b->set[i], l, &coarse);
        float lux    = (float)LUMENS_PER_WATT * rgb_luminance(fine);
        float dimmed = l < 0 ? 1.0f : scene_dimming_of_group(s, l);
        if (l >= 0)
            w->of_layer[l] += lux;
        all += dimmed * lux;
    }
    return all;
}

/* Maps tell of suns and lamps together: it counts as that of which there is more. */
static bool focused_is_electric(const scene *s)
{
    return s->by_lamps.focused >= s->by_suns.focused;
}

static void take_sample(const grid_run_state *g, thread_scratch *w, int i, const sample_id *id,
                        float *values)
{
    const path_bundle *b   = &w->bundle;
    const grid_channels *c = &g->channels;
    float straight         = lux_of(&b->direct, i);
    for (int l = 0; l < g->layers; l++) {
        w->of_layer[l]        = lux_of(&b->layers[l], i);
        w->direct_of_layer[l] = lux_of(&b->layers[g->layers + l], i);
    }
    if (w->lamp[i] >= 0)
        add_straight(g, w, w->lamp[i], (float)LUMENS_PER_WATT * w->lamp_e[i], &straight);
    float lamps_and_paths = straight;
    if (w->sun[i] >= 0)
        add_straight(g, w, scene_lamp_count(g->s) + w->sun[i], w->sun_e[i], &straight);
    float reflected = lux_of(&b->indirect, i);
    float mirrored  = b->mirrored ? lux_of(b->mirrored, i) : 0.0f;
    float smoothed  = b->smoothed ? (float)LUMENS_PER_WATT * b->smoothed[i] : 0.0f;
    float focused   = g->maps.focused ? focused_at(g, w, i, id) : 0.0f;
    if (c->smoothed >= 0)
        values[c->smoothed * BUNDLE + i] = smoothed;
    put(g, w, i, straight + reflected + focused, straight, values);
    if (c->classes >= 0) {
        values[(c->classes + CLASS_DIRECT) * BUNDLE + i]    = straight;
        values[(c->classes + CLASS_REFLECTED) * BUNDLE + i] = reflected - mirrored;
        values[(c->classes + CLASS_MIRRORED) * BUNDLE + i]  = mirrored;
        values[(c->classes + CLASS_FOCUSED) * BUNDLE + i]   = focused;
    }
    values[c->met * BUNDLE + i] = b->met[i];
    if (c->outside >= 0)
        values[c->outside * BUNDLE + i] = lux_of(b->outside, i);
    if (c->electric >= 0)
        values[c->electric * BUNDLE + i] = lamps_and_paths + reflected +
                                           (focused_is_electric(g->s) ? focused : 0.0f) -
                                           lux_of(b->daylight, i);
}

void grid_sample(void *context, int thread, const sample_id *ids, int count, float *values)
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
        b->set[i]   = ids[i].scramble;
        b->seed[i]  = hash_combine_u32(hash_combine_u32(g->seed, cell), ids[i].scramble);
    }
    memset(w->lamp, -1, sizeof w->lamp);
    memset(w->sun, -1, sizeof w->sun);
    if (atomic_load(&g->lamps_left))
        sample_lamps(g, w, ids, count);
    if (g->disks)
        sample_suns(g, w, ids, count);
    path_trace(w->paths, b, &g->paths);
    for (int i = 0; i < count; i++)
        take_sample(g, w, i, &ids[i], values);
}
