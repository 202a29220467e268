/* tests/physics/test_plan_pairs_views.c -- pairs of scenes (plan_pairs.h) of effects that views
 * show: refraction, the levels of rays, normal maps.
 */
#include "core/color.h"
#include "sim/render.h"
#include "tests/physics/plan_pairs.h"
#include "tests/slab.h"

/* ---- refraction ------------------------------------------------------------------------------ */

/* A block of 1 m, of that index and clear, or of what absorbs within. */
static void write_block(lab *l, double index, const char *absorption)
{
    quad q[6];
    quads_of_box((dvec3){ 1.5, 1, 1.1 }, (dvec3){ 2.5, 2, 1.7 }, q);
    lab_quads(l, "block.gltf", q, 6,
              text_of(&l->a,
                      "\"name\":\"Block\",\"pbrMetallicRoughness\":{\"metallicFactor\":0,"
                      "\"roughnessFactor\":0},\"extensions\":{\"KHR_materials_transmission\":{"
                      "\"transmissionFactor\":1},\"KHR_materials_ior\":{\"ior\":%.9g},"
                      "\"KHR_materials_volume\":{\"thicknessFactor\":1%s}}",
                      index, absorption));
}

/* At 25 %: forced on, the map of focused light is grainy at a shadow's edge. */
#define ROOM_25 "lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: 0.3}\naccuracy: 25%\n"
#define BLOCK   ROOM_25 "scene: block.gltf\nlights: [" POINT "]\n" GRID

/* Light goes through a solid of index 1 as if nothing were there: forced on, as through 1.0001. */
TEST(a_solid_of_index_1_bends_nothing)
{
    outcome planned, forced, bare;
    lab l;
    lab_open(&l);
    write_block(&l, 1.0, "");
    run(&l, BLOCK, &as_planned, &planned);
    run(&l, BLOCK, &all_is_on, &forced);
    assert_false(is_on(&planned, EFFECT_REFRACTION));
    assert_false(planned.scene->solids || is_on(&planned, EFFECT_MIRRORS));
    assert_true(forced.scene->solids);
    assert_agree(&planned, &forced);
    run(&l, ROOM_25 "lights: [" POINT "]\n" GRID, &as_planned, &bare);
    assert_agree(&planned, &bare);
    lab_close(&l);
}

TEST(a_solid_by_a_hair_denser_than_air_refracts)
{
    lab l;
    lab_open(&l);
    plan p;
    write_block(&l, 1.0002, "");
    assert_true(plan_make(lab_scene(&l, BLOCK), &as_planned, &p, NULL, NULL));
    assert_true(p.effects[EFFECT_REFRACTION].on);
    write_block(&l, 1.0, ",\"attenuationDistance\":1,\"attenuationColor\":[0.999,0.999,0.999]");
    assert_true(plan_make(lab_scene(&l, BLOCK), &as_planned, &p, NULL, NULL));
    assert_true(p.effects[EFFECT_REFRACTION].on); /* what is lost within takes its way */
    lab_close(&l);
}

/* ---- views ----------------------------------------------------------------------------------- */

typedef struct look {
    plan plan;
    view_result view;
} look;

static void look_at(lab *l, const char *yaml, const plan_options *how, look *out)
{
    lux_error err     = { 0 };
    const scene *s    = lab_scene(l, yaml);
    plan_options asks = *how;
    run_options r     = { .accuracy = (double)NAN, .deadline = HUGE_VAL, .seed = 1, .threads = 1 };
    asks.views        = true;
    if (!plan_make(s, &asks, &out->plan, NULL, &err))
        fail_msg("%s", err.text);
    scene_options o = { .threads = 1, .off = plan_without(&out->plan), .on = out->plan.on };
    s               = scene_new(&l->a, s->study, &o, NULL, &err);
    plan_apply(&out->plan, &r);
    if (!s || !view_run(&l->a, s, &s->study->views[0], &r, &out->view, &err))
        fail_msg("%s", err.text);
}

/* cd/m^2 of pixel x of row y of a grey picture. */
static double seen(const look *l, int x, int y)
{
    return LUMENS_PER_WATT * (double)l->view.radiance[1][y * l->view.width + x];
}

static void assert_same_picture(const look *a, const look *b)
{
    size_t n = (size_t)a->view.width * (size_t)a->view.height;
    for (int c = 0; c < 3; c++)
        assert_memory_equal(a->view.radiance[c], b->view.radiance[c], n * sizeof(float));
}

