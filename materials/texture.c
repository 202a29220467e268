/* materials/texture.c -- see texture.h.
 *
 * Each level has half the columns and rows of the one below it, rounded down, until one texel is
 * left. Where n is odd and becomes m = (n - 1) / 2, texel x of the smaller level covers the parts
 * (m - x, m, x + 1) / n of the texels 2x, 2x + 1 and 2x + 2: every level has the mean of the
 * picture. Means are kept in double until they are stored.
 *
 * A level is stored with a frame of one texel, filled as the wrap modes say. With u folded into
 * [0, 1], each look-up then reads four neighbours, and none of them is outside:
 *
 *     column       0     1     2    ...    W    W+1
 *                frame   |<--- the level --->|  frame
 *     u W + 1/2   0.5    1.0   ...         W   W + 0.5
 *                 ^ its whole part is the left corner, the rest the place between it and the next
 */
#include "materials/texture.h"

#include "core/packet_math.h"

#include <stdio.h>
#include <string.h>

enum { MOST_A_SIDE = 32768, MOST_LEVELS = 16 };

/* Beyond this no picture means anything, and differences of texels might overflow. */
static const float MOST_TEXEL = 1e30f;

/* What a look-up must know of a level: a row of packet.h. */
typedef struct level {
    float width, height;
    int32_t first, stride; /* its frame's upper left texel; texels from a line to the next */
} level;

struct texture {
    float *texels;                 /* rows of four */
    level levels[MOST_LEVELS + 1]; /* the last one twice, so that each has one above it */
    float last;                    /* the highest level */
    float size;                    /* the longer side, texels */
    texture_wrap wrap_u, wrap_v;
    bool nearest;
    uint64_t bytes;
    float mean[4];
};

/* ---- looking up ------------------------------------------------------------------------------ */

/* Coordinates where the picture is, [0, 1], for all floats: NaN and infinities become one or the
 * other end. */
static vfloat fold(texture_wrap wrap, vfloat u)
{
    const vfloat zero = vsplat(0.0f), one = vsplat(1.0f);
    vfloat half = 0.5f * u;
    switch (wrap) {
    case WRAP_REPEAT:
        return vmin(u - vfloor(u), one);
    case WRAP_MIRROR:
        return 1.0f - vabs(2.0f * vmin(half - vfloor(half), one) - 1.0f);
    default:
        return vmin(vmax(u, zero), one);
    }
}

/* Four neighbours of one level: texels upper, upper + 1, lower and lower + 1, and the place between
 * them, to the right and down, [0, 1). */
typedef struct vpatch {
    vint upper, lower;
    vfloat x, y;
} vpatch;

static inline vpatch patch_at(const texture *t, vint number, vfloat u, vfloat v)
{
    vfloat of[4]; /* the fields of struct level */
    vgather4((const float *)t->levels, number, of);
    vint stride = vas_int(of[3]);

    vfloat x    = u * of[0] + 0.5f;
    vfloat y    = v * of[1] + 0.5f;
    vint column = vto_int(x);
    vint line   = vto_int(y);
    vint upper  = vas_int(of[2]) + line * stride + column;
    return (vpatch){ upper, upper + stride, x - vto_float(column), y - vto_float(line) };
}

static inline float4 patch_row(const float *texels, const vpatch *p, int i)
{
    int32_t upper = lane(p->upper, i), lower = lane(p->lower, i);
    float x    = lane(p->x, i);
    float4 top = float4_lerp(float4_at(texels, upper), float4_at(texels, upper + 1), x);
    float4 low = float4_lerp(float4_at(texels, lower), float4_at(texels, lower + 1), x);
    return float4_lerp(top, low, lane(p->y, i));
}

static inline void blended_rows(const texture *t, vfloat u, vfloat v, vfloat width, vmask active,
                                float4 rows[LANES])
{
    /* One texel of the full picture is level 0, two are level 1; a width of NaN is level 0 */
    vfloat wide  = width * t->size;
    vfloat place = vsplat(0.0f);
    if (vany(active & (wide > 1.0f)))
        place = vmin(vmax(vlog2(wide), vsplat(0.0f)), vsplat(t->last));
    vint below  = vto_int(place);
    vfloat rest = place - vto_float(below);

    vpatch near = patch_at(t, below, u, v);
    for (int i = 0; i < LANES; i++)
        rows[i] = patch_row(t->texels, &near, i);
    if (!vany(active & (rest > 0.0f)))
        return;
    vpatch far = patch_at(t, below + 1, u, v);
    for (int i = 0; i < LANES; i++)
        rows[i] = float4_lerp(rows[i], patch_row(t->texels, &far, i), lane(rest, i));
}

