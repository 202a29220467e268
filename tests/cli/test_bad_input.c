/* tests/cli/test_bad_input.c -- files that are missing, cut, foreign, enormous or wrong: each gives
 * one line that names the file, exit code 2, and no result.
 */
#include "tests/folder.h"
#include "tests/program.h"
#include "tests/test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define ROOM                                                                                       \
    "lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: 0.5}\naccuracy: 50%\n"                        \
    "grids: [{name: g, on: room, height: 0.75, spacing: 1}]\n"
#define LAMP "lights: [{type: point, at: [2, 1.5, 2], intensity: 100}]\n"

/* No command takes the study of this text: line `says`; and none leaves a file. */
static void assert_refused(const char *yaml, const char *says)
{
    char *folder = folder_of_study(yaml);
    LUX4_FAILS(folder, 2, says, "grid", "study.yaml");
    LUX4_FAILS(folder, 2, says, "render", "study.yaml", "--json");
    LUX4_FAILS(folder, 2, says, "check", "study.yaml");
    assert_int_equal(count_names(folder), 1);
    folder_free(folder);
}

/* Makes the file NAME wrong in every general way, and runs the study on each. */
static void break_file(const char *folder, const char *name, const char *good, size_t size)
{
    char *path = strdup(path_in(folder, name));
    LUX4_FAILS(folder, 2, "no such file", "grid", "study.yaml");
    folder_write(folder, name, "");
    LUX4_FAILS(folder, 2, name, "grid", "study.yaml");

    static const size_t cuts[] = { 1, 5, 19, 100, 700 };
    for (size_t i = 0; i < sizeof cuts / sizeof *cuts && cuts[i] < size; i++) {
        FILE *f = fopen(path, "wb");
        fwrite(good, 1, cuts[i], f);
        fclose(f);
        LUX4_FAILS(folder, 2, name, "grid", "study.yaml");
    }
    unsigned char noise[4096];
    for (size_t i = 0, x = 1; i < sizeof noise;
         i++, x          = x * 6364136223846793005u + 1442695040888963407u)
        noise[i] = (unsigned char)(x >> 56);
    FILE *f = fopen(path, "wb");
    fwrite(noise, 1, sizeof noise, f);
    fclose(f);
    LUX4_FAILS(folder, 2, name, "grid", "study.yaml");

    assert_int_equal(truncate(path, (off_t)9 << 30), 0); /* takes no room on the disk */
    LUX4_FAILS(folder, 2, "has 9663676416 bytes, at most", "grid", "study.yaml");
    unlink(path);
    mkdir(path, 0777);
    LUX4_FAILS(folder, 2, "is a folder, a file was expected", "grid", "study.yaml");
    rmdir(path);
    mkfifo(path, 0666);
    LUX4_FAILS(folder, 2, "is not a regular file", "grid", "study.yaml");
    unlink(path);
    assert_false(there_is(folder, "out"));
    free(path);
}

TEST(a_study_that_is_none_is_refused)
{
    char *folder = folder_new();
    break_file(folder, "study.yaml", "lux4: 1\nroom: {size: [4, 3, 2", 29);
    folder_free(folder);
}

TEST(photometry_that_is_none_is_refused)
{
    static const char *const names[] = { "downlight.ies", "panel.ldt" };
    for (int i = 0; i < 2; i++) {
        char yaml[512], from[64];
        size_t size;
        snprintf(yaml, sizeof yaml, "%sluminaires: [{name: l, photometry: %s, at: [2, 1, 2]}]\n",
                 ROOM, names[i]);
        snprintf(from, sizeof from, "data/office/%s", names[i]);
        char *folder = folder_of_study(yaml);
        char *good   = bytes_of(path_in(project_root(), from), &size);
        break_file(folder, names[i], good, size);
        free(good);
        folder_free(folder);
    }
}

TEST(a_scene_that_is_none_is_refused)
{
    size_t size;
    char *good   = bytes_of(path_in(project_root(), "data/office/office.glb"), &size);
    char *folder = folder_of_study(ROOM LAMP "scene: model.glb\n");
    break_file(folder, "model.glb", good, size);
    folder_write(folder, "study.yaml", ROOM LAMP "scene: model.gltf\n");
    break_file(folder, "model.gltf", "{\"asset\": {\"version\": \"2.0\"}, \"nodes\": [", 40);
    free(good);
    folder_free(folder);
}

