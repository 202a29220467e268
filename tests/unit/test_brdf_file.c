/* tests/unit/test_brdf_file.c -- .brdf and MERL files: what they mean, and each way to break them.
 */
#include "core/file.h"
#include "materials/brdf_bands.h"
#include "materials/brdf_parts.h"
#include "tests/folder.h"
#include "tests/test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static arena memory;
static notices told;
static lux_error err;

static const brdf *read_text(const char *text)
{
    arena_clear(&memory);
    told = (notices){ .a = &memory };
    err  = (lux_error){ 0 };
    return brdf_read_text(&memory, "t.brdf", text, strlen(text), &told, &err);
}

static vrgb value_at(const brdf *b, double theta_in, double theta_out, double delta)
{
    const double deg = M_PI / 180.0;
    vvec3 wi         = vspread((vec3){ (float)sin(theta_in * deg), 0, (float)cos(theta_in * deg) });
    vvec3 wo         = vspread((vec3){ (float)(sin(theta_out * deg) * cos(delta * deg)),
                                       (float)(sin(theta_out * deg) * sin(delta * deg)),
                                       (float)cos(theta_out * deg) });
    return vbrdf_value(b, &wo, &wi, ALL_LANES);
}

static const char good[] = "lux4 brdf 1\n"
                           "# two by three by two\n"
                           "parameters isotropic\n"
                           "bands R G B # linear\n"
                           "unit 1/sr\n"
                           "theta_in 0 60\n"
                           "theta_out 0 30\n"
                           "  90\n"
                           "delta_phi 0 180\n"
                           "values\n"
                           ".01 .02 .03   .01 .02 .03   .02 .02 .02 .04 .04 .04\n"
                           ".05 .05 .05 .06 .06 .06\n"
                           "0 0 0 0 0 0 .1 0 0 .2 0 0 .1 .1 .1 .1 .1 .1 # the end\n";

TEST(a_table_is_read_as_its_file_says)
{
    const brdf *b = read_text(good);
    assert_non_null(b);
    assert_int_equal(told.count, 0);
    const brdf_figures *f = brdf_figures_of(b);
    assert_true(f->kind == BRDF_ISOTROPIC && f->axes == 3 && f->bands == 3);
    assert_true(f->counts[0] == 2 && f->counts[1] == 3 && f->counts[2] == 2);

    vrgb at = value_at(b, 0, 0, 0);
    assert_near(lane(at.x, 0), 0.01, 1e-5);
    assert_near(lane(at.z, 0), 0.03, 1e-5);
    assert_near(lane(value_at(b, 60, 30, 180).x, 0), 0.2, 1e-5);
    assert_near(lane(value_at(b, 60, 30, 90).x, 0), 0.15, 1e-5);  /* between places */
    assert_near(lane(value_at(b, 60, 30, -90).x, 0), 0.15, 1e-5); /* the other way round */
    assert_near(lane(value_at(b, 80, 30, 180).x, 0), 0.2, 1e-5);  /* beyond the last place */
    assert_near(lane(value_at(b, 30, 30, 0).x, 0), 0.06, 1e-5);
    assert_near(lane(value_at(b, 60, 60, 0).y, 0), 0.05, 1e-5);
}

