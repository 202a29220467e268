/* lights/disk.c -- a flat, round, matt surface that shines from one side.
 *
 * A point at the height z above the plane of the disk and d beside its axis, r1 and r2 from the
 * nearest and the farthest place of the rim, sees an ellipse on its sphere of directions (Guillen
 * et al., "Area-Preserving Parameterizations for Spherical Ellipses", CGF 36(4) 2017). Its centre
 * w halves the angle between these two places; b is that half, a the half angle across. With
 * S = r1 r2 and k = R^2 - d^2 - z^2, of which S^2 = k^2 + (2 R z)^2,
 *
 *     sin a = 2R / (r1 + r2),              cos^2 a = 2 (S - k) / (r1 + r2)^2
 *     sin^2 b = (S + k) / 2S,              cos^2 b = (S - k) / 2S
 *     w = (-d cos a, -z / cos a) / sqrt S  along the offset and the axis of the disk
 *
 * In the frame of a, b and w the rim is (sin a cos v, sin b sin v, c(v)) with
 * c^2 = cos^2 a cos^2 v + cos^2 b sin^2 v, and the solid angle within it is
 *
 *     omega = integral of sin a sin b / (1 + c(v)) dv,  v = 0 ... 2 pi
 *
 * of which the integrand varies by less than 2 whatever the ellipse, and hardly for a small one.
 * Even samples of omega would need the inverse of this elliptic integral, by tables or by Newton's
 * method in every lane. Instead v has a density that can be inverted and is the integrand's at the
 * ends of both axes,
 *
 *     q(v) = ca cb / (2 pi (ca^2 cos^2 v + cb^2 sin^2 v)),  ca = cos(a/2), cb = cos(b/2)
 *     tan v = (ca / cb) tan f,  (r, f) an even place in the unit disk
 *
 * and in the slice of v samples are even in solid angle: 1 - cos theta = r^2 (1 - c). The density
 *
 *     pdf = q (1 + c) / (sin a sin b)
 *
 * is known exactly without any integral. It is 1 / omega times 0.92 to 1.07 wherever the point is,
 * times 0.997 to 1.003 where the rim is farther than R / 2, and tends to 1 / omega for ellipses
 * that are small or round: so nothing degenerates where the disk is tiny or near.
 */
#include "core/color.h"
#include "core/warp.h"
#include "lights/light.h"

#define PI 3.14159265f

typedef struct disk_light {
    light base;
    vec3 centre;     /* m */
    vec3 u, v, axis; /* unit: two directions in its plane, the side that shines */
    float radius;    /* m */
    vec3 radiance;   /* W/(sr m^2) */
} disk_light;

/* The disk as a point sees it: see above. */
typedef struct vellipse {
    vmask lit;                 /* on the side that shines */
    vfloat x, y, z;            /* m, the point along u, v and axis, from the centre */
    vfloat d, r1, r2;          /* m */
    vfloat s, s_plus, s_minus; /* m^2: S, S + k, S - k */
    vfloat out_x, out_y;       /* the direction of (x, y); (1, 0) if they are 0 */
} vellipse;

static vellipse ellipse_from(const disk_light *l, const vvec3 *p, vmask active)
{
    vellipse e;
    float radius = l->radius;
    vvec3 from   = vsub(*p, vspread(l->centre));
    e.x          = vdot(from, vspread(l->u));
    e.y          = vdot(from, vspread(l->v));
    e.z          = vdot(from, vspread(l->axis));

    vfloat d2 = e.x * e.x + e.y * e.y;
    vmask off = d2 > 0.0f;
    e.d       = vsqrt(d2);
    e.out_x   = vselect(off, e.x / e.d, vsplat(1.0f));
    e.out_y   = vkeep(off, e.y / e.d);
    vfloat z2 = e.z * e.z;
    e.r1      = vsqrt(z2 + (e.d - radius) * (e.d - radius));
    e.r2      = vsqrt(z2 + (e.d + radius) * (e.d + radius));
    e.s       = e.r1 * e.r2;

    /* S + k and S - k: the one that would cancel is (2 R z)^2 by the other */
    vfloat k     = (radius - e.d) * (radius + e.d) - z2;
    vfloat large = e.s + vabs(k);
    vfloat small = 4.0f * radius * radius * z2 / large;
    e.s_plus     = vselect(k < 0.0f, small, large);
    e.s_minus    = vselect(k < 0.0f, large, small);
    e.lit        = active & (e.z > 0.0f) & (small > 0.0f) & (large < INFINITY);
    return e;
}

