/* tests/unit/test_photometry.c -- LM-63 files, good, bent and broken.
 *
 * Expected candelas are the numbers in the texts times the factors that the standards name.
 */
#include "tests/photometry_reading.h"

#include <stdio.h>

/* ---- LM-63 ------------------------------------------------------------------------------ */

#define LABELS         "[TEST] T1\n[MANUFAC] Somebody\n[lumcat] L-1\n[LUMINAIRE] Lamp \"A\"\n"
#define WEB3           "0 45 90\n0\n100 50 0\n"
#define HEADER(factor) "1 1000 2 3 1 1 2 0.3 1.2 0\n0.5 " factor " 40\n"

TEST(the_tenth_number_is_a_factor_in_1986_and_1991_alone)
{
    const struct {
        const char *first;
        photometry_format format;
        double factor;
    } versions[] = {
        { "some free text\n", PHOTOMETRY_LM63_1986, 3 },
        { "IESNA91\n", PHOTOMETRY_LM63_1991, 3 },
        { "IESNA:LM-63-1995\n", PHOTOMETRY_LM63_1995, 1 },
        { "IESNA:LM-63-2002\n", PHOTOMETRY_LM63_2002, 1 },
        { "IES:LM-63-2019\n", PHOTOMETRY_LM63_2019, 1 },
    };
    for (size_t i = 0; i < sizeof versions / sizeof *versions; i++) {
        char text[512];
        snprintf(text, sizeof text, "%s" LABELS "TILT=NONE\n" HEADER("3") WEB3, versions[i].first);
        assert_non_null(read_text(text));
        assert_int_equal(r.p->format, versions[i].format);
        assert_near(at(0, 0), 100.0 * 2.0 * 0.5 * versions[i].factor, 1e-6);
        assert_near(at(77, 22.5), 75.0 * versions[i].factor, 1e-6);
        assert_near(r.p->lamp_lumens, 1000.0, 0);
        assert_near(r.p->watts, 40.0, 0);
        assert_near(r.p->length, 1.2, 1e-6);
        assert_near(r.p->width, 0.3, 1e-6);
        assert_int_equal(r.p->opening, OPENING_RECTANGLE);
        assert_true(r.p->length_along_deg == 0.0f);
        assert_int_equal(r.p->symmetry, SYMMETRY_ROTATIONAL);
        assert_string_equal(r.p->manufacturer, "Somebody");
        assert_string_equal(r.p->catalog, "L-1");
    }
}

TEST(the_generation_type_of_2019_changes_no_candela)
{
    const char *types[] = { "1.00001", "1.00010", "1.00100", "1.01100", "1.10000", "1.11100" };
    for (size_t i = 0; i < 6; i++) {
        char text[512];
        snprintf(text, sizeof text,
                 "IES:LM-63-2019\nTILT=NONE\n1 1000 1 3 1 1 2 0 0 0 1 %s 9\n" WEB3, types[i]);
        assert_non_null(read_text(text));
        assert_true(at(0, 0) == 100.0);
        assert_int_equal(r.n.count, 0);
    }
    read_text("IES:LM-63-2019\nTILT=NONE\n1 1000 1 3 1 1 2 0 0 0 1 1.5 9\n" WEB3);
    assert_true(at(0, 0) == 100.0 && noticed("t:3: LM-63-2019 has no file generation type 1.5"));
}

TEST(version_lines_are_read_however_they_are_written)
{
    const char *first[] = { "IESNA: LM-63-2002", " iesna:lm-63-2002", "IESNA:LM-63-2002  ",
                            "IES:LM-63-2002", "IESNA LM-63-2002" };
    for (size_t i = 0; i < 5; i++) {
        char text[512];
        snprintf(text, sizeof text, "%s\nTILT=NONE\n" HEADER("1") WEB3, first[i]);
        assert_non_null(read_text(text));
        assert_int_equal(r.p->format, PHOTOMETRY_LM63_2002);
        assert_int_equal(r.n.count, i == 2 ? 0 : 1);
    }
    read_text("IES NA91\nTILT=NONE\n" HEADER("1") WEB3);
    assert_int_equal(r.p->format, PHOTOMETRY_LM63_1991);
    read_text("IESNA95\nTILT=NONE\n" HEADER("1") WEB3);
    assert_int_equal(r.p->format, PHOTOMETRY_LM63_1995);
    read_text("IESNA:LM-63-2077\nTILT=NONE\n" HEADER("1") WEB3);
    assert_true(noticed("t:1: LM-63 has no version of 2077"));
    read_text("IESNA:LM-63-2002 made by a program of our own\nTILT=NONE\n" HEADER("3") WEB3);
    assert_int_equal(r.p->format, PHOTOMETRY_LM63_2002);
    assert_true(at(0, 0) == 100.0 && noticed("t:1: the version line is not 'IESNA:LM-63-2002'"));
    read_text("IESNA:LM-63\nTILT=NONE\n" HEADER("3") WEB3);
    assert_int_equal(r.p->format, PHOTOMETRY_LM63_1986);
    assert_true(noticed("t:1: the version line names no year"));
}

