/* tests/unit/test_eulumdat.c -- EULUMDAT files, good, bent and broken, and figures of webs. */
#include "tests/eulumdat_sheet.h"

TEST(intensities_are_per_1000_lumens_times_the_conversion_factor)
{
    ldt t    = plain;
    t.factor = "1,5";
    assert_non_null(read_ldt(t));
    assert_int_equal(r.p->format, PHOTOMETRY_EULUMDAT);
    assert_near(at(0, 0), 100.0 * 2.0 * 1.5, 1e-6);
    assert_near(at(123, 22.5), 75.0 * 2.0 * 1.5, 1e-6);
    assert_near(r.p->lamp_lumens, 2000.0, 0);
    assert_near(r.p->watts, 40.0, 0);
    assert_near(r.p->stated_lor, 1.0, 0);
    assert_int_equal(r.p->symmetry, SYMMETRY_ROTATIONAL);
    assert_true(r.p->length_along_deg == 90.0f);
    assert_string_equal(r.p->manufacturer, "Company");
    assert_string_equal(r.p->catalog, "Number");
    assert_string_equal(r.p->lamp, "LED");
    t.factor = "0";
    assert_non_null(read_ldt(t));
    assert_true(at(0, 0) == 200.0 && noticed("the conversion factor is 0: taken as 1"));
}

TEST(a_negative_number_of_lamps_is_absolute_photometry)
{
    ldt t  = plain;
    t.sets = "1\n-1\nLED\n700\n\n\n5\n";
    assert_non_null(read_ldt(t));
    assert_true(r.p->absolute && r.p->lamp_lumens == 0.0 && r.p->stated_lumens == 700.0);
    assert_near(at(0, 0), 70.0, 1e-6);
    photometry_figure(r.p, "t", &r.n);
    assert_true(noticed("flux is stated as 700.0 lm"));
}

TEST(of_several_sets_of_lamps_the_first_counts)
{
    ldt t  = plain;
    t.sets = "2\n1\nA\n1000\n\n\n10\n1\nB\n5000\n\n\n50\n";
    assert_non_null(read_ldt(t));
    assert_near(at(0, 0), 100.0, 1e-6);
    assert_near(r.p->watts, 10.0, 0);
    assert_true(noticed("t:27: 2 sets of lamps: the first is taken (A, 1000 lm)"));
}

TEST(symmetries_are_unfolded_as_stockmar_numbers_planes)
{
    ldt t    = plain;
    t.planes = "8", t.angles = EIGHT;

    t.symmetry = "0";
    t.values   = "1\n1\n1\n1\n1\n2\n1\n1\n3\n1\n1\n4\n1\n1\n5\n1\n1\n6\n1\n1\n7\n1\n1\n8";
    assert_non_null(read_ldt(t));
    for (int i = 0; i < 8; i++)
        assert_true(at(45 * i, 90) == 2.0 * (i + 1));

    t.symmetry = "2"; /* C0 to C180 */
    t.values   = "1\n1\n1\n1\n1\n2\n1\n1\n3\n1\n1\n4\n1\n1\n5";
    assert_non_null(read_ldt(t));
    assert_true(at(45, 90) == 4 && at(180, 90) == 10 && at(315, 90) == 4 && at(225, 90) == 8);

    t.symmetry = "3"; /* C270 by way of C0 to C90 */
    assert_non_null(read_ldt(t));
    assert_true(at(270, 90) == 2 && at(315, 90) == 4 && at(0, 90) == 6 && at(90, 90) == 10);
    assert_true(at(180, 90) == 6 && at(225, 90) == 4 && at(135, 90) == 8);

    t.angles = "90\n135\n180\n225\n270\n315\n0\n45"; /* a writer that begins at C90, and says so */
    assert_non_null(read_ldt(t));
    assert_true(at(90, 90) == 2 && at(135, 90) == 4 && at(270, 90) == 10 && at(45, 90) == 4);

    t.symmetry = "4", t.angles = EIGHT; /* C0 to C90 */
    t.values = "1\n1\n1\n1\n1\n2\n1\n1\n3";
    assert_non_null(read_ldt(t));
    assert_true(at(135, 90) == 4 && at(180, 90) == 2 && at(270, 90) == 6 && at(315, 90) == 4);

    t.symmetry = "1";
    t.values   = "1\n1\n9";
    assert_non_null(read_ldt(t));
    assert_true(r.p->plane_count == 1 && at(200, 90) == 18);
    assert_int_equal(r.n.count, 0);

    t          = plain; /* one plane can only be the same all around */
    t.symmetry = "3";
    assert_non_null(read_ldt(t));
    assert_int_equal(r.p->symmetry, SYMMETRY_ROTATIONAL);
    assert_true(noticed("t:3: one C plane with symmetry 3: taken as rotationally symmetric"));
}

