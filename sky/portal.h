/* sky/portal.h -- drawing directions through openings, as the sky behind them is bright.
 *
 * Portals are rectangles through which outside light comes into a room. Seen from a point, a
 * portal is a rectangle in the two angles to its sides; a table of the sky in these angles, summed
 * along both, gives the light that comes through it from there, and directions drawn in
 * proportion to luminance (Bitterli, Novak and Jarosz, "Portal-Masked Environment Map Sampling",
 * EGSR 2015). One portal is drawn of all, in proportion to about what each gives the surface.
 *
 * Light goes in against a portal's normal: points on its outer side get none through it.
 * Immutable once made: any thread may ask. Lanes outside `active` come back zero.
 */
#ifndef SKY_PORTAL_H
#define SKY_PORTAL_H

#include "core/packet.h"
#include "sky/sky.h"

typedef struct portal {
    vec3 centre;  /* m */
    vec3 u, v;    /* m: from the centre to the middles of two sides; square to each other; > 0 */
    vec3 outward; /* unit: u x v or its reverse */
} portal;

/* The place on it at (s, t) in [0,1)^2: even on it as these are. */
static inline vvec3 portal_place(const portal *q, vfloat s, vfloat t)
{
    vvec3 along =
        vadd(vscale(vspread(q->u), 2.0f * s - 1.0f), vscale(vspread(q->v), 2.0f * t - 1.0f));
    return vadd(vspread(q->centre), along);
}

/* Whether a place of its plane, from its centre, is on it. */
static inline vmask portal_covers(const portal *q, const vvec3 *at)
{
    vvec3 u = vspread(q->u), v = vspread(q->v);
    return (vabs(vdot(*at, u)) <= vdot(u, u)) & (vabs(vdot(*at, v)) <= vdot(v, v));
}

typedef struct portals portals;

/* count >= 1 portals, under the mean luminance of skies (as dome_new; a uniform one, if that is 0
 * everywhere). NULL, with *err, without memory. */
const portals *portals_new(arena *a, const portal *list, int count, const sky *const *skies,
                           int sky_count, lux_error *err);

/* A direction through one of them from p; n: of the surface there, unit, or 0 where light from all
 * around counts. (s, t) in [0,1)^2, pick in [0,1). The lanes that could draw one; in *pdf the
 * density of portals_pdf() there, 1/sr, > 0 and finite. */
vmask portals_sample(const portals *all, const vvec3 *p, const vvec3 *n, vfloat pick, vfloat s,
                     vfloat t, vmask active, vvec3 *wi, vfloat *pdf);

/* The density with which portals_sample() draws wi, through whichever of them, 1/sr; 0 where it
 * goes through none. */
vfloat portals_pdf(const portals *all, const vvec3 *p, const vvec3 *n, const vvec3 *wi,
                   vmask active);

/* Which lanes' rays from p along wi go out through some portal. */
vmask portals_cross(const portals *all, const vvec3 *p, const vvec3 *wi, vmask active);

#endif
