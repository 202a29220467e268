/* tests/fuzz/fuzz_photometry.c -- any bytes as LM-63 or EULUMDAT: a web of finite light with
 * ascending angles, or refused in one line that names the file.
 *
 * The first byte says what is put before the others, so that both formats are met soon: nothing,
 * a version and TILT line, or the lines by which EULUMDAT is known.
 */
#include "lights/photometry.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size);

static void check(const photometry *p, notices *n)
{
    size_t values = (size_t)p->plane_count * (size_t)p->gamma_count;
    for (size_t i = 0; i < values; i++)
        if (!(p->candela[i] >= 0.0f && p->candela[i] < INFINITY))
            abort();
    for (int i = 0; i < p->plane_count; i++)
        if (!(p->plane_deg[i] >= 0.0f && p->plane_deg[i] < 360.0f) ||
            (i > 0 && !(p->plane_deg[i] > p->plane_deg[i - 1])))
            abort();
    for (int i = 0; i < p->gamma_count; i++)
        if (!(p->gamma_deg[i] >= 0.0f && p->gamma_deg[i] <= 180.0f) ||
            (i > 0 && !(p->gamma_deg[i] > p->gamma_deg[i - 1])))
            abort();
    if (!(p->length >= 0.0f && p->width >= 0.0f && p->height >= 0.0f && p->length < 2e4f))
        abort();
    photometry_figures f = photometry_figure(p, "no/p", n);
    double tilted        = photometry_tilt_factor(p, 33.0);
    if (!(p->luminaire_lumens >= 0.0 && p->luminaire_lumens < HUGE_VAL) ||
        !(f.beam_deg[0] >= 0.0 && f.field_deg[1] <= 360.0) || !(tilted >= 0.0 && tilted < HUGE_VAL))
        abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    static const char *const fronts[] = { "", "IESNA:LM-63-1995\nTILT=NONE\n",
                                          "IES:LM-63-2019\nTILT=INCLUDE\n", "a\n1\n" };
    if (size == 0)
        return 0;
    const char *front = fronts[bytes[0] % 4];
    size_t before     = strlen(front);
    char *text        = calloc(before + size, 1); /* ends in a NUL, not one byte beyond it */
    if (!text)
        return 0;
    memcpy(text, front, before);
    memcpy(text + before, bytes + 1, size - 1);

    arena memory        = { 0 };
    notices n           = { .a = &memory };
    lux_error err       = { 0 };
    const photometry *p = photometry_parse(&memory, "no/p", text, before + size - 1, &n, &err);
    if (!p && err.code != ERR_MEMORY &&
        (strncmp(err.text, "no/p:", 5) != 0 || strpbrk(err.text, "\n\r\x1b")))
        abort();
    for (const notice *w = n.first; w; w = w->next)
        if (strpbrk(w->text, "\n\r\x1b"))
            abort();
    if (p)
        check(p, &n);
    free(text);
    arena_clear(&memory);
    return 0;
}
