/* sim/accuracy.c -- see accuracy.h. */
#include "sim/accuracy.h"

#include "core/parallel.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* 97.5 % quantile of Student's t by degrees of freedom (Abramowitz and Stegun, table 26.10) */
static const double student_t[SCRAMBLES] = { HUGE_VAL, 12.7062, 4.3027, 3.1824, 2.7764, 2.5706,
                                             2.4469,   2.3646,  2.3060, 2.2622, 2.2281, 2.2010,
                                             2.1788,   2.1604,  2.1448, 2.1314 };

/* Items so few that threads would lie idle are split by scramble where they need many samples. */
enum { FEW_ITEMS = 1024, LONG_ROUND = 1 << 20 /* samples */ };

typedef struct by_scramble {
    float sum[SCRAMBLES];
} by_scramble;

/* n h^2, of n samples and half width h, at the last two looks at an item: after so many samples */
typedef struct look {
    float before, now;
    uint32_t samples;
} look;

typedef struct run_state {
    const accuracy_desc *d;
    accuracy_result *r;
    int judged;         /* channels */
    int spread;         /* those and the ones that are only told: whose spread is known */
    double *total;      /* items * channels, channel by channel */
    by_scramble *parts; /* an item, of each of those: item * spread + channel */
    double *floors;     /* of each of those */
    look *looks;        /* as parts */
    float *values;      /* a thread: channels * BUNDLE */

    /* This round: n new samples for each scramble of the active items, beginning with number
     * `first`. Work is handed out as `together` items at a time or, if pieces > 1, as one item's
     * scrambles in that many pieces. */
    int *active, active_count, together, pieces;
    uint32_t n, first;
    int from, to;  /* scrambles of this pass; all of them, but for the passes of the first round */
    int scrambles; /* that every item has had, of SCRAMBLES */
    int rounds;    /* that are over */
    double *new_total;       /* (piece * active_count + j) * channels + channel */
    by_scramble *new_parts;  /* an active item: as parts */
    atomic_int *pieces_done; /* an active item */
    bool may_cut;            /* the deadline counts: once every item has two scrambles */
    atomic_llong samples_done;
    double samples_before, samples_predicted, reached;
    bool halt; /* by __atomic alone */
} run_state;

double clock_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

double deadline_share(double deadline, int left)
{
    double now = clock_seconds();
    return now + fmax(deadline - now, 0.0) / left;
}

const char *run_end_text(run_end end)
{
    static const char *const texts[] = {
        [RUN_INTERRUPTED] = "interrupted before the accuracy asked for was reached",
        [RUN_LATE]        = "the time was out before the accuracy asked for was reached",
        [RUN_EXHAUSTED]   = "the accuracy asked for takes more samples than lux4 draws",
    };
    return end == RUN_DONE ? NULL : texts[end];
}

/* ---- one round: samples ---------------------------------------------------------------------- */

/* Adds the values of samples begin .. end - 1, which are of one scramble of one item. */
static void add_set(run_state *s, const float *values, int begin, int end, double *total,
                    by_scramble *parts, int scramble)
{
    for (int c = 0; c < s->d->channels; c++) {
        double sum = 0.0;
        for (int i = begin; i < end; i++)
            sum += (double)values[c * BUNDLE + i];
        total[c] += sum;
        if (c < s->spread)
            parts[c].sum[scramble] = (float)((double)parts[c].sum[scramble] + sum);
    }
}

/* Scrambles r0 .. r1 - 1 of active items j0 .. j1 - 1, all of them together at most a bundle, or
 * a bundle of one scramble after the other. */
static void sample_sets(run_state *s, int thread, int j0, int j1, int r0, int r1, double *totals)
{
    float *values = s->values + (size_t)thread * (size_t)s->d->channels * BUNDLE;
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
                        &s->new_parts[j * s->spread], r);
            }
        }
    }
}

