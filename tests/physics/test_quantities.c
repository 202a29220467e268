/* tests/physics/test_quantities.c -- vertical, cylindrical and semicylindrical illuminance.
 *
 * With e the angle of the light to the vertical and a its azimuth from where the sensor faces, a
 * point of I cd at the distance d gives
 *
 *     E_v  = I sin e cos a / d^2             E_cyl = I sin e / (pi d^2)
 *     E_sc = I sin e (1 + cos a) / (pi d^2)
 *
 * (EN 12464-1, EN 13201-3), and an even luminance L all around, with the integral of sin e over the
 * sphere, pi^2: E_v = E_cyl = E_sc = pi L.
 */
#include "core/color.h"
#include "tests/box.h"
#include "tests/lab.h"
#include "tests/test.h"

enum { N = 6 };

static const lab_probe probes[N] = {
    { { 0, 0, 0 }, { 0, 0, 1 } },  { { 1, 0.5, 1 }, { 0, 0, 1 } },
    { { -2, 1, 3 }, { 0, 0, 1 } }, { { 0.3, -0.4, 5 }, { 0, 0, 1 } },
    { { 2, 2, 2 }, { 0, 0, 1 } },  { { 4, -1, 2.5 }, { 1, 0, 0 } },
};
static const dvec3 lamp   = { 1, 2, 2.5 };
static const dvec3 facing = { 0.6, 0.8, 0 };

/* 1000 cd at each sensor; 0: E_v, 1: E_cyl, 2: E_sc */
static double wanted(dvec3 at, int which)
{
    dvec3 to = d3_sub(lamp, at);
    double d = d3_length(to), level = hypot(to.x, to.y);
    double sine = level / d, cos_a = d3_dot(to, facing) / level;
    double e = 1000.0 * sine / (d * d);
    return which == 0 ? e * fmax(cos_a, 0.0) : which == 1 ? e / M_PI : e * (1.0 + cos_a) / M_PI;
}

static const char *const quantity[] = { ", quantity: vertical, facing: [3, 4, 0]",
                                        ", quantity: cylindrical",
                                        ", quantity: semicylindrical, facing: [3, 4, 0]" };

TEST(a_point_gives_its_closed_forms)
{
    for (int q = 0; q < 3; q++) {
        lab l;
        lab_open(&l);
        grid_result r;
        lab_measure(&l, "lights: [{type: point, at: [1, 2, 2.5], intensity: 1000}]", quantity[q],
                    probes, N, &(run_options){ 0 }, &r);
        for (int i = 0; i < N; i++)
            assert_near(r.illuminance[i], wanted(probes[i].at, q), 1e-5);
        lab_close(&l);
    }
}

/* A small sphere of light, sampled, of the same candelas: off by its size, (0.01 / d)^2. */
TEST(a_small_luminaire_gives_those_of_a_point)
{
    for (int q = 0; q < 3; q++) {
        lab l;
        lab_open(&l);
        double want[N];
        for (int i = 0; i < N; i++)
            want[i] = wanted(probes[i].at, q);
        lab_write(&l, "globe.ies",
                  "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 1 1 2 -0.02 -0.02 -0.02\n1 1 0\n"
                  "0 90 180\n0\n1000 1000 1000\n");
        grid_result r;
        lab_measure(&l, "luminaires: [{photometry: globe.ies, at: [1, 2, 2.5]}]", quantity[q],
                    probes, N, &(run_options){ .accuracy = 0.01 }, &r);
        lab_check(quantity[q], &r, want, 2e-4, 0.01);
        lab_close(&l);
    }
}

