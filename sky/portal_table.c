/* sky/portal_table.c -- see portal_table.h.
 *
 * Of a box, its first and last columns and rows count in part:
 *
 *            first         last
 *           +--+----------+--+
 *           |  |          |  |  last
 *           +--+----------+--+
 *           |  |          |  |
 *           +--+----------+--+
 *           |  |          |  |  first
 *           +--+----------+--+
 *
 * A row is drawn by its share of the box, then a column by its share of the row.
 */
#include "sky/portal_table.h"

/* ---- drawing -------------------------------------------------------------------------------- */

/* The tangent of half the angle from z toward x, and 1 + its square. */
static vfloat half_tangent(vfloat x, vfloat z, vfloat r) { return x / (z + r); }

/* From x - half to x + half. What lies between both ends is worked out by itself: of ends far away
 * the difference has few digits. */
static inline void span_of(vfloat x, vfloat half, vfloat z, int cells, vmask *wide, portal_span *s)
{
    vfloat x0 = x - half, x1 = x + half;
    vfloat r0 = vsqrt(x0 * x0 + z * z), r1 = vsqrt(x1 * x1 + z * z);
    vfloat apart =
        vselect(x0 * x1 > 0.0f, 4.0f * half * x * z * z / (x1 * r0 + x0 * r1), x1 * r0 - x0 * r1);
    vfloat by    = 1.0f / ((z + r0) * (z + r1));
    vfloat a0    = x0 * (z + r1) * by;
    vfloat a1    = x1 * (z + r0) * by;
    vfloat width = (2.0f * half * z + apart) * by;

    const float scale = 0.5f * (float)cells;
    vfloat begin = scale + scale * a0, end = scale + scale * a1;
    *wide      = *wide & (a0 < a1) & (width > 0.0f);
    vint first = vto_int(vkeep(*wide, vmin(begin, vsplat((float)(cells - 1)))));
    vint last  = vto_int(vkeep(*wide, vmin(end, vsplat((float)(cells - 1)))));
    vmask one  = first == last;

    s->low        = a0;
    s->width      = width * scale;
    s->edge[0]    = first;
    s->edge[1]    = first + 1;
    s->edge[2]    = vselect_int(one, first + 1, last);
    s->edge[3]    = vselect_int(one, first + 1, last + 1);
    s->last       = vkeep(~one, end - vto_float(last));
    vfloat before = s->width - s->last - vto_float(s->edge[2] - s->edge[1]);
    s->first      = vmax(before, vsplat(0.0f));
}

static vint sum_at(const portal_table *t, vint i, vint j)
{
    return vgather_int(t->sums, j * (t->cells + 1) + i);
}

void portal_table_box(const portal_table *t, const portal_view *v, vmask active, portal_box *box)
{
    vmask seen = active & (v->z > 0.0f);
    span_of(v->x, v->half_x, v->z, t->cells, &seen, &box->a);
    span_of(v->y, v->half_y, v->z, t->cells, &seen, &box->b);

    /* All that its cells hold, by how much of them it covers */
    vint i0 = vkeep_int(seen, box->a.edge[0]), i1 = vkeep_int(seen, box->a.edge[3]);
    vint j0 = vkeep_int(seen, box->b.edge[0]), j1 = vkeep_int(seen, box->b.edge[3]);
    vint count = (sum_at(t, i1, j1) - sum_at(t, i0, j1)) - (sum_at(t, i1, j0) - sum_at(t, i0, j0));
    vfloat covered = box->a.width * box->b.width / (vto_float(i1 - i0) * vto_float(j1 - j0));
    box->light     = vkeep(seen, t->unit * covered * vto_float(count));
    box->seen      = seen & (box->light > 0.0f);
}

/* The sums of one step of b, at the four edges along a. */
typedef struct edge_sums {
    vint at[4];
} edge_sums;

static edge_sums sums_along(const portal_table *t, const portal_span *a, vint j)
{
    edge_sums e;
    for (int k = 0; k < 4; k++)
        e.at[k] = sum_at(t, a->edge[k], j);
    return e;
}

/* What of the box's columns lies between two steps of b. */
static vfloat between(const portal_span *a, const edge_sums *low, const edge_sums *high)
{
    vint at[4];
    for (int k = 0; k < 4; k++)
        at[k] = high->at[k] - low->at[k];
    return a->first * vto_float(at[1] - at[0]) + vto_float(at[2] - at[1]) +
           a->last * vto_float(at[3] - at[2]);
}

