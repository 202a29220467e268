/* tests/cli/test_interrupt.c -- Ctrl-C in the middle of a long run. */
#include "core/image.h"
#include "tests/folder.h"
#include "tests/program.h"
#include "tests/test.h"

#include <signal.h>
#include <stdlib.h>
#include <string.h>

/* `dark` lies under the room's floor and looks away: done at once, whatever the accuracy. `long`
 * takes minutes. */
static const char room[] =
    "lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: 0.8}\naccuracy: 0.01%\n"
    "lights: [{type: point, at: [2, 1.5, 2], intensity: 100}]\n"
    "grids:\n  - {name: dark, origin: [1, 1, -1], u: [0, 1, 0], v: [1, 0, 0], spacing: 1}\n"
    "  - {name: long, on: room, height: 1, spacing: 0.2}\n"
    "  - {name: never, on: room, height: 1, spacing: 1}\n"
    "views: [{name: dim, eye: [1, 1, -1], target: [1, 1, -2], fov: 50, size: [4, 4]},\n"
    "  {name: slow, eye: [1, 1, 1], target: [3, 2, 1], fov: 50, size: [64, 64]}]\n";

static bool marked_partial(const char *path)
{
    arena a       = { 0 };
    lux_error err = { 0 };
    image im;
    if (!image_read_exr(path, &a, &im, &err))
        fail_msg("%s", err.text);
    bool found = false;
    for (int i = 0; i < im.attribute_count; i++)
        found |= !strcmp(im.attributes[i].name, "lux4:partial");
    arena_clear(&a);
    return found;
}

TEST(grids_that_are_done_are_written_and_the_current_one_is_marked)
{
    char *folder     = folder_of_study(room);
    csv *c           = malloc(sizeof *c);
    program_result r = { 0 };
    program_expect(130,
                   &(program_desc){ .folder = folder,
                                    .until  = path_in(folder, "out/dark.exr"),
                                    .then_s = 0.5,
                                    .words  = { "grid", "study.yaml", "--json" } },
                   &r);
    assert_one_line(&r, "interrupted");
    assert_true(json_is_valid(r.out));
    assert_int_equal(count_names(path_in(folder, "out")), 4); /* no temporary file is left */
    csv_read(path_in(folder, "out/dark.csv"), c);
    assert_int_equal(c->count, 1);
    assert_false(c->partial);
    assert_false(marked_partial(path_in(folder, "out/dark.exr")));
    csv_read(path_in(folder, "out/long.csv"), c);
    assert_int_equal(c->count, 20 * 15);
    assert_true(c->partial);
    assert_true(marked_partial(path_in(folder, "out/long.exr")));
    assert_true(r.seconds < 15.0);
    program_free(&r);
    free(c);
    folder_free(folder);
}

TEST(views_that_are_done_are_written_and_the_current_one_is_marked)
{
    char *folder     = folder_of_study(room);
    program_result r = { 0 };
    program_expect(
        130,
        &(program_desc){ .folder = folder,
                         .until  = path_in(folder, "out/dim.png"),
                         .then_s = 1.5,
                         .words  = { "render", "study.yaml", "--accuracy=0.01%", "--json" } },
        &r);
    assert_one_line(&r, "interrupted");
    assert_true(json_is_valid(r.out));
    assert_int_equal(count_names(path_in(folder, "out")), 4);
    assert_false(marked_partial(path_in(folder, "out/dim.exr")));
    assert_true(marked_partial(path_in(folder, "out/slow.exr")));
    assert_true(there_is(folder, "out/slow.png"));
    program_free(&r);
    folder_free(folder);
}

TEST(before_its_first_results_nothing_is_written_of_a_view)
{
    /* So many pixels that the first round takes seconds */
    char *folder = folder_of_study(
        "lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: 0.99}\n"
        "lights: [{type: point, at: [2, 1.5, 2], intensity: 100}]\n"
        "views: [{name: big, eye: [1, 1, 1], target: [3, 2, 1], fov: 50, size: [1000, 800]}]\n");
    program_result r = { 0 };
    program_expect(130,
                   &(program_desc){ .folder = folder,
                                    .until  = path_in(folder, "out"),
                                    .then_s = 0.1,
                                    .words  = { "render", "study.yaml", "--json" } },
                   &r);
    assert_one_line(&r, "interrupted before view big had its first picture");
    if (!json_is_valid(r.out))
        fail_msg("no JSON: %s", r.out);
    assert_int_equal(count_names(path_in(folder, "out")), 0);
    program_free(&r);
    folder_free(folder);
}

TEST(a_second_interruption_is_obeyed_at_once)
{
    char *folder     = folder_of_study(room);
    program_result r = { 0 };
    program_run(&(program_desc){ .folder = folder,
                                 .until  = path_in(folder, "out/dark.exr"),
                                 .then_s = 0.2,
                                 .twice  = true,
                                 .words  = { "grid", "study.yaml" } },
                &r);
    assert_true(r.code == -SIGINT || r.code == 130); /* 130: it was ready between the two */
    program_free(&r);
    folder_free(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(grids_that_are_done_are_written_and_the_current_one_is_marked),
        cmocka_unit_test(views_that_are_done_are_written_and_the_current_one_is_marked),
        cmocka_unit_test(before_its_first_results_nothing_is_written_of_a_view),
        cmocka_unit_test(a_second_interruption_is_obeyed_at_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
