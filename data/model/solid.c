/* data/model/solid.c -- see solid.h. */
#include "data/model/solid.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define TURN 6.28318530717958647692

enum { SIDE_MAX = 1024 }; /* points around a ring, or lines of a raster squared */

shape shape_new(const char *name, double detail)
{
    shape s = { .detail = detail };
    strncpy(s.name, name, sizeof s.name - 1);
    shape_at(&s, (point){ 0 }, 0.0, 0.0);
    return s;
}

void solid_clear(shape *s)
{
    for (int m = 0; m < INK_MAX; m++) {
        free(s->patches[m].xyz);
        free(s->patches[m].corners);
        s->patches[m] = (patch){ 0 };
    }
}

void shape_at(shape *s, point p, double turn_deg, double tip_deg)
{
    const double ct = cos(turn_deg * TURN / 360.0), st = sin(turn_deg * TURN / 360.0);
    const double cp = cos(tip_deg * TURN / 360.0), sp = sin(tip_deg * TURN / 360.0);
    s->origin  = p;
    s->axis[0] = (point){ ct, st, 0.0 };
    s->axis[1] = (point){ -st * cp, ct * cp, sp };
    s->axis[2] = (point){ st * sp, -ct * sp, cp };
}

static bool grow(void **array, uint32_t *room, uint32_t count, size_t size)
{
    if (count < *room)
        return true;
    const uint32_t more = *room ? *room * 2 : 256;
    void *moved         = realloc(*array, more * size);
    if (moved) {
        *array = moved;
        *room  = more;
    }
    return moved != NULL;
}

static float rounded(double v) { return (float)(round(v * 1e5) / 1e5 + 0.0); }

uint32_t add_vertex(shape *s, point p)
{
    patch *t = &s->patches[s->ink];
    if (!grow((void **)&t->xyz, &t->vertex_room, t->vertex_count, 3 * sizeof *t->xyz)) {
        s->out_of_memory = true;
        return 0;
    }
    if (s->warp)
        s->warp(&p);
    const point o = s->origin, *a = s->axis;
    float *to = t->xyz + 3 * t->vertex_count;
    to[0]     = rounded(o.x + a[0].x * p.x + a[1].x * p.y + a[2].x * p.z);
    to[1]     = rounded(o.y + a[0].y * p.x + a[1].y * p.y + a[2].y * p.z);
    to[2]     = rounded(o.z + a[0].z * p.x + a[1].z * p.y + a[2].z * p.z);
    return t->vertex_count++;
}

void add_triangle(shape *s, uint32_t a, uint32_t b, uint32_t c)
{
    patch *t = &s->patches[s->ink];
    if (!grow((void **)&t->corners, &t->triangle_room, t->triangle_count, 3 * sizeof *t->corners)) {
        s->out_of_memory = true;
        return;
    }
    memcpy(t->corners + 3 * t->triangle_count, (uint32_t[]){ a, b, c }, 3 * sizeof a);
    t->triangle_count++;
}

/* a, b, c, d run counter-clockwise */
static void quad(shape *s, uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    add_triangle(s, a, b, c);
    add_triangle(s, a, c, d);
}

uint32_t shape_triangles(const shape *s)
{
    uint32_t n = 0;
    for (int m = 0; m < INK_MAX; m++)
        n += s->patches[m].triangle_count;
    return n;
}

double draw(uint32_t *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return (*seed >> 8) / 16777216.0;
}

/* ---- boxes and plates ------------------------------------------------------------------- */

void add_box(shape *s, point a, point b)
{
    uint32_t v[8]; /* bit 0: b.x, bit 1: b.y, bit 2: b.z */
    for (int i = 0; i < 8; i++)
        v[i] = add_vertex(s, (point){ i & 1 ? b.x : a.x, i & 2 ? b.y : a.y, i & 4 ? b.z : a.z });
    quad(s, v[0], v[2], v[3], v[1]);
    quad(s, v[4], v[5], v[7], v[6]);
    quad(s, v[0], v[1], v[5], v[4]);
    quad(s, v[2], v[6], v[7], v[3]);
    quad(s, v[0], v[4], v[6], v[2]);
    quad(s, v[1], v[3], v[7], v[5]);
}

static bool solid_cell(const plate *p, int i, int j)
{
    return i >= 0 && j >= 0 && i < p->nu - 1 && j < p->nv - 1 &&
           p->cells[j * (p->nu - 1) + i] != ' ';
}

static uint32_t plate_vertex(shape *s, const plate *p, int i, int j, double w)
{
    const double u = p->u[i], v = p->v[j];
    const point at[3] = { { w, u, v }, { u, w, v }, { u, v, w } };
    return add_vertex(s, at[p->across]);
}

