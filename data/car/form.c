/* data/car/form.c -- see car.h: the body, a hull and a cabin of superelliptic sections, lofted.
 *
 * Hull, per section x:  |y / w|^3.4 + |(z - m) / h|^3 + |x / l|^12 = 1
 * Cabin:                |y / c|^2.6 + ((z - z0) / (r - z0))^3.6 + |(x - x0) / l'|^8 = 1,  z > z0
 * w, c: half widths; m, h: middle and half height between floor pan and shoulder; r: roof line;
 * all are B-splines along x. The two blend into one another within some centimetres.
 */
#include "data/car/car.h"

#include <math.h>

#define QUARTER      1.57079632679489661923
#define HALF_LENGTH  2.25 /* m */
#define CABIN_FLOOR  0.35
#define CABIN_LENGTH 1.9 /* half of what the roof line can reach, about x = -0.35 */
#define BLEND        0.07

/* Knots from x = -2.5 (behind the tail) to 2.5 m, every 0.25 m */
enum { KNOTS = 21 };
static const double shoulder[KNOTS] = { 0.86, 0.89,  0.915, 0.925, 0.925, 0.92, 0.91,
                                        0.90, 0.89,  0.885, 0.88,  0.875, 0.87, 0.865,
                                        0.86, 0.845, 0.82,  0.785, 0.74,  0.68, 0.61 };
static const double under[KNOTS]    = { 0.36, 0.31, 0.25, 0.21, 0.19, 0.18, 0.175,
                                        0.17, 0.17, 0.17, 0.17, 0.17, 0.17, 0.17,
                                        0.17, 0.17, 0.17, 0.18, 0.19, 0.21, 0.24 };
static const double width[KNOTS]    = { 0.80, 0.83, 0.855, 0.875, 0.885, 0.885, 0.88,
                                        0.87, 0.86, 0.855, 0.855, 0.855, 0.86,  0.865,
                                        0.87, 0.87, 0.865, 0.85,  0.82,  0.775, 0.70 };
static const double roof[KNOTS]     = { 0.45, 0.58, 0.79,  0.97, 1.10, 1.22,  1.315,
                                        1.38, 1.41, 1.415, 1.40, 1.36, 1.265, 1.11,
                                        0.95, 0.78, 0.60,  0.45, 0.40, 0.40,  0.40 };
static const double cabin[KNOTS]    = { 0.45, 0.48,  0.52, 0.57, 0.62, 0.665, 0.70,
                                        0.72, 0.735, 0.74, 0.74, 0.74, 0.735, 0.725,
                                        0.71, 0.69,  0.67, 0.65, 0.63, 0.60,  0.60 };

static double spline(const double *knots, double x)
{
    return curve_at(knots, KNOTS, -2.5, 0.25, x);
}

double form_shoulder(double x) { return spline(shoulder, x); }
double form_cabin(double x) { return spline(cabin, x); }

/* Wide over the wheels, drawn in between them. */
static double half_width(double x, double z)
{
    const double r = hypot(fabs(x) - AXLE, z - RADIUS) - 0.40, a = r / 0.09;
    const double b = (z - 0.44) / 0.13, c = x / 0.85;
    return spline(width, x) + 0.035 / (1.0 + a * a) - 0.035 * exp(-b * b - c * c * c * c);
}

static double hull(point p)
{
    const double low = spline(under, p.x), high = spline(shoulder, p.x);
    const double m = 0.5 * (low + high), h = 0.5 * (high - low);
    const double sum = pow(fabs(p.y) / half_width(p.x, p.z), 3.4) + pow(fabs(p.z - m) / h, 3.0) +
                       pow(fabs(p.x) / HALF_LENGTH, 12.0);
    return 0.45 * (pow(sum, 1.0 / 3.2) - 1.0);
}

static double house(point p)
{
    const double h   = fmax(spline(roof, p.x) - CABIN_FLOOR, 0.02);
    const double sum = pow(fabs(p.y) / spline(cabin, p.x), 2.6) +
                       pow(fmax(p.z - CABIN_FLOOR, 0.0) / h, 3.6) +
                       pow(fabs(p.x + 0.35) / CABIN_LENGTH, 8.0);
    return fmax(0.6 * (pow(sum, 1.0 / 3.2) - 1.0), CABIN_FLOOR - p.z);
}

double form(point p)
{
    const double a = hull(p), b = house(p);
    const double near = fmax(BLEND - fabs(a - b), 0.0);
    return fmin(a, b) - near * near / (4.0 * BLEND);
}

/* Where the ray leaves the body; it starts inside and crosses the surface once. */
static point leaves(point from, point d)
{
    double in = 0.0, out = 3.0;
    for (int i = 0; i < 48; i++) {
        const double t                = 0.5 * (in + out);
        const point p                 = { from.x + d.x * t, from.y + d.y * t, from.z + d.z * t };
        *(form(p) < 0.0 ? &in : &out) = t;
    }
    return (point){ from.x + d.x * in, from.y + d.y * in, from.z + d.z * in };
}

/* Rays square to an axis along the car, that at its ends turn until they look along it. */
point form_at(double along, double around)
{
    const double axis = 1.75, end = 0.95; /* m: half of it, and what the quarter turn stands for */
    const double a = fabs(along) * (axis + end), turn = fmax(a - axis, 0.0) / end * QUARTER;
    const double side = along < 0.0 ? -1.0 : 1.0, c = cos(turn);
    if (a >= axis + end)
        return leaves((point){ side * axis, 0.0, 0.52 }, (point){ side, 0.0, 0.0 });
    return leaves((point){ side * fmin(a, axis), 0.0, 0.52 },
                  (point){ side * sin(turn), c * cos(around), c * sin(around) * 0.8 });
}

point form_above(double x, double y)
{
    return leaves((point){ x, y, 0.5 }, (point){ 0.0, 0.0, 1.0 });
}
