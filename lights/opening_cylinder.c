/* lights/opening_cylinder.c -- an opening that is an elliptic cylinder about its axis z, or with no
 * half.z an ellipse.
 *
 *     A(w) = pi a b |w_z| + 4 half_z sqrt(b^2 w_x^2 + a^2 w_y^2),    a = half_x, b = half_y
 *
 * The side is (a cos f, b sin f, z). With (q_x / a, q_y / b) = Q (cos f0, sin f0) its place f has
 *
 *     (n . q) dA = a b Q cos(f - f0) df dz,    n . (q - place) dA = a b (Q cos(f - f0) - 1) df dz
 *
 * and is seen where the latter is above 0: places are even in sin(f - f0) between +-sqrt(1 -
 * 1/Q^2).
 */
#include "lights/opening.h"

typedef struct vcylinder_view {
    vvec3 q;             /* m */
    vfloat big_q;        /* Q */
    vfloat cos_0, sin_0; /* of f0 */
    vfloat sin_edge;     /* of f - f0, where the side is no longer seen */
    vfloat above;        /* m, the plane of the cap */
    vfloat cap, side;    /* m^3, |q| times the area seen along q; 0 where it is not */
    vfloat sum, by_area;
} vcylinder_view;

static const float OFF_PLANE = 1e-12f; /* m, as of a rectangle: opening_box.c */

static vcylinder_view look(const opening *o, const vvec3 *q)
{
    float a = o->half.x, b = o->half.y;
    vcylinder_view v = { .q = *q };
    if (o->half.z == 0.0f)
        v.q.z = vmax(v.q.z, vsplat(OFF_PLANE));
    vfloat x   = v.q.x / a;
    vfloat y   = v.q.y / b;
    v.big_q    = vsqrt(x * x + y * y);
    v.cos_0    = vselect(v.big_q > 0.0f, x / v.big_q, vsplat(1.0f));
    v.sin_0    = vkeep(v.big_q > 0.0f, y / v.big_q);
    v.sin_edge = vsqrt(vmax((v.big_q - 1.0f) * (v.big_q + 1.0f), vsplat(0.0f))) / v.big_q;
    v.above    = v.q.z - o->half.z;
    v.cap      = vkeep(v.above > 0.0f, (WARP_PI * a * b) * v.q.z);
    v.side     = vkeep(v.big_q > 1.0f, (4.0f * o->half.z * a * b) * v.big_q * v.sin_edge);
    v.sum      = v.cap + v.side;
    v.by_area  = vopening_by_area(vsub(v.q, vspread(o->half)), v.q, v.sum);
    return v;
}

static vfloat cylinder_projected(const opening *o, const vvec3 *w)
{
    float a = o->half.x, b = o->half.y;
    vfloat x = b * w->x, y = a * w->y;
    return (WARP_PI * a * b) * vabs(w->z) + 4.0f * o->half.z * vsqrt(x * x + y * y);
}

static vmask place(const opening *o, const vcylinder_view *v, vvec3 to, vfloat ratio, vmask seen,
                   vopening_place *out)
{
    vfloat dist2   = vdot(to, to);
    out->to        = to;
    out->projected = cylinder_projected(o, &to) / vsqrt(dist2);
    out->spread    = vopening_spread(v->by_area, out->projected, ratio, v->sum, dist2);
    return seen & (dist2 > 0.0f) & (out->spread > 0.0f);
}

static vmask meet_surface(const opening *o, const vcylinder_view *v, vvec3 w, vmask active,
                          vopening_place *out)
{
    /* The cap */
    float a = o->half.x, b = o->half.y;
    vfloat cap_dist = v->above / -w.z;
    vfloat x = (v->q.x + cap_dist * w.x) / a, y = (v->q.y + cap_dist * w.y) / b;
    vmask cap = (v->cap > 0.0f) & (cap_dist > 0.0f) & (x * x + y * y <= 1.0f);

    /* The side: k2 t^2 + 2 k1 t + k0 = 0, the nearer root */
    vfloat wx = w.x / a, wy = w.y / b;
    vfloat k2        = wx * wx + wy * wy;
    vfloat k1        = v->big_q * (v->cos_0 * wx + v->sin_0 * wy);
    vfloat k0        = (v->big_q - 1.0f) * (v->big_q + 1.0f);
    vfloat square    = k1 * k1 - k2 * k0;
    vfloat root      = vsqrt(vmax(square, vsplat(0.0f)));
    vfloat side_dist = k0 / (root - k1);
    vmask side       = (v->side > 0.0f) & (k1 < 0.0f) & (square > 0.0f) &
                 (vabs(v->q.z + side_dist * w.z) <= o->half.z);

    /* n . (q - place), with the n that makes n . place 1, is t sqrt(k1^2 - k2 k0) */
    vfloat gap   = side_dist * root;
    vfloat ratio = vselect(cap, v->q.z / v->above, (1.0f + gap) / gap);
    vfloat dist  = vselect(cap, cap_dist, side_dist);
    return place(o, v, vscale(w, dist), ratio, active & (cap | side), out);
}

