/* sim/path_patch.c -- sunlight that has come in by a portal lights a patch, and the patch the room.
 *
 * Paths meet a patch seldom. So from where they stand, x, a portal is drawn and a place o on it;
 * the sunlight that comes through o falls on y, which is asked for light as a lamp would be:
 *
 *                 o         the portal                w: toward the sun
 *        -----=========-----                          c: cosines
 *              \   \   \
 *               \   \   \        E(x) = f(x) c(x) f(y) c(y, w) e c(y, x) / (|x - y|^2 p(y))
 *            x   \   \   \       p(y) = c(y, w) * sum of q / (A c(o, w)), over portals that lie
 *         ------- ============          between y and the sun, q: how often each is drawn  [1/m^2]
 *                 y   the patch
 *
 * A place o is even on its portal, of area A. What paths find in patches by themselves counts with
 * the power heuristic of both densities, so that neither a patch close by nor one that no portal
 * lights costs more than noise.
 */
#include "core/color.h"
#include "sim/path_parts.h"
#include "sim/sensor.h"
#include "sim/shading.h"

enum { MOST_PANES = 8 /* that sunlight goes through, one behind the other */ };

struct sun_patches {
    int portal_count;
    const portal *portals;
    const float *area; /* m^2 */
    float *facing;     /* m^2: A c(o, w) of sun i and portal j at i * portal_count + j, >= 0 */
    int32_t *active;   /* suns that come in by some portal */
    int active_count;

    /* Of one step, by packet: what is drawn, and what is found there */
    vint sun[PACKETS];
    vvec3 to_sun[PACKETS];
    vrgb e[PACKETS];
    vmask drawn[PACKETS];
    vhit hit[PACKETS];   /* y */
    vrgb found[PACKETS]; /* W/m^2, at the beginning of the path, if nothing stands between */
    vsurface patch[PACKETS];
};

/* ---- making ---------------------------------------------------------------------------------- */

/* How much of portal j a sun sees. */
static float seen_by(const light *sun, const portal *p, float area)
{
    vvec3 at    = vspread(p->centre);
    vfloat half = vsplat(0.5f);
    vlight_sample of;
    light_sample(sun, &at, half, half, ALL_LANES, &of);
    return area * fmaxf(lane(vdot(of.wi, vspread(p->outward)), 0), 0.0f);
}

bool path_patches_new(path_tracer *t, arena *a, lux_error *err)
{
    const scene *s = t->s;
    int n          = s->portal_count;
    if (n == 0 || s->sun_count == 0 || !s->reflects)
        return true;
    sun_patches *w = arena_new(a, sun_patches, err);
    float *area    = w ? arena_array(a, float, (size_t)n, err) : NULL;
    if (!area || !(w->facing = arena_array(a, float, (size_t)n *(size_t)s->sun_count, err)) ||
        !(w->active = arena_array(a, int32_t, (size_t)s->sun_count, err)))
        return false;
    w->portal_count = n;
    w->portals      = s->portal_list;
    w->area         = area;
    for (int j = 0; j < n; j++)
        area[j] = 4.0f * v3_length(w->portals[j].u) * v3_length(w->portals[j].v);
    for (int i = 0; i < s->sun_count; i++) {
        float all = 0.0f;
        for (int j = 0; j < n; j++)
            all += w->facing[i * n + j] =
                seen_by(s->lights[scene_lamp_count(s) + i], &w->portals[j], area[j]);
        if (all > 0.0f)
            w->active[w->active_count++] = i;
    }
    if (w->active_count > 0)
        t->patches = w;
    return true;
}

/* ---- which portal ---------------------------------------------------------------------------- */

/* How often portal j is drawn at p, beside the others: as much of the sun as it lets in, the less
 * the farther away it is. */
static vfloat weight_of(const sun_patches *w, int j, vfloat facing, const vvec3 *p)
{
    vvec3 to = vsub(vspread(w->portals[j].centre), *p);
    return facing / (vdot(to, to) + w->area[j]);
}

static vfloat facing_of(const sun_patches *w, vint sun, int j)
{
    return vgather(w->facing, sun * w->portal_count + j);
}

/* The density at which o is drawn, on a plane square to w, of places that lie behind the portal as
 * seen from the sun: toward it from y, by the portals that are on the way. */
static vfloat density_at(const sun_patches *w, vint sun, const vvec3 *x, const vvec3 *y,
                         const vvec3 *wi, vmask active)
{
    vfloat total = { 0 }, density = { 0 };
    for (int j = 0; j < w->portal_count; j++) {
        const portal *p = &w->portals[j];
        vfloat facing   = vkeep(active, facing_of(w, sun, j));
        vfloat weight   = weight_of(w, j, facing, x);
        total           = total + weight;

        /* Where the way to the sun crosses the portal's plane */
        vfloat slope = vdot(*wi, vspread(p->outward));
        vvec3 to     = vsub(vspread(p->centre), *y);
        vfloat along = vdot(to, vspread(p->outward)) / slope;
        vvec3 off    = vsub(vscale(*wi, along), to);
        float uu = v3_dot(p->u, p->u), vv = v3_dot(p->v, p->v);
        vmask crosses = active & (slope > 0.0f) & (along > 0.0f) &
                        (vabs(vdot(off, vspread(p->u))) <= uu) &
                        (vabs(vdot(off, vspread(p->v))) <= vv);
        density = density + vkeep(crosses, weight / (w->area[j] * slope));
    }
    return vkeep(active & (total > 0.0f), density / total);
}

