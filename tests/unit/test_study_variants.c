/* tests/unit/test_study_variants.c -- named changes, merged over a study by key. */
#include "tests/study_text.h"
#include "tests/test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char office[] =
    "lux4: 1\n"
    "room: {size: [5, 4, 3], reflectance: {ceiling: 0.7, walls: 0.5, floor: 0.2}}\n"
    "maintenance: 0.8\n"
    "lights:\n"
    "  - {type: point, at: [1, 1, 2], intensity: 100, group: general}\n"
    "  - {type: point, at: [2, 1, 2], intensity: 100, group: desk}\n"
    "dimming: {general: 0.5, desk: 0.25}\n"
    "grids: [{name: a, on: room, height: 0.75, spacing: 1}]\n"
    "accuracy: 5%\n"
    "variants:\n"
    "  evening: {sky: {model: none}, dimming: {general: 0.3}}\n"
    "  bright: {room: {reflectance: {walls: 0.8}}, maintenance: ~, accuracy: 1%}\n"
    "  dark: {lights: [{type: point, at: [1, 1, 1], lumens: 9}], dimming: {general: ~, desk: ~,\n"
    "         other: 2}}\n"
    "  as-built: {}\n"
    "  new: {dimming: null, views: [{name: v, camera: c}], grids: []}\n"
    "  tall: {room: {size: [5, 4, 9]}, grids: [{name: a, on: room, height: 8, spacing: 1}]}\n";

static arena memory;

static const study *good(const char *variant) { return study_of_text(&memory, variant, office); }

static int forget(void **state)
{
    (void)state;
    arena_clear(&memory);
    return 0;
}

TEST(without_a_variant_a_study_is_what_it_says)
{
    const study *s = good(NULL), *same = good("as-built");
    assert_null(s->variant);
    assert_string_equal(same->variant, "as-built");
    for (int i = 0; i < 2; i++, s = same) {
        assert_true(study_group_factor(s, "general") == 0.5);
        assert_true(s->maintenance == 0.8 && s->light_count == 2 && s->grid_count == 1);
        assert_near(s->room.walls.x, 0.5, 1e-7); /* a float */
    }
}

TEST(mappings_are_merged_by_key)
{
    const study *s = good("evening");
    assert_string_equal(s->variant, "evening");
    assert_true(study_group_factor(s, "general") == 0.3);
    assert_true(study_group_factor(s, "desk") == 0.25); /* kept */
    assert_true(s->maintenance == 0.8 && s->light_count == 2);

    s = good("bright");
    assert_near(s->room.walls.x, 0.8, 1e-7);
    assert_near(s->room.ceiling.x, 0.7, 1e-7);
    assert_true(s->room.size.x == 5.0 && s->accuracy == 0.01);
}

TEST(what_is_no_mapping_is_replaced_as_a_whole)
{
    const study *s = good("dark");
    assert_int_equal(s->light_count, 1);
    assert_true(s->lights[0].lumens == 9.0 && s->lights[0].where.line == 13);
    s = good("tall");
    assert_true(s->grid_count == 1 && s->grids[0].height == 8.0); /* checked in the new room */
    s = good("new");
    assert_true(s->view_count == 1 && s->grid_count == 0);
}

TEST(null_takes_a_key_out)
{
    const study *s = good("bright");
    assert_true(s->maintenance == 1.0 && !s->maintenance_given);
    s = good("dark");
    assert_int_equal(s->dimming_count, 1);
    assert_true(study_group_factor(s, NULL) == 2.0);
    assert_int_equal(good("new")->dimming_count, 0);
}

TEST(a_variant_that_is_not_there_is_refused)
{
    assert_study_refused("evning", office, ERR_ARGUMENT,
                         "11:3: no variant `evning`: did you mean `evening`?");
    assert_study_refused("xyzxyz", office, ERR_ARGUMENT,
                         "11:3: no variant `xyzxyz`: there is evening, bright, dark, as-built, "
                         "new, tall");
    assert_study_refused("\x1b[1m\n", office, ERR_ARGUMENT,
                         "11:3: no variant `?[1m?`: there is evening, bright, dark, as-built, "
                         "new, tall");
    assert_study_refused("", office, ERR_ARGUMENT,
                         "11:3: no variant ``: there is evening, bright, dark, as-built, "
                         "new, tall");
    assert_study_refused("a", "lux4: 1\n", ERR_ARGUMENT,
                         " no variant `a`: the study has no `variants`");
    assert_study_refused("a", "lux4: 1\nvariants: {}", ERR_ARGUMENT,
                         " no variant `a`: the study has no `variants`");
}

