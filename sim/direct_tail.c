/* sim/direct_tail.c -- lamps without extent that something may shadow: the strongest are asked one
 * by one, the weak ones by a few rays together.
 *
 * How many are asked: first until the rest is below its share of what all would give if nothing
 * stood between; then, where much of that turns out to be hidden, until it is below its share of
 * what does arrive. In full shadow all are asked.
 *
 * The rest, of which lamp i would give e_i and the sum T, gets n = 16 rays. Ray j goes to the lamp
 * in whose part of the running sum of e_i the place (j + u_j) T / n lies, u_j even in [0,1): the
 * mean number of rays to lamp i is n e_i / T, and
 *
 *     T / n * number of rays that arrive     [W/m^2]
 *
 * has what the lamps give as its mean. Each term is 0 or T / n and independent of the others, so
 * that its variance is (T / n)^2 / 4 at most (Popoviciu) and the standard deviation of all
 * T / (2 sqrt n). Half a 95 % interval of a spread that is known would be 1.96 of that; here it
 * is 2.1314, Student's t of the 15 degrees of freedom that samples have (accuracy.h).
 */
#include "core/sampler.h"
#include "sim/direct_parts.h"

#include <string.h>

enum {
    TAIL_RAYS = 16, /* a sensor and layer */
    BUCKETS   = 1024,
    TAIL_SET  = 0x7a11, /* its numbers, beside those of samples */
};

/* Of the accuracy asked for: what all weak lamps together may give. */
static const float tail_share = 0.1f;

static bool is_asked(const direct_sensor *w, int l)
{
    return !light_has_extent(w->s->lights[l]) && !direct_is_clear(w, l);
}

/* ---- the strongest --------------------------------------------------------------------------- */

