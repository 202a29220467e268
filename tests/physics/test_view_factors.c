/* tests/physics/test_view_factors.c -- glowing walls against published view factors.
 *
 * A black wall that sees a black wall of radiance L receives, on average, E = pi L F. Published: J.
 * R. Howell, A Catalog of Radiation Heat Transfer Configuration Factors, C-11 (identical, parallel,
 * directly opposed rectangles) and C-14 (two rectangles with a common edge, at right angles).
 */
#include "core/color.h"
#include "tests/box.h"
#include "tests/folder.h"
#include "tests/test.h"

/* C-11: a x b, c apart. */
static double opposed(double a, double b, double c)
{
    double x = a / c, y = b / c, x2 = 1 + x * x, y2 = 1 + y * y;
    return 2.0 / (M_PI * x * y) *
           (0.5 * log(x2 * y2 / (x2 + y * y)) + x * sqrt(y2) * atan(x / sqrt(y2)) +
            y * sqrt(x2) * atan(y / sqrt(x2)) - x * atan(x) - y * atan(y));
}

/* C-14: from a rectangle l x w to one of l x h, the edge l in common. */
static double at_right_angles(double l, double w, double h)
{
    double H = h / l, W = w / l, s = H * H + W * W;
    double logs = log((1 + W * W) * (1 + H * H) / (1 + s)) +
                  W * W * log(W * W * (1 + s) / ((1 + W * W) * s)) +
                  H * H * log(H * H * (1 + s) / ((1 + H * H) * s));
    return (W * atan(1 / W) + H * atan(1 / H) - sqrt(s) * atan(1 / sqrt(s)) + 0.25 * logs) /
           (M_PI * W);
}

/* The mean over a grid on one wall of a black box, in units of pi L, with its half width. */
static double mean_factor(const vec3 emission[ROOM_MATERIALS], dvec3 size, study_grid g,
                          double *half)
{
    arena a             = { 0 };
    const vec3 black[3] = { { 0 } };
    const scene *s      = box_scene(&a, size, black, emission, true);
    run_options o       = { .accuracy = 0.02, .deadline = HUGE_VAL, .seed = 3, .threads = 1 };
    grid_result r;
    g.name = "g";
    assert_true(grid_run(&a, s, &g, &o, &r, NULL));
    for (int k = 0; k < r.sensor_count; k++)
        assert_near(r.indirect[k], 0.0, 1e-6); /* black walls pass nothing on */
    double unit = M_PI * LUMENS_PER_WATT, mean = r.average / unit;
    *half = independent_half_width(&r) / unit;
    arena_clear(&a);
    return mean;
}

/* The midpoint rule on 40 cells a side is within 2e-4 of these means. */
static void assert_factor(double got, double want, double half)
{
    if (!(fabs(got - want) <= 5e-4 * want + 2.0 * half))
        fail_msg("view factor %.6f, published %.6f", got, want);
}

TEST(published_values_of_the_formulas)
{
    assert_near(opposed(1, 1, 1), 0.199825, 1e-5); /* the cube's, as tabulated */
    assert_near(at_right_angles(1, 1, 1), 0.200044, 1e-5);
    assert_near(opposed(2, 2, 1), 0.415253, 1e-5);
}

TEST(parallel_plates_see_each_other_as_published)
{
    const vec3 emission[3] = { [ROOM_FLOOR] = { 1, 1, 1 } };
    double half, got;
    study_grid lid = { .origin = { 0, 0, 1 }, .u = { 0, 2, 0 }, .v = { 2, 0, 0 }, .spacing = 0.05 };
    got            = mean_factor(emission, (dvec3){ 2, 2, 1 }, lid, &half);
    assert_factor(got, opposed(2, 2, 1), half);
}

TEST(a_rectangular_cavity_fills_as_published)
{
    const vec3 emission[3] = { [ROOM_FLOOR] = { 1, 1, 1 } };
    dvec3 size             = { 3, 2, 1.5 };
    double half, got;
    study_grid lid = {
        .origin = { 0, 0, 1.5 }, .u = { 0, 2, 0 }, .v = { 3, 0, 0 }, .spacing = 0.06
    };
    study_grid wall = {
        .origin = { 0, 0, 0 }, .u = { 0, 0, 1.5 }, .v = { 3, 0, 0 }, .spacing = 0.06
    };
    got = mean_factor(emission, size, lid, &half);
    assert_factor(got, opposed(3, 2, 1.5), half);
    got = mean_factor(emission, size, wall, &half); /* of the wall 3 x 1.5 to the floor 3 x 2 */
    assert_factor(got, at_right_angles(3, 1.5, 2), half);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(published_values_of_the_formulas),
        cmocka_unit_test(parallel_plates_see_each_other_as_published),
        cmocka_unit_test(a_rectangular_cavity_fills_as_published),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
