/* core/transform.h -- affine maps and vectors in double precision, for building scenes.
 *
 * Places of a building may be given in a country's grid, millions of metres from its origin:
 * they are placed in double precision and traced, re-centred, in single.
 */
#ifndef CORE_TRANSFORM_H
#define CORE_TRANSFORM_H

#include "core/vec3.h"

typedef struct dvec3 {
    double x, y, z;
} dvec3;

/* p -> m p + t: the columns 0..2 of m are where the axes go, column 3 is where the origin goes. */
typedef struct transform {
    double m[3][4];
} transform;

#define TRANSFORM_IDENTITY ((transform){ { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 } } })

static inline dvec3 d3_add(dvec3 a, dvec3 b) { return (dvec3){ a.x + b.x, a.y + b.y, a.z + b.z }; }
static inline dvec3 d3_sub(dvec3 a, dvec3 b) { return (dvec3){ a.x - b.x, a.y - b.y, a.z - b.z }; }
static inline dvec3 d3_scale(dvec3 a, double s) { return (dvec3){ a.x * s, a.y * s, a.z * s }; }
static inline double d3_dot(dvec3 a, dvec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline double d3_length(dvec3 a) { return sqrt(d3_dot(a, a)); }
static inline dvec3 d3_cross(dvec3 a, dvec3 b)
{
    return (dvec3){ a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}
static inline dvec3 d3_from(vec3 a) { return (dvec3){ (double)a.x, (double)a.y, (double)a.z }; }
static inline vec3 d3_to_float(dvec3 a) { return (vec3){ (float)a.x, (float)a.y, (float)a.z }; }

/* Each coordinate as a float has it. By way of memory, since gcc 12 at -O2 takes
 * d3_from(d3_to_float(a)) for a itself. */
static inline dvec3 d3_rounded(dvec3 a)
{
    volatile float x = (float)a.x, y = (float)a.y, z = (float)a.z;
    return (dvec3){ (double)x, (double)y, (double)z };
}
static inline bool d3_finite(dvec3 a) { return isfinite(a.x) && isfinite(a.y) && isfinite(a.z); }

static inline dvec3 transform_vector(const transform *t, dvec3 v)
{
    return (dvec3){ t->m[0][0] * v.x + t->m[0][1] * v.y + t->m[0][2] * v.z,
                    t->m[1][0] * v.x + t->m[1][1] * v.y + t->m[1][2] * v.z,
                    t->m[2][0] * v.x + t->m[2][1] * v.y + t->m[2][2] * v.z };
}
static inline dvec3 transform_point(const transform *t, dvec3 p)
{
    return d3_add(transform_vector(t, p), (dvec3){ t->m[0][3], t->m[1][3], t->m[2][3] });
}

/* First b, then a. */
static inline transform transform_product(const transform *a, const transform *b)
{
    transform c;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            c.m[i][j] = a->m[i][0] * b->m[0][j] + a->m[i][1] * b->m[1][j] +
                        a->m[i][2] * b->m[2][j] + (j == 3 ? a->m[i][3] : 0.0);
    return c;
}

/* Of the linear part: the volume of the unit cube's image, negative where it mirrors. */
static inline double transform_determinant(const transform *t)
{
    const double(*m)[4] = t->m;
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/* The inverse of t, whose determinant must not be 0. */
static inline transform transform_inverse(const transform *t)
{
    const double(*m)[4] = t->m;
    double s            = 1.0 / transform_determinant(t);
    transform r         = { { { s * (m[1][1] * m[2][2] - m[1][2] * m[2][1]),
                                s * (m[0][2] * m[2][1] - m[0][1] * m[2][2]),
                                s * (m[0][1] * m[1][2] - m[0][2] * m[1][1]), 0 },
                              { s * (m[1][2] * m[2][0] - m[1][0] * m[2][2]),
                                s * (m[0][0] * m[2][2] - m[0][2] * m[2][0]),
                                s * (m[0][2] * m[1][0] - m[0][0] * m[1][2]), 0 },
                              { s * (m[1][0] * m[2][1] - m[1][1] * m[2][0]),
                                s * (m[0][1] * m[2][0] - m[0][0] * m[2][1]),
                                s * (m[0][0] * m[1][1] - m[0][1] * m[1][0]), 0 } } };
    dvec3 o             = transform_vector(&r, (dvec3){ m[0][3], m[1][3], m[2][3] });
    r.m[0][3] = -o.x, r.m[1][3] = -o.y, r.m[2][3] = -o.z;
    return r;
}

#endif
