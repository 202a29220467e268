/* tests/cli/test_mix.c -- lux4 mix: results of chosen numbers, and mixtures summed by hand. */
#include "core/image.h"
#include "tests/folder.h"
#include "tests/program.h"
#include "tests/test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char header[] = "x,y,z,nx,ny,nz,illuminance_lx,direct_lx,indirect_lx,half_width_lx,"
                             "general_lx,sky_lx\n";

static void expect_text(const char *folder, const char *name, const char *want)
{
    size_t size;
    char *got = bytes_of(path_in(folder, name), &size);
    assert_string_equal(got, want);
    free(got);
}

/* ---- tables ---------------------------------------------------------------------------------- */

TEST(a_table_is_mixed_by_its_columns_of_groups)
{
    program_result r = { 0 };
    char *folder     = folder_new(), text[600];
    snprintf(text, sizeof text, "%s%s", header,
             "0.10,2,0.75,0,0,1,110,80,30,1.5,100,10\n"
             "0.30,2,0.75,0,0,1,0.3,0.2,0.1,0,0.1,0.2\r\n"
             "# partial: interrupted\n");
    folder_write(folder, "desk.csv", text);

    LUX4(folder, 0, &r, "mix", "desk.csv", "general=0.25", "sky=2");
    assert_non_null(strstr(r.out, "written: desk-mix.csv"));
    assert_non_null(strstr(r.err, "direct, indirect and half width"));
    expect_text(folder, "desk-mix.csv", /* 25 + 20, 0.025 + 0.4 */
                "x,y,z,nx,ny,nz,illuminance_lx,general_lx,sky_lx\n"
                "0.10,2,0.75,0,0,1,45,100,10\n"
                "0.30,2,0.75,0,0,1,0.425,0.1,0.2\n"
                "# partial: interrupted\n");

    /* A mixture again, of which no more can be lost; what is not named counts in full */
    LUX4(folder, 0, &r, "mix", "--json", "desk-mix.csv", "general=0", "-o", "night.csv");
    assert_string_equal(r.err, "");
    assert_true(json_is_valid(r.out));
    assert_near(json_number_at(r.out, "average_lx"), (10.0 + 0.2) / 2.0, 1e-9);
    assert_near(json_number_at(r.out, "groups.0.factor"), 0.0, 0.0);
    assert_near(json_number_at(r.out, "groups.1.factor"), 1.0, 0.0);
    assert_memory_equal(json_at(r.out, "groups.1.name"), "\"sky\"", 5);
    assert_memory_equal(json_at(r.out, "file"), "\"night.csv\"", 11);
    expect_text(folder, "night.csv",
                "x,y,z,nx,ny,nz,illuminance_lx,general_lx,sky_lx\n"
                "0.10,2,0.75,0,0,1,10,100,10\n"
                "0.30,2,0.75,0,0,1,0.2,0.1,0.2\n"
                "# partial: interrupted\n");

    LUX4(folder, 0, &r, "mix", "desk.csv", "-o", "quiet.csv", "--quiet");
    assert_string_equal(r.err, "");
    program_free(&r);
    folder_free(folder);
}

