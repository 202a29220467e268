/* tests/unit/test_photometry_report.c -- what the `photometry` command prints and draws. */
#include "sim/photometry_report.h"
#include "tests/test.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char *const GOOD = "build/report_good.ies";
static const char *const BAD  = "build/report_bad.ies";

static void write_file(const char *path, const char *text)
{
    FILE *f = fopen(path, "w");
    assert_non_null(f);
    fputs(text, f);
    fclose(f);
}

/* 100 cd at gamma 0 falling in a line to 0 at 90, of a lamp of 200 lm. Within gamma there are
 * 200 pi (1 - (1 - gamma / 90 deg) cos gamma - (2 / pi) sin gamma) lm: 228.32 in all, of which
 * 47.9, 77.6 and 94.5 % within the angles of the flux code. */
static int prepare(void **state)
{
    (void)state;
    write_file(GOOD,
               "IESNA:LM-63-2002\n[MANUFAC] \"Q\" \\ <&>\nTILT=NONE\n1 200 1 2 1 1 2 0 0 0 1 1 "
               "10\n0 90\n0\n100 0\n");
    write_file(BAD, "IESNA:LM-63-2002\nTILT=NONE\n1 x");
    return 0;
}

static int clean(void **state)
{
    (void)state;
    unlink(GOOD), unlink(BAD);
    return 0;
}

/* What a report prints, in memory of malloc. */
static char *report(const char *const *files, int count, photometry_options o, bool *done,
                    notices *n, lux_error *err)
{
    char *text;
    size_t size;
    FILE *f = open_memstream(&text, &size);
    *done   = photometry_report(f, files, count, &o, n, err);
    fclose(f);
    return text;
}

static char *slurp(const char *path)
{
    static char text[1 << 16];
    FILE *f = fopen(path, "r");
    assert_non_null(f);
    text[fread(text, 1, sizeof text - 1, f)] = '\0';
    fclose(f);
    return text;
}

TEST(json_has_the_keys_and_units_of_the_contract)
{
    arena a   = { 0 };
    notices n = { .a = &a };
    bool done;
    char *text = report(&GOOD, 1, (photometry_options){ .json = true }, &done, &n, NULL);
    assert_true(done);
    assert_string_equal(
        text,
        "{\"files\":[{\"file\":\"build/report_good.ies\",\"format\":\"LM-63-2002\",\"type\":\"C\","
        "\"lamp_lm\":200,\"luminaire_lm\":228.318531,\"lor\":1.14159265,\"lor_up\":0,\"watts\":10,"
        "\"efficacy_lm_w\":22.8318531,\"maximum_cd\":100,\"maximum_c_deg\":0,\"maximum_gamma_deg\":"
        "0,"
        "\"beam_deg\":90,\"beam_c90_deg\":90,\"field_deg\":162,\"field_c90_deg\":162,"
        "\"flux_code\":\"48 78 94 100 114\","
        "\"symmetry\":\"rotational\",\"opening\":\"point\",\"opening_m\":[0,0,0],\"length_along\":"
        "\"C0\","
        "\"warnings\":[\"build/report_good.ies: the luminaire gives 228.3 lm, more than its lamps "
        "(200.0 lm): LOR 114 %\"]}]}\n");
    assert_int_equal(n.count, 1);
    free(text);
    arena_clear(&a);
}

TEST(a_refused_file_does_not_hide_the_others)
{
    const char *files[] = { BAD, GOOD, "build/no_such.ldt", GOOD };
    arena a             = { 0 };
    notices n           = { .a = &a };
    lux_error err       = { 0 };
    bool done;
    char *text = report(files, 4, (photometry_options){ .json = true }, &done, &n, &err);
    assert_false(done);
    assert_string_equal(err.text,
                        "build/report_bad.ies:3:3: found 'x', expected the lumens of a lamp");
    assert_non_null(strstr(text, "{\"files\":[{\"file\""));
    assert_non_null(strstr(text, "]},{\"file\""));
    assert_non_null(strstr(n.first->text, "more than its lamps"));
    assert_string_equal(n.last->text, "build/no_such.ldt: no such file");
    free(text);
    text = report(&GOOD, 1, (photometry_options){ 0 }, &done, &n, &err);
    assert_non_null(strstr(text, "  luminaire flux (lm)               228.3\n"));
    assert_non_null(strstr(text, "length along C0\n"));
    free(text);
    arena_clear(&a);
}

