/* lights/photometry_write.c -- webs as LM-63-2002 or EULUMDAT; the contract is in photometry.h.
 *
 * Only the planes that the symmetry needs are written. Where it needs one at an angle that the
 * web does not have (0, 90, 180, 270), the interpolated plane is: as the web is linear along C,
 * it adds and loses nothing.
 */
#include "core/file.h"
#include "lights/photometry.h"

#include <math.h>
#include <string.h>
#include <strings.h>

enum { LONGEST_LABEL = 78 /* bytes, EULUMDAT's; LM-63 has 256 a line */, VALUES_A_LINE = 10 };

/* ---- what both formats need ------------------------------------------------------------- */

/* Angles C to write. */
typedef struct plane_list {
    double *deg;
    int count;
} plane_list;

/* The web's planes strictly between from and to, and these two; where from > to, by way of 0.
 * Angles are given as from..from + 360. */
static bool list_planes(const photometry *p, double from, double to, plane_list *out, arena *a,
                        lux_error *err)
{
    double end = to > from ? to : to + 360.0;
    out->deg   = arena_array(a, double, 2 * (size_t)p->plane_count + 2, err);
    if (!out->deg)
        return false;
    out->count             = 0;
    out->deg[out->count++] = from;
    for (int turn = 0; turn < 2; turn++) {
        for (int i = 0; i < p->plane_count; i++) {
            double deg = (double)p->plane_deg[i] + 360.0 * turn;
            if (deg > from + 1e-3 && deg < end - 1e-3)
                out->deg[out->count++] = deg;
        }
    }
    out->deg[out->count++] = end;
    return true;
}

/* The common step of ascending angles; 0 if there is none. */
static double even_step(const double *at, int count)
{
    if (count < 2)
        return 0.0;
    double step = at[1] - at[0];
    for (int i = 2; i < count; i++)
        if (fabs(at[i] - at[i - 1] - step) > 1e-3)
            return 0.0;
    return step;
}

/* Text as a line takes it, cut between characters. */
static void write_label(FILE *f, const char *key, const char *text, const char *line_end)
{
    size_t n = text ? strlen(text) : 0;
    if (n > LONGEST_LABEL)
        for (n = LONGEST_LABEL; (text[n] & 0xc0) == 0x80;)
            n--;
    fprintf(f, "%s%.*s%s", key, (int)n, text ? text : "", line_end);
}

/* The opening with its length along C plane 0 or 90, as the format wants it. */
typedef struct turned_opening {
    opening_shape shape;
    double length, width, height; /* m */
} turned_opening;

static turned_opening turn_opening(const photometry *p, float length_along_deg)
{
    turned_opening o = { p->opening, (double)p->length, (double)p->width, (double)p->height };
    if (p->length_along_deg == length_along_deg)
        return o;
    o.length = (double)p->width, o.width = (double)p->length;
    if (o.shape == OPENING_CYLINDER_ALONG)
        o.shape = OPENING_CYLINDER_ACROSS;
    else if (o.shape == OPENING_CYLINDER_ACROSS)
        o.shape = OPENING_CYLINDER_ALONG;
    return o;
}

/* ---- LM-63 ------------------------------------------------------------------------------ */

/* The signs of length, width and height by which LM-63-2002 tells shapes. */
static void opening_signs(opening_shape s, double sign[3])
{
    static const signed char table[][3] = {
        [OPENING_POINT]             = { 1, 1, 1 },
        [OPENING_LINE]              = { 1, 1, 1 },
        [OPENING_RECTANGLE]         = { 1, 1, 1 },
        [OPENING_BOX]               = { 1, 1, 1 },
        [OPENING_DISC]              = { -1, -1, 1 },
        [OPENING_VERTICAL_CYLINDER] = { -1, -1, 1 },
        [OPENING_SPHERE]            = { -1, -1, -1 },
        [OPENING_CYLINDER_ALONG]    = { 1, -1, -1 },
        [OPENING_CYLINDER_ACROSS]   = { -1, 1, -1 },
        [OPENING_VERTICAL_DISC]     = { -1, 1, -1 },
    };
    for (int i = 0; i < 3; i++)
        sign[i] = table[s][i];
}

static void write_numbers(FILE *f, const double *at, int count)
{
    for (int i = 0; i < count; i++)
        fprintf(f, "%.9g%s", at[i], i + 1 == count || i % VALUES_A_LINE == 9 ? "\r\n" : " ");
}

