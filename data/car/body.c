/* data/car/body.c -- see car.h: the form as triangles, cut along the outlines of its regions.
 *
 * A triangle that an outline crosses is cut in up to three, along the straight line between the
 * places where the outline crosses its sides; its neighbour across a side finds the same place.
 */
#include "data/car/car.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define TURN 6.28318530717958647692
#define SNAP 4e-4 /* m: an outline that passes a corner so near goes through it */

enum { STATIONS = 192, AROUND = 132, TABLE = 1 << 18 };

typedef struct body {
    shape of;
    bool lenses;     /* wanted are the lenses alone; else all but them */
    uint32_t *table; /* vertices of a patch by their place, plus one; 0 is free */
    int *inks;
} body;

typedef struct triangle {
    point at[3];
} triangle;

/* ---- vertices shared by place ------------------------------------------------------------- */

static uint32_t place_hash(const int32_t at[3], int ink)
{
    uint32_t h = (uint32_t)ink * 0x9e3779b9u;
    for (int k = 0; k < 3; k++)
        h = (h ^ (uint32_t)at[k]) * 0x85ebca6bu, h ^= h >> 13;
    return h % TABLE;
}

static uint32_t shared_vertex(body *b, point p)
{
    const int ink       = b->of.ink;
    const patch *t      = &b->of.patches[ink];
    const int32_t at[3] = { (int32_t)lround(p.x * 1e5), (int32_t)lround(p.y * 1e5),
                            (int32_t)lround(p.z * 1e5) };
    uint32_t slot       = place_hash(at, ink);
    for (; b->table[slot]; slot = (slot + 1) % TABLE) {
        const float *v = t->xyz + 3 * (b->table[slot] - 1);
        if (b->inks[slot] == ink && lround((double)v[0] * 1e5) == at[0] &&
            lround((double)v[1] * 1e5) == at[1] && lround((double)v[2] * 1e5) == at[2])
            return b->table[slot] - 1;
    }
    const uint32_t v = add_vertex(&b->of, p);
    b->table[slot]   = v + 1;
    b->inks[slot]    = ink;
    return v;
}

static void keep(body *b, const triangle *t, int ink)
{
    if (ink == NO_INK || (ink == LENS) != b->lenses)
        return;
    b->of.ink = ink;
    uint32_t v[3];
    for (int k = 0; k < 3; k++)
        v[k] = shared_vertex(b, t->at[k]);
    if (v[0] != v[1] && v[1] != v[2] && v[2] != v[0])
        add_triangle(&b->of, v[0], v[1], v[2]);
}

/* ---- cutting ------------------------------------------------------------------------------ */

/* Places on a side are worked out from its same end, whichever triangle asks. */
static point crossing(point a, point b, double fa, double fb)
{
    if (a.x > b.x || (a.x == b.x && (a.y > b.y || (a.y == b.y && a.z > b.z))))
        return crossing(b, a, fb, fa);
    const double t = fa / (fa - fb);
    return (point){ a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t, a.z + (b.z - a.z) * t };
}

/* The part of a triangle where side * (f - level) is positive, as a fan; returns its triangles. */
static int part(const triangle *t, const double f[3], double side, triangle out[2])
{
    point ring[4];
    int n = 0;
    for (int k = 0; k < 3; k++) {
        const int m    = (k + 1) % 3;
        const double a = side * f[k], b = side * f[m];
        if (a >= 0.0)
            ring[n++] = t->at[k];
        if ((a > 0.0 && b < 0.0) || (a < 0.0 && b > 0.0))
            ring[n++] = crossing(t->at[k], t->at[m], f[k], f[m]);
    }
    if (!(side * f[0] > 0.0 || side * f[1] > 0.0 || side * f[2] > 0.0))
        return 0;
    for (int k = 2; k < n; k++)
        out[k - 2] = (triangle){ { ring[0], ring[k - 1], ring[k] } };
    return n - 2;
}

