/* sky/brightness.c -- see brightness.h. */
#include "sky/brightness.h"

#include "core/color.h"

#include <float.h>

/* Of skies without a table of their own: 1.4 degrees. Of panoramas a cell is k x k pixels. */
enum { COLUMNS = 256, ROWS = 128, MOST_COLUMNS = 2048, MOST_ROWS = 1024 };

static int cells(int pixels, int most)
{
    int pooled = (pixels - 1) / most + 1;
    return (pixels - 1) / pooled + 1;
}

static void choose_size(brightness *b, const sky *const *skies, int count)
{
    b->columns = COLUMNS;
    b->rows    = ROWS;
    for (int i = 0; i < count; i++) {
        int columns = skies[i]->columns > 0 ? cells(skies[i]->columns, MOST_COLUMNS) : 0;
        int rows    = skies[i]->rows > 0 ? cells(skies[i]->rows, MOST_ROWS) : 0;
        b->columns  = columns > b->columns ? columns : b->columns;
        b->rows     = rows > b->rows ? rows : b->rows;
    }
}

/* Points in a cell along one side, so that every pixel has one. */
static int points(int pixels, int size) { return pixels > size ? (pixels - 1) / size + 1 : 1; }

/* Sines and cosines of the azimuth at points in the middle of equal steps; room for a packet more.
 */
static void azimuths(float *sines, float *cosines, int count)
{
    for (int i = 0; i < count + LANES; i++) {
        double azimuth = 2.0 * M_PI * ((i < count ? i : 0) + 0.5) / count - M_PI;
        sines[i]       = (float)sin(azimuth);
        cosines[i]     = (float)cos(azimuth);
    }
}

/* Adds the sky at one row of points to a row of cells. */
static void add_row(double *sums, const sky *s, double from_zenith, const float *sines, int across,
                    int columns)
{
    const int count      = across * columns;
    const float *cosines = sines + count + LANES;
    vfloat z             = vsplat((float)cos(from_zenith));
    vfloat r             = vsplat((float)sin(from_zenith));
    for (int i = 0; i < count; i += LANES) {
        vmask active = vlane_index() + i < count;
        vvec3 wi     = { r * vload(sines + i), r * vload(cosines + i), z };
        vfloat y     = vrgb_luminance(sky_radiance(s, &wi, active));
        for (int k = 0; k < LANES && i + k < count; k++)
            sums[(i + k) / across] += (double)lane(y, k);
    }
}

static bool add_sky(double *sums, const brightness *b, const sky *s, double weight, lux_error *err)
{
    const int across = points(s->columns, b->columns), down = points(s->rows, b->rows);
    const int count = across * b->columns;
    arena scratch   = { 0 };
    float *sines    = arena_array(&scratch, float, 2 * ((size_t)count + LANES), err);
    double *row     = sines ? arena_array(&scratch, double, (size_t)b->columns, err) : NULL;
    for (int j = 0; row && j < b->rows; j++) {
        if (j == 0)
            azimuths(sines, sines + count + LANES, count);
        for (int i = 0; i < b->columns; i++)
            row[i] = 0.0;
        for (int k = 0; k < down; k++)
            add_row(row, s, M_PI * (j + (k + 0.5) / down) / b->rows, sines, across, b->columns);
        for (int i = 0; i < b->columns; i++)
            sums[(size_t)j * (size_t)b->columns + (size_t)i] += weight * row[i] / (across * down);
    }
    arena_clear(&scratch);
    return row != NULL;
}

static void finish(brightness *b, const double *sums)
{
    const size_t columns = (size_t)b->columns;
    double total         = 0.0;
    for (size_t j = 0; j < (size_t)b->rows; j++) {
        const double *row = sums + j * columns;
        double of_row     = 0.0;
        for (size_t i = 0; i < columns; i++) {
            double beside = row[(i + 1) % columns] + row[(i + columns - 1) % columns];
            double most   = fmin(fmax(row[i], 0.25 * beside), (double)FLT_MAX);
            b->luminance[j * columns + i] = (float)most;
            of_row += row[i];
        }
        total +=
            of_row * (cos(M_PI * (double)j / b->rows) - cos(M_PI * ((double)j + 1.0) / b->rows));
    }
    b->mean = total / (2.0 * b->columns);
}

bool brightness_of(arena *a, brightness *b, const sky *const *skies, int count, lux_error *err)
{
    choose_size(b, skies, count);
    const size_t size = (size_t)b->columns * (size_t)b->rows;
    arena scratch     = { 0 };
    b->luminance      = arena_array(a, float, size, err);
    double *sums      = b->luminance ? arena_array(&scratch, double, size, err) : NULL;
    bool done         = sums != NULL;
    for (int i = 0; done && i < count; i++)
        done = add_sky(sums, b, skies[i], 1.0 / count, err);
    if (done)
        finish(b, sums);
    arena_clear(&scratch);
    return done;
}
