/* tests/hard/test_transport_hard.c -- mirrors, panes and lamps that touch, and scenes that are
 * tiny, huge or far away, against closed forms: images behind mirrors, Lambert's formula, furnaces.
 */
#include "tests/gltf_text.h"
#include "tests/slab.h"
#include "tests/test.h"

#include <stdlib.h>

static lab l;

static int prepare(void **state)
{
    (void)state;
    lab_open(&l);
    return 0;
}

static int forget(void **state)
{
    (void)state;
    lab_close(&l);
    return 0;
}

static void assert_lux(const char *what, const char *yaml, const lab_probe *p, int count,
                       const double *want)
{
    grid_result r;
    lab_measure(&l, yaml, NULL, p, count, &(run_options){ .accuracy = 0.02 }, &r);
    for (int k = 0; k < count; k++)
        assert_true(isfinite(r.illuminance[k]) && r.direct[k] >= 0.0 && r.indirect[k] >= 0.0);
    lab_check(what, &r, want, 1e-3, 0.02);
}

/* A rectangle that is square to an axis: 0, 1, 2. */
static quad square_to(int axis, double at, const double low[2], const double high[2])
{
    const double c[4][2] = {
        { low[0], low[1] }, { high[0], low[1] }, { high[0], high[1] }, { low[0], high[1] }
    };
    quad q;
    for (int i = 0; i < 4; i++)
        q.corner[i] = axis == 0   ? (dvec3){ at, c[i][0], c[i][1] }
                      : axis == 1 ? (dvec3){ c[i][0], at, c[i][1] }
                                  : (dvec3){ c[i][0], c[i][1], at };
    return q;
}

static void write_mirror(const char *name, int axis, double at, double reach)
{
    quad q = square_to(axis, at, (double[]){ -reach, -reach }, (double[]){ reach, reach });
    lab_quads(&l, name, &q, 1, "\"name\":\"Mirror\"");
}

static const char mirror_wall[] = "materials: [{match: Mirror, mirror: 0.9}]\n";

/* ---- at the mirror --------------------------------------------------------------------------- */

/* A panel over it; what the mirror sends back leaves the sensor. */
TEST(a_sensor_on_a_mirror_has_what_falls_on_it)
{
    const dvec3 panel[4] = { { 1, 1, 2.5 }, { 3, 1, 2.5 }, { 3, 3, 2.5 }, { 1, 3, 2.5 } };
    const lab_probe p[]  = { { { 0, 2, 1 }, { 1, 0, 0 } }, { { 0, -1, 2.4 }, { 1, 0, 0 } } };
    double want[2];
    write_mirror("one.gltf", 0, 0.0, 30.0);
    for (int i = 0; i < 2; i++)
        want[i] = 1000.0 * polygon_lux(panel, 4, p[i].at, p[i].normal);
    assert_lux("on a mirror",
               text_of(&l.a,
                       "scene: one.gltf\n%slights: [{type: rect, at: [2, 2, 2.5], aim: [0, 0, "
                       "-1], size: [2, 2], luminance: 1000}]",
                       mirror_wall),
               p, 2, want);
}

/* It and its image are one panel, of two halves. */
TEST(a_lamp_that_touches_a_mirror_is_as_long_again)
{
    const dvec3 panel[4] = { { 0, 1, 2.5 }, { 2, 1, 2.5 }, { 2, 3, 2.5 }, { 0, 3, 2.5 } };
    const dvec3 image[4] = { { -2, 1, 2.5 }, { 0, 1, 2.5 }, { 0, 3, 2.5 }, { -2, 3, 2.5 } };
    const lab_probe p[]  = { { { 1, 2, 0 }, { 0, 0, 1 } },
                             { { 0.01, 2, 2 }, { 0, 0, 1 } },
                             { { 2, 1, 1 }, { -1, 0, 0 } } };
    double want[3];
    write_mirror("one.gltf", 0, 0.0, 30.0);
    for (int i = 0; i < 3; i++)
        want[i] = 1000.0 * (polygon_lux(panel, 4, p[i].at, p[i].normal) +
                            0.9 * polygon_lux(image, 4, p[i].at, p[i].normal));
    assert_lux("touching",
               text_of(&l.a,
                       "scene: one.gltf\n%slights: [{type: rect, at: [1, 2, 2.5], aim: [0, 0, "
                       "-1], size: [2, 2], luminance: 1000}]",
                       mirror_wall),
               p, 3, want);
}

/* A glowing sheet with both sides, seen eight times. Nothing stands between: all lies in z = +-0.5,
 * and the sensors between those. */
