/* lights/triangle.c -- a triangle of a glowing surface, of even radiance L, that shines from both
 * sides.
 *
 * Sampled evenly in solid angle (the map of Arvo, "Stratified Sampling of Spherical Triangles",
 * SIGGRAPH 1995, in tangents of half angles, of which nothing cancels: slivers and triangles far
 * away keep their digits, and need no sampling by area). Seen from the point, the corners are a, b,
 * c, and S is the solid angle (Van Oosterom & Strackee 1983):
 *
 *     tan(S/2) = h 2 area / (|a||b||c| + (a.b)|c| + (b.c)|a| + (c.a)|b|)
 *
 * A triangle of the angle alpha at a between sides of arcs x and y has tan(S/2) = k sin(alpha) /
 * (1 + k cos(alpha)), k = tan(x/2) tan(y/2). So q on the side from a to c cuts off s of S where
 *
 *     tan(aq/2) = sin(sigma) / (tan(ab/2) sin(alpha - sigma))        sigma = s S / 2
 *
 * and t picks the place on the arc from b to q, even in the cosine to b: sin(bp/2)^2 = t
 * sin(bq/2)^2. The angle at a is that of the planes of a, b and a, c; their normals are a x b and a
 * x c.
 */
#include "core/color.h"
#include "core/warp.h"
#include "lights/polygon.h"

#include <float.h>

typedef struct triangle_light {
    light base;
    polygon shape;
    vec3 radiance; /* W/(sr m^2) */
} triangle_light;

/* Close by above or below it (of the height, in units of `reach`) corners are all but opposite to
 * each other, and where arcs between them run is lost: directions even on the hemisphere take their
 * place, of which those that miss give nothing. Not if there were too many of those (sr). */
static const float CLOSE = 0.001f, CLOSE_ANGLE = 1.0f;

/* The triangle as seen from points; z is toward its plane, from either side. */
typedef struct view {
    vvec3 a, b, c;     /* m, from the point to the corners */
    vfloat ra, rb;     /* m, their lengths */
    vfloat ab, bc, ca; /* m^2, dot products */
    vfloat volume;     /* m^3, six times that of the tetrahedron */
    vfloat half;       /* sr, half the solid angle; > 0 in lit lanes */
    vmask close;       /* sampled as the hemisphere is */
    vmask lit;
} view;

static view look(const triangle_light *l, vvec3 place, vmask active)
{
    const polygon *g = &l->shape;
    vfloat h         = vabs(place.z);
    view v           = { .a = { g->x[0] - place.x, g->y[0] - place.y, h },
                         .b = { g->x[1] - place.x, g->y[1] - place.y, h },
                         .c = { g->x[2] - place.x, g->y[2] - place.y, h } };
    v.ra             = vlength(v.a);
    v.rb             = vlength(v.b);
    vfloat rc        = vlength(v.c);
    v.ab             = vdot(v.a, v.b);
    v.bc             = vdot(v.b, v.c);
    v.ca             = vdot(v.c, v.a);
    v.volume         = h * (2.0f * g->area);
    v.half           = vatan2(v.volume, v.ra * v.rb * rc + v.ab * rc + v.bc * v.ra + v.ca * v.rb);
    v.lit            = active & (h > 0.0f) & (v.half > 0.0f);
    v.close          = (h < CLOSE * g->reach) & (v.half > 0.5f * CLOSE_ANGLE);
    return v;
}

/* How far along the straight line from a to b the arc ends whose half has the tangent t: of
 * a^2 = a . a, ab = a . b and the length of a x b. In [0, 1]. */
static vfloat along(vfloat a2, vfloat ab, vfloat cross, vfloat t)
{
    vfloat reach = a2 * (2.0f * t);
    vfloat x     = reach / (reach - ab * (2.0f * t) + cross * (1.0f - t * t));
    return vmin(vmax(x, vsplat(0.0f)), vsplat(1.0f));
}

