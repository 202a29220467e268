/* tests/unit/test_camera.c -- the round projections: where the places of a picture look. Directions
 * are compared with those of libm in double, to 1e-6: sine and cosine in packets are good to 1e-7.
 */
#include "sim/camera.h"
#include "tests/folder.h"
#include "tests/study_text.h"
#include "tests/test.h"

#include <stdio.h>

static arena memory;

/* The camera of the one view with these keys, in a room. */
static camera camera_of(const char *keys)
{
    char yaml[600];
    camera c;
    lux_error err = { 0 };
    snprintf(yaml, sizeof yaml,
             "lux4: 1\nroom: {size: [4, 3, 2], reflectance: 0.5}\n"
             "views: [{name: v, %s}]\n",
             keys);
    const scene *s = scene_of_text(&memory, yaml);
    if (!camera_of_view(s, &s->study->views[0], &c, &err))
        fail_msg("%s", err.text);
    return c;
}

static void assert_looks(const camera *c, double x, double y, double to_x, double to_y, double to_z)
{
    vray ray          = camera_ray(c, vsplat((float)x), vsplat((float)y));
    const double w[3] = { (double)lane(ray.direction.x, 0), (double)lane(ray.direction.y, 0),
                          (double)lane(ray.direction.z, 0) };
    double dx = w[0] - to_x, dy = w[1] - to_y, dz = w[2] - to_z;
    if (sqrt(dx * dx + dy * dy + dz * dz) > 1e-6)
        fail_msg("%g %g: %g %g %g, not %g %g %g", x, y, w[0], w[1], w[2], to_x, to_y, to_z);
    assert_true(lane(ray.reach, 0) == INFINITY);
}

static bool sees(const camera *c, double x, double y)
{
    return vall(camera_sees(c, vsplat((float)x), vsplat((float)y)));
}

/* ---- fisheye --------------------------------------------------------------------------------- */

TEST(a_fisheye_is_equidistant_about_its_target)
{
    camera c =
        camera_of("eye: [1, 1, 1], target: [1, 2, 1], projection: fisheye, size: [200, 200]");
    assert_looks(&c, 100, 100, 0, 1, 0);
    for (double r = 5.0; r <= 100.0; r += 19.0)
        for (double turn = 0.1; turn < 6.3; turn += 0.7) {
            double angle = 0.5 * M_PI * r / 100.0; /* from the axis */
            assert_looks(&c, 100.0 + r * cos(turn), 100.0 - r * sin(turn), sin(angle) * cos(turn),
                         cos(angle), sin(angle) * sin(turn));
        }
    assert_looks(&c, 200, 100, 1, 0, 0); /* right is right, up is up */
    assert_looks(&c, 100, 0, 0, 0, 1);
}

TEST(looking_up_it_has_north_up_and_east_to_the_left)
{
    camera c = camera_of("eye: [1, 1, 1], target: [1, 1, 2], projection: fisheye, size: [64, 64]");
    assert_looks(&c, 32, 32, 0, 0, 1);
    assert_looks(&c, 32, 0, 0, 1, 0);
    assert_looks(&c, 0, 32, 1, 0, 0);
}

TEST(a_fisheye_sees_the_largest_circle_in_the_picture)
{
    camera wide =
        camera_of("eye: [1, 1, 1], target: [1, 2, 1], projection: fisheye, size: [300, 100]");
    camera high =
        camera_of("eye: [1, 1, 1], target: [1, 2, 1], projection: fisheye, size: [100, 300]");
    assert_true(sees(&wide, 150, 50) && sees(&wide, 199.9, 50) && sees(&wide, 150, 0.1));
    assert_false(sees(&wide, 200.1, 50) || sees(&wide, 99.9, 50) || sees(&wide, 186, 86));
    assert_true(sees(&wide, 185, 85));
    assert_true(sees(&high, 50, 199.9) && !sees(&high, 50, 200.1) && !sees(&high, 50, 99.0));
    assert_looks(&wide, 200, 50, 1, 0, 0);
    assert_looks(&high, 50, 100, 0, 0, 1);
}

/* ---- panorama -------------------------------------------------------------------------------- */

