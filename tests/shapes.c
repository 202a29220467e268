/* tests/shapes.c -- see shapes.h. */
#include "tests/shapes.h"
#include "core/triangle_test.h"

#include <float.h>
#include <stdlib.h>

static void *grown(void *array, uint32_t *room, size_t size)
{
    *room       = *room ? 2 * *room : 64;
    void *moved = realloc(array, *room * size);
    if (!moved)
        abort();
    return moved;
}

mesh shape_mesh(const shape *s)
{
    return (mesh){ .positions      = s->positions,
                   .corners        = s->corners,
                   .position_count = s->position_count,
                   .triangle_count = s->triangle_count };
}

void shape_clear(shape *s)
{
    free(s->positions);
    free(s->corners);
    *s = (shape){ 0 };
}

uint32_t shape_point(shape *s, vec3 p)
{
    if (s->position_count == s->position_room)
        s->positions = grown(s->positions, &s->position_room, sizeof *s->positions);
    s->positions[s->position_count] = p;
    return s->position_count++;
}

void shape_triangle(shape *s, uint32_t a, uint32_t b, uint32_t c)
{
    if (s->triangle_count == s->triangle_room)
        s->corners = grown(s->corners, &s->triangle_room, 3 * sizeof *s->corners);
    uint32_t *to = s->corners + (size_t)3 * s->triangle_count++;
    to[0] = a, to[1] = b, to[2] = c;
}

/* Squares between rows x columns points from `first` on, columns closed, rows if `round`. */
static void close_net(shape *s, uint32_t first, int rows, int columns, bool round)
{
    for (int i = 0; i + !round < rows; i++)
        for (int j = 0; j < columns; j++) {
            uint32_t r = (uint32_t)((i + 1) % rows * columns), q = (uint32_t)(i * columns);
            uint32_t j0 = (uint32_t)j, j1 = (uint32_t)((j + 1) % columns);
            shape_triangle(s, first + q + j0, first + r + j0, first + r + j1);
            shape_triangle(s, first + q + j0, first + r + j1, first + q + j1);
        }
}

void shape_sphere(shape *s, vec3 centre, float radius, int rings)
{
    int columns    = 2 * rings;
    uint32_t first = s->position_count;
    for (int i = 1; i < rings; i++)
        for (int j = 0; j < columns; j++) {
            double a = 3.14159265358979 * i / rings, b = 6.28318530717959 * j / columns;
            shape_point(s, (vec3){ centre.x + radius * (float)(sin(a) * cos(b)),
                                   centre.y + radius * (float)(sin(a) * sin(b)),
                                   centre.z + radius * (float)cos(a) });
        }
    close_net(s, first, rings - 1, columns, false);
    uint32_t top  = shape_point(s, (vec3){ centre.x, centre.y, centre.z + radius });
    uint32_t foot = shape_point(s, (vec3){ centre.x, centre.y, centre.z - radius });
    uint32_t last = first + (uint32_t)((rings - 2) * columns);
    for (int j = 0; j < columns; j++) {
        uint32_t j0 = (uint32_t)j, j1 = (uint32_t)((j + 1) % columns);
        shape_triangle(s, top, first + j0, first + j1);
        shape_triangle(s, foot, last + j1, last + j0);
    }
}

void shape_torus(shape *s, vec3 centre, float radius, float tube, int rings)
{
    uint32_t first = s->position_count;
    for (int i = 0; i < 2 * rings; i++)
        for (int j = 0; j < rings; j++) {
            double a = 3.14159265358979 * i / rings, b = 6.28318530717959 * j / rings;
            double r = (double)radius + (double)tube * cos(b);
            shape_point(s, (vec3){ centre.x + (float)(r * cos(a)), centre.y + (float)(r * sin(a)),
                                   centre.z + tube * (float)sin(b) });
        }
    close_net(s, first, 2 * rings, rings, true);
}