TEST(tables_that_are_none_are_refused_with_their_line)
{
    static const struct {
        const char *rows, *says;
    } cases[] = {
        { "", "t.csv: no row below the header" },
        { "1,2,3,0,0,1,5,4,1,0,3\n", "t.csv:2:22: expected as many numbers" },
        { "1,2,3,0,0,1,5,4,1,0,3,2,7\n", "t.csv:2:24: expected the end of the line" },
        { "1,2,3,0,0,1,5,4,1,0,3,2\n1,2,3,0,0,1,5,4,1,0,nan,2\n",
          "t.csv:3:21: expected a number, found `nan`" },
        { "1,2,3,0,0,1,5,4,1,0,1e999,2\n", "t.csv:2:21: expected a number" },
        { "1,2,3,0,0,1,5,4,1,0, 3,2\n", "t.csv:2:21: expected a number, found ` 3`" },
        { "1,two,3,0,0,1,5,4,1,0,3,2\n", "t.csv:2:3: expected a number, found `two`" },
        { "1,2,3,0,0,1,5,4,1,0,1e308,1e308\n", "t.csv:2: the mixture is too large" },
    };
    char *folder = folder_new(), text[600];
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        snprintf(text, sizeof text, "%s%s", header, cases[i].rows);
        folder_write(folder, "t.csv", text);
        LUX4_FAILS(folder, 2, cases[i].says, "mix", "t.csv");
        LUX4_FAILS(folder, 2, cases[i].says, "mix", "t.csv", "--json", "--quiet");
    }
    static const struct {
        const char *text, *says;
    } headers[] = {
        { "", "t.csv:1:1: expected a grid's header" },
        { "x,y,z,nx,ny,nz\n1,2,3,0,0,1\n", "t.csv:1:1: expected a grid's header" },
        { "x,y,z,nx,ny,nz,illuminance_lx\n1,2,3,0,0,1,5\n", "t.csv: no group layers" },
        { "x,y,z,nx,ny,nz,illuminance_lx,direct_lx,indirect_lx,half_width_lx\n",
          "no group layers" },
        { "x,y,z,nx,ny,nz,illuminance_lx,a_lx,a_lx\n", "t.csv:1:36: expected each group once" },
        { "x,y,z,nx,ny,nz,illuminance_lx,a_lx,_lx\n", "t.csv:1:36: expected a column NAME_lx" },
        { "x,y,z,nx,ny,nz,illuminance_lx,a_lx,b\n",
          "expected a column NAME_lx of a group, found `b`" },
    };
    for (size_t i = 0; i < sizeof headers / sizeof *headers; i++) {
        folder_write(folder, "t.csv", headers[i].text);
        LUX4_FAILS(folder, 2, headers[i].says, "mix", "t.csv");
    }
    assert_int_equal(count_names(folder), 1); /* nothing was left */
    folder_free(folder);
}

/* ---- pictures -------------------------------------------------------------------------------- */

enum { WIDTH = 3, HEIGHT = 2, PIXELS = WIDTH * HEIGHT, ALL_CHANNELS = 32 };

/* A picture that grows; pixel i of a channel is value + i * step. */
typedef struct picture {
    image im;
    image_channel channels[ALL_CHANNELS];
    float values[ALL_CHANNELS][PIXELS];
} picture;

static void add(picture *p, const char *name, float value, float step)
{
    int c          = p->im.channel_count++;
    p->im.width    = WIDTH;
    p->im.height   = HEIGHT;
    p->im.channels = p->channels;
    p->channels[c] = (image_channel){ name, p->values[c] };
    for (int i = 0; i < PIXELS; i++)
        p->values[c][i] = value + (float)i * step;
}

static void write_picture(const picture *p, const char *folder, const char *name)
{
    static image_attribute attributes[] = {
        { "lux4:study", ATTRIBUTE_STRING, "office.yaml", 0 },
        { "lux4:mix", ATTRIBUTE_STRING, "an older one", 0 },
        { "whiteLuminance", ATTRIBUTE_FLOAT, NULL, 179.0f },
    };
    image im           = p->im;
    im.attributes      = attributes;
    im.attribute_count = 3;
    lux_error err      = { 0 };
    if (!image_write_exr(path_in(folder, name), &im, false, NULL, &err))
        fail_msg("%s", err.text);
}

static void read_picture(arena *a, const char *folder, const char *name, image *out)
{
    lux_error err = { 0 };
    if (!image_read_exr(path_in(folder, name), a, out, &err))
        fail_msg("%s", err.text);
}

static const float *values_of(const image *im, const char *name)
{
    for (int c = 0; c < im->channel_count; c++)
        if (!strcmp(im->channels[c].name, name))
            return im->channels[c].values;
    return NULL;
}

static void expect_channel(const image *im, const char *name, float value, float step)
{
    const float *got = values_of(im, name);
    if (!got)
        fail_msg("no channel %s", name);
    for (int i = 0; i < PIXELS; i++)
        assert_near(got[i], value + (float)i * step, 0.0); /* all sums here are exact */
}

