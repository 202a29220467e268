/* tests/material_points.h -- points and directions that material_checks.h asks about; only the two
 * files that serve it include this. */
#ifndef TESTS_MATERIAL_POINTS_H
#define TESTS_MATERIAL_POINTS_H

#include "materials/material.h"
#include "tests/test.h"

static const double pi = 3.14159265358979324;

typedef struct dir {
    double x, y, z;
} dir;

static inline vvec3 spread(dir d) { return vspread((vec3){ (float)d.x, (float)d.y, (float)d.z }); }

static inline dir lane_dir(const vvec3 *v, int i)
{
    return (dir){ (double)lane(v->x, i), (double)lane(v->y, i), (double)lane(v->z, i) };
}

static inline double lane_channel(const vrgb *v, int i, int channel)
{
    return (double)(channel == 0 ? lane(v->x, i) : channel == 1 ? lane(v->y, i) : lane(v->z, i));
}

static inline vshading seen_from(const material *m, dir wo)
{
    vvec3 n = vspread((vec3){ 0, 0, wo.z < 0.0 ? -1.0f : 1.0f });
    return (vshading){ .wo       = spread(wo),
                       .n        = n,
                       .flat     = n,
                       .front    = n.z > 0.0f,
                       .distance = vsplat(1.0f),
                       .look     = look_plain(m) };
}

/* ---- polar coordinates about an axis ---------------------------------------------------------
 *
 * The angle from the axis is pi x^4, x in [0, 1]: at x = 0.13 it is 1 mrad.
 */

typedef struct polar {
    dir axis, u, v;
} polar;

/* About the mirror direction of wo, or about the one straight on. */
static inline polar polar_about(dir wo, bool transmitted)
{
    dir a         = { -wo.x, -wo.y, transmitted ? -wo.z : wo.z };
    double length = sqrt(a.x * a.x + a.y * a.y + a.z * a.z);
    a             = (dir){ a.x / length, a.y / length, a.z / length };

    double sign = copysign(1.0, a.z), b = -1.0 / (sign + a.z);
    return (polar){ a,
                    { 1.0 + sign * a.x * a.x * b, sign * a.x * a.y * b, -sign * a.x },
                    { a.x * a.y * b, sign + a.y * a.y * b, -a.y } };
}

static inline dir polar_direction(const polar *p, double x, double phi)
{
    double alpha = pi * x * x * x * x;
    double c = cos(alpha), s = sin(alpha), su = s * cos(phi), sv = s * sin(phi);
    return (dir){ c * p->axis.x + su * p->u.x + sv * p->v.x,
                  c * p->axis.y + su * p->u.y + sv * p->v.y,
                  c * p->axis.z + su * p->u.z + sv * p->v.z };
}

/* sr: of a cell of that width in x and phi. */
static inline double polar_solid_angle(double x, double dx, double dphi)
{
    double alpha = pi * x * x * x * x;
    return 4.0 * pi * x * x * x * sin(alpha) * dx * dphi;
}

static inline void polar_of(const polar *p, dir d, double *x, double *phi)
{
    double c  = d.x * p->axis.x + d.y * p->axis.y + d.z * p->axis.z;
    double su = d.x * p->u.x + d.y * p->u.y + d.z * p->u.z;
    double sv = d.x * p->v.x + d.y * p->v.y + d.z * p->v.z;
    *x        = pow(atan2(hypot(su, sv), c) / pi, 0.25);
    *phi      = atan2(sv, su);
    *phi += *phi < 0.0 ? 2.0 * pi : 0.0;
}

#endif
