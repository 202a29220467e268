/* lights/opening_line.c -- an opening that is a line, from -half.x to half.x along its axis x.
 *
 * Each element dl of the length l sends I(w) dl / l. Places are drawn evenly in the angle at q, so
 * that near the line, where d^2 varies most, I / d^2 over the density does not:
 *
 *     density(x) = r / (angle (r^2 + (x - q_x)^2)),    e = I / (l density d^2)
 *
 * with r the distance of q from the axis, and at least a small part of the distance from the line's
 * ends, so that on the axis itself a density is left.
 */
#include "core/packet_math.h"
#include "lights/opening.h"

static vmask line_draw(const opening *o, const vvec3 *q, vfloat s, vfloat t, vmask active,
                       vopening_place *out)
{
    (void)t;
    const float off_axis = 1e-3f; /* rad */
    vfloat from          = -o->half.x - q->x;
    vfloat end           = o->half.x - q->x;
    vfloat off2          = q->y * q->y + q->z * q->z;
    vfloat r             = vmax(vsqrt(off2), off_axis * (vabs(from) + vabs(end)));

    /* The tangent of the angle from x = 0 is x / r; that of a sum of angles, by sines and cosines
     */
    vfloat angle = vatan2(r * (2.0f * o->half.x), r * r + from * end);
    vfloat sin_a = vsin(s * angle);
    vfloat cos_a = vcos(s * angle);
    vfloat x     = r * (from * cos_a + r * sin_a) / (r * cos_a - from * sin_a);
    x            = vmin(vmax(x, from), end);

    vfloat density = r / (angle * (r * r + x * x));
    vfloat dist2   = x * x + off2;
    out->to        = (vvec3){ x, -q->y, -q->z };
    out->projected = vsplat(0.0f);
    out->spread    = 2.0f * o->half.x * density * dist2;
    return active & (dist2 > 0.0f) & (out->spread > 0.0f);
}

static vvec3 line_leave(const opening *o, const vvec3 *w, vfloat s, vfloat t)
{
    (void)w, (void)t;
    return (vvec3){ (2.0f * s - 1.0f) * o->half.x, vsplat(0.0f), vsplat(0.0f) };
}

const opening_type opening_line = { .draw = line_draw, .leave = line_leave };
