/* data/model/curve.c -- see solid.h: smooth curves through few points. */
#include "data/model/solid.h"

#include <math.h>

/* The weights of four knots of a uniform cubic B-spline, at t of [0, 1] between the inner two. */
static void weights(double t, double w[4])
{
    const double s = 1.0 - t;
    w[0]           = s * s * s / 6.0;
    w[1]           = (3.0 * t * t * t - 6.0 * t * t + 4.0) / 6.0;
    w[2]           = (3.0 * s * s * s - 6.0 * s * s + 4.0) / 6.0;
    w[3]           = t * t * t / 6.0;
}

static int within(int i, int count) { return i < 0 ? 0 : i >= count ? count - 1 : i; }

int curve_points(const double (*knots)[2], int count, int per, double (*out)[2])
{
    int n = 0;
    for (int s = -1; s < count; s++)
        for (int i = 0; i <= (s == count - 1 ? per : per - 1); i++) {
            double w[4], p[2] = { 0 };
            weights((double)i / per, w);
            for (int k = 0; k < 4; k++) {
                const double *q = knots[within(s - 1 + k, count)];
                p[0] += w[k] * q[0];
                p[1] += w[k] * q[1];
            }
            if (n && hypot(p[0] - out[n - 1][0], p[1] - out[n - 1][1]) < 1e-4)
                continue;
            out[n][0] = p[0];
            out[n][1] = p[1];
            n++;
        }
    return n;
}

double curve_at(const double *knots, int count, double first, double step, double x)
{
    const double t = (x - first) / step, s = floor(t);
    double w[4], sum                       = 0.0;
    weights(t - s, w);
    for (int k = 0; k < 4; k++)
        sum += w[k] * knots[within((int)s - 1 + k, count)];
    return sum;
}

void add_turned(shape *s, const lathe *l, int per)
{
    double rz[512][2];
    lathe fine = *l;
    if ((l->count + 1) * per + 1 > COUNT(rz))
        return;
    fine.count = curve_points(l->rz, l->count, per, rz);
    fine.rz    = (const double(*)[2])rz;
    add_lathe(s, &fine);
}
