/* tests/physics/test_scene_coverage.c -- stated intervals hold the truth in four scenes: the short
 * cousin of long_scene_coverage.c, without those that end after two rounds.
 *
 * Of some 240 intervals a scene 90 % must hold it: where 95 % do, fewer are found once in 2,000
 * times; where 85 % do, as many once in 60.
 */
#include "tests/physics/scene_coverage.h"

enum { SEEDS = 20 };

static void covers(const char *what, const trial_scene *t, run_stop stop, double accuracy,
                   const coverage *c)
{
    if (!(c->held >= 0.90 * c->all && (stop != AT_ACCURACY || c->within >= 0.95 * c->all)))
        fail_msg("%s, %s, %g %%, %s: of %d intervals %d hold the truth, %d values are as accurate "
                 "as asked",
                 what, t->name, 100.0 * accuracy, stop_text[stop], c->all, c->held, c->within);
}

TEST(intervals_of_sensors_hold_the_truth)
{
    for (int i = 0; i < TRIAL_SCENES; i++) {
        const trial_scene *t = &trial_scenes[i];
        double accuracy      = 1.5 * t->accuracy;
        lab l;
        lab_open(&l);
        const scene *s   = make_trial_scene(&l, t);
        grid_truth truth = find_grid_truth(&l, s, t, (t->mirrored ? 2.0 : 0.4) * accuracy);
        for (run_stop stop = t->mirrored ? AFTER_TWO_SCRAMBLES : 0; stop < RUN_STOPS;
             stop += AFTER_TWO_SCRAMBLES) {
            coverage c = grid_coverage(s, &truth, stop, accuracy, SEEDS);
            covers("grid", t, stop, accuracy, &c);
        }
        lab_close(&l);
    }
}

/* Pictures of 16 by 12 pixels. */
TEST(intervals_of_pixels_hold_the_truth)
{
    for (int i = 0; i < TRIAL_SCENES; i++) {
        const trial_scene *t = &trial_scenes[i];
        if (t->mirrored) /* takes long */
            continue;
        lab l;
        lab_open(&l);
        const scene *s    = make_trial_scene(&l, t);
        study_view v      = trial_view(t);
        v.width           = 16;
        v.height          = 12;
        view_result truth = find_view_truth(&l, s, &v, 0.15);
        for (run_stop stop = 0; stop < RUN_STOPS; stop += AFTER_TWO_SCRAMBLES) {
            coverage c = view_coverage(s, &v, &truth, stop, 0.2, 2);
            covers("view", t, stop, 0.2, &c);
        }
        lab_close(&l);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(intervals_of_sensors_hold_the_truth),
        cmocka_unit_test(intervals_of_pixels_hold_the_truth),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
