/* tests/unit/test_plan.c -- what plans decide, of whom they obey, and how they say why. */
#include "sim/plan.h"
#include "tests/folder.h"
#include "tests/test.h"

#include <string.h>

#define ROOM(reflectance) "lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: " reflectance "}\n"
#define POINT             "lights: [{type: point, at: [2, 1, 2], lumens: 1000}]\n"
#define DISK              "lights: [{type: disk, at: [2, 1, 2], radius: 0.2, lumens: 1000}]\n"
#define GRID              "grids: [{name: g, on: room, height: 0.75, margin: 0.5, spacing: 1}]\n"
#define VIEW              "views: [{name: v, eye: [0.5, 0.5, 1.5], target: [4, 3, 1], fov: 60, size: [8, 6]}]\n"

static arena memory;

static const scene *plan_of(const char *yaml, plan_options o, plan *out)
{
    notices said   = { .a = &memory };
    lux_error err  = { 0 };
    o.accuracy     = o.accuracy > 0.0 ? o.accuracy : (double)NAN;
    const scene *s = scene_of_text(&memory, yaml);
    if (!plan_make(s, &o, out, &said, &err))
        fail_msg("%s", err.text);
    return s;
}

static void assert_why(const plan *p, effect e, bool on, const char *why)
{
    assert_int_equal(p->effects[e].on, on);
    if (!strstr(p->effects[e].why, why))
        fail_msg("%s: `%s`, not `%s`", effect_name(e), p->effects[e].why, why);
}

/* 0.5^8 < 0.02 / 5 < 0.5^7 */
TEST(a_bare_room_calls_for_one_effect)
{
    plan p;
    plan_of(ROOM("0.5") POINT GRID, (plan_options){ 0 }, &p);
    for (int e = 0; e < EFFECTS; e++)
        assert_int_equal(p.effects[e].on, e == EFFECT_INTERREFLECTION);
    assert_int_equal(p.off, 0);
    assert_true(p.bound == 0.0);
    assert_why(&p, EFFECT_SHADOWS, false, "nothing stands between any lamp and any sensor");
    assert_why(&p, EFFECT_AREA_LIGHTS, false, "the lamp is a point");
    assert_why(&p, EFFECT_INTERREFLECTION, true,
               "100 % of the surface area reflects more than 20 %, in the mean 50 %: about 8 ");
    arena_clear(&memory);
}

/* Of a cube one side of six is bright; (0.8 + 4 * 0.1 + 0.2) / 6 = 0.233. */
TEST(areas_are_those_of_the_surfaces)
{
    plan p;
    plan_of("lux4: 1\nroom: {size: [2, 2, 2], reflectance: {ceiling: 0.8, walls: 0.1, floor: 0.2}}"
            "\nlights: [{type: point, at: [1, 1, 1], lumens: 1}]\n",
            (plan_options){ 0 }, &p);
    assert_why(&p, EFFECT_INTERREFLECTION, true,
               "17 % of the surface area reflects more than 20 %, in the mean 23 %");
    arena_clear(&memory);
}

TEST(the_user_has_the_last_word)
{
    plan p;
    plan_of(ROOM("0.5") DISK GRID, (plan_options){ .no = 1u << EFFECT_AREA_LIGHTS }, &p);
    assert_true(p.effects[EFFECT_AREA_LIGHTS].forced && p.effects[EFFECT_AREA_LIGHTS].missed);
    assert_why(&p, EFFECT_AREA_LIGHTS, false,
               "left out as asked: 1 of 1 lamp is more than a point");
    assert_int_equal(plan_without(&p), 1u << EFFECT_AREA_LIGHTS);
    assert_true(p.bound == 0.0); /* of what is missed none is known */

    plan_of(ROOM("0.5") DISK GRID,
            (plan_options){ .has_only = true,
                            .only     = 1u << EFFECT_SUN | 1u << EFFECT_SHADOWS,
                            .no       = 1u << EFFECT_SUN },
            &p);
    for (int e = 0; e < EFFECTS; e++)
        assert_int_equal(p.effects[e].on, e == EFFECT_SHADOWS);
    assert_true(p.effects[EFFECT_INTERREFLECTION].missed && !p.effects[EFFECT_SUN].missed);

    plan_of(ROOM("0") DISK GRID, (plan_options){ .has_only = true, .only = ~0u }, &p);
    for (int e = 0; e < EFFECTS; e++)
        assert_true(p.effects[e].on && p.effects[e].forced);
    assert_int_equal(p.off, 0);
    arena_clear(&memory);
}

