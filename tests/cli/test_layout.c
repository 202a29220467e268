/* tests/cli/test_layout.c -- where luminaires are, where they aim, and what scales their light.
 *
 * Direct light of points has no samples: what is the same is so to the byte, and ratios are exact
 * to a float rounding or two.
 */
#include "tests/folder.h"
#include "tests/program.h"
#include "tests/test.h"

#include <stdio.h>
#include <string.h>

static const double rounding = 4 * 0x1p-24; /* relative */

/* A point of 1000 lamp lumens, with twice as much light at 45 degrees toward C90 as toward C0. */
static const char web[] = "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 3 2 1 2 0 0 0\n1 1 10\n"
                          "0 45 90\n0 90\n100 50 0\n100 100 0\n";

static const char nodes[] =
    "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0,1,2]}],\"nodes\":["
    "{\"name\":\"Spot.1\",\"translation\":[1,2,-1]},{\"name\":\"Spot.2\",\"translation\":[3,2,-1]},"
    "{\"name\":\"Other\",\"translation\":[5,2,-1]}]}";

static char *folder;

static int begin(void **state)
{
    (void)state;
    folder = folder_new();
    folder_write(folder, "web.ies", web);
    folder_write(folder, "nodes.gltf", nodes);
    return 0;
}

static int end(void **state)
{
    (void)state;
    folder_free(folder);
    return 0;
}

static void write_study(const char *luminaires, const char *more)
{
    char text[2048];
    snprintf(text, sizeof text,
             "lux4: 1\nroom: {size: [6, 4, 2.8], reflectance: 0.5}\n%s\n"
             "luminaires: [%s]\ngrids: [{name: g, on: room, height: 0, spacing: 1}]\n",
             more, luminaires);
    folder_write(folder, "study.yaml", text);
}

/* The direct light of luminaires in a room of 6 by 4 m: OUT/g.csv. */
static void light_of(const char *out, const char *luminaires, const char *more, csv *rows)
{
    program_result r = { 0 };
    char path[64];
    write_study(luminaires, more);
    LUX4(folder, 0, &r, "grid", "study.yaml", "--direct-only", "-o", out, "--overwrite");
    snprintf(path, sizeof path, "%s/g.csv", out);
    if (rows)
        csv_read(path_in(folder, path), rows);
    program_free(&r);
}

static void assert_same_light(const char *luminaires, const char *other)
{
    light_of("a", luminaires, "scene: nodes.gltf", NULL);
    light_of("b", other, "scene: nodes.gltf", NULL);
    assert_same_bytes(path_in(folder, "a/g.csv"), path_in(folder, "b/g.csv"));
    assert_same_bytes(path_in(folder, "a/g.exr"), path_in(folder, "b/g.exr"));
}

TEST(layouts_are_where_they_say)
{
    static const char *const pairs[][2] = {
        { "layout: {fill: room, z: 2.5, count: [3, 2]}",
          "at: [[1,1,2.5],[3,1,2.5],[5,1,2.5],[1,3,2.5],[3,3,2.5],[5,3,2.5]]" },
        { "layout: {fill: room, z: 2.5, count: [1, 1]}", "at: [3, 2, 2.5]" },
        { "layout: {from: [1, 1, 2.5], to: [5, 3, 1.5], count: 3}",
          "at: [[1,1,2.5],[3,2,2],[5,3,1.5]]" },
        { "layout: {from: [1, 1, 2.5], to: [5, 3, 1.5], count: 1}", "at: [3,2,2]" },
        { "layout: {from: [1, 1, 2.5], to: [5, 3, 1.5], count: [2, 1]}", "at: [[1,2,2],[5,2,2]]" },
        { "layout: {from: [5, 1, 2.5], to: [1, 3, 1.5], count: [2, 1, 2]}",
          "at: [[5,2,2.5],[1,2,2.5],[5,2,1.5],[1,2,1.5]]" },
        { "nodes: \"Spot*\"", "at: [[1,1,2],[3,1,2]]" },
        { "nodes: \"Spot*\", aim_at: [3, 3, 0.5]", "at: [[1,1,2],[3,1,2]], aim_at: [3, 3, 0.5]" },
    };
    char one[256], other[256];
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        snprintf(one, sizeof one, "{photometry: web.ies, %s}", pairs[i][0]);
        snprintf(other, sizeof other, "{photometry: web.ies, %s}", pairs[i][1]);
        assert_same_light(one, other);
    }
}

