/* tests/unit/test_photometry_encoding.c -- labels in the encodings that files come in. */
#include "lights/photometry_parts.h"
#include "tests/photometry_reading.h"

#include <stdio.h>

#define NUMBERS "1 -1 1 3 1 1 2 0 0 0 1 1 40\n0 45 90\n0\n100 50 0\n"

static const char *label(const char *bytes)
{
    char text[512];
    snprintf(text, sizeof text, "IESNA91\n[MANUFAC] %s\nTILT=NONE\n" NUMBERS, bytes);
    assert_non_null(read_text(text));
    assert_int_equal(r.n.count, 0);
    assert_true(at(0, 45) == 50.0);
    return r.p->manufacturer;
}

TEST(latin_1_labels_become_utf_8)
{
    assert_string_equal(label("Gr\xfc\xdf"
                              "e"),
                        "Gr\xc3\xbc\xc3\x9f"
                        "e");
    assert_string_equal(label("Gr\xc3\xbc\xc3\x9f"
                              "e"),
                        "Gr\xc3\xbc\xc3\x9f"
                        "e");
    assert_string_equal(label("\xc4\xd6\xdc \xe9\xe0 \xe8re"),
                        "\xc3\x84\xc3\x96\xc3\x9c \xc3\xa9\xc3\xa0 \xc3\xa8re");
}

TEST(quotes_dashes_and_signs_of_windows_are_kept)
{
    assert_string_equal(label("Lamp\x99 \x96 Erco\x92s \x80 5"),
                        "Lamp\xe2\x84\xa2 \xe2\x80\x93 Erco\xe2\x80\x99s \xe2\x82\xac 5");
    assert_string_equal(label("a\x81 b"), "a  b"); /* in no use */
}

/* 照明器具 (lighting fixture), ダウンライト (downlight) with a trail byte that is a backslash (ソ),
 * half-width ﾗﾝﾌﾟ (lamp) and Latin letters. */
#define LIGHTING  "\x8f\xc6\x96\xbe\x8a\xed\x8b\xef"
#define DOWNLIGHT "\x83\x5f\x83\x45\x83\x93\x83\x89\x83\x43\x83\x67"

TEST(shift_jis_labels_become_utf_8)
{
    assert_string_equal(label(LIGHTING), "照明器具");
    assert_string_equal(label(DOWNLIGHT " 100 lm \x83\x5c\x83\x5b"), "ダウンライト 100 lm ソゼ");
    assert_string_equal(label(LIGHTING " \xd7\xdd\xcc\xdf"), "照明器具 ﾗﾝﾌﾟ");
}

TEST(shift_jis_does_not_break_the_lines_of_eulumdat)
{
    assert_non_null(
        read_text(LIGHTING "\r\n2\r\n1\r\n1\r\n0\r\n2\r\n90\r\n\r\n" DOWNLIGHT "\r\n\r\n\r\n\r\n"
                           "500\r\n400\r\n30\r\n0\r\n0\r\n0\r\n0\r\n0\r\n0\r\n100\r\n100\r\n1\r\n"
                           "0\r\n1\r\n1\r\nLED\r\n1000\r\n\r\n\r\n40\r\n0\r\n0\r\n0\r\n0\r\n0\r\n"
                           "0\r\n0\r\n0\r\n0\r\n0\r\n0\r\n0\r\n90\r\n7\r\n5"));
    assert_string_equal(r.p->manufacturer, "照明器具");
    assert_string_equal(r.p->name, "ダウンライト");
    assert_near(at(0, 90), 5.0, 1e-6);
}

TEST(only_japanese_text_is_taken_for_shift_jis)
{
    assert_true(text_is_shift_jis(LIGHTING, 8));
    assert_false(text_is_shift_jis(LIGHTING, 7)); /* cut within a character */
    assert_false(text_is_shift_jis("照明器具", 12));
    assert_false(text_is_shift_jis("Gr\xfc\xdf"
                                   "e, Lumi\xe8re",
                                   14));
    assert_false(text_is_shift_jis("Erco\x92s \x93Halo\x94", 14));
    assert_false(text_is_shift_jis("lamp", 4));
}

/* Two-byte characters cut in the middle, controls, and bytes that are nothing. */
TEST(labels_are_always_whole_utf_8)
{
    char bytes[301] = { 0 };
    for (int k = 0; k < 300; k++)
        bytes[k] = k % 2 ? '\xa0' : '\x82'; /* あ */
    const char *s = label(bytes);
    assert_int_equal(strlen(s), 450);
    assert_false(strncmp(s, "あああ", 9));
    label(LIGHTING "\x81\xad"); /* no such character */
    label("a\x01\x02\x7f"
          "b");
    assert_string_equal(r.p->manufacturer, "a   b");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(latin_1_labels_become_utf_8),
        cmocka_unit_test(quotes_dashes_and_signs_of_windows_are_kept),
        cmocka_unit_test(shift_jis_labels_become_utf_8),
        cmocka_unit_test(shift_jis_does_not_break_the_lines_of_eulumdat),
        cmocka_unit_test(only_japanese_text_is_taken_for_shift_jis),
        cmocka_unit_test(labels_are_always_whole_utf_8),
    };
    return cmocka_run_group_tests(tests, NULL, finish);
}
