/* materials/bsdf_tensor.c -- tensor trees: their text, look-up, means over boxes, and reverse.
 *
 * G. Ward, M. Kurt, N. Bonneel, "Reducing anisotropic BSDF measurement to common practice",
 * Workshop on Material Appearance Modeling 2014, describes them.
 */
#include "materials/bsdf_parts.h"

#include "core/warp.h"

#include <string.h>

#define BELOW_1 0x1.fffffep-1f

/* ---- text: tree = "{" (tree ... tree | number ... number) "}" ----------------------------------
 */

typedef struct tensor_reader {
    int rank, depth;
    int32_t *first, *log2;
    float *value;
    int nodes, node_count, values; /* node_count: of all the braces there are */
    const char *at, *path;
    int *line;
    lux_error *err;
} tensor_reader;

static char next_token(tensor_reader *r)
{
    for (; *r->at == ' ' || *r->at == '\t' || *r->at == '\n' || *r->at == '\r'; r->at++)
        *r->line += *r->at == '\n';
    return *r->at;
}

static bool wrong(tensor_reader *r, const char *what)
{
    return failed(r->err, ERR_FORMAT, "%s:%d: tensor tree: %s", r->path, *r->line, what);
}

static bool read_grid(tensor_reader *r, int node, int level)
{
    const int first = r->values;
    while (next_token(r) != '}')
        if (!bsdf_number(&r->at, r->path, r->line, &r->value[r->values], r->err))
            return false;
        else
            r->values++;
    int log2 = 0, count = r->values - first;
    while (log2 <= TENSOR_DEPTH - level && log2 * r->rank < 31 && 1 << log2 * r->rank < count)
        log2++;
    if (log2 * r->rank >= 31 || 1 << log2 * r->rank != count)
        return wrong(r, "numbers that fill no grid of 1, 2, 4, 8 ... places along each axis");
    if (level + log2 > TENSOR_DEPTH)
        return wrong(r, "finer than 4096 along an axis");
    r->first[node] = first;
    r->log2[node]  = log2;
    r->depth       = level + log2 > r->depth ? level + log2 : r->depth;
    return true;
}

static bool read_node(tensor_reader *r, int node, int level)
{
    if (next_token(r) != '{')
        return wrong(r, "no { where one is wanted");
    r->at++;
    if (next_token(r) == '{') {
        const int children = 1 << r->rank, first = r->nodes;
        if (level >= TENSOR_DEPTH)
            return wrong(r, "braces nested deeper than 12");
        if (children > r->node_count - r->nodes)
            return wrong(r, "a branch with too few parts");
        r->first[node] = first;
        r->log2[node]  = -1;
        r->nodes += children;
        for (int i = 0; i < children; i++)
            if (!read_node(r, first + i, level + 1))
                return false;
    } else if (!read_grid(r, node, level)) {
        return false;
    }
    if (next_token(r) != '}')
        return wrong(r, "no } where one is wanted");
    r->at++;
    if (next_token(r) == ',')
        r->at++;
    return true;
}

/* Numbers and braces there can be at most. */
static void count_text(const char *text, int *numbers, int *braces)
{
    bool inside = false;
    for (const char *s = text; *s; s++) {
        bool part = (*s >= '+' && *s <= '9' && *s != ',') || *s == 'e' || *s == 'E';
        *numbers += part && !inside;
        *braces += *s == '{';
        inside = part;
    }
}

static tensor *tensor_new(arena *a, int rank, int nodes, int values, lux_error *err)
{
    tensor *t      = arena_new(a, tensor, err);
    int32_t *first = arena_array(a, int32_t, (size_t)nodes, err);
    int32_t *log2  = arena_array(a, int32_t, (size_t)nodes, err);
    float *value   = arena_array(a, float, (size_t)values, err);
    if (!t || !first || !log2 || !value)
        return NULL;
    *t = (tensor){
        .rank = rank, .first = first, .log2 = log2, .value = value, .nodes = nodes, .values = values
    };
    return t;
}

const tensor *tensor_parse(arena *a, int rank, const char *text, const char *path, int *line,
                           lux_error *err)
{
    int numbers = 1, braces = 1;
    count_text(text, &numbers, &braces);
    int32_t *first = arena_array(a, int32_t, (size_t)braces, err);
    int32_t *log2  = arena_array(a, int32_t, (size_t)braces, err);
    float *value   = arena_array(a, float, (size_t)numbers + 1, err);
    tensor *t      = arena_new(a, tensor, err);
    if (!first || !log2 || !value || !t)
        return NULL;
    tensor_reader r = { .rank       = rank,
                        .first      = first,
                        .log2       = log2,
                        .value      = value,
                        .nodes      = 1,
                        .node_count = braces,
                        .at         = text,
                        .path       = path,
                        .line       = line,
                        .err        = err };
    if (!read_node(&r, 0, 0))
        return NULL;
    if (next_token(&r) != '\0') {
        wrong(&r, "more behind its last }");
        return NULL;
    }
    *t = (tensor){ .rank   = rank,
                   .depth  = r.depth,
                   .first  = first,
                   .log2   = log2,
                   .value  = value,
                   .nodes  = r.nodes,
                   .values = r.values };
    return t;
}

