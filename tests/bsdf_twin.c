/* tests/bsdf_twin.c -- see bsdf_twin.h. */
#include "tests/bsdf_twin.h"

#include "tests/folder.h"
#include "tests/test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double pi = 3.14159265358979324;

static const double full_edge[]    = { 0, 5, 15, 25, 35, 45, 55, 65, 75, 90 };
static const int full_count[]      = { 1, 8, 16, 20, 24, 24, 24, 16, 12 };
static const double half_edge[]    = { 0, 6.5, 19.5, 32.5, 46.5, 61.5, 76.5, 90 };
static const int half_count[]      = { 1, 8, 12, 16, 20, 12, 4 };
static const double quarter_edge[] = { 0, 9, 27, 46, 66, 90 };
static const int quarter_count[]   = { 1, 8, 12, 12, 8 };

const twin_basis twin_full    = { "LBNL/Klems Full", 9, 145, full_edge, full_count };
const twin_basis twin_half    = { "LBNL/Klems Half", 7, 73, half_edge, half_count };
const twin_basis twin_quarter = { "LBNL/Klems Quarter", 5, 41, quarter_edge, quarter_count };

const char *const twin_names[4] = { "Transmission Front", "Transmission Back", "Reflection Front",
                                    "Reflection Back" };

static int ring_of(const twin_basis *b, int *cell)
{
    int ring = 0;
    for (; *cell >= b->count[ring]; ring++)
        *cell -= b->count[ring];
    return ring;
}

double twin_area(const twin_basis *b, int cell)
{
    int ring   = ring_of(b, &cell);
    double low = cos(b->edge[ring] * pi / 180), high = cos(b->edge[ring + 1] * pi / 180);
    return pi / b->count[ring] * (low * low - high * high);
}

static double turns(double x, double y)
{
    double turn = atan2(y, x) / (2 * pi);
    return turn < 0 ? turn + 1 : turn;
}

int twin_cell(const twin_basis *b, double x, double y, double z)
{
    double theta = acos(z) * 180 / pi;
    int ring = 0, first = 0;
    for (; ring < b->rings - 1 && theta >= b->edge[ring + 1]; ring++)
        first += b->count[ring];
    return first + (int)(turns(x, y) * b->count[ring] + 0.5) % b->count[ring];
}

bool twin_at_edge(const twin_basis *b, double x, double y, double z)
{
    for (int i = 0; i < b->rings; i++) {
        double place = turns(x, y) * b->count[i] + 0.5;
        if (fabs(z - cos(b->edge[i] * pi / 180)) < 1e-6 || z < 1e-4 ||
            fabs(place - floor(place + 0.5)) * hypot(x, y) < 1e-5 * b->count[i])
            return true;
    }
    return false;
}

void twin_middle(const twin_basis *b, int cell, double out[3])
{
    int ring     = ring_of(b, &cell);
    double theta = (b->edge[ring] + b->edge[ring + 1]) * pi / 360;
    double phi   = 2 * pi * cell / b->count[ring];
    theta        = ring == 0 ? 0 : theta;
    out[0]       = sin(theta) * cos(phi);
    out[1]       = sin(theta) * sin(phi);
    out[2]       = cos(theta);
}

static void head(FILE *f, const char *structure)
{
    fprintf(f,
            "<?xml version=\"1.0\"?>\n<WindowElement><Optical><Layer>\n<DataDefinition>"
            "<IncidentDataStructure>%s</IncidentDataStructure></DataDefinition>\n",
            structure);
}

static void block(FILE *f, const char *wavelength, const char *direction, const char *bases)
{
    fprintf(f,
            "<WavelengthData><Wavelength unit=\"Integral\">%s</Wavelength>\n<WavelengthDataBlock>\n"
            "<WavelengthDataDirection>%s</WavelengthDataDirection>\n%s\n"
            "<ScatteringDataType>BTDF</ScatteringDataType>\n<ScatteringData>\n",
            wavelength, direction, bases);
}

static const char tail[] = "</ScatteringData></WavelengthDataBlock></WavelengthData>\n";

