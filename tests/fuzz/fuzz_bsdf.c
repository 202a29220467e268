/* tests/fuzz/fuzz_bsdf.c -- any bytes as a BSDF: figures of a layer that keeps energy, or refused
 * in one line that names the file and a line of it.
 *
 * The first byte says what the others are: a whole file, the numbers of a small matrix, or a tree.
 */
#include "materials/bsdf.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size);

static const char *const fronts[4] = {
    "",
    "<w><IncidentDataStructure>Columns</IncidentDataStructure><AngleBasis><AngleBasisName>a"
    "</AngleBasisName><AngleBasisBlock><nPhis>2</nPhis><UpperTheta>90</UpperTheta>"
    "</AngleBasisBlock></AngleBasis><WavelengthData><Wavelength>Visible</Wavelength>"
    "<WavelengthDataBlock><WavelengthDataDirection>Transmission Front</WavelengthDataDirection>"
    "<ColumnAngleBasis>a</ColumnAngleBasis><RowAngleBasis>a</RowAngleBasis><ScatteringData>",
    "<w><IncidentDataStructure>TensorTree3</IncidentDataStructure><WavelengthData><Wavelength>"
    "Visible</Wavelength><WavelengthDataBlock><WavelengthDataDirection>Transmission Front"
    "</WavelengthDataDirection><AngleBasis>LBNL/Shirley-Chiu</AngleBasis><ScatteringData>",
    "<w><IncidentDataStructure>TensorTree4</IncidentDataStructure><WavelengthData><Wavelength>"
    "Visible</Wavelength><WavelengthDataBlock><WavelengthDataDirection>Reflection Back"
    "</WavelengthDataDirection><AngleBasis>LBNL/Shirley-Chiu</AngleBasis><ScatteringData>",
};
static const char back[] = "</ScatteringData></WavelengthDataBlock></WavelengthData></w>";

static void check(const bsdf *b)
{
    const bsdf_figures *f = bsdf_figure(b);
    for (int side = 0; side < 2; side++) {
        double all  = f->reflectance[side] + f->transmittance[side];
        double fore = f->normal_reflectance[side] + f->normal_transmittance[side];
        if (!(all >= 0.0 && all <= 1.0 + 1e-5) || !(fore >= 0.0 && fore <= 1.0 + 1e-5))
            abort();
    }
    if (!(f->scale > 0.0 && f->scale <= 1.0) || !(f->reciprocity >= 0.0 && f->reciprocity <= 2.01))
        abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    if (size == 0)
        return 0;
    const int kind = bytes[0] % 4;
    size_t before = strlen(fronts[kind]), behind = kind ? sizeof back - 1 : 0;
    char *text = malloc(before + size + behind);
    if (!text)
        return 0;
    memcpy(text, fronts[kind], before);
    memcpy(text + before, bytes + 1, size - 1);
    memcpy(text + before + size - 1, back, behind);

    arena memory  = { 0 };
    notices n     = { .a = &memory };
    lux_error err = { 0 };
    const bsdf *b = bsdf_parse(&memory, "no/b", text, before + size - 1 + behind, &n, &err);
    if (!b && err.code != ERR_MEMORY &&
        (strncmp(err.text, "no/b:", 5) != 0 || strpbrk(err.text, "\n\r\x1b")))
        abort();
    for (const notice *w = n.first; w; w = w->next)
        if (strpbrk(w->text, "\n\r\x1b"))
            abort();
    if (b)
        check(b);
    free(text);
    arena_clear(&memory);
    return 0;
}
