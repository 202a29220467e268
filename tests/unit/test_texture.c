/* tests/unit/test_texture.c -- pictures against a twin in double precision that has no frames, no
 * rows of four and no halves: texels by their places, means by the areas that overlap. */
#include "materials/texture.h"
#include "tests/one_lane_texture.h"
#include "tests/shapes.h"
#include "tests/test.h"

#include <stdlib.h>
#include <string.h>

enum { MOST = 70, SIZES = 10 };

static const int sizes[SIZES][2]   = { { 1, 1 },  { 2, 2 },  { 3, 5 },  { 17, 9 }, { 64, 64 },
                                       { 1, 13 }, { 70, 1 }, { 7, 33 }, { 2, 31 }, { 63, 64 } };
static const texture_wrap wraps[3] = { WRAP_REPEAT, WRAP_CLAMP, WRAP_MIRROR };

/* ---- the twin -------------------------------------------------------------------------------- */

typedef struct twin {
    int levels, width[8], height[8];
    double rgba[8][MOST * MOST][4];
    texture_wrap wrap_u, wrap_v;
} twin;

static double overlap(double a0, double a1, double b0, double b1)
{
    return fmax(0.0, fmin(a1, b1) - fmax(a0, b0));
}

/* Texels of level `to` as the areas of the full picture's that they cover, level by level. */
static void twin_shrink(twin *t, int to)
{
    int w = t->width[to - 1], h = t->height[to - 1];
    int m = t->width[to] = w > 1 ? w / 2 : 1, k = t->height[to] = h > 1 ? h / 2 : 1;
    double wide = (double)w / m, high = (double)h / k;
    for (int i = 0; i < m * k; i++)
        for (int c = 0; c < 4; c++) {
            double sum = 0.0, x = i % m, y = i / m;
            for (int j = 0; j < w * h; j++)
                sum += t->rgba[to - 1][j][c] * overlap(j % w, j % w + 1, x * wide, (x + 1) * wide) *
                       overlap(j / w, j / w + 1, y * high, (y + 1) * high);
            t->rgba[to][i][c] = sum / (wide * high);
        }
}

static void twin_make(twin *t, const texture_desc *d)
{
    *t = (twin){ .width = { d->width }, .height = { d->height } };
    for (int i = 0; i < d->width * d->height; i++)
        for (int c = 0; c < 4; c++)
            t->rgba[0][i][c] = (double)d->rgba[4 * i + c];
    t->levels = 1;
    while (t->width[t->levels - 1] > 1 || t->height[t->levels - 1] > 1)
        twin_shrink(t, t->levels++);
}

static int twin_wrap(texture_wrap wrap, long long i, int n)
{
    if (wrap == WRAP_CLAMP)
        return (int)(i < 0 ? 0 : i < n ? i : n - 1);
    long long period = wrap == WRAP_REPEAT ? n : 2 * n;
    i                = ((i % period) + period) % period;
    return (int)(i < n ? i : 2 * n - 1 - i);
}

static double twin_level(const twin *t, int l, double u, double v, int c)
{
    double x = u * t->width[l] - 0.5, y = v * t->height[l] - 0.5, sum = 0.0;
    for (int k = 0; k < 4; k++) {
        double i = floor(x) + k % 2, j = floor(y) + k / 2; /* each corner by its distance */
        int column = twin_wrap(t->wrap_u, (long long)i, t->width[l]);
        int line   = twin_wrap(t->wrap_v, (long long)j, t->height[l]);
        sum += (1 - fabs(x - i)) * (1 - fabs(y - j)) * t->rgba[l][line * t->width[l] + column][c];
    }
    return sum;
}

static double twin_lookup(const twin *t, double u, double v, double width, int c)
{
    double place = log2(width * fmax(t->width[0], t->height[0]));
    place        = fmin(fmax(place, 0.0), t->levels - 1);
    int l        = (int)place;
    double near  = twin_level(t, l, u, v, c);
    double far   = l + 1 < t->levels ? twin_level(t, l + 1, u, v, c) : near;
    return near + (place - l) * (far - near);
}

/* ---- pictures -------------------------------------------------------------------------------- */

