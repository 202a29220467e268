/* tests/physics/test_narrow_lobes.c -- narrow materials in the light of lamps with extent, as a
 * view sees them: the integral of f cos L over the lamp, which asking the lamp and drawing from the
 * material have to add up to, whichever does it well.
 */
#include "core/color.h"
#include "sim/render.h"
#include "tests/gltf_text.h"
#include "tests/program.h"
#include "tests/slab.h"
#include "tests/test.h"

#include <string.h>

/* A plane z = 0, seen at the origin from the west at 45 degrees: what a mirror would show lies at
 * (2, 0, 2). One square millimetre is seen. */
#define SEEN                                                                                       \
    "views: [{name: v, projection: orthographic, eye: [-2, 0, 2], target: [0, 0, 0], width: "      \
    "0.001, size: [4, 4]}]\n"

static const dvec3 to_eye = { -0.70710678118654752, 0, 0.70710678118654752 };

typedef struct seen {
    const scene *s;
    vint material;
    int channel;
} seen;

static double f_cos(const void *context, dvec3 wi)
{
    const seen *c = context;
    vvec3 up      = vspread((vec3){ 0, 0, 1 });
    vvec3 in      = vspread(d3_to_float(wi));
    vshading at   = { .wo       = vspread(d3_to_float(to_eye)),
                      .n        = up,
                      .flat     = up,
                      .front    = ALL_LANES,
                      .distance = vsplat(1.0f) };
    vrgb f        = materials_reflect(c->s->materials, c->material, &at, &in, ALL_LANES, NULL);
    return (double)lane(c->channel == 0 ? f.x : c->channel == 1 ? f.y : f.z, 0);
}

static int number_of(const scene *s, const char *name)
{
    for (int i = 0; i < s->material_count; i++)
        if (!strcmp(s->material_info[i].name, name))
            return i;
    fail_msg("no material %s", name);
    return -1;
}

static const char *const shapes[] = { "rect", "disk", "glow" };

/* The integral over the lamp: 0.8 m wide at z = 2, about (x, 0.2). A disk by rings and sectors. */
static double over_lamp(int shape, double x, const seen *c)
{
    enum { RINGS = 200, SECTORS = 300 };
    quad q = quad_level(x, 0.2, 2, 0.8);
    if (strcmp(shapes[shape], "disk"))
        return quad_integral(&q, (dvec3){ 0, 0, 0 }, 150, f_cos, c);
    double sum = 0.0;
    for (int i = 0; i < RINGS; i++)
        for (int k = 0; k < SECTORS; k++) {
            double r = 0.4 * (i + 0.5) / RINGS, turn = 2.0 * M_PI * k / SECTORS;
            dvec3 to = { x + r * cos(turn), 0.2 + r * sin(turn), 2.0 };
            double d = d3_length(to), area = r * 0.4 / RINGS * 2.0 * M_PI / SECTORS;
            sum += f_cos(c, d3_scale(to, 1.0 / d)) * area * 2.0 / (d * d * d);
        }
    return sum;
}

static const char *lamp_of(lab *l, int shape, double x)
{
    quad q = quad_level(x, 0.2, 2, 0.8);
    if (!strcmp(shapes[shape], "rect"))
        return text_of(&l->a,
                       "lights: [{type: rect, at: [%g, 0.2, 2], size: [0.8, 0.8], luminance: "
                       "1000}]\n",
                       x);
    if (!strcmp(shapes[shape], "disk"))
        return text_of(
            &l->a, "lights: [{type: disk, at: [%g, 0.2, 2], radius: 0.4, luminance: 1000}]\n", x);
    lab_quads(l, "glow.gltf", &q, 1, lab_glow(l, 1000.0));
    return "";
}

/* Fails unless the mean of the pixels is the integral, for every channel: within 1e-3, of the
 * quadrature and the millimetre, and three of its standard errors. */
static void check_view(const char *what, const view_result *r, const double want[3])
{
    int n = r->width * r->height;
    for (int c = 0; c < 3; c++) {
        double sum = 0.0, squares = 0.0;
        for (int i = 0; i < n; i++) {
            double value = LUMENS_PER_WATT * (double)r->radiance[c][i];
            sum += value / n;
            squares += value * value / n;
        }
        double spread = sqrt(fmax(squares - sum * sum, 0.0) / (n - 1));
        if (!(fabs(sum - want[c]) <= 1e-3 * want[c] + 4.0 * spread) || !(spread < 0.02 * want[c]))
            fail_msg("%s, channel %d: %.6g cd/m^2 +- %.2g, not %.6g", what, c, sum, spread,
                     want[c]);
    }
}

