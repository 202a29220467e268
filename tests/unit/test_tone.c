/* tests/unit/test_tone.c -- previews are exposed as the operator's authors say, and are sRGB. */
#include "sim/tone.h"
#include "tests/test.h"

#include <float.h>
#include <string.h>

enum { MOST = 300 * 200 };

static float red[MOST], green[MOST], blue[MOST];
static uint8_t rgb[3 * MOST];

static void fill(float value)
{
    for (int i = 0; i < MOST; i++)
        red[i] = green[i] = blue[i] = value;
}

static void set(int i, float value) { red[i] = green[i] = blue[i] = value; }

static void tone(int width, int height, const tone_options *o)
{
    arena a       = { 0 };
    lux_error err = { 0 };
    if (!tone_photographic(red, green, blue, width, height, o, rgb, &a, &err))
        fail_msg("%s", err.text);
    arena_clear(&a);
}

/* IEC 61966-2-1: the curve that displays apply to a code. */
static double linear_of(double code)
{
    double v = code / 255.0;
    return v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
}

TEST(codes_are_those_of_the_standard)
{
    srgb_table t = srgb_table_make();
    for (int k = 0; k < 256; k++) {
        assert_int_equal(srgb_code(&t, linear_of(k)), k);
        assert_int_equal(srgb_code(&t, linear_of(k + 0.499)), k);
        assert_int_equal(srgb_code(&t, linear_of(k - 0.499 * (k > 0))), k);
    }
    assert_int_equal(srgb_code(&t, 0.0031308), 10); /* where the curve's two parts meet: 10.3 */
    assert_int_equal(srgb_code(&t, 0.5), 188);      /* 0.73536 */
    assert_int_equal(srgb_code(&t, 0.18), 118);     /* 0.46136 */
    assert_int_equal(srgb_code(&t, -1.0), 0);
    assert_int_equal(srgb_code(&t, (double)FLT_MAX), 255);
}

TEST(a_grey_card_of_any_brightness_becomes_the_key)
{
    /* Equation 4 with Lwhite = 1 leaves 0.18 where it is: sRGB 118. */
    for (float brightness = 1e-20f; brightness < 1e20f; brightness *= 1000.0f) {
        fill(brightness);
        tone(300, 200, NULL);
        for (int i = 0; i < 3 * MOST; i += 997)
            assert_int_equal(rgb[i], 118);
    }
}

TEST(exposure_is_counted_in_stops)
{
    fill(3.0f);
    tone(10, 10, &(tone_options){ .exposure_ev = 1.0 });
    assert_int_equal(rgb[0], 162); /* 0.36: 1.055 0.36^(1/2.4) - 0.055 = 0.63426, times 255 161.7 */
    tone(10, 10, &(tone_options){ .exposure_ev = -1.0 });
    assert_int_equal(rgb[0], 85); /* 0.09: 0.33181, times 255 84.6 */
    tone(10, 10, &(tone_options){ .key = 0.36 });
    assert_int_equal(rgb[0], 162);
}

TEST(brighter_is_never_darker)
{
    float value = 1e-4f;
    for (int i = 0; i < MOST; i++, value *= 1.0004f)
        set(i, value);
    tone(300, 200, NULL);
    for (int i = 1; i < MOST; i++)
        assert_true(rgb[3 * i] >= rgb[3 * i - 3]);
    assert_int_equal(rgb[3 * MOST - 1], 255); /* the brightest 0.5 % are white */
    assert_true(rgb[0] < 5);
}

TEST(black_stays_black)
{
    fill(0.0f);
    memset(rgb, 7, sizeof rgb);
    tone(300, 200, NULL);
    for (int i = 0; i < 3 * MOST; i++)
        assert_int_equal(rgb[i], 0);
    fill(-1.0f);
    tone(300, 200, NULL);
    assert_int_equal(rgb[0], 0);
}

TEST(one_lit_pixel_is_seen_and_alone)
{
    fill(0.0f);
    set(12345, 1e-30f);
    tone(300, 200, NULL);
    for (int i = 0; i < MOST; i++)
        assert_true(i == 12345 ? rgb[3 * i] >= 118 : rgb[3 * i] == 0);
    tone(1, 1, NULL); /* a picture of one black pixel */
    assert_int_equal(rgb[0], 0);
}

TEST(a_bright_pixel_does_not_darken_the_rest)
{
    fill(1.0f);
    set(777, 1e4f);
    tone(300, 200, NULL);
    assert_in_range(rgb[0], 116, 118);
    assert_int_equal(rgb[3 * 777], 255);
}

TEST(colours_keep_their_hue)
{
    fill(1.0f);
    for (int i = 0; i < MOST; i++)
        green[i] = blue[i] = 0.5f;
    tone(30, 20, NULL);
    srgb_table t = srgb_table_make();
    double k     = 0.18 / (0.2126 + 0.7152 * 0.5 + 0.0722 * 0.5); /* luminance becomes 0.18 */
    assert_int_equal(rgb[0], srgb_code(&t, k));
    assert_int_equal(rgb[1], srgb_code(&t, 0.5 * k));
    assert_int_equal(rgb[2], rgb[1]);
}

TEST(what_is_no_picture_is_refused)
{
    arena a       = { 0 };
    lux_error err = { 0 };
    fill(1.0f);
    green[31] = NAN;
    assert_false(tone_photographic(red, green, blue, 30, 20, NULL, rgb, &a, &err));
    assert_string_equal(err.text, "pixel at column 1 of row 1 is no finite colour");
    green[31] = INFINITY;
    assert_false(tone_photographic(red, green, blue, 30, 20, NULL, rgb, &a, NULL));
    red[31] = green[31] = blue[31] = FLT_MAX;
    assert_true(tone_photographic(red, green, blue, 30, 20, NULL, rgb, &a, NULL));
    assert_int_equal(rgb[3 * 31 + 1], 255);
    assert_false(tone_photographic(red, green, blue, 0, 20, NULL, rgb, &a, &err));
    arena_clear(&a);
    memory_is_out = true;
    bool made     = tone_photographic(red, green, blue, 30, 20, NULL, rgb, &a, &err);
    memory_is_out = false;
    assert_false(made);
    assert_int_equal(err.code, ERR_MEMORY);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(codes_are_those_of_the_standard),
        cmocka_unit_test(a_grey_card_of_any_brightness_becomes_the_key),
        cmocka_unit_test(exposure_is_counted_in_stops),
        cmocka_unit_test(brighter_is_never_darker),
        cmocka_unit_test(black_stays_black),
        cmocka_unit_test(one_lit_pixel_is_seen_and_alone),
        cmocka_unit_test(a_bright_pixel_does_not_darken_the_rest),
        cmocka_unit_test(colours_keep_their_hue),
        cmocka_unit_test(what_is_no_picture_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
