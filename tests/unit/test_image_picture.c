/* tests/unit/test_image_picture.c -- PNG out, mean colours in, through the library loaded late. */
#include "core/file.h"
#include "core/image.h"
#include "core/parallel.h"
#include "tests/test.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

static char folder[64]; /* of this test alone */

static const char *in_folder(const char *name)
{
    static char path[4][128];
    static int turn;
    turn = (turn + 1) % 4;
    snprintf(path[turn], sizeof path[turn], "%s/%s", folder, name);
    return path[turn];
}

static int make_folder(void **state)
{
    (void)state;
    strcpy(folder, access("/dev/shm", W_OK) ? "/tmp/lux4_picture_XXXXXX" : "/dev/shm/lux4_XXXXXX");
    return mkdtemp(folder) ? 0 : -1;
}

static int remove_folder(void **state)
{
    (void)state;
    char command[128];
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return system(command);
}

static const char *put(const char *name, const void *bytes, size_t size)
{
    const char *path = in_folder(name);
    FILE *f          = fopen(path, "wb");
    fwrite(bytes, 1, size, f);
    fclose(f);
    return path;
}

static const char *put_text(const char *name, const char *text)
{
    return put(name, text, strlen(text));
}

/* IEC 61966-2-1 */
static double linear_of(double v)
{
    return v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
}

/* The mean of all pixels: what small pictures are compared by. */
static bool picture_mean(const char *path, const void *bytes, size_t size, bool srgb, float mean[4],
                         lux_error *err)
{
    arena a       = { 0 };
    double sum[4] = { 0 };
    int width, height;
    float *rgba;
    bool good = image_load_rgba(path, bytes, size, srgb, &a, &width, &height, &rgba, err);
    for (int i = 0; good && i < 4 * width * height; i++)
        sum[i % 4] += (double)rgba[i];
    for (int c = 0; good && c < 4; c++)
        mean[c] = (float)(sum[c] / (width * height));
    arena_clear(&a);
    return good;
}

static void assert_mean(const char *path, bool srgb, double r, double g, double b, double a)
{
    float mean[4];
    lux_error err = { 0 };
    if (!picture_mean(path, NULL, 0, srgb, mean, &err))
        fail_msg("%s", err.text);
    assert_near(mean[0], r, 1e-6);
    assert_near(mean[1], g, 1e-6);
    assert_near(mean[2], b, 1e-6);
    assert_near(mean[3], a, 1e-6);
}

/* ---- writing ---------------------------------------------------------------------------- */

static const uint8_t FOUR[12] = { 255, 0, 0, 0, 128, 0, 0, 0, 64, 255, 255, 255 };

TEST(a_png_holds_its_pixels_and_says_that_they_are_srgb)
{
    arena a       = { 0 };
    lux_error err = { 0 };
    size_t size[2];
    char *bytes[2];
    for (int i = 0; i < 2; i++) {
        if (!image_write_rgb8(in_folder("a.png"), 2, 2, FOUR, &err))
            fail_msg("%s", err.text);
        bytes[i] = file_read(&a, in_folder("a.png"), 1 << 20, &size[i], NULL);
    }
    assert_memory_equal(bytes[0], "\x89PNG\r\n\x1a\n", 8);
    bool srgb = false;
    for (size_t i = 0; i + 4 <= size[0]; i++) {
        srgb |= memcmp(bytes[0] + i, "sRGB", 4) == 0;
        assert_memory_not_equal(bytes[0] + i, "tIME", 4);
        assert_memory_not_equal(bytes[0] + i, "Date", 4);
    }
    assert_true(srgb);
    assert_int_equal(size[0], size[1]);
    assert_memory_equal(bytes[0], bytes[1], size[0]);
    assert_mean(in_folder("a.png"), false, 2.0 / 4, 383.0 / 255 / 4, 319.0 / 255 / 4, 1.0);
    assert_mean(in_folder("a.png"), true, 0.5, (linear_of(128.0 / 255) + 1) / 4,
                (linear_of(64.0 / 255) + 1) / 4, 1.0);
    arena_clear(&a);
}

static void assert_not_written(const char *path, int width, const char *why)
{
    lux_error err = { 0 };
    assert_false(image_write_rgb8(path, width, 2, FOUR, &err));
    if (err.code == ERR_NONE || !strstr(err.text, why))
        fail_msg("%s", err.text);
}

TEST(what_cannot_be_written_is_refused)
{
    assert_not_written(in_folder("a.png"), 0, "a.png: 0 x 2 pixels");
    assert_not_written(in_folder("a.odd"), 2, "a.odd: cannot be written: ");
    assert_not_written(in_folder("none/a.png"), 2, "cannot write: no such folder");
    assert_int_not_equal(access(in_folder("a.odd"), F_OK), 0);
}

