/* tests/physics/long_daylight_paths.c -- the same light of day whatever is known of openings, to
 * half a percent.
 */
#include "tests/physics/daylight_paths.h"

TEST(skies_give_the_same_to_half_a_percent)
{
    all_openings_agree("sky: {model: clear, sun: off, sun_at: {azimuth: 200, elevation: 40}}\n",
                       0.004, 0.005, 0.01);
    all_openings_agree("sky: {model: panorama, file: sky.exr}\n", 0.004, 0.005, 0.01);
}

TEST(suns_give_the_same_to_half_a_percent)
{
    all_openings_agree(SUN_ALONE("200", "40", "disk") "0}\n", 0.004, 0.005, 0.01);
    all_openings_agree(SUN_ALONE("160", "30", "point") "0.4}\n", 0.004, 0.005, 0.01);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(skies_give_the_same_to_half_a_percent),
        cmocka_unit_test(suns_give_the_same_to_half_a_percent),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
