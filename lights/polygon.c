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
 *
 * The error, measured in units of the irradiance that faces the polygon: rectangles 3e-6 up to
 * 1 : 10 and 4e-5 at 1 : 100, triangles 2e-5 and 1.3e-4: the long edges of strips all but cancel.
 * What the rounding of the height makes of it, 1e-7 of the distance, comes on top.
 */
#include "lights/polygon.h"

#include "core/color.h"
#include "core/warp.h"

/* Distance in units of `reach` from which the quadrature is used: its error, of the order of
 * 0.01 (size / distance)^6 of the value, is then as small as the rounding of Lambert's sum. */
static const float FAR = 5.0f;

/* The largest float below pi. */
static const float BELOW_PI = 3.14159250f;

typedef struct end {
    vfloat x, y;
} end;

/* An edge, or what of it is above the horizon: from the centroid, for the quadrature, in which its
 * length keeps its digits however far the point is; and from the foot, for Lambert's sum, in which
 * its place keeps them however close. */
typedef struct edge {
    end a, b;
    end foot_a, foot_b;
    vfloat dx, dy;
    vmask present;
} edge;

/* The polygon cut by the horizon: what is left of its edges, and the edge along the horizon. */
typedef struct outline {
    edge edges[POLYGON_CORNERS + 1];
    int count;
    vmask whole;  /* nothing cut off */
    vmask inside; /* the foot is inside of what is left */
} outline;

static end select_end(vmask m, end a, end b)
{
    return (end){ vselect(m, a.x, b.x), vselect(m, a.y, b.y) };
}

/* A corner from the foot. Right above it, it is taken to be beside: both of its edges must agree to
 * which side. */
static end from_foot(end a, vvec3 place)
{
    const float beside = 1e-18f; /* m */
    end to             = { a.x - place.x, a.y - place.y };
    vmask at           = (to.x == 0.0f) & (to.y == 0.0f);
    to.x               = vselect(at, vsplat(beside), to.x);
    return to;
}

static edge edge_of(const polygon *g, int i, vvec3 place)
{
    int k    = i + 1 < g->corners ? i + 1 : 0;
    edge e   = { .a       = { vsplat(g->x[i]), vsplat(g->y[i]) },
                 .b       = { vsplat(g->x[k]), vsplat(g->y[k]) },
                 .present = ALL_LANES };
    e.foot_a = from_foot(e.a, place);
    e.foot_b = from_foot(e.b, place);
    e.dx     = e.b.x - e.a.x;
    e.dy     = e.b.y - e.a.y;
    return e;
}

/* t: twice the area of the edge and the foot, > 0 if that is to the left; by the nearer end, which
 * has more digits. */
static vfloat turn_of(const edge *e)
{
    vfloat a2 = e->foot_a.x * e->foot_a.x + e->foot_a.y * e->foot_a.y;
    vfloat b2 = e->foot_b.x * e->foot_b.x + e->foot_b.y * e->foot_b.y;
    end near_ = select_end(a2 < b2, e->foot_a, e->foot_b);
    return near_.x * e->dy - near_.y * e->dx;
}

/* Between a and b; a if it is no number. */
static vfloat between(vfloat x, vfloat a, vfloat b)
{
    return vmin(vmax(x, vmin(a, b)), vmax(a, b));
}

/* The part of an edge where f >= 0, f = n . v being fa and fb at its ends. From the foot the place
 * where it is 0 solves  x dy - y dx = t  and  n_x x + n_y y = n_z h. */
static void cut(edge *e, vvec3 place, vvec3 n, vfloat fa, vfloat fb)
{
    vmask in = fa >= 0.0f, stays = fb >= 0.0f;
    vfloat s  = vkeep(fa != fb, fa / (fa - fb));
    end at    = { e->a.x + s * e->dx, e->a.y + s * e->dy };
    vfloat up = n.z * place.z;
    vfloat t  = turn_of(e);
    vfloat d  = 1.0f / (n.x * e->dx + n.y * e->dy);
    end foot  = { between((t * n.y + up * e->dx) * d, e->foot_a.x, e->foot_b.x),
                  between((up * e->dy - t * n.x) * d, e->foot_a.y, e->foot_b.y) };

    vmask whole = in & stays;
    e->a        = select_end(in, e->a, at);
    e->b        = select_end(stays, e->b, at);
    e->foot_a   = select_end(in, e->foot_a, foot);
    e->foot_b   = select_end(stays, e->foot_b, foot);
    e->dx       = vselect(whole, e->dx, e->foot_b.x - e->foot_a.x);
    e->dy       = vselect(whole, e->dy, e->foot_b.y - e->foot_a.y);
    e->present  = in | stays;
}

static vfloat above(end foot, vvec3 place, vvec3 n)
{
    return n.x * foot.x + n.y * foot.y - n.z * place.z;
}

/* Edges need no order: each is cut by itself, and the one along the horizon goes from where the
 * outline sinks below it to where it rises. */
