/* core/bsp_clip.c -- see bsp.h. Sutherland and Hodgman, "Reentrant polygon clipping", 1974. */
#include "core/bsp.h"

#include <string.h>

enum { MOST_CORNERS = 9 }; /* 3, and one more for each side of the cell */

/* Keeps what of the polygon has side * p[axis] <= side * at. In double precision a corner on
 * the plane is off by far less than the width that rays give to planes. */
static int cut(double polygon[][3], int n, int axis, double at, double side)
{
    double kept[MOST_CORNERS + 1][3];
    int out = 0;
    for (int i = 0; i < n; i++) {
        const double *p = polygon[i], *q = polygon[i + 1 < n ? i + 1 : 0];
        double over_p = side * (p[axis] - at), over_q = side * (q[axis] - at);
        if (over_p <= 0.0)
            memcpy(kept[out++], p, sizeof *kept);
        if ((over_p < 0.0 && over_q > 0.0) || (over_p > 0.0 && over_q < 0.0)) {
            double s = over_p / (over_p - over_q);
            for (int k = 0; k < 3; k++)
                kept[out][k] = k == axis ? at : p[k] + s * (q[k] - p[k]);
            out++;
        }
        if (out >= MOST_CORNERS) /* a convex polygon gains one a plane: only rounding gets here */
            break;
    }
    memcpy(polygon, kept, (size_t)out * sizeof *kept);
    return out;
}

static float clamped(double a, float low, float high)
{
    float f = (float)a;
    return f < low ? low : f > high ? high : f;
}

bool bsp_clip(const float *corners, const bsp_box *cell, bsp_box *part)
{
    double polygon[MOST_CORNERS + 1][3];
    for (int i = 0; i < 9; i++)
        polygon[i / 3][i % 3] = (double)corners[i];

    int n = 3;
    for (int axis = 0; axis < 3; axis++) {
        float least = corners[axis], most = corners[axis];
        for (int i = 3 + axis; i < 9; i += 3) {
            least = corners[i] < least ? corners[i] : least;
            most  = corners[i] > most ? corners[i] : most;
        }
        if (least < cell->low[axis])
            n = cut(polygon, n, axis, (double)cell->low[axis], -1.0);
        if (most > cell->high[axis])
            n = cut(polygon, n, axis, (double)cell->high[axis], 1.0);
    }
    if (n == 0)
        return false;

    for (int axis = 0; axis < 3; axis++) {
        double least = polygon[0][axis], most = least;
        for (int i = 1; i < n; i++) {
            least = polygon[i][axis] < least ? polygon[i][axis] : least;
            most  = polygon[i][axis] > most ? polygon[i][axis] : most;
        }
        part->low[axis]  = clamped(least, cell->low[axis], cell->high[axis]);
        part->high[axis] = clamped(most, cell->low[axis], cell->high[axis]);
    }
    return true;
}
