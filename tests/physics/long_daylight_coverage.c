/* tests/physics/long_daylight_coverage.c -- intervals of daylight hold the truth, over 100 seeds.
 *
 * Of 95 % intervals, pooled over sensors and seeds, at least 93 % must hold it, and 95 % of the
 * values must be as accurate as asked.
 */
#include "tests/physics/daylight_coverage.h"

enum { SEEDS = 100 };

static void covers(const char *what, const char *yaml, double accuracy)
{
    lab l;
    lab_open(&l);
    write_sunny_panorama(&l);
    coverage c = coverage_of(&l, yaml, accuracy, SEEDS);
    printf("%s, %g %%: of %d intervals %.1f %% hold the truth, %.1f %% of the values are as "
           "accurate as asked\n",
           what, 100.0 * accuracy, c.all, 100.0 * c.held / c.all, 100.0 * c.within / c.all);
    lab_close(&l);
    assert_true(c.held >= 0.93 * c.all && c.within >= 0.95 * c.all);
}

TEST(an_overcast_room)
{
    covers("overcast", LIT_BY("sky: {model: overcast, horizontal: 10000}\n"), 0.05);
    covers("overcast", LIT_BY("sky: {model: overcast, horizontal: 10000}\n"), 0.02);
}

TEST(a_clear_sky_and_the_patch_of_its_sun)
{
    covers("clear sky and sun", LIT_BY(CLEAR), 0.05);
    covers("clear sky and sun", LIT_BY(CLEAR), 0.02);
}

TEST(a_panorama_through_a_window)
{
    covers("panorama", LIT_BY("sky: {model: panorama, file: sky.exr}\n"), 0.05);
    covers("panorama", LIT_BY("sky: {model: panorama, file: sky.exr}\n"), 0.02);
}

TEST(sensors_in_the_half_shadow_of_the_sun)
{
    covers("half shadow", HALF_SHADOW, 0.05);
    covers("half shadow", HALF_SHADOW, 0.02);
}

TEST(hours_of_a_series) { covers("series", LIT_BY(SERIES), 0.05); }

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_overcast_room),
        cmocka_unit_test(a_clear_sky_and_the_patch_of_its_sun),
        cmocka_unit_test(a_panorama_through_a_window),
        cmocka_unit_test(sensors_in_the_half_shadow_of_the_sun),
        cmocka_unit_test(hours_of_a_series),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