static const char *attribute_of(const image *im, const char *name)
{
    const char *text = NULL;
    for (int i = 0; i < im->attribute_count; i++)
        if (!strcmp(im->attributes[i].name, name)) {
            assert_null(text); /* once */
            text = im->attributes[i].type == ATTRIBUTE_STRING ? im->attributes[i].text : "a number";
        }
    return text;
}

static void write_grid(const char *folder)
{
    picture p = { 0 };
    add(&p, "Y", 150, 3);
    add(&p, "direct.Y", 110, 3);
    add(&p, "indirect.Y", 40, 0);
    add(&p, "halfWidth.Y", 1, 0);
    add(&p, "group.general.Y", 100, 2);
    add(&p, "group.general.direct.Y", 70, 2);
    add(&p, "group.general.halfWidth.Y", 0.5f, 0);
    add(&p, "group.spot.1.Y", 50, 1); /* names may hold dots */
    add(&p, "group.spot.1.direct.Y", 40, 1);
    add(&p, "group.spot.1.halfWidth.Y", 0.75f, 0);
    write_picture(&p, folder, "desk.exr");
}

TEST(a_grid_is_mixed_channel_by_channel)
{
    program_result r = { 0 };
    char *folder     = folder_new();
    arena a          = { 0 };
    image im;
    write_grid(folder);
    LUX4(folder, 0, &r, "mix", "desk.exr", "general=0.5", "-o", "evening.exr", "--json");
    assert_true(json_is_valid(r.out));
    assert_near(json_number_at(r.out, "average_lx"), 100.0 + 2.5 * 2.0, 1e-9);
    read_picture(&a, folder, "evening.exr", &im);
    assert_int_equal(im.channel_count, 10);
    expect_channel(&im, "Y", 100, 2);
    expect_channel(&im, "direct.Y", 75, 2);
    expect_channel(&im, "indirect.Y", 25, 0);
    expect_channel(&im, "halfWidth.Y", 1, 0);
    expect_channel(&im, "group.general.Y", 100, 2);
    expect_channel(&im, "group.spot.1.direct.Y", 40, 1);
    assert_string_equal(attribute_of(&im, "lux4:mix"), "general=0.5 spot.1=1");
    assert_string_equal(attribute_of(&im, "lux4:study"), "office.yaml");
    assert_string_equal(attribute_of(&im, "whiteLuminance"), "a number");

    LUX4(folder, 0, &r, "mix", "evening.exr", "spot.1=3", "general=0"); /* a mixture again */
    read_picture(&a, folder, "evening-mix.exr", &im);
    expect_channel(&im, "Y", 150, 3);
    expect_channel(&im, "indirect.Y", 30, 0);
    expect_channel(&im, "halfWidth.Y", 2.25f, 0);
    assert_int_equal(count_names(folder), 3);
    arena_clear(&a);
    program_free(&r);
    folder_free(folder);
}

static void add_view_group(picture *p, const char *const names[5], float value)
{
    for (int k = 0; k < 5; k++)
        add(p, names[k], value * (float)(k + 1), 1);
}

