/* lights/photometry_eulumdat.c -- reads EULUMDAT (.ldt), A. Stockmar 1990: one value a line.
 *
 *     1 company  2 Ityp  3 Isym  4 Mc planes  5 Dc  6 Ng angles  7 Dg  8 report  9 name
 *     10 number  11 file  12 date  13-15 size  16-17 luminous length, width  18-21 luminous
 *     heights  22 DFF  23 LORL  24 conversion factor  25 tilt  26 n sets of lamps, each:
 *     number, type, total flux, colour, colour rendering, watts  27 ten direct ratios
 *     28 Mc angles C  29 Ng angles gamma  30 intensities, plane after plane
 *
 *     I = value * flux / 1000 * conversion factor        [cd], flux in lm of the set of lamps
 *
 * Sets of lamps are alternatives: the first is the one that counts. A negative number of lamps
 * is absolute photometry: flux is then that of the luminaire.
 */
#include "lights/photometry_parts.h"

#include <math.h>
#include <stdio.h>

enum { MOST_LAMP_SETS = 1000, DIRECT_RATIOS = 10 };

/* What is read before the angles and is needed after them. */
typedef struct ldt_header {
    int symmetry, planes, gammas;
    double plane_step, gamma_step; /* deg; 0: not even */
    double factor;                 /* what makes candelas of values */
} ldt_header;

static bool read_words(scanner *c, const char *what, const char **out, lux_error *err)
{
    scanned_line l;
    scanner start = *c;
    if (!scan_line(c, &l))
        return scan_wrong(&start, what, err);
    *out = scan_words(c, l.text, l.length);
    return true;
}

/* A length in mm, made metres; blank and negative ones are 0. */
static bool read_length(scanner *c, const char *what, float *out, lux_error *err)
{
    double mm;
    int line      = c->line;
    scanner start = *c;
    if (!scan_line_number(c, what, true, &mm, err))
        return false;
    if (!(mm <= 1e7))
        return scan_wrong(&start, "a length up to 10 km", err);
    if (mm < 0.0)
        notice_add(c->n, "%s:%d: %g mm: taken as 0", c->path, line, mm);
    *out = (float)(fmax(mm, 0.0) / 1000.0);
    return true;
}

/* Lines 1 to 12. */
static bool read_front(photometry *p, scanner *c, ldt_header *h, lux_error *err)
{
    int kind;
    const char *file;
    return read_words(c, "line 1, the company", &p->manufacturer, err) &&
           scan_line_count(c, "line 2, the type of luminaire", 0, 3, &kind, err) &&
           scan_line_count(c, "line 3, the symmetry", 0, 4, &h->symmetry, err) &&
           scan_line_count(c, "line 4, the number of C planes", 1, MOST_ANGLES, &h->planes, err) &&
           scan_line_number(c, "line 5, the step of planes", true, &h->plane_step, err) &&
           scan_line_count(c, "line 6, the number of angles", 1, MOST_ANGLES, &h->gammas, err) &&
           scan_line_number(c, "line 7, the step of angles", true, &h->gamma_step, err) &&
           read_words(c, "line 8, the report", &p->report, err) &&
           read_words(c, "line 9, the luminaire's name", &p->name, err) &&
           read_words(c, "line 10, the luminaire's number", &p->catalog, err) &&
           read_words(c, "line 11, the file's name", &file, err) &&
           read_words(c, "line 12, the date", &p->date, err);
}

/* Lines 13 to 21: of the luminaire itself, nothing is kept. */
static bool read_sizes(photometry *p, scanner *c, lux_error *err)
{
    float size, height[4];
    for (int i = 0; i < 3; i++)
        if (!read_length(c, "a size of the luminaire", &size, err))
            return false;
    if (!read_length(c, "the luminous length", &p->length, err) ||
        !read_length(c, "the luminous width", &p->width, err))
        return false;
    int line    = c->line;
    bool uneven = false;
    for (int i = 0; i < 4; i++)
        if (!read_length(c, "a luminous height", &height[i], err))
            return false;

    bool round = p->length > 0.0f && p->width == 0.0f;
    p->height  = fmaxf(fmaxf(height[0], height[1]), fmaxf(height[2], height[3]));
    p->width   = round ? p->length : p->width;
    if (p->width == 0.0f)
        p->opening = p->height > 0.0f ? OPENING_LINE : OPENING_POINT;
    else if (p->length == 0.0f)
        p->opening = p->height > 0.0f ? OPENING_BOX : OPENING_LINE;
    else if (round)
        p->opening = p->height > 0.0f ? OPENING_VERTICAL_CYLINDER : OPENING_DISC;
    else
        p->opening = p->height > 0.0f ? OPENING_BOX : OPENING_RECTANGLE;
    p->length_along_deg = 90.0f;
    for (int i = 0; i < 4; i++) {
        p->side_height[i] = height[i];
        uneven            = uneven || height[i] != p->height;
    }
    if (uneven)
        notice_add(c->n,
                   "%s:%d: luminous heights of %g, %g, %g, %g mm toward C0, C90, C180, C270: the "
                   "light is spread over a %s of the greatest",
                   c->path, line, 1e3 * (double)height[0], 1e3 * (double)height[1],
                   1e3 * (double)height[2], 1e3 * (double)height[3],
                   opening_shape_name(p->opening));
    return true;
}

