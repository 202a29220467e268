/* core/table.h -- irregular tables: values at uneven places along each axis, linear in between.
 *
 * A goniodiagram is such a table along two angles, a BRDF along three or four. One axis is found
 * at a time, by binary search in all lanes at once: every lane halves the same range as often, so
 * no lane waits for another; an axis of n places takes ceil(log2 n) steps. Where the places are
 * nearly even, as most laboratories measure, a multiplication finds them instead. However uneven
 * they are, bins do: even ones, so many that none holds two places, each of which knows the three
 * places that its x may lie between, as one 16-byte load.
 *
 *     places   |     |   |              |
 *     bins     |   |   |   |   |   |   |   |     in each the last place at or before its begin,
 *                                                and the two behind that
 *
 * No index ever leaves the table, whatever the input: NaN, infinities and dead lanes read a border
 * and come to no harm. At a place of the table its own value comes back exactly.
 */
#ifndef CORE_TABLE_H
#define CORE_TABLE_H

#include "core/arena.h"
#include "core/packet.h"

/* Where the values of a table stand along one of its axes. Beyond its ends a table is what it is
 * there; a periodic axis goes from its last place on to its first, one period further. */
typedef struct table_axis {
    const float *at; /* finite, ascending, not owned */
    int count;       /* >= 1 */
    bool periodic;
    float period;  /* > at[count - 1] - at[0], if periodic */
    float density; /* places for each unit, if they are nearly even (table_axis_density); else 0 */

    /* Of table_axis_bins; else NULL. Four floats a bin: the places i, i + 1, i + 2, and i */
    const float *bins;
    float bins_per_unit;
} table_axis;

/* Where each lane is along an axis: `fraction` of the way from place `below` to place `above`. */
typedef struct vtable_place {
    vint below, above; /* 0 ... count - 1 */
    vfloat fraction;   /* [0, 1] */
} vtable_place;

/* Ways of looking up that are worse or slower than the usual ones, to measure what these are worth.
 * Who keeps a table keeps this beside it. */
typedef struct table_measures {
    bool nearest; /* the value at the nearest place, in place of those around */
    bool libm;    /* angles by the C library (core/lane_math.h) */
} table_measures;

/* Whether *axis is as described above; else false, with *err, which `what` begins. */
bool table_axis_check(const table_axis *axis, const char *what, lux_error *err);

/* What table_axis.density may be: 1 / spacing if every place is within a quarter of the spacing of
 * where even ones would be, around the seam too; else 0. Either way the same cell is found. */
float table_axis_density(const table_axis *axis);

/* Gives *axis its bins, made in a; none where more than a few thousand would be needed, or where
 * there is one cell alone. Either way the same cells are found. False, with *err, if there is no
 * memory for them. */
bool table_axis_bins(table_axis *axis, arena *a, lux_error *err);

/* The last place at or before x, for x on the axis; of cells 0 ... cells - 1. */
static inline vint vtable_cell(const table_axis *axis, int cells, vfloat x)
{
    const float *at = axis->at;
    vint below      = vsplat_int(0);
    if (axis->density > 0.0f) { /* a guess that is at most one off */
        vfloat guess = (x - at[0]) * axis->density;
        below        = vto_int(vmin(guess, vsplat((float)(cells - 1))));
        vint next    = vselect_int(below + 1 < cells, below + 1, below);
        vmask short_ = vgather(at, next) <= x;
        vmask far    = vgather(at, below) > x;
        below        = vselect_int(short_, next, below);
        return vselect_int(far & (below > 0), below - 1, below);
    }
    for (int left = cells; left > 1; left -= left / 2) {
        vint middle = below + left / 2;
        below       = vselect_int(vgather(at, middle) <= x, middle, below);
    }
    return below;
}

/* For x on an axis that has bins. */
static inline vtable_place vtable_find_bin(const table_axis *axis, vfloat x)
{
    vfloat bin[4];
    vgather4(axis->bins, vto_int((x - axis->at[0]) * axis->bins_per_unit), bin);
    vmask second = bin[1] <= x;
    vint below   = vto_int(bin[3]);
    below        = vselect_int(second, below + 1, below);
    vint above   = vselect_int(below + 1 >= axis->count, vsplat_int(0), below + 1);
    vfloat low   = vselect(second, bin[1], bin[0]);
    vfloat high  = vselect(second, bin[2], bin[1]);
    vfloat share = (x - low) / (high - low);
    return (vtable_place){ below, above, vmin(vmax(share, vsplat(0.0f)), vsplat(1.0f)) };
}

/* Finds x in each lane. Along a periodic axis x may be up to a period outside of
 * [at[0], at[0] + period]; what is farther out is taken at the border. */
static inline vtable_place vtable_find(const table_axis *axis, vfloat x)
{
    const float *at = axis->at;
    int count       = axis->count;
    float first     = at[0];
    float end       = axis->periodic ? first + axis->period : at[count - 1];

    /* Onto the axis: the operand order of vmax drops NaN */
    if (axis->periodic) {
        x = vselect(x < first, x + axis->period, x);
        x = vselect(x >= end, x - axis->period, x);
    }
    x = vmin(vmax(x, vsplat(first)), vsplat(end));
    if (axis->bins)
        return vtable_find_bin(axis, x);

    /* The last place at or before x, but not the last of all where nothing follows it */
    int cells  = axis->periodic || count == 1 ? count : count - 1;
    vint below = vtable_cell(axis, cells, x);

    /* The next one, perhaps around the seam, and how far it is */
    vmask last   = below + 1 >= count;
    vint above   = vselect_int(last, vsplat_int(0), below + 1);
    vfloat low   = vgather(at, below);
    vfloat high  = vselect(last, vsplat(end), vgather(at, above));
    vfloat share = (x - low) / (high - low);
    return (vtable_place){ below, above, vmin(vmax(share, vsplat(0.0f)), vsplat(1.0f)) };
}

