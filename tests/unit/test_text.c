/* tests/unit/test_text.c -- numbers are read as written, or not at all. */
#include "core/text.h"
#include "tests/test.h"

#include <float.h>
#include <locale.h>
#include <string.h>

static void assert_number(const char *s, double want, const char *rest)
{
    double got      = 77.0;
    const char *end = NULL;
    assert_true(text_number(s, &end, &got));
    assert_memory_equal(&got, &want, sizeof want); /* -0 is not 0 */
    assert_string_equal(end, rest);
}

TEST(numbers_end_where_they_end)
{
    assert_number("0", 0.0, "");
    assert_number("-0", -0.0, "");
    assert_number("+12.50mm", 12.5, "mm");
    assert_number(".5", 0.5, "");
    assert_number("5.", 5.0, "");
    assert_number("1.2.3", 1.2, ".3");
    assert_number("1e3", 1000.0, "");
    assert_number("1E-3,", 0.001, ",");
    assert_number("1e", 1.0, "e");
    assert_number("1e+", 1.0, "e+");
    assert_number("0x10", 0.0, "x10");
    assert_number("-0X10", -0.0, "X10");
}

TEST(numbers_are_the_nearest_doubles)
{
    assert_number("0.1", 0.1, "");
    assert_number("1.7976931348623157e308", DBL_MAX, "");
    assert_number("4.9406564584124654e-324", DBL_TRUE_MIN, "");
    assert_number("1e-999", 0.0, "");
    assert_number("9007199254740993", 9007199254740992.0, ""); /* 2^53 + 1: a tie, to even */
}

TEST(what_is_no_finite_number_is_refused)
{
    static const char *const no[] = { "",    "+",   "-",     ".", "e5", " 1",
                                      "inf", "nan", "1e309", "x", "--1" };
    for (size_t i = 0; i < sizeof no / sizeof *no; i++) {
        double out = 77.0;
        assert_false(text_number(no[i], NULL, &out));
        assert_true(out == 77.0);
    }
}

TEST(a_locale_with_a_comma_changes_nothing)
{
    if (!setlocale(LC_NUMERIC, "de_DE.UTF-8") && !setlocale(LC_NUMERIC, "fr_FR.UTF-8"))
        skip();
    assert_number("1.5", 1.5, "");
    assert_number("1,5", 1.0, ",5");
    setlocale(LC_NUMERIC, "C");
}

/* Counted by hand; kitten and sitting is everybody's example. */
TEST(words_are_as_far_apart_as_slips_lie_between)
{
    static const struct {
        const char *a, *b;
        int slips;
    } cases[] = {
        { "", "", 0 },
        { "general", "general", 0 },
        { "", "sky", 3 },
        { "sky", "", 3 },
        { "kitten", "sitting", 3 },
        { "genral", "general", 1 },
        { "gerneal", "general", 2 },
        { "gird", "grid", 1 },
        { "grid", "render", 5 },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_int_equal(text_distance(cases[i].a, cases[i].b), cases[i].slips);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_end_where_they_end),
        cmocka_unit_test(numbers_are_the_nearest_doubles),
        cmocka_unit_test(what_is_no_finite_number_is_refused),
        cmocka_unit_test(words_are_as_far_apart_as_slips_lie_between),
        cmocka_unit_test(a_locale_with_a_comma_changes_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