/* A place on some portal, as weights are. */
static vmask draw_place(const sun_patches *w, vint sun, const vvec3 *x, const vsample4 *u,
                        vmask active, vvec3 *place)
{
    vfloat total = { 0 }, sum = { 0 };
    for (int j = 0; j < w->portal_count; j++)
        total = total + weight_of(w, j, vkeep(active, facing_of(w, sun, j)), x);
    vfloat target = u->z * total;
    vmask open    = active & (total > 0.0f);
    vvec3 at      = { 0 };
    for (int j = 0; j < w->portal_count; j++) {
        const portal *p = &w->portals[j];
        vfloat weight   = weight_of(w, j, vkeep(active, facing_of(w, sun, j)), x);
        sum             = sum + weight;
        vmask this      = open & (weight > 0.0f) & (sum >= target);
        vvec3 here      = vadd(vspread(p->centre), vadd(vscale(vspread(p->u), 2.0f * u->x - 1.0f),
                                                        vscale(vspread(p->v), 2.0f * u->y - 1.0f)));
        at              = vselect3(this, here, at);
        open            = open & ~this;
    }
    *place = at;
    return active & (total > 0.0f) & ~open;
}

vfloat path_patch_pdf(const path_tracer *t, int k, int sun, const vvec3 *wi, vmask active)
{
    const sun_patches *w = t->patches;
    if (t->s->hollow)
        active = active & ((t->does[k] & DOES_HOLLOW) == 0);
    if (!vany(active))
        return (vfloat){ 0 };
    const vsurface *y = &t->at[k];
    vvec3 x           = load3(t, LEFT, k);
    vvec3 way         = vsub(y->position, x);
    vfloat to_sun     = vabs(vdot(*wi, y->normal));
    vfloat distance2  = vdot(way, way);
    vfloat to_x       = vabs(vdot(way, y->normal)) / vsqrt(distance2);
    vfloat square     = density_at(w, vsplat_int(sun), &x, &y->position, wi, active);
    vfloat on_patch   = square * to_sun * (1.0f / (float)w->active_count);
    return vkeep(active & (to_x > 0.0f), on_patch * distance2 / to_x);
}

/* ---- asking ---------------------------------------------------------------------------------- */

/* Which sun, and along which of its rays light comes in. */
static void draw(path_tracer *t, int k)
{
    const scene *s = t->s;
    sun_patches *w = t->patches;
    vsample4 u     = path_numbers(t, k, OF_PATCH);
    vsample4 v     = path_numbers(t, k, OF_PATCH << 8);
    vint pick      = vto_int(u.w * (float)w->active_count);
    vmask active   = t->asks[k];
    w->sun[k]      = vgather_int(w->active, vkeep_int(active, pick));
    vvec3 place    = { 0 };
    w->drawn[k]    = draw_place(w, w->sun[k], &t->at[k].position, &u, active, &place);
    w->to_sun[k]   = (vvec3){ 0 };
    w->e[k]        = (vrgb){ 0 };
    for (vmask left = w->drawn[k]; vany(left);) {
        int sun;
        vmask same = vtake_same(w->sun[k], &left, &sun);
        vlight_sample of;
        light_sample(s->lights[scene_lamp_count(s) + sun], &place, v.x, v.y, same, &of);
        w->to_sun[k] = vselect3(same, of.wi, w->to_sun[k]);
        w->e[k]      = vselect3(same, of.e, w->e[k]);
    }
    t->asked[k] = w->drawn[k];
    t->rays[k]  = (vray){ place, vneg(w->to_sun[k]), vsplat(INFINITY) };
}

/* The first surface that a packet's rays meet which lets no light straight through; the lanes that
 * are to go on. */
static vmask land(path_tracer *t, int k, vmask met)
{
    const scene *s  = t->s;
    sun_patches *w  = t->patches;
    const vhit *hit = &t->hits[k];
    vmask hollow    = { 0 };
    if (s->hollow) {
        vsurface at;
        world_surface(s->world, hit, met, &at);
        vint does   = vgather_int(s->material_does, vkeep_int(met, at.material));
        hollow      = met & ((does & DOES_HOLLOW) != 0);
        vvec3 start = vray_start(&at, &t->rays[k].direction);

        t->rays[k].origin = vselect3(hollow, start, t->rays[k].origin);
    }
    vmask here   = met & ~hollow;
    vhit *to     = &w->hit[k];
    w->drawn[k]  = w->drawn[k] | here;
    to->distance = vselect(here, hit->distance, to->distance);
    to->instance = vselect_int(here, hit->instance, to->instance);
    to->triangle = vselect_int(here, hit->triangle, to->triangle);
    to->u        = vselect(here, hit->u, to->u);
    to->v        = vselect(here, hit->v, to->v);
    return hollow;
}