/* The corner (i, j, k) of the box's net, found again by its number where sides share it. */
typedef struct net {
    shape *s;
    vec3 low, high;
    int cells;
    uint32_t *numbers; /* + 1; (cells + 1)^3 */
} net;

static uint32_t net_point(net *n, const int at[3])
{
    int m           = n->cells + 1;
    uint32_t *found = &n->numbers[(at[0] * m + at[1]) * m + at[2]];
    if (!*found) {
        float x = (float)at[0] / (float)n->cells, y = (float)at[1] / (float)n->cells;
        float z = (float)at[2] / (float)n->cells;
        *found  = 1 + shape_point(n->s, (vec3){ n->low.x + (n->high.x - n->low.x) * x,
                                                n->low.y + (n->high.y - n->low.y) * y,
                                                n->low.z + (n->high.z - n->low.z) * z });
    }
    return *found - 1;
}

void shape_box(shape *s, vec3 low, vec3 high, int cells)
{
    size_t m = (size_t)cells + 1;
    net n    = { s, low, high, cells, calloc(m * m * m, sizeof *n.numbers) };
    if (!n.numbers)
        abort();
    for (int side = 0; side < 6; side++) {
        int axis = side / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (int i = 0; i < cells; i++)
            for (int j = 0; j < cells; j++) {
                uint32_t p[4];
                for (int k = 0; k < 4; k++) {
                    int at[3];
                    at[axis] = side % 2 ? cells : 0;
                    at[u]    = i + (k == 1 || k == 2);
                    at[v]    = j + (k >= 2);
                    p[k]     = net_point(&n, at);
                }
                uint32_t second = side % 2 ? p[1] : p[3], last = side % 2 ? p[3] : p[1];
                shape_triangle(s, p[0], second, p[2]);
                shape_triangle(s, p[0], p[2], last);
            }
    }
    free(n.numbers);
}

float random_unit(uint32_t *state)
{
    *state     = *state * 747796405u + 2891336453u; /* O'Neill's PCG, output RXS-M-XS */
    uint32_t w = ((*state >> ((*state >> 28 & 15) + 4)) ^ *state) * 277803737u;
    return (float)((w >> 22 ^ w) >> 8) * 0x1p-24f;
}

vec3 random_direction(uint32_t *state)
{
    float z   = 2.0f * random_unit(state) - 1.0f;
    float phi = 6.2831853f * random_unit(state);
    float r   = sqrtf(fmaxf(0.0f, 1.0f - z * z));
    return (vec3){ r * cosf(phi), r * sinf(phi), z };
}

/* Each number drawn in a statement of its own: else compilers choose the order. */
vec3 random_point(uint32_t *state)
{
    float x = 2.0f * random_unit(state) - 1.0f;
    float y = 2.0f * random_unit(state) - 1.0f;
    float z = 2.0f * random_unit(state) - 1.0f;
    return (vec3){ x, y, z };
}

vec3 random_offset(float size, uint32_t *state)
{
    float length = size * random_unit(state);
    return v3_scale(random_direction(state), length);
}

void shape_soup(shape *s, int triangles, float size, uint32_t seed)
{
    for (int i = 0; i < triangles; i++) {
        vec3 at = random_point(&seed);
        uint32_t p[3];
        for (int k = 0; k < 3; k++) {
            vec3 d = random_offset(size, &seed);
            p[k]   = shape_point(s, (vec3){ at.x + d.x, at.y + d.y, at.z + d.z });
        }
        shape_triangle(s, p[0], p[1], p[2]);
    }
}

static void put(vfloat *a, int i, float value)
{
    *a = vselect(vlane_index() == vsplat_int(i), vsplat(value), *a);
}

void ray_set(vray *r, int i, vec3 o, vec3 d, float reach)
{
    put(&r->origin.x, i, o.x);
    put(&r->origin.y, i, o.y);
    put(&r->origin.z, i, o.z);
    put(&r->direction.x, i, d.x);
    put(&r->direction.y, i, d.y);
    put(&r->direction.z, i, d.z);
    put(&r->reach, i, reach);
}