/* Its frame on the sphere of directions, as (u, v, axis) of the disk has it, and its size. */
typedef struct vellipse_frame {
    vvec3 side, up, middle; /* unit: along a, along b, w */
    vfloat sin_a, sin_b;
    vfloat cos2_a, cos2_b;
    vfloat ca2, cb2; /* squares of the cosines of a/2 and b/2 */
} vellipse_frame;

static vellipse_frame frame_of(const disk_light *l, const vellipse *e)
{
    vfloat sum = 1.0f / (e->r1 + e->r2);
    vfloat one = 1.0f / e->s;
    vellipse_frame f;
    f.sin_a      = 2.0f * l->radius * sum;
    f.cos2_a     = 2.0f * e->s_minus * (sum * sum);
    f.sin_b      = vsqrt(0.5f * e->s_plus * one);
    f.cos2_b     = 0.5f * e->s_minus * one;
    vfloat cos_a = vsqrt(f.cos2_a);
    f.ca2        = 0.5f + 0.5f * cos_a;
    f.cb2        = 0.5f + 0.5f * vsqrt(f.cos2_b);

    vfloat root  = vsqrt(one);
    vfloat flat  = e->d * cos_a * root;
    vfloat steep = e->z / cos_a * root;
    f.side       = (vvec3){ -e->out_y, e->out_x, vsplat(0.0f) };
    f.up         = (vvec3){ steep * e->out_x, steep * e->out_y, -flat };
    f.middle     = (vvec3){ -flat * e->out_x, -flat * e->out_y, -steep };
    return f;
}

/* 1 / pdf, in sr: cos2_v is the square of the cosine of v, and c that of the rim there. */
static vfloat steradians(const vellipse_frame *f, vfloat cos2_v, vfloat c)
{
    vfloat bend = f->ca2 * cos2_v + f->cb2 * (1.0f - cos2_v);
    return 2.0f * PI * f->sin_a * f->sin_b * bend / (vsqrt(f->ca2 * f->cb2) * (1.0f + c));
}

static vfloat rim_cosine(const vellipse_frame *f, vfloat cos2_v)
{
    return vsqrt(f->cos2_a * cos2_v + f->cos2_b * (1.0f - cos2_v));
}

static vmask disk_sample(const light *self, const vvec3 *p, vfloat s, vfloat t, vmask active,
                         vlight_sample *out)
{
    const disk_light *l = (const disk_light *)self;
    vellipse e          = ellipse_from(l, p, active);
    vellipse_frame f    = frame_of(l, &e);

    /* tan v = (ca / cb) tan f */
    vfloat x, y;
    vsquare_to_disk(s, t, &x, &y);
    vfloat cos2  = f.cb2 * x * x;
    vfloat sin2  = f.ca2 * y * y;
    vfloat both  = 1.0f / vmax(cos2 + sin2, vsplat(1e-30f));
    vfloat cos_v = x * vsqrt(f.cb2 * both);
    vfloat sin_v = y * vsqrt(f.ca2 * both);

    /* 1 - cos theta = r^2 (1 - c), and 1 - c = sin^2 / (1 + c) */
    vfloat cos2_v = cos2 * both;
    vfloat c      = rim_cosine(&f, cos2_v);
    vfloat x_rim  = f.sin_a * cos_v;
    vfloat y_rim  = f.sin_b * sin_v;
    vfloat share  = (x * x + y * y) / (1.0f + c);
    vfloat drop   = share * (x_rim * x_rim + y_rim * y_rim);
    vfloat scale  = vsqrt(share * (2.0f - drop));
    vvec3 way     = vadd(vadd(vscale(f.side, scale * x_rim), vscale(f.up, scale * y_rim)),
                         vscale(f.middle, 1.0f - drop));

    vvec3 wi  = vadd(vadd(vscale(vspread(l->u), way.x), vscale(vspread(l->v), way.y)),
                     vscale(vspread(l->axis), way.z));
    vfloat sr = steradians(&f, cos2_v, c);
    vmask lit = e.lit & (way.z < 0.0f);
    out->wi   = vkeep3(lit, wi);
    out->dist = vkeep(lit, e.z / -way.z);
    out->e    = vscale(vspread(l->radiance), vkeep(lit, sr));
    out->pdf  = vkeep(lit, 1.0f / sr);
    return lit;
}

