/* tests/sky_twin.c -- see sky_twin.h. */
#include "tests/sky_twin.h"

#include <math.h>

double sky_twin_luminance(const sky_twin *s, const double w[3])
{
    switch (s->kind) {
    case TWIN_BLACK:
        return 0.0;
    case TWIN_EVEN:
        return 1.0;
    case TWIN_SMOOTH:
        return 2.0 + w[0] + 0.5 * w[2];
    case TWIN_SUNNY:
        return w[2] > 0.0
                   ? 1.0 + 1000.0 * exp(50.0 * (0.6 * w[0] + 0.64 * w[1] + 0.48 * w[2] - 1.0))
                   : 0.0;
    default:;
        const int columns = s->base.columns, rows = s->base.rows;
        int column = (int)((atan2(w[0], w[1]) / M_PI + 1.0) * 0.5 * columns);
        int row    = (int)(atan2(hypot(w[0], w[1]), w[2]) / M_PI * rows);
        column     = column < columns ? column : columns - 1;
        row        = row < rows ? row : rows - 1;
        return (double)s->pixel[(size_t)row * (size_t)columns + (size_t)column];
    }
}

static vrgb radiance(const sky *self, const vvec3 *wi, vmask active)
{
    const sky_twin *s = (const sky_twin *)self;
    float y[LANES];
    for (int i = 0; i < LANES; i++) {
        double w[3] = { (double)lane(wi->x, i), (double)lane(wi->y, i), (double)lane(wi->z, i) };
        y[i]        = lane(active, i) ? (float)sky_twin_luminance(s, w) : 0.0f;
    }
    return (vrgb){ vload(y), vload(y), vload(y) };
}

static const sky_type twin_type = { "twin", radiance };

sky_twin sky_twin_of(twin_kind kind, const float *pixel, int columns, int rows)
{
    return (sky_twin){ .base  = { .type = &twin_type, .columns = columns, .rows = rows },
                       .kind  = kind,
                       .pixel = pixel };
}
