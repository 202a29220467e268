/* sim/sun_patch_make.c -- see sun_patch.h: sunlight cast through portals, and what it meets. */
#include "core/color.h"
#include "core/parallel.h"
#include "core/sampler.h"
#include "core/warp.h"
#include "sim/direct.h"
#include "sim/shading.h"
#include "sim/shadow.h"
#include "sim/sun_patch_parts.h"

enum {
    MOST_PANES  = 64,      /* that sunlight goes through, one behind the other */
    MOST_CAST   = 8192,    /* places, a set, of all portals of a sun; a power of two */
    LEAST_CAST  = 8,       /* of one portal */
    MOST_POINTS = 1 << 20, /* all in all, of each generation */
    BATCH       = 64,      /* packets that are followed together */
};

/* The points of one sun, portal and set. */
typedef struct lot {
    sun_patches *w;
    int sun, portal, set;
    int64_t first;     /* point */
    int kept, kept_on; /* of the patch, and of what that lights */
} lot;

/* Light on its way. */
typedef struct batch {
    vray rays[BATCH];
    vmask active[BATCH], landed[BATCH], blocked[BATCH];
    vhit hits[BATCH], hit[BATCH];
    vvec3 to_sun[BATCH];
    vrgb e[BATCH]; /* of the sun; then pi f(y) e */
    vsurface patch[BATCH];
    vint nobody[BATCH];
    vpassed passed[BATCH];
} batch;

static vuint set_of(const lot *l, uint32_t generation)
{
    const sun_patches *w = l->w;
    uint32_t seed        = hash_combine_u32(w->seed, (uint32_t)(l->sun * w->portals + l->portal));
    return vsplat_uint(hash_combine_u32(hash_combine_u32(seed, (uint32_t)l->set), generation));
}