/* 0 alone, 0 to 90, 0 to 180, 90 to 270, 0 to 360. */
static bool list_for_ies(const photometry *p, plane_list *out, arena *a, lux_error *err)
{
    double from = p->symmetry == SYMMETRY_C90 ? 90.0 : 0.0;
    double to   = p->symmetry == SYMMETRY_QUADRANT ? 90.0
                  : p->symmetry == SYMMETRY_C0     ? 180.0
                  : p->symmetry == SYMMETRY_C90    ? 270.0
                                                   : 360.0;
    if (!list_planes(p, from, to, out, a, err))
        return false;
    if (p->plane_count == 1)
        out->count = 1;
    return true;
}

static bool write_ies(const photometry *p, FILE *f, arena *a, lux_error *err)
{
    plane_list planes;
    double *row = arena_array(a, double, (size_t)p->gamma_count, err);
    if (!row || !list_for_ies(p, &planes, a, err))
        return false;
    fprintf(f, "IESNA:LM-63-2002\r\n");
    write_label(f, "[TEST] ", p->report, "\r\n");
    write_label(f, "[TESTLAB] ", "", "\r\n");
    write_label(f, "[ISSUEDATE] ", p->date, "\r\n");
    write_label(f, "[MANUFAC] ", p->manufacturer, "\r\n");
    write_label(f, "[LUMCAT] ", p->catalog, "\r\n");
    write_label(f, "[LUMINAIRE] ", p->name, "\r\n");
    write_label(f, "[LAMP] ", p->lamp, "\r\n");

    double sign[3];
    turned_opening o = turn_opening(p, 0.0f);
    opening_signs(o.shape, sign);
    fprintf(f, "TILT=NONE\r\n1 %.9g 1 %d %d 1 2 %.9g %.9g %.9g\r\n1 1 %.9g\r\n",
            p->lamp_lumens > 0.0 ? p->lamp_lumens : -1.0, p->gamma_count, planes.count,
            0.0 + sign[1] * o.width, 0.0 + sign[0] * o.length, 0.0 + sign[2] * o.height, p->watts);
    for (int j = 0; j < p->gamma_count; j++)
        row[j] = (double)p->gamma_deg[j];
    write_numbers(f, row, p->gamma_count);
    write_numbers(f, planes.deg, planes.count);
    for (int i = 0; i < planes.count; i++) {
        for (int j = 0; j < p->gamma_count; j++)
            row[j] = photometry_candela(p, planes.deg[i], (double)p->gamma_deg[j]);
        write_numbers(f, row, p->gamma_count);
    }
    return true;
}

/* ---- EULUMDAT --------------------------------------------------------------------------- */

/* Its opening: length and width in mm, width 0 for round ones, and height. */
static void write_ldt_opening(const photometry *p, const char *path, FILE *f, notices *n)
{
    turned_opening o = turn_opening(p, 90.0f);
    bool round =
        (o.shape == OPENING_DISC || o.shape == OPENING_VERTICAL_CYLINDER) && o.length == o.width;
    bool known = round || o.shape == OPENING_POINT || o.shape == OPENING_LINE ||
                 o.shape == OPENING_RECTANGLE || o.shape == OPENING_BOX;
    if (!known)
        notice_add(n,
                   "%s: EULUMDAT has no opening '%s' of %g by %g m: written as the box around it",
                   path, opening_shape_name(o.shape), o.length, o.width);
    double mm[3] = { 1e3 * o.length, round ? 0.0 : 1e3 * o.width, 1e3 * o.height };
    fprintf(f, "%.9g\r\n%.9g\r\n%.9g\r\n", mm[0], mm[1], mm[2]);
    fprintf(f, "%.9g\r\n%.9g\r\n", mm[0], mm[1]);
    for (int i = 0; i < 4; i++)
        fprintf(f, "%.9g\r\n", mm[2]);
}

/* The planes all the way around (Mc of them), and which are stored from where on. */
typedef struct ldt_planes {
    plane_list all, stored;
    int symmetry;
} ldt_planes;

