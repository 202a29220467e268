/* tests/unit/test_dome.c -- directions drawn as skies are bright. */
#include "sky/dome.h"

#include "core/sampler.h"
#include "tests/drawn_sky.h"
#include "tests/one_lane_sky.h"
#include "tests/test.h"

#include <stdlib.h>

enum { COLUMNS = 64, ROWS = 32 };
static const float just_below_one = 0x1.fffffep-1f;

/* Pixels of 1 with a sun among them, at the pole, at the seam, and elsewhere. */
static float sun_at_pole[ROWS * COLUMNS], sun_at_seam[ROWS * COLUMNS], sun[ROWS * COLUMNS];
enum { POLE = 0 * COLUMNS + 5, SEAM = 12 * COLUMNS + 63, ELSEWHERE = 9 * COLUMNS + 17 };

enum { SKIES = 7 };
static sky_twin skies[SKIES];

static int make_skies(void **state)
{
    (void)state;
    for (int i = 0; i < ROWS * COLUMNS; i++)
        sun_at_pole[i] = sun_at_seam[i] = sun[i] = 1.0f;
    sun_at_pole[POLE] = sun_at_seam[SEAM] = sun[ELSEWHERE] = 1e9f;
    skies[0]                                               = sky_twin_of(TWIN_BLACK, NULL, 0, 0);
    skies[1]                                               = sky_twin_of(TWIN_EVEN, NULL, 0, 0);
    skies[2]                                               = sky_twin_of(TWIN_SMOOTH, NULL, 0, 0);
    skies[3]                                               = sky_twin_of(TWIN_SUNNY, NULL, 0, 0);
    skies[4] = sky_twin_of(TWIN_PIXELS, sun_at_pole, COLUMNS, ROWS);
    skies[5] = sky_twin_of(TWIN_PIXELS, sun_at_seam, COLUMNS, ROWS);
    skies[6] = sky_twin_of(TWIN_PIXELS, sun, COLUMNS, ROWS);
    return 0;
}

static const dome *dome_of(arena *a, const sky_twin *s)
{
    const sky *one = &s->base;
    const dome *d  = dome_new(a, &one, 1, NULL);
    assert_non_null(d);
    return d;
}

static double pdf_at(const dome *d, vec3 w)
{
    vvec3 wi = vspread(w);
    return (double)lane(dome_pdf(d, &wi, ALL_LANES), 0);
}

static vec3 toward(double from_zenith, double azimuth)
{
    return (vec3){ (float)(sin(from_zenith) * sin(azimuth)),
                   (float)(sin(from_zenith) * cos(azimuth)), (float)cos(from_zenith) };
}

/* What the density comes to in each of 48 x 24 equal steps of angle (summed: 1), by the middles of
 * parts that are finer than any cell, and fall in with them. */
enum { ACROSS = 48, DOWN = 24, PARTS = 32 };
static void integrate(const dome *d, double out[DOWN * ACROSS])
{
    const int rows = DOWN * PARTS, columns = ACROSS * PARTS;
    for (int i = 0; i < DOWN * ACROSS; i++)
        out[i] = 0.0;
    for (int j = 0; j < rows; j++) {
        double angle = 2.0 * M_PI / columns * (cos(M_PI * j / rows) - cos(M_PI * (j + 1) / rows));
        for (int i = 0; i < columns; i++) {
            vec3 w = toward(M_PI * (j + 0.5) / rows, 2.0 * M_PI * (i + 0.5) / columns - M_PI);
            out[j / PARTS * ACROSS + i / PARTS] += pdf_at(d, w) * angle;
        }
    }
}

static int bin_of(vec3 w)
{
    int i = (int)((atan2((double)w.x, (double)w.y) / M_PI + 1.0) * 0.5 * ACROSS);
    int j = (int)(atan2(hypot((double)w.x, (double)w.y), (double)w.z) / M_PI * DOWN);
    return (j < DOWN ? j : DOWN - 1) * ACROSS + (i < ACROSS ? i : ACROSS - 1);
}

/* A cell is 6 x 6 parts, whose middles lie on no border. What is off is the rounding of the sums:
 * 2^-24 of some 1e-3. */
