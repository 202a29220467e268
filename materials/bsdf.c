/* materials/bsdf.c -- a BSDF made of a file: completed, scaled to give back no more than it gets,
 * with tables to draw from.
 *
 * What is missing of transmission is the other way through, reversed: f(a -> b) = f(b -> a) of any
 * layer at rest. What is missing of reflection is 0. Where reflection and transmission of some
 * incidence add up to more than 1, all of the file is multiplied by one factor: any other choice
 * would make it less reciprocal.
 */
#include "materials/bsdf_parts.h"

#include "core/file.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#define PI 3.14159265358979323846

static const char *const side_names[2] = { "Front", "Back" };

const bsdf_figures *bsdf_figure(const bsdf *b) { return &b->figures; }

/* ---- what a file lacks -------------------------------------------------------------------------
 */

/* The cell about the opposite way. */
static int opposite(const klems *k, int cell)
{
    vvec3 d = vklems_direction(k, vsplat_int(cell), vsplat(0.5f), vsplat(0.5f));
    return lane(vklems_cell(k, -d.x, -d.y, d.z), 0);
}

static float *klems_reverse(arena *a, const klems *k, const float *value, lux_error *err)
{
    const int n = k->cells;
    float *to   = arena_array(a, float, (size_t)n *(size_t)n, err);
    int *other  = arena_array(a, int, (size_t)n, err);
    if (!to || !other)
        return NULL;
    for (int i = 0; i < n; i++)
        other[i] = opposite(k, i);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            to[i * n + j] = value[other[j] * n + other[i]];
    return to;
}

static bool read_block(arena *a, bsdf *b, const bsdf_file *f, int side, int part, lux_error *err)
{
    const bsdf_block *from = &f->block[side][part];
    int line               = from->text_line;
    if (!from->text)
        return true;
    if (b->rank == 0)
        b->side[side].value[part] = klems_parse(a, &b->basis, f, from, err);
    else
        b->side[side].tree[part] = tensor_parse(a, b->rank, from->text, f->path, &line, err);
    return b->side[side].value[part] || b->side[side].tree[part];
}

/* Where there is nothing either way, nothing. */
static bool complete(arena *a, bsdf *b, int side, int part, lux_error *err)
{
    bsdf_side *s           = &b->side[side];
    const bsdf_side *other = &b->side[!side];
    const bool reverse     = part == BSDF_TRANSMIT && (other->value[part] || other->tree[part]);
    const size_t n         = (size_t)b->basis.cells;
    if (s->value[part] || s->tree[part])
        return true;
    if (b->rank == 0)
        s->value[part] = reverse ? klems_reverse(a, &b->basis, other->value[part], err)
                                 : arena_array(a, float, n *n, err);
    else
        s->tree[part] = reverse ? tensor_reverse(a, other->tree[part], err)
                                : tensor_even(a, b->rank, 0.0f, err);
    return s->value[part] || s->tree[part];
}

static void tell_missing(const bsdf_file *f, notices *n)
{
    for (int side = 0; side < 2; side++)
        if (!f->block[side][BSDF_REFLECT].text)
            notice_add(n, "%s: no Reflection %s: taken as black on that side", f->path,
                       side_names[side]);
    const bool there[2] = { f->block[0][BSDF_TRANSMIT].text, f->block[1][BSDF_TRANSMIT].text };
    if (!there[0] && !there[1])
        notice_add(n, "%s: no Transmission: taken as opaque", f->path);
    else if (!there[0] || !there[1])
        notice_add(n, "%s: no Transmission %s: taken from Transmission %s by reciprocity%s",
                   f->path, side_names[there[0]], side_names[!there[0]],
                   f->rank == 3 ? ", averaged on a grid" : "");
}

/* ---- which directions --------------------------------------------------------------------------
 */

static bool find_basis(const bsdf_file *f, const char *name, klems *out)
{
    for (int i = 0; i < f->bases; i++)
        if (strcasecmp(f->basis[i].name, name) == 0) {
            *out = f->basis[i];
            return true;
        }
    return klems_known(name, out);
}

