/* tests/cli/test_places.c -- where studies lie and results go: odd names, other folders, folders
 * that may not be written to, disks that are full.
 */
#include "tests/folder.h"
#include "tests/program.h"
#include "tests/test.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <unistd.h>

static const char room[] =
    "lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: 0.5}\naccuracy: 50%\n"
    "lights: [{type: point, at: [2, 1.5, 2], intensity: 100}]\n"
    "grids: [{name: g, on: room, height: 0.75, spacing: 0.2}]\n" /* 300 sensors: 30 kB */
    "views: [{name: v, eye: [1, 1, 1], target: [3, 2, 1], size: [200, 150]}]\n";

enum { NOBODY = 65534 };

TEST(a_study_is_found_from_wherever_it_is_named)
{
    static const char *const names[] = {
        "plain.yaml",   "with blank.yaml", "\xc3\xa4\xe2\x82\xac.yaml",
        "100%s%n.yaml", "-dash.yaml",      "a'b\"c.yaml"
    };
    char *folder     = folder_new(), path[PATH_MAX];
    program_result r = { 0 };
    for (int i = 0; i < 6; i++) {
        char home[64], file[128];
        snprintf(home, sizeof home, "%d %%d \xc3\xb6", i);
        snprintf(file, sizeof file, "%s/%s", home, names[i]);
        mkdir(path_in(folder, home), 0777);
        folder_write(folder, file, room);
        const char *first = path_in(path_in(folder, home), "out/g.csv");
        LUX4(folder, 0, &r, "grid", file); /* beside the study, from elsewhere */
        assert_string_equal(r.err, "");
        assert_true(access(first, F_OK) == 0);
        LUX4("/", 0, &r, "grid", path_in(folder, file), "-o", path_in(folder, "o"), "--overwrite");
        assert_same_bytes(path_in(folder, "o/g.csv"), first);
        LUX4(path_in(folder, home), 0, &r, "grid", "--json", "--", names[i]);
        assert_true(json_is_valid(r.out));
        snprintf(path, sizeof path, "../%s/./%s", home, names[i]);
        LUX4(path_in(folder, home), 0, &r, "grid", path);
    }
    program_free(&r);
    folder_free(folder);
}

TEST(a_path_far_too_long_is_refused)
{
    char *folder = folder_of_study(room), name[6000];
    memset(name, 'a', sizeof name);
    name[300] = '\0';
    LUX4_FAILS(folder, 2, "lux4: aaaa", "grid", name);
    LUX4_FAILS(folder, 2, "lux4: aaaa", "grid", "study.yaml", "-o", name);
    name[300]             = 'a';
    name[sizeof name - 1] = '\0';
    LUX4_FAILS(folder, 2, "lux4: aaaa", "grid", name);
    LUX4_FAILS(folder, 2, "lux4: aaaa", "grid", "study.yaml", "-o", name);
    folder_free(folder);
}

TEST(what_is_no_folder_takes_no_results)
{
    char *folder     = folder_of_study(room);
    program_result r = { 0 };
    LUX4_FAILS(folder, 2, "study.yaml: is a file, a folder was expected", "grid", "study.yaml",
               "-o", "study.yaml");
    LUX4_FAILS(folder, 2, "/dev/null: is a file", "grid", "study.yaml", "-o", "/dev/null");
    LUX4_FAILS(folder, 2, "/proc/lux4: cannot make this folder", "grid", "study.yaml", "-o",
               "/proc/lux4/x");
    folder_write(folder, "out", "a file");
    LUX4_FAILS(folder, 2, "out: is a file, a folder was expected", "grid", "study.yaml");
    unlink(path_in(folder, "out"));

    mkdir(path_in(folder, "out"), 0777);
    mkdir(path_in(folder, "out/g.exr"), 0777);
    LUX4_FAILS(folder, 2, "out/g.exr: is in the way", "grid", "study.yaml");
    LUX4_FAILS(folder, 2, "out/g.exr: is in the way", "grid", "study.yaml", "--overwrite");
    mkdir(path_in(folder, "out/v.png"), 0777);
    LUX4_FAILS(folder, 2, "out/v.png: is in the way", "render", "study.yaml", "--overwrite");
    assert_int_equal(count_names(path_in(folder, "out")), 2);
    program_free(&r);
    folder_free(folder);
}

TEST(a_link_to_a_folder_is_a_folder)
{
    char *folder     = folder_of_study(room);
    program_result r = { 0 };
    mkdir(path_in(folder, "real"), 0777);
    assert_int_equal(symlink("real", path_in(folder, "out")), 0);
    LUX4(folder, 0, &r, "grid", "study.yaml");
    assert_true(there_is(folder, "real/g.csv"));
    program_free(&r);
    folder_free(folder);
}