TEST(the_density_comes_to_one_and_draws_follow_it)
{
    enum { DRAWS = 40000 };
    static double expected[DOWN * ACROSS];
    static int count[DOWN * ACROSS];
    for (int k = 0; k < SKIES; k++) {
        arena a       = { 0 };
        const dome *d = dome_of(&a, &skies[k]);
        integrate(d, expected);
        double sum = 0.0;
        for (int i = 0; i < DOWN * ACROSS; i++) {
            sum += expected[i];
            count[i] = 0;
        }
        assert_near(sum, 1.0, 1e-4);

        uint32_t at = 7;
        for (int i = 0; i < DRAWS; i += LANES) {
            float s[LANES], t[LANES];
            for (int l = 0; l < LANES; l++) {
                s[l] = (float)twin_even(&at);
                t[l] = (float)twin_even(&at);
            }
            vfloat pdf;
            vvec3 w = dome_sample(d, vload(s), vload(t), ALL_LANES, &pdf);
            for (int l = 0; l < LANES; l++)
                count[bin_of((vec3){ lane(w.x, l), lane(w.y, l), lane(w.z, l) })]++;
        }
        for (int i = 0; i < DOWN * ACROSS; i++)
            expected[i] *= DRAWS / sum;
        double by_chance = chi_square_test(expected, count, DOWN * ACROSS);
        if (!(by_chance > 0.01))
            fail_msg("sky %d: p = %g", k, by_chance);
        arena_clear(&a);
    }
}

static void check_draw(const dome *d, float s, float t)
{
    vfloat pdf;
    vvec3 w    = dome_sample(d, vsplat(s), vsplat(t), ALL_LANES, &pdf);
    float told = lane(pdf, 0);
    assert_true(told > 0.0f && told < INFINITY);
    assert_true(lane(dome_pdf(d, &w, ALL_LANES), 0) == told);
    assert_near(lane(vlength(w), 0), 1.0, 3e-7);
}

TEST(the_density_told_is_that_of_the_direction_to_the_bit)
{
    const float edge[] = { 0.0f, 0x1p-24f, 0.25f, 0.5f, 0x1.fffffcp-1f, just_below_one };
    for (int k = 0; k < SKIES; k++) {
        arena a       = { 0 };
        const dome *d = dome_of(&a, &skies[k]);
        for (int i = 0; i < 36; i++)
            check_draw(d, edge[i % 6], edge[i / 6]);
        uint32_t at = 3;
        for (int i = 0; i < 100000; i++) {
            float s = (float)twin_even(&at), t = (float)twin_even(&at);
            check_draw(d, s, t);
            check_draw(d, (float)(i % 1024) / 1024.0f, t); /* borders of cells */
            check_draw(d, edge[i % 6], t);
        }
        arena_clear(&a);
    }
}

TEST(poles_and_seam_have_a_density)
{
    const vec3 w[] = { { 0, 0, 1 },          { 0, 0, -1 },         { 0, -1, 0 },
                       { -0.0f, -1, 0 },     { -1e-30f, -1, 0 },   { 1e-30f, -1e-30f, 1 },
                       { -0.0f, -0.0f, -1 }, { 0, -1e-8f, -1.0f }, { 1, 0, 1.1920929e-7f } };
    arena a        = { 0 };
    const dome *d  = dome_of(&a, &skies[1]);
    for (int i = 0; i < 9; i++)
        assert_near(pdf_at(d, w[i]), 1.0 / (4.0 * M_PI), 1e-3); /* 2^-24 of 1 / 256 and 1e-4 */
    arena_clear(&a);
}

TEST(a_black_sky_and_an_even_one_are_drawn_evenly)
{
    arena a = { 0 };
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < 50; i++)
            assert_near(pdf_at(dome_of(&a, &skies[k]), toward(0.06 * i + 0.05, 0.1 * i)),
                        1.0 / (4.0 * M_PI), 1e-3);
    arena_clear(&a);
}

/* Of 2 + x + z/2 the mean is 2, and x + z/2 is left where that is positive: sqrt(1.25) times a
 * cosine, whose integral over the half sphere is pi. A cell is 0.025 wide. */