static void levels(const triangle *t, const region *r, double level, double f[3])
{
    for (int k = 0; k < 3; k++) {
        f[k] = r->inside(t->at[k]) - level;
        if (fabs(f[k]) < SNAP)
            f[k] = 0.0;
    }
}

/* Deals a triangle out to the regions from the k-th on. */
static void deal(body *b, const triangle *t, int k)
{
    if (k == car_region_count) {
        keep(b, t, PAINT);
        return;
    }
    const region *r = &car_regions[k];
    double f[3];
    triangle outer[2], above[2], in[2];
    levels(t, r, r->low, f);
    for (int n = part(t, f, -1.0, outer), i = 0; i < n; i++)
        deal(b, &outer[i], k + 1);
    for (int n = part(t, f, 1.0, above), i = 0; i < n; i++) {
        levels(&above[i], r, r->high, f);
        for (int beyond = part(&above[i], f, 1.0, outer), j = 0; j < beyond; j++)
            deal(b, &outer[j], k + 1);
        for (int within = part(&above[i], f, -1.0, in), j = 0; j < within; j++)
            keep(b, &in[j], r->ink);
    }
}

/* ---- the sheet ---------------------------------------------------------------------------- */

/* The points around a station, from below over the left side. The right is its mirror image. */
static void fill_row(point row[AROUND + 1], int i)
{
    for (int j = 0; 2 * j <= AROUND; j++) {
        row[j] = form_at(2.0 * i / STATIONS - 1.0, TURN * j / AROUND - TURN / 4.0);
        if (j == 0 || 2 * j == AROUND)
            row[j].y = 0.0;
        row[AROUND - j] = (point){ row[j].x, 0.0 - row[j].y, row[j].z };
    }
}

static void deal_quad(body *b, point (*rows)[AROUND + 1], int i, int j)
{
    const point *tail = rows[~i & 1], *nose = rows[i & 1]; /* i is the station of the nose's side */
    if (i < STATIONS)
        deal(b, &(triangle){ { tail[j], nose[j + 1], nose[j] } }, 0);
    else
        deal(b, &(triangle){ { tail[j], tail[j + 1], nose[0] } }, 0);
    if (i > 1 && i < STATIONS)
        deal(b, &(triangle){ { tail[j], tail[j + 1], nose[j + 1] } }, 0);
}

static shape body_sheets(const char *name, bool lenses)
{
    body b  = { .of = shape_new(name, 1.0), .lenses = lenses };
    b.table = calloc(TABLE, sizeof *b.table);
    b.inks  = calloc(TABLE, sizeof *b.inks);
    b.of.out_of_memory |= !b.table || !b.inks;
    point rows[2][AROUND + 1];
    const int first = lenses ? STATIONS * 3 / 4 : 0; /* they are at the front */
    for (int i = first; i <= STATIONS && !b.of.out_of_memory; i++) {
        fill_row(rows[i & 1], i);
        for (int j = 0; j < AROUND && i > first; j++)
            deal_quad(&b, rows, i, j);
    }
    free(b.table);
    free(b.inks);
    return b.of;
}

shape car_body(void) { return body_sheets("Body", false); }

/* ---- head lights -------------------------------------------------------------------------- */

/* A copy of a sheet's vertices, moved: the far side of a solid, or the bottom of a pot. */
static uint32_t copy_vertices(shape *s, const patch *t, point (*moved)(point p))
{
    const uint32_t first = s->patches[s->ink].vertex_count, n = t->vertex_count;
    for (uint32_t v = 0; v < n; v++) {
        const float *p = t->xyz + 3 * v;
        add_vertex(s, moved((point){ (double)p[0], (double)p[1], (double)p[2] }));
    }
    return first;
}

static int edge_order(const void *a, const void *b) { return memcmp(a, b, 2 * sizeof(uint32_t)); }

