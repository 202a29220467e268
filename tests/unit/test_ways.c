/* tests/unit/test_ways.c -- how much light of lamps and suns is focused or goes by narrow lobes,
 * and what is said of it.
 */
#include "sim/scene.h"
#include "tests/gltf_text.h"
#include "tests/lab_sphere.h"
#include "tests/test.h"
#include "tests/told_scene.h"

#define ROOM(glass)                                                                                \
    "room: {size: [4, 6, 3], reflectance: 0.5, windows: [\n"                                       \
    "  {wall: south, at: [0.5, 0.9], size: [3, 1.5], transmittance: " glass "}]}\n"
#define SUN   "sky: {model: clear, horizontal: 10000, sun_illuminance: 80000, sun_at: "
#define FLOOR "materials: [{match: 'room: floor', "
#define HIGH  SUN "{azimuth: 180, elevation: 40}}\n"

static void assert_no_way(scene_ways w)
{
    assert_true(w.focused == 0.0);
    assert_true(w.narrow == 0.0);
}

/* ---- plane mirrors: images are asked for ----------------------------------------------------- */

TEST(panes_and_plane_mirrors_focus_nothing)
{
    const scene *s = told_scene_of(
        ROOM("0.8") FLOOR "mirror: 0.8}]\n" HIGH "lights: [{type: point, at: [2, 3, 2], lumens: "
                          "1000}]\n");
    assert_non_null(s->mirror_images);
    assert_no_way(s->by_suns);
    assert_no_way(s->by_lamps);
    assert_null(scene_left_to_chance(s, false));
    assert_false(was_told("by way of"));
}

/* ---- balls ----------------------------------------------------------------------------------- */

/* A ball of radius 0.5 m in a room, 0.6 m from a point lamp, of whose light the share (1 - sqrt(1 -
 * (r/d)^2)) / 2 meets it. */
static double share_met(void) { return 0.5 * (1.0 - sqrt(1.0 - 25.0 / 36.0)); }

static const scene *with_ball_of(double radius, const char *made_of, const char *more)
{
    lab l;
    lab_open(&l);
    lab_sphere(&l, "ball.gltf", (dvec3){ 2.5, 1.5, 1.5 }, radius, 64, made_of);
    const scene *s = told_scene_of(text_of(told_memory(),
                                           "room: {size: [5, 3, 3], reflectance: 0.5}\n"
                                           "scene: %s/ball.gltf\n%s",
                                           l.folder, more));
    lab_close(&l);
    return s;
}

static const scene *with_ball(const char *made_of, const char *more)
{
    return with_ball_of(0.5, made_of, more);
}

#define LAMP "lights: [{type: point, at: [1.9, 1.5, 1.5], lumens: 1000}]\n"
static const char glass[] =
    "\"name\":\"Ball\",\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"roughnessFactor\":0},"
    "\"extensions\":{\"KHR_materials_transmission\":{\"transmissionFactor\":1},"
    "\"KHR_materials_volume\":{\"thicknessFactor\":1}}";

/* 2 %: 16384 particles, of which every fourth or so meets it, drawn evenly; pieces that are 2.8
 * degrees wide hide 0.1 % less */
TEST(all_that_meets_a_ball_of_clear_glass_is_focused)
{
    const scene *s = with_ball(glass, LAMP);
    assert_true(s->lenses);
    assert_near(s->by_lamps.focused, share_met(), 0.02);
    assert_true(s->by_lamps.narrow == 0.0);
    assert_no_way(s->by_suns);
    assert_true(was_told("% of the light of lamps comes by way of round mirrors or solids of glass "
                         "(first \"Ball\"): "));
    assert_null(scene_left_to_chance(s, false));
}

/* Of two lamps, of which one shines nine times as much away from the ball: of all 0.12 %. Where
 * both are larger than a metre rays meet them often enough. */
TEST(a_little_focused_light_is_looked_for_too)
{
    const scene *s = with_ball(
        glass, "lights: [{type: point, at: [0.2, 1.5, 1.5], lumens: 1000}, {type: cone, at: [1, "
               "1.5, 1.5], aim: [-1, 0, 0], lumens: 9000, inner: 10, outer: 20}]\n");
    assert_true(s->by_lamps.focused > 0.0 && s->by_lamps.focused < SHARE_THAT_MATTERS);
    assert_true(scene_focuses(s));
    s = with_ball(glass, "lights: [{type: rect, at: [1, 1.5, 2.9], size: [1.5, 1.5], lumens: "
                         "1000}]\n");
    assert_true(s->by_lamps.focused > SHARE_THAT_MATTERS);
    assert_false(scene_focuses(s));
    assert_true(scene_is_rarely_met(s));
}