TEST(what_is_everywhere_the_same_is_left_to_others)
{
    arena a       = { 0 };
    const dome *d = dome_of(&a, &skies[2]);
    assert_near(pdf_at(d, (vec3){ 0.8f, 0, 0.6f }), 1.1 / (M_PI * sqrt(1.25)), 0.03);
    assert_near(pdf_at(d, (vec3){ 0, 0.8f, 0.6f }), 0.3 / (M_PI * sqrt(1.25)), 0.06);
    assert_true(pdf_at(d, (vec3){ -0.8f, 0, 0.6f }) == 0.0);
    assert_true(pdf_at(d, (vec3){ 0, 0.6f, -0.8f }) == 0.0);
    arena_clear(&a);
}

/* sr, of a pixel. */
static double pixel_angle(int pixel)
{
    int row = pixel / COLUMNS;
    return 2.0 * M_PI / COLUMNS * (cos(M_PI * row / ROWS) - cos(M_PI * (row + 1) / ROWS));
}

/* The mean of L / pdf and of its square, over so many draws. */
static void estimate(const sky_twin *s, const dome *d, int draws, double *mean, double *square)
{
    uint32_t at = 11;
    *mean = *square = 0.0;
    for (int i = 0; i < draws; i++) {
        float a = (float)twin_even(&at), b = (float)twin_even(&at);
        vfloat pdf;
        vvec3 wi    = dome_sample(d, vsplat(a), vsplat(b), ALL_LANES, &pdf);
        double w[3] = { (double)lane(wi.x, 0), (double)lane(wi.y, 0), (double)lane(wi.z, 0) };
        double e    = sky_twin_luminance(s, w) / (double)lane(pdf, 0);
        *mean += e / draws;
        *square += e * e / draws;
    }
}

/* Of a sun that is 1e9 times the rest, no draw differs by what the rest gives. */
TEST(a_sun_of_one_pixel_has_its_energy_and_no_firefly)
{
    const int pixel[] = { POLE, SEAM, ELSEWHERE };
    for (int k = 0; k < 3; k++) {
        arena a       = { 0 };
        const dome *d = dome_of(&a, &skies[4 + k]);
        double mean, square;
        estimate(&skies[4 + k], d, 100000, &mean, &square);
        assert_near(mean, 1e9 * pixel_angle(pixel[k]), 0.01); /* 0.1 %: a ninth of draws miss */
        assert_true(square < 1.15 * mean * mean);             /* 18 / 16 */
        arena_clear(&a);
    }
}

/* A glow that is e^-1 within 11 degrees, 1000 times the sky: over the sphere, evenly drawn, the
 * variance of its light is some 70 times its square. */
TEST(a_sunny_sky_varies_fifty_times_less_than_when_drawn_evenly)
{
    arena a       = { 0 };
    const dome *d = dome_of(&a, &skies[3]);
    double mean, square, even = 0.0, even_square = 0.0;
    estimate(&skies[3], d, 100000, &mean, &square);
    uint32_t at = 5;
    for (int i = 0; i < 100000; i++) {
        double z = 2.0 * twin_even(&at) - 1.0, phi = 2.0 * M_PI * twin_even(&at);
        double r = sqrt(1.0 - z * z), w[3] = { r * cos(phi), r * sin(phi), z };
        double e = 4.0 * M_PI * sky_twin_luminance(&skies[3], w);
        even += e / 1e5;
        even_square += e * e / 1e5;
    }
    assert_true(even_square - even * even > 50.0 * (square - mean * mean));
    arena_clear(&a);
}

/* Four pixels a cell; a quarter of the light again in the cell to each side. */
TEST(of_a_panorama_that_is_pooled_no_pixel_is_lost)
{
    enum { WIDE = 8192, HIGH = 16 };
    float *pixel = calloc((size_t)WIDE * HIGH, sizeof *pixel);
    assert_non_null(pixel);
    pixel[5 * WIDE + 4001] = 1.0f;
    sky_twin s             = sky_twin_of(TWIN_PIXELS, pixel, WIDE, HIGH);
    arena a                = { 0 };
    const dome *d          = dome_of(&a, &s);
    double azimuth         = 2.0 * M_PI * 4001.5 / WIDE - M_PI;
    double angle           = 2.0 * M_PI / 2048 * (cos(M_PI * 5 / HIGH) - cos(M_PI * 6 / HIGH));
    assert_near(pdf_at(d, toward(M_PI * 5.5 / HIGH, azimuth)) * angle, 2.0 / 3.0, 1e-3);
    free(pixel);
    arena_clear(&a);
}

