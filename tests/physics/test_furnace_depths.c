/* tests/physics/test_furnace_depths.c -- enclosures of every made_of, whose light is the same
 * whatever finds it and wherever roulette begins.
 *
 * A closed enclosure that emits L_e and reflects rho everywhere has L = L_e / (1 - rho), also
 * around bodies in it that lose nothing: panes and blocks of clear glass, mirrors. A hollow sphere
 * with a lamp of flux Phi in its middle has beside the direct light E = Phi / S rho / (1 - rho)
 * everywhere, whichever way a sensor looks.
 */
#include "core/color.h"
#include "tests/gltf_text.h"
#include "tests/lab_sphere.h"
#include "tests/slab.h"
#include "tests/test.h"

static const double glow = 100.0; /* cd/m^2 */

static const lab_probe inside[2] = { { { 0.6, 0.9, 1.1 }, { 0, 0, 1 } },
                                     { { -1, 1, 1.5 }, { 0.6, 0, -0.8 } } };

/* A box that glows, 4 m a side, of a material whose albedo is rho at every angle. */
static void glowing_enclosure(const char *made_of, double rho, double accuracy)
{
    lab l;
    lab_open(&l);
    quad side[6];
    quads_of_box((dvec3){ -2, -2, -2 }, (dvec3){ 2, 2, 2 }, side);
    lab_quads(&l, "glow.gltf", side, 6, lab_glow(&l, glow));
    double lux = M_PI * glow / (1.0 - (double)(float)rho);
    lab_check_all_ways(
        made_of,
        text_of(&l.a, "scene: glow.gltf\nmaterials: [{match: Glow, %s: %g}]\n", made_of, rho), &l,
        inside, 2, (double[]){ lux, lux }, 1e-4, accuracy);
    lab_close(&l);
}

TEST(matt_walls_of_50_percent_that_glow_are_a_furnace)
{
    glowing_enclosure("reflectance", 0.5, 0.01);
}
TEST(matt_walls_of_90_percent_that_glow_are_a_furnace)
{
    glowing_enclosure("reflectance", 0.9, 0.02);
}
TEST(matt_walls_of_99_percent_that_glow_are_a_furnace)
{
    glowing_enclosure("reflectance", 0.99, 0.05);
}
TEST(mirrors_of_50_percent_that_glow_are_a_furnace) { glowing_enclosure("mirror", 0.5, 0.02); }
TEST(mirrors_of_99_percent_that_glow_are_a_furnace) { glowing_enclosure("mirror", 0.99, 0.06); }

/* ---- bodies that lose nothing ---------------------------------------------------------------- */

static const char block[] =
    "\"name\":\"Body\",\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"roughnessFactor\":0},"
    "\"extensions\":{\"KHR_materials_transmission\":{\"transmissionFactor\":1},"
    "\"KHR_materials_volume\":{\"thicknessFactor\":1}}";

static void around_a_body(double rho, const char *looks, const char *made_of, bool solid,
                          double exact)
{
    lab l;
    lab_open(&l);
    quad side[6], body[6];
    quads_of_box((dvec3){ -2, -2, -2 }, (dvec3){ 2, 2, 2 }, side);
    quads_of_box((dvec3){ -0.7, -0.8, -0.5 }, (dvec3){ 0.8, 0.6, 0.7 }, body);
    lab_quads(&l, "glow.gltf", side, 6, lab_glow(&l, glow));
    lab_quads(&l, "body.gltf", body, solid ? 6 : 1, looks);
    double lux = M_PI * glow / (1.0 - (double)(float)rho);
    lab_check_all_ways(looks,
                       text_of(&l.a,
                               "scene: [glow.gltf, body.gltf]\nmaterials:\n"
                               "  - {match: Glow, reflectance: %g}\n%s",
                               rho, made_of),
                       &l, inside, 2, (double[]){ lux, lux }, exact, 0.02);
    lab_close(&l);
}

