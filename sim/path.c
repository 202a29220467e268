/* sim/path.c -- see path.h. The living paths stay packed at the front of the arrays. */
#include "sim/path.h"

#include "core/color.h"
#include "core/sampler.h"
#include "core/warp.h"
#include "sim/direct.h"

#include <string.h>

enum { PACKETS = PATHS / LANES };

/* Survival is never certain, so that a path ends even in a room that absorbs nothing. */
static const float surest_survival = 0.995f;

typedef struct path_tracer {
    const scene *s;
    direct_scratch *direct;
    int64_t ray_count;
    path_bundle *b;
    int alive;

    /* Of each living path: whose it is, where it stands, how it came, what it is worth */
    int32_t id[PATHS], material[PATHS];
    float x[PATHS], y[PATHS], z[PATHS], error[PATHS];
    float nx[PATHS], ny[PATHS], nz[PATHS]; /* on the side that it came from */
    float ox[PATHS], oy[PATHS], oz[PATHS]; /* toward where it came from */
    float worth[3][PATHS];

    /* Of one step, by packet */
    vsurface at[PACKETS];
    vmask active[PACKETS];
    vfloat pick[PACKETS];
    vsample4 sample[PACKETS];
    direct_pick lamps[PACKETS];
    vray rays[PACKETS];
    vhit hits[PACKETS];
} path_tracer;

path_tracer *path_tracer_new(arena *a, const scene *s, lux_error *err)
{
    path_tracer *t = arena_new(a, path_tracer, err);
    if (!t)
        return NULL;
    t->s      = s;
    t->direct = direct_scratch_new(a, s, err);
    return t->direct ? t : NULL;
}

int64_t path_rays(const path_tracer *t) { return t->ray_count + direct_rays(t->direct); }

static vvec3 load3(const float *x, const float *y, const float *z, int i)
{
    return (vvec3){ vload(x + i), vload(y + i), vload(z + i) };
}

static void store3(float *x, float *y, float *z, int i, vvec3 v)
{
    vstore(x + i, v.x);
    vstore(y + i, v.y);
    vstore(z + i, v.z);
}

static int packets_of(const path_tracer *t) { return (t->alive + LANES - 1) / LANES; }

static void load_packets(path_tracer *t, uint32_t depth)
{
    for (int k = 0; k < packets_of(t); k++) {
        int i             = k * LANES;
        t->active[k]      = (vlane_index() + i) < t->alive;
        vint id           = vload_int(t->id + i);
        vuint index       = vunsigned(vgather_int((const int32_t *)t->b->index, id));
        vuint seed        = vunsigned(vgather_int((const int32_t *)t->b->seed, id));
        t->sample[k]      = vsobol4(index, vhash_combine(seed, vunsigned(vsplat_int((int)depth))));
        t->pick[k]        = t->sample[k].z;
        t->at[k].position = load3(t->x, t->y, t->z, i);
        t->at[k].normal   = load3(t->nx, t->ny, t->nz, i);
        t->at[k].error    = vload(t->error + i);
        t->at[k].material = vload_int(t->material + i);
    }
}

/* Adds what lane i of each packet found to the sums of the path that it is. */
static void add_to(path_tracer *t, float sums[3][PATHS], int k, vrgb e)
{
    float r[LANES], g[LANES], b[LANES];
    vstore(r, e.x);
    vstore(g, e.y);
    vstore(b, e.z);
    for (int i = 0; i < LANES && k * LANES + i < t->alive; i++) {
        int id = t->id[k * LANES + i];
        sums[0][id] += r[i];
        sums[1][id] += g[i];
        sums[2][id] += b[i];
    }
}

static vrgb load_worth(const path_tracer *t, int k)
{
    return load3(t->worth[0], t->worth[1], t->worth[2], k * LANES);
}

/* ---- a step of all living paths -------------------------------------------------------------- */

/* All lamps where the paths begin. One that is drawn by its luminance would do, but for colour: a
 * mixture's luminance can be sure while its colour is not. */
static void ask_all_lamps(path_tracer *t)
{
    for (int first = 0; first < packets_of(t); first += DIRECT_PACKETS) {
        int n = packets_of(t) - first;
        n     = n < DIRECT_PACKETS ? n : DIRECT_PACKETS;
        vrgb e[DIRECT_PACKETS];
        direct_all(t->s, t->direct, t->at + first, t->active + first, n, e);
        for (int k = 0; k < n; k++)
            add_to(t, t->b->lamp, first + k, e[k]);
    }
}

