/* lights/photometry_ies.c -- reads ANSI/IES LM-63 of 1986, 1991, 1995, 2002 and 2019.
 *
 *     IESNA:LM-63-2002                 version; 1986 has none
 *     [MANUFAC] Somebody               labels; 1986: any text
 *     TILT=NONE                        or INCLUDE, or the name of a file
 *     lamps lumens multiplier nV nH type units width length height
 *     ballast_factor tenth watts
 *     nV vertical angles, nH horizontal angles, nH times nV candelas
 *
 * From TILT on, line ends mean no more than blanks. The light of a direction is
 *
 *     candela = value * multiplier * ballast_factor * tenth
 *
 * where `tenth` counts in 1986 and 1991 alone (the ballast-lamp photometric factor): it was
 * "reserved" in 1995 and 2002, and names the way the file was made in 2019 (1.10000: an
 * accredited laboratory, and so on).
 */
#include "lights/photometry_parts.h"

#include <math.h>
#include <stdio.h>

static const double FEET = 0.3048; /* m */

/* The numbers before the angles, and where each of them stands. */
enum {
    LAMPS,
    LUMENS,
    MULTIPLIER,
    VERTICALS,
    HORIZONTALS,
    TYPE,
    UNITS,
    WIDTH,
    LENGTH,
    HEIGHT,
    BALLAST,
    TENTH,
    WATTS,
    HEADER_NUMBERS
};

typedef struct ies_header {
    double at[HEADER_NUMBERS];
    scanner place[HEADER_NUMBERS];
} ies_header;

/* ---- numbers ---------------------------------------------------------------------------- */

static bool read_header(scanner *c, ies_header *h, lux_error *err)
{
    static const struct {
        const char *what;
        int least, most; /* of whole numbers; both 0: any number */
    } numbers[HEADER_NUMBERS] = {
        [LAMPS]       = { "the number of lamps", -1000000, 1000000 },
        [LUMENS]      = { "the lumens of a lamp" },
        [MULTIPLIER]  = { "the candela multiplier" },
        [VERTICALS]   = { "the number of vertical angles", 1, MOST_ANGLES },
        [HORIZONTALS] = { "the number of horizontal angles", 1, MOST_ANGLES },
        [TYPE]        = { "the photometric type (1: C, 2: B, 3: A)", 1, 3 },
        [UNITS]       = { "the unit of length (1: feet, 2: metres)", 1, 2 },
        [WIDTH]       = { "the width of the opening" },
        [LENGTH]      = { "the length of the opening" },
        [HEIGHT]      = { "the height of the opening" },
        [BALLAST]     = { "the ballast factor" },
        [TENTH]       = { "the number behind the ballast factor" },
        [WATTS]       = { "the input watts" },
    };
    for (int i = 0; i < HEADER_NUMBERS; i++) {
        int count;
        bool whole = numbers[i].most > 0;
        scan_left(c);
        h->place[i] = *c;
        if (whole &&
            !scan_count(c, numbers[i].what, numbers[i].least, numbers[i].most, &count, err))
            return false;
        if (!whole && !scan_number(c, numbers[i].what, &h->at[i], err))
            return false;
        h->at[i] = whole ? count : h->at[i];
    }
    return true;
}

/* A factor as it counts: 0 leaves no light, which no file means; below 0 there is no sense. */
static bool settle_factor(scanner *c, ies_header *h, int i, const char *what, lux_error *err)
{
    char expected[64];
    snprintf(expected, sizeof expected, "%s > 0", what);
    if (h->at[i] < 0.0)
        return scan_wrong(&h->place[i], expected, err);
    if (h->at[i] == 0.0) {
        notice_add(c->n, "%s:%d: %s is 0, where LM-63 has one > 0: taken as 1", c->path,
                   h->place[i].line, what);
        h->at[i] = 1.0;
    }
    return true;
}

