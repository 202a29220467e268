/* lights/light.c -- what all lights share: see light.h. */
#include "lights/light.h"

vfloat vlight_power_bound(const light_bounds *b, const vvec3 *p, vmask active)
{
    if (b->far)
        return vkeep(active, vsplat(b->peak));

    /* The nearest place of the box */
    vvec3 low   = vspread(b->low);
    vvec3 high  = vspread(b->high);
    vvec3 near_ = { vmin(vmax(p->x, low.x), high.x), vmin(vmax(p->y, low.y), high.y),
                    vmin(vmax(p->z, low.z), high.z) };
    vvec3 off   = vsub(near_, *p);
    return vkeep(active, b->peak / vdot(off, off));
}

vmask vlight_is_whole(const light_bounds *b, const vvec3 *p, const vvec3 *n, vmask active)
{
    if (b->far)
        return active;

    /* How far the middle of the box is off the horizon, and how far its corners reach toward it */
    vvec3 low    = vsub(vspread(b->low), *p);
    vvec3 high   = vsub(vspread(b->high), *p);
    vfloat off   = vdot(*n, vadd(low, high));
    vfloat reach = vabs(n->x) * (high.x - low.x) + vabs(n->y) * (high.y - low.y) +
                   vabs(n->z) * (high.z - low.z);
    return active & (vabs(off) >= reach);
}
