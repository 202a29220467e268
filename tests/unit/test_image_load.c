/* tests/unit/test_image_load.c -- whole pictures in: PNGs of every kind made here byte by byte. */
#include "core/image.h"
#include "tests/test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

/* IEC 61966-2-1 */
static double linear_of(double v)
{
    return v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
}

/* ---- PNGs ------------------------------------------------------------------------------------ */

enum { GREY = 0, RGB = 2, PALETTE = 3, GREY_ALPHA = 4, RGBA = 6 };

typedef struct png {
    uint8_t bytes[4096];
    size_t size;
} png;

static void put(png *p, const void *bytes, size_t size)
{
    memcpy(p->bytes + p->size, bytes, size);
    p->size += size;
}

static void put32(png *p, uint32_t n)
{
    put(p, (uint8_t[4]){ (uint8_t)(n >> 24), (uint8_t)(n >> 16), (uint8_t)(n >> 8), (uint8_t)n },
        4);
}

/* Length, name, contents, and the CRC of the latter two (ISO/IEC 15948, annex D). */
static void put_chunk(png *p, const char *name, const void *bytes, size_t size)
{
    put32(p, (uint32_t)size);
    size_t start = p->size;
    put(p, name, 4);
    put(p, bytes, size);
    uint32_t crc = ~0u;
    for (size_t i = start; i < p->size; i++) {
        crc ^= p->bytes[i];
        for (int k = 0; k < 8; k++)
            crc = crc & 1 ? crc >> 1 ^ 0xedb88320u : crc >> 1;
    }
    put32(p, ~crc);
}

/* A zlib stream of one stored block (RFC 1950, 1951). */
static void put_pixels(png *p, const uint8_t *raw, size_t size)
{
    png z       = { .size = 0 };
    uint8_t low = (uint8_t)size, high = (uint8_t)(size >> 8);
    uint8_t head[7] = { 0x78, 0x01, 1, low, high, (uint8_t)~low, (uint8_t)~high };
    uint32_t a = 1, b = 0;
    for (size_t i = 0; i < size; i++) {
        a = (a + raw[i]) % 65521;
        b = (b + a) % 65521;
    }
    put(&z, head, sizeof head);
    put(&z, raw, size);
    put32(&z, b << 16 | a);
    put_chunk(p, "IDAT", z.bytes, z.size);
}

/* raw: of each row a 0 and its samples. The palette has four colours, the second half clear. */
static png make_png(uint32_t width, uint32_t height, int bits, int kind, const uint8_t *raw,
                    size_t size)
{
    static const uint8_t palette[12] = { 255, 0, 0, 0, 128, 0, 0, 0, 64, 255, 255, 255 };
    static const uint8_t clear[2]    = { 255, 51 };
    png p = { .size = 0 }, head = { .size = 0 };
    put32(&head, width);
    put32(&head, height);
    put(&head, (uint8_t[5]){ (uint8_t)bits, (uint8_t)kind, 0, 0, 0 }, 5);
    put(&p, "\x89PNG\r\n\x1a\n", 8);
    put_chunk(&p, "IHDR", head.bytes, head.size);
    if (kind == PALETTE) {
        put_chunk(&p, "PLTE", palette, sizeof palette);
        put_chunk(&p, "tRNS", clear, sizeof clear);
    }
    put_pixels(&p, raw, size);
    put_chunk(&p, "IEND", "", 0);
    return p;
}

/* ---- what is read ---------------------------------------------------------------------------- */

static arena memory; /* of the test that runs */

static int clear(void **state)
{
    (void)state;
    arena_clear(&memory);
    return 0;
}

static const float *load(const png *p, bool srgb, int width, int height)
{
    int w, h;
    float *rgba;
    lux_error err = { 0 };
    if (!image_load_rgba("a.glb: /images/0", p->bytes, p->size, srgb, &memory, &w, &h, &rgba, &err))
        fail_msg("%s", err.text);
    assert_int_equal(w, width);
    assert_int_equal(h, height);
    return rgba;
}

/* To the rounding of a float: decoding is exact. */
static void assert_pixel(const float *got, double r, double g, double b, double a)
{
    const double want[4] = { r, g, b, a };
    for (int c = 0; c < 4; c++)
        assert_near(got[c], want[c], 0x1p-23);
}

