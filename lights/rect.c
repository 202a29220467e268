/* lights/rect.c -- a flat rectangle of even radiance L that shines from one side.
 *
 * Sampled evenly in solid angle (the result of Urena, Fajardo & King, "An Area-Preserving
 * Parametrization for Spherical Rectangles", EGSR 2013, by another way). From its foot in the plane
 * and h above it a point sees [x0, x1] x [y0, y1]. With
 *
 *     s_i = y_i / sqrt(y_i^2 + h^2)        e_i = h / sqrt(y_i^2 + h^2)
 *     c   = x / sqrt(x^2 + h^2)
 *
 * the solid angle of [0, x] x [y0, y1] is A = asin(c s1) - asin(c s0), and solved for x
 *
 *     x = h sin A / sqrt((cos A - s0 s1)^2 - (e0 e1)^2)
 *
 * So an even number s gives x by A = A(x0) + s S, S the solid angle of all; and an even t gives y
 * at that x, since the solid angle of a narrow strip is even in y / sqrt(x^2 + y^2 + h^2). No arc
 * is needed but S: the sum of those of its two triangles, by the tangents of their halves, in which
 * nothing cancels however small they are (Van Oosterom & Strackee 1983).
 */
#include "core/color.h"
#include "core/warp.h"
#include "lights/polygon.h"

#include <float.h>

typedef struct rect_light {
    light base;
    polygon shape; /* v along the longer side */
    vec3 radiance; /* W/(sr m^2) */
} rect_light;

/* sr. Below it, places are even in area: of x by solid angle the rounding of 1 in sin A is lost, as
 * much as 1e-3 of the width here, and the pdf by area varies by 1 %. */
static const float BY_AREA = 1e-4f;

/* sr. Above it, the solid angle is the sum of four arcs. */
static const float WIDE = 1.0f;

/* The rectangle as seen from points. */
typedef struct view {
    vfloat x0, x1, y0, y1, h;  /* m, from the foot; the height */
    vfloat r00, r01, r10, r11; /* m, to the corners (x0, y0), (x0, y1), (x1, y0), (x1, y1) */
    vfloat angle;              /* sr, > 0 in lit lanes */
    vmask lit;
} view;

static vfloat hypot3(vfloat x, vfloat y, vfloat h) { return vsqrt(x * x + y * y + h * h); }

/* The solid angle by its triangles 00 10 11 and 00 11 01. */
static vfloat by_triangles(const view *v, vfloat area)
{
    vfloat xx = v->x0 * v->x1, yy = v->y0 * v->y1, h2 = v->h * v->h;
    vfloat cross = v->r00 * v->r11 + (xx + yy + h2);
    vfloat low =
        v->r10 * cross + (xx + v->y0 * v->y0 + h2) * v->r11 + (v->x1 * v->x1 + yy + h2) * v->r00;
    vfloat high =
        v->r01 * cross + (xx + v->y1 * v->y1 + h2) * v->r00 + (v->x0 * v->x0 + yy + h2) * v->r11;
    vfloat volume = v->h * area;
    return 2.0f * vatan2(volume * (low + high), low * high - volume * volume);
}

/* The sum of the angles atan(x y / (h r)) of the corners, each a complex number, about that of
 * by_triangles(): to a rounding of pi where that one, close by above an edge, has lost digits. */
static vfloat by_corners(const view *v, vfloat about)
{
    vfloat r0 = v->h * v->r00, i0 = v->x0 * v->y0;
    vfloat r1 = v->h * v->r11, i1 = v->x1 * v->y1;
    vfloat r2 = v->h * v->r01, i2 = -v->x0 * v->y1;
    vfloat r3 = v->h * v->r10, i3 = -v->x1 * v->y0;
    vfloat ra = r0 * r1 - i0 * i1, ia = r0 * i1 + i0 * r1;
    vfloat rb = r2 * r3 - i2 * i3, ib = r2 * i3 + i2 * r3;
    vfloat angle = vatan2(ra * ib + ia * rb, ra * rb - ia * ib);
    return angle + vkeep(about - angle > WARP_PI, vsplat(2.0f * WARP_PI));
}

