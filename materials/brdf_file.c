/* materials/brdf_file.c -- our own tables of reflection, .brdf: text that people can write.
 *
 *     lux4 brdf 1                          the first line
 *     # car paint, measured 2026-03-01     from # to the end of the line: a comment
 *     parameters isotropic                 or anisotropic, or half
 *     bands R G B                          or one of any name (grey), or wavelengths: 450 550 650
 *     unit 1/sr                            what the values are in; there is no other
 *     theta_in 0 15 30 45 60 75 85         places along each axis, in degrees, ascending and as
 *     theta_out 0 10 20 30 40 50 60        uneven as you like, over as many lines as they take
 *       70 80 85 90
 *     delta_phi 0 5 10 20 40 90 180
 *     values                               the last: f, the bands of a place side by side; the last
 *     0.12 0.10 0.09                       axis is the fastest; lines are broken anywhere;
 *     ...                                  below 0: not measured, taken from the neighbours
 *
 * Axes, in the order of the values (see brdf.h for their ranges):
 *
 *     isotropic     theta_in theta_out delta_phi
 *     anisotropic   theta_in phi_in theta_out phi_out
 *     half          theta_h theta_d phi_d
 *
 * "In" is where light comes from, "out" where it goes, both away from the surface. `bands` and
 * `unit` may be left out: grey, 1/sr. Wavelengths become RGB as brdf_bands.c says.
 */
#include "core/text.h"
#include "materials/brdf_bands.h"
#include "materials/brdf_parts.h"

#include <stdio.h>
#include <string.h>

enum { MOST_BANDS = 64, LONGEST_WORD = 32 };

/* Where the reader is: a word of the file. */
typedef struct reader {
    const char *path, *at, *end;
    int line;
    arena *scratch;
    lux_error *err;
} reader;

typedef struct header {
    int kind; /* -1: not yet known */
    int bands, counts[4];
    double weights[MOST_BANDS][3];
    double *deg[4];
} header;

static const char *const kind_names[]    = { "isotropic", "anisotropic", "half" };
static const char *const axis_names[][4] = { { "theta_in", "theta_out", "delta_phi" },
                                             { "theta_in", "phi_in", "theta_out", "phi_out" },
                                             { "theta_h", "theta_d", "phi_d" } };
static const int kind_axes[]             = { 3, 4, 3 };

/* ---- words ----------------------------------------------------------------------------------- */

/* To the next word; false at the end. Comments and line ends lie between words; `here` stops at the
 * end of the line. */
static bool next_word(reader *r, bool here)
{
    while (r->at < r->end) {
        char c = *r->at;
        if (c == '#') {
            while (r->at < r->end && *r->at != '\n')
                r->at++;
        } else if (c == '\n') {
            if (here)
                return false;
            r->line++;
            r->at++;
        } else if (c == ' ' || c == '\t' || c == '\r') {
            r->at++;
        } else {
            return true;
        }
    }
    return false;
}

static size_t word_length(const reader *r)
{
    size_t n = 0;
    while (r->at + n < r->end && !strchr(" \t\r\n#", r->at[n])) /* finds NUL, too */
        n++;
    return n;
}

static bool take_word(reader *r, const char *word)
{
    size_t n = strlen(word);
    if (word_length(r) != n || memcmp(r->at, word, n))
        return false;
    r->at += n;
    return true;
}

static bool take_number(reader *r, double *out)
{
    const char *last;
    if (!text_number(r->at, &last, out) || last != r->at + word_length(r))
        return false;
    r->at = last;
    return true;
}

static void *wrong(const reader *r, const char *expected)
{
    char shown[LONGEST_WORD + 1] = { 0 };
    size_t n                     = r->at < r->end ? word_length(r) : 0;
    for (size_t i = 0; i < n && i < LONGEST_WORD; i++)
        shown[i] = r->at[i] < ' ' || r->at[i] > '~' ? '?' : r->at[i];
    if (r->at == r->end)
        return failed(r->err, ERR_FORMAT, "%s:%d: found the end of the file, expected %s", r->path,
                      r->line, expected);
    if (n == 0)
        return failed(r->err, ERR_FORMAT, "%s:%d: found nothing, expected %s", r->path, r->line,
                      expected);
    return failed(r->err, ERR_FORMAT, "%s:%d: found '%s', expected %s", r->path, r->line, shown,
                  expected);
}

