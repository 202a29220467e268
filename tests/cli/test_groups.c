/* tests/cli/test_groups.c -- --groups: a layer a group, and what lux4 mix makes of the layers.
 *
 * Samples of a layered run do not depend on dimming, so that layers of two runs are the same to the
 * byte, and a mixture is off by roundings only: of floats in EXR, and of samples, which are
 * floats before they are summed.
 */
#include "core/image.h"
#include "tests/box_gltf.h"
#include "tests/folder.h"
#include "tests/gltf_text.h"
#include "tests/program.h"
#include "tests/test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { GROUPS = 3, MOST_ROWS = 64 };
static const char *const groups[GROUPS] = { "general", "desk", "other" };

/* Relative: float roundings of lamps at some bounces, of their sum, of the mixture. */
static const double rounding = 8 * 0x1p-24;

/* Lamps of all ways to be taken: as points, by closed forms, by samples. */
static const char format[] =
    "lux4: 1\n"
    "room: {size: [4, 3, 2.5], reflectance: 0.5}\n"
    "maintenance: 0.8\n"
    "scene: {file: table.gltf}\n"
    "lights:\n"
    "  - {type: rect, at: [1, 1, 2.4], size: [0.3, 1.2], lumens: 1000, group: general%s}\n"
    "  - {type: point, at: [3, 2, 2.2], lumens: 700, group: general%s}\n"
    "  - {type: disk, at: [3, 1, 2], radius: 0.2, lumens: 900, group: desk, color: 2700K%s}\n"
    "  - {type: linear, from: [1, 2.5, 2], to: [3, 2.5, 2], lumens: 800%s}\n"
    "grids: [{name: plane, on: room, height: 0.1, spacing: 0.9}]\n"
    "views: [{name: view, eye: [0.3, 0.3, 1.5], target: [3, 2, 1.4], fov: 80, size: [9, 7]}]\n"
    "%s";

static char *folder;
static arena memory;

static int begin(void **state)
{
    (void)state;
    folder = folder_new();
    box_gltf_write(folder, "table.gltf", (double[]){ 2, 1, 0.2 }, (double[]){ 3, 1.6, 0.7 }, 0.0);
    return 0;
}

static int end(void **state)
{
    (void)state;
    folder_free(folder);
    arena_clear(&memory);
    return 0;
}

/* Runs grid and view, into the folder's NAME. */
static void run(const char *name, const char *text, bool layered)
{
    program_result r = { 0 };
    char file[64];
    snprintf(file, sizeof file, "%s.yaml", name);
    folder_write(folder, file, text);
    const char *more = layered ? "--groups" : "--quiet";
    LUX4(folder, 0, &r, "grid", file, "--accuracy", "20%", "-o", name, more);
    LUX4(folder, 0, &r, "render", file, "--accuracy", "40%", "-o", name, more);
    program_free(&r);
}

static const char *study_of(const char *own_general, const char *own_desk, const char *own_other,
                            const char *top)
{
    return text_of(&memory, format, own_general, own_general, own_desk, own_other, top);
}

static const char *in(const char *name, const char *file)
{
    return path_in(folder, text_of(&memory, "%s/%s", name, file));
}

/* A column of a table by its name; how many rows it has. */
static int column(const char *path, const char *name, double out[MOST_ROWS])
{
    size_t size;
    char *text = bytes_of(path, &size), *line_end, *line;
    int which = -1, at = 0, rows = 0;
    for (char *word = strtok_r(text, "\n", &line_end), *rest, *cell = strtok_r(word, ",", &rest);
         cell; cell = strtok_r(NULL, ",", &rest), at++)
        which = strcmp(cell, name) ? which : at;
    assert_true(which >= 0);
    while ((line = strtok_r(NULL, "\n", &line_end)) && rows < MOST_ROWS) {
        for (int c = 0; c < which; c++)
            line = strchr(line, ',') + 1;
        out[rows++] = strtod(line, NULL);
    }
    free(text);
    return rows;
}

static image read_exr(const char *path)
{
    image im;
    lux_error err = { 0 };
    if (!image_read_exr(path, &memory, &im, &err))
        fail_msg("%s", err.text);
    return im;
}

static const float *channel(const image *im, const char *name)
{
    for (int c = 0; c < im->channel_count; c++)
        if (!strcmp(im->channels[c].name, name))
            return im->channels[c].values;
    fail_msg("no channel %s", name);
    return NULL;
}

static const float *layer(const image *im, int group, const char *what)
{
    return channel(im, text_of(&memory, "group.%s.%s", groups[group], what));
}

/* ---- layers ---------------------------------------------------------------------------------- */

static void assert_sum(const image *im, const char *all, const char *part, const double factors[])
{
    const float *whole = channel(im, all);
    for (int i = 0; i < im->width * im->height; i++) {
        double sum = 0.0;
        for (int g = 0; g < GROUPS; g++) {
            double l = (double)layer(im, g, part)[i];
            assert_true(l >= 0.0);
            sum += factors[g] * l;
        }
        assert_near(whole[i], sum, rounding);
    }
}

