/* tests/fuzz/fuzz_probes.c -- any bytes as a table of probes: unit normals, or refused. */
#include "sim/probes.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    char *text = calloc(size + 1, 1);
    if (!text)
        return 0;
    memcpy(text, bytes, size);

    arena memory  = { 0 };
    lux_error err = { 0 };
    probes p      = { 0 };
    bool good     = probes_parse(&memory, "p.csv", text, &p, &err);
    if (!good && (strncmp(err.text, "p.csv:", 6) != 0 || strpbrk(err.text, "\n\r\x1b")))
        abort();
    for (int i = 0; good && i < p.count; i++)
        if (!(fabs(d3_length(p.normal[i]) - 1.0) < 1e-12) || !d3_finite(p.position[i]))
            abort();
    free(text);
    arena_clear(&memory);
    return 0;
}
