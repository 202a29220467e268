/* sim/cost_figures.c -- errors of runs against a reference, a slope through them, and advice.
 *
 * The formulae stand in cost.h. A half width is t times a standard error, with t = 2.1314 the
 * 97.5 % quantile of Student's distribution of 15 degrees of freedom, as accuracy.h has 16
 * scrambles.
 */
#include "sim/cost_parts.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const double student_t = 2.1314;

static const double usual_slope = -0.5; /* of plain Monte Carlo, where none is known */
static const double least_slope = -0.1; /* one that is flatter was not measured but is chance */
static const double one_percent = 0.01;
static const double enough      = 0.95; /* the share of the sensors that is promised */

static const double surely = 2.0; /* standard errors */

/* Below this share of the reference's own noise an error is not told apart from none. */
static const double told_apart = 0.5;

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double cost_median(const double *x, int n)
{
    double sorted[COST_RUNS];
    n = n < COST_RUNS ? n : COST_RUNS;
    for (int i = 0; i < n; i++)
        sorted[i] = x[i];
    qsort(sorted, (size_t)n, sizeof *sorted, compare);
    return 0.5 * (sorted[(n - 1) / 2] + sorted[n / 2]);
}

double cost_slope(const double *x, const double *y, int n)
{
    double count = 0.0, mean_x = 0.0, mean_y = 0.0, xx = 0.0, xy = 0.0;
    for (int i = 0; i < n; i++)
        if (x[i] > 0.0 && y[i] > 0.0)
            count += 1.0, mean_x += log(x[i]), mean_y += log(y[i]);
    mean_x /= fmax(count, 1.0), mean_y /= fmax(count, 1.0);
    for (int i = 0; i < n; i++)
        if (x[i] > 0.0 && y[i] > 0.0) {
            double dx = log(x[i]) - mean_x;
            xx += dx * dx;
            xy += dx * (log(y[i]) - mean_y);
        }
    return xx > 1e-12 ? xy / xx : (double)NAN;
}

/* ---- errors ---------------------------------------------------------------------------------- */

/* What the error of sensor i is relative to. */
static double against(const cost_sample *reference, int i)
{
    return fmax((double)reference->value[i], reference->floor);
}

/* 0 / 0 where all is dark: no error. */
static double relative(double x, double to) { return x == 0.0 ? 0.0 : x / to; }

static double error_of(const cost_sample *run, const cost_sample *reference, int i)
{
    return relative((double)run->value[i] - (double)reference->value[i], against(reference, i));
}

static double noise_of(const cost_sample *reference, int i)
{
    return relative((double)reference->half_width[i], against(reference, i)) / student_t;
}

double cost_half_width(const cost_sample *of, const cost_sample *reference)
{
    double squares = 0.0;
    for (int i = 0; i < of->count; i++) {
        double half = relative((double)of->half_width[i], against(reference, i));
        squares += half * half;
    }
    double mean = squares / of->count;
    return isfinite(mean) ? sqrt(mean) : (double)NAN;
}

/* Means over all sensors. */
typedef struct error_sums {
    double squares;            /* of errors, over runs too */
    double between;            /* variances between runs; NAN of one run */
    double reference;          /* squares of the reference's standard error */
    double bias, bias_squared; /* what a sensor says of the square of the bias; its square */
    double within, promised;
} error_sums;

static void add_sensor(const cost_sample *runs, int count, const cost_sample *reference,
                       double asked, int i, error_sums *s, cost_row *out)
{
    double e[COST_RUNS], mean = 0.0, squares = 0.0, own = noise_of(reference, i);
    for (int k = 0; k < count; k++) {
        e[k] = error_of(&runs[k], reference, i);
        mean += e[k] / count;
        double worst = sqrt(fmax(e[k] * e[k] - own * own, 0.0));
        double half  = relative((double)runs[k].half_width[i], against(reference, i));
        out->worst   = fmax(out->worst, worst);
        s->squares += e[k] * e[k] / count;
        s->within += (fabs(e[k]) <= asked) / (double)count;
        s->promised += (half <= asked) / (double)count;
    }
    for (int k = 0; k < count; k++)
        squares += (e[k] - mean) * (e[k] - mean);
    double between = squares / (count - 1), bias = mean * mean - between / count - own * own;
    s->between += between;
    s->bias += bias;
    s->bias_squared += bias * bias;
    s->reference += own * own;
}

static double root(double square) { return sqrt(fmax(square, 0.0)); }

/* Of the mean of what n sensors say, and none where that is no more than their spread explains: a
 * few wild pixels of few rays are no bias. */
static double bias_of(const error_sums *s, int n)
{
    double mean     = s->bias / n;
    double variance = fmax(s->bias_squared / n - mean * mean, 0.0) / fmax(n - 1, 1.0);
    return mean > surely * sqrt(variance) ? root(mean) : 0.0;
}

