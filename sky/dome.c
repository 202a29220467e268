/* sky/dome.c -- see dome.h.
 *
 * The cells of a brightness table, the density the same all over each:
 *
 *     p = P(row) P(column | row) columns / (2 pi (h1 - h0))
 *
 * where h = 1 - cos is counted from the nearer pole, so that no digit is lost there:
 *
 *     z = 1 - h    x^2 + y^2 = h (2 - h)
 *
 * Directions are looked up by the functions that give their density, and where rounding has put
 * one into the next cell, it is drawn in the middle of its own.
 */
#include "sky/dome.h"

#include "core/distribution.h"
#include "core/warp.h"

struct dome {
    int columns, rows;
    float *row_cdf;     /* rows + 1 */
    float *column_cdf;  /* columns + 1 of each row */
    float *h0, *height; /* of each row: h where it begins, to where it ends; from its pole */
    float *density;     /* 1/sr, of each row, for both shares 1 */
};

/* Less than that of the light remaining above the mean: nothing is taken off. */
static const double TOO_LITTLE = 0.1;

/* Weights below this, of the mean, are none: so that products of shares remain normal numbers. */
static const double NOTHING = 1e-9;

/* ---- drawing -------------------------------------------------------------------------------- */

typedef struct cell {
    vint row, column;
} cell;

static cell find(const dome *d, const vvec3 *wi, vmask active)
{
    vfloat r      = vsqrt(wi->x * wi->x + wi->y * wi->y);
    vfloat down   = vatan2(r, wi->z) * ((float)d->rows / WARP_PI);
    vfloat around = (vatan2(wi->x, wi->y) + WARP_PI) * ((float)d->columns / (2.0f * WARP_PI));
    vfloat row    = vmin(vkeep(active, down), vsplat((float)(d->rows - 1)));
    vfloat column = vmin(vkeep(active, around), vsplat((float)(d->columns - 1)));
    return (cell){ vto_int(vmax(row, vsplat(0.0f))), vto_int(vmax(column, vsplat(0.0f))) };
}

static vfloat density(const dome *d, cell c)
{
    vint at      = c.row * (d->columns + 1) + c.column;
    vfloat row   = vgather(d->row_cdf, c.row + 1) - vgather(d->row_cdf, c.row);
    vfloat share = vgather(d->column_cdf, at + 1) - vgather(d->column_cdf, at);
    return row * share * vgather(d->density, c.row);
}

static vvec3 place(const dome *d, cell c, vfloat across, vfloat down)
{
    vmask north    = c.row < (d->rows + 1) / 2;
    vfloat h       = vgather(d->h0, c.row) + down * vgather(d->height, c.row);
    vfloat r       = vsqrt(vmax(h * (2.0f - h), vsplat(0.0f)));
    vfloat azimuth = (vto_float(c.column) + across) * (2.0f * WARP_PI / (float)d->columns);
    vfloat z       = 1.0f - h;
    return (vvec3){ -r * vsin(azimuth), -r * vcos(azimuth), vselect(north, z, -z) };
}

vvec3 dome_sample(const dome *d, vfloat s, vfloat t, vmask active, vfloat *pdf)
{
    vfloat down, across, share;
    cell drawn;
    s            = vkeep(active, s);
    t            = vkeep(active, t);
    drawn.row    = vdistribution_draw(d->row_cdf, vsplat_int(0), d->rows, t, &down, &share);
    vint first   = drawn.row * (d->columns + 1);
    drawn.column = vdistribution_draw(d->column_cdf, first, d->columns, s, &across, &share);

    vvec3 wi   = place(d, drawn, across, down);
    cell found = find(d, &wi, active);
    vmask off  = (found.row != drawn.row) | (found.column != drawn.column);
    if (vany(off & active))
        wi = vselect3(off, place(d, drawn, vsplat(0.5f), vsplat(0.5f)), wi);
    *pdf = vkeep(active, density(d, drawn));
    return vkeep3(active, wi);
}