/* Walls from the sheet's border, whose edges no other triangle has the other way round. */
static void wall(shape *s, const patch *t, uint32_t front, uint32_t back)
{
    const uint32_t n      = 3 * t->triangle_count;
    uint32_t(*reverse)[2] = calloc(n, sizeof *reverse);
    if (!reverse) {
        s->out_of_memory = true;
        return;
    }
    for (uint32_t i = 0; i < n; i++) {
        reverse[i][0] = t->corners[i % 3 == 2 ? i - 2 : i + 1];
        reverse[i][1] = t->corners[i];
    }
    qsort(reverse, n, sizeof *reverse, edge_order);
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t a = t->corners[i], b = t->corners[i % 3 == 2 ? i - 2 : i + 1];
        const uint32_t key[2] = { a, b };
        if (bsearch(key, reverse, n, sizeof *reverse, edge_order))
            continue;
        add_triangle(s, front + a, back + a, back + b);
        add_triangle(s, front + a, back + b, front + b);
    }
    free(reverse);
}

static void add_copy(shape *s, const patch *t, uint32_t first, bool back)
{
    for (uint32_t i = 0; i < t->triangle_count; i++) {
        const uint32_t *c = t->corners + 3 * i;
        add_triangle(s, first + c[0], first + c[back ? 2 : 1], first + c[back ? 1 : 2]);
    }
}

static point same(point p) { return p; }

/* Into the body, square to its surface, by the thickness of the cover. */
static point inward(point p)
{
    const double e = 1e-4, by = car_paints[LENS].thickness;
    const point g = { form((point){ p.x + e, p.y, p.z }) - form((point){ p.x - e, p.y, p.z }),
                      form((point){ p.x, p.y + e, p.z }) - form((point){ p.x, p.y - e, p.z }),
                      form((point){ p.x, p.y, p.z + e }) - form((point){ p.x, p.y, p.z - e }) };
    return minus(p, times(unit(g), by));
}

/* The pot behind starts a little below the cover, which keeps clear of it. */
static point rim_of_pot(point p) { return (point){ p.x - 0.012, p.y, p.z }; }

static point bottom_of_pot(point p)
{
    const double y = p.y < 0.0 ? -0.585 : 0.585;
    return (point){ 1.90 + 0.1 * (p.x - 1.9), y + 0.8 * (p.y - y), 0.615 + 0.8 * (p.z - 0.615) };
}

/* Two bright bowls in each pot, open to the front. */
static void reflectors(shape *s)
{
    static const double bowl[][2] = { { 0.008, 0.000 }, { 0.020, 0.002 }, { 0.032, 0.010 },
                                      { 0.041, 0.030 }, { 0.038, 0.030 }, { 0.029, 0.013 },
                                      { 0.018, 0.006 }, { 0.008, 0.004 } };
    s->ink                        = CHROME;
    for (int i = 0; i < 4; i++) {
        const double y = side_of(i & 1) * (i & 2 ? 0.635 : 0.535);
        shape_at(s, (point){ 1.912, y, 0.612 }, 90.0, 90.0); /* its axis along x */
        add_lathe(s, &(lathe){ bowl, COUNT(bowl), 32, true });
    }
    shape_at(s, (point){ 0 }, 0.0, 0.0);
}

shape car_lamps(void)
{
    shape sheet = body_sheets("Lens", true), s = shape_new("Head lights", 1.0);
    const patch *t = &sheet.patches[LENS];
    s.out_of_memory |= sheet.out_of_memory;

    s.ink                = LENS;
    const uint32_t front = copy_vertices(&s, t, same), back = copy_vertices(&s, t, inward);
    add_copy(&s, t, front, false);
    add_copy(&s, t, back, true);
    wall(&s, t, front, back);

    s.ink              = HOUSING; /* seen from within */
    const uint32_t rim = copy_vertices(&s, t, rim_of_pot),
                   pot = copy_vertices(&s, t, bottom_of_pot);
    add_copy(&s, t, pot, false);
    wall(&s, t, pot, rim);
    solid_clear(&sheet);
    reflectors(&s);
    return s;
}
