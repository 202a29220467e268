/* tests/unit/test_accuracy.c -- rounds of samples, half widths and why runs end, on fake samples
 * whose values are known. */
#include "core/sampler.h"
#include "sim/accuracy.h"
#include "tests/test.h"

#include <string.h>

/* Scramble r of 0 .. 15 is off the mean by r - 7.5: the squares sum up to 340, so that
 * s^2 = 340 / 15, and the half width is t s / sqrt(16), t = 2.13145 of 15 degrees of freedom. */
static const double unit_half = 2.53691;

static double off(sample_id id) { return id.scramble - 7.5; }

typedef struct fake {
    float (*value)(sample_id id); /* of channel 0; channel c has c + 1 times that */
    int channels;
    sample_id stop_at; /* raises *stop when this is asked for */
    volatile bool *stop;
    bool lose_memory; /* from the first call on */
} fake;

static void fake_sample(void *context, int thread, const sample_id *ids, int count, float *values)
{
    const fake *f = context;
    (void)thread;
    for (int i = 0; i < count; i++) {
        float value = f->value(ids[i]);
        for (int c = 0; c < f->channels; c++)
            values[c * BUNDLE + i] = (float)(c + 1) * value;
        if (f->stop && memcmp(&ids[i], &f->stop_at, sizeof *ids) == 0)
            __atomic_store_n(f->stop, true, __ATOMIC_RELAXED);
    }
    if (f->lose_memory)
        memory_is_out = true;
}

/* Some items of one channel, 16 samples in the first round, no deadline. */
static accuracy_desc desc_of(fake *f, int items)
{
    f->channels = f->channels ? f->channels : 1;
    return (accuracy_desc){ .items         = items,
                            .channels      = f->channels,
                            .accuracy      = 0.01,
                            .needed        = 1.0,
                            .first_samples = 16,
                            .threads       = 1,
                            .deadline      = HUGE_VAL,
                            .sample        = fake_sample,
                            .context       = f };
}

static accuracy_result run(arena *a, const accuracy_desc *d)
{
    accuracy_result r;
    lux_error err = { 0 };
    if (!accuracy_run(a, d, &r, &err))
        fail_msg("%s", err.text);
    return r;
}

/* ---- means and half widths ------------------------------------------------------------------- */

static float by_scramble(sample_id id) { return (float)(17.5 + off(id)); }

TEST(a_half_width_is_student_s_of_the_scrambles_means)
{
    arena a           = { 0 };
    fake f            = { .value = by_scramble };
    accuracy_desc d   = desc_of(&f, 1);
    d.first_samples   = 8; /* and as many in the second round, which is never left out */
    d.accuracy        = 0.2;
    accuracy_result r = run(&a, &d);
    assert_near(r.mean[0], 17.5, 1e-7);
    assert_near(r.half_width[0], unit_half, 1e-4);
    assert_near(r.reached, unit_half / 17.5, 1e-4);
    assert_near(r.floor, 1.75, 1e-7);
    assert_int_equal(r.samples[0], 16 * 16);
    assert_true(r.end == RUN_DONE && r.complete && r.missed == 0);
    arena_clear(&a);
}

/* Two items whose errors are opposite: of the mean of both the scrambles show none, and what is
 * told is what independent errors would leave. Where they are the same, all of it is left. */
static float opposed(sample_id id) { return (float)(17.5 + (id.item ? -off(id) : off(id))); }

TEST(an_average_is_as_sure_as_what_items_share_lets_it_be)
{
    static const double stopping = 0.05;
    static const struct {
        float (*value)(sample_id id);
        double half; /* units */
    } of[] = { { opposed, M_SQRT1_2 + stopping }, { by_scramble, 1.0 } };
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
        arena a           = { 0 };
        fake f            = { .value = of[i].value };
        accuracy_desc d   = desc_of(&f, 2);
        d.accuracy        = 0.2;
        accuracy_result r = run(&a, &d);
        assert_near(r.of_average[0], of[i].half * unit_half, 1e-4);
        arena_clear(&a);
    }
}