/* A cell is a quarter of a pixel wide; those beside a sun take a quarter of what one in it has. */
TEST(of_several_skies_the_mean_is_drawn)
{
    const sky *all[]  = { &skies[5].base, &skies[2].base, &skies[6].base };
    const int pixel[] = { SEAM, ELSEWHERE };
    arena a           = { 0 };
    const dome *d     = dome_new(&a, all, 3, NULL);
    assert_non_null(d);
    double both = pixel_angle(SEAM) + pixel_angle(ELSEWHERE);
    for (int k = 0; k < 2; k++) {
        int row = pixel[k] / COLUMNS, column = pixel[k] % COLUMNS;
        vec3 w = toward(M_PI * (row + 0.4) / ROWS, 2.0 * M_PI * (column + 0.4) / COLUMNS - M_PI);
        assert_near(pdf_at(d, w) * both, 16.0 / 18.0, 1e-3);
    }
    arena_clear(&a);
}

TEST(dead_lanes_are_zero)
{
    arena a       = { 0 };
    const dome *d = dome_of(&a, &skies[3]);
    vfloat pdf    = vsplat(5.0f);
    vvec3 w       = dome_sample(d, vsplat(NAN), vsplat(NAN), ~ALL_LANES, &pdf);
    assert_true(vall((w.x == 0.0f) & (w.y == 0.0f) & (w.z == 0.0f) & (pdf == 0.0f)));
    w = vspread((vec3){ NAN, INFINITY, NAN });
    assert_true(vall(dome_pdf(d, &w, ~ALL_LANES) == 0.0f));
    arena_clear(&a);
}

TEST(one_lane_draws_the_same_to_the_bit)
{
    arena a     = { 0 };
    uint32_t at = 1;
    for (int k = 0; k < SKIES; k++) {
        const dome *d = dome_of(&a, &skies[k]);
        for (int i = 0; i < 1000; i++) {
            float s[LANES], t[LANES], one[4];
            for (int l = 0; l < LANES; l++) {
                s[l] = (float)twin_even(&at);
                t[l] = (float)twin_even(&at);
            }
            vfloat pdf;
            vvec3 w = dome_sample(d, vload(s), vload(t), ALL_LANES, &pdf);
            for (int l = 0; l < LANES; l++) {
                one_lane_dome_sample(d, s[l], t[l], one);
                assert_true(one[0] == lane(w.x, l) && one[1] == lane(w.y, l));
                assert_true(one[2] == lane(w.z, l) && one[3] == lane(pdf, l));
                assert_true(one_lane_dome_pdf(d, one) == one[3]);
            }
        }
    }
    arena_clear(&a);
}

TEST(without_memory_there_is_none)
{
    arena a        = { 0 };
    lux_error err  = { 0 };
    const sky *one = &skies[3].base;
    memory_is_out  = true;
    const dome *d  = dome_new(&a, &one, 1, &err);
    memory_is_out  = false;
    assert_null(d);
    assert_int_equal(err.code, ERR_MEMORY);
    arena_clear(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_density_comes_to_one_and_draws_follow_it),
        cmocka_unit_test(the_density_told_is_that_of_the_direction_to_the_bit),
        cmocka_unit_test(poles_and_seam_have_a_density),
        cmocka_unit_test(a_black_sky_and_an_even_one_are_drawn_evenly),
        cmocka_unit_test(what_is_everywhere_the_same_is_left_to_others),
        cmocka_unit_test(a_sun_of_one_pixel_has_its_energy_and_no_firefly),
        cmocka_unit_test(a_sunny_sky_varies_fifty_times_less_than_when_drawn_evenly),
        cmocka_unit_test(of_a_panorama_that_is_pooled_no_pixel_is_lost),
        cmocka_unit_test(of_several_skies_the_mean_is_drawn),
        cmocka_unit_test(dead_lanes_are_zero),
        cmocka_unit_test(one_lane_draws_the_same_to_the_bit),
        cmocka_unit_test(without_memory_there_is_none),
    };
    return cmocka_run_group_tests(tests, make_skies, NULL);
}