TEST(a_view_is_mixed_and_shown_with_its_surfaces_kept)
{
    static const char *const general[] = { "group.general.R", "group.general.G", "group.general.B",
                                           "group.general.illuminance.Y",
                                           "group.general.halfWidth.Y" };
    static const char *const of_sky[]  = { "group.sky.R", "group.sky.G", "group.sky.B",
                                           "group.sky.illuminance.Y", "group.sky.halfWidth.Y" };
    static const char *const mixed[]   = { "R", "G", "B", "illuminance.Y", "halfWidth.Y" };
    program_result r                   = { 0 };
    char *folder                       = folder_new();
    arena a                            = { 0 };
    picture p                          = { 0 };
    image im;
    add_view_group(&p, mixed, 7);
    add_view_group(&p, general, 4);
    add_view_group(&p, of_sky, 3);
    add(&p, "Z", 5, 0.25f);
    add(&p, "normal.Z", -1, 0);
    write_picture(&p, folder, "view.exr");

    LUX4(folder, 0, &r, "mix", "view.exr", "sky=0", "general=0.5", "--json");
    assert_true(json_is_valid(r.out));
    assert_null(json_at(r.out, "average_lx"));
    assert_memory_equal(json_at(r.out, "png"), "\"view-mix.png\"", 14);
    assert_true(there_is(folder, "view-mix.png"));
    read_picture(&a, folder, "view-mix.exr", &im);
    assert_int_equal(im.channel_count, 17);
    for (int k = 0; k < 5; k++)
        expect_channel(&im, mixed[k], 2.0f * (float)(k + 1), 0.5f);
    expect_channel(&im, "Z", 5, 0.25f);
    expect_channel(&im, "normal.Z", -1, 0);
    expect_channel(&im, "group.sky.illuminance.Y", 12, 1);

    LUX4(folder, 0, &r, "mix", "view.exr", "-o", "only.png");
    assert_true(there_is(folder, "only.png"));
    assert_false(there_is(folder, "only.exr"));
    LUX4_FAILS(folder, 2, "expected a name that ends in .exr, as that of what is mixed, or in .png",
               "mix", "view.exr", "-o", "view.csv");
    arena_clear(&a);
    program_free(&r);
    folder_free(folder);
}

TEST(a_channel_without_its_layers_is_left_out)
{
    program_result r = { 0 };
    char *folder     = folder_new();
    arena a          = { 0 };
    picture p        = { 0 };
    image im;
    add(&p, "Y", 3, 0);
    add(&p, "direct.Y", 2, 0);
    add(&p, "indirect.Y", 1, 0);
    add(&p, "halfWidth.Y", 1, 0);
    add(&p, "group.a.Y", 1, 0);
    add(&p, "group.a.direct.Y", 1, 0);
    add(&p, "group.b.Y", 2, 0);
    write_picture(&p, folder, "g.exr");
    LUX4(folder, 0, &r, "mix", "g.exr", "b=2");
    read_picture(&a, folder, "g-mix.exr", &im);
    expect_channel(&im, "Y", 5, 0);
    assert_null(values_of(&im, "direct.Y"));
    assert_null(values_of(&im, "indirect.Y"));
    assert_null(values_of(&im, "halfWidth.Y"));

    add(&p, "group.c.direct.Y", 1, 0); /* what is all of it then? */
    write_picture(&p, folder, "g.exr");
    LUX4_FAILS(folder, 2, "expected a channel group.c.Y", "mix", "g.exr", "--overwrite");
    arena_clear(&a);
    program_free(&r);
    folder_free(folder);
}

/* 1 and twice 2^-24: in floats, one after the other, 1. */
TEST(sums_are_rounded_once)
{
    program_result r = { 0 };
    char *folder     = folder_new();
    arena a          = { 0 };
    picture p        = { 0 };
    image im;
    add(&p, "group.a.Y", 1, 0);
    add(&p, "group.b.Y", 0x1p-24f, 0);
    add(&p, "group.c.Y", 0x1p-24f, 0);
    write_picture(&p, folder, "g.exr");
    LUX4(folder, 0, &r, "mix", "g.exr");
    read_picture(&a, folder, "g-mix.exr", &im);
    expect_channel(&im, "Y", 1.0f + 0x1p-23f, 0);
    arena_clear(&a);
    program_free(&r);
    folder_free(folder);
}

/* ---- what is refused ------------------------------------------------------------------------- */