/* The corners of the raster that some solid cell touches, near (w0) and far (w1). */
static void plate_vertices(shape *s, const plate *p, uint32_t (*at)[2])
{
    for (int j = 0; j < p->nv; j++)
        for (int i = 0; i < p->nu; i++)
            if (solid_cell(p, i, j) || solid_cell(p, i - 1, j) || solid_cell(p, i, j - 1) ||
                solid_cell(p, i - 1, j - 1)) {
                at[j * p->nu + i][0] = plate_vertex(s, p, i, j, p->w0);
                at[j * p->nu + i][1] = plate_vertex(s, p, i, j, p->w1);
            }
}

/* The face between two raster corners; `flip`: u, v, w are a left-handed system. */
static void plate_side(shape *s, const uint32_t *a, const uint32_t *b, bool flip)
{
    if (flip)
        quad(s, a[0], a[1], b[1], b[0]);
    else
        quad(s, a[0], b[0], b[1], a[1]);
}

static void plate_cell(shape *s, const plate *p, uint32_t (*at)[2], int i, int j)
{
    const bool flip   = p->across == 1;
    const uint32_t *a = at[j * p->nu + i], *b = at[j * p->nu + i + 1];
    const uint32_t *d = at[(j + 1) * p->nu + i], *c = at[(j + 1) * p->nu + i + 1];

    quad(s, a[!flip], b[!flip], c[!flip], d[!flip]);
    quad(s, a[flip], d[flip], c[flip], b[flip]);
    if (!solid_cell(p, i, j - 1))
        plate_side(s, a, b, flip);
    if (!solid_cell(p, i + 1, j))
        plate_side(s, b, c, flip);
    if (!solid_cell(p, i, j + 1))
        plate_side(s, c, d, flip);
    if (!solid_cell(p, i - 1, j))
        plate_side(s, d, a, flip);
}

void add_plate(shape *s, const plate *p)
{
    uint32_t at[SIDE_MAX][2];
    assert(p->nu * p->nv <= SIDE_MAX && strlen(p->cells) == (size_t)((p->nu - 1) * (p->nv - 1)));
    plate_vertices(s, p, at);
    for (int j = 0; j < p->nv - 1; j++)
        for (int i = 0; i < p->nu - 1; i++)
            if (solid_cell(p, i, j))
                plate_cell(s, p, at, i, j);
}

/* ---- round things ----------------------------------------------------------------------- */

static int fine(const shape *s, int segments, int least)
{
    const int n = (int)lround(segments * s->detail);
    return n < least ? least : n > SIDE_MAX ? SIDE_MAX : n;
}

/* One ring of n vertices, or a pole, that a band of faces joins to the one before it. */
typedef struct ring {
    uint32_t at[SIDE_MAX];
    bool pole;
} ring;

/* Counter-clockwise rings, the lower first: faces look outward. */
static void join(shape *s, const ring *low, const ring *high, int n)
{
    for (int i = 0; i < n; i++) {
        const int k = (i + 1) % n;
        if (low->pole)
            add_triangle(s, low->at[0], high->at[k], high->at[i]);
        else if (high->pole)
            add_triangle(s, low->at[i], low->at[k], high->at[0]);
        else
            quad(s, low->at[i], low->at[k], high->at[k], high->at[i]);
    }
}

/* A flat end on a ring; the lowest looks down. */
static void cap(shape *s, const ring *end, int n, bool lowest)
{
    for (int i = 2; i < n; i++)
        add_triangle(s, end->at[0], end->at[lowest ? i : i - 1], end->at[lowest ? i - 1 : i]);
}

static void lathe_ring(shape *s, ring *to, const double rz[2], int n)
{
    to->pole = rz[0] == 0.0;
    for (int i = 0; i < (to->pole ? 1 : n); i++) {
        const double a = TURN * i / n;
        to->at[i]      = add_vertex(s, (point){ rz[0] * cos(a), rz[0] * sin(a), rz[1] });
    }
}

void add_lathe(shape *s, const lathe *l)
{
    const int n = fine(s, l->segments, 3);
    ring rings[2], first;
    lathe_ring(s, &rings[0], l->rz[0], n);
    first = rings[0];
    for (int i = 1; i < l->count; i++) {
        lathe_ring(s, &rings[i & 1], l->rz[i], n);
        join(s, &rings[~i & 1], &rings[i & 1], n);
    }
    if (l->closed)
        join(s, &rings[(l->count - 1) & 1], &first, n);
}