/* Ends the rays of whole packets to one lamp each. */
static void end_batch(direct_sensor *w, sensor_sum *sums)
{
    direct_trace(w, RAYS_COHERENT);
    for (int k = 0; k < w->batched; k++)
        direct_add(w, sums, lane(w->light[k], 0), vkeep(w->asked[k], direct_arrives(w, k, w->e[k])),
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

/* The e below which all lamps of the layer together give less than `left`: found by sorting them
 * into buckets by exponent and two bits of the fraction. */
static float weakest_of(const direct_sensor *w, int layer, int i, double left)
{
    double sums[BUCKETS] = { 0 };
    for (int l = 0; l < scene_lamp_count(w->s); l++) {
        float e = lane(w->lamps[l].e, i);
        if (!is_asked(w, l) || direct_layer(w, l) != layer || !(e > 0.0f))
            continue;
        uint32_t bits;
        memcpy(&bits, &e, sizeof bits);
        sums[bits >> 21] += (double)e;
    }
    uint32_t bucket = 0;
    while (bucket < BUCKETS - 1 && sums[bucket] <= left)
        left -= sums[bucket++];
    uint32_t bits = bucket << 21;
    float weakest;
    memcpy(&weakest, &bits, sizeof weakest);
    return weakest;
}

/* Asks lamps, where `most` is given only those that give less than that, until in each lane the
 * rest of each layer is below its share of `all`. Leaves in w->weakest where that is, and the rest
 * in w->tail. */
static void ask_strong(direct_sensor *w, const vsurface *at, vmask active, const vfloat *all,
                       const vfloat *most, sensor_sum *sums)
{
    double share = (double)tail_share * w->ask.accuracy;
    bool few     = w->s->asks_all || scene_lamp_count(w->s) <= ASKED_LAMPS;
    for (int layer = 0; layer < w->layers; layer++) {
        float weakest[LANES] = { 0 };
        for (int bits = few ? 0 : vbits(active); bits; bits &= bits - 1) {
            int i      = __builtin_ctz((unsigned)bits);
            weakest[i] = weakest_of(w, layer, i, share * (double)lane(all[layer], i));
        }
        vfloat found      = vload(weakest);
        w->weakest[layer] = most ? vmin(found, most[layer]) : found;
        w->tail[layer]    = (vfloat){ 0 };
    }
    for (int l = 0; l < scene_lamp_count(w->s); l++) {
        if (!is_asked(w, l))
            continue;
        int layer      = direct_layer(w, l);
        vfloat e       = w->lamps[l].e;
        vmask left     = active & (e > 0.0f) & (most ? e < most[layer] : ALL_LANES);
        vmask strong   = left & (e >= w->weakest[layer]);
        w->tail[layer] = w->tail[layer] + vkeep(left & ~strong, e);
        if (vany(strong))
            ask_lamp(w, at, l, strong, sums);
    }
    end_batch(w, sums);
}

static bool any_tail(const direct_sensor *w)
{
    vmask any = { 0 };
    for (int layer = 0; layer < w->layers; layer++)
        any = any | (w->tail[layer] > 0.0f);
    return vany(any);
}

/* ---- the tail -------------------------------------------------------------------------------- */

/* The lamps that a lane's rays go to. */
static void pick_tail(const direct_sensor *w, int layer, int i, uint32_t seed,
                      int32_t picks[TAIL_RAYS])
{
    double step = (double)lane(w->tail[layer], i) / TAIL_RAYS, sum = 0.0, place = 0.0;
    int32_t last = 0;
    int j        = -1;
    for (int l = 0; l < scene_lamp_count(w->s) && j < TAIL_RAYS; l++) {
        float e = lane(w->lamps[l].e, i);
        if (!is_asked(w, l) || direct_layer(w, l) != layer || !(e > 0.0f) ||
            e >= lane(w->weakest[layer], i))
            continue;
        last = l;
        for (sum += (double)e; j < TAIL_RAYS && place < sum;) {
            if (j >= 0)
                picks[j] = l;
            j++;
            place = step * (j + 0x1p-32 * hash_combine_u32(seed, (uint32_t)j));
        }
    }
    for (j = j < 0 ? 0 : j; j < TAIL_RAYS; j++) /* what rounding left over */
        picks[j] = last;
}

/* Ray j of each lane, toward the lamp that it picked. */
static void aim_tail(direct_sensor *w, const vsurface *at, vmask active, int j,
                     int32_t picks[LANES][TAIL_RAYS])
{
    int32_t of[LANES];
    for (int i = 0; i < LANES; i++)
        of[i] = picks[i][j];
    w->light[j] = vload_int(of);
    w->spare[j] = vsplat_int(0);
    vvec3 wi    = { 0 };
    vfloat dist = { 0 };
    for (vmask left = active; vany(left);) {
        int l;
        vmask same  = vtake_same(w->light[j], &left, &l);
        wi          = vselect3(same, w->lamps[l].wi, wi);
        dist        = vselect(same, w->lamps[l].dist, dist);
        w->spare[j] = vselect_int(same, vsplat_int(w->s->light_info[l].owner), w->spare[j]);
    }
    w->rays[j]  = direct_shadow_ray(at, &wi, dist);
    w->asked[j] = active;
}

/* Adds what arrives by ray j, and in each lane the bound to the sums of its lamp. */
static void add_tail(direct_sensor *w, int j, vfloat each, vfloat bound, sensor_sum *sums)
{
    for (vmask left = w->asked[j]; vany(left);) {
        int l;
        vmask same = vtake_same(w->light[j], &left, &l);
        direct_add(w, sums, l, vkeep(same, direct_arrives(w, j, each)), vkeep(same, bound));
    }
}

static void ask_tail(direct_sensor *w, const vsurface *at, int layer, uint32_t first,
                     sensor_sum *sums)
{
    const float half_width          = 2.1314f * 0.125f; /* of T */
    int32_t picks[LANES][TAIL_RAYS] = { 0 };
    vmask active                    = w->tail[layer] > 0.0f;
    uint32_t set = hash_combine_u32(hash_combine_u32(w->ask.seed, TAIL_SET), (uint32_t)layer);
    for (int bits = vbits(active); bits; bits &= bits - 1) {
        int i = __builtin_ctz((unsigned)bits);
        pick_tail(w, layer, i, hash_combine_u32(set, first + (uint32_t)i), picks[i]);
    }
    for (int j = 0; j < TAIL_RAYS; j++)
        aim_tail(w, at, active, j, picks);
    w->batched = TAIL_RAYS;
    direct_trace(w, RAYS_INCOHERENT);
    w->batched   = 0;
    vfloat each  = w->tail[layer] * (1.0f / TAIL_RAYS);
    vfloat bound = half_width * w->tail[layer];
    for (int j = 0; j < TAIL_RAYS; j++)
        add_tail(w, j, each, j == 0 ? bound : (vfloat){ 0 }, sums);
}

void direct_ask(direct_sensor *w, const vsurface *at, vmask active, uint32_t first,
                sensor_sum *sums)
{
    ask_strong(w, at, active, w->total, NULL, sums);
    if (!any_tail(w))
        return;
    for (int layer = 0; layer < w->layers; layer++) {
        w->arrived[layer] = sums[w->s->layered ? 1 + layer : 0].e;
        w->most[layer]    = w->weakest[layer];
    }
    ask_strong(w, at, active, w->arrived, w->most, sums);
    for (int layer = 0; layer < w->layers; layer++)
        if (vany(w->tail[layer] > 0.0f))
            ask_tail(w, at, layer, first, sums);
}
