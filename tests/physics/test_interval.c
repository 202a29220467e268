/* tests/physics/test_interval.c -- the interval that is claimed holds the truth as often as
 * claimed.
 *
 * Of 95 % intervals, pooled over sensors and seeds, at least 93 % must hold the truth, which is
 * known exactly (a glowing box) or from an independent simulation (box_ies, where it is present).
 * Each run stops by itself at the accuracy asked for: the bias of stopping early is part of what is
 * tested.
 */
#include "core/color.h"
#include "tests/box.h"
#include "tests/box_ies.h"
#include "tests/folder.h"
#include "tests/test.h"

typedef struct score {
    int sensors, held, within;
} score;

static void count(score *s, const grid_result *r, const double *truth, double accuracy)
{
    double average = 0.0;
    for (int k = 0; k < r->sensor_count; k++)
        average += truth[k] / r->sensor_count;
    for (int k = 0; k < r->sensor_count; k++) {
        double off = fabs(r->illuminance[k] - truth[k]);
        s->sensors++;
        s->held += off <= r->half_width[k];
        s->within += off <= accuracy * fmax(truth[k], 0.1 * average);
    }
}

static void assert_score(const score *s, const char *what)
{
    if (!(s->sensors >= 1000 && s->held >= 0.93 * s->sensors && s->within >= 0.95 * s->sensors))
        fail_msg(
            "%s: of %d intervals %d hold the truth (93 %% wanted), %d values are as accurate as "
            "asked (95 %% wanted)",
            what, s->sensors, s->held, s->within);
}

/* L = L_e / (1 - rho) everywhere; paths end at random, and so their samples differ. */
TEST(intervals_in_a_glowing_box_hold_the_truth)
{
    arena a           = { 0 };
    const vec3 rho[3] = { { 0.6f, 0.6f, 0.6f }, { 0.6f, 0.6f, 0.6f }, { 0.6f, 0.6f, 0.6f } };
    const vec3 le[3]  = { { 1, 1, 1 }, { 1, 1, 1 }, { 1, 1, 1 } };
    const scene *s    = box_scene(&a, (dvec3){ 4, 3, 2.5 }, rho, le, true);
    study_grid g      = {
             .name = "g", .origin = { 0, 0, 0.8 }, .u = { 4, 0, 0 }, .v = { 0, 3, 0 }, .spacing = 1
    };
    double truth[12];
    for (int k = 0; k < 12; k++)
        truth[k] = M_PI * LUMENS_PER_WATT / (1.0 - (double)0.6f);
    score all = { 0 };
    for (uint32_t seed = 1; seed <= 100; seed++) {
        arena run     = { 0 };
        run_options o = { .accuracy = 0.03, .deadline = HUGE_VAL, .seed = seed, .threads = 1 };
        grid_result r;
        assert_true(grid_run(&run, s, &g, &o, &r, NULL));
        count(&all, &r, truth, 0.03);
        arena_clear(&run);
    }
    assert_score(&all, "glowing box");
    arena_clear(&a);
}

static void box_ies_holds(double accuracy, uint32_t seeds)
{
    arena a = { 0 };
    box_ies b;
    if (!box_ies_read(&a, &b))
        skip();
    score all = { 0 };
    for (uint32_t seed = 1; seed <= seeds; seed++) {
        arena run = { 0 };
        grid_result r;
        grid_of_scene(&run, b.scene, 0,
                      &(run_options){ .accuracy = accuracy, .seed = seed, .threads = 2 }, &r);
        assert_int_equal(r.sensor_count, BOX_IES_SENSORS);
        count(&all, &r, b.total, accuracy);
        arena_clear(&run);
    }
    assert_score(&all, "box_ies");
    arena_clear(&a);
}

TEST(intervals_of_5_percent_hold_an_independent_truth) { box_ies_holds(0.05, 20); }
TEST(intervals_of_2_percent_hold_an_independent_truth) { box_ies_holds(0.02, 10); }

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(intervals_in_a_glowing_box_hold_the_truth),
        cmocka_unit_test(intervals_of_5_percent_hold_an_independent_truth),
        cmocka_unit_test(intervals_of_2_percent_hold_an_independent_truth),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