char *twin_text(const twin_basis *b, unsigned parts, bool rows, twin_value *value, const void *with)
{
    char *text, bases[200];
    size_t size;
    FILE *f = open_memstream(&text, &size);
    assert_non_null(f);
    head(f, rows ? "Rows" : "Columns");
    snprintf(bases, sizeof bases,
             "<ColumnAngleBasis>%s</ColumnAngleBasis><RowAngleBasis>%s</RowAngleBasis>", b->name,
             b->name);
    block(f, "Solar", twin_names[0], bases); /* which is passed over */
    fprintf(f, "no numbers%s", tail);
    for (int part = 0; part < 4; part++) {
        if (!(parts >> part & 1))
            continue;
        block(f, "Visible", twin_names[part], bases);
        for (int i = 0; i < b->cells; i++)
            for (int j = 0; j < b->cells; j++)
                fprintf(f, "%.9g%c", rows ? value(part, i, j, with) : value(part, j, i, with),
                        j == b->cells - 1 ? '\n'
                        : part == 1       ? ','
                                          : ' ');
        fputs(tail, f);
    }
    fputs("</Layer></Optical></WindowElement>\n", f);
    fclose(f);
    return text;
}

/* ---- trees -------------------------------------------------------------------------------------
 */

static uint32_t mix(uint32_t a, uint32_t b)
{
    a = (a ^ b * 0x9e3779b9u) * 0x85ebca6bu;
    a = (a ^ a >> 13) * 0xc2b2ae35u;
    return a ^ a >> 16;
}

enum { DEEPEST = 3 };

/* What a node of this key is: -1 a branch, else the log2 of a leaf's grid */
static int kind(uint32_t key, int level)
{
    uint32_t h = mix(key, 77) % 8;
    return level < DEEPEST && (level == 0 || h < 2) ? -1 : h == 2 && level < DEEPEST ? 1 : 0;
}

static double leaf_value(uint32_t key, int place) /* 2 of 3 are 0 to 1/(4 pi), one is 0 */
{
    uint32_t h = mix(key, 1000 + (uint32_t)place);
    return h % 3 == 0 ? 0 : h / 4294967296.0 * 0.08;
}

static void write_node(FILE *f, int rank, uint32_t key, int level)
{
    int log2 = kind(key, level);
    fputs(level % 2 ? "{ " : "{\n", f);
    for (int i = 0; log2 < 0 && i < 1 << rank; i++)
        write_node(f, rank, mix(key, (uint32_t)i), level + 1);
    for (int i = 0; log2 >= 0 && i < 1 << rank * log2; i++)
        fprintf(f, "%.8e ", leaf_value(key, i));
    fputs("}\n", f);
}

static uint32_t root(int rank, int part) { return mix((uint32_t)rank, 17 + (uint32_t)part); }

char *twin_tree_text(int rank, unsigned parts)
{
    char *text;
    size_t size;
    FILE *f = open_memstream(&text, &size);
    assert_non_null(f);
    head(f, rank == 3 ? "TensorTree3" : "TensorTree4");
    for (int part = 0; part < 4; part++) {
        if (!(parts >> part & 1))
            continue;
        block(f, "Visible", twin_names[part], "<AngleBasis>LBNL/Shirley-Chiu</AngleBasis>");
        write_node(f, rank, root(rank, part), 0);
        fputs(tail, f);
    }
    fputs("</Layer></Optical></WindowElement>\n", f);
    fclose(f);
    return text;
}

double twin_tree_value(int rank, int part, const double place[4])
{
    double at[4];
    memcpy(at, place, sizeof at);
    uint32_t key = root(rank, part);
    for (int level = 0;; level++) {
        int log2 = kind(key, level), index = 0, child = 0;
        if (log2 >= 0) {
            for (int i = 0; i < rank; i++)
                index = (index << log2) + (int)(at[i] * (1 << log2));
            return leaf_value(key, index);
        }
        for (int i = 0; i < rank; i++) {
            int upper = at[i] >= 0.5;
            child |= upper << i;
            at[i] = 2 * at[i] - upper;
        }
        key = mix(key, (uint32_t)child);
    }
}

const bsdf *twin_read(arena *a, const char *text, notices *n, lux_error *err)
{
    char path[300], *folder = folder_new();
    folder_write(folder, "a.xml", text);
    snprintf(path, sizeof path, "%s/a.xml", folder);
    const bsdf *b = bsdf_read(a, path, n, err);
    if (!b && err && strncmp(err->text, path, strlen(path)) == 0) /* not where the folder is */
        memmove(err->text, err->text + strlen(path) - 5, strlen(err->text) - strlen(path) + 6);
    folder_free(folder);
    return b;
}