static view look(const rect_light *l, vvec3 place, vmask active)
{
    const polygon *g = &l->shape;
    view v           = { .x0 = g->x[0] - place.x,
                         .x1 = g->x[2] - place.x,
                         .y0 = g->y[0] - place.y,
                         .y1 = g->y[2] - place.y,
                         .h  = place.z };
    v.r00            = hypot3(v.x0, v.y0, v.h);
    v.r01            = hypot3(v.x0, v.y1, v.h);
    v.r10            = hypot3(v.x1, v.y0, v.h);
    v.r11            = hypot3(v.x1, v.y1, v.h);
    v.angle          = by_triangles(&v, vsplat(g->area));

    /* All but a half space, and rounded beyond it */
    v.angle    = vselect(v.angle < -WARP_PI, v.angle + 4.0f * WARP_PI, v.angle);
    v.lit      = active & (v.h > 0.0f) & (v.angle > 0.0f);
    vmask wide = v.lit & (v.angle > WIDE);
    if (vany(wide))
        v.angle = vselect(wide, by_corners(&v, v.angle), v.angle);
    return v;
}

/* (cos A - s0 s1)^2 - (e0 e1)^2 by its factors, that of the difference b of the angles with the
 * sines s0 and s1 as (sin b^2 - sin A^2) / (cos A + cos b) where b is acute. Where cos A and s0 s1
 * are about 1, or -1, they differ by what they lack, which squares of small numbers tell. */
static vfloat radicand(vfloat sin_a, vfloat cos_a, vfloat sin_b, vfloat ss, vfloat e0, vfloat e1)
{
    vfloat ee    = e0 * e1;
    vfloat cos_b = ss + ee;
    vfloat e2    = e0 * e0 + e1 * e1 - ee * ee; /* 1 - (s0 s1)^2 */
    vfloat lacks = e2 / (1.0f + vabs(ss)) - sin_a * sin_a / (1.0f + vabs(cos_a));
    vfloat alike = vselect(ss < 0.0f, -lacks, lacks);
    vfloat gap   = vselect(cos_a * ss > 0.0f, alike, cos_a - ss);
    vfloat acute = (sin_b - sin_a) * (sin_b + sin_a) / (cos_a + cos_b);
    return vselect(cos_b > 0.0f, acute, gap - ee) * (gap + ee);
}

/* x by solid angle, s of it to the left. */
static vfloat place_x(const view *v, vfloat s)
{
    vfloat h  = v->h;
    vfloat w0 = 1.0f / vsqrt(v->y0 * v->y0 + h * h);
    vfloat w1 = 1.0f / vsqrt(v->y1 * v->y1 + h * h);
    vfloat ww = w0 * w1;
    vfloat yy = v->y0 * v->y1;

    /* A(x0), from its parts asin(c s1) and asin(c s0) */
    vfloat d2    = v->x0 * v->x0 + h * h;
    vfloat below = v->y0 * v->r01, above = v->y1 * v->r00;
    vfloat apart = vselect(yy > 0.0f, (v->y1 - v->y0) * (v->y1 + v->y0) / (above + below),
                           (above - below) / d2);
    vfloat sin_0 = v->x0 * h * apart * ww;
    vfloat cos_0 = (h * h * (v->r00 * v->r01) + v->x0 * v->x0 * yy) * ww / d2;

    vfloat step  = s * v->angle;
    vfloat sin_s = vsin(step), cos_s = vcos(step);
    vfloat sin_a = sin_0 * cos_s + cos_0 * sin_s;
    vfloat cos_a = cos_0 * cos_s - sin_0 * sin_s;
    vfloat sin_b = h * (v->y1 - v->y0) * ww;
    vfloat root2 = radicand(sin_a, cos_a, sin_b, yy * ww, h * w0, h * w1);
    vfloat x     = h * sin_a / vsqrt(vmax(root2, vsplat(FLT_MIN)));
    return vmin(vmax(x, v->x0), v->x1);
}

/* y by solid angle, t of the strip at x below it: s of the sine is even. Where all of the strip is
 * to one side its sines may all be about 1; then 1 - |s| is what keeps digits. */
