/* tests/physics/test_material_furnace.c -- surfaces of every material in an even glow L from all
 * around: they are seen as bright as their albedo times L, plus what comes through; in a box of
 * mirrors that glow it is L_e / (1 - rho).
 */
#include "core/color.h"
#include "sim/render.h"
#include "tests/gltf_text.h"
#include "tests/program.h"
#include "tests/slab.h"
#include "tests/test.h"

#include <string.h>

static const double glow = 100.0; /* cd/m^2 */

/* The enclosure, black but for its glow, around a plate at the origin. */
static void write_enclosure(lab *l)
{
    quad side[6];
    quads_of_box((dvec3){ -2, -2, -2 }, (dvec3){ 2, 2, 2 }, side);
    lab_quads(l, "glow.gltf", side, 6, lab_glow(l, glow));
}

static int number_of(const scene *s, const char *name)
{
    for (int i = 0; i < s->material_count; i++)
        if (!strcmp(s->material_info[i].name, name))
            return i;
    fail_msg("no material %s", name);
    return -1;
}

static double channel_of(vrgb v, int c)
{
    return (double)lane(c == 0 ? v.x : c == 1 ? v.y : v.z, 0);
}

/* What the material sends to the eye of an even glow of 1: back, straight through, and scattered
 * through, by the midpoint rule on half degrees, which the edges of Klems' cells lie on. */
static void all_of(const scene *s, int m, dvec3 wo, double out[3])
{
    enum { RINGS = 180, SECTORS = 720 };
    const double half_degree = M_PI / 360.0;
    vvec3 n                  = vspread((vec3){ 0, 0, wo.z > 0.0 ? 1.0f : -1.0f });
    vint which               = vsplat_int(m);
    vshading at              = { .wo       = vspread(d3_to_float(wo)),
                                 .n        = n,
                                 .flat     = n,
                                 .front    = n.z > 0.0f,
                                 .distance = vsplat(1.0f) };
    vrgb back                = materials_albedo(s->materials, which, &at, ALL_LANES);
    vrgb on                  = materials_through(s->materials, which, &at, ALL_LANES);
    for (int c = 0; c < 3; c++)
        out[c] = channel_of(back, c) + channel_of(on, c);
    if (!s->materials[m]->two_sided)
        return;
    for (int i = 0; i < RINGS; i++)
        for (int k = 0; k < SECTORS; k++) {
            double cosine = cos((i + 0.5) * half_degree), sine = sin((i + 0.5) * half_degree);
            double low = sin(i * half_degree), high = sin((i + 1) * half_degree);
            double turn  = 2.0 * M_PI * (k + 0.5) / SECTORS;
            vec3 d       = { (float)(sine * cos(turn)), (float)(sine * sin(turn)),
                             (float)(wo.z > 0.0 ? -cosine : cosine) };
            vvec3 wi     = vspread(d);
            vrgb f       = materials_reflect(s->materials, which, &at, &wi, ALL_LANES, NULL);
            double share = (high * high - low * low) * M_PI / SECTORS; /* of cos dw */
            for (int c = 0; c < 3; c++)
                out[c] += channel_of(f, c) / cosine * share;
        }
}

/* The plate from so many degrees off its normal; `whole`: what is to be seen, NAN: what the
 * material says. Tolerance: 2e-3, and four standard errors of 64 pixels. */
