/* tests/fuzz/fuzz_study.c -- any bytes as a study: read, or refused in one line that names it. */
#include "sim/study.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    arena memory   = { 0 };
    notices n      = { .a = &memory };
    lux_error err  = { 0 };
    const study *s = study_parse(&memory, "s.yaml", NULL, (const char *)bytes, size, &n, &err);
    if (!s && (strncmp(err.text, "s.yaml:", 7) != 0 || strpbrk(err.text, "\n\r\x1b")))
        abort();
    for (int i = 0; s && i < s->grid_count; i++)
        if (!s->grids[i].points && !(s->grids[i].spacing > 0.0))
            abort();
    arena_clear(&memory);
    return 0;
}