/* The number behind the ballast factor, in versions in which it is none. */
static void check_tenth(const photometry *p, scanner *c, const ies_header *h)
{
    static const double generations[] = { 1.00001, 1.00010, 1.00000, 1.00100, 1.01000,
                                          1.01100, 1.10000, 1.10100, 1.11000, 1.11100 };
    double tenth                      = h->at[TENTH];
    int line                          = h->place[TENTH].line;
    if (p->format != PHOTOMETRY_LM63_2019) {
        if (tenth != 1.0)
            notice_add(c->n, "%s:%d: %g behind the ballast factor, where %s has 1: ignored",
                       c->path, line, tenth, photometry_format_name(p->format));
        return;
    }
    for (size_t i = 0; i < sizeof generations / sizeof *generations; i++)
        if (fabs(tenth - generations[i]) < 1e-6)
            return;
    notice_add(c->n, "%s:%d: LM-63-2019 has no file generation type %.6g: ignored, it is no factor",
               c->path, line, tenth);
}

/* Lamps and watts. */
static void settle_lamps(photometry *p, scanner *c, const ies_header *h)
{
    double lamps = h->at[LAMPS], lumens = h->at[LUMENS], watts = h->at[WATTS];
    if (lamps < 1.0)
        notice_add(c->n, "%s:%d: %g lamps, where LM-63 has 1 or more: taken as 1", c->path,
                   h->place[LAMPS].line, lamps);
    if (lumens < 0.0 && lumens != -1.0)
        notice_add(c->n, "%s:%d: %g lumens a lamp: taken as -1, absolute photometry", c->path,
                   h->place[LUMENS].line, lumens);
    if (lumens == 0.0)
        notice_add(c->n, "%s:%d: 0 lumens a lamp: taken as not known", c->path,
                   h->place[LUMENS].line);
    if (watts < 0.0)
        notice_add(c->n, "%s:%d: %g input watts: taken as not known", c->path, h->place[WATTS].line,
                   watts);
    p->absolute    = lumens < 0.0;
    p->lamp_lumens = lumens > 0.0 ? lumens * fmax(lamps, 1.0) : 0.0;
    p->watts       = fmax(watts, 0.0);
}

static bool settle_opening(photometry *p, scanner *c, const ies_header *h, lux_error *err)
{
    double unit = h->at[UNITS] == 1.0 ? FEET : 1.0;
    for (int i = WIDTH; i <= HEIGHT; i++)
        if (!(fabs(h->at[i]) * unit <= 1e4))
            return scan_wrong(&h->place[i], "a size of the opening up to 10 km", err);
    if (!opening_from_signs(p, h->at[WIDTH] * unit, h->at[LENGTH] * unit, h->at[HEIGHT] * unit))
        notice_add(c->n,
                   "%s:%d: %s has no opening with a width, length and height of %g, %g, %g: "
                   "taken as a %s",
                   c->path, h->place[WIDTH].line, photometry_format_name(p->format), h->at[WIDTH],
                   h->at[LENGTH], h->at[HEIGHT], opening_shape_name(p->opening));
    for (int i = 0; i < 4; i++)
        p->side_height[i] = p->height;
    p->length_along_deg = 0.0f;
    return true;
}

/* The header's meaning, but for the web; *factor is what makes candelas of its values. */
static bool settle_header(photometry *p, scanner *c, ies_header *h, double *factor, lux_error *err)
{
    bool tenth_counts = p->format <= PHOTOMETRY_LM63_1991;
    if (!settle_factor(c, h, MULTIPLIER, "the candela multiplier", err) ||
        !settle_factor(c, h, BALLAST, "the ballast factor", err) ||
        (tenth_counts && !settle_factor(c, h, TENTH, "the ballast-lamp photometric factor", err)))
        return false;
    *factor = h->at[MULTIPLIER] * h->at[BALLAST] * (tenth_counts ? h->at[TENTH] : 1.0);
    if (!tenth_counts)
        check_tenth(p, c, h);
    settle_lamps(p, c, h);
    p->type = "CBA"[(int)h->at[TYPE] - 1];
    return settle_opening(p, c, h, err);
}

