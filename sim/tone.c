/* sim/tone.c -- see tone.h. */
#include "sim/tone.h"

#include "core/color.h"

#include <math.h>
#include <stdlib.h>

enum { COPY_WIDTH = 128 }; /* cells of the small copy, at most */

static const double DEFAULT_KEY  = 0.18;
static const double SHARE_WHITE  = 0.005; /* of the cells may be whiter than white */
static const double LEAST_OF_TOP = 1e-6;  /* darker cells count as this share of the brightest */

/* ---- sRGB ------------------------------------------------------------------------------- */

srgb_table srgb_table_make(void)
{
    srgb_table t = { { 0.0 } };
    for (int k = 1; k < 256; k++) {
        double v   = (k - 0.5) / 255.0;
        t.least[k] = v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
    }
    return t;
}

uint8_t srgb_code(const srgb_table *t, double linear)
{
    int code = 0;
    for (int step = 128; step; step /= 2)
        if (linear >= t->least[code + step])
            code += step;
    return (uint8_t)code;
}

/* ---- exposure --------------------------------------------------------------------------- */

typedef struct picture {
    const float *r, *g, *b;
    int width, height;
} picture;

/* In [0, 1e37]: so that even the luminance of the brightest floats is one. */
static float within(float v) { return v > 0.0f ? fminf(v, 1e37f) : 0.0f; }

static vec3 color_at(const picture *p, size_t i)
{
    return (vec3){ within(p->r[i]), within(p->g[i]), within(p->b[i]) };
}

static bool all_finite(const picture *p, lux_error *err)
{
    size_t pixels = (size_t)p->width * (size_t)p->height;
    for (size_t i = 0; i < pixels; i++)
        if (!isfinite(p->r[i]) || !isfinite(p->g[i]) || !isfinite(p->b[i]))
            return failed(err, ERR_ARGUMENT, "pixel at column %zu of row %zu is no finite colour",
                          i % (size_t)p->width, i / (size_t)p->width);
    return true;
}

/* The mean luminance of size * size pixels, or of those that the picture has there. */
static double cell_luminance(const picture *p, int column, int row, int size)
{
    int x_end  = (column + 1) * size < p->width ? (column + 1) * size : p->width;
    int y_end  = (row + 1) * size < p->height ? (row + 1) * size : p->height;
    double sum = 0.0;
    for (int y = row * size; y < y_end; y++)
        for (int x = column * size; x < x_end; x++)
            sum += (double)rgb_luminance(color_at(p, (size_t)y * (size_t)p->width + (size_t)x));
    return sum / ((double)(x_end - column * size) * (double)(y_end - row * size));
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The luminances of the cells that have any, ascending. Their number, or -1 with *err. */
static int lit_cells(const picture *p, double **cells, arena *scratch, lux_error *err)
{
    int longer  = p->width > p->height ? p->width : p->height;
    int size    = (longer + COPY_WIDTH - 1) / COPY_WIDTH;
    int columns = (p->width + size - 1) / size;
    int rows    = (p->height + size - 1) / size;
    *cells      = arena_array(scratch, double, (size_t)columns *(size_t)rows, err);
    if (!*cells)
        return -1;
    int count = 0;
    for (int i = 0; i < columns * rows; i++) {
        double l = cell_luminance(p, i % columns, i / columns, size);
        if (l > 0.0)
            (*cells)[count++] = l;
    }
    qsort(*cells, (size_t)count, sizeof **cells, ascending);
    return count;
}

typedef struct exposure {
    double scale; /* equation 2: key 2^ev / Lavg */
    double white; /* Lwhite, >= 1 */
} exposure;

/* From count >= 1 luminances > 0, ascending. */
static exposure expose(const double *cells, int count, const tone_options *o)
{
    double least = LEAST_OF_TOP * cells[count - 1];
    double sum   = 0.0;
    for (int i = 0; i < count; i++)
        sum += log(fmax(cells[i], least));
    double average = exp(sum / count);

    double key   = o->key > 0.0 ? o->key : DEFAULT_KEY;
    double scale = key / average;
    int whitest  = count - 1 - (int)(SHARE_WHITE * count);
    return (exposure){ .scale = scale * exp2(o->exposure_ev),
                       .white = fmax(scale * cells[whitest], 1.0) };
}

/* ---- the picture ------------------------------------------------------------------------ */

static void tone_pixel(const exposure *e, const srgb_table *t, vec3 color, uint8_t rgb[3])
{
    double lw = (double)rgb_luminance(color);
    double l  = e->scale * lw;
    double ld = l * (1.0 + l / (e->white * e->white)) / (1.0 + l);
    double k  = lw > 0.0 ? ld / lw : 0.0;
    rgb[0]    = srgb_code(t, k * (double)color.x);
    rgb[1]    = srgb_code(t, k * (double)color.y);
    rgb[2]    = srgb_code(t, k * (double)color.z);
}

bool tone_photographic(const float *r, const float *g, const float *b, int width, int height,
                       const tone_options *o, uint8_t *rgb, arena *scratch, lux_error *err)
{
    const picture p = { r, g, b, width, height };
    double *cells;
    if (width < 1 || height < 1)
        return failed(err, ERR_ARGUMENT, "a picture of %d x %d pixels", width, height);
    if (!all_finite(&p, err))
        return false;
    int count = lit_cells(&p, &cells, scratch, err);
    if (count < 0)
        return false;

    const tone_options usual = { 0 };
    const exposure e   = count ? expose(cells, count, o ? o : &usual) : (exposure){ 0.0, 1.0 };
    const srgb_table t = srgb_table_make();
    size_t pixels      = (size_t)width * (size_t)height;
    for (size_t i = 0; i < pixels; i++)
        tone_pixel(&e, &t, color_at(&p, i), rgb + 3 * i);
    return true;
}
