/* tests/eulumdat_sheet.h -- EULUMDAT files for tests, and reading them. */
#ifndef TESTS_EULUMDAT_SHEET_H
#define TESTS_EULUMDAT_SHEET_H

#include "tests/photometry_reading.h"

#include <stdio.h>

/* A file from its parts; every place that a test changes is an argument. */
typedef struct ldt {
    const char *symmetry, *planes, *opening, *factor, *sets, *angles, *values;
} ldt;

#define ONE_SET "1\n2\nLED\n2000\n3000\n80\n40\n"

static const ldt plain = { "1", "1", "0\n0\n0\n0\n0\n0", "1", ONE_SET, "0", "100\n50\n0" };

static inline const char *sheet_text(ldt t)
{
    static char text[2048];
    snprintf(text, sizeof text,
             "Company\n2\n%s\n%s\n0\n3\n45\nReport\nName\nNumber\nfile.ldt\ndate\n500\n400\n30\n%"
             "s\n100\n"
             "100\n%s\n0\n%s0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n%s\n0\n45\n90\n%s\n",
             t.symmetry, t.planes, t.opening, t.factor, t.sets, t.angles, t.values);
    return text;
}

static inline const photometry *read_ldt(ldt t) { return read_text(sheet_text(t)); }

/* Eight planes; at gamma 0 10 cd/klm, at 90 the plane's own number. */
#define EIGHT "0\n45\n90\n135\n180\n225\n270\n315"

#endif