static inline void nearest_rows(const texture *t, vfloat u, vfloat v, float4 rows[LANES])
{
    const level *all = &t->levels[0];
    vint column      = vto_int(vmin(u * all->width, vsplat(all->width - 1.0f)));
    vint line        = vto_int(vmin(v * all->height, vsplat(all->height - 1.0f)));
    vint texel       = (line + 1) * all->stride + column + 1;
    for (int i = 0; i < LANES; i++)
        rows[i] = float4_at(t->texels, lane(texel, i));
}

vtexel vtexture_lookup(const texture *t, vfloat u, vfloat v, vfloat width, vmask active)
{
    float4 rows[LANES];
    vfloat of[4];
    vfloat x = fold(t->wrap_u, u), y = fold(t->wrap_v, v);
    if (t->nearest)
        nearest_rows(t, x, y, rows);
    else
        blended_rows(t, x, y, width, active, rows);
    vturn4(rows, of);
    return (vtexel){ vkeep(active, of[0]), vkeep(active, of[1]), vkeep(active, of[2]),
                     vkeep(active, of[3]) };
}

/* ---- making ---------------------------------------------------------------------------------- */

static int half_of(int n) { return n > 1 ? n / 2 : 1; }

/* What of the n texels of a line one of half as many covers; the weights add up to 1. */
typedef struct cover {
    int first, count;
    double weight[3];
} cover;

static cover cover_of(int n, int x)
{
    double m = half_of(n);
    if (n == 1)
        return (cover){ 0, 1, { 1.0 } };
    if (n % 2 == 0)
        return (cover){ 2 * x, 2, { 0.5, 0.5 } };
    return (cover){ 2 * x, 3, { (m - x) / n, m / n, (x + 1.0) / n } };
}

/* A level while the pyramid is made: the picture as it came, or means. */
typedef struct picture {
    int width, height;
    const float *given; /* or NULL */
    double *means;
} picture;

static void add_line(const picture *p, int line, double weight, double *sum)
{
    size_t length = (size_t)p->width * 4, first = (size_t)line * length;
    if (p->given)
        for (size_t i = 0; i < length; i++)
            sum[i] += weight * (double)p->given[first + i];
    else
        for (size_t i = 0; i < length; i++)
            sum[i] += weight * p->means[first + i];
}

static void clear_line(const picture *p, double *sum)
{
    memset(sum, 0, (size_t)p->width * 4 * sizeof *sum);
}

/* The next level, into means; sum holds one line of p. */
static void shrink(const picture *p, double *sum, double *means)
{
    int width = half_of(p->width), height = half_of(p->height);
    for (int y = 0; y < height; y++) {
        cover lines = cover_of(p->height, y);
        clear_line(p, sum);
        for (int k = 0; k < lines.count; k++)
            add_line(p, lines.first + k, lines.weight[k], sum);
        for (int x = 0; x < width; x++) {
            cover columns      = cover_of(p->width, x);
            const double *from = sum + 4 * (size_t)columns.first;
            for (int c = 0; c < 4; c++, means++) {
                *means = 0.0;
                for (int k = 0; k < columns.count; k++)
                    *means += columns.weight[k] * from[4 * k + c];
            }
        }
    }
}

/* Which of n texels stands at i, -1 ... n: those at the ends are the frame. */
static int framed(texture_wrap wrap, int i, int n)
{
    bool repeats = wrap == WRAP_REPEAT;
    if (i < 0)
        return repeats ? n - 1 : 0;
    return i < n ? i : repeats ? 0 : n - 1;
}

/* With its frame. No texel is -0: so a blend of them is not either, whichever way it is made. */
static void store(const texture *t, const picture *p, double *sum, float *to)
{
    for (int y = -1; y <= p->height; y++) {
        clear_line(p, sum);
        add_line(p, framed(t->wrap_v, y, p->height), 1.0, sum);
        for (int x = -1; x <= p->width; x++) {
            const double *from = sum + 4 * (size_t)framed(t->wrap_u, x, p->width);
            for (int c = 0; c < 4; c++)
                *to++ = (float)from[c] + 0.0f;
        }
    }
}