TEST(openings_are_round_where_the_width_is_0)
{
    const struct {
        const char *size;
        opening_shape shape;
        double l, w, h;
        int notices;
    } cases[] = {
        { "1200\n300\n0\n0\n0\n0", OPENING_RECTANGLE, 1.2, 0.3, 0, 0 },
        { "1200\n300\n20\n20\n20\n20", OPENING_BOX, 1.2, 0.3, 0.02, 0 },
        { "1200\n300\n10\n20\n10\n20", OPENING_BOX, 1.2, 0.3, 0.02, 1 },
        { "200\n0\n0\n0\n0\n0", OPENING_DISC, 0.2, 0.2, 0, 0 },
        { "200\n0\n50\n50\n50\n50", OPENING_VERTICAL_CYLINDER, 0.2, 0.2, 0.05, 0 },
        { "0\n300\n0\n0\n0\n0", OPENING_LINE, 0, 0.3, 0, 0 },
        { "0\n300\n50\n50\n50\n50", OPENING_BOX, 0, 0.3, 0.05, 0 },
        { "0\n0\n50\n50\n50\n50", OPENING_LINE, 0, 0, 0.05, 0 },
        { "0\n0\n\n0\n0\n0", OPENING_POINT, 0, 0, 0, 1 },
        { "-5\n0\n0\n0\n0\n0", OPENING_POINT, 0, 0, 0, 1 },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        ldt t     = plain;
        t.opening = cases[i].size;
        assert_non_null(read_ldt(t));
        assert_int_equal(r.p->opening, cases[i].shape);
        assert_near(r.p->length, cases[i].l, 1e-6);
        assert_near(r.p->width, cases[i].w, 1e-6);
        assert_near(r.p->height, cases[i].h, 1e-6);
        assert_int_equal(r.n.count, cases[i].notices);
    }
}

TEST(each_side_has_its_luminous_height)
{
    ldt t     = plain;
    t.opening = "1200\n300\n10\n20\n0\n40";
    assert_non_null(read_ldt(t));
    const float mm[4] = { 10, 20, 0, 40 };
    for (int i = 0; i < 4; i++)
        assert_near(r.p->side_height[i], 1e-3 * (double)mm[i], 1e-6);
    assert_true(noticed("t:18: luminous heights of 10, 20, 0, 40 mm toward C0, C90, C180, C270: "
                        "the light is spread over a box of the greatest"));
}

/* What is between the values does not matter, but is said, once. */
TEST(tables_with_blank_lines_and_crowded_lines_are_read)
{
    ldt t    = plain;
    t.values = "100\n\n50\n\n \n0";
    assert_non_null(read_ldt(t));
    assert_true(at(0, 45) == 100.0 && r.n.count == 1);
    assert_true(noticed("t:48: a blank line among the values: passed over"));
    t.values = "100 50\t0\n";
    assert_non_null(read_ldt(t));
    assert_true(at(0, 45) == 100.0 && r.n.count == 1);
    assert_true(noticed("t:47: several values on a line, where EULUMDAT has one: all are read"));
    t.values = "100 50 x\n";
    assert_null(read_ldt(t));
    assert_string_equal(r.err.text, "t:47:8: found 'x', expected intensity 3 of 3");
    t.values = "100\n50\n0\nThe end";
    assert_non_null(read_ldt(t));
    assert_true(r.n.count == 1 && noticed("t:50: text behind the last intensity: ignored"));
}

TEST(decimal_commas_line_ends_and_marks_do_not_matter)
{
    ldt t    = plain;
    t.values = "100,5\n50,25\n0";
    assert_non_null(read_ldt(t));
    assert_near(at(0, 0), 201.0, 1e-6);
    assert_near(at(0, 45), 100.5, 1e-6);
    const char *ends[] = { "\r\n", "\r", "\r\r\n" };
    for (int i = 0; i < 4; i++) {
        char text[2048];
        size_t n = 0;
        if (i == 3)
            n = (size_t)snprintf(text, sizeof text, "\xef\xbb\xbf");
        for (const char *s = sheet_text(t); *s; s++)
            if (*s == '\n' && i < 3)
                n += (size_t)snprintf(text + n, sizeof text - n, "%s", ends[i]);
            else
                text[n++] = *s;
        n += (size_t)snprintf(text + n, sizeof text - n, "\x1a garbage");
        assert_non_null(read_text(text));
        assert_near(at(0, 45), 100.5, 1e-6);
        assert_string_equal(r.p->manufacturer, "Company");
        assert_int_equal(r.n.count, 0);
    }
}