void add_cylinder(shape *s, point base, double radius, double height, int segments)
{
    const int n = fine(s, segments, 3);
    ring low = { .pole = false }, high = { .pole = false };
    for (int i = 0; i < n; i++) {
        const double a = TURN * i / n, x = base.x + radius * cos(a), y = base.y + radius * sin(a);
        low.at[i]  = add_vertex(s, (point){ x, y, base.z });
        high.at[i] = add_vertex(s, (point){ x, y, base.z + height });
    }
    cap(s, &low, n, true);
    join(s, &low, &high, n);
    cap(s, &high, n, false);
}

/* Where a tube points at its i-th point: midway between the stretches before and after. */
static point heading(const tube *t, int i)
{
    point d = { 0 };
    if (i > 0)
        d = unit(minus(t->path[i], t->path[i - 1]));
    if (i + 1 < t->count)
        d = minus(unit(minus(t->path[i + 1], t->path[i])), times(d, -1.0));
    return unit(d);
}

/* Square tubes lie flat: corners at 45 degrees. The first side is kept along the path. */
static void tube_ring(shape *s, ring *to, const tube *t, int i, int n, point *side)
{
    const point d = heading(t, i), c = t->path[i];
    *side          = unit(minus(*side, times(d, dot(*side, d))));
    const point e  = cross(d, *side);
    const double f = t->count > 1 ? (double)i / (t->count - 1) : 0.0;
    const double r = t->end_radius > 0.0 ? t->radius + (t->end_radius - t->radius) * f : t->radius;

    to->pole = false;
    for (int k = 0; k < n; k++) {
        const double a = TURN * (k + 0.5) / n, x = r * cos(a), y = r * sin(a);
        to->at[k] = add_vertex(s, (point){ c.x + side->x * x + e.x * y, c.y + side->y * x + e.y * y,
                                           c.z + side->z * x + e.z * y });
    }
}

void add_tube(shape *s, const tube *t)
{
    const int n       = t->segments == 4 ? 4 : fine(s, t->segments, 3);
    const point along = heading(t, 0);
    point side        = fabs(along.z) < 0.8 ? (point){ 0, 0, 1 } : (point){ 1, 0, 0 };
    ring rings[2];

    tube_ring(s, &rings[0], t, 0, n, &side);
    cap(s, &rings[0], n, true);
    for (int i = 1; i < t->count; i++) {
        tube_ring(s, &rings[i & 1], t, i, n, &side);
        join(s, &rings[~i & 1], &rings[i & 1], n);
    }
    cap(s, &rings[(t->count - 1) & 1], n, false);
}

static double power(double base, double e) { return copysign(pow(fabs(base), e), base); }

static void cushion_ring(shape *s, ring *to, const cushion *c, double tilt, int n)
{
    const double r = power(cos(tilt), c->edge), z = c->half.z * power(sin(tilt), c->edge);
    to->pole = fabs(tilt) > 0.2499 * TURN;
    for (int i = 0; i < (to->pole ? 1 : n); i++) {
        const double a = TURN * (i + 0.5) / n, w = to->pole ? 0.0 : r;
        to->at[i] =
            add_vertex(s, (point){ c->centre.x + c->half.x * w * power(cos(a), c->squareness),
                                   c->centre.y + c->half.y * w * power(sin(a), c->squareness),
                                   c->centre.z + z });
    }
}

/* An end of straight strips along x, each between two places of the ring as far along y. */
static void strips(shape *s, const ring *end, int n, bool lowest)
{
    for (int k = 0; k + 1 < n / 2; k++) {
        const uint32_t right = end->at[(n + n / 4 - 1 - k) % n], left = end->at[n / 4 + k];
        const uint32_t right2 = end->at[(n + n / 4 - 2 - k) % n], left2 = end->at[n / 4 + k + 1];
        if (lowest)
            quad(s, right, right2, left2, left);
        else
            quad(s, right, left, left2, right2);
    }
}

void add_cushion(shape *s, const cushion *c)
{
    const int n = 4 * (fine(s, c->segments, 4) / 4), rows = fine(s, c->rings, 3);
    const int skip = c->ruled ? 1 : 0; /* strips instead of poles */
    ring rings[2];
    for (int i = skip; i <= rows - skip; i++) {
        cushion_ring(s, &rings[i & 1], c, TURN * (0.5 * i / rows - 0.25), n);
        if (i > skip)
            join(s, &rings[~i & 1], &rings[i & 1], n);
        if (c->ruled && (i == 1 || i == rows - 1))
            strips(s, &rings[i & 1], n, i == 1);
    }
}
