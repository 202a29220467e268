/* tests/unit/test_courtyard.c -- the courtyard as shipped is what its program makes, and is sound.
 */
#include "data/courtyard/courtyard.h"
#include "tests/solids.h"
#include "tests/test.h"

static model built;

static int forget(void **state)
{
    (void)state;
    model_clear(&built);
    return 0;
}

static bool write_glb(FILE *to)
{
    courtyard_build(&built);
    return model_write_glb(&built, to);
}

TEST(the_file_in_the_repository_is_that_which_the_program_makes)
{
    assert_file_is("data/courtyard/courtyard.glb", write_glb);
}

TEST(every_solid_is_closed_and_looks_outward_and_no_triangle_is_flat)
{
    courtyard_build(&built);
    assert_false(built.overflow);
    for (int i = 0; i < built.shape_count; i++)
        for (int k = 0; k < PAINT_COUNT; k++) {
            const patch *t = &built.shapes[i].patches[k];
            double volume6;
            if (!t->triangle_count || k == GLASS)
                continue;
            if (!patch_is_closed(t) || !(patch_least_area(t, &volume6) > 1e-9) || !(volume6 > 0.0))
                fail_msg("%s, %s: open, inside out, or a triangle under 0.001 mm^2",
                         built.shapes[i].name, courtyard_paints[k].name);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(the_file_in_the_repository_is_that_which_the_program_makes,
                                  forget),
        cmocka_unit_test_teardown(every_solid_is_closed_and_looks_outward_and_no_triangle_is_flat,
                                  forget),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
