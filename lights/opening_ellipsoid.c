/* lights/opening_ellipsoid.c -- an opening that is an ellipsoid, such as a sphere.
 *
 * Divided by its half sizes it is a ball of radius 1, seen from q', |q'| = Q, within the cone of
 * the angle asin(1/Q), in which a direction w' is drawn evenly. A direction w becomes w' = (w_x /
 * half_x,
 * ...), of a length |w'|, and dw = |w'|^3 half_x half_y half_z dw'. So
 *
 *     A(w) = pi half_x half_y half_z |w'|
 *     pdf  = 1 / (2 pi (1 - cos) half_x half_y half_z |w'|^3)
 *     pdf A(w) = 1 / (2 (1 - cos) |w'|^2)
 */
#include "core/warp.h"
#include "lights/opening.h"

static vvec3 divide(vvec3 a, vec3 b) { return (vvec3){ a.x / b.x, a.y / b.y, a.z / b.z }; }

/* 1 - cos of asin(1/Q), without the cancellation. */
static vfloat cone(vfloat q2)
{
    return 1.0f / (q2 * (1.0f + vsqrt(vmax(1.0f - 1.0f / q2, vsplat(0.0f)))));
}

/* The place at w', which need not be of unit length, times `dist`. */
static vmask place(const opening *o, vvec3 w_ball, vfloat dist, vfloat q2, vmask met,
                   vopening_place *out)
{
    vec3 h         = o->half;
    vvec3 ball     = vscale(w_ball, dist);
    out->to        = (vvec3){ ball.x * h.x, ball.y * h.y, ball.z * h.z };
    vfloat dist2   = vdot(out->to, out->to);
    vfloat ball2   = vdot(ball, ball) / dist2; /* |w'|^2 */
    out->projected = (3.14159265f * h.x * h.y * h.z) * vsqrt(ball2);
    out->spread    = 0.5f / (cone(q2) * ball2);
    return met & (dist2 > 0.0f);
}

static vmask ellipsoid_draw(const opening *o, const vvec3 *q, vfloat s, vfloat t, vmask active,
                            vopening_place *out)
{
    vvec3 from = divide(*q, o->half);
    vfloat q2  = vdot(from, from);
    vmask seen = active & (q2 > 1.0f);

    /* Even in the disk is even in the cone, if the square of its radius is 1 - cos */
    vfloat x, y, most = cone(q2);
    vsquare_to_disk(s, t, &x, &y);
    vfloat less  = (x * x + y * y) * most; /* 1 - cos of the angle to the axis */
    vfloat sin2  = less * (2.0f - less);
    vfloat scale = vsqrt(most * (2.0f - less));

    /* Where the ball is met */
    vfloat size  = vsqrt(q2);
    vfloat half2 = vmax(1.0f - q2 * sin2, vsplat(0.0f));
    vfloat dist  = (size - 1.0f) * (size + 1.0f) / (size * (1.0f - less) + vsqrt(half2));

    vvec3 u, v, axis = vscale(from, -1.0f / size);
    vframe(axis, &u, &v);
    vvec3 w = vadd(vscale(axis, 1.0f - less), vadd(vscale(u, x * scale), vscale(v, y * scale)));
    return place(o, w, dist, q2, seen, out);
}

static vmask ellipsoid_meet(const opening *o, const vvec3 *q, const vvec3 *w, vmask active,
                            vopening_place *out)
{
    vvec3 from  = divide(*q, o->half);
    vvec3 ball  = divide(*w, o->half);
    vfloat a    = vdot(ball, ball);
    vfloat b    = vdot(from, ball);
    vfloat c    = vdot(from, from) - 1.0f;
    vfloat root = b * b - a * c;
    vmask met   = active & (c > 0.0f) & (b < 0.0f) & (root >= 0.0f);
    vfloat dist = c / (vsqrt(vmax(root, vsplat(0.0f))) - b);
    return place(o, ball, dist, c + 1.0f, met, out);
}

static vfloat ellipsoid_projected(const opening *o, const vvec3 *w)
{
    vec3 h = o->half;
    return (3.14159265f * h.x * h.y * h.z) * vlength(divide(*w, h));
}

/* Even over the ball as seen against w': what is even stays so when all is stretched. */
static vvec3 ellipsoid_leave(const opening *o, const vvec3 *w, vfloat s, vfloat t)
{
    vec3 h      = o->half;
    vvec3 axis  = vnormalize(divide(*w, h));
    vvec3 place = vwarp_cosine_about(axis, s, t);
    return (vvec3){ place.x * h.x, place.y * h.y, place.z * h.z };
}

const opening_type opening_ellipsoid = { .draw      = ellipsoid_draw,
                                         .meet      = ellipsoid_meet,
                                         .projected = ellipsoid_projected,
                                         .leave     = ellipsoid_leave };