TEST(every_variant_is_checked_whether_it_is_chosen_or_not)
{
    static const broken_study table[] = {
        { "variants: []", "2:11: expected a mapping (key: value), found a list of 0" },
        { "variants:\n  a:", "3:5: expected a mapping (key: value), found nothing" },
        { "variants:\n  a: {lux4: 1}", "3:13: a variant cannot change `lux4`" },
        { "variants:\n  a: {variants: {}}", "3:17: a variant cannot change `variants`" },
        { "variants: {a: {}, b: {},\n a: {}}", "3:2: the key `a` stands in line 2 already" },
        { "variants: {a/b: {}}",
          "2:12: expected a name of a-z, A-Z, 0-9, _, - and . that does not begin with - or . (it "
          "names files), found `a/b`" },
        { "variants:\n  a: {}\n  b: {acuracy: 2%}",
          "4:7: with the variant `b`: unknown key `acuracy`: did you mean `accuracy`?" },
        { "variants:\n  b: {maintenance: 2}",
          "3:20: with the variant `b`: expected a number > 0 and at most 1, found `2`" },
        { "variants:\n  b: {maintenance: ~}",
          "3:7: with the variant `b`: there is no key `maintenance` to be taken out" },
        { "room: {size: [1, 2, 3], reflectance: 1}\nvariants:\n  b: {room: {size: ~}}",
          "4:13: with the variant `b`: a room needs the key `size`" },
        { "room: {size: [1, 2, 3], reflectance: 1}\nvariants:\n"
          "  b: {room: {size: [1, 1, 1],\n size: [2, 2, 2]}}",
          "5:2: with the variant `b`: the key `size` stands in line 4 already" },
        { "variants:\n  b: {maintenance: 1, maintenance: 1}",
          "3:23: with the variant `b`: the key `maintenance` stands in line 3 already" },
        { "variants:\n  b: {dimming: {g: 1}}",
          "3:17: with the variant `b`: no light is of the group `g`" },
        { "variants:\n  b: {[c]: 1}",
          "3:7: with the variant `b`: expected the name of a key, found a list of 1" },
        { "room: {size: [1, 2, 3], reflectance: 1}\n"
          "grids: [{name: a, on: room, height: 2, spacing: 1}]\n"
          "variants:\n  low: {room: {size: [1, 2, 2]}}",
          "3:9: with the variant `low`: `height: 2` is not below the ceiling at 2 m" },
    };
    ALL_REFUSED(table, ERR_FORMAT);
    assert_study_refused(NULL,
                         "lux4: 1\nvariants: {a: {when: 2026-06-21T10:00, sky: {model: clear, "
                         "sun: dim}}}",
                         ERR_FORMAT,
                         "2:65: with the variant `a`: expected off or on or disk or point, found "
                         "`dim`");
}

TEST(a_study_must_be_good_without_its_variants)
{
    assert_study_refused("a", "lux4: 1\nmaintenance: 2\nvariants: {a: {maintenance: 1}}",
                         ERR_FORMAT, "2:14: expected a number > 0 and at most 1, found `2`");
}

TEST(later_stages_name_the_variant)
{
    lux_error err  = { 0 };
    const study *s = good("dark");
    assert_null(study_failed(s, s->lights[0].where, &err, ERR_IO, "no lamp"));
    assert_string_equal(err.text, "job/office.yaml:13:19: with the variant `dark`: no lamp");
}

TEST(variants_are_bounded)
{
    char text[2000] = "lux4: 1\nvariants: {";
    for (int i = 0; i < 65; i++)
        sprintf(text + strlen(text), "v%d: {}, ", i);
    strcat(text, "}");
    assert_study_refused(NULL, text, ERR_FORMAT, "2:11: a mapping of 65 keys, expected at most 64");
    char *many  = malloc(1 << 20);
    size_t used = (size_t)sprintf(many, "lux4: 1\nvariants: {a: {");
    for (int i = 0; i < 80000; i++)
        used += (size_t)sprintf(many + used, "k%d: 1,", i);
    strcpy(many + used, "}}");
    assert_study_refused(NULL, many, ERR_FORMAT,
                         "2:15: with the variant `a`: a mapping of 80000 keys, expected at most "
                         "64");
    free(many);
}

TEST(what_variants_repeat_is_bounded)
{
    char *text  = malloc(1 << 20);
    size_t used = (size_t)sprintf(text, "lux4: 1\nscene:\n");
    for (int i = 0; i < 90000; i++)
        used += (size_t)sprintf(text + used, "- a\n");
    used += (size_t)sprintf(text + used, "variants:\n");
    for (int i = 0; i < 21; i++)
        used += (size_t)sprintf(text + used, "  v%d: {}\n", i);
    assert_non_null(study_of_text(&memory, NULL, text)); /* 22 times 90,000 */
    strcpy(text + used, "  w: {}\n");
    assert_study_refused(NULL, text, ERR_FORMAT,
                         "3:1: with the variant `w`: more than 2000000 items of lists in all "
                         "variants together");
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(without_a_variant_a_study_is_what_it_says, forget),
        cmocka_unit_test_teardown(mappings_are_merged_by_key, forget),
        cmocka_unit_test_teardown(what_is_no_mapping_is_replaced_as_a_whole, forget),
        cmocka_unit_test_teardown(null_takes_a_key_out, forget),
        cmocka_unit_test(a_variant_that_is_not_there_is_refused),
        cmocka_unit_test(every_variant_is_checked_whether_it_is_chosen_or_not),
        cmocka_unit_test(a_study_must_be_good_without_its_variants),
        cmocka_unit_test_teardown(later_stages_name_the_variant, forget),
        cmocka_unit_test(variants_are_bounded),
        cmocka_unit_test_teardown(what_variants_repeat_is_bounded, forget),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