TEST(minus_one_lumens_are_absolute_photometry)
{
    read_text("IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 1 1 2 0 0 0 1 1 40\n" WEB3);
    assert_true(r.p->absolute && r.p->lamp_lumens == 0.0);
    photometry_figures f = photometry_figure(r.p, "t", &r.n);
    assert_true(f.lor_known && f.lor == 1.0);
    assert_int_equal(r.n.count, 0);
    read_text("IESNA:LM-63-2002\nTILT=NONE\n1 -5 1 3 1 1 2 0 0 0 1 1 40\n" WEB3);
    assert_true(r.p->absolute && noticed("taken as -1"));
    read_text("IESNA:LM-63-2002\nTILT=NONE\n2 1500 1 3 1 1 2 0 0 0 1 1 40\n" WEB3);
    assert_near(r.p->lamp_lumens, 3000.0, 0); /* two lamps */
    read_text("IESNA:LM-63-2002\nTILT=NONE\n1 0 1 3 1 1 2 0 0 0 1 1 40\n" WEB3);
    assert_false(photometry_figure(r.p, "t", NULL).lor_known);
}

TEST(feet_are_made_metres)
{
    read_text("IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 1 1 1 1 2 3 1 1 40\n" WEB3);
    assert_near(r.p->width, 0.3048, 1e-6);
    assert_near(r.p->length, 0.6096, 1e-6);
    assert_near(r.p->height, 0.9144, 1e-6);
}

/* Webs of two rings, 10 cd at gamma 0 and the plane's number at 90. */
#define PLANES(n, angles)                                                                          \
    "IESNA:LM-63-1995\nTILT=NONE\n1 -1 1 2 " n " 1 2 0 0 0 1 1 1\n0 90\n" angles "\n"

TEST(symmetries_are_unfolded)
{
    read_text(PLANES("3", "0 45 90") "10 1 10 2 10 3");
    assert_int_equal(r.p->symmetry, SYMMETRY_QUADRANT);
    assert_int_equal(r.p->plane_count, 8);
    assert_true(at(135, 90) == 2 && at(180, 90) == 1 && at(225, 90) == 2 && at(270, 90) == 3);

    read_text(PLANES("3", "0 60 180") "10 1 10 2 10 3");
    assert_int_equal(r.p->symmetry, SYMMETRY_C0);
    assert_int_equal(r.p->plane_count, 4);
    assert_true(at(0, 90) == 1 && at(60, 90) == 2 && at(180, 90) == 3 && at(300, 90) == 2);

    read_text(PLANES("3", "90 135 270") "10 1 10 2 10 3");
    assert_int_equal(r.p->symmetry, SYMMETRY_C90);
    assert_int_equal(r.p->plane_count, 4);
    assert_true(at(90, 90) == 1 && at(135, 90) == 2 && at(270, 90) == 3 && at(45, 90) == 2);
    assert_int_equal(r.n.count, 0);

    read_text(PLANES("5", "0 90 180 270 360") "10 1 10 2 10 3 10 4 10 1");
    assert_int_equal(r.p->symmetry, SYMMETRY_NONE);
    assert_int_equal(r.p->plane_count, 4);
    assert_true(at(315, 90) == 2.5 && at(-45, 90) == 2.5 && at(360, 90) == 1);
    assert_int_equal(r.n.count, 0);
}