/* Means 10, 10, 20; half widths 2, 0, 1 units: relative 0.2, 0, 0.05 units. Squares 0.04, 0, 0.0025
 * of mean 0.0425 / 3: items 1 and 2 are below, and take the mean of both. */
static float three_spreads(sample_id id)
{
    static const double mean[] = { 10, 10, 20 }, spread[] = { 2, 0, 1 };
    return (float)(mean[id.item] + spread[id.item] * off(id));
}

TEST(an_item_is_not_taken_to_be_much_surer_than_the_others)
{
    arena a           = { 0 };
    fake f            = { .value = three_spreads };
    accuracy_desc d   = desc_of(&f, 3);
    d.accuracy        = 1.0;
    accuracy_result r = run(&a, &d);
    assert_near(r.half_width[0], 2.0 * unit_half, 1e-4);
    assert_near(r.half_width[1], 10.0 * sqrt(0.0425 / 6.0) * unit_half, 1e-4);
    assert_near(r.half_width[2], 20.0 * sqrt((0.0025 + 0.0425 / 3.0) / 2.0) * unit_half, 1e-4);
    arena_clear(&a);
}

TEST(what_is_known_exactly_counts_in_the_accuracy_and_not_in_the_mean)
{
    arena a            = { 0 };
    const double exact = 157.5;
    fake f             = { .value = by_scramble };
    accuracy_desc d    = desc_of(&f, 1);
    d.first_samples    = 8; /* and as many in the second round, which is never left out */
    d.exact            = &exact;
    d.accuracy         = 0.02; /* 0.145 of 17.5, 0.0145 of 175 */
    accuracy_result r  = run(&a, &d);
    assert_true(r.end == RUN_DONE && r.samples[0] == 16 * 16);
    assert_near(r.mean[0], 17.5, 1e-7);
    assert_near(r.half_width[0], unit_half, 1e-4);
    assert_near(r.reached, unit_half / 175.0, 1e-4);
    assert_near(r.floor, 17.5, 1e-7);
    arena_clear(&a);
}

TEST(what_is_left_out_widens_the_interval_by_its_bound)
{
    arena a            = { 0 };
    const double bound = 0.5;
    fake f             = { .value = by_scramble };
    accuracy_desc d    = desc_of(&f, 1);
    d.bound            = &bound;
    d.accuracy         = 0.2;
    accuracy_result r  = run(&a, &d);
    assert_near(r.half_width[0], unit_half + 0.5, 1e-4);
    assert_near(r.reached, (unit_half + 0.5) / 17.5, 1e-4);
    arena_clear(&a);
}

/* Channel 2, a tenth of channel 1, is held to a tenth of the mean of that: a part may be small. */
static float part_of_a_tenth(sample_id id) { return (float)(17.5 + off(id)); }

TEST(a_small_part_is_judged_by_what_it_is_part_of)
{
    arena a              = { 0 };
    const double exact[] = { 1000.0, 1000.0, 0.0 };
    fake f               = { .value = part_of_a_tenth, .channels = 3 };
    accuracy_desc d      = desc_of(&f, 1);
    d.judged             = 3;
    d.exact              = exact;
    d.first_samples      = 8;
    d.accuracy        = 1.01 * 3.0 * unit_half / 103.5 / PARTS_SHARE; /* floor: (1000 + 35) / 10 */
    accuracy_result r = run(&a, &d);
    assert_near(r.half_width[2], 3.0 * unit_half, 1e-4);
    assert_true(r.end == RUN_DONE && r.missed == 0);
    arena_clear(&a);
}

