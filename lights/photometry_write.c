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

enum { LONGEST_LDT = 78, LONGEST_IES = 240 /* bytes of a label; LM-63 has 256 a line */ };
enum { VALUES_A_LINE = 10 };

static const double NARROWEST_MM = 1.0; /* EULUMDAT takes a width of 0 as round */

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

/* What is written to. */
typedef struct web_output {
    FILE *file;
    const char *path; /* for messages */
    size_t longest;   /* bytes of a label */
    arena *a;
    notices *n;
} web_output;

/* Text as a line takes it, cut between characters. */
static void write_label(const web_output *o, const char *key, const char *text)
{
    size_t n = text ? strlen(text) : 0;
    if (n > o->longest) {
        notice_add(o->n, "%s: a label of %zu bytes is cut to %zu: %s", o->path, n, o->longest,
                   text);
        for (n = o->longest; (text[n] & 0xc0) == 0x80;)
            n--;
    }
    fprintf(o->file, "%s%.*s\r\n", key, (int)n, text ? text : "");
}

static bool even_sides(const photometry *p)
{
    const float *h = p->side_height;
    return h[0] == h[1] && h[0] == h[2] && h[0] == h[3];
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
        [OPENING_VERTICAL_DISC]     = { -1, -1, -1 },
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

/* Up to the TILT line and its table. */
static void write_ies_labels(const photometry *p, const web_output *o)
{
    fprintf(o->file, "IESNA:LM-63-2002\r\n");
    write_label(o, "[TEST] ", p->report);
    write_label(o, "[TESTLAB] ", "");
    write_label(o, "[ISSUEDATE] ", p->date);
    write_label(o, "[MANUFAC] ", p->manufacturer);
    write_label(o, "[LUMCAT] ", p->catalog);
    write_label(o, "[LUMINAIRE] ", p->name);
    write_label(o, "[LAMP] ", p->lamp);
    if (p->tilt_count == 0) {
        fprintf(o->file, "TILT=NONE\r\n");
        return;
    }
    fprintf(o->file, "TILT=INCLUDE\r\n%d\r\n%d\r\n", p->tilt_geometry, p->tilt_count);
    for (int i = 0; i < p->tilt_count; i++)
        fprintf(o->file, "%.9g\r\n", (double)p->tilt_deg[i]);
    for (int i = 0; i < p->tilt_count; i++)
        fprintf(o->file, "%.9g\r\n", (double)p->tilt_factor[i]);
}

static bool write_ies(const photometry *p, const web_output *out, lux_error *err)
{
    plane_list planes;
    FILE *f     = out->file;
    double *row = arena_array(out->a, double, (size_t)p->gamma_count, err);
    if (!row || !list_for_ies(p, &planes, out->a, err))
        return false;
    write_ies_labels(p, out);

    double sign[3];
    turned_opening o = turn_opening(p, 0.0f);
    opening_signs(o.shape, sign);
    if (o.shape == OPENING_LINE)
        notice_add(out->n, "%s: LM-63 has no line: the opening is written as one of no width",
                   out->path);
    if (!even_sides(p))
        notice_add(out->n, "%s: LM-63 has one height of the opening: %g m, the greatest", out->path,
                   o.height);
    fprintf(f, "1 %.9g 1 %d %d 1 2 %.9g %.9g %.9g\r\n1 1 %.9g\r\n",
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

/* Its opening: length and width in mm, width 0 for round ones, and heights. */
static void write_ldt_opening(const photometry *p, const web_output *out)
{
    FILE *f          = out->file;
    turned_opening o = turn_opening(p, 90.0f);
    bool round =
        (o.shape == OPENING_DISC || o.shape == OPENING_VERTICAL_CYLINDER) && o.length == o.width;
    bool known = round || o.shape == OPENING_POINT || o.shape == OPENING_LINE ||
                 o.shape == OPENING_RECTANGLE || o.shape == OPENING_BOX;
    if (!known)
        notice_add(out->n,
                   "%s: EULUMDAT has no opening '%s' of %g by %g m: written as the box around it",
                   out->path, opening_shape_name(o.shape), o.length, o.width);
    double mm[3] = { 1e3 * o.length, round ? 0.0 : 1e3 * o.width, 1e3 * o.height };
    if (!round && mm[0] > 0.0 && mm[1] == 0.0) {
        notice_add(out->n, "%s: EULUMDAT has no opening without width: written %g mm wide",
                   out->path, NARROWEST_MM);
        mm[1] = NARROWEST_MM;
    }
    fprintf(f, "%.9g\r\n%.9g\r\n%.9g\r\n", mm[0], mm[1], mm[2]);
    fprintf(f, "%.9g\r\n%.9g\r\n", mm[0], mm[1]);
    for (int i = 0; i < 4; i++)
        fprintf(f, "%.9g\r\n", even_sides(p) ? mm[2] : 1e3 * (double)p->side_height[i]);
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

static void write_ldt_lamps(const photometry *p, const photometry_figures *g, double flux,
                            const web_output *o)
{
    FILE *f    = o->file;
    double all = p->luminaire_lumens;
    fprintf(f, "%.9g\r\n%.9g\r\n1\r\n0\r\n1\r\n", g->flux_code[3],
            100.0 * (p->lamp_lumens > 0.0 ? all / p->lamp_lumens : 1.0));
    fprintf(f, "%d\r\n", p->lamp_lumens > 0.0 ? 1 : -1);
    write_label(o, "", p->lamp);
    fprintf(f, "%.9g\r\n\r\n\r\n%.9g\r\n", flux, p->watts);
    for (int i = 0; i < 10; i++) /* direct ratios */
        fprintf(f, "0\r\n");
}

static bool write_ldt(const photometry *p, const web_output *o, lux_error *err)
{
    ldt_planes planes;
    FILE *f       = o->file;
    double *gamma = arena_array(o->a, double, (size_t)p->gamma_count, err);
    if (!gamma || !list_for_ldt(p, &planes, o->a, err))
        return false;
    if (p->tilt_count > 0)
        notice_add(o->n, "%s: EULUMDAT has no word for the lamp's output by tilt: left out",
                   o->path);
    for (int j = 0; j < p->gamma_count; j++)
        gamma[j] = (double)p->gamma_deg[j];

    write_label(o, "", p->manufacturer);
    fprintf(f, "%d\r\n%d\r\n%d\r\n%.9g\r\n%d\r\n%.9g\r\n", planes.symmetry == 1 ? 1 : 3,
            planes.symmetry, planes.all.count, even_step(planes.all.deg, planes.all.count),
            p->gamma_count, even_step(gamma, p->gamma_count));
    write_label(o, "", p->report);
    write_label(o, "", p->name);
    write_label(o, "", p->catalog);
    write_label(o, "", strrchr(o->path, '/') ? strrchr(o->path, '/') + 1 : o->path);
    write_label(o, "", p->date);
    write_ldt_opening(p, o);

    photometry_figures g = photometry_figure(p, o->path, NULL);
    double flux          = p->lamp_lumens > 0.0 ? p->lamp_lumens : p->luminaire_lumens;
    flux                 = flux > 0.0 ? flux : 1000.0; /* a dark one: any will do */
    write_ldt_lamps(p, &g, flux, o);
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
    arena a              = { 0 };
    const web_output out = { f.stream, path, ies ? LONGEST_IES : LONGEST_LDT, &a, n };
    bool done            = ies ? write_ies(p, &out, err) : write_ldt(p, &out, err);
    arena_clear(&a);
    if (!done) {
        file_discard(&f);
        return false;
    }
    return file_commit(&f, err);
}
