/* tests/cli/test_sky.c -- lux4 sky: its files, its figures, and that they are the same light. */
#include "core/image.h"
#include "tests/folder.h"
#include "tests/program.h"
#include "tests/test.h"

#include <stdlib.h>
#include <string.h>

static const char clear[] =
    "lux4: 1\nroom: {size: [4, 3, 2], reflectance: 0.5}\n"
    "site: {place: \"52N 13E\", altitude: 34, zone: \"+02:00\", north: 10}\n"
    "when: 2026-06-21T11:30\n"
    "sky: {model: clear, horizontal: 15000, sun_illuminance: 80000}\n"
    "variants:\n"
    "  uniform: {sky: {model: uniform, horizontal: 9000, sun_illuminance: ~, ground: 0}}\n"
    "  point: {sky: {sun: point}}\n"
    "  again: {sky: {model: panorama, file: out/sky.exr, horizontal: ~, sun_illuminance: ~}}\n";

static const image_attribute *attribute_of(const image *im, const char *name)
{
    for (int i = 0; i < im->attribute_count; i++)
        if (!strcmp(im->attributes[i].name, name))
            return &im->attributes[i];
    fail_msg("no attribute %s", name);
    return NULL;
}

static const float *channel_of(const image *im, const char *name)
{
    for (int i = 0; i < im->channel_count; i++)
        if (!strcmp(im->channels[i].name, name))
            return im->channels[i].values;
    fail_msg("no channel %s", name);
    return NULL;
}

static void read_sky(arena *a, const char *folder, image *im)
{
    lux_error err = { 0 };
    if (!image_read_exr(path_in(folder, "out/sky.exr"), a, im, &err))
        fail_msg("%s", err.text);
}

/* lx on level ground of what is above the horizon, by the exact integral over each row. */
static double lux_on_level_ground(const image *im)
{
    const float *g = channel_of(im, "G");
    double sum = 0.0, steps = M_PI / im->height;
    for (int y = 0; y < im->height / 2; y++)
        for (int x = 0; x < im->width; x++)
            sum += (double)g[(size_t)y * (size_t)im->width + (size_t)x] * M_PI / im->width *
                   (pow(sin((y + 1) * steps), 2.0) - pow(sin(y * steps), 2.0));
    return 179.0 * sum;
}

TEST(a_uniform_sky_is_even_above_and_black_below)
{
    char *folder     = folder_of_study(clear);
    program_result r = { 0 };
    arena a          = { 0 };
    image im;
    LUX4(folder, 0, &r, "sky", "study.yaml", "--variant", "uniform");
    read_sky(&a, folder, &im);
    assert_int_equal(im.width, 2048);
    assert_int_equal(im.height, 1024);
    assert_int_equal(im.channel_count, 3);
    for (int c = 0; c < 3; c++)
        for (int y = 0; y < 1024; y += 31)
            for (int x = 0; x < 2048; x += 127)
                assert_near(im.channels[c].values[y * 2048 + x],
                            y < 512 ? 9000.0 / 179.0 / M_PI : 0.0, 1e-6);
    assert_near(lux_on_level_ground(&im), 9000.0, 1e-5);
    assert_true(there_is(folder, "out/sky.png"));
    assert_non_null(strstr(r.out, "9000 lx of the sky"));
    assert_non_null(strstr(r.out, "2865 cd/m2")); /* 9000 / pi */
    arena_clear(&a);
    program_free(&r);
    folder_free(folder);
}

TEST(the_panorama_says_where_and_when_it_is_of)
{
    char *folder     = folder_of_study(clear);
    program_result r = { 0 };
    arena a          = { 0 };
    image im;
    LUX4(folder, 0, &r, "sky", "study.yaml");
    read_sky(&a, folder, &im);
    assert_near(attribute_of(&im, "whiteLuminance")->number, 179.0, 0.0);
    assert_near(attribute_of(&im, "latitude")->number, 52.0, 1e-7);
    assert_near(attribute_of(&im, "longitude")->number, 13.0, 1e-7);
    assert_near(attribute_of(&im, "altitude")->number, 34.0, 0.0);
    assert_string_equal(attribute_of(&im, "capDate")->text, "2026:06:21 11:30:00");
    assert_near(attribute_of(&im, "utcOffset")->number, -7200.0, 0.0);
    assert_string_equal(attribute_of(&im, "lux4:study")->text, "study.yaml");
    assert_string_equal(attribute_of(&im, "lux4:sky")->text, "clear");
    arena_clear(&a);
    program_free(&r);
    folder_free(folder);
}

TEST(a_panorama_is_as_wide_as_asked_for)
{
    char *folder     = folder_of_study(clear);
    program_result r = { 0 };
    arena a          = { 0 };
    image im;
    LUX4(folder, 0, &r, "sky", "study.yaml", "--variant", "uniform", "--width", "130");
    read_sky(&a, folder, &im);
    assert_int_equal(im.width, 130);
    assert_int_equal(im.height, 65);
    assert_near(im.channels[0].values[130 * 31 + 7], 9000.0 / 179.0 / M_PI, 1e-6);
    LUX4_FAILS(folder, 2, "--width 129: expected an even number of pixels from 64 to 16384", "sky",
               "study.yaml", "--width", "129");
    LUX4_FAILS(folder, 2, "--width 62: expected an even number", "sky", "study.yaml", "--width",
               "62");
    LUX4_FAILS(folder, 2, "--width has no meaning for lux4 grid", "grid", "study.yaml", "--width",
               "64");
    arena_clear(&a);
    program_free(&r);
    folder_free(folder);
}

