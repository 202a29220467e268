/* tests/unit/test_image_exr.c -- EXR files hold what was put in, to the bit, or do not appear. */
#include "core/file.h"
#include "core/image.h"
#include "tests/test.h"

#include <dirent.h>
#include <float.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

static char path[64]; /* of this process alone */

static void forget_file(void)
{
    if (path[0])
        remove(path);
}

static const char *file_path(void)
{
    if (!path[0]) {
        /* Every file is synced, for which a disk takes its time. */
        const char *folder = access("/dev/shm", W_OK) ? "/tmp" : "/dev/shm";
        snprintf(path, sizeof path, "%s/lux4_exr_%ld.exr", folder, (long)getpid());
        atexit(forget_file);
    }
    return path;
}

static uint32_t next_random(uint32_t *state) /* Marsaglia 2003, xorshift */
{
    *state ^= *state << 13;
    *state ^= *state >> 17;
    return *state ^= *state << 5;
}

static float float_of(uint32_t bits)
{
    float f;
    memcpy(&f, &bits, sizeof f);
    return f;
}

/* An image of random channels; only the lowest `bits` of each value vary. */
static image random_image(arena *a, int width, int height, int channels, int bits)
{
    static char names[64][32];
    uint32_t state = 1 + (uint32_t)(width * 131 + height * 17 + bits);
    image im       = { .width = width, .height = height, .channel_count = channels };
    im.channels    = arena_array(a, image_channel, (size_t)channels, NULL);
    for (int c = 0; c < channels; c++) {
        snprintf(names[c], sizeof names[c], "channel %02d", (c * 7 + 3) % channels);
        im.channels[c].name   = names[c];
        im.channels[c].values = arena_array(a, float, (size_t)(width * height), NULL);
        for (int i = 0; i < width * height; i++) {
            uint32_t v               = next_random(&state) >> 8 & ((1u << bits) - 1);
            im.channels[c].values[i] = float_of(0x3f800000u | v >> 1 | (v & 1) << 31);
        }
    }
    return im;
}

static const float *values_of(const image *im, const char *name)
{
    for (int c = 0; c < im->channel_count; c++)
        if (strcmp(im->channels[c].name, name) == 0)
            return im->channels[c].values;
    return NULL;
}

static void assert_same(const image *got, const image *want)
{
    assert_int_equal(got->width, want->width);
    assert_int_equal(got->height, want->height);
    assert_int_equal(got->channel_count, want->channel_count);
    for (int c = 0; c < want->channel_count; c++) {
        const float *values = values_of(got, want->channels[c].name);
        assert_non_null(values);
        assert_memory_equal(values, want->channels[c].values,
                            sizeof(float) * (size_t)(want->width * want->height));
    }
}

static void assert_round_trip(const image *im)
{
    arena a       = { 0 };
    lux_error err = { 0 };
    image got;
    if (!image_write_exr(file_path(), im, false, NULL, &err) ||
        !image_read_exr(file_path(), &a, &got, &err))
        fail_msg("%s", err.text);
    assert_same(&got, im);
    arena_clear(&a);
}

/* ---- what is written is read ------------------------------------------------------------ */

TEST(every_class_of_floats_survives)
{
    float values[12]    = { 0.0f,    -0.0f,    1.0f,         -1.0f,  FLT_MAX, -FLT_MAX,
                            FLT_MIN, -FLT_MIN, FLT_TRUE_MIN, 1e-40f, 0.1f,    65504.0f };
    image_channel c     = { "Y", values };
    const int widths[5] = { 1, 2, 3, 4, 12 };
    for (int i = 0; i < 5; i++)
        assert_round_trip(&(image){ widths[i], 12 / widths[i], 1, &c, 0, NULL });
}

TEST(all_exponents_survive)
{
    float values[512];
    for (uint32_t i = 0; i < 512; i++)
        values[i] = float_of(i / 256 << 31 | (i % 255) << 23 | 0x2aaaaau);
    assert_round_trip(&(image){ 32, 16, 1, &(image_channel){ "Y", values }, 0, NULL });
}

