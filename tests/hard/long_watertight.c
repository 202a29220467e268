/* tests/hard/long_watertight.c -- ten million rays and paths that try to leave closed rooms, and
 * a million rays against testing everything. */
#include "tests/hard/watertight.h"

#include <string.h>

TEST(none_of_ten_million_rays_leaves)
{
    for (int cells = 2; cells <= 32; cells *= 2)
        for (int k = 0; k < ROOMS; k++) {
            room r    = room_make(k, cells);
            int leaks = leaks_of_aimed_rays(&r, 225000, (uint32_t)(100 * cells + k));
            if (leaks)
                fail_msg("room %d of %d cells: %d leaks", k, cells, leaks);
            shape_clear(&r.s);
        }
}

/* Not the slivers of two rings: edges of a degree, and a start moved off one side is past the
 * other. */
TEST(no_path_of_four_million_bounces_goes_astray)
{
    for (int cells = 4; cells <= 32; cells *= 2)
        for (int k = 0; k < ROOMS; k++) {
            room r   = room_make(k, cells);
            strays s = strays_of_paths(&r, 6000, 20, (uint32_t)(7 * cells + k));
            if (s.left || s.again)
                fail_msg("room %d of %d cells: %d left, %d met the same again", k, cells, s.left,
                         s.again);
            shape_clear(&r.s);
        }
}

TEST(a_million_rays_meet_what_testing_everything_meets)
{
    shape s       = { 0 };
    uint32_t seed = 5;
    arena a       = { 0 };
    lux_error err = { 0 };
    shape_soup(&s, 500, 0.4f, 77);
    shape_box(&s, (vec3){ -0.5f, -0.5f, -0.5f }, (vec3){ 0.5f, 0.5f, 0.5f }, 4);
    mesh m           = shape_mesh(&s);
    world_instance i = { .place = TRANSFORM_IDENTITY };
    world_desc d     = { &m, 1, &i, 1, TRIANGLE_WATERTIGHT, 2 };
    world *w         = world_new(&a, &d, &err);
    assert_non_null(w);
    for (int n = 0; n < 1000000; n += LANES) {
        vray r    = { 0 };
        vmask all = ALL_LANES;
        for (int k = 0; k < LANES; k++) {
            vec3 o = random_offset(1.5f, &seed);
            ray_set(&r, k, o, random_direction(&seed), INFINITY);
        }
        vhit got, want = brute_first(&d, &r, all);
        world_first_hit(w, &r, &all, 1, RAYS_COHERENT, &got);
        assert_memory_equal(&got, &want, sizeof got);
    }
    arena_clear(&a);
    shape_clear(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(none_of_ten_million_rays_leaves),
        cmocka_unit_test(no_path_of_four_million_bounces_goes_astray),
        cmocka_unit_test(a_million_rays_meet_what_testing_everything_meets),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