static void do_work(void *context, int item, int thread)
{
    run_state *s = context;
    int j0 = item / s->pieces * s->together, j1 = j0 + s->together;
    int piece = item % s->pieces, per = (s->to - s->from) / s->pieces;
    j1 = j1 < s->active_count ? j1 : s->active_count;

    size_t at = (size_t)piece * (size_t)s->active_count + (size_t)j0;
    sample_sets(s, thread, j0, j1, s->from + piece * per, s->from + (piece + 1) * per,
                s->new_total + at * (size_t)s->d->channels);
    for (int j = j0; j < j1; j++)
        atomic_fetch_add(&s->pieces_done[j], 1);

    double now = (double)atomic_fetch_add(&s->samples_done, (long long)(j1 - j0) * per * s->n);
    progress_update(s->d->progress, (s->samples_before + now) / s->samples_predicted,
                    100.0 * s->reached);
    if (progress_stopped(s->d->progress) || (s->may_cut && clock_seconds() > s->d->deadline))
        __atomic_store_n(&s->halt, true, __ATOMIC_RELAXED);
}

/* Takes over what this round found of the items that it finished. */
static void take_over(run_state *s)
{
    size_t channels = (size_t)s->d->channels, active = (size_t)s->active_count;
    size_t spread = (size_t)s->spread;
    for (size_t j = 0; j < active; j++) {
        if (s->pieces_done[j] < s->pieces)
            continue;
        size_t item = (size_t)s->active[j];
        for (size_t c = 0; c < channels; c++)
            for (size_t piece = 0; piece < (size_t)s->pieces; piece++)
                s->total[c * (size_t)s->d->items + item] +=
                    s->new_total[(piece * active + j) * channels + c];
        for (size_t q = 0; q < spread; q++)
            for (int r = 0; r < SCRAMBLES; r++)
                s->parts[item * spread + q].sum[r] += s->new_parts[j * spread + q].sum[r];
        s->r->samples[item] += (uint32_t)(s->to - s->from) * s->n;
    }
}

static bool sample_round(run_state *s, lux_error *err)
{
    arena scratch    = { 0 };
    size_t active    = (size_t)s->active_count;
    uint32_t an_item = (uint32_t)(s->to - s->from) * s->n; /* samples */
    bool whole       = s->to - s->from == SCRAMBLES;
    s->together      = an_item <= BUNDLE ? (int)(BUNDLE / an_item) : 1;
    s->pieces        = whole && an_item > BUNDLE && s->active_count < FEW_ITEMS ? SCRAMBLES : 1;
    s->new_total =
        arena_array(&scratch, double, active *(size_t)s->pieces *(size_t)s->d->channels, err);
    s->new_parts   = arena_array(&scratch, by_scramble, active * (size_t)s->spread, err);
    s->pieces_done = arena_array(&scratch, atomic_int, active, err);
    if (s->new_total && s->new_parts && s->pieces_done) {
        int items = (s->active_count + s->together - 1) / s->together * s->pieces;
        atomic_store(&s->samples_done, 0);
        bool all = parallel_for(items, s->d->threads, do_work, s, &s->halt);
        if (all || whole) /* a pass counts if every item has had it */
            take_over(s);
        if (all)
            s->scrambles = s->to;
    }
    bool good = s->new_total && s->new_parts && s->pieces_done;
    arena_clear(&scratch);
    return good;
}

/* ---- between rounds: how good it is ---------------------------------------------------------- */

static size_t at(const run_state *s, int channel, int item)
{
    return (size_t)channel * (size_t)s->d->items + (size_t)item;
}

static double value_of(const run_state *s, int channel, int item)
{
    double n   = s->r->samples[item];
    bool known = s->d->exact && channel < s->judged;
    return (known ? s->d->exact[at(s, channel, item)] : 0.0) +
           (n > 0 ? s->total[at(s, channel, item)] / n : 0.0);
}

/* From the item's own scrambles alone. */
static double own_half_width(const run_state *s, int channel, int item)
{
    int scrambles     = s->scrambles;
    const float *part = s->parts[(size_t)item * (size_t)s->spread + (size_t)channel].sum;
    double n = (double)s->r->samples[item] / scrambles, mean = 0.0, squares = 0.0;
    if (!(n > 0.0) || scrambles < 2)
        return HUGE_VAL;
    for (int r = 0; r < scrambles; r++)
        mean += (double)part[r] / (n * scrambles);
    for (int r = 0; r < scrambles; r++) {
        double off = (double)part[r] / n - mean;
        squares += off * off;
    }
    return student_t[scrambles - 1] * sqrt(squares / (scrambles - 1) / scrambles);
}