TEST(points_that_are_none_are_refused_before_any_work)
{
    char *folder = folder_of_study(
        "lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: 0.5}\naccuracy: 50%\n" LAMP
        "grids: [{name: a, on: room, height: 1, spacing: 1}, {name: b, points: points.csv}]\n");
    break_file(folder, "points.csv", "x,y,z,nx,ny,nz\n1,1,1,0,0,1\n", 24);
    folder_write(folder, "points.csv", "x,y,z,nx,ny,nz\n1,1,nan,0,0,1\n");
    LUX4_FAILS(folder, 2, "points.csv:2:5: ", "grid", "study.yaml");
    folder_write(folder, "points.csv", "x,y,z,nx,ny,nz\n1,1,1,0,0,0\n");
    LUX4_FAILS(folder, 2, "points.csv:2:", "grid", "study.yaml", "--json");
    assert_false(there_is(folder, "out"));
    folder_free(folder);
}

TEST(what_is_wrong_in_a_study_is_told_with_its_place)
{
    static const char *const studies[][2] = {
        { "lux4: 2\n", "study.yaml:1:7: " },
        { "lux4: 1\nroom: 5\n", "study.yaml:2:7: expected a mapping" },
        { "lux4: 1\nroom: {size: [4, -3, 2.5], reflectance: 0.5}\n", "study.yaml:2:18: " },
        { "lux4: 1\nroom: {size: [4, 0, 2.5], reflectance: 0.5}\n", "study.yaml:2:18: " },
        { "lux4: 1\nroom: {size: [4, .nan, 2.5], reflectance: 0.5}\n", "found `.nan`" },
        { "lux4: 1\nroom: {size: [4, .inf, 2.5], reflectance: 0.5}\n", "found `.inf`" },
        { "lux4: 1\nroom: {size: [4, 1e999, 2.5], reflectance: 0.5}\n", "found `1e999`" },
        { "lux4: 1\nroom: {size: [4, 3, 2], reflectance: 1.5}\n", "a number from 0 to 1" },
        { "lux4: 1\nroom: {size: [4, 3, 2], reflectence: 1}\n", "did you mean `reflectance`?" },
        { "lux4: 1\nroom: &r {size: *r}\n", "contains itself" },
        { "lux4: 1\nlux4: 1\n", "stands in line 1 already" },
        { "lux4: 1\nsky: {model: cloudy}\n", "found `cloudy`" },
        { "lux4: 1\nvariants:\n  night: {room: 5}\n",
          "study.yaml:3:17: with the variant `night`: " },
        { ROOM "views: [{name: g, eye: [1, 1, 1], target: [2, 1, 1]}]\n", "name `g` is taken" },
        { ROOM "views: [{name: a/b, eye: [1, 1, 1], target: [2, 1, 1]}]\n", "expected a name" },
        { ROOM "views: [{name: v, eye: [1, 1, 1], target: [1, 1, 1]}]\n", "the same place" },
        { ROOM "lights: [{type: point, at: [1, 1, 1], intensity: -1}]\n", "a number >= 0" },
        { ROOM "lights: [{type: point, at: [1, 1, 1]}]\n", "study.yaml:5:" },
        { ROOM "materials: [{match: Nix*, reflectance: 0.5}]\n",
          "`Nix*` matches no material; there are `room: ceiling`, `room: walls`, `room: floor`" },
        { "lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: 0.5}\n"
          "grids: [{name: g, on: room, height: 1, spacing: 1e-9}]\n",
          "study.yaml:3:" },
    };
    for (size_t i = 0; i < sizeof studies / sizeof *studies; i++)
        assert_refused(studies[i][0], studies[i][1]);
}

TEST(bombs_of_aliases_and_depth_are_refused_at_once)
{
    char *text = malloc(1 << 20), *c = text + sprintf(text, "lux4: 1\nroom: &a [1, 1]\n");
    for (char name = 'b'; name <= 'z'; name++) /* 8^25 ones */
        c += sprintf(c, "%c: &%c [*%c, *%c, *%c, *%c, *%c, *%c, *%c, *%c]\n", name, name, name - 1,
                     name - 1, name - 1, name - 1, name - 1, name - 1, name - 1, name - 1);
    char *folder     = folder_of_study(text);
    program_result r = { 0 };
    LUX4(folder, 2, &r, "check", "study.yaml");
    assert_one_line(&r, "study.yaml:");
    assert_true(r.seconds < 5.0);
    memset(text, '[', 900000);
    text[900000] = '\0';
    folder_write(folder, "study.yaml", text);
    LUX4(folder, 2, &r, "check", "study.yaml");
    assert_one_line(&r, "study.yaml:");
    assert_true(r.seconds < 5.0);
    program_free(&r);
    folder_free(folder);
    free(text);
}

