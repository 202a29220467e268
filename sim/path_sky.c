/* sim/path_sky.c -- light of skies that paths find: by asking in directions that are drawn as skies
 * are bright, through portals where there are any, and where their own rays leave the scene. Both
 * ways are mixed by the power heuristic, so that an opening that is no portal costs noise and no
 * light.
 */
#include "core/color.h"
#include "core/warp.h"
#include "sim/path_parts.h"
#include "sim/sensor.h"

/* Of the directions that are asked in: drawn without regard to portals. */
static const float dome_share = 0.125f;

/* Of those at the end of a path: drawn without regard to skies. */
static const float even_share = 0.5f;

/* The density with which draw() draws wi, 1/sr. */
static vfloat sky_pdf(const scene *s, const vvec3 *p, const vvec3 *n, const vvec3 *wi, vmask active)
{
    vfloat open = dome_pdf(s->dome, wi, active);
    if (!s->portals)
        return open;
    return dome_share * open + (1.0f - dome_share) * portals_pdf(s->portals, p, n, wi, active);
}

/* A direction of each lane, with its density; the lanes that have one. */
static vmask draw(const scene *s, const vvec3 *p, const vvec3 *n, const vsample4 *u, vmask active,
                  vvec3 *wi, vfloat *pdf)
{
    *wi = dome_sample(s->dome, u->x, u->y, active, pdf);
    if (!s->portals)
        return active;
    vmask through = active & (u->z >= dome_share);
    vfloat pick = vmin((u->z - dome_share) * (1.0f / (1.0f - dome_share)), vsplat(0x1.fffffep-1f));
    vvec3 other;
    vfloat ignored;
    vmask drawn = portals_sample(s->portals, p, n, pick, u->x, u->y, through, &other, &ignored);
    *wi         = vselect3(through, other, *wi);
    active      = active & (drawn | ~through);
    *pdf        = sky_pdf(s, p, n, wi, active);
    return active & (*pdf > 0.0f);
}

/* What comes along wi of all skies, each where it belongs; `worth` is what that counts. Where a
 * path has not gone on from any surface, nothing reflected counts, but to the eye. */
static void add_skies(path_tracer *t, int k, const vvec3 *wi, vrgb worth, vmask straight,
                      vmask lanes)
{
    const scene *s = t->s;
    vmask below    = lanes & (wi->z < 0.0f);
    for (int i = 0; i < s->sky_count; i++) {
        const scene_sky *of = &s->skies[i];
        vmask here          = of->sky->below ? lanes : lanes & ~below;
        if (of->ground)
            here = t->o->bounce || t->o->eye ? below : (vmask){ 0 };
        if (!vany(here))
            continue;
        vrgb radiance = sky_radiance(of->sky, wi, here);
        path_layer to = { of->group, 1.0f, true, of->ground && !t->o->eye };
        path_add(t, k, here, straight, as_known(vmul(worth, radiance)), &to);
    }
}

/* Where paths end no ray finds what skies have everywhere alike, which domes leave out (dome.h): so
 * in a share of cases the direction is drawn by its cosine there; both ways have one density. */
static vmask draw_at_ends(path_tracer *t, int k, const vsample4 *u, vmask facing)
{
    const vsurface *at = &t->at[k];
    direct_pick *to    = &t->lights[k];
    vmask ends         = t->asks[k] & t->ends[k];
    vmask even         = ends & (u->w < even_share);
    to->wi             = vselect3(even, vwarp_cosine_about(at->normal, u->x, u->y), to->wi);
    vfloat cosine      = vmax(vdot(to->wi, at->normal), vsplat(0.0f));
    vfloat aimed       = sky_pdf(t->s, &at->position, &at->normal, &to->wi, ends);
    vfloat both        = (1.0f - even_share) * aimed + even_share * vwarp_cosine_pdf(cosine);
    to->pdf            = vselect(ends, both, to->pdf);
    return facing | (even & (cosine > 0.0f));
}

static void aim(path_tracer *t, int k, bool beginning)
{
    const vsurface *at = &t->at[k];
    direct_pick *to    = &t->lights[k];
    vsample4 u         = path_numbers(t, k, OF_SKY);
    vvec3 n            = path_horizon(t, k, beginning);
    vmask facing       = draw(t->s, &at->position, &n, &u, t->asks[k], &to->wi, &to->pdf);
    if (!beginning && t->indirect && vany(t->asks[k] & t->ends[k]))
        facing = draw_at_ends(t, k, &u, facing);
    vmask around = (n.x == 0.0f) & (n.y == 0.0f) & (n.z == 0.0f);
    t->asked[k]  = facing & (around | (vdot(to->wi, at->normal) > 0.0f));
    t->rays[k]   = direct_shadow_ray(at, &to->wi, vsplat(INFINITY));
}

/* Light that has come straight through solids is found by nobody else. */
static void take(path_tracer *t, int k, bool beginning)
{
    const direct_pick *l = &t->lights[k];
    vmask lit            = t->asked[k] & ~t->blocked[k];
    vfloat pdf, of_sky = l->pdf;
    if (!vany(lit))
        return;
    vrgb worth   = path_worth(t, k, &l->wi, beginning, lit, &pdf);
    vfloat share = power_heuristic(of_sky, pdf);
    if (has_hollow(t->s)) {
        share = vselect(t->passed[k].solids, vsplat(1.0f), share);
        worth = vmul(worth, t->passed[k].share);
    }
    worth = vkeep3(lit, vscale(worth, share / of_sky));
    add_skies(t, k, &l->wi, worth, beginning ? ALL_LANES : (vmask){ 0 }, lit);
}

void path_ask_sky(path_tracer *t, bool beginning)
{
    int n = packets_of(t);
    for (int k = 0; k < n; k++)
        aim(t, k, beginning);
    t->ray_count +=
        shadow_trace(t->s, t->rays, t->asked, t->nobody, n, RAYS_INCOHERENT, t->blocked, t->passed);
    for (int k = 0; k < n; k++)
        take(t, k, beginning);
}

/* The density with which packet k would have asked, where it was last, in the direction that it
 * took. */
static vfloat asked_pdf(const path_tracer *t, int k, vmask active)
{
    vmask around = state_has(t, k, AROUND);
    if (quantity_is_round(t->o->quantity))
        around = around | ~state_has(t, k, SCATTERED);
    vvec3 p = load3(t, LEFT, k);
    vvec3 n = vselect3(around, (vvec3){ 0 }, load3(t, SIDE, k));
    return sky_pdf(t->s, &p, &n, &t->rays[k].direction, active);
}

void path_add_sky(path_tracer *t)
{
    for (int k = 0; k < packets_of(t); k++) {
        vfloat pdf   = load(t, PDF, k);
        vmask active = t->active[k] & (t->hits[k].instance < 0) & (pdf >= 0.0f);
        if (!vany(active))
            continue;
        vmask asked  = active & (pdf < INFINITY);
        vfloat other = vany(asked) ? asked_pdf(t, k, asked) : (vfloat){ 0 };
        vfloat share = power_heuristic(pdf, vkeep(asked, other)) * first_of(t, k);
        vrgb worth   = vkeep3(active, vscale(worth_of(t, k), share));
        add_skies(t, k, &t->rays[k].direction, worth, ~state_has(t, k, SCATTERED), active);
    }
}