TEST(a_lamp_in_the_corner_of_three_mirrors_has_seven_images)
{
    quad glow           = square_to(2, 0.5, (double[]){ 0.1, 0.1 }, (double[]){ 0.9, 0.7 });
    const lab_probe p[] = { { { 1.5, 1.2, 0.3 }, { -0.6, -0.8, 0 } },
                            { { 0.4, 0.9, 0.1 }, { 0, 0, 1 } } };
    double want[2]      = { 0 };
    const char *name[3] = { "x.gltf", "y.gltf", "z.gltf" };
    for (int axis = 0; axis < 3; axis++)
        write_mirror(name[axis], axis, 0.0, 30.0);
    lab_quads(&l, "glow.gltf", &glow, 1, lab_glow(&l, 1000.0));
    for (int m = 0; m < 8; m++)
        for (int i = 0; i < 2; i++) {
            dvec3 c[4];
            for (int k = 0; k < 4; k++)
                c[k] = (dvec3){ m & 1 ? -glow.corner[k].x : glow.corner[k].x,
                                m & 2 ? -glow.corner[k].y : glow.corner[k].y,
                                m & 4 ? -glow.corner[k].z : glow.corner[k].z };
            double worth = pow(0.9, (m & 1) + (m >> 1 & 1) + (m >> 2));
            want[i] += 1000.0 * worth * polygon_lux(c, 4, p[i].at, p[i].normal);
        }
    assert_lux("three mirrors",
               text_of(&l.a, "scene: [x.gltf, y.gltf, z.gltf, glow.gltf]\n%s", mirror_wall), p, 2,
               want);
}

/* Two mirrors 1 mm apart, 5 mm above the sensor between them, under a wide glow: unfolded, gap k of
 * a row is seen by way of |k| reflections. */
TEST(mirrors_a_millimetre_apart_show_a_row_of_gaps)
{
    const double gap = 1e-3, above = 5e-3;
    quad side[2], bright           = quad_level(0, 0, 0.02, 4);
    for (int i = 0; i < 2; i++)
        side[i] = square_to(0, gap * i, (double[]){ -1, -above }, (double[]){ 1, above });
    lab_quads(&l, "sides.gltf", side, 2, "\"name\":\"Mirror\"");
    lab_quads(&l, "glow.gltf", &bright, 1, lab_glow(&l, 1000.0));
    lab_probe p = { { 0.4 * gap, 0, 0 }, { 0, 0, 1 } };
    double want = 0.0;
    for (int k = -150; k <= 150; k++) {
        quad q = square_to(2, above, (double[]){ k * gap, -0.5 }, (double[]){ (k + 1) * gap, 0.5 });
        want += 1000.0 * pow(0.9, abs(k)) * polygon_lux(q.corner, 4, p.at, p.normal);
    }
    assert_lux("1 mm", text_of(&l.a, "scene: [sides.gltf, glow.gltf]\n%s", mirror_wall), &p, 1,
               &want);
}

/* ---- panes in one place ---------------------------------------------------------------------- */

static double through_two(const void *context, dvec3 wi)
{
    (void)context;
    slab s = slab_of(1.52, slab_inner(1.52, 0.8), wi.z);
    return wi.z * s.passed * s.passed / (1.0 - s.reflected * s.reflected);
}

TEST(two_panes_in_one_place_are_two_panes)
{
    quad bright  = quad_level(0, 0, 1, 1),
         pane[2] = { quad_level(0, 0, 0.5, 4), quad_level(0, 0, 0.5, 4) };
    lab_quads(&l, "panes.gltf", pane, 2, "\"name\":\"Glass\"");
    lab_quads(&l, "glow.gltf", &bright, 1, lab_glow(&l, 1000.0));
    lab_probe p = { { 0.1, 0.2, 0 }, { 0, 0, 1 } };
    double want = 1000.0 * quad_integral(&bright, p.at, 40, through_two, NULL);
    assert_lux("panes",
               "scene: [panes.gltf, glow.gltf]\n"
               "materials: [{match: Glass, transmittance: 0.8, ior: 1.52}]\n",
               &p, 1, &want);
}

/* ---- far away, tiny, huge -------------------------------------------------------------------- */