/* count ascending angles within least..most. */
static bool read_angles(scanner *c, const char *what, double *out, int count, const double range[2],
                        lux_error *err)
{
    for (int i = 0; i < count; i++) {
        char expected[160];
        snprintf(expected, sizeof expected, "%s %d of %d, from %g to %g deg", what, i + 1, count,
                 range[0], range[1]);
        scan_left(c);
        scanner start = *c;
        if (!scan_number(c, expected, &out[i], err))
            return false;
        if (!(out[i] >= range[0] && out[i] <= range[1]))
            return scan_wrong(&start, expected, err);
        if (i > 0 && !(out[i] > out[i - 1])) {
            snprintf(expected, sizeof expected, "%s %d of %d, larger than the one before (%g)",
                     what, i + 1, count, out[i - 1]);
            return scan_wrong(&start, expected, err);
        }
    }
    return true;
}

static bool read_candelas(scanner *c, stored_web *w, double factor, lux_error *err)
{
    int negative = 0, line = c->line;
    size_t count = (size_t)w->plane_count * (size_t)w->gamma_count;
    for (size_t i = 0; i < count; i++) {
        char expected[96];
        double value;
        snprintf(expected, sizeof expected, "candela value %zu of %zu", i + 1, count);
        scan_left(c);
        scanner start = *c;
        if (!scan_number(c, expected, &value, err))
            return false;
        if (!web_candela(value, factor, &w->candela[i], &negative))
            return scan_wrong(&start, "a candela value that is below 1e30 cd with all factors",
                              err);
    }
    if (negative > 0)
        notice_add(c->n, "%s:%d: %d negative candela values: taken as 0", c->path, line, negative);
    if (scan_left(c))
        notice_add(c->n, "%s:%d: text behind the last candela value: ignored", c->path, c->line);
    return true;
}

/* ---- symmetry --------------------------------------------------------------------------- */

static bool near(double a, double b) { return fabs(a - b) < 0.01; }

static const struct {
    double first, last;
    photometry_symmetry symmetry;
    bool standard;
} ranges[] = {
    { 0, 90, SYMMETRY_QUADRANT, true }, { 0, 180, SYMMETRY_C0, true },
    { 90, 270, SYMMETRY_C90, true },    { 0, 360, SYMMETRY_NONE, true },
    { 180, 360, SYMMETRY_C0, false },   { -90, 90, SYMMETRY_C90, false },
    { -180, 0, SYMMETRY_C0, false },    { -180, 180, SYMMETRY_NONE, false },
    { 270, 450, SYMMETRY_C90, false },
};

/* What the horizontal angles of type C stand for. */
static bool find_symmetry(photometry *p, scanner *c, const stored_web *w, lux_error *err)
{
    double first = w->plane[0], last = w->plane[w->plane_count - 1];
    if (w->plane_count == 1) {
        if (first != 0.0)
            notice_add(c->n,
                       "%s:%d: one horizontal angle, %g, where LM-63 has 0: taken as "
                       "rotationally symmetric",
                       c->path, w->plane_line, first);
        p->symmetry = SYMMETRY_ROTATIONAL;
        return true;
    }
    for (size_t i = 0; i < sizeof ranges / sizeof *ranges; i++) {
        if (!near(first, ranges[i].first) || !near(last, ranges[i].last))
            continue;
        p->symmetry = ranges[i].symmetry;
        if (!ranges[i].standard)
            notice_add(c->n,
                       "%s:%d: horizontal angles from %g to %g, which LM-63 does not have: "
                       "symmetry taken as %s",
                       c->path, w->plane_line, first, last, photometry_symmetry_name(p->symmetry));
        return true;
    }

    /* All the way around but for the plane that repeats the first */
    double step = w->plane[w->plane_count - 1] - w->plane[w->plane_count - 2];
    if (last - first < 360.0 && last + 1.5 * step >= first + 360.0) {
        p->symmetry = SYMMETRY_NONE;
        notice_add(c->n, "%s:%d: the horizontal angles end at %g: %g is taken to repeat %g",
                   c->path, w->plane_line, last, first + 360.0, first);
        return true;
    }
    return failed(err, ERR_FORMAT,
                  "%s:%d:%d: found horizontal angles from %g to %g, expected 0 "
                  "alone, 0 to 90, 0 to 180, 90 to 270 or 0 to 360",
                  c->path, w->plane_line, w->plane_column, first, last);
}