TEST(direct_light_alone_is_no_miss)
{
    plan p;
    run_options r = { 0 };
    plan_of(ROOM("0.5") POINT GRID, (plan_options){ .direct_only = true }, &p);
    assert_why(&p, EFFECT_INTERREFLECTION, false, "left out as asked: --direct-only");
    assert_false(p.effects[EFFECT_INTERREFLECTION].missed);
    plan_apply(&p, &r);
    assert_true(r.direct_only && r.transport == TRANSPORT_PATH);
    arena_clear(&memory);
}

/* A sun is no lamp; materials that light does not come back from are counted. */
TEST(reasons_count_what_they_name)
{
    static const char sunny[] =
        "lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: 0.5, windows: [{wall: south, at: [1, 1], "
        "size: [2, 1]}]}\nsky: {model: clear, horizontal: 5000, sun_illuminance: 20000, sun_at: "
        "{azimuth: 180, elevation: 40}}\n" GRID;
    plan p;
    plan_of(sunny, (plan_options){ 0 }, &p);
    assert_why(&p, EFFECT_SHADOWS, true, "something may stand before sun and sky");
    assert_why(&p, EFFECT_MANY_LIGHTS, false, "there is no lamp");
    assert_why(&p, EFFECT_NEAR_FIELD, false, "there is no luminaire");
    assert_why(&p, EFFECT_SKY, true, "it gives light, and the ground below");
    assert_why(&p, EFFECT_PORTALS, true, "looked for through openings (1 room window)");
    plan_of(ROOM("0.5") POINT "materials: [{match: 'room: floor', mirror: 0.5}]\n" GRID,
            (plan_options){ .direct_only = true }, &p);
    assert_why(&p, EFFECT_MIRRORS, false,
               "1 material calls for it, but no light comes back from surfaces");
    plan_of(ROOM("0.5") POINT GRID, (plan_options){ .has_only = true, .only = ~0u }, &p);
    assert_why(&p, EFFECT_SUN, true, "asked for, though the study has none");
    assert_why(&p, EFFECT_INTERREFLECTION, true, "asked for: 100 % of");
    arena_clear(&memory);
}

/* All that is off, but for what the user says, comes to less than a fifth of the accuracy; without
 * room for it the bound of the disk alone keeps it on. */
TEST(bounds_stay_below_a_fifth_of_the_accuracy)
{
    plan p;
    const char *yaml = ROOM(
        "0.000001") "lights: [{type: disk, at: [2, 1, 2.2], radius: 0.01, lumens: 1000}]\n" GRID;
    plan_of(yaml, (plan_options){ .accuracy = 0.1 }, &p);
    double sum = 0.0;
    for (int e = 0; e < EFFECTS; e++)
        sum += p.effects[e].bound;
    assert_false(p.effects[EFFECT_INTERREFLECTION].on || p.effects[EFFECT_AREA_LIGHTS].on);
    assert_true(p.effects[EFFECT_INTERREFLECTION].bound > 0.0);
    assert_true(p.effects[EFFECT_AREA_LIGHTS].bound > 0.0);
    assert_near(p.bound, sum, 1e-12);
    assert_true(p.bound < 0.02);
    assert_why(&p, EFFECT_AREA_LIGHTS, false, "1 lamp of extent: point within ");
    assert_why(&p, EFFECT_INTERREFLECTION, false, "no surface reflects more than 0.0001 %");

    double both = p.bound, disk = p.effects[EFFECT_AREA_LIGHTS].bound;
    plan_of(yaml, (plan_options){ .accuracy = 5.0 * (both - 0.5 * disk) }, &p);
    assert_true(p.effects[EFFECT_AREA_LIGHTS].on);
    assert_false(p.effects[EFFECT_INTERREFLECTION].on);
    arena_clear(&memory);
}

