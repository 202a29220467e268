/* core/triangle_test.h -- a ray against a triangle, per lane: rays, triangles, or both differ.
 *
 * Watertight: Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013.
 * The corners are moved to the ray's origin and sheared so that the ray runs along one axis.
 * An edge's function is a difference of two products: it never gets the wrong sign by rounding,
 * but may become 0. It is then done in double precision, where both products are exact; and
 * where it is exactly 0, the ray is thought of as moved by (e, e^2), e -> 0, across its
 * direction. So exactly one of the triangles around an edge or vertex of a surface is met.
 *
 * Distances come with the errors of the sheared corners, times how thin the triangle is: for
 * those that are close to 0, where the error would decide whether a ray meets the surface that
 * it leaves, they are computed anew, in double precision from the plane.
 *
 * Projection: Wald, "Realtime Ray Tracing and Interactive Global Illumination", 2004, 7.1.
 */
#ifndef CORE_TRIANGLE_TEST_H
#define CORE_TRIANGLE_TEST_H

#include "core/trace.h"

/* A ray for the watertight test: the axes are turned so that z is that of its largest
 * component, and x and y come behind it. */
typedef struct vshear {
    vfloat o[3]; /* origin */
    vfloat s[3]; /* dx / dz, dy / dz, 1 / dz */
    vfloat near; /* distances below are computed anew; see shear_near */
} vshear;

/* A thousandth of the mesh (whose largest coordinate is given), in units of the distance. */
static inline vfloat shear_near(vfloat s2, float largest) { return 0x1p-10f * largest * vabs(s2); }

/* Corners, each as x, y, z of the turned axes. */
typedef struct vcorners {
    vfloat a[3], b[3], c[3];
} vcorners;

typedef struct vmeet {
    vfloat t, u, v;
} vmeet;

/* Corners as the ray sees them, and the edges' functions. */
typedef struct vedges {
    vfloat ax, ay, az, bx, by, bz, cx, cy, cz, u, v, w;
} vedges;

static inline __attribute__((always_inline)) vedges vedges_of(const vshear *r, const vcorners *p)
{
    vedges e;
    e.az = p->a[2] - r->o[2];
    e.bz = p->b[2] - r->o[2];
    e.cz = p->c[2] - r->o[2];
    e.ax = (p->a[0] - r->o[0]) - r->s[0] * e.az;
    e.ay = (p->a[1] - r->o[1]) - r->s[1] * e.az;
    e.bx = (p->b[0] - r->o[0]) - r->s[0] * e.bz;
    e.by = (p->b[1] - r->o[1]) - r->s[1] * e.bz;
    e.cx = (p->c[0] - r->o[0]) - r->s[0] * e.cz;
    e.cy = (p->c[1] - r->o[1]) - r->s[1] * e.cz;

    e.u = e.cx * e.by - e.cy * e.bx;
    e.v = e.ax * e.cy - e.ay * e.cx;
    e.w = e.bx * e.ay - e.by * e.ax;
    return e;
}

/* The lanes of active in whose triangle the ray's line lies; *m is of use in those alone. What
 * is rare, lines through edges and distances near 0, is in *rare: for these lanes
 * watertight_rare() has the last word. */
static inline __attribute__((always_inline)) vmask
watertight_line(const vshear *r, const vcorners *p, vmask active, vmeet *m, vmask *rare)
{
    vedges e = vedges_of(r, p);

    /* NaN goes past here, and on to t */
    vmask below = vmin(vmin(e.u, e.v), e.w) < 0.0f;
    vmask above = vmax(vmax(e.u, e.v), e.w) > 0.0f;
    vmask in    = active & ~(below & above);
    *rare       = ~ALL_LANES;
    if (!vany(in))
        return in;

    vfloat det = e.u + e.v + e.w;
    m->t       = (e.u * e.az + e.v * e.bz + e.w * e.cz) * r->s[2] / det;
    m->u       = e.v / det;
    m->v       = e.w / det;
    *rare      = in & ((e.u == 0.0f) | (e.v == 0.0f) | (e.w == 0.0f) | (vabs(m->t) < r->near));
    return in;
}

/* All of `lanes` anew: those in whose triangle the line lies. It takes no part in the usual
 * course of things, and so none of its registers. */
vmask watertight_rare(const vshear *r, const vcorners *p, vmask lanes, vmeet *m);

/* The lanes of `in` whose ray meets the triangle at 0 < t <= most < INFINITY. */
static inline vmask meet_within(const vmeet *m, vmask in, vfloat most)
{
    return in & (m->t > 0.0f) & (m->t <= most);
}

/* A ray for the projection test: o and d at the axes k, k + 1, k + 2 of the triangle. */
typedef struct vaxes {
    vfloat o[3], d[3];
} vaxes;

typedef struct vprojection {
    vfloat n_u, n_v, n_d, b_u, b_v, b_d, c_u, c_v, c_d;
} vprojection;

static inline __attribute__((always_inline)) vmask
projection_line(const vaxes *r, const vprojection *p, vmask active, vmeet *m)
{
    m->t = (p->n_d - r->o[0] - p->n_u * r->o[1] - p->n_v * r->o[2]) /
           (r->d[0] + p->n_u * r->d[1] + p->n_v * r->d[2]);
    vfloat hu = r->o[1] + m->t * r->d[1];
    vfloat hv = r->o[2] + m->t * r->d[2];
    m->u      = hu * p->b_u + hv * p->b_v + p->b_d;
    m->v      = hu * p->c_u + hv * p->c_v + p->c_d;
    return active & (m->u >= 0.0f) & (m->v >= 0.0f) & (m->u + m->v <= 1.0f);
}

#endif