static vmask disk_hit(const light *self, const vvec3 *p, const vvec3 *wi, vmask active,
                      vlight_hit *out)
{
    const disk_light *l = (const disk_light *)self;
    vellipse e          = ellipse_from(l, p, active);

    /* Where the ray meets the plane */
    vvec3 way = { vdot(*wi, vspread(l->u)), vdot(*wi, vspread(l->v)), vdot(*wi, vspread(l->axis)) };
    vfloat dist = e.z / -way.z;
    vfloat x    = e.x + dist * way.x;
    vfloat y    = e.y + dist * way.y;
    vmask met   = e.lit & (way.z < 0.0f) & (x * x + y * y <= l->radius * l->radius);

    /* tan v = (along b / sin b) / (along a / sin a) */
    vellipse_frame f = frame_of(l, &e);
    vfloat side      = vdot(way, f.side) / f.sin_a;
    vfloat up        = vdot(way, f.up) / f.sin_b;
    vfloat both      = side * side + up * up;
    vfloat cos2_v    = vselect(both > 0.0f, side * side / both, vsplat(1.0f));
    vfloat sr        = steradians(&f, cos2_v, rim_cosine(&f, cos2_v));

    out->dist     = vkeep(met, dist);
    out->radiance = vkeep3(met, vspread(l->radiance));
    out->pdf      = vkeep(met, 1.0f / sr);
    return met;
}

/* ---- in closed form ---------------------------------------------------------------------------
 */

/* ln(1 + f) for f >= 0, exact where f is small: the rounding of 1 + f is made up for by the ratio
 * (Kahan; in Goldberg, "What every computer scientist should know", 1991, theorem 4). */
static vfloat vlog1p(vfloat f)
{
    vfloat sum = 1.0f + f;
    vfloat log = 0.693147182f * vlog2(sum);
    return vselect(sum == 1.0f, f, f * (log / (sum - 1.0f)));
}

/* The part of the rim above the horizon of the receiver, from the angle f0 - h to f0 + h. Angles
 * are counted about the disk's centre, from the direction of the point's offset. */
typedef struct varc {
    vfloat half;         /* rad: h */
    vfloat cos_f, sin_f; /* of f0 */
    vfloat cos_h, sin_h; /* of h */
} varc;

/* An end of the arc, at the angle f: what it takes where it is next to the point, too. Rounding
 * moves an end along the rim, which changes little, as long as all who use it agree on where it is.
 */
typedef struct vend {
    vfloat sine, versine; /* of f; 1 - cos f */
    vfloat x, y;          /* m, from the point, along the offset and across it */
    vfloat turn, square;  /* the angle of 1 - rho exp(-i f), and its size squared */
} vend;

static vend end_at(const disk_light *l, const vellipse *e, vfloat rho, vfloat sine, vfloat cosine)
{
    vend end;
    vfloat near_ = 2.0f * e->r1 / (e->r1 + e->r2); /* 1 - rho */
    end.sine     = sine;
    end.versine  = vselect(cosine > 0.0f, sine * sine / (1.0f + cosine), 1.0f - cosine);
    end.x        = (l->radius - e->d) - l->radius * end.versine;
    end.y        = l->radius * sine;
    end.turn     = vatan2(rho * sine, near_ + rho * end.versine);
    end.square   = near_ * near_ + 2.0f * rho * end.versine;
    return end;
}

/* Lambert's contour integral  E = (L / 2) integral of n . (r x dr) / r^2  along the arc and back
 * along its chord. With r = (R cos f - d, R sin f, -z) from the point, r^2 = A - B cos f, A = R^2 +
 * d^2 + z^2, B = 2 R d, S^2 = A^2 - B^2 and rho = (r2 - r1) / (r2 + r1), over the arc
 *
 *     T                                = arg(1 - rho exp(-i f)) at its end, less that where it
 * begins int df / r^2                     = (2h + 2T) / S int cos f df / r^2               = (2h
 * rho + (1 + rho^2) T / rho) / S             [x] int sin f df / r^2               = (ln of the
 * ratio of r^2 at the ends) / B       [y] int (R^2 - R d cos f) df / r^2   = h (S + k) / S + T k /
 * S                        [z]
 *
 * [x], [y] and [z] are what components of n along the offset, across it and along the axis get,
 * the first two times R z. (1 / (A - B cos f) is a Poisson kernel: (1 + 2 sum rho^j cos jf) / S.)
 * The chord lies in the plane of the receiver and adds the angle that it subtends. */
