/* sim/accuracy.c -- see accuracy.h. */
#include "sim/accuracy.h"

#include "core/parallel.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* Quantile of Student's t with 15 degrees of freedom at 1 - 0.035 / 2: see accuracy.h */
static const double student_t = 2.317770;
_Static_assert(SCRAMBLES == 16, "student_t is that of 15 degrees of freedom");

/* Items so few that threads would lie idle are split by scramble where they need many samples. */
enum { FEW_ITEMS = 1024 };

typedef struct by_scramble {
    float sum[SCRAMBLES]; /* of channel 0 */
} by_scramble;

typedef struct run_state {
    const accuracy_desc *d;
    accuracy_result *r;
    double *total;      /* items * channels, channel by channel */
    by_scramble *parts; /* an item */
    float *values;      /* a thread: MOST_CHANNELS * BUNDLE */

    /* This round: n new samples for each scramble of the active items, beginning with number
     * `first`. Work is handed out as `together` items at a time or, if pieces > 1, as one item's
     * scrambles in that many pieces. */
    int *active, active_count, together, pieces;
    uint32_t n, first;
    double *new_total;       /* (piece * active_count + j) * channels + channel */
    by_scramble *new_parts;  /* an active item */
    atomic_int *pieces_done; /* an active item */
    bool may_cut;            /* the deadline counts: not in the first round */
    atomic_llong samples_done;
    double samples_before, samples_predicted, reached;
    volatile bool halt;
} run_state;

double clock_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* ---- one round: samples ------------------------------------------------------------------------
 */

/* Adds the values of samples begin .. end - 1, which are of one scramble of one item. */
static void add_set(run_state *s, const float *values, int begin, int end, double *total,
                    float *part)
{
    for (int c = 0; c < s->d->channels; c++) {
        double sum = 0.0;
        for (int i = begin; i < end; i++)
            sum += (double)values[c * BUNDLE + i];
        total[c] += sum;
        if (c == 0)
            *part = (float)((double)*part + sum);
    }
}

/* Scrambles r0 .. r1 - 1 of active items j0 .. j1 - 1, all of them together at most a bundle, or
 * a bundle of one scramble after the other. */
static void sample_sets(run_state *s, int thread, int j0, int j1, int r0, int r1, double *totals)
{
    float *values = s->values + (size_t)thread * MOST_CHANNELS * BUNDLE;
    sample_id ids[BUNDLE];
    uint32_t step = s->n < BUNDLE ? s->n : BUNDLE; /* samples of a set in one bundle */
    int sets = (j1 - j0) * (r1 - r0), room = BUNDLE / (int)step;

    for (int from = 0; from < sets; from += room) {
        int to = from + room < sets ? from + room : sets;
        for (uint32_t k = 0; k < s->n; k += step) {
            int count = 0;
            for (int set = from; set < to; set++)
                for (uint32_t i = 0; i < step; i++)
                    ids[count++] = (sample_id){
                        .item     = (uint32_t)s->active[j0 + set / (r1 - r0)],
                        .scramble = (uint32_t)(r0 + set % (r1 - r0)),
                        .index    = s->first + k + i,
                    };
            s->d->sample(s->d->context, thread, ids, count, values);
            for (int set = from; set < to; set++) {
                int j = j0 + set / (r1 - r0), r = r0 + set % (r1 - r0),
                    at = (set - from) * (int)step;
                add_set(s, values, at, at + (int)step,
                        totals + (size_t)(j - j0) * (size_t)s->d->channels,
                        &s->new_parts[j].sum[r]);
            }
        }
    }
}