/* Next-event estimation where the paths stand: one lamp, by its luminance. */
static void ask_a_lamp(path_tracer *t, bool beginning)
{
    const scene *s = t->s;
    for (int first = 0; first < packets_of(t); first += DIRECT_PACKETS) {
        int n = packets_of(t) - first;
        n     = n < DIRECT_PACKETS ? n : DIRECT_PACKETS;
        direct_one(s, t->direct, t->at + first, t->active + first, t->pick + first, n,
                   t->lamps + first);
    }
    for (int k = 0; k < packets_of(t); k++) {
        const direct_pick *l = &t->lamps[k];
        vvec3 wo             = load3(t->ox, t->oy, t->oz, k * LANES);
        if (beginning) {
            vfloat cosine = vkeep(t->active[k], vdot(l->wi, t->at[k].normal));
            add_to(t, t->b->lamp, k, vscale(l->e, cosine));
        } else {
            vrgb f = materials_reflect(s->materials, t->at[k].material, &wo, &l->wi,
                                       &t->at[k].normal, t->active[k]);
            add_to(t, t->b->indirect, k, vmul(load_worth(t, k), vmul(f, l->e)));
        }
    }
}

static void ask_lamps(path_tracer *t, bool beginning)
{
    if (t->s->light_count == 0)
        return;
    if (beginning && t->s->lights_differ)
        ask_all_lamps(t);
    else
        ask_a_lamp(t, beginning);
}

/* Keeps the paths of `goes`, worth what `worth` says, heading along the rays of packet k. */
static int keep(path_tracer *t, int k, vmask goes, vrgb worth, const vray *ray, int kept)
{
    float w[3][LANES], o[3][LANES], d[3][LANES];
    store3(w[0], w[1], w[2], 0, worth);
    store3(o[0], o[1], o[2], 0, ray->origin);
    store3(d[0], d[1], d[2], 0, ray->direction);
    for (int bits = vbits(goes); bits; bits &= bits - 1) {
        int i       = __builtin_ctz((unsigned)bits);
        t->id[kept] = t->id[k * LANES + i];
        t->x[kept] = o[0][i], t->y[kept] = o[1][i], t->z[kept] = o[2][i];
        t->nx[kept] = d[0][i], t->ny[kept] = d[1][i], t->nz[kept] = d[2][i];
        t->worth[0][kept] = w[0][i], t->worth[1][kept] = w[1][i], t->worth[2][kept] = w[2][i];
        kept++;
    }
    return kept;
}

/* Draws where each path goes on, or that it ends. Behind this, x y z and nx ny nz hold the rays'
 * origins and directions. */
static void draw_directions(path_tracer *t, bool beginning)
{
    const scene *s = t->s;
    int n = packets_of(t), kept = 0;
    for (int k = 0; k < n; k++) {
        const vsample4 *u  = &t->sample[k];
        const vsurface *at = &t->at[k];
        vvec3 wo           = load3(t->ox, t->oy, t->oz, k * LANES);
        vrgb worth         = load_worth(t, k);
        vmask goes         = t->active[k];
        vscatter next;
        if (beginning) {
            next.wi = vwarp_cosine_about(at->normal, u->x, u->y);
        } else {
            goes = materials_scatter(s->materials, at->material, &wo, &at->normal, u->x, u->y, goes,
                                     &next);
            worth = vmul(worth, next.weight);

            /* Roulette: a path goes on as often as it is worth going */
            vfloat most     = vmax(worth.x, vmax(worth.y, worth.z));
            vfloat survival = vmin(most, vsplat(surest_survival));
            goes            = goes & (u->w < survival);
            worth           = vscale(worth, 1.0f / survival);
        }
        vray ray = { .origin = vray_start(at, &next.wi), .direction = next.wi };
        kept     = keep(t, k, goes, worth, &ray, kept);
    }
    t->alive = kept;
}