static vfloat contour(const disk_light *l, const vellipse *e, vvec3 n, varc a)
{
    vfloat sum   = e->r1 + e->r2;
    vfloat rho   = vmax(4.0f * l->radius * e->d / (sum * sum), vsplat(1e-15f));
    vfloat one_s = 1.0f / e->s;
    vfloat sc = a.sin_f * a.cos_h, cs = a.cos_f * a.sin_h;
    vfloat cc = a.cos_f * a.cos_h, ss = a.sin_f * a.sin_h;
    vend from = end_at(l, e, rho, sc - cs, cc + ss);
    vend to   = end_at(l, e, rho, sc + cs, cc - ss);

    vfloat turn  = to.turn - from.turn;
    vfloat ratio = 4.0f * rho * vabs(ss) / vmax(vmin(from.square, to.square), vsplat(1e-30f));
    vfloat log   = vcopysign(vlog1p(ratio), ss);

    vfloat rz = l->radius * e->z;
    vfloat x  = rz * one_s * (2.0f * a.half * rho + (1.0f + rho * rho) * (turn / rho));
    vfloat y  = rz * 2.0f * (log / rho) / (sum * sum);
    vfloat z  = a.half * e->s_plus * one_s + turn * (0.5f * (e->s_plus - e->s_minus)) * one_s;

    /* The chord: cross and scalar product of its ends; away from the rim the former is better got
     * from how far the chord's middle is along the receiver */
    vfloat level = vsqrt(n.x * n.x + n.y * n.y);
    vfloat ahead = n.z * (l->radius * a.cos_h - e->d * a.cos_f) + e->z * level;
    vfloat cross = e->z * (n.x * (to.y - from.y) + n.y * (from.x - to.x)) +
                   n.z * (to.y * from.x - to.x * from.y);
    cross         = vselect(e->r1 > l->radius, 2.0f * l->radius * a.sin_h * ahead, cross);
    vfloat scalar = from.x * to.x + from.y * to.y + e->z * e->z;
    vfloat chord  = vatan2(cross, scalar);
    return 0.5f * (chord - (n.x * x + n.y * y + n.z * z));
}

/* The same where the disk is cut and small, its parts of the contour nearly cancelling: over the
 * part v > R cos h, with v counted up the slope, of
 *
 *     L (z / r^4) (1 + 4 v d cos f0 / r^2) (height at v) dA
 *
 * so that 1 / |x|^4 is good to its first order in R / r; the second is in all 2 (R / r)^3 of what a
 * surface gets that faces the disk. Its contour is good to 1e-7 r / R of that. */
static vfloat contour_far(const disk_light *l, const vellipse *e, vfloat rise, vfloat r2, varc a)
{
    float radius = l->radius;
    vfloat sin3  = a.sin_h * a.sin_h * a.sin_h;
    vfloat both  = a.sin_h * a.cos_h;
    vfloat even  = (2.0f / 3) * sin3 - a.cos_h * (a.half - both);
    vfloat odd =
        0.25f * (a.half - both * (1.0f - 2.0f * a.sin_h * a.sin_h)) - (2.0f / 3) * a.cos_h * sin3;
    vfloat lean = 4.0f * radius * e->d * a.cos_f / r2;
    return (e->z * rise / r2) * (radius * radius / r2) * (even + lean * odd);
}

static const float FAR = 64.0f; /* radii, where both are as good */