TEST(each_luminaire_aims_from_its_own_place)
{
    assert_same_light("{photometry: web.ies, at: [[1, 1, 2], [5, 3, 2]], aim_at: [3, 2, 1]}",
                      "{photometry: web.ies, at: [1, 1, 2], aim: [2, 1, -1]}, "
                      "{photometry: web.ies, at: [5, 3, 2], aim: [-2, -1, -1]}");
}

TEST(nodes_turn_further_by_rotate)
{
    static csv at_node, at_place;
    light_of("a", "{photometry: web.ies, nodes: Other, rotate: 60}", "scene: nodes.gltf", &at_node);
    light_of("b", "{photometry: web.ies, at: [5, 1, 2], rotate: 60}", "", &at_place);
    for (int k = 0; k < at_node.count; k++)
        assert_near(at_node.row[k][ALL], at_place.row[k][ALL], 16 * 0x1p-24);
}

TEST(turned_by_a_quarter_c90_is_where_c0_was)
{
    csv plain, turned;
    enum { WIDE = 6 };
    light_of("a", "{photometry: web.ies, at: [3, 2, 2]}", "", &plain);
    light_of("b", "{photometry: web.ies, at: [3, 2, 2], rotate: 90}", "", &turned);
    assert_int_equal(plain.count, 24);
    for (int y = 0; y < 4; y++)
        for (int x = 1; x < 5; x++) { /* the square that a quarter turn leaves */
            int k = y * WIDE + x, from = (4 - x) * WIDE + y + 1;
            assert_near(turned.row[k][ALL], plain.row[from][ALL], 16 * 0x1p-24);
        }
    /* 0.5 m off along both axes and 2 m below it is the same from everywhere */
    assert_near(plain.row[WIDE + 2][ALL], plain.row[2 * WIDE + 3][ALL], 16 * 0x1p-24);
}

TEST(what_scales_the_light_multiplies)
{
    static const struct {
        const char *lamp, *top;
        double times;
    } cases[] = {
        { "dimming: 0.25", "", 0.25 },
        { "dimming: 0", "", 0.0 },
        { "group: a, dimming: 0.5", "dimming: {a: 3}", 1.5 },
        { "dimming: 0.5", "dimming: {other: 0.5}", 0.25 },
        { "lamp_lumens: 3000", "", 3.0 },
        { "lamp_lumens: 0", "", 0.0 },
        { "lamp_lumens: 500, dimming: 0.5", "maintenance: 0.8", 0.2 },
        { "color: 2700K", "", 1.0 },
        { "color: [0, 0, 1]", "maintenance: 0.5", 0.5 },
    };
    static csv full, scaled, twice;
    light_of("a", "{photometry: web.ies, at: [3, 2, 2]}", "", &full);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char lamp[256];
        snprintf(lamp, sizeof lamp, "{photometry: web.ies, at: [3, 2, 2], %s}", cases[i].lamp);
        light_of("b", lamp, cases[i].top, &scaled);
        for (int k = 0; k < full.count; k++)
            assert_near(scaled.row[k][ALL], cases[i].times * full.row[k][ALL], rounding);
    }
    light_of("a", "{photometry: web.ies, at: [3, 2, 2], lumens: 400}", "", &scaled);
    light_of("b", "{photometry: web.ies, at: [3, 2, 2], lumens: 800, dimming: 0.75}", "", &twice);
    for (int k = 0; k < full.count; k++)
        assert_near(twice.row[k][ALL], 1.5 * scaled.row[k][ALL], rounding);
}