/* The whole box, and its first row if that were full. */
typedef struct box_sums {
    vfloat first_row, total;
    edge_sums low; /* at the end of the first row */
} box_sums;

static box_sums sums_of(const portal_table *t, const portal_box *box)
{
    edge_sums e0 = sums_along(t, &box->a, box->b.edge[0]);
    edge_sums e1 = sums_along(t, &box->a, box->b.edge[1]);
    edge_sums e2 = sums_along(t, &box->a, box->b.edge[2]);
    edge_sums e3 = sums_along(t, &box->a, box->b.edge[3]);
    box_sums s   = { .first_row = between(&box->a, &e0, &e1), .low = e1 };
    s.total      = box->b.first * s.first_row + between(&box->a, &e1, &e2) +
              box->b.last * between(&box->a, &e2, &e3);
    return s;
}

/* How far from the beginning of a span, for `into` of the cell [at, at + 1). */
static vfloat distance_to(const portal_span *s, vmask in_first, vint at, vfloat into)
{
    vfloat after = s->first + vto_float(at - s->edge[1]) + into;
    return vmin(vmax(vselect(in_first, into, after), vsplat(0.0f)), s->width);
}

/* The row that `target` of the box's total falls in, and where. */
static vfloat draw_row(const portal_table *t, const portal_box *box, vfloat q, vint *row)
{
    box_sums sums   = sums_of(t, box);
    vfloat target   = q * sums.total;
    vfloat of_first = box->b.first * sums.first_row;
    vmask in_first  = (target < of_first) | (box->b.edge[3] == box->b.edge[1]);
    vfloat rest     = target - of_first;
    vint low = box->b.edge[1], high = vselect_int(in_first, low, box->b.edge[3]);
    vfloat below = vsplat(0.0f);
    while (vany(high - low > 1)) {
        vint middle  = (low + high) >> 1;
        edge_sums e  = sums_along(t, &box->a, middle);
        vfloat sum   = between(&box->a, &sums.low, &e);
        vmask beyond = (sum <= rest) & (high - low > 1);
        below        = vselect(beyond, sum, below);
        high         = vselect_int(beyond | (high - low <= 1), high, middle);
        low          = vselect_int(beyond, middle, low);
    }
    *row         = vselect_int(in_first, box->b.edge[0], low);
    edge_sums e0 = sums_along(t, &box->a, *row), e1 = sums_along(t, &box->a, *row + 1);
    vfloat of_row = between(&box->a, &e0, &e1);
    vfloat into   = vselect(in_first, target, rest - below) / of_row;
    return distance_to(&box->b, in_first, low, into);
}

static vfloat draw_column(const portal_table *t, const portal_span *a, vfloat s, vint row)
{
    edge_sums e0 = sums_along(t, a, row), e1 = sums_along(t, a, row + 1);
    vfloat target   = s * between(a, &e0, &e1);
    vint base       = e1.at[1] - e0.at[1];
    vfloat of_first = vto_float(base - (e1.at[0] - e0.at[0]));
    vmask in_first  = (target < a->first * of_first) | (a->edge[3] == a->edge[1]);
    vfloat rest     = target - a->first * of_first;
    vint low = a->edge[1], high = vselect_int(in_first, low, a->edge[3]);
    vint below = vsplat_int(0), above = e1.at[3] - e0.at[3] - base;
    while (vany(high - low > 1)) {
        vint middle  = (low + high) >> 1;
        vint sum     = sum_at(t, middle, row + 1) - sum_at(t, middle, row) - base;
        vmask more   = high - low > 1;
        vmask beyond = (vto_float(sum) <= rest) & more;
        below        = vselect_int(beyond, sum, below);
        above        = vselect_int(more & ~beyond, sum, above);
        high         = vselect_int(more & ~beyond, middle, high);
        low          = vselect_int(beyond, middle, low);
    }
    vfloat into =
        vselect(in_first, target / of_first, (rest - vto_float(below)) / vto_float(above - below));
    return distance_to(a, in_first, low, into);
}