static vrgb disk_irradiance(const light *self, const vvec3 *p, const vvec3 *normal, vmask active)
{
    const disk_light *l = (const disk_light *)self;
    vellipse e          = ellipse_from(l, p, active);

    /* The normal along the offset, across it, along the axis */
    vfloat nu = vdot(*normal, vspread(l->u));
    vfloat nv = vdot(*normal, vspread(l->v));
    vvec3 n   = { nu * e.out_x + nv * e.out_y, nv * e.out_x - nu * e.out_y,
                  vdot(*normal, vspread(l->axis)) };

    /* The height of the rim above the receiver is middle + rise cos(f - f0) */
    vfloat level  = vsqrt(n.x * n.x + n.y * n.y);
    vfloat rise   = l->radius * level;
    vfloat middle = -(n.x * e.d + n.z * e.z);
    vmask lit     = e.lit & (middle > -rise);
    vmask cut     = lit & (middle < rise);

    /* All of it: h = pi, T = 0 and no chord */
    vfloat sum   = e.r1 + e.r2;
    vfloat x     = l->radius * e.z * (4.0f * l->radius * e.d / (sum * sum));
    vfloat share = -PI * (n.x * x + n.z * (0.5f * e.s_plus)) / e.s;
    if (vany(cut)) {
        varc a;
        a.cos_h = -middle / rise;
        a.sin_h = vsqrt(vmax((1.0f - a.cos_h) * (1.0f + a.cos_h), vsplat(0.0f)));
        a.half  = vatan2(a.sin_h, a.cos_h);
        a.cos_f = n.x / level;
        a.sin_f = n.y / level;

        vfloat r2   = e.d * e.d + e.z * e.z;
        vmask far   = r2 > FAR * FAR * l->radius * l->radius;
        vfloat part = vselect(far, contour_far(l, &e, rise, r2, a), contour(l, &e, n, a));
        share       = vselect(cut, part, share);
    }
    share = vmin(vmax(share, vsplat(0.0f)), vsplat(PI));
    return vscale(vspread(l->radiance), vkeep(lit, share));
}

/* ---- for choosing among lights ----------------------------------------------------------------
 */

/* About its solid angle, pi sin a sin b, times the cosine at its highest place above the horizon.
 */
static vfloat disk_weight(const light *self, const vvec3 *p, const vvec3 *n, vmask active)
{
    const disk_light *l = (const disk_light *)self;
    vellipse e          = ellipse_from(l, p, active);
    vfloat n_axis       = vdot(*n, vspread(l->axis));
    vfloat level        = vsqrt(vmax(1.0f - n_axis * n_axis, vsplat(0.0f)));
    vfloat highest      = vdot(*n, vsub(vspread(l->centre), *p)) + l->radius * level;
    vfloat away         = vsqrt(e.d * e.d + e.z * e.z + l->radius * l->radius);
    vfloat sin_a        = 2.0f * l->radius / (e.r1 + e.r2);
    vfloat sin_b        = vsqrt(0.5f * e.s_plus / e.s);
    vfloat strength     = PI * rgb_luminance(l->radiance) * sin_a * sin_b;
    return vkeep(e.lit & (highest > 0.0f), strength * (highest / away));
}

/* All from the centre c, E = pi R^2 L z / r^3. With x from the point to a place of the disk, V(x) =
 * L z x / |x|^4 is what a unit of area gives a surface facing x, and n . V one with the normal n
 * above whose horizon it is. m = r - R is less than any distance.
 *
 * No part below the horizon: the first order cancels, for c is the middle. In any direction
 * |V''| <= 12 L z / m^5 (as for a line: linear.c), and the mean of |x - c|^2 is R^2 / 2; hence
 *
 *     |error| <= pi R^2 L z (R^2 / 4) 12 / m^5                                             [A]
 *
 * Cut by the horizon: n . x is f + s v, v from c up the slope, |f| <= s R, 0 <= s <= 1. With the
 * positive part +, q = L z / |x|^4, |q'| <= 4 L z / m^5, and means over the disk
 *
 *     |error| = pi R^2 |mean((q - q0)(f + s v)+) + q0 (mean((f + s v)+) - f+)|
 *             <= pi R^2 L z ((4 / m^5) R (2R / 3) + (1 / r^4) 2R / (3 pi))                 [B]
 *
 * the last being largest where f = 0; mean |x - c| is 2R / 3, the mean of v+ 2R / (3 pi). The
 * first order stays in [B]: seen edge-on, half of the disk lights a surface that its centre
 * does not. */
