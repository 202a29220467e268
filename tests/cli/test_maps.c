/* tests/cli/test_maps.c -- lux4 --save-maps: what is kept is read again; nothing is left in part.
 */
#include "tests/folder.h"
#include "tests/program.h"
#include "tests/test.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define ROOM                                                                                       \
    "lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: 0.8}\n"                                       \
    "lights: [{type: point, at: [2, 1.5, 2], intensity: 100}]\n"                                   \
    "grids: [{name: floor, on: room, height: 0.5, spacing: 1}]\n"
static const char room[] = ROOM "accuracy: 10%\n";

TEST(maps_are_made_once_and_give_the_same_light_again)
{
    char *folder     = folder_of_study(room);
    program_result r = { 0 };
    struct stat made, later;
    LUX4(folder, 0, &r, "grid", "study.yaml", "--transport=maps", "--save-maps=m.maps", "-o", "1");
    assert_int_equal(stat(path_in(folder, "m.maps"), &made), 0);
    LUX4(folder, 0, &r, "grid", "study.yaml", "--transport=maps", "--save-maps=m.maps", "-o", "2");
    assert_int_equal(stat(path_in(folder, "m.maps"), &later), 0);
    assert_int_equal(made.st_ino, later.st_ino); /* a new one would be another file */
    assert_same_bytes(path_in(folder, "1/floor.csv"), path_in(folder, "2/floor.csv"));
    assert_null(strstr(r.err, "anew"));
    LUX4(folder, 0, &r, "grid", "study.yaml", "--transport=maps", "--save-maps=m.maps", "-o", "3",
         "--seed=7");
    assert_non_null(strstr(r.err, "m.maps: its maps are of other seed, particles or accuracy: they "
                                  "are made anew"));
    program_free(&r);
    folder_free(folder);
}

TEST(what_is_no_file_of_maps_is_refused_and_kept)
{
    char *folder = folder_of_study(room);
    folder_write(folder, "notes.txt", "not to be lost");
    LUX4_FAILS(folder, 2, "notes.txt: no file of illumination maps", "grid", "study.yaml",
               "--transport=maps", "--save-maps=notes.txt");
    size_t size;
    char *text = bytes_of(path_in(folder, "notes.txt"), &size);
    assert_string_equal(text, "not to be lost");
    free(text);
    LUX4_FAILS(folder, 2, "is a folder", "grid", "study.yaml", "--transport=maps",
               "--save-maps=out");
    folder_free(folder);
}

/* Maps that the disk has no room for: a failure of the run, and no file. */
TEST(maps_that_grow_too_large_are_not_left_in_part)
{
    static const char *const commands[] = { "grid", "render" };
    char *folder                        = folder_of_study(
                               ROOM "views: [{name: v, eye: [1, 1, 1], target: [3, 2, 1], fov: 50, size: [8, 8]}]\n");
    program_result r = { 0 };
    for (int i = 0; i < 2; i++) {
        program_expect(1,
                       &(program_desc){ .folder          = folder,
                                        .most_file_bytes = 4096,
                                        .words = { commands[i], "study.yaml", "--transport=maps",
                                                   "--accuracy=25%", "--save-maps=m.maps" } },
                       &r);
        assert_one_line(&r, "m.maps: cannot write");
        assert_int_equal(count_names(folder), 2); /* study.yaml and out */
        assert_int_equal(count_names(path_in(folder, "out")), 0);
    }
    program_free(&r);
    folder_free(folder);
}

TEST(maps_that_are_interrupted_leave_no_file)
{
    char *folder     = folder_of_study(room);
    program_result r = { 0 };
    program_expect(130,
                   &(program_desc){ .folder = folder,
                                    .until  = path_in(folder, "out"),
                                    .then_s = 0.3,
                                    .words  = { "grid", "study.yaml", "--transport=maps",
                                                "--accuracy=0.05%", "--save-maps=m.maps" } },
                   &r);
    assert_one_line(&r, "interrupted");
    assert_int_equal(count_names(folder), 2);
    assert_int_equal(count_names(path_in(folder, "out")), 0);
    program_free(&r);
    folder_free(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(maps_are_made_once_and_give_the_same_light_again),
        cmocka_unit_test(what_is_no_file_of_maps_is_refused_and_kept),
        cmocka_unit_test(maps_that_grow_too_large_are_not_left_in_part),
        cmocka_unit_test(maps_that_are_interrupted_leave_no_file),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
