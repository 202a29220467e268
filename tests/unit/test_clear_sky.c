/* tests/unit/test_clear_sky.c -- how bright sun and sky are by formula. */
#include "sky/sky.h"
#include "tests/test.h"

#include <string.h>

static const double pi = 3.14159265358979324;

/* The IESNA Lighting Handbook's clear day: 127.5 exp(-0.21 / sin h) klx of sun, 0.8 + 15.5 sin^0.5
 * h klx of sky. Of another atmosphere, and so within a tenth; the sky's from 30 degrees on. */
TEST(a_turbidity_of_three_is_the_handbooks_clear_day)
{
    for (double h = 10; h <= 90; h += 5) {
        double s = sin(h * pi / 180);
        assert_near(sky_sun_lx(h, 0, 3, 1), 127.5e3 * exp(-0.21 / s), 0.07);
        if (h >= 30)
            assert_near(sky_diffuse_lx(12, h, 0, 3), 800 + 15500 * sqrt(s), 0.17);
    }
    assert_near(sky_sun_lx(10, 0, 3, 1), 38050, 0.01);
    assert_near(sky_sun_lx(60, 0, 3, 1), 100050, 0.01);
}

/* By hand at 60 degrees and T = 3: m = 1.15396, 1/delta = 8.50012, E_sun = 1367 exp(-0.352786) =
 * 960.64 W/m^2; Trd = 0.0792033, A = 0.108154, 1.996586, -1.108235: E_sky = 108.918 W/m^2; delta of
 * Perez 0.091943; efficacies 103.429 and 132.773 lm/W. */
TEST(sixty_degrees_are_as_by_hand)
{
    double s = sin(pi / 3), m = 1 / (s + 0.50572 * pow(66.07995, -1.6364));
    double rayleigh =
        6.6296 + 1.7513 * m - 0.1202 * m * m + 0.0065 * m * m * m - 0.00013 * m * m * m * m;
    double beam  = 1367 * exp(-0.8662 * 3 * m / rayleigh);
    double trd   = -0.015843 + 0.030543 * 3 + 3.797e-4 * 9;
    double a0    = 0.26463 - 0.061581 * 3 + 0.0031408 * 9;
    double a1    = 2.0402 + 0.018945 * 3 - 0.011161 * 9;
    double a2    = -1.3025 + 0.039231 * 3 + 0.0085079 * 9;
    double level = 1367 * trd * (a0 + a1 * s + a2 * s * s);
    double delta = m * level / 1367;
    double sun   = beam * (101.18 + 3.16 - 1.1 * exp(5.73 * pi / 6 - 5) - 8.29 * delta);
    double clear = level * (152.23 + 0.7 - 45.27 * s - 7.98 * log(delta));
    assert_near(sky_sun_lx(60, 0, 3, 1), sun, 1e-9);
    assert_near(sky_diffuse_lx(12, 60, 0, 3), clear, 1e-9);
    assert_true(sun > 95e3 && sun < 100e3 && clear > 10e3 && clear < 15e3);
}

TEST(cloudy_skies_are_the_handbooks)
{
    for (int type = 0; type <= 16; type++)
        for (double h = 1; h <= 90; h += 1) {
            double s = sin(h * pi / 180), got = sky_diffuse_lx(type, h, 0, 3);
            if (type >= 6 && type <= 10)
                assert_near(got, 300 + 45000 * s, 1e-9);
            else if (type < 6 || type == 16)
                assert_near(got, 300 + 21000 * s, 1e-9);
        }
    assert_near(sky_diffuse_lx(16, 60, 0, 3), 18486.5, 1e-5);
}

TEST(all_are_continuous_and_zero_below_the_horizon)
{
    static const double turbidities[] = { 1, 2, 3, 4.5, 7, 12, 20 };
    for (int type = 0; type <= 16; type++)
        for (int i = 0; i < 7; i++) {
            double t = turbidities[i], level = 0, sun = 0;
            for (int k = 0; k <= 90000; k += type % 6 ? 50 : 5) {
                double h = k * 1e-3, step = type % 6 ? 50e-3 : 5e-3;
                double next = sky_diffuse_lx(type, h, 0, t), beam = sky_sun_lx(h, 0, t, 1);
                assert_true(next >= 0 && next < 7e4 && beam >= 0 && beam < 133.8e3);
                assert_true(fabs(next - level) < 5000 * step && fabs(beam - sun) < 60000 * step);
                assert_true(k == 0 || (next > 0 && beam > 0));
                level = next;
                sun   = beam;
            }
        }
    assert_true(sky_sun_lx(0, 0, 3, 1) == 0 && sky_sun_lx(-5, 0, 3, 1) == 0);
    assert_true(sky_diffuse_lx(12, 0, 0, 3) == 0 && sky_diffuse_lx(16, -0.1, 0, 3) == 0);
    assert_true(sky_sun_lx((double)NAN, 0, 3, 1) == 0 &&
                sky_diffuse_lx(12, 30, 0, (double)NAN) == 0);
    assert_true(sky_diffuse_lx(12, 30, 0, 21) == 0 && sky_sun_lx(30, 0, 0.9, 1) == 0);
}

TEST(the_sun_gains_by_height_and_nearness_and_loses_by_turbidity)
{
    assert_true(sky_sun_lx(40, 2000, 3, 1) > 1.03 * sky_sun_lx(40, 0, 3, 1));
    assert_true(sky_diffuse_lx(12, 40, 2000, 3) < sky_diffuse_lx(12, 40, 0, 3));
    assert_near(sky_sun_lx(40, 0, 3, 0.9833), sky_sun_lx(40, 0, 3, 1) / (0.9833 * 0.9833), 1e-12);
    for (double t = 1; t < 20; t += 0.5)
        assert_true(sky_sun_lx(40, 0, t + 0.5, 1) < sky_sun_lx(40, 0, t, 1));
    for (double t = 1; t < 11.5; t += 0.5)
        assert_true(sky_diffuse_lx(12, 60, 0, t + 0.5) > sky_diffuse_lx(12, 60, 0, t));
}

TEST(formulae_have_names)
{
    assert_non_null(strstr(sky_sun_formula(), "Kasten 1996"));
    assert_non_null(strstr(sky_diffuse_formula(12), "ESRA"));
    assert_non_null(strstr(sky_diffuse_formula(7), "partly cloudy"));
    assert_non_null(strstr(sky_diffuse_formula(16), "overcast"));
    assert_true(sky_diffuse_formula(0) == sky_diffuse_formula(1));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_turbidity_of_three_is_the_handbooks_clear_day),
        cmocka_unit_test(sixty_degrees_are_as_by_hand),
        cmocka_unit_test(cloudy_skies_are_the_handbooks),
        cmocka_unit_test(all_are_continuous_and_zero_below_the_horizon),
        cmocka_unit_test(the_sun_gains_by_height_and_nearness_and_loses_by_turbidity),
        cmocka_unit_test(formulae_have_names),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
