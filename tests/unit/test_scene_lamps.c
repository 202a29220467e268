/* tests/unit/test_scene_lamps.c -- what becomes of the lamps of a study: files read once, what they
 * send out, and what the user is told of them.
 */
#include "lights/luminaire.h"
#include "tests/folder.h"
#include "tests/test.h"

#include <stdio.h>
#include <string.h>

static arena memory;
static notices said;
static char *folder;

static int prepare(void **state)
{
    (void)state;
    folder = folder_new();
    return 0;
}

static int forget(void **state)
{
    (void)state;
    folder_free(folder);
    arena_clear(&memory);
    return 0;
}

/* 100 cd below the horizon, 200 pi lm; half of it if the lamp is tilted by 90 degrees. */
#define LAMP(width, length)                                                                        \
    "IESNA:LM-63-2002\n[TEST] 1\n[TESTLAB] x\n[ISSUEDATE] x\n[MANUFAC] x\nTILT=INCLUDE\n1\n3\n"    \
    "0 90 180\n1 0.5 0.25\n1 -1 1 2 1 1 2 " width " " length " 0\n1 1 25\n0 90\n0\n100 100\n"

static const scene *open_study(const char *text)
{
    char path[4096];
    folder_write(folder, "study.yaml", text);
    snprintf(path, sizeof path, "%s/study.yaml", folder);
    said           = (notices){ .a = &memory };
    lux_error err  = { 0 };
    const study *s = study_read(&memory, path, NULL, &said, &err);
    const scene *made =
        s ? scene_new(&memory, s, &(scene_options){ .threads = 1 }, &said, &err) : NULL;
    if (!made)
        fail_msg("%s", err.text);
    return made;
}

/* How many lines say that. */
static int count_said(const char *what)
{
    int count = 0;
    for (const notice *n = said.first; n; n = n->next)
        count += strstr(n->text, what) != NULL;
    return count;
}

static void assert_said(const char *what)
{
    if (count_said(what) == 1)
        return;
    for (const notice *n = said.first; n; n = n->next)
        print_message("%s\n", n->text);
    fail_msg("`%s` is said %d times", what, count_said(what));
}

/* ---- files ----------------------------------------------------------------------------------- */

static const char gltf_lamps[] =
    "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0,1]}],"
    "\"extensionsUsed\":[\"EXT_lights_ies\"],\"extensions\":{\"EXT_lights_ies\":{\"lights\":["
    "{\"uri\":\"lamp.ies\"},{\"uri\":\"other.ies\"}]}},\"nodes\":["
    "{\"translation\":[1,1,-1],\"extensions\":{\"EXT_lights_ies\":{\"light\":0}}},"
    "{\"translation\":[2,1,-1],\"extensions\":{\"EXT_lights_ies\":{\"light\":1}}}]}";

TEST(a_file_is_one_web_and_one_model_for_all_lamps_that_name_it)
{
    folder_write(folder, "lamp.ies", LAMP("0.3", "0.3"));
    folder_write(folder, "other.ies", LAMP("0.3", "0.6"));
    folder_write(folder, "lamps.gltf", gltf_lamps);
    const scene *s =
        open_study("lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: 0}\nscene: lamps.gltf\n"
                   "luminaires:\n  - {photometry: lamp.ies, at: [[1, 1, 2], [2, 1, 2]]}\n"
                   "  - {photometry: other.ies, at: [3, 1, 2]}\n"
                   "  - {photometry: lamp.ies, at: [3, 2, 2]}\n"
                   "lights:\n  - {type: disk, at: [1, 2, 2], radius: 0.1, photometry: lamp.ies}\n"
                   "  - {type: rect, at: [2, 2, 2], size: [0.2, 0.2], photometry: lamp.ies}\n"
                   "grids: [{name: g, on: floor, spacing: 1}]\n");
    static const bool other[] = { false, false, true, false, false, false, false, true };
    const scene_light *info   = s->light_info;
    assert_int_equal(s->light_count, 8);
    for (int i = 0; i < 8; i++) {
        const luminaire *l = (const luminaire *)s->lights[i];
        const luminaire *m = (const luminaire *)s->lights[other[i] ? 2 : 0];
        assert_ptr_equal(info[i].web, info[other[i] ? 2 : 0].web);
        assert_ptr_equal(l->model, m->model);
    }
    assert_ptr_not_equal(info[0].web, info[2].web);
    assert_int_equal(said.count, 0);
}

/* ---- TILT ------------------------------------------------------------------------------------ */

TEST(lumens_that_are_given_leave_a_tilted_luminaire_too)
{
    folder_write(folder, "lamp.ies", LAMP("0", "0"));
    const scene *s =
        open_study("lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: 0}\nluminaires:\n"
                   "  - {photometry: lamp.ies, at: [1, 1, 2]}\n"
                   "  - {photometry: lamp.ies, at: [1, 1, 2], aim: [1, 0, 0]}\n"
                   "  - {photometry: lamp.ies, at: [1, 1, 2], aim: [1, 0, 0], lumens: 500}\n"
                   "lights:\n  - {type: disk, at: [1, 1, 2], aim: [1, 0, 0], radius: 0.1, "
                   "photometry: lamp.ies, lumens: 500}\n"
                   "  - {type: disk, at: [1, 1, 2], aim: [1, 0, 0], radius: 0.1, "
                   "photometry: lamp.ies}\n"
                   "grids: [{name: g, on: floor, spacing: 1}]\n");
    const double want[] = { 200.0 * M_PI, 100.0 * M_PI, 500.0, 500.0, 100.0 * M_PI };
    for (int i = 0; i < 5; i++) {
        assert_near(s->light_info[i].lumens, want[i], 1e-6); /* of the web's integral in floats */
        assert_near(179.0 * (double)light_flux(s->lights[i]).y, want[i], 1e-6);
    }
}

