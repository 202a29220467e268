/* tests/unit/test_study_hostile.c -- studies that were made to hurt, and files that are none. */
#include "sim/study.h"
#include "tests/test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* Every kind of thing that a study can hold, to be cut and bent. */
static const char whole[] =
    "%YAML 1.2\n---\nlux4: 1 # one\n"
    "room: {size: [10, 6, 3], reflectance: {ceiling: 0.7, walls: [0.5, 0.4, 0.3], floor: 0.2}}\n"
    "scene:\n  - {file: 'office.glb', scale: 0x1, lights: on}\n  - {file: desk.glb, at: &a [[2, "
    "1.5, 0], [4, 1.5, 0]], rotate: 90}\n"
    "sky: {model: cie, cie: {type: 12}, sun: disk, turbidity: 3, ground: [0.1, 0.2, 0.3], "
    "horizontal: 5}\nsite: {place: 55.7558N 37.6173E, altitude: 150, zone: Europe/Moscow, north: "
    "9}\n"
    "when: {date: 2026-03-21..2026-06-21, from: \"08:00\", to: 18:00, step: 60, every: week}\n"
    "maintenance: 0.8\nluminaires:\n  - name: down\n    photometry: a.ies\n"
    "    at: *a\n    color: 4000K\n    lumens: 3e3\n    group: g\n    aim_at: [3, 2, 0]\n"
    "  - {photometry: b.ldt, layout: {fill: room, z: 2.8, count: [2, 3]}}\n"
    "  - {photometry: b.ldt, layout: {from: [0, 0, 1], to: [1, 2, 1], count: 4}}\n"
    "  - {photometry: b.ldt, nodes: 'Spot*', aim: [0, 1, 0]}\n"
    "lights:\n  - {type: point, at: [0, 0, 3], intensity: 100, color: [1, 0.5, 0.2]}\n"
    "  - {type: cone, at: [0, 0, 3], aim_at: [0, 1, 0], lumens: 10, inner: 20, outer: 30}\n"
    "  - {type: cosine, at: [0, 0, 3], aim: [0, 0, -1], intensity: 100, exponent: 4}\n"
    "  - {type: parallel, aim: [0, 0, -1], illuminance: 9, at: [0, 0, 9], radius: 1}\n"
    "  - {type: linear, from: [0, 0, 3], to: [2, 0, 3], lumens: 1000}\n"
    "  - {type: disk, at: [0, 0, 3], radius: 0.2, photometry: c.ies}\n"
    "  - {type: rect, at: [0, 0, 3], up: [0, 1, 0], size: [1.2, 0.3], luminance: 3000}\n"
    "dimming: {g: 0.5, other: 2}\n"
    "materials:\n  - {match: \"W\\u00e4nd*\", reflectance: 0.5}\n"
    "grids:\n  - {name: desk, on: room, height: 0.75, margin: 0.5, spacing: en12464, "
    "require: {average: 500}}\n"
    "  - name: p\n    points: |-\n      probes.csv\n"
    "  - {name: plane, origin: [0, 0, 0.75], u: [10, 0, 0], v: [0, 6, 0], spacing: 0.5}\n"
    "  - {name: wall, on: walls, spacing: 1, quantity: vertical, require: {maximum: 9}}\n"
    "  - {name: c, on: ceiling, spacing: 2, quantity: semicylindrical, facing: [1, 0, 0]}\n"
    "views:\n  - {name: corner, eye: [0.2, 0.2, 1.6], target: [5, 3, 1], fov: 70, size: [64, 48]}\n"
    "accuracy: 2%\nvariants:\n  v: {sky: {model: none}, dimming: {g: ~}, room: {size: [9, 9, 9]}}\n"
    "  w: {grids: [], lights: [], when: 2026-06-21T10:00+03:00, sky: {cie: ~, model: perez, "
    "turbidity: ~, horizontal: ~, perez: {direct_normal: 500, diffuse_horizontal: 90}}}\n"
    "  x: {when: ~, sky: {sun_at: {azimuth: 180, elevation: 60}}}\n...\n";