TEST(noise_of_every_size_survives)
{
    /* Among these are chunks that deflate cannot make smaller. */
    for (int bits = 1; bits <= 24; bits += bits < 20 ? 4 : 1) {
        for (int width = 1; width < 60; width += 3) {
            arena a  = { 0 };
            image im = random_image(&a, width, 1 + width * 7 % 37, 1 + width % 3, bits);
            assert_round_trip(&im);
            arena_clear(&a);
        }
    }
}

/* The size of the one chunk of the file just written, as stored: the table of chunks ends where
 * that chunk begins, with its line and its size. */
static int32_t stored_size(void)
{
    arena a        = { 0 };
    int32_t stored = -1;
    size_t size;
    const char *bytes = file_read(&a, file_path(), 1 << 20, &size, NULL);
    for (size_t at = 0; stored < 0 && at + 16 <= size; at++) {
        uint64_t offset;
        memcpy(&offset, bytes + at, sizeof offset);
        if (offset == at + 8)
            memcpy(&stored, bytes + at + 12, sizeof stored);
    }
    arena_clear(&a);
    return stored;
}

/* openexr#2306: more and less noise makes chunks of all sizes around their own. */
TEST(a_chunk_that_compresses_to_its_own_size_survives)
{
    int smaller = 0, own_size = 0;
    for (int noisy = 0; noisy <= 256; noisy++) {
        float values[256];
        uint32_t seed = 7;
        for (int i = 0; i < 256; i++) {
            uint32_t r = next_random(&seed);
            values[i]  = i < noisy ? float_of(r & 0xbfffffffu) : 0.0f;
        }
        assert_round_trip(&(image){ 256, 1, 1, &(image_channel){ "Y", values }, 0, NULL });
        int32_t stored = stored_size();
        assert_true(stored > 0 && stored <= (int32_t)sizeof values);
        smaller += stored < (int32_t)sizeof values;
        own_size += stored == (int32_t)sizeof values;
    }
    assert_true(smaller > 0 && own_size > 0);
}

TEST(many_channels_are_matched_by_name)
{
    arena a  = { 0 };
    image im = random_image(&a, 19, 23, 40, 24);
    assert_round_trip(&im);
    arena_clear(&a);
}

TEST(long_names_and_attributes_survive)
{
    char longest[256];
    memset(longest, 'n', 255);
    longest[255]                 = '\0';
    float values[2]              = { 1.0f, 2.0f };
    image_channel channels[]     = { { longest, values },
                                     { "group.a lamp with a name of more.R", values } };
    image_attribute attributes[] = {
        { "whiteLuminance", ATTRIBUTE_FLOAT, NULL, 179.0f },
        { "lux4:seed", ATTRIBUTE_STRING, "1", 0.0f },
        { "lux4:an attribute of more than 31 characters", ATTRIBUTE_STRING, "", 0.0f },
    };
    arena a  = { 0 };
    image im = { 2, 1, 2, channels, 3, attributes }, got;
    assert_round_trip(&im);
    assert_true(image_read_exr(file_path(), &a, &got, NULL));
    int found = 0;
    for (int i = 0; i < got.attribute_count; i++) {
        for (int j = 0; j < 3; j++) {
            if (strcmp(got.attributes[i].name, attributes[j].name) != 0)
                continue;
            found++;
            assert_int_equal(got.attributes[i].type, attributes[j].type);
            if (attributes[j].type == ATTRIBUTE_STRING)
                assert_string_equal(got.attributes[i].text, attributes[j].text);
            else
                assert_true(got.attributes[i].number == attributes[j].number);
        }
    }
    assert_int_equal(found, 3);
    arena_clear(&a);
}

TEST(bytes_depend_on_the_contents_alone)
{
    arena a = { 0 };
    size_t size[2];
    char *bytes[2];
    image im = random_image(&a, 50, 40, 3, 12);
    for (int i = 0; i < 2; i++) {
        assert_true(image_write_exr(file_path(), &im, false, NULL, NULL));
        bytes[i] = file_read(&a, file_path(), 1 << 20, &size[i], NULL);
    }
    assert_int_equal(size[0], size[1]);
    assert_memory_equal(bytes[0], bytes[1], size[0]);
    arena_clear(&a);
}

