/* tests/physics/test_furnace.c -- enclosures whose light is known exactly, whatever their shape.
 *
 * A closed enclosure whose every surface emits L_e and reflects rho has the radiance
 * L = L_e / (1 - rho) everywhere: L = L_e + rho L. A closed room of one reflectance with a lamp of
 * flux Phi anywhere has, averaged over its surface S, E = Phi / (S (1 - rho)): energy balance (CIE
 * 171:2006, 5.8). Bounce limits and biased roulette show here.
 */
#include "core/color.h"
#include "tests/box.h"
#include "tests/folder.h"
#include "tests/test.h"

#include <stdio.h>
#include <string.h>

/* Within the interval that is claimed, stretched from 95 % to 99.9 % (t of 15 degrees of freedom),
 * and within the accuracy asked for, stretched alike. */
static void assert_within(double got, double want, double half_width, double accuracy)
{
    double stretch = 4.0728 / 2.1314;
    if (!(fabs(got - want) <= stretch * half_width + 1e-5 * want))
        fail_msg("%.9g is not %.9g +- %.3g", got, want, half_width);
    assert_true(half_width <= accuracy * want);
}

static void glowing_box(double rho, double accuracy)
{
    arena a  = { 0 };
    float r  = (float)rho;
    vec3 all = { r, r, r }, glow = { 1, 1, 1 };
    const vec3 reflectance[] = { all, all, all }, emission[] = { glow, glow, glow };
    const scene *s = box_scene(&a, (dvec3){ 5, 3, 2.5 }, reflectance, emission, true);
    study_grid g   = {
          .name = "g", .origin = { 1, 1, 0.8 }, .u = { 3, 0, 0 }, .v = { 0, 1, 0 }, .spacing = 1
    };
    run_options o = { .accuracy = accuracy, .deadline = HUGE_VAL, .seed = 1, .threads = 1 };
    grid_result got;
    assert_true(grid_run(&a, s, &g, &o, &got, NULL));
    double want = M_PI * LUMENS_PER_WATT / (1.0 - (double)r);
    for (int k = 0; k < got.sensor_count; k++) {
        assert_within(got.illuminance[k], want, got.half_width[k], accuracy);
        /* What shines straight at it is found by light and by ray: its noise is in that of all */
        assert_within(got.direct[k], M_PI * LUMENS_PER_WATT, got.half_width[k],
                      accuracy / (1.0 - rho));
    }
    arena_clear(&a);
}

TEST(a_glowing_box_of_20_percent_is_exact) { glowing_box(0.2, 0.005); }
TEST(a_glowing_box_of_50_percent_is_exact) { glowing_box(0.5, 0.005); }
TEST(a_glowing_box_of_80_percent_is_exact) { glowing_box(0.8, 0.01); }
TEST(a_glowing_box_of_95_percent_is_exact) { glowing_box(0.95, 0.01); }
TEST(a_glowing_box_of_99_percent_is_exact) { glowing_box(0.99, 0.02); }

/* The illuminance of a 4 m cube's six faces, averaged: sensors on the faces, looking inward. The
 * lamp off the centre lights some corners more than others; the mean does not care. */
static double mean_over_walls(double rho, const char *lamp, double accuracy, double *half_width)
{
    arena a = { 0 };
    char text[4096];
    snprintf(text, sizeof text,
             "lux4: 1\nroom: {size: [4, 4, 4], reflectance: %g}\n"
             "lights: [{type: point, at: %s, lumens: 10000}]\n"
             "grids:\n"
             "  - {name: floor, origin: [0, 0, 0], u: [4, 0, 0], v: [0, 4, 0], spacing: 0.2}\n"
             "  - {name: ceiling, origin: [0, 0, 4], u: [0, 4, 0], v: [4, 0, 0], spacing: 0.2}\n"
             "  - {name: south, origin: [0, 0, 0], u: [0, 0, 4], v: [4, 0, 0], spacing: 0.2}\n"
             "  - {name: north, origin: [0, 4, 0], u: [4, 0, 0], v: [0, 0, 4], spacing: 0.2}\n"
             "  - {name: west, origin: [0, 0, 0], u: [0, 4, 0], v: [0, 0, 4], spacing: 0.2}\n"
             "  - {name: east, origin: [4, 0, 0], u: [0, 0, 4], v: [0, 4, 0], spacing: 0.2}\n",
             rho, lamp);
    const scene *s = scene_of_text(&a, text);
    double sum     = 0.0;
    *half_width    = 0.0;
    for (int g = 0; g < s->study->grid_count; g++) {
        grid_result r;
        grid_of_scene(&a, s, g, &(run_options){ .accuracy = accuracy, .seed = 7 }, &r);
        sum += r.average / 6.0;
        *half_width += independent_half_width(&r) / 6.0;
    }
    arena_clear(&a);
    return sum;
}

/* Expected: 10000 / (96 (1 - rho)) lx. Midpoints on 20 x 20 cells a face are within 1e-3 of the
 * integral of the direct light for these lamps. */
static void lamp_in_a_cube(double rho, const char *lamp)
{
    double half_width, got = mean_over_walls(rho, lamp, 0.2, &half_width);
    double want = 10000.0 / (96.0 * (1.0 - (double)(float)rho));
    if (!(fabs(got - want) <= 1e-3 * want + 2.0 * half_width))
        fail_msg("rho %g, lamp at %s: %.6g lx, not %.6g", rho, lamp, got, want);
}

TEST(a_lamp_in_a_black_cube_loses_nothing) { lamp_in_a_cube(0.0, "[2, 2, 2]"); }
TEST(a_lamp_in_the_middle_of_a_cube_balances) { lamp_in_a_cube(0.5, "[2, 2, 2]"); }
TEST(a_lamp_off_the_middle_of_a_cube_balances) { lamp_in_a_cube(0.8, "[1.3, 2.4, 2.9]"); }

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_glowing_box_of_20_percent_is_exact),
        cmocka_unit_test(a_glowing_box_of_50_percent_is_exact),
        cmocka_unit_test(a_glowing_box_of_80_percent_is_exact),
        cmocka_unit_test(a_glowing_box_of_95_percent_is_exact),
        cmocka_unit_test(a_glowing_box_of_99_percent_is_exact),
        cmocka_unit_test(a_lamp_in_a_black_cube_loses_nothing),
        cmocka_unit_test(a_lamp_in_the_middle_of_a_cube_balances),
        cmocka_unit_test(a_lamp_off_the_middle_of_a_cube_balances),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
