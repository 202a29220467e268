/* sim/grid_requirements.c -- what a study requires of a grid against what was got: grid.h. */
#include "sim/grid.h"

/* Student's distribution of SCRAMBLES - 1 = 15 degrees of freedom: the probability of |t| or less
 * (Abramowitz and Stegun, 26.7.3, for an odd number of degrees). */
static double within_t15(double t)
{
    double angle = atan(t / sqrt(15.0)), c = cos(angle), term = c, sum = c;
    for (int k = 3; k < 15; k += 2) {
        term *= (k - 1.0) / k * c * c;
        sum += term;
    }
    return 2.0 / M_PI * (angle + sin(angle) * sum);
}

/* By how much wider the intervals of n sensors are that hold all their values at once with 95 %,
 * than those that hold each (Bonferroni): of the smallest of many it is the unluckiest that counts.
 */
static double widening(int n)
{
    double each = 1.0 - 0.05 / n, low = 2.0, high = 1e3;
    for (int step = 0; step < 60; step++) {
        double t = 0.5 * (low + high);
        if (within_t15(t) < each)
            low = t;
        else
            high = t;
    }
    return high / 2.131450; /* t of 97.5 % */
}

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
    range m     = { r->minimum, HUGE_VAL, HUGE_VAL };
    double wide = widening(r->sensor_count);
    for (int k = 0; k < r->sensor_count; k++) {
        m.low  = fmin(m.low, r->illuminance[k] - wide * r->half_width[k]);
        m.high = fmin(m.high, r->illuminance[k] + wide * r->half_width[k]);
    }
    return m;
}

static range maximum_of(const grid_result *r)
{
    range m     = { r->maximum, 0.0, 0.0 };
    double wide = widening(r->sensor_count);
    for (int k = 0; k < r->sensor_count; k++) {
        m.low  = fmax(m.low, r->illuminance[k] - wide * r->half_width[k]);
        m.high = fmax(m.high, r->illuminance[k] + wide * r->half_width[k]);
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