TEST(wrong_words_are_refused)
{
    char *folder = folder_new();
    write_grid(folder);
    LUX4_FAILS(folder, 2, "no group `genral`: did you mean `general`? It has: general, spot.1",
               "mix", "desk.exr", "genral=1");
    LUX4_FAILS(folder, 2, "expected GROUP=FACTOR", "mix", "desk.exr", "general");
    LUX4_FAILS(folder, 2, "expected GROUP=FACTOR", "mix", "desk.exr", "=1");
    LUX4_FAILS(folder, 2, "expected a factor", "mix", "desk.exr", "general=");
    LUX4_FAILS(folder, 2, "expected a factor", "mix", "desk.exr", "general=-1");
    LUX4_FAILS(folder, 2, "expected a factor", "mix", "desk.exr", "general=nan");
    LUX4_FAILS(folder, 2, "expected a factor", "mix", "desk.exr", "general=0.5x");
    LUX4_FAILS(folder, 2, "has a factor already", "mix", "desk.exr", "general=1", "general=2");
    LUX4_FAILS(folder, 2, "which result?", "mix");
    LUX4_FAILS(folder, 2, "none.exr: ", "mix", "none.exr", "general=1");
    LUX4_FAILS(folder, 2, "expected a result of a run", "mix", "general=1", "desk.exr");
    LUX4_FAILS(folder, 2, "-o: expected FILE", "mix", "desk.exr", "-o");
    LUX4_FAILS(folder, 2, "-o: expected FILE", "mix", "desk.exr", "-o", "");
    assert_int_equal(count_names(folder), 1);
    folder_free(folder);
}

TEST(files_that_are_there_and_the_result_itself_are_spared)
{
    program_result r = { 0 };
    char *folder     = folder_new();
    write_grid(folder);
    LUX4(folder, 0, &r, "mix", "desk.exr");
    LUX4_FAILS(folder, 2, "desk-mix.exr: is there already", "mix", "desk.exr");
    LUX4(folder, 0, &r, "mix", "desk.exr", "--overwrite");
    LUX4_FAILS(folder, 2, "is what is mixed", "mix", "desk.exr", "-o", "./desk.exr", "--overwrite");
    LUX4_FAILS(folder, 2, "ends in .exr", "mix", "desk.exr", "-o", "desk.png"); /* no view */
    LUX4_FAILS(folder, 2, "ends in .exr", "mix", "desk.exr", "-o", "desk");
    LUX4_FAILS(folder, 1, "nowhere", "mix", "desk.exr", "-o", "nowhere/desk.exr");
    assert_int_equal(count_names(folder), 2);
    program_free(&r);
    folder_free(folder);
}

TEST(pictures_without_layers_or_numbers_are_refused)
{
    char *folder = folder_new();
    picture p    = { 0 };
    add(&p, "Y", 3, 0);
    write_picture(&p, folder, "g.exr");
    LUX4_FAILS(folder, 2, "g.exr: no group layers in it: run lux4 with --groups", "mix", "g.exr");

    /* One pixel is stored as it is: its bits are found, and made those of NaN */
    add(&p, "group.a.Y", 3, 0);
    p.im.width = p.im.height = 1;
    p.values[1][0]           = 0x1.23456p3f;
    write_picture(&p, folder, "g.exr");
    size_t size, at = 0;
    char *bytes = bytes_of(path_in(folder, "g.exr"), &size);
    while (at + 4 <= size && memcmp(bytes + at, &p.values[1][0], 4) != 0)
        at++;
    assert_true(at + 4 <= size);
    memset(bytes + at, 0xff, 4);
    FILE *f = fopen(path_in(folder, "g.exr"), "wb");
    assert_int_equal(fwrite(bytes, 1, size, f), size);
    fclose(f);
    free(bytes);
    LUX4_FAILS(folder, 2, "g.exr: channel group.a.Y: expected finite numbers", "mix", "g.exr");

    folder_write(folder, "g.exr", "not a picture");
    LUX4_FAILS(folder, 2, "g.exr: ", "mix", "g.exr");
    assert_int_equal(count_names(folder), 1);
    folder_free(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_table_is_mixed_by_its_columns_of_groups),
        cmocka_unit_test(tables_that_are_none_are_refused_with_their_line),
        cmocka_unit_test(a_grid_is_mixed_channel_by_channel),
        cmocka_unit_test(a_view_is_mixed_and_shown_with_its_surfaces_kept),
        cmocka_unit_test(a_channel_without_its_layers_is_left_out),
        cmocka_unit_test(sums_are_rounded_once),
        cmocka_unit_test(wrong_words_are_refused),
        cmocka_unit_test(files_that_are_there_and_the_result_itself_are_spared),
        cmocka_unit_test(pictures_without_layers_or_numbers_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
