/* core/table.h -- irregular tables: values at uneven places along each axis, linear in between.
 *
 * A goniodiagram is such a table along two angles, a BRDF along three or four. One axis is found
 * at a time, by binary search in all lanes at once: every lane halves the same range as often, so
 * no lane waits for another; an axis of n places takes ceil(log2 n) steps. Where the places are
 * nearly even, as most laboratories measure, a multiplication finds them instead. No index ever
 * leaves the table, whatever the input: NaN, infinities and dead lanes read a border and come to no
 * harm. At a place of the table its own value comes back exactly.
 */
#ifndef CORE_TABLE_H
#define CORE_TABLE_H

#include "core/error.h"
#include "core/packet.h"

/* Where the values of a table stand along one of its axes. Beyond its ends a table is what it is
 * there; a periodic axis goes from its last place on to its first, one period further. */
typedef struct table_axis {
    const float *at; /* finite, ascending, not owned */
    int count;       /* >= 1 */
    bool periodic;
    float period;  /* > at[count - 1] - at[0], if periodic */
    float density; /* places for each unit, if they are nearly even (table_axis_density); else 0 */
} table_axis;

/* Where each lane is along an axis: `fraction` of the way from place `below` to place `above`. */
typedef struct vtable_place {
    vint below, above; /* 0 ... count - 1 */
    vfloat fraction;   /* [0, 1] */
} vtable_place;

/* Whether *axis is as described above; else false, with *err, which `what` begins. */
bool table_axis_check(const table_axis *axis, const char *what, lux_error *err);

/* What table_axis.density may be: 1 / spacing if every place is within a quarter of the spacing of
 * where even ones would be, around the seam too; else 0. Either way the same cell is found. */
float table_axis_density(const table_axis *axis);

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

#endif
