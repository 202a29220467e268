/* sim/direct.c -- see direct.h. */
#include "sim/direct.h"

#include "core/color.h"

/* What a lamp would give the points of one packet. */
typedef struct candidate {
    vlight_sample lamp;
    vfloat share; /* luminance of its irradiance, up to a factor; 0 where it is dark */
} candidate;

struct direct_scratch {
    vray rays[DIRECT_PACKETS];
    vmask asked[DIRECT_PACKETS], blocked[DIRECT_PACKETS];
    vlight_sample lamp[DIRECT_PACKETS];
    int64_t ray_count;
    candidate candidates[]; /* a light */
};

direct_scratch *direct_scratch_new(arena *a, const scene *s, lux_error *err)
{
    size_t lights = (size_t)s->light_count;
    return arena_alloc(a, 1, sizeof(direct_scratch) + lights * sizeof(candidate),
                       alignof(direct_scratch), err);
}

int64_t direct_rays(const direct_scratch *w) { return w->ray_count; }

/* What lamp l gives each point before anything stands between; the lanes that it lights. */
static vmask unshadowed(const light *l, const vsurface *at, vmask active, vlight_sample *out,
                        vfloat *cosine)
{
    vfloat middle = vsplat(0.5f); /* no lamp of this version has places to draw */
    vmask lit     = light_sample(l, &at->position, middle, middle, active, out);
    *cosine       = vdot(out->wi, at->normal);
    return lit & (*cosine > 0.0f);
}

static vfloat largest(vvec3 v) { return vmax(vabs(v.x), vmax(vabs(v.y), vabs(v.z))); }

/* A ray from the point to just before the lamp, aimed anew from where it starts: near a lamp, the
 * step off the surface is seen. It ends where a surface in which the lamp lies may be rounded to:
 * a few times what a float resolves at the larger of both places. */
static vray shadow_ray(const vsurface *at, const vlight_sample *lamp)
{
    const float roundings = 8.0f * 0x1p-24f;
    vvec3 start           = vray_start(at, &lamp->wi);
    vmask far             = lamp->dist == INFINITY;
    vvec3 place           = valong(at->position, lamp->wi, lamp->dist);
    vvec3 to              = vsub(place, start);
    vfloat dist           = vlength(to);
    vfloat before         = roundings * vmax(largest(place), vmax(largest(start), dist));
    return (vray){ .origin    = start,
                   .direction = vselect3(far, lamp->wi, vscale(to, 1.0f / dist)),
                   .reach     = vselect(far, lamp->dist, dist - before) };
}

static void trace_shadows(const scene *s, direct_scratch *w, int packets, ray_hint hint)
{
    for (int k = 0; k < packets; k++)
        w->ray_count += __builtin_popcount((unsigned)vbits(w->asked[k]));
    world_any_hit(s->world, w->rays, w->asked, NULL, packets, hint, w->blocked);
}

void direct_all(const scene *s, direct_scratch *w, const vsurface *at, const vmask *active,
                int packets, vrgb *e)
{
    for (int k = 0; k < packets; k++)
        e[k] = (vrgb){ 0 };
    for (int l = 0; l < s->light_count; l++) {
        vfloat cosine[DIRECT_PACKETS];
        for (int k = 0; k < packets; k++) {
            w->asked[k] = unshadowed(s->lights[l], &at[k], active[k], &w->lamp[k], &cosine[k]);
            w->rays[k]  = shadow_ray(&at[k], &w->lamp[k]);
        }
        trace_shadows(s, w, packets, RAYS_COHERENT);
        for (int k = 0; k < packets; k++) {
            vmask lit = w->asked[k] & ~w->blocked[k];
            e[k]      = vadd(e[k], vkeep3(lit, vscale(w->lamp[k].e, cosine[k])));
        }
    }
}

/* Which lamp each lane draws, -1 for none, and 1 / the probability of that. */
static vint draw(const scene *s, direct_scratch *w, const vsurface *at, vmask active, vfloat pick,
                 vfloat *inverse_probability)
{
    vfloat total = { 0 };
    for (int l = 0; l < s->light_count; l++) {
        candidate *c = &w->candidates[l];
        vfloat cosine;
        vmask lit = unshadowed(s->lights[l], at, active, &c->lamp, &cosine);
        c->share  = vkeep(lit, vrgb_luminance(c->lamp.e) * cosine);
        total     = total + c->share;
    }

    /* The first lamp at which the running sum reaches pick * total: it reaches all of it at last */
    vint drawn   = vsplat_int(-1);
    vfloat share = { 0 }, sum = { 0 }, threshold = pick * total;
    for (int l = 0; l < s->light_count; l++) {
        const candidate *c = &w->candidates[l];
        sum                = sum + c->share;
        vmask this         = active & (drawn < 0) & (c->share > 0.0f) & (sum >= threshold);
        drawn              = vselect_int(this, vsplat_int(l), drawn);
        share              = vselect(this, c->share, share);
    }
    *inverse_probability = vkeep(drawn >= 0, total / share);
    return drawn;
}

void direct_one(const scene *s, direct_scratch *w, const vsurface *at, const vmask *active,
                const vfloat *pick, int packets, direct_pick *out)
{
    for (int k = 0; k < packets; k++) {
        vfloat inverse_probability;
        vint drawn = draw(s, w, &at[k], active[k], pick[k], &inverse_probability);
        vmask left = active[k] & (drawn >= 0);
        out[k]     = (direct_pick){ 0 };

        vfloat reach = { 0 };
        w->asked[k]  = left;
        while (vany(left)) {
            int l      = lane(drawn, __builtin_ctz((unsigned)vbits(left)));
            vmask same = left & (drawn == l);
            left       = left & ~same;

            const vlight_sample *lamp = &w->candidates[l].lamp;
            out[k].wi                 = vselect3(same, lamp->wi, out[k].wi);
            out[k].e = vselect3(same, vscale(lamp->e, inverse_probability), out[k].e);
            reach    = vselect(same, lamp->dist, reach);
        }
        w->rays[k] = shadow_ray(&at[k], &(vlight_sample){ .wi = out[k].wi, .dist = reach });
    }
    trace_shadows(s, w, packets, RAYS_INCOHERENT);
    for (int k = 0; k < packets; k++)
        out[k].e = vkeep3(w->asked[k] & ~w->blocked[k], out[k].e);
}