TEST(what_bounds_alone_spoil_is_not_sampled_for_ever)
{
    arena a            = { 0 };
    const double bound = 5.0; /* of 17.5: more than the accuracy allows */
    fake f             = { .value = by_scramble };
    accuracy_desc d    = desc_of(&f, 1);
    d.bound            = &bound;
    d.accuracy         = 0.2;
    d.first_samples    = 8;
    accuracy_result r  = run(&a, &d);
    assert_true(r.end == RUN_HELD_UP && r.missed == 1);
    assert_int_equal(r.samples[0], 16 * 16);
    arena_clear(&a);
}

/* What scrambles are off by is 0.9 of by_scramble's, whatever their samples; the rest is of each
 * round alone: one order of the scrambles for odd numbers of rounds, another one for even ones. */
static float mostly_common(sample_id id)
{
    int round       = 31 - __builtin_clz(id.index / 8 + 1);
    unsigned turned = id.scramble * (round % 2 ? 3 : 5) % 16;
    return (float)(17.5 + 0.9 * off(id) + 0.1 * ((double)turned - 7.5));
}

TEST(what_all_samples_of_a_scramble_share_is_not_sampled_for_ever)
{
    arena a           = { 0 };
    fake f            = { .value = mostly_common };
    accuracy_desc d   = desc_of(&f, 1);
    d.first_samples   = 8;
    d.common          = true;
    d.accuracy        = 0.5 * unit_half / 17.5;
    accuracy_result r = run(&a, &d);
    assert_true(r.end == RUN_HELD_UP && r.missed == 1);
    assert_int_equal(r.samples[0], 16 * 16);
    assert_true(r.half_width[0] >= 0.9 * unit_half && r.half_width[0] <= unit_half);
    d.accuracy = 1.01 * unit_half / 17.5; /* then it is not in the way */
    r          = run(&a, &d);
    assert_true(r.end == RUN_DONE && r.missed == 0);
    arena_clear(&a);
}

TEST(several_channels_are_judged_each_by_itself)
{
    arena a                = { 0 };
    const double exact[]   = { 17.5, 0.0 }; /* then channel 0 is twice as sure as channel 1 */
    fake f                 = { .value = by_scramble, .channels = 3 };
    accuracy_desc d        = desc_of(&f, 1);
    d.judged               = 2;
    d.exact                = exact;
    d.first_samples        = 8;
    d.accuracy             = 1.5 * unit_half / 35.0;
    accuracy_result r      = run(&a, &d);
    const double at_first  = unit_half / 35.0;
    const double of_second = 2.0 * unit_half / 35.0; /* channel 1 is twice channel 0 */
    assert_near(r.half_width[0], unit_half, 1e-4);
    assert_near(r.half_width[1], 2.0 * unit_half, 1e-4);
    assert_true(at_first <= d.accuracy && of_second > PARTS_SHARE * d.accuracy);
    assert_int_equal(r.missed, 1);
    assert_near(r.reached, of_second / PARTS_SHARE, 1e-4);
    arena_clear(&a);
}

/* Channel 1 is twice channel 0, and nothing of it is known besides: its floor is its own. */
TEST(a_channel_that_is_only_told_has_a_half_width_and_no_say)
{
    arena a              = { 0 };
    const double exact[] = { 1e4, 1e4, 1e4 }, bound[] = { 1.0, 1.0, 1.0 };
    fake f            = { .value = three_spreads, .channels = 2 };
    accuracy_desc d   = desc_of(&f, 3);
    d.told            = 1;
    d.exact           = exact;
    d.bound           = bound;
    d.accuracy        = 0.002; /* of 10000; of channel 1's 20, items 0 and 2 are far from it */
    accuracy_result r = run(&a, &d);
    assert_true(r.end == RUN_DONE && r.missed == 0 && r.samples[0] == 16 * 32);
    assert_near(r.mean[3 + 2], 40.0, 1e-7);
    assert_near(r.half_width[0], 2.0 * unit_half + 1.0, 1e-4);
    assert_near(r.half_width[3 + 0], 4.0 * unit_half, 1e-4);
    assert_near(r.half_width[3 + 1], 20.0 * sqrt(0.0425 / 6.0) * unit_half, 1e-4);
    arena_clear(&a);
}

