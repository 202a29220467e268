/* sim/sun_patch.c -- see sun_patch.h. */
#include "sim/sun_patch.h"

#include "core/color.h"
#include "core/parallel.h"
#include "core/sampler.h"
#include "sim/direct.h"
#include "sim/shading.h"
#include "sim/shadow.h"

enum {
    MOST_PANES  = 8,       /* that sunlight goes through, one behind the other */
    MOST_CAST   = 8192,    /* places, a set, of all portals of a sun; a power of two */
    LEAST_CAST  = 8,       /* of one portal */
    MOST_POINTS = 1 << 21, /* all in all */
};

/* What is kept of a point. */
enum {
    AT, /* three numbers each */
    NORMAL = AT + 3,
    TO_SUN = NORMAL + 3,
    E      = TO_SUN + 3,
    SHINES = E + 3, /* radiance */
    OFF    = SHINES + 3,
    U,
    V,
    FIELDS,
};

/* The points of a lot stand together, one lot after the other: sun by sun, portal by portal. */
struct sun_patches {
    const scene *s;
    int portals, cast; /* cast: places, a lot */
    bool matt;         /* all surfaces are */
    uint32_t seed;
    const float *area; /* m^2, of each portal */
    float *facing;     /* m^2: A c(o, w) of each sun and portal, >= 0 */
    float *lit;        /* m^2: the same, times the share that is kept of all sets */
    int32_t *kept;     /* of each lot */
    float *field[FIELDS];
    int32_t *instance, *triangle, *material;
    int32_t *suns;
    int sun_count;
};

int sun_patch_suns(const sun_patches *w) { return w->sun_count; }
int sun_patch_sun(const sun_patches *w, int i) { return w->suns[i]; }

static const light *sun_of(const sun_patches *w, int sun)
{
    return w->s->lights[scene_lamp_count(w->s) + sun];
}

/* ---- making ---------------------------------------------------------------------------------- */

enum { BATCH = 64 /* packets that are followed together */ };

/* The points of one sun, portal and set. */
typedef struct lot {
    sun_patches *w;
    int sun, portal, set;
    int64_t first; /* point */
    int kept;
} lot;

/* Sunlight on its way in. */
typedef struct batch {
    vray rays[BATCH];
    vmask active[BATCH], landed[BATCH], blocked[BATCH];
    vhit hits[BATCH], hit[BATCH];
    vvec3 to_sun[BATCH];
    vrgb e[BATCH];
    vint nobody[BATCH];
    vpassed passed[BATCH];
} batch;

/* Packet k of places: where they are on the portal, and from where in the sun light comes. */
static void cast(const lot *l, batch *b, int k, int index)
{
    const sun_patches *w = l->w;
    const portal *p      = &w->s->portal_list[l->portal];
    uint32_t seed        = hash_combine_u32(w->seed, (uint32_t)(l->sun * w->portals + l->portal));
    vuint of_set         = vsplat_uint(hash_combine_u32(seed, (uint32_t)l->set));
    vsample4 u           = vsobol4(vunsigned(vlane_index() + index), of_set);
    vvec3 place          = vadd(vspread(p->centre), vadd(vscale(vspread(p->u), 2.0f * u.x - 1.0f),
                                                         vscale(vspread(p->v), 2.0f * u.y - 1.0f)));
    vlight_sample of;
    light_sample(sun_of(w, l->sun), &place, u.z, u.w, ALL_LANES, &of);
    b->active[k] = (vlane_index() + index) < w->cast;
    b->landed[k] = (vmask){ 0 };
    b->hit[k]    = (vhit){ .instance = vsplat_int(-1) };
    b->to_sun[k] = of.wi;
    b->e[k]      = of.e;
    b->rays[k]   = (vray){ place, vneg(of.wi), vsplat(INFINITY) };
}

/* What the rays of packet k have met: the first surface that lets no light straight through, or
 * one that they go on through. */
static void land(const sun_patches *w, batch *b, int k)
{
    const vhit *now = &b->hits[k];
    vmask met = b->active[k] & (now->instance >= 0), hollow = { 0 };
    if (w->s->hollow) {
        vsurface at;
        world_surface(w->s->world, now, met, &at);
        vint does         = vgather_int(w->s->material_does, vkeep_int(met, at.material));
        hollow            = met & ((does & DOES_HOLLOW) != 0);
        vvec3 start       = vray_start(&at, &b->rays[k].direction);
        b->rays[k].origin = vselect3(hollow, start, b->rays[k].origin);
    }
    vmask here   = met & ~hollow;
    vhit *to     = &b->hit[k];
    to->instance = vselect_int(here, now->instance, to->instance);
    to->triangle = vselect_int(here, now->triangle, to->triangle);
    to->u        = vselect(here, now->u, to->u);
    to->v        = vselect(here, now->v, to->v);
    b->landed[k] = b->landed[k] | here;
    b->active[k] = hollow;
}

