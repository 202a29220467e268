/* core/table.c -- see table.h. */
#include "core/table.h"

#include <math.h>

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