TEST(every_kind_of_png_is_four_floats)
{
    static const uint8_t grey[] = { 0, 51, 255 }, grey_alpha[] = { 0, 51, 102, 255, 0 },
                         rgb[]  = { 0, 51, 0, 255, 102, 255, 0 },
                         rgba[] = { 0, 51, 0, 255, 204, 102, 255, 0, 0 }, index[] = { 0, 1, 2 };
    png p           = make_png(2, 1, 8, GREY, grey, sizeof grey);
    const float *at = load(&p, false, 2, 1);
    assert_pixel(at, 0.2, 0.2, 0.2, 1);
    assert_pixel(at + 4, 1, 1, 1, 1);
    p  = make_png(2, 1, 8, GREY_ALPHA, grey_alpha, sizeof grey_alpha);
    at = load(&p, false, 2, 1);
    assert_pixel(at, 0.2, 0.2, 0.2, 0.4);
    assert_pixel(at + 4, 1, 1, 1, 0); /* colours stay where nothing is seen of them */
    p  = make_png(2, 1, 8, RGB, rgb, sizeof rgb);
    at = load(&p, false, 2, 1);
    assert_pixel(at, 0.2, 0, 1, 1);
    assert_pixel(at + 4, 0.4, 1, 0, 1);
    p  = make_png(2, 1, 8, RGBA, rgba, sizeof rgba);
    at = load(&p, false, 2, 1);
    assert_pixel(at, 0.2, 0, 1, 0.8);
    assert_pixel(at + 4, 0.4, 1, 0, 0);
    p  = make_png(2, 1, 8, PALETTE, index, sizeof index);
    at = load(&p, false, 2, 1);
    assert_pixel(at, 0, 128.0 / 255, 0, 0.2);
    assert_pixel(at + 4, 0, 0, 64.0 / 255, 1);
}

TEST(colours_are_decoded_from_srgb_and_alpha_is_not)
{
    for (int v = 0; v < 256; v += 3) {
        const uint8_t raw[] = { 0, (uint8_t)v, (uint8_t)(255 - v), 7, (uint8_t)v };
        png p               = make_png(1, 1, 8, RGBA, raw, sizeof raw);
        assert_pixel(load(&p, true, 1, 1), linear_of(v / 255.0), linear_of((255 - v) / 255.0),
                     linear_of(7 / 255.0), v / 255.0);
    }
    for (unsigned v = 0; v < 65536; v += 257 * 20 + 1) {
        const uint8_t raw[] = { 0, (uint8_t)(v >> 8), (uint8_t)v, (uint8_t)(v >> 8), (uint8_t)v };
        png p               = make_png(1, 1, 16, GREY_ALPHA, raw, sizeof raw);
        double c            = linear_of(v / 65535.0);
        assert_pixel(load(&p, true, 1, 1), c, c, c, v / 65535.0);
        assert_pixel(load(&p, false, 1, 1), v / 65535.0, v / 65535.0, v / 65535.0, v / 65535.0);
    }
}

TEST(rows_come_from_the_top)
{
    enum { W = 3, H = 200 }; /* several strips */
    uint8_t raw[H * (W + 1)];
    for (int i = 0; i < H * (W + 1); i++)
        raw[i] = i % (W + 1) ? (uint8_t)(i / (W + 1) + i % (W + 1)) : 0;
    png p           = make_png(W, H, 8, GREY, raw, sizeof raw);
    const float *at = load(&p, false, W, H);
    for (int i = 0; i < W * H; i++)
        assert_near(at[4 * i], (i / W + i % W + 1) / 255.0, 0x1p-23);
}

/* ---- files ----------------------------------------------------------------------------------- */

static const char *write_file(const char *name, const void *bytes, size_t size)
{
    static char path[100];
    snprintf(path, sizeof path, "/tmp/lux4_load_%ld_%s", (long)getpid(), name);
    FILE *f = fopen(path, "wb");
    fwrite(bytes, 1, size, f);
    fclose(f);
    return path;
}

TEST(floats_are_linear_whatever_is_said_of_integers)
{
    /* (m + 0 or 0.5) / 256 2^(e - 128) */
    static const char rgbe[] = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\x80\x40\x20\x83";
    const char *path         = write_file("c.hdr", rgbe, sizeof rgbe - 1);
    int w, h;
    float *rgba;
    assert_true(image_load_rgba(path, NULL, 0, true, &memory, &w, &h, &rgba, NULL));
    assert_near(rgba[0], 4.0, 0.005);
    assert_near(rgba[1], 2.0, 0.01);
    assert_near(rgba[3], 1.0, 0);
    unlink(path);
}

TEST(of_many_channels_the_first_four_count)
{
    float v[6][2]      = { { 1, 2 }, { 3, 4 }, { 5, 6 }, { 7, 8 }, { 9, 10 }, { 11, 12 } };
    image_channel c[6] = { { "A", v[3] }, { "B", v[2] },       { "G", v[1] },
                           { "R", v[0] }, { "depth.Z", v[4] }, { "wood.id", v[5] } };
    image im           = { 2, 1, 6, c, 0, NULL };
    char path[100];
    snprintf(path, sizeof path, "%s", write_file("d.exr", "", 0));
    assert_true(image_write_exr(path, &im, false, NULL, NULL));
    int w, h;
    float *rgba;
    lux_error err = { 0 };
    if (!image_load_rgba(path, NULL, 0, true, &memory, &w, &h, &rgba, &err))
        fail_msg("%s", err.text);
    for (int i = 0; i < 8; i++)
        assert_true(rgba[i] == v[i % 4][i / 4]);
    unlink(path);
}

static void assert_refused(const char *path, const void *bytes, size_t size, const char *why)
{
    lux_error err = { 0 };
    int w, h;
    float *rgba;
    assert_false(image_load_rgba(path, bytes, size, true, &memory, &w, &h, &rgba, &err));
    if (!strstr(err.text, why) || strncmp(err.text, path, strlen(path)) != 0)
        fail_msg("%s", err.text);
}