static void seen_from(double deg, const char *looks, const char *materials, double whole)
{
    lab l;
    lab_open(&l);
    write_enclosure(&l);
    quad plate = quad_level(0, 0, 0, 0.5);
    lab_quads(&l, "plate.gltf", &plate, 1, looks);
    double turn = deg * M_PI / 180.0;
    dvec3 wo    = { -0.6 * sin(turn), 0.8 * sin(turn), cos(turn) };
    const scene *s =
        lab_scene(&l, text_of(&l.a,
                              "lux4: 1\nscene: [glow.gltf, plate.gltf]\n%s"
                              "views: [{name: v, projection: orthographic, eye: [%.17g, %.17g, "
                              "%.17g], target: [0, 0, 0], width: 0.01, size: [8, 8]}]\n",
                              materials, wo.x, wo.y, wo.z));
    double want[3] = { whole, whole, whole };
    if (isnan(whole))
        all_of(s, number_of(s, "Plate"), wo, want);
    run_options o = { .accuracy = 0.05, .deadline = HUGE_VAL, .seed = 1, .threads = 1 };
    view_result r;
    assert_true(view_run(&l.a, s, &s->study->views[0], &o, &r, NULL));
    for (int c = 0; c < 3; c++) {
        double sum = 0.0, squares = 0.0, got;
        for (int i = 0; i < 64; i++) {
            got = LUMENS_PER_WATT * (double)r.radiance[c][i] / glow;
            sum += got / 64;
            squares += got * got / 64;
        }
        double error = sqrt(fmax(squares - sum * sum, 0.0) / 63);
        if (!(fabs(sum - want[c]) <= 2e-3 * want[c] + 1e-6 + 4.0 * error) ||
            !(error <= 0.01 * want[c]))
            fail_msg("%s %s at %g degrees, channel %d: %.5g +- %.2g, not %.5g", looks, materials,
                     deg, c, sum, error, want[c]);
    }
    lab_close(&l);
}

static void plate(const char *looks, const char *materials, double whole)
{
    static const double deg[] = { 0, 60, 85, 120 /* from behind */ };
    for (int i = 0; i < 4; i++)
        seen_from(deg[i], looks, materials, whole);
}

#define STUDY(text) "\"name\":\"Plate\"", "materials: [{match: Plate, " text "}]\n"
#define LOOKS(text) "\"name\":\"Plate\",\"pbrMetallicRoughness\":{" text "}", ""
#define CLEAR       ",\"extensions\":{\"KHR_materials_transmission\":{\"transmissionFactor\":1}}"

TEST(matt_surfaces_show_their_reflectance) { plate(STUDY("reflectance: 0.6"), 0.6); }
TEST(mirrors_show_their_reflectance) { plate(STUDY("mirror: 0.9"), 0.9); }
TEST(panes_that_absorb_nothing_cannot_be_seen)
{
    lab l;
    lab_open(&l);
    plate("\"name\":\"Plate\"",
          text_of(&l.a, "materials: [{match: Plate, transmittance: %.9g}]\n",
                  slab_of(1.52, 1.0, 1.0).passed),
          1.0);
    lab_close(&l);
}
TEST(panes_that_absorb_show_the_rest)
{
    plate(STUDY("transmittance: [0.8, 0.5, 0.1]"), (double)NAN);
}

TEST(phong_surfaces_show_their_albedo)
{
    plate(STUDY("reflectance: [0.5, 0.3, 0.1], specular: 0.4, exponent: 50"), (double)NAN);
}

TEST(metals_show_their_albedo)
{
    plate(LOOKS("\"baseColorFactor\":[0.95,0.7,0.4,1],\"roughnessFactor\":0.1"), (double)NAN);
    plate(LOOKS("\"baseColorFactor\":[0.95,0.7,0.4,1],\"roughnessFactor\":0.7"), (double)NAN);
}

/* What rough facets lose among each other is given back: white metal is white. */
TEST(white_metal_cannot_be_seen)
{
    plate(LOOKS("\"baseColorFactor\":[1,1,1,1],\"roughnessFactor\":0.6"), 0.995);
}

TEST(plastics_show_their_albedo)
{
    plate(LOOKS("\"baseColorFactor\":[0.8,0.4,0.1,1],\"metallicFactor\":0,\"roughnessFactor\":0.3"),
          (double)NAN);
}

/* Blurred glass that absorbs nothing: all of it leaves on one side or the other. */
TEST(frosted_glass_shows_what_it_lets_through)
{
    plate("\"name\":\"Plate\",\"pbrMetallicRoughness\":{\"metallicFactor\":0,"
          "\"roughnessFactor\":0.5}" CLEAR,
          "", (double)NAN);
}

TEST(veils_show_what_is_behind_them)
{
    plate("\"name\":\"Plate\",\"alphaMode\":\"BLEND\",\"pbrMetallicRoughness\":{"
          "\"baseColorFactor\":[0.5,0.5,0.5,0.25],\"metallicFactor\":0}",
          "", 0.75 + 0.25 * 0.5);
}