static vvec3 pick(const view *v, vfloat s, vfloat t)
{
    /* q, on the side from a to c */
    vvec3 to_c      = vsub(v->c, v->a);
    vvec3 n_ab      = vcross(v->a, vsub(v->b, v->a));
    vvec3 n_ac      = vcross(v->a, to_c);
    vfloat cross_ac = vlength(n_ac);
    vfloat sigma    = s * v->half;
    vfloat sin_s = vsin(sigma), cos_s = vcos(sigma);
    vfloat rest  = v->volume * v->ra * cos_s - vdot(n_ab, n_ac) * sin_s; /* ~ sin(alpha - sigma) */
    vfloat tan_q = sin_s * (v->ra * v->rb + v->ab) * cross_ac / vmax(rest, vsplat(FLT_MIN));
    vvec3 q      = valong(v->a, to_c, along(v->ra * v->ra, v->ca, cross_ac, tan_q));

    /* The place, on the arc from b to q */
    vvec3 to_q      = vsub(q, v->b);
    vfloat bq       = vdot(v->b, q);
    vfloat cross_bq = vlength(vcross(v->b, to_q));
    vfloat m        = cross_bq / (v->rb * vlength(q) + bq); /* tan(bq/2) */
    vfloat m2       = m * m;
    vfloat tan_p    = m * vsqrt(t / (1.0f + m2 * (1.0f - t)));
    return valong(v->b, to_q, along(v->rb * v->rb, bq, cross_bq, tan_p));
}

/* Whether a place of the plane, seen from the foot, is of the triangle. */
static vmask contains(const view *v, vvec3 at)
{
    const vvec3 corner[3] = { v->a, v->b, v->c };
    vmask within          = ALL_LANES;
    for (int i = 0; i < 3; i++) {
        vvec3 from = corner[i];
        vvec3 side = vsub(corner[i < 2 ? i + 1 : 0], from);
        within &= side.x * (at.y - from.y) - side.y * (at.x - from.x) >= 0.0f;
    }
    return within;
}

/* 1/sr */
static vfloat density(const view *v)
{
    return vselect(v->close, vsplat(0.5f / WARP_PI), 0.5f / v->half);
}

static vmask triangle_sample(const light *self, const vvec3 *p, vfloat s, vfloat t, vmask active,
                             vlight_sample *out)
{
    const triangle_light *l = (const triangle_light *)self;
    vvec3 place             = vpolygon_place(&l->shape, p);
    view v                  = look(l, place, active);
    vvec3 at                = pick(&v, s, t);
    vmask lit               = v.lit;
    if (vany(v.lit & v.close)) {
        vvec3 w = vwarp_sphere(0.5f * s, t); /* z > 0 */
        at      = vselect3(v.close, vscale(w, v.a.z / w.z), at);
        lit &= ~v.close | contains(&v, at);
    }
    vvec3 to   = { at.x, at.y, -place.z };
    vfloat r   = vlength(to);
    vfloat pdf = density(&v);

    out->wi   = vkeep3(lit, vpolygon_turn_back(&l->shape, vscale(to, 1.0f / r)));
    out->dist = vkeep(lit, r);
    out->e    = vkeep3(lit, vscale(vspread(l->radiance), 1.0f / pdf));
    out->pdf  = vkeep(lit, pdf);
    return lit;
}

static vmask triangle_hit(const light *self, const vvec3 *p, const vvec3 *wi, vmask active,
                          vlight_hit *out)
{
    const triangle_light *l = (const triangle_light *)self;
    vvec3 place             = vpolygon_place(&l->shape, p);
    vvec3 w                 = vpolygon_turn(&l->shape, *wi);
    view v                  = look(l, place, active);
    vfloat r                = -place.z / w.z;
    vmask met               = v.lit & (r > 0.0f) & (r < INFINITY) & contains(&v, vscale(w, r));

    out->dist     = vkeep(met, r);
    out->radiance = vkeep3(met, vspread(l->radiance));
    out->pdf      = vkeep(met, density(&v));
    return met;
}

/* A place or direction of the frame, with the lit side up. */
static vvec3 upright(vvec3 place, vvec3 a)
{
    return (vvec3){ a.x, a.y, vselect(place.z < 0.0f, -a.z, a.z) };
}

static vrgb triangle_irradiance(const light *self, const vvec3 *p, const vvec3 *n, vmask active)
{
    const triangle_light *l = (const triangle_light *)self;
    vvec3 place             = vpolygon_place(&l->shape, p);
    vvec3 normal            = vpolygon_turn(&l->shape, *n);
    vfloat e = vpolygon_irradiance(&l->shape, upright(place, place), upright(place, normal));
    return vscale(vspread(l->radiance), vkeep(active, e));
}

