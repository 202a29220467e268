/* tests/lab_sphere.c -- see lab_sphere.h. */
#include "tests/lab_sphere.h"

#include "tests/test.h"

static dvec3 corner_of(int ring, int sector, int rings)
{
    double z = M_PI * ring / rings, turn = M_PI * (sector % (2 * rings)) / rings;
    double s = ring == rings ? 0.0 : sin(z); /* the pole is one point */
    return (dvec3){ s * cos(turn), s * sin(turn), cos(z) };
}

double lab_sphere(lab *l, const char *name, dvec3 centre, double radius, int rings,
                  const char *made_of)
{
    int count   = 2 * rings * rings;
    quad *q     = arena_array(&l->a, quad, (size_t)count, NULL);
    double area = 0.0;
    for (int i = 0; i < count; i++) {
        int r = i / (2 * rings), s = i % (2 * rings);
        /* A piece at a pole has two corners there */
        const dvec3 c[4] = { corner_of(r, s, rings), corner_of(r + 1, s, rings),
                             corner_of(r + 1, s + 1, rings), corner_of(r, s + 1, rings) };
        for (int k = 0; k < 4; k++)
            q[i].corner[k] = d3_add(centre, d3_scale(c[k], radius));
        dvec3 a = d3_sub(q[i].corner[2], q[i].corner[0]);
        dvec3 b = d3_sub(q[i].corner[3], q[i].corner[1]);
        area += 0.5 * d3_length(d3_cross(a, b));
    }
    lab_quads(l, name, q, count, made_of);
    return area;
}