/* Reads; if it is refused, the message must be one line that names the file. */
static bool survives(const char *text, size_t size)
{
    arena memory  = { 0 };
    lux_error err = { 0 };
    char *exact   = malloc(size ? size : 1); /* so that the sanitizer sees a byte too far */
    const study *s =
        study_parse(&memory, "s.yaml", NULL, memcpy(exact, text, size), size, NULL, &err);
    if (!s && (strncmp(err.text, "s.yaml:", 7) != 0 || strpbrk(err.text, "\n\r\x1b")))
        fail_msg("no good message: %s", err.text);
    free(exact);
    arena_clear(&memory);
    return s != NULL;
}

static void assert_says(const char *text, size_t size, const char *says)
{
    arena memory  = { 0 };
    lux_error err = { 0 };
    clock_t began = clock();
    assert_null(study_parse(&memory, "s.yaml", NULL, text, size, NULL, &err));
    double seconds = (double)(clock() - began) / CLOCKS_PER_SEC;
    assert_string_equal(err.text, says);
    if (seconds > 1.0) /* a few ms; libyaml by itself took 36 s for some */
        fail_msg("%.1f s for \"%s\"", seconds, says);
    arena_clear(&memory);
}

/* The unit, as often as it fits into `size` bytes, behind the front. */
static char *repeated(const char *front, const char *unit, size_t size)
{
    char *text = malloc(size + 1);
    size_t at = strlen(front), step = strlen(unit);
    memcpy(text, front, at);
    for (; at < size; at += step)
        memcpy(text + at, unit, step < size - at ? step : size - at);
    text[size] = '\0';
    return text;
}

TEST(a_study_cut_anywhere_is_read_or_refused)
{
    assert_true(survives(whole, strlen(whole)));
    for (size_t size = 0; size < strlen(whole); size++)
        survives(whole, size);
}

TEST(a_study_with_any_byte_bent_is_read_or_refused)
{
    static const unsigned char bends[] = { 0x01, 0x20, 0x80, 0xff };
    char text[sizeof whole];
    for (size_t i = 0; i < strlen(whole); i++)
        for (size_t k = 0; k < sizeof bends; k++) {
            memcpy(text, whole, sizeof whole);
            text[i] = (char)((unsigned char)text[i] ^ bends[k]);
            survives(text, strlen(whole));
        }
}

TEST(a_study_with_any_byte_replaced_by_an_indicator_is_read_or_refused)
{
    static const char indicators[] = "[]{},:-?&*!|>'\"%@`#\n\t ~";
    char text[sizeof whole];
    for (size_t i = 0; i < strlen(whole); i++) {
        memcpy(text, whole, sizeof whole);
        text[i] = indicators[i % strlen(indicators)];
        survives(text, strlen(whole));
    }
}

TEST(endless_nesting_is_refused_at_once)
{
    static const struct {
        const char *unit, *says;
    } table[] = { { "[", "s.yaml:1:65: nested deeper than 64" },
                  { "{", "s.yaml:1:65: nested deeper than 64" },
                  { "[\n", "s.yaml:65:1: nested deeper than 64" },
                  { "{? ", "s.yaml:1:193: nested deeper than 64" },
                  { "- ", "s.yaml:1:129: nested deeper than 64" },
                  { "? ", "s.yaml:1:129: nested deeper than 64" } };
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        char *text = repeated("", table[i].unit, 160000);
        assert_says(text, 160000, table[i].says);
        free(text);
    }
}

TEST(brackets_in_texts_and_comments_are_no_nesting)
{
    char *text = repeated("lux4: 1\nmaterials: [{reflectance: 0, match: '", "[{", 1000);
    char commented[3000];
    snprintf(commented, sizeof commented, "%s'}]\n# %s\n", text, text + 100);
    assert_true(survives(commented, strlen(commented)));
    free(text);
}