/* The solid angle, by the cosine of what of the corners and the centroid is highest. */
static vfloat triangle_weight(const light *self, const vvec3 *p, const vvec3 *n, vmask active)
{
    const triangle_light *l = (const triangle_light *)self;
    vvec3 place             = vpolygon_place(&l->shape, p);
    view v                  = look(l, place, active);
    vfloat high             = vpolygon_highest(&l->shape, place, vpolygon_turn(&l->shape, *n));
    vfloat e                = rgb_luminance(l->radiance) * (2.0f * v.half) * high;
    return vkeep(v.lit & (high > 0.0f), e);
}

static vmask triangle_as_point(const light *self, const vvec3 *p, vmask active, vlight_sample *out,
                               vfloat *error)
{
    const triangle_light *l = (const triangle_light *)self;
    return vpolygon_as_point(&l->shape, vpolygon_place(&l->shape, p), l->radiance, 2, active, out,
                             error);
}

static vec3 triangle_peak(const light *self, vec3 *toward)
{
    const triangle_light *l = (const triangle_light *)self;
    *toward                 = l->shape.n; /* and straight away from it */
    return v3_scale(l->radiance, l->shape.area);
}

static vec3 triangle_flux(const light *self)
{
    const triangle_light *l = (const triangle_light *)self;
    return v3_scale(l->radiance, l->shape.area * (float)(2.0 * M_PI));
}

/* u picks the side, too. */
static vmask triangle_emit(const light *self, const light_target *to, vfloat s, vfloat t, vfloat u,
                           vfloat v, vmask active, vlight_ray *out)
{
    const triangle_light *l = (const triangle_light *)self;
    const polygon *g        = &l->shape;
    (void)to;
    vfloat b, c;
    vwarp_triangle(s, t, &b, &c);
    vvec3 place = { g->x[0] + b * (g->x[1] - g->x[0]) + c * (g->x[2] - g->x[0]),
                    g->y[0] + b * (g->y[1] - g->y[0]) + c * (g->y[2] - g->y[0]), vsplat(0.0f) };
    vmask back  = u >= 0.5f;
    vvec3 way   = vwarp_cosine(2.0f * u - vkeep(back, vsplat(1.0f)), v);
    way.z       = vselect(back, -way.z, way.z);

    out->origin    = vkeep3(active, vadd(vspread(g->centre), vpolygon_turn_back(g, place)));
    out->direction = vkeep3(active, vpolygon_turn_back(g, way));
    out->flux      = vkeep3(active, vspread(triangle_flux(self)));
    return active;
}

/* Hemispheres about both of its normals, and so about all directions. */
static light_bounds triangle_bounds(const light *self)
{
    const triangle_light *l = (const triangle_light *)self;
    light_bounds b          = polygon_bounds(&l->shape);
    b.cos_spread            = -1.0f;
    b.peak                  = rgb_luminance(l->radiance) * l->shape.area;
    return b;
}

static const light_type triangle_type = { .name       = "triangle",
                                          .sample     = triangle_sample,
                                          .hit        = triangle_hit,
                                          .irradiance = triangle_irradiance,
                                          .weight     = triangle_weight,
                                          .as_point   = triangle_as_point,
                                          .emit       = triangle_emit,
                                          .flux       = triangle_flux,
                                          .peak       = triangle_peak,
                                          .bounds     = triangle_bounds };

const light *light_triangle(arena *a, const triangle_desc *d, lux_error *err)
{
    dvec3 corner[3];
    for (int i = 0; i < 3; i++)
        corner[i] = d3_from(d->corner[i]);
    dvec3 side  = d3_sub(corner[1], corner[0]);
    dvec3 n     = d3_cross(side, d3_sub(corner[2], corner[0]));
    double area = d3_length(n);
    if (!(0.5 * area >= (double)FLT_MIN && area < HUGE_VAL))
        return failed(err, ERR_ARGUMENT, "triangle light: it has no area");
    if (!v3_nonnegative(d->radiance))
        return failed(err, ERR_ARGUMENT, "triangle light: a radiance is not >= 0 W/(sr m^2)");

    triangle_light *l = arena_new(a, triangle_light, err);
    if (!l)
        return NULL;
    l->base     = (light){ &triangle_type };
    l->radiance = d->radiance;
    polygon_make(&l->shape, corner, 3, d3_scale(side, 1.0 / d3_length(side)),
                 d3_scale(n, 1.0 / area));
    return &l->base;
}