/* Sky and sun as they come out of the study that is asked for. */
static void figures(const char *folder, const char *variant, program_result *r)
{
    if (variant)
        LUX4(folder, 0, r, "sky", "study.yaml", "--json", "--overwrite", "-o", "other", "--variant",
             variant);
    else
        LUX4(folder, 0, r, "sky", "study.yaml", "--json");
    assert_true(json_is_valid(r->out));
}

TEST(read_back_as_a_panorama_it_gives_the_same_light)
{
    char *folder     = folder_of_study(clear);
    program_result r = { 0 }, b = { 0 };
    arena a = { 0 };
    image im;
    figures(folder, NULL, &r);
    figures(folder, "again", &b);
    assert_near(json_number_at(r.out, "sky_horizontal_lx"), 15000.0, 1e-5);
    assert_near(json_number_at(r.out, "sun_normal_lx"), 80000.0, 1e-6);

    /* The sun's energy to a float's rounding of some pixels, what is under it to their mean */
    double azimuth = json_number_at(r.out, "sun_azimuth_deg");
    double high    = json_number_at(r.out, "sun_elevation_deg");
    assert_near(json_number_at(b.out, "sun_normal_lx"), 80000.0, 1e-4);
    assert_near(json_number_at(b.out, "sky_horizontal_lx"), 15000.0, 1e-4);
    assert_true(fabs(json_number_at(b.out, "sun_azimuth_deg") - azimuth) < 0.02);
    assert_true(fabs(json_number_at(b.out, "sun_elevation_deg") - high) < 0.02);
    /* Of a pixel whose middle is 0.09 degrees off, where this sky grows by 1.5 a radian */
    assert_near(json_number_at(b.out, "zenith_cd_m2"), json_number_at(r.out, "zenith_cd_m2"), 3e-3);

    /* And the picture itself: sky and sun together */
    read_sky(&a, folder, &im);
    double sine = sin(high * M_PI / 180.0);
    assert_near(lux_on_level_ground(&im), 15000.0 + 80000.0 * sine, 1e-4);
    arena_clear(&a);
    program_free(&r);
    program_free(&b);
    folder_free(folder);
}

TEST(a_sun_that_is_a_point_has_its_energy_in_the_picture_too)
{
    char *folder     = folder_of_study(clear);
    program_result r = { 0 };
    arena a          = { 0 };
    image im;
    LUX4(folder, 0, &r, "sky", "study.yaml", "--variant", "point", "--json");
    double sine = sin(json_number_at(r.out, "sun_elevation_deg") * M_PI / 180.0);
    assert_near(json_number_at(r.out, "sun_horizontal_lx"), 80000.0 * sine, 1e-6);
    read_sky(&a, folder, &im);
    assert_near(lux_on_level_ground(&im), 15000.0 + 80000.0 * sine, 1e-4);
    arena_clear(&a);
    program_free(&r);
    folder_free(folder);
}

TEST(what_cannot_be_is_refused)
{
    char *folder = folder_of_study("lux4: 1\nroom: {size: [4, 3, 2], reflectance: 0.5}\n");
    LUX4_FAILS(folder, 2, "the study has no `sky`", "sky", "study.yaml");
    LUX4_FAILS(folder, 2, "which study?", "sky");
    folder_free(folder);
    folder = folder_of_study(
        "lux4: 1\nsky: {model: uniform, horizontal: 5000}\nroom: {size: [4, 3, 2], "
        "reflectance: 0.5}\nviews: [{name: sky, eye: [1, 1, 1], target: [2, 1, 1]}]\n");
    LUX4_FAILS(folder, 2, "a grid or view is called `sky`", "sky", "study.yaml");
    folder_free(folder);
}

TEST(the_same_study_gives_the_same_bytes)
{
    char *folder     = folder_of_study(clear);
    program_result r = { 0 };
    LUX4(folder, 0, &r, "sky", "study.yaml", "--threads", "1");
    LUX4(folder, 0, &r, "sky", "study.yaml", "--threads", "3", "-o", "other");
    assert_same_bytes(path_in(folder, "out/sky.exr"), path_in(folder, "other/sky.exr"));
    assert_same_bytes(path_in(folder, "out/sky.png"), path_in(folder, "other/sky.png"));
    program_free(&r);
    folder_free(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_uniform_sky_is_even_above_and_black_below),
        cmocka_unit_test(the_panorama_says_where_and_when_it_is_of),
        cmocka_unit_test(a_panorama_is_as_wide_as_asked_for),
        cmocka_unit_test(read_back_as_a_panorama_it_gives_the_same_light),
        cmocka_unit_test(a_sun_that_is_a_point_has_its_energy_in_the_picture_too),
        cmocka_unit_test(what_cannot_be_is_refused),
        cmocka_unit_test(the_same_study_gives_the_same_bytes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