/* Lines 22 to 26. */
static bool read_ratios(photometry *p, scanner *c, ldt_header *h, int *sets, lux_error *err)
{
    double downward, output, tilt;
    if (!scan_line_number(c, "line 22, the downward flux fraction", true, &downward, err) ||
        !scan_line_number(c, "line 23, the light output ratio", true, &output, err))
        return false;
    p->stated_lor = fmax(output / 100.0, 0.0);

    scanner start = *c;
    if (!scan_line_number(c, "line 24, the conversion factor", true, &h->factor, err))
        return false;
    if (!(h->factor >= 0.0))
        return scan_wrong(&start, "line 24, a conversion factor > 0", err);
    if (h->factor == 0.0) {
        notice_add(c->n, "%s:%d: the conversion factor is 0: taken as 1", c->path, start.line);
        h->factor = 1.0;
    }
    if (!scan_line_number(c, "line 25, the tilt of measurement", true, &tilt, err))
        return false;
    if (tilt != 0.0)
        notice_add(c->n, "%s:%d: measured with a tilt of %g deg: the light is taken as it stands",
                   c->path, c->line - 1, tilt);
    return scan_line_count(c, "line 26, the number of sets of lamps", 1, MOST_LAMP_SETS, sets, err);
}

typedef struct lamp_set {
    double lamps, flux, watts;
    const char *type;
    scanner flux_place;
} lamp_set;

static bool read_lamp_set(scanner *c, lamp_set *s, lux_error *err)
{
    const char *words;
    if (!scan_line_number(c, "the number of lamps", true, &s->lamps, err) ||
        !read_words(c, "the type of lamps", &s->type, err))
        return false;
    s->flux_place = *c;
    return scan_line_number(c, "the flux of the lamps", true, &s->flux, err) &&
           read_words(c, "the colour appearance", &words, err) &&
           read_words(c, "the colour rendering", &words, err) &&
           scan_line_number(c, "the watts of the lamps", true, &s->watts, err);
}

static bool read_lamps(photometry *p, scanner *c, ldt_header *h, int sets, lux_error *err)
{
    lamp_set first, other;
    int line = c->line;
    if (!read_lamp_set(c, &first, err))
        return false;
    for (int i = 1; i < sets; i++)
        if (!read_lamp_set(c, &other, err))
            return false;
    if (sets > 1)
        notice_add(c->n, "%s:%d: %d sets of lamps: the first is taken (%s, %g lm)", c->path, line,
                   sets, first.type, first.flux);
    if (!(first.flux > 0.0))
        return scan_wrong(&first.flux_place,
                          "a flux of the lamps > 0: intensities are given per 1000 lm", err);
    if (first.watts < 0.0)
        notice_add(c->n, "%s:%d: %g W: taken as not known", c->path, line + 5, first.watts);

    p->absolute      = first.lamps < 0.0;
    p->lamp_lumens   = p->absolute ? 0.0 : first.flux;
    p->stated_lumens = p->absolute ? first.flux : 0.0;
    p->watts         = fmax(first.watts, 0.0);
    p->lamp          = first.type;
    h->factor *= first.flux / 1000.0;

    double ratio;
    for (int i = 0; i < DIRECT_RATIOS; i++)
        if (!scan_line_number(c, "a direct ratio", true, &ratio, err))
            return false;
    return true;
}

/* ---- the web ---------------------------------------------------------------------------- */

/* count angles within 0..most, ascending; with one step down allowed where `wraps`. */
static bool read_angles(scanner *c, const char *what, double *out, int count, double most,
                        bool wraps, lux_error *err)
{
    for (int i = 0; i < count; i++) {
        char expected[128];
        scanner start;
        snprintf(expected, sizeof expected, "%s %d of %d, 0 to %g deg", what, i + 1, count, most);
        if (!scan_value(c, expected, &start, &out[i], err))
            return false;
        if (!(out[i] >= 0.0 && out[i] <= most))
            return scan_wrong(&start, expected, err);
        if (i == 0 || out[i] > out[i - 1])
            continue;
        if (!wraps) {
            snprintf(expected, sizeof expected, "%s %d of %d, larger than the one before (%g)",
                     what, i + 1, count, out[i - 1]);
            return scan_wrong(&start, expected, err);
        }
        wraps = false;
    }
    return true;
}

static bool near(double a, double b) { return fabs(a - b) < 0.01; }