/* ---- the header ------------------------------------------------------------------------------ */

static bool read_kind(reader *r, header *h)
{
    next_word(r, true);
    if (h->kind >= 0)
        return wrong(r, "parameters named once");
    for (int i = 0; i < 3; i++)
        if (take_word(r, kind_names[i])) {
            h->kind = i;
            return true;
        }
    return wrong(r, "isotropic, anisotropic or half");
}

/* Names or wavelengths to the end of the line. */
static bool read_bands(reader *r, header *h)
{
    static const char names[3][2] = { "R", "G", "B" };
    double nm[MOST_BANDS];
    int count = 0, named = 0, waves = 0;
    for (; next_word(r, true); count++) {
        if (count == MOST_BANDS)
            return wrong(r, "at most 64 bands");
        if (count < 3 && named == count && take_word(r, names[count])) {
            named++;
        } else if (take_number(r, &nm[count])) {
            if (!(nm[count] > (waves ? nm[count - 1] : 0.0) && nm[count] <= 1e5))
                return failed(r->err, ERR_FORMAT,
                              "%s:%d: found a wavelength of %g, expected ascending nanometres",
                              r->path, r->line, nm[count]);
            waves++;
        } else if (count == 0) {
            r->at += word_length(r); /* one of any name */
        } else {
            return wrong(r, "R G B, one name alone, or wavelengths in nanometres");
        }
    }
    if (count == 0 || (count > 1 && named != count && waves != count) || (named > 1 && count != 3))
        return wrong(r, "R G B, one name alone, or wavelengths in nanometres");

    h->bands = count;
    if (count == named && count == 3)
        for (int i = 0; i < 9; i++)
            h->weights[i / 3][i % 3] = i / 3 == i % 3;
    else if (count > 1)
        bands_to_rgb(nm, count, h->weights);
    else
        h->weights[0][0] = h->weights[0][1] = h->weights[0][2] = 1.0;
    return true;
}

static bool read_axis(reader *r, header *h, int axis)
{
    if (h->counts[axis])
        return failed(r->err, ERR_FORMAT, "%s:%d: found %s a second time", r->path, r->line,
                      axis_names[h->kind][axis]);
    int room = 0, line = r->line;
    double value = 0.0, *at = NULL;
    while (next_word(r, false) && take_number(r, &value)) {
        int count = h->counts[axis];
        if (count == BRDF_MOST_AXIS)
            return failed(r->err, ERR_FORMAT,
                          "%s:%d: found more than %d places on an axis, finer than any data",
                          r->path, r->line, BRDF_MOST_AXIS);
        if (count == room) {
            room         = room ? 2 * room : 64;
            double *more = arena_array(r->scratch, double, (size_t)room, r->err);
            if (!more)
                return false;
            if (count)
                memcpy(more, at, (size_t)count * sizeof *at);
            at = more;
        }
        at[h->counts[axis]++] = value;
    }
    h->deg[axis] = at;
    if (h->counts[axis] == 0)
        return wrong(r, "places in degrees");
    char where[400];
    snprintf(where, sizeof where, "%s:%d", r->path, line);
    return brdf_check_places(where, (brdf_kind)h->kind, axis, at, h->counts[axis], r->err);
}

/* One keyword and what belongs to it, but `values`. */
static bool read_keyword(reader *r, header *h)
{
    if (take_word(r, "parameters"))
        return read_kind(r, h);
    if (take_word(r, "bands"))
        return read_bands(r, h);
    if (take_word(r, "unit")) {
        next_word(r, true);
        return take_word(r, "1/sr") || wrong(r, "1/sr");
    }
    for (int i = 0; h->kind >= 0 && i < kind_axes[h->kind]; i++)
        if (take_word(r, axis_names[h->kind][i]))
            return read_axis(r, h, i);
    return wrong(r, h->kind < 0 ? "parameters, bands or unit"
                                : "bands, unit, values or an axis of these parameters");
}

