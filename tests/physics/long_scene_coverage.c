/* tests/physics/long_scene_coverage.c -- what is promised of --accuracy and --time, in four scenes,
 * of grids and of pictures: of all the intervals of 95 % that runs state, at least 93 % hold the
 * truth, and in no scene fewer than 92 %; and at least 95 % of the values are as accurate as asked,
 * unless it was a deadline that ended the run.
 *
 * At least 1,000 sensors times seeds in each scene: 92 % of them is 4 standard deviations below
 * 95 %.
 */
#include "tests/physics/scene_coverage.h"

enum { TRIALS = 1000 };

/* So many seeds, of `unknowns` each. */
static int seeds_for(int unknowns) { return (TRIALS + unknowns - 1) / unknowns; }

static void keeps_its_word(const char *what, const trial_scene *t, run_stop stop, double accuracy,
                           const coverage *c, coverage *pool)
{
    print_coverage(what, t, stop, accuracy, c);
    assert_true(c->all >= TRIALS && c->held >= 0.92 * c->all);
    assert_true(stop != AT_ACCURACY || c->within >= 0.95 * c->all);
    add_coverage(&pool[stop], c);
}

static void assert_pool(const char *what, const coverage *pool)
{
    for (run_stop stop = 0; stop < RUN_STOPS; stop++) {
        const coverage *c = &pool[stop];
        printf("%s, all, %s: of %d intervals %.1f %% hold the truth\n", what, stop_text[stop],
               c->all, 100.0 * c->held / c->all);
        assert_true(c->held >= 0.93 * c->all);
    }
}

TEST(sensors_of_grids_keep_the_promise)
{
    coverage pool[RUN_STOPS] = { 0 };
    for (int i = 0; i < TRIAL_SCENES; i++) {
        const trial_scene *t = &trial_scenes[i];
        lab l;
        lab_open(&l);
        const scene *s   = make_trial_scene(&l, t);
        double accuracy  = t->accuracy;
        grid_truth truth = find_grid_truth(&l, s, t, (t->mirrored ? 0.5 : 0.1) * accuracy);
        for (run_stop stop = 0; stop < RUN_STOPS; stop++) {
            coverage c = grid_coverage(s, &truth, stop, accuracy, seeds_for(truth.r.sensor_count));
            keeps_its_word("grid", t, stop, accuracy, &c, pool);
        }
        lab_close(&l);
    }
    assert_pool("grid", pool);
}

TEST(pixels_of_views_keep_the_promise)
{
    coverage pool[RUN_STOPS] = { 0 };
    for (int i = 0; i < TRIAL_SCENES; i++) {
        const trial_scene *t = &trial_scenes[i];
        lab l;
        lab_open(&l);
        const scene *s    = make_trial_scene(&l, t);
        study_view v      = trial_view(t);
        double accuracy   = t->mirrored ? 0.2 : 0.1;
        view_result truth = find_view_truth(&l, s, &v, 0.6 * accuracy);
        for (run_stop stop = 0; stop < RUN_STOPS; stop++) {
            coverage c =
                view_coverage(s, &v, &truth, stop, accuracy, seeds_for(v.width * v.height));
            keeps_its_word("view", t, stop, accuracy, &c, pool);
        }
        lab_close(&l);
    }
    assert_pool("view", pool);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sensors_of_grids_keep_the_promise),
        cmocka_unit_test(pixels_of_views_keep_the_promise),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
