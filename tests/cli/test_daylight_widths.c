/* tests/cli/test_daylight_widths.c -- daylight on one, four or eight lanes, on one thread and on
 * two: the same files, to the byte.
 */
#include "core/image.h"
#include "tests/folder.h"
#include "tests/program.h"
#include "tests/test.h"
#include "tests/widths.h"

#include <stdio.h>
#include <string.h>

static char *folder;

static int begin(void **state)
{
    (void)state;
    folder = folder_new();
    return 0;
}

static int end(void **state)
{
    (void)state;
    folder_free(folder);
    return 0;
}

#define ROOM                                                                                       \
    "lux4: 1\nroom: {size: [4, 5, 3], reflectance: {ceiling: 0.8, walls: [0.6, 0.5, 0.4], "        \
    "floor: 0.2}, windows: [{wall: south, at: [0.5, 1], size: [1.2, 1.2]},\n"                      \
    "  {wall: west, at: [1, 0.8], size: [2, 1.5]}]}\n"                                             \
    "lights: [{type: rect, at: [2, 2, 2.9], size: [0.6, 1.2], lumens: 1500, group: lamp, "         \
    "dimming: 0.5}]\nmaintenance: 0.8\n"                                                           \
    "grids:\n  - {name: g, on: room, height: 0.75, spacing: 1.8}\n"                                \
    "  - {name: c, on: room, height: 1.2, spacing: 2.5, quantity: cylindrical}\n"                  \
    "views: [{name: v, eye: [3.5, 4.5, 1.6], target: [1, 0, 1.4], fov: 80, size: [9, 7]}]\n"
#define BERLIN "site: {place: 52.5N 13.4E, zone: Europe/Berlin, north: 25}\n"
#define DAY    "when: {date: 2026-03-21, from: \"09:00\", to: \"15:00\", step: 120}\n"

/* The program of one width with one or two threads, into FOLDER/OUT. */
static void run(const char *program, const char *threads, const char *out,
                const char *const words[4])
{
    program_result r = { 0 };
    program_expect(
        0,
        &(program_desc){ .program = program,
                         .folder  = folder,
                         .words   = { words[0], "study.yaml", "-o", out, "--overwrite", "--threads",
                                      threads, "--accuracy", words[1], words[2], words[3] } },
        &r);
    program_free(&r);
}

/* words: command, accuracy, up to two options; names: of the files that it leaves, NULL behind. */
static void assert_same_everywhere(const char *const words[4], const char *const *names)
{
    char first[16] = "", program[4096], out[16], one[64], other[64];
    int runs       = 0;
    for (int width = 1; width; width = width_after(width)) {
        if (!program_of_width(width, program, sizeof program))
            continue;
        for (int threads = 1; threads <= 2; threads++, runs++) {
            snprintf(out, sizeof out, "%d-%d", width, threads);
            run(program, threads == 1 ? "1" : "2", out, words);
            if (!first[0])
                strcpy(first, out);
            for (int i = 0; names[i]; i++) {
                snprintf(one, sizeof one, "%s/%s", first, names[i]);
                snprintf(other, sizeof other, "%s/%s", out, names[i]);
                assert_same_bytes(path_in(folder, one), path_in(folder, other));
            }
        }
    }
    assert_true(runs >= 2);
}

#define GRIDS "g.csv", "g.exr", "c.csv", "c.exr"

static void write_study(const char *text) { folder_write(folder, "study.yaml", text); }

TEST(grids_of_a_sunny_room_are_the_same_in_groups_and_whole)
{
    write_study(ROOM BERLIN "when: 2026-03-21T14:00\nsky: {model: clear, ground: 0.3}\n");
    assert_same_everywhere((const char *const[4]){ "grid", "30%" },
                           (const char *const[]){ GRIDS, NULL });
    assert_same_everywhere((const char *const[4]){ "grid", "50%", "--groups" },
                           (const char *const[]){ GRIDS, NULL });
}

