/* tests/cli/test_material.c -- lux4 material: figures, JSON, diagrams, swatches, wrong files. */
#include "tests/folder.h"
#include "tests/program.h"
#include "tests/test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* f = 0.1 / pi and 0.5 / pi everywhere: albedos of 0.1 and 0.5 at every angle. */
static const char matt[] =
    "lux4 brdf 1\nparameters isotropic\nbands R G B\ntheta_in 0 90\n"
    "theta_out 0 90\ndelta_phi 0 180\nvalues\n"
    "0.159154943 0.0318309886 0.0318309886 0.159154943 0.0318309886 0.0318309886\n"
    "0.159154943 0.0318309886 0.0318309886 0.159154943 0.0318309886 0.0318309886\n"
    "0.159154943 0.0318309886 0.0318309886 0.159154943 0.0318309886 0.0318309886\n"
    "0.159154943 0.0318309886 0.0318309886 0.159154943 0.0318309886 0.0318309886\n";

/* f = 2 / pi: twice what arrives. */
static const char gains[] = "lux4 brdf 1\nparameters anisotropic\ntheta_in 0 90\nphi_in 0 360\n"
                            "theta_out 0 90\nphi_out 0 360\nvalues\n"
                            "0.636619772 0.636619772 0.636619772 0.636619772\n"
                            "0.636619772 0.636619772 0.636619772 0.636619772\n"
                            "0.636619772 0.636619772 0.636619772 0.636619772\n"
                            "0.636619772 0.636619772 0.636619772 0.636619772\n";

static char *folder_of_materials(void)
{
    char *folder = folder_new();
    folder_write(folder, "matt.brdf", matt);
    folder_write(folder, "gains.brdf", gains);
    folder_write(folder, "bad.brdf", "lux4 brdf 1\nparameters isotropic\ntheta_in 0 x\n");
    folder_write(folder, "bad.xml", "<WindowElement>\n<Layer>\n</WindowElement>\n");
    return folder;
}

static const char *in_data(const char *name)
{
    static char path[4096];
    snprintf(path, sizeof path, "%s/data/materials/%s", project_root(), name);
    return path;
}

static void assert_says(const char *text, const char *what)
{
    if (!strstr(text, what))
        fail_msg("nothing of `%s` in:\n%s", what, text);
}

TEST(a_table_is_told_in_words)
{
    char *folder     = folder_of_materials();
    program_result r = { 0 };
    LUX4(folder, 0, &r, "material", "matt.brdf");
    assert_string_equal(r.err, "");
    assert_says(r.out, "matt.brdf\n");
    assert_says(r.out, "isotropic table\n");
    assert_says(r.out, "theta_in 2, theta_out 2, delta_phi 2\n");
    assert_says(r.out, "reflects of diffuse light          0.500  0.100  0.100\n");
    assert_says(r.out, "at  0 degrees      0.500  0.100  0.100\n");
    assert_says(r.out, "at 85 degrees      0.500  0.100  0.100\n");
    program_free(&r);
    folder_free(folder);
}

TEST(json_has_the_figures)
{
    char *folder     = folder_of_materials();
    program_result r = { 0 };
    LUX4(folder, 0, &r, "material", "--json", "matt.brdf", "gains.brdf");
    assert_true(json_is_valid(r.out));
    assert_memory_equal(json_at(r.out, "files.0.file"), "\"matt.brdf\"", 11);
    assert_near(json_number_at(r.out, "files.0.axes.theta_out"), 2.0, 0.0);
    assert_near(json_number_at(r.out, "files.0.bands"), 3.0, 0.0);
    assert_near(json_number_at(r.out, "files.0.largest_albedo"), 0.5, 1e-5);
    assert_near(json_number_at(r.out, "files.0.scale"), 1.0, 0.0);
    assert_near(json_number_at(r.out, "files.0.reciprocity_error"), 0.0, 1e-5);
    assert_near(json_number_at(r.out, "files.0.reflectance.0"), 0.5, 1e-5);
    assert_near(json_number_at(r.out, "files.0.transmittance.0"), 0.0, 0.0);
    assert_near(json_number_at(r.out, "files.0.albedo.9.angle_deg"), 85.0, 0.0);
    assert_near(json_number_at(r.out, "files.0.albedo.9.r"), 0.5, 1e-5);
    assert_near(json_number_at(r.out, "files.0.albedo.9.g"), 0.1, 1e-5);
    /* Of an anisotropic one two planes; scaled from 2 to 1, and told */
    assert_near(json_number_at(r.out, "files.1.largest_albedo"), 2.0, 1e-5);
    assert_near(json_number_at(r.out, "files.1.scale"), 0.5, 1e-4);
    assert_near(json_number_at(r.out, "files.1.albedo.19.azimuth_deg"), 90.0, 0.0);
    assert_near(json_number_at(r.out, "files.1.albedo.19.r"), 1.0, 1e-4);
    assert_non_null(json_at(r.out, "files.1.warnings.0"));
    assert_says(r.err, "lux4: warning: gains.brdf: ");
    program_free(&r);
    folder_free(folder);
}