static float by_item(sample_id id) { return (float)(id.item + 1); }

TEST(every_channel_has_its_means)
{
    arena a           = { 0 };
    fake f            = { .value = by_item, .channels = 8 };
    accuracy_desc d   = desc_of(&f, 5);
    accuracy_result r = run(&a, &d);
    for (int c = 0; c < 8; c++)
        for (int i = 0; i < 5; i++)
            assert_near(r.mean[c * 5 + i], (c + 1) * (i + 1), 1e-12);
    arena_clear(&a);
}

/* Exponential samples of mean 1, which are skewed; of one unknown alone, which no others help. Its
 * runs end after the second round to the fifth. Of 4000 intervals of 95 %, 95 % +- 0.35 % hold the
 * mean; of those that forget what they were at the look before, 93.8 %. */
static uint32_t trial;

static float exponential(sample_id id)
{
    uint32_t h = hash_combine_u32(hash_combine_u32(hash_u32(trial), id.scramble), id.index);
    return (float)-log((h + 0.5) * 0x1p-32);
}

TEST(looking_after_each_round_leaves_the_intervals_valid)
{
    enum { TRIALS = 4000 };
    int held = 0, within = 0;
    for (trial = 1; trial <= TRIALS; trial++) {
        arena a           = { 0 };
        fake f            = { .value = exponential };
        accuracy_desc d   = desc_of(&f, 1);
        d.first_samples   = 8;
        d.accuracy        = 0.1;
        accuracy_result r = run(&a, &d);
        held += fabs(r.mean[0] - 1.0) <= r.half_width[0];
        within += fabs(r.mean[0] - 1.0) <= d.accuracy;
        arena_clear(&a);
    }
    if (!(held >= 0.945 * TRIALS && within >= 0.95 * TRIALS))
        fail_msg("of %d intervals %d hold the truth, %d values are as accurate as asked", TRIALS,
                 held, within);
}

/* ---- rounds ---------------------------------------------------------------------------------- */

/* Samples beyond the 16th are all alike: n of them leave 16 / n of the spread. */
static float settling(sample_id id) { return (float)(100.0 + (id.index < 16 ? off(id) : 0.0)); }

TEST(samples_double_until_the_accuracy_is_reached)
{
    arena a           = { 0 };
    fake f            = { .value = settling };
    accuracy_desc d   = desc_of(&f, 2);
    d.accuracy        = 0.01; /* 0.0254 by 16, 0.0155 by 32, 0.0078 by 64 */
    accuracy_result r = run(&a, &d);
    assert_true(r.end == RUN_DONE);
    for (int i = 0; i < 2; i++) {
        assert_int_equal(r.samples[i], 16 * 64);
        /* n h^2 = 16 unit^2 / n was twice as much at the look before: the mean of both counts */
        assert_near(r.half_width[i], sqrt(1.5) * unit_half / 4.0, 1e-3);
        assert_near(r.mean[i], 100.0, 1e-7);
    }
    arena_clear(&a);
}

/* Of items 0 to 3, the last two spread. */
static float half_settled(sample_id id) { return id.item < 2 ? 100.0f : settling(id); }

TEST(the_share_needed_may_leave_the_worst_items_behind)
{
    arena a           = { 0 };
    fake f            = { .value = half_settled };
    accuracy_desc d   = desc_of(&f, 4);
    d.first_samples   = 8;    /* and as many in the second round, which is never left out */
    d.accuracy        = 0.02; /* half widths 0.0254, and half of that where nothing spreads */
    d.needed          = 0.5;
    accuracy_result r = run(&a, &d);
    assert_true(r.end == RUN_DONE && r.missed == 2 && r.samples[0] == 16 * 16);
    assert_true(r.samples[3] == 16 * 16);
    assert_near(r.reached, 0.005 * unit_half, 1e-4);

    d.needed = 0.7; /* of 4, 1 may miss */
    r        = run(&a, &d);
    assert_true(r.end == RUN_DONE && r.missed == 0 && r.samples[0] == 16 * 16);
    assert_true(r.samples[3] == 16 * 32);
    arena_clear(&a);
}

