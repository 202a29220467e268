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

/* A level without its frame, or the picture as it came. */
typedef struct picture {
    int width, height;
    size_t stride; /* floats from a line to the next */
    const float *texels;
} picture;

static float *first_texel(const texture *t, const level *l)
{
    return t->texels + 4 * ((size_t)l->first + (size_t)l->stride + 1);
}

static picture picture_of(const texture *t, const level *l)
{
    return (picture){ (int)l->width, (int)l->height, 4 * (size_t)l->stride, first_texel(t, l) };
}

/* Sums of several lines of p by their weights. */
static void add_lines(const picture *p, const cover *lines, double *sum)
{
    memset(sum, 0, (size_t)p->width * 4 * sizeof *sum);
    for (int k = 0; k < lines->count; k++) {
        const float *from = p->texels + (size_t)(lines->first + k) * p->stride;
        for (size_t i = 0; i < (size_t)p->width * 4; i++)
            sum[i] += lines->weight[k] * (double)from[i];
    }
}

/* The next level of p at `to`, whose lines are stride floats apart; sum holds one line of p. */
static void shrink(const picture *p, double *sum, float *to, size_t stride)
{
    int width = half_of(p->width), height = half_of(p->height);
    for (int y = 0; y < height; y++) {
        cover lines = cover_of(p->height, y);
        add_lines(p, &lines, sum);
        for (int x = 0; x < width; x++) {
            cover columns      = cover_of(p->width, x);
            const double *from = sum + 4 * (size_t)columns.first;
            for (int c = 0; c < 4; c++) {
                double mean = 0.0;
                for (int k = 0; k < columns.count; k++)
                    mean += columns.weight[k] * from[4 * k + c];
                to[(size_t)y * stride + 4 * (size_t)x + (size_t)c] = (float)mean + 0.0f;
            }
        }
    }
}

/* Of n texels the one that stands before the first, or after the last, in the frame. */
static size_t framed(texture_wrap wrap, bool after, int n)
{
    return after == (wrap == WRAP_REPEAT) ? 0 : (size_t)n - 1;
}

/* Puts a frame about a level. */
static void add_frame(const texture *t, const level *l)
{
    const size_t texel = 4 * sizeof *t->texels, stride = 4 * (size_t)l->stride;
    int width = (int)l->width, height = (int)l->height;
    float *first = first_texel(t, l);
    for (int y = 0; y < height; y++) {
        float *line = first + (size_t)y * stride;
        memcpy(line - 4, line + 4 * framed(t->wrap_u, false, width), texel);
        memcpy(line + 4 * width, line + 4 * framed(t->wrap_u, true, width), texel);
    }
    float *top = first - 4 - stride, *low = first - 4 + (size_t)height * stride;
    memcpy(top, first - 4 + framed(t->wrap_v, false, height) * stride, stride * sizeof *top);
    memcpy(low, first - 4 + framed(t->wrap_v, true, height) * stride, stride * sizeof *low);
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

/* No texel is -0: so a blend of them is not either, whichever way it is made. */
static void copy_picture(const texture *t, const texture_desc *d)
{
    size_t length = (size_t)d->width * 4, stride = 4 * (size_t)t->levels[0].stride;
    float *to = first_texel(t, &t->levels[0]);
    for (size_t y = 0; y < (size_t)d->height; y++)
        for (size_t i = 0; i < length; i++)
            to[y * stride + i] = d->rgba[y * length + i] + 0.0f;
}

/* Each level is made of the one below as it is stored: beside them there is a line of sums. */
static bool fill(texture *t, const texture_desc *d, arena *scratch, lux_error *err)
{
    double *sum = arena_array(scratch, double, (size_t)d->width * 4, err);
    if (!sum)
        return false;
    copy_picture(t, d);
    add_frame(t, &t->levels[0]);
    for (int i = 1; i <= (int)t->last; i++) {
        const level *l = &t->levels[i];
        picture below  = picture_of(t, l - 1);
        shrink(&below, sum, first_texel(t, l), 4 * (size_t)l->stride);
        add_frame(t, l);
    }
    memcpy(t->mean, first_texel(t, &t->levels[(int)t->last]), sizeof t->mean);
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

void texture_range(const texture *t, float low[4], float high[4])
{
    picture p = picture_of(t, &t->levels[0]);
    for (int c = 0; c < 4; c++)
        low[c] = high[c] = p.texels[c];
    for (size_t y = 0; y < (size_t)p.height; y++)
        for (size_t i = 0; i < 4 * (size_t)p.width; i++) {
            float v     = p.texels[y * p.stride + i];
            low[i % 4]  = fminf(low[i % 4], v);
            high[i % 4] = fmaxf(high[i % 4], v);
        }
}

double texture_share(const texture *t, float alpha)
{
    picture p    = picture_of(t, &t->levels[0]);
    size_t count = 0;
    for (size_t y = 0; y < (size_t)p.height; y++)
        for (size_t x = 0; x < (size_t)p.width; x++)
            count += p.texels[y * p.stride + 4 * x + 3] >= alpha;
    return (double)count / ((double)p.width * p.height);
}

uint64_t texture_picture_bytes(const texture *t)
{
    const level *l = &t->levels[0];
    return (uint64_t)l->width * (uint64_t)l->height * 4 * sizeof *t->texels;
}

uint64_t texture_bytes(const texture *t) { return t->bytes; }
