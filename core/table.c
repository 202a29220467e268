/* core/table.c -- see table.h. */
#include "core/table.h"

#include <math.h>

enum { MOST_BINS = 4096 }; /* of an axis: 64 kB */

bool table_axis_check(const table_axis *axis, const char *what, lux_error *err)
{
    if (axis->count < 1)
        return failed(err, ERR_ARGUMENT, "%s: %d places, at least 1 was expected", what,
                      axis->count);
    for (int i = 0; i < axis->count; i++) {
        if (!isfinite(axis->at[i]))
            return failed(err, ERR_ARGUMENT, "%s: place %d is not finite", what, i + 1);
        if (i > 0 && !(axis->at[i] > axis->at[i - 1]))
            return failed(err, ERR_ARGUMENT,
                          "%s: place %d (%g) is not larger than the one before (%g)", what, i + 1,
                          (double)axis->at[i], (double)axis->at[i - 1]);
    }
    float span = axis->at[axis->count - 1] - axis->at[0];
    if (axis->periodic && !(axis->period > span && axis->period < INFINITY))
        return failed(err, ERR_ARGUMENT, "%s: a period of %g, more than %g was expected", what,
                      (double)axis->period, (double)span);
    return true;
}

float table_axis_density(const table_axis *axis)
{
    int cells   = axis->periodic ? axis->count : axis->count - 1;
    double span = axis->periodic ? (double)axis->period
                                 : (double)axis->at[axis->count - 1] - (double)axis->at[0];
    if (cells < 2 || !(span > 0.0))
        return 0.0f;
    for (int i = 0; i < axis->count; i++) {
        double off = ((double)axis->at[i] - (double)axis->at[0]) * cells / span - i;
        if (!(fabs(off) < 0.25))
            return 0.0f;
    }
    return (float)(cells / span);
}

/* The bin of a place, in the packets' own arithmetic: it never falls as x grows. */
static int bin_of(const table_axis *axis, float per_unit, float x)
{
    return (int)((x - axis->at[0]) * per_unit);
}

static bool one_in_each(const table_axis *axis, float per_unit, int cells)
{
    for (int i = 1; i < cells; i++)
        if (bin_of(axis, per_unit, axis->at[i]) == bin_of(axis, per_unit, axis->at[i - 1]))
            return false;
    return true;
}

/* Of `count` bins: place i is the last at or before the begin of the bin, -1 in the first; where
 * none but the end follows it, the one before it, so that no x is beyond the second. */
static void fill_bins(const table_axis *axis, float per_unit, int cells, float end, float *bins,
                      int count)
{
    int i = -1;
    for (int b = 0; b < count; b++) {
        while (i + 2 < cells && bin_of(axis, per_unit, axis->at[i + 1]) < b)
            i++;
        for (int k = 0; k < 3; k++)
            bins[4 * b + k] = i + k < 0 ? axis->at[0] : i + k < cells ? axis->at[i + k] : end;
        bins[4 * b + 3] = (float)i;
    }
}

bool table_axis_bins(table_axis *axis, arena *a, lux_error *err)
{
    axis->bins = NULL;
    int cells  = axis->periodic ? axis->count : axis->count - 1;
    float end  = axis->periodic ? axis->at[0] + axis->period : axis->at[axis->count - 1];
    if (cells < 2)
        return true;

    /* Twice as many until no two places share one */
    float span = end - axis->at[0];
    int tried  = cells;
    while (tried <= MOST_BINS && !one_in_each(axis, (float)tried / span, cells))
        tried *= 2;
    if (tried > MOST_BINS)
        return true;

    float per_unit = (float)tried / span;
    int count      = bin_of(axis, per_unit, end) + 1;
    float *bins    = arena_array(a, float, 4 * (size_t)count, err);
    if (!bins)
        return false;
    fill_bins(axis, per_unit, cells, end, bins, count);
    axis->bins          = bins;
    axis->bins_per_unit = per_unit;
    return true;
}
