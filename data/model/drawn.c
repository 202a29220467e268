/* data/model/drawn.c -- see model.h: normals and texture coordinates of a patch's corners.
 *
 * A corner's normal is the mean, by area, of the faces about its vertex that meet its own face by
 * less than the crease. Sums, products and roots only: the same bytes on every machine.
 */
#include "data/model/model.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define TURN 6.28318530717958647692

typedef struct corner_look {
    float normal[3], uv[2];
} corner_look;

/* What is worked out of a patch; `around` lists the triangles of vertex v from start[v] on. */
typedef struct work {
    const patch *of;
    const paint *by;
    point *faces; /* normal times twice the area, one a triangle */
    uint32_t *start, *around;
    point low, high;
    corner_look *corners;   /* one a triangle's corner */
    uint32_t *first, *next; /* vertices made of a vertex, plus one */
} work;

static point vertex_of(const patch *t, uint32_t v)
{
    const float *p = t->xyz + 3 * v;
    return (point){ (double)p[0], (double)p[1], (double)p[2] };
}

static point face_of(const patch *t, uint32_t i)
{
    const uint32_t *c = t->corners + 3 * i;
    const point a = vertex_of(t, c[0]), b = vertex_of(t, c[1]), d = vertex_of(t, c[2]);
    return cross(minus(b, a), minus(d, a));
}

/* ---- normals ------------------------------------------------------------------------------ */

static void find_around(work *w)
{
    const patch *t   = w->of;
    const uint32_t n = 3 * t->triangle_count;
    for (uint32_t i = 0; i < n; i++)
        w->start[t->corners[i] + 1]++;
    for (uint32_t v = 0; v < t->vertex_count; v++)
        w->start[v + 1] += w->start[v];
    for (uint32_t i = n; i-- > 0;) /* start[v + 1] runs down to what start[v] should be */
        w->around[--w->start[t->corners[i] + 1]] = i / 3;
    memmove(w->start, w->start + 1, t->vertex_count * sizeof *w->start);
    w->start[t->vertex_count] = n;
}

static void find_normal(const work *w, uint32_t corner, double cos_crease)
{
    const uint32_t v  = w->of->corners[corner];
    const point own   = w->faces[corner / 3];
    const double area = length(own);
    point sum         = { 0 };
    for (uint32_t k = w->start[v]; k < w->start[v + 1]; k++) {
        const point f = w->faces[w->around[k]];
        if (w->around[k] == corner / 3 || dot(f, own) > cos_crease * length(f) * area)
            sum = (point){ sum.x + f.x, sum.y + f.y, sum.z + f.z };
    }
    const double l = length(sum);
    float *to      = w->corners[corner].normal;
    to[0]          = (float)(sum.x / l);
    to[1]          = (float)(sum.y / l);
    to[2]          = (float)(sum.z / l);
}

/* ---- texture coordinates ------------------------------------------------------------------ */

/* p as the axis that the face looks along most shows it: u to the right, v down. */
static void seen(point face, point p, double uv[2])
{
    const double x = fabs(face.x), y = fabs(face.y), z = fabs(face.z);
    if (z >= x && z >= y)
        uv[0] = p.x, uv[1] = face.z > 0.0 ? -p.y : p.y;
    else if (y >= x)
        uv[0] = face.y < 0.0 ? p.x : -p.x, uv[1] = -p.z;
    else
        uv[0] = face.x > 0.0 ? p.y : -p.y, uv[1] = -p.z;
}

static void fitted(const work *w, point face, point p, double uv[2])
{
    double a[2], b[2];
    seen(face, p, uv);
    seen(face, w->low, a);
    seen(face, w->high, b);
    for (int k = 0; k < 2; k++)
        uv[k] = (uv[k] - fmin(a[k], b[k])) / fmax(fabs(b[k] - a[k]), 1e-6);
}

/* Within half a turn of the triangle's middle, so that none is wound around the axis. */
static double turned(const work *w, uint32_t corner, point p)
{
    const uint32_t *c = w->of->corners + corner / 3 * 3;
    point m           = { 0 };
    for (int k = 0; k < 3; k++) {
        const point q = vertex_of(w->of, c[k]);
        m             = (point){ m.x + q.x, m.y + q.y, 0.0 };
    }
    const double middle = atan2(m.y, m.x) / TURN;
    const double a      = p.x == 0.0 && p.y == 0.0 ? middle : atan2(p.y, p.x) / TURN;
    return a - round(a - middle);
}