static double floor_of(const run_state *s, int channel)
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
static double against_of(const run_state *s, int channel, int item)
{
    bool own     = channel < 2 || s->d->apart || channel >= s->judged;
    double floor = s->floors[own ? channel : 1];
    return fmax(fabs(value_of(s, channel, item)), floor);
}

/* A half width against that. */
static double ratio_of(const run_state *s, int channel, int item)
{
    double half = s->r->half_width[at(s, channel, item)];
    return half == 0.0 ? 0.0 : half / against_of(s, channel, item); /* infinite if that is 0 */
}

/* An item is looked at after each round that it takes part in. */
static void look_at(const run_state *s, int channel, int item)
{
    double n = s->r->samples[item], half = s->r->half_width[at(s, channel, item)];
    look *l = &s->looks[(size_t)item * (size_t)s->spread + (size_t)channel];
    if (s->rounds > 0 && l->samples != s->r->samples[item])
        *l = (look){ l->now, (float)(n * half * half), s->r->samples[item] };
}

/* The square of the half width that an item would have if its samples were as alike as those of the
 * others (pool: n ratio^2), or as they were at the look before, if that is more. */
static double others_square(const run_state *s, int channel, int item, double pool)
{
    double n = s->r->samples[item], against = against_of(s, channel, item);
    const look *l = &s->looks[(size_t)item * (size_t)s->spread + (size_t)channel];
    return n > 0.0 ? fmax(pool * against * against, (double)l->before) / n : 0.0;
}

/* Half widths of all items: their own, widened where an item seems surer than the others are on
 * average for as many samples, or than it was itself. Its samples may just have missed what is rare
 * and bright. */
static void estimate_half_widths(run_state *s, int channel)
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
static int first_held(const run_state *s) { return s->judged > 1 && !s->d->apart ? 1 : 0; }

static double share_of(const run_state *s, int channel)
{
    return channel && !s->d->apart ? PARTS_SHARE : 1.0;
}

/* No sample found anything, and they are too few to say that there is nothing: the spread of
 * zeros is 0, and would be taken for certainty. */
static bool is_in_doubt(const run_state *s, int channel, int item)
{
    return s->total[at(s, channel, item)] == 0.0 &&
           s->r->samples[item] < (uint64_t)SCRAMBLES * (uint64_t)s->d->dark_samples;
}

/* The worst of an item's channels, against what is asked of each. */
static double worst_ratio(const run_state *s, int item)
{
    double worst = 0.0;
    for (int q = first_held(s); q < s->judged; q++) {
        double ratio = is_in_doubt(s, q, item) ? HUGE_VAL : ratio_of(s, q, item) / share_of(s, q);
        worst        = ratio <= worst ? worst : ratio; /* no number is no certainty */
    }
    return isnan(worst) ? HUGE_VAL : worst;
}

/* Whether more samples may make the item good: what is left out of them alone does not spoil it,
 * nor what stays as it is, which they come close to slowly. */
static bool can_be_good(const run_state *s, int item)
{
    const double most_fixed = 0.9; /* then the rest of the square is a fifth */
    const accuracy_desc *d  = s->d;
    bool can                = true;
    for (int q = first_held(s); q < s->judged; q++) {
        double asked = share_of(s, q) * d->accuracy * against_of(s, q, item);
        double bound = d->bound ? d->bound[at(s, q, item)] : 0.0;
        double fixed = d->fixed ? d->fixed[at(s, q, item)] : 0.0;
        can          = can && bound <= asked && fixed <= most_fixed * (asked - bound);
    }
    return can;
}

/* Judges all items; leaves those that are to be sampled on in s->active. */
static bool judge(run_state *s, lux_error *err)
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
    s->r->end   = enough ? RUN_DONE : RUN_EXHAUSTED; /* unless something else ends it before */
    arena_clear(&scratch);
    return true;
}

static void halt_if_late(run_state *s)
{
    if (progress_stopped(s->d->progress) || clock_seconds() > s->d->deadline)
        __atomic_store_n(&s->halt, true, __ATOMIC_RELAXED);
}

static void every_item(run_state *s)
{
    for (s->active_count = 0; s->active_count < s->d->items; s->active_count++)
        s->active[s->active_count] = s->active_count;
}