/* Of memory of its own, which ends where the picture does. */
static float *random_picture(int width, int height)
{
    uint32_t seed = (uint32_t)(width * 100 + height);
    float *rgba   = malloc(sizeof *rgba * (size_t)(width * height * 4));
    for (int i = 0; i < width * height * 4; i++)
        rgba[i] = 1.0f + random_unit(&seed);
    return rgba;
}

static const texture *make(arena *a, const texture_desc *d)
{
    lux_error err    = { 0 };
    const texture *t = texture_new(a, d, &err);
    if (!t)
        fail_msg("%s", err.text);
    return t;
}

static void spell(vtexel t, int i, float rgba[4])
{
    rgba[0] = lane(t.red, i);
    rgba[1] = lane(t.green, i);
    rgba[2] = lane(t.blue, i);
    rgba[3] = lane(t.alpha, i);
}

static void look(const texture *t, float u, float v, float width, float rgba[4])
{
    spell(vtexture_lookup(t, vsplat(u), vsplat(v), vsplat(width), ALL_LANES), 0, rgba);
}

TEST(a_checkerboard_from_afar_is_its_mean)
{
    for (int s = 0; s < SIZES; s++) {
        arena a = { 0 };
        int w = sizes[s][0], h = sizes[s][1];
        float *rgba  = random_picture(w, h), got[4], mean[4];
        double white = 0;
        for (int i = 0; i < w * h; i++) {
            bool is = (i % w + i / w) % 2;
            white += is;
            for (int c = 0; c < 4; c++)
                rgba[4 * i + c] = is ? 0.1f * (float)(c + 1) : 0.0f;
        }
        const texture *t =
            make(&a, &(texture_desc){ .name = "t", .width = w, .height = h, .rgba = rgba });
        float widths[3] = { 1.0f, 50.0f, INFINITY };
        for (int k = 0; k < 3; k++)
            for (float u = -1.3f; u < 2; u += 0.37f) {
                look(t, u, 0.7f * u, widths[k], got);
                texture_mean(t, mean);
                assert_memory_equal(got, mean, sizeof mean);
                for (int c = 0; c < 4; c++) /* half an ulp of a float */
                    assert_near(got[c], (double)(0.1f * (float)(c + 1)) * white / (w * h), 0x1p-24);
            }
        free(rgba);
        arena_clear(&a);
    }
}

/* How far a float look-up may be off: 2^-23 of the coordinate (which is below 4) in each of two
 * axes, times the texels that are a unit, times 1, the most that neighbours differ by; and 2 ulp
 * of the level's number, 7 at most, in two levels that differ by 1. */
static double allowed(int w, int h) { return 0x1p-21 * (w + h) + 0x1p-20; }

TEST(look_ups_are_bilinear_in_two_levels)
{
    static twin expected;
    uint32_t seed = 1;
    for (int s = 0; s < SIZES * 9; s++) {
        arena a = { 0 };
        int w = sizes[s / 9][0], h = sizes[s / 9][1];
        float *rgba      = random_picture(w, h);
        texture_desc d   = { "t", w, h, rgba, wraps[s % 3], wraps[s / 3 % 3], false };
        const texture *t = make(&a, &d);
        if (s % 9 == 0)
            twin_make(&expected, &d);
        expected.wrap_u = d.wrap_u;
        expected.wrap_v = d.wrap_v;
        free(rgba);
        for (int n = 0; n < 300; n++) {
            float got[4], u = 6 * random_unit(&seed) - 3, v = 6 * random_unit(&seed) - 3;
            float width = exp2f(10 * random_unit(&seed) - 8);
            look(t, u, v, width, got);
            for (int c = 0; c < 4; c++)
                if (fabs((double)got[c] - twin_lookup(&expected, (double)u, (double)v,
                                                      (double)width, c)) > allowed(w, h))
                    fail_msg("%d x %d, wraps %d %d, at %.9g %.9g, %.9g wide: %.9g, not %.9g", w, h,
                             d.wrap_u, d.wrap_v, (double)u, (double)v, (double)width,
                             (double)got[c],
                             twin_lookup(&expected, (double)u, (double)v, (double)width, c));
        }
        arena_clear(&a);
    }
}

