/* tests/unit/test_photometry_opening.c -- the luminous opening of LM-63 by the signs of its
 * sizes, version by version, and the table by which lamps give less in a tilted luminaire. */
#include "tests/photometry_reading.h"

#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

#define NUMBERS "1 -1 1 3 1 1 2 0 0 0 1 1 40\n0 45 90\n0\n100 50 0\n"

static const char *const versions[] = { "free text", "IESNA91", "IESNA:LM-63-1995",
                                        "IESNA:LM-63-2002", "IES:LM-63-2019" };

/* What a row of sizes, written as width, length, height, is in one version. */
typedef struct opening_case {
    const char *size; /* m */
    opening_shape shape;
    double length, width, height;
} opening_case;

static void check(int version, const opening_case *o, bool defined)
{
    char text[512], rule[64];
    snprintf(text, sizeof text, "%s\nTILT=NONE\n1 -1 1 3 1 1 2\n%s\n1 1 9\n0 45 90\n0\n9 5 0\n",
             versions[version], o->size);
    assert_non_null(read_text(text));
    if (r.p->opening != o->shape)
        fail_msg("%s, %s: a %s", versions[version], o->size, opening_shape_name(r.p->opening));
    assert_near(r.p->length, o->length, 1e-7);
    assert_near(r.p->width, o->width, 1e-7);
    assert_near(r.p->height, o->height, 1e-7);
    for (int i = 0; i < 4; i++)
        assert_true(r.p->side_height[i] == r.p->height);
    snprintf(rule, sizeof rule, "t:4: %s has no opening with", photometry_format_name(r.p->format));
    if (noticed(rule) == defined || r.n.count != !defined)
        fail_msg("%s, %s: %d notices", versions[version], o->size, r.n.count);
}

/* The cases are defined in the versions from..to, and mean the same, with a notice, in the others
 * unless these are marked as other. */
static void check_all(int from, int to, const opening_case *cases, size_t count)
{
    for (size_t i = 0; i < count; i++)
        for (int v = from; v <= to; v++)
            check(v, &cases[i], true);
}

#define CHECK(from, to, ...)                                                                       \
    do {                                                                                           \
        const opening_case all[] = { __VA_ARGS__ };                                                \
        check_all(from, to, all, sizeof all / sizeof *all);                                        \
    } while (0)

TEST(points_rectangles_and_boxes_are_the_same_in_all_versions)
{
    CHECK(0, 4, { "0 0 0", OPENING_POINT, 0, 0, 0 }, { "0.5 2 0", OPENING_RECTANGLE, 2, 0.5, 0 },
          { "0.5 2 3", OPENING_BOX, 2, 0.5, 3 }, { "0 2 3", OPENING_BOX, 2, 0, 3 },
          { "0.5 0 3", OPENING_BOX, 0, 0.5, 3 });
}

TEST(round_openings_of_1986_and_1991)
{
    CHECK(0, 1, { "-1 0 0", OPENING_DISC, 1, 1, 0 },
          { "-1 0 3", OPENING_VERTICAL_CYLINDER, 1, 1, 3 }, { "-1 2 0", OPENING_DISC, 2, 1, 0 },
          { "-1 2 3", OPENING_SPHERE, 2, 1, 3 });
}

TEST(round_openings_of_1995)
{
    CHECK(2, 2, { "-1 0 0", OPENING_DISC, 1, 1, 0 },
          { "-1 0 3", OPENING_VERTICAL_CYLINDER, 1, 1, 3 }, { "-1 0 -1", OPENING_SPHERE, 1, 1, 1 },
          { "0 2 -3", OPENING_CYLINDER_ALONG, 2, 3, 3 },
          { "2 0 -3", OPENING_CYLINDER_ACROSS, 3, 2, 3 },
          { "-1 2 3", OPENING_VERTICAL_CYLINDER, 2, 1, 3 },
          { "1 -2 3", OPENING_VERTICAL_CYLINDER, 2, 1, 3 }, { "-1 2 -3", OPENING_SPHERE, 2, 1, 3 },
          { "1 -2 -3", OPENING_SPHERE, 2, 1, 3 });
}

/* The vertical disc has the width and height of its diameter and no length; files that have it
 * the other way around are at hand as well. */