static bool list_for_ldt(const photometry *p, ldt_planes *out, arena *a, lux_error *err)
{
    static const struct {
        int isym;
        double from, to;
    } forms[]             = { [SYMMETRY_NONE]       = { 0, 0, 360 },
                              [SYMMETRY_C0]         = { 2, 0, 180 },
                              [SYMMETRY_C90]        = { 3, 270, 90 },
                              [SYMMETRY_QUADRANT]   = { 4, 0, 90 },
                              [SYMMETRY_ROTATIONAL] = { 1, 0, 360 } };
    photometry_symmetry s = p->plane_count == 1 ? SYMMETRY_ROTATIONAL : p->symmetry;
    if (!list_planes(p, 0.0, 360.0, &out->all, a, err) ||
        !list_planes(p, forms[s].from, forms[s].to, &out->stored, a, err))
        return false;
    out->all.count--; /* 360 is 0 */
    out->symmetry = forms[s].isym;

    /* The counts that the format derives from Mc must be those that there are */
    int mc = out->all.count, count = out->stored.count;
    bool fits = out->symmetry == 2 ? mc % 2 == 0 && count == mc / 2 + 1
                : out->symmetry == 3
                    ? mc % 4 == 0 && count == mc / 2 + 1 && out->all.deg[3 * mc / 4] == 270.0
                : out->symmetry == 4 ? mc % 4 == 0 && count == mc / 4 + 1
                                     : false;
    if (out->symmetry == 1)
        out->all.count = out->stored.count = 1;
    else if (!fits)
        out->symmetry = 0, out->stored = out->all;
    return true;
}

static void write_ldt_lamps(const photometry *p, const photometry_figures *g, double flux, FILE *f)
{
    double all = p->luminaire_lumens;
    fprintf(f, "%.9g\r\n%.9g\r\n1\r\n0\r\n1\r\n", g->flux_code[3],
            100.0 * (p->lamp_lumens > 0.0 ? all / p->lamp_lumens : 1.0));
    fprintf(f, "%d\r\n", p->lamp_lumens > 0.0 ? 1 : -1);
    write_label(f, "", p->lamp, "\r\n");
    fprintf(f, "%.9g\r\n\r\n\r\n%.9g\r\n", flux, p->watts);
    for (int i = 0; i < 10; i++) /* direct ratios */
        fprintf(f, "0\r\n");
}

static bool write_ldt(const photometry *p, const char *path, FILE *f, arena *a, notices *n,
                      lux_error *err)
{
    ldt_planes planes;
    double *gamma = arena_array(a, double, (size_t)p->gamma_count, err);
    if (!gamma || !list_for_ldt(p, &planes, a, err))
        return false;
    for (int j = 0; j < p->gamma_count; j++)
        gamma[j] = (double)p->gamma_deg[j];

    write_label(f, "", p->manufacturer, "\r\n");
    fprintf(f, "%d\r\n%d\r\n%d\r\n%.9g\r\n%d\r\n%.9g\r\n", planes.symmetry == 1 ? 1 : 3,
            planes.symmetry, planes.all.count, even_step(planes.all.deg, planes.all.count),
            p->gamma_count, even_step(gamma, p->gamma_count));
    write_label(f, "", p->report, "\r\n");
    write_label(f, "", p->name, "\r\n");
    write_label(f, "", p->catalog, "\r\n");
    write_label(f, "", strrchr(path, '/') ? strrchr(path, '/') + 1 : path, "\r\n");
    write_label(f, "", p->date, "\r\n");
    write_ldt_opening(p, path, f, n);

    photometry_figures g = photometry_figure(p, path, NULL);
    double flux          = p->lamp_lumens > 0.0 ? p->lamp_lumens : p->luminaire_lumens;
    flux                 = flux > 0.0 ? flux : 1000.0; /* a dark one: any will do */
    write_ldt_lamps(p, &g, flux, f);
    for (int i = 0; i < planes.all.count; i++)
        fprintf(f, "%.9g\r\n", planes.all.deg[i]);
    for (int j = 0; j < p->gamma_count; j++)
        fprintf(f, "%.9g\r\n", gamma[j]);
    for (int i = 0; i < planes.stored.count; i++)
        for (int j = 0; j < p->gamma_count; j++)
            fprintf(f, "%.9g\r\n",
                    photometry_candela(p, planes.stored.deg[i], gamma[j]) * 1000.0 / flux);
    return true;
}

bool photometry_write(const photometry *p, const char *path, notices *n, lux_error *err)
{
    size_t length = strlen(path);
    bool ies      = length > 4 && !strcasecmp(path + length - 4, ".ies");
    bool ldt      = length > 4 && !strcasecmp(path + length - 4, ".ldt");
    if (!ies && !ldt)
        return failed(err, ERR_ARGUMENT, "%s: expected a name that ends in .ies or .ldt", path);
    if (p->lamp_lumens == 0.0 && p->format != PHOTOMETRY_NO_FILE && !p->absolute)
        notice_add(n, "%s: the lamps' lumens are not known: written as absolute photometry", path);

    output_file f;
    if (!file_create(&f, path, err))
        return false;
    arena a   = { 0 };
    bool done = ies ? write_ies(p, f.stream, &a, err) : write_ldt(p, path, f.stream, &a, n, err);
    arena_clear(&a);
    if (!done) {
        file_discard(&f);
        return false;
    }
    return file_commit(&f, err);
}
