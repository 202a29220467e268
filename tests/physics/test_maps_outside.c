/* tests/physics/test_maps_outside.c -- illumination maps of a room beside a sunlit yard: particles
 * that are aimed at its window and divided before it (map_portals.c, map_split.c).
 */
#include "sim/map_parts.h"
#include "tests/folder.h"
#include "tests/gltf_text.h"
#include "tests/lab.h"
#include "tests/program.h"
#include "tests/test.h"
#include "tests/transports.h"

#include <stdio.h>

static const scene *courtyard(arena *a)
{
    lux_error err = { 0 };
    char path[4096];
    snprintf(path, sizeof path, "%s/data/courtyard/courtyard.yaml", project_root());
    const study *from = study_read(a, path, "noon", NULL, &err);
    const scene *s = from ? scene_new(a, from, &(scene_options){ .threads = 2 }, NULL, &err) : NULL;
    if (!s)
        fail_msg("%s", err.text);
    return s;
}

static const illumination_map *map_of(arena *a, const scene *s, int threads)
{
    lux_error err = { 0 };
    map_options o = {
        .seed = 3, .threads = threads, .particles = 1 << 16, .accuracy = 0.1, .deadline = HUGE_VAL
    };
    const illumination_map *m = illumination_map_new(a, s, &o, &err);
    if (!m)
        fail_msg("%s", err.text);
    return m;
}

/* All light of particles that are divided goes somewhere; only rounding is lost. */
TEST(divided_particles_lose_no_light)
{
    arena a                   = { 0 };
    const scene *s            = courtyard(&a);
    const illumination_map *m = map_of(&a, s, 2);
    map_figures f             = illumination_map_figures(m);
    assert_near((double)f.absorbed.y + (double)f.escaped.y, (double)f.emitted.y, 1e-5);
    assert_true(f.dropped.y == 0.0f);
    arena_clear(&a);
}

TEST(maps_do_not_depend_on_threads)
{
    arena a                     = { 0 };
    const scene *s              = courtyard(&a);
    const illumination_map *one = map_of(&a, s, 1), *three = map_of(&a, s, 3);
    assert_int_equal(one->cells.node_count, three->cells.node_count);
    size_t n = map_bins(one) * (size_t)one->slots * SCRAMBLES * 3;
    assert_memory_equal(one->values, three->values, n * sizeof *one->values);
    arena_clear(&a);
}

/* Both are asked for 10 %, half-widths of 95 %: by themselves off by 5 % at most, and 7 % together.
 * Without being aimed particles leave the room's map half-widths of 20 %. */
TEST(a_room_beside_a_sunlit_yard_has_the_light_that_paths_find)
{
    arena a        = { 0 };
    const scene *s = courtyard(&a);
    grid_result maps, paths;
    run_options o = {
        .accuracy = 0.1, .deadline = HUGE_VAL, .seed = 1, .threads = 2, .transport = TRANSPORT_MAPS
    };
    grid_of_scene(&a, s, 0, &o, &maps);
    o.transport = TRANSPORT_PATH;
    o.seed      = 2;
    grid_of_scene(&a, s, 0, &o, &paths);
    double square = 0.0;
    for (int k = 0; k < maps.sensor_count; k++) {
        double of  = fmax(paths.illuminance[k], 0.1 * paths.average);
        double off = (maps.illuminance[k] - paths.illuminance[k]) / of;
        square += off * off / maps.sensor_count;
    }
    assert_true(sqrt(square) < 0.07);
    assert_true(maps.worst_half_width < 0.15);
    arena_clear(&a);
}

/* A white wall on white ground. Where paths end in maps no ray goes on to find what of the sky is
 * darker than its mean: without it 3 % and more would be missing here. */
TEST(where_paths_end_all_of_the_sky_is_asked)
{
    lab l;
    lab_open(&l);
    quad side[2] = { { { { -4, -4, 0 }, { 4, -4, 0 }, { 4, 4, 0 }, { -4, 4, 0 } } },
                     { { { 3, -4, 0 }, { 3, -4, 4 }, { 3, 4, 4 }, { 3, 4, 0 } } } };
    lab_quads(&l, "yard.gltf", side, 2, "\"name\":\"Matt\"");
    const lab_probe p[] = { { { 2.9, 0.1, 0.5 }, { 0, 0, 1 } },
                            { { 2.9, 0.1, 1.5 }, { 1, 0, 0 } },
                            { { 0.2, 0.3, 0.5 }, { 0.6, 0, -0.8 } } };
    grid_result r[TRANSPORTS];
    for (int t = 0; t < TRANSPORTS; t++)
        lab_measure(&l,
                    "scene: yard.gltf\nmaterials: [{match: Matt, reflectance: 0.8}]\n"
                    "sky: {model: overcast, horizontal: 10000, ground: 0.2}",
                    NULL, p, 3,
                    &(run_options){ .accuracy = 0.02, .seed = 1, .transport = transports[t] },
                    &r[t]);
    for (int k = 0; k < 3; k++) {
        double apart = fabs(r[0].illuminance[k] - r[1].illuminance[k]);
        double joint = hypot(r[0].half_width[k], r[1].half_width[k]);
        assert_true(apart <= 1.5 * joint && joint <= 0.06 * r[0].illuminance[k]);
    }
    lab_close(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(divided_particles_lose_no_light),
        cmocka_unit_test(maps_do_not_depend_on_threads),
        cmocka_unit_test(a_room_beside_a_sunlit_yard_has_the_light_that_paths_find),
        cmocka_unit_test(where_paths_end_all_of_the_sky_is_asked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
