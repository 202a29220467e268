/* tests/physics/test_plan_pilot.c -- transports that pilots choose, against runs by both.
 *
 * Rays of particles count as many times as sim/plan_pilot.c says of them: twice.
 */
#include "sim/plan.h"
#include "tests/folder.h"
#include "tests/test.h"

#include <string.h>

#define LAMP "lights: [{type: disk, at: [3, 2, 2.7], radius: 0.2, lumens: 3000}]\n"

/* 1925 sensors, between surfaces that give most light back: at each a path goes on for long. */
#define BRIGHT                                                                                     \
    "lux4: 1\nroom: {size: [6, 4, 2.8], reflectance: 0.8}\n" LAMP                                  \
    "grids: [{name: g, on: room, height: 0.75, margin: 0.25, spacing: 0.1}]\naccuracy: 10%\n"

/* 3200 sensors, and dull surfaces: paths are short, and a map for that takes two million particles.
 */
#define DULL                                                                                       \
    "lux4: 1\nroom: {size: [6, 4, 2.8], reflectance: 0.3}\n" LAMP                                  \
    "grids: [{name: g, on: room, height: 0.75, margin: 1, spacing: 0.05}]\naccuracy: 0.6%\n"

static arena memory;

static const scene *planned(const char *yaml, plan_options o, plan *out)
{
    lux_error err  = { 0 };
    notices said   = { .a = &memory };
    const scene *s = scene_of_text(&memory, yaml);
    o.accuracy     = (double)NAN;
    if (!plan_make(s, &o, out, &said, &err))
        fail_msg("%s", err.text);
    return s;
}

/* Rays until the accuracy is reached. */
static double rays_by(const scene *s, const plan *p, transport t)
{
    lux_error err = { 0 };
    grid_result r;
    run_options o = {
        .accuracy = (double)NAN, .deadline = HUGE_VAL, .seed = 1, .threads = 2, .bound = p->bound
    };
    o.transport = t;
    if (!grid_run(&memory, s, &s->study->grids[0], &o, &r, &err))
        fail_msg("%s", err.text);
    assert_int_equal(r.end, RUN_DONE);
    assert_int_equal(r.missed, 0);
    double particles = t == TRANSPORT_MAPS ? (double)r.known_rays : 0.0;
    return (double)r.rays + particles;
}

static void assert_sooner(const char *yaml, transport sooner)
{
    transport other = sooner == TRANSPORT_MAPS ? TRANSPORT_PATH : TRANSPORT_MAPS;
    plan p;
    const scene *s = planned(yaml, (plan_options){ .seed = 1 }, &p);
    assert_int_equal(p.transport, sooner);
    assert_non_null(strstr(p.transport_why, "maps"));
    double taken = rays_by(s, &p, sooner), left = rays_by(s, &p, other);
    if (!(taken < left))
        fail_msg("%s: %g rays, the other way %g", p.transport_why, taken, left);
    arena_clear(&memory);
}

TEST(many_sensors_in_a_bright_room_go_by_maps) { assert_sooner(BRIGHT, TRANSPORT_MAPS); }

TEST(a_dull_room_goes_by_paths) { assert_sooner(DULL, TRANSPORT_PATH); }

static void assert_same_plan(const char *yaml, bool views)
{
    plan first, other;
    planned(yaml, (plan_options){ .seed = 7, .threads = 1, .views = views }, &first);
    for (int threads = 1; threads <= 3; threads++) {
        planned(yaml, (plan_options){ .seed = 7, .threads = threads, .views = views }, &other);
        assert_int_equal(other.transport, first.transport);
        assert_string_equal(other.transport_why, first.transport_why);
    }
    arena_clear(&memory);
}

/* To the words, in which the rays are told. */
TEST(a_seed_has_one_plan_whatever_the_threads)
{
    static const char view[] =
        BRIGHT "views: [{name: v, eye: [1, 1, 1.5], target: [6, 4, 1], size: [200, 150]}]\n";
    assert_same_plan(BRIGHT, false);
    assert_same_plan(DULL, false);
    assert_same_plan(view, true);
}

TEST(who_stops_pilots_stops_the_plan)
{
    volatile bool stop = true;
    progress p         = { .stop = &stop };
    lux_error err      = { 0 };
    plan_options o     = { .accuracy = (double)NAN, .seed = 1, .progress = &p };
    plan out;
    assert_false(plan_make(scene_of_text(&memory, BRIGHT), &o, &out, NULL, &err));
    assert_int_equal(err.code, ERR_INTERRUPTED);
    arena_clear(&memory);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(many_sensors_in_a_bright_room_go_by_maps),
        cmocka_unit_test(a_dull_room_goes_by_paths),
        cmocka_unit_test(a_seed_has_one_plan_whatever_the_threads),
        cmocka_unit_test(who_stops_pilots_stops_the_plan),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
