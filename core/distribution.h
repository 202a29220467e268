/* core/distribution.h -- drawing from tabulated densities, in all lanes at once.
 *
 * A row is a density that is constant over each of `count` cells of equal width: its cumulative
 * sums cdf[0 ... count], from 0 to exactly 1. Rows stand one after the other in a table; each lane
 * may draw from a row of its own.
 */
#ifndef CORE_DISTRIBUTION_H
#define CORE_DISTRIBUTION_H

#include "core/packet.h"

/* Makes cdf[0 ... count] of weights[0 ... count - 1], finite and >= 0, at least one cell; returns
 * their sum. Where that is 0 all cells weigh the same. Cells of weight 0 are never drawn, else. */
double distribution_make(float *cdf, const double *weights, int count);

/* The cell of the row that begins at cdf[first] that u in [0, 1) falls into; in *rest how far into
 * it, [0, 1), and in *share the cell's probability, > 0. */
static inline vint vdistribution_draw(const float *cdf, vint first, int count, vfloat u,
                                      vfloat *rest, vfloat *share)
{
    vint below = vsplat_int(0);
    for (int left = count; left > 1; left -= left / 2) {
        vint middle = below + left / 2;
        below       = vselect_int(vgather(cdf, first + middle) <= u, middle, below);
    }
    vfloat low = vgather(cdf, first + below);
    *share     = vgather(cdf, first + below + 1) - low;
    *rest      = vmin(vmax((u - low) / *share, vsplat(0.0f)), vsplat(0x1.fffffep-1f));
    return below;
}

#endif
