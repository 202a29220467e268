/* lights/opening.h -- the luminous opening of a luminaire: places on it, and what rays meet of it.
 *
 * Light that goes in direction w is spread evenly over the opening's area as seen along w, A(w):
 *
 *     radiance L(w) = I(w) / A(w),    so that far away the intensity is I(w), whatever the shape
 *
 * A flat opening is the limit of a flattened solid: each of its elements sends I(w) dA / A to both
 * sides, whatever I is there. All shapes are convex and mirror themselves in three planes: they
 * are looked at from a point q >= 0 along their own axes, into which luminaire.c folds all others.
 */
#ifndef LIGHTS_OPENING_H
#define LIGHTS_OPENING_H

#include "core/warp.h"
#include "lights/photometry.h"

typedef struct opening opening;

/* A place of the opening, for the point q of each lane. */
typedef struct vopening_place {
    vvec3 to;         /* m, from q to the place */
    vfloat projected; /* m^2, A(w); 0 for a line */
    vfloat spread;    /* m^2/sr, pdf A(w): I / spread is what a place that was drawn gives, and
                         spread / projected the density with which it is drawn, 1/sr */
} vopening_place;

typedef struct opening_type {
    /* Draws a place seen from q by even (s, t); the lanes that have one. */
    vmask (*draw)(const opening *o, const vvec3 *q, vfloat s, vfloat t, vmask active,
                  vopening_place *out);

    /* The place that the ray from q along the unit vector w meets first. NULL: a line. */
    vmask (*meet)(const opening *o, const vvec3 *q, const vvec3 *w, vmask active,
                  vopening_place *out);

    /* m^2, A(w). NULL: a line. */
    vfloat (*projected)(const opening *o, const vvec3 *w);

    /* The place from which light leaves along the unit vector w >= 0, from the centre: (s, t) are
     * even over what is seen against w. */
    vvec3 (*leave)(const opening *o, const vvec3 *w, vfloat s, vfloat t);
} opening_type;

struct opening {
    const opening_type *type; /* NULL: a point */
    int axis[3];              /* own axes x, y, z: 0 the length's, 1 the width's, 2 the height's */
    vec3 half;                /* m, half sizes along the own axes; 0: none */
    float radius;             /* m, from the centre to the farthest corner of the box around it */
    float area;               /* m^2, seen along the direction from which most of it is seen, */
    float least_area;         /* m^2, and from which least */
    bool flat;                /* a plane figure, across its own axis z, or a line */
    float mean1;       /* m, if flat: at least the mean distance of its places from the centre, */
    float mean2;       /* m^2, its mean square, */
    float mean2_along; /* m^2, and the mean square along the axis where it is greatest */
};

extern const opening_type opening_line, opening_box, opening_cylinder, opening_ellipsoid;

/* The opening of p; sizes below 10 um are none. */
opening opening_of(const photometry *p);

/* How a place is drawn: in the share `by_area` of cases even over what is seen along q, by the
 * projected area; else by a direction that is even in a hemisphere which holds all of the opening.
 * The former alone gives weights up to I / least^2, `least` being the distance to the box around
 * the opening, the latter up to 2 pi I / A, which is large for what is seen edge on. Where the
 * former is more both are mixed, the more by direction the nearer, but never without places by
 * area, which keep the edge-on part in check. seen: m^3, |q| times the area seen along q. */
static inline vfloat vopening_by_area(vvec3 beyond, vvec3 q, vfloat seen)
{
    vvec3 least  = { vmax(beyond.x, vsplat(0.0f)), vmax(beyond.y, vsplat(0.0f)),
                     vmax(beyond.z, vsplat(0.0f)) };
    vfloat ratio = 6.2831853f * vdot(least, least) * vlength(q) / seen;
    return vselect(ratio < 1.0f, vmax(0.5f * ratio, vsplat(0.125f)), vsplat(1.0f));
}

/* Which way this (s, t) draws, and s made even again, below 1. */
static inline vmask vopening_pick(vfloat by_area, vfloat *s)
{
    vmask area   = *s < by_area;
    vfloat place = *s / by_area;
    vfloat ray   = (*s - by_area) / (1.0f - by_area);
    *s           = vmin(vselect(area, place, ray), vsplat(0x1.fffffep-1f));
    return area;
}

/* pdf A(w) of a place with normal n: `ratio` is (n . q) / (n . (q - place)), d^2 = |to|^2. A place
 * is drawn by area with the density (n . q) / seen per area, which is that times d^2 / cos per
 * solid angle, cos = n . (q - place) / d. */
static inline vfloat vopening_spread(vfloat by_area, vfloat projected, vfloat ratio, vfloat seen,
                                     vfloat dist2)
{
    vfloat area = by_area * ratio * (projected * dist2 * vsqrt(dist2) / seen);
    return area + (1.0f - by_area) * projected * (1.0f / 6.2831853f);
}

/* A direction, even in the hemisphere about the unit vector n: from the whole sphere, what lies
 * on the other side mirrored. */
static inline vvec3 vopening_hemisphere(vvec3 n, vfloat s, vfloat t)
{
    vvec3 w      = vwarp_sphere(s, t);
    vfloat below = vmax(-vdot(w, n), vsplat(0.0f));
    return vadd(w, vscale(n, 2.0f * below));
}

#endif