static void measured(const char *file)
{
    lab l;
    lab_open(&l);
    plate("\"name\":\"Plate\"",
          text_of(&l.a, "materials: [{match: Plate, brdf: %s/data/materials/%s, up: [0, 1, 0]}]\n",
                  project_root(), file),
          (double)NAN);
    lab_close(&l);
}

TEST(measured_paint_shows_its_albedo) { measured("carpaint.brdf"); }
TEST(measured_metal_shows_its_albedo) { measured("brushed.brdf"); }
TEST(measured_glazing_shows_all_that_it_scatters) { measured("glazing.xml"); }
TEST(measured_blinds_show_all_that_they_scatter) { measured("blind.xml"); }

/* ---- bodies ---------------------------------------------------------------------------------- */

/* A block of glass, however the light goes about in it */
TEST(a_block_of_clear_glass_cannot_be_seen)
{
    lab l;
    lab_open(&l);
    write_enclosure(&l);
    quad side[6];
    quads_of_box((dvec3){ -0.3, -0.2, -0.25 }, (dvec3){ 0.3, 0.3, 0.2 }, side);
    lab_quads(&l, "block.gltf", side, 6,
              "\"name\":\"Block\",\"pbrMetallicRoughness\":{\"metallicFactor\":0,"
              "\"roughnessFactor\":0},\"extensions\":{\"KHR_materials_transmission\":{"
              "\"transmissionFactor\":1},\"KHR_materials_volume\":{\"thicknessFactor\":1}}");
    const scene *s = lab_scene(&l, "lux4: 1\nscene: [glow.gltf, block.gltf]\n"
                                   "views: [{name: v, eye: [1.2, -1, 0.8], target: [0, 0, 0], fov: "
                                   "30, size: [16, 12]}]\n");
    run_options o  = { .accuracy = 0.05, .deadline = HUGE_VAL, .seed = 1, .threads = 1 };
    view_result r;
    assert_true(view_run(&l.a, s, &s->study->views[0], &o, &r, NULL));
    double sum = 0.0;
    for (int i = 0; i < 16 * 12; i++) {
        double got = LUMENS_PER_WATT * (double)r.radiance[1][i] / glow;
        assert_near(got, 1.0, 0.15);
        sum += got / (16 * 12);
    }
    assert_near(sum, 1.0, 5e-3);
    lab_close(&l);
}

/* L_e / (1 - rho), pi times that on a sensor: paths end by chance alone. */
TEST(a_box_of_mirrors_that_glow_is_a_furnace)
{
    lab l;
    lab_open(&l);
    write_enclosure(&l);
    const lab_probe p[] = { { { 0.3, 0.2, 0.1 }, { 0, 0, 1 } },
                            { { -1, 1, 1.5 }, { 0.6, 0, -0.8 } } };
    double lux          = M_PI * glow / (1.0 - 0.9);
    grid_result r;
    lab_measure(&l, "scene: glow.gltf\nmaterials: [{match: Glow, mirror: 0.9}]\n", NULL, p, 2,
                &(run_options){ .accuracy = 0.02 }, &r);
    lab_check("box of mirrors", &r, (double[]){ lux, lux }, 1e-5, 0.02);
    lab_close(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(matt_surfaces_show_their_reflectance),
        cmocka_unit_test(mirrors_show_their_reflectance),
        cmocka_unit_test(panes_that_absorb_nothing_cannot_be_seen),
        cmocka_unit_test(panes_that_absorb_show_the_rest),
        cmocka_unit_test(phong_surfaces_show_their_albedo),
        cmocka_unit_test(metals_show_their_albedo),
        cmocka_unit_test(white_metal_cannot_be_seen),
        cmocka_unit_test(plastics_show_their_albedo),
        cmocka_unit_test(frosted_glass_shows_what_it_lets_through),
        cmocka_unit_test(veils_show_what_is_behind_them),
        cmocka_unit_test(measured_paint_shows_its_albedo),
        cmocka_unit_test(measured_metal_shows_its_albedo),
        cmocka_unit_test(measured_glazing_shows_all_that_it_scatters),
        cmocka_unit_test(measured_blinds_show_all_that_they_scatter),
        cmocka_unit_test(a_block_of_clear_glass_cannot_be_seen),
        cmocka_unit_test(a_box_of_mirrors_that_glow_is_a_furnace),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
