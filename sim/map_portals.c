/* sim/map_portals.c -- see map_parts.h: particles outside that are sent on toward portals.
 *
 * Of the light that surfaces outside give on a hundredth or less comes in by a window; drawn as
 * they reflect alone, a room gets few of their particles, each of which carries a lot. So where a
 * particle stands before a portal it goes on toward one in a share a of cases; with f what the
 * surface gives on, p_f and p_a the densities of both ways it is worth
 *
 *     f cos / ((1 - a) p_f + a p_a)
 *
 * whichever way it was drawn (Veach and Guibas, SIGGRAPH 1995: the balance heuristic of one
 * sample). Of portals with area A, r from the place p, one is drawn in proportion to
 * about the light that it gets from there, A cos_p cos_c / (r^2 + A / 2), then an even place on it.
 */
#include "sim/map_parts.h"

static const float aimed_share = 0.25f; /* a */

static float area_of(const portal *q) { return 4.0f * v3_length(q->u) * v3_length(q->v); }

/* From p to the place on the portal that is nearest. */
static vvec3 way_to(const portal *q, const vvec3 *p)
{
    vvec3 to = vsub(vspread(q->centre), *p), u = vspread(q->u), v = vspread(q->v);
    vfloat s = -vdot(to, u) / vdot(u, u), t = -vdot(to, v) / vdot(v, v);
    vvec3 at = vadd(vscale(u, vmin(vmax(s, vsplat(-1.0f)), vsplat(1.0f))),
                    vscale(v, vmin(vmax(t, vsplat(-1.0f)), vsplat(1.0f))));
    return vadd(to, at);
}

/* What portal i is drawn in proportion to: 0 from behind it, and where it is below the horizon. */
static vfloat chance_of(const portal *q, const vvec3 *p, const vvec3 *n)
{
    float area     = area_of(q);
    vvec3 to       = vsub(vspread(q->centre), *p);
    vvec3 way      = way_to(q, p);
    vfloat across  = vabs(vdot(*n, vspread(q->u))) + vabs(vdot(*n, vspread(q->v)));
    vfloat highest = vdot(*n, to) + across; /* of its corners */
    vfloat before  = -vdot(to, vspread(q->outward));
    vfloat d2      = vdot(way, way);
    vfloat cos_c   = vmin(before / vsqrt(d2), vsplat(1.0f));
    vfloat cos_p   = vmin(highest / vsqrt(vdot(to, to)), vsplat(1.0f));
    vmask faces    = (before > 0.0f) & (highest > 0.0f);
    return vkeep(faces, area * cos_c * cos_p / (d2 + 0.5f * area));
}

static vfloat sum_of_chances(const scene *s, const vvec3 *p, const vvec3 *n)
{
    vfloat sum = vsplat(0.0f);
    for (int i = 0; i < s->portal_count; i++)
        sum = sum + chance_of(&s->portal_list[i], p, n);
    return sum;
}

/* An even place on the portal that pick draws. */
static vvec3 place_on_portal(const scene *s, const vvec3 *p, const vvec3 *n, vfloat at,
                             const vfloat st[2])
{
    vfloat before = vsplat(0.0f);
    vvec3 place   = *p;
    for (int i = 0; i < s->portal_count; i++) {
        const portal *q = &s->portal_list[i];
        vfloat chance   = chance_of(q, p, n);
        vmask taken     = (chance > 0.0f) & (before <= at);
        place           = vselect3(taken, portal_place(q, st[0], st[1]), place);
        before          = before + chance;
    }
    return place;
}

/* p_a */
static vfloat density(const scene *s, const vvec3 *p, const vvec3 *n, const vvec3 *wi, vfloat sum)
{
    vfloat of = vsplat(0.0f);
    for (int i = 0; i < s->portal_count; i++) {
        const portal *q = &s->portal_list[i];
        vfloat chance   = chance_of(q, p, n);
        vvec3 out       = vspread(q->outward);
        vvec3 to        = vsub(vspread(q->centre), *p);
        vfloat cosine   = -vdot(*wi, out);
        vfloat far      = -vdot(to, out) / cosine;
        vvec3 at        = vsub(vscale(*wi, far), to);
        vmask through   = (chance > 0.0f) & (cosine > 0.0f) & portal_covers(q, &at);
        of              = of + vkeep(through, chance * far * far / (cosine * area_of(q)));
    }
    return vkeep(sum > 0.0f, of / sum);
}

vmask map_toward_portals(const scene *s, const vsurface *at, const vshading *h, const vsample4 *u,
                         vmask active, vmask goes, vscatter *next, vfloat *rarer)
{
    const vvec3 *p = &at->position, *n = &h->n;
    vfloat sum   = sum_of_chances(s, p, n);
    vmask before = active & (sum > 0.0f);
    *rarer       = vsplat(1.0f);
    if (!vany(before))
        return goes;
    vmask aimed    = before & (u->x < aimed_share);
    vfloat pick    = vmin(u->x * (1.0f / aimed_share), vsplat(0x1.fffffep-1f));
    vfloat st[2]   = { u->y, u->z };
    vvec3 to       = vsub(place_on_portal(s, p, n, pick * sum, st), *p);
    vfloat length2 = vdot(to, to);
    goes           = (goes & ~aimed) | (aimed & (length2 > 0.0f));
    next->wi       = vselect3(aimed, vscale(to, 1.0f / vsqrt(length2)), next->wi);
    next->straight = next->straight & ~aimed;
    next->bent     = next->bent & ~aimed;

    /* What it is worth; along single directions it has not been aimed */
    vmask single = goes & ~aimed & (next->straight | (next->pdf == INFINITY));
    vmask drawn  = before & goes & ~single;
    vfloat p_f;
    vrgb f_cos   = materials_reflect(s->materials, at->material, h, &next->wi, drawn, &p_f);
    vfloat both  = (1.0f - aimed_share) * p_f + aimed_share * density(s, p, n, &next->wi, sum);
    vfloat once  = vsplat(1.0f / (1.0f - aimed_share));
    next->weight = vselect3(drawn, vscale(f_cos, 1.0f / both), next->weight);
    next->weight = vselect3(before & single, vscale(next->weight, once), next->weight);
    next->pdf    = vselect(drawn, both, next->pdf);
    *rarer       = vselect(drawn, vmin(p_f / both, *rarer), *rarer);
    return goes & ~(drawn & ~(p_f > 0.0f));
}

vfloat map_portal_share(const scene *s, const vsurface *at, const vshading *h, vmask active)
{
    vfloat sum  = sum_of_chances(s, &at->position, &h->n);
    vrgb albedo = materials_albedo(s->materials, at->material, h, active & (sum > 0.0f));
    vfloat most = vmax(albedo.x, vmax(albedo.y, albedo.z));
    return most * sum * (0.318309886f / aimed_share);
}