vvec3 portal_table_draw(const portal_table *t, const portal_box *box, vfloat s, vfloat q)
{
    vint row;
    const float step = 2.0f / (float)t->cells;
    vfloat b         = box->b.low + step * draw_row(t, box, q, &row);
    vfloat a         = box->a.low + step * draw_column(t, &box->a, s, row);

    /* (2a / (1 - a^2), 2b / (1 - b^2), 1) without the division */
    vfloat of_a = (1.0f - a) * (1.0f + a), of_b = (1.0f - b) * (1.0f + b);
    return (vvec3){ 2.0f * a * of_b, 2.0f * b * of_a, of_a * of_b };
}

/* The cell of a span that holds x, which may have been rounded out of it. */
static vint cell_in(const portal_span *s, vfloat x)
{
    vint at = vto_int(x);
    at      = vselect_int(at < s->edge[0], s->edge[0], at);
    return vselect_int(at < s->edge[3], at, s->edge[3] - 1);
}

vfloat portal_table_density(const portal_table *t, const portal_box *box, const vvec3 *w,
                            vmask active)
{
    vfloat xz = w->x * w->x + w->z * w->z, yz = w->y * w->y + w->z * w->z;
    vfloat a = half_tangent(w->x, w->z, vsqrt(xz));
    vfloat b = half_tangent(w->y, w->z, vsqrt(yz));

    const float scale = 0.5f * (float)t->cells;
    vint i            = vkeep_int(active, cell_in(&box->a, vkeep(active, scale + scale * a)));
    vint j            = vkeep_int(active, cell_in(&box->b, vkeep(active, scale + scale * b)));
    vint count =
        (sum_at(t, i + 1, j + 1) - sum_at(t, i, j + 1)) - (sum_at(t, i + 1, j) - sum_at(t, i, j));

    box_sums sums  = sums_of(t, box);
    vfloat in_map  = scale * scale * vto_float(count) / sums.total;
    vfloat squeeze = w->z * (1.0f + a * a) * (1.0f + b * b) / (4.0f * xz * yz);
    return vkeep(active, in_map * squeeze);
}

/* ---- making --------------------------------------------------------------------------------- */

/* All counts together, about; with those of one at least, below 2^31. */
static const double COUNTS = 0x1p30;

/* Of the sky's mean luminance, added everywhere: so that light which the table does not know of is
 * found. */
static const double FLOOR = 1e-3;

/* Pixels that are so many times brighter than the mean are put into the cell that they lie in. */
static const double BRIGHT = 4.0;

/* sr, of the rectangle from straight ahead to (a, b): atan(X Y / sqrt(1 + X^2 + Y^2)). */
static double corner_angle(double a, double b)
{
    double x = 2.0 * a, y = 2.0 * b, of_x = 1.0 - a * a, of_y = 1.0 - b * b;
    double far = sqrt(of_x * of_x * of_y * of_y + x * x * of_y * of_y + y * y * of_x * of_x);
    return atan2(x * y, far);
}

static double cell_angle(int i, int j, int cells)
{
    double a0 = 2.0 * i / cells - 1.0, a1 = 2.0 * (i + 1) / cells - 1.0;
    double b0 = 2.0 * j / cells - 1.0, b1 = 2.0 * (j + 1) / cells - 1.0;
    return corner_angle(a1, b1) - corner_angle(a0, b1) - corner_angle(a1, b0) +
           corner_angle(a0, b0);
}

static double component(vec3 a, double x, double y, double z)
{
    return (double)a.x * x + (double)a.y * y + (double)a.z * z;
}

/* Where the middle of a cell looks, in the sky. */
static double luminance_at(const portal_table *t, const brightness *bright, int i, int j)
{
    double a = (2.0 * i + 1.0) / t->cells - 1.0, b = (2.0 * j + 1.0) / t->cells - 1.0;
    double x = 2.0 * a * (1.0 - b * b), y = 2.0 * b * (1.0 - a * a);
    double z      = (1.0 - a * a) * (1.0 - b * b);
    double east   = component((vec3){ t->u.x, t->v.x, t->outward.x }, x, y, z);
    double north  = component((vec3){ t->u.y, t->v.y, t->outward.y }, x, y, z);
    double up     = component((vec3){ t->u.z, t->v.z, t->outward.z }, x, y, z);
    double around = (atan2(east, north) / M_PI + 1.0) * 0.5 * bright->columns;
    double down   = atan2(hypot(east, north), up) / M_PI * bright->rows;
    int column    = around < bright->columns ? (int)around : bright->columns - 1;
    int row       = down < bright->rows ? (int)down : bright->rows - 1;
    return (double)bright->luminance[(size_t)row * (size_t)bright->columns + (size_t)column];
}