/* Rays of a view look at surfaces, and lie all over their pixels. */
TEST(views_are_planned_for_as_views)
{
    plan p;
    plan_of(ROOM("0") POINT VIEW, (plan_options){ .views = true }, &p);
    assert_true(p.effects[EFFECT_ANTIALIASING].on);
    assert_near(p.accuracy, 0.1, 0.0);
    plan_of(ROOM("0.5") POINT VIEW,
            (plan_options){ .views = true, .no = 1u << EFFECT_ANTIALIASING }, &p);
    assert_int_equal(plan_without(&p), 1u << EFFECT_ANTIALIASING);
    arena_clear(&memory);
}

/* Some samples of paths are drawn where nothing else decides (tests/physics/test_plan_pilot.c). */
TEST(transport_is_told_with_its_reason)
{
    plan p;
    plan_of(ROOM("0.5") POINT GRID, (plan_options){ 0 }, &p);
    assert_int_equal(p.transport, TRANSPORT_PATH);
    assert_non_null(strstr(p.transport_why, "paths reach 2 % after about "));
    plan_of(ROOM("0.5") POINT GRID, (plan_options){ .transport = TRANSPORT_MAPS }, &p);
    assert_int_equal(p.transport, TRANSPORT_MAPS);
    assert_string_equal(p.transport_why, "asked for");
    plan_of(ROOM("0.5") POINT GRID, (plan_options){ .series = true }, &p);
    assert_int_equal(p.transport, TRANSPORT_PATH);
    assert_string_equal(p.transport_why, "all moments of a series are weighed from the same paths");
    plan_of(ROOM("0") POINT GRID, (plan_options){ 0 }, &p);
    assert_string_equal(p.transport_why, "no light comes back from surfaces");
    arena_clear(&memory);
}

#define DAY                                                                                        \
    "site: {place: \"55N 37E\", zone: Europe/Moscow}\nwhen: 2026-06-21T12:00\n"                    \
    "sky: {model: overcast}\nmaintenance: 0.8\n"

TEST(daylight_beside_maintained_light_goes_by_paths)
{
    plan p;
    const scene *s = plan_of(ROOM("0.5") POINT GRID DAY, (plan_options){ 0 }, &p);
    assert_true(grid_needs_paths(s));
    assert_int_equal(p.transport, TRANSPORT_PATH);
    assert_string_equal(p.transport_why,
                        "daylight is told apart from light that needs maintenance");
    arena_clear(&memory);
}

TEST(effects_are_found_by_their_whole_names)
{
    for (int e = 0; e < EFFECTS; e++)
        assert_int_equal(effect_find(effect_name((effect)e), strlen(effect_name((effect)e))), e);
    assert_int_equal(effect_find("sun,sky", 3), EFFECT_SUN);
    assert_int_equal(effect_find("su", 2), EFFECTS);
    assert_int_equal(effect_find("", 0), EFFECTS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_bare_room_calls_for_one_effect),
        cmocka_unit_test(areas_are_those_of_the_surfaces),
        cmocka_unit_test(the_user_has_the_last_word),
        cmocka_unit_test(direct_light_alone_is_no_miss),
        cmocka_unit_test(reasons_count_what_they_name),
        cmocka_unit_test(bounds_stay_below_a_fifth_of_the_accuracy),
        cmocka_unit_test(views_are_planned_for_as_views),
        cmocka_unit_test(transport_is_told_with_its_reason),
        cmocka_unit_test(daylight_beside_maintained_light_goes_by_paths),
        cmocka_unit_test(effects_are_found_by_their_whole_names),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
