/* sim/path_sun.c -- suns asked where paths stand.
 *
 * Indoors nearly all places see no sun: of several suns, those that would have to come in by no
 * portal are asked now and then only, and count as often more; but where surfaces are outside.
 * Where a sunlit patch is met that was asked for where the path was last (path_patch.c), it counts
 * by the power heuristic.
 */
#include "core/color.h"
#include "sim/path_parts.h"
#include "sim/sensor.h"

enum { SELDOM = 16 /* places, of which one asks */ };

/* The lanes of packet k that ask sun l, and how much each then counts. */
static vmask who_asks(const path_tracer *t, int k, int l, vfloat *count)
{
    const scene *s = t->s;
    vsurface at    = t->at[k];
    vlight_sample of;
    vfloat half = vsplat(0.5f);
    *count      = vsplat(1.0f);
    if (s->sun_count == 1 || !s->portals)
        return t->asks[k];
    light_sample(s->lights[l], &at.position, half, half, t->asks[k], &of);
    vmask in = portals_cross(s->portals, &at.position, &of.wi, t->asks[k]);
    if (has_exteriors(s) && t->depth > 0)
        in = in | ((t->does[k] & DOES_EXTERIOR) != 0);
    *count = vselect(in, *count, vsplat((float)SELDOM));
    return t->asks[k] & (in | path_in_turn(t, k, l, SELDOM));
}

static void take(path_tracer *t, int k, int sun, bool beginning, vfloat count)
{
    const direct_pick *l    = &t->lights[k];
    const scene_light *info = &t->s->light_info[scene_lamp_count(t->s) + sun];
    vmask lit               = t->asked[k] & (l->light >= 0);
    if (!vany(lit & ((l->e.x > 0.0f) | (l->e.y > 0.0f) | (l->e.z > 0.0f))))
        return;
    bool extended = light_has_extent(t->s->lights[scene_lamp_count(t->s) + sun]);
    bool narrow   = extended && has_narrow(t->s) && !beginning;
    vfloat pdf;
    vrgb worth = path_worth(t, k, &l->wi, beginning, lit, narrow ? &pdf : NULL);
    if (narrow) {
        vmask found = (t->does[k] & DOES_NARROW) != 0;
        count       = count * vselect(found, power_heuristic(l->pdf, pdf), vsplat(1.0f));
    }
    if (has_patches(t) && !beginning)
        count = count * path_patch_share(t, k, sun, &l->wi, lit);
    path_layer to = { info->group, info->dimming, true, false };
    path_add(t, k, lit, beginning ? ALL_LANES : (vmask){ 0 },
             as_known(vmul(vscale(worth, count), l->e)), &to);
}

void path_ask_suns(path_tracer *t, bool beginning)
{
    const scene *s = t->s;
    int lamps      = scene_lamp_count(s);
    vsample4 u[DIRECT_PACKETS];
    vfloat count[DIRECT_PACKETS];
    for (int first = 0; first < packets_of(t); first += DIRECT_PACKETS) {
        int n = packets_of(t) - first < DIRECT_PACKETS ? packets_of(t) - first : DIRECT_PACKETS;
        for (int i = 0; i < n; i++)
            u[i] = path_numbers(t, first + i, OF_SUN);
        for (int sun = 0; sun < s->sun_count; sun++) {
            for (int i = 0; i < n; i++)
                t->asked[first + i] = who_asks(t, first + i, lamps + sun, &count[i]);
            direct_batch b = { .at         = t->at + first,
                               .active     = t->asked + first,
                               .u          = u,
                               .packets    = n,
                               .all_around = beginning && quantity_is_round(t->o->quantity),
                               .around = !beginning && has_narrow(s) ? t->around + first : NULL };
            direct_lamp(s, t->direct, lamps + sun, &b, t->lights + first);
            for (int i = 0; i < n; i++)
                take(t, first + i, sun, beginning, count[i]);
        }
    }
}