/* A limit on the size of files stands for the disk that is full. */
TEST(a_full_disk_is_an_error_and_leaves_nothing)
{
    enum { SIDE = 100 };
    static uint8_t noise[3 * SIDE * SIDE];
    for (unsigned i = 0; i < sizeof noise; i++)
        noise[i] = (uint8_t)(i * i * 2654435761u >> 13);
    struct rlimit before, limit;
    lux_error err = { 0 };
    getrlimit(RLIMIT_FSIZE, &before);
    limit          = before;
    limit.rlim_cur = 5000;
    signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &limit);
    bool written = image_write_rgb8(in_folder("a.png"), SIDE, SIDE, noise, &err);
    setrlimit(RLIMIT_FSIZE, &before);
    assert_false(written);
    assert_int_equal(err.code, ERR_IO);
    assert_non_null(strstr(err.text, "a.png: cannot write: "));
    assert_int_equal(rmdir(folder), 0); /* it is empty */
    assert_int_equal(mkdir(folder, 0700), 0);
}

/* ---- reading ---------------------------------------------------------------------------- */

TEST(means_are_of_linear_values)
{
    const char *grey = put_text("a.pgm", "P2 2 1 255 0 255\n");
    assert_mean(grey, true, 0.5, 0.5, 0.5, 1.0);
    /* One pixel of 65535, 32768 and 100 in 16 bits. */
    static const uint8_t deep_png[75] = {
        137, 80,  78,  71,  13, 10,  26, 10, 0,   0,   0,   13,  73,  72,  68,  82, 0,   0,  0,
        1,   0,   0,   0,   1,  16,  2,  0,  0,   0,   192, 231, 143, 157, 0,   0,  0,   18, 73,
        68,  65,  84,  120, 1,  1,   7,  0,  248, 255, 0,   255, 255, 128, 0,   0,  100, 13, 96,
        2,   227, 241, 210, 1,  159, 0,  0,  0,   0,   73,  69,  78,  68,  174, 66, 96,  130
    };
    const char *deep = put("b.png", deep_png, sizeof deep_png);
    assert_mean(deep, false, 1.0, 32768.0 / 65535, 100.0 / 65535, 1.0);
    assert_mean(deep, true, 1.0, linear_of(32768.0 / 65535), linear_of(100.0 / 65535), 1.0);
    /* Radiance HDR is linear, whatever is said of integers: (m + 0.5 or m) / 256 2^(e - 128). */
    static const char rgbe[] = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\x80\x40\x20\x83";
    const char *hdr          = put("c.hdr", rgbe, sizeof rgbe - 1);
    float mean[4], plain[4];
    assert_true(picture_mean(hdr, NULL, 0, true, mean, NULL));
    assert_true(picture_mean(hdr, NULL, 0, false, plain, NULL));
    assert_memory_equal(mean, plain, sizeof mean);
    assert_near(mean[0], 4.0, 0.005);
}

TEST(alpha_is_a_mean_and_colours_are_not_multiplied_by_it)
{
    /* Targa: uncompressed, 2 x 1 pixels of 32 bits, 8 of them alpha; stored blue first. */
    static const uint8_t tga[18 + 8] = { 0, 0, 2, 0,  0, 0, 0,  0,   0,   0, 0,  0,   2,
                                         0, 1, 0, 32, 8, 0, 51, 255, 102, 0, 51, 255, 204 };
    assert_mean(put("a.tga", tga, sizeof tga), false, 1.0, 0.2, 0.0, 0.6);
}

TEST(an_exr_of_ours_is_read_by_openimageio)
{
    float r[3] = { 1.0f, 2.0f, 6.0f }, g[3] = { 0.5f, 0.0f, 0.0f }, b[3] = { 0.0f, 1e6f, -1e-3f };
    image_channel c[3] = { { "G", g }, { "B", b }, { "R", r } };
    image im           = { 3, 1, 3, c, 0, NULL };
    assert_true(image_write_exr(in_folder("a.exr"), &im, false, NULL, NULL));
    assert_mean(in_folder("a.exr"), true, 3.0, 0.5 / 3, (1e6 - 1e-3) / 3, 1.0);
}

