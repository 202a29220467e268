/* tests/unit/test_exterior.c -- what a study says is outside, by nodes and by materials. */
#include "sim/scene.h"
#include "tests/folder.h"
#include "tests/quads_gltf.h"
#include "tests/test.h"

#include <stdio.h>
#include <string.h>

static arena memory;
static char *folder;
static lux_error err;

static const char *const materials[] = { "Brick", "Grass" };

/* Squares that lie above each other at z = 0, 1, 2, 3: a ray down the middle of each meets it. */
static const quad squares[] = {
    { "Lawn", 1, -1, { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } },
    { "Facade", 0, -1, { 0, 0, 1 }, { 1, 0, 0 }, { 0, 1, 0 } },
    { "Ledge", 0, 1, { 0, 0, 2 }, { 1, 0, 0 }, { 0, 1, 0 } }, /* hangs at the facade */
    { "Shelf", 0, -1, { 0, 0, 3 }, { 1, 0, 0 }, { 0, 1, 0 } },
};

static int prepare(void **state)
{
    (void)state;
    folder = folder_new();
    quads_gltf_write(folder, "a.gltf", squares, 4, materials, 2);
    return 0;
}

static int forget(void **state)
{
    (void)state;
    folder_free(folder);
    arena_clear(&memory);
    return 0;
}

/* `scene` of a study; NULL: refused, with err. */
static const scene *open_scene(const char *entries)
{
    char text[4096], path[4096];
    snprintf(text, sizeof text, "lux4: 1\nscene:\n%s", entries);
    folder_write(folder, "s.yaml", text);
    snprintf(path, sizeof path, "%s/s.yaml", folder);
    err            = (lux_error){ 0 };
    const study *s = study_read(&memory, path, NULL, NULL, &err);
    return s ? scene_new(&memory, s, &(scene_options){ .threads = 1 }, NULL, &err) : NULL;
}

/* Whether what lies at height z above (x + 0.5, 0.5) is outside: 1, 0; -1: nothing lies there. */
static int outside_at(const scene *s, double x, double z)
{
    vec3 from = scene_place(s, (dvec3){ x + 0.5, 0.45, z + 0.25 });
    vray ray  = { vspread(from), vspread((vec3){ 0, 0, -1 }), vsplat(0.5f) };
    vmask one = vlane_index() == 0;
    vhit hit;
    vsurface at;
    world_first_hit(s->world, &ray, &one, 1, RAYS_COHERENT, &hit);
    if (lane(hit.instance, 0) < 0)
        return -1;
    world_surface(s->world, &hit, one, &at);
    int made_of = lane(at.material, 0);
    bool does   = s->material_does[made_of] & DOES_EXTERIOR;
    assert_int_equal(does, s->material_info[made_of].exterior);
    return does;
}

static void assert_outside(const scene *s, double x, int lawn, int facade, int ledge, int shelf)
{
    assert_int_equal(outside_at(s, x, 0), lawn);
    assert_int_equal(outside_at(s, x, 1), facade);
    assert_int_equal(outside_at(s, x, 2), ledge);
    assert_int_equal(outside_at(s, x, 3), shelf);
}

static const scene *good_scene(const char *text)
{
    const scene *s = open_scene(text);
    if (!s)
        fail_msg("%s", err.text);
    return s;
}

TEST(nothing_is_outside_where_nothing_is_said)
{
    const scene *s = good_scene("  {file: a.gltf}");
    assert_false(s->exteriors);
    assert_int_equal(s->material_count, 3); /* glTF's default one is the last */
    assert_outside(s, 0, 0, 0, 0, 0);
}

TEST(a_node_is_outside_with_all_below_it)
{
    const scene *s = good_scene("  {file: a.gltf, exterior: [\"Fac?de\"]}");
    assert_true(s->exteriors);
    assert_int_equal(s->material_count, 4); /* brick is there twice */
    assert_string_equal(s->material_info[3].name, "Brick");
    assert_outside(s, 0, 0, 1, 1, 0);
}

TEST(a_material_is_outside_wherever_it_is)
{
    const scene *s = good_scene("  {file: a.gltf, exterior: Gr*}");
    assert_int_equal(s->material_count, 3); /* grass is nowhere inside */
    assert_outside(s, 0, 1, 0, 0, 0);
    assert_outside(good_scene("  {file: a.gltf, exterior: [Grass, Shelf]}"), 0, 1, 0, 0, 1);
}

