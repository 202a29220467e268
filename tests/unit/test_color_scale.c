/* tests/unit/test_color_scale.c -- bands of false colours hold what they say, and print in grey. */
#include "sim/color_scale.h"
#include "tests/test.h"

TEST(limits_are_of_the_series_1_2_5)
{
    static const double want[] = { 0, 100, 200, 500, 1000, 2000, 5000, 1e4, 2e4, 5e4, 1e5 };
    color_scale s              = color_scale_125(RAMP_LIGHT, 0.0, 86293.2);
    assert_int_equal(s.bands, 10);
    for (int i = 0; i <= 10; i++)
        assert_true(s.limit[i] == want[i]);
}

TEST(a_scale_begins_below_the_least_value)
{
    static const double want[] = { 0.5, 1, 2, 5, 10, 20 };
    color_scale s              = color_scale_125(RAMP_LIGHT, 0.61, 19.9);
    assert_int_equal(s.bands, 5);
    for (int i = 0; i <= 5; i++)
        assert_true(s.limit[i] == want[i]);
}

TEST(what_is_a_limit_itself_fits)
{
    for (double most = 1e-6; most < 1e7; most *= 1.37) {
        color_scale s = color_scale_125(RAMP_LIGHT, 0.5 * most, most);
        assert_true(s.limit[s.bands] >= most && s.limit[s.bands] < 2.5 * most * (1 + 1e-9));
        assert_true(s.limit[0] <= 0.5 * most);
    }
    color_scale even = color_scale_125(RAMP_LIGHT, 500.0, 500.0);
    assert_true(even.limit[even.bands] == 500.0 && even.bands >= 1);
}

TEST(hours_have_equal_steps)
{
    color_scale s = color_scale_even(RAMP_HOURS, 8.0);
    assert_int_equal(s.bands, 8);
    assert_true(s.limit[0] == 0.0 && s.limit[1] == 1.0 && s.limit[8] == 8.0);
    s = color_scale_even(RAMP_HOURS, 10.5);
    assert_int_equal(s.bands, 6);
    assert_true(s.limit[6] == 12.0);
}

TEST(darkness_has_a_scale)
{
    color_scale s = color_scale_125(RAMP_LIGHT, 0.0, 0.0);
    assert_true(s.bands >= 1 && s.limit[s.bands] == 1.0 && s.limit[0] == 0.0);
    assert_int_equal(color_scale_band(&s, 0.0), 0);
    s = color_scale_even(RAMP_HOURS, 0.0);
    assert_true(s.limit[s.bands] == 1.0);
}

TEST(a_band_holds_its_lower_limit_and_not_its_upper)
{
    color_scale s = color_scale_125(RAMP_LIGHT, 0.0, 5e4);
    for (int i = 0; i < s.bands; i++) {
        assert_int_equal(color_scale_band(&s, s.limit[i]), i);
        assert_int_equal(color_scale_band(&s, nextafter(s.limit[i + 1], 0.0)), i);
    }
    assert_int_equal(color_scale_band(&s, 1e9), s.bands - 1);
}

/* Lightness by the weights of Rec. 709. */
TEST(each_band_is_lighter_than_the_one_below)
{
    for (int ramp = RAMP_LIGHT; ramp <= RAMP_HOURS; ramp++)
        for (int bands = 1; bands <= MOST_BANDS; bands++) {
            color_scale s = { .ramp = (color_ramp)ramp, .bands = bands };
            double before = -1.0;
            for (int i = 0; i < bands; i++) {
                uint8_t rgb[3];
                color_scale_color(&s, i, rgb);
                double light = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
                assert_true(light > before + 5.0);
                before = light;
            }
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(limits_are_of_the_series_1_2_5),
        cmocka_unit_test(a_scale_begins_below_the_least_value),
        cmocka_unit_test(what_is_a_limit_itself_fits),
        cmocka_unit_test(hours_have_equal_steps),
        cmocka_unit_test(darkness_has_a_scale),
        cmocka_unit_test(a_band_holds_its_lower_limit_and_not_its_upper),
        cmocka_unit_test(each_band_is_lighter_than_the_one_below),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