TEST(each_break_of_a_file_is_named_with_its_line)
{
    static const struct {
        const char *text, *message;
    } broken[] = {
        { "lux4 brdf 2\n", "t.brdf:1: found '2', expected 'lux4 brdf 1'" },
        { "lux4 brdf\n1\n", "t.brdf:1: found nothing, expected 'lux4 brdf 1'" },
        { "lux4 brdf 1\n\nparameters odd\n",
          "t.brdf:3: found 'odd', expected isotropic, anisotropic or half" },
        { "lux4 brdf 1\ntheta_in 0\n",
          "t.brdf:2: found 'theta_in', expected parameters, bands or unit" },
        { "lux4 brdf 1\nparameters half\ntheta_in 0\n",
          "t.brdf:3: found 'theta_in', expected bands, unit, values or an axis of these "
          "parameters" },
        { "lux4 brdf 1\nparameters half\nparameters half\n",
          "t.brdf:3: found 'half', expected parameters named once" },
        { "lux4 brdf 1\nunit nits\n", "t.brdf:2: found 'nits', expected 1/sr" },
        { "lux4 brdf 1\nbands R G\n",
          "t.brdf:2: found nothing, expected R G B, one name alone, or wavelengths in nanometres" },
        { "lux4 brdf 1\nbands 500 400\n",
          "t.brdf:2: found a wavelength of 400, expected ascending nanometres" },
        { "lux4 brdf 1\nbands 500 red\n",
          "t.brdf:2: found 'red', expected R G B, one name alone, or wavelengths in nanometres" },
        { "lux4 brdf 1\nparameters isotropic\ntheta_in 0 30\n 20\n",
          "t.brdf:3: found 20 after 30, expected ascending theta_in" },
        { "lux4 brdf 1\nparameters isotropic\ntheta_in 0\ntheta_in 1\n",
          "t.brdf:4: found theta_in a second time" },
        { "lux4 brdf 1\nparameters isotropic\ntheta_in\n",
          "t.brdf:4: found the end of the file, expected places in degrees" },
        { "lux4 brdf 1\nparameters isotropic\ntheta_in 0 1e999\n",
          "t.brdf:3: found '1e999', expected bands, unit, values or an axis of these parameters" },
        { "lux4 brdf 1\nparameters isotropic\ntheta_in 0\nvalues\n1",
          "t.brdf:4: found values, expected theta_out before them" },
        { "lux4 brdf 1\nvalues 1\n", "t.brdf:2: found values, expected parameters before them" },
        { "lux4 brdf 1\nparameters isotropic\n",
          "t.brdf:3: found the end of the file, expected values" },
        { "lux4 brdf 1\nparameters isotropic\ntheta_in 0\ntheta_out 0 91\ndelta_phi 0\nvalues 1 1",
          "t.brdf:4: theta_out 91 is not in [0, 90] degrees" },
        { "lux4 brdf 1\nparameters isotropic\ntheta_in 0\ntheta_out 0\ndelta_phi -90 300\nvalues 1 "
          "1",
          "t.brdf:5: delta_phi spans 390 degrees, at most 360 were expected" },
        { "lux4 brdf 1\nparameters half\ntheta_h 0\ntheta_d 0\nphi_d 0 190\nvalues 1 1",
          "t.brdf:5: phi_d spans 190 degrees, at most 180 were expected" },
        { "lux4 brdf 1\nparameters isotropic\ntheta_in 0\ntheta_out 0\ndelta_phi 200\nvalues 1",
          "t.brdf:5: delta_phi begins at 200, at most 180 degrees were expected" },
        { "lux4 brdf 1\nparameters isotropic\ntheta_in 0\ntheta_out 0 9\ndelta_phi 0\nvalues "
          ".1\nnan",
          "t.brdf:7: found 'nan', expected a value in 1/sr, below 1e30" },
        { "lux4 brdf 1\nparameters isotropic\ntheta_in 0\ntheta_out 0\ndelta_phi 0\nvalues 1e31",
          "t.brdf:6: found '1e31', expected a value in 1/sr, below 1e30" },
        { "lux4 brdf 1\nparameters isotropic\ntheta_in 0\ntheta_out 0\ndelta_phi 0\nvalues .1 .2",
          "t.brdf:6: found '.2', expected the end of the file after the last value" },
        { "lux4 brdf 1\nparameters isotropic\ntheta_in 0 1 2\ntheta_out 0 9\ndelta_phi 0\nvalues "
          ".1",
          "t.brdf:6: found axes of 6 places, expected no more than there are values" },
        { "lux4 brdf 1\nparameters isotropic\ntheta_in 0\ntheta_out 0 9\ndelta_phi 0\nvalues .1  "
          "#x",
          "t.brdf:6: found the end of the file, expected a value in 1/sr, below 1e30" },
        { "lux4 brdf 1\nparameters isotropic\ntheta_in 0\ntheta_out 0\ndelta_phi 0\nvalues -1",
          "t.brdf: no place has data" },
    };
    for (size_t i = 0; i < sizeof broken / sizeof *broken; i++) {
        assert_null(read_text(broken[i].text));
        assert_string_equal(err.text, broken[i].message);
    }
}

