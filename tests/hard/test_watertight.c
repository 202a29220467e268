/* tests/hard/test_watertight.c -- no ray leaves a closed room; long_watertight.c tries more. */
#include "tests/hard/watertight.h"

TEST(no_ray_leaves_by_a_corner_an_edge_or_a_face)
{
    for (int k = 0; k < ROOMS; k++) {
        room r    = room_make(k, 4);
        int leaks = leaks_of_aimed_rays(&r, 35000, 1 + (uint32_t)k);
        if (leaks)
            fail_msg("room %d: %d leaks", k, leaks);
        shape_clear(&r.s);
    }
}

TEST(no_path_leaves_or_meets_what_it_has_just_left)
{
    for (int k = 0; k < ROOMS; k++) {
        room r   = room_make(k, 4);
        strays s = strays_of_paths(&r, 1000, 20, 3 + (uint32_t)k);
        if (s.left || s.again)
            fail_msg("room %d: %d left, %d met the same again", k, s.left, s.again);
        shape_clear(&r.s);
    }
}

/* What the other test is slower for */
TEST(the_projection_test_leaks_here)
{
    int leaks = 0;
    for (int k = 0; k < ROOMS; k++) {
        room r = room_make(k, 4);
        r.test = TRIANGLE_PROJECTION;
        int l  = leaks_of_aimed_rays(&r, 10000, 1 + (uint32_t)k);
        print_message("room %d: %d of 10000\n", k, l);
        leaks += l;
        shape_clear(&r.s);
    }
    assert_true(leaks > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_ray_leaves_by_a_corner_an_edge_or_a_face),
        cmocka_unit_test(no_path_leaves_or_meets_what_it_has_just_left),
        cmocka_unit_test(the_projection_test_leaks_here),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
