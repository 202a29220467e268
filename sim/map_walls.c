/* sim/map_walls.c -- see map_parts.h: whether something stands on a cell.
 *
 *          |wall                    Rays run from place to place over the cell, a little above
 *     x----|-x------x   lifted      it, and up to there from places on it: whatever stands on
 *     :    | :      :               the cell or lies on it is in the way of some of them. One
 *   __:____|_:______:_  the cell    that cuts the cell in two crosses its outline.
 */
#include "sim/map_parts.h"

static const double highest_lift = 2e-3; /* m: what is lower shades nothing that matters */
static const double lift_share   = 0.25; /* of the cell's size, at most */

enum { MOST_WALL_RAYS = 3 * MOST_RING + MOST_FEET };

typedef struct wall_rays {
    float from[3][MOST_WALL_RAYS + LANES], way[3][MOST_WALL_RAYS + LANES];
    float reach[MOST_WALL_RAYS + LANES];
    int count;
} wall_rays;

static void add_ray(wall_rays *r, dvec3 from, dvec3 to)
{
    dvec3 along   = d3_sub(to, from);
    double length = d3_length(along);
    if (!(length > 1e-9))
        return;
    vec3 f = d3_to_float(from), w = d3_to_float(d3_scale(along, 1.0 / length));
    int i         = r->count++;
    r->from[0][i] = f.x, r->from[1][i] = f.y, r->from[2][i] = f.z;
    r->way[0][i] = w.x, r->way[1][i] = w.y, r->way[2][i] = w.z;
    r->reach[i] = (float)length;
}

static dvec3 raised(const map_outline *o, dvec3 p, double height)
{
    double above = d3_dot(d3_sub(p, o->ring[0]), o->normal);
    return d3_add(p, d3_scale(o->normal, height - above));
}

static void draw_rays(const scene *s, const map_outline *o, wall_rays *r)
{
    vec3 low, high;
    world_bounds(s->world, &low, &high);
    double most = 0x1p-6;
    for (int k = 0; k < 2; k++) {
        vec3 p = k ? high : low;
        most   = fmax(most, (double)fmaxf(fabsf(p.x), fmaxf(fabsf(p.y), fabsf(p.z))));
    }
    double off  = 16.0 * 0x1p-24 * most; /* m, what coordinates are off by */
    double lift = o->bulge + fmax(fmin(highest_lift, lift_share * o->size), 8.0 * off);

    dvec3 middle = { 0, 0, 0 };
    for (int k = 0; k < o->rings; k++)
        middle = d3_add(middle, d3_scale(o->ring[k], 1.0 / o->rings));
    middle = raised(o, middle, lift);
    for (int k = 0; k < o->rings; k++) {
        dvec3 a = raised(o, o->ring[k], lift);
        dvec3 b = raised(o, o->ring[(k + 1) % o->rings], lift);
        dvec3 c = raised(o, o->ring[(k + 2) % o->rings], lift);
        add_ray(r, a, b);
        add_ray(r, a, middle);
        add_ray(r, d3_scale(d3_add(a, b), 0.5), d3_scale(d3_add(b, c), 0.5));
    }
    for (int k = 0; k < o->foots; k++)
        add_ray(r, d3_add(o->feet[k], d3_scale(o->normal, 2.0 * off)), raised(o, o->feet[k], lift));
}

/* By the first hit: a pane is a wall, too. */
bool map_is_walled(const scene *s, const map_outline *o)
{
    wall_rays r = { 0 };
    draw_rays(s, o, &r);
    for (int i = 0; i < r.count; i += LANES) {
        vray ray = { .origin = { vload(r.from[0] + i), vload(r.from[1] + i), vload(r.from[2] + i) },
                     .direction = { vload(r.way[0] + i), vload(r.way[1] + i), vload(r.way[2] + i) },
                     .reach     = vload(r.reach + i) };
        vmask active = vlane_index() + i < r.count;
        vhit hit;
        world_first_hit(s->world, &ray, &active, 1, RAYS_COHERENT, &hit);
        if (vany(active & (hit.instance >= 0)))
            return true;
    }
    return false;
}