TEST(pictures_in_memory_are_told_by_their_first_bytes)
{
    arena a       = { 0 };
    lux_error err = { 0 };
    size_t size;
    float mean[4];
    assert_true(image_write_rgb8(in_folder("a.png"), 2, 2, FOUR, NULL));
    char *bytes = file_read(&a, in_folder("a.png"), 1 << 20, &size, NULL);
    if (!picture_mean("scene.glb#/images/0", bytes, size, false, mean, &err))
        fail_msg("%s", err.text);
    assert_near(mean[0], 0.5, 1e-6);
    for (size_t cut = 0; cut < size; cut++) {
        char *copy = malloc(cut + 1); /* of its own, for the sanitizer's sake */
        memcpy(copy, bytes, cut);
        assert_false(picture_mean("scene.glb#/images/0", copy, cut, false, mean, &err));
        assert_non_null(strstr(err.text, "scene.glb#/images/0: "));
        free(copy);
    }
    for (size_t at = 8; at < size; at++) { /* each byte is under some CRC */
        bytes[at] ^= 4;
        assert_false(picture_mean("memory", bytes, size, false, mean, &err));
        assert_string_equal(err.text, "memory: PNG that is cut off or damaged");
        bytes[at] ^= 4;
    }
    assert_false(picture_mean("memory", bytes, 20, false, mean, &err));
    assert_false(picture_mean("memory", "text", 4, false, mean, &err));
    assert_string_equal(err.text, "memory: cannot be read as a picture: a picture of no known kind "
                                  "(PNG and JPEG are known)");
    arena_clear(&a);
}

static void assert_not_read(const char *path, const char *why)
{
    float mean[4];
    lux_error err = { 0 };
    assert_false(picture_mean(path, NULL, 0, true, mean, &err));
    if (err.code == ERR_NONE || !strstr(err.text, why))
        fail_msg("%s", err.text);
}

TEST(what_cannot_be_read_is_refused)
{
    assert_int_equal(mkfifo(in_folder("pipe.png"), 0600), 0);
    assert_not_read(in_folder("pipe.png"), "is not a regular file");
    assert_not_read(in_folder("none.png"), "no such file");
    assert_not_read(folder, "is a folder");
    assert_not_read(put_text("a.png", "no picture"), "cannot be read as a picture: ");
    assert_not_read(put_text("b.png", ""), "cannot be read as a picture: ");
    assert_not_read(put_text("c.ppm", "P3 40000 1 255 "), "at most 32768 a side");
    assert_not_read(put_text("d.ppm", "P6 20000 20000 65535 "), "more than 4 GB");
    assert_not_read(put("e.pfm", "Pf\n1 1\n-1.0\n\0\0\xc0\x7f", 16), "no finite number");
}

/* ---- loading ---------------------------------------------------------------------------- */

typedef struct crowd {
    const char *path;
    int *right;
} crowd;

static void mean_of_png(void *context, int item, int thread)
{
    (void)thread;
    float mean[4];
    crowd *c       = context;
    c->right[item] = picture_mean(c->path, NULL, 0, false, mean, NULL) && mean[0] == 0.5f;
}

TEST(many_threads_may_read_at_once)
{
    int right[8];
    assert_true(image_write_rgb8(in_folder("a.png"), 2, 2, FOUR, NULL));
    parallel_for(8, 4, mean_of_png, &(crowd){ in_folder("a.png"), right }, NULL);
    for (int i = 0; i < 8; i++)
        assert_true(right[i]);
}

/* What the copy does that lies where no library is: 0 if the error is as it should be. */
static int stay_without_library(void)
{
    lux_error err  = { 0 };
    uint8_t rgb[3] = { 0 };
    bool written   = image_write_rgb8("/nowhere/a.png", 1, 1, rgb, &err);
    return written || err.code != ERR_UNSUPPORTED || !strstr(err.text, "/nowhere/a.png: ") ||
           !strstr(err.text, "liblux4_oiio.so") || !strstr(err.text, "libopenimageio");
}

TEST(a_library_that_is_missing_is_named)
{
    char command[600];
    snprintf(command, sizeof command,
             "mkdir -p %s/a/b/c && cp /proc/%ld/exe %s/a/b/c/t && %s/a/b/c/t alone", folder,
             (long)getpid(), folder, folder);
    assert_int_equal(system(command), 0);
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, make_folder, remove_folder)

int main(int count, char **arguments)
{
    if (count == 2 && strcmp(arguments[1], "alone") == 0)
        return stay_without_library();
    const struct CMUnitTest tests[] = {
        IN_FOLDER(a_png_holds_its_pixels_and_says_that_they_are_srgb),
        IN_FOLDER(what_cannot_be_written_is_refused),
        IN_FOLDER(a_full_disk_is_an_error_and_leaves_nothing),
        IN_FOLDER(means_are_of_linear_values),
        IN_FOLDER(alpha_is_a_mean_and_colours_are_not_multiplied_by_it),
        IN_FOLDER(an_exr_of_ours_is_read_by_openimageio),
        IN_FOLDER(pictures_in_memory_are_told_by_their_first_bytes),
        IN_FOLDER(what_cannot_be_read_is_refused),
        IN_FOLDER(many_threads_may_read_at_once),
        IN_FOLDER(a_library_that_is_missing_is_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