static void assert_file_refused(const char *name, const char *text, size_t size, const char *why)
{
    const char *path = write_file(name, text, size);
    assert_refused(path, NULL, 0, why);
    unlink(path);
}

TEST(what_is_no_picture_or_too_large_is_refused)
{
    assert_refused("none.png", NULL, 0, "no such file");
    assert_refused("a.glb", "text", 4, "a picture of no known kind");
    assert_file_refused("a.ppm", "P3 40000 1 255 ", 15, "40000 x 1 pixels, at most 32768 a side");
    assert_file_refused("b.ppm", "P6 32768 8193 255 ", 18,
                        "32768 x 8193 pixels are more than 4 GB");
    assert_file_refused("c.ppm", "P6 100 100 255 ab", 17, "cannot be read as a picture");
    assert_file_refused("d.pfm",
                        "PF\n2 1\n-1.0\n\0\0\x80\x3f\0\0\x80\x3f\0\0\x80\x3f\0\0\x80\x3f"
                        "\0\0\x80\x7f\0\0\0\0",
                        12 + 24, "in column 1 of row 0 is a value that is no finite number");
}

TEST(pngs_that_are_cut_or_damaged_are_refused)
{
    static const uint8_t raw[] = { 0, 51, 0, 255, 204, 102, 255, 0, 0 };
    png p                      = make_png(2, 1, 8, RGBA, raw, sizeof raw);
    for (size_t cut = 0; cut < p.size; cut++) {
        uint8_t *copy = malloc(cut + 1); /* of its own, for the sanitizer's sake */
        memcpy(copy, p.bytes, cut);
        assert_refused("m", copy, cut, "");
        free(copy);
    }
    for (size_t at = 0; at < p.size; at++) {
        p.bytes[at] ^= 4;
        assert_refused("m", p.bytes, p.size, "");
        p.bytes[at] ^= 4;
    }
    /* Right CRCs, but rows that are not there, a size that lies, bits that are not allowed */
    p = make_png(2, 9, 8, RGBA, raw, sizeof raw);
    assert_refused("m", p.bytes, p.size, "cannot be read as a picture");
    p = make_png(0, 1, 8, RGBA, raw, sizeof raw);
    assert_refused("m", p.bytes, p.size, "cannot be read as a picture");
    p = make_png(2, 1, 3, RGBA, raw, sizeof raw);
    assert_refused("m", p.bytes, p.size, "cannot be read as a picture");
}

/* A JPEG has no sums to check: cut or changed ones are an error or some picture. */
TEST(jpegs_that_are_changed_do_no_harm)
{
    static uint8_t grey[16 * 16 * 3], bytes[4096];
    memset(grey, 100, sizeof grey);
    char path[100];
    snprintf(path, sizeof path, "%s", write_file("e.jpg", "", 0));
    if (!image_write_rgb8(path, 16, 16, grey, NULL))
        skip();
    FILE *f     = fopen(path, "rb");
    size_t size = fread(bytes, 1, sizeof bytes, f);
    fclose(f);
    unlink(path);
    int w, h;
    float *rgba;
    assert_true(image_load_rgba("e", bytes, size, true, &memory, &w, &h, &rgba, NULL));
    assert_near(rgba[0], linear_of(100 / 255.0), 1e-6);
    for (size_t at = 0; at < size; at += 11) {
        lux_error err = { 0 };
        uint8_t was   = bytes[at];
        bytes[at]     = (uint8_t)(was ^ 0x15);
        if (!image_load_rgba("e", bytes, size, true, &memory, &w, &h, &rgba, &err))
            assert_int_not_equal(err.code, ERR_NONE);
        bytes[at] = was;
        if (!image_load_rgba("e", bytes, at, true, &memory, &w, &h, &rgba, &err))
            assert_int_not_equal(err.code, ERR_NONE);
        arena_clear(&memory);
    }
}

TEST(full_memory_is_an_error)
{
    static const uint8_t raw[] = { 0, 51 };
    png p                      = make_png(1, 1, 8, GREY, raw, sizeof raw);
    lux_error err              = { 0 };
    int w, h;
    float *rgba;
    memory_is_out = true;
    bool loaded   = image_load_rgba("m", p.bytes, p.size, true, &memory, &w, &h, &rgba, &err);
    memory_is_out = false;
    assert_false(loaded);
    assert_int_equal(err.code, ERR_MEMORY);
}

#define CLEARED(test) cmocka_unit_test_teardown(test, clear)

int main(void)
{
    const struct CMUnitTest tests[] = {
        CLEARED(every_kind_of_png_is_four_floats),
        CLEARED(colours_are_decoded_from_srgb_and_alpha_is_not),
        CLEARED(rows_come_from_the_top),
        CLEARED(floats_are_linear_whatever_is_said_of_integers),
        CLEARED(of_many_channels_the_first_four_count),
        CLEARED(what_is_no_picture_or_too_large_is_refused),
        CLEARED(pngs_that_are_cut_or_damaged_are_refused),
        CLEARED(jpegs_that_are_changed_do_no_harm),
        CLEARED(full_memory_is_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