/* As root nothing is forbidden: then the program runs as nobody, who must get at it. */
static program_desc as_nobody(const char *folder)
{
    chmod(folder, 0755);
    return (program_desc){ .folder = folder, .user = getuid() == 0 ? NOBODY : 0 };
}

static bool nobody_can_run(const char *folder)
{
    program_desc d   = as_nobody(folder);
    program_result r = { 0 };
    d.words[0]       = "--version";
    program_run(&d, &r);
    bool runs = r.code == 0;
    program_free(&r);
    return runs;
}

TEST(a_folder_that_may_not_be_written_to_is_refused_before_any_work)
{
    char *folder   = folder_of_study(room);
    program_desc d = as_nobody(folder);
    bool runs      = nobody_can_run(folder);
    mkdir(path_in(folder, "results"), 0555);
    chmod(folder, 0555);
    if (runs) {
        d.words[0] = "grid", d.words[1] = "study.yaml";
        program_fails(2, "out: cannot make this folder: Permission denied", &d);
        d.words[2] = "-o", d.words[3] = "results";
        program_fails(2, "results: cannot write into this folder: Permission denied", &d);
        d.words[0] = "render";
        program_fails(2, "results: cannot write into this folder: Permission denied", &d);

        char *elsewhere = folder_new(); /* a study that may only be read is a good study */
        chmod(elsewhere, 0777);
        program_result r = { 0 };
        d.words[0] = "grid", d.words[3] = elsewhere;
        program_expect(0, &d, &r);
        program_free(&r);
        folder_free(elsewhere);
    }
    chmod(folder, 0755);
    folder_free(folder);
    if (!runs)
        skip();
}

TEST(a_study_that_may_not_be_read_is_refused)
{
    char *folder   = folder_of_study(room);
    program_desc d = as_nobody(folder);
    bool runs      = nobody_can_run(folder);
    chmod(path_in(folder, "study.yaml"), 0);
    d.words[0] = "grid", d.words[1] = "study.yaml";
    if (runs)
        program_fails(2, "study.yaml: cannot read: Permission denied", &d);
    folder_free(folder);
    if (!runs)
        skip();
}

TEST(a_file_that_grows_too_large_is_not_left_in_part)
{
    static const char *const commands[] = { "grid", "render" };
    char *folder                        = folder_of_study(room);
    program_result r                    = { 0 };
    for (int i = 0; i < 2; i++) {
        program_desc d = { .folder = folder, .most_file_bytes = 4096 };
        d.words[0] = commands[i], d.words[1] = "study.yaml", d.words[2] = "--json";
        d.words[3] = "--accuracy=100%", d.words[4] = "--direct-only";
        program_expect(1, &d, &r);
        assert_one_line(&r, i == 0 ? "out/g.csv: cannot write" : "out/v.exr: cannot write");
        assert_int_equal(count_names(path_in(folder, "out")), 0);
    }
    program_free(&r);
    folder_free(folder);
}

/* A disk of 16 kB, where we are allowed to mount one. */
TEST(a_full_disk_is_told_and_leaves_nothing_in_part)
{
    char *folder     = folder_of_study(room);
    program_result r = { 0 };
    char *disk       = strdup(path_in(folder, "disk"));
    mkdir(disk, 0777);
    bool mounted = mount("none", disk, "tmpfs", 0, "size=16k") == 0;
    if (mounted) {
        program_run(
            &(program_desc){ .folder = folder, .words = { "grid", "study.yaml", "-o", "disk" } },
            &r);
        int of_grid = count_names(disk), code = r.code;
        program_result view = { 0 };
        program_run(&(program_desc){ .folder = folder,
                                     .words  = { "render", "study.yaml", "-o", "disk",
                                                 "--direct-only", "--accuracy=100%" } },
                    &view);
        int of_view = count_names(disk);
        umount(disk);
        assert_int_equal(code, 1);
        assert_one_line(&r, "disk/g.csv: cannot write: No space left on device");
        assert_int_equal(of_grid, 0);
        assert_int_equal(view.code, 1);
        assert_one_line(&view, "disk/v.exr: cannot write: No space left on device");
        assert_int_equal(of_view, 0);
        program_free(&view);
    }
    program_free(&r);
    free(disk);
    folder_free(folder);
    if (!mounted)
        skip();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_study_is_found_from_wherever_it_is_named),
        cmocka_unit_test(a_path_far_too_long_is_refused),
        cmocka_unit_test(what_is_no_folder_takes_no_results),
        cmocka_unit_test(a_link_to_a_folder_is_a_folder),
        cmocka_unit_test(a_folder_that_may_not_be_written_to_is_refused_before_any_work),
        cmocka_unit_test(a_study_that_may_not_be_read_is_refused),
        cmocka_unit_test(a_file_that_grows_too_large_is_not_left_in_part),
        cmocka_unit_test(a_full_disk_is_told_and_leaves_nothing_in_part),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