static bool block_basis(bsdf *b, const bsdf_file *f, const bsdf_block *block, lux_error *err)
{
    if (f->rank != 0) {
        if (strcasecmp(block->basis, "LBNL/Shirley-Chiu") == 0)
            return true;
        return failed(err, ERR_UNSUPPORTED, "%s:%d: a tensor tree whose AngleBasis is not %s",
                      f->path, block->line, "LBNL/Shirley-Chiu");
    }
    klems basis;
    if (!find_basis(f, block->column, &basis))
        return failed(err, ERR_FORMAT, "%s:%d: a ColumnAngleBasis that is not known", f->path,
                      block->line);
    if (strcasecmp(block->column, block->row) != 0 ||
        (b->basis.cells > 0 && strcasecmp(b->basis.name, basis.name) != 0))
        return failed(err, ERR_UNSUPPORTED, "%s:%d: angle bases that differ within a file", f->path,
                      block->line);
    b->basis = basis;
    return true;
}

static void choose_cells(bsdf *b)
{
    enum { OUT_FINEST = 6, IN_FINEST3 = 8, IN_FINEST4 = 5 }; /* of at most 4 M numbers a side */
    int depth = 1;
    if (b->rank == 0) {
        b->rows = b->cells = b->basis.cells;
        return;
    }
    for (int i = 0; i < 4; i++)
        depth =
            b->side[i / 2].tree[i % 2]->depth > depth ? b->side[i / 2].tree[i % 2]->depth : depth;
    int finest  = b->rank == 3 ? IN_FINEST3 : IN_FINEST4;
    b->in_log2  = depth < finest ? depth : finest;
    b->out_log2 = depth < OUT_FINEST ? depth : OUT_FINEST;
    b->rows     = b->rank == 3 ? 1 << (b->in_log2 - 1) : 1 << 2 * b->in_log2;
    b->cells    = 1 << 2 * b->out_log2;
}

/* ---- tables ------------------------------------------------------------------------------------
 */

/* What goes into each cell, of light that arrives within a row. */
static void row_weights(const bsdf *b, const bsdf_side *s, int part, int row, double *weight)
{
    if (b->rank > 0) {
        const int across    = 1 << b->in_log2;
        const double low[2] = { (double)(b->rank == 3 ? row : row / across) / across,
                                (double)(row % across) / across };
        tensor_row(s->tree[part], low, 1.0 / across, b->out_log2, weight);
        for (int i = 0; i < b->cells; i++)
            weight[i] *= PI / b->cells;
        return;
    }
    const klems *k     = &b->basis;
    const float *value = s->value[part] + (size_t)row * (size_t)b->cells;
    for (int ring = 0, i = 0; ring < k->rings; ring++)
        for (int end = i + (int)k->count[ring]; i < end; i++)
            weight[i] = (double)value[i] * (double)k->area[ring];
}

static bool make_tables(arena *a, bsdf *b, bsdf_side *s, double *weight, lux_error *err)
{
    const size_t stride = 2 * (size_t)b->cells + 1;
    s->cdf              = arena_array(a, float, stride *(size_t)b->rows, err);
    s->share[0]         = arena_array(a, float, (size_t)b->rows, err);
    s->share[1]         = arena_array(a, float, (size_t)b->rows, err);
    if (!s->cdf || !s->share[0] || !s->share[1])
        return false;
    for (int row = 0; row < b->rows; row++) {
        double sum[2] = { 0, 0 };
        for (int part = 0; part < 2; part++) {
            double *w = weight + part * b->cells;
            row_weights(b, s, part, row, w);
            for (int i = 0; i < b->cells; i++)
                sum[part] += w[i];
            s->share[part][row] = (float)sum[part];
        }
        if (distribution_make(s->cdf + (size_t)row * stride, weight, 2 * b->cells) == 0.0)
            memset(s->cdf + (size_t)row * stride, 0, stride * sizeof(float)); /* black: no draws */
        b->figures.most = fmax(b->figures.most, sum[0] + sum[1]);
    }
    return true;
}

/* ---- energy ------------------------------------------------------------------------------------
 */

