/* lights/linear.c -- a straight line that shines around itself as a thin matt cylinder does.
 *
 *     dE = i0 du sin(theta) / r^2        [W/m^2], i0 = I / length in W/(sr m)
 *
 * on a surface facing the element du at the distance r, theta the angle to the line. With h the
 * distance of the point from the line's axis, u counted along it from the foot of the
 * perpendicular, and a = atan(u / h) the angle there, cos a = sin theta = h / r and
 *
 *     dE = (i0 / h) cos a da
 *
 * Samples are even in a, of which the line subtends w = a1 - a0:
 *
 *     w = atan2(length h, h^2 + u0 u1),    E = i0 w cos a / h = i0 w / r
 *
 * which is well behaved however far the point is, and where it lies beyond the ends of the line
 * near its axis, h -> 0. A surface with the normal n gets, of what its horizon leaves of the line,
 *
 *     E = (i0 / 2h) ((n . h^)(w + cos(a0 + a1) sin w) + (n . t^) sin(a0 + a1) sin w)
 */
#include "core/color.h"
#include "core/transform.h"
#include "core/warp.h"
#include "lights/light.h"

typedef struct linear_light {
    light base;
    vec3 from, to, middle; /* m */
    vec3 along;            /* unit, from `from` to `to` */
    float length;          /* m */
    vec3 intensity;        /* W/sr, of the whole line, square to it */
    vec3 strength;         /* W/(sr m), of each metre */
} linear_light;

/* A line as a point sees it. */
typedef struct vline {
    vvec3 foot;    /* m, from the point to the foot of the perpendicular */
    vfloat h;      /* m, its length */
    vfloat u0, u1; /* m, where the line begins and ends, counted along it from the foot */
} vline;

static vline line_from(const linear_light *l, const vvec3 *p)
{
    vvec3 along = vspread(l->along);
    vvec3 start = vsub(vspread(l->from), *p);
    vfloat u0   = vdot(start, along);
    vvec3 foot  = vsub(start, vscale(along, u0));
    return (vline){ foot, vlength(foot), u0, u0 + l->length };
}

/* The angle that the stretch of the line from u0 to u1 = u0 + length subtends. */
static vfloat angle_of(vfloat h, vfloat u0, vfloat u1, vfloat length)
{
    return vatan2(length * h, h * h + u0 * u1);
}

static vmask linear_sample(const light *self, const vvec3 *p, vfloat s, vfloat t, vmask active,
                           vlight_sample *out)
{
    const linear_light *l = (const linear_light *)self;
    (void)t; /* a line has one dimension */

    vline line   = line_from(l, p);
    vfloat width = angle_of(line.h, line.u0, line.u1, vsplat(l->length));
    vmask lit    = active & (line.h > 0.0f) & (width > 0.0f);

    /* The angle a0 + s w, by the sum formulae: exact where cos a is small */
    vfloat r0    = vsqrt(line.h * line.h + line.u0 * line.u0);
    vfloat turn  = s * width;
    vfloat sin_s = vsin(turn);
    vfloat cos_s = vcos(turn);
    vfloat cos_a = (line.h * cos_s - line.u0 * sin_s) / r0;
    vfloat sin_a = (line.u0 * cos_s + line.h * sin_s) / r0;

    /* The place; near the axis rounding would let it leave the line */
    vfloat u    = vmin(vmax(line.h * (sin_a / cos_a), line.u0), line.u1);
    vvec3 to    = valong(line.foot, vspread(l->along), u);
    vfloat dist = vlength(to);

    out->wi   = vkeep3(lit, vscale(to, 1.0f / dist));
    out->dist = vkeep(lit, dist);
    out->e    = vscale(vspread(l->strength), vkeep(lit, width / dist));
    out->pdf  = vkeep(lit, vsplat(INFINITY));
    return lit;
}

/* w - sin w for w in [0, pi]: the series where the difference would cancel. */
static vfloat less_its_sine(vfloat w, vfloat sin_w)
{
    vfloat w2     = w * w;
    vfloat series = w * w2 * (1.0f / 6 - w2 * (1.0f / 120 - w2 * (1.0f / 5040 - w2 / 362880)));
    return vselect(w < 1.0f, series, w - sin_w);
}

