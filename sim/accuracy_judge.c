/* sim/accuracy_judge.c -- between rounds: how far off each unknown may be, and who needs more. */
#include "sim/accuracy_parts.h"

#include <math.h>
#include <stdlib.h>

/* 97.5 % quantile of Student's t by degrees of freedom (Abramowitz and Stegun, table 26.10) */
static const double student_t[SCRAMBLES] = { HUGE_VAL, 12.7062, 4.3027, 3.1824, 2.7764, 2.5706,
                                             2.4469,   2.3646,  2.3060, 2.2622, 2.2281, 2.2010,
                                             2.1788,   2.1604,  2.1448, 2.1314 };

/* Correlation of 16 pairs that is no chance. */
static const double believed = 0.9;

static size_t at(const accuracy_state *s, int channel, int item)
{
    return (size_t)channel * (size_t)s->d->items + (size_t)item;
}

static double value_of(const accuracy_state *s, int channel, int item)
{
    double n   = s->r->samples[item];
    bool known = s->d->exact && channel < s->judged;
    return (known ? s->d->exact[at(s, channel, item)] : 0.0) +
           (n > 0 ? s->total[at(s, channel, item)] / n : 0.0);
}

double accuracy_half_width(const double *values, int count, double *mean)
{
    double squares = 0.0;
    *mean          = 0.0;
    for (int r = 0; r < count; r++)
        *mean += values[r] / count;
    for (int r = 0; r < count; r++)
        squares += (values[r] - *mean) * (values[r] - *mean);
    return count < 2 ? HUGE_VAL : student_t[count - 1] * sqrt(squares / (count - 1) / count);
}

/* Adds what each scramble says of an item, times `weight`. False if it has no samples. */
static bool add_scrambles(const accuracy_state *s, int channel, int item, double weight,
                          double of[SCRAMBLES])
{
    const float *part = s->parts[(size_t)item * (size_t)s->spread + (size_t)channel].sum;
    double n          = (double)s->r->samples[item] / s->scrambles;
    for (int r = 0; n > 0.0 && r < s->scrambles; r++)
        of[r] += weight * (double)part[r] / n;
    return n > 0.0;
}

/* From the item's own scrambles alone. */
static double own_half_width(const accuracy_state *s, int channel, int item)
{
    double of[SCRAMBLES] = { 0 }, ignored;
    bool any             = add_scrambles(s, channel, item, 1.0, of);
    return any ? accuracy_half_width(of, s->scrambles, &ignored) : HUGE_VAL;
}

/* Of the mean half width: by how much more the mean of many may be off than their spread tells, as
 * each has stopped as soon as it seemed sure. Measured: 0.023 in a room, 0.034 with its lamp close
 * to the ceiling, less in a bright cavity and by a window. */
static const double stopping = 0.05;

void accuracy_judge_average(const accuracy_state *s)
{
    int items = s->d->items;
    for (int q = 0; q < s->spread; q++) {
        double of[SCRAMBLES] = { 0 }, squares = 0.0, sum = 0.0, ignored;
        for (int i = 0; i < items; i++) {
            bool bounded = s->d->bound && q < s->judged;
            double bound = bounded ? s->d->bound[at(s, q, i)] : 0.0;
            double own   = s->r->half_width[at(s, q, i)] - bound;
            add_scrambles(s, q, i, 1.0 / items, of);
            squares += own * own;
            sum += own;
        }
        double spread =
            fmax(accuracy_half_width(of, s->scrambles, &ignored), sqrt(squares) / items);
        s->r->of_average[q] = fmin(spread + stopping * sum / items, sum / items);
    }
}

static double floor_of(const accuracy_state *s, int channel)
{
    double sum = 0.0, count = 0.0;
    bool geometric = s->d->floor == FLOOR_LOG_MEAN;
    for (int i = 0; i < s->d->items; i++) {
        double value = fabs(value_of(s, channel, i));
        if (geometric && !(value > 0.0))
            continue;
        sum += geometric ? log(value) : value;
        count += 1.0;
    }
    if (count == 0.0)
        return 0.0;
    return 0.1 * (geometric ? exp(sum / count) : sum / count);
}

/* What the accuracy asked for is relative to. */
static double against_of(const accuracy_state *s, int channel, int item)
{
    bool own     = channel < 2 || s->d->apart || channel >= s->judged;
    double floor = s->floors[own ? channel : 1];
    return fmax(fabs(value_of(s, channel, item)), floor);
}

/* A half width against that. */
static double ratio_of(const accuracy_state *s, int channel, int item)
{
    double half = s->r->half_width[at(s, channel, item)];
    return half == 0.0 ? 0.0 : half / against_of(s, channel, item); /* infinite if that is 0 */
}

/* An item is looked at after each round that it takes part in. */
static void look_at(const accuracy_state *s, int channel, int item)
{
    double n = s->r->samples[item], half = s->r->half_width[at(s, channel, item)];
    look *l = &s->looks[(size_t)item * (size_t)s->spread + (size_t)channel];
    if (s->rounds > 0 && l->samples != s->r->samples[item])
        *l = (look){ l->now, (float)(n * half * half), l->common, s->r->samples[item] };
}

/* The square of the half width that an item would have if its samples were as alike as those of the
 * others (pool: n ratio^2), or as they were at the look before, if that is more. */
static double others_square(const accuracy_state *s, int channel, int item, double pool)
{
    double n = s->r->samples[item], against = against_of(s, channel, item);
    const look *l = &s->looks[(size_t)item * (size_t)s->spread + (size_t)channel];
    return n > 0.0 ? fmax(pool * against * against, (double)l->before) / n : 0.0;
}