TEST(a_scene_with_a_cycle_or_a_way_out_is_refused)
{
    char *folder = folder_of_study(ROOM LAMP "scene: scene.gltf\n");
    folder_write(folder, "scene.gltf",
                 "{\"asset\": {\"version\": \"2.0\"}, \"nodes\": [{\"children\": [1]}, "
                 "{\"children\": [0]}], \"scenes\": [{\"nodes\": [0]}], \"scene\": 0}");
    LUX4_FAILS(folder, 2, "scene.gltf: /nodes/0: the node is its own ancestor", "grid",
               "study.yaml");
    static const char *const ways[] = { "../secret.bin",
                                        "/etc/passwd",
                                        "a/../../secret.bin",
                                        "file:///etc/passwd",
                                        "%2e%2e/secret.bin",
                                        "http://example.org/x.bin",
                                        "link.bin" };
    assert_int_equal(symlink("/etc/passwd", path_in(folder, "link.bin")), 0);
    for (int i = 0; i < 7; i++) {
        char text[256];
        snprintf(text, sizeof text,
                 "{\"asset\": {\"version\": \"2.0\"}, \"buffers\": [{\"byteLength\": 4, \"uri\": "
                 "\"%s\"}]}",
                 ways[i]);
        folder_write(folder, "scene.gltf", text);
        LUX4_FAILS(folder, 2, "scene.gltf: /buffers/0", "grid", "study.yaml");
    }
    folder_free(folder);
}

TEST(a_study_that_asks_for_nothing_is_told_so)
{
    char *folder     = folder_of_study("lux4: 1\nroom: {size: [4, 3, 2], reflectance: 0.5}\n" LAMP);
    program_result r = { 0 };
    LUX4_FAILS(folder, 2, "study.yaml: the study has no `grids`", "grid", "study.yaml");
    LUX4_FAILS(folder, 2, "study.yaml: the study has no `grids`", "grid", "study.yaml", "--json");
    LUX4(folder, 0, &r, "check", "study.yaml");
    assert_false(there_is(folder, "out"));
    program_free(&r);
    folder_free(folder);
}

TEST(what_is_ignored_is_warned_of)
{
    static const char json[] =
        "{\"asset\": {\"version\": \"2.0\"}, \"buffers\": [{\"byteLength\": 36, \"uri\": "
        "\"data:application/"
        "octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAQAAAAAAAAAAA\"}],"
        "\"bufferViews\": [{\"buffer\": 0, \"byteLength\": 36}], \"accessors\": [{\"bufferView\": "
        "0, "
        "\"componentType\": 5126, \"count\": 3, \"type\": \"VEC3\"}], \"meshes\": "
        "[{\"primitives\": "
        "[{\"attributes\": {\"POSITION\": 0}}]}, {\"primitives\": [{\"attributes\": {}}]}], "
        "\"nodes\": [{\"mesh\": 0}, {\"mesh\": 1}, {\"mesh\": 0, \"scale\": [0, 0, 0]}], "
        "\"scenes\": [{\"nodes\": [0, 1, 2]}], \"scene\": 0}";
    char *folder     = folder_of_study(ROOM "scene: scene.gltf\n"
                                                "lights: [{type: point, at: [9, 9, 9], intensity: 1}]\n");
    program_result r = { 0 };
    csv *c           = malloc(sizeof *c);
    folder_write(folder, "scene.gltf", json);
    LUX4(folder, 0, &r, "grid", "study.yaml");
    static const char *const says[] = { "scene.gltf: /meshes/0: 1 triangles without area",
                                        "scene.gltf: /meshes/0: 2 meshes have no triangles",
                                        "study.yaml:6:10: a light at (9, 9, 9) m lies outside" };
    for (int i = 0; i < 3; i++)
        if (!strstr(r.err, says[i]))
            fail_msg("nothing of `%s` in: %s", says[i], r.err);
    for (const char *line = r.err; *line; line = strchr(line, '\n') + 1)
        assert_memory_equal(line, "lux4: warning: ", 15);
    csv_read(path_in(folder, "out/g.csv"), c);
    for (int k = 0; k < c->count; k++)
        assert_near(c->row[k][ALL], 0.0, 0.0);
    free(c);
    program_free(&r);
    folder_free(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_study_that_is_none_is_refused),
        cmocka_unit_test(photometry_that_is_none_is_refused),
        cmocka_unit_test(a_scene_that_is_none_is_refused),
        cmocka_unit_test(points_that_are_none_are_refused_before_any_work),
        cmocka_unit_test(what_is_wrong_in_a_study_is_told_with_its_place),
        cmocka_unit_test(bombs_of_aliases_and_depth_are_refused_at_once),
        cmocka_unit_test(a_scene_with_a_cycle_or_a_way_out_is_refused),
        cmocka_unit_test(a_study_that_asks_for_nothing_is_told_so),
        cmocka_unit_test(what_is_ignored_is_warned_of),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