static float decades(sample_id id)
{
    static const float values[] = { 0, 1, 100, 10000 };
    return values[id.item] + (id.item == 1 ? (float)(0.1 * off(id)) : 0.0f);
}

TEST(the_floor_is_a_tenth_of_the_mean_or_of_the_geometric_mean)
{
    arena a           = { 0 };
    fake f            = { .value = decades };
    accuracy_desc d   = desc_of(&f, 4);
    d.accuracy        = 0.5;
    d.floor           = FLOOR_LOG_MEAN;
    accuracy_result r = run(&a, &d);
    assert_near(r.floor, 10.0, 1e-6);
    assert_near(r.reached, 0.1 * unit_half / 10.0, 1e-4);
    d.floor = FLOOR_MEAN;
    r       = run(&a, &d);
    assert_near(r.floor, 252.525, 1e-6);
    assert_near(r.reached, 0.1 * unit_half / 252.525, 1e-4);
    arena_clear(&a);
}

static float dark(sample_id id)
{
    (void)id;
    return 0.0f;
}

TEST(darkness_is_believed_after_the_samples_asked_for)
{
    arena a           = { 0 };
    fake f            = { .value = dark };
    accuracy_desc d   = desc_of(&f, 3);
    d.first_samples   = 8; /* and as many in the second round, which is never left out */
    accuracy_result r = run(&a, &d);
    assert_true(r.end == RUN_DONE && r.samples[2] == 16 * 16);
    d.dark_samples = 256;
    r              = run(&a, &d);
    assert_true(r.end == RUN_DONE && r.samples[0] == 16 * 256 && r.samples[2] == 16 * 256);
    assert_true(r.mean[0] == 0.0 && r.half_width[0] == 0.0 && r.floor == 0.0);
    arena_clear(&a);
}

/* ---- the same bytes, however it is divided --------------------------------------------------- */

/* Looks random, and not settled after the first round. */
static float noise(sample_id id)
{
    uint32_t h = (id.item * 0x9e3779b1u + id.scramble) * 0x85ebca6bu + id.index;
    h          = (h ^ (h >> 15)) * 0x2c1b3c6du;
    h          = (h ^ (h >> 12)) * 0x297a2d39u;
    return (float)((h ^ (h >> 15)) >> 8) * 0x1p-24f;
}

static void assert_same_bytes(const accuracy_result *x, const accuracy_result *y, size_t items)
{
    assert_memory_equal(x->mean, y->mean, items * sizeof *x->mean);
    assert_memory_equal(x->half_width, y->half_width, items * sizeof *x->half_width);
    assert_memory_equal(x->samples, y->samples, items * sizeof *x->samples);
    assert_true(x->floor == y->floor && x->reached == y->reached && x->end == y->end);
    assert_true(x->missed == y->missed && x->complete && y->complete);
}

static void divided(int items, int first_samples, double accuracy)
{
    arena a               = { 0 };
    fake f                = { .value = noise };
    accuracy_desc d       = desc_of(&f, items);
    d.first_samples       = first_samples;
    d.accuracy            = accuracy;
    accuracy_result plain = run(&a, &d);
    assert_true(plain.end == RUN_DONE);
    for (d.threads = 1; d.threads <= 3; d.threads++) {
        d.deadline           = d.threads == 2 ? HUGE_VAL : clock_seconds() + 1e6;
        accuracy_result same = run(&a, &d);
        assert_same_bytes(&plain, &same, (size_t)items);
    }
    arena_clear(&a);
}

/* With a deadline the first round goes scramble by scramble; without, all at once. */
TEST(passes_and_threads_change_no_byte) { divided(100, 16, 0.05); }

TEST(passes_and_threads_change_no_byte_of_items_in_pieces) { divided(5, 1024, 0.004); }

