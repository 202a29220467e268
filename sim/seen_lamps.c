/* sim/seen_lamps.c -- see seen_lamps.h.
 *
 * The rays begin within r of o and go within the angle p of the axis a. A lamp within the sphere R
 * about c is met only if, with d the distance of c from o and t its angle to a,
 *
 *     d <= R + r   or   t <= p + asin((R + r) / d)
 */
#include "sim/seen_lamps.h"

seen_lamps lamps_that_show(arena *a, const scene *s, lux_error *err)
{
    int32_t *lamps = arena_array(a, int32_t, (size_t)s->light_count + 1, err);
    int count      = 0;
    for (int l = 0; lamps && l < s->light_count; l++)
        if (s->lights[l]->type->hit)
            lamps[count++] = l;
    return (seen_lamps){ lamps, count };
}

/* What holds a batch of rays. */
typedef struct beam {
    dvec3 origin, axis;
    double radius;       /* m, of the origins about theirs */
    double cosine, sine; /* of the half angle; cosine <= 0: as good as anywhere */
} beam;

static dvec3 lane_of(vvec3 v, int i)
{
    return (dvec3){ (double)lane(v.x, i), (double)lane(v.y, i), (double)lane(v.z, i) };
}

static beam beam_of(const vray *rays, const vmask *active, int packets)
{
    const double rounding = 1e-5;
    beam b                = { .cosine = 1.0 };
    double count          = 0.0;
    for (int k = 0; k < packets; k++)
        for (int bits = vbits(active[k]); bits; bits &= bits - 1, count += 1.0) {
            int i    = __builtin_ctz((unsigned)bits);
            b.origin = d3_add(b.origin, lane_of(rays[k].origin, i));
            b.axis   = d3_add(b.axis, lane_of(rays[k].direction, i));
        }
    double length = d3_length(b.axis);
    if (!(length > rounding * count))
        return (beam){ .cosine = -1.0 };
    b.origin = d3_scale(b.origin, 1.0 / count);
    b.axis   = d3_scale(b.axis, 1.0 / length);
    for (int k = 0; k < packets; k++)
        for (int bits = vbits(active[k]); bits; bits &= bits - 1) {
            int i    = __builtin_ctz((unsigned)bits);
            b.cosine = fmin(b.cosine, d3_dot(b.axis, lane_of(rays[k].direction, i)));
            b.radius = fmax(b.radius, d3_length(d3_sub(lane_of(rays[k].origin, i), b.origin)));
        }
    b.cosine -= rounding;
    b.sine = sqrt(fmax(0.0, 1.0 - b.cosine * b.cosine));
    return b;
}

static bool may_meet(const beam *b, const light *l)
{
    light_bounds box = light_bounds_of(l);
    dvec3 low = d3_from(box.low), high = d3_from(box.high);
    dvec3 to     = d3_sub(d3_scale(d3_add(low, high), 0.5), b->origin);
    double d     = d3_length(to);
    double reach = (0.5 * d3_length(d3_sub(high, low)) + b->radius) * 1.0001 + 1e-6 * d;
    if (box.far || b->cosine <= 0.0 || !(d > reach))
        return true;
    double sine = reach / d, cosine = sqrt(1.0 - sine * sine);
    return d3_dot(to, b->axis) >= d * (b->cosine * cosine - b->sine * sine);
}

int lamps_before(const scene *s, const seen_lamps *all, const vray *rays, const vmask *active,
                 int packets, int32_t *list)
{
    int count = 0;
    beam b    = beam_of(rays, active, packets);
    for (int i = 0; i < all->count; i++)
        if (may_meet(&b, s->lights[all->lamps[i]]))
            list[count++] = all->lamps[i];
    return count;
}
