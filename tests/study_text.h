/* tests/study_text.h -- studies as texts, and what is said of those that are broken. */
#ifndef TESTS_STUDY_TEXT_H
#define TESTS_STUDY_TEXT_H

#include "sim/study.h"

/* The study, read as job/office.yaml with a variant or NULL. Fails the test if it is refused. */
const study *study_of_text(arena *a, const char *variant, const char *text);

typedef struct broken_study {
    const char *text, *says; /* behind "lux4: 1\n"; behind "s.yaml:" */
} broken_study;

/* Fails unless the whole text is refused with that code and, behind "s.yaml:", that message. */
void assert_study_refused(const char *variant, const char *text, error_code code, const char *says);
void assert_studies_refused(const broken_study *table, size_t count, error_code code);

#define ALL_REFUSED(table, code) assert_studies_refused(table, sizeof table / sizeof *table, code)

#endif
