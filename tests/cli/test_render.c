/* tests/cli/test_render.c -- lux4 render: the pictures, and what is written about them. */
#include "core/image.h"
#include "tests/folder.h"
#include "tests/program.h"
#include "tests/test.h"

#include <stdlib.h>
#include <string.h>

#define ROOM                                                                                       \
    "lux4: 1\nroom: {size: [4, 3, 2], reflectance: 0.5}\n"                                         \
    "lights: [{type: point, at: [2, 1.5, 1.5], intensity: 100}]\n"
/* The second looks down from the ceiling on a floor of 4 m by 3 m; the third away from the room. */
static const char room[] =
    ROOM "views:\n  - {name: in, eye: [0.5, 0.5, 1], target: [3, 2, 1], fov: 70, size: [20, 15]}\n"
         "  - {name: plan, eye: [2, 1.5, 1.9], target: [2, 1.5, 0], projection: orthographic, "
         "width: 4, size: [8, 6]}\n"
         "  - {name: away, eye: [-1, 0, 1], target: [-2, 0, 1], size: [5, 4]}\n";

static const float *channel_of(const image *im, const char *name)
{
    for (int i = 0; i < im->channel_count; i++)
        if (!strcmp(im->channels[i].name, name))
            return im->channels[i].values;
    fail_msg("no channel %s", name);
    return NULL;
}

static const image_attribute *attribute_of(const image *im, const char *name)
{
    for (int i = 0; i < im->attribute_count; i++)
        if (!strcmp(im->attributes[i].name, name))
            return &im->attributes[i];
    fail_msg("no attribute %s", name);
    return NULL;
}

static void read_view(arena *a, const char *folder, const char *name, image *im)
{
    lux_error err = { 0 };
    if (!image_read_exr(path_in(folder, name), a, im, &err))
        fail_msg("%s", err.text);
    for (int i = 0; i < im->channel_count; i++)
        for (int k = 0; k < im->width * im->height; k++)
            assert_true(isfinite(im->channels[i].values[k]));
}

