/* data/car/regions.c -- see car.h: outlines on the body, as functions that are 0 along them.
 *
 * Inside they are positive, about the distance to the outline in metres. Corners are rounded by
 * a smooth minimum.
 */
#include "data/car/car.h"

#include <math.h>

#define ROUND 0.07 /* m, of corners */

static double both(double a, double b)
{
    const double near = fmax(ROUND - fabs(a - b), 0.0);
    return fmin(a, b) - near * near / (4.0 * ROUND);
}

static double arch(point p)
{
    return fmin(0.385 - hypot(fabs(p.x) - AXLE, p.z - RADIUS), fabs(p.y) - 0.50);
}

/* ---- glass -------------------------------------------------------------------------------- */

static double windscreen(point p)
{
    const double y = fabs(p.y), top = 0.36 - 0.25 * p.y * p.y;
    return both(both(p.z - form_shoulder(p.x) - 0.055, p.x - top), 0.70 * form_cabin(p.x) - y);
}

static double rear_window(point p)
{
    const double y = fabs(p.y), top = -0.98 + 0.25 * p.y * p.y;
    return both(both(p.z - form_shoulder(p.x) - 0.055, top - p.x), 0.70 * form_cabin(p.x) - y);
}

static double side_windows(point p)
{
    const double y = fabs(p.y) - 0.785 * form_cabin(p.x), belt = p.z - form_shoulder(p.x) - 0.035;
    const double back = p.x + 1.42 - 0.6 * (p.z - 0.95), post = -0.30;
    const double free = both(belt, y);
    return fmax(both(free, p.x - post), both(both(free, post - 0.07 - p.x), back));
}

static double windows(point p)
{
    return fmax(fmax(windscreen(p), rear_window(p)), side_windows(p));
}

/* An ellipse as front or back show it, on both sides of the car. */
static double ellipse(point p, double y, double z, double half_width, double half_height)
{
    const double u = (fabs(p.y) - y) / half_width, v = (p.z - z) / half_height;
    return half_height * (1.0 - sqrt(u * u + v * v));
}

static double head_light(point p)
{
    return fmin(ellipse(p, 0.585, 0.615 + 0.12 * (fabs(p.y) - 0.585), 0.175, 0.075), p.x - 1.5);
}

static double tail_light(point p) { return fmin(ellipse(p, 0.56, 0.73, 0.20, 0.055), -1.5 - p.x); }

/* ---- gaps and grilles --------------------------------------------------------------------- */

static double door(point p)
{
    const double side = fabs(p.y) - 0.44, x = p.x - 0.12 * (p.z - 0.6);
    return both(both(x + 0.32, 0.90 - x), both(p.z - 0.27, side));
}

static double hood(point p)
{
    const double y = fabs(p.y), y2 = p.y * p.y;
    return both(both(p.x - 1.06 + 0.25 * y2, 2.0 - 0.25 * y2 - p.x), both(0.68 - y, p.z - 0.5));
}

static double boot(point p)
{
    const double y2 = p.y * p.y;
    return both(both(-1.72 - 0.1 * y2 - p.x, 0.62 - fabs(p.y)), p.z - 0.64);
}

static double intake(point p)
{
    const double low = both(both(0.50 - fabs(p.y), p.x - 1.5), both(p.z - 0.275, 0.425 - p.z));
    return low;
}

static double mouth(point p)
{
    return both(both(0.29 - fabs(p.y), p.x - 1.5), both(p.z - 0.50, 0.595 - p.z));
}

static double sill(point p) { return 0.235 - p.z; }

const region car_regions[] = {
    { arch, 0.0, 9.0, NO_INK },          { head_light, 0.0, 9.0, LENS },
    { head_light, -0.006, 0.0, CHROME }, { tail_light, 0.0, 9.0, TAIL },
    { tail_light, -0.006, 0.0, SEAL },   { windows, 0.0, 9.0, WINDOW },
    { windows, -0.008, 0.0, SEAL },      { windows, -0.018, -0.008, CHROME },
    { mouth, 0.0, 9.0, GRILLE },         { mouth, -0.012, 0.0, CHROME },
    { intake, 0.0, 9.0, GRILLE },        { sill, 0.0, 9.0, TRIM },
    { door, -0.002, 0.002, SEAL },       { hood, -0.002, 0.002, SEAL },
    { boot, -0.002, 0.002, SEAL },
};
const int car_region_count = COUNT(car_regions);
