/* tests/unit/test_site.c -- sky/site.h */
#include "sky/site.h"
#include "tests/test.h"

#include <string.h>

static void check_place(const char *text, double latitude_deg, double longitude_deg,
                        double tolerance_deg)
{
    site s        = { 0 };
    lux_error err = { 0 };
    if (!site_read(&s, text, &err))
        fail_msg("%s", err.text);
    if (!(fabs(s.latitude_deg - latitude_deg) <= tolerance_deg &&
          fabs(s.longitude_deg - longitude_deg) <= tolerance_deg))
        fail_msg("%s is %.7f %.7f", text, s.latitude_deg, s.longitude_deg);
    assert_true(s.altitude_m == 0.0);
}

TEST(degrees_are_read_in_every_notation)
{
    check_place("55.7558N 37.6173E", 55.7558, 37.6173, 1e-12);
    check_place("37.6173E 55.7558N", 55.7558, 37.6173, 1e-12);
    check_place("55.7558 37.6173", 55.7558, 37.6173, 1e-12);
    check_place("  55.7558,\t37.6173 ", 55.7558, 37.6173, 1e-12);
    check_place("33.87S 151.22E", -33.87, 151.22, 1e-12);
    check_place("-33.87 -70.5", -33.87, -70.5, 1e-12);
    check_place("55d45'21\"N 37d37'2\"E", 55 + 45 / 60.0 + 21 / 3600.0, 37 + 37 / 60.0 + 2 / 3600.0,
                1e-12);
    check_place("55:45:21N 37:37:02E", 55 + 45 / 60.0 + 21 / 3600.0, 37 + 37 / 60.0 + 2 / 3600.0,
                1e-12);
    check_place("55\xc2\xb0"
                "45'N 37\xc2\xb0"
                "37'E",
                55.75, 37 + 37 / 60.0, 1e-12);
}

/* UTM's central meridian and equator are exact; a square of MGRS is read at its centre, so to half
 * of its side. */
TEST(maps_are_read)
{
    check_place("37N 500000 0", 0.0, 39.0, 1e-9);
    check_place("37S 500000 10000000", 0.0, 39.0, 1e-9);
    check_place("N 2000000 1300000", 83.7, 0.0, 0.1); /* 700 km / 0.994 from the pole */
    check_place("31NAA6602100000", 0.0, 0.0, 2e-5);
    check_place("37N 413000 6180000", 55.758, 37.614, 0.01);
    check_place("37UDB1300080000", 55.758, 37.614, 0.01);
}

TEST(poles_and_the_date_line_are_places)
{
    check_place("90N 0E", 90.0, 0.0, 0.0);
    check_place("90S 37E", -90.0, 37.0, 0.0);
    check_place("0 180", 0.0, 180.0, 0.0);
    check_place("0 -180", 0.0, -180.0, 0.0);
    check_place("0 279", 0.0, -81.0, 0.0); /* east of Greenwich, as tables of JPL have it */
}

TEST(what_is_no_place_is_refused)
{
    const char *bad[] = { "",
                          " ",
                          "91N 0E",
                          "-90.0001 0",
                          "nan nan",
                          "nan inf",
                          "inf 0",
                          "0 inf",
                          "INVALID",
                          "55N 37N",
                          "55.7558N",
                          "55.7558N 37.6173E 12",
                          "Moscow",
                          "55,7558N 37,6173E",
                          "61N 413000 6180000",
                          "37N 9e9 6180000",
                          "37UDB130008000",
                          "37UDI1300080000",
                          "55d61'N 37E",
                          "\x01\xff\n",
                          "%s%n %d" };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        site s        = { 1.0, 2.0, 3.0 };
        lux_error err = { 0 };
        if (site_read(&s, bad[i], &err))
            fail_msg("\"%s\" was read as %g %g", bad[i], s.latitude_deg, s.longitude_deg);
        assert_int_equal(err.code, ERR_ARGUMENT);
        assert_non_null(strstr(err.text, "is expected"));
        assert_null(strchr(err.text, '\n'));
        assert_true(s.latitude_deg == 1.0 && s.altitude_m == 3.0); /* untouched */
    }
}

TEST(a_very_long_text_is_refused_in_a_short_message)
{
    static char text[100001];
    memset(text, '5', sizeof text - 1);
    site s;
    lux_error err = { 0 };
    assert_false(site_read(&s, text, &err));
    assert_non_null(strstr(err.text, "too long"));
    assert_false(site_read(&s, text, NULL));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(degrees_are_read_in_every_notation),
        cmocka_unit_test(maps_are_read),
        cmocka_unit_test(poles_and_the_date_line_are_places),
        cmocka_unit_test(what_is_no_place_is_refused),
        cmocka_unit_test(a_very_long_text_is_refused_in_a_short_message),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
