/* tests/cli/test_usage.c -- words on the command line, and what the program answers to them. */
#include "tests/folder.h"
#include "tests/program.h"
#include "tests/test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char room[] = "lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: 0.5}\n"
                           "lights: [{type: point, at: [2, 1.5, 2], intensity: 100}]\n"
                           "grids: [{name: g, on: room, height: 0.75, spacing: 1}]\n";

/* Help, versions and lists go to stdout, with nothing on stderr. */
static void assert_tells(const program_result *r, const char *says)
{
    assert_string_equal(r->err, "");
    if (!strstr(r->out, says))
        fail_msg("nothing of `%s` in: %s", says, r->out);
}

TEST(without_a_command_usage_goes_to_stderr)
{
    program_result r = { 0 };
    LUX4(NULL, 2, &r, NULL);
    assert_string_equal(r.out, "");
    assert_non_null(strstr(r.err, "usage: lux4 COMMAND"));
    program_free(&r);
}

TEST(help_lists_the_commands)
{
    static const char *const words[] = { "help", "--help", "-h" };
    program_result r                 = { 0 };
    for (int i = 0; i < 3; i++) {
        LUX4(NULL, 0, &r, words[i]);
        assert_tells(&r, "usage: lux4 COMMAND");
        assert_tells(&r, "\n  grid ");
        assert_tells(&r, "\n  render ");
        assert_tells(&r, "\n  check ");
        assert_tells(&r, "\n  photometry ");
        assert_tells(&r, "\n  material ");
        assert_tells(&r, "\n  mix ");
        assert_tells(&r, "\n  sun ");
    }
    program_free(&r);
}

TEST(each_command_has_its_help)
{
    static const char *const commands[] = { "grid",     "render", "check", "photometry",
                                            "material", "mix",    "sun" };
    for (int i = 0; i < 7; i++) {
        program_result r = { 0 }, same = { 0 };
        LUX4(NULL, 0, &r, "help", commands[i]);
        LUX4(NULL, 0, &same, commands[i], "--help");
        assert_tells(&r, commands[i]);
        assert_tells(&r, "options:");
        assert_string_equal(r.out, same.out);
        LUX4(NULL, 0, &same, commands[i], "no-such-study.yaml", "--help", "--no-such-option");
        assert_string_equal(r.out, same.out);
        program_free(&r);
        program_free(&same);
    }
    program_result page = { 0 };
    LUX4(NULL, 0, &page, "help", "study");
    assert_tells(&page, "luminaires");
    program_free(&page);
    LUX4_FAILS(NULL, 2, "unknown command `gird`", "help", "gird");
    LUX4_FAILS(NULL, 2, "`tone` is not supported yet", "help", "tone");
}

TEST(the_version_is_told)
{
    program_result r = { 0 };
    LUX4(NULL, 0, &r, "--version");
    assert_tells(&r, "lux4 " LUX4_VERSION "\n");
    program_free(&r);
}

TEST(what_is_no_command_is_refused)
{
    LUX4_FAILS(NULL, 2, "unknown command `gird`", "gird", "study.yaml");
    LUX4_FAILS(NULL, 2, "unknown command `--json`", "--json", "grid", "study.yaml");
    LUX4_FAILS(NULL, 2, "unknown command `study.yaml`", "study.yaml");
}

TEST(commands_that_are_promised_are_refused_by_name)
{
    static const char *const commands[] = { "tone", "diff" };
    for (size_t i = 0; i < sizeof commands / sizeof *commands; i++)
        LUX4_FAILS(NULL, 2, "is not supported yet", commands[i], "study.yaml");
}

TEST(options_that_are_promised_are_refused_by_name)
{
    static const char *const options[] = { "--resume", "--tone", "--false-color" };
    char *folder                       = folder_of_study(room);
    for (int i = 0; i < 3; i++) {
        LUX4_FAILS(folder, 2, "is not supported yet", "grid", "study.yaml", options[i], "auto");
        LUX4_FAILS(folder, 2, "is not supported yet", "render", options[i], "study.yaml");
    }
    assert_int_equal(count_names(folder), 1);
    folder_free(folder);
}

TEST(wrong_options_are_refused_before_anything_is_read)
{
    LUX4_FAILS(NULL, 2, "unknown option --thread ", "grid", "none.yaml", "--thread", "2");
    LUX4_FAILS(NULL, 2, "unknown option -x", "grid", "none.yaml", "-x");
    LUX4_FAILS(NULL, 2, "-o: expected DIR", "grid", "none.yaml", "-o");
    LUX4_FAILS(NULL, 2, "-o: expected a folder", "grid", "none.yaml", "-o", "");
    LUX4_FAILS(NULL, 2, "--seed: expected N", "grid", "none.yaml", "--seed");
    LUX4_FAILS(NULL, 2, "--json takes no value", "grid", "none.yaml", "--json=yes");
    LUX4_FAILS(NULL, 2, "--plot has no meaning", "grid", "none.yaml", "--plot", "x.svg");
    /* Options of all are taken by all */
    LUX4_FAILS(NULL, 2, "none.yaml", "check", "none.yaml", "--seed", "2", "--half", "-o", "x");
}