TEST(halves_are_rounded_and_clamped_with_a_notice)
{
    float values[18 * 2] = { 1.0f / 3.0f, 65504.0f, 65505.0f, 1e30f, -1e30f, -0.0f, 5.9604645e-8f };
    values[35]           = 70000.0f; /* in the second chunk */
    image_channel c      = { "Y", values };
    image im             = { 2, 18, 1, &c, 0, NULL }, got;
    arena a              = { 0 };
    notices n            = { .a = &a };
    assert_true(image_write_exr(file_path(), &im, true, &n, NULL));
    assert_true(image_read_exr(file_path(), &a, &got, NULL));
    /* IEEE 754: binary16 has 11 significant bits; its least value is 2^-24. */
    const float want[] = {
        0.333251953125f, 65504.0f, 65504.0f, 65504.0f, -65504.0f, -0.0f, 0x1p-24f
    };
    assert_memory_equal(got.channels[0].values, want, sizeof want);
    assert_true(got.channels[0].values[35] == 65504.0f);
    assert_true(values[3] == 1e30f); /* ours are untouched */
    assert_int_equal(n.count, 1);
    assert_non_null(strstr(n.first->text, "channel Y: 4 of 36 values"));
    arena_clear(&a);
}

/* ---- what cannot be written ------------------------------------------------------------- */

static void assert_refused(const image *im, const char *why)
{
    lux_error err = { 0 };
    remove(file_path());
    assert_false(image_write_exr(file_path(), im, false, NULL, &err));
    assert_int_equal(err.code, ERR_ARGUMENT);
    if (!strstr(err.text, why))
        fail_msg("%s", err.text);
    assert_int_not_equal(access(file_path(), F_OK), 0);
}

TEST(what_is_no_picture_is_refused_before_a_file_appears)
{
    float values[6]       = { 0 };
    char name[257]        = "";
    image_channel c[2]    = { { "Y", values }, { "Y", values } };
    image_attribute odd   = { "compression", ATTRIBUTE_STRING, "text", 0.0f };
    image_attribute empty = { "", ATTRIBUTE_FLOAT, NULL, 1.0f };
    values[4]             = NAN;
    assert_refused(&(image){ 3, 2, 1, c, 0, NULL }, "channel Y is no number at column 1 of row 1");
    values[4] = -INFINITY;
    assert_refused(&(image){ 3, 2, 1, c, 0, NULL }, "channel Y is infinite at column 1 of row 1");
    values[4] = 0.0f;
    assert_refused(&(image){ 3, 2, 2, c, 0, NULL }, "two channels Y");
    assert_refused(&(image){ 3, 2, 0, c, 0, NULL }, "without channels");
    assert_refused(&(image){ 0, 2, 1, c, 0, NULL }, "0 x 2 pixels");
    assert_refused(&(image){ 3, -2, 1, c, 0, NULL }, "3 x -2 pixels");
    assert_refused(&(image){ 3, 2, 1, c, 1, &odd }, "cannot be written as EXR");
    assert_refused(&(image){ 3, 2, 1, c, 1, &empty }, "name of 0 bytes");
    memset(name, 'n', 256);
    c[0].name = name;
    assert_refused(&(image){ 3, 2, 1, c, 0, NULL }, "name of 256 bytes");
}

/* A limit on the size of files stands for the disk that is full. */
TEST(a_full_disk_is_an_error_and_leaves_nothing)
{
    arena a  = { 0 };
    image im = random_image(&a, 100, 100, 3, 24);
    struct rlimit before, limit;
    getrlimit(RLIMIT_FSIZE, &before);
    limit = before;
    signal(SIGXFSZ, SIG_IGN);
    remove(file_path());
    for (rlim_t most = 0; most < 100000; most = most * 3 + 100) { /* in the header, and behind */
        lux_error err  = { 0 };
        limit.rlim_cur = most;
        setrlimit(RLIMIT_FSIZE, &limit);
        bool written = image_write_exr(file_path(), &im, false, NULL, &err);
        setrlimit(RLIMIT_FSIZE, &before);
        assert_false(written);
        assert_int_equal(err.code, ERR_IO);
        assert_non_null(strstr(err.text, "cannot write: File too large"));
        assert_int_not_equal(access(file_path(), F_OK), 0);
    }
    arena_clear(&a);
}