static vfloat place_y(const view *v, vfloat x, vfloat t)
{
    vfloat d2 = x * x + v->h * v->h;
    vfloat w0 = 1.0f / vsqrt(v->y0 * v->y0 + d2);
    vfloat w1 = 1.0f / vsqrt(v->y1 * v->y1 + d2);
    vfloat s0 = v->y0 * w0, s1 = v->y1 * w1;
    vfloat m0 = d2 * (w0 * w0) / (1.0f + vabs(s0));
    vfloat m1 = d2 * (w1 * w1) / (1.0f + vabs(s1));
    vfloat s  = s0 + t * (s1 - s0);
    vfloat m  = m0 + t * (m1 - m0);

    vmask aside = v->y0 * v->y1 > 0.0f;
    vfloat cos2 = vselect(aside, m * (2.0f - m), 1.0f - s * s);
    vfloat y    = s * vsqrt(d2 / vmax(cos2, vsplat(FLT_MIN)));
    return vmin(vmax(y, v->y0), v->y1);
}

/* 1/sr, of a place at the distance r. */
static vfloat density(const rect_light *l, const view *v, vfloat r)
{
    vfloat by_area = r * r * r / (l->shape.area * v->h);
    return vselect(v->angle < BY_AREA, by_area, 1.0f / v->angle);
}

static vmask rect_sample(const light *self, const vvec3 *p, vfloat s, vfloat t, vmask active,
                         vlight_sample *out)
{
    const rect_light *l = (const rect_light *)self;
    view v              = look(l, vpolygon_place(&l->shape, p), active);
    vmask by_area       = v.angle < BY_AREA;
    vfloat x            = v.x0 + s * (v.x1 - v.x0);
    vfloat y            = v.y0 + t * (v.y1 - v.y0);
    if (vany(v.lit & ~by_area)) {
        vfloat even_x = place_x(&v, s);
        vfloat even_y = place_y(&v, even_x, t);
        x             = vselect(by_area, x, even_x);
        y             = vselect(by_area, y, even_y);
    }
    vfloat r   = hypot3(x, y, v.h);
    vfloat pdf = density(l, &v, r);
    vvec3 to   = { x, y, -v.h };

    out->wi   = vkeep3(v.lit, vpolygon_turn_back(&l->shape, vscale(to, 1.0f / r)));
    out->dist = vkeep(v.lit, r);
    out->e    = vkeep3(v.lit, vscale(vspread(l->radiance), 1.0f / pdf));
    out->pdf  = vkeep(v.lit, pdf);
    return v.lit;
}

static vmask rect_hit(const light *self, const vvec3 *p, const vvec3 *wi, vmask active,
                      vlight_hit *out)
{
    const rect_light *l = (const rect_light *)self;
    vvec3 w             = vpolygon_turn(&l->shape, *wi);
    view v              = look(l, vpolygon_place(&l->shape, p), active);
    vfloat r            = v.h / -w.z;
    vfloat x            = w.x * r;
    vfloat y            = w.y * r;
    vmask met = v.lit & (w.z < 0.0f) & (x >= v.x0) & (x <= v.x1) & (y >= v.y0) & (y <= v.y1);

    out->dist     = vkeep(met, r);
    out->radiance = vkeep3(met, vspread(l->radiance));
    out->pdf      = vkeep(met, density(l, &v, r));
    return met;
}

static vrgb rect_irradiance(const light *self, const vvec3 *p, const vvec3 *n, vmask active)
{
    const rect_light *l = (const rect_light *)self;
    vfloat e =
        vpolygon_irradiance(&l->shape, vpolygon_place(&l->shape, p), vpolygon_turn(&l->shape, *n));
    return vscale(vspread(l->radiance), vkeep(active, e));
}

/* The solid angle, by the cosine of what of the corners and the centre is highest. */
static vfloat rect_weight(const light *self, const vvec3 *p, const vvec3 *n, vmask active)
{
    const rect_light *l = (const rect_light *)self;
    vvec3 place         = vpolygon_place(&l->shape, p);
    view v              = look(l, place, active);
    vfloat high         = vpolygon_highest(&l->shape, place, vpolygon_turn(&l->shape, *n));
    vfloat e            = rgb_luminance(l->radiance) * v.angle * high;
    return vkeep(v.lit & (high > 0.0f), e);
}

static vmask rect_as_point(const light *self, const vvec3 *p, vmask active, vlight_sample *out,
                           vfloat *error)
{
    const rect_light *l = (const rect_light *)self;
    return vpolygon_as_point(&l->shape, vpolygon_place(&l->shape, p), l->radiance, 1, active, out,
                             error);
}

