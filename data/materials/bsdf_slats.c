/* data/materials/bsdf_slats.c -- a venetian blind of flat, thin, matt slats of no end.
 *
 * Between two slats lies a parallelogram, open to the outside and to the room:
 *
 *     y               B ____--  upper slat        corners of the openings: outside A, B,
 *     ^      B'  ____---   | room                 of height h = spacing; slats of width w that
 *     |   ____---     ____-- A                    rise toward the room by `tilt`
 *     |  |      ____---
 *     |   ---- --  lower slat
 *     +------> z
 *
 * Each face is cut into strips. Light of a way (x, y, z) goes, seen along the slats, by (y, z): the
 * share v_j of what arrives at an opening that meets strip j is the strip's image in the opening,
 * as the parallelogram is convex; what meets none goes straight through. Strips then light each
 * other:
 *
 *     B_j = rho (E_j + sum_k F_jk B_k)      E_j = v_j h / l      [W/m^2, of 1 W/m^2 at the opening]
 *
 * with F between strips by Hottel's crossed strings. Their radiance B_j / pi is seen through an
 * opening in the share of v_j of the way reversed, so that
 *
 *     f(in, out) = h rho / (pi l) sum_jk v_j(reversed out) (1 - rho F)^-1_jk v_k(in)      [1/sr]
 *
 * which is reciprocal as F is symmetric. f is linear in v(in) and in v(out): of cells it takes
 * their means.
 */
#include "data/materials/bsdf_models.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double pi = 3.14159265358979324;

enum {
    STRIPS = 24,
    ALL    = 2 * STRIPS
}; /* of each face: the lower slat's upper one, then the other */

slats slats_shipped(void)
{
    return (slats){ .width = 0.025, .spacing = 0.020, .tilt = 0.25 * pi, .reflectance = 0.7 };
}

typedef struct point {
    double y, z;
} point;

/* The place at `part`, 0 ... 1 from the outside to the room, of a face: 0 lower slat, 1 upper. */
static point place(const slats *s, int face, double part)
{
    return (point){ s->width * part * sin(s->tilt) + face * s->spacing,
                    s->width * part * cos(s->tilt) };
}

static double between(point a, point b) { return hypot(a.y - b.y, a.z - b.z); }

static double clamp(double a, double low, double high)
{
    return a < low ? low : a > high ? high : a;
}

/* v[] of a way in from a side; what goes straight through. */
static double meets(const slats *s, int side, const double way[3], double v[ALL])
{
    const point way2 = { way[1], side == 0 ? way[2] : -way[2] };
    const point low  = place(s, 0, side); /* of the opening, which is straight up from there */
    double open      = 1.0;
    for (int i = 0; i < ALL; i++) {
        double image[2];
        int face = i / STRIPS;
        for (int k = 0; k < 2; k++) {
            point p  = place(s, face, (double)(i % STRIPS + k) / STRIPS);
            image[k] = (p.y - (p.z - low.z) * way2.y / way2.z - low.y) / s->spacing;
        }
        /* A face is met on its inner side alone: the lower one from above */
        double across = way2.y * cos(s->tilt) - way2.z * sin(s->tilt);
        bool met      = face == 0 ? across < 0.0 : across > 0.0;
        v[i]          = met ? fabs(clamp(image[1], 0.0, 1.0) - clamp(image[0], 0.0, 1.0)) : 0.0;
        open -= v[i];
    }
    return open;
}

double slats_open(const slats *s, int side, const double way[3])
{
    double v[ALL];
    return meets(s, side, way, v);
}

/* Crossed strings between strips of the two faces; those of one face do not see each other. */
static double exchange(const slats *s, int j, int k)
{
    if (j / STRIPS == k / STRIPS)
        return 0.0;
    point a[2], b[2];
    for (int i = 0; i < 2; i++) {
        a[i] = place(s, j / STRIPS, (double)(j % STRIPS + i) / STRIPS);
        b[i] = place(s, k / STRIPS, (double)(k % STRIPS + i) / STRIPS);
    }
    double crossed   = between(a[0], b[1]) + between(a[1], b[0]);
    double uncrossed = between(a[0], b[0]) + between(a[1], b[1]);
    return fabs(crossed - uncrossed) / (2.0 * s->width / STRIPS);
}

