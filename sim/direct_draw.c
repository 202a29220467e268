/* sim/direct_draw.c -- samples of lamps with extent that something may shadow.
 *
 * A sample asks one lamp, drawn by its weight against that of all of its layer that take samples.
 * Of the layers each is drawn as often as another: a small one is not to be noisy for the sake of a
 * large one.
 */
#include "core/color.h"
#include "core/sampler.h"
#include "sim/direct_parts.h"

#include <string.h>

enum { SAMPLE_SET = 0x1a3b }; /* the samples of lamps, beside those of paths */

/* Leaves in w->lamps the weights of those that take samples, and their sums in w->sampled. */
static void weigh_sampled(direct_sensor *w, const vsurface *at, vmask active)
{
    direct_weigh(w, at, active);
    for (int layer = 0; layer < w->layers; layer++)
        w->sampled[layer] = (vfloat){ 0 };
    for (int l = 0; l < scene_lamp_count(w->s); l++) {
        int layer          = direct_layer(w, l);
        vmask sampled      = active & ~direct_is_known(w, l);
        vfloat weight      = light_has_extent(w->s->lights[l]) ? w->lamps[l].weight : (vfloat){ 0 };
        w->lamps[l].weight = vkeep(sampled & (weight > 0.0f), weight);
        w->sampled[layer]  = w->sampled[layer] + w->lamps[l].weight;
    }
}

/* A sensor that takes many samples comes again and again. */
static bool is_prepared(const direct_sensor *w, const vsurface *at, vmask active)
{
    const vvec3 *p = &w->at.position, *n = &w->at.normal;
    vmask same = (at->position.x == p->x) & (at->position.y == p->y) & (at->position.z == p->z) &
                 (at->normal.x == n->x) & (at->normal.y == n->y) & (at->normal.z == n->z);
    return vbits(active) == vbits(w->prepared) && !vany(active & ~same);
}

void direct_sensor_prepare(direct_sensor *w, const vsurface *at, vmask active)
{
    if (!w->s->extended || is_prepared(w, at, active))
        return;
    double sum[LANES] = { 0 };
    memset(w->listed_count, 0, sizeof w->listed_count);
    w->at       = *at;
    w->prepared = active;
    weigh_sampled(w, at, active);
    for (int l = 0; l < scene_lamp_count(w->s); l++) {
        vfloat share = w->lamps[l].weight / w->sampled[direct_layer(w, l)];
        for (int bits = vbits(w->lamps[l].weight > 0.0f); bits; bits &= bits - 1) {
            int i = __builtin_ctz((unsigned)bits), n = w->listed_count[i]++;
            sum[i] += (double)lane(share, i);
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
        int l;
        vmask same = vtake_same(w->light[k], &left, &l);
        vlight_sample lamp;
        vmask lit       = light_sample(s->lights[l], &at.position, u.x, u.y, same, &lamp);
        vfloat response = vsensor_response(w->ask.quantity, &at.normal, &lamp.wi);
        vfloat e        = vrgb_luminance(lamp.e) * response / chance;
        lit             = lit & (e > 0.0f);
        wi              = vselect3(lit, lamp.wi, wi);
        dist            = vselect(lit, lamp.dist, dist);
        w->e[k]         = vselect(lit, e, w->e[k]);
        w->spare[k]     = vselect_int(lit, vsplat_int(s->light_info[l].owner), w->spare[k]);
        if (!direct_is_clear(w, l))
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
        direct_trace(w, RAYS_COHERENT);
        for (int k = 0; k < w->batched; k++)
            w->e[k] = (float)w->s->study->maintenance * direct_arrives(w, k, w->e[k]);
        for (int j = from; j < to; j++) {
            int k = (j - from) / LANES, at = (j - from) % LANES;
            e[j]    = lane(w->e[k], at);
            lamp[j] = lane(w->light[k], at);
        }
        w->batched = 0;
    }
}