static bool read_header(reader *r, header *h)
{
    static const char *const first[] = { "lux4", "brdf", "1" };
    for (int i = 0; i < 3; i++)
        if (!next_word(r, true) || !take_word(r, first[i]))
            return wrong(r, "'lux4 brdf 1'");
    while (next_word(r, false) && !take_word(r, "values"))
        if (!read_keyword(r, h))
            return false;
    if (r->at == r->end)
        return wrong(r, "values");
    if (h->kind < 0)
        return failed(r->err, ERR_FORMAT, "%s:%d: found values, expected parameters before them",
                      r->path, r->line);
    for (int i = 0; i < kind_axes[h->kind]; i++)
        if (!h->counts[i])
            return failed(r->err, ERR_FORMAT, "%s:%d: found values, expected %s before them",
                          r->path, r->line, axis_names[h->kind][i]);
    return true;
}

/* ---- values ---------------------------------------------------------------------------------- */

/* One place: its bands as RGB; below 0 where any of them is. */
static bool read_place(reader *r, const header *h, float rgb[3])
{
    double sum[3] = { 0 };
    bool missing  = false;
    for (int i = 0; i < h->bands; i++) {
        double value     = 0.0;
        bool more        = next_word(r, false);
        const char *word = r->at;
        if (!more || !take_number(r, &value) || value > 1e30) {
            r->at = word;
            return wrong(r, "a value in 1/sr, below 1e30");
        }
        missing = missing || value < 0.0;
        for (int c = 0; c < 3; c++)
            sum[c] += h->weights[i][c] * value;
    }
    for (int c = 0; c < 3; c++)
        rgb[c] = missing ? -1.0f : (float)(sum[c] > 0.0 ? sum[c] : 0.0);
    return true;
}

static float *read_values(reader *r, const header *h)
{
    int64_t places = 1, most = BRDF_MOST_PLACES;
    for (int i = 0; i < kind_axes[h->kind]; i++) {
        places *= h->counts[i];
        if (places > most)
            return failed(r->err, ERR_FORMAT, "%s:%d: found axes of more than %d places", r->path,
                          r->line, BRDF_MOST_PLACES);
    }
    if (places * h->bands > (r->end - r->at + 1) / 2) /* a digit and a blank, each */
        return failed(r->err, ERR_FORMAT,
                      "%s:%d: found axes of %lld places, expected no more than there are values",
                      r->path, r->line, (long long)places);
    float *rgb = arena_array(r->scratch, float, 3 * (size_t)places, r->err);
    for (int64_t i = 0; rgb && i < places; i++)
        if (!read_place(r, h, rgb + 3 * i))
            return NULL;
    if (rgb && next_word(r, false))
        return wrong(r, "the end of the file after the last value");
    return rgb;
}

const brdf *brdf_read_text(arena *a, const char *path, const char *text, size_t size, notices *n,
                           lux_error *err)
{
    arena scratch = { 0 };
    reader r      = { path, text, text + size, 1, &scratch, err };
    header h      = { .kind = -1, .bands = 1, .weights = { { 1.0, 1.0, 1.0 } } };
    const brdf *b = NULL;
    float *rgb    = read_header(&r, &h) ? read_values(&r, &h) : NULL;
    if (rgb) {
        brdf_data d = { .name = path, .kind = (brdf_kind)h.kind, .rgb = rgb, .bands = h.bands };
        for (int i = 0; i < 4; i++) {
            d.counts[i] = h.counts[i];
            d.deg[i]    = h.deg[i];
        }
        b = brdf_make(a, &d, n, err);
    }
    arena_clear(&scratch);
    return b;
}