TEST(what_repeats_in_libyaml_is_bounded)
{
    size_t size = 900000;
    char *text  = malloc(size + 100);
    size_t used = 0;
    for (int i = 0; used < size; i++)
        used += (size_t)sprintf(text + used, "- &a%d\n", i);
    assert_says(text, used, "s.yaml:1001:3: anchors (&): more than 1000");

    used = 0;
    for (int i = 0; used < size; i++)
        used += (size_t)sprintf(text + used, "%%TAG !a%d! b\n", i);
    assert_says(text, used, "s.yaml:17:1: directives (%): more than 16");
    free(text);
}

TEST(aliases_make_no_cycle_no_depth_and_no_flood)
{
    static const char cycle[] = "lux4: 1\nscene: &a [x, *a]\n";
    assert_says(cycle, strlen(cycle), "s.yaml:2:8: contains itself through an alias (*)");
    static const char key[] = "lux4: 1\n? &a {x: {? *a : 1}}\n: 2\n";
    assert_says(key, strlen(key), "s.yaml:2:3: contains itself through an alias (*)");

    /* Ten times as many in each line */
    char text[8000] = "lux4: 1\na: &a [x,x,x,x,x,x,x,x,x,x]\n";
    for (int c = 'b'; c <= 'k'; c++) {
        int d = c - 1;
        sprintf(text + strlen(text), "%c: &%c [*%c,*%c,*%c,*%c,*%c,*%c,*%c,*%c,*%c,*%c]\n", c, c, d,
                d, d, d, d, d, d, d, d, d);
    }
    assert_says(text, strlen(text),
                "s.yaml:6:4: nodes, with what aliases (*) repeat: more than 1000000");

    /* One level deeper in each line */
    strcpy(text, "lux4: 1\na0: &a0 [x]\n");
    for (int i = 1; i < 100; i++)
        sprintf(text + strlen(text), "a%d: &a%d [*a%d]\n", i, i, i - 1);
    assert_says(text, strlen(text), "s.yaml:64:6: nested through aliases (*) deeper than 64");
}

TEST(lists_are_bounded)
{
    char *text                   = repeated("lux4: 1\nscene: [", "a,", 8 + 8 + 2 * 100001);
    text[8 + 8 + 2 * 100001 - 1] = ']';
    assert_says(text, strlen(text), "s.yaml:2:8: a list of 100001, expected at most 100000");
    memmove(text + 16, text + 18, strlen(text + 18) + 1);
    assert_true(survives(text, strlen(text)));
    free(text);
}

TEST(what_is_no_study_is_refused_in_one_line)
{
    static const struct {
        const char *text, *says;
    } table[] = {
        { "", "s.yaml: nothing in it, expected a study (lux4: 1 ...)" },
        { "# nothing\n\n", "s.yaml: nothing in it, expected a study (lux4: 1 ...)" },
        { "\xef\xbb\xbf", "s.yaml: nothing in it, expected a study (lux4: 1 ...)" },
        { "---\n", "s.yaml:2:1: expected a study (lux4: 1 ...), found nothing" },
        { "lux4: 1\n---\nlux4: 1\n", "s.yaml:2:1: a second document begins here, expected one" },
        { "lux4: 1\n\tscene: a", "s.yaml:2:1: not valid YAML: while scanning a plain scalar: found "
                                 "a tab character that violates indentation" },
        { "lux4: [1", "s.yaml:2:1: not valid YAML: while parsing a flow sequence: did not find "
                      "expected ',' or ']'" },
        { "lux4: 1\n# gr\xc3\xbc\xff", "s.yaml:2:6: not valid YAML: invalid leading UTF-8 octet" },
        { "lux4: 1\nscene: \x01",
          "s.yaml:2:8: not valid YAML: control characters are not allowed" },
        { "\xff\xfel\0u\0x\0", "s.yaml:1:1: not valid YAML: invalid leading UTF-8 octet" },
        { "lux4: *no", "s.yaml:1:7: not valid YAML: found undefined alias" },
        { "lux4: !!int 1", "s.yaml:1:7: tags (!) have no meaning in a study" },
        { "lux4: 1\nscene: !evil [a]", "s.yaml:2:8: tags (!) have no meaning in a study" },
    };
    for (size_t i = 0; i < sizeof table / sizeof *table; i++)
        assert_says(table[i].text, strlen(table[i].text), table[i].says);
    assert_says("lux4: 1\0", 8, "s.yaml:1:8: not valid YAML: control characters are not allowed");
    char *huge = repeated("lux4: 1\n", "#", (1 << 20) + 1);
    assert_says(huge, (1 << 20) + 1, "s.yaml: 1048577 bytes, a study has at most 1048576");
    assert_true(survives(huge, 1 << 20));
    free(huge);
}

