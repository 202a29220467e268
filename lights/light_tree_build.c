/* lights/light_tree_build.c -- how the nodes of a light tree are found: see light_tree.h.
 *
 * From the root down each set of lights is cut in two where this is least (section 4.4 of the
 * paper), tried at BINS - 1 places along each of the three axes:
 *
 *     longest side / side along the axis x (peak M_omega M_A of the one + that of the other part)
 *
 * M_A grows with the box and M_omega with the cone of orientations of a part. Both are simpler here
 * than in the paper: M_A has the square of the diagonal added, so that lights in a row have one,
 * and M_omega is the size of the two cones instead of an integral over them, which needs arcs.
 */
#include "lights/light_tree_parts.h"

#include <float.h>
#include <string.h>

enum {
    BINS        = 12,
    DEEP        = 64, /* from here on sets are halved: at most 32 levels more */
    STACK       = DEEP + 40,
    MOST_LIGHTS = 1 << 26, /* row numbers of the nodes stay within 31 bits */
};

static const double LEAST_PEAK = 1e-20; /* of the brightest: products stay in the range of floats */
static const float LEAST_RADIUS  = 1e-6f; /* m: a point on a light has a finite importance */
static const double RADIUS_SLACK = 5e-7; /* of coordinates, for places drawn on a light in floats */
static const double COS_SLACK    = 1e-6;
static const float LEAST_FLOOR   = 0.1f; /* beams that are no cosine have something at their rim */

typedef struct direction {
    double x, y, z;
} direction;

/* Of one light, or of several together. */
typedef struct lit_part {
    float low[3], high[3]; /* m */
    direction axis;        /* unit */
    double cos_spread, cos_reach;
    double peak;
    int light;
} lit_part;

