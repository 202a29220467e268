/* sim/direct_sensor.c -- see direct_sensor.h: all lamps weighed, and what needs no rays summed. */
#include "sim/direct_sensor.h"

#include "core/color.h"
#include "core/without.h"
#include "sim/direct_parts.h"

#include <string.h>

/* Of the accuracy asked for: what all lamps taken as points may be off together. */
static const float point_share = 0.1f;

direct_sensor *direct_sensor_new(arena *a, const scene *s, const sensor_ask *ask, lux_error *err)
{
    size_t lamps     = (size_t)s->light_count + 1;
    direct_sensor *w = arena_new(a, direct_sensor, err);
    if (!w)
        return NULL;
    w->s            = s;
    w->ask          = *ask;
    w->layers       = s->layered ? s->group_count : 1;
    size_t layers   = (size_t)w->layers + 1;
    vfloat **sums[] = { &w->lost, &w->total,   &w->sure, &w->count,  &w->weakest,
                        &w->most, &w->arrived, &w->tail, &w->sampled };
    w->lamps        = arena_array(a, candidate, lamps, err);
    bool good       = w->lamps != NULL;
    for (size_t i = 0; good && i < sizeof sums / sizeof *sums; i++)
        good = (*sums[i] = arena_array(a, vfloat, layers, err)) != NULL;
    for (int i = 0; good && i < LANES; i++) {
        w->listed[i]  = arena_array(a, int32_t, lamps, err);
        w->running[i] = w->listed[i] ? arena_array(a, float, lamps, err) : NULL;
        good          = w->running[i] != NULL;
    }
    return good ? w : NULL;
}

int64_t direct_sensor_rays(const direct_sensor *w) { return w->ray_count; }

/* ---- what each lamp would give --------------------------------------------------------------- */

static bool has_closed_form(const direct_sensor *w, int l)
{
    return w->s->lights[l]->type->irradiance && !quantity_is_round(w->ask.quantity) &&
           direct_is_clear(w, l);
}

/* A lamp that one direction stands for: all of it, or its centre where nothing hides a part of it,
 * the horizon neither. Whatever is round has a horizon in every direction. */
static void see_as_point(const direct_sensor *w, int i, const vsurface *at, vmask active,
                         candidate *c)
{
    const light *l = w->s->lights[i];
    vlight_sample lamp;
    vmask lit;
    if (light_has_extent(l)) {
        light_bounds box = light_bounds_of(l);
        vmask whole      = vlight_is_whole(&box, &at->position, &at->normal, active);
        lit              = l->type->as_point(l, &at->position, active, &lamp, &c->error);
        c->error         = vselect(whole, c->error, vsplat(INFINITY));
    } else {
        vfloat middle = vsplat(0.5f);
        lit           = light_sample(l, &at->position, middle, middle, active, &lamp);
    }
    vfloat response = vsensor_response(w->ask.quantity, &at->normal, &lamp.wi);
    c->wi           = lamp.wi;
    c->dist         = lamp.dist;
    c->e            = vkeep(lit, vrgb_luminance(lamp.e) * response);
}

static candidate weigh(const direct_sensor *w, int i, const vsurface *at, vmask active)
{
    const light *l = w->s->lights[i];
    candidate c    = { 0 };
    if (has_closed_form(w, i)) {
        vrgb all = l->type->irradiance(l, &at->position, &at->normal, active);
        c.e = c.weight = vrgb_luminance(all);
        return c;
    }
    bool extended = light_has_extent(l), round = quantity_is_round(w->ask.quantity);
    if (extended && (round || !direct_is_clear(w, i)))
        c.error = vsplat(INFINITY);
    else
        see_as_point(w, i, at, active, &c);
    c.weight = c.e;
    if (extended) {
        vvec3 n  = round ? direct_facing(l, at) : at->normal;
        c.weight = direct_weight(l, &at->position, &n, active);
    }
    return c;
}