void cost_row_figures(const cost_sample *runs, int count, const cost_sample *reference,
                      double asked, cost_row *out)
{
    double seconds[COST_RUNS], rays[COST_RUNS], squares = 0.0;
    error_sums s = { 0 };
    out->worst   = 0.0;
    out->runs    = count;
    for (int k = 0; k < count; k++) {
        double half = cost_half_width(&runs[k], reference);
        squares += half * half / count;
        seconds[k] = runs[k].seconds;
        rays[k]    = (double)runs[k].rays;
    }
    for (int i = 0; i < reference->count; i++)
        add_sensor(runs, count, reference, asked, i, &s, out);

    double n = reference->count, least = told_apart * told_apart * s.reference / n;
    out->half_width = sqrt(squares);
    out->seconds    = cost_median(seconds, count);
    out->rays       = (int64_t)llround(cost_median(rays, count));
    out->rms        = root(fmax((s.squares - s.reference) / n, least));
    out->noise      = count > 1 ? root(s.between / n) : fmin(out->half_width / student_t, out->rms);
    out->bias       = count > 1 ? bias_of(&s, reference->count)
                                : root(out->rms * out->rms - out->noise * out->noise);
    out->within     = s.within / n;
    out->reaches    = out->within >= enough;
    out->promises   = s.promised / n >= enough;
}

/* ---- what follows ---------------------------------------------------------------------------- */

double cost_seconds_for_1(const cost_row *r, double slope)
{
    double left = one_percent * one_percent - r->bias * r->bias;
    if (!(left > 0.0))
        return (double)NAN;
    slope = slope < least_slope ? slope : usual_slope;
    if (!(r->noise > 0.0))
        return r->seconds;
    return r->seconds * pow(r->noise / sqrt(left), -1.0 / slope);
}

/* The slope of the ladder; rungs that took the same samples count once. */
static double slope_of(const cost_row *rows, int count)
{
    double x[COST_MOST_SETTINGS], y[COST_MOST_SETTINGS];
    int n = 0;
    for (int i = 0; i < count && n < COST_MOST_SETTINGS; i++)
        if (rows[i].ladder == COST_ACCURACY && !(n && x[n - 1] == (double)rows[i].rays))
            x[n] = (double)rows[i].rays, y[n++] = rows[i].rms;
    return cost_slope(x, y, n);
}

/* Settings that a user can choose. */
static bool is_choice(const cost_row *r)
{
    return r->ladder == COST_ACCURACY || r->ladder == COST_TRANSPORT || r->ladder == COST_EFFECTS;
}

/* Another way than the usual one is to be told from it by more than noise. */
static double weighed_seconds(const cost_row *r)
{
    return r->ladder == COST_ACCURACY ? r->seconds : 1.3 * r->seconds;
}

/* The cheapest that reaches the study's accuracy and, if `promised`, says so itself; NULL. */
static const cost_row *cheapest(const cost_row *rows, int count, bool promised)
{
    const cost_row *best = NULL;
    for (int i = 0; i < count; i++) {
        const cost_row *r = &rows[i];
        bool good         = is_choice(r) && r->reaches && (!promised || r->promises);
        if (good && (!best || weighed_seconds(r) < weighed_seconds(best)))
            best = r;
    }
    return best;
}

static void advise(const cost_row *rows, cost_result *r)
{
    const cost_row *first = cheapest(rows, r->row_count, false);
    const cost_row *sure  = cheapest(rows, r->row_count, true);
    const cost_row *best  = NULL;
    double asked          = 100.0 * r->asked;
    for (int i = 0; i < r->row_count; i++)
        if (is_choice(&rows[i]) && (!best || rows[i].within > best->within))
            best = &rows[i];
    if (sure && sure == first)
        snprintf(r->advice, sizeof r->advice,
                 "%s is the cheapest setting that meets %g %%: %.2g s, %.0f %% of the %s within it",
                 sure->setting, asked, sure->seconds, floor(100.0 * sure->within),
                 r->view ? "pixels" : "sensors");
    else if (first && sure)
        snprintf(r->advice, sizeof r->advice,
                 "%s is the cheapest setting that meets %g %% (%.2g s), though its intervals do "
                 "not say so; %s is the cheapest whose intervals do (%.2g s)",
                 first->setting, asked, first->seconds, sure->setting, sure->seconds);
    else if (first)
        snprintf(r->advice, sizeof r->advice,
                 "%s is the cheapest setting that meets %g %% (%.2g s), though its intervals do "
                 "not say so, nor do others",
                 first->setting, asked, first->seconds);
    else if (best)
        snprintf(r->advice, sizeof r->advice,
                 "no setting met %g %% in the time given; %s came nearest: %.0f %% of the %s "
                 "within it after %.2g s",
                 asked, best->setting, floor(100.0 * best->within), r->view ? "pixels" : "sensors",
                 best->seconds);
}

void cost_conclude(cost_row *rows, cost_result *r)
{
    r->slope = slope_of(rows, r->row_count);
    for (int i = 0; i < r->row_count; i++)
        rows[i].seconds_for_1 = cost_seconds_for_1(&rows[i], r->slope);
    advise(rows, r);
}