/* 4100 * 16 * 16 samples are more than 2^20: passes whatever the deadline. */
TEST(passes_and_threads_change_no_byte_of_a_long_round) { divided(4100, 16, 0.09); }

/* ---- why runs end ---------------------------------------------------------------------------- */

TEST(a_deadline_already_past_leaves_two_scrambles_of_each_item)
{
    arena a         = { 0 };
    fake f          = { .value = by_scramble };
    accuracy_desc d = desc_of(&f, 50);
    d.accuracy      = 10.0;
    d.deadline      = clock_seconds() - 1.0;
    for (d.threads = 1; d.threads <= 3; d.threads++) {
        accuracy_result r = run(&a, &d);
        assert_true(r.complete && r.end == RUN_LATE);
        for (int i = 0; i < 50; i++) {
            assert_int_equal(r.samples[i], 2 * 16);
            assert_near(r.mean[i], 10.5, 1e-7);
            /* 10 and 11: s / sqrt(2) = 0.5; t = 12.7062 of one degree of freedom */
            assert_near(r.half_width[i], 6.3531, 1e-4);
        }
    }
    arena_clear(&a);
}

TEST(a_stop_in_the_first_pass_leaves_nothing_complete)
{
    arena a = { 0 };
    for (int by_pass = 0; by_pass < 2; by_pass++) {
        volatile bool stop = false;
        progress p         = { .stop = &stop };
        fake f             = { .value = by_scramble, .stop_at = { 1, 0, 15 }, .stop = &stop };
        accuracy_desc d    = desc_of(&f, 100);
        d.progress         = &p;
        d.deadline         = by_pass ? clock_seconds() + 1e6 : HUGE_VAL;
        accuracy_result r  = run(&a, &d);
        assert_true(stop && !r.complete && r.end == RUN_INTERRUPTED);
    }
    arena_clear(&a);
}

/* In the fourth pass: 10, 11 and 12 are left; t = 4.3027 of two degrees of freedom, s = 1. */
TEST(a_stop_in_a_later_pass_keeps_the_passes_before)
{
    arena a            = { 0 };
    volatile bool stop = false;
    progress p         = { .stop = &stop };
    fake f             = { .value = by_scramble, .stop_at = { 1, 3, 15 }, .stop = &stop };
    accuracy_desc d    = desc_of(&f, 100);
    d.progress         = &p;
    d.deadline         = clock_seconds() + 1e6;
    accuracy_result r  = run(&a, &d);
    assert_true(r.complete && r.end == RUN_INTERRUPTED);
    for (int i = 0; i < 100; i++) {
        assert_int_equal(r.samples[i], 3 * 16);
        assert_near(r.mean[i], 11.0, 1e-7);
        assert_near(r.half_width[i], 4.3027 / sqrt(3.0), 1e-4);
    }
    arena_clear(&a);
}

/* 1 in the first 128 samples of a scramble, 5 in those after; never settled. */
static float rising(sample_id id) { return (float)((id.index < 128 ? 1.0 : 5.0) + off(id)); }

/* Rounds of 64, 64 and 128; in the third, each item's scrambles are work for 16. Item 1 is stopped
 * amid its work. */
TEST(a_stop_in_a_later_round_keeps_the_sums_of_items_not_finished)
{
    arena a            = { 0 };
    volatile bool stop = false;
    progress p         = { .stop = &stop };
    fake f             = { .value = rising, .stop_at = { 1, 3, 128 }, .stop = &stop };
    accuracy_desc d    = desc_of(&f, 3);
    d.first_samples    = 64;
    d.progress         = &p;
    accuracy_result r  = run(&a, &d);
    assert_true(r.complete && r.end == RUN_INTERRUPTED && r.missed == 3);
    assert_int_equal(r.samples[0], 16 * 256);
    assert_int_equal(r.samples[1], 16 * 128);
    assert_int_equal(r.samples[2], 16 * 128);
    assert_near(r.mean[0], 3.0, 1e-6);
    assert_near(r.mean[1], 1.0, 1e-6);
    assert_near(r.mean[2], 1.0, 1e-6);
    assert_near(r.half_width[1], unit_half, 1e-4);
    arena_clear(&a);
}