vfloat dome_pdf(const dome *d, const vvec3 *wi, vmask active)
{
    return vkeep(active, density(d, find(d, wi, active)));
}

/* ---- making --------------------------------------------------------------------------------- */

/* sr, of a row of cells. */
static double row_angle(int row, int rows)
{
    return 2.0 * M_PI * (cos(M_PI * row / rows) - cos(M_PI * (row + 1.0) / rows));
}

/* What to take off: the mean, or nothing where that leaves too little. */
static double common_part(const brightness *b)
{
    double left = 0.0, all = 0.0;
    for (int j = 0; j < b->rows; j++) {
        const float *row = b->luminance + (size_t)j * (size_t)b->columns;
        double of_row = 0.0, left_of_row = 0.0;
        for (int i = 0; i < b->columns; i++) {
            of_row += (double)row[i];
            left_of_row += fmax((double)row[i] - b->mean, 0.0);
        }
        all += of_row * row_angle(j, b->rows);
        left += left_of_row * row_angle(j, b->rows);
    }
    return left > TOO_LITTLE * all ? b->mean : 0.0;
}

static void drop_faint(double *weights, int count)
{
    double sum = 0.0;
    for (int i = 0; i < count; i++)
        sum += weights[i];
    for (int i = 0; i < count; i++)
        weights[i] = weights[i] > NOTHING * sum / count ? weights[i] : 0.0;
}

static void fill(dome *d, const brightness *b, double common, double *weights)
{
    double *of_rows = weights + d->columns;
    for (int j = 0; j < d->rows; j++) {
        const float *row = b->luminance + (size_t)j * (size_t)b->columns;
        float *cdf       = d->column_cdf + (size_t)j * ((size_t)d->columns + 1);
        for (int i = 0; i < d->columns; i++)
            weights[i] = b->mean > 0.0 ? fmax((double)row[i] - common, 0.0) : 1.0;
        drop_faint(weights, d->columns);
        of_rows[j] = distribution_make(cdf, weights, d->columns) * row_angle(j, d->rows);

        int from_pole = j < (d->rows + 1) / 2 ? j : d->rows - 1 - j;
        double low = sin(0.5 * M_PI * from_pole / d->rows), angle = row_angle(j, d->rows);
        d->h0[j]      = (float)(2.0 * low * low);
        d->height[j]  = (float)(angle / (2.0 * M_PI));
        d->density[j] = (float)(d->columns / angle);
    }
    drop_faint(of_rows, d->rows);
    distribution_make(d->row_cdf, of_rows, d->rows);
}

static dome *room_for(arena *a, int columns, int rows, lux_error *err)
{
    const size_t n = (size_t)rows;
    dome *d        = arena_new(a, dome, err);
    if (!d || !(d->row_cdf = arena_array(a, float, 4 * n + 1, err)) ||
        !(d->column_cdf = arena_array(a, float, n *((size_t)columns + 1), err)))
        return NULL;
    d->columns = columns;
    d->rows    = rows;
    d->h0      = d->row_cdf + n + 1;
    d->height  = d->h0 + n;
    d->density = d->height + n;
    return d;
}

/* common: W/(sr m^2), taken off all cells. */
static const dome *make(arena *a, const brightness *b, double common, lux_error *err)
{
    arena scratch   = { 0 };
    double *weights = arena_array(&scratch, double, (size_t)b->columns + (size_t)b->rows, err);
    dome *d         = weights ? room_for(a, b->columns, b->rows, err) : NULL;
    if (d)
        fill(d, b, common, weights);
    arena_clear(&scratch);
    return d;
}

const dome *dome_new(arena *a, const sky *const *skies, int count, lux_error *err)
{
    arena scratch = { 0 };
    brightness b  = { 0 };
    const dome *d = NULL;
    if (brightness_of(&scratch, &b, skies, count, err))
        d = make(a, &b, common_part(&b), err);
    arena_clear(&scratch);
    return d;
}

const dome *dome_of_table(arena *a, const brightness *b, lux_error *err)
{
    return make(a, b, 0.0, err);
}
