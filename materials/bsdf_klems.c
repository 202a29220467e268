/* materials/bsdf_klems.c -- Klems' bases of directions, and matrices over them.
 *
 *     projected solid angle of a cell = pi / count (cos^2 theta_low - cos^2 theta_high)   [sr]
 *     cell of azimuth phi             = floor(count phi / (2 pi) + 1/2) mod count
 *
 * Klems, "A new method for predicting the solar heat gain of complex fenestration systems", ASHRAE
 * Transactions 100(1) 1994; the rings are those of LBNL WINDOW.
 */
#include "materials/bsdf_parts.h"

#include "core/text.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#define PI 3.14159265358979323846

bool klems_known(const char *name, klems *out)
{
    static const klems_ring full[] = { { 0, 5, 1 },    { 5, 15, 8 },   { 15, 25, 16 },
                                       { 25, 35, 20 }, { 35, 45, 24 }, { 45, 55, 24 },
                                       { 55, 65, 24 }, { 65, 75, 16 }, { 75, 90, 12 } };
    static const klems_ring half[] = { { 0, 6.5, 1 },      { 6.5, 19.5, 8 },   { 19.5, 32.5, 12 },
                                       { 32.5, 46.5, 16 }, { 46.5, 61.5, 20 }, { 61.5, 76.5, 12 },
                                       { 76.5, 90, 4 } };
    static const klems_ring quarter[] = {
        { 0, 9, 1 }, { 9, 27, 8 }, { 27, 46, 12 }, { 46, 66, 12 }, { 66, 90, 8 }
    };
    static const struct {
        const char *name;
        const klems_ring *ring;
        int rings;
    } known[] = { { "LBNL/Klems Full", full, 9 },
                  { "LBNL/Klems Half", half, 7 },
                  { "LBNL/Klems Quarter", quarter, 5 } };
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strcasecmp(name, known[i].name) == 0)
            return !klems_make(out, known[i].name, known[i].ring, known[i].rings);
    return false;
}

const char *klems_make(klems *k, const char *name, const klems_ring *ring, int rings)
{
    enum { CLOSE = 1000 }; /* angles may be written to a thousandth of a degree */
    if (rings < 1 || rings > KLEMS_RINGS)
        return "not 1 to 48 rings of polar angles";
    *k       = (klems){ .rings = rings };
    double z = 1.0;
    for (int i = 0; i < rings; i++) {
        double before = i > 0 ? ring[i - 1].high_deg : 0.0;
        bool last     = i == rings - 1;
        if (!(fabs(ring[i].low_deg - before) < 1.0 / CLOSE))
            return "polar angles that do not begin where the ring before ends";
        if (!(ring[i].high_deg > before + 1.0 / CLOSE) || !(ring[i].high_deg < 90.0 + 1.0 / CLOSE))
            return "polar angles that do not ascend to 90";
        if (last && !(ring[i].high_deg > 90.0 - 1.0 / CLOSE))
            return "polar angles that do not ascend to 90";
        if (ring[i].count < 1 || ring[i].count > KLEMS_CELLS - k->cells)
            return "numbers of azimuths that are not 1 to 2000 in all";
        double high      = last ? 0.0 : cos(ring[i].high_deg * PI / 180.0);
        k->cosine[i]     = (float)z;
        k->cosine[i + 1] = (float)high;
        k->count[i]      = (float)ring[i].count;
        k->first[i]      = k->cells;
        k->area[i]       = (float)(PI / ring[i].count * (z * z - high * high));
        k->cells += ring[i].count;
        z = high;
    }
    snprintf(k->name, sizeof k->name, "%s", name);
    return NULL;
}

vint vklems_cell(const klems *k, vfloat x, vfloat y, vfloat z)
{
    vint ring = vsplat_int(0);
    for (int i = 1; i < k->rings; i++)
        ring = vselect_int(z <= k->cosine[i], vsplat_int(i), ring);
    vfloat count = vgather(k->count, ring);
    vfloat turn  = vatan2(y, x) * (float)(0.5 / PI);
    turn         = vselect(turn < 0.0f, turn + 1.0f, turn);
    vfloat place = vfloor(turn * count + 0.5f);
    place        = vmax(vselect(place >= count, vsplat(0.0f), place), vsplat(0.0f));
    return vgather_int(k->first, ring) + vto_int(place);
}

static vint ring_of(const klems *k, vint cell)
{
    vint ring = vsplat_int(0);
    for (int i = 1; i < k->rings; i++)
        ring = vselect_int(cell >= k->first[i], vsplat_int(i), ring);
    return ring;
}

vvec3 vklems_direction(const klems *k, vint cell, vfloat u, vfloat v)
{
    /* Even in cos^2 theta and in azimuth */
    vint ring   = ring_of(k, cell);
    vfloat low  = vgather(k->cosine, ring);
    vfloat high = vgather(k->cosine, ring + 1);
    vfloat zz   = vlerp(low * low, high * high, v);
    vfloat nth  = vto_float(cell - vgather_int(k->first, ring));
    vfloat phi  = (nth - 0.5f + u) / vgather(k->count, ring) * (float)(2.0 * PI);
    vfloat r    = vsqrt(1.0f - zz);
    return (vvec3){ r * vcos(phi), r * vsin(phi), vsqrt(zz) };
}

vfloat vklems_area(const klems *k, vint cell) { return vgather(k->area, ring_of(k, cell)); }

static bool space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

bool bsdf_number(const char **text, const char *path, int *line, float *out, lux_error *err)
{
    const char *s = *text;
    double number;
    for (; space(*s); s++)
        *line += *s == '\n';
    if (!text_number(s, &s, &number) || !(*s == '\0' || space(*s) || *s == ',' || *s == '}'))
        return failed(err, ERR_FORMAT, "%s:%d: ScatteringData: no number where one is wanted", path,
                      *line);
    if (!(number >= 0.0 && number <= 1e6))
        return failed(err, ERR_FORMAT, "%s:%d: ScatteringData: %g is not in [0, 1e6] 1/sr", path,
                      *line, number);
    for (; space(*s); s++)
        *line += *s == '\n';
    s += *s == ',';
    for (; space(*s); s++)
        *line += *s == '\n';
    *text = s;
    *out  = (float)number;
    return true;
}

float *klems_parse(arena *a, const klems *k, const bsdf_file *f, const bsdf_block *b,
                   lux_error *err)
{
    const int n  = k->cells;
    float *value = arena_array(a, float, (size_t)n *(size_t)n, err);
    if (!value)
        return NULL;
    const char *s = b->text;
    int line      = b->text_line;
    for (int i = 0; i < n * n; i++) {
        int row = i / n, column = i % n;
        if (!bsdf_number(&s, f->path, &line, &value[f->in_rows ? i : column * n + row], err))
            return NULL;
    }
    if (*s)
        return failed(err, ERR_FORMAT, "%s:%d: ScatteringData: more than %d x %d numbers", f->path,
                      line, n, n);
    return value;
}