TEST(values_that_never_settle_exhaust_the_samples)
{
    arena a           = { 0 };
    fake f            = { .value = by_scramble };
    accuracy_desc d   = desc_of(&f, 1);
    d.first_samples   = BUNDLE;
    accuracy_result r = run(&a, &d);
    assert_true(r.end == RUN_EXHAUSTED && r.complete && r.missed == 1);
    assert_int_equal(r.samples[0], SCRAMBLES * MOST_SAMPLES);
    assert_near(r.half_width[0], unit_half, 1e-4);
    arena_clear(&a);
}

TEST(every_end_but_success_has_a_text)
{
    assert_null(run_end_text(RUN_DONE));
    for (run_end end = RUN_INTERRUPTED; end <= RUN_HELD_UP; end++)
        assert_non_null(run_end_text(end));
}

TEST(memory_that_is_out_is_an_error)
{
    for (int late = 0; late < 2; late++) { /* at once, or amid the first round */
        arena a         = { 0 };
        fake f          = { .value = by_scramble, .lose_memory = late };
        accuracy_desc d = desc_of(&f, 3);
        lux_error err   = { 0 };
        accuracy_result r;
        memory_is_out = !late;
        bool good     = accuracy_run(&a, &d, &r, &err);
        memory_is_out = false;
        assert_false(good);
        assert_int_equal(err.code, ERR_MEMORY);
        arena_clear(&a);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_half_width_is_student_s_of_the_scrambles_means),
        cmocka_unit_test(an_average_is_as_sure_as_what_items_share_lets_it_be),
        cmocka_unit_test(an_item_is_not_taken_to_be_much_surer_than_the_others),
        cmocka_unit_test(what_is_known_exactly_counts_in_the_accuracy_and_not_in_the_mean),
        cmocka_unit_test(what_is_left_out_widens_the_interval_by_its_bound),
        cmocka_unit_test(several_channels_are_judged_each_by_itself),
        cmocka_unit_test(a_small_part_is_judged_by_what_it_is_part_of),
        cmocka_unit_test(what_bounds_alone_spoil_is_not_sampled_for_ever),
        cmocka_unit_test(what_all_samples_of_a_scramble_share_is_not_sampled_for_ever),
        cmocka_unit_test(a_channel_that_is_only_told_has_a_half_width_and_no_say),
        cmocka_unit_test(every_channel_has_its_means),
        cmocka_unit_test(looking_after_each_round_leaves_the_intervals_valid),
        cmocka_unit_test(samples_double_until_the_accuracy_is_reached),
        cmocka_unit_test(the_share_needed_may_leave_the_worst_items_behind),
        cmocka_unit_test(the_floor_is_a_tenth_of_the_mean_or_of_the_geometric_mean),
        cmocka_unit_test(darkness_is_believed_after_the_samples_asked_for),
        cmocka_unit_test(passes_and_threads_change_no_byte),
        cmocka_unit_test(passes_and_threads_change_no_byte_of_items_in_pieces),
        cmocka_unit_test(passes_and_threads_change_no_byte_of_a_long_round),
        cmocka_unit_test(a_deadline_already_past_leaves_two_scrambles_of_each_item),
        cmocka_unit_test(a_stop_in_the_first_pass_leaves_nothing_complete),
        cmocka_unit_test(a_stop_in_a_later_pass_keeps_the_passes_before),
        cmocka_unit_test(a_stop_in_a_later_round_keeps_the_sums_of_items_not_finished),
        cmocka_unit_test(values_that_never_settle_exhaust_the_samples),
        cmocka_unit_test(every_end_but_success_has_a_text),
        cmocka_unit_test(memory_that_is_out_is_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