static int cell_of(double x, double z, int cells)
{
    int i = (int)((x / (z + hypot(x, z)) + 1.0) * 0.5 * cells);
    return i < 0 ? 0 : i < cells ? i : cells - 1;
}

/* Adds light from a direction, W/m^2 of so many sr, to the cell that holds it. None that is smaller
 * than the source: there the middle of the cell tells. */
static void add_light(double *light, const double *angles, const portal_table *t,
                      const double from[3], double luminance, double angle)
{
    double ahead = component(t->outward, from[0], from[1], from[2]);
    if (ahead <= 0.0)
        return;
    int i     = cell_of(component(t->u, from[0], from[1], from[2]), ahead, t->cells);
    int j     = cell_of(component(t->v, from[0], from[1], from[2]), ahead, t->cells);
    size_t at = (size_t)j * (size_t)t->cells + (size_t)i;
    if (angle < angles[at])
        light[at] += luminance * angle;
}

static void add_bright(double *light, const double *angles, const portal_table *t,
                       const brightness *bright)
{
    for (int row = 0; row < bright->rows; row++) {
        double top = M_PI * row / bright->rows, bottom = M_PI * (row + 1.0) / bright->rows;
        double angle        = 2.0 * M_PI * (cos(top) - cos(bottom)) / bright->columns;
        double middle       = 0.5 * (top + bottom);
        const float *of_row = bright->luminance + (size_t)row * (size_t)bright->columns;
        for (int column = 0; column < bright->columns; column++) {
            double azimuth = (2.0 * (column + 0.5) / bright->columns - 1.0) * M_PI;
            if ((double)of_row[column] > BRIGHT * bright->mean)
                add_light(light, angles, t,
                          (double[]){ sin(middle) * sin(azimuth), sin(middle) * cos(azimuth),
                                      cos(middle) },
                          (double)of_row[column], angle);
        }
    }
}

/* At least an eighth of what the brightest of the eight around it has by solid angle: where the sun
 * lies across a border, not all of it is on one side. */
static double with_neighbours(const double *light, const double *angle, int i, int j, int cells)
{
    double most = 0.0;
    for (int y = j > 0 ? j - 1 : 0; y <= j + 1 && y < cells; y++)
        for (int x = i > 0 ? i - 1 : 0; x <= i + 1 && x < cells; x++) {
            size_t at = (size_t)y * (size_t)cells + (size_t)x;
            most      = fmax(most, light[at] / angle[at]);
        }
    size_t here = (size_t)j * (size_t)cells + (size_t)i;
    return fmax(light[here], 0.125 * most * angle[here]);
}

static void sum_up(portal_table *t, int32_t *sums, const double *light, const double *angle,
                   double mean)
{
    const int n        = t->cells;
    const size_t width = (size_t)n + 1;
    double total       = 0.0;
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++)
            total += with_neighbours(light, angle, i, j, n);
    t->unit = (float)(total / (mean > 0.0 ? mean : 1.0) / COUNTS);
    for (int j = 0; j < n; j++) {
        int32_t row = 0;
        for (int i = 0; i < n; i++) {
            row += (int32_t)(with_neighbours(light, angle, i, j, n) / total * COUNTS) + 1;
            size_t at = ((size_t)j + 1) * width + (size_t)i + 1;
            sums[at]  = sums[at - width] + row;
        }
    }
    t->sums = sums;
}

bool portal_table_fill(arena *a, portal_table *t, const brightness *bright, lux_error *err)
{
    const size_t n = (size_t)t->cells;
    arena scratch  = { 0 };
    int32_t *sums  = arena_array(a, int32_t, (n + 1) * (n + 1), err);
    double *light  = sums ? arena_array(&scratch, double, 2 * n * n, err) : NULL;
    if (light) {
        double *angle = light + n * n;
        for (size_t at = 0; at < n * n; at++)
            angle[at] = cell_angle((int)(at % n), (int)(at / n), t->cells);
        add_bright(light, angle, t, bright);
        for (size_t at = 0; at < n * n; at++) {
            double y = luminance_at(t, bright, (int)(at % n), (int)(at / n)) + FLOOR * bright->mean;
            light[at] = fmax(light[at], angle[at] * (bright->mean > 0.0 ? y : 1.0));
        }
        sum_up(t, sums, light, angle, bright->mean);
    }
    arena_clear(&scratch);
    return light != NULL;
}
