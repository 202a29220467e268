/* tests/unit/test_panorama_sun.c -- the sun in a panorama: found, or not, with all its energy.
 *
 * Expected energies are numerical integrals of the direction over pixels, in double. Maps are
 * small: a pixel of 256 x 128 is 1.4 degrees.
 */
#include "core/color.h"
#include "sky/panorama.h"
#include "tests/panorama_file.h"
#include "tests/test.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { W = 256, H = 128 };
static const panorama_desc plain = { .scale = (double)NAN, .horizontal = (double)NAN };

/* ---- the twin -------------------------------------------------------------------------------- */

static void direction(double column, double row, double w[3])
{
    double f = 2.0 * M_PI * (column / W - 0.5), t = M_PI * row / H;
    w[0] = sin(t) * sin(f), w[1] = sin(t) * cos(f), w[2] = cos(t);
}

/* The integral of the direction over a pixel, sr: midpoints. */
static void toward_of(int column, int row, double out[3])
{
    enum { CUTS = 64 };
    out[0] = out[1] = out[2] = 0.0;
    for (int j = 0; j < CUTS; j++)
        for (int i = 0; i < CUTS; i++) {
            double w[3], y = row + (j + 0.5) / CUTS;
            direction(column + (i + 0.5) / CUTS, y, w);
            double area = 2.0 * M_PI * M_PI / W / H / CUTS / CUTS * sin(M_PI * y / H);
            for (int k = 0; k < 3; k++)
                out[k] += area * w[k];
        }
}

static double size_of(const double v[3]) { return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

/* What all of rgb gives a surface square to w that sees all of it, both sides: the moment of it. */
static void moment_of(const file_box *b, int c, double out[3])
{
    out[0] = out[1] = out[2] = 0.0;
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++) {
            double w[3], area = 2.0 * M_PI / W * (cos(M_PI * y / H) - cos(M_PI * (y + 1) / H));
            direction(x + 0.5, y + 0.5, w);
            for (int k = 0; k < 3; k++)
                out[k] += area * w[k] * (double)b->rgb[c][y * W + x];
        }
}

/* The map as it is looked up, back into rgb. */
static void read_back(file_box *b, const sky *s)
{
    for (int i = 0; i < W * H; i++) {
        double w[3];
        direction(i % W + 0.5, i / W + 0.5, w);
        vvec3 wi     = vspread((vec3){ (float)w[0], (float)w[1], (float)w[2] });
        vrgb l       = sky_radiance(s, &wi, ALL_LANES);
        b->rgb[0][i] = lane(l.x, 0), b->rgb[1][i] = lane(l.y, 0), b->rgb[2][i] = lane(l.z, 0);
    }
}

static void dot_on(file_box *b, int column, int row, float by)
{
    int i        = row * W + (column + W) % W;
    b->rgb[0][i] = by, b->rgb[1][i] = by, b->rgb[2][i] = by;
}

/* ---- what is a sun --------------------------------------------------------------------------- */

TEST(a_sun_of_one_pixel_is_found_with_its_energy_wherever_it_is)
{
    static const int at[][2] = { { 128, 30 }, { 0, 40 },      { W - 1, 63 }, { 64, 64 },
                                 { 17, 0 },   { W - 1, 0 },   { 0, 1 },      { 100, 127 },
                                 { 0, 127 },  { W - 1, 100 }, { 200, 90 },   { 40, 2 } };
    file_box b               = file_box_new();
    for (size_t i = 0; i < sizeof at / sizeof *at; i++) {
        double toward[3];
        panorama_sun sun;
        notices n = { .a = &b.a };
        file_box_fill(&b, W, H, 1.0f, 1.0f, 1.0f);
        dot_on(&b, at[i][0], at[i][1], 1e9f);
        const sky *s = panorama_of_file(&b, W, H, plain, &sun, &n);
        toward_of(at[i][0], at[i][1], toward);
        double e = size_of(toward) * (1e9 - 1.0);
        assert_true(sun.found && !sun.clipped);
        assert_near(sun.irradiance.x, e, 1e-4); /* midpoints of a 64th of a pixel: 1e-5 at a pole */
        assert_near(sun.irradiance.z, e, 1e-4);
        const double to[3] = { (double)sun.to_sun.x, (double)sun.to_sun.y, (double)sun.to_sun.z };
        assert_near(to[0] * toward[0] + to[1] * toward[1] + to[2] * toward[2], size_of(toward),
                    1e-6);
        /* e = pi L sin^2(radius), unless the sun itself is larger */
        double wide = 2.0 * asin(sqrt(e / (M_PI * 1e9))) * 180.0 / M_PI;
        assert_near(sun.diameter_deg, fmax(wide, 0.533), 1e-4);
        assert_near(s->horizontal.x, M_PI, 1e-6); /* what is left is even */
        assert_int_equal(n.count, 1);
        assert_non_null(strstr(n.first->text, "lx square to it"));
    }
    file_box_free(&b);
}