/* Whether the last plane, 360 deg on, repeats the first. */
static void check_seam(scanner *c, const stored_web *w)
{
    int n = w->plane_count, rings = w->gamma_count;
    if (n < 2 || !near(w->plane[n - 1] - w->plane[0], 360.0))
        return;
    const float *first = w->candela, *last = w->candela + (size_t)(n - 1) * (size_t)rings;
    float most = 0.0f, off = 0.0f;
    for (int i = 0; i < rings; i++) {
        most = fmaxf(most, first[i]);
        off  = fmaxf(off, fabsf(first[i] - last[i]));
    }
    if (off > 0.01f * most)
        notice_add(c->n, "%s:%d: the plane at %g differs from that at %g: the latter counts",
                   c->path, w->plane_line, w->plane[n - 1], w->plane[0]);
}

static bool make_type_c(photometry *p, scanner *c, const stored_web *w, lux_error *err)
{
    double first = w->gamma[0], last = w->gamma[w->gamma_count - 1];
    bool standard = (near(first, 0) || near(first, 90)) && (near(last, 90) || near(last, 180));
    if (!standard)
        notice_add(c->n,
                   "%s:%d: vertical angles from %g to %g, where LM-63 has 0 to 90, 90 to "
                   "180 or 0 to 180: dark outside of them",
                   c->path, w->gamma_line, first, last);
    check_seam(c, w);
    return find_symmetry(p, c, w, err) && web_unfold(p, w, c, err);
}

static bool make_type_ab(photometry *p, scanner *c, const stored_web *w, lux_error *err)
{
    if (!web_from_ab(p, w, c, err))
        return false;
    notice_add(c->n, "%s:%d: photometric type %c: resampled as type C, %d planes of %d angles",
               c->path, w->gamma_line, p->type, p->plane_count, p->gamma_count);
    return true;
}

bool photometry_read_ies(photometry *p, scanner *c, lux_error *err)
{
    scanned_line tilt = { 0 };
    ies_header h      = { 0 };
    double factor;
    stored_web w;
    if (!ies_read_labels(p, c, &tilt, err) || !ies_read_tilt(p, c, &tilt, err) ||
        !read_header(c, &h, err) || !settle_header(p, c, &h, &factor, err))
        return false;
    if (!stored_web_of_text(&w, (int)h.at[HORIZONTALS], (int)h.at[VERTICALS], &h.place[VERTICALS],
                            err))
        return false;

    /* In 1986 type 1 was A as well as C: C has no vertical angles below 0 */
    bool maybe_a          = p->format == PHOTOMETRY_LM63_1986 && p->type == 'C';
    const double vert[2]  = { p->type == 'C' && !maybe_a ? 0.0 : -180.0, 180.0 };
    const double horiz[2] = { -180.0, p->type == 'C' ? 450.0 : 180.0 };
    scan_left(c);
    w.gamma_line = c->line;
    if (!read_angles(c, "vertical angle", w.gamma, w.gamma_count, vert, err))
        return false;
    scan_left(c);
    w.plane_line   = c->line;
    w.plane_column = scan_column(c);
    if (!read_angles(c, "horizontal angle", w.plane, w.plane_count, horiz, err) ||
        !read_candelas(c, &w, factor, err))
        return false;
    if (maybe_a && w.gamma[0] < 0.0) {
        notice_add(c->n, "%s:%d: vertical angles below 0 in a file of 1986: taken as type A",
                   c->path, w.gamma_line);
        p->type = 'A';
    }
    return p->type == 'C' ? make_type_c(p, c, &w, err) : make_type_ab(p, c, &w, err);
}