/* 4 x 4 pixels of 1 m, straight down on what lies about (2, 2, 0). */
#define DOWN                                                                                       \
    "views: [{name: v, projection: orthographic, eye: [2, 2, 1.5], target: [2, 2, 0], width: 4, "  \
    "size: [4, 4]}]\n"

/* A quad of 100 cd/m^2 from x = 0 to 2.25: of the third column a quarter glows, and not the middle.
 */
TEST(an_edge_is_smooth_with_antialiasing_and_jagged_without)
{
    static const char yaml[] = "lux4: 1\nscene: glow.gltf\n" DOWN;
    plan_options none        = as_planned;
    look planned, off;
    lab l;
    lab_open(&l);
    quad q = { { { 0, 0, 0 }, { 2.25, 0, 0 }, { 2.25, 4, 0 }, { 0, 4, 0 } } };
    lab_quads(&l, "glow.gltf", &q, 1, lab_glow(&l, 100.0));
    look_at(&l, yaml, &as_planned, &planned);
    none.no = 1u << EFFECT_ANTIALIASING;
    look_at(&l, yaml, &none, &off);
    assert_true(planned.plan.effects[EFFECT_ANTIALIASING].on);
    assert_true(off.plan.effects[EFFECT_ANTIALIASING].missed);
    for (int y = 0; y < 4; y++) {
        assert_near(seen(&planned, 1, y), 100.0, 1e-5);
        assert_near(seen(&planned, 2, y), 25.0, 0.1); /* as accurate as asked for */
        assert_near(seen(&planned, 3, y), 0.0, 0.0);
        assert_near(seen(&off, 1, y), 100.0, 1e-5);
        assert_near(seen(&off, 2, y), 0.0, 0.0);
    }
    lab_close(&l);
}

/* Of an even sky and nothing before it, the first level: 32 rays a pixel. */
TEST(the_levels_of_rays_are_told_and_kept)
{
    look even;
    lab l;
    lab_open(&l);
    look_at(&l,
            "lux4: 1\nsky: {model: uniform, horizontal: 1000}\n"
            "views: [{name: v, eye: [0, 0, 1], target: [0, 0.1, 2], fov: 20, size: [4, 4]}]\n",
            &as_planned, &even);
    assert_near(seen(&even, 1, 2), 1000.0 / M_PI, 1e-5);
    assert_int_equal(even.view.rays, 32 * 16);
    const char *why = even.plan.effects[EFFECT_ANTIALIASING].why;
    assert_string_equal(why, "32 rays all over each pixel, then 64, 128 and so on, until 98 % of "
                             "the pixels are within 10 %; 16777216 rays at most");
    lab_close(&l);
}

/* Where all is black there is nothing to smooth. */
TEST(antialiasing_is_off_until_there_is_light)
{
    static const char yaml[] = "lux4: 1\nscene: sheet.gltf\n%s" DOWN;
    look dark, forced, lit;
    lab l;
    lab_open(&l);
    quad q = quad_level(2, 2, 0, 2.5);
    lab_quads(&l, "sheet.gltf", &q, 1, "\"name\":\"S\"");
    look_at(&l, text_of(&l.a, yaml, ""), &as_planned, &dark);
    look_at(&l, text_of(&l.a, yaml, ""), &all_is_on, &forced);
    look_at(&l,
            text_of(&l.a, yaml, "lights: [{type: parallel, aim: [0, 0, -1], illuminance: 1e-6}]\n"),
            &as_planned, &lit);
    assert_false(dark.plan.effects[EFFECT_ANTIALIASING].on);
    assert_true(forced.plan.effects[EFFECT_ANTIALIASING].on);
    assert_true(lit.plan.effects[EFFECT_ANTIALIASING].on);
    assert_same_picture(&dark, &forced);
    assert_true(seen(&lit, 0, 0) > 0.0);
    lab_close(&l);
}

/* Through the block of index 1 the floor is seen as if it were not there. */
TEST(a_view_through_index_1_is_that_without_the_solid)
{
    static const char yaml[] = "lux4: 1\nroom: {size: [4, 4, 2.5], reflectance: 0.3}\n%s"
                               "lights: [{type: point, at: [2, 1, 2.2], lumens: 1000}]\n"
                               "views: [{name: v, eye: [2, 1.5, 2.3], target: [2, 1.6, 0], "
                               "fov: 60, size: [4, 4]}]\n";
    look block, bare;
    lab l;
    lab_open(&l);
    write_block(&l, 1.0, "");
    look_at(&l, text_of(&l.a, yaml, "scene: block.gltf\n"), &as_planned, &block);
    look_at(&l, text_of(&l.a, yaml, ""), &as_planned, &bare);
    assert_false(block.plan.effects[EFFECT_REFRACTION].on);
    for (int i = 0; i < 16; i++)
        assert_near(seen(&block, i % 4, i / 4), seen(&bare, i % 4, i / 4), 0.2); /* 10 % each */
    lab_close(&l);
}

