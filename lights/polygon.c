/* lights/polygon.c -- the light of a flat Lambertian polygon, in closed form and as a point.
 *
 * Lambert's formula (1760): with v_i the corners seen from the lit point, c_i = v_i x v_i+1 and
 * theta_i the angle between them, of a polygon above the horizon of n,
 *
 *     E = (L/2) sum theta_i (c_i . n) / |c_i|
 *
 * In the frame of the polygon, the foot of the point its origin, h the height, an edge from a to b:
 *
 *     c       = (h dy, -h dx, t)             t = a x b, in the plane
 *     |c|     = sqrt(t^2 + h^2 |b - a|^2)
 *     theta   = atan2(|c|, a . b + h^2)
 *
 * Along the polygon's plane all terms have a factor h, and it stands before the sum. Square to it,
 * terms that are not small cancel where the point is near the plane: what they are at h = 0, the
 * angles theta0 of the edges around the foot, sums to 2 pi or 0 as the foot is inside or outside.
 * So only what differs from that is added, with the sign of t, each of order h^2:
 *
 *     |t| theta / |c| - theta0 = (theta - theta0) - theta (|c| - |t|) / |c|
 *     tan(theta - theta0)      = (a . b (|c| - |t|) - |t| h^2) / (|c| |t| + a . b (a . b + h^2))
 *     |c| - |t|                = h^2 |b - a|^2 / (|c| + |t|)
 *
 * Far away edges cancel whatever is done; there the integral of h (n . v) / |v|^4 is a smooth one,
 * and taken by the 7 points of Radon (1948), exact to the fifth degree, on the triangles of edges
 * and one place of the polygon.
 */
#include "lights/polygon.h"

#include "core/color.h"
#include "core/warp.h"

/* Distance in units of `reach` from which the quadrature is used: its error, of the order of
 * 0.01 (size / distance)^6 of the value, is then as small as the rounding of Lambert's sum. */
static const float FAR = 8.0f;

/* The largest float below pi. */
static const float BELOW_PI = 3.14159250f;

/* An edge, or what of it is above the horizon; from the centroid, so that its length keeps its
 * digits however far the point is. */
typedef struct edge {
    vfloat ax, ay, bx, by;
    vmask present;
} edge;

/* The polygon cut by the horizon: what is left of its edges, and the edge along the horizon. */
typedef struct outline {
    edge edges[POLYGON_CORNERS + 1];
    int count;
    vmask whole;  /* nothing cut off */
    vmask inside; /* the foot is inside of what is left */
} outline;

static vfloat vlerp_to(vfloat a, vfloat b, vfloat t) { return a + t * (b - a); }

/* The part of an edge where f >= 0, f a linear function, fa and fb at its ends. */
static edge cut(edge e, vfloat fa, vfloat fb)
{
    vfloat t = vkeep(fa != fb, fa / (fa - fb));
    vfloat x = vlerp_to(e.ax, e.bx, t);
    vfloat y = vlerp_to(e.ay, e.by, t);
    vmask in = fa >= 0.0f, stays = fb >= 0.0f;
    return (edge){ vselect(in, e.ax, x), vselect(in, e.ay, y), vselect(stays, e.bx, x),
                   vselect(stays, e.by, y), in | stays };
}

/* t: twice the area of the edge and the foot, > 0 if that is to the left. */
static vfloat turn_of(const edge *e, vvec3 place)
{
    return (e->ax - place.x) * (e->by - e->ay) - (e->ay - place.y) * (e->bx - e->ax);
}

/* Edges need no order: each is cut by itself, and the one along the horizon goes from where the
 * outline sinks below it to where it rises. */
