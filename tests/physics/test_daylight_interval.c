/* tests/physics/test_daylight_interval.c -- intervals of daylight hold the truth: the short cousin
 * of long_daylight_coverage.c.
 *
 * Errors of one run are related, so that of so few seeds 90 % must hold it.
 */
#include "tests/physics/daylight_coverage.h"

enum { SEEDS = 10 };

static void covers(const char *what, const char *yaml, double accuracy)
{
    lab l;
    lab_open(&l);
    write_sunny_panorama(&l);
    coverage c = coverage_of(&l, yaml, accuracy, SEEDS);
    lab_close(&l);
    if (!(c.held >= 0.90 * c.all && c.within >= 0.95 * c.all))
        fail_msg("%s: of %d intervals %d hold the truth, %d values are as accurate as asked", what,
                 c.all, c.held, c.within);
}

TEST(an_overcast_room)
{
    covers("overcast", LIT_BY("sky: {model: overcast, horizontal: 10000}\n"), 0.05);
}

TEST(a_clear_sky_and_the_patch_of_its_sun) { covers("clear sky and sun", LIT_BY(CLEAR), 0.05); }

TEST(a_panorama_through_a_window)
{
    covers("panorama", LIT_BY("sky: {model: panorama, file: sky.exr}\n"), 0.05);
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
