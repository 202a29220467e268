/* tests/physics/long_maps.c -- illumination maps against paths in all shipped scenes. */
#include "tests/physics/maps_against_paths.h"

TEST(maps_of_the_office) { maps_agree_with_paths("office/office.yaml", NULL); }
TEST(maps_of_the_room_of_glass) { maps_agree_with_paths("glass/glass.yaml", NULL); }
TEST(maps_of_the_car) { maps_agree_with_paths("car/car.yaml", NULL); }
TEST(maps_of_the_courtyard) { maps_agree_with_paths("courtyard/courtyard.yaml", "noon"); }

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(maps_of_the_office),
        cmocka_unit_test(maps_of_the_room_of_glass),
        cmocka_unit_test(maps_of_the_car),
        cmocka_unit_test(maps_of_the_courtyard),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