/* Where sums are above 1 by what numbers written with few digits come to, no one need know. */
static void scale_down(bsdf *b, const char *path, notices *n)
{
    const double scale = b->figures.most > 1.0 ? 1.0 / (b->figures.most * (1.0 + 1e-7)) : 1.0;
    b->figures.scale   = scale;
    if (scale == 1.0)
        return;
    for (int i = 0; i < 4; i++) {
        bsdf_side *s = &b->side[i / 2];
        int part     = i % 2;
        float *value = b->rank == 0 ? s->value[part] : s->tree[part]->value;
        size_t values =
            b->rank == 0 ? (size_t)b->cells * (size_t)b->cells : (size_t)s->tree[part]->values;
        for (size_t j = 0; j < values; j++)
            value[j] = (float)((double)value[j] * scale);
        for (int row = 0; row < b->rows; row++)
            s->share[part][row] = (float)((double)s->share[part][row] * scale);
    }
    if (b->figures.most > 1.001)
        notice_add(n,
                   "%s: reflection and transmission of some incidence add up to %.3f: all of it is "
                   "multiplied by %.4f",
                   path, b->figures.most, scale);
}

/* Of all light, what arrives within a row, if it comes evenly from everywhere. */
static double row_share(const bsdf *b, int row)
{
    if (b->rank == 0) {
        int ring = 0;
        while (ring + 1 < b->basis.rings && row >= b->basis.first[ring + 1])
            ring++;
        return (double)b->basis.area[ring] / PI;
    }
    if (b->rank == 4)
        return 1.0 / b->rows;
    double high = 1.0 - (double)row / b->rows, low = 1.0 - (double)(row + 1) / b->rows;
    return high * high - low * low;
}

/* The largest sum there would be if the names of reflection were exchanged. */
static double most_exchanged(const bsdf *b)
{
    double most = 0.0;
    for (int side = 0; side < 2; side++)
        for (int row = 0; row < b->rows; row++)
            most = fmax(most, (double)b->side[side].share[BSDF_TRANSMIT][row] +
                                  (double)b->side[!side].share[BSDF_REFLECT][row]);
    return most;
}

/* ---- figures -----------------------------------------------------------------------------------
 */

enum { PROBES = 8 }; /* along each axis of the square: 64 directions, 4,096 pairs */

/* Off the borders of cells, and with each direction its opposite, as (x, y) goes: what goes
 * straight or is mirrored is often all there is. */
static vvec3 probe(int i)
{
    const int at[2]      = { i / PROBES, i % PROBES };
    const float within[] = { 0.41f, 0.37f };
    float place[2];
    for (int k = 0; k < 2; k++)
        place[k] = at[k] < PROBES / 2 ? ((float)at[k] + within[k]) / PROBES
                                      : 1.0f - ((float)(PROBES - 1 - at[k]) + within[k]) / PROBES;
    vvec3 d;
    vsquare_to_disk(vsplat(place[0]), vsplat(place[1]), &d.x, &d.y);
    d.z = vsqrt(vmax(1.0f - d.x * d.x - d.y * d.y, vsplat(0.0f)));
    return d;
}

static double value_of(const bsdf *b, int side, int part, vvec3 from, vvec3 to)
{
    vvec3 in      = { -from.x, -from.y, from.z };
    vbsdf_place p = vbsdf_find(b, &in, &to);
    vfloat f      = vbsdf_value(b, (bsdf_side_name)side, (bsdf_part)part, &p, ALL_LANES);
    return (double)lane(f, 0);
}

static double reciprocity_error(const bsdf *b)
{
    double sum = 0.0, off = 0.0;
    for (int i = 0; i < PROBES * PROBES; i++)
        for (int j = 0; j < PROBES * PROBES; j++) {
            vvec3 from = probe(i), to = probe(j);
            for (int k = 0; k < 3; k++) { /* through; reflected in front, at the back */
                int part     = k == 0 ? BSDF_TRANSMIT : BSDF_REFLECT;
                int side     = k == 2 ? BSDF_BACK : BSDF_FRONT;
                int other    = k == 0 ? BSDF_BACK : side;
                double there = value_of(b, side, part, from, to);
                double back  = value_of(b, other, part, to, from);
                off += fabs(there - back);
                sum += 0.5 * (there + back);
            }
        }
    return sum > 0.0 ? off / sum : 0.0;
}