TEST(messages_show_no_control_characters_and_half_no_character)
{
    static const char escape[] = "lux4: 1\n\"\\e[31m\\n\": 2";
    assert_says(escape, strlen(escape),
                "s.yaml:2:1: unknown key the text `?[31m?`: a study has lux4, room, scene, site, "
                "when, sky, maintenance, luminaires, lights, dimming, materials, grids, views, "
                "accuracy, variants");
    char *text = repeated("lux4: x", "\xc3\xa9", 6 + 1 + 200);
    assert_says(text, strlen(text),
                "s.yaml:1:7: expected a number, found "
                "`x\xc3\xa9\xc3\xa9\xc3\xa9\xc3\xa9\xc3\xa9\xc3\xa9\xc3\xa9\xc3\xa9\xc3\xa9"
                "\xc3\xa9\xc3\xa9\xc3\xa9\xc3\xa9\xc3\xa9\xc3\xa9\xc3\xa9\xc3\xa9\xc3\xa9\xc3\xa9"
                "\xc3\xa9\xc3\xa9\xc3\xa9\xc3\xa9...`");
    free(text);
}

TEST(files_that_cannot_be_read_are_errors)
{
    arena memory  = { 0 };
    lux_error err = { 0 };
    assert_null(study_read(&memory, "tests", NULL, NULL, &err));
    assert_int_equal(err.code, ERR_IO);
    assert_non_null(strstr(err.text, "tests: "));
    assert_null(study_read(&memory, "tests/no-such.yaml", NULL, NULL, &err));
    assert_int_equal(err.code, ERR_IO);
    assert_non_null(strstr(err.text, "tests/no-such.yaml: "));
    assert_null(study_read(&memory, "tests/run", NULL, NULL, &err)); /* a file, but no study */
    assert_int_equal(err.code, ERR_FORMAT);
    assert_non_null(strstr(err.text, "tests/run:"));
    arena_clear(&memory);
}

TEST(no_memory_is_an_error)
{
    arena memory   = { 0 };
    lux_error err  = { 0 };
    memory_is_out  = true;
    const study *s = study_parse(&memory, "s.yaml", NULL, whole, strlen(whole), NULL, &err);
    memory_is_out  = false;
    assert_null(s);
    assert_int_equal(err.code, ERR_MEMORY);
    arena_clear(&memory);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_study_cut_anywhere_is_read_or_refused),
        cmocka_unit_test(a_study_with_any_byte_bent_is_read_or_refused),
        cmocka_unit_test(a_study_with_any_byte_replaced_by_an_indicator_is_read_or_refused),
        cmocka_unit_test(endless_nesting_is_refused_at_once),
        cmocka_unit_test(brackets_in_texts_and_comments_are_no_nesting),
        cmocka_unit_test(what_repeats_in_libyaml_is_bounded),
        cmocka_unit_test(aliases_make_no_cycle_no_depth_and_no_flood),
        cmocka_unit_test(lists_are_bounded),
        cmocka_unit_test(what_is_no_study_is_refused_in_one_line),
        cmocka_unit_test(messages_show_no_control_characters_and_half_no_character),
        cmocka_unit_test(files_that_cannot_be_read_are_errors),
        cmocka_unit_test(no_memory_is_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