TEST(a_missing_plane_at_360_is_understood)
{
    read_text(PLANES("4", "0 90 180 270") "10 1 10 2 10 3 10 4");
    assert_int_equal(r.p->plane_count, 4);
    assert_true(at(315, 90) == 2.5 && noticed("t:5: the horizontal angles end at 270"));
    read_text(PLANES("5", "0 90 180 270 360") "10 1 10 2 10 3 10 4 10 9");
    assert_true(at(0, 90) == 1 && noticed("the plane at 360 differs"));
    assert_refused(PLANES("2", "0 120") "10 1 10 2",
                   "t:5:1: found horizontal angles from 0 to 120, expected 0 alone, 0 to 90, 0 to "
                   "180, 90 to 270 or 0 to 360");
}

/* ---- types A and B ---------------------------------------------------------------------- */

#define TYPE(t)                                                                                    \
    "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 5 5 " t                                                   \
    " 2 0 0 0 1 1 1\n-90 -45 0 45 90\n-90 -45 0 45 90\n"
/* By H; 1 cd but for H = 45, V = 0 (5 cd) and H = 0, V = 45 (9 cd) */
#define SPOTS "1 1 1 1 1 1 1 1 1 1 1 1 1 9 1 1 1 5 1 1 1 1 1 1 1"

TEST(types_a_and_b_have_h_toward_c0_and_v_toward_c90)
{
    for (int b = 0; b < 2; b++) {
        assert_non_null(read_text(b ? TYPE("2") SPOTS : TYPE("3") SPOTS));
        assert_int_equal(r.p->type, b ? 'B' : 'A');
        assert_near(at(0, 45), 5.0, 1e-5);
        assert_near(at(90, 45), 9.0, 1e-5);
        assert_near(at(180, 45), 1.0, 1e-5);
        assert_near(at(270, 45), 1.0, 1e-5);
        assert_near(at(0, 0), 1.0, 1e-5);
        assert_near(at(0, 22.5), 3.0, 1e-5);
        assert_true(at(10, 91) == 0.0); /* behind it is dark */
        assert_true(noticed("resampled as type C"));
    }
}

/* Off the axes the types differ: H = 45, V = 45 is d = (1/2, 1/sqrt 2, -1/2) in A, and
 * (1/sqrt 2, 1/2, -1/2) in B; both at gamma 60, C 54.74 and 35.26. */
TEST(types_a_and_b_differ_in_which_angle_is_the_latitude)
{
    const char *spot = "1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 9 1 1 1 1 1 1";
    char text[512];
    snprintf(text, sizeof text, TYPE("3") "%s", spot);
    read_text(text);
    assert_near(at(54.7356, 60), 9.0, 0.02); /* between planes 5 deg apart */
    assert_true(at(35.2644, 60) < 8.0);
    snprintf(text, sizeof text, TYPE("2") "%s", spot);
    read_text(text);
    assert_near(at(35.2644, 60), 9.0, 0.02);
    assert_true(at(54.7356, 60) < 8.0);
}

/* The same candelas in all directions of half a space: 2 pi lm a candela, however told. */
TEST(types_a_and_b_keep_the_flux)
{
    const char *even = "7 7 7 7 7 7 7 7 7 7 7 7 7 7 7 7 7 7 7 7 7 7 7 7 7";
    char text[512];
    for (int type = 2; type <= 3; type++) {
        snprintf(text, sizeof text, TYPE("%d") "%s", type, even);
        read_text(text);
        assert_near(r.p->luminaire_lumens, 2.0 * M_PI * 7.0, 1e-4);
    }
    read_text("IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 2 3 2 0 0 0 1 1 1\n0 90\n0 90\n7 7 7 7");
    assert_near(r.p->luminaire_lumens, 2.0 * M_PI * 7.0, 1e-4); /* 0 to 90 mirrors */
}

TEST(type_1_of_1986_with_angles_below_0_is_type_a)
{
    read_text("free\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0 1 1 1\n-90 90\n0\n7 7");
    assert_int_equal(r.p->type, 'A');
    assert_refused("IESNA91\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0 1 1 1\n-90 90\n0\n7 7",
                   "t:4:1: found '-90', expected vertical angle 1 of 2, from 0 to 180 deg");
}

/* ---- files as they come ----------------------------------------------------------------- */