TEST(dimmed_layers_add_up_to_the_whole)
{
    static const double factors[] = { 0.25, 2.0, 0.0 };
    run("sum", study_of("", "", "", "dimming: {general: 0.25, desk: 2, other: 0}\n"), true);

    double all[MOST_ROWS], own[GROUPS][MOST_ROWS];
    int rows = column(in("sum", "plane.csv"), "illuminance_lx", all);
    assert_int_equal(rows, 4 * 3);
    for (int g = 0; g < GROUPS; g++)
        column(in("sum", "plane.csv"), text_of(&memory, "%s_lx", groups[g]), own[g]);
    for (int k = 0; k < rows; k++) {
        assert_true(own[0][k] > 0.0 && own[1][k] > 0.0 && own[2][k] > 0.0);
        double sum = factors[0] * own[0][k] + factors[1] * own[1][k] + factors[2] * own[2][k];
        assert_near(all[k], sum, rounding);
    }

    image plane = read_exr(in("sum", "plane.exr"));
    assert_sum(&plane, "Y", "Y", factors);
    assert_sum(&plane, "direct.Y", "direct.Y", factors);
    image view = read_exr(in("sum", "view.exr"));
    assert_sum(&view, "R", "R", factors);
    assert_sum(&view, "G", "G", factors);
    assert_sum(&view, "B", "B", factors);
    assert_sum(&view, "illuminance.Y", "illuminance.Y", factors);
    for (int g = 0; g < GROUPS;
         g++) /* as wide as asked for: 20 %, of a tenth of the mean at least */
        for (int i = 0; i < 4 * 3; i++) {
            double half = (double)layer(&plane, g, "halfWidth.Y")[i];
            assert_true(half >= 0.0 && half <= 0.2 * (double)layer(&plane, g, "Y")[i] + 20.0);
            assert_true((double)layer(&view, g, "halfWidth.Y")[i] >= 0.0);
        }
}

/* All channels and columns of layers are the same to the bit. */
static void assert_same_layers(const char *one, const char *other)
{
    double a[MOST_ROWS], b[MOST_ROWS];
    for (int g = 0; g < GROUPS; g++) {
        const char *name = text_of(&memory, "%s_lx", groups[g]);
        int rows         = column(in(one, "plane.csv"), name, a);
        assert_int_equal(column(in(other, "plane.csv"), name, b), rows);
        assert_memory_equal(a, b, (size_t)rows * sizeof *a);
    }
    for (int picture = 0; picture < 2; picture++) {
        const char *file = picture ? "view.exr" : "plane.exr";
        image x = read_exr(in(one, file)), y = read_exr(in(other, file));
        size_t bytes = sizeof(float) * (size_t)x.width * (size_t)x.height;
        for (int c = 0; c < x.channel_count; c++)
            if (!strncmp(x.channels[c].name, "group.", 6))
                assert_memory_equal(x.channels[c].values, channel(&y, x.channels[c].name), bytes);
    }
}

/* Mixes the results in FROM by these words: table, grid and view are those in DIMMED. */
static void assert_mixed(const char *from, const char *dimmed, const char *const words[3])
{
    program_result r = { 0 };
    double got[MOST_ROWS], want[MOST_ROWS];
    LUX4(folder, 0, &r, "mix", in(from, "plane.csv"), words[0], words[1], words[2], "-o", "mix.csv",
         "--overwrite");
    int rows = column(path_in(folder, "mix.csv"), "illuminance_lx", got);
    assert_int_equal(column(in(dimmed, "plane.csv"), "illuminance_lx", want), rows);
    for (int k = 0; k < rows; k++)
        assert_near(got[k], want[k], rounding);

    static const char *const channels[2][4] = { { "Y" }, { "R", "G", "B", "illuminance.Y" } };
    for (int picture = 0; picture < 2; picture++) {
        const char *file = picture ? "view.exr" : "plane.exr";
        LUX4(folder, 0, &r, "mix", in(from, file), words[0], words[1], words[2], "-o", "mix.exr",
             "--overwrite");
        image x = read_exr(path_in(folder, "mix.exr")), y = read_exr(in(dimmed, file));
        for (int c = 0; c < (picture ? 4 : 1); c++) {
            const float *a = channel(&x, channels[picture][c]);
            const float *b = channel(&y, channels[picture][c]);
            for (int i = 0; i < x.width * x.height; i++)
                assert_near(a[i], b[i], rounding);
        }
    }
    program_free(&r);
}

TEST(a_mixture_is_what_a_run_with_those_dimmings_gives)
{
    static const char *const by_top[] = { "general=0.3", "desk=2", "other=0" };
    static const char *const by_own[] = { "general=0.6", "desk=0", "other=1.5" };
    static const char *const none[]   = { "general=0", "desk=0", "other=0" };
    run("full", study_of("", "", "", ""), true);
    run("top", study_of("", "", "", "dimming: {general: 0.3, desk: 2, other: 0}\n"), true);
    run("own", study_of(", dimming: 0.6", ", dimming: 0", ", dimming: 1.5", ""), true);
    run("none", study_of("", "", "", "dimming: {general: 0, desk: 0, other: 0}\n"), true);
    assert_same_layers("full", "top");
    assert_same_layers("full", "own");
    assert_same_layers("full", "none");
    assert_mixed("full", "top", by_top);
    assert_mixed("full", "own", by_own);
    assert_mixed("full", "none", none);
    assert_mixed("none", "top", by_top); /* what was out can be lit */
}