static vec3 rect_peak(const light *self, vec3 *toward)
{
    const rect_light *l = (const rect_light *)self;
    *toward             = l->shape.n;
    return v3_scale(l->radiance, l->shape.area);
}

static vec3 rect_flux(const light *self)
{
    const rect_light *l = (const rect_light *)self;
    return v3_scale(l->radiance, l->shape.area * (float)M_PI);
}

static vmask rect_emit(const light *self, const light_target *to, vfloat s, vfloat t, vfloat u,
                       vfloat v, vmask active, vlight_ray *out)
{
    const rect_light *l = (const rect_light *)self;
    const polygon *g    = &l->shape;
    (void)to;
    vvec3 place = { vlerp(vsplat(g->x[0]), vsplat(g->x[2]), s),
                    vlerp(vsplat(g->y[0]), vsplat(g->y[2]), t), vsplat(0.0f) };

    out->origin    = vkeep3(active, vadd(vspread(g->centre), vpolygon_turn_back(g, place)));
    out->direction = vkeep3(active, vpolygon_turn_back(g, vwarp_cosine(u, v)));
    out->flux      = vkeep3(active, vspread(rect_flux(self)));
    return active;
}

static light_bounds rect_bounds(const light *self)
{
    const rect_light *l = (const rect_light *)self;
    light_bounds b      = polygon_bounds(&l->shape);
    b.cos_spread        = 1.0f;
    b.peak              = rgb_luminance(l->radiance) * l->shape.area;
    return b;
}

static const light_type rect_type = { .name       = "rect",
                                      .sample     = rect_sample,
                                      .hit        = rect_hit,
                                      .irradiance = rect_irradiance,
                                      .weight     = rect_weight,
                                      .as_point   = rect_as_point,
                                      .emit       = rect_emit,
                                      .flux       = rect_flux,
                                      .peak       = rect_peak,
                                      .bounds     = rect_bounds };

/* ---- making one ------------------------------------------------------------------------- */

/* Corners counter-clockwise about n. v goes along the longer side, where the solid angle has more
 * to tell places apart by: along the width, or along the height. */
static void make_shape(rect_light *l, const rect_desc *d, dvec3 up, dvec3 n)
{
    dvec3 across = d3_cross(n, up);
    bool tall    = d->height >= d->width;
    dvec3 v      = tall ? up : across;
    dvec3 u      = d3_cross(v, n);
    double a     = 0.5 * (double)(tall ? d->width : d->height);
    double b     = 0.5 * (double)(tall ? d->height : d->width);
    dvec3 c      = d3_from(d->centre);
    dvec3 corner[4];
    for (int i = 0; i < 4; i++) {
        double x  = i == 0 || i == 3 ? -a : a;
        double y  = i < 2 ? -b : b;
        corner[i] = d3_add(c, d3_add(d3_scale(u, x), d3_scale(v, y)));
    }
    polygon_make(&l->shape, corner, 4, v, n);
}

const light *light_rect(arena *a, const rect_desc *d, lux_error *err)
{
    dvec3 n     = d3_from(d->aim);
    double size = d3_length(n);
    if (!(size > 0.0 && size < HUGE_VAL))
        return failed(err, ERR_ARGUMENT, "rect light: the aim has no length");
    n            = d3_scale(n, 1.0 / size);
    dvec3 up     = d3_from(d->up);
    double long_ = d3_length(up);
    up           = d3_sub(up, d3_scale(n, d3_dot(up, n)));
    double high  = d3_length(up);
    if (!(high > 1e-6 * long_ && long_ < HUGE_VAL))
        return failed(err, ERR_ARGUMENT, "rect light: up has no length or lies along the aim");
    if (!(d->width > 0.0f && d->width < INFINITY && d->height > 0.0f && d->height < INFINITY))
        return failed(err, ERR_ARGUMENT, "rect light: a side is not > 0 m");
    if (!v3_nonnegative(d->radiance))
        return failed(err, ERR_ARGUMENT, "rect light: a radiance is not >= 0 W/(sr m^2)");

    rect_light *l = arena_new(a, rect_light, err);
    if (!l)
        return NULL;
    l->base     = (light){ &rect_type };
    l->radiance = d->radiance;
    make_shape(l, d, d3_scale(up, 1.0 / high), n);
    return &l->base;
}