/* A finer axis than any instrument's takes long to integrate, however small its file. */
TEST(an_axis_has_at_most_2000_places)
{
    static const int rows[][2] = { { 2000, 1 }, { 2001, 0 } };
    for (int row = 0; row < 2; row++) {
        char text[40000];
        int at = snprintf(text, sizeof text, "lux4 brdf 1\nparameters half\ntheta_h");
        for (int i = 0; i < rows[row][0]; i++)
            at += snprintf(text + at, sizeof text - (size_t)at, " %.3f", 0.04 * i);
        at += snprintf(text + at, sizeof text - (size_t)at, "\ntheta_d 0\nphi_d 0\nvalues");
        for (int i = 0; i < rows[row][0]; i++)
            at += snprintf(text + at, sizeof text - (size_t)at, " .1");
        assert_int_equal(read_text(text) != NULL, rows[row][1]);
    }
    assert_string_equal(err.text, "t.brdf:3: found more than 2000 places on an axis, finer than "
                                  "any data");
}

/* Whatever a file holds, it is read or refused; sanitizers see what goes astray. */
TEST(no_mutation_of_a_file_is_misread)
{
    char text[sizeof good];
    uint32_t seed = 3;
    int read      = 0;
    for (int i = 0; i < 20000; i++) {
        memcpy(text, good, sizeof good);
        for (int k = 0; k < 1 + i % 3; k++) {
            seed                                  = seed * 1664525u + 1013904223u;
            text[(seed >> 8) % (sizeof good - 1)] = (char)"01592.-+e \n#R_\377"[seed >> 28];
        }
        const brdf *b = read_text(text);
        assert_true(b != NULL || err.code != ERR_NONE);
        read += b != NULL;
        if (b)
            assert_true(lane(value_at(b, 40, 50, 60).x, 0) >= 0.0f);
    }
    for (size_t length = 0; length < sizeof good - 1; length++) {
        memcpy(text, good, sizeof good);
        text[length] = '\0';
        read_text(text);
    }
    assert_true(read > 100 && read < 19900);
}

TEST(a_file_without_memory_is_an_error)
{
    memory_is_out = true;
    assert_null(read_text(good));
    memory_is_out = false;
    assert_int_equal(err.code, ERR_MEMORY);
}

TEST(places_without_data_become_like_their_neighbours_and_it_is_told)
{
    const brdf *b = read_text("lux4 brdf 1\nparameters isotropic\ntheta_in 0 30 60\ntheta_out 0\n"
                              "delta_phi 0\nvalues .1 -1 .2\n");
    assert_non_null(b);
    assert_near(lane(value_at(b, 30, 0, 0).x, 0), 0.1, 1e-6);
    assert_near(brdf_figures_of(b)->missing, 1.0 / 3.0, 1e-6);
    assert_string_equal(told.first->text, "t.brdf: 33.3 % of its places have no data: they repeat "
                                          "their neighbours'");
}

/* sRGB's primaries: a reflectance that is 1 above 600 nm alone is red, below 490 nm blue. */
TEST(bands_of_wavelengths_become_colours)
{
    const double nm[] = { 400, 490, 500, 590, 600, 700 };
    double w[6][3];
    bands_to_rgb(nm, 6, w);
    for (int c = 0; c < 3; c++) {
        double sum = 0.0;
        for (int i = 0; i < 6; i++)
            sum += w[i][c];
        assert_near(sum, 1.0, 1e-12);
    }
    assert_true(w[4][0] + w[5][0] > 0.6 && w[4][1] + w[5][1] < 0.1);
    assert_true(w[0][2] + w[1][2] > 0.8 && w[0][0] + w[1][0] < 0.15);
    const brdf *b = read_text("lux4 brdf 1\nbands 450 550 650\nparameters isotropic\ntheta_in 0\n"
                              "theta_out 0\ndelta_phi 0\nvalues .25 .25 .25\n");
    vrgb f        = value_at(b, 20, 30, 40);
    assert_near(lane(f.x, 0), 0.25, 1e-6); /* white stays so */
    assert_near(lane(f.y, 0), 0.25, 1e-6);
    assert_near(lane(f.z, 0), 0.25, 1e-6);
}