/* A clear double glazing lets through the same both ways; reflected and let through by one and the
 * other way of finding it are what the pane of the model does not absorb. */
TEST(a_glazing_is_told_for_both_sides)
{
    program_result r = { 0 };
    LUX4(NULL, 0, &r, "material", in_data("glazing.xml"));
    assert_says(r.out, "BSDF, LBNL/Klems Full\n");
    assert_says(r.out, "light from outside            from above       from the side");
    assert_says(r.out, "light from the room ");
    LUX4(NULL, 0, &r, "material", "--json", in_data("glazing.xml"));
    assert_true(json_is_valid(r.out));
    assert_near(json_number_at(r.out, "files.0.directions"), 145.0, 0.0);
    assert_memory_equal(json_at(r.out, "files.0.albedo.0.side"), "\"front\"", 7);
    assert_memory_equal(json_at(r.out, "files.0.albedo.59.side"), "\"back\"", 6);
    assert_near(json_number_at(r.out, "files.0.albedo.0.through.1"),
                json_number_at(r.out, "files.0.albedo.30.through.1"), 2e-3);
    assert_near(json_number_at(r.out, "files.0.transmittance.0"),
                json_number_at(r.out, "files.0.transmittance_back.0"), 1e-4);
    program_free(&r);
}

TEST(wrong_files_are_refused_by_file_and_line)
{
    char *folder = folder_of_materials();
    LUX4_FAILS(folder, 2, "which files?", "material");
    LUX4_FAILS(folder, 2, "none.brdf: no such file", "material", "none.brdf");
    LUX4_FAILS(folder, 2, "bad.brdf:3:", "material", "bad.brdf");
    LUX4_FAILS(folder, 2, "bad.xml:3:", "material", "bad.xml");
    LUX4_FAILS(folder, 2, "expected one with --plot or --swatch", "material", "matt.brdf",
               "gains.brdf", "--plot", "x.svg");
    LUX4_FAILS(folder, 2, "--plot x.png: expected a file *.svg", "material", "matt.brdf", "--plot",
               "x.png");
    LUX4_FAILS(folder, 2, "--swatch x.svg: expected a file *.png", "material", "matt.brdf",
               "--swatch", "x.svg");
    LUX4_FAILS(folder, 2, "--write has no meaning", "material", "matt.brdf", "--write", "x.ies");

    program_result r = { 0 }; /* the good one is told all the same */
    LUX4(folder, 2, &r, "material", "--json", "bad.brdf", "matt.brdf");
    assert_true(json_is_valid(r.out));
    assert_memory_equal(json_at(r.out, "files.0.file"), "\"matt.brdf\"", 11);
    assert_says(r.err, "bad.brdf:3:");
    program_free(&r);
    folder_free(folder);
}

/* How often `what` stands in text. */
static int times(const char *text, const char *what)
{
    int count = 0;
    for (const char *c = strstr(text, what); c; c = strstr(c + 1, what))
        count++;
    return count;
}