TEST(no_memory_is_an_error)
{
    arena a       = { 0 };
    lux_error err = { 0 };
    image im      = random_image(&a, 600, 600, 3, 24), got;
    assert_true(image_write_exr(file_path(), &im, true, NULL, NULL));
    memory_is_out = true;
    bool written  = image_write_exr(file_path(), &im, true, NULL, &err);
    bool read     = image_read_exr(file_path(), &a, &got, &err);
    memory_is_out = false;
    assert_false(written || read);
    assert_int_equal(err.code, ERR_MEMORY);
    arena_clear(&a);
}

/* ---- what cannot be read ---------------------------------------------------------------- */

static bool reads(const char *bytes, size_t size, lux_error *err)
{
    arena a = { 0 };
    image im;
    FILE *f = fopen(file_path(), "wb");
    fwrite(bytes, 1, size, f);
    fclose(f);
    bool ok = image_read_exr(file_path(), &a, &im, err);
    arena_clear(&a);
    return ok;
}

TEST(a_file_cut_anywhere_is_an_error)
{
    arena a = { 0 };
    size_t size;
    image im = random_image(&a, 20, 40, 2, 16);
    assert_true(image_write_exr(file_path(), &im, false, NULL, NULL));
    char *bytes = file_read(&a, file_path(), 1 << 20, &size, NULL);
    for (size_t cut = 0; cut < size; cut += cut < 600 ? 1 : 37) {
        lux_error err = { 0 };
        assert_false(reads(bytes, cut, &err));
        assert_int_equal(err.code, ERR_FORMAT);
    }
    assert_false(reads(bytes, size - 1, NULL));
    assert_true(reads(bytes, size, NULL));
    arena_clear(&a);
}

TEST(a_file_with_a_wrong_byte_is_read_or_refused)
{
    arena a = { 0 };
    size_t size;
    image im = random_image(&a, 20, 40, 2, 16);
    assert_true(image_write_exr(file_path(), &im, false, NULL, NULL));
    char *bytes   = file_read(&a, file_path(), 1 << 20, &size, NULL);
    uint32_t seed = 3;
    for (int i = 0; i < 1500; i++) {
        size_t at     = next_random(&seed) % (i % 2 ? size : 500);
        char before   = bytes[at];
        bytes[at]     = (char)(next_random(&seed) >> 11);
        lux_error err = { 0 };
        if (!reads(bytes, size, &err))
            assert_true(err.code != ERR_NONE && err.text[0]);
        bytes[at] = before;
    }
    arena_clear(&a);
}

/* Files of others, if there are any: of those that are read, each value is a float. */
TEST(files_of_others_are_read_or_refused)
{
    static const char *const folders[] = { "../shared/data/hdr",
                                           "../shared/data/hdr/reader_tests" };
    int read_count = 0, refused_count = 0;
    for (int i = 0; i < 2; i++) {
        DIR *d = opendir(folders[i]);
        for (struct dirent *e; d && (e = readdir(d));) {
            if (!strstr(e->d_name, ".exr"))
                continue;
            arena a       = { 0 };
            lux_error err = { 0 };
            image im;
            char name[512];
            snprintf(name, sizeof name, "%s/%s", folders[i], e->d_name);
            bool ok = image_read_exr(name, &a, &im, &err);
            read_count += ok;
            refused_count += !ok;
            assert_true(ok || (err.code != ERR_NONE && strstr(err.text, e->d_name)));
            arena_clear(&a);
        }
        if (d)
            closedir(d);
    }
    if (read_count + refused_count == 0)
        skip();
    assert_true(read_count > 0 && refused_count > 0);
}