TEST(labels_of_lm_63_do_not_make_it_that)
{
    char text[2048];
    for (int i = 0; i < 2; i++) {
        snprintf(text, sizeof text, "%s%s", i ? "IES Ltd" : "Company",
                 strchr(sheet_text(plain), '\n'));
        if (i == 0)
            memcpy(strstr(text, "Number"), "TILT=9", 6);
        assert_non_null(read_text(text));
        assert_int_equal(r.p->format, PHOTOMETRY_EULUMDAT);
    }
}

TEST(blank_lines_before_the_first_are_passed_over)
{
    char text[2100];
    snprintf(text, sizeof text, "\n \n%s", sheet_text(plain));
    assert_non_null(read_text(text));
    assert_string_equal(r.p->manufacturer, "Company");
    assert_true(at(0, 45) == 100.0 && noticed("t:1: blank lines before the first"));
    snprintf(text, sizeof text, "%s", strchr(sheet_text(plain), '\n')); /* no company: no blank */
    assert_non_null(read_text(text));
    assert_string_equal(r.p->manufacturer, "");
    assert_int_equal(r.n.count, 0);
}

TEST(what_eulumdat_cannot_mean_is_refused_at_its_place)
{
    ldt t    = plain;
    t.values = "100\n50";
    assert_null(read_ldt(t));
    assert_string_equal(r.err.text, "t:49:1: found the end of the file, expected intensity 3 of 3");
    t.values = "100\nnan\n3";
    assert_null(read_ldt(t));
    assert_string_equal(r.err.text, "t:48:1: found 'nan', expected intensity 2 of 3");
    t        = plain;
    t.angles = "400";
    assert_null(read_ldt(t));
    assert_string_equal(r.err.text, "t:43:1: found '400', expected C plane 1 of 1, 0 to 360 deg");
    t      = plain;
    t.sets = "0\n";
    assert_null(read_ldt(t));
    assert_string_equal(r.err.text,
                        "t:26:1: found '0', expected line 26, the number of sets of lamps, "
                        "a whole number from 1 to 1000");
    t.sets = "1\n1\nLED\n0\n\n\n5\n";
    assert_null(read_ldt(t));
    assert_string_equal(r.err.text,
                        "t:29:1: found '0', expected a flux of the lamps > 0: intensities are "
                        "given per 1000 lm");
    t          = plain;
    t.symmetry = "2", t.planes = "8", t.angles = "0\n10\n20\n30\n40\n50\n60\n70";
    assert_null(read_ldt(t));
    assert_string_equal(r.err.text,
                        "t:43:1: found C planes from 0 to 40 for symmetry 2, expected 0 to 180");
    t.angles = "0\n10\n10\n30\n40\n50\n60\n70";
    assert_null(read_ldt(t));
    assert_string_equal(
        r.err.text, "t:45:1: found '10', expected C plane 3 of 8, larger than the one before (10)");
}

TEST(a_stated_output_that_the_web_does_not_have_is_doubted)
{
    assert_non_null(read_ldt(plain)); /* 3 rings of 200, 100, 0 cd: 365 lm of 2000 lm */
    photometry_figures f = photometry_figure(r.p, "t", &r.n);
    assert_near(f.lor, r.p->luminaire_lumens / 2000.0, 1e-12);
    assert_true(
        noticed("t: the light output ratio is stated as 100.0 %, the intensities add up to"));
    ldt t    = plain;
    t.values = "5000\n5000\n5000";
    assert_non_null(read_ldt(t));
    photometry_figure(r.p, "t", &r.n);
    assert_true(noticed("more than its lamps"));
}

