/* sim/map_outline.c -- see map_parts.h: where parts of a mesh lie that cells are made of.
 */
#include "sim/map_parts.h"

static const double flat_cosine = 0.94; /* of a part's normals with their mean: 20 degrees */

uint32_t map_triangle_at(const map_ground *on, int32_t rank, dvec3 c[3])
{
    uint32_t made_of = world_triangle(on->world, on->instance, on->mesh->order[rank], c);
    for (int i = 0; i < 3; i++)
        c[i] = transform_point(&on->place, c[i]);
    return made_of;
}

/* Of length twice the area, on the lit side. */
static dvec3 lit_normal(const map_ground *on, const dvec3 c[3])
{
    dvec3 n = d3_cross(d3_sub(c[1], c[0]), d3_sub(c[2], c[0]));
    return on->mirrors == on->front ? d3_scale(n, -1.0) : n;
}

double map_part_area(const map_ground *on, const map_part *p)
{
    if (p->single)
        return 0.5 * d3_length(lit_normal(on, p->corner));
    double sum = 0.0;
    dvec3 c[3];
    for (int32_t r = p->low; r < p->high; r++) {
        map_triangle_at(on, r, c);
        sum += 0.5 * d3_length(lit_normal(on, c));
    }
    return sum;
}

int map_longest_edge(const dvec3 c[3], double *length)
{
    int longest = 0;
    *length     = -1.0;
    for (int e = 0; e < 3; e++) {
        double l = d3_length(d3_sub(c[(e + 1) % 3], c[e]));
        if (l > *length * (1.0 + 1e-9)) /* of equal ones the first, whatever rounds */
            *length = l, longest = e;
    }
    return longest;
}

static dvec3 middle_of(const dvec3 c[3])
{
    return d3_scale(d3_add(c[0], d3_add(c[1], c[2])), 1.0 / 3.0);
}

void map_halve(dvec3 c[3], int edge, int half)
{
    int i = edge, j = (edge + 1) % 3;
    dvec3 m         = d3_scale(d3_add(c[i], c[j]), 0.5);
    c[half ? i : j] = m;
}

/* ---- outlines -------------------------------------------------------------------------------- */

static void outline_single(const map_part *p, double pull, map_outline *o)
{
    dvec3 middle = middle_of(p->corner);
    for (int i = 0; i < 3; i++) {
        dvec3 q        = d3_add(p->corner[i], d3_scale(d3_sub(middle, p->corner[i]), pull));
        dvec3 next     = p->corner[(i + 1) % 3];
        dvec3 edge     = d3_scale(d3_add(p->corner[i], next), 0.5);
        o->ring[i]     = q;
        o->feet[i]     = q;
        o->feet[3 + i] = d3_add(edge, d3_scale(d3_sub(middle, edge), pull));
        o->feet[6 + i] = d3_scale(d3_add(p->corner[i], middle), 0.5);
    }
    o->feet[9] = middle;
    o->rings   = 3;
    o->foots   = 10;
}

/* The corners that lie farthest out in each of MOST_RING directions along the cell. */
static void outline_many(const map_ground *on, const map_part *p, double pull, map_outline *o)
{
    vec3 u, v, n = d3_to_float(o->normal);
    v3_frame(n, &u, &v);
    double farthest[MOST_RING];
    dvec3 sum = { 0, 0, 0 }, c[3];
    for (int k = 0; k < MOST_RING; k++)
        farthest[k] = -HUGE_VAL;
    for (int32_t r = p->low; r < p->high; r++) {
        map_triangle_at(on, r, c);
        sum = d3_add(sum, middle_of(c));
        for (int i = 0; i < 3; i++)
            for (int k = 0; k < MOST_RING; k++) {
                double turn = 2.0 * M_PI * k / MOST_RING;
                double out =
                    cos(turn) * d3_dot(c[i], d3_from(u)) + sin(turn) * d3_dot(c[i], d3_from(v));
                if (out > farthest[k])
                    farthest[k] = out, o->ring[k] = c[i];
            }
    }
    dvec3 middle = d3_scale(sum, 1.0 / (p->high - p->low));
    for (int k = 0; k < MOST_RING; k++)
        o->ring[k] = d3_add(o->ring[k], d3_scale(d3_sub(middle, o->ring[k]), pull));
    o->rings      = MOST_RING;
    int32_t count = p->high - p->low;
    o->foots      = count < MOST_FEET ? count : MOST_FEET;
    for (int k = 0; k < o->foots; k++) {
        map_triangle_at(on, p->low + (int32_t)((int64_t)count * k / o->foots), c);
        o->feet[k] = middle_of(c);
    }
}

bool map_part_normal(const map_ground *on, const map_part *p, dvec3 *mean)
{
    dvec3 c[3], sum = { 0, 0, 0 };
    if (p->single)
        sum = lit_normal(on, p->corner);
    for (int32_t r = p->low; !p->single && r < p->high; r++) {
        map_triangle_at(on, r, c);
        sum = d3_add(sum, lit_normal(on, c));
    }
    double length = d3_length(sum);
    if (!(length > 0.0))
        return false;
    *mean = d3_scale(sum, 1.0 / length);
    for (int32_t r = p->low; !p->single && r < p->high; r++) {
        map_triangle_at(on, r, c);
        dvec3 n = lit_normal(on, c);
        if (d3_dot(n, *mean) < flat_cosine * d3_length(n))
            return false;
    }
    return true;
}

double map_part_size(const map_ground *on, const map_part *p)
{
    double size = 0.0;
    dvec3 c[3];
    if (p->single) {
        map_longest_edge(p->corner, &size);
        return size;
    }
    dvec3 low = { HUGE_VAL, HUGE_VAL, HUGE_VAL }, high = { -HUGE_VAL, -HUGE_VAL, -HUGE_VAL };
    for (int32_t r = p->low; r < p->high; r++) {
        map_triangle_at(on, r, c);
        for (int i = 0; i < 3; i++) {
            low  = (dvec3){ fmin(low.x, c[i].x), fmin(low.y, c[i].y), fmin(low.z, c[i].z) };
            high = (dvec3){ fmax(high.x, c[i].x), fmax(high.y, c[i].y), fmax(high.z, c[i].z) };
        }
    }
    return d3_length(d3_sub(high, low));
}

void map_part_outline(const map_ground *on, const map_part *p, double size, map_outline *o)
{
    /* Off its edges by no more than rounding needs: walls beside them are not on it */
    double pull = fmin(0.25, 8.0 * on->rounding / size);
    o->size     = size;
    o->bulge    = 0.0;
    if (p->single) {
        outline_single(p, pull, o);
        return;
    }
    outline_many(on, p, pull, o);
    dvec3 c[3];
    for (int32_t r = p->low; r < p->high; r++) {
        map_triangle_at(on, r, c);
        for (int i = 0; i < 3; i++)
            o->bulge = fmax(o->bulge, d3_dot(d3_sub(c[i], o->ring[0]), o->normal));
    }
}