/* The nearer one of the two places alone. */
static inline vtable_place vtable_nearest(vtable_place p)
{
    p.fraction = vkeep(p.fraction >= 0.5f, vsplat(1.0f));
    return p;
}

/* The value at two places, of values[first * count of the second axis + second]. */
static inline vfloat vtable_blend2(const float *values, int second_count, vtable_place first,
                                   vtable_place second)
{
    vint row0 = first.below * second_count;
    vint row1 = first.above * second_count;
    vfloat a  = vlerp(vgather(values, row0 + second.below), vgather(values, row0 + second.above),
                      second.fraction);
    vfloat b  = vlerp(vgather(values, row1 + second.below), vgather(values, row1 + second.above),
                      second.fraction);
    return vlerp(a, b, first.fraction);
}

/* Both at once: values[i * axes[1].count + j] stands at (axes[0].at[i], axes[1].at[j]). */
static inline vfloat vtable_lookup2(const float *values, const table_axis axes[2], vfloat x,
                                    vfloat y)
{
    return vtable_blend2(values, axes[1].count, vtable_find(&axes[0], x), vtable_find(&axes[1], y));
}

/* ---- four values a place, side by side: one load a corner, each lane blended by itself --------
 */

/* What blends a table's corners: rows[r] + columns[c], in floats, and what each weighs. */
typedef struct vtable_corners {
    vint rows[4], columns[4];
    vfloat row_weights[4], column_weights[4];
} vtable_corners;

/* The two last axes, of row_size = second_count * 4 floats. */
static inline void vtable_columns(vtable_corners *k, int second_count, const vtable_place p[2])
{
    vfloat f = p[0].fraction, g = p[1].fraction;
    vint low             = 4 * second_count * p[0].below;
    vint high            = 4 * second_count * p[0].above;
    k->columns[0]        = low + 4 * p[1].below;
    k->columns[1]        = low + 4 * p[1].above;
    k->columns[2]        = high + 4 * p[1].below;
    k->columns[3]        = high + 4 * p[1].above;
    k->column_weights[0] = (1.0f - f) * (1.0f - g);
    k->column_weights[1] = (1.0f - f) * g;
    k->column_weights[2] = f * (1.0f - g);
    k->column_weights[3] = f * g;
}

/* `rows` is 2 or 4, a constant. */
static inline void vtable_blend_corners(const float *values, const vtable_corners *k, int rows,
                                        vfloat out[4])
{
    int32_t row[4][LANES], column[4][LANES];
    float row_weight[4][LANES], column_weight[4][LANES];
    for (int r = 0; r < rows; r++) {
        vstore_int(row[r], k->rows[r]);
        vstore(row_weight[r], k->row_weights[r]);
    }
    for (int c = 0; c < 4; c++) {
        vstore_int(column[c], k->columns[c]);
        vstore(column_weight[c], k->column_weights[c]);
    }

    float4 sums[LANES];
    for (int i = 0; i < LANES; i++) {
        float4 of[4];
        for (int c = 0; c < 4; c++) {
            const float *corner = values + column[c][i];
            of[c]               = float4_scale(float4_load(corner + row[0][i]), row_weight[0][i]);
            for (int r = 1; r < rows; r++)
                of[c] = float4_add(of[c],
                                   float4_scale(float4_load(corner + row[r][i]), row_weight[r][i]));
            of[c] = float4_scale(of[c], column_weight[c][i]);
        }
        sums[i] = float4_add(float4_add(of[0], of[1]), float4_add(of[2], of[3]));
    }
    vturn4(sums, out);
}

/* Four values at once of three axes: values[4 * ((i * axes[1].count + j) * axes[2].count + k)] and
 * the three behind it stand at (axes[0].at[i], axes[1].at[j], axes[2].at[k]); values are on a
 * multiple of 16 bytes, at most 2^29 places. */
static inline void vtable_fours3(const float *values, const table_axis axes[3],
                                 const vtable_place p[3], vfloat out[4])
{
    int size = 4 * axes[1].count * axes[2].count;
    vtable_corners k;
    k.rows[0]        = size * p[0].below;
    k.rows[1]        = size * p[0].above;
    k.row_weights[0] = 1.0f - p[0].fraction;
    k.row_weights[1] = p[0].fraction;
    vtable_columns(&k, axes[2].count, p + 1);
    vtable_blend_corners(values, &k, 2, out);
}

/* The same of four axes. */
static inline void vtable_fours4(const float *values, const table_axis axes[4],
                                 const vtable_place p[4], vfloat out[4])
{
    int size = 4 * axes[2].count * axes[3].count;
    vtable_corners k;
    vfloat f = p[0].fraction, g = p[1].fraction;
    vint low         = axes[1].count * p[0].below;
    vint high        = axes[1].count * p[0].above;
    k.rows[0]        = size * (low + p[1].below);
    k.rows[1]        = size * (low + p[1].above);
    k.rows[2]        = size * (high + p[1].below);
    k.rows[3]        = size * (high + p[1].above);
    k.row_weights[0] = (1.0f - f) * (1.0f - g);
    k.row_weights[1] = (1.0f - f) * g;
    k.row_weights[2] = f * (1.0f - g);
    k.row_weights[3] = f * g;
    vtable_columns(&k, axes[3].count, p + 2);
    vtable_blend_corners(values, &k, 4, out);
}

#endif
