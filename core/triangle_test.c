/* core/triangle_test.c -- see triangle_test.h: what is rare, or done once a triangle. */
#include "core/triangle_test.h"

/* The sign of p x q, corners as the ray sees them, given its value; of the ray moved aside by
 * (e, e^2) where that is 0: (p - m) x (q - m) = p x q + e (py - qy) + e^2 (qx - px). */
static int edge_sign(double cross, double px, double py, double qx, double qy)
{
    double by = cross != 0.0 ? cross : py != qy ? py - qy : qx - px;
    return (by > 0.0) - (by < 0.0);
}

static vmask through_edges(const vedges *e, vfloat sz, vmask which, vmeet *m)
{
    float t[LANES], u[LANES], v[LANES];
    vmask in = ~ALL_LANES;
    for (int i = 0; i < LANES; i++) {
        t[i] = lane(m->t, i), u[i] = lane(m->u, i), v[i] = lane(m->v, i);
        if (!(vbits(which) >> i & 1))
            continue;
        double ax = (double)lane(e->ax, i), ay = (double)lane(e->ay, i);
        double bx = (double)lane(e->bx, i), by = (double)lane(e->by, i);
        double cx = (double)lane(e->cx, i), cy = (double)lane(e->cy, i);

        double fu  = cx * by - cy * bx;
        double fv  = ax * cy - ay * cx;
        double fw  = bx * ay - by * ax;
        double det = fu + fv + fw;
        int su     = edge_sign(fu, cx, cy, bx, by);
        int sv     = edge_sign(fv, ax, ay, cx, cy);
        int sw     = edge_sign(fw, bx, by, ax, ay);
        if (det == 0.0 || su != sv || sv != sw)
            continue;

        double along =
            fu * (double)lane(e->az, i) + fv * (double)lane(e->bz, i) + fw * (double)lane(e->cz, i);
        t[i] = (float)(along * (double)lane(sz, i) / det);
        u[i] = (float)(fv / det);
        v[i] = (float)(fw / det);
        in |= vlane_index() == i;
    }
    *m = (vmeet){ vload(t), vload(u), vload(v) };
    return in & which;
}

/* In double precision: the distances that single precision leaves open. */
static vfloat near_exact(const vshear *r, const vcorners *p, vmask which, vfloat single)
{
    float t[LANES];
    vstore(t, single);
    for (unsigned left = (unsigned)vbits(which); left; left &= left - 1) {
        int i = __builtin_ctz(left);
        double a[3], b[3], c[3]; /* corner 0 from the origin; edges from it */
        for (int k = 0; k < 3; k++) {
            a[k] = (double)lane(p->a[k], i) - (double)lane(r->o[k], i);
            b[k] = (double)lane(p->b[k], i) - (double)lane(p->a[k], i);
            c[k] = (double)lane(p->c[k], i) - (double)lane(p->a[k], i);
        }
        double nx = b[1] * c[2] - b[2] * c[1];
        double ny = b[2] * c[0] - b[0] * c[2];
        double nz = b[0] * c[1] - b[1] * c[0];
        double to = nx * a[0] + ny * a[1] + nz * a[2];
        double on = nx * (double)lane(r->s[0], i) + ny * (double)lane(r->s[1], i) + nz;
        t[i]      = (float)(to / on * (double)lane(r->s[2], i));
    }
    return vload(t);
}

/* Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric
 * Predicates", 1997, table 9: how far the product of three differences may be off. */
static const float orient_error = 8 * 0x1p-24f;