TEST(what_is_no_exr_is_refused)
{
    lux_error err = { 0 };
    arena a       = { 0 };
    image im;
    assert_false(reads("no picture", 10, &err));
    assert_int_equal(err.code, ERR_FORMAT);
    assert_false(reads("", 0, &err));
    assert_false(image_read_exr("/tmp", &a, &im, &err));
    assert_int_equal(err.code, ERR_IO);
    assert_string_equal(err.text, "/tmp: is a folder, a file was expected");
    arena_clear(&a);
}

/* ---- several parts ---------------------------------------------------------------------- */

enum { PARTS = 3 };

/* Of different sizes, with more lines than a chunk has. */
static void write_parts(arena *a, image parts[PARTS])
{
    static const char *const names[PARTS] = { "2026-06-21T10:00+03:00", "2026-06-21T11:00+03:00",
                                              "a name that has more than 31 characters" };
    lux_error err                         = { 0 };
    for (int p = 0; p < PARTS; p++) {
        parts[p]      = random_image(a, 5 + p, 40 - 19 * p, 2, 20);
        parts[p].part = names[p];
    }
    if (!image_write_exr_parts(file_path(), parts, PARTS, &err))
        fail_msg("%s", err.text);
}

TEST(parts_survive_each_by_its_name)
{
    arena a       = { 0 };
    lux_error err = { 0 };
    image parts[PARTS], got;
    write_parts(&a, parts);
    for (int p = 0; p < PARTS; p++) {
        if (!image_read_exr_part(file_path(), p, &a, &got, &err))
            fail_msg("%s", err.text);
        assert_same(&got, &parts[p]);
        const image_attribute *name = got.attributes;
        while (strcmp(name->name, "name") != 0)
            assert_true(++name < got.attributes + got.attribute_count);
        assert_string_equal(name->text, parts[p].part);
    }
    assert_false(image_read_exr_part(file_path(), PARTS, &a, &got, &err));
    assert_int_equal(err.code, ERR_ARGUMENT);
    assert_false(image_read_exr_part(file_path(), -1, &a, &got, &err));
    assert_false(image_read_exr(file_path(), &a, &got, &err));
    assert_non_null(strstr(err.text, "EXR of 3 parts, one was expected"));
    arena_clear(&a);
}

TEST(parts_without_names_of_their_own_are_refused)
{
    arena a       = { 0 };
    lux_error err = { 0 };
    image parts[PARTS];
    write_parts(&a, parts);
    remove(file_path());
    parts[2].part = parts[0].part;
    assert_false(image_write_exr_parts(file_path(), parts, PARTS, &err));
    assert_non_null(strstr(err.text, "two parts 2026-06-21T10:00+03:00"));
    parts[2].part = "";
    assert_false(image_write_exr_parts(file_path(), parts, PARTS, &err));
    assert_non_null(strstr(err.text, "name of 0 bytes"));
    assert_int_not_equal(access(file_path(), F_OK), 0);
    arena_clear(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_class_of_floats_survives),
        cmocka_unit_test(all_exponents_survive),
        cmocka_unit_test(noise_of_every_size_survives),
        cmocka_unit_test(a_chunk_that_compresses_to_its_own_size_survives),
        cmocka_unit_test(many_channels_are_matched_by_name),
        cmocka_unit_test(long_names_and_attributes_survive),
        cmocka_unit_test(bytes_depend_on_the_contents_alone),
        cmocka_unit_test(halves_are_rounded_and_clamped_with_a_notice),
        cmocka_unit_test(what_is_no_picture_is_refused_before_a_file_appears),
        cmocka_unit_test(a_full_disk_is_an_error_and_leaves_nothing),
        cmocka_unit_test(no_memory_is_an_error),
        cmocka_unit_test(a_file_cut_anywhere_is_an_error),
        cmocka_unit_test(a_file_with_a_wrong_byte_is_read_or_refused),
        cmocka_unit_test(files_of_others_are_read_or_refused),
        cmocka_unit_test(what_is_no_exr_is_refused),
        cmocka_unit_test(parts_survive_each_by_its_name),
        cmocka_unit_test(parts_without_names_of_their_own_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