static int stored_count(const ldt_header *h)
{
    int mc = h->planes;
    return h->symmetry == 0   ? mc
           : h->symmetry == 1 ? 1
           : h->symmetry == 4 ? mc / 4 + 1
                              : mc / 2 + 1;
}

/* The angles of the planes that are stored, of all that are listed; false where these are not
 * those of the symmetry. Stockmar numbers them from C0 up; symmetric about C90-C270, from C270 by
 * way of C0 to C90. Writers that begin at C90 list the angles so. */
static bool list_stored(const ldt_header *h, const double *listed, int count, double *stored)
{
    int mc = h->planes, first = 0;
    double from = 0.0, to = h->symmetry == 2 ? 180.0 : 90.0;
    if (h->symmetry == 3) {
        first = near(listed[0], 0.0) ? 3 * mc / 4 : 0;
        from  = near(listed[first], 90.0) ? 90.0 : 270.0;
        to    = 360.0 - from;
    }
    for (int i = 0; i < count; i++)
        stored[i] = listed[(first + i) % mc];
    return h->symmetry < 2 || mc == 1 || (near(stored[0], from) && near(stored[count - 1], to));
}

static void check_step(scanner *c, const char *what, int line, const double *at, int count,
                       double step)
{
    if (count > 1 && step > 0.0 && !near(at[1] - at[0], step))
        notice_add(c->n, "%s:%d: %s are %g deg apart where the header says %g: the angles count",
                   c->path, line, what, at[1] - at[0], step);
}

static bool read_intensities(scanner *c, stored_web *w, double factor, lux_error *err)
{
    int negative = 0, line = c->line + 1;
    size_t count = (size_t)w->plane_count * (size_t)w->gamma_count;
    for (size_t i = 0; i < count; i++) {
        char expected[96];
        double value;
        snprintf(expected, sizeof expected, "intensity %zu of %zu", i + 1, count);
        scanner start;
        if (!scan_value(c, expected, &start, &value, err))
            return false;
        if (!web_candela(value, factor, &w->candela[i], &negative))
            return scan_wrong(&start, "an intensity below 1e30 cd", err);
    }
    if (negative > 0)
        notice_add(c->n, "%s:%d: %d negative intensities: taken as 0", c->path, line, negative);
    if (scan_left(c))
        notice_add(c->n, "%s:%d: text behind the last intensity: ignored", c->path, c->line);
    return true;
}

static bool read_web(photometry *p, scanner *c, const ldt_header *h, lux_error *err)
{
    stored_web w;
    double *listed = arena_array(c->a, double, (size_t)h->planes, err);
    if (!listed || !stored_web_of_text(&w, stored_count(h), h->gammas, c, err))
        return false;
    w.plane_line = c->line, w.plane_column = 1;
    if (!read_angles(c, "C plane", listed, h->planes, 360.0, h->symmetry == 3, err))
        return false;
    w.gamma_line = c->line + 1; /* the cursor is behind the last plane */
    if (!list_stored(h, listed, w.plane_count, w.plane))
        return failed(err, ERR_FORMAT,
                      "%s:%d:1: found C planes from %g to %g for symmetry %d, expected "
                      "%s",
                      c->path, w.plane_line, w.plane[0], w.plane[w.plane_count - 1], h->symmetry,
                      h->symmetry == 2   ? "0 to 180"
                      : h->symmetry == 3 ? "270 to 90"
                                         : "0 to 90");
    if (!read_angles(c, "angle gamma", w.gamma, h->gammas, 180.0, false, err) ||
        !read_intensities(c, &w, h->factor, err))
        return false;
    check_step(c, "C planes", w.plane_line, listed, h->planes, h->plane_step);
    check_step(c, "angles gamma", w.gamma_line, w.gamma, h->gammas, h->gamma_step);

    static const photometry_symmetry symmetries[] = { SYMMETRY_NONE, SYMMETRY_ROTATIONAL,
                                                      SYMMETRY_C0, SYMMETRY_C90,
                                                      SYMMETRY_QUADRANT };
    p->symmetry                                   = symmetries[h->symmetry];
    if (h->symmetry != 1 && w.plane_count == 1) {
        notice_add(c->n, "%s:3: one C plane with symmetry %d: taken as rotationally symmetric",
                   c->path, h->symmetry);
        p->symmetry = SYMMETRY_ROTATIONAL;
    }
    return web_unfold(p, &w, c, err);
}

bool photometry_read_eulumdat(photometry *p, scanner *c, lux_error *err)
{
    ldt_header h = { 0 };
    int sets;
    p->format = PHOTOMETRY_EULUMDAT;
    p->type   = 'C';
    return read_front(p, c, &h, err) && read_sizes(p, c, err) &&
           read_ratios(p, c, &h, &sets, err) && read_lamps(p, c, &h, sets, err) &&
           read_web(p, c, &h, err);
}
