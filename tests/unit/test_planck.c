/* tests/unit/test_planck.c -- colours of black bodies against published chromaticities. */
#include "sim/planck.h"
#include "tests/test.h"

TEST(chromaticities_are_the_published_ones)
{
    /* 2856 K: CIE illuminant A (CIE 015); the others: the Planckian locus for the CIE 1931
     * observer as it is commonly tabulated */
    static const double table[][3] = {
        { 1000, 0.6527, 0.3445 },  { 1500, 0.5857, 0.3931 },  { 2000, 0.5267, 0.4133 },
        { 2856, 0.4476, 0.4074 },  { 4000, 0.3805, 0.3768 },  { 5000, 0.3451, 0.3516 },
        { 6500, 0.3135, 0.3237 },  { 10000, 0.2807, 0.2884 }, { 15000, 0.2637, 0.2673 },
        { 20000, 0.2565, 0.2577 },
    };
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        double x, y;
        assert_true(planck_chromaticity(table[i][0], &x, &y));
        if (fabs(x - table[i][1]) > 5e-4 || fabs(y - table[i][2]) > 5e-4) /* the fits' own error */
            fail_msg("%g K: %.4f %.4f", table[i][0], x, y);
    }
}

TEST(the_two_formulae_meet)
{
    double x, y, x2, y2;
    planck_chromaticity(15000.0, &x, &y);
    planck_chromaticity(15000.001, &x2, &y2);
    assert_true(fabs(x - x2) < 3e-4 && fabs(y - y2) < 3e-4);
}

TEST(every_color_has_luminance_1_and_no_negative_channel)
{
    for (double t = 1000.0; t <= 25000.0; t += 100.0) {
        vec3 c;
        assert_true(planck_color(t, &c));
        assert_true(c.x >= 0.0f && c.y > 0.0f && c.z >= 0.0f);
        assert_near(0.2126 * (double)c.x + 0.7152 * (double)c.y + 0.0722 * (double)c.z, 1.0, 1e-6);
    }
}

/* Back by the matrix of BT.709's primaries and white (SMPTE RP 177). From 2000 K on all three
 * channels are above 0. */
TEST(colors_have_the_chromaticity_of_their_temperature)
{
    for (double t = 2000.0; t <= 25000.0; t += 500.0) {
        vec3 c;
        double x, y;
        assert_true(planck_color(t, &c));
        assert_true(planck_chromaticity(t, &x, &y));
        double r = (double)c.x, g = (double)c.y, b = (double)c.z;
        double big_x = 0.4123908 * r + 0.3575843 * g + 0.1804808 * b;
        double big_y = 0.2126390 * r + 0.7151687 * g + 0.0721923 * b;
        double big_z = 0.0193308 * r + 0.1191948 * g + 0.9505322 * b;
        assert_near(big_x / (big_x + big_y + big_z), x, 1e-5); /* seven digits, and floats */
        assert_near(big_y / (big_x + big_y + big_z), y, 1e-5);
    }
}

TEST(a_body_of_6504_kelvin_is_nearly_white_and_cooler_ones_are_red)
{
    vec3 white, warm;
    planck_color(6504.0, &white); /* D65 lies 0.005 above the locus in y: a little green lacks */
    assert_near(white.x, 1.0, 0.05);
    assert_near(white.y, 1.0, 0.05);
    assert_near(white.z, 1.0, 0.05);
    planck_color(2700.0, &warm);
    assert_true(warm.x > 2.0f * warm.y && warm.y > 2.0f * warm.z);
}

TEST(temperatures_outside_the_formulae_are_refused)
{
    static const double table[] = { 999.9, 25000.1, -1.0, 0.0, (double)NAN, (double)INFINITY };
    vec3 c                      = { -1, -1, -1 };
    for (size_t i = 0; i < sizeof table / sizeof *table; i++)
        assert_false(planck_color(table[i], &c));
    assert_true(c.x == -1.0f);
}

TEST(black_has_no_luminance_to_scale)
{
    static const double black[] = { 0, 0, 0 }, below[] = { -1, -2, 0 }, blue[] = { -1, 0, 7 };
    vec3 c;
    assert_false(rgb_scale_to_luminance_1(black, &c));
    assert_false(rgb_scale_to_luminance_1(below, &c));
    assert_true(rgb_scale_to_luminance_1(blue, &c));
    assert_near(c.z, 1.0 / 0.0722, 1e-6);
    assert_true(c.x == 0.0f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(chromaticities_are_the_published_ones),
        cmocka_unit_test(the_two_formulae_meet),
        cmocka_unit_test(every_color_has_luminance_1_and_no_negative_channel),
        cmocka_unit_test(colors_have_the_chromaticity_of_their_temperature),
        cmocka_unit_test(a_body_of_6504_kelvin_is_nearly_white_and_cooler_ones_are_red),
        cmocka_unit_test(temperatures_outside_the_formulae_are_refused),
        cmocka_unit_test(black_has_no_luminance_to_scale),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
