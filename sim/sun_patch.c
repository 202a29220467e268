/* sim/sun_patch.c -- see sun_patch.h: points given out. */
#include "sim/sun_patch_parts.h"

int sun_patch_suns(const sun_patches *w) { return w->sun_count; }
int sun_patch_sun(const sun_patches *w, int i) { return w->suns[i]; }
bool sun_patches_matt(const sun_patches *w) { return w->matt; }

/* How often portal j is drawn at x, beside the others. */
static vfloat weight_of(const sun_patches *w, int sun, int j, const vvec3 *x)
{
    vvec3 to = vsub(vspread(w->s->portal_list[j].centre), *x);
    return w->lit[sun * w->portals + j] / (vdot(to, to) + w->area[j]);
}

/* Three numbers of a row, and the fourth. */
static vvec3 load_row(const patch_lots *l, vint point, int row, vfloat *more)
{
    vfloat of[4];
    vgather4(l->rows, point * l->row_count + row, of);
    *more = of[3];
    return (vvec3){ of[0], of[1], of[2] };
}

/* Which portal, with what probability. */
static vint draw_portal(const sun_patches *w, int sun, const vvec3 *x, vfloat u, vmask active,
                        vfloat *chance)
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
    *chance = share / total;
    return drawn;
}

vmask sun_patch_draw(const sun_patches *w, patch_generation which, int sun, vint set,
                     const vvec3 *x, vfloat u, vfloat v, vmask active, patch_point *out)
{
    const patch_lots *l = which == PATCH_FIRST ? &w->first : &w->second;
    vfloat chance;
    vint which_portal = draw_portal(w, sun, x, u, active, &chance);
    vint pair         = vkeep_int(which_portal >= 0, sun * w->portals + which_portal);
    vint lot          = pair * SCRAMBLES + set;
    vint kept         = vgather_int(l->kept, vkeep_int(active, lot));
    vmask drawn       = active & (which_portal >= 0) & (kept > 0);
    vint at           = vkeep_int(drawn, lot * w->cast + vto_int(v * vto_float(kept)));

    vfloat none;
    out->at.position = load_row(l, at, PLACE_ROW, &out->drawn);
    out->at.normal   = load_row(l, at, NORMAL_ROW, &out->patch_cos);
    out->before      = load_row(l, at, BEFORE_ROW, &out->patch_thin);
    out->light       = load_row(l, at, LIGHT_ROW, &none);
    if (!w->matt) {
        vfloat weight;
        vvec3 hit = load_row(l, at, HIT_ROW, &weight);
        out->hit  = (vhit){
             .instance = vas_int(hit.x), .triangle = vas_int(hit.y), .u = hit.z, .v = weight
        };
    }
    out->area = vgather(w->facing, pair) * vto_float(kept) * (1.0f / (float)w->cast) / chance;
    out->part = chance / vgather(w->lit, pair);
    if (which == PATCH_SECOND) {
        out->patch  = load_row(l, at, PATCH_ROW, &none);
        out->to_sun = load_row(l, at, SUN_ROW, &none);
    }
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
                                  weight * (1.0f / w->lit[sun * w->portals + j]));
    }
    return vkeep(active & (total > 0.0f), density / total);
}