TEST(texel_centres_are_the_texels)
{
    arena a          = { 0 };
    float *rgba      = random_picture(16, 8), got[4];
    texture_desc d   = { .name = "t", .width = 16, .height = 8, .rgba = rgba };
    const texture *t = make(&a, &d);
    for (int i = 0; i < 16 * 8; i++) {
        look(t, ((float)(i % 16) + 0.5f) / 16, ((float)(i / 16) + 0.5f) / 8, 0.0f, got);
        assert_memory_equal(got, rgba + 4 * i, sizeof got);
    }
    free(rgba);
    arena_clear(&a);
}

TEST(only_repeat_blends_across_the_seam)
{
    static const float rgba[8] = { 0, 0, 0, 0, 1, 1, 1, 1 }; /* black on the left, white */
    static const float want[3] = { 0.5f, 0.0f, 0.0f };
    for (int k = 0; k < 3; k++) {
        arena a          = { 0 };
        texture_desc d   = { "t", 2, 1, rgba, wraps[k], WRAP_CLAMP, false };
        const texture *t = make(&a, &d);
        float got[4];
        look(t, 0.0f, 0.5f, 0.0f, got);
        assert_true(got[0] == want[k]);
        look(t, -0.25f, 0.5f, 0.0f, got); /* white, black by clamp and mirror */
        assert_true(got[0] == (k == 0 ? 1.0f : 0.0f));
        look(t, 1.75f, 0.5f, 0.0f, got);
        assert_true(got[0] == (k == 2 ? 0.0f : 1.0f));
        arena_clear(&a);
    }
}

TEST(nearest_takes_one_texel_of_the_full_picture)
{
    for (int k = 0; k < 9; k++) {
        arena a          = { 0 };
        float *rgba      = random_picture(5, 3), got[4];
        texture_desc d   = { "t", 5, 3, rgba, wraps[k % 3], wraps[k / 3], true };
        const texture *t = make(&a, &d);
        for (int i = -10; i < 20; i++) {
            float u = ((float)i + 0.4f) / 5, v = ((float)i + 0.7f) / 3;
            int at = 5 * twin_wrap(d.wrap_v, i, 3) + twin_wrap(d.wrap_u, i, 5);
            look(t, u, v, 1.0f, got);
            assert_memory_equal(got, rgba + 4 * at, sizeof got);
        }
        free(rgba);
        arena_clear(&a);
    }
}

TEST(any_coordinate_reads_a_texel_that_is_there)
{
    static const float odd[] = { NAN,      -NAN,           INFINITY, -INFINITY, 3.4e38f,
                                 -3.4e38f, 1e-45f,         -1e-9f,   -1e-45f,   0.0f,
                                 -0.0f,    1.0f,           2.0f,     -1.0f,     0.5f,
                                 1e9f,     0x1.fffffep-1f, 1.5f,     8388607.5f };
    enum { ODD = sizeof odd / sizeof *odd };
    for (int s = 0; s < SIZES * 6; s++) {
        arena a = { 0 };
        int w = sizes[s / 6][0], h = sizes[s / 6][1];
        float *rgba      = random_picture(w, h), got[4];
        texture_desc d   = { "t", w, h, rgba, wraps[s % 3], wraps[s % 3], s % 6 < 3 };
        const texture *t = make(&a, &d);
        free(rgba);
        for (int i = 0; i < ODD * ODD * ODD; i++) {
            look(t, odd[i % ODD], odd[i / ODD % ODD], odd[i / ODD / ODD], got);
            for (int c = 0; c < 4; c++) /* all texels are */
                assert_true(got[c] >= 1.0f && got[c] <= 2.0f);
        }
        arena_clear(&a);
    }
}

TEST(what_is_no_coordinate_is_an_end_of_the_picture)
{
    static const float odd[3] = { NAN, INFINITY, -INFINITY };
    for (int k = 0; k < 9; k++) {
        arena a          = { 0 };
        float *rgba      = random_picture(7, 33), got[4], want[4];
        texture_desc d   = { "t", 7, 33, rgba, wraps[k % 3], wraps[k % 3], false };
        const texture *t = make(&a, &d);
        free(rgba);
        for (int i = 0; i < 3; i++) { /* 1 repeats, and is mirrored, as 0 */
            float end = i == 1 && wraps[k % 3] == WRAP_CLAMP ? 1.0f : 0.0f;
            float own = 0.3f, width = 0.01f * (float)(k / 3);
            look(t, odd[i], own, width, got);
            look(t, end, own, width, want);
            assert_memory_equal(got, want, sizeof got);
            look(t, own, odd[i], width, got);
            look(t, own, end, width, want);
            assert_memory_equal(got, want, sizeof got);
        }
        arena_clear(&a);
    }
}