const tensor *tensor_even(arena *a, int rank, float value, lux_error *err)
{
    tensor *t = tensor_new(a, rank, 1, 1, err);
    if (t)
        t->value[0] = value;
    return t;
}

/* ---- look-up -----------------------------------------------------------------------------------
 */

void vdisk_to_square(vfloat x, vfloat y, vfloat *s, vfloat *t)
{
    vmask flat   = vabs(x) > vabs(y); /* in the left or right wedge */
    vfloat main  = vselect(flat, x, y);
    vfloat other = vselect(flat, y, x);
    vfloat r     = vcopysign(vsqrt(x * x + y * y), main);
    vfloat turn  = vatan2(vcopysign(vsplat(1.0f), main) * other, vabs(main));
    vfloat side  = r * turn * 1.27323954f; /* 4 / pi */
    *s           = vmin(vmax(0.5f + 0.5f * vselect(flat, r, side), vsplat(0.0f)), vsplat(BELOW_1));
    *t           = vmin(vmax(0.5f + 0.5f * vselect(flat, side, r), vsplat(0.0f)), vsplat(BELOW_1));
}

void vtensor_place(int rank, const vvec3 *in, const vvec3 *out, vfloat place[4])
{
    place[3] = vsplat(0.0f);
    if (rank == 4) {
        vdisk_to_square(in->x, in->y, &place[0], &place[1]);
        vdisk_to_square(out->x, out->y, &place[2], &place[3]);
        return;
    }
    /* What is above 1/2 is not used: straight on is at the last place below it */
    vfloat r = vsqrt(in->x * in->x + in->y * in->y);
    vfloat c = vselect(r > 0.0f, in->x / r, vsplat(1.0f));
    vfloat d = vkeep(r > 0.0f, in->y / r);
    place[0] = vmin(vmax(0.5f - 0.5f * r, vsplat(0.0f)), vsplat(0.5f * BELOW_1));
    vdisk_to_square(out->x * c + out->y * d, out->y * c - out->x * d, &place[1], &place[2]);
}

vfloat vtensor_value(const tensor *t, const vfloat place[4], vmask active)
{
    vfloat at[4] = { place[0], place[1], place[2], place[3] };
    vint node    = vsplat_int(0);
    for (;;) {
        vmask branch = active & (vgather_int(t->log2, node) < 0);
        if (!vany(branch))
            break;
        vint child = vsplat_int(0);
        for (int i = 0; i < t->rank; i++) {
            vmask upper = at[i] >= 0.5f;
            child       = child + vkeep_int(upper, vsplat_int(1 << i));
            vfloat half = 2.0f * at[i] - vkeep(upper, vsplat(1.0f));
            at[i]       = vselect(branch, half, at[i]);
        }
        node = vselect_int(branch, vgather_int(t->first, node) + child, node);
    }
    vint log2  = vkeep_int(active, vgather_int(t->log2, node));
    vint index = vsplat_int(0), across = vsplat_int(1) << log2;
    for (int i = 0; i < t->rank; i++)
        index = (index << log2) + vto_int(at[i] * vto_float(across));
    index = vkeep_int(active, vgather_int(t->first, node) + index);
    return vkeep(active, vgather(t->value, index));
}

/* ---- means over boxes --------------------------------------------------------------------------
 */

/* Axes in, in, out, out: those of in that rank 3 lacks are one cell wide. */
typedef struct row_work {
    const tensor *t;
    double low[2], width; /* the box of in */
    int across;           /* squares of out along each axis */
    double *mean;
} row_work;

/* Of [low, low + width] the share of in's box along an axis. */
static double shared(double low, double width, double box_low, double box_width)
{
    double from = low > box_low ? low : box_low;
    double to   = low + width < box_low + box_width ? low + width : box_low + box_width;
    return to > from ? (to - from) / box_width : 0.0;
}

static void add_square(const row_work *w, const double low[2], double width, double value)
{
    const double square = 1.0 / w->across;
    int from[2], to[2];
    for (int i = 0; i < 2; i++) {
        from[i] = (int)(low[i] * w->across);
        to[i]   = width > square ? (int)((low[i] + width) * w->across) : from[i] + 1;
    }
    double part = width < square ? width * width / (square * square) : 1.0;
    for (int y = from[0]; y < to[0]; y++)
        for (int x = from[1]; x < to[1]; x++)
            w->mean[y * w->across + x] += part * value;
}

