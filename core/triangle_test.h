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

/* Corners as the ray sees them. */
typedef struct vedges {
    vfloat ax, ay, az, bx, by, bz, cx, cy, cz;
} vedges;

/* What is rare: rays through edges, and hits near 0. The lanes of `which` that meet their
 * triangle, with what *m gets for these. */
vmask watertight_edge(const vedges *e, vfloat sz, vmask which, vmeet *m);
void watertight_near(const vshear *r, const vcorners *p, vmask which, vmeet *m);

/* The lanes of active that meet their triangle at 0 < t <= most < INFINITY. *m is of use in
 * those alone. */
static inline __attribute__((always_inline)) vmask
watertight_test(const vshear *r, const vcorners *p, vmask active, vfloat most, vmeet *m)
{
    vfloat az = p->a[2] - r->o[2];
    vfloat bz = p->b[2] - r->o[2];
    vfloat cz = p->c[2] - r->o[2];
    vfloat ax = (p->a[0] - r->o[0]) - r->s[0] * az;
    vfloat ay = (p->a[1] - r->o[1]) - r->s[1] * az;
    vfloat bx = (p->b[0] - r->o[0]) - r->s[0] * bz;
    vfloat by = (p->b[1] - r->o[1]) - r->s[1] * bz;
    vfloat cx = (p->c[0] - r->o[0]) - r->s[0] * cz;
    vfloat cy = (p->c[1] - r->o[1]) - r->s[1] * cz;

    vfloat u = cx * by - cy * bx;
    vfloat v = ax * cy - ay * cx;
    vfloat w = bx * ay - by * ax;

    /* NaN goes past here, and on to t */
    vmask below = vmin(vmin(u, v), w) < 0.0f;
    vmask above = vmax(vmax(u, v), w) > 0.0f;
    vmask in    = active & ~(below & above);
    if (!vany(in))
        return in;

    vfloat det  = u + v + w;
    m->t        = (u * az + v * bz + w * cz) * r->s[2] / det;
    m->u        = v / det;
    m->v        = w / det;
    vmask edges = in & ((u == 0.0f) | (v == 0.0f) | (w == 0.0f));
    vmask near  = in & (vabs(m->t) < r->near);
    if (__builtin_expect(vany(near), 0)) {
        /* How far t may be off. Of 2^-24: x by 2 x + 4 z, y likewise; so u, v, w by 12 x y +
         * 8 z (x + y); each counts with a z, and 5 roundings of all come on top. */
        vfloat x   = vmax(vabs(ax), vmax(vabs(bx), vabs(cx)));
        vfloat y   = vmax(vabs(ay), vmax(vabs(by), vabs(cy)));
        vfloat z   = vmax(vabs(az), vmax(vabs(bz), vabs(cz)));
        vfloat off = 36.0f * x * y + 24.0f * z * (x + y) + 5.0f * vabs(det);
        off        = 0x1p-24f * z * off * vabs(r->s[2]);
        near &= ~(vabs(m->t * det) > off);
    }
    if (__builtin_expect(vany(edges | near), 0)) {
        vedges e    = { ax, ay, az, bx, by, bz, cx, cy, cz };
        vcorners at = *p;
        vmeet on    = *m;
        in          = (in & ~edges) | watertight_edge(&e, r->s[2], edges, &on);
        watertight_near(r, &at, near | (edges & in & (vabs(on.t) < r->near)), &on);
        *m = on;
    }
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
projection_test(const vaxes *r, const vprojection *p, vmask active, vfloat most, vmeet *m)
{
    m->t = (p->n_d - r->o[0] - p->n_u * r->o[1] - p->n_v * r->o[2]) /
           (r->d[0] + p->n_u * r->d[1] + p->n_v * r->d[2]);
    vmask in  = active & (m->t > 0.0f) & (m->t <= most);
    vfloat hu = r->o[1] + m->t * r->d[1];
    vfloat hv = r->o[2] + m->t * r->d[2];
    m->u      = hu * p->b_u + hv * p->b_v + p->b_d;
    m->v      = hu * p->c_u + hv * p->c_v + p->c_d;
    return in & (m->u >= 0.0f) & (m->v >= 0.0f) & (m->u + m->v <= 1.0f);
}

#endif