/* Half widths of all items: their own, widened where an item seems surer than the others are on
 * average for as many samples, or than it was itself. Its samples may just have missed what is rare
 * and bright. */
static void estimate_half_widths(accuracy_state *s, int channel)
{
    double pool = 0.0, count = 0.0; /* mean of n ratio^2 */
    double *half = s->r->half_width + at(s, channel, 0);
    for (int i = 0; i < s->d->items; i++) {
        half[i] = own_half_width(s, channel, i);
        look_at(s, channel, i);
        double ratio = ratio_of(s, channel, i);
        if (!(ratio < HUGE_VAL)) /* or is no number */
            continue;
        pool += s->r->samples[i] * ratio * ratio;
        count += 1.0;
    }
    pool = count > 0.0 ? pool / count : 0.0;
    for (int i = 0; i < s->d->items; i++) {
        double own = half[i] * half[i], others = others_square(s, channel, i, pool);
        if (own < others)
            half[i] = sqrt(0.5 * (own + others));
        half[i] += s->d->bound && channel < s->judged ? s->d->bound[at(s, channel, i)] : 0.0;
    }
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The channels that are held to the accuracy begin here. */
static int first_held(const accuracy_state *s) { return s->judged > 1 && !s->d->apart ? 1 : 0; }

static double share_of(const accuracy_state *s, int channel)
{
    return channel && !s->d->apart ? PARTS_SHARE : 1.0;
}

/* No sample found anything, and they are too few to say that there is nothing: the spread of
 * zeros is 0, and would be taken for certainty. */
static bool is_in_doubt(const accuracy_state *s, int channel, int item)
{
    return s->total[at(s, channel, item)] == 0.0 &&
           s->r->samples[item] < (uint64_t)SCRAMBLES * (uint64_t)s->d->dark_samples;
}

/* The worst of an item's channels, against what is asked of each. */
static double worst_ratio(const accuracy_state *s, int item)
{
    double worst = 0.0;
    for (int q = first_held(s); q < s->judged; q++) {
        double ratio = is_in_doubt(s, q, item) ? HUGE_VAL : ratio_of(s, q, item) / share_of(s, q);
        worst        = ratio <= worst ? worst : ratio; /* no number is no certainty */
    }
    return isnan(worst) ? HUGE_VAL : worst;
}

/* What of its half width stays however many samples follow (accuracy.h). */
static double common_half_width(const accuracy_state *s, int channel, int item, double half)
{
    double r = (double)s->looks[(size_t)item * (size_t)s->spread + (size_t)channel].common;
    return r > believed ? half * sqrt(2.0 * r / (1.0 + r)) : 0.0;
}

/* Whether more samples may make the item good: what is left out of them alone does not spoil it,
 * nor what stays as it is, which they come close to slowly. */
static bool can_be_good(const accuracy_state *s, int item)
{
    const double most_fixed = 0.9; /* then the rest of the square is a fifth */
    const accuracy_desc *d  = s->d;
    bool can                = true;
    for (int q = first_held(s); q < s->judged; q++) {
        double asked = share_of(s, q) * d->accuracy * against_of(s, q, item);
        double bound = d->bound ? d->bound[at(s, q, item)] : 0.0;
        double fixed = d->fixed ? d->fixed[at(s, q, item)] : 0.0;
        double half  = s->r->half_width[at(s, q, item)] - bound;
        can          = can && bound <= asked && fixed <= most_fixed * (asked - bound) &&
              common_half_width(s, q, item, half) <= asked - bound;
    }
    return can;
}

bool accuracy_judge(accuracy_state *s, lux_error *err)
{
    int items      = s->d->items;
    arena scratch  = { 0 };
    double *ratios = arena_array(&scratch, double, (size_t)items, err);
    if (!ratios)
        return false;

    for (int q = 0; q < s->spread; q++) {
        s->floors[q] = floor_of(s, q);
        estimate_half_widths(s, q);
    }
    s->r->floor       = s->floors[0];
    s->r->missed      = 0;
    s->r->complete    = true;
    s->active_count   = 0;
    s->samples_before = s->samples_predicted = 0.0;
    for (int i = 0; i < items; i++) {
        double n  = s->r->samples[i];
        ratios[i] = worst_ratio(s, i);
        s->samples_before += n;
        s->samples_predicted += n;
        if (n == 0.0 || s->scrambles < 2)
            s->r->complete = false;
        bool missed = n == 0.0 || !(ratios[i] <= s->d->accuracy);
        s->r->missed += missed;
        if ((missed && can_be_good(s, i)) || s->rounds < LEAST_ROUNDS) {
            double more = fmin(ratios[i] / s->d->accuracy, 1e3);
            s->samples_predicted += fmax(n, n * (more * more - 1.0));
            s->active[s->active_count++] = i;
        }
    }

    int may_miss = (int)((1.0 - s->d->needed) * items + 1e-9);
    qsort(ratios, (size_t)items, sizeof *ratios, compare);
    s->reached = s->r->reached = ratios[items - 1 - may_miss];
    bool enough = s->rounds >= LEAST_ROUNDS && s->r->complete && s->r->missed <= may_miss;
    bool over   = s->rounds >= LEAST_ROUNDS && s->active_count == 0; /* those left are held up */
    s->r->end   = enough ? RUN_DONE : over ? RUN_HELD_UP : RUN_EXHAUSTED; /* if nothing else does */
    arena_clear(&scratch);
    return true;
}
