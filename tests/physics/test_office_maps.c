/* tests/physics/test_office_maps.c -- illumination maps against paths in the office. */
#include "tests/physics/maps_against_paths.h"

TEST(maps_of_the_office_agree_with_paths) { maps_agree_with_paths("office/office.yaml", NULL); }

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(maps_of_the_office_agree_with_paths),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