/* ---- MERL ------------------------------------------------------------------------------------ */

enum { H = 90, D = 90, P = 180, PLACES = H * D * P, BYTES = 12 + 24 * PLACES };

static char *new_merl(double fill)
{
    static const int32_t counts[3] = { H, D, P };
    char *bytes                    = malloc(BYTES);
    memcpy(bytes, counts, sizeof counts);
    for (int i = 0; i < 3 * PLACES; i++)
        memcpy(bytes + 12 + 8 * i, &fill, 8);
    return bytes;
}

static void put(char *bytes, int plane, int index, double value)
{
    memcpy(bytes + 12 + 8 * ((size_t)plane * PLACES + (size_t)index), &value, 8);
}

/* wi and wo by their half and difference angles (Rusinkiewicz 1998), in degrees. */
static vrgb half_value(const brdf *b, double h_deg, double d_deg, double p_deg)
{
    const double deg = M_PI / 180.0;
    double h = h_deg * deg, d = d_deg * deg, p = p_deg * deg;
    double x = sin(d) * cos(p), y = sin(d) * sin(p), z = cos(d);
    vvec3 wi = vspread(
        (vec3){ (float)(x * cos(h) + z * sin(h)), (float)y, (float)(z * cos(h) - x * sin(h)) });
    vvec3 wo = vspread(
        (vec3){ (float)(z * sin(h) - x * cos(h)), (float)-y, (float)(z * cos(h) + x * sin(h)) });
    return vbrdf_value(b, &wo, &wi, ALL_LANES);
}

/* By hand, index = phi_d + 180 (theta_d + 90 theta_h):
 *   theta_h 10.2 deg: sqrt(10.2 / 90) 90 = 30.3 -> 30, theta_d 40.5 -> 40, phi_d 70.5 -> 70
 *     70 + 180 (40 + 90 30)     =  493270, its middle theta_h = 90 (30.5 / 90)^2 = 10.336 deg
 *   theta_h 0.00278 deg = 90 (0.5 / 90)^2 -> 0, theta_d 0.5 -> 0, phi_d 0.5 -> 0: index 0
 *   theta_h 40 deg: 60 -> middle of 60 is 40.669, theta_d 20.5 -> 20, phi_d 179.5 -> 179
 *     179 + 180 (20 + 90 60)    =  975779
 */
TEST(a_merl_file_has_its_cells_where_the_database_says)
{
    char *bytes = new_merl(75.0);
    put(bytes, 0, 493270, 150.0);
    put(bytes, 1, 0, 150.0);
    put(bytes, 2, 975779, 150.0);
    put(bytes, 1, 493270 + 180 * 90, -1.0); /* no data: theta_h 31 becomes like 30 */
    char *folder = folder_new(), path[400];
    snprintf(path, sizeof path, "%s/table.binary", folder);
    FILE *f = fopen(path, "wb");
    assert_true(f && fwrite(bytes, 1, BYTES, f) == BYTES && fclose(f) == 0);
    free(bytes);

    arena_clear(&memory);
    told          = (notices){ .a = &memory };
    const brdf *b = brdf_read(&memory, path, &told, &err);
    folder_free(folder);
    assert_non_null(b);
    assert_int_equal(told.count, 1);
    assert_true(brdf_figures_of(b)->bytes < 40 << 20);

    const double red = 1.0 / 1500.0, green = 1.15 / 1500.0, blue = 1.66 / 1500.0;
    double h30 = 90.0 * (30.5 / 90.0) * (30.5 / 90.0), h60 = 90.0 * (60.5 / 90.0) * (60.5 / 90.0);
    double h0 = 90.0 * (0.5 / 90.0) * (0.5 / 90.0), h31 = 90.0 * (31.5 / 90.0) * (31.5 / 90.0);
    assert_near(lane(half_value(b, h30, 40.5, 70.5).x, 0), 150.0 * red, 1e-3);
    assert_near(lane(half_value(b, h30, 40.5, 70.5).y, 0), 75.0 * green, 1e-3);
    assert_near(lane(half_value(b, h30, 41.5, 70.5).x, 0), 75.0 * red, 1e-3);
    assert_near(lane(half_value(b, h30, 40.5, 71.0).x, 0), 112.5 * red, 1e-3); /* half way */
    assert_near(lane(half_value(b, h31, 40.5, 70.5).x, 0), 150.0 * red, 1e-3); /* no data */
    assert_near(lane(half_value(b, h0, 0.5, 0.5).y, 0), 150.0 * green, 5e-3);
    assert_near(lane(half_value(b, h60, 20.5, 179.5).z, 0), 150.0 * blue, 1e-3);
    assert_near(lane(half_value(b, h60, 20.5, -0.5).z, 0), 150.0 * blue, 1e-3);  /* wi and wo */
    assert_near(lane(half_value(b, h60, 20.5, 180.0).z, 0), 112.5 * blue, 1e-3); /* the seam */
}