void direct_weigh(direct_sensor *w, const vsurface *at, vmask active)
{
    for (int layer = 0; layer < w->layers; layer++)
        w->total[layer] = w->sure[layer] = w->count[layer] = (vfloat){ 0 };
    for (int l = 0; l < scene_lamp_count(w->s); l++) {
        candidate *c    = &w->lamps[l];
        int layer       = direct_layer(w, l);
        *c              = weigh(w, l, at, active);
        w->total[layer] = w->total[layer] + c->weight;
        w->sure[layer]  = w->sure[layer] + vmax(c->e - c->error, vsplat(0.0f));
        w->count[layer] = w->count[layer] + vkeep(c->weight > 0.0f, vsplat(1.0f));
    }
}

/* A lamp is taken as a point if its bound is small against what it gives for sure, or the mean of
 * its layer's lamps does: so the bounds of all add up to the share at most of what all give. */
vmask direct_is_known(const direct_sensor *w, int l)
{
    const candidate *c = &w->lamps[l];
    int layer          = direct_layer(w, l);
    vfloat mean        = w->sure[layer] / vmax(w->count[layer], vsplat(1.0f));
    vfloat least       = vmax(c->e - c->error, mean);
    float share        = 0.5f * point_share * (float)w->ask.accuracy;
    return (c->error == 0.0f) | (c->error <= share * least);
}

/* ---- sums ------------------------------------------------------------------------------------ */

/* What the rounding of a sum loses is kept beside it, exactly (Knuth, The Art of Computer
 * Programming 2, 4.2.2, theorem B): a lamp that gives nothing changes neither. */
static void add_one(sensor_sum *sum, vfloat *lost, vfloat e, vfloat bound)
{
    vfloat all  = sum->e + e;
    vfloat part = all - sum->e;
    *lost       = *lost + ((sum->e - (all - part)) + (e - part));
    sum->e      = all;
    sum->bound  = sum->bound + bound;
}

void direct_add(direct_sensor *w, sensor_sum *sums, int l, vfloat e, vfloat bound)
{
    const scene_light *info = &w->s->light_info[l];
    float left              = (float)scene_maintenance(w->s, l);
    e                       = left * e;
    bound                   = left * bound;
    add_one(&sums[0], &w->lost[0], info->dimming * e, info->dimming * bound);
    if (w->s->layered)
        add_one(&sums[1 + info->group], &w->lost[1 + info->group], e, bound);
}

void direct_trace(direct_sensor *w, ray_hint hint)
{
    w->ray_count +=
        shadow_trace(w->s, w->rays, w->asked, w->spare, w->batched, hint, w->blocked, w->passed);
}

/* Of a lamp's light as luminance, what glass of another colour lets through. */
static vfloat tinted(const direct_sensor *w, int k, vfloat e)
{
    vfloat share = { 0 };
    for (vmask left = w->asked[k]; vany(left);) {
        int l;
        vmask same = vtake_same(w->light[k], &left, &l);
        vrgb color = vspread(w->s->light_info[l].color);
        share      = vselect(same, vrgb_luminance(vmul(color, w->passed[k].share)), share);
    }
    return vselect(w->asked[k], e * share, e);
}

vfloat direct_arrives(const direct_sensor *w, int k, vfloat e)
{
    vfloat open = vkeep(~(w->asked[k] & w->blocked[k]), e);
    return HAS_MIRRORS && w->s->hollow ? tinted(w, k, open) : open;
}

vmask direct_sensor_sum(direct_sensor *w, const vsurface *at, vmask active, uint32_t first,
                        sensor_sum *sums)
{
    int sum_count = w->s->layered ? 1 + w->layers : 1;
    vmask pending = { 0 };
    memset(sums, 0, sizeof *sums * (size_t)sum_count);
    memset(w->lost, 0, sizeof *w->lost * (size_t)sum_count);
    direct_weigh(w, at, active);
    for (int l = 0; l < scene_lamp_count(w->s); l++) {
        const candidate *c = &w->lamps[l];
        if (direct_is_clear(w, l) || light_has_extent(w->s->lights[l])) {
            vmask known = active & direct_is_known(w, l);
            pending     = pending | (active & ~known & (c->weight > 0.0f));
            direct_add(w, sums, l, vkeep(known, c->e), vkeep(known, c->error));
        }
    }
    direct_ask(w, at, active, first, sums);
    for (int i = 0; i < sum_count; i++)
        sums[i].e = sums[i].e + w->lost[i];
    return pending;
}