static vmask disk_as_point(const light *self, const vvec3 *p, vmask active, vlight_sample *out,
                           vfloat *error)
{
    const disk_light *l = (const disk_light *)self;
    float radius        = l->radius;
    vvec3 to            = vsub(vspread(l->centre), *p);
    vfloat dist2        = vdot(to, to);
    vfloat dist         = vsqrt(dist2);
    vfloat z            = -vdot(to, vspread(l->axis));
    vmask lit           = active & (z > 0.0f);
    vfloat cos_l        = z / dist;
    float area          = PI * radius * radius;

    out->wi   = vkeep3(lit, vscale(to, 1.0f / dist));
    out->dist = vkeep(lit, dist);
    out->e    = vscale(vspread(l->radiance), vkeep(lit, area * cos_l / dist2));
    out->pdf  = vkeep(lit, vsplat(INFINITY));

    vfloat m     = dist - radius;
    vfloat m2    = m * m;
    vfloat small = radius / m;
    vfloat ratio = m / dist;
    vfloat whole = 3.0f * small * small;
    vfloat cut   = small * (0.212206591f * (ratio * ratio * ratio * ratio) + 2.66666667f * small);
    vfloat bound = rgb_luminance(l->radiance) * area * (z / m) / m2 * vmax(whole, cut);
    *error       = vkeep(lit, vselect(m > radius, bound, vsplat(INFINITY)));
    return lit;
}

static vec3 disk_flux(const light *self)
{
    const disk_light *l = (const disk_light *)self;
    return v3_scale(l->radiance, PI * PI * l->radius * l->radius);
}

static vmask disk_emit(const light *self, const light_target *to, vfloat s, vfloat t, vfloat u,
                       vfloat v, vmask active, vlight_ray *out)
{
    const disk_light *l = (const disk_light *)self;
    (void)to;
    vfloat x, y;
    vsquare_to_disk(s, t, &x, &y);
    vvec3 off = vadd(vscale(vspread(l->u), l->radius * x), vscale(vspread(l->v), l->radius * y));

    out->origin    = vkeep3(active, vadd(vspread(l->centre), off));
    out->direction = vkeep3(active, vwarp_cosine_about(vspread(l->axis), u, v));
    out->flux      = vkeep3(active, vspread(disk_flux(self)));
    return active;
}

static vec3 disk_peak(const light *self, vec3 *toward)
{
    const disk_light *l = (const disk_light *)self;
    *toward             = l->axis;
    return v3_scale(l->radiance, PI * l->radius * l->radius);
}

static light_bounds disk_bounds(const light *self)
{
    const disk_light *l = (const disk_light *)self;
    vec3 c = l->centre, n = l->axis;
    vec3 half  = { l->radius * sqrtf(fmaxf(0.0f, 1.0f - n.x * n.x)),
                   l->radius * sqrtf(fmaxf(0.0f, 1.0f - n.y * n.y)),
                   l->radius * sqrtf(fmaxf(0.0f, 1.0f - n.z * n.z)) };
    float peak = rgb_luminance(l->radiance) * PI * l->radius * l->radius;
    return (light_bounds){ .low        = { c.x - half.x, c.y - half.y, c.z - half.z },
                           .high       = { c.x + half.x, c.y + half.y, c.z + half.z },
                           .axis       = n,
                           .cos_spread = 1.0f,
                           .cos_reach  = 0.0f,
                           .peak       = peak };
}

static const light_type disk_type = { .name       = "disk",
                                      .sample     = disk_sample,
                                      .hit        = disk_hit,
                                      .irradiance = disk_irradiance,
                                      .weight     = disk_weight,
                                      .as_point   = disk_as_point,
                                      .emit       = disk_emit,
                                      .flux       = disk_flux,
                                      .peak       = disk_peak,
                                      .bounds     = disk_bounds };

const light *light_disk(arena *a, const disk_desc *d, lux_error *err)
{
    float length = v3_length(d->aim);
    if (!(length > 0.0f && length < INFINITY))
        return failed(err, ERR_ARGUMENT, "disk light: the aim has no length");
    if (!(d->radius >= 1e-6f && d->radius <= 1e6f))
        return failed(err, ERR_ARGUMENT, "disk light: a radius of %g m, wanted 1e-6 to 1e6",
                      (double)d->radius);
    if (!v3_nonnegative(d->radiance))
        return failed(err, ERR_ARGUMENT, "disk light: a radiance is not >= 0 W/(sr m^2)");

    disk_light *l = arena_new(a, disk_light, err);
    if (!l)
        return NULL;
    l->base     = (light){ &disk_type };
    l->centre   = d->centre;
    l->axis     = v3_scale(d->aim, 1.0f / length);
    l->radius   = d->radius;
    l->radiance = d->radiance;
    v3_frame(l->axis, &l->u, &l->v);
    return &l->base;
}