static void store3(const sun_patches *w, int field, int64_t to, const vvec3 *v, int i)
{
    w->field[field][to]     = lane(v->x, i);
    w->field[field + 1][to] = lane(v->y, i);
    w->field[field + 2][to] = lane(v->z, i);
}

/* Keeps the points of packet k that the sun sees. */
static void keep(lot *l, const batch *b, int k)
{
    const sun_patches *w = l->w;
    const scene *s       = w->s;
    vvec3 way            = vneg(b->to_sun[k]);
    vmask lit            = b->landed[k] & ~b->blocked[k];
    vrgb e               = s->hollow ? vmul(b->e[k], b->passed[k].share) : b->e[k];
    vrgb radiance        = { 0 };
    vsurface at;
    vshading shading;
    if (!vany(lit))
        return;
    scene_shade(s, &b->hit[k], &way, vsplat(0.0f), lit, &at, &shading);
    if (w->matt) {
        vrgb f   = materials_reflect(s->materials, at.material, &shading, &b->to_sun[k], lit, NULL);
        radiance = vmul(f, e);
    }
    for (int bits = vbits(lit); bits; bits &= bits - 1) {
        int i      = __builtin_ctz((unsigned)bits);
        int64_t to = l->first + l->kept++;
        store3(w, AT, to, &at.position, i);
        store3(w, NORMAL, to, &at.normal, i);
        store3(w, TO_SUN, to, &b->to_sun[k], i);
        store3(w, E, to, &e, i);
        store3(w, SHINES, to, &radiance, i);
        w->field[OFF][to] = lane(at.error, i);
        w->field[U][to]   = lane(b->hit[k].u, i);
        w->field[V][to]   = lane(b->hit[k].v, i);
        w->instance[to]   = lane(b->hit[k].instance, i);
        w->triangle[to]   = lane(b->hit[k].triangle, i);
        w->material[to]   = lane(at.material, i);
    }
}

static void follow(lot *l, batch *b, int from)
{
    const scene *s = l->w->s;
    int left = (l->w->cast - from + LANES - 1) / LANES, n = left < BATCH ? left : BATCH;
    for (int k = 0; k < n; k++)
        cast(l, b, k, from + k * LANES);
    bool any = true;
    for (int pane = 0; any && pane < MOST_PANES; pane++) {
        world_first_hit(s->world, b->rays, b->active, n, RAYS_COHERENT, b->hits);
        any = false;
        for (int k = 0; k < n; k++) {
            land(l->w, b, k);
            any = any || vany(b->active[k]);
        }
    }
    for (int k = 0; k < n; k++) {
        vsurface at;
        world_surface(s->world, &b->hit[k], b->landed[k], &at);
        vmask front = vdot(at.normal, b->to_sun[k]) >= 0.0f;
        at.normal   = vselect3(front, at.normal, vneg(at.normal));
        b->rays[k]  = direct_shadow_ray(&at, &b->to_sun[k], vsplat(INFINITY));
    }
    shadow_trace(s, b->rays, b->landed, b->nobody, n, RAYS_COHERENT, b->blocked, b->passed);
    for (int k = 0; k < n; k++)
        keep(l, b, k);
}

typedef struct making {
    sun_patches *w;
    batch *batches; /* of each thread */
} making;

static void make_lot(void *context, int item, int thread)
{
    making *m      = context;
    sun_patches *w = m->w;
    batch *b       = &m->batches[thread];
    int pair       = item / SCRAMBLES;
    lot l          = { .w      = w,
                       .sun    = pair / w->portals,
                       .portal = pair % w->portals,
                       .set    = item % SCRAMBLES,
                       .first  = (int64_t)item * w->cast };
    if (w->facing[pair] > 0.0f)
        for (int from = 0; from < w->cast; from += BATCH * LANES)
            follow(&l, b, from);
    w->kept[item] = l.kept;
}

