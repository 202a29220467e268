/* sim/inside.c -- see inside.h. */
#include "sim/inside.h"

#include <string.h>

enum { DIRECTIONS = 64, MOST_HITS = 32 };

/* A spiral from pole to pole, one direction on each band of equal area, turned by the golden angle
 * from the one before: even, and along no axis, on which edges of furniture lie. */
static void spread_directions(vec3 out[DIRECTIONS])
{
    const double cos_golden = -0.73736887807831985, sin_golden = 0.67549029426152364;
    double c = 1.0, s = 0.0;
    for (int i = 0; i < DIRECTIONS; i++) {
        double z    = 1.0 - (2 * i + 1) / (double)DIRECTIONS;
        double r    = sqrt(1.0 - z * z);
        double next = c * cos_golden - s * sin_golden;
        out[i]      = (vec3){ (float)(r * c), (float)(r * s), (float)z };
        s           = s * cos_golden + c * sin_golden;
        c           = next;
    }
}

static vfloat largest(vvec3 a) { return vmax(vabs(a.x), vmax(vabs(a.y), vabs(a.z))); }

/* What was counted on the way along a ray. */
typedef struct tally {
    vint out, in;      /* backs, and fronts that no back in their plane can precede any more */
    vint fronts;       /* in the plane that was met last */
    vfloat plane;      /* m, where that was */
    vmask shut, touch; /* once out > in; a surface at the place itself */
} tally;

static void count_hit(tally *c, const world *w, const vray *ray, const vhit *hit, vmask active)
{
    /* m: how far off each other two surfaces in one plane may be found, by some roundings of
     * corners, of their way to the ray and of its distance */
    const float roundings = 64.0f * 0x1p-24f;
    vsurface s;
    world_surface(w, hit, active, &s);
    vfloat cosine = vdot(s.normal, ray->direction);
    vfloat near   = roundings * vmax(largest(ray->origin), largest(s.position));
    vmask back    = active & (cosine > 0.0f);
    vmask front   = active & ~(cosine > 0.0f);

    vmask apart = active & ((hit->distance - c->plane) * vabs(cosine) > near);
    c->in       = c->in + vkeep_int(apart, c->fronts);
    c->fronts   = vselect_int(apart, vsplat_int(0), c->fronts) + vkeep_int(front, vsplat_int(1));
    c->plane    = vselect(apart, hit->distance, c->plane);
    c->out      = c->out + vkeep_int(back, vsplat_int(1));
    c->shut |= active & (c->out > c->in);
    c->touch |= active & (hit->distance * vabs(cosine) <= near);
}

/* The lanes of active whose place is closed in toward d, and on no surface. */
static vmask closed_toward(const world *w, vvec3 from, vec3 d, vmask active)
{
    vray ray = { .origin = from, .direction = vspread(d), .reach = vsplat(INFINITY) };
    vhit hits[MOST_HITS];
    tally c = { .plane = vsplat(-INFINITY), .shut = ~ALL_LANES, .touch = ~ALL_LANES };
    world_every_hit(w, &ray, &active, 1, MOST_HITS, hits);
    for (int k = 0; k < MOST_HITS; k++) {
        vmask met = active & (hits[k].instance >= vsplat_int(0)) & ~c.shut;
        if (!vany(met))
            break;
        count_hit(&c, w, &ray, &hits[k], met);
    }
    return active & c.shut & ~c.touch;
}

int inside_find(const world *w, const vec3 *places, int count, bool *inside, bool *shell_outward)
{
    vec3 directions[DIRECTIONS];
    int found = 0;
    spread_directions(directions);
    for (int i = 0; i < count; i += LANES) {
        int some = count - i < LANES ? count - i : LANES;
        float x[LANES], y[LANES], z[LANES];
        for (int k = 0; k < LANES; k++) {
            const vec3 *p = &places[i + (k < some ? k : 0)];
            x[k] = p->x, y[k] = p->y, z[k] = p->z;
        }
        vvec3 from = { vload(x), vload(y), vload(z) };
        vmask left = vlane_index() < vsplat_int(some);
        for (int d = 0; d < DIRECTIONS && vany(left); d++)
            left = closed_toward(w, from, directions[d], left);
        for (int k = 0; k < some; k++)
            inside[i + k] = vbits(left) >> k & 1;
        found += __builtin_popcount((unsigned)vbits(left));
    }

    *shell_outward = 2 * (int64_t)found > count;
    if (*shell_outward)
        memset(inside, 0, (size_t)count * sizeof *inside);
    return *shell_outward ? 0 : found;
}
