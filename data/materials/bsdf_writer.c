/* data/materials/bsdf_writer.c -- Klems' full basis, and files of LBNL's BSDF XML over it. */
#include "data/materials/bsdf_models.h"

#include <math.h>

static const double pi = 3.14159265358979324;

enum { RINGS = 9 };
static const double edge[RINGS + 1] = { 0, 5, 15, 25, 35, 45, 55, 65, 75, 90 }; /* deg */
static const int count[RINGS]       = { 1, 8, 16, 20, 24, 24, 24, 16, 12 };

static int ring_of(int *cell)
{
    int ring = 0;
    for (; *cell >= count[ring]; ring++)
        *cell -= count[ring];
    return ring;
}

/* cos^2 of the polar angle where a ring begins. */
static double square_of(int ring)
{
    double z = ring == RINGS ? 0.0 : cos(edge[ring] * pi / 180.0);
    return z * z;
}

double full_area(int cell)
{
    int ring = ring_of(&cell);
    return pi / count[ring] * (square_of(ring) - square_of(ring + 1));
}

void full_sample(int cell, int i, int j, double way[3])
{
    int ring    = ring_of(&cell);
    double part = (i + 0.5) / FULL_SAMPLES;
    double zz   = (1.0 - part) * square_of(ring) + part * square_of(ring + 1);
    double phi  = 2.0 * pi * (cell - 0.5 + (j + 0.5) / FULL_SAMPLES) / count[ring];
    way[0]      = sqrt(1.0 - zz) * cos(phi);
    way[1]      = sqrt(1.0 - zz) * sin(phi);
    way[2]      = sqrt(zz);
}

static void write_basis(FILE *to)
{
    fprintf(to, "<AngleBasis>\n<AngleBasisName>LBNL/Klems Full</AngleBasisName>\n");
    for (int i = 0; i < RINGS; i++)
        fprintf(to,
                "<AngleBasisBlock><Theta>%g</Theta><nPhis>%d</nPhis><ThetaBounds>"
                "<LowerTheta>%g</LowerTheta><UpperTheta>%g</UpperTheta></ThetaBounds>"
                "</AngleBasisBlock>\n",
                i == 0 ? 0.0 : 0.5 * (edge[i] + edge[i + 1]), count[i], edge[i], edge[i + 1]);
    fprintf(to, "</AngleBasis>\n");
}

/* A row for each out, a column for each in. */
static void write_block(FILE *to, const char *direction, const double (*f)[FULL_CELLS])
{
    fprintf(to,
            "<WavelengthData>\n<LayerNumber>System</LayerNumber>\n"
            "<Wavelength unit=\"Integral\">Visible</Wavelength>\n"
            "<SourceSpectrum>CIE Illuminant D65 1nm.ssp</SourceSpectrum>\n"
            "<DetectorSpectrum>ASTM E308 1931 Y.dsp</DetectorSpectrum>\n"
            "<WavelengthDataBlock>\n<WavelengthDataDirection>%s</WavelengthDataDirection>\n"
            "<ColumnAngleBasis>LBNL/Klems Full</ColumnAngleBasis>\n"
            "<RowAngleBasis>LBNL/Klems Full</RowAngleBasis>\n"
            "<ScatteringDataType>%s</ScatteringDataType>\n<ScatteringData>\n",
            direction, direction[0] == 'T' ? "BTDF" : "BRDF");
    for (int out = 0; out < FULL_CELLS; out++)
        for (int in = 0; in < FULL_CELLS; in++)
            fprintf(to, "%.*g%c", f[in][out] < 1.0 ? 3 : 5, f[in][out],
                    in == FULL_CELLS - 1 ? '\n' : ' ');
    fprintf(to, "</ScatteringData>\n</WavelengthDataBlock>\n</WavelengthData>\n");
}

bool model_write(const bsdf_model *m, FILE *to)
{
    fprintf(to,
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
            "<!-- Made by lux4's data/materials/make_bsdf.c from a model: README-bsdf.md -->\n"
            "<WindowElement xmlns=\"http://windows.lbl.gov\">\n"
            "<WindowElementType>System</WindowElementType>\n<FileType>BSDF</FileType>\n"
            "<Optical>\n<Layer>\n<Material>\n<Name>%s</Name>\n<Manufacturer>lux4</Manufacturer>\n"
            "<DeviceType>Other</DeviceType>\n</Material>\n<DataDefinition>\n"
            "<IncidentDataStructure>Columns</IncidentDataStructure>\n",
            m->name);
    write_basis(to);
    fprintf(to, "</DataDefinition>\n");
    write_block(to, "Transmission Front", m->transmission[0]);
    write_block(to, "Transmission Back", m->transmission[1]);
    write_block(to, "Reflection Front", m->reflection[0]);
    write_block(to, "Reflection Back", m->reflection[1]);
    fprintf(to, "</Layer>\n</Optical>\n</WindowElement>\n");
    return !ferror(to);
}
