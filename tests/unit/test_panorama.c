/* tests/unit/test_panorama.c -- panoramas as skies: where their pixels are, what they give, which
 * are refused. The twin finds pixels by libm in double; suns: test_panorama_sun.c.
 */
#include "sky/panorama.h"
#include "tests/panorama_file.h"
#include "tests/test.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const panorama_desc plain = { .scale = (double)NAN, .horizontal = (double)NAN };

/* ---- the twin -------------------------------------------------------------------------------- */

/* Its pixel, in fractions of pixels from the top left corner. */
static void place_of(const double w[3], double rotate_deg, int width, int height, double *x,
                     double *y)
{
    double turn = atan2(w[0], w[1]) / (2.0 * M_PI) + 0.5 - rotate_deg / 360.0;
    *x          = (turn - floor(turn)) * width;
    *y          = acos(w[2]) / M_PI * height;
}

static double from_edge(double x) { return fabs(x - round(x)); }

static vec3 look(const sky *s, double x, double y, double z)
{
    vvec3 w = vspread((vec3){ (float)x, (float)y, (float)z });
    vrgb l  = sky_radiance(s, &w, ALL_LANES);
    return (vec3){ lane(l.x, 0), lane(l.y, 0), lane(l.z, 0) };
}

/* Red tells the pixel. */
static const sky *numbered(file_box *b, int width, int height, panorama_desc d)
{
    for (int i = 0; i < width * height; i++)
        b->rgb[0][i] = (float)i, b->rgb[1][i] = 1.0f, b->rgb[2][i] = 2.0f;
    return panorama_of_box(b, width, height, d, NULL);
}

/* ---- where ----------------------------------------------------------------------------------- */

TEST(the_middle_looks_along_y_and_right_of_it_is_x)
{
    file_box b   = file_box_new();
    const sky *s = numbered(&b, 8, 5, plain);
    assert_true(look(s, 1e-3, 1, 0).x == 2 * 8 + 4);  /* right of the middle, middle row */
    assert_true(look(s, -1e-3, 1, 0).x == 2 * 8 + 3); /* left of it */
    assert_true(look(s, 1, 1e-3, 0).x == 2 * 8 + 5);
    assert_true(look(s, 1, -1e-3, 0).x == 2 * 8 + 6);
    assert_true(look(s, -1, -1e-3, 0).x == 2 * 8 + 1);
    assert_true(look(s, 1e-3, -1, 0).x == 2 * 8 + 7); /* the seam's both sides */
    assert_true(look(s, -1e-3, -1, 0).x == 2 * 8 + 0);
    assert_true(look(s, 1e-4, 1e-3, 1).x == 4); /* the zenith is the top row */
    assert_true(look(s, 1e-4, 1e-3, -1).x == 4 * 8 + 4);
    assert_true(look(s, 0, 1, 0).y == 1.0f && look(s, 0, 1, 0).z == 2.0f);
    assert_true(s->below && s->columns == 8 && s->rows == 5);
    file_box_free(&b);
}

TEST(rotate_turns_it_clockwise_seen_from_above)
{
    file_box b      = file_box_new();
    panorama_desc d = plain;
    d.rotate_deg    = 90.0;
    const sky *s    = numbered(&b, 8, 4, d);
    assert_true(look(s, 1, 1e-3, 0).x == 2 * 8 + 3);  /* what looked along +y is at +x */
    assert_true(look(s, 1, -1e-3, 0).x == 2 * 8 + 4); /* further clockwise: to the right */
    d.rotate_deg   = -270.0 - 720.0;
    const sky *too = panorama_of_box(&b, 8, 4, d, NULL);
    assert_true(look(too, 1, -1e-3, 0).x == 2 * 8 + 4);
    file_box_free(&b);
}