TEST(wrong_values_are_refused)
{
    static const char *const values[][2] = {
        { "--accuracy", "2" },       { "--accuracy", "0%" },     { "--accuracy", "-1%" },
        { "--accuracy", "101%" },    { "--accuracy", "nan%" },   { "--accuracy", "inf%" },
        { "--accuracy", "" },        { "--accuracy", "2%%" },    { "--accuracy", "high" },
        { "--accuracy", "1e-320%" }, { "--time", "-1" },         { "--time", "nan" },
        { "--time", "inf" },         { "--time", "1h" },         { "--time", "" },
        { "--threads", "0" },        { "--threads", "-1" },      { "--threads", "1.5" },
        { "--threads", "257" },      { "--threads", "1e9" },     { "--threads", "all" },
        { "--seed", "-1" },          { "--seed", "4294967296" }, { "--seed", "0.5" },
        { "--seed", "one" },
    };
    for (size_t i = 0; i < sizeof values / sizeof *values; i++)
        LUX4_FAILS(NULL, 2, values[i][0], "grid", "none.yaml", values[i][0], values[i][1]);
}

TEST(one_study_is_wanted)
{
    LUX4_FAILS(NULL, 2, "which study?", "grid");
    LUX4_FAILS(NULL, 2, "which study?", "render", "--json");
    LUX4_FAILS(NULL, 2, "which study?", "check", "--");
    LUX4_FAILS(NULL, 2, "one study at a time", "grid", "a.yaml", "b.yaml");
    LUX4_FAILS(NULL, 2, "one study at a time", "check", "a.yaml", "b.yaml");
    LUX4_FAILS(NULL, 2, "lux4: -.yaml: no such file", "grid", "--", "-.yaml");
    LUX4_FAILS(NULL, 2, "lux4: --json: no such file", "check", "--", "--json");
}

TEST(options_may_come_first_and_hold_their_value)
{
    char *folder     = folder_of_study(room);
    program_result r = { 0 };
    LUX4(folder, 0, &r, "grid", "--accuracy=50%", "--seed=7", "--threads", "1", "study.yaml");
    LUX4(folder, 0, &r, "grid", "-o", "x", "--accuracy", "50 %", "--", "study.yaml");
    assert_true(there_is(folder, "out/g.csv") && there_is(folder, "x/g.csv"));
    program_free(&r);
    folder_free(folder);
}

TEST(a_variant_is_chosen_by_its_name)
{
    char text[1000];
    snprintf(text, sizeof text, "%svariants:\n  two: {lights: [%s, %s]}\n", room,
             "{type: point, at: [1, 1, 2], intensity: 1}",
             "{type: point, at: [2, 1, 2], lumens: 1}");
    char *folder     = folder_of_study(text);
    program_result r = { 0 };
    LUX4(folder, 0, &r, "check", "study.yaml", "--json");
    assert_tells(&r, "\"lights\":1,");
    LUX4(folder, 0, &r, "check", "study.yaml", "--json", "--variant", "two");
    assert_tells(&r, "\"lights\":2,");
    LUX4(folder, 0, &r, "grid", "study.yaml", "--variant=two", "--accuracy=50%");
    LUX4_FAILS(folder, 2, "no variant `tow`: did you mean `two`?", "render", "study.yaml",
               "--variant", "tow");
    program_free(&r);
    folder_free(folder);
}

TEST(what_cannot_be_printed_is_an_error)
{
    char *folder                      = folder_of_study(room);
    program_result r                  = { 0 };
    static const char *const places[] = { "/dev/full", "" };
    for (int i = 0; i < 2; i++) {
        program_expect(1, &(program_desc){ .out = places[i], .words = { "help" } }, &r);
        assert_one_line(&r, "cannot write the results");
        program_expect(1, &(program_desc){ .out = places[i], .words = { "--version" } }, &r);
        assert_one_line(&r, "cannot write the results");
        program_expect(1,
                       &(program_desc){
                           .out = places[i], .folder = folder, .words = { "check", "study.yaml" } },
                       &r);
        assert_one_line(&r, "cannot write the results");
        program_expect(1,
                       &(program_desc){
                           .out = places[i], .folder = folder, .words = { "plan", "study.yaml" } },
                       &r);
        assert_one_line(&r, "cannot write the results");
        program_expect(1,
                       &(program_desc){ .out    = places[i],
                                        .folder = folder,
                                        .words  = { "grid", "study.yaml", "--accuracy=50%" } },
                       &r);
        assert_one_line(&r, "cannot write the results");
        size_t size;
        char *bytes = bytes_of(path_in(folder, "out/g.csv"), &size);
        assert_memory_equal(bytes, "x,y,z,", 6); /* and no result went into a file instead */
        assert_null(strstr(bytes, "average"));
        free(bytes);
    }
    program_free(&r);
    folder_free(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(without_a_command_usage_goes_to_stderr),
        cmocka_unit_test(help_lists_the_commands),
        cmocka_unit_test(each_command_has_its_help),
        cmocka_unit_test(the_version_is_told),
        cmocka_unit_test(what_is_no_command_is_refused),
        cmocka_unit_test(commands_that_are_promised_are_refused_by_name),
        cmocka_unit_test(options_that_are_promised_are_refused_by_name),
        cmocka_unit_test(wrong_options_are_refused_before_anything_is_read),
        cmocka_unit_test(wrong_values_are_refused),
        cmocka_unit_test(one_study_is_wanted),
        cmocka_unit_test(options_may_come_first_and_hold_their_value),
        cmocka_unit_test(a_variant_is_chosen_by_its_name),
        cmocka_unit_test(what_cannot_be_printed_is_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