/* Sets levels, last and size; returns how many texels there are, frames and all: fewer than 2^31
 * of the largest picture. */
static size_t lay_out(texture *t, int width, int height)
{
    size_t count = 0;
    level *l     = t->levels;
    t->size      = (float)(width > height ? width : height);
    while (true) {
        *l++ = (level){ (float)width, (float)height, (int32_t)count, width + 2 };
        count += (size_t)(width + 2) * (size_t)(height + 2);
        if (width == 1 && height == 1)
            break;
        width  = half_of(width);
        height = half_of(height);
    }
    *l      = l[-1];
    t->last = (float)(l - 1 - t->levels);
    return count;
}

static bool fill(texture *t, const texture_desc *d, arena *scratch, lux_error *err)
{
    int width = half_of(d->width), height = half_of(d->height);
    size_t next   = (size_t)width * (size_t)height * 4;
    size_t after  = (size_t)half_of(width) * (size_t)half_of(height) * 4;
    double *sum   = arena_array(scratch, double, (size_t)d->width * 4, err);
    double *one   = sum ? arena_array(scratch, double, next, err) : NULL;
    double *other = one ? arena_array(scratch, double, after, err) : NULL;
    if (!other)
        return false;
    picture p = { d->width, d->height, d->rgba, NULL };
    for (int i = 0; i <= (int)t->last; i++) {
        store(t, &p, sum, t->texels + 4 * (size_t)t->levels[i].first);
        double *smaller = p.means == one ? other : one;
        shrink(&p, sum, smaller);
        p = (picture){ half_of(p.width), half_of(p.height), NULL, smaller };
    }
    for (int c = 0; c < 4; c++)
        t->mean[c] = (float)p.means[c] + 0.0f;
    return true;
}

static bool texels_valid(const texture_desc *d, lux_error *err)
{
    static const char *const channels[4] = { "red", "green", "blue", "alpha" };
    size_t count                         = (size_t)d->width * (size_t)d->height * 4;
    for (size_t i = 0; i < count; i++) {
        float v = d->rgba[i];
        if (fabsf(v) <= MOST_TEXEL)
            continue;
        char text[32] = "not a number";
        if (!isnan(v))
            snprintf(text, sizeof text, "%g", (double)v);
        return failed(err, ERR_FORMAT,
                      "%s: the %s of the pixel in column %zu of row %zu is %s, at most 1e30 wanted",
                      d->name, channels[i % 4], i / 4 % (size_t)d->width, i / 4 / (size_t)d->width,
                      text);
    }
    return true;
}

const texture *texture_new(arena *a, const texture_desc *d, lux_error *err)
{
    if (d->width < 1 || d->height < 1 || d->width > MOST_A_SIDE || d->height > MOST_A_SIDE)
        return failed(err, ERR_ARGUMENT, "%s: %d x %d pixels, 1 to %d a side wanted", d->name,
                      d->width, d->height, MOST_A_SIDE);
    if (!texels_valid(d, err))
        return NULL;
    texture *t = arena_new(a, texture, err);
    if (!t)
        return NULL;
    size_t count = lay_out(t, d->width, d->height);
    t->wrap_u    = d->wrap_u;
    t->wrap_v    = d->wrap_v;
    t->nearest   = d->nearest;
    t->bytes     = sizeof *t + count * 4 * sizeof *t->texels;
    t->texels    = arena_alloc(a, count, 4 * sizeof *t->texels, 64, err);
    if (!t->texels)
        return NULL;
    arena scratch = { 0 };
    bool ok       = fill(t, d, &scratch, err);
    arena_clear(&scratch);
    return ok ? t : NULL;
}

void texture_mean(const texture *t, float rgba[4])
{
    for (int c = 0; c < 4; c++)
        rgba[c] = t->mean[c];
}

double texture_share(const texture *t, float alpha)
{
    const level *l = &t->levels[0];
    int width = (int)l->width, height = (int)l->height;
    size_t count = 0;
    for (int y = 1; y <= height; y++) /* within the frame */
        for (int x = 1; x <= width; x++)
            count += t->texels[4 * ((size_t)y * (size_t)l->stride + (size_t)x) + 3] >= alpha;
    return (double)count / ((double)width * height);
}

uint64_t texture_bytes(const texture *t) { return t->bytes; }