/* How much of each portal each sun sees. Returns the most portals that one sun shines through. */
static int face(sun_patches *w, float *area)
{
    const scene *s = w->s;
    int most       = 0;
    for (int j = 0; j < w->portals; j++)
        area[j] = 4.0f * v3_length(s->portal_list[j].u) * v3_length(s->portal_list[j].v);
    w->area = area;
    for (int i = 0; i < s->sun_count; i++) {
        int lit = 0;
        for (int j = 0; j < w->portals; j++) {
            vvec3 at    = vspread(s->portal_list[j].centre);
            vfloat half = vsplat(0.5f);
            vlight_sample of;
            light_sample(sun_of(w, i), &at, half, half, ALL_LANES, &of);
            vfloat cosine                 = vdot(of.wi, vspread(s->portal_list[j].outward));
            w->facing[i * w->portals + j] = area[j] * fmaxf(lane(cosine, 0), 0.0f);
            lit += w->facing[i * w->portals + j] > 0.0f;
        }
        most = lit > most ? lit : most;
    }
    return most;
}

/* So many places a lot that the points' own error is a small part of the accuracy: that of a set
 * falls with about the power 3/4 of their number, and is 0.3 % of the patches' light for 1024. */
static int places_of(const sun_patches *w, int portals, double accuracy)
{
    double wanted = 1024.0 * pow(fmax(0.01 / accuracy, 0.25), 4.0 / 3.0) / portals;
    double room   = (double)MOST_POINTS / SCRAMBLES / w->portals / w->s->sun_count;
    int places    = LEAST_CAST;
    while (places < MOST_CAST && 1.5 * places < wanted && 2 * places <= room)
        places *= 2;
    return places;
}

static bool make_room(arena *a, sun_patches *w, lux_error *err)
{
    size_t lots = (size_t)w->portals * (size_t)w->s->sun_count * SCRAMBLES;
    size_t n    = lots * (size_t)w->cast;
    w->kept     = arena_array(a, int32_t, lots, err);
    w->instance = w->kept ? arena_array(a, int32_t, n, err) : NULL;
    w->triangle = w->instance ? arena_array(a, int32_t, n, err) : NULL;
    w->material = w->triangle ? arena_array(a, int32_t, n, err) : NULL;
    for (int f = 0; w->material && f < FIELDS; f++)
        if (!(w->field[f] = arena_array(a, float, n, err)))
            return false;
    return w->material != NULL;
}

/* What portals let in, and which suns anything comes of. */
static void sum_up(sun_patches *w)
{
    for (int i = 0; i < w->s->sun_count; i++) {
        float all = 0.0f;
        for (int j = 0; j < w->portals; j++) {
            int pair = i * w->portals + j, kept = 0;
            for (int r = 0; r < SCRAMBLES; r++)
                kept += w->kept[pair * SCRAMBLES + r];
            all += w->lit[pair] = w->facing[pair] * (float)kept / (float)(SCRAMBLES * w->cast);
        }
        if (all > 0.0f)
            w->suns[w->sun_count++] = i;
    }
}

bool sun_patches_new(arena *a, const scene *s, uint32_t seed, double accuracy, int threads,
                     const sun_patches **out, lux_error *err)
{
    *out = NULL;
    if (s->portal_count == 0 || s->sun_count == 0 || !s->reflects)
        return true;
    size_t pairs   = (size_t)s->portal_count * (size_t)s->sun_count;
    sun_patches *w = arena_new(a, sun_patches, err);
    float *area    = w ? arena_array(a, float, (size_t)s->portal_count, err) : NULL;
    if (!area || !(w->facing = arena_array(a, float, pairs, err)) ||
        !(w->lit = arena_array(a, float, pairs, err)) ||
        !(w->suns = arena_array(a, int32_t, (size_t)s->sun_count, err)))
        return false;
    w->s       = s;
    w->seed    = seed;
    w->portals = s->portal_count;
    w->matt    = !s->narrow && !s->textured && !s->smooth;
    int most   = face(w, area);
    if (most == 0)
        return true;
    w->cast       = places_of(w, most, accuracy);
    arena scratch = { 0 };
    making m      = { .w = w, .batches = arena_array(&scratch, batch, (size_t)threads, err) };
    bool good     = m.batches && make_room(a, w, err);
    if (good)
        parallel_for((int)pairs * SCRAMBLES, threads, make_lot, &m, NULL);
    arena_clear(&scratch);
    if (good)
        sum_up(w);
    *out = good && w->sun_count > 0 ? w : NULL;
    return good;
}