static double dot(direction a, direction b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static direction cross(direction a, direction b)
{
    return (direction){ a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}
static double length(direction a) { return sqrt(dot(a, a)); }
static double root(double a) { return a > 0.0 ? sqrt(a) : 0.0; }

/* s a + t b, made unit. */
static direction between(direction a, double s, direction b, double t)
{
    direction d = { s * a.x + t * b.x, s * a.y + t * b.y, s * a.z + t * b.z };
    double l    = length(d);
    return (direction){ d.x / l, d.y / l, d.z / l };
}

static direction across(direction a)
{
    direction off  = fabs(a.z) < 0.7 ? (direction){ 0, 0, 1 } : (direction){ 1, 0, 0 };
    direction side = cross(off, a);
    return between(side, 1.0, side, 0.0);
}

/* ---- two parts as one ------------------------------------------------------------------------ */

/* The narrowest cone that holds those of a and b, into a. Let A and B be their half angles, A the
 * wider, D the angle between the axes: it has the half angle (A + D + B) / 2, and its axis leans
 * from a's toward b's. Sums of angles by their cosines and sines alone. */
static void join_cones(lit_part *a, const lit_part *b)
{
    const lit_part wide = a->cos_spread <= b->cos_spread ? *a : *b;
    const lit_part slim = a->cos_spread <= b->cos_spread ? *b : *a;

    /* D + B in [0, 2 pi] */
    direction normal = cross(wide.axis, slim.axis);
    double cos_a = wide.cos_spread, sin_a = root(1.0 - cos_a * cos_a);
    double cos_b = slim.cos_spread, sin_b = root(1.0 - cos_b * cos_b);
    double cos_d = dot(wide.axis, slim.axis), sin_d = length(normal);
    double cos_db = cos_d * cos_b - sin_d * sin_b;
    double sin_db = sin_d * cos_b + cos_d * sin_b;

    /* D + B <= A: the wider holds it; 2 pi - (D + B) <= A: the two hold all directions */
    a->axis       = wide.axis;
    a->cos_spread = sin_db >= 0.0 ? cos_a : -1.0;
    if (cos_db >= cos_a)
        return;

    /* Half of A + D + B, which is in [0, 2 pi] here */
    double cos_sum = cos_a * cos_db - sin_a * sin_db;
    double sin_sum = sin_a * cos_db + cos_a * sin_db;
    double cos_o   = copysign(root(0.5 * (1.0 + cos_sum)), sin_sum);
    double sin_o   = root(0.5 * (1.0 - cos_sum));

    /* The axis, turned by that less A, in the plane of both axes */
    double cos_turn = cos_o * cos_a + sin_o * sin_a;
    double sin_turn = sin_o * cos_a - cos_o * sin_a;
    direction side = sin_d > 1e-12 ? between(slim.axis, 1.0, wide.axis, -cos_d) : across(wide.axis);

    a->axis       = between(wide.axis, cos_turn, side, sin_turn);
    a->cos_spread = cos_o;
}

/* a part of no light has the peak 0. */
static void join(lit_part *a, const lit_part *b)
{
    if (b->peak == 0.0)
        return;
    if (a->peak == 0.0) {
        *a = *b;
        return;
    }
    for (int k = 0; k < 3; k++) {
        a->low[k]  = fminf(a->low[k], b->low[k]);
        a->high[k] = fmaxf(a->high[k], b->high[k]);
    }
    join_cones(a, b);
    a->cos_reach = fmin(a->cos_reach, b->cos_reach);
    a->peak += b->peak;
}

/* cos of the spread and the reach together, which are pi at most. */
static double cos_wide(double cos_spread, double cos_reach)
{
    double sin_s   = root(1.0 - cos_spread * cos_spread);
    double sin_r   = root(1.0 - cos_reach * cos_reach);
    double cos_sum = cos_spread * cos_reach - sin_s * sin_r;
    double sin_sum = sin_s * cos_reach + cos_spread * sin_r;
    bool over      = sin_sum < 0.0 || cos_spread == -1.0 || cos_reach == -1.0;
    return over ? -1.0 : cos_sum;
}

/* ---- where to cut ---------------------------------------------------------------------------- */

static double middle(const lit_part *p, int axis)
{
    return 0.5 * ((double)p->low[axis] + (double)p->high[axis]);
}

static double side(const lit_part *p, int axis)
{
    return (double)p->high[axis] - (double)p->low[axis];
}

static double measure(const lit_part *p)
{
    if (p->peak == 0.0)
        return 0.0;
    double x = side(p, 0), y = side(p, 1), z = side(p, 2);
    double area  = 2.0 * (x * y + y * z + z * x) + x * x + y * y + z * z;
    double cones = 2.0 - p->cos_spread - cos_wide(p->cos_spread, p->cos_reach);
    return p->peak * area * cones;
}

/* The middles of the lights of a set, in bins along an axis. */
typedef struct range {
    double low, high;
} range;

static int bin_of(const range *r, double at)
{
    int bin = (int)(BINS * ((at - r->low) / (r->high - r->low)));
    return bin < BINS ? bin : BINS - 1;
}

typedef struct cut {
    int axis, bin; /* lights of bins < bin are the first part */
    double cost;
} cut;

static void cut_along(const lit_part *parts, int count, int axis, const range *r, double factor,
                      cut *best)
{
    lit_part bins[BINS] = { 0 };
    for (int i = 0; i < count; i++)
        join(&bins[bin_of(r, middle(&parts[i], axis))], &parts[i]);

    /* What lies before each bin, and then what lies from it on */
    double before[BINS] = { 0 };
    lit_part sum        = { 0 };
    for (int i = 1; i < BINS; i++) {
        join(&sum, &bins[i - 1]);
        before[i] = measure(&sum);
    }
    sum = (lit_part){ 0 };
    for (int i = BINS - 1; i > 0; i--) {
        join(&sum, &bins[i]);
        double cost = factor * (before[i] + measure(&sum));
        if (cost < best->cost)
            *best = (cut){ axis, i, cost };
    }
}

/* How many of the parts, moved to the front, are the first of the two sets. */
static int split(lit_part *parts, int count, const lit_part *all, int depth)
{
    range r[3];
    for (int k = 0; k < 3; k++) {
        r[k] = (range){ DBL_MAX, -DBL_MAX };
        for (int i = 0; i < count; i++) {
            r[k].low  = fmin(r[k].low, middle(&parts[i], k));
            r[k].high = fmax(r[k].high, middle(&parts[i], k));
        }
    }

    /* The first and the last bin are not empty: neither set is */
    cut best       = { .axis = -1, .cost = DBL_MAX };
    double longest = fmax(side(all, 0), fmax(side(all, 1), side(all, 2)));
    for (int k = 0; k < 3 && depth < DEEP; k++)
        if (r[k].high > r[k].low)
            cut_along(parts, count, k, &r[k], longest / side(all, k), &best);
    if (best.axis < 0)
        return count / 2;

    int first = 0;
    for (int i = 0; i < count; i++)
        if (bin_of(&r[best.axis], middle(&parts[i], best.axis)) < best.bin) {
            lit_part moved = parts[i];
            parts[i]       = parts[first];
            parts[first++] = moved;
        }
    return first;
}

/* ---- the nodes ------------------------------------------------------------------------------- */

static void write_node(tree_node *node, const lit_part *p)
{
    /* The ball: around where its middle is as floats */
    float c[3];
    double r2 = 0.0, size = 0.0;
    for (int k = 0; k < 3; k++) {
        c[k]       = (float)middle(p, k);
        double off = fmax((double)p->high[k] - (double)c[k], (double)c[k] - (double)p->low[k]);
        r2 += off * off;
        size = fmax(size, fmax(fabs((double)p->low[k]), fabs((double)p->high[k])));
    }
    float radius = (float)(sqrt(r2) * (1.0 + 1e-6) + RADIUS_SLACK * size);
    double cos_s = fmax(p->cos_spread - COS_SLACK, -1.0);

    float *to           = node->number;
    to[NODE_X]          = c[0];
    to[NODE_Y]          = c[1];
    to[NODE_Z]          = c[2];
    to[NODE_RADIUS]     = fmaxf(radius, LEAST_RADIUS);
    to[NODE_AXIS_X]     = (float)p->axis.x;
    to[NODE_AXIS_Y]     = (float)p->axis.y;
    to[NODE_AXIS_Z]     = (float)p->axis.z;
    to[NODE_COS_SPREAD] = (float)cos_s;
    to[NODE_SIN_SPREAD] = (float)root(1.0 - cos_s * cos_s);
    to[NODE_COS_REACH]  = (float)p->cos_reach;
    to[NODE_FLOOR]      = fmaxf(LEAST_FLOOR, -(float)p->cos_reach);
    to[NODE_PEAK]       = (float)p->peak;
}

/* Sets yet to be made into nodes; the second child of `parent`, or its first: -1. */
typedef struct task {
    int from, count, depth, parent;
} task;

static int build(lit_part *parts, int count, tree_node *nodes, int32_t *links, int32_t *places)
{
    task stack[STACK];
    int waiting = 0, made = 0;
    if (count > 0)
        stack[waiting++] = (task){ 0, count, 0, -1 };
    while (waiting > 0) {
        task now      = stack[--waiting];
        lit_part *set = parts + now.from;
        lit_part all  = { 0 };
        for (int i = 0; i < now.count; i++)
            join(&all, &set[i]);

        int node = made++;
        write_node(&nodes[node], &all);
        if (now.parent >= 0)
            links[now.parent] = node;
        if (now.count == 1) {
            links[node]        = ~set->light;
            places[set->light] = node;
            continue;
        }

        /* The first child is made next, and all below it before the second */
        int first        = split(set, now.count, &all, now.depth);
        stack[waiting++] = (task){ now.from + first, now.count - first, now.depth + 1, node };
        stack[waiting++] = (task){ now.from, first, now.depth + 1, -1 };
    }
    return made;
}

/* ---- from lights ----------------------------------------------------------------------------- */

static bool bounds_are_numbers(const light_bounds *b)
{
    const float *low = &b->low.x, *high = &b->high.x;
    double l = (double)v3_length(b->axis);
    bool ok  = b->peak >= 0.0f && b->peak < INFINITY && l > 0.0 && l < (double)INFINITY &&
              fabsf(b->cos_spread) <= 1.0f && fabsf(b->cos_reach) <= 1.0f;
    for (int k = 0; k < 3 && !b->far; k++)
        ok &= low[k] <= high[k] && fabsf(low[k]) < INFINITY && fabsf(high[k]) < INFINITY;
    return ok;
}

static lit_part part_of(const light_bounds *b, double scale, int number)
{
    direction axis = { (double)b->axis.x, (double)b->axis.y, (double)b->axis.z };
    lit_part p     = { .axis       = between(axis, 1.0, axis, 0.0),
                       .cos_spread = (double)b->cos_spread,
                       .cos_reach  = (double)b->cos_reach,
                       .peak       = fmax((double)b->peak * scale, LEAST_PEAK),
                       .light      = number };
    memcpy(p.low, &b->low, sizeof p.low);
    memcpy(p.high, &b->high, sizeof p.high);
    return p;
}

static far_light far_of(const lit_part *p)
{
    double cosine = fmax(cos_wide(p->cos_spread, p->cos_reach) - COS_SLACK, -1.0);
    return (far_light){ .axis     = { (float)p->axis.x, (float)p->axis.y, (float)p->axis.z },
                        .cos_wide = (float)cosine,
                        .sin_wide = (float)root(1.0 - cosine * cosine),
                        .peak     = (float)p->peak,
                        .light    = p->light };
}

/* Counts the lights that are not dark, far ones and all; the brightest's peak. */
static bool count_lights(const light *const *lights, int count, int *near_count, int *far_count,
                         double *brightest, lux_error *err)
{
    *near_count = *far_count = 0;
    *brightest               = 0.0;
    if (count > MOST_LIGHTS)
        return failed(err, ERR_UNSUPPORTED, "%d lights, at most %d wanted", count, MOST_LIGHTS);
    for (int i = 0; i < count; i++) {
        light_bounds b = light_bounds_of(lights[i]);
        if (b.peak == 0.0f)
            continue;
        if (!bounds_are_numbers(&b))
            return failed(err, ERR_ARGUMENT, "light %d (%s): its place or strength is no number",
                          i + 1, lights[i]->type->name);
        ++*(b.far ? far_count : near_count);
        *brightest = fmax(*brightest, (double)b.peak);
    }
    return true;
}

static const light_tree *tree_new(arena *a, arena *scratch, const light *const *lights, int count,
                                  lux_error *err)
{
    int near_count, far_count;
    double brightest;
    if (!count_lights(lights, count, &near_count, &far_count, &brightest, err))
        return NULL;

    size_t node_count = near_count > 0 ? 2 * (size_t)near_count - 1 : 0;
    light_tree *t     = arena_new(a, light_tree, err);
    tree_node *nodes  = t ? arena_array(a, tree_node, node_count, err) : NULL;
    int32_t *links    = nodes ? arena_array(a, int32_t, node_count, err) : NULL;
    int32_t *places   = links ? arena_array(a, int32_t, (size_t)count, err) : NULL;
    far_light *far_   = places ? arena_array(a, far_light, (size_t)far_count, err) : NULL;
    lit_part *parts   = far_ ? arena_array(scratch, lit_part, (size_t)near_count, err) : NULL;
    if (!parts)
        return NULL;

    int is_near = 0, is_far = 0;
    for (int i = 0; i < count; i++) {
        light_bounds b = light_bounds_of(lights[i]);
        places[i]      = DARK_PLACE;
        if (b.peak == 0.0f)
            continue;
        lit_part p = part_of(&b, 1.0 / brightest, i);
        if (b.far) {
            places[i]      = FAR_PLACE - is_far;
            far_[is_far++] = far_of(&p);
        } else {
            parts[is_near++] = p;
        }
    }
    int made = build(parts, near_count, nodes, links, places);
    *t       = (light_tree){ nodes, links, far_, places, made, far_count, count };
    return t;
}

const light_tree *light_tree_new(arena *a, const light *const *lights, int count, lux_error *err)
{
    arena scratch       = { 0 };
    const light_tree *t = tree_new(a, &scratch, lights, count, err);
    arena_clear(&scratch);
    return t;
}
