/* tests/glass_sphere.c -- see glass_sphere.h.
 *
 * Light that meets the sphere (radius 1) at the angle i to its normal, b = sin i off the axis, goes
 * on within at t, sin t = sin i / n, along chords of 2 cos t that all meet the surface at t: the
 * border reflects the same share R each time, R_s and R_p apart. Of its flux
 *
 *     R                                is reflected,
 *     (1 - R)^2 A^(k + 1) R^k          leaves after k reflections within, A = inner^(cos t),
 *
 * turned by 2 (i - t) + k (pi - 2 t). The beam's shares are integrals of those over 2 b db, u = b^2
 * in [0, 1]; with u = 1 - w^2 they are smooth at the rim. Reference: H. C. van de Hulst, Light
 * Scattering by Small Particles, 12.22.
 */
#include "tests/glass_sphere.h"

#include "tests/test.h"

enum { STEPS = 20000 };

typedef struct ray {
    double i, t;    /* rad */
    double r[2], a; /* reflected by a border: s, p; left by one chord */
    double weight;  /* of the beam */
} ray;

/* The midpoint rule in w. */
static ray ray_of(double n, double inner, int step)
{
    double w = (step + 0.5) / STEPS, b = sqrt(1.0 - w * w), c = w;
    double d = sqrt(1.0 - b * b / (n * n)); /* cos t */
    double s = (c - n * d) / (c + n * d), p = (n * c - d) / (n * c + d);
    return (ray){ .i      = asin(b),
                  .t      = asin(b / n),
                  .r      = { s * s, p * p },
                  .a      = pow(inner, d),
                  .weight = 2.0 * w / STEPS };
}

static double leaves(const ray *r, int order)
{
    double sum = 0.0;
    for (int k = 0; k < 2; k++)
        sum += 0.5 * (1.0 - r->r[k]) * (1.0 - r->r[k]) * pow(r->r[k], order);
    return sum * pow(r->a, order + 1);
}

glass_sphere glass_sphere_of(double n, double inner)
{
    glass_sphere all = { .absorbed = 0.0 };
    for (int j = 0; j < STEPS; j++) {
        ray r = ray_of(n, inner, j);
        all.reflected += r.weight * 0.5 * (r.r[0] + r.r[1]);
        for (int k = 0; k < SPHERE_ORDERS; k++)
            all.leaves[k] += r.weight * leaves(&r, k);
        /* Enters (1 - R), each chord keeps A of it, R of what arrives goes round again */
        for (int k = 0; k < 2; k++)
            all.absorbed += r.weight * 0.5 * (1.0 - r.r[k]) * (1.0 - r.a) / (1.0 - r.r[k] * r.a);
    }
    return all;
}

double glass_sphere_within(double n, double inner, int order, double angle)
{
    double sum = 0.0;
    for (int j = 0; j < STEPS; j++) {
        ray r       = ray_of(n, inner, j);
        double turn = 2.0 * (r.i - r.t) + order * (M_PI - 2.0 * r.t);
        if (fabs(remainder(turn, 2.0 * M_PI)) <= angle)
            sum += r.weight * leaves(&r, order);
    }
    return sum;
}

double glass_sphere_on_disk(double n, double inner, int order, double distance, double radius)
{
    double sum = 0.0;
    for (int j = 0; j < STEPS; j++) {
        /* It leaves where the normal makes the angle i to it: at i - turn from the axis, and off
         * the axis by that much less for each metre that it goes */
        ray r       = ray_of(n, inner, j);
        double turn = 2.0 * (r.i - r.t) + order * (M_PI - 2.0 * r.t), out = turn - r.i;
        double x = cos(out), y = -sin(out);
        double at = y - (distance - x) * tan(turn);
        if (cos(turn) > 0.0 && fabs(at) <= radius)
            sum += r.weight * leaves(&r, order);
    }
    return sum;
}