/* All of them. */
static void follow_sunlight(path_tracer *t, int n)
{
    sun_patches *w = t->patches;
    bool any       = true;
    for (int k = 0; k < n; k++) {
        w->drawn[k] = (vmask){ 0 };
        w->hit[k]   = (vhit){ .instance = vsplat_int(-1) };
    }
    for (int pane = 0; any && pane < MOST_PANES; pane++) {
        any = false;
        for (int k = 0; k < n; k++)
            t->ray_count += __builtin_popcount((unsigned)vbits(t->asked[k]));
        world_first_hit(t->s->world, t->rays, t->asked, n, RAYS_COHERENT, t->hits);
        for (int k = 0; k < n; k++) {
            t->asked[k] = land(t, k, t->asked[k] & (t->hits[k].instance >= 0));
            any         = any || vany(t->asked[k]);
        }
    }
}

/* What of the patch's light would reach the path's beginning, and the ray that is to tell. */
static void connect(path_tracer *t, int k, bool beginning)
{
    const scene *s    = t->s;
    sun_patches *w    = t->patches;
    const vsurface *x = &t->at[k];
    vsurface y;
    vshading shading;
    world_surface(s->world, &w->hit[k], w->drawn[k], &y);
    vvec3 way          = vsub(y.position, x->position);
    vfloat distance    = vlength(way);
    vvec3 wi           = vscale(way, 1.0f / distance);
    w->hit[k].distance = distance;
    vmask active       = w->drawn[k] & (distance > 0.0f);
    scene_shade(s, &w->hit[k], &wi, vsplat(0.0f), active, &y, &shading);
    vfloat to_x   = -vdot(wi, y.normal);
    vfloat to_sun = vabs(vdot(w->to_sun[k], y.normal));
    vvec3 n       = path_horizon(t, k, beginning);
    vmask around  = (n.x == 0.0f) & (n.y == 0.0f) & (n.z == 0.0f);
    active        = active & (to_x > 0.0f) & (around | (vdot(wi, x->normal) > 0.0f));

    /* f(x) c(x) f(y) c(y, w) e, and how it was drawn */
    vfloat pdf;
    vrgb worth = path_worth(t, k, &wi, beginning, active, &pdf);
    vrgb back  = materials_reflect(s->materials, y.material, &shading, &w->to_sun[k], active, NULL);
    vfloat square = density_at(w, w->sun[k], &x->position, &y.position, &w->to_sun[k], active);
    vfloat drawn  = square * to_sun * distance * distance / to_x * (1.0f / (float)w->active_count);
    vfloat count  = power_heuristic(drawn, pdf) / drawn;
    w->found[k]   = vscale(vmul(worth, vmul(back, w->e[k])), count);
    w->patch[k]   = y;
    w->drawn[k]   = active & (drawn > 0.0f) & (vrgb_luminance(w->found[k]) > 0.0f);
    t->rays[k]    = direct_shadow_ray(x, &wi, distance);
    t->asked[k]   = w->drawn[k];
}

/* Traces t->rays, and keeps what passes. */
static void keep_open(path_tracer *t, int n, bool through_solids)
{
    sun_patches *w = t->patches;
    t->ray_count +=
        shadow_trace(t->s, t->rays, t->asked, t->nobody, n, RAYS_INCOHERENT, t->blocked, t->passed);
    for (int k = 0; k < n; k++) {
        vmask open = t->asked[k] & ~t->blocked[k];
        if (t->s->hollow) {
            w->found[k] = vmul(w->found[k], t->passed[k].share);
            open        = through_solids ? open : open & ~t->passed[k].solids;
        }
        w->drawn[k] = open;
    }
}

static void add_found(path_tracer *t, int k)
{
    const scene *s = t->s;
    sun_patches *w = t->patches;
    for (vmask left = w->drawn[k]; vany(left);) {
        int sun;
        vmask same              = vtake_same(w->sun[k], &left, &sun);
        const scene_light *info = &s->light_info[scene_lamp_count(s) + sun];
        path_layer to           = { info->group, info->dimming, true, false };
        path_add(t, k, same, (vmask){ 0 }, vkeep3(same, w->found[k]), &to);
    }
}

/* Whether the path's beginning and the patch see each other is asked before whether the sun sees
 * the patch: of that the answer is mostly yes. */
void path_ask_patches(path_tracer *t, bool beginning)
{
    sun_patches *w = t->patches;
    int n          = packets_of(t);
    for (int k = 0; k < n; k++)
        draw(t, k);
    follow_sunlight(t, n);
    for (int k = 0; k < n; k++)
        connect(t, k, beginning);
    keep_open(t, n, false);
    for (int k = 0; k < n; k++) {
        t->asked[k] = w->drawn[k];
        t->rays[k]  = direct_shadow_ray(&w->patch[k], &w->to_sun[k], vsplat(INFINITY));
    }
    keep_open(t, n, true);
    for (int k = 0; k < n; k++)
        add_found(t, k);
}