/* A furnace of this size, m, about `at`: L_e / (1 - rho). */
static void furnace(double size, dvec3 at)
{
    quad side[6];
    double h = 0.5 * size, lux = M_PI * 100.0 / 0.5;
    quads_of_box((dvec3){ -h, -h, -h }, (dvec3){ h, h, h }, side);
    lab_quads(&l, "furnace.gltf", side, 6, lab_glow(&l, 100.0));
    const lab_probe p[]  = { { d3_add(at, (dvec3){ 0.3 * h, 0.4 * h, -0.2 * h }), { 0, 0, 1 } },
                             { d3_add(at, (dvec3){ -0.9 * h, 0, 0.1 * h }), { 0.6, 0, -0.8 } } };
    const double want[2] = { lux, lux };
    assert_lux(text_of(&l.a, "furnace of %g m at %g m", size, at.x),
               text_of(&l.a,
                       "scene: [{file: furnace.gltf, at: [[%.17g, %.17g, %.17g]]}]\n"
                       "materials: [{match: Glow, reflectance: 0.5}]\n",
                       at.x, at.y, at.z),
               p, 2, want);
}

TEST(a_furnace_of_a_millimetre_is_one) { furnace(1e-3, (dvec3){ 0, 0, 0 }); }
TEST(a_furnace_of_ten_kilometres_is_one) { furnace(1e4, (dvec3){ 0, 0, 0 }); }
TEST(a_furnace_a_thousand_kilometres_away_is_one) { furnace(4.0, (dvec3){ 1e6, 1e6, 0 }); }

/* A panel and its image in a mirror, all so many times as large and moved. */
static void mirrored_panel(double f, dvec3 by)
{
    quad bright            = { { { 1 * f, 1 * f, 2.5 * f },
                                 { 3 * f, 1 * f, 2.5 * f },
                                 { 3 * f, 3 * f, 2.5 * f },
                                 { 1 * f, 3 * f, 2.5 * f } } };
    const lab_probe near[] = { { { 1 * f, 1 * f, 0 }, { 0, 0, 1 } },
                               { { 2 * f, 2 * f, 1 * f }, { -1, 0, 0 } } };
    lab_probe p[2];
    double want[2];
    write_mirror("one.gltf", 0, 0.0, 30.0 * f);
    lab_quads(&l, "glow.gltf", &bright, 1, lab_glow(&l, 1000.0));
    for (int i = 0; i < 2; i++) {
        dvec3 c[4];
        for (int k = 0; k < 4; k++)
            c[k] = (dvec3){ -bright.corner[k].x, bright.corner[k].y, bright.corner[k].z };
        want[i] = 1000.0 * (polygon_lux(bright.corner, 4, near[i].at, near[i].normal) +
                            0.9 * polygon_lux(c, 4, near[i].at, near[i].normal));
        p[i]    = (lab_probe){ d3_add(near[i].at, by), near[i].normal };
    }
    assert_lux(text_of(&l.a, "panel, %g times, at %g m", f, by.x),
               text_of(&l.a,
                       "scene: [{file: one.gltf, at: [[%.17g, %.17g, 0]]}, {file: glow.gltf, at: "
                       "[[%.17g, %.17g, 0]]}]\n%s",
                       by.x, by.y, by.x, by.y, mirror_wall),
               p, 2, want);
}

TEST(a_mirror_of_millimetres_shows_images) { mirrored_panel(2.5e-4, (dvec3){ 0, 0, 0 }); }
TEST(a_mirror_of_kilometres_shows_images) { mirrored_panel(2500.0, (dvec3){ 0, 0, 0 }); }
TEST(a_mirror_a_thousand_kilometres_away_shows_images)
{
    mirrored_panel(1.0, (dvec3){ 1e6, -1e6, 0 });
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_sensor_on_a_mirror_has_what_falls_on_it),
        cmocka_unit_test(a_lamp_that_touches_a_mirror_is_as_long_again),
        cmocka_unit_test(a_lamp_in_the_corner_of_three_mirrors_has_seven_images),
        cmocka_unit_test(mirrors_a_millimetre_apart_show_a_row_of_gaps),
        cmocka_unit_test(two_panes_in_one_place_are_two_panes),
        cmocka_unit_test(a_furnace_of_a_millimetre_is_one),
        cmocka_unit_test(a_furnace_of_ten_kilometres_is_one),
        cmocka_unit_test(a_furnace_a_thousand_kilometres_away_is_one),
        cmocka_unit_test(a_mirror_of_millimetres_shows_images),
        cmocka_unit_test(a_mirror_of_kilometres_shows_images),
        cmocka_unit_test(a_mirror_a_thousand_kilometres_away_shows_images),
    };
    return cmocka_run_group_tests(tests, prepare, forget);
}