/* Of the rays that look for solids a marble is met by 0.2 in the mean. */
TEST(a_marble_is_no_plate)
{
    const scene *s = with_ball_of(0.01, glass, LAMP);
    assert_true(s->lenses);
    assert_true(scene_focuses(s));
    assert_null(scene_left_to_chance(s, false));
}

TEST(what_a_round_mirror_leaves_is_focused)
{
    const scene *s =
        with_ball("\"name\":\"Ball\"", LAMP "materials: [{match: Ball, mirror: 0.6}]\n");
    double q = share_met();
    assert_near(s->by_lamps.focused, 0.6 * q / (1.0 - q + 0.6 * q), 0.02);
    assert_false(s->lenses);
}

TEST(a_matt_ball_focuses_nothing)
{
    const scene *s = with_ball("\"name\":\"Ball\"", LAMP);
    assert_no_way(s->by_lamps);
    assert_null(scene_left_to_chance(s, false));
}

/* ---- narrow lobes ---------------------------------------------------------------------------- */

#define GLOSS "reflectance: 0.2, specular: 0.4, exponent: 5000}]\n"

/* Half of the room's sun falls on a floor that is nearly a mirror, and sends it to the ceiling. */
TEST(sunlight_by_narrow_lobes_is_told_of)
{
    const scene *s = told_scene_of(ROOM("1") FLOOR GLOSS HIGH);
    assert_true(s->by_suns.narrow > SHARE_THAT_MATTERS);
    assert_true(s->by_suns.focused == 0.0);
    assert_true(was_told("of the light of suns comes by way of narrow lobes (first \"room: "
                         "floor\"): it is found rarely, intervals are not valid"));
    assert_non_null(scene_left_to_chance(s, false));
    assert_null(scene_left_to_chance(s, true));
}

TEST(narrow_lobes_in_the_shade_are_not)
{
    const scene *s = told_scene_of(ROOM("1") "materials: [{match: 'room: ceiling', " GLOSS SUN
                                             "{azimuth: 180, elevation: "
                                             "40}}\n");
    assert_no_way(s->by_suns);
    assert_null(scene_left_to_chance(s, false));
}

TEST(lamps_by_narrow_lobes_are_told_of_unless_rays_meet_them)
{
    const scene *s = told_scene_of(ROOM("1") FLOOR GLOSS
                                   "lights: [{type: point, at: [2, 3, 2], lumens: 1000}]\n");
    assert_true(s->lamps_hide);
    assert_true(s->by_lamps.narrow > SHARE_THAT_MATTERS);
    assert_true(was_told("of the light of lamps comes by way of narrow lobes"));
    assert_non_null(scene_left_to_chance(s, false));
    s = told_scene_of(ROOM("1") FLOOR GLOSS
                      "lights: [{type: rect, at: [2, 3, 2.9], size: [3, 3], lumens: 1000}]\n");
    assert_false(s->lamps_hide);
    assert_true(s->by_lamps.narrow > SHARE_THAT_MATTERS);
    assert_false(was_told("narrow lobes"));
    assert_null(scene_left_to_chance(s, false));
}

#define CASE(name) cmocka_unit_test_setup_teardown(name, told_prepare, told_forget)

int main(void)
{
    const struct CMUnitTest tests[] = {
        CASE(panes_and_plane_mirrors_focus_nothing),
        CASE(all_that_meets_a_ball_of_clear_glass_is_focused),
        CASE(a_little_focused_light_is_looked_for_too),
        CASE(a_marble_is_no_plate),
        CASE(what_a_round_mirror_leaves_is_focused),
        CASE(a_matt_ball_focuses_nothing),
        CASE(sunlight_by_narrow_lobes_is_told_of),
        CASE(narrow_lobes_in_the_shade_are_not),
        CASE(lamps_by_narrow_lobes_are_told_of_unless_rays_meet_them),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