TEST(the_lamp_gives_what_is_taken_out_of_the_picture)
{
    file_box b = file_box_new();
    for (int turn = 0; turn < 2; turn++) {
        panorama_desc d = plain;
        panorama_sun sun;
        double before[3], after[3];
        d.rotate_deg = 360.0 * turn;
        d.scale      = 2.0;
        /* A sky that grows blue upward, a sun of four pixels with a corona about it, at the seam */
        for (int i = 0; i < W * H; i++) {
            double w[3], l, dx, dy, dz;
            direction(i % W + 0.5, i / W + 0.5, w);
            dx = w[0], dy = w[1] + 0.8, dz = w[2] - 0.6;
            l           = 30.0 * exp(-30.0 * sqrt(dx * dx + dy * dy + dz * dz));
            b.rgb[0][i] = (float)(l + 1.0), b.rgb[1][i] = (float)(l + 1.0 + 0.5 * w[2]);
            b.rgb[2][i] = (float)(l + 2.0 + w[2]);
        }
        for (int k = 0; k < 4; k++) {
            int i       = (37 + k / 2) * W + (k & 1 ? 0 : W - 1);
            b.rgb[0][i] = 5e4f, b.rgb[1][i] = 4e4f, b.rgb[2][i] = 3e4f + 100.0f * (float)k;
        }
        for (int c = 0; c < 3; c++) {
            moment_of(&b, c, before);
            const sky *s = panorama_of_file(&b, W, H, d, &sun, NULL);
            assert_true(sun.found);
            file_box rest = file_box_new();
            read_back(&rest, s);
            moment_of(&rest, c, after);
            const float e[3]  = { sun.irradiance.x, sun.irradiance.y, sun.irradiance.z };
            const float to[3] = { sun.to_sun.x, sun.to_sun.y, sun.to_sun.z };
            for (int k = 0; k < 3; k++)
                after[k] = (after[k] + (double)(e[c] * to[k])) / 2.0 - before[k];
            /* pixels as if all of their light came from their middle: 1e-4 of a pixel of 1.4
             * degrees; and one direction for all colours */
            assert_true(size_of(after) < 2e-4 * size_of(before));
            file_box_free(&rest);
        }
    }
    file_box_free(&b);
}

TEST(it_turns_and_is_scaled_as_the_picture_is)
{
    file_box b = file_box_new();
    panorama_sun sun, other;
    panorama_desc d = plain;
    file_box_fill(&b, W, H, 1.0f, 1.0f, 1.0f);
    dot_on(&b, 128, 40, 1e6f);
    panorama_of_file(&b, W, H, d, &sun, NULL);
    d.rotate_deg = 90.0;
    d.scale      = 3.0;
    panorama_of_file(&b, W, H, d, &other, NULL);
    assert_near(other.to_sun.x, sun.to_sun.y, 1e-6); /* clockwise: +y to +x */
    assert_near(other.to_sun.y, -sun.to_sun.x, 1e-6);
    assert_near(other.to_sun.z, sun.to_sun.z, 1e-6);
    assert_near(other.irradiance.y, 3.0f * sun.irradiance.y, 1e-6);
    assert_near(other.diameter_deg, sun.diameter_deg, 1e-9);

    /* Sun and sky together are what was asked for */
    d.scale      = (double)NAN;
    d.horizontal = 500.0;
    const sky *s = panorama_of_file(&b, W, H, d, &other, NULL);
    assert_near(s->horizontal.x + other.irradiance.x * other.to_sun.z, 500.0, 1e-4);
    file_box_free(&b);
}

TEST(keep_sun_leaves_it_in)
{
    file_box b = file_box_new();
    panorama_sun sun;
    panorama_desc d = plain;
    d.keep_sun      = true;
    file_box_fill(&b, W, H, 1.0f, 1.0f, 1.0f);
    dot_on(&b, 128, 40, 1e9f);
    const sky *s = panorama_of_file(&b, W, H, d, &sun, NULL);
    assert_false(sun.found);
    read_back(&b, s);
    assert_true(b.rgb[0][40 * W + 128] == 1e9f);
    file_box_free(&b);
}

/* ---- what is none ---------------------------------------------------------------------------- */

/* A square of pixels. */
static void square_on(file_box *b, int column, int row, int side, float by)
{
    for (int i = 0; i < side * side; i++)
        dot_on(b, column + i % side, row + i / side, by);
}

static void assert_no_sun(file_box *b, const char *says)
{
    panorama_sun sun;
    notices n = { .a = &b->a };
    panorama_of_file(b, W, H, plain, &sun, &n);
    assert_false(sun.found);
    assert_int_equal(n.count, says ? 1 : 0);
    if (says && !strstr(n.first->text, says))
        fail_msg("%s", n.first->text);
}

