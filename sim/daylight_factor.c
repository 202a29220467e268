/* sim/daylight_factor.c -- see daylight_factor.h. */
#include "sim/daylight_factor.h"

#include "sky/sky.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Any would do: all is taken by it. */
static const double outside_lx = 10000.0;

static bool is_overcast(const study_sky *k)
{
    bool cie = k->given && k->model == STUDY_SKY_CIE;
    return cie && (k->type == 1 || k->type == 3 || k->type == SKY_TRADITIONAL);
}

const study *daylight_factor_study(arena *a, const study *s, lux_error *err)
{
    study *out = arena_new(a, study, err);
    if (!out)
        return NULL;
    *out          = *s;
    out->when     = (study_when){ .where = s->when.where };
    study_sky *k  = &out->sky;
    k->type       = is_overcast(k) ? k->type : SKY_TRADITIONAL;
    k->given      = true;
    k->model      = STUDY_SKY_CIE;
    k->name       = "overcast";
    k->sun        = STUDY_SUN_OFF;
    k->horizontal = outside_lx;

    k->sun_at_given    = false;
    k->sun_illuminance = (double)NAN;
    return out;
}

const char *daylight_factor_sky(const study *overcast)
{
    switch (overcast->sky.type) {
    case 1:
        return "CIE sky type 1";
    case 3:
        return "CIE sky type 3";
    default:
        return "traditional overcast sky, (1 + 2 sin h)/3";
    }
}

/* ---- figures --------------------------------------------------------------------------------- */

static int by_size(const void *left, const void *right)
{
    double a = *(const double *)left, b = *(const double *)right;
    return (a > b) - (a < b);
}

static double median_of(double *scratch, const double *values, int n)
{
    memcpy(scratch, values, (size_t)n * sizeof *scratch);
    qsort(scratch, (size_t)n, sizeof *scratch, by_size);
    return 0.5 * (scratch[(n - 1) / 2] + scratch[n / 2]);
}

static void summarise(daylight_factor *f, double *scratch, int n)
{
    f->minimum = HUGE_VAL;
    for (int k = 0; k < n; k++) {
        f->average += f->all[k] / n;
        f->average_half_width += f->half_width[k] / n;
        f->average_sky += f->sky[k] / n;
        f->average_external += f->external[k] / n;
        f->average_internal += f->internal[k] / n;
        f->minimum = fmin(f->minimum, f->all[k]);
        f->maximum = fmax(f->maximum, f->all[k]);
        f->share += (f->all[k] >= FACTOR_LEAST) / (double)n;
    }
    f->uniformity = f->average > 0.0 ? f->minimum / f->average : 0.0;
    f->median     = median_of(scratch, f->all, n);
}

bool daylight_factor_of(arena *a, const grid_result *r, daylight_factor *out, lux_error *err)
{
    enum { PARTS = 6 }; /* five results, one scratch */
    size_t n      = (size_t)r->sensor_count;
    double *block = arena_array(a, double, PARTS *n, err);
    if (!block)
        return false;
    *out           = (daylight_factor){ .plan       = r,
                                        .all        = block,
                                        .sky        = block + n,
                                        .external   = block + 2 * n,
                                        .internal   = block + 3 * n,
                                        .half_width = block + 4 * n };
    double percent = 100.0 / outside_lx;
    for (size_t k = 0; k < n; k++) {
        double outside     = r->outside ? fmin(r->outside[k], r->indirect[k]) : 0.0;
        out->sky[k]        = percent * r->direct[k];
        out->external[k]   = percent * outside;
        out->internal[k]   = percent * (r->indirect[k] - outside);
        out->all[k]        = out->sky[k] + out->external[k] + out->internal[k];
        out->half_width[k] = percent * r->half_width[k];
    }
    summarise(out, block + 5 * n, (int)n);
    return true;
}