/* Whose middle column looks at that azimuth, clockwise from +y. */
static void assert_is_panorama(const camera *c, double azimuth)
{
    for (int row = 1; row < 10; row++)
        for (int column = 0; column <= 20; column++) {
            double a = azimuth + 2.0 * M_PI * (column / 20.0 - 0.5), t = M_PI * row / 10.0;
            assert_looks(c, c->width * column / 20.0, c->height * row / 10.0, sin(t) * sin(a),
                         sin(t) * cos(a), cos(t));
        }
    assert_looks(c, 3, 0, 0, 0, 1);
    assert_looks(c, 3, c->height, 0, 0, -1);
    assert_true(sees(c, 0, 0) && sees(c, c->width, c->height));
}

TEST(a_panorama_goes_clockwise_around_the_zenith)
{
    camera c =
        camera_of("eye: [1, 1, 1], target: [1, 2, 1], projection: panorama, size: [400, 200]");
    assert_is_panorama(&c, 0.0);
    c = camera_of("eye: [1, 1, 1], target: [2, 1, 1], projection: panorama, size: [90, 80]");
    assert_is_panorama(&c, 0.5 * M_PI);
}

TEST(it_stays_level_wherever_its_target_is)
{
    camera c =
        camera_of("eye: [1, 1, 1], target: [2, 2, 7], projection: panorama, size: [400, 200]");
    assert_is_panorama(&c, 0.25 * M_PI);
    c = camera_of("eye: [1, 1, 1], target: [1, 1, 0], projection: panorama, size: [400, 200]");
    assert_is_panorama(&c, 0.0);
}

/* ---- both ------------------------------------------------------------------------------------ */

/* The angle between the rays through neighbouring places about the middle. */
static double angle_down(const camera *c)
{
    vray above = camera_ray(c, vsplat(0.5f * (float)c->width), vsplat(0.5f * (float)c->height - 1));
    vray below = camera_ray(c, vsplat(0.5f * (float)c->width), vsplat(0.5f * (float)c->height + 1));
    vvec3 off  = vsub(above.direction, below.direction);
    return asin(0.5 * (double)lane(vlength(off), 0)); /* half of that of two pixels */
}

TEST(the_spread_is_the_angle_of_a_pixel_in_the_middle)
{
    static const char *const keys[] = {
        "eye: [1, 1, 1], target: [1, 2, 1], projection: fisheye, size: [300, 100]",
        "eye: [1, 1, 1], target: [1, 2, 1], projection: fisheye, size: [100, 300]",
        "eye: [1, 1, 1], target: [1, 2, 1], projection: panorama, size: [400, 200]",
        "eye: [1, 1, 1], target: [1, 2, 1], fov: 1, size: [400, 200]",
    };
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++) {
        camera c = camera_of(keys[i]);
        assert_near(c.spread, angle_down(&c), 1e-4); /* of differences of floats near 1 */
    }
}

TEST(without_a_size_round_views_are_not_squeezed)
{
    camera f = camera_of("eye: [1, 1, 1], target: [1, 2, 1], projection: fisheye");
    camera p = camera_of("eye: [1, 1, 1], target: [1, 2, 1], projection: panorama");
    assert_true(f.width == 768 && f.height == 768);
    assert_true(p.width == 1024 && p.height == 512);
}

TEST(round_views_have_no_opening_and_no_width)
{
    static const broken_study table[] = {
        { "views: [{name: a, eye: [0,0,0], target: [1,0,0], projection: fisheye, fov: 90}]",
          "2:76: `fov` does not go with fisheye, which shows 180 degrees" },
        { "views: [{name: a, eye: [0,0,0], target: [1,0,0], projection: panorama, width: 3}]",
          "2:79: `width` does not go with panorama, which shows all around" },
    };
    ALL_REFUSED(table, ERR_FORMAT);
}

static int forget(void **state)
{
    (void)state;
    arena_clear(&memory);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_fisheye_is_equidistant_about_its_target),
        cmocka_unit_test(looking_up_it_has_north_up_and_east_to_the_left),
        cmocka_unit_test(a_fisheye_sees_the_largest_circle_in_the_picture),
        cmocka_unit_test(a_panorama_goes_clockwise_around_the_zenith),
        cmocka_unit_test(it_stays_level_wherever_its_target_is),
        cmocka_unit_test(the_spread_is_the_angle_of_a_pixel_in_the_middle),
        cmocka_unit_test(without_a_size_round_views_are_not_squeezed),
        cmocka_unit_test(round_views_have_no_opening_and_no_width),
    };
    return cmocka_run_group_tests(tests, NULL, forget);
}