static void near_plane(const vshear *r, const vcorners *p, vmask which, vmeet *m)
{
    vvec3 a = { p->a[0] - r->o[0], p->a[1] - r->o[1], p->a[2] - r->o[2] };
    vvec3 b = { p->b[0] - p->a[0], p->b[1] - p->a[1], p->b[2] - p->a[2] };
    vvec3 c = { p->c[0] - p->a[0], p->c[1] - p->a[1], p->c[2] - p->a[2] };
    vvec3 n = { b.y * c.z - b.z * c.y, b.z * c.x - b.x * c.z, b.x * c.y - b.y * c.x };

    vvec3 size   = { vabs(b.y * c.z) + vabs(b.z * c.y), vabs(b.z * c.x) + vabs(b.x * c.z),
                     vabs(b.x * c.y) + vabs(b.y * c.x) };
    vfloat error = orient_error * (size.x * vabs(a.x) + size.y * vabs(a.y) + size.z * vabs(a.z));
    vfloat to    = vdot(n, a);
    vfloat on    = n.x * r->s[0] + n.y * r->s[1] + n.z;
    vfloat t     = to / on * r->s[2];
    vmask open   = which & ~(vabs(to) > error);
    if (vany(open))
        t = near_exact(r, p, open, t);
    m->t = vselect(which, t, m->t);
}

/* Whether t may be off by as much as it is. Of 2^-24: x by 2 x + 4 z, y likewise; so u, v, w by
 * 12 x y + 8 z (x + y); each counts with a z, and 5 roundings of all come on top. */
static vmask uncertain(const vshear *r, const vedges *e, const vmeet *m)
{
    vfloat det = vabs(e->u + e->v + e->w);
    vfloat x   = vmax(vabs(e->ax), vmax(vabs(e->bx), vabs(e->cx)));
    vfloat y   = vmax(vabs(e->ay), vmax(vabs(e->by), vabs(e->cy)));
    vfloat z   = vmax(vabs(e->az), vmax(vabs(e->bz), vabs(e->cz)));
    vfloat off = 36.0f * x * y + 24.0f * z * (x + y) + 5.0f * det;
    return ~(vabs(m->t) * det > 0x1p-24f * z * off * vabs(r->s[2]));
}

vmask watertight_rare(const vshear *r, const vcorners *p, vmask lanes, vmeet *m)
{
    vmask rare;
    vedges e    = vedges_of(r, p);
    vmask in    = watertight_line(r, p, lanes, m, &rare);
    vmask edges = in & ((e.u == 0.0f) | (e.v == 0.0f) | (e.w == 0.0f));
    if (vany(edges))
        in = (in & ~edges) | through_edges(&e, r->s[2], edges, m);
    vmask near = in & (vabs(m->t) < r->near) & (edges | uncertain(r, &e, m));
    if (vany(near))
        near_plane(r, p, near, m);
    return in;
}

void projection_make(const float *p, projection *out)
{
    double a[3], b[3], n[3]; /* edges to corners 1 and 2, and across both */
    for (int k = 0; k < 3; k++) {
        a[k] = (double)p[3 + k] - (double)p[k];
        b[k] = (double)p[6 + k] - (double)p[k];
    }
    for (int k = 0; k < 3; k++)
        n[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
    int k = fabs(n[0]) > fabs(n[1]) ? 0 : 1;
    k     = fabs(n[2]) > fabs(n[k]) ? 2 : k;
    int u = (k + 1) % 3, v = (k + 2) % 3;

    /* h = H - corner 0 in (u, v): the weights are (h x b) / (a x b) and (a x h) / (a x b) */
    double pu = (double)p[u], pv = (double)p[v], s = 1.0 / n[k];
    *out = (projection){
        .n_u = (float)(n[u] * s),
        .n_v = (float)(n[v] * s),
        .n_d = (float)((double)p[k] + (n[u] * pu + n[v] * pv) * s),
        .k   = k,
        .b_u = (float)(b[v] * s),
        .b_v = (float)(-b[u] * s),
        .b_d = (float)((pv * b[u] - pu * b[v]) * s),
        .c_u = (float)(-a[v] * s),
        .c_v = (float)(a[u] * s),
        .c_d = (float)((pu * a[v] - pv * a[u]) * s),
    };
}