static outline cut_at_horizon(const polygon *g, vvec3 place, vvec3 n)
{
    outline o    = { .count = g->corners + 1, .whole = ALL_LANES, .inside = ALL_LANES };
    edge horizon = { 0 };
    vmask rises = { 0 }, sinks = { 0 };
    vfloat middle = vdot(n, place);
    for (int i = 0; i < g->corners; i++) {
        int k  = i + 1 < g->corners ? i + 1 : 0;
        edge e = { vsplat(g->x[i]), vsplat(g->y[i]), vsplat(g->x[k]), vsplat(g->y[k]), ALL_LANES };
        vfloat fa = n.x * e.ax + n.y * e.ay - middle;
        vfloat fb = n.x * e.bx + n.y * e.by - middle;
        o.whole &= fa >= 0.0f;
        o.inside &= turn_of(&e, place) >= 0.0f;

        vmask down = (fa >= 0.0f) & ~(fb >= 0.0f);
        vmask up   = ~(fa >= 0.0f) & (fb >= 0.0f);
        o.edges[i] = cut(e, fa, fb);
        horizon.ax = vselect(down, o.edges[i].bx, horizon.ax);
        horizon.ay = vselect(down, o.edges[i].by, horizon.ay);
        horizon.bx = vselect(up, o.edges[i].ax, horizon.bx);
        horizon.by = vselect(up, o.edges[i].ay, horizon.by);
        sinks |= down;
        rises |= up;
    }
    horizon.present     = sinks & rises;
    o.edges[g->corners] = horizon;
    o.inside &= o.whole | (n.z <= 0.0f); /* is the foot above the horizon? */
    return o;
}

/* What an edge adds along the plane, of which n takes (ny dx - nx dy), and square to it, without
 * its sign. */
static vfloat edge_terms(const edge *e, vvec3 place, vfloat turn, vfloat *square)
{
    vfloat dx    = e->bx - e->ax;
    vfloat dy    = e->by - e->ay;
    vfloat h     = place.z;
    vfloat ab    = (e->ax - place.x) * (e->bx - place.x) + (e->ay - place.y) * (e->by - place.y);
    vfloat h2    = h * h;
    vfloat t     = vabs(turn);
    vfloat rise  = h2 * (dx * dx + dy * dy);
    vfloat c     = vsqrt(t * t + rise);
    vmask some   = e->present & (c > 0.0f);
    vfloat inv   = vkeep(some, 1.0f / c);
    vfloat lift  = vkeep(some, rise / (c + t));
    vfloat theta = vatan2(c, ab + h2);
    vfloat tilt  = vatan2(ab * lift - t * h2, c * t + ab * (ab + h2)); /* theta - theta0 */
    *square      = vkeep(some, tilt - theta * lift * inv);
    return theta * inv;
}

static vfloat lambert_sum(const outline *o, vvec3 place, vvec3 n)
{
    vfloat along = vsplat(0.0f), square = vsplat(0.0f);
    for (int i = 0; i < o->count; i++) {
        const edge *e = &o->edges[i];
        vfloat dx     = e->bx - e->ax;
        vfloat dy     = e->by - e->ay;
        vfloat turn   = turn_of(e, place);

        /* Of a short edge along the horizon the turn is but rounding: the foot tells its sign */
        vfloat sign = i + 1 < o->count ? turn : -n.z;
        vfloat off;
        along  = along + edge_terms(e, place, turn, &off) * (n.y * dx - n.x * dy);
        square = square + vselect(sign < 0.0f, -off, off);
    }
    return 0.5f * place.z * along - n.z * (vkeep(o->inside, vsplat(WARP_PI)) + 0.5f * square);
}

/* (n . v) / |v|^4 over the triangle of an edge and (px, py), from the centroid. */
static vfloat triangle_sum(const edge *e, vfloat px, vfloat py, vvec3 place, vvec3 n)
{
    static const float at[7][3] = {
        { 0.333333333f, 0.333333333f, 0.225f },
        { 0.0597158718f, 0.470142064f, 0.132394153f },
        { 0.470142064f, 0.0597158718f, 0.132394153f },
        { 0.470142064f, 0.470142064f, 0.132394153f },
        { 0.797426985f, 0.101286507f, 0.125939181f },
        { 0.101286507f, 0.797426985f, 0.125939181f },
        { 0.101286507f, 0.101286507f, 0.125939181f },
    };
    vfloat ax = e->ax - px, ay = e->ay - py;
    vfloat bx = e->bx - px, by = e->by - py;
    vfloat sum = vsplat(0.0f);
    for (int i = 0; i < 7; i++) {
        vvec3 v   = { px + at[i][0] * ax + at[i][1] * bx, py + at[i][0] * ay + at[i][1] * by,
                      vsplat(0.0f) };
        vvec3 to  = vsub(v, place);
        vfloat r2 = vdot(to, to);
        sum       = sum + at[i][2] * vdot(n, to) / (r2 * r2);
    }
    return vkeep(e->present, sum * (0.5f * (ax * by - ay * bx)));
}

