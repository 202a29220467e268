/* tests/physics/test_bounces.c -- light of no more than so many reflections: what a geometric
 * series gives after so many terms.
 *
 * Where all that can be seen is as bright, L_0, and reflects rho, one more reflection adds rho
 * times what the last one gave: L_N = L_0 (1 + rho + ... + rho^N).
 */
#include "tests/gltf_text.h"
#include "tests/lab_sphere.h"
#include "tests/slab.h"
#include "tests/test.h"

static const int limits[] = { 0, 1, 2, 4 };
enum { LIMITS = sizeof limits / sizeof *limits };

static const lab_probe inside[2] = { { { 0.6, 0.9, 1.1 }, { 0, 0, 1 } },
                                     { { -1, 1, 1.5 }, { 0.6, 0, -0.8 } } };

static double series(double rho, int from, int to)
{
    double sum = 0.0;
    for (int k = from; k <= to; k++)
        sum += pow(rho, k);
    return sum;
}

static void glowing_box(const char *made_of, double rho, int limit)
{
    lab l;
    lab_open(&l);
    quad side[6];
    quads_of_box((dvec3){ -2, -2, -2 }, (dvec3){ 2, 2, 2 }, side);
    lab_quads(&l, "glow.gltf", side, 6, lab_glow(&l, 100.0));
    double lux = M_PI * 100.0 * series(rho, 0, limit);
    grid_result r;
    run_options o = { .accuracy = 0.01, .bounded = true, .bounces = limit };
    lab_measure(
        &l, text_of(&l.a, "scene: glow.gltf\nmaterials: [{match: Glow, %s: %g}]\n", made_of, rho),
        NULL, inside, 2, &o, &r);
    lab_check(text_of(&l.a, "%s, %d at most", made_of, limit), &r, (double[]){ lux, lux }, 1e-4,
              0.01);
    lab_close(&l);
}

TEST(a_glowing_matt_box_has_one_term_a_reflection)
{
    for (int i = 0; i < LIMITS; i++)
        glowing_box("reflectance", 0.8, limits[i]);
}

TEST(a_glowing_box_of_mirrors_has_one_term_a_reflection)
{
    for (int i = 0; i < LIMITS; i++)
        glowing_box("mirror", 0.8, limits[i]);
}

/* ---- an integrating sphere ------------------------------------------------------------------- */

/* 1e-3: pieces are flat, 4.5 degrees wide. Looking away from the lamp and to it */
static void sphere_of(const char *lamp, double lumens, int limit)
{
    const double rho = 0.8;
    lab l;
    lab_open(&l);
    double area         = lab_sphere(&l, "sphere.gltf", (dvec3){ 0 }, 1, 40, "\"name\":\"Matt\"");
    double even         = lumens / area * series(rho, 1, limit);
    const lab_probe p[] = { { { 0.5, 0, 0 }, { 0.6, 0.8, 0 } }, { { 0, -0.3, 0.6 }, { 0, 0, 1 } } };
    grid_result r;
    run_options o = { .accuracy = 0.01, .bounded = true, .bounces = limit };
    lab_measure(&l,
                text_of(&l.a, "scene: sphere.gltf\nmaterials: [{match: Matt, reflectance: %g}]\n%s",
                        rho, lamp),
                NULL, p, 2, &o, &r);
    if (limit > 0)
        lab_check(text_of(&l.a, "sphere, %d at most", limit), &r, (double[]){ even, even }, 1e-3,
                  0.01);
    for (int k = 0; k < 2 && limit == 0; k++)
        assert_near(r.illuminance[k], 0.0, 1e-9);
    lab_close(&l);
}

TEST(a_sphere_about_a_lamp_has_one_term_a_reflection)
{
    for (int i = 0; i < LIMITS; i++)
        sphere_of("lights: [{type: point, at: [0, 0, 0], lumens: 1000}]", 1000, limits[i]);
}

/* ---- light that goes straight on is not reflected -------------------------------------------- */

/* A glowing sheet seen through four veils, of which each is a quarter there. */
TEST(veils_take_no_reflections)
{
    lab l;
    lab_open(&l);
    quad pane[4], bright = quad_level(0, 0, 3, 0.1);
    for (int i = 0; i < 4; i++)
        pane[i] = quad_level(0, 0, 0.5 + 0.5 * i, 4);
    lab_quads(&l, "pane.gltf", pane, 4,
              "\"name\":\"Veil\",\"alphaMode\":\"BLEND\","
              "\"pbrMetallicRoughness\":{\"baseColorFactor\":[0,0,0,0.25],\"metallicFactor\":0}");
    lab_quads(&l, "glow.gltf", &bright, 1, lab_glow(&l, 1000.0));
    const lab_probe p = { { 0, 0, 0 }, { 0, 0, 1 } };
    grid_result r;
    lab_measure(&l, "scene: [pane.gltf, glow.gltf]", NULL, &p, 1,
                &(run_options){ .accuracy = 0.01, .bounded = true, .bounces = 0 }, &r);
    double want = pow(0.75, 4.0) * 1000.0 * polygon_lux(bright.corner, 4, p.at, p.normal);
    lab_check("veils", &r, &want, 1e-4, 0.01);
    lab_close(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_glowing_matt_box_has_one_term_a_reflection),
        cmocka_unit_test(a_glowing_box_of_mirrors_has_one_term_a_reflection),
        cmocka_unit_test(a_sphere_about_a_lamp_has_one_term_a_reflection),
        cmocka_unit_test(veils_take_no_reflections),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