static vrgb linear_irradiance(const light *self, const vvec3 *p, const vvec3 *n, vmask active)
{
    const linear_light *l = (const linear_light *)self;
    vline line            = line_from(l, p);

    /* What is above the horizon: heights are linear along the line */
    vfloat f0     = vdot(vsub(vspread(l->from), *p), *n);
    vfloat f1     = vdot(vsub(vspread(l->to), *p), *n);
    vmask clip0   = f0 < 0.0f;
    vmask clip1   = f1 < 0.0f;
    vfloat share  = vselect(clip0, f1, f0) / vabs(f1 - f0);
    vfloat length = vselect(clip0 | clip1, l->length * share, vsplat(l->length));
    vfloat u0     = vselect(clip0, line.u1 - length, line.u0);
    vfloat u1     = vselect(clip1, line.u0 + length, line.u1);
    vmask lit     = active & (line.h > 0.0f) & ((f0 > 0.0f) | (f1 > 0.0f));

    /* The angles of its ends, their sum, and what they subtend */
    vfloat h  = line.h;
    vfloat r0 = vsqrt(h * h + u0 * u0);
    vfloat r1 = vsqrt(h * h + u1 * u1);
    vfloat c0 = h / r0, s0 = u0 / r0;
    vfloat c1 = h / r1, s1 = u1 / r1;
    vfloat w     = angle_of(h, u0, u1, length);
    vfloat sin_w = (length / r0) * c1;

    /* 1 + cos(a0 + a1) = 1 + c0 c1 - s0 s1, without its cancellation near the axis */
    vfloat ss       = s0 * s1;
    vfloat not_sine = (c0 * c0 + c1 * c1 - c0 * c0 * c1 * c1) / (1.0f + ss);
    vfloat one_plus = c0 * c1 + vselect(ss > 0.0f, not_sine, 1.0f - ss);
    vfloat sin_sum  = s0 * c1 + c0 * s1;

    vfloat across = less_its_sine(w, sin_w) + sin_w * one_plus;
    vfloat n_foot = vdot(*n, line.foot) / h;
    vfloat n_line = vdot(*n, vspread(l->along));
    vfloat e      = 0.5f * (n_foot * across + n_line * sin_sum * sin_w) / h;
    return vscale(vspread(l->strength), vkeep(lit, vmax(e, vsplat(0.0f))));
}

/* Facing the light, at the nearest place of the line; times the largest cosine at its ends or
 * there: if any of the line is above the horizon, one of its ends is. */
static vfloat linear_weight(const light *self, const vvec3 *p, const vvec3 *n, vmask active)
{
    const linear_light *l = (const linear_light *)self;
    vline line            = line_from(l, p);
    vfloat width          = angle_of(line.h, line.u0, line.u1, vsplat(l->length));

    vfloat u      = vmin(vmax(vsplat(0.0f), line.u0), line.u1);
    vfloat near_  = vsqrt(line.h * line.h + u * u);
    vfloat n_foot = vdot(*n, line.foot);
    vfloat n_line = vdot(*n, vspread(l->along));
    vfloat cos_n  = (n_foot + n_line * u) / near_;
    cos_n = vmax(cos_n, (n_foot + n_line * line.u0) / vsqrt(line.h * line.h + line.u0 * line.u0));
    cos_n = vmax(cos_n, (n_foot + n_line * line.u1) / vsqrt(line.h * line.h + line.u1 * line.u1));

    vmask lit = active & (line.h > 0.0f) & (cos_n > 0.0f);
    return vkeep(lit, rgb_luminance(l->strength) * width / near_ * cos_n);
}

/* All from the middle c, E = I h / r^3. With x from the point to a place of the line, V(x) =
 * i0 h x / |x|^4 is what one metre gives a surface facing x, and n . V what it gives one with the
 * normal n above whose horizon it is. m = r - length/2 is the least distance.
 *
 * No part below the horizon: the first order cancels, for c is the middle. Along the line
 * |V''| = 4 i0 h sqrt(12 s^4 - 4 s^2 + 1) / |x|^5 <= 12 i0 h / m^5, s being the sine of a; hence
 *
 *     |error| <= (length^2 / 24) 12 I h / m^5                                              [A]
 *
 * Cut by the horizon: n . x is f + s u, u from c, |f| <= |s| length/2. With the positive part +,
 * q = I h / |x|^4, |q'| <= 4 I h / m^5, and means over the line
 *
 *     |error| = |mean((q - q0)(f + s u)+) + q0 (mean((f + s u)+) - f+)|
 *             <= (4 I h / m^5) |s| length^2 / 8 + (I h / r^4) |s| length / 8               [B]
 *
 * the last being largest where f = 0. |s| <= h / m: n lies f / r along x, so that
 * |s| <= |f| / r + h / r <= |s| length / 2r + h / r. The first order stays in [B]: seen edge-on,
 * half of the line lights a surface that its middle does not. */