TEST(every_direction_finds_the_pixel_of_the_twin)
{
    static const double turns[] = { 0.0, 33.0, 180.0, -401.5 };
    enum { W = 180, H = 91, RUNS = 20000 };
    file_box b = file_box_new();
    for (size_t t = 0; t < sizeof turns / sizeof *turns; t++) {
        panorama_desc d = plain;
        d.rotate_deg    = turns[t];
        const sky *s    = numbered(&b, W, H, d);
        srand(7);
        for (int i = 0; i < RUNS; i++) {
            double z = 2.0 * rand() / RAND_MAX - 1.0, a = 2.0 * M_PI * rand() / RAND_MAX;
            double r = sqrt(1.0 - z * z), x, y, w[3] = { r * sin(a), r * cos(a), z };
            place_of(w, turns[t], W, H, &x, &y);
            if (from_edge(x) < 2e-4 || from_edge(y) < 2e-4) /* two roundings of a turn by 180 */
                continue;
            assert_true(look(s, w[0], w[1], w[2]).x == (float)((int)y * W + (int)x));
        }
    }
    file_box_free(&b);
}

TEST(poles_and_seam_are_found_whatever_the_sign_of_zero)
{
    file_box b = file_box_new();
    enum { W = 64, H = 32 };
    const sky *s = numbered(&b, W, H, plain);
    for (int i = 0; i < 4; i++) {
        double zero = i & 1 ? -0.0 : 0.0, other = i & 2 ? -0.0 : 0.0;
        assert_true(look(s, zero, other, 1).x < W);
        assert_true(look(s, zero, other, -1).x >= W * (H - 1));
        int column = (int)look(s, zero, -1, other).x % W;
        assert_true(column == 0 || column == W - 1);
    }
    /* Within a row of the poles of 1.7 degrees: 1e-3 rad off them, where acos(z) has 4 digits */
    for (double a = 0.01; a < 2.0 * M_PI; a += 0.1) {
        double x = a / (2.0 * M_PI) + 0.5, at = floor((x - floor(x)) * W);
        if (from_edge(x * W) < 1e-3)
            continue;
        assert_true(look(s, 1e-3 * sin(a), 1e-3 * cos(a), 1).x == (float)at);
    }
    file_box_free(&b);
}

TEST(dark_lanes_are_zero_whatever_they_hold)
{
    file_box b   = file_box_new();
    const sky *s = numbered(&b, 8, 4, plain);
    vvec3 wild = vspread((vec3){ NAN, INFINITY, -NAN }), w = vspread((vec3){ 0, 1, 0 });
    vrgb none  = sky_radiance(s, &wild, (vmask){ 0 });
    vmask one  = vlane_index() == 0;
    w          = vselect3(one, w, wild);
    vrgb first = sky_radiance(s, &w, one);
    for (int i = 0; i < LANES; i++) {
        assert_true(lane(none.x, i) == 0.0f && lane(none.y, i) == 0.0f);
        assert_true(lane(first.y, i) == (i ? 0.0f : 1.0f));
    }
    file_box_free(&b);
}

/* ---- how bright ------------------------------------------------------------------------------ */

TEST(a_constant_one_gives_pi_on_level_ground)
{
    file_box b = file_box_new();
    for (int h = 1; h < 40; h += 13) {
        file_box_fill(&b, 2 * h, h, 1.0f, 2.0f, 3.0f);
        notices n = { .a = &b.a };
        panorama_sun sun;
        const sky *s = panorama_of_file(&b, 2 * h, h, plain, &sun, &n);
        assert_near(s->horizontal.x, M_PI, 1e-6); /* a float's rounding */
        assert_near(s->horizontal.y, 2.0 * M_PI, 1e-6);
        assert_near(s->horizontal.z, 3.0 * M_PI, 1e-6);
        assert_false(sun.found);
        assert_int_equal(n.count, 0);
    }
    file_box_free(&b);
}

/* Of pixels as they are looked up: midpoints, 32 a pixel in polar angle. */
static double horizontal_by_lookup(const sky *s, int width, int height)
{
    double sum = 0.0, df = 2.0 * M_PI / width, dt = M_PI / height / 32.0;
    for (int j = 0; j < 16 * height; j++)
        for (int i = 0; i < width; i++) {
            double t = (j + 0.5) * dt, f = (i + 0.5) * df - M_PI;
            sum += (double)look(s, sin(t) * sin(f), sin(t) * cos(f), cos(t)).x * sin(t) * cos(t) *
                   df * dt;
        }
    return sum;
}

