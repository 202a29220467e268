/* tests/cli/test_sun_plot.c -- lux4 sun --plot: the sun-path diagram. */
#include "tests/folder.h"
#include "tests/program.h"
#include "tests/test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MOSCOW "--place", "55.7558N 37.6173E", "--zone", "Europe/Moscow"
#define SYDNEY "--place", "33.87S 151.22E", "--zone", "Australia/Sydney"
#define TROMSO "--place", "69.65N 18.96E", "--zone", "Europe/Oslo"

static void assert_says(const char *text, const char *what)
{
    if (!strstr(text, what))
        fail_msg("nothing of `%s` in:\n%s", what, text);
}

static int times(const char *text, const char *what)
{
    int count = 0;
    for (const char *c = strstr(text, what); c; c = strstr(c + 1, what))
        count++;
    return count;
}

/* One opening tag for each closing one, and no number that is none. To be freed. */
static char *svg_of(const char *path)
{
    static const char *const tags[] = { "svg", "g", "text", "tspan" };
    size_t size;
    char *svg = bytes_of(path, &size);
    for (int i = 0; i < 4; i++) {
        char open[16], plain[16], close[16];
        snprintf(open, sizeof open, "<%s ", tags[i]);
        snprintf(plain, sizeof plain, "<%s>", tags[i]);
        snprintf(close, sizeof close, "</%s>", tags[i]);
        assert_int_equal(times(svg, open) + times(svg, plain), times(svg, close));
    }
    assert_string_equal(svg + size - 7, "</svg>\n");
    assert_int_equal(times(svg, "<"), times(svg, ">"));
    assert_null(strstr(svg, "nan"));
    assert_null(strstr(svg, "inf"));
    return svg;
}

static const char SUN_DISK[] = "fill=\"#ffd830\"";

TEST(a_diagram_has_its_labels)
{
    static const char *const labels[] = {
        ">55.7558N 37.6173E</text>",
        ">N</text>",
        ">E</text>",
        ">S</text>",
        ">W</text>",
        ">30°</text>",
        ">330°</text>",
        ">Jun</text>",
        ">Dec</text>",
        ">Mar, Sep</text>",
        ">Jan, Nov</text>",
        ">4</tspan>",
        ">12</tspan>",
        ">21</tspan>",
        "Europe/Moscow",
        "hours: civil time at UTC+03:00<",
        "orange: path of 2026-06-21; sun at 2026-06-21T10:00+03:00: azimuth 123.7°",
        ", elevation 47.5°<",
    };
    char *folder     = folder_new();
    program_result r = { 0 };
    LUX4(folder, 0, &r, "sun", MOSCOW, "--time", "2026-06-21T10:00", "--plot", "sun.svg");
    assert_says(r.out, "\nwritten: sun.svg\n");
    char *svg = svg_of(path_in(folder, "sun.svg"));
    for (size_t i = 0; i < sizeof labels / sizeof *labels; i++)
        assert_says(svg, labels[i]);
    assert_null(strstr(svg, ">2</tspan>")); /* it is night then, all year */
    assert_int_equal(times(svg, SUN_DISK), 1);
    free(svg);
    LUX4_FAILS(folder, 2, "sun.svg: is there already", "sun", MOSCOW, "--time", "2026-06-21T10:00",
               "--plot", "sun.svg");
    LUX4(folder, 0, &r, "sun", MOSCOW, "--time", "2026-06-21T22:00", "--plot", "sun.svg",
         "--overwrite");
    svg = svg_of(path_in(folder, "sun.svg"));
    assert_says(svg, ", below the horizon<");
    assert_int_equal(times(svg, SUN_DISK), 0);
    free(svg);
    program_free(&r);
    folder_free(folder);
}

/* Where the sun of the diagram stands: 256 px is the rim's radius, (380, 378) its middle. */
TEST(the_sun_is_drawn_where_it_stands)
{
    char *folder     = folder_new();
    program_result r = { 0 };
    LUX4(folder, 0, &r, "sun", SYDNEY, "--time", "2026-06-21T09:00", "--plot", "s.svg", "--json");
    assert_true(json_is_valid(r.out));
    double azimuth = json_number_at(r.out, "azimuth_deg") * M_PI / 180.0;
    double zenith  = (90.0 - json_number_at(r.out, "apparent_elevation_deg")) * M_PI / 180.0;
    char *svg      = svg_of(path_in(folder, "s.svg"));
    const char *at = strstr(svg, "r=\"7\""), *from = at;
    while (*from != '<')
        from--;
    double x, y;
    assert_int_equal(sscanf(from, "<circle cx=\"%lf\" cy=\"%lf\"", &x, &y), 2);
    assert_near(x, 380.0 + 256.0 * tan(0.5 * zenith) * sin(azimuth), 1e-4);
    assert_near(y, 378.0 - 256.0 * tan(0.5 * zenith) * cos(azimuth), 1e-4);
    assert_true(x > 380.0 && y < 378.0); /* winter's morning in the south: north-east */
    free(svg);
    program_free(&r);
    folder_free(folder);
}

TEST(diagrams_are_whole_from_pole_to_pole)
{
    static const char *const places[] = { "90 0", "-90 0",  "70 25",    "66.56 0", "23.44 10",
                                          "0 0",  "0 -180", "-23.44 0", "-70 180" };
    char *folder                      = folder_new();
    program_result r                  = { 0 };
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        LUX4(folder, 0, &r, "sun", "--place", places[i], "--zone", "UTC", "--year", "--time",
             "2026", "--plot", "y.svg", "--overwrite");
        char *svg = svg_of(path_in(folder, "y.svg"));
        assert_says(svg, ">Mar, Sep<");
        assert_null(strstr(svg, "orange")); /* no date was asked for */
        free(svg);
    }
    LUX4(folder, 0, &r, "sun", TROMSO, "--day", "--time", "2026-12-21", "--plot", "y.svg",
         "--overwrite");
    char *svg = svg_of(path_in(folder, "y.svg"));
    assert_says(svg, "the sun stays down on 2026-12-21<");
    assert_says(svg, "UTC+01:00, as on 2026-12-21; clocks change in this year<");
    free(svg);
    program_free(&r);
    folder_free(folder);
}

TEST(a_diagram_without_a_place_to_be_is_an_error)
{
    LUX4_FAILS(NULL, 1, "/none/sun.svg", "sun", MOSCOW, "--time", "2026-06-21T10:00", "--plot",
               "/none/sun.svg");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_diagram_has_its_labels),
        cmocka_unit_test(the_sun_is_drawn_where_it_stands),
        cmocka_unit_test(diagrams_are_whole_from_pole_to_pole),
        cmocka_unit_test(a_diagram_without_a_place_to_be_is_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
