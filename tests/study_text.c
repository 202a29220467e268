/* tests/study_text.c -- see study_text.h. */
#include "tests/study_text.h"

#include "tests/test.h"

#include <stdio.h>
#include <string.h>

const study *study_of_text(arena *a, const char *variant, const char *text)
{
    lux_error err  = { 0 };
    const study *s = study_parse(a, "job/office.yaml", variant, text, strlen(text), NULL, &err);
    if (!s)
        fail_msg("%s", err.text);
    return s;
}

void assert_study_refused(const char *variant, const char *text, error_code code, const char *says)
{
    arena memory   = { 0 };
    lux_error err  = { 0 };
    const study *s = study_parse(&memory, "s.yaml", variant, text, strlen(text), NULL, &err);
    if (s)
        fail_msg("read without an error, not \"%s\":\n%s", says, text);
    if (strncmp(err.text, "s.yaml:", 7) != 0 || strcmp(err.text + 7, says) != 0)
        fail_msg("\"%s\", not \"%s\", for\n%s", err.text, says, text);
    assert_int_equal(err.code, code);
    arena_clear(&memory);
}

void assert_studies_refused(const broken_study *table, size_t count, error_code code)
{
    for (size_t i = 0; i < count; i++) {
        char text[2000];
        snprintf(text, sizeof text, "lux4: 1\n%s", table[i].text);
        assert_study_refused(NULL, text, code, table[i].says);
    }
}