TEST(the_horizontal_irradiance_is_the_integral_over_its_pixels)
{
    file_box b = file_box_new();
    for (int h = 8; h <= 9; h++) { /* the horizon between two rows, and through one */
        srand(3);
        for (int i = 0; i < 16 * h; i++)
            b.rgb[0][i] = b.rgb[1][i] = b.rgb[2][i] = (float)rand() / (float)RAND_MAX;
        const sky *s = panorama_of_box(&b, 16, h, plain, NULL);
        /* The midpoint rule is off by (dt)^2 / 6 of a smooth integrand */
        assert_near(s->horizontal.x, horizontal_by_lookup(s, 16, h), 1e-4);
    }
    file_box_free(&b);
}

TEST(scale_multiplies_and_horizontal_is_met)
{
    file_box b = file_box_new();
    file_box_fill(&b, 16, 8, 1.0f, 0.5f, 0.25f);
    for (int i = 0; i < 64; i++)
        b.rgb[0][i] += 0.1f * (float)i;
    panorama_desc d = plain;
    d.scale         = 25.0;
    vec3 one        = look(panorama_of_box(&b, 16, 8, plain, NULL), 0.1, 1, 0.5);
    vec3 scaled     = look(panorama_of_box(&b, 16, 8, d, NULL), 0.1, 1, 0.5);
    assert_near(scaled.x, 25.0 * (double)one.x, 1e-6);
    assert_near(scaled.y, 12.5, 1e-6);
    d.scale      = (double)NAN;
    d.horizontal = 100.0;
    vec3 e       = panorama_of_box(&b, 16, 8, d, NULL)->horizontal;
    assert_near(0.2126 * (double)e.x + 0.7152 * (double)e.y + 0.0722 * (double)e.z, 100.0, 1e-6);
    file_box_free(&b);
}

/* ---- files ----------------------------------------------------------------------------------- */

TEST(alpha_and_other_channels_do_not_count)
{
    file_box b      = file_box_new();
    float colour[3] = { 1e30f, 2e-30f, 0.5f }, nothing = 0.0f, far = 3e38f;
    image_channel c[] = { { "A", &nothing },    { "B", &colour[2] },
                          { "G", &colour[1] },  { "R", &colour[0] },
                          { "Z", &far },        { "halfWidth.Y", &nothing },
                          { "normal.X", &far }, { "albedo.R", &nothing } };
    image im          = { .width = 1, .height = 1, .channel_count = 8, .channels = c };
    assert_true(image_write_exr(b.path, &im, false, NULL, NULL));
    panorama_desc d = plain;
    panorama_sun sun;
    lux_error err = { 0 };
    d.scale       = 1e-3;
    d.path        = b.path;
    const sky *s  = sky_panorama(&b.a, &d, &sun, NULL, &err);
    if (!s)
        fail_msg("%s", err.text);
    assert_near(look(s, 0, 0, 1).x, 1e27, 1e-6); /* neither clamped, nor decoded, nor by alpha */
    assert_near(look(s, 0, 0, 1).y, 2e-33, 1e-6);
    assert_near(look(s, 0, 0, 1).z, 0.5e-3, 1e-6);
    file_box_free(&b);
}

TEST(radiance_pictures_are_read_and_grey_ones)
{
    file_box b = file_box_new();
    /* (m + 0 or 0.5) / 256 2^(e - 128) */
    const sky *s = panorama_of_bytes(
        &b, "hdr",
        "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n\x80\x40\x20\x83\x80\x80\x80\x90", 53);
    assert_near(look(s, -1, 0, 0).x, 4.0, 0.005);
    assert_near(look(s, -1, 0, 0).y, 2.0, 0.01);
    assert_near(look(s, 1, 0, 0).z, 32768.0, 0.005);
    s = panorama_of_bytes(&b, "pfm", "Pf\n1 2\n-1.0\n\0\0\x80\x3f\0\0\0\x40", 20);
    assert_near(look(s, 0, 0, 1).y, 2.0, 0.0); /* rows from below */
    assert_near(look(s, 0, 0, -1).z, 1.0, 0.0);
    file_box_free(&b);
}

TEST(what_is_not_twice_as_wide_as_high_is_noticed)
{
    file_box b = file_box_new();
    notices n  = { .a = &b.a };
    panorama_sun sun;
    file_box_fill(&b, 20, 9, 1.0f, 1.0f, 1.0f);
    panorama_of_file(&b, 20, 9, plain, &sun, &n);
    assert_int_equal(n.count, 1);
    assert_non_null(strstr(n.first->text, "20 x 9 pixels, not twice as wide as high"));
    file_box_free(&b);
}