/* A picture that decoders know by its first eight bytes, and by its size in the first chunk. */
static void assert_png(const char *path, unsigned char width, unsigned char height)
{
    size_t size;
    unsigned char *b = (unsigned char *)bytes_of(path, &size);
    assert_true(size > 40);
    assert_memory_equal(b, "\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16);
    const unsigned char sides[8] = { 0, 0, 0, width, 0, 0, 0, height };
    assert_memory_equal(b + 16, sides, 8);
    assert_memory_equal(b + size - 8, "IEND", 4);
    free(b);
}

TEST(a_view_is_a_radiometric_exr_and_a_png)
{
    char *folder     = folder_of_study(room);
    program_result r = { 0 };
    arena a          = { 0 };
    image im;
    LUX4(folder, 0, &r, "render", "study.yaml", "--accuracy", "50%");
    assert_non_null(strstr(r.err, "lux4: warning: view away: all is black"));
    assert_non_null(strstr(r.out, "out/in.exr, "));
    assert_png(path_in(folder, "out/in.png"), 20, 15);
    assert_png(path_in(folder, "out/plan.png"), 8, 6);

    read_view(&a, folder, "out/in.exr", &im);
    assert_int_equal(im.width, 20);
    assert_int_equal(im.height, 15);
    static const char *const names[] = { "R",        "G",        "B",        "illuminance.Y",
                                         "Z",        "normal.X", "normal.Y", "normal.Z",
                                         "albedo.R", "albedo.G", "albedo.B", "halfWidth.Y" };
    assert_int_equal(im.channel_count, 12);
    for (int i = 0; i < 12; i++)
        channel_of(&im, names[i]);
    assert_near(attribute_of(&im, "whiteLuminance")->number, 179.0, 0.0);
    assert_string_equal(attribute_of(&im, "lux4:study")->text, "study.yaml");
    assert_string_equal(attribute_of(&im, "lux4:view")->text, "in");
    arena_clear(&a);
    program_free(&r);
    folder_free(folder);
}

TEST(an_orthographic_view_measures_the_floor)
{
    char *folder     = folder_of_study(room);
    program_result r = { 0 };
    arena a          = { 0 };
    image im;
    LUX4(folder, 0, &r, "render", "study.yaml", "--accuracy", "1%", "--direct-only");
    read_view(&a, folder, "out/plan.exr", &im);
    const float *e = channel_of(&im, "illuminance.Y"), *z = channel_of(&im, "Z");
    const float *red = channel_of(&im, "R"), *up = channel_of(&im, "normal.Z");
    const float *albedo = channel_of(&im, "albedo.G");
    for (int k = 0; k < 48; k++) {
        assert_near(z[k], 1.9, 1e-4);
        assert_near(up[k], 1.0, 1e-4);
        assert_near(albedo[k], 0.5, 1e-4);
        assert_near(179.0f * red[k], 0.5 / 3.14159265 * (double)e[k], 1e-4); /* L = rho E / pi */
    }
    /* E = I h / d^3 at the middle of the pixel 0.25 m east and north of below the lamp, of half a
     * metre a side: over the pixel it varies by less than 2 % from that */
    double d2 = 1.5 * 1.5 + 2.0 * 0.25 * 0.25;
    assert_near(e[2 * 8 + 4], 100.0 * 1.5 / (d2 * sqrt(d2)), 0.03);
    arena_clear(&a);
    program_free(&r);
    folder_free(folder);
}

TEST(a_view_of_nothing_is_black)
{
    char *folder     = folder_of_study(room);
    program_result r = { 0 };
    arena a          = { 0 };
    image im;
    LUX4(folder, 0, &r, "render", "study.yaml", "--accuracy", "50%", "--json");
    assert_true(json_is_valid(r.out));
    assert_memory_equal(json_at(r.out, "views.2.name"), "\"away\"", 6);
    assert_near(json_number_at(r.out, "views.2.width"), 5.0, 0.0);
    assert_memory_equal(json_at(r.out, "views.2.interval_valid"), "true", 4);
    read_view(&a, folder, "out/away.exr", &im);
    for (int i = 0; i < im.channel_count; i++)
        for (int k = 0; k < 20; k++)
            assert_true(im.channels[i].values[k] == 0.0f);
    assert_png(path_in(folder, "out/away.png"), 5, 4);
    arena_clear(&a);
    program_free(&r);
    folder_free(folder);
}

TEST(halves_are_smaller_and_as_good)
{
    char *folder     = folder_of_study(room);
    program_result r = { 0 };
    arena a          = { 0 };
    image im, half;
    LUX4(folder, 0, &r, "render", "study.yaml", "--accuracy", "50%");
    LUX4(folder, 0, &r, "render", "study.yaml", "--accuracy", "50%", "--half", "-o", "half");
    read_view(&a, folder, "out/in.exr", &im);
    read_view(&a, folder, "half/in.exr", &half);
    const float *z = channel_of(&im, "Z"), *as_half = channel_of(&half, "Z");
    for (int k = 0; k < 300; k++)
        assert_near(as_half[k], z[k], 0x1p-11); /* 11 bits, rounded */
    assert_false(same_bytes(path_in(folder, "out/in.exr"), path_in(folder, "half/in.exr")));
    assert_same_bytes(path_in(folder, "out/in.png"), path_in(folder, "half/in.png"));
    arena_clear(&a);
    program_free(&r);
    folder_free(folder);
}

TEST(threads_change_no_byte_of_a_picture)
{
    char *folder     = folder_of_study(room);
    program_result r = { 0 };
    LUX4(folder, 0, &r, "render", "study.yaml", "-o", "1", "--threads", "1", "--accuracy=30%");
    LUX4(folder, 0, &r, "render", "study.yaml", "-o", "2", "--threads", "2", "--accuracy=30%");
    LUX4(folder, 0, &r, "render", "study.yaml", "-o", "3", "--seed", "2", "--accuracy=30%");
    assert_same_bytes(path_in(folder, "1/in.exr"), path_in(folder, "2/in.exr"));
    assert_same_bytes(path_in(folder, "1/in.png"), path_in(folder, "2/in.png"));
    assert_same_bytes(path_in(folder, "1/plan.exr"), path_in(folder, "2/plan.exr"));
    assert_false(same_bytes(path_in(folder, "1/in.exr"), path_in(folder, "3/in.exr")));
    program_free(&r);
    folder_free(folder);
}

TEST(the_exposure_is_of_the_preview_alone)
{
    char *folder     = folder_of_study(room);
    program_result r = { 0 };
    LUX4(folder, 0, &r, "render", "study.yaml", "-o", "1", "--accuracy=50%");
    LUX4(folder, 0, &r, "render", "study.yaml", "-o", "2", "--accuracy=50%", "--exposure", "2");
    assert_same_bytes(path_in(folder, "1/in.exr"), path_in(folder, "2/in.exr"));
    assert_false(same_bytes(path_in(folder, "1/in.png"), path_in(folder, "2/in.png")));
    program_free(&r);
    folder_free(folder);
}

TEST(without_time_a_first_picture_is_written)
{
    char *folder     = folder_of_study(room);
    program_result r = { 0 };
    LUX4(folder, 3, &r, "render", "study.yaml", "--time", "0", "--accuracy", "0.1%");
    assert_one_line(&r, "time was out before the accuracy asked for was reached");
    assert_png(path_in(folder, "out/in.png"), 20, 15);
    assert_int_equal(count_names(path_in(folder, "out")), 6);
    program_free(&r);
    folder_free(folder);
}

TEST(a_camera_that_is_not_there_is_refused)
{
    char *folder     = folder_of_study(ROOM);
    program_result r = { 0 };
    LUX4_FAILS(folder, 2, "study.yaml: the study has no `views`", "render", "study.yaml");
    folder_write(folder, "study.yaml", ROOM "views: [{name: v, camera: Front}]\n");
    LUX4_FAILS(folder, 2, "study.yaml:4:9: view `v`: no camera `Front` in the scene: it has none",
               "render", "study.yaml");
    folder_write(folder, "scene.gltf",
                 "{\"asset\": {\"version\": \"2.0\"}, \"cameras\": [{\"type\": \"perspective\", "
                 "\"perspective\": {\"yfov\": 1, \"znear\": 0.1}}], \"nodes\": [{\"camera\": 0, "
                 "\"name\": \"Side\", \"translation\": [2, 1, -1]}], \"scenes\": [{\"nodes\": "
                 "[0]}], \"scene\": 0}");
    folder_write(folder, "study.yaml",
                 ROOM "scene: scene.gltf\nviews: [{name: v, camera: Front}]\n");
    LUX4_FAILS(folder, 2, "no camera `Front` in the scene, which has Side", "render", "study.yaml");
    assert_false(there_is(folder, "out"));
    folder_write(folder, "study.yaml",
                 ROOM "scene: scene.gltf\nviews: [{name: v, camera: Side, size: [8, 6]}]\n");
    LUX4(folder, 0, &r, "render", "study.yaml", "--accuracy=50%");
    assert_png(path_in(folder, "out/v.png"), 8, 6);
    program_free(&r);
    folder_free(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_view_is_a_radiometric_exr_and_a_png),
        cmocka_unit_test(an_orthographic_view_measures_the_floor),
        cmocka_unit_test(a_view_of_nothing_is_black),
        cmocka_unit_test(halves_are_smaller_and_as_good),
        cmocka_unit_test(threads_change_no_byte_of_a_picture),
        cmocka_unit_test(the_exposure_is_of_the_preview_alone),
        cmocka_unit_test(without_time_a_first_picture_is_written),
        cmocka_unit_test(a_camera_that_is_not_there_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