/* A place of what is seen, by its area along q. */
static vvec3 draw_surface(const opening *o, const vcylinder_view *v, vfloat s, vfloat t,
                          vfloat *ratio)
{
    float a = o->half.x, b = o->half.y, c = o->half.z;
    vfloat at   = s * v->sum;
    vmask side  = at < v->side;
    vfloat even = vselect(side, at / v->side, (at - v->side) / v->cap);
    even        = vmin(vmax(even, vsplat(0.0f)), vsplat(1.0f));

    vfloat disk_x, disk_y;
    vsquare_to_disk(vkeep(~side, even), t, &disk_x, &disk_y);

    vfloat sin_f = (2.0f * even - 1.0f) * v->sin_edge;
    vfloat cos_f = vsqrt(1.0f - sin_f * sin_f);
    vfloat x     = vselect(side, v->cos_0 * cos_f - v->sin_0 * sin_f, disk_x);
    vfloat y     = vselect(side, v->sin_0 * cos_f + v->cos_0 * sin_f, disk_y);
    vfloat z     = vselect(side, 2.0f * t - 1.0f, vsplat(1.0f));

    vfloat n_q = v->big_q * cos_f;
    *ratio     = vselect(side, n_q / vmax(n_q - 1.0f, vsplat(0.0f)), v->q.z / v->above);
    return vsub((vvec3){ a * x, b * y, c * z }, v->q);
}

/* Square to a plane beyond which all of the cylinder lies: that of the cap or, beside the side, the
 * one that touches it below q. */
static vvec3 inward(const opening *o, const vcylinder_view *v)
{
    vmask above = v->cap > 0.0f;
    vfloat x    = -v->cos_0 / o->half.x;
    vfloat y    = -v->sin_0 / o->half.y;
    vfloat size = vsqrt(x * x + y * y);
    return (vvec3){ vkeep(~above, x / size), vkeep(~above, y / size), vkeep(above, vsplat(-1.0f)) };
}

static vmask cylinder_draw(const opening *o, const vvec3 *q, vfloat s, vfloat t, vmask active,
                           vopening_place *out)
{
    vcylinder_view v = look(o, q);
    vmask seen       = active & (v.sum > 0.0f);
    vmask area       = vopening_pick(v.by_area, &s);
    vfloat ratio     = { 0 };
    vvec3 to         = draw_surface(o, &v, s, t, &ratio);
    vmask lit        = place(o, &v, to, ratio, seen & area, out);
    if (!vany(seen & ~area))
        return lit;

    vopening_place other;
    vvec3 w        = vopening_hemisphere(inward(o, &v), s, t);
    vmask met      = meet_surface(o, &v, w, seen & ~area, &other);
    out->to        = vselect3(area, out->to, other.to);
    out->spread    = vselect(area, out->spread, other.spread);
    out->projected = vselect(area, out->projected, other.projected);
    return lit | met;
}

static vmask cylinder_meet(const opening *o, const vvec3 *q, const vvec3 *w, vmask active,
                           vopening_place *out)
{
    vcylinder_view v = look(o, q);
    return meet_surface(o, &v, *w, active & (v.sum > 0.0f), out);
}

/* Against w the side is seen within a quarter of a turn of the f that w points to, as (b w_x,
 * a w_y): in proportion to cos(f - f0). */
static vvec3 cylinder_leave(const opening *o, const vvec3 *w, vfloat s, vfloat t)
{
    float a = o->half.x, b = o->half.y, c = o->half.z;
    vfloat x = b * w->x, y = a * w->y;
    vfloat level = vsqrt(x * x + y * y);
    vfloat side  = 4.0f * c * level;
    vfloat cap   = (WARP_PI * a * b) * w->z;
    vfloat at    = s * (side + cap);
    vmask beside = at < side;
    vfloat even  = vselect(beside, at / side, (at - side) / cap);
    even         = vmin(vmax(even, vsplat(0.0f)), vsplat(1.0f));

    vfloat disk_x, disk_y;
    vsquare_to_disk(vkeep(~beside, even), t, &disk_x, &disk_y);
    vfloat sin_f = 2.0f * even - 1.0f;
    vfloat cos_f = vsqrt(vmax(1.0f - sin_f * sin_f, vsplat(0.0f)));
    vfloat cos_0 = vselect(level > 0.0f, x / level, vsplat(1.0f));
    vfloat sin_0 = vkeep(level > 0.0f, y / level);
    return (vvec3){ a * vselect(beside, cos_0 * cos_f - sin_0 * sin_f, disk_x),
                    b * vselect(beside, sin_0 * cos_f + cos_0 * sin_f, disk_y),
                    c * vselect(beside, 2.0f * t - 1.0f, vsplat(1.0f)) };
}

const opening_type opening_cylinder = { .draw      = cylinder_draw,
                                        .meet      = cylinder_meet,
                                        .projected = cylinder_projected,
                                        .leave     = cylinder_leave };