TEST(round_openings_of_2002_and_2019)
{
    CHECK(3, 4, { "-1 -1 0", OPENING_DISC, 1, 1, 0 }, { "-1 -2 0", OPENING_DISC, 2, 1, 0 },
          { "-1 -1 3", OPENING_VERTICAL_CYLINDER, 1, 1, 3 },
          { "-1 -2 3", OPENING_VERTICAL_CYLINDER, 2, 1, 3 },
          { "-1 -1 -1", OPENING_SPHERE, 1, 1, 1 }, { "-1 -2 -3", OPENING_SPHERE, 2, 1, 3 },
          { "-1 2 -1", OPENING_CYLINDER_ALONG, 2, 1, 1 },
          { "-1 2 -3", OPENING_CYLINDER_ALONG, 2, 1, 3 },
          { "2 -1 -1", OPENING_CYLINDER_ACROSS, 1, 2, 1 },
          { "-1 0 -1", OPENING_VERTICAL_DISC, 0, 1, 1 },
          { "0 -1 -2", OPENING_VERTICAL_DISC, 1, 0, 2 });
}

TEST(what_a_version_does_not_define_is_understood_and_says_so)
{
    const struct {
        int version;
        opening_case o;
    } cases[] = {
        { 3, { "-1 0 0", OPENING_DISC, 1, 1, 0 } },  /* as in 1995 */
        { 2, { "-1 -2 0", OPENING_DISC, 2, 1, 0 } }, /* as in 2002 */
        { 1, { "-1 0 -1", OPENING_SPHERE, 1, 1, 1 } },
        { 0, { "0 2 -3", OPENING_CYLINDER_ALONG, 2, 3, 3 } },
        { 4, { "-1 2 0", OPENING_DISC, 2, 1, 0 } },
        { 2, { "1 -2 0", OPENING_DISC, 2, 1, 0 } },
        { 3, { "0 -2 0", OPENING_DISC, 2, 2, 0 } },
        { 3, { "0 -2 3", OPENING_VERTICAL_CYLINDER, 2, 2, 3 } },
        { 3, { "0 0 -3", OPENING_POINT, 0, 0, 0 } },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        check(cases[i].version, &cases[i].o, false);
    const opening_case lines[] = { { "0 2 0", OPENING_LINE, 2, 0, 0 },
                                   { "2 0 0", OPENING_LINE, 0, 2, 0 },
                                   { "0 0 2", OPENING_LINE, 0, 0, 2 } };
    for (int v = 0; v < 5; v++)
        for (int i = 0; i < 3; i++)
            check(v, &lines[i], false);
}

TEST(sizes_beyond_10_km_are_refused_at_their_place)
{
    assert_refused("IESNA91\nTILT=NONE\n1 -1 1 3 1 1 2 0 -2e4 0 1 1 40\n",
                   "t:3:18: found '-2e4', expected a size of the opening up to 10 km");
}

/* ---- TILT ------------------------------------------------------------------------------- */

TEST(a_table_of_tilts_is_kept_and_linear_between_its_angles)
{
    assert_non_null(
        read_text("IESNA:LM-63-2002\ntilt = Include\n1\n3\n0 90 180\n1 .5\n.8\n" NUMBERS));
    assert_int_equal(r.n.count, 0);
    assert_true(at(0, 0) == 100.0); /* as measured */
    assert_int_equal(r.p->tilt_geometry, 1);
    assert_near(photometry_tilt_factor(r.p, 0), 1.0, 0);
    assert_near(photometry_tilt_factor(r.p, 45), 0.75, 1e-7);
    assert_near(photometry_tilt_factor(r.p, 90), 0.5, 1e-7);
    assert_near(photometry_tilt_factor(r.p, 135), 0.65, 1e-7);
    assert_near(photometry_tilt_factor(r.p, 180), 0.8, 1e-7);
    assert_non_null(read_text("IESNA:LM-63-2002\nTILT=INCLUDE\n2\n2\n30 60\n.9 .7\n" NUMBERS));
    assert_near(photometry_tilt_factor(r.p, 0), 0.9, 1e-7); /* no angle below: the first's */
    assert_near(photometry_tilt_factor(r.p, 170), 0.7, 1e-7);
    assert_non_null(read_text("IESNA:LM-63-2002\nTILT=NONE\n" NUMBERS));
    assert_near(photometry_tilt_factor(r.p, 170), 1.0, 0);
}

TEST(a_broken_table_of_tilts_is_refused_at_its_place)
{
    assert_refused("IESNA91\nTILT=INCLUDE\n4\n1\n0\n1\n",
                   "t:3:1: found '4', expected the lamp-to-luminaire geometry of TILT, a whole "
                   "number from 1 to 3");
    assert_refused("IESNA91\nTILT=INCLUDE\n1\n2\n0 90\n1",
                   "t:6:2: found the end of the file, expected a tilt factor, from 0 to 1000");
    assert_refused("IESNA91\nTILT=INCLUDE\n1\n2\n0 0\n1 1",
                   "t:5:3: found '0', expected a tilt angle, from 0 to 180 deg and ascending");
    assert_refused("IESNA91\nTILT=INCLUDE\n1\n2\n0 181\n1 1",
                   "t:5:3: found '181', expected a tilt angle, from 0 to 180 deg and ascending");
    assert_refused("IESNA91\nTILT=INCLUDE\n1\n2\n0 90\n1 -1",
                   "t:6:3: found '-1', expected a tilt factor, from 0 to 1000");
    assert_refused("IESNA91\nTILT=INCLUDE\n1\n1001\n",
                   "t:4:1: found '1001', expected the number of tilt angles, a whole number from 1 "
                   "to 1000");
}

static void write_file(const char *path, const char *text)
{
    FILE *f = fopen(path, "w");
    assert_non_null(f);
    fputs(text, f);
    fclose(f);
}

static const photometry *read_with(const char *tilt, const char *version)
{
    char text[512];
    snprintf(text, sizeof text, "%s\nTILT=%s\n%s", version, tilt, NUMBERS);
    write_file("build/tilted/lamp.ies", text);
    finish(NULL);
    r.n.a      = &r.a;
    return r.p = photometry_read(&r.a, "build/tilted/lamp.ies", &r.n, &r.err);
}

TEST(a_table_of_tilts_is_read_from_a_file_beside)
{
    mkdir("build/tilted", 0777);
    write_file("build/tilted/some lamp.tlt", "3\n2\n0 90\n1 0.5\n");
    assert_non_null(read_with("some lamp.tlt", "IESNA:LM-63-2002"));
    assert_int_equal(r.n.count, 0);
    assert_int_equal(r.p->tilt_geometry, 3);
    assert_near(photometry_tilt_factor(r.p, 45), 0.75, 1e-7);
    assert_non_null(read_with("some lamp.tlt", "IES:LM-63-2019"));
    assert_near(photometry_tilt_factor(r.p, 45), 0.75, 1e-7);
    assert_true(noticed("lamp.ies:2: LM-63-2019 does not allow TILT in a file of its own"));

    write_file("build/tilted/some lamp.tlt", "3\n2\n0 x\n1 0.5\n");
    assert_null(read_with("some lamp.tlt", "IESNA:LM-63-2002"));
    assert_string_equal(r.err.text, "build/tilted/some lamp.tlt:3:3: found 'x', expected a tilt "
                                    "angle, from 0 to 180 deg and ascending");
    unlink("build/tilted/some lamp.tlt");
}

TEST(tables_of_tilts_elsewhere_are_not_opened)
{
    mkdir("build/tilted", 0777);
    write_file("build/report_tilt.tlt", "1\n2\n0 90\n1 0.5\n");
    const char *outside[] = { "../report_tilt.tlt", "/etc/passwd", "C:\\lamps\\a.tlt", "a/b.tlt" };
    for (int i = 0; i < 4; i++) {
        assert_non_null(read_with(outside[i], "IESNA:LM-63-2002"));
        assert_true(r.p->tilt_count == 0 && noticed("only a file in the same folder is read"));
    }
    const char *missing[] = { "none.tlt", "..", "." };
    for (int i = 0; i < 3; i++) {
        assert_non_null(read_with(missing[i], "IESNA:LM-63-2002"));
        assert_true(r.p->tilt_count == 0 && noticed("the same in every tilt"));
    }
    assert_non_null(read_with("", "IESNA:LM-63-2002"));
    assert_true(noticed("lamp.ies:2: TILT= without NONE, INCLUDE or a file: taken as NONE"));
    unlink("build/report_tilt.tlt");
    unlink("build/tilted/lamp.ies");
    rmdir("build/tilted");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_rectangles_and_boxes_are_the_same_in_all_versions),
        cmocka_unit_test(round_openings_of_1986_and_1991),
        cmocka_unit_test(round_openings_of_1995),
        cmocka_unit_test(round_openings_of_2002_and_2019),
        cmocka_unit_test(what_a_version_does_not_define_is_understood_and_says_so),
        cmocka_unit_test(sizes_beyond_10_km_are_refused_at_their_place),
        cmocka_unit_test(a_table_of_tilts_is_kept_and_linear_between_its_angles),
        cmocka_unit_test(a_broken_table_of_tilts_is_refused_at_its_place),
        cmocka_unit_test(a_table_of_tilts_is_read_from_a_file_beside),
        cmocka_unit_test(tables_of_tilts_elsewhere_are_not_opened),
    };
    return cmocka_run_group_tests(tests, NULL, finish);
}