static void do_work(void *context, int item, int thread)
{
    run_state *s = context;
    int j0 = item / s->pieces * s->together, j1 = j0 + s->together;
    int piece = item % s->pieces, per = SCRAMBLES / s->pieces;
    j1 = j1 < s->active_count ? j1 : s->active_count;

    size_t at = (size_t)piece * (size_t)s->active_count + (size_t)j0;
    sample_sets(s, thread, j0, j1, piece * per, (piece + 1) * per,
                s->new_total + at * (size_t)s->d->channels);
    for (int j = j0; j < j1; j++)
        atomic_fetch_add(&s->pieces_done[j], 1);

    double now = (double)atomic_fetch_add(&s->samples_done, (long long)(j1 - j0) * per * s->n);
    progress_update(s->d->progress, (s->samples_before + now) / s->samples_predicted,
                    100.0 * s->reached);
    if (progress_stopped(s->d->progress) || (s->may_cut && clock_seconds() > s->d->deadline))
        s->halt = true;
}

/* Takes over what this round found of the items that it finished. */
static void take_over(run_state *s)
{
    size_t channels = (size_t)s->d->channels, active = (size_t)s->active_count;
    for (size_t j = 0; j < active; j++) {
        if (s->pieces_done[j] < s->pieces)
            continue;
        size_t item = (size_t)s->active[j];
        for (size_t c = 0; c < channels; c++)
            for (size_t piece = 0; piece < (size_t)s->pieces; piece++)
                s->total[c * (size_t)s->d->items + item] +=
                    s->new_total[(piece * active + j) * channels + c];
        for (int r = 0; r < SCRAMBLES; r++)
            s->parts[item].sum[r] += s->new_parts[j].sum[r];
        s->r->samples[item] += SCRAMBLES * s->n;
    }
}

static bool sample_round(run_state *s, lux_error *err)
{
    arena scratch   = { 0 };
    size_t active   = (size_t)s->active_count;
    uint32_t sensor = SCRAMBLES * s->n; /* samples of an item */
    s->together     = sensor <= BUNDLE ? (int)(BUNDLE / sensor) : 1;
    s->pieces       = sensor > BUNDLE && s->active_count < FEW_ITEMS ? SCRAMBLES : 1;
    s->new_total =
        arena_array(&scratch, double, active *(size_t)s->pieces *(size_t)s->d->channels, err);
    s->new_parts   = arena_array(&scratch, by_scramble, active, err);
    s->pieces_done = arena_array(&scratch, atomic_int, active, err);
    if (s->new_total && s->new_parts && s->pieces_done) {
        int items = (s->active_count + s->together - 1) / s->together * s->pieces;
        atomic_store(&s->samples_done, 0);
        parallel_for(items, s->d->threads, do_work, s, &s->halt);
        take_over(s);
    }
    bool good = s->new_total && s->new_parts && s->pieces_done;
    arena_clear(&scratch);
    return good;
}

/* ---- between rounds: how good it is ------------------------------------------------------------
 */

static double value_of(const run_state *s, int item)
{
    double n = s->r->samples[item];
    return (s->d->exact ? s->d->exact[item] : 0.0) + (n > 0 ? s->total[item] / n : 0.0);
}

static double half_width_of(const run_state *s, int item)
{
    double n = (double)(s->r->samples[item] / SCRAMBLES), mean = 0.0, squares = 0.0;
    if (!(n > 0.0))
        return 0.0;
    for (int r = 0; r < SCRAMBLES; r++)
        mean += (double)s->parts[item].sum[r] / (n * SCRAMBLES);
    for (int r = 0; r < SCRAMBLES; r++) {
        double off = (double)s->parts[item].sum[r] / n - mean;
        squares += off * off;
    }
    return student_t * sqrt(squares / (SCRAMBLES - 1) / SCRAMBLES);
}

static double floor_of(const run_state *s)
{
    double sum = 0.0, count = 0.0;
    bool geometric = s->d->floor == FLOOR_LOG_MEAN;
    for (int i = 0; i < s->d->items; i++) {
        double value = fabs(value_of(s, i));
        if (geometric && !(value > 0.0))
            continue;
        sum += geometric ? log(value) : value;
        count += 1.0;
    }
    if (count == 0.0)
        return 0.0;
    return 0.1 * (geometric ? exp(sum / count) : sum / count);
}

