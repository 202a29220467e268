/* tests/physics/test_picture.c -- pictures of surfaces whose luminance is known: rho E / pi where
 * light falls on them, L where they glow; and the illuminance beside it.
 */
#include "core/color.h"
#include "sim/render.h"
#include "tests/lab.h"
#include "tests/test.h"

/* A view straight down on a floor of 3 x 2 m, 24 x 16 pixels: row 0 is the north. */
enum { WIDE = 24, HIGH = 16 };
#define PLAN                                                                                       \
    "views: [{name: plan, projection: orthographic, eye: [1.5, 1, 1.5], target: [1.5, 1, 0], "     \
    "width: 3, size: [24, 16]}]\n"

static dvec3 seen_by(int pixel)
{
    return (dvec3){ 3.0 * (pixel % WIDE + 0.5) / WIDE, 2.0 - 2.0 * (pixel / WIDE + 0.5) / HIGH, 0 };
}

static void look_down(lab *l, const char *yaml, double accuracy, view_result *out)
{
    const scene *s = lab_scene(l, yaml);
    lux_error err  = { 0 };
    run_options o  = { .accuracy = accuracy, .deadline = HUGE_VAL, .seed = 1, .threads = 1 };
    if (!view_run(&l->a, s, &s->study->views[0], &o, out, &err))
        fail_msg("%s", err.text);
    assert_int_equal(out->width, WIDE);
    assert_int_equal(out->height, HIGH);
}

/* Fails unless 98 % of the pixels are as near as asked to E and its luminance, and all within twice
 * that: pixel means are those of their middles, but for `exact`. */
static void check_pixels(const view_result *r, const double *lux, double rho, double exact)
{
    int within = 0;
    for (int i = 0; i < WIDE * HIGH; i++) {
        double luminance = LUMENS_PER_WATT * (double)r->radiance[1][i], want = rho * lux[i] / M_PI;
        double off = fabs(luminance - want) - exact * want;
        assert_near(r->distance[i], 1.5, 1e-5);
        assert_near(r->normal[2][i], 1.0, 1e-6);
        if (!(off <= 2.0 * r->asked * want) ||
            !(fabs((double)r->illuminance[i] - lux[i]) <= (2.0 * r->asked + exact) * lux[i]))
            fail_msg("pixel %d: %g cd/m^2 and %g lx, not %g and %g", i, luminance,
                     (double)r->illuminance[i], want, lux[i]);
        within += off <= (double)r->half_width[i];
    }
    assert_true(within >= 0.93 * WIDE * HIGH);
}

/* A point and a panel, black walls: 0.5 % for how E bends within a pixel */
TEST(a_floor_in_the_light_of_lamps_shows_its_luminance)
{
    lab l;
    lab_open(&l);
    const dvec3 corner[] = { { 0.4, 0.7, 2 }, { 1.6, 0.7, 2 }, { 1.6, 1.3, 2 }, { 0.4, 1.3, 2 } };
    double lux[WIDE * HIGH];
    for (int i = 0; i < WIDE * HIGH; i++) {
        dvec3 d = d3_sub((dvec3){ 2.5, 1.5, 2 }, seen_by(i));
        lux[i]  = 200.0 * d.z / pow(d3_dot(d, d), 1.5) +
                 1000.0 * polygon_lux(corner, 4, seen_by(i), (dvec3){ 0, 0, 1 });
    }
    view_result r;
    look_down(
        &l,
        "lux4: 1\nroom: {size: [3, 2, 2.5], reflectance: {ceiling: 0, walls: 0, floor: 0.4}}\n"
        "lights: [{type: point, at: [2.5, 1.5, 2], intensity: 200},"
        " {type: rect, at: [1, 1, 2], size: [1.2, 0.6], luminance: 1000}]\n" PLAN,
        0.02, &r);
    check_pixels(&r, lux, 0.4, 0.005);
    lab_close(&l);
}

/* A small glowing quad beside a point */
TEST(a_floor_in_the_light_of_a_glowing_quad_shows_its_luminance)
{
    lab l;
    lab_open(&l);
    const quad glow = { { { 1.4, 0.9, 2 }, { 1.4, 1.1, 2 }, { 1.6, 1.1, 2 }, { 1.6, 0.9, 2 } } };
    double lux[WIDE * HIGH];
    lab_quads(&l, "glow.gltf", &glow, 1, lab_glow(&l, 20000.0));
    for (int i = 0; i < WIDE * HIGH; i++) {
        dvec3 d = d3_sub((dvec3){ 2.5, 1.5, 2 }, seen_by(i));
        lux[i]  = 20000.0 * polygon_lux(glow.corner, 4, seen_by(i), (dvec3){ 0, 0, 1 }) +
                 200.0 * d.z / pow(d3_dot(d, d), 1.5);
    }
    view_result r;
    look_down(
        &l,
        "lux4: 1\nroom: {size: [3, 2, 2.5], reflectance: {ceiling: 0, walls: 0, floor: 0.4}}\n"
        "scene: glow.gltf\nlights: [{type: point, at: [2.5, 1.5, 2], intensity: 200}]\n" PLAN,
        0.02, &r);
    check_pixels(&r, lux, 0.4, 0.005);
    lab_close(&l);
}

TEST(a_glowing_surface_shows_its_own_luminance)
{
    lab l;
    lab_open(&l);
    quad glow = { { { 0, 0, 0.5 }, { 3, 0, 0.5 }, { 3, 2, 0.5 }, { 0, 2, 0.5 } } };
    lab_quads(&l, "glow.gltf", &glow, 1, lab_glow(&l, 1234.5));
    view_result r;
    look_down(&l, "lux4: 1\nscene: glow.gltf\n" PLAN, 0.1, &r);
    for (int i = 0; i < WIDE * HIGH; i++) {
        assert_near(LUMENS_PER_WATT * (double)r.radiance[1][i], 1234.5, 1e-5);
        assert_near(r.illuminance[i], 0.0, 1e-6);
    }
    lab_close(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_floor_in_the_light_of_lamps_shows_its_luminance),
        cmocka_unit_test(a_floor_in_the_light_of_a_glowing_quad_shows_its_luminance),
        cmocka_unit_test(a_glowing_surface_shows_its_own_luminance),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