TEST(what_cannot_be_laid_out_or_aimed_is_refused)
{
    static const struct {
        const char *lamp, *says;
    } cases[] = {
        { "at: [3, 2, 2], aim_at: [3, 2, 2]", "`aim_at` is where the luminaire is" },
        { "nodes: Spot.1, aim_at: [1, 1, 2]", "has no direction to shine to" },
        { "nodes: \"Lamp*\"", "Lamp*" },
        { "at: [3, 2, 2], aim: [0, 0, 0]", "expected a direction, found no length" },
        { "layout: {fill: room, z: 2.8, count: [2, 2]}", "is not below the ceiling" },
        { "layout: {fill: room, z: 2, count: 3}", "[along x, along y]" },
        { "layout: {fill: room, z: 2, count: [0, 2]}", "from 1 to 100000, found `0`" },
        { "layout: {fill: room, count: [1, 2]}", "a layout needs `fill: room` and `z`" },
        { "layout: {from: [1, 1, 2], to: [5, 1, 2], count: [2, 2]}", "have the same y" },
        { "layout: {from: [1, 1, 2], to: [5, 3, 2], count: [1000, 1000]}", "at most 100000" },
        { "at: [3, 2, 2], lumens: 1, lamp_lumens: 1", "not both" },
        { "at: [3, 2, 2], dimming: -1", "expected a number >= 0, found `-1`" },
        { "at: [3, 2, 2], nodes: Other", "takes one of `at`, `layout` and `nodes`" },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char lamp[256];
        snprintf(lamp, sizeof lamp, "{photometry: web.ies, %s}", cases[i].lamp);
        write_study(lamp, "scene: nodes.gltf");
        LUX4_FAILS(folder, 2, cases[i].says, "grid", "study.yaml");
        LUX4_FAILS(folder, 2, cases[i].says, "check", "study.yaml");
    }
}

TEST(a_light_that_cannot_be_made_is_told_with_its_line)
{
    static const struct {
        const char *lamp, *says;
    } cases[] = {
        { "{type: disk, at: [1, 1, 1], radius: 1e-8, lumens: 1}", "study.yaml:4:4: disk light: " },
        { "{type: linear, from: [1, 1, 1], to: [1, 1, 1e8], lumens: 1}",
          "study.yaml:4:4: linear light: " },
        { "{type: rect, at: [1, 1, 1], size: [1, 1e9], photometry: web.ies}",
          "study.yaml:4:4: luminaire: a luminous opening" },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[512];
        snprintf(text, sizeof text,
                 "lux4: 1\nroom: {size: [6, 4, 2.8], reflectance: 0.5}\nlights:\n - %s\n",
                 cases[i].lamp);
        folder_write(folder, "study.yaml", text);
        LUX4_FAILS(folder, 2, cases[i].says, "check", "study.yaml", "--quiet");
    }
}

TEST(an_opening_that_reaches_through_the_ceiling_is_told)
{
    static const char *const heights[] = { "2.74", "2.76" }; /* a ball of 0.1 m below 2.8 m */
    program_result r                   = { 0 };
    folder_write(folder, "ball.ies",
                 "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 1 1 2 -0.1 -0.1 -0.1\n"
                 "1 1 10\n0 180\n0\n100 100\n");
    for (int i = 0; i < 2; i++) {
        char lamp[128];
        snprintf(lamp, sizeof lamp, "{photometry: ball.ies, at: [3, 2, %s]}", heights[i]);
        write_study(lamp, "");
        LUX4(folder, 0, &r, "check", "study.yaml");
        assert_true(!strstr(r.err, "reaches through a wall, floor or ceiling") == !i);
    }
    program_free(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(layouts_are_where_they_say),
        cmocka_unit_test(each_luminaire_aims_from_its_own_place),
        cmocka_unit_test(nodes_turn_further_by_rotate),
        cmocka_unit_test(turned_by_a_quarter_c90_is_where_c0_was),
        cmocka_unit_test(what_scales_the_light_multiplies),
        cmocka_unit_test(a_light_that_cannot_be_made_is_told_with_its_line),
        cmocka_unit_test(an_opening_that_reaches_through_the_ceiling_is_told),
        cmocka_unit_test(what_cannot_be_laid_out_or_aimed_is_refused),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