/* The place shared by the triangles is the centroid, or one on the horizon. */
static vfloat quadrature(const outline *o, vvec3 place, vvec3 n)
{
    const edge *horizon = &o->edges[o->count - 1];
    vfloat px           = vkeep(horizon->present, horizon->ax);
    vfloat py           = vkeep(horizon->present, horizon->ay);
    vfloat sum          = vsplat(0.0f);
    for (int i = 0; i + 1 < o->count; i++)
        sum = sum + triangle_sum(&o->edges[i], px, py, place, n);
    return sum * place.z;
}

vfloat vpolygon_irradiance(const polygon *g, vvec3 place, vvec3 n)
{
    outline o = cut_at_horizon(g, place, n);
    vmask far = vdot(place, place) >= FAR * FAR * g->reach * g->reach;
    vmask lit = (place.z > 0.0f) & (o.whole | o.edges[g->corners].present);
    vfloat e  = vsplat(0.0f);
    if (vany(lit & ~far))
        e = lambert_sum(&o, place, n);
    if (vany(lit & far))
        e = vselect(far, quadrature(&o, place, n), e);
    return vkeep(lit, vmin(vmax(e, vsplat(0.0f)), vsplat(BELOW_PI)));
}

vfloat vpolygon_highest(const polygon *g, vvec3 place, vvec3 n)
{
    const float rounding = 1e-6f; /* rad: of directions, by which a sample may be above them */
    vfloat d2            = vdot(place, place);
    vfloat best          = -vdot(n, place) / vsqrt(d2);
    for (int i = 0; i < g->corners; i++) {
        vvec3 to = { g->x[i] - place.x, g->y[i] - place.y, -place.z };
        best     = vmax(vdot(n, to) / vsqrt(vdot(to, to)), best);
    }
    return vmin(best + rounding, vsplat(1.0f));
}

/* All from the centroid, v0 and d away. With f(y) = h (v0 + y) / |v0 + y|^4 the irradiance is
 * L times the integral of max(n . f(y), 0) over y. By Taylor n . f(y) = g + l(y) + q(y) with
 *
 *     g      = (h/d^4) (n . v0)
 *     l(y)   = (h/d^4) (n . y - 4 (n . v0) (v0 . y) / d^2)
 *     |q(y)| <= 6 h |y|^2 / (d - R)^5
 *
 * since the second derivative of v / |v|^4 along a unit vector is at most 12 / |v|^5: it is
 * sqrt(192 s^4 - 64 s^2 + 16) / |v|^5, s the cosine between them. About the centroid the mean of l
 * is 0. If d >= 4 R, -l - g <= -(h/d^4) (n . y) for g >= 0 (and so in mirror image for g < 0): what
 * the horizon cuts off adds at most half the mean of |n . y|, which is at most the standard
 * deviation. Hence, E0 = L A h / d^3 being the irradiance that faces the centroid,
 *
 *     error <= E0 (deviation / (2 d) + 6 (moment / d^2) (d / (d - R))^5)
 *
 * of which the first term is needed only for surfaces whose horizon cuts the polygon. */
