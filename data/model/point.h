/* data/model/point.h -- points and arrows in space, m. */
#ifndef MODEL_POINT_H
#define MODEL_POINT_H

#include <math.h>

typedef struct point {
    double x, y, z;
} point;

static inline point minus(point a, point b) { return (point){ a.x - b.x, a.y - b.y, a.z - b.z }; }

static inline double dot(point a, point b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline double length(point a) { return sqrt(dot(a, a)); }
static inline point times(point a, double f) { return (point){ a.x * f, a.y * f, a.z * f }; }
static inline point unit(point a) { return times(a, 1.0 / length(a)); }

static inline point cross(point a, point b)
{
    return (point){ a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

/* Of two things that mirror one another the right or the left: -1 or 1. */
static inline double side_of(int i) { return i ? 1.0 : -1.0; }

#endif