/* One opening tag for each closing one, and no number that is none. */
static void assert_svg(const char *path, int lobes)
{
    static const char *const tags[] = { "svg", "g", "text" };
    size_t size;
    char *svg = bytes_of(path, &size);
    for (int i = 0; i < 3; i++) {
        char open[16], plain[16], close[16];
        snprintf(open, sizeof open, "<%s ", tags[i]);
        snprintf(plain, sizeof plain, "<%s>", tags[i]);
        snprintf(close, sizeof close, "</%s>", tags[i]);
        assert_int_equal(times(svg, open) + times(svg, plain), times(svg, close));
    }
    assert_string_equal(svg + size - 7, "</svg>\n");
    assert_null(strstr(svg, "nan"));
    assert_null(strstr(svg, "inf"));
    assert_int_equal(times(svg, "<polyline"), lobes);
    free(svg);
}

TEST(plots_are_whole_and_not_overwritten)
{
    char *folder     = folder_of_materials();
    program_result r = { 0 };
    LUX4(folder, 0, &r, "material", "matt.brdf", "--plot", "matt.svg");
    assert_says(r.out, "written: matt.svg\n");
    assert_svg(path_in(folder, "matt.svg"), 4 + 3); /* four beams; R, G and B */
    LUX4_FAILS(folder, 2, "matt.svg: is there already", "material", "gains.brdf", "--plot",
               "matt.svg");
    LUX4(folder, 0, &r, "material", "gains.brdf", "--plot", "matt.svg", "--overwrite", "--quiet");
    assert_svg(path_in(folder, "matt.svg"), 2 * (4 + 1)); /* two planes; grey */
    LUX4(folder, 0, &r, "material", in_data("blind.xml"), "--plot", "blind.svg");
    assert_svg(path_in(folder, "blind.svg"), 2 * (8 + 2)); /* two sides, above and below */
    program_free(&r);
    folder_free(folder);
}

/* A matt lobe is largest straight up: 1 of 1, 165 px above (225, 280). */
TEST(lobes_are_drawn_to_scale)
{
    char *folder     = folder_of_materials();
    program_result r = { 0 };
    size_t size;
    LUX4(folder, 0, &r, "material", "matt.brdf", "--plot", "matt.svg");
    char *svg = bytes_of(path_in(folder, "matt.svg"), &size);
    char wanted[64];
    double luminance = 0.2126 * 0.5 + 0.7874 * 0.1;
    snprintf(wanted, sizeof wanted, ">30°: %.3g</text>", luminance / M_PI);
    assert_says(svg, wanted);
    assert_says(svg, " 225.00,115.00 "); /* straight up: 1 of 1 */
    free(svg);
    program_free(&r);
    folder_free(folder);
}

static unsigned word(const char *bytes)
{
    const unsigned char *b = (const unsigned char *)bytes;
    return (unsigned)b[0] << 24 | (unsigned)b[1] << 16 | (unsigned)b[2] << 8 | b[3];
}

/* PNG: width and height are the big-endian words at 16 and 20. */
TEST(a_swatch_is_a_picture_of_256_pixels)
{
    char *folder     = folder_of_materials();
    program_result r = { 0 };
    size_t size;
    LUX4(folder, 0, &r, "material", "matt.brdf", "--swatch", "ball.png", "--time", "1");
    char *png = bytes_of(path_in(folder, "ball.png"), &size);
    assert_true(size > 10000); /* no even grey */
    assert_memory_equal(png, "\x89PNG", 4);
    assert_int_equal(word(png + 16), 256);
    assert_int_equal(word(png + 20), 256);
    free(png);
    LUX4_FAILS(folder, 2, "ball.png: is there already", "material", "matt.brdf", "--swatch",
               "ball.png");
    program_free(&r);
    folder_free(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_table_is_told_in_words),
        cmocka_unit_test(json_has_the_figures),
        cmocka_unit_test(a_glazing_is_told_for_both_sides),
        cmocka_unit_test(wrong_files_are_refused_by_file_and_line),
        cmocka_unit_test(plots_are_whole_and_not_overwritten),
        cmocka_unit_test(lobes_are_drawn_to_scale),
        cmocka_unit_test(a_swatch_is_a_picture_of_256_pixels),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