static void add_grid(const row_work *w, int node, const double low[4], double width)
{
    const int lead = w->t->rank - 2, n = 1 << w->t->log2[node];
    const float *value = w->t->value + w->t->first[node];
    const double cell  = width / n;
    for (int i = 0; i < n * (lead == 2 ? n : 1); i++) {
        int at[2]    = { lead == 2 ? i / n : i, i % n };
        double share = 1.0;
        for (int k = 0; k < lead; k++)
            share *= shared(low[k] + at[k] * cell, cell, w->low[k], w->width);
        if (share == 0.0)
            continue;
        for (int j = 0; j < n * n; j++) {
            double out[2] = { low[lead] + j / n * cell, low[lead + 1] + j % n * cell };
            add_square(w, out, cell,
                       share * (double)value[(size_t)i * (size_t)(n * n) + (size_t)j]);
        }
    }
}

static void add_node(const row_work *w, int node, const double low[4], double width)
{
    for (int k = 0; k < w->t->rank - 2; k++)
        if (shared(low[k], width, w->low[k], w->width) == 0.0)
            return;
    if (w->t->log2[node] >= 0) {
        add_grid(w, node, low, width);
        return;
    }
    for (int i = 0; i < 1 << w->t->rank; i++) {
        double part[4] = { 0 };
        for (int k = 0; k < w->t->rank; k++)
            part[k] = low[k] + (i >> k & 1 ? 0.5 * width : 0.0);
        add_node(w, w->t->first[node] + i, part, 0.5 * width);
    }
}

void tensor_row(const tensor *t, const double low[2], double width, int out_log2, double *mean)
{
    const row_work w = { t, { low[0], low[1] }, width, 1 << out_log2, mean };
    memset(mean, 0, sizeof *mean << 2 * out_log2);
    add_node(&w, 0, (double[4]){ 0 }, 1.0);
}

/* ---- reverse -----------------------------------------------------------------------------------
 */

/* Of rank 4 in and out change places, and ways to opposite ones: (p, q) becomes (1 - q, 1 - p). */
static int reverse_child(int i) { return 15 & ~(i >> 2 | i << 2); }

static void reverse_grid(const tensor *from, int node, tensor *to, int to_first)
{
    const int n = 1 << from->log2[node], plane = n * n;
    const float *value = from->value + from->first[node];
    for (int in = 0; in < plane; in++)
        for (int out = 0; out < plane; out++)
            to->value[to_first + in * plane + out] =
                value[(plane - 1 - out) * plane + plane - 1 - in];
}

static void reverse_node(const tensor *from, int node, tensor *to, int to_node, int *nodes)
{
    to->log2[to_node] = from->log2[node];
    if (from->log2[node] >= 0) {
        to->first[to_node] = to->values;
        reverse_grid(from, node, to, to->values);
        to->values += 1 << 4 * from->log2[node];
        return;
    }
    const int first    = *nodes;
    to->first[to_node] = first;
    *nodes += 16;
    for (int i = 0; i < 16; i++)
        reverse_node(from, from->first[node] + reverse_child(i), to, first + i, nodes);
}

/* The mean of 2 x 2 x 2 places in each cell of a grid: a rank 3 tree holds the polar angle of one
 * direction alone, and no tree has the same cells in reverse. */
static float reversed_value(const tensor *t, const int at[3], int n)
{
    double sum = 0.0;
    for (int i = 0; i < 8; i++) {
        float p[3];
        for (int k = 0; k < 3; k++)
            p[k] = ((float)at[k] + (i >> k & 1 ? 0.75f : 0.25f)) / (float)n;
        vvec3 in = { vsplat(0), vsplat(0), vsplat(0) }, out = in;
        vfloat x, y, place[4];
        vsquare_to_disk(vsplat(p[1]), vsplat(p[2]), &x, &y);
        in.x  = -x;
        in.y  = -y;
        out.x = vsplat(2.0f * p[0] - 1.0f);
        vtensor_place(3, &in, &out, place);
        sum += (double)lane(vtensor_value(t, place, ALL_LANES), 0);
    }
    return (float)(sum / 8.0);
}

static const tensor *reverse_rank3(arena *a, const tensor *t, lux_error *err)
{
    enum { FINEST = 6 };
    const int log2 = t->depth < 1 ? 1 : t->depth > FINEST ? FINEST : t->depth, n = 1 << log2;
    tensor *to = tensor_new(a, 3, 1, n * n * n, err);
    if (!to)
        return NULL;
    to->log2[0] = to->depth = log2;
    for (int i = 0; i < n / 2; i++) /* above 1/2 nothing is used */
        for (int j = 0; j < n * n; j++)
            to->value[i * n * n + j] = reversed_value(t, (int[3]){ i, j / n, j % n }, n);
    return to;
}

const tensor *tensor_reverse(arena *a, const tensor *t, lux_error *err)
{
    if (t->rank == 3)
        return reverse_rank3(a, t, err);
    tensor *to = tensor_new(a, 4, t->nodes, t->values, err);
    if (!to)
        return NULL;
    int nodes  = 1;
    to->depth  = t->depth;
    to->values = 0;
    reverse_node(t, 0, to, 0, &nodes);
    return to;
}