vmask vpolygon_as_point(const polygon *g, vvec3 place, vec3 radiance, int sides, vmask active,
                        vlight_sample *out, vfloat *error)
{
    vfloat d2    = vdot(place, place);
    vfloat d     = vsqrt(d2);
    vfloat inv_d = 1.0f / d;
    vfloat h     = sides == 2 ? vabs(place.z) : place.z;
    vmask lit    = active & (h > 0.0f);
    vfloat share = g->area * (h * inv_d) * (inv_d * inv_d);

    out->wi   = vkeep3(lit, vpolygon_turn_back(g, vscale(place, -inv_d)));
    out->dist = vkeep(lit, d);
    out->e    = vkeep3(lit, vscale(vspread(radiance), share));
    out->pdf  = vkeep(lit, vsplat(INFINITY));

    /* Of the height, in units of the distance, and of what follows */
    const float rounding = 1e-6f;
    vfloat inv_d2        = inv_d * inv_d;
    vfloat near_         = d / (d - g->reach);
    vfloat near5         = near_ * near_ * (near_ * near_) * near_;
    vfloat first         = 0.5f * g->deviation * inv_d;
    vfloat second        = 6.0f * g->moment * inv_d2 * near5;
    vfloat off           = share * (first + second) + rounding * g->area * inv_d2;
    vfloat bound         = rgb_luminance(radiance) * off;
    *error               = vkeep(lit, vselect(d >= 4.0f * g->reach, bound, vsplat(INFINITY)));
    return lit;
}

light_bounds polygon_bounds(const polygon *g)
{
    vec3 low = g->centre, high = g->centre;
    for (int i = 0; i < g->corners; i++) {
        float x = g->x[i], y = g->y[i];
        vec3 c = { g->centre.x + x * g->u.x + y * g->v.x, g->centre.y + x * g->u.y + y * g->v.y,
                   g->centre.z + x * g->u.z + y * g->v.z };
        low    = (vec3){ fminf(low.x, c.x), fminf(low.y, c.y), fminf(low.z, c.z) };
        high   = (vec3){ fmaxf(high.x, c.x), fmaxf(high.y, c.y), fmaxf(high.z, c.z) };
    }
    return (light_bounds){ .low = low, .high = high, .axis = g->n, .cos_reach = 0.0f };
}

/* ---- making one ------------------------------------------------------------------------- */

/* Twice the area, of a triangle of the plane. */
static double cross2(dvec3 a, dvec3 b) { return a.x * b.y - a.y * b.x; }

/* Area, and second moments about the origin, by the triangles of the origin and each edge. */
static void measure(polygon *g, const dvec3 *at)
{
    double area = 0.0, xx = 0.0, xy = 0.0, yy = 0.0, reach = 0.0;
    for (int i = 0; i < g->corners; i++) {
        dvec3 a = at[i], b = at[(i + 1) % g->corners];
        double w = 0.5 * cross2(a, b);
        area += w;
        xx += w * (a.x * a.x + a.x * b.x + b.x * b.x) / 6.0;
        yy += w * (a.y * a.y + a.y * b.y + b.y * b.y) / 6.0;
        xy += w * (2.0 * (a.x * a.y + b.x * b.y) + a.x * b.y + b.x * a.y) / 12.0;
        reach   = fmax(reach, hypot(a.x, a.y));
        g->x[i] = (float)a.x;
        g->y[i] = (float)a.y;
    }
    double mean = 0.5 * (xx + yy) / area, half = hypot(0.5 * (xx - yy), xy) / area;
    g->area      = (float)area;
    g->reach     = (float)reach;
    g->moment    = (float)(2.0 * mean);
    g->deviation = (float)sqrt(mean + half);
}

void polygon_make(polygon *g, const dvec3 *corner, int corners, dvec3 v, dvec3 n)
{
    dvec3 u = d3_cross(v, n), centre = { 0 }, at[POLYGON_CORNERS];
    for (int i = 0; i < corners; i++) /* of rectangles and triangles, the centroid */
        centre = d3_add(centre, d3_scale(corner[i], 1.0 / corners));
    g->centre = d3_to_float(centre);
    for (int i = 0; i < corners; i++) { /* from the centre as rounded: corners stay in place */
        dvec3 off = d3_sub(corner[i], d3_from(g->centre));
        at[i]     = (dvec3){ d3_dot(off, u), d3_dot(off, v), 0.0 };
    }
    g->u       = d3_to_float(u);
    g->v       = d3_to_float(v);
    g->n       = d3_to_float(n);
    g->corners = corners;
    measure(g, at);
}