TEST(plots_and_conversions_are_written_once)
{
    const char *plot = "build/report.svg", *out = "build/report.ldt";
    unlink(plot), unlink(out);
    arena a       = { 0 };
    notices n     = { .a = &a };
    lux_error err = { 0 };
    bool done;
    photometry_options o = { .plot = plot, .write = out };
    free(report(&GOOD, 1, o, &done, &n, &err));
    assert_true(done);
    const char *svg = slurp(plot);
    assert_non_null(strstr(svg, "cd/klm"));
    assert_non_null(strstr(svg, "all planes are the same")); /* one line then */
    assert_null(strstr(svg, "stroke-dasharray"));
    assert_non_null(strstr(svg, "</svg>\n"));
    assert_null(strstr(svg, "nan"));
    const char *ldt = slurp(out);
    assert_non_null(strstr(ldt, "\"Q\" \\ <&>\r\n1\r\n1\r\n1\r\n"));

    free(report(&GOOD, 1, o, &done, &n, &err));
    assert_false(done);
    assert_string_equal(err.text, "build/report.ldt: is there already; --overwrite replaces it");
    o.overwrite = true;
    free(report(&GOOD, 1, o, &done, &n, &err));
    assert_true(done);
    const char *two[] = { GOOD, GOOD };
    free(report(two, 2, o, &done, &n, &err));
    assert_false(done);
    free(report(two, 0, o, &done, &n, &err));
    assert_false(done);
    unlink(plot), unlink(out);
    arena_clear(&a);
}

/* 500 cd/klm at gamma 0: the curve's first point lies at 500 of 500, straight down. */
TEST(gamma_0_is_drawn_downward_and_to_scale)
{
    const char *plot    = "build/report.svg";
    arena a             = { 0 };
    lux_error err       = { 0 };
    const photometry *p = photometry_read(&a, GOOD, NULL, &err);
    assert_non_null(p);
    assert_true(photometry_plot(p, "<title> & \"more\" \xff", plot, &err));
    const char *svg = slurp(plot);
    assert_non_null(strstr(svg, "points=\" 260.00,510.00 "));
    assert_non_null(strstr(svg, ">&#60;title&#62; &#38; \"more\" ?</text>"));
    assert_non_null(strstr(svg, ">500</text>"));
    unlink(plot);
    arena_clear(&a);
}

/* C0 100, C90 80, C180 60, C270 20 cd at gamma 0, falling in a line to 0 at 90; absolute. */
TEST(two_lines_tell_the_planes_apart)
{
    const char *plot = "build/report.svg", *file = "build/report_planes.ies";
    write_file(file, "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 5 1 2 0 0 0 1 1 10\n0 90\n0 90 180 270 "
                     "360\n100 0 80 0 60 0 20 0 100 0\n");
    arena a       = { 0 };
    lux_error err = { 0 };
    bool done;
    photometry_options o = { .plot = plot };
    notices n            = { .a = &a };
    unlink(plot);
    free(report(&file, 1, o, &done, &n, &err));
    assert_true(done);
    const char *svg = slurp(plot);
    assert_non_null(strstr(svg, ">cd</text>")); /* no lamp lumens: not cd/klm */
    assert_non_null(strstr(svg, ">report_planes.ies</text>"));
    /* From C0 to C180 at 210 px for 100 cd; from C90 to C270, broken */
    const char *full = strstr(svg, "#c02020\" points=\" 260.00,510.00 ");
    assert_non_null(full);
    assert_true(strstr(full, " 260.00,426.00\"") < strstr(full, "dasharray"));
    const char *broken = strstr(svg, "dasharray=\"7 4\" points=\" 260.00,468.00 ");
    assert_non_null(broken);
    assert_non_null(strstr(broken, " 260.00,342.00\""));
    unlink(plot), unlink(file);
    arena_clear(&a);
}

TEST(long_titles_are_made_small_and_cut)
{
    const char *plot    = "build/report.svg";
    arena a             = { 0 };
    lux_error err       = { 0 };
    const photometry *p = photometry_read(&a, GOOD, NULL, &err);
    assert_true(photometry_plot(p, "A TITLE OF FORTY-SEVEN LETTERS, ALL OF THEM BIG", plot, &err));
    assert_non_null(strstr(slurp(plot), "font-size=\"15.3\"")); /* 490 / (47 0.68) */
    char title[400] = { 0 };
    for (int i = 0; i < 100; i++) /* three bytes each */
        memcpy(title + 3 * i, "\xe3\x81\x82", 3);
    assert_true(photometry_plot(p, title, plot, &err));
    assert_non_null(strstr(slurp(plot), "\xe3\x81\x82…</text>"));
    unlink(plot);
    arena_clear(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(json_has_the_keys_and_units_of_the_contract),
        cmocka_unit_test(a_refused_file_does_not_hide_the_others),
        cmocka_unit_test(plots_and_conversions_are_written_once),
        cmocka_unit_test(gamma_0_is_drawn_downward_and_to_scale),
        cmocka_unit_test(two_lines_tell_the_planes_apart),
        cmocka_unit_test(long_titles_are_made_small_and_cut),
    };
    return cmocka_run_group_tests(tests, prepare, clean);
}
