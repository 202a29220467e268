/* tests/unit/long_gltf.c -- a hierarchy a million nodes deep: seconds, and a gigabyte, go to the
 * library's own structures. */
#include "sim/gltf.h"
#include "tests/gltf_text.h"
#include "tests/test.h"

#include <stdio.h>

TEST(a_million_deep_hierarchy_is_walked_without_a_stack)
{
    enum { DEEP = 1000000 };
    arena a    = { 0 };
    char *text = arena_array(&a, char, 200 + 24 * (size_t)DEEP, NULL);
    char *at = text + sprintf(text, "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],"
                                    "\"nodes\":[");
    for (int i = 1; i < DEEP; i++)
        at += sprintf(at, "{\"children\":[%d]},", i);
    at += sprintf(at, "{\"translation\":[1,2,3]}]}");

    lux_error err = { 0 };
    const gltf *g = read_bytes(&a, "scene.gltf", text, (size_t)(at - text), NULL, &err);
    assert_non_null(g);
    assert_int_equal(g->node_count, DEEP);
    assert_near(g->nodes[DEEP - 1].place.m[2][3], 2, 0);
    scratch_remove();
    arena_clear(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_million_deep_hierarchy_is_walked_without_a_stack),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
