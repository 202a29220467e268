/* tests/cli/test_widths.c -- one, four or eight lanes: the same files, to the byte.
 *
 * Compares the programs of the widths that are built; those older than a source are no builds of
 * it, and are left out.
 */
#define _GNU_SOURCE
#include "tests/folder.h"
#include "tests/program.h"
#include "tests/test.h"

#include <ftw.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const char room[] =
    "lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: {ceiling: 0.8, walls: [0.6, 0.5, 0.4], "
    "floor: 0.2}}\naccuracy: 5%\n"
    "lights:\n  - {type: point, at: [[1, 1, 2], [3, 2, 2]], intensity: 100, color: 3000K}\n"
    "grids:\n  - {name: plane, on: room, height: 0.75, spacing: 0.3}\n"
    "  - {name: row, origin: [0.2, 0.2, 0.1], u: [3.5, 0.1, 0], v: [0, 0.2, 0.3], spacing: 0.5}\n"
    "views: [{name: view, eye: [0.5, 0.5, 1], target: [3, 2, 1], fov: 70, size: [21, 15]}]\n";

static struct timespec newest; /* source */

static int look_at(const char *path, const struct stat *st, int kind, struct FTW *ftw)
{
    const char *end = strrchr(path, '.');
    (void)ftw;
    if (kind == FTW_F && end && (!strcmp(end, ".c") || !strcmp(end, ".h") || !strcmp(end, ".cpp")))
        if (st->st_mtim.tv_sec > newest.tv_sec)
            newest = st->st_mtim;
    return 0;
}

/* A program of that width that can be run here and is none of yesterday. */
static bool is_usable(const char *program, int width)
{
    static const char *const layers[] = { "core", "materials", "lights", "sky", "sim" };
    char folder[4096];
    for (int i = 0; i < 5; i++) {
        snprintf(folder, sizeof folder, "%s/%s", project_root(), layers[i]);
        nftw(folder, look_at, 16, FTW_PHYS);
    }
    struct stat st;
#ifdef __x86_64__
    if (width == 8 && !(__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")))
        return false;
#endif
    return stat(program, &st) == 0 && st.st_mtim.tv_sec >= newest.tv_sec;
}

/* Runs the study by each program, with results in FOLDER/WIDTH; the widths that were run. */
static int run_each(const char *folder, const char *command, const char *path, const char *accuracy,
                    int widths[3])
{
    int count = 0;
    for (int width = 1; width <= 8; width = width == 1 ? 4 : 2 * width) {
        char program[4096], name[16];
        snprintf(program, sizeof program, "%s/build/release-%d/lux4", project_root(), width);
        snprintf(name, sizeof name, "%d", width);
        if (!is_usable(program, width))
            continue;
        program_result r = { 0 };
        program_expect(0,
                       &(program_desc){ .program = program,
                                        .words   = { command, path, "--accuracy", accuracy, "-o",
                                                     path_in(folder, name), "--overwrite" } },
                       &r);
        program_free(&r);
        widths[count++] = width;
    }
    return count;
}

static void assert_same_results(const char *folder, const int *widths, int count,
                                const char *const *names)
{
    if (count < 2)
        skip();
    for (int i = 1; i < count; i++)
        for (const char *const *name = names; *name; name++) {
            char one[64], other[64];
            snprintf(one, sizeof one, "%d/%s", widths[0], *name);
            snprintf(other, sizeof other, "%d/%s", widths[i], *name);
            assert_same_bytes(path_in(folder, one), path_in(folder, other));
        }
}

TEST(a_room_is_the_same_at_every_width)
{
    static const char *const names[] = { "plane.csv", "plane.exr", "row.csv", "row.exr", NULL };
    char *folder                     = folder_of_study(room);
    int widths[3], count = run_each(folder, "grid", path_in(folder, "study.yaml"), "5%", widths);
    assert_same_results(folder, widths, count, names);
    folder_free(folder);
}

TEST(a_view_is_the_same_at_every_width)
{
    static const char *const names[] = { "view.exr", "view.png", NULL };
    char *folder                     = folder_of_study(room);
    int widths[3], count = run_each(folder, "render", path_in(folder, "study.yaml"), "30%", widths);
    assert_same_results(folder, widths, count, names);
    folder_free(folder);
}

TEST(the_office_is_the_same_at_every_width)
{
    static const char *const names[] = { "desk-1.csv",  "desk-1.exr", "desk-4.csv", "meeting.csv",
                                         "meeting.exr", "floor.csv",  "floor.exr",  NULL };
    char *folder                     = folder_new();
    int widths[3],
        count = run_each(folder, "grid", path_in(project_root(), "data/office/office.yaml"), "5%",
                         widths);
    assert_same_results(folder, widths, count, names);
    folder_free(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_room_is_the_same_at_every_width),
        cmocka_unit_test(a_view_is_the_same_at_every_width),
        cmocka_unit_test(the_office_is_the_same_at_every_width),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
