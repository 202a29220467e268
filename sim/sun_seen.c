/* sim/sun_seen.c -- see sun_seen.h. */
#include "sim/sun_seen.h"

#include "core/color.h"
#include "sim/accuracy.h"
#include "sim/direct.h"
#include "sim/shadow.h"

struct sun_seen {
    const scene *s;
    study_quantity quantity;
    int64_t ray_count;
    vray rays[SUN_PACKETS];
    vmask asked[SUN_PACKETS], blocked[SUN_PACKETS];
    vint spare[SUN_PACKETS];
    vrgb e[SUN_PACKETS];
    vpassed passed[SUN_PACKETS];
};

sun_seen *sun_seen_new(arena *a, const scene *s, study_quantity q, lux_error *err)
{
    sun_seen *w = arena_new(a, sun_seen, err);
    if (w)
        *w = (sun_seen){ .s = s, .quantity = q };
    return w;
}

int64_t sun_rays(const sun_seen *w) { return w->ray_count; }

/* Sets out the rays of packet k toward one sun, for the lanes given. */
static void aim(sun_seen *w, int k, const vsurface *at, int sun, vfloat s, vfloat t, vmask lanes)
{
    vlight_sample of;
    const light *l  = w->s->lights[scene_lamp_count(w->s) + sun];
    vmask lit       = light_sample(l, &at->position, s, t, lanes, &of);
    vfloat response = vsensor_response(w->quantity, &at->normal, &of.wi);
    lit             = lit & (response > 0.0f);
    vray ray        = direct_shadow_ray(at, &of.wi, of.dist);
    w->e[k]         = vselect3(lit, vscale(of.e, response), w->e[k]);
    w->asked[k]     = w->asked[k] | lit;

    w->rays[k].origin    = vselect3(lit, ray.origin, w->rays[k].origin);
    w->rays[k].direction = vselect3(lit, ray.direction, w->rays[k].direction);
    w->rays[k].reach     = vselect(lit, ray.reach, w->rays[k].reach);
}

static void begin(sun_seen *w, int k)
{
    w->rays[k]  = (vray){ 0 };
    w->asked[k] = (vmask){ 0 };
    w->spare[k] = vsplat_int(0);
    w->e[k]     = (vrgb){ 0 };
}

static void trace(sun_seen *w, int packets)
{
    w->ray_count += shadow_trace(w->s, w->rays, w->asked, w->spare, packets, RAYS_COHERENT,
                                 w->blocked, w->passed);
    for (int k = 0; k < packets; k++) {
        w->asked[k] = w->asked[k] & ~w->blocked[k];
        if (w->s->hollow)
            w->e[k] = vmul(w->e[k], w->passed[k].share);
    }
}

/* Adds `count` rays of a scramble of each lane, from number `from` on, to what they find and to how
 * many nothing opaque stops. */
static void look(sun_seen *w, const vsurface *at, int sun, vuint set, uint32_t from, int count,
                 vmask active, vfloat *e, vfloat *open)
{
    for (int done = 0, some; done < count; done += some) {
        some = count - done < SUN_PACKETS ? count - done : SUN_PACKETS;
        for (int j = 0; j < some; j++) {
            vsample4 u = vsobol4(vsplat_uint(from + (uint32_t)(done + j)), set);
            begin(w, j);
            aim(w, j, at, sun, u.x, u.y, active);
        }
        trace(w, some);
        for (int j = 0; j < some; j++) {
            *e    = *e + vkeep(w->asked[j], vrgb_luminance(w->e[j]));
            *open = *open + vkeep(w->asked[j], vsplat(1.0f));
        }
    }
}

/* From the half shadow: rays double until half of the interval of e, with Student's t of 15 degrees
 * of freedom (accuracy.h), is small against e, or a little of what all of the disk would give. An
 * edge across the disk takes rays as half to the power of -4/3. */
static void look_closely(sun_seen *w, const vsurface *at, int sun, vuint sensor, double accuracy,
                         vmask mixed, sun_look *out)
{
    const float student = 2.1314f, share = 0.25f * (float)accuracy, little = 0.02f;
    vfloat e[SCRAMBLES] = { 0 }, open[SCRAMBLES] = { 0 };
    vmask left = mixed;
    int before = 0, now = SUN_RAYS;
    for (; vany(left) && now * SCRAMBLES <= MOST_SUN_RAYS; before = now, now *= 2) {
        vfloat mean = { 0 }, squares = { 0 }, unhidden = { 0 };
        for (int r = 0; r < SCRAMBLES; r++) {
            vuint set = vhash_combine(sensor, vsplat_uint((uint32_t)r));
            look(w, at, sun, set, (uint32_t)before, now - before, left, &e[r], &open[r]);
            mean     = mean + e[r] * (1.0f / (float)(now * SCRAMBLES));
            unhidden = unhidden + open[r] * (1.0f / (float)(now * SCRAMBLES));
        }
        for (int r = 0; r < SCRAMBLES; r++) {
            vfloat off = e[r] * (1.0f / (float)now) - mean;
            squares    = squares + off * off;
        }
        vfloat half = student * vsqrt(squares * (1.0f / (SCRAMBLES * (SCRAMBLES - 1))));
        out->e      = vselect(left, mean, out->e);
        out->bound  = vselect(left, half, out->bound);
        out->open   = vselect(left, unhidden, out->open);
        vfloat all  = mean * vmax(vsplat(1.0f), little / vmax(unhidden, vsplat(1e-6f)));
        left        = left & (half > share * all);
    }
}

sun_look sun_look_at(sun_seen *w, const vsurface *at, int sun, uint32_t seed, vuint sensor,
                     double accuracy, vmask active)
{
    bool disk    = light_has_extent(w->s->lights[scene_lamp_count(w->s) + sun]);
    int rays     = disk ? SUN_RAYS : 1;
    vuint set    = vhash_combine(vsplat_uint(hash_combine_u32(seed, (uint32_t)sun)), sensor);
    sun_look all = { 0 };
    look(w, at, sun, set, 0, rays, active, &all.e, &all.open);
    all.mixed = active & (all.open > 0.0f) & (all.open < (float)rays);
    all.e     = all.e * (1.0f / (float)rays);
    all.open  = all.open * (1.0f / (float)rays);
    if (vany(all.mixed))
        look_closely(w, at, sun, set, accuracy, all.mixed, &all);
    return all;
}

void sun_ask(sun_seen *w, const vsurface *at, const vint *sun, const vsample4 *u,
             const vmask *active, int packets, vfloat *e)
{
    for (int k = 0; k < packets; k++) {
        begin(w, k);
        for (vmask left = active[k]; vany(left);) {
            int which;
            vmask same = vtake_same(sun[k], &left, &which);
            aim(w, k, &at[k], which, u[k].x, u[k].y, same);
        }
    }
    trace(w, packets);
    for (int k = 0; k < packets; k++)
        e[k] = vkeep(w->asked[k], vrgb_luminance(w->e[k]));
}