TEST(line_ends_marks_and_wrapping_do_not_matter)
{
    const char *texts[] = {
        "IESNA:LM-63-2002\r\n[MANUFAC] Somebody\r\nTILT=NONE\r\n1 -1 1 3 1 1 2\r\n0 0 0 1 1 "
        "9\r\n" WEB3,
        "IESNA:LM-63-2002\r[MANUFAC] Somebody\rTILT=NONE\r1 -1 1 3 1 1 2 0 0 0\r1 1 9\r0 45 "
        "90\r0\r100 "
        "50 0",
        "\xef\xbb\xbfIESNA:LM-63-2002\n[MANUFAC] Somebody\nTILT=NONE\n1 -1 1 3 1 1 2 0 0 0 1 1 "
        "9\n" WEB3,
        "IESNA:LM-63-2002\n\n [Manufac]   Somebody\t\n  TILT = none \n\n1\n-1\n1,3.0\n1\n1 2 0 0 0 "
        "1\n1\n"
        "9\n0,45,90 0 100\n\n50\n0\n\x1a garbage \x01",
        "IESNA:LM-63-2002\n[MANUFAC] Somebody\nTILT=NONE\n+1 -1.0E0 1.e0 3 1 1 2 .0 0. 0 1 1 9\n0 "
        "4.5e1 "
        "90 0 1E2 50 0",
        ("IESNA:LM-63-2002\r\r\n[MANUFAC] Somebody\r\r\nTILT=NONE\r\r\n1 -1 1 3 1 1 2 0 0 0 1 1 "
         "9\r\r\n0 45 90 0 100 50 0\r\r\n"),
    };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        assert_non_null(read_text(texts[i]));
        assert_int_equal(r.n.count, 0);
        assert_string_equal(r.p->manufacturer, "Somebody");
        assert_near(at(0, 45), 50.0, 1e-6);
        assert_near(at(0, 67.5), 25.0, 1e-6);
        assert_int_equal(r.p->gamma_count, 3);
    }
}

TEST(what_can_be_understood_is_and_says_so)
{
    read_text("IESNA91\nTILT=NONE\n" HEADER("1") WEB3 "and more\n");
    assert_true(r.p && noticed("t:8: text behind the last candela value"));
    read_text("IESNA91\nTILT=NONE\n" HEADER("0") WEB3);
    assert_true(r.p && at(0, 0) == 100.0 &&
                noticed("t:4: the ballast-lamp photometric factor is 0, where"));
    read_text("IESNA91\nTILT=NONE\n" HEADER("1") "0 45 90 0 100 -0.5 0\n");
    assert_true(r.p && at(0, 45) == 0.0 && noticed("1 negative candela values: taken as 0"));
    read_text("IESNA:LM-63-2002\nTILT=NONE\n" HEADER("1.5") WEB3);
    assert_true(r.p &&
                noticed("t:4: 1.5 behind the ballast factor, where LM-63-2002 has 1: ignored"));
    read_text("IESNA91\nTILT=NONE\n" HEADER("1") "5 45 80 0 100 50 10\n");
    assert_true(r.p && at(0, 4) == 0.0 && at(0, 81) == 0.0 && noticed("dark outside"));
    read_text("IESNA91\nTILT=NONE\n" HEADER("1") "0 45 90 0 0 0 0\n");
    assert_true(r.p && r.p->luminaire_lumens == 0.0 && noticed("is dark"));
}