static void find_uv(const work *w, uint32_t corner)
{
    const point p    = vertex_of(w->of, w->of->corners[corner]);
    const point face = w->faces[corner / 3];
    const double by  = w->by->tile > 0.0 ? w->by->tile : 1.0;
    double uv[2];
    if (w->by->map == MAP_FIT)
        fitted(w, face, p, uv);
    else if (w->by->map == MAP_SIDE)
        uv[0] = p.x / by, uv[1] = -p.z / by;
    else if (w->by->map == MAP_TURN)
        uv[0] = turned(w, corner, p) / by, uv[1] = (w->high.z - p.z) / (w->high.z - w->low.z);
    else
        seen(face, p, uv), uv[0] /= by, uv[1] /= by;
    for (int k = 0; k < 2; k++)
        w->corners[corner].uv[k] = (float)(round(uv[k] * 1e5) / 1e5 + 0.0);
}

/* ---- corners become vertices -------------------------------------------------------------- */

static uint32_t vertex_made(const work *w, drawn *out, uint32_t corner)
{
    const uint32_t v     = w->of->corners[corner];
    const corner_look *c = &w->corners[corner];
    for (uint32_t k = w->first[v]; k; k = w->next[k - 1])
        if (memcmp(out->normals + 3 * (k - 1), c->normal, sizeof c->normal) == 0 &&
            memcmp(out->uv + 2 * (k - 1), c->uv, sizeof c->uv) == 0)
            return k - 1;

    const uint32_t n = out->vertex_count++;
    memcpy(out->xyz + 3 * n, w->of->xyz + 3 * v, 3 * sizeof *out->xyz);
    memcpy(out->normals + 3 * n, c->normal, sizeof c->normal);
    memcpy(out->uv + 2 * n, c->uv, sizeof c->uv);
    w->next[n]  = w->first[v];
    w->first[v] = n + 1;
    return n;
}

static void find_corners(work *w, drawn *out)
{
    const patch *t      = w->of;
    const double crease = cos(w->by->crease_deg * TURN / 360.0);
    w->low = w->high = vertex_of(t, 0);
    for (uint32_t v = 1; v < t->vertex_count; v++) {
        const point p = vertex_of(t, v);
        w->low        = (point){ fmin(w->low.x, p.x), fmin(w->low.y, p.y), fmin(w->low.z, p.z) };
        w->high       = (point){ fmax(w->high.x, p.x), fmax(w->high.y, p.y), fmax(w->high.z, p.z) };
    }
    for (uint32_t i = 0; i < t->triangle_count; i++)
        w->faces[i] = face_of(t, i);
    find_around(w);
    for (uint32_t i = 0; i < 3 * t->triangle_count; i++) {
        if (w->by->crease_deg > 0.0)
            find_normal(w, i, crease);
        if (w->by->map != MAP_NONE)
            find_uv(w, i);
        out->corners[i] = vertex_made(w, out, i);
    }
}

bool draw_patch(const patch *t, const paint *p, drawn *out)
{
    const size_t n = 3 * (size_t)t->triangle_count, vertices = t->vertex_count + (size_t)1;
    *out = (drawn){ .triangle_count = t->triangle_count };
    if (p->crease_deg <= 0.0 && p->map == MAP_NONE) {
        out->xyz          = t->xyz;
        out->corners      = t->corners;
        out->vertex_count = t->vertex_count;
        return true;
    }
    out->own        = true;
    out->xyz        = calloc(3 * n, sizeof *out->xyz);
    out->normals    = calloc(3 * n, sizeof *out->normals);
    out->uv         = calloc(2 * n, sizeof *out->uv);
    out->corners    = calloc(n, sizeof *out->corners);
    work w          = { .of      = t,
                        .by      = p,
                        .faces   = calloc(n, sizeof *w.faces),
                        .start   = calloc(vertices + 1, sizeof *w.start),
                        .around  = calloc(n, sizeof *w.around),
                        .corners = calloc(n, sizeof *w.corners),
                        .first   = calloc(vertices, sizeof *w.first),
                        .next    = calloc(n, sizeof *w.next) };
    const bool room = out->xyz && out->normals && out->uv && out->corners && w.faces && w.start &&
                      w.around && w.corners && w.first && w.next;
    if (room)
        find_corners(&w, out);
    void *scratch[] = { w.faces, w.start, w.around, w.corners, w.first, w.next };
    for (int i = 0; i < COUNT(scratch); i++)
        free(scratch[i]);
    if (p->crease_deg <= 0.0)
        free(out->normals), out->normals = NULL;
    if (p->map == MAP_NONE)
        free(out->uv), out->uv = NULL;
    return room;
}

void drawn_clear(drawn *d)
{
    if (d->own) {
        free(d->xyz);
        free(d->corners);
    }
    free(d->normals);
    free(d->uv);
    *d = (drawn){ 0 };
}
