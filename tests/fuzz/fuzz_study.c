/* tests/fuzz/fuzz_study.c -- any bytes as a study: read, or refused in one line that names it. */
#define _GNU_SOURCE /* memmem() */
#include "sim/study.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size);

static void look_at(const study *s)
{
    double along_u, along_v;
    for (int i = 0; i < s->grid_count; i++) {
        if (s->grids[i].points)
            continue;
        study_grid_counts(&s->grids[i], &along_u, &along_v);
        if (!(s->grids[i].spacing > 0.0 && along_u >= 1.0 && along_v >= 1.0))
            abort();
    }
    for (int i = 0; i < s->luminaire_count; i++)
        if (!s->luminaires[i].nodes && !s->luminaires[i].at)
            abort();
    for (int i = 0; i < s->light_count; i++)
        for (int k = 0; k < s->lights[i].at_count; k++)
            if (!(d3_length(study_light_aim(&s->lights[i], k)) > 0.0))
                abort();
}

static void read_one(const char *variant, const uint8_t *bytes, size_t size)
{
    arena memory   = { 0 };
    notices n      = { .a = &memory };
    lux_error err  = { 0 };
    const study *s = study_parse(&memory, "s.yaml", variant, (const char *)bytes, size, &n, &err);
    if (!s && (strncmp(err.text, "s.yaml:", 7) != 0 || strpbrk(err.text, "\n\r\x1b")))
        abort();
    if (s)
        look_at(s);
    arena_clear(&memory);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    read_one(NULL, bytes, size);
    if (memmem(bytes, size, "variants", 8))
        read_one("v", bytes, size);
    return 0;
}