TEST(an_entry_speaks_for_its_own_copies_alone)
{
    const scene *s = good_scene("  - {file: a.gltf, at: [[0, 0, 0], [2, 0, 0]], exterior: Facade}\n"
                                "  - {file: a.gltf, at: [4, 0, 0]}\n"
                                "  - {file: a.gltf, at: [6, 0, 0], exterior: [Brick]}\n"
                                "  - {file: a.gltf, at: [8, 0, 0], exterior: ['*']}\n");
    assert_outside(s, 0, 0, 1, 1, 0);
    assert_outside(s, 2, 0, 1, 1, 0);
    assert_outside(s, 4, 0, 0, 0, 0);
    assert_outside(s, 6, 0, 1, 1, 1);
    assert_outside(s, 8, 1, 1, 1, 1);
}

/* 20001 triangles in all and more: then a mesh is no longer copied but placed. */
TEST(placed_meshes_are_outside_where_their_copies_are)
{
    static char text[400000];
    size_t n = (size_t)snprintf(text, sizeof text, "  - {file: a.gltf, at: [");
    for (int i = 0; i < 3400; i++)
        n += (size_t)snprintf(text + n, sizeof text - n, "%s[%d, 0, 0]", i ? "," : "", 2 * i);
    snprintf(text + n, sizeof text - n,
             "], exterior: Facade}\n  - {file: a.gltf, at: [-2, 0, 0]}\n"
             "  - {file: a.gltf, at: [-4, 0, 0], exterior: Brick}\n"
             "  - {file: a.gltf, at: [-6, 0, 0], exterior: [Brick, Lawn]}\n");
    char *whole = arena_array(&memory, char, sizeof text + 100, NULL), path[4096];
    snprintf(whole, sizeof text + 100, "lux4: 1\nscene:\n%s", text);
    folder_write(folder, "s.yaml", whole);
    snprintf(path, sizeof path, "%s/s.yaml", folder);
    const study *from = study_read(&memory, path, NULL, NULL, &err);
    if (!from)
        fail_msg("%s", err.text);
    const scene *s = scene_new(&memory, from, &(scene_options){ .threads = 1 }, NULL, &err);
    if (!s)
        fail_msg("%s", err.text);
    assert_true(world_statistics(s->world).triangles < world_statistics(s->world).placed_triangles);
    assert_outside(s, 0, 0, 1, 1, 0);
    assert_outside(s, 6798, 0, 1, 1, 0);
    assert_outside(s, -2, 0, 0, 0, 0);
    assert_outside(s, -4, 0, 1, 1, 1);
    assert_outside(s, -6, 1, 1, 1, 1);
}

static void assert_refused(const char *entries, const char *says)
{
    if (open_scene(entries))
        fail_msg("read without an error, not \"%s\"", says);
    if (!strstr(err.text, says))
        fail_msg("\"%s\", not \"%s\"", err.text, says);
}

TEST(a_pattern_that_names_nothing_is_refused_where_it_stands)
{
    assert_refused("  - {file: a.gltf, exterior: [Facade, Wal*]}",
                   "s.yaml:3:5: `exterior: Wal*` matches no node with surfaces and no material in "
                   "use of ");
    assert_refused("  - {file: a.gltf, exterior: [1, [2]]}", "s.yaml:3:34: expected");
    assert_refused("  - {file: a.gltf, portals: {}}", "s.yaml:3:29: expected");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(nothing_is_outside_where_nothing_is_said, prepare, forget),
        cmocka_unit_test_setup_teardown(a_node_is_outside_with_all_below_it, prepare, forget),
        cmocka_unit_test_setup_teardown(a_material_is_outside_wherever_it_is, prepare, forget),
        cmocka_unit_test_setup_teardown(an_entry_speaks_for_its_own_copies_alone, prepare, forget),
        cmocka_unit_test_setup_teardown(placed_meshes_are_outside_where_their_copies_are, prepare,
                                        forget),
        cmocka_unit_test_setup_teardown(a_pattern_that_names_nothing_is_refused_where_it_stands,
                                        prepare, forget),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
