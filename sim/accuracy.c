/* sim/accuracy.c -- rounds of samples; see accuracy.h. */
#include "sim/accuracy_parts.h"

#include "core/parallel.h"

#include <math.h>
#include <time.h>

/* Items so few that threads would lie idle are split by scramble where they need many samples. */
enum { FEW_ITEMS = 1024, LONG_ROUND = 1 << 20 /* samples */ };

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
        [RUN_HELD_UP]     = "maps or bounds are not fine enough for the accuracy asked for",
    };
    return end == RUN_DONE ? NULL : texts[end];
}

/* ---- one round: samples ---------------------------------------------------------------------- */

/* Adds the values of samples begin .. end - 1, which are of one scramble of one item. */
static void add_set(accuracy_state *s, const float *values, int begin, int end, double *total,
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
static void sample_sets(accuracy_state *s, int thread, int j0, int j1, int r0, int r1,
                        double *totals)
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
    accuracy_state *s = context;
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

/* Of pairs of sums. */
static float correlation(const by_scramble *a, const by_scramble *b)
{
    double mean_a = 0.0, mean_b = 0.0, aa = 0.0, bb = 0.0, ab = 0.0;
    for (int r = 0; r < SCRAMBLES; r++) {
        mean_a += (double)a->sum[r] / SCRAMBLES;
        mean_b += (double)b->sum[r] / SCRAMBLES;
    }
    for (int r = 0; r < SCRAMBLES; r++) {
        double x = (double)a->sum[r] - mean_a, y = (double)b->sum[r] - mean_b;
        aa += x * x, bb += y * y, ab += x * y;
    }
    return aa > 0.0 && bb > 0.0 ? (float)(ab / sqrt(aa * bb)) : 0.0f;
}

/* Takes over what this round found of the items that it finished. */
static void take_over(accuracy_state *s)
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
        for (size_t q = 0; q < spread; q++) {
            by_scramble *to = &s->parts[item * spread + q], *more = &s->new_parts[j * spread + q];
            if (s->d->common && s->rounds > 0)
                s->looks[item * spread + q].common = correlation(to, more);
            for (int r = 0; r < SCRAMBLES; r++)
                to->sum[r] += more->sum[r];
        }
        s->r->samples[item] += (uint32_t)(s->to - s->from) * s->n;
    }
}

static bool sample_round(accuracy_state *s, lux_error *err)
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

/* ---- all rounds ------------------------------------------------------------------------------ */

static void halt_if_late(accuracy_state *s)
{
    if (progress_stopped(s->d->progress) || clock_seconds() > s->d->deadline)
        __atomic_store_n(&s->halt, true, __ATOMIC_RELAXED);
}

static void every_item(accuracy_state *s)
{
    for (s->active_count = 0; s->active_count < s->d->items; s->active_count++)
        s->active[s->active_count] = s->active_count;
}

/* The first round. Where it is long, or time is short, it goes scramble by scramble: once every
 * item has had two, there is a result, however soon time is out. The sums are the same. */
static bool first_round(accuracy_state *s, lux_error *err)
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
        if (s->may_cut && !accuracy_judge(s, err)) /* how accurate it is so far */
            return false;
        every_item(s);
        if (s->may_cut || progress_stopped(s->d->progress))
            halt_if_late(s);
    }
    s->from   = 0;
    s->to     = SCRAMBLES;
    s->rounds = s->scrambles == SCRAMBLES;
    return accuracy_judge(s, err);
}

/* The only round of a run of so many samples: in the end there is what there is. */
static bool run_once(accuracy_state *s, lux_error *err)
{
    int samples = s->d->only_samples, scrambles = samples < SCRAMBLES ? samples : SCRAMBLES;
    while (samples % scrambles != 0)
        scrambles--;
    s->n                 = (uint32_t)(samples / scrambles);
    s->to                = scrambles;
    s->samples_predicted = (double)s->d->items * samples;
    every_item(s);
    if (!sample_round(s, err) || !accuracy_judge(s, err))
        return false;
    s->r->complete = s->scrambles == scrambles;
    s->r->end      = progress_stopped(s->d->progress) ? RUN_INTERRUPTED : s->r->end;
    return true;
}

static bool run_rounds(accuracy_state *s, lux_error *err)
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
        if (!accuracy_judge(s, err))
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
    arena scratch    = { 0 };
    int judged       = d->judged ? d->judged : 1;
    size_t spread    = (size_t)(judged + d->told);
    accuracy_state s = { .d = d, .r = out, .judged = judged, .spread = judged + d->told };
    *out             = (accuracy_result){ .mean       = arena_array(a, double, values, err),
                                          .half_width = arena_array(a, double, spread *items, err),
                                          .of_average = arena_array(a, double, spread, err),
                                          .samples    = arena_array(a, uint32_t, items, err) };
    s.total          = arena_array(&scratch, double, values, err);
    s.parts          = arena_array(&scratch, by_scramble, spread * items, err);
    s.looks          = arena_array(&scratch, look, spread * items, err);
    s.floors         = arena_array(&scratch, double, spread, err);
    s.active         = arena_array(&scratch, int, items, err);
    s.values  = arena_array(&scratch, float, (size_t)d->threads *(size_t)d->channels *BUNDLE, err);
    bool good = out->mean && out->half_width && out->of_average && out->samples && s.total &&
                s.parts && s.looks && s.floors && s.active && s.values && run_rounds(&s, err);
    if (good)
        accuracy_judge_average(&s);
    for (size_t v = 0; good && v < values; v++) {
        uint32_t n   = out->samples[v % items];
        out->mean[v] = n ? s.total[v] / n : 0.0;
    }
    arena_clear(&scratch);
    return good;
}
