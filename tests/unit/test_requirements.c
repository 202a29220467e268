/* tests/unit/test_requirements.c -- when a requirement is met, and when that can be told. */
#include "sim/grid.h"
#include "tests/test.h"

enum { SENSORS = 50 };

/* 50 sensors of 100 lx, each to 1 lx with 95 %. All of them at once: with 1 - 0.05 / 50 = 99.9 %
 * each, for which Student's t of 15 degrees of freedom is 4.0728 in place of 2.1314 (Abramowitz and
 * Stegun, table 26.10): to 1.9109 lx. */
static const double together = 4.0728 / 2.1314;

static grid_requirement judged(study_grid g)
{
    static double lux[SENSORS], half[SENSORS];
    for (int k = 0; k < SENSORS; k++)
        lux[k] = 100.0, half[k] = 1.0;
    grid_result r = { .grid               = &g,
                      .sensor_count       = SENSORS,
                      .illuminance        = lux,
                      .half_width         = half,
                      .average            = 100.0,
                      .minimum            = 100.0,
                      .maximum            = 100.0,
                      .uniformity         = 1.0,
                      .average_half_width = 1.0 };
    grid_requirement out[MOST_REQUIREMENTS];
    assert_int_equal(grid_requirements(&r, out), 1);
    return out[0];
}

static study_grid asking(double average, double minimum, double maximum, double uniformity)
{
    return (study_grid){ .require_average    = average,
                         .require_minimum    = minimum,
                         .require_maximum    = maximum,
                         .require_uniformity = uniformity };
}
static const double none = (double)NAN;

TEST(an_average_is_told_by_its_own_half_width)
{
    grid_requirement r = judged(asking(99.5, none, none, none));
    assert_true(r.met && !r.decided);
    assert_near(r.half_width, 1.0, 1e-12);
    r = judged(asking(98.9, none, none, none));
    assert_true(r.met && r.decided);
    r = judged(asking(101.1, none, none, none));
    assert_true(!r.met && r.decided);
}

TEST(a_minimum_is_told_by_intervals_that_hold_all_at_once)
{
    grid_requirement r = judged(asking(none, 100.0 - 0.99 * together, none, none));
    assert_near(r.half_width, together, 1e-4);
    assert_true(r.met && !r.decided);
    r = judged(asking(none, 100.0 - 1.01 * together, none, none));
    assert_true(r.met && r.decided);
    r = judged(asking(none, 100.0 + 0.99 * together, none, none));
    assert_true(!r.met && !r.decided);
    r = judged(asking(none, 100.0 + 1.01 * together, none, none));
    assert_true(!r.met && r.decided);
}

TEST(a_maximum_asks_for_less)
{
    grid_requirement r = judged(asking(none, none, 100.0 + 1.01 * together, none));
    assert_true(r.met && r.decided);
    r = judged(asking(none, none, 100.0 + 0.99 * together, none));
    assert_true(r.met && !r.decided);
    r = judged(asking(none, none, 100.0 - 1.01 * together, none));
    assert_true(!r.met && r.decided);
}

TEST(a_uniformity_is_told_by_minimum_and_average)
{
    double low         = (100.0 - together) / 101.0;
    grid_requirement r = judged(asking(none, none, none, low - 1e-4));
    assert_true(r.met && r.decided);
    r = judged(asking(none, none, none, low + 1e-4));
    assert_true(r.met && !r.decided);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_average_is_told_by_its_own_half_width),
        cmocka_unit_test(a_minimum_is_told_by_intervals_that_hold_all_at_once),
        cmocka_unit_test(a_maximum_asks_for_less),
        cmocka_unit_test(a_uniformity_is_told_by_minimum_and_average),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