/* One lane alone skips the level that other lanes need: -0 + 0 * (mean - -0) would be +0. */
TEST(zero_has_one_sign_whatever_the_other_lanes_need)
{
    arena a = { 0 };
    float rgba[4 * 4 * 4], got[4], want[4];
    for (int i = 0; i < 4 * 4 * 4; i++)
        rgba[i] = i < 4 ? -0.0f : i / 4 == 10 ? 500.0f : -1.0f;
    const texture *t =
        make(&a, &(texture_desc){ .name = "t", .width = 4, .height = 4, .rgba = rgba });
    vfloat width = vselect(vlane_index() == 0, vsplat(0.0f), vsplat(0.4f));
    one_lane_lookup(t, 0.125f, 0.125f, 0.0f, want);
    spell(vtexture_lookup(t, vsplat(0.125f), vsplat(0.125f), width, ALL_LANES), 0, got);
    assert_memory_equal(got, want, sizeof got);
    arena_clear(&a);
}

TEST(look_ups_do_not_jump_from_level_to_level)
{
    arena a          = { 0 };
    float *rgba      = random_picture(37, 50), got[4], before[4];
    texture_desc d   = { .name = "t", .width = 37, .height = 50, .rgba = rgba };
    const texture *t = make(&a, &d);
    look(t, 0.3f, 0.6f, 1e-3f, before);
    for (float width = 1e-3f; width < 3.0f; width *= 1.001f) {
        look(t, 0.3f, 0.6f, width, got);
        for (int c = 0; c < 4; c++) /* levels differ by less than 1, and log2(1.001) < 0.00145 */
            assert_true(fabsf(got[c] - before[c]) < 0.00146f);
        memcpy(before, got, sizeof got);
    }
    free(rgba);
    arena_clear(&a);
}

TEST(what_is_all_the_same_stays_so_to_the_bit)
{
    arena a       = { 0 };
    uint32_t seed = 9;
    float rgba[4 * 7 * 6], got[4];
    for (int i = 0; i < 7 * 6 * 4; i++)
        rgba[i] = 0.1f;
    texture_desc d   = { .name = "t", .width = 7, .height = 6, .rgba = rgba };
    const texture *t = make(&a, &d);
    for (int n = 0; n < 1000; n++) {
        float u = random_unit(&seed), v = random_unit(&seed);
        look(t, u, v, 2 * random_unit(&seed), got);
        assert_memory_equal(got, rgba, sizeof got);
    }
    arena_clear(&a);
}

TEST(lanes_are_as_one_lane_and_dark_ones_are_zero)
{
    uint32_t seed = 4;
    for (int k = 0; k < 18; k++) {
        arena a          = { 0 };
        float *rgba      = random_picture(29, 50);
        rgba[8]          = -0.0f;
        texture_desc d   = { "t", 29, 50, rgba, wraps[k % 3], wraps[k / 3 % 3], k >= 9 };
        const texture *t = make(&a, &d);
        free(rgba);
        for (int n = 0; n < 500; n++) {
            float u[LANES], v[LANES], width[LANES], got[4], want[4];
            for (int i = 0; i < LANES; i++) {
                u[i]     = 6 * random_unit(&seed) - 3;
                v[i]     = 6 * random_unit(&seed) - 3;
                width[i] = exp2f(9 * random_unit(&seed) - 8);
            }
            vmask active = (vlane_index() & 1) == (n & 1);
            vtexel one   = vtexture_lookup(t, vload(u), vload(v), vload(width), active);
            for (int i = 0; i < LANES; i++) {
                static const float dark[4] = { 0 };
                one_lane_lookup(t, u[i], v[i], width[i], want);
                spell(one, i, got);
                assert_memory_equal(got, i % 2 == n % 2 ? want : dark, sizeof got);
            }
        }
        arena_clear(&a);
    }
}