static void assert_bytes_refused(file_box *b, const char *ending, const char *bytes, size_t size,
                                 const char *why)
{
    lux_error err   = { 0 };
    panorama_desc d = plain;
    panorama_sun sun;
    d.path = file_box_write(b, ending, bytes, size);
    assert_null(sky_panorama(&b->a, &d, &sun, NULL, &err));
    if (strncmp(err.text, d.path, strlen(d.path)) != 0 || !strstr(err.text, why))
        fail_msg("%s", err.text);
}

TEST(files_that_are_no_picture_of_light_are_refused_by_name_and_pixel)
{
    file_box b = file_box_new();
#define PFM "PF\n2 1\n-1.0\n\0\0\x80\x3f\0\0\x80\x3f\0\0\x80\x3f\0\0\x80\x3f\0\0\x80\x3f"
    assert_bytes_refused(&b, "pfm", PFM "\0\0\x80\x7f", 36, "in column 1 of row 0 is a value that");
    assert_bytes_refused(&b, "pfm", PFM "\0\0\xc0\x7f", 36, "in column 1 of row 0 is a value that");
    assert_bytes_refused(&b, "pfm", PFM "\0\0\x80\xbf", 36, "negative pixels");
    assert_bytes_refused(&b, "exr", "text", 4, "cannot be read as a picture");
    assert_bytes_refused(&b, "hdr", "", 0, "cannot be read as a picture");
    assert_bytes_refused(&b, "hdr",
                         "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n+Y 1 +X 1\n\x80\x40\x20\x83", 49,
                         "turned or mirrored");
    file_box_free(&b);
}

/* Pictures that test readers, broken ones among them, where they are. */
TEST(whatever_a_file_holds_it_is_a_sky_or_an_error_of_its_name)
{
    static const char folder[] = "../shared/data/hdr/reader_tests";
    DIR *all                   = opendir(folder);
    for (struct dirent *e; all && (e = readdir(all));) {
        char path[400];
        arena a         = { 0 };
        panorama_desc d = plain;
        lux_error err   = { 0 };
        panorama_sun sun;
        snprintf(path, sizeof path, "%s/%s", folder, e->d_name);
        d.path       = path;
        const sky *s = sky_panorama(&a, &d, &sun, NULL, &err);
        if (!s && strncmp(err.text, path, strlen(path)) != 0)
            fail_msg("%s", err.text);
        if (s) {
            vec3 l = look(s, 0.3, -0.4, 0.5);
            assert_true(isfinite(l.x) && isfinite(l.y) && isfinite(l.z) && l.x >= 0.0f);
        }
        arena_clear(&a);
    }
    if (all)
        closedir(all);
}

TEST(numbers_that_make_no_sense_are_refused)
{
    file_box b = file_box_new();
    file_box_fill(&b, 4, 2, 1e10f, 1e10f, 1e10f);
    file_box_store(&b, 4, 2);
    static const struct {
        double rotate, scale, horizontal;
        const char *why;
    } bad[] = { { HUGE_VAL, 1, 1, "rotated by inf degrees" },
                { 0, 0, 1, "the scale is 0" },
                { 0, -1, 1, "the scale is -1" },
                { 0, 1, -1, "the irradiance of level ground is -1" },
                { 0, 1e25, (double)NAN, "beyond what can be reckoned with" },
                { 0, 1e-45, (double)NAN, "beyond what can be reckoned with" } };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        panorama_desc d = { .path       = b.path,
                            .rotate_deg = bad[i].rotate,
                            .scale      = bad[i].scale,
                            .horizontal = bad[i].horizontal };
        lux_error err   = { 0 };
        panorama_sun sun;
        assert_null(sky_panorama(&b.a, &d, &sun, NULL, &err));
        if (!strstr(err.text, bad[i].why))
            fail_msg("%s", err.text);
    }
    panorama_desc d = plain;
    lux_error err   = { 0 };
    panorama_sun sun;
    file_box_fill(&b, 4, 2, 0.0f, 0.0f, 0.0f);
    file_box_store(&b, 4, 2);
    d.path       = b.path;
    d.horizontal = 5.0;
    assert_null(sky_panorama(&b.a, &d, &sun, NULL, &err));
    assert_non_null(strstr(err.text, "all is black above the horizon"));
    d.horizontal = (double)NAN;
    assert_non_null(sky_panorama(&b.a, &d, &sun, NULL, &err)); /* black alone is no error */
    file_box_free(&b);
}