/* A large square right above: of every sensor, by quadrature over its area. */
static double of_square(dvec3 at, int which)
{
    enum { SIDE = 400 };
    double sum = 0.0;
    for (int i = 0; i < SIDE * SIDE; i++) {
        double x = -1.0 + 2.0 * (i % SIDE + 0.5) / SIDE, y = -1.0 + 2.0 * (i / SIDE + 0.5) / SIDE;
        dvec3 to  = d3_sub((dvec3){ x, y, 3 }, at);
        double d2 = d3_dot(to, to), d = sqrt(d2);
        double dw = to.z / (d * d2), sine = hypot(to.x, to.y) / d;
        double face = d3_dot(to, facing) / d;
        sum += dw * (which == 0   ? fmax(face, 0.0)
                     : which == 1 ? sine / M_PI
                                  : (sine + face) / M_PI);
    }
    return 800.0 * sum * 4.0 / (SIDE * SIDE);
}

TEST(a_large_rectangle_gives_what_quadrature_does)
{
    enum { PLACES = 3 };
    const lab_probe p[PLACES] = { { { 0.2, 0.1, 1.2 }, { 0, 0, 1 } },
                                  { { -1.5, -1, 1.2 }, { 0, 0, 1 } },
                                  { { 3, 1, 0.5 }, { 0, 0, 1 } } };
    for (int q = 0; q < 3; q++) {
        lab l;
        lab_open(&l);
        double want[PLACES];
        for (int i = 0; i < PLACES; i++)
            want[i] = of_square(p[i].at, q);
        grid_result r;
        lab_measure(&l, "lights: [{type: rect, at: [0, 0, 3], size: [2, 2], luminance: 800}]",
                    quantity[q], p, PLACES, &(run_options){ .accuracy = 0.01 }, &r);
        lab_check(quantity[q], &r, want, 1e-3, 0.01); /* quadrature: kinks at facing . w = 0 */

        /* The same square as a surface that glows */
        const quad q2 = { { { -1, -1, 3 }, { 1, -1, 3 }, { 1, 1, 3 }, { -1, 1, 3 } } };
        lab_quads(&l, "glow.gltf", &q2, 1, lab_glow(&l, 800.0));
        lab_measure(&l, "scene: glow.gltf", quantity[q], p, PLACES,
                    &(run_options){ .accuracy = 0.01 }, &r);
        lab_check(quantity[q], &r, want, 1e-3, 0.01);
        lab_close(&l);
    }
}

/* A closed box that glows, and gives back a share of what it gets: L = L_e / (1 - rho). */
static void surrounded(double rho, double accuracy)
{
    static const study_quantity of[] = { QUANTITY_VERTICAL, QUANTITY_CYLINDRICAL,
                                         QUANTITY_SEMICYLINDRICAL };
    float back                       = (float)rho;
    vec3 all = { back, back, back }, glow = { 1, 1, 1 };
    const vec3 reflectance[] = { all, all, all }, emission[] = { glow, glow, glow };
    for (int q = 0; q < 3; q++) {
        arena a        = { 0 };
        const scene *s = box_scene(&a, (dvec3){ 5, 3, 2.5 }, reflectance, emission, true);
        study_grid g   = { .name     = "g",
                           .origin   = { 1, 1, 0.8 },
                           .u        = { 3, 0, 0 },
                           .v        = { 0, 1, 0 },
                           .spacing  = 1,
                           .quantity = of[q],
                           .facing   = facing };
        grid_result r;
        run_options o = { .accuracy = accuracy, .deadline = HUGE_VAL, .seed = 1, .threads = 1 };
        assert_true(grid_run(&a, s, &g, &o, &r, NULL));
        double e              = M_PI * LUMENS_PER_WATT / (1.0 - (double)back);
        const double want[16] = { e, e, e, e, e, e, e, e };
        lab_check(grid_quantity_name(of[q]), &r, want, 1e-5, accuracy);
        arena_clear(&a);
    }
}

TEST(all_are_pi_l_within_an_even_luminance) { surrounded(0.0, 0.005); }
TEST(all_are_pi_l_in_a_furnace) { surrounded(0.7, 0.01); }

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_point_gives_its_closed_forms),
        cmocka_unit_test(a_small_luminaire_gives_those_of_a_point),
        cmocka_unit_test(a_large_rectangle_gives_what_quadrature_does),
        cmocka_unit_test(all_are_pi_l_within_an_even_luminance),
        cmocka_unit_test(all_are_pi_l_in_a_furnace),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