/* ---- shapes ---------------------------------------------------------------------------------- */

static void open_rect(const char *file, const char *size)
{
    char text[1000];
    snprintf(text, sizeof text,
             "lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: 0}\nlights:\n"
             "  - {type: rect, at: [[1, 1, 2], [2, 2, 2]], size: %s, photometry: %s}\n"
             "grids: [{name: g, on: floor, spacing: 1}]\n",
             size, file);
    open_study(text);
}

/* LM-63 has width before length, and the length along C0. */
TEST(a_rect_that_is_longer_across_its_file_is_told_of_once)
{
    folder_write(folder, "c0.ies", LAMP("0.3", "1.2"));
    folder_write(folder, "c90.ies", LAMP("1.2", "0.3"));
    folder_write(folder, "square.ies", LAMP("0.6", "0.6"));
    folder_write(folder, "point.ies", LAMP("0", "0"));
    open_rect("c0.ies", "[0.3, 1.2]");
    assert_said("study.yaml:4:5: the opening of ");
    assert_said("c0.ies is longer along C0 (1.2 m along C0, 0.3 m along C90), this rect along C90 "
                "(0.3 m and 1.2 m): ");
    open_rect("c90.ies", "[1.2, 0.3]");
    assert_said("c90.ies is longer along C90 (0.3 m along C0, 1.2 m along C90), this rect along C0 "
                "(1.2 m and 0.3 m): ");
    open_rect("c0.ies", "[1.2, 0.3]");
    assert_int_equal(said.count, 0);
    open_rect("c90.ies", "[0.3, 1.2]");
    assert_int_equal(said.count, 0);
    open_rect("c0.ies", "[0.6, 0.6]");
    assert_int_equal(said.count, 0);
    open_rect("square.ies", "[0.3, 1.2]");
    assert_int_equal(said.count, 0);
    open_rect("point.ies", "[0.3, 1.2]");
    assert_int_equal(said.count, 0);
}

/* ---- many ------------------------------------------------------------------------------------ */

TEST(lamps_of_one_entry_that_lie_outside_are_told_of_in_one_line)
{
    open_study("lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: 0}\nlights:\n"
               "  - {type: point, at: [[1, 1, 2], [9, 1, 2], [9, 2, 2]], lumens: 1}\n"
               "  - {type: point, at: [9, 2, 1], lumens: 1}\n"
               "grids: [{name: g, on: floor, spacing: 1}]\n");
    assert_said("study.yaml:4:5: 2 lights, the first at (9, 1, 2) m, lie outside the room, ");
    assert_said("study.yaml:5:5: a light at (9, 2, 1) m lies outside the room, ");
}

/* 20,000 dim lamps in the middle of the room, and one that gives half of all light 1 cm from a
 * wall: it is among those that are looked at. */
TEST(of_very_many_lamps_those_that_matter_are_looked_at)
{
    folder_write(folder, "lamp.ies", LAMP("0", "0"));
    const scene *s = open_study(
        "lux4: 1\nroom: {size: [400, 400, 100], reflectance: 0.5}\nluminaires:\n"
        "  - {photometry: lamp.ies, lumens: 1, layout: {from: [100, 100, 50], to: [300, 300, 50], "
        "count: [200, 100]}}\n"
        "lights: [{type: point, at: [0.01, 200, 50], lumens: 20000}]\n"
        "grids: [{name: g, on: floor, spacing: 100}]\n");
    assert_int_equal(s->light_count, 20001);
    assert_int_equal(s->small_patches, 1);
    assert_said(
        "study.yaml: at least 1 of 20001 lights, first `point` at (0.01, 200, 50) m, shine ");
}

/* Half of what is around a lamp in the ceiling is nothing; 1 cm below it nothing is lost. */
TEST(lamps_in_a_ceiling_are_told_of_in_one_line)
{
    open_study("lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: 0}\nlights:\n"
               "  - {name: bulb, type: point, at: [[1, 1, 2.49], [2, 1, 2.5], [3, 1, 2.5]], "
               "lumens: 1}\n"
               "grids: [{name: g, on: floor, spacing: 1}]\n");
    assert_said("% of the light of `bulb` at (2, 1, 2.5) m, and of 1 more, leaves the room: ");
    assert_int_equal(count_said("leaves the room"), 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_file_is_one_web_and_one_model_for_all_lamps_that_name_it,
                                        prepare, forget),
        cmocka_unit_test_setup_teardown(lumens_that_are_given_leave_a_tilted_luminaire_too, prepare,
                                        forget),
        cmocka_unit_test_setup_teardown(a_rect_that_is_longer_across_its_file_is_told_of_once,
                                        prepare, forget),
        cmocka_unit_test_setup_teardown(lamps_of_one_entry_that_lie_outside_are_told_of_in_one_line,
                                        prepare, forget),
        cmocka_unit_test_setup_teardown(lamps_in_a_ceiling_are_told_of_in_one_line, prepare,
                                        forget),
        cmocka_unit_test_setup_teardown(of_very_many_lamps_those_that_matter_are_looked_at, prepare,
                                        forget),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