/* (1 - rho F)^-1 by Gauss and Jordan: its diagonal is the largest of each row, no pivot needed. */
static void solve(const slats *s, double inverse[ALL][ALL])
{
    double m[ALL][ALL];
    for (int j = 0; j < ALL; j++)
        for (int k = 0; k < ALL; k++) {
            m[j][k]       = (j == k) - s->reflectance * exchange(s, j, k);
            inverse[j][k] = j == k;
        }
    for (int p = 0; p < ALL; p++) {
        double pivot = m[p][p];
        for (int k = 0; k < ALL; k++) {
            m[p][k] /= pivot;
            inverse[p][k] /= pivot;
        }
        for (int j = 0; j < ALL; j++) {
            double factor = m[j][p];
            for (int k = 0; k < ALL && j != p; k++) {
                m[j][k] -= factor * m[p][k];
                inverse[j][k] -= factor * inverse[p][k];
            }
        }
    }
}

/* Means over cells: what meets the strips, of ways in and of ways out reversed; what passes. */
typedef struct blind_work {
    double in[2][FULL_CELLS][ALL], out[2][FULL_CELLS][ALL], open[2][FULL_CELLS];
} blind_work;

static void mean_of_cell(const slats *s, int side, int cell, blind_work *w)
{
    const double part = 1.0 / (FULL_SAMPLES * FULL_SAMPLES);
    for (int i = 0; i < FULL_SAMPLES * FULL_SAMPLES; i++) {
        double way[3], v[ALL];
        full_sample(cell, i / FULL_SAMPLES, i % FULL_SAMPLES, way);
        w->open[side][cell] += part * meets(s, side, way, v);
        for (int j = 0; j < ALL; j++)
            w->in[side][cell][j] += part * v[j];
        double reversed[3] = { -way[0], -way[1], way[2] };
        meets(s, side, reversed, v);
        for (int j = 0; j < ALL; j++)
            w->out[side][cell][j] += part * v[j];
    }
}

/* Light in from `side` out of `to`, by way of the strips. */
static void by_strips(const slats *s, int side, int to, const blind_work *w, double (*inverse)[ALL],
                      double (*f)[FULL_CELLS])
{
    const double scale = s->spacing * s->reflectance / (pi * s->width / STRIPS);
    for (int in = 0; in < FULL_CELLS; in++) {
        double lit[ALL] = { 0 };
        for (int j = 0; j < ALL; j++)
            for (int k = 0; k < ALL; k++)
                lit[j] += inverse[j][k] * w->in[side][in][k];
        for (int out = 0; out < FULL_CELLS; out++)
            for (int j = 0; j < ALL; j++)
                f[in][out] += scale * w->out[to][out][j] * lit[j];
    }
}

bool model_blind(bsdf_model *m, const slats *s)
{
    blind_work *w         = calloc(1, sizeof *w);
    double(*inverse)[ALL] = calloc(ALL, sizeof *inverse);
    const bool has_memory = w && inverse;
    memset(m, 0, sizeof *m);
    m->name = "Venetian blind, matt slats";
    if (has_memory) {
        for (int i = 0; i < 2 * FULL_CELLS; i++)
            mean_of_cell(s, i % 2, i / 2, w);
        solve(s, inverse);
        for (int side = 0; side < 2; side++) {
            by_strips(s, side, side, w, inverse, m->reflection[side]);
            by_strips(s, side, !side, w, inverse, m->transmission[side]);
            for (int cell = 0; cell < FULL_CELLS; cell++)
                m->transmission[side][cell][cell] += w->open[side][cell] / full_area(cell);
        }
    }
    free(w);
    free(inverse);
    return has_memory;
}
