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