TEST(a_merl_file_of_the_wrong_size_is_refused)
{
    char bytes[12 + 24 * 8];
    memset(bytes, 0, sizeof bytes);
    int32_t counts[3] = { 2, 2, 2 };
    memcpy(bytes, counts, 12);
    arena_clear(&memory);
    assert_non_null(brdf_read_merl(&memory, "m", bytes, sizeof bytes, NULL, &err));
    assert_null(brdf_read_merl(&memory, "m", bytes, sizeof bytes - 1, NULL, &err));
    assert_string_equal(err.text, "m: found 203 bytes, expected 204 for 2 x 2 x 2 cells in three "
                                  "channels");
    assert_null(brdf_read_merl(&memory, "m", bytes, 11, NULL, &err));
    assert_string_equal(err.text, "m: found 11 bytes, expected 'lux4 brdf 1', or MERL's three "
                                  "counts");
    counts[1] = -2;
    memcpy(bytes, counts, 12);
    assert_null(brdf_read_merl(&memory, "m", bytes, sizeof bytes, NULL, &err));
    assert_non_null(strstr(err.text, "offset 4: found 4294967294"));
    counts[1] = 361;
    memcpy(bytes, counts, 12);
    assert_null(brdf_read_merl(&memory, "m", bytes, sizeof bytes, NULL, &err));
    assert_non_null(strstr(err.text, "offset 4: found 361, expected"));
    assert_non_null(strstr(err.text, "each from 1 to 360"));
    counts[0] = counts[1] = counts[2] = 360;
    memcpy(bytes, counts, 12);
    assert_null(brdf_read_merl(&memory, "m", bytes, sizeof bytes, NULL, &err));
    assert_non_null(strstr(err.text, "offset 0: found 360 x 360 x 360 cells"));
    counts[2] = 2;
    counts[0] = counts[1] = 2;
    memcpy(bytes, counts, 12);
    double infinite = HUGE_VAL;
    memcpy(bytes + 12 + 8 * 3, &infinite, 8);
    assert_null(brdf_read_merl(&memory, "m", bytes, sizeof bytes, NULL, &err));
    assert_string_equal(err.text, "m: offset 36: found inf, expected a number below 1e30");
}

TEST(a_missing_file_is_named)
{
    assert_null(brdf_read(&memory, "/nowhere/x.brdf", NULL, &err));
    assert_string_equal(err.text, "/nowhere/x.brdf: no such file");
}

static int end(void **state)
{
    (void)state;
    arena_clear(&memory);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_table_is_read_as_its_file_says),
        cmocka_unit_test(each_break_of_a_file_is_named_with_its_line),
        cmocka_unit_test(an_axis_has_at_most_2000_places),
        cmocka_unit_test(no_mutation_of_a_file_is_misread),
        cmocka_unit_test(a_file_without_memory_is_an_error),
        cmocka_unit_test(places_without_data_become_like_their_neighbours_and_it_is_told),
        cmocka_unit_test(bands_of_wavelengths_become_colours),
        cmocka_unit_test(a_merl_file_has_its_cells_where_the_database_says),
        cmocka_unit_test(a_merl_file_of_the_wrong_size_is_refused),
        cmocka_unit_test(a_missing_file_is_named),
    };
    return cmocka_run_group_tests(tests, NULL, end);
}