static bool figure(arena *a, bsdf *b, lux_error *err)
{
    bsdf_figures *f = &b->figures;
    const vvec3 up  = { vsplat(0.0f), vsplat(0.0f), vsplat(1.0f) };
    const int front = lane(vbsdf_row(b, &up), 0);
    f->directions   = b->rank == 0 ? b->basis.cells : 1 << 2 * b->out_log2;
    for (int side = 0; side < 2; side++) {
        float *const *share           = b->side[side].share;
        f->normal_reflectance[side]   = (double)share[BSDF_REFLECT][front];
        f->normal_transmittance[side] = (double)share[BSDF_TRANSMIT][front];
        for (int row = 0; row < b->rows; row++) {
            f->reflectance[side] += row_share(b, row) * (double)share[BSDF_REFLECT][row];
            f->transmittance[side] += row_share(b, row) * (double)share[BSDF_TRANSMIT][row];
        }
    }
    f->reciprocity = reciprocity_error(b);
    char *name     = arena_array(a, char, KLEMS_NAME, err);
    if (!name)
        return false;
    if (b->rank == 0)
        snprintf(name, KLEMS_NAME, "%s", b->basis.name);
    else
        snprintf(name, KLEMS_NAME, "tensor tree of rank %d", b->rank);
    for (char *c = name; *c; c++)
        *c = *c < ' ' || *c > '~' ? '?' : *c;
    f->basis = name;
    return true;
}

/* ---- all of it ---------------------------------------------------------------------------------
 */

static bool fill(arena *a, bsdf *b, const bsdf_file *f, lux_error *err)
{
    for (int i = 0; i < 4; i++)
        if (f->block[i / 2][i % 2].text && !block_basis(b, f, &f->block[i / 2][i % 2], err))
            return false;
    for (int i = 0; i < 4; i++)
        if (!read_block(a, b, f, i / 2, i % 2, err))
            return false;
    for (int i = 0; i < 4; i++)
        if (!complete(a, b, i / 2, i % 2, err))
            return false;
    choose_cells(b);
    arena scratch  = { 0 };
    double *weight = arena_array(&scratch, double, 2 * (size_t)b->cells, err);
    bool made      = weight && make_tables(a, b, &b->side[0], weight, err) &&
                make_tables(a, b, &b->side[1], weight, err);
    arena_clear(&scratch);
    return made;
}

const bsdf *bsdf_parse(arena *a, const char *path, const char *bytes, size_t size, notices *n,
                       lux_error *err)
{
    arena text = { 0 }; /* what the file's elements hold */
    bsdf_file f;
    bsdf *b = arena_new(a, bsdf, err);
    if (!b || !bsdf_file_parse(&text, path, bytes, size, n, &f, err)) {
        arena_clear(&text);
        return NULL;
    }
    b->rank   = f.rank;
    bool made = fill(a, b, &f, err);
    if (made) {
        tell_missing(&f, n);
        if (b->figures.most > 1.01 && most_exchanged(b) <= 1.0)
            notice_add(n, "%s: the names Front and Back of its reflections look exchanged", path);
        scale_down(b, path, n);
        made = figure(a, b, err);
    }
    if (made && b->figures.reciprocity > 0.2)
        notice_add(n, "%s: far from reciprocal: ways back differ by %.0f %% of the mean", path,
                   100.0 * b->figures.reciprocity);
    arena_clear(&text);
    return made ? b : NULL;
}

const bsdf *bsdf_read(arena *a, const char *path, notices *n, lux_error *err)
{
    enum { MOST_BYTES = 256 << 20 };
    arena file    = { 0 };
    size_t size   = 0;
    char *bytes   = file_read(&file, path, MOST_BYTES, &size, err);
    const bsdf *b = bytes ? bsdf_parse(a, path, bytes, size, n, err) : NULL;
    arena_clear(&file);
    return b;
}