TEST(what_cannot_be_understood_is_refused_at_its_place)
{
    assert_refused("", "t:1:1: found an empty file, expected LM-63 or EULUMDAT");
    assert_refused("\n  \r\n", "t:1:1: found an empty file, expected LM-63 or EULUMDAT");
    assert_refused("hello\nworld\n",
                   "t:1:1: neither LM-63 (no line 'TILT=') nor EULUMDAT (lines 2 to 4 "
                   "are no type, symmetry and number of planes)");
    assert_refused("IESNA91\n[TEST]", "t:2:7: found the end of the file, expected a line 'TILT='");
    assert_refused("IESNA91\nTILT=NONE\n1 x", "t:3:3: found 'x', expected the lumens of a lamp");
    assert_refused("IESNA91\nTILT=NONE\n1 1000lm",
                   "t:3:3: found '1000lm', expected the lumens of a lamp");
    assert_refused("IESNA91\nTILT=NONE\n1 nan",
                   "t:3:3: found 'nan', expected the lumens of a lamp");
    assert_refused("IESNA91\nTILT=NONE\n1 1e999",
                   "t:3:3: found '1e999', expected the lumens of a lamp");
    assert_refused(
        "IESNA91\nTILT=NONE\n1 1 1 2.5",
        "t:3:7: found '2.5', expected the number of vertical angles, a whole number from "
        "1 to 20000");
    assert_refused(
        "IESNA91\nTILT=NONE\n1 1 1 -3",
        "t:3:7: found '-3', expected the number of vertical angles, a whole number from 1 "
        "to 20000");
    assert_refused("IESNA91\nTILT=NONE\n1 1 1 3 1 4",
                   "t:3:11: found '4', expected the photometric type (1: C, 2: B, 3: A), a whole "
                   "number from 1 to 3");
    assert_refused("IESNA91\nTILT=NONE\n1 1 -1 3 1 1 2 0 0 0 1 1 1 " WEB3,
                   "t:3:5: found '-1', expected the candela multiplier > 0");
    assert_refused(
        "IESNA91\nTILT=NONE\n" HEADER("1") "0 45 45\n0\n1 2 3",
        "t:5:6: found '45', expected vertical angle 3 of 3, larger than the one before (45)");
    assert_refused("IESNA91\nTILT=NONE\n" HEADER("1") "0 45 181\n0\n1 2 3",
                   "t:5:6: found '181', expected vertical angle 3 of 3, from 0 to 180 deg");
    assert_refused("IESNA91\nTILT=NONE\n" HEADER("1") "0 45 90\n0\n1 2\n",
                   "t:8:1: found the end of the file, expected candela value 3 of 3");
    assert_refused("IESNA91\nTILT=NONE\n" HEADER("1") "0 45 90\n0\n1 inf 3",
                   "t:7:3: found 'inf', expected candela value 2 of 3");
    assert_refused("IESNA91\nTILT=NONE\n" HEADER("1") "0 45 90\n0\n1 1e40 3",
                   "t:7:3: found '1e40', expected a candela value that is below 1e30 cd with all "
                   "factors");
    assert_refused("IESNA91\nTILT=NONE\n1 1 1 20000 20000 1 2 0 0 0 1 1 1\n",
                   "t:3:7: found 20000 planes of 20000 angles, expected at most 4194304 values");
    assert_refused("IESNA91\nTILT=NONE\n1 1 1 2000 2000 1 2 0 0 0 1 1 1\n",
                   "t:3:7: found 2000 planes of 2000 angles, expected no more values than the file "
                   "has room for");
    assert_null(read_bytes("IESNA91\0TILT=NONE\n", 18));
    assert_string_equal(r.err.text, "t:1:8: found a byte 0, expected a text file");
    assert_null(read_bytes("\xff\xfeI\0E\0", 6));
    assert_string_equal(r.err.text, "t:1:1: found UTF-16, expected plain text or UTF-8");
}

TEST(no_memory_is_an_error)
{
    arena none          = { 0 };
    lux_error err       = { 0 };
    const char *t       = "IESNA91\nTILT=NONE\n" HEADER("1") WEB3;
    memory_is_out       = true;
    const photometry *p = photometry_parse(&none, "t", t, strlen(t), NULL, &err);
    memory_is_out       = false;
    assert_null(p);
    assert_int_equal(err.code, ERR_MEMORY);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_tenth_number_is_a_factor_in_1986_and_1991_alone),
        cmocka_unit_test(the_generation_type_of_2019_changes_no_candela),
        cmocka_unit_test(version_lines_are_read_however_they_are_written),
        cmocka_unit_test(minus_one_lumens_are_absolute_photometry),
        cmocka_unit_test(feet_are_made_metres),
        cmocka_unit_test(symmetries_are_unfolded),
        cmocka_unit_test(a_missing_plane_at_360_is_understood),
        cmocka_unit_test(types_a_and_b_have_h_toward_c0_and_v_toward_c90),
        cmocka_unit_test(types_a_and_b_differ_in_which_angle_is_the_latitude),
        cmocka_unit_test(types_a_and_b_keep_the_flux),
        cmocka_unit_test(type_1_of_1986_with_angles_below_0_is_type_a),
        cmocka_unit_test(line_ends_marks_and_wrapping_do_not_matter),
        cmocka_unit_test(what_can_be_understood_is_and_says_so),
        cmocka_unit_test(what_cannot_be_understood_is_refused_at_its_place),
        cmocka_unit_test(no_memory_is_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, finish);
}