/* In the light of each kind of lamp: where its image stands, and beside it. */
static void lit_plane(const char *looks, const char *materials)
{
    for (int shape = 0; shape < 3; shape++)
        for (int beside = 0; beside < 2; beside++) {
            double x = beside ? 2.9 : 2.3, want[3];
            lab l;
            lab_open(&l);
            quad plane       = quad_level(0, 0, 0, 1);
            const char *lamp = lamp_of(&l, shape, x);
            bool glow        = !*lamp;
            lab_quads(&l, "plane.gltf", &plane, 1, looks);
            const scene *s =
                lab_scene(&l, text_of(&l.a, "lux4: 1\nscene: [plane.gltf%s]\n%s%s" SEEN,
                                      glow ? ", glow.gltf" : "", materials, lamp));
            run_options o = { .accuracy = 0.02, .deadline = HUGE_VAL, .seed = 1, .threads = 1 };
            seen c        = { .s = s, .material = vsplat_int(number_of(s, "Plane")) };
            for (c.channel = 0; c.channel < 3; c.channel++)
                want[c.channel] = 1000.0 * over_lamp(shape, x, &c);
            view_result r;
            assert_true(view_run(&l.a, s, &s->study->views[0], &o, &r, NULL));
            check_view(text_of(&l.a, "%s %s", shapes[shape], beside ? "beside" : "seen"), &r, want);
            lab_close(&l);
        }
}

TEST(a_phong_lobe_shows_lamps_as_its_integral)
{
    lit_plane("\"name\":\"Plane\"", "materials: [{match: Plane, reflectance: [0.3, 0.2, 0.1], "
                                    "specular: 0.4, exponent: 200}]\n");
}

TEST(glossy_metal_shows_lamps_as_its_integral)
{
    lit_plane("\"name\":\"Plane\",\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.9,0.6,0.3,1],"
              "\"metallicFactor\":1,\"roughnessFactor\":0.1}",
              "");
}

TEST(glossy_plastic_shows_lamps_as_its_integral)
{
    lit_plane("\"name\":\"Plane\",\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.5,0.2,0.1,1],"
              "\"metallicFactor\":0,\"roughnessFactor\":0.25}",
              "");
}

static void measured(const char *file)
{
    lab l;
    lab_open(&l);
    lit_plane("\"name\":\"Plane\"",
              text_of(&l.a,
                      "materials: [{match: Plane, brdf: %s/data/materials/%s, up: [1, 1, 0]}]\n",
                      project_root(), file));
    lab_close(&l);
}

TEST(a_measured_car_paint_shows_lamps_as_its_integral) { measured("carpaint.brdf"); }
TEST(a_measured_brushed_metal_shows_lamps_as_its_integral) { measured("brushed.brdf"); }

/* ---- layers ---------------------------------------------------------------------------------- */

TEST(layers_of_a_glossy_view_add_up)
{
    lab l;
    lab_open(&l);
    quad plane = quad_level(0, 0, 0, 1), glow = quad_level(2.3, 0.2, 2, 0.8);
    lab_quads(&l, "glow.gltf", &glow, 1, lab_glow(&l, 500.0));
    lab_quads(&l, "plane.gltf", &plane, 1,
              "\"name\":\"Plane\",\"pbrMetallicRoughness\":{\"metallicFactor\":1,"
              "\"roughnessFactor\":0.2}");
    const scene *plain = lab_scene(
        &l, "lux4: 1\nscene: [plane.gltf, glow.gltf]\nmaintenance: 0.8\n"
            "lights: [{type: rect, at: [1.4, 0, 2], size: [0.5, 0.5], luminance: 1000, group: a},\n"
            "  {type: point, at: [1.5, 0.1, 2], intensity: 20, group: b}]\n"
            "dimming: {other: 0.5, a: 0.25, b: 2}\n" SEEN);
    lux_error err  = { 0 };
    const scene *s = scene_new(&l.a, plain->study, &(scene_options){ 1, true }, NULL, &err);
    run_options o  = { .accuracy = 0.05, .deadline = HUGE_VAL, .seed = 1, .threads = 1 };
    view_result r;
    assert_non_null(s);
    assert_true(view_run(&l.a, s, &s->study->views[0], &o, &r, &err));
    assert_int_equal(r.layer_count, 3);
    for (int c = 0; c < 3; c++)
        for (int i = 0; i < 16; i++) {
            double sum = 0.0;
            for (int g = 0; g < 3; g++) {
                double own = (double)r.layers[g].radiance[c][i];
                assert_true(own > 0.0);
                sum += own * (s->groups[g][0] == 'o' ? 0.5 : s->groups[g][0] == 'a' ? 0.25 : 2.0);
            }
            assert_near(r.radiance[c][i], sum, 1e-5);
        }
    lab_close(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_phong_lobe_shows_lamps_as_its_integral),
        cmocka_unit_test(glossy_metal_shows_lamps_as_its_integral),
        cmocka_unit_test(glossy_plastic_shows_lamps_as_its_integral),
        cmocka_unit_test(a_measured_car_paint_shows_lamps_as_its_integral),
        cmocka_unit_test(a_measured_brushed_metal_shows_lamps_as_its_integral),
        cmocka_unit_test(layers_of_a_glossy_view_add_up),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