/* The first round. Where it is long, or time is short, it goes scramble by scramble: once every
 * item has had two, there is a result, however soon time is out. The sums are the same. */
static bool first_round(run_state *s, lux_error *err)
{
    bool at_once =
        s->d->deadline == HUGE_VAL && (double)s->d->items * SCRAMBLES * s->n < LONG_ROUND;
    int step = at_once ? SCRAMBLES : 1;
    for (int from = 0; from < SCRAMBLES && !s->halt; from += step) {
        s->from = from;
        s->to   = from + step;
        if (!sample_round(s, err))
            return false;
        s->may_cut = s->scrambles >= 2;
        if (s->may_cut && !judge(s, err)) /* how accurate it is so far */
            return false;
        every_item(s);
        if (s->may_cut || progress_stopped(s->d->progress))
            halt_if_late(s);
    }
    s->from   = 0;
    s->to     = SCRAMBLES;
    s->rounds = s->scrambles == SCRAMBLES;
    return judge(s, err);
}

/* The only round of a run of so many samples: in the end there is what there is. */
static bool run_once(run_state *s, lux_error *err)
{
    int samples = s->d->only_samples, scrambles = samples < SCRAMBLES ? samples : SCRAMBLES;
    while (samples % scrambles != 0)
        scrambles--;
    s->n                 = (uint32_t)(samples / scrambles);
    s->to                = scrambles;
    s->samples_predicted = (double)s->d->items * samples;
    every_item(s);
    if (!sample_round(s, err) || !judge(s, err))
        return false;
    s->r->complete = s->scrambles == scrambles;
    s->r->end      = progress_stopped(s->d->progress) ? RUN_INTERRUPTED : s->r->end;
    return true;
}

static bool run_rounds(run_state *s, lux_error *err)
{
    const accuracy_desc *d = s->d;
    if (d->only_samples > 0)
        return run_once(s, err);
    s->n                 = (uint32_t)d->first_samples;
    s->samples_predicted = 16.0 * d->items * SCRAMBLES * s->n;
    s->reached           = (double)NAN;
    every_item(s);
    if (!first_round(s, err))
        return false;
    while (!s->halt && s->r->end != RUN_DONE && s->active_count > 0 &&
           2 * (s->first + s->n) <= MOST_SAMPLES) {
        s->first += s->n;
        s->n = s->first; /* as many again: doubled; from there on, they are a net of their own */
        if (!sample_round(s, err))
            return false;
        s->rounds++;
        if (!judge(s, err))
            return false;
        halt_if_late(s);
    }
    if (s->halt && s->r->end != RUN_DONE)
        s->r->end = progress_stopped(d->progress) ? RUN_INTERRUPTED : RUN_LATE;
    return true;
}

bool accuracy_run(arena *a, const accuracy_desc *d, accuracy_result *out, lux_error *err)
{
    size_t items = (size_t)d->items, values = items * (size_t)d->channels;
    arena scratch = { 0 };
    int judged    = d->judged ? d->judged : 1;
    size_t spread = (size_t)(judged + d->told);
    run_state s   = { .d = d, .r = out, .judged = judged, .spread = judged + d->told };
    *out          = (accuracy_result){ .mean       = arena_array(a, double, values, err),
                                       .half_width = arena_array(a, double, spread *items, err),
                                       .samples    = arena_array(a, uint32_t, items, err) };
    s.total       = arena_array(&scratch, double, values, err);
    s.parts       = arena_array(&scratch, by_scramble, spread * items, err);
    s.looks       = arena_array(&scratch, look, spread * items, err);
    s.floors      = arena_array(&scratch, double, spread, err);
    s.active      = arena_array(&scratch, int, items, err);
    s.values  = arena_array(&scratch, float, (size_t)d->threads *(size_t)d->channels *BUNDLE, err);
    bool good = out->mean && out->half_width && out->samples && s.total && s.parts && s.looks &&
                s.floors && s.active && s.values && run_rounds(&s, err);
    for (size_t v = 0; good && v < values; v++) {
        uint32_t n   = out->samples[v % items];
        out->mean[v] = n ? s.total[v] / n : 0.0;
    }
    arena_clear(&scratch);
    return good;
}