TEST(a_plain_run_agrees_within_the_half_widths)
{
    static const char dimming[] = "dimming: {general: 0.3, desk: 2, other: 0}\n";
    double a[MOST_ROWS], b[MOST_ROWS], half[MOST_ROWS], plain_half[MOST_ROWS];
    int off = 0;
    run("layered", study_of("", "", "", dimming), true);
    run("plain", study_of("", "", "", dimming), false);
    int rows = column(in("layered", "plane.csv"), "illuminance_lx", a);
    column(in("layered", "plane.csv"), "half_width_lx", half);
    column(in("plain", "plane.csv"), "illuminance_lx", b);
    column(in("plain", "plane.csv"), "half_width_lx", plain_half);
    for (int k = 0; k < rows; k++)
        off += fabs(a[k] - b[k]) > half[k] + plain_half[k];
    assert_int_equal(off, 0); /* of 12, each has 0.6 % */
    image plain = read_exr(in("plain", "plane.exr"));
    assert_int_equal(plain.channel_count, 4); /* no layers */
}

/* ---- which group ----------------------------------------------------------------------------- */

TEST(what_glows_is_of_the_group_other)
{
    program_result r = { 0 };
    double dark[MOST_ROWS], other[MOST_ROWS], all[MOST_ROWS];
    box_gltf_write(folder, "lamp.gltf", (double[]){ 1, 1, 2 }, (double[]){ 1.3, 1.3, 2.3 }, 1.0);
    folder_write(folder, "glow.yaml",
                 "lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: 0.5}\nscene: lamp.gltf\n"
                 "lights: [{type: point, at: [3, 2, 2], intensity: 1, group: a, dimming: 0}]\n"
                 "dimming: {other: 0.5}\n"
                 "grids: [{name: g, on: room, height: 0.5, spacing: 1}]\n");
    LUX4(folder, 0, &r, "grid", "glow.yaml", "--groups", "-o", "glow", "--accuracy", "5%");
    int rows = column(in("glow", "g.csv"), "a_lx", dark);
    column(in("glow", "g.csv"), "other_lx", other);
    column(in("glow", "g.csv"), "illuminance_lx", all);
    for (int k = 0; k < rows; k++) {
        assert_true(dark[k] > 0.0 && other[k] > 0.0);
        assert_near(all[k], 0.5 * other[k], rounding);
    }
    program_free(&r);
}

TEST(a_lamp_of_a_group_dimmed_otherwise_is_told)
{
    program_result r = { 0 };
    folder_write(folder, "differ.yaml",
                 "lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: 0.5}\nlights:\n"
                 "  - {type: point, at: [3, 2, 2], intensity: 1, group: a, dimming: 0.5}\n"
                 "  - {type: point, at: [1, 2, 2], intensity: 1, group: a}\n"
                 "grids: [{name: g, on: room, height: 0.5, spacing: 1}]\n");
    LUX4(folder, 0, &r, "grid", "differ.yaml", "--groups", "-o", "differ", "--accuracy", "5%");
    assert_non_null(
        strstr(r.err, "warning: differ.yaml: lights of group `a` are dimmed differently"));
    LUX4(folder, 0, &r, "grid", "differ.yaml", "-o", "differ-2", "--accuracy", "5%");
    assert_string_equal(r.err, "");
    program_free(&r);
}

TEST(more_groups_than_there_are_layers_are_refused)
{
    char text[8192] = "lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: 0.5}\n"
                      "grids: [{name: g, on: room, height: 0.5, spacing: 1}]\nlights:\n";
    for (int count = 32; count <= 33; count++) {
        char *to = strstr(text, "lights:\n") + 8;
        for (int i = 0; i < count; i++)
            to += snprintf(to, 128, "  - {type: point, at: [1, 1, 2], intensity: 1, group: g%d}\n",
                           i);
        folder_write(folder, "many.yaml", text);
        program_result r = { 0 };
        if (count == 33)
            LUX4_FAILS(folder, 2, "many.yaml: 33 groups, expected at most 32", "grid", "many.yaml",
                       "--groups", "-o", "many", "--overwrite");
        LUX4(folder, 0, &r, "grid", "many.yaml", count == 33 ? "--quiet" : "--groups", "-o", "many",
             "--overwrite", "--accuracy", "20%", "--direct-only");
        program_free(&r);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(dimmed_layers_add_up_to_the_whole),
        cmocka_unit_test(a_mixture_is_what_a_run_with_those_dimmings_gives),
        cmocka_unit_test(a_plain_run_agrees_within_the_half_widths),
        cmocka_unit_test(what_glows_is_of_the_group_other),
        cmocka_unit_test(a_lamp_of_a_group_dimmed_otherwise_is_told),
        cmocka_unit_test(more_groups_than_there_are_layers_are_refused),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