TEST(without_memory_there_is_an_error)
{
    file_box b      = file_box_new();
    panorama_desc d = plain;
    lux_error err   = { 0 };
    arena none      = { 0 };
    panorama_sun sun;
    file_box_fill(&b, 16, 8, 1.0f, 1.0f, 1.0f);
    file_box_store(&b, 16, 8);
    d.path        = b.path;
    memory_is_out = true;
    const sky *s  = sky_panorama(&none, &d, &sun, NULL, &err);
    memory_is_out = false;
    assert_null(s);
    assert_int_equal(err.code, ERR_MEMORY);
    file_box_free(&b);
}

/* ---- negative pixels ------------------------------------------------------------------------- */

TEST(negative_swings_beside_a_bright_pixel_keep_its_energy)
{
    file_box b = file_box_new();
    enum { W = 64, H = 32 };
    file_box_fill(&b, W, H, 1.0f, 1.0f, 1.0f);
    for (int c = 0; c < 3; c++) {
        b.rgb[c][7 * W]         = 50.0f; /* at the seam */
        b.rgb[c][7 * W + W - 1] = -6.0f;
        b.rgb[c][8 * W + 1]     = -2.0f;
    }
    const sky *s = panorama_of_box(&b, W, H, plain, NULL);
    double got = 0.0, want = 0.0;
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++) {
            double f = (x + 0.5) * 2.0 * M_PI / W - M_PI, t = (y + 0.5) * M_PI / H;
            double angle = cos(y * M_PI / H) - cos((y + 1) * M_PI / H);
            vec3 l       = look(s, sin(t) * sin(f), sin(t) * cos(f), cos(t));
            assert_true(l.x > 0.5f); /* no hole is left */
            got += angle * (double)l.x;
            want += angle * (double)b.rgb[0][y * W + x];
        }
    assert_near(got, want, 1e-6); /* roundings of floats */
    file_box_free(&b);
}

TEST(a_negative_pixel_that_nothing_explains_is_an_error)
{
    file_box b      = file_box_new();
    panorama_desc d = plain;
    lux_error err   = { 0 };
    panorama_sun sun;
    file_box_fill(&b, 64, 32, 1.0f, 1.0f, 1.0f);
    b.rgb[1][5 * 64 + 40] = -0.75f;
    file_box_store(&b, 64, 32);
    d.path = b.path;
    assert_null(sky_panorama(&b.a, &d, &sun, NULL, &err));
    assert_non_null(strstr(err.text, "the pixel in column 40 of row 5 is negative: 1 -0.75 1"));
    file_box_free(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_middle_looks_along_y_and_right_of_it_is_x),
        cmocka_unit_test(rotate_turns_it_clockwise_seen_from_above),
        cmocka_unit_test(every_direction_finds_the_pixel_of_the_twin),
        cmocka_unit_test(poles_and_seam_are_found_whatever_the_sign_of_zero),
        cmocka_unit_test(dark_lanes_are_zero_whatever_they_hold),
        cmocka_unit_test(a_constant_one_gives_pi_on_level_ground),
        cmocka_unit_test(the_horizontal_irradiance_is_the_integral_over_its_pixels),
        cmocka_unit_test(scale_multiplies_and_horizontal_is_met),
        cmocka_unit_test(alpha_and_other_channels_do_not_count),
        cmocka_unit_test(radiance_pictures_are_read_and_grey_ones),
        cmocka_unit_test(what_is_not_twice_as_wide_as_high_is_noticed),
        cmocka_unit_test(files_that_are_no_picture_of_light_are_refused_by_name_and_pixel),
        cmocka_unit_test(whatever_a_file_holds_it_is_a_sky_or_an_error_of_its_name),
        cmocka_unit_test(numbers_that_make_no_sense_are_refused),
        cmocka_unit_test(without_memory_there_is_an_error),
        cmocka_unit_test(negative_swings_beside_a_bright_pixel_keep_its_energy),
        cmocka_unit_test(a_negative_pixel_that_nothing_explains_is_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