static void assert_refused(const texture_desc *d, const char *why)
{
    arena a       = { 0 };
    lux_error err = { 0 };
    assert_null(texture_new(&a, d, &err));
    if (!strstr(err.text, why))
        fail_msg("%s", err.text);
    arena_clear(&a);
}

TEST(texels_that_are_no_numbers_are_refused_by_name_and_place)
{
    float *rgba    = random_picture(4, 3);
    texture_desc d = { .name = "wood.png", .width = 4, .height = 3, .rgba = rgba };
    rgba[4 * 6]    = NAN;
    assert_refused(&d, "wood.png: the red of the pixel in column 2 of row 1 is not a number");
    rgba[4 * 6]     = 1;
    rgba[4 * 3 + 2] = -INFINITY;
    assert_refused(&d, "wood.png: the blue of the pixel in column 3 of row 0 is -inf");
    rgba[4 * 3 + 2] = 1e31f;
    assert_refused(&d, "is 1e+31, at most 1e30 wanted");
    free(rgba);
}

TEST(sizes_out_of_range_and_full_memory_are_errors)
{
    static const float rgba[4] = { 0 };
    assert_refused(&(texture_desc){ .name = "t", .width = 0, .height = 1, .rgba = rgba },
                   "t: 0 x 1 pixels, 1 to 32768 a side wanted");
    assert_refused(&(texture_desc){ .name = "t", .width = 1, .height = 32769, .rgba = rgba },
                   "t: 1 x 32769 pixels");
    memory_is_out = true;
    assert_refused(&(texture_desc){ .name = "t", .width = 1, .height = 1, .rgba = rgba }, "");
    memory_is_out = false;
}

TEST(memory_is_a_third_more_than_the_picture)
{
    arena a     = { 0 };
    float *rgba = random_picture(64, 64);
    double size = 64 * 64 * 16;
    const texture *t =
        make(&a, &(texture_desc){ .name = "t", .width = 64, .height = 64, .rgba = rgba });
    assert_true((double)texture_bytes(t) > 4 * size / 3);
    assert_true((double)texture_bytes(t) < 4 * size / 3 * 1.15); /* frames of 2 in 64, and names */
    free(rgba);
    arena_clear(&a);
}

/* Of 3 x 2 texels four are at or above a half, none counted twice by the frame. */
TEST(a_share_counts_the_texels_of_the_picture_alone)
{
    arena a               = { 0 };
    float rgba[6 * 4]     = { 0 };
    const float alphas[6] = { 1.0f, 0.5f, 0.0f, 0.75f, 0.5f, 0.25f };
    for (int i = 0; i < 6; i++)
        rgba[4 * i + 3] = alphas[i];
    const texture *t =
        make(&a, &(texture_desc){ .name = "t", .width = 3, .height = 2, .rgba = rgba });
    assert_near(texture_share(t, 0.5f), 4.0 / 6.0, 0.0);
    assert_near(texture_share(t, 0.0f), 1.0, 0.0);
    assert_near(texture_share(t, 1.5f), 0.0, 0.0);
    arena_clear(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_checkerboard_from_afar_is_its_mean),
        cmocka_unit_test(look_ups_are_bilinear_in_two_levels),
        cmocka_unit_test(texel_centres_are_the_texels),
        cmocka_unit_test(only_repeat_blends_across_the_seam),
        cmocka_unit_test(nearest_takes_one_texel_of_the_full_picture),
        cmocka_unit_test(any_coordinate_reads_a_texel_that_is_there),
        cmocka_unit_test(what_is_no_coordinate_is_an_end_of_the_picture),
        cmocka_unit_test(zero_has_one_sign_whatever_the_other_lanes_need),
        cmocka_unit_test(look_ups_do_not_jump_from_level_to_level),
        cmocka_unit_test(what_is_all_the_same_stays_so_to_the_bit),
        cmocka_unit_test(lanes_are_as_one_lane_and_dark_ones_are_zero),
        cmocka_unit_test(texels_that_are_no_numbers_are_refused_by_name_and_place),
        cmocka_unit_test(sizes_out_of_range_and_full_memory_are_errors),
        cmocka_unit_test(a_share_counts_the_texels_of_the_picture_alone),
        cmocka_unit_test(memory_is_a_third_more_than_the_picture),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