/* Traces the rays, and moves the paths to what they meet. */
static void go_on(path_tracer *t)
{
    int n = packets_of(t), kept = 0;
    for (int k = 0; k < n; k++) {
        int i        = k * LANES;
        t->active[k] = (vlane_index() + i) < t->alive;
        t->rays[k] =
            (vray){ load3(t->x, t->y, t->z, i), load3(t->nx, t->ny, t->nz, i), vsplat(INFINITY) };
    }
    t->ray_count += t->alive;
    world_first_hit(t->s->world, t->rays, t->active, n, RAYS_INCOHERENT, t->hits);

    for (int k = 0; k < n; k++) {
        vsurface at;
        vmask met = t->active[k] & (t->hits[k].instance >= 0);
        world_surface(t->s->world, &t->hits[k], met, &at);
        vvec3 wo   = vneg(t->rays[k].direction);
        vmask back = vdot(wo, at.normal) < 0.0f;
        at.normal  = vselect3(back, vneg(at.normal), at.normal);

        float n3[3][LANES], o3[3][LANES], p3[3][LANES], error[LANES];
        int32_t made_of[LANES];
        store3(n3[0], n3[1], n3[2], 0, at.normal);
        store3(o3[0], o3[1], o3[2], 0, wo);
        store3(p3[0], p3[1], p3[2], 0, at.position);
        vstore(error, at.error);
        vstore_int(made_of, at.material);
        for (int bits = vbits(met); bits; bits &= bits - 1, kept++) {
            int i = __builtin_ctz((unsigned)bits), from = k * LANES + i;
            t->id[kept] = t->id[from];
            for (int c = 0; c < 3; c++)
                t->worth[c][kept] = t->worth[c][from];
            t->x[kept] = p3[0][i], t->y[kept] = p3[1][i], t->z[kept] = p3[2][i];
            t->nx[kept] = n3[0][i], t->ny[kept] = n3[1][i], t->nz[kept] = n3[2][i];
            t->ox[kept] = o3[0][i], t->oy[kept] = o3[1][i], t->oz[kept] = o3[2][i];
            t->error[kept]    = error[i];
            t->material[kept] = made_of[i];
        }
    }
    t->alive = kept;
}

/* Which paths see something that could give light back. */
static void note_what_is_met(path_tracer *t)
{
    for (int k = 0; k < packets_of(t); k++) {
        vmask active = (vlane_index() + k * LANES) < t->alive;
        vint which   = vload_int(t->material + k * LANES);
        vfloat back  = vrgb_luminance(materials_albedo(t->s->materials, which, active));
        for (int bits = vbits(active & (back > 0.0f)); bits; bits &= bits - 1)
            t->b->met[t->id[k * LANES + __builtin_ctz((unsigned)bits)]] = 1.0f;
    }
}

/* What shines by itself where the paths have come to. */
static void add_glow(path_tracer *t, bool straight)
{
    if (!t->s->glows)
        return;
    for (int k = 0; k < packets_of(t); k++) {
        vmask active = (vlane_index() + k * LANES) < t->alive;
        vint which   = vload_int(t->material + k * LANES);
        vrgb glow    = materials_emission(t->s->materials, which, active);
        add_to(t, straight ? t->b->glow : t->b->indirect, k, vmul(load_worth(t, k), glow));
    }
}

static void begin(path_tracer *t, path_bundle *b)
{
    t->b     = b;
    t->alive = b->count;
    memset(b->lamp, 0, sizeof b->lamp);
    memset(b->glow, 0, sizeof b->glow);
    memset(b->indirect, 0, sizeof b->indirect);
    memset(b->met, 0, sizeof b->met);
    size_t bytes = (size_t)b->count * sizeof(float);
    memcpy(t->x, b->x, bytes), memcpy(t->y, b->y, bytes), memcpy(t->z, b->z, bytes);
    memcpy(t->nx, b->nx, bytes), memcpy(t->ny, b->ny, bytes), memcpy(t->nz, b->nz, bytes);
    memcpy(t->ox, b->nx, bytes), memcpy(t->oy, b->ny, bytes), memcpy(t->oz, b->nz, bytes);
    memcpy(t->error, b->error, bytes);
    for (int i = 0; i < PATHS; i++) {
        t->id[i]       = i < b->count ? i : 0; /* those behind the last are read, and dropped */
        t->material[i] = 0;
        for (int c = 0; c < 3; c++)
            t->worth[c][i] = 1.0f;
    }
}

void path_trace(path_tracer *t, path_bundle *b, bool lamps, bool bounce)
{
    begin(t, b);
    for (uint32_t depth = 0; t->alive > 0; depth++) {
        load_packets(t, depth);
        if (depth > 0 || lamps)
            ask_lamps(t, depth == 0);
        if (!bounce && (depth > 0 || !t->s->glows))
            break;
        draw_directions(t, depth == 0);
        go_on(t);
        add_glow(t, depth == 0);
        if (depth == 0)
            note_what_is_met(t);
        if (!bounce)
            break;
    }

    /* The pdf of the first direction, cos / pi, turns radiance into irradiance by pi */
    for (int c = 0; c < 3; c++)
        for (int i = 0; i < b->count; i++) {
            b->glow[c][i] *= WARP_PI;
            b->indirect[c][i] *= WARP_PI;
        }
}