/* The sheet's web has a LOR of 1 - 2 / pi times 2 pi / 10: 22.83 %, and states 100 %. */
TEST(doubt_begins_at_5_percent_and_at_a_lor_of_102)
{
    const struct {
        double lor;
        bool differs, too_much;
    } cases[] = { { 0.94, true, false },
                  { 0.96, false, false },
                  { 1.01, false, false },
                  { 1.03, false, true },
                  { 1.06, true, true } };
    for (int i = 0; i < 5; i++) {
        ldt t = plain;
        char factor[32];
        snprintf(factor, sizeof factor, "%.12g", cases[i].lor / (0.2 * M_PI * (1.0 - 2.0 / M_PI)));
        t.factor = factor;
        assert_non_null(read_ldt(t));
        assert_near(photometry_figure(r.p, "t", &r.n).lor, cases[i].lor, 1e-6);
        assert_true(noticed("is stated as 100.0 %") == cases[i].differs);
        assert_true(noticed("more than its lamps") == cases[i].too_much);
    }
}

/* ---- figures ---------------------------------------------------------------------------- */

/* I = 100 (1 - gamma / 90): half at 45 deg, a tenth at 81, on both sides. The flux within g is
 * 2 pi 100 (1 - (1 - g/90) cos g - sin g / (pi/2)), by parts. */
TEST(figures_of_a_straight_line_are_its_closed_forms)
{
    assert_non_null(read_ldt(plain));
    photometry_figures f = photometry_figure(r.p, "t", NULL);
    assert_near(f.beam_deg[0], 90.0, 1e-6);
    assert_near(f.beam_deg[1], 90.0, 1e-6);
    assert_near(f.field_deg[0], 162.0, 1e-6);
    assert_near(f.maximum_cd, 200.0, 1e-6);
    double within[4];
    for (int i = 0; i < 4; i++) {
        double g = acos(0.75 - 0.25 * i);
        within[i] =
            2.0 * M_PI * 200.0 * (1.0 - (1.0 - g / (M_PI / 2)) * cos(g) - sin(g) / (M_PI / 2));
    }
    assert_near(r.p->luminaire_lumens, within[3], 1e-9);
    for (int i = 0; i < 3; i++)
        assert_near(f.flux_code[i], 100.0 * within[i] / within[3], 1e-6);
    assert_near(f.flux_code[3], 100.0, 1e-6);
    assert_near(f.lor_up + 1.0, 1.0, 1e-12);
    assert_near(f.efficacy, within[3] / 40.0, 1e-9);
}

/* C0 alone is bright, from gamma 45 to 90: its beam lies on one side; C180 has a tenth of it. */
TEST(a_beam_on_one_side_is_as_wide_as_it_is)
{
    ldt t    = plain;
    t.planes = "4", t.symmetry = "0", t.angles = "0\n90\n180\n270";
    t.values = "0\n100\n100\n0\n0\n0\n0\n10\n0\n0\n0\n0";
    assert_non_null(read_ldt(t));
    photometry_figures f = photometry_figure(r.p, "t", NULL);
    assert_near(f.beam_deg[0], 90.0 - 22.5, 1e-6);
    assert_near(f.field_deg[0], 90.0 + 45.0, 1e-6); /* from C0 at 90 to C180 at 45 */
    assert_true(f.beam_deg[1] == 0.0);
    assert_true(f.maximum_plane_deg == 0.0 && f.maximum_gamma_deg == 45.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(intensities_are_per_1000_lumens_times_the_conversion_factor),
        cmocka_unit_test(a_negative_number_of_lamps_is_absolute_photometry),
        cmocka_unit_test(of_several_sets_of_lamps_the_first_counts),
        cmocka_unit_test(symmetries_are_unfolded_as_stockmar_numbers_planes),
        cmocka_unit_test(openings_are_round_where_the_width_is_0),
        cmocka_unit_test(each_side_has_its_luminous_height),
        cmocka_unit_test(tables_with_blank_lines_and_crowded_lines_are_read),
        cmocka_unit_test(decimal_commas_line_ends_and_marks_do_not_matter),
        cmocka_unit_test(labels_of_lm_63_do_not_make_it_that),
        cmocka_unit_test(blank_lines_before_the_first_are_passed_over),
        cmocka_unit_test(what_eulumdat_cannot_mean_is_refused_at_its_place),
        cmocka_unit_test(a_stated_output_that_the_web_does_not_have_is_doubted),
        cmocka_unit_test(doubt_begins_at_5_percent_and_at_a_lor_of_102),
        cmocka_unit_test(figures_of_a_straight_line_are_its_closed_forms),
        cmocka_unit_test(a_beam_on_one_side_is_as_wide_as_it_is),
    };
    return cmocka_run_group_tests(tests, NULL, finish);
}
