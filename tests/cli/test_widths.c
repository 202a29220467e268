/* tests/cli/test_widths.c -- one, four or eight lanes: the same files, to the byte. */
#include "tests/box_gltf.h"
#include "tests/folder.h"
#include "tests/lab_picture.h"
#include "tests/lab_sphere.h"
#include "tests/program.h"
#include "tests/test.h"
#include "tests/widths.h"

#include <stdio.h>

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

/* Runs the study by each program, with results in FOLDER/WIDTH; the widths that were run. */
static int run_each(const char *folder, const char *command, const char *path, const char *accuracy,
                    int widths[3])
{
    int count = 0;
    for (int width = 1; width; width = width_after(width)) {
        char program[4096], name[16];
        if (!program_of_width(width, program, sizeof program))
            continue;
        snprintf(name, sizeof name, "%d", width);
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

/* Ends the folder; where there is but one program to run, nothing has been tested. */
static void assert_same_results(char *folder, const int *widths, int count,
                                const char *const *names)
{
    for (int i = 1; i < count; i++)
        for (const char *const *name = names; *name; name++) {
            char one[64], other[64];
            snprintf(one, sizeof one, "%d/%s", widths[0], *name);
            snprintf(other, sizeof other, "%d/%s", widths[i], *name);
            assert_same_bytes(path_in(folder, one), path_in(folder, other));
        }
    folder_free(folder);
    if (count < 2)
        skip();
}

TEST(a_room_is_the_same_at_every_width)
{
    static const char *const names[] = { "plane.csv", "plane.exr", "row.csv", "row.exr", NULL };
    char *folder                     = folder_of_study(room);
    int widths[3], count = run_each(folder, "grid", path_in(folder, "study.yaml"), "5%", widths);
    assert_same_results(folder, widths, count, names);
}

TEST(a_view_is_the_same_at_every_width)
{
    static const char *const names[] = { "view.exr", "view.png", NULL };
    char *folder                     = folder_of_study(room);
    int widths[3], count = run_each(folder, "render", path_in(folder, "study.yaml"), "30%", widths);
    assert_same_results(folder, widths, count, names);
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
}

/* Focused light may not get as sure as asked for, exit code 3: its files are there all the same. */
static void run_to_files(const program_desc *d, program_result *r)
{
    program_run(d, r);
    if (r->code != 0 && r->code != 3)
        fail_msg("exits with %d: %s", r->code, r->err);
}

/* Runs grid and view of study.yaml with one and two threads, plain and layered, by one program. */
static void run_threads(const char *folder, const char *program, int width)
{
    static const char *const options[] = { "--quiet", "--groups" };
    for (int i = 0; i < 8; i++) {
        program_result r    = { 0 };
        const char *threads = i & 1 ? "2" : "1", *command = i & 4 ? "render" : "grid";
        char out[32];
        snprintf(out, sizeof out, "%d-%d-%d", width, i & 1, i >> 1 & 1);
        run_to_files(&(program_desc){ .program = program,
                                      .folder  = folder,
                                      .words   = { command, "study.yaml", "-o", out, "--threads",
                                                   threads, "--accuracy", i & 4 ? "60%" : "40%",
                                                   options[i >> 1 & 1], "--overwrite" } },
                     &r);
        program_free(&r);
    }
}

/* Fails unless grid and view of study.yaml leave the same files at every width that is there. */
static void assert_same_everywhere(const char *folder, const char *const *names, int count)
{
    char one[64], other[64];
    int first = 0; /* width */
    for (int width = 1; width; width = width_after(width)) {
        char program[4096];
        if (!program_of_width(width, program, sizeof program))
            continue;
        run_threads(folder, program, width);
        first = first ? first : width;
        for (int i = 0; i < 4; i++)
            for (int n = 0; n < count; n++) {
                snprintf(one, sizeof one, "%d-0-%d/%s", first, i >> 1, names[n]);
                snprintf(other, sizeof other, "%d-%d-%d/%s", width, i & 1, i >> 1, names[n]);
                assert_same_bytes(path_in(folder, one), path_in(folder, other));
            }
    }
}

TEST(lamps_of_all_kinds_are_the_same_at_every_width_and_on_every_thread)
{
    static const char *const names[] = { "g.csv", "g.exr", "c.csv", "c.exr", "v.exr", "v.png" };
    char *folder                     = folder_of_study(lamps);
    program_result r                 = { 0 };
    box_gltf_write(folder, "box.gltf", (double[]){ 2, 1, 0.6 }, (double[]){ 4, 2, 0.9 }, 1.0);
    folder_write(folder, "box.ies", IES("0.2 0.3 0.1"));
    folder_write(folder, "spot.ies", IES("0 0 0"));
    LUX4(folder, 0, &r, "photometry", path_in(project_root(), "data/office/panel.ldt"), "--write",
         "panel.ldt");
    program_free(&r);
    assert_same_everywhere(folder, names, 6);
    folder_free(folder);
}

/* ---- materials ------------------------------------------------------------------------------- */

/* All but the names of what is measured */
static const char all_materials[] =
    "lux4: 1\nroom: {size: [6, 4, 2.8], reflectance: 0.5}\n"
    "scene: [glow.gltf, picture.gltf, bumps.gltf, screen.gltf, metal.gltf, plastic.gltf, "
    "frost.gltf,"
    " block.gltf, {file: plate.gltf, at: [[1, 1, 0.5], [2, 1, 0.5]]}, paint.gltf, brushed.gltf,"
    " window.gltf, blind.gltf, mirror.gltf, phong.gltf]\n"
    "lights:\n"
    "  - {type: rect, at: [2, 2, 2.7], size: [1, 0.5], lumens: 2000, group: a, color: 3000K}\n"
    "  - {type: point, at: [4, 1, 2], lumens: 900}\n"
    "materials:\n"
    "  - {match: Plate, transmittance: [0.8, 0.7, 0.5], pane: box}\n"
    "  - {match: Mirror, mirror: 0.9}\n"
    "  - {match: Phong, reflectance: 0.2, specular: 0.5, exponent: 90}\n"
    "  - {match: Paint, brdf: %1$s/data/materials/carpaint.brdf}\n"
    "  - {match: Brushed, brdf: %1$s/data/materials/brushed.brdf, up: [1, 0, 0]}\n"
    "  - {match: Window, brdf: %1$s/data/materials/glazing.xml}\n"
    "  - {match: Blind, brdf: %1$s/data/materials/blind.xml}\n"
    "grids:\n  - {name: g, on: room, height: 0.3, spacing: 1.2}\n"
    "views: [{name: v, eye: [0.5, 0.3, 2], target: [4, 3, 0.5], fov: 80, size: [24, 18]}]\n";

/* A square of 0.7 m, leaning, number i of a row of them. */
static quad square_of_row(int i)
{
    double x = 0.6 + 0.9 * (i % 6), y = 1.0 + i / 6;
    return (quad){
        { { x, y, 0.5 }, { x + 0.6, y, 0.5 }, { x + 0.6, y + 0.3, 1.1 }, { x, y + 0.3, 1.1 } }
    };
}

#define LOOKS(name, text) "\"name\":\"" name "\",\"pbrMetallicRoughness\":{" text "}"
#define CLEAR             "\"KHR_materials_transmission\":{\"transmissionFactor\":1}"

static void write_materials(lab *l)
{
    static const uint8_t four[16] = { 188, 0,   51,  255, 0,   188, 128, 90,
                                      151, 128, 188, 0,   128, 100, 200, 255 };
    static const struct {
        const char *name, *looks;
    } flat[] = {
        { "metal.gltf", LOOKS("Metal", "\"roughnessFactor\":0.2") },
        { "plastic.gltf", LOOKS("Plastic", "\"metallicFactor\":0,\"roughnessFactor\":0.4") },
        { "frost.gltf",
          LOOKS("Frost", "\"metallicFactor\":0,\"roughnessFactor\":0.3") ",\"extensions\":{" CLEAR
                                                                         "}" },
        { "paint.gltf", LOOKS("Paint", "") },
        { "brushed.gltf", LOOKS("Brushed", "") },
        { "window.gltf", LOOKS("Window", "") },
        { "blind.gltf", LOOKS("Blind", "") },
        { "mirror.gltf", LOOKS("Mirror", "") },
        { "phong.gltf", LOOKS("Phong", "") },
    };
    const picture p = { 2, 2, four, "" };
    quad q, box[6];
    int count = 0;
    for (; count < 9; count++) {
        q = square_of_row(count);
        lab_quads(l, flat[count].name, &q, 1, flat[count].looks);
    }
    q = square_of_row(count++);
    lab_picture(l, "picture.gltf", &q, &p,
                LOOKS("Picture", "\"baseColorTexture\":{\"index\":0},\"metallicRoughnessTexture\":"
                                 "{\"index\":0}"));
    q = square_of_row(count++);
    lab_picture(l, "bumps.gltf", &q, &p,
                LOOKS("Bumps", "\"metallicFactor\":0") ",\"normalTexture\":{\"index\":0}");
    q = square_of_row(count++);
    lab_picture(l, "screen.gltf", &q, &p,
                LOOKS("Screen", "\"baseColorTexture\":{\"index\":0}") ",\"alphaMode\":\"BLEND\"");
    q = square_of_row(count++);
    lab_quads(l, "glow.gltf", &q, 1, lab_glow(l, 2000.0));
    quads_of_box((dvec3){ 3, 3, 0 }, (dvec3){ 3.5, 3.4, 0.8 }, box);
    lab_quads(
        l, "block.gltf", box, 6,
        LOOKS("Block",
              "\"metallicFactor\":0,\"roughnessFactor\":0") ",\"extensions\":{" CLEAR
                                                            ",\"KHR_materials_volume\":{"
                                                            "\"thicknessFactor\":1,"
                                                            "\"attenuationDistance\":1,"
                                                            "\"attenuationColor\":[0.5,0.8,0.9]}}");
    quads_of_box((dvec3){ 0, 0, 0 }, (dvec3){ 0.4, 0.01, 0.6 }, box);
    lab_quads(l, "plate.gltf", box, 6, LOOKS("Plate", ""));
}

TEST(materials_of_all_kinds_are_the_same_at_every_width_and_on_every_thread)
{
    static const char *const names[] = { "g.csv", "g.exr", "v.exr", "v.png" };
    lab l;
    lab_open(&l);
    write_materials(&l);
    lab_write(&l, "study.yaml", all_materials, project_root());
    assert_same_everywhere(l.folder, names, 4);
    lab_close(&l);
}

/* ---- mirrors, lenses and maps ---------------------------------------------------------------- */

static const char bent[] =
    "lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: 0.5}\n"
    "scene: [mirror.gltf, pane.gltf, ball.gltf]\n"
    "lights:\n  - {type: point, at: [1, 1, 2], lumens: 2000, color: 3000K}\n"
    "  - {type: rect, at: [3, 2, 2.4], size: [0.5, 0.5], lumens: 900}\n"
    "materials:\n  - {match: Mirror, mirror: [0.9, 0.8, 0.7]}\n"
    "  - {match: Pane, transmittance: 0.7}\n"
    "grids:\n  - {name: g, on: room, height: 0.3, spacing: 1}\n"
    "  - {name: c, on: room, height: 1.2, spacing: 2, quantity: cylindrical}\n";

static void write_bent(lab *l)
{
    quad mirror = { { { 0.1, 0.5, 0.2 }, { 0.1, 2.5, 0.2 }, { 0.1, 2.5, 2 }, { 0.1, 0.5, 2 } } };
    quad pane   = { { { 2, 0.5, 0 }, { 2, 2.5, 0 }, { 2, 2.5, 1.4 }, { 2, 0.5, 1.4 } } };
    lab_quads(l, "mirror.gltf", &mirror, 1, LOOKS("Mirror", ""));
    lab_quads(l, "pane.gltf", &pane, 1, LOOKS("Pane", ""));
    lab_sphere(
        l, "ball.gltf", (dvec3){ 1.2, 1.2, 1.2 }, 0.3, 12,
        LOOKS("Ball", "\"metallicFactor\":0,\"roughnessFactor\":0") ",\"extensions\":{" CLEAR
                                                                    ",\"KHR_materials_volume\":{"
                                                                    "\"thicknessFactor\":1}}");
    lab_write(l, "study.yaml", "%s", bent);
}

/* By paths with one and two threads, and by maps. */
TEST(images_focused_light_and_maps_are_the_same_at_every_width_and_on_every_thread)
{
    static const char *const names[] = { "g.csv", "g.exr", "c.csv", "c.exr" };
    static const char *const by[]    = { "path", "maps" };
    lab l;
    lab_open(&l);
    write_bent(&l);
    int first = 0; /* width */
    for (int width = 1; width; width = width_after(width)) {
        char program[4096], out[32], one[64], other[64];
        if (!program_of_width(width, program, sizeof program))
            continue;
        first = first ? first : width;
        for (int i = 0; i < 3; i++) {
            program_result r = { 0 };
            snprintf(out, sizeof out, "%d-%d-%d", width, i & 1, i >> 1);
            run_to_files(&(program_desc){ .program = program,
                                          .folder  = l.folder,
                                          .words   = { "grid", "study.yaml", "-o", out, "--threads",
                                                     i & 1 ? "2" : "1", "--accuracy", "60%",
                                                       "--transport", by[i >> 1] } },
                         &r);
            program_free(&r);
            for (int n = 0; n < 4; n++) {
                snprintf(one, sizeof one, "%d-0-%d/%s", first, i >> 1, names[n]);
                snprintf(other, sizeof other, "%s/%s", out, names[n]);
                assert_same_bytes(path_in(l.folder, one), path_in(l.folder, other));
            }
        }
    }
    lab_close(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lamps_of_all_kinds_are_the_same_at_every_width_and_on_every_thread),
        cmocka_unit_test(materials_of_all_kinds_are_the_same_at_every_width_and_on_every_thread),
        cmocka_unit_test(
            images_focused_light_and_maps_are_the_same_at_every_width_and_on_every_thread),
        cmocka_unit_test(a_room_is_the_same_at_every_width),
        cmocka_unit_test(a_view_is_the_same_at_every_width),
        cmocka_unit_test(the_office_is_the_same_at_every_width),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