static vmask linear_as_point(const light *self, const vvec3 *p, vmask active, vlight_sample *out,
                             vfloat *error)
{
    const linear_light *l = (const linear_light *)self;
    vvec3 along           = vspread(l->along);
    vvec3 to              = vsub(vspread(l->middle), *p);
    vfloat dist2          = vdot(to, to);
    vfloat dist           = vsqrt(dist2);
    vfloat h              = vlength(vsub(to, vscale(along, vdot(to, along))));
    vmask lit             = active & (h > 0.0f);

    out->wi   = vkeep3(lit, vscale(to, 1.0f / dist));
    out->dist = vkeep(lit, dist);
    out->e    = vscale(vspread(l->intensity), vkeep(lit, (h / dist) / dist2));
    out->pdf  = vkeep(lit, vsplat(INFINITY));

    vfloat m     = dist - 0.5f * l->length;
    vfloat m2    = m * m;
    vfloat small = l->length / m; /* of both bounds, what they share: I h / m^3 */
    vfloat ratio = m / dist;
    vfloat whole = 0.5f * small * small;
    vfloat cut   = (h / m) * small * 0.125f * (ratio * ratio * ratio * ratio + 4.0f * small);
    vfloat bound = rgb_luminance(l->intensity) * (h / m) / m2 * vmax(whole, cut);
    *error       = vkeep(active, vselect(m > 0.5f * l->length, bound, vsplat(INFINITY)));
    return lit;
}

static vec3 linear_flux(const light *self)
{
    return v3_scale(((const linear_light *)self)->intensity, (float)(M_PI * M_PI));
}

/* Of directions by intensity the cosine to the line has the density (2 / pi) sqrt(1 - c^2): that
 * of a coordinate of an even place in the unit disk; the other one is even in its chord, and tells
 * the turn about the line. */
static vmask linear_emit(const light *self, const light_target *to, vfloat s, vfloat t, vfloat u,
                         vfloat v, vmask active, vlight_ray *out)
{
    const linear_light *l = (const linear_light *)self;
    (void)to, (void)t; /* a line has one dimension */
    vfloat cos_a, y;
    vsquare_to_disk(u, v, &cos_a, &y);
    vfloat chord = vsqrt(vmax((1.0f - cos_a) * (1.0f + cos_a), vsplat(1e-12f)));
    vfloat turn  = 0.5f * vmin(vmax(y / chord, vsplat(-1.0f)), vsplat(1.0f));
    vvec3 place  = valong(vspread(l->from), vspread(l->along), s * l->length);

    out->origin    = vkeep3(active, place);
    out->direction = vkeep3(active, vwarp_about(vspread(l->along), 1.0f - cos_a, turn));
    out->flux      = vkeep3(active, vspread(linear_flux(self)));
    return active;
}

/* Square to the line in all directions: this is one of them. */
static vec3 linear_peak(const light *self, vec3 *toward)
{
    const linear_light *l = (const linear_light *)self;
    vec3 other;
    v3_frame(l->along, toward, &other);
    return l->intensity;
}

static light_bounds linear_bounds(const light *self)
{
    const linear_light *l = (const linear_light *)self;
    vec3 a = l->from, b = l->to;
    return (light_bounds){ .low        = { fminf(a.x, b.x), fminf(a.y, b.y), fminf(a.z, b.z) },
                           .high       = { fmaxf(a.x, b.x), fmaxf(a.y, b.y), fmaxf(a.z, b.z) },
                           .axis       = l->along,
                           .cos_spread = -1.0f,
                           .cos_reach  = -1.0f,
                           .peak       = rgb_luminance(l->intensity) };
}

static const light_type linear_type = { .name       = "linear",
                                        .sample     = linear_sample,
                                        .irradiance = linear_irradiance,
                                        .weight     = linear_weight,
                                        .as_point   = linear_as_point,
                                        .emit       = linear_emit,
                                        .flux       = linear_flux,
                                        .peak       = linear_peak,
                                        .bounds     = linear_bounds };

const light *light_linear(arena *a, const linear_desc *d, lux_error *err)
{
    dvec3 from    = d3_from(d->from);
    dvec3 to      = d3_from(d->to);
    dvec3 line    = d3_add(to, d3_scale(from, -1.0));
    double length = d3_length(line);
    if (!(length >= 1e-6 && length <= 1e6))
        return failed(err, ERR_ARGUMENT, "linear light: %g m long, wanted 1e-6 to 1e6", length);
    if (!v3_nonnegative(d->intensity))
        return failed(err, ERR_ARGUMENT, "linear light: an intensity is not >= 0 W/sr");

    linear_light *l = arena_new(a, linear_light, err);
    if (!l)
        return NULL;
    l->base      = (light){ &linear_type };
    l->from      = d->from;
    l->to        = d->to;
    l->middle    = d3_to_float(d3_scale(d3_add(from, to), 0.5));
    l->along     = d3_to_float(d3_scale(line, 1.0 / length));
    l->length    = (float)length;
    l->intensity = d->intensity;
    l->strength  = v3_scale(d->intensity, 1.0f / l->length);
    return &l->base;
}
