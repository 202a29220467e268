/* sim/grid_requirements.c -- what a study requires of a grid against what was got: grid.h. */
#include "sim/grid.h"

typedef struct range {
    double got, low, high; /* the truth lies between, as far as half widths tell */
} range;

static range average_of(const grid_result *r)
{
    return (range){ r->average, r->average - r->average_half_width,
                    r->average + r->average_half_width };
}

static range minimum_of(const grid_result *r)
{
    range m = { r->minimum, HUGE_VAL, HUGE_VAL };
    for (int k = 0; k < r->sensor_count; k++) {
        m.low  = fmin(m.low, r->illuminance[k] - r->half_width[k]);
        m.high = fmin(m.high, r->illuminance[k] + r->half_width[k]);
    }
    return m;
}

static range maximum_of(const grid_result *r)
{
    range m = { r->maximum, 0.0, 0.0 };
    for (int k = 0; k < r->sensor_count; k++) {
        m.low  = fmax(m.low, r->illuminance[k] - r->half_width[k]);
        m.high = fmax(m.high, r->illuminance[k] + r->half_width[k]);
    }
    return m;
}

static range uniformity_of(const grid_result *r)
{
    range least = minimum_of(r), mean = average_of(r);
    bool lit = mean.low > 0.0;
    return (range){ r->uniformity, lit ? fmax(least.low, 0.0) / mean.high : 0.0,
                    lit ? fmin(least.high / mean.low, 1.0) : 1.0 };
}

int grid_requirements(const grid_result *r, grid_requirement out[MOST_REQUIREMENTS])
{
    const study_grid *g = r->grid;
    const struct {
        const char *name, *unit;
        double asked;
        range is;
        bool at_most;
    } all[MOST_REQUIREMENTS] = {
        { "average", "lx", g->require_average, average_of(r), false },
        { "minimum", "lx", g->require_minimum, minimum_of(r), false },
        { "maximum", "lx", g->require_maximum, maximum_of(r), true },
        { "uniformity", "", g->require_uniformity, uniformity_of(r), false },
    };
    int count = 0;
    for (int k = 0; k < MOST_REQUIREMENTS; k++) {
        double asked = all[k].asked;
        range is     = all[k].is;
        if (isnan(asked))
            continue;
        out[count++] = (grid_requirement){
            .name       = all[k].name,
            .unit       = all[k].unit,
            .asked      = asked,
            .got        = is.got,
            .half_width = fmax(is.got - is.low, is.high - is.got),
            .met        = all[k].at_most ? is.got <= asked : is.got >= asked,
            .decided    = all[k].at_most ? is.high <= asked || is.low > asked
                                         : is.low >= asked || is.high < asked,
        };
    }
    return count;
}