/* Packet k of places: where they are on the portal, and from where in the sun light comes. */
static void cast(const lot *l, batch *b, int k, int index)
{
    const sun_patches *w = l->w;
    const portal *p      = &w->s->portal_list[l->portal];
    vsample4 u           = vsobol4(vunsigned(vlane_index() + index), set_of(l, 0));
    vvec3 place          = vadd(vspread(p->centre), vadd(vscale(vspread(p->u), 2.0f * u.x - 1.0f),
                                                         vscale(vspread(p->v), 2.0f * u.y - 1.0f)));
    vlight_sample of;
    light_sample(patch_sun(w, l->sun), &place, u.z, u.w, ALL_LANES, &of);
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

/* Lane i of three numbers, and one more, as a row of a point. */
static void store_row(const patch_lots *l, int64_t point, int row, const vvec3 *v, vfloat more,
                      int i)
{
    float *to = l->rows + 4 * (point * l->row_count + row);
    to[0]     = lane(v->x, i);
    to[1]     = lane(v->y, i);
    to[2]     = lane(v->z, i);
    to[3]     = lane(more, i);
}

static void store_hit(const patch_lots *l, int64_t point, const vhit *hit, int i)
{
    vvec3 row = { vas_float(hit->instance), vas_float(hit->triangle), hit->u };
    store_row(l, point, HIT_ROW, &row, hit->v, i);
}

/* Keeps the points of packet k that the sun sees, and lets light go on from there, as a matt
 * surface would send it. */
static void keep_patch(lot *l, batch *b, int k, int index)
{
    const sun_patches *w = l->w;
    const scene *s       = w->s;
    vvec3 way            = vneg(b->to_sun[k]);
    vmask lit            = b->landed[k] & ~b->blocked[k];
    vrgb e               = s->hollow ? vmul(b->e[k], b->passed[k].share) : b->e[k];
    vsurface *at         = &b->patch[k];
    vshading shading;
    b->active[k] = b->landed[k] = (vmask){ 0 };
    if (!vany(lit))
        return;
    scene_shade(s, &b->hit[k], &way, vsplat(0.0f), lit, at, &shading);
    vsample4 u    = vsobol4(vunsigned(vlane_index() + index), set_of(l, 1));
    vvec3 on      = vwarp_cosine_about(at->normal, u.x, u.y);
    vrgb radiance = { 0 };
    vfloat none   = { 0 };
    if (w->matt) {
        vrgb f = materials_reflect(s->materials, at->material, &shading, &b->to_sun[k], lit, NULL);
        radiance = vmul(f, e);
    }
    for (int bits = vbits(lit); bits; bits &= bits - 1) {
        int i      = __builtin_ctz((unsigned)bits);
        int64_t to = l->first + l->kept++;
        store_row(&w->first, to, PLACE_ROW, &at->position, none, i);
        store_row(&w->first, to, NORMAL_ROW, &at->normal, none, i);
        store_row(&w->first, to, BEFORE_ROW, &b->to_sun[k], none, i);
        store_row(&w->first, to, LIGHT_ROW, w->matt ? &radiance : &e, none, i);
        store_hit(&w->first, to, &b->hit[k], i);
    }

    /* What y sends on toward z: pi f(y) e */
    shading.wo    = on;
    vfloat cosine = vdot(b->to_sun[k], at->normal);
    vrgb f  = materials_reflect(s->materials, at->material, &shading, &b->to_sun[k], lit, NULL);
    b->e[k] = vkeep3(lit & (cosine > 0.0f), vscale(vmul(f, e), WARP_PI / cosine));
    b->active[k] = lit & (vrgb_luminance(b->e[k]) > 0.0f);
    b->hit[k]    = (vhit){ .instance = vsplat_int(-1) };
    b->rays[k]   = (vray){ vray_start(at, &on), on, vsplat(INFINITY) };
}

/* Keeps what the light of packet k's patch falls on. */
static void keep_second(lot *l, const batch *b, int k)
{
    const sun_patches *w = l->w;
    const scene *s       = w->s;
    vmask met            = b->landed[k];
    const vsurface *y    = &b->patch[k];
    vvec3 on = b->rays[k].direction, back = vneg(on);
    vsurface z;
    vshading shading;
    if (!vany(met))
        return;
    scene_shade(s, &b->hit[k], &on, vsplat(0.0f), met, &z, &shading);
    vvec3 way        = vsub(z.position, y->position);
    vfloat distance2 = vdot(way, way);
    vfloat from_y    = vdot(on, y->normal);
    vfloat to_z      = vdot(back, z.normal);
    vfloat to_sun    = vdot(b->to_sun[k], y->normal);
    vfloat none      = { 0 };
    vrgb radiance    = { 0 };
    met              = met & (distance2 > 0.0f) & (from_y > 0.0f) & (to_z > 0.0f) & (to_sun > 0.0f);
    if (w->matt) {
        vrgb f   = materials_reflect(s->materials, z.material, &shading, &back, met, NULL);
        radiance = vscale(vmul(f, b->e[k]), 1.0f / to_z);
    }
    vfloat thin  = from_y / distance2;
    vfloat drawn = thin * to_z * (1.0f / WARP_PI);
    for (int bits = vbits(met); bits; bits &= bits - 1) {
        int i      = __builtin_ctz((unsigned)bits);
        int64_t to = l->first + l->kept_on++;
        store_row(&w->second, to, PLACE_ROW, &z.position, drawn, i);
        store_row(&w->second, to, NORMAL_ROW, &z.normal, to_sun, i);
        store_row(&w->second, to, BEFORE_ROW, &back, thin, i);
        store_row(&w->second, to, LIGHT_ROW, w->matt ? &radiance : &b->e[k], none, i);
        store_row(&w->second, to, PATCH_ROW, &y->position, none, i);
        store_row(&w->second, to, SUN_ROW, &b->to_sun[k], none, i);
        store_hit(&w->second, to, &b->hit[k], i);
    }
}

/* Follows the rays of n packets to what stops them. */
static void fly(const sun_patches *w, batch *b, int n, ray_hint hint)
{
    bool any = true;
    for (int pane = 0; any && pane < MOST_PANES; pane++) {
        world_first_hit(w->s->world, b->rays, b->active, n, hint, b->hits);
        any = false;
        for (int k = 0; k < n; k++) {
            land(w, b, k);
            any = any || vany(b->active[k]);
        }
    }
}

/* What of the light of packets of patches arrives where it has landed, through panes. What bends on
 * its way through solids is left to paths, as path_patch.c does. */
static void dim(const scene *s, batch *b, int n)
{
    for (int k = 0; k < n; k++) {
        vvec3 on = b->rays[k].direction;
        vsurface z;
        world_surface(s->world, &b->hit[k], b->landed[k], &z);
        vvec3 way  = vsub(z.position, b->patch[k].position);
        b->rays[k] = direct_shadow_ray(&b->patch[k], &on, vlength(way));
    }
    shadow_trace(s, b->rays, b->landed, b->nobody, n, RAYS_INCOHERENT, b->blocked, b->passed);
    for (int k = 0; k < n; k++) {
        b->landed[k] = b->landed[k] & ~b->blocked[k] & ~b->passed[k].solids;
        b->e[k]      = vmul(b->e[k], b->passed[k].share);
    }
}

static void follow(lot *l, batch *b, int from)
{
    const scene *s = l->w->s;
    int left = (l->w->cast - from + LANES - 1) / LANES, n = left < BATCH ? left : BATCH;
    for (int k = 0; k < n; k++)
        cast(l, b, k, from + k * LANES);
    fly(l->w, b, n, RAYS_COHERENT);
    for (int k = 0; k < n; k++) {
        vsurface at;
        world_surface(s->world, &b->hit[k], b->landed[k], &at);
        vmask front = vdot(at.normal, b->to_sun[k]) >= 0.0f;
        at.normal   = vselect3(front, at.normal, vneg(at.normal));
        b->rays[k]  = direct_shadow_ray(&at, &b->to_sun[k], vsplat(INFINITY));
    }
    shadow_trace(s, b->rays, b->landed, b->nobody, n, RAYS_COHERENT, b->blocked, b->passed);
    for (int k = 0; k < n; k++)
        keep_patch(l, b, k, from + k * LANES);
    fly(l->w, b, n, RAYS_INCOHERENT);
    if (s->hollow)
        dim(s, b, n);
    for (int k = 0; k < n; k++)
        keep_second(l, b, k);
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
    w->first.kept[item]  = l.kept;
    w->second.kept[item] = l.kept_on;
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
            light_sample(patch_sun(w, i), &at, half, half, ALL_LANES, &of);
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
static int places_of(const sun_patches *w, int lit, double accuracy)
{
    double wanted = 1024.0 * pow(fmax(0.01 / accuracy, 0.25), 4.0 / 3.0) / lit;
    double room   = (double)MOST_POINTS / SCRAMBLES / w->portals / w->s->sun_count;
    int places    = LEAST_CAST;
    while (places < MOST_CAST && 1.5 * places < wanted && 2 * places <= room)
        places *= 2;
    return places;
}

static bool make_lots(arena *a, const sun_patches *w, int rows, patch_lots *l, lux_error *err)
{
    size_t lots  = (size_t)w->portals * (size_t)w->s->sun_count * SCRAMBLES;
    size_t n     = lots * (size_t)w->cast * (size_t)rows * 4;
    l->row_count = rows;
    l->kept      = arena_array(a, int32_t, lots, err);
    l->rows      = l->kept ? arena_array(a, float, n, err) : NULL;
    return l->rows != NULL;
}

/* What portals let in, and which suns anything comes of. */
static void sum_up(sun_patches *w)
{
    for (int i = 0; i < w->s->sun_count; i++) {
        float all = 0.0f;
        for (int j = 0; j < w->portals; j++) {
            int pair = i * w->portals + j, kept = 0;
            for (int r = 0; r < SCRAMBLES; r++)
                kept += w->first.kept[pair * SCRAMBLES + r];
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
    bool good     = m.batches && make_lots(a, w, FIRST_ROWS, &w->first, err) &&
                make_lots(a, w, SECOND_ROWS, &w->second, err);
    if (good)
        parallel_for((int)pairs * SCRAMBLES, threads, make_lot, &m, NULL);
    arena_clear(&scratch);
    if (good)
        sum_up(w);
    *out = good && w->sun_count > 0 ? w : NULL;
    return good;
}
