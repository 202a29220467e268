/* tests/cli/test_daylight_edges.c -- series at the edges of days, years and the Earth. */
#include "tests/folder.h"
#include "tests/program.h"
#include "tests/test.h"

#include <stdlib.h>
#include <string.h>

#define STUDY(place, zone, sky)                                                                    \
    "lux4: 1\nroom: {size: [4, 5, 3], reflectance: 0.5, windows: [{wall: south, at: [1, 1], "      \
    "size: "                                                                                       \
    "[2, 1.2]}]}\naccuracy: 20%\ngrids: [{name: g, on: room, height: 0.8, spacing: 2.5}]\n"        \
    "site: {place: " place ", zone: " zone "}\nwhen: 2026-06-21T10:00\nsky: {model: " sky "}\n"

enum { CELLS = 4 };

/* Illuminances in the order of the file, at most `most`; each is finite and not negative. */
static int illuminances(const char *folder, double *lux, int most)
{
    size_t size;
    int count  = 0;
    char *text = bytes_of(path_in(folder, "out/g.csv"), &size);
    for (char *line = strchr(text, '\n') + 1; *line && count < most; count++) {
        char *at = line;
        for (int i = 0; i < 7; i++)
            at = strchr(at, ',') + 1;
        lux[count] = strtod(at, NULL);
        assert_true(isfinite(lux[count]) && lux[count] >= 0.0);
        line = strchr(line, '\n') + 1;
    }
    free(text);
    return count;
}

TEST(a_series_goes_on_over_the_end_of_a_day_and_of_a_year)
{
    enum { MOMENTS = 2 * 2 };
    double lux[MOMENTS * CELLS + 1];
    program_result r = { 0 };
    char *folder     = folder_of_study(STUDY("52N 13E", "Europe/Berlin", "clear"));
    LUX4(folder, 0, &r, "daylight", "study.yaml", "--date", "2026-12-31..2027-01-01", "--from",
         "11:59", "--to", "23:59", "--step", "720");
    assert_int_equal(illuminances(folder, lux, MOMENTS * CELLS + 1), MOMENTS * CELLS);
    assert_non_null(strstr(r.out, "2026-12-31T23:59+01:00"));
    assert_non_null(strstr(r.out, "2027-01-01T11:59+01:00"));
    for (int i = 0; i < MOMENTS * CELLS; i++)
        assert_true(i / CELLS % 2 == 0 ? lux[i] > 100.0 : lux[i] == 0.0); /* noon, midnight */
    program_free(&r);
    folder_free(folder);
}

TEST(the_polar_night_is_dark_all_day_and_the_polar_day_is_not)
{
    enum { MOMENTS = 9 };
    double lux[MOMENTS * CELLS + 1];
    program_result r = { 0 };
    char *folder     = folder_of_study(STUDY("80N 15E", "\"+01:00\"", "clear"));
    LUX4(folder, 0, &r, "daylight", "study.yaml", "--date", "2026-12-21", "--from", "00:00", "--to",
         "23:59", "--step", "170");
    assert_non_null(strstr(r.err, "no daylight arrives at any time"));
    assert_int_equal(illuminances(folder, lux, MOMENTS * CELLS + 1), MOMENTS * CELLS);
    for (int i = 0; i < MOMENTS * CELLS; i++)
        assert_true(lux[i] == 0.0);
    LUX4(folder, 0, &r, "daylight", "study.yaml", "--date", "2026-06-21", "--from", "00:00", "--to",
         "23:59", "--step", "170", "--overwrite");
    assert_int_equal(illuminances(folder, lux, MOMENTS * CELLS + 1), MOMENTS * CELLS);
    for (int i = 0; i < MOMENTS * CELLS; i++)
        assert_true(lux[i] > 10.0);
    program_free(&r);
    folder_free(folder);
}

TEST(at_the_poles_and_on_the_date_line_there_is_daylight)
{
    static const char *const studies[] = { STUDY("90N 0E", "\"+00:00\"", "clear"),
                                           STUDY("90S 0E", "\"+00:00\"", "clear"),
                                           STUDY("0N 180E", "\"+12:00\"", "intermediate"),
                                           STUDY("0N 180W", "\"-12:00\"", "intermediate") };
    for (int i = 0; i < 4; i++) {
        double lux[CELLS + 1];
        program_result r = { 0 };
        char *folder     = folder_of_study(studies[i]);
        LUX4(folder, 0, &r, "daylight", "study.yaml", "--date",
             i == 1 ? "2026-12-21" : "2026-06-21", "--from", "12:00");
        assert_int_equal(illuminances(folder, lux, CELLS + 1), CELLS);
        for (int k = 0; k < CELLS; k++)
            assert_true(lux[k] > 10.0);
        program_free(&r);
        folder_free(folder);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_series_goes_on_over_the_end_of_a_day_and_of_a_year),
        cmocka_unit_test(the_polar_night_is_dark_all_day_and_the_polar_day_is_not),
        cmocka_unit_test(at_the_poles_and_on_the_date_line_there_is_daylight),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