/* Half width against what it is measured by: what the accuracy asked for bounds. */
static double ratio_of(const run_state *s, int item)
{
    double against = fmax(fabs(value_of(s, item)), s->r->floor), half = s->r->half_width[item];
    return half > 0.0 ? half / against : 0.0; /* infinite if against is 0 */
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* No sample found anything, and they are too few to say that there is nothing: the spread of
 * zeros is 0, and would be taken for certainty. */
static bool is_in_doubt(const run_state *s, int item)
{
    return s->total[item] == 0.0 &&
           s->r->samples[item] < (uint64_t)SCRAMBLES * (uint64_t)s->d->dark_samples;
}

/* Judges all items; leaves those that are to be sampled on in s->active. */
static bool judge(run_state *s, lux_error *err)
{
    int items      = s->d->items;
    arena scratch  = { 0 };
    double *ratios = arena_array(&scratch, double, (size_t)items, err);
    if (!ratios)
        return false;

    for (int i = 0; i < items; i++)
        s->r->half_width[i] = half_width_of(s, i);
    s->r->floor       = floor_of(s);
    s->r->missed      = 0;
    s->r->complete    = true;
    s->active_count   = 0;
    s->samples_before = s->samples_predicted = 0.0;
    for (int i = 0; i < items; i++) {
        double n  = s->r->samples[i];
        ratios[i] = ratio_of(s, i);
        s->samples_before += n;
        s->samples_predicted += n;
        if (n == 0.0)
            s->r->complete = false;
        if (n == 0.0 || ratios[i] > s->d->accuracy || is_in_doubt(s, i)) {
            double more = fmin(ratios[i] / s->d->accuracy, 1e3);
            s->r->missed++;
            s->samples_predicted += fmax(n, n * (more * more - 1.0));
            s->active[s->active_count++] = i;
        }
    }

    int may_miss = (int)((1.0 - s->d->needed) * items + 1e-9);
    qsort(ratios, (size_t)items, sizeof *ratios, compare);
    s->reached = s->r->reached = ratios[items - 1 - may_miss];
    s->r->enough               = s->r->complete && s->r->missed <= may_miss;
    arena_clear(&scratch);
    return true;
}

static bool run_rounds(run_state *s, lux_error *err)
{
    const accuracy_desc *d = s->d;
    s->n                   = (uint32_t)d->first_samples;
    s->samples_predicted   = 16.0 * d->items * SCRAMBLES * s->n;
    s->reached             = (double)NAN;
    for (s->active_count = 0; s->active_count < d->items; s->active_count++)
        s->active[s->active_count] = s->active_count;

    do {
        if (!sample_round(s, err) || !judge(s, err))
            return false;
        s->may_cut = true;
        s->first += s->n;
        s->n = s->first; /* as many again: doubled */
        if (progress_stopped(d->progress) || clock_seconds() > d->deadline)
            s->halt = true;
    } while (!s->halt && !s->r->enough && s->first + s->n <= MOST_SAMPLES);
    s->r->interrupted = progress_stopped(d->progress);
    return true;
}

bool accuracy_run(arena *a, const accuracy_desc *d, accuracy_result *out, lux_error *err)
{
    size_t items = (size_t)d->items, values = items * (size_t)d->channels;
    arena scratch = { 0 };
    run_state s   = { .d = d, .r = out };
    *out          = (accuracy_result){ .mean       = arena_array(a, double, values, err),
                                       .half_width = arena_array(a, double, items, err),
                                       .samples    = arena_array(a, uint32_t, items, err) };
    s.total       = arena_array(&scratch, double, values, err);
    s.parts       = arena_array(&scratch, by_scramble, items, err);
    s.active      = arena_array(&scratch, int, items, err);
    s.values      = arena_array(&scratch, float, (size_t)d->threads *MOST_CHANNELS *BUNDLE, err);
    bool good = out->mean && out->half_width && out->samples && s.total && s.parts && s.active &&
                s.values && run_rounds(&s, err);
    for (size_t v = 0; good && v < values; v++) {
        uint32_t n   = out->samples[v % items];
        out->mean[v] = n ? s.total[v] / n : 0.0;
    }
    arena_clear(&scratch);
    return good;
}