/* ---- everything ----------------------------------------------------------------------------- */

/* Each lane's x, y, z from the axis `shift` behind that of its largest component. */
static vfloat axis_of(const vvec3 *a, vint longest, int shift)
{
    const vfloat c[3] = { a->x, a->y, a->z };
    vfloat out        = c[(2 + shift) % 3];
    out               = vselect(longest == vsplat_int(0), c[shift], out);
    return vselect(longest == vsplat_int(1), c[(1 + shift) % 3], out);
}

static vvec3 turned(const transform *t, const vvec3 *a, bool point)
{
    vfloat r[3];
    for (int k = 0; k < 3; k++) {
        r[k] = (float)t->m[k][0] * a->x + (float)t->m[k][1] * a->y + (float)t->m[k][2] * a->z;
        if (point)
            r[k] = r[k] + (float)t->m[k][3];
    }
    return (vvec3){ r[0], r[1], r[2] };
}

static void brute_mesh(const mesh *m, int instance, const vvec3 *o, const vvec3 *d, vmask active,
                       vhit *best)
{
    vfloat x = vabs(d->x), y = vabs(d->y), z = vabs(d->z);
    vint longest  = vselect_int((x >= y) & (x >= z), vsplat_int(0),
                                vselect_int(y >= z, vsplat_int(1), vsplat_int(2)));
    vshear s      = { { axis_of(o, longest, 1), axis_of(o, longest, 2), axis_of(o, longest, 0) } };
    s.s[0]        = axis_of(d, longest, 1) / axis_of(d, longest, 0);
    s.s[1]        = axis_of(d, longest, 2) / axis_of(d, longest, 0);
    s.s[2]        = 1.0f / axis_of(d, longest, 0);
    float largest = 0.0f;
    for (uint32_t i = 0; i < m->position_count; i++) {
        vec3 at = m->positions[i];
        largest = fmaxf(largest, fmaxf(fabsf(at.x), fmaxf(fabsf(at.y), fabsf(at.z))));
    }
    s.near = shear_near(s.s[2], largest);
    for (uint32_t i = 0; i < m->triangle_count; i++) {
        vfloat p[3][3];
        for (int k = 0; k < 3; k++) {
            vvec3 corner = vspread(m->positions[m->corners[3 * i + (uint32_t)k]]);
            for (int shift = 0; shift < 3; shift++)
                p[k][(shift + 2) % 3] = axis_of(&corner, longest, shift);
        }
        vcorners c = { { p[0][0], p[0][1], p[0][2] },
                       { p[1][0], p[1][1], p[1][2] },
                       { p[2][0], p[2][1], p[2][2] } };
        vmeet hit  = { 0 };
        vmask in   = watertight_rare(&s, &c, active, &hit);
        in         = meet_within(&hit, in, vmin(best->distance, vsplat(FLT_MAX)));
        in &= hit.t < best->distance; /* the first of equals stays */
        best->distance = vselect(in, hit.t, best->distance);
        best->instance = vselect_int(in, vsplat_int(instance), best->instance);
        best->triangle = vselect_int(in, vsplat_int((int32_t)i), best->triangle);
        best->u        = vselect(in, hit.u, best->u);
        best->v        = vselect(in, hit.v, best->v);
    }
}

vhit brute_first(const world_desc *d, const vray *ray, vmask active)
{
    vhit best = { .distance = ray->reach, .instance = vsplat_int(-1), .triangle = vsplat_int(-1) };
    for (uint32_t i = 0; i < d->instance_count; i++) {
        transform back = transform_inverse(&d->instances[i].place);
        vvec3 o = turned(&back, &ray->origin, true), dir = turned(&back, &ray->direction, false);
        brute_mesh(&d->meshes[d->instances[i].mesh], (int)i, &o, &dir, active, &best);
    }
    best.distance = vselect(best.instance >= vsplat_int(0), best.distance, vsplat(INFINITY));
    return best;
}
