/* tests/unit/test_glints.c -- when sunlight by way of mirrors and panes matters, and is said to. */
#include "sim/scene.h"
#include "tests/quads_gltf.h"
#include "tests/test.h"
#include "tests/told_scene.h"

#include <stdio.h>
#include <string.h>

#define ROOM(glass)                                                                                \
    "room: {size: [4, 6, 3], reflectance: 0.5, windows: [\n"                                       \
    "  {wall: south, at: [0.5, 0.9], size: [3, 1.5], transmittance: " glass "}]}\n"
#define SUN "sky: {model: clear, horizontal: 10000, sun_illuminance: 80000, sun_at: "

/* Its sun falls on floor and walls, what the pane reflects leaves to the sky. */
TEST(a_pane_alone_hides_no_sunlight)
{
    const scene *s = told_scene_of(ROOM("0.8") SUN "{azimuth: 190, elevation: 40}}\n");
    assert_int_equal(s->sun_count, 1);
    assert_true(s->mirrors);
    assert_false(s->glints);
    assert_false(s->mirrors_hide);
    assert_null(scene_left_to_chance(s, false));
}

/* Half of the room's sun falls on a mirror, which sends it to the ceiling. */
TEST(a_mirror_in_the_sun_is_told_of)
{
    const scene *s =
        told_scene_of(ROOM("1") "materials: [{match: 'room: floor', mirror: 0.8}]\n" SUN
                                "{azimuth: 180, elevation: 40}}\n");
    assert_true(s->glints);
    assert_true(was_told("of the sunlight comes by way of mirrors, panes or smooth surfaces (first "
                         "\"room: floor\") and is not found"));
    assert_non_null(scene_left_to_chance(s, false));
    assert_null(scene_left_to_chance(s, true));
}

TEST(a_mirror_in_the_shade_is_not)
{
    const scene *s =
        told_scene_of(ROOM("1") "materials: [{match: 'room: ceiling', mirror: 0.8}]\n" SUN
                                "{azimuth: 180, elevation: 40}}\n");
    assert_false(s->glints);
    assert_null(scene_left_to_chance(s, false));
}

/* The sun comes by the south window alone, flat enough to leave by the west one, whose pane sends
 * a part of it back. */
TEST(a_second_pane_in_the_beam_is_told_of)
{
#define CORNER(west)                                                                               \
    "room: {size: [4, 4, 3], reflectance: 0.5, windows: [\n"                                       \
    "  {wall: south, at: [0.01, 0.3], size: [3.98, 2.6]},\n"                                       \
    "  {wall: west, at: [0.01, 0.3], size: [3.98, 2.6]" west "}]}\n" SUN                           \
    "{azimuth: 135, elevation: 5}}\n"
    assert_true(told_scene_of(CORNER(", transmittance: 0.8"))->glints);
    assert_false(told_scene_of(CORNER(""))->glints);
}

/* What the notice says, 0 to 1. */
static double share_told(void)
{
    double percent = 0.0;
    for (const notice *n = told_first(); n; n = n->next) {
        const char *at = strstr(n->text, ": about ");
        if (at && strstr(n->text, "of the sunlight"))
            assert_int_equal(sscanf(at, ": about %lf %%", &percent), 1);
    }
    return 0.01 * percent;
}

/* All of the south and the north wall is glass. Sunlight sinks by 1 m on its way through the room:
 * a third of it falls on the floor, R of the rest comes back from the north pane, of which as much
 * falls on the floor, and R of what is then left comes back from the south pane: glints are
 * (R + R^2) / (1 + R + R^2). Of glass R = r (1 + a T), with r = ((n - 1) / (n + 1))^2 and a, what
 * passes once within it, from T = (1 - r)^2 a / (1 - r^2 a^2). The notice has two digits, and is of
 * some 3000 beams: 4 %. */
TEST(the_share_of_glints_is_what_two_panes_send_to_and_fro)
{
    char text[600];
    snprintf(text, sizeof text,
             "room: {size: [4, 6, 3], reflectance: 0.5, windows: [\n"
             "  {wall: south, at: [0.001, 0.001], size: [3.998, 2.998], transmittance: 0.8},\n"
             "  {wall: north, at: [0.001, 0.001], size: [3.998, 2.998], transmittance: 0.8}]}\n" SUN
             "{azimuth: 180, elevation: %.12g}}\n",
             atan(1.0 / 6.0) * 180 / M_PI);
    assert_true(told_scene_of(text)->glints);
    double r = pow(0.52 / 2.52, 2), e2 = (1 - r) * (1 - r), t = 0.8;
    double a = 2 * t / (e2 + sqrt(e2 * e2 + 4 * r * r * t * t)), R = r * (1 + a * t);
    assert_near(share_told(), (R + R * R) / (1 + R + R * R), 0.04);
}

/* Glass of a facade that faces the sun, and a court before it. */
TEST(a_glass_facade_lights_the_court_before_it)
{
    static const char *const materials[] = { "Paving", "Glass" };
    const quad court[]                   = {
                          { "Court", 0, -1, { 0, -10, 0 }, { 10, 0, 0 }, { 0, 10, 0 } },
                          { "Facade", 1, -1, { 0, 0, 0 }, { 10, 0, 0 }, { 0, 0, 8 } },
                          { "Wall", 0, -1, { 0, 0.1, 0 }, { 10, 0, 0 }, { 0, 0, 8 } },
                          { "Opposite", 0, -1, { 0, -10, 0 }, { 10, 0, 0 }, { 0, 0, 3 } },
    };
    quads_gltf_write(told_folder(), "court.gltf", court, 4, materials, 2);
    const scene *s = told_scene_of("scene: court.gltf\n" SUN "{azimuth: 180, elevation: 50}}\n");
    assert_true(s->glints);
    assert_true(was_told("first \"Glass\""));
    s = told_scene_of("scene: court.gltf\n" SUN "{azimuth: 0, elevation: 50}}\n"); /* from behind */
    assert_false(s->glints);
}

TEST(lamps_are_judged_as_before)
{
    const scene *s =
        told_scene_of(ROOM("0.8") SUN "{azimuth: 190, elevation: 40}}\n"
                                      "lights: [{type: point, at: [2, 3, 2], lumens: 1000}]\n");
    assert_true(s->mirrors_hide);
    assert_false(s->glints);
}

#define CASE(name) cmocka_unit_test_setup_teardown(name, told_prepare, told_forget)

int main(void)
{
    const struct CMUnitTest tests[] = {
        CASE(a_pane_alone_hides_no_sunlight),
        CASE(a_mirror_in_the_sun_is_told_of),
        CASE(a_mirror_in_the_shade_is_not),
        CASE(a_second_pane_in_the_beam_is_told_of),
        CASE(the_share_of_glints_is_what_two_panes_send_to_and_fro),
        CASE(a_glass_facade_lights_the_court_before_it),
        CASE(lamps_are_judged_as_before),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