/* ---- normal maps ----------------------------------------------------------------------------- */

/* A level floor of 4 m whose map has two texels. */
static void write_bumps(lab *l, uint8_t red, uint8_t green)
{
    quad q           = quad_level(2, 2, 0, 4);
    uint8_t texel[8] = { 127, 128, 255, 255, red, green, 255, 255 };
    lab_picture(l, "floor.gltf", &q, &(picture){ 2, 1, texel, NEAREST_TEXEL },
                "\"name\":\"Bumps\",\"normalTexture\":{\"index\":0},\"pbrMetallicRoughness\":{"
                "\"metallicFactor\":0,\"baseColorFactor\":[0.5,0.5,0.5,1]}");
}

/* From the west, 45 degrees above the horizon. */
#define SLANTED                                                                                    \
    "lux4: 1\nscene: floor.gltf\nlights: [{type: parallel, aim: [1, 0, -1], illuminance: "         \
    "1000}]\n" DOWN

/* cd/m^2 of a slope toward the east of x : z. */
static double sloping(double x, double z)
{
    return 0.5 / M_PI * 1000.0 * (z - x) / sqrt(2.0 * (x * x + z * z));
}

/* 8 bits have no 0: 127 and 128 stand for it, and 129 is a slope. */
TEST(a_normal_map_that_is_flat_to_its_last_bit_is_off)
{
    look planned, forced, sloped;
    lab l;
    lab_open(&l);
    write_bumps(&l, 128, 127);
    look_at(&l, SLANTED, &as_planned, &planned);
    look_at(&l, SLANTED, &all_is_on, &forced);
    assert_false(planned.plan.effects[EFFECT_NORMAL_MAPS].on);
    assert_true(forced.plan.effects[EFFECT_NORMAL_MAPS].on);
    assert_true(planned.plan.bound == 0.0);
    for (int x = 0; x < 4; x++) {
        assert_near(seen(&planned, x, 1), sloping(0, 1), 1e-5);
        assert_near(seen(&forced, x, 1), sloping(0, 1), 1e-5);
    }
    write_bumps(&l, 129, 128);
    look_at(&l, SLANTED, &as_planned, &sloped);
    assert_true(sloped.plan.effects[EFFECT_NORMAL_MAPS].on);
    assert_near(seen(&sloped, 0, 1), sloping(0, 1), 1e-5);
    assert_near(seen(&sloped, 3, 1), sloping(3.0 / 255.0, 1), 1e-4);
    assert_true(seen(&sloped, 3, 1) < 0.99 * sloping(0, 1));
    lab_close(&l);
}

TEST(a_slope_of_a_normal_map_shows_in_views_and_comes_back_to_sensors)
{
    static const char yaml[] = ROOM("0.3") "scene: floor.gltf\nlights: [" POINT "]\n" GRID;
    look sloped;
    outcome planned, forced, needed;
    lab l;
    lab_open(&l);
    write_bumps(&l, 191, 128);
    look_at(&l, SLANTED, &as_planned, &sloped);
    assert_near(seen(&sloped, 3, 1), sloping(2.0 * 191 / 255 - 1.0, 1), 1e-4);
    run(&l, yaml, &as_planned, &needed);
    assert_true(is_on(&needed, EFFECT_NORMAL_MAPS));
    write_bumps(&l, 127, 127);
    run(&l, yaml, &as_planned, &planned);
    run(&l, yaml, &all_is_on, &forced);
    assert_false(is_on(&planned, EFFECT_NORMAL_MAPS));
    assert_agree(&planned, &forced);
    lab_close(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_solid_of_index_1_bends_nothing),
        cmocka_unit_test(a_solid_by_a_hair_denser_than_air_refracts),
        cmocka_unit_test(an_edge_is_smooth_with_antialiasing_and_jagged_without),
        cmocka_unit_test(the_levels_of_rays_are_told_and_kept),
        cmocka_unit_test(antialiasing_is_off_until_there_is_light),
        cmocka_unit_test(a_view_through_index_1_is_that_without_the_solid),
        cmocka_unit_test(a_normal_map_that_is_flat_to_its_last_bit_is_off),
        cmocka_unit_test(a_slope_of_a_normal_map_shows_in_views_and_comes_back_to_sensors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