static outline cut_at_horizon(const polygon *g, vvec3 place, vvec3 n)
{
    outline o   = { .count = g->corners + 1, .whole = ALL_LANES, .inside = ALL_LANES };
    edge *along = &o.edges[g->corners];
    vmask rises = { 0 }, sinks = { 0 };
    *along = (edge){ 0 };
    for (int i = 0; i < g->corners; i++) {
        edge e    = edge_of(g, i, place);
        vfloat fa = above(e.foot_a, place, n);
        vfloat fb = above(e.foot_b, place, n);
        o.whole &= fa >= 0.0f;
        o.inside &= turn_of(&e) >= 0.0f;

        vmask down = (fa >= 0.0f) & ~(fb >= 0.0f);
        vmask up   = ~(fa >= 0.0f) & (fb >= 0.0f);
        cut(&e, place, n, fa, fb);
        along->a      = select_end(down, e.b, along->a);
        along->b      = select_end(up, e.a, along->b);
        along->foot_a = select_end(down, e.foot_b, along->foot_a);
        along->foot_b = select_end(up, e.foot_a, along->foot_b);
        sinks |= down;
        rises |= up;
        o.edges[i] = e;
    }
    along->dx      = along->foot_b.x - along->foot_a.x;
    along->dy      = along->foot_b.y - along->foot_a.y;
    along->present = sinks & rises;
    o.inside &= o.whole | (n.z <= 0.0f); /* is the foot above the horizon? */
    return o;
}

static vfloat dot_of(const edge *e)
{
    return e->foot_a.x * e->foot_b.x + e->foot_a.y * e->foot_b.y;
}

/* theta - theta0, for ab = a . b in the plane, c = |c|, lift = |c| - t and t >= 0. */
static vfloat tilt_of(vfloat ab, vfloat c, vfloat lift, vfloat t, vfloat h2)
{
    return vatan2(ab * lift - t * h2, c * t + ab * (ab + h2));
}

/* What an edge of the polygon adds along the plane, to be multiplied by h, and square to it. */
static void edge_terms(const edge *e, vvec3 place, vvec3 n, vfloat *along, vfloat *square)
{
    vfloat dx    = e->dx;
    vfloat dy    = e->dy;
    vfloat h2    = place.z * place.z;
    vfloat ab    = dot_of(e);
    vfloat turn  = turn_of(e);
    vfloat t     = vabs(turn);
    vfloat rise  = h2 * (dx * dx + dy * dy);
    vfloat c     = vsqrt(t * t + rise);
    vmask some   = e->present & (c > 0.0f);
    vfloat inv   = vkeep(some, 1.0f / c);
    vfloat lift  = vkeep(some, rise / (c + t));
    vfloat theta = vatan2(c, ab + h2);
    vfloat off   = vkeep(some, tilt_of(ab, c, lift, t, h2) - theta * lift * inv);
    *along       = *along + theta * inv * (n.y * dx - n.x * dy);
    *square      = *square + vselect(turn < 0.0f, -off, off);
}

/* The edge along the horizon, whose c is along n: all of its angle counts. Of that, what the sum of
 * theta0 has of it is |n_z| theta0; and t = |n_z| |c|, |c| = h |b - a| / sqrt(n_x^2 + n_y^2). */
static vfloat horizon_term(const edge *e, vvec3 place, vvec3 n)
{
    vfloat length2 = e->dx * e->dx + e->dy * e->dy;
    vfloat h2      = place.z * place.z;
    vfloat across  = n.x * n.x + n.y * n.y;
    vfloat up      = vabs(n.z);
    vfloat c       = place.z * vsqrt(length2 / across);
    vfloat ab      = dot_of(e);
    vfloat rest    = across / (1.0f + up); /* 1 - |n_z| */
    vfloat theta   = vatan2(c, ab + h2);
    vfloat tilt    = tilt_of(ab, c, c * rest, c * up, h2);
    return vkeep(e->present & (across > 0.0f), rest * theta + up * tilt);
}

static vfloat lambert_sum(const outline *o, vvec3 place, vvec3 n)
{
    vfloat along = vsplat(0.0f), square = vsplat(0.0f);
    for (int i = 0; i + 1 < o->count; i++)
        edge_terms(&o->edges[i], place, n, &along, &square);
    vfloat turns = 2.0f * vkeep(o->inside, vsplat(WARP_PI)) + square;
    return 0.5f * (place.z * along + horizon_term(&o->edges[o->count - 1], place, n) - n.z * turns);
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
    vfloat ax = e->a.x - px, ay = e->a.y - py;
    vfloat bx = e->b.x - px, by = e->b.y - py;
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
    vfloat px           = vkeep(horizon->present, horizon->a.x);
    vfloat py           = vkeep(horizon->present, horizon->a.y);
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
    centre    = d3_rounded(centre);
    g->centre = d3_to_float(centre);
    for (int i = 0; i < corners; i++) { /* from the centre as rounded: corners stay in place */
        dvec3 off = d3_sub(corner[i], centre);
        at[i]     = (dvec3){ d3_dot(off, u), d3_dot(off, v), 0.0 };
    }
    g->u       = d3_to_float(u);
    g->v       = d3_to_float(v);
    g->n       = d3_to_float(n);
    g->corners = corners;
    measure(g, at);
}