TEST(pictures_that_show_the_sky_are_the_same)
{
    static const char *const names[] = { "v.exr", "v.png", NULL };
    write_study(ROOM BERLIN "when: 2026-03-21T14:00\nsky: {model: clear, ground: 0.3}\n");
    assert_same_everywhere((const char *const[4]){ "render", "100%" }, names);
    assert_same_everywhere((const char *const[4]){ "render", "100%", "--groups" }, names);
}

TEST(a_day_of_four_hours_is_the_same)
{
    static const char *const names[] = { "g.csv", "g.exr", "g.svg", "g-sun.csv", "c.csv", NULL };
    write_study(ROOM BERLIN DAY "sky: {model: clear, turbidity: 4}\n");
    assert_same_everywhere((const char *const[4]){ "daylight", "40%" }, names);
    write_study(ROOM BERLIN DAY
                "sky: {perez: {direct_normal: 500, diffuse_horizontal: 150}, sun: point}\n");
    assert_same_everywhere((const char *const[4]){ "daylight", "50%" }, names);
}

TEST(daylight_factors_are_the_same)
{
    static const char *const names[] = { "g.csv", "g.exr", "g.svg", NULL };
    write_study(ROOM "sky: {model: overcast}\n");
    assert_same_everywhere((const char *const[4]){ "daylight", "10%", "--factor" }, names);
}

/* A picture of a sky with a sun in it, of 64 by 32 pixels. */
TEST(what_a_panorama_lights_is_the_same)
{
    enum { W = 64, H = 32 };
    static const char *const names[] = { GRIDS, NULL }, *const view[] = { "v.exr", "v.png", NULL };
    static float rgb[3][W * H];
    lux_error err = { 0 };
    for (int i = 0; i < W * H; i++)
        for (int c = 0; c < 3; c++)
            rgb[c][i] = (i < W * H / 2 ? 20.0f : 4.0f) * (1.0f + 0.1f * (float)(i * (3 + c) % 17));
    rgb[0][10 * W + 20] = rgb[1][10 * W + 20] = rgb[2][10 * W + 20] = 2e5f;
    image_channel c[3] = { { "B", rgb[2] }, { "G", rgb[1] }, { "R", rgb[0] } };
    image im           = { .width = W, .height = H, .channel_count = 3, .channels = c };
    assert_true(image_write_exr(path_in(folder, "sky.exr"), &im, false, NULL, &err));
    write_study(ROOM "sky: {model: panorama, file: sky.exr, rotate: 33}\n");
    assert_same_everywhere((const char *const[4]){ "grid", "50%" }, names);
    assert_same_everywhere((const char *const[4]){ "render", "100%" }, view);
}

TEST(pictures_of_skies_are_the_same)
{
    static const char *const names[] = { "sky.exr", "sky.png", NULL };
    char program[4096], out[16], one[64], other[64], first[16] = "";
    write_study(ROOM BERLIN "when: 2026-03-21T14:00\nsky: {model: clear}\n");
    for (int width = 1; width; width = width_after(width)) {
        program_result r = { 0 };
        if (!program_of_width(width, program, sizeof program))
            continue;
        snprintf(out, sizeof out, "sky-%d", width);
        program_expect(0,
                       &(program_desc){ .program = program,
                                        .folder  = folder,
                                        .words   = { "sky", "study.yaml", "-o", out } },
                       &r);
        program_free(&r);
        if (!first[0])
            strcpy(first, out);
        for (int i = 0; names[i]; i++) {
            snprintf(one, sizeof one, "%s/%s", first, names[i]);
            snprintf(other, sizeof other, "%s/%s", out, names[i]);
            assert_same_bytes(path_in(folder, one), path_in(folder, other));
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(grids_of_a_sunny_room_are_the_same_in_groups_and_whole),
        cmocka_unit_test(pictures_that_show_the_sky_are_the_same),
        cmocka_unit_test(a_day_of_four_hours_is_the_same),
        cmocka_unit_test(daylight_factors_are_the_same),
        cmocka_unit_test(what_a_panorama_lights_is_the_same),
        cmocka_unit_test(pictures_of_skies_are_the_same),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