TEST(lamps_are_no_suns)
{
    file_box b = file_box_new();
    file_box_fill(&b, W, H, 1.0f, 1.0f, 1.0f);
    assert_no_sun(&b, NULL); /* nothing bright */
    dot_on(&b, 30, 40, 90.0f);
    assert_no_sun(&b, NULL); /* not by orders */
    dot_on(&b, 30, 40, 1e5f);
    dot_on(&b, 130, 50, 0.3e5f);
    assert_no_sun(&b, "in several places");
    dot_on(&b, 130, 50, 1e5f);
    assert_no_sun(&b, "in several places");

    file_box_fill(&b, W, H, 1.0f, 1.0f, 1.0f);
    square_on(&b, 20, 30, 4, 1e5f); /* 5.6 degrees: a window */
    assert_no_sun(&b, "too large for a sun");
    file_box_fill(&b, W, H, 1.0f, 1.0f, 1.0f);
    square_on(&b, 20, 30, 12, 1e5f); /* beyond 5 degrees from anywhere in it */
    assert_no_sun(&b, NULL);         /* it is as bright as what is around */

    file_box_fill(&b, W, H, 1.0f, 1.0f, 1.0f);
    dot_on(&b, 30, 64, 150.0f); /* bright, but of no weight: 0.09 of 12.6 */
    assert_no_sun(&b, NULL);
    file_box_free(&b);
}

TEST(a_clipped_sun_is_said_to_be_one)
{
    file_box b = file_box_new();
    panorama_sun sun;
    notices n = { .a = &b.a };
    file_box_fill(&b, W, H, 1.0f, 1.0f, 1.0f);
    square_on(&b, W - 1, 30, 2, 3e4f); /* a plateau of 2.8 degrees */
    panorama_of_file(&b, W, H, plain, &sun, &n);
    assert_true(sun.found && sun.clipped);
    assert_non_null(strstr(n.first->text, "brighter than the picture holds"));

    file_box_fill(&b, W, H, 1.0f, 1.0f, 1.0f);
    dot_on(&b, 3, 30, 65504.0f); /* as much as 16 bits hold */
    panorama_of_file(&b, W, H, plain, &sun, NULL);
    assert_true(sun.found && sun.clipped);

    file_box_fill(&b, W, H, 0.1f, 0.1f, 0.1f);
    square_on(&b, 20, 30, 2, 1.0f); /* a picture of 8 bits */
    assert_no_sun(&b, "holds only a part of its light");
    square_on(&b, 90, 30, 2, 1.0f);
    assert_no_sun(&b, NULL);
    file_box_free(&b);
}

/* ---- pictures of others, where they are ------------------------------------------------------ */

#define SHARED "../shared/data/hdr/"

TEST(the_suns_of_captured_panoramas_are_found_and_nothing_else)
{
    static const struct {
        const char *name;
        double elevation, azimuth; /* deg; by eye, to 2 pixels; NAN: none */
        double pixel;
    } file[] = {
        { "blender__courtyard.exr", (double)NAN, 0, 0.35 }, /* the sun behind a roof */
        { "blender__studio.exr", (double)NAN, 0, 0.35 },    /* lamps */
        { "blender__sunrise.exr", 8.1, 35.9, 0.35 },        /* over a field */
        { "c-ray__rooitou_park_1k.hdr", 10.5, 36.0, 0.35 }, /* between trees */
        { "pmndrs__lobby.exr", (double)NAN, 0, 0.7 },       /* lamps */
        { "pmndrs__night.exr", (double)NAN, 0, 0.7 },       /* street lights */
        { "pmndrs__sky.exr", 47.9, 34.3, 0.7 },             /* at noon */
        { "pmndrs__studio.exr", (double)NAN, 0, 0.7 },      /* a soft box */
        { "pmndrs__sunset.exr", (double)NAN, 0, 0.7 },      /* a rest of it, 1 % of all light */
    };
    arena a = { 0 };
    for (size_t i = 0; i < sizeof file / sizeof *file; i++) {
        char path[200];
        snprintf(path, sizeof path, SHARED "%s", file[i].name);
        if (access(path, R_OK) != 0)
            continue;
        panorama_desc d = plain;
        panorama_sun sun;
        lux_error err = { 0 };
        d.path        = path;
        if (!sky_panorama(&a, &d, &sun, NULL, &err))
            fail_msg("%s", err.text);
        if (sun.found != !isnan(file[i].elevation))
            fail_msg("%s: %s", path, sun.found ? "a sun" : "no sun");
        if (!sun.found)
            continue;
        double deg     = 180.0 / M_PI,
               azimuth = deg * atan2((double)sun.to_sun.x, (double)sun.to_sun.y);
        assert_true(fabs(deg * asin((double)sun.to_sun.z) - file[i].elevation) <
                    2.0 * file[i].pixel);
        assert_true(fabs(azimuth - file[i].azimuth) < 2.0 * file[i].pixel);
        assert_true(sun.diameter_deg < 1.1 && !sun.clipped);
    }
    arena_clear(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_sun_of_one_pixel_is_found_with_its_energy_wherever_it_is),
        cmocka_unit_test(the_lamp_gives_what_is_taken_out_of_the_picture),
        cmocka_unit_test(it_turns_and_is_scaled_as_the_picture_is),
        cmocka_unit_test(keep_sun_leaves_it_in),
        cmocka_unit_test(lamps_are_no_suns),
        cmocka_unit_test(a_clipped_sun_is_said_to_be_one),
        cmocka_unit_test(the_suns_of_captured_panoramas_are_found_and_nothing_else),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