/* ---- asking ---------------------------------------------------------------------------------- */

/* How often portal j is drawn at x, beside the others. */
static vfloat weight_of(const sun_patches *w, int sun, int j, const vvec3 *x)
{
    vvec3 to = vsub(vspread(w->s->portal_list[j].centre), *x);
    return w->lit[sun * w->portals + j] / (vdot(to, to) + w->area[j]);
}

static vvec3 load3(const sun_patches *w, int field, vint at)
{
    return (vvec3){ vgather(w->field[field], at), vgather(w->field[field + 1], at),
                    vgather(w->field[field + 2], at) };
}

/* Which portal, of those that have points in the lane's set, and with what probability. */
static vint draw_portal(const sun_patches *w, int sun, vint set, const vvec3 *x, vfloat u,
                        vmask active, vfloat *chance)
{
    vfloat total = { 0 }, sum = { 0 }, share = { 0 };
    for (int j = 0; j < w->portals; j++)
        if (w->lit[sun * w->portals + j] > 0.0f)
            total = total + weight_of(w, sun, j, x);
    vint drawn = vsplat_int(-1);
    for (int j = 0; j < w->portals; j++) {
        if (!(w->lit[sun * w->portals + j] > 0.0f))
            continue;
        vfloat weight = weight_of(w, sun, j, x);
        sum           = sum + weight;
        vmask this    = active & (drawn < 0) & (sum >= u * total);
        drawn         = vselect_int(this, vsplat_int(j), drawn);
        share         = vselect(this, weight, share);
    }
    *chance   = share / total;
    vint lots = (sun * w->portals + drawn) * SCRAMBLES + set;
    vint kept = vgather_int(w->kept, vkeep_int(drawn >= 0, lots));
    return vselect_int((drawn >= 0) & (kept > 0), drawn, vsplat_int(-1));
}

vmask sun_patch_draw(const sun_patches *w, int sun, vint set, const vvec3 *x, vfloat u, vfloat v,
                     vmask active, patch_point *out)
{
    vfloat chance;
    vint portal = draw_portal(w, sun, set, x, u, active, &chance);
    vmask drawn = active & (portal >= 0);
    vint pair   = vkeep_int(drawn, sun * w->portals + portal);
    vint lot    = vkeep_int(drawn, pair * SCRAMBLES + set);
    vint kept   = vgather_int(w->kept, lot);
    vint at     = vkeep_int(drawn, lot * w->cast + vto_int(v * vto_float(kept)));

    out->at           = (vsurface){ .position = load3(w, AT, at),
                                    .error    = vgather(w->field[OFF], at),
                                    .normal   = load3(w, NORMAL, at),
                                    .material = vgather_int(w->material, at) };
    out->to_sun       = load3(w, TO_SUN, at);
    out->e            = load3(w, E, at);
    out->radiance     = load3(w, SHINES, at);
    out->hit.instance = vgather_int(w->instance, at);
    out->hit.triangle = vgather_int(w->triangle, at);
    out->hit.u        = vgather(w->field[U], at);
    out->hit.v        = vgather(w->field[V], at);
    out->area = vgather(w->facing, pair) * vto_float(kept) * (1.0f / (float)w->cast) / chance;
    return drawn;
}

vfloat sun_patch_density(const sun_patches *w, int sun, const vvec3 *x, const vvec3 *y,
                         const vvec3 *wi, vmask active)
{
    vfloat total = { 0 }, density = { 0 };
    for (int j = 0; j < w->portals; j++) {
        const portal *p = &w->s->portal_list[j];
        if (!(w->lit[sun * w->portals + j] > 0.0f))
            continue;
        vfloat weight = weight_of(w, sun, j, x);
        total         = total + weight;

        /* Where the way to the sun crosses the portal's plane */
        vfloat slope = vdot(*wi, vspread(p->outward));
        vvec3 to     = vsub(vspread(p->centre), *y);
        vfloat along = vdot(to, vspread(p->outward)) / slope;
        vvec3 off    = vsub(vscale(*wi, along), to);
        vmask inside = (vabs(vdot(off, vspread(p->u))) <= v3_dot(p->u, p->u)) &
                       (vabs(vdot(off, vspread(p->v))) <= v3_dot(p->v, p->v));
        density = density + vkeep(active & (slope > 0.0f) & (along > 0.0f) & inside,
                                  weight / w->lit[sun * w->portals + j]);
    }
    return vkeep(active & (total > 0.0f), density / total);
}
