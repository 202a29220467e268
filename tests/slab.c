/* tests/slab.c -- see slab.h. Reference: M. Born and E. Wolf, Principles of Optics, 1.5.2. */
#include "tests/slab.h"

#include <math.h>

/* Of one border: s and p polarised. */
static void border(double n, double c, double r[2])
{
    double t = sqrt(1.0 - (1.0 - c * c) / (n * n));
    double s = (c - n * t) / (c + n * t), p = (n * c - t) / (n * c + t);
    r[0] = s * s;
    r[1] = p * p;
}

slab slab_of(double n, double inner, double c)
{
    double t = sqrt(1.0 - (1.0 - c * c) / (n * n)), a = pow(inner, 1.0 / t), r[2];
    slab all = { 0 };
    border(n, c, r);
    for (int k = 0; k < 2; k++) {
        double to_and_fro = 1.0 - r[k] * r[k] * a * a, passes = (1.0 - r[k]) * (1.0 - r[k]);
        all.passed += 0.5 * passes * a / to_and_fro;
        all.reflected += 0.5 * r[k] * (1.0 + passes * a * a / to_and_fro);
    }
    return all;
}

double slab_inner(double n, double transmittance)
{
    double low = 0.0, high = 1.0;
    for (int i = 0; i < 60; i++) {
        double a = 0.5 * (low + high);
        slab_of(n, a, 1.0).passed < transmittance ? (low = a) : (high = a);
    }
    return 0.5 * (low + high);
}

double quad_integral(const quad *q, dvec3 p, int side, quad_integrand *f, const void *context)
{
    dvec3 u    = d3_scale(d3_sub(q->corner[1], q->corner[0]), 1.0 / side);
    dvec3 v    = d3_scale(d3_sub(q->corner[3], q->corner[0]), 1.0 / side);
    dvec3 area = d3_cross(u, v), from = d3_sub(q->corner[0], p);
    const double near = 0.5 - 0.5 / sqrt(3.0); /* Gauss's two points of a cell */
    double sum        = 0.0;
    for (int i = 0; i < 2 * side; i++)
        for (int k = 0; k < 2 * side; k++) {
            double x = i / 2 + (i % 2 ? 1.0 - near : near), y = k / 2 + (k % 2 ? 1.0 - near : near);
            dvec3 to = d3_add(from, d3_add(d3_scale(u, x), d3_scale(v, y)));
            double d = d3_length(to);
            sum += f(context, d3_scale(to, 1.0 / d)) * fabs(d3_dot(to, area)) / (4.0 * d * d * d);
        }
    return sum;
}

quad quad_level(double x, double y, double z, double size)
{
    double h = 0.5 * size;
    return (quad){
        { { x - h, y - h, z }, { x + h, y - h, z }, { x + h, y + h, z }, { x - h, y + h, z } }
    };
}