TEST(a_block_of_clear_glass_in_a_furnace_changes_nothing)
{
    around_a_body(0.8, block, "", true, 1e-4);
}

TEST(a_pane_that_absorbs_nothing_in_a_furnace_changes_nothing)
{
    lab l;
    lab_open(&l);
    around_a_body(
        0.8, "\"name\":\"Body\"",
        text_of(&l.a, "  - {match: Body, transmittance: %.9g}\n", slab_of(1.52, 1.0, 1.0).passed),
        false, 1e-4);
    lab_close(&l);
}

TEST(a_whole_mirror_in_a_furnace_changes_nothing)
{
    around_a_body(0.8, "\"name\":\"Body\"", "  - {match: Body, mirror: 1}\n", true, 1e-4);
}

/* Metal of roughness 0.6 whose facets are white loses 0.5 % at most (test_material_furnace.c): of
 * the light of a furnace, whose walls are 8 times the body's surface, less than that. */
TEST(white_metal_in_a_furnace_changes_nothing)
{
    around_a_body(0.8,
                  "\"name\":\"Body\",\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,1,1,1],"
                  "\"roughnessFactor\":0.6}",
                  "", true, 5e-3);
}

/* ---- an integrating sphere ------------------------------------------------------------------- */

/* 1e-3: pieces are flat, 4.5 degrees wide; they are lit unevenly by the square of half of that. */
static void integrating_sphere(double rho, double accuracy)
{
    lab l;
    lab_open(&l);
    double area         = lab_sphere(&l, "sphere.gltf", (dvec3){ 0 }, 1, 40, "\"name\":\"Matt\"");
    double even         = 1000.0 / area * (double)(float)rho / (1.0 - (double)(float)rho);
    const lab_probe p[] = { { { 0.5, 0, 0 }, { 0, 0, 1 } },
                            { { 0, -0.3, 0.6 }, { 0.6, 0, 0.8 } },
                            { { 0, 0, 0.5 }, { 0, 0, -1 } } };
    const double want[] = { even, even, even + 1000.0 / (4.0 * M_PI * 0.25) };
    lab_check_all_ways("sphere",
                       text_of(&l.a,
                               "scene: sphere.gltf\nmaterials: [{match: Matt, reflectance: %g}]\n"
                               "lights: [{type: point, at: [0, 0, 0], lumens: 1000}]",
                               rho),
                       &l, p, 3, want, 1e-3, accuracy);
    lab_close(&l);
}

TEST(an_integrating_sphere_of_50_percent_is_even) { integrating_sphere(0.5, 0.01); }
TEST(an_integrating_sphere_of_90_percent_is_even) { integrating_sphere(0.9, 0.02); }
TEST(an_integrating_sphere_of_99_percent_is_even) { integrating_sphere(0.99, 0.06); }

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(matt_walls_of_50_percent_that_glow_are_a_furnace),
        cmocka_unit_test(matt_walls_of_90_percent_that_glow_are_a_furnace),
        cmocka_unit_test(matt_walls_of_99_percent_that_glow_are_a_furnace),
        cmocka_unit_test(mirrors_of_50_percent_that_glow_are_a_furnace),
        cmocka_unit_test(mirrors_of_99_percent_that_glow_are_a_furnace),
        cmocka_unit_test(a_block_of_clear_glass_in_a_furnace_changes_nothing),
        cmocka_unit_test(a_pane_that_absorbs_nothing_in_a_furnace_changes_nothing),
        cmocka_unit_test(a_whole_mirror_in_a_furnace_changes_nothing),
        cmocka_unit_test(white_metal_in_a_furnace_changes_nothing),
        cmocka_unit_test(an_integrating_sphere_of_50_percent_is_even),
        cmocka_unit_test(an_integrating_sphere_of_90_percent_is_even),
        cmocka_unit_test(an_integrating_sphere_of_99_percent_is_even),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
