/* tests/cli/test_widths.c -- one, four or eight lanes: the same files, to the byte.
 *
 * Compares the programs of the widths that are built; those older than a source are no builds of
 * it, and are left out.
 */
#define _GNU_SOURCE
#include "tests/box_gltf.h"
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

/* Lamps of each kind, more than are asked one by one, a glowing box that shades them, groups:
 * points and openings. */
static const char lamps[] =
    "lux4: 1\nroom: {size: [6, 4, 2.8], reflectance: 0.5}\nscene: box.gltf\n"
    "lights:\n"
    "  - {type: rect, at: [1, 1, 2.4], size: [0.3, 1.2], lumens: 1000, group: a, color: 3000K}\n"
    "  - {type: disk, at: [5, 1, 2], aim: [-1, 1, -2], radius: 0.2, lumens: 900, group: b}\n"
    "  - {type: linear, from: [1, 3.5, 2], to: [3, 3.5, 2], lumens: 800, group: b}\n"
    "  - {type: cone, at: [5, 3, 2.5], aim_at: [3, 2, 0], lumens: 500, outer: 30, group: a}\n"
    "luminaires:\n"
    "  - {photometry: panel.ldt, at: [3, 3, 2.7], rotate: 30, group: a, dimming: 0.5}\n"
    "  - {photometry: box.ies, layout: {fill: room, z: 2.5, count: [3, 2]}, lumens: 300}\n"
    "  - {photometry: spot.ies, layout: {fill: room, z: 2.6, count: [6, 5]}, lumens: 90}\n"
    "dimming: {b: 0.7}\n"
    "grids:\n  - {name: g, on: room, height: 0.5, spacing: 0.8}\n"
    "  - {name: c, on: room, height: 1.2, spacing: 2, quantity: cylindrical}\n"
    "views: [{name: v, eye: [0.5, 0.5, 1], target: [4, 3, 1], fov: 70, size: [13, 11]}]\n";

#define IES(size)                                                                                  \
    "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 4 1 1 2 " size "\n1 1 10\n0 45 90 180\n0\n100 80 30 10\n"

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

/* Runs grid and view of study.yaml with one and two threads, plain and layered, by one program. */
static void run_threads(const char *folder, int width)
{
    static const char *const options[] = { "--quiet", "--groups" };
    char program[4096];
    snprintf(program, sizeof program, "%s/build/release-%d/lux4", project_root(), width);
    for (int i = 0; i < 8; i++) {
        program_result r    = { 0 };
        const char *threads = i & 1 ? "2" : "1", *command = i & 4 ? "render" : "grid";
        char out[32];
        snprintf(out, sizeof out, "%d-%d-%d", width, i & 1, i >> 1 & 1);
        program_expect(0,
                       &(program_desc){ .program = program,
                                        .folder  = folder,
                                        .words   = { command, "study.yaml", "-o", out, "--threads",
                                                     threads, "--accuracy", i & 4 ? "60%" : "10%",
                                                     options[i >> 1 & 1], "--overwrite" } },
                       &r);
        program_free(&r);
    }
}

TEST(lamps_of_all_kinds_are_the_same_at_every_width_and_on_every_thread)
{
    static const char *const names[] = { "g.csv", "g.exr", "c.csv", "c.exr", "v.exr", "v.png" };
    char *folder                     = folder_of_study(lamps), one[64], other[64];
    program_result r                 = { 0 };
    int first                        = 0; /* width */
    box_gltf_write(folder, "box.gltf", (double[]){ 2, 1, 0.6 }, (double[]){ 4, 2, 0.9 }, 1.0);
    folder_write(folder, "box.ies", IES("0.2 0.3 0.1"));
    folder_write(folder, "spot.ies", IES("0 0 0"));
    LUX4(folder, 0, &r, "photometry", path_in(project_root(), "data/office/panel.ldt"), "--write",
         "panel.ldt");
    program_free(&r);
    for (int width = 1; width <= 8; width = width == 1 ? 4 : 2 * width) {
        char program[4096];
        snprintf(program, sizeof program, "%s/build/release-%d/lux4", project_root(), width);
        if (!is_usable(program, width))
            continue;
        run_threads(folder, width);
        first = first ? first : width;
        for (int i = 0; i < 4; i++)
            for (int n = 0; n < 6; n++) {
                snprintf(one, sizeof one, "%d-0-%d/%s", first, i >> 1, names[n]);
                snprintf(other, sizeof other, "%d-%d-%d/%s", width, i & 1, i >> 1, names[n]);
                assert_same_bytes(path_in(folder, one), path_in(folder, other));
            }
    }
    folder_free(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lamps_of_all_kinds_are_the_same_at_every_width_and_on_every_thread),
        cmocka_unit_test(a_room_is_the_same_at_every_width),
        cmocka_unit_test(a_view_is_the_same_at_every_width),
        cmocka_unit_test(the_office_is_the_same_at_every_width),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
