/* materials/brdf_energy.c -- what a table gives back, and what wi is drawn from.
 *
 * Between places f is linear in each angle, so its integral over a cell is the corners' sum with
 * the weights of linear hats, which have closed forms; and it is linear between the directions of
 * wo that are places of the table. Albedos are therefore exact, not estimates. Of a hat:
 *
 *     S = sin^2 t / 2,   T = sin 2t / 8 - t cos 2t / 4        [primitives of sc and t sc]
 *     upper half over [a, b]:  (T(b) - T(a) - a (S(b) - S(a))) / (b - a)
 *
 * Where more comes back than came in, f is scaled by the smaller of 1 / albedo of both of its
 * directions: what is reciprocal stays so, other directions stay as measured, and the new albedo,
 * a mean of what is at most the old one times its inverse, is at most 1.
 */
#include "core/distribution.h"
#include "materials/brdf_parts.h"

enum { HALF_NODES = 48, HALF_AZIMUTHS = 24 };

static const double TELLING = 1e-3; /* of gained light: what is less is rounding of the file's */

/* ---- weights --------------------------------------------------------------------------------- */

static double whole(double t) { return 0.5 * sin(t) * sin(t); }
static double first(double t) { return sin(2.0 * t) / 8.0 - t * cos(2.0 * t) / 4.0; }

/* Of the interval above place i: what its lower and upper end weigh in sin cos d(theta). */
static void theta_halves(const table_axis *axis, int i, double *lower, double *upper)
{
    double a = (double)axis->at[i], b = (double)axis->at[i + 1], all = whole(b) - whole(a);
    *upper = (first(b) - first(a) - a * all) / (b - a);
    *lower = all - *upper;
}

static double theta_weight(const table_axis *axis, int i)
{
    double lower = 0.0, upper = 0.0, unused;
    if (i > 0)
        theta_halves(axis, i - 1, &unused, &upper);
    if (i + 1 < axis->count)
        theta_halves(axis, i, &lower, &unused);
    return lower + upper;
}

/* From place i to the next, around. */
static double phi_width(const table_axis *axis, int i)
{
    double from = (double)axis->at[i];
    return i + 1 < axis->count ? (double)axis->at[i + 1] - from
                               : (double)axis->at[0] + (double)axis->period - from;
}

static double phi_weight(const table_axis *axis, int i)
{
    return 0.5 * (phi_width(axis, i) + phi_width(axis, i > 0 ? i - 1 : axis->count - 1));
}

/* ---- one node -------------------------------------------------------------------------------- */

static const table_axis *theta_in(const brdf *b)
{
    return &b->axes[b->kind == BRDF_ANISOTROPIC ? 2 : 1];
}
static const table_axis *phi_in(const brdf *b)
{
    return &b->axes[b->kind == BRDF_ANISOTROPIC ? 3 : 2];
}

static void direction_node(const brdf *b, int node, double *cells, double rgb[3])
{
    int thetas = b->cells.thetas, phis = b->cells.phis;
    const float *from = b->values + (size_t)node * (size_t)((thetas + 1) * phis * 4);
    for (int row = 0; row < thetas; row++) {
        double lower, upper;
        theta_halves(theta_in(b), row, &lower, &upper);
        for (int column = 0; column < phis; column++) {
            double half = 0.5 * phi_width(phi_in(b), column), sum = 0.0;
            int next         = column + 1 < phis ? column + 1 : 0;
            const float *low = from + 4 * row * phis, *high = low + 4 * phis;
            for (int k = 0; k < 3; k++) {
                double at_low  = (double)low[4 * column + k] + (double)low[4 * next + k];
                double at_high = (double)high[4 * column + k] + (double)high[4 * next + k];
                double part    = half * (lower * at_low + upper * at_high);
                rgb[k] += part;
                sum += part;
            }
            cells[row * phis + column] = sum / 3.0;
        }
    }
}

/* ---- all nodes ------------------------------------------------------------------------------- */

static int node_count(const brdf *b) { return b->nodes.theta.count * b->nodes.phi.count; }

/* Scratch and results while a table is integrated. */
typedef struct tables {
    float *rows, *columns, *density;
    double *cells, *row;  /* of one node */
    float *scale_in;      /* of each direction of wi among the places: what it may keep */
    const float *measure; /* of each cell */
} tables;

static void tabulate_node(brdf *b, const tables *t, int node)
{
    int thetas = b->cells.thetas, phis = b->cells.phis;
    double rgb[3] = { 0 };
    if (b->kind == BRDF_HALF)
        brdf_half_node(b, node, t->cells, rgb);
    else
        direction_node(b, node, t->cells, rgb);

    float *albedo = b->nodes.albedo + 4 * node;
    for (int k = 0; k < 3; k++)
        albedo[k] = (float)rgb[k];
    albedo[3] = (float)((rgb[0] + rgb[1] + rgb[2]) / 3.0);

    float *rows = t->rows + (size_t)node * (size_t)(thetas + 1);
    for (int row = 0; row < thetas; row++) {
        size_t at      = (size_t)node * (size_t)thetas + (size_t)row;
        float *columns = t->columns + at * (size_t)(phis + 1);
        t->row[row]    = distribution_make(columns, t->cells + row * phis, phis);
    }
    distribution_make(rows, t->row, thetas);
    for (int row = 0; row < thetas; row++) {
        size_t at            = (size_t)node * (size_t)thetas + (size_t)row;
        const float *columns = t->columns + at * (size_t)(phis + 1);
        float share          = rows[row + 1] - rows[row];
        for (int column = 0; column < phis; column++) {
            float cell = share * (columns[column + 1] - columns[column]);
            t->density[at * (size_t)phis + (size_t)column] =
                albedo[3] * cell / t->measure[row * phis + column];
        }
    }
}

/* ---- energy ---------------------------------------------------------------------------------- */

static void note_most(brdf *b, double albedo, float theta, float phi)
{
    brdf_figures *f = &b->figures;
    if (albedo > (double)f->albedo_most) {
        f->albedo_most = (float)albedo;
        f->theta_deg   = theta * (float)(180.0 / M_PI);
        f->phi_deg     = phi * (float)(180.0 / M_PI);
    }
}

static double largest(const double rgb[3]) { return fmax(rgb[0], fmax(rgb[1], rgb[2])); }
static double kept(double albedo) { return albedo > 1.0 ? (1.0 - 1e-6) / albedo : 1.0; }

static double node_albedo(const brdf *b, int node)
{
    const float *at = b->nodes.albedo + 4 * node;
    return largest((double[3]){ (double)at[0], (double)at[1], (double)at[2] });
}

/* What light from the place `row`, `column` of wi gives to all wo together; the mean over columns
 * where they are no azimuths of wi but between it and wo. */
static double incoming_albedo(const brdf *b, int row, int column)
{
    int rows = b->cells.thetas + 1, phis = b->cells.phis, outs = b->nodes.phi.count;
    bool turns    = b->kind == BRDF_ISOTROPIC;
    double rgb[3] = { 0 };
    for (int node = 0; node < node_count(b); node++) {
        double weight = theta_weight(&b->nodes.theta, node / outs);
        for (int c = turns ? 0 : column; c < (turns ? phis : column + 1); c++) {
            size_t at = ((size_t)node * (size_t)rows + (size_t)row) * (size_t)phis + (size_t)c;
            double w  = weight *
                       (turns ? phi_weight(phi_in(b), c) : phi_weight(&b->nodes.phi, node % outs));
            for (int k = 0; k < 3; k++)
                rgb[k] += w * (double)b->values[4 * at + (size_t)k];
        }
    }
    return largest(rgb);
}

/* Whether any direction gives back too much; scale_in is what light of wi's places may keep. */
static bool gains(brdf *b, const tables *t)
{
    int outs = b->nodes.phi.count, rows = b->cells.thetas + 1;
    double most = 0.0;
    for (int node = 0; node < node_count(b); node++) {
        most = fmax(most, node_albedo(b, node));
        note_most(b, node_albedo(b, node), b->nodes.theta.at[node / outs],
                  b->nodes.phi.at[node % outs]);
    }
    if (b->kind == BRDF_HALF)
        return most > 1.0;

    bool around = b->kind == BRDF_ANISOTROPIC;
    int columns = around ? b->cells.phis : 1;
    for (int row = 0; row < rows; row++) {
        for (int column = 0; column < columns; column++) {
            double albedo                       = incoming_albedo(b, row, column);
            t->scale_in[row * columns + column] = (float)kept(albedo);
            most                                = fmax(most, albedo);
            note_most(b, albedo, theta_in(b)->at[row], around ? phi_in(b)->at[column] : 0.0f);
        }
    }
    return most > 1.0;
}

static void scale_value(brdf *b, size_t place, double scale)
{
    for (size_t k = 0; k < 3; k++)
        b->values[4 * place + k] = (float)((double)b->values[4 * place + k] * scale);
    b->figures.scale_least = fminf(b->figures.scale_least, (float)scale);
}

static void scale_directions(brdf *b, const tables *t)
{
    int rows = b->cells.thetas + 1, phis = b->cells.phis;
    int columns  = b->kind == BRDF_ANISOTROPIC ? phis : 1;
    size_t place = 0;
    for (int node = 0; node < node_count(b); node++) {
        double out = kept(node_albedo(b, node));
        for (int row = 0; row < rows; row++)
            for (int column = 0; column < phis; column++, place++) {
                double in = (double)t->scale_in[row * columns + (columns > 1 ? column : 0)];
                scale_value(b, place, fmin(in, out));
            }
    }
}

/* Of half tables: what directions of this cosine may keep. */
static double kept_at(const brdf *b, double cosine)
{
    const table_axis *axis = &b->nodes.theta;
    double theta           = acos(fmin(fmax(cosine, 0.0), 1.0));
    int i                  = 0;
    while (i + 2 < axis->count && (double)axis->at[i + 1] <= theta)
        i++;
    return fmin(kept(node_albedo(b, i)), kept(node_albedo(b, i + 1)));
}

static void scale_halves(brdf *b)
{
    const table_axis *axes = b->axes;
    size_t place           = 0;
    for (int i = 0; i < axes[0].count; i++)
        for (int j = 0; j < axes[1].count; j++)
            for (int k = 0; k < axes[2].count; k++, place++) {
                double h = (double)axes[0].at[i], d = (double)axes[1].at[j];
                double mean = cos(h) * cos(d), off = sin(h) * sin(d) * cos((double)axes[2].at[k]);
                scale_value(b, place, fmin(kept_at(b, mean - off), kept_at(b, mean + off)));
            }
}

/* What scaling by places leaves of too much, as half tables may have it between their nodes. */
static void scale_all(brdf *b)
{
    size_t places = 1;
    for (int i = 0; i < b->figures.axes; i++)
        places *= (size_t)b->axes[i].count;
    double most = 0.0;
    for (int node = 0; node < node_count(b); node++)
        most = fmax(most, node_albedo(b, node));
    if (most <= 1.0)
        return;
    float least = b->figures.scale_least;
    for (size_t i = 0; i < places; i++)
        scale_value(b, i, kept(most));
    b->figures.scale_least = least * (float)kept(most);
}

/* Of light that is equally strong from everywhere. */
static vec3 diffuse_reflectance(const brdf *b)
{
    double rgb[3] = { 0 };
    int outs      = b->nodes.phi.count;
    for (int node = 0; node < node_count(b); node++) {
        double w = theta_weight(&b->nodes.theta, node / outs) *
                   phi_weight(&b->nodes.phi, node % outs) / M_PI;
        for (int k = 0; k < 3; k++)
            rgb[k] += w * (double)b->nodes.albedo[4 * node + k];
    }
    return (vec3){ fminf((float)rgb[0], 1.0f), fminf((float)rgb[1], 1.0f),
                   fminf((float)rgb[2], 1.0f) };
}

/* ---- what there is to integrate -------------------------------------------------------------- */

static bool make_nodes(brdf *b, arena *a, lux_error *err)
{
    static const float ahead = 0.0f;
    b->nodes.phi =
        (table_axis){ .at = &ahead, .count = 1, .periodic = true, .period = 6.28318531f };
    if (b->kind == BRDF_ANISOTROPIC)
        b->nodes.phi = b->axes[1];
    if (b->kind != BRDF_HALF) {
        b->nodes.theta = b->axes[0];
    } else {
        float *at = arena_array(a, float, HALF_NODES, err);
        if (!at)
            return false;
        for (int i = 0; i < HALF_NODES; i++) { /* denser toward the horizon */
            double left = 1.0 - i / (double)(HALF_NODES - 1);
            at[i]       = (float)(0.5 * M_PI * (1.0 - left * left));
        }
        b->nodes.theta = (table_axis){ .at = at, .count = HALF_NODES };
        if (!table_axis_bins(&b->nodes.theta, a, err))
            return false;
    }
    b->nodes.albedo = arena_array(a, float, 4 * (size_t)node_count(b), err);
    return b->nodes.albedo != NULL;
}

static double edge(const brdf *b, double theta)
{
    double s = b->kind == BRDF_HALF ? sin(0.5 * theta) : sin(theta);
    return s * s;
}

/* Cells and their edges, and in *measure that of each cell, in scratch. */
static bool make_cells(brdf *b, arena *a, arena *scratch, float **measure, lux_error *err)
{
    bool half              = b->kind == BRDF_HALF;
    const table_axis *rows = half ? &b->axes[0] : theta_in(b);
    int thetas = rows->count - 1, phis = half ? HALF_AZIMUTHS : phi_in(b)->count;
    float *theta = arena_array(a, float, (size_t)thetas + 1, err);
    float *phi   = theta ? arena_array(a, float, (size_t)phis + 1, err) : NULL;
    *measure     = phi ? arena_array(scratch, float, (size_t)(thetas * phis), err) : NULL;
    if (!*measure)
        return false;
    for (int i = 0; i <= thetas; i++)
        theta[i] = (float)edge(b, (double)rows->at[i]);
    for (int i = 0; i <= phis; i++)
        phi[i] = half        ? (float)(2.0 * M_PI * i / phis)
                 : i == phis ? phi_in(b)->at[0] + phi_in(b)->period
                             : phi_in(b)->at[i];

    /* d(sin^2 t) / 2 = sin cos dt, and 2 d(sin^2 t/2) = sin dt */
    double unit = half ? 2.0 : 0.5;
    for (int i = 0; i < thetas; i++)
        for (int j = 0; j < phis; j++)
            (*measure)[i * phis + j] =
                (float)(unit * (edge(b, (double)rows->at[i + 1]) - edge(b, (double)rows->at[i])) *
                        ((double)phi[j + 1] - (double)phi[j]));
    b->cells =
        (brdf_cells){ .thetas = thetas, .phis = phis, .theta_edges = theta, .phi_edges = phi };
    return true;
}

static bool make_tables(brdf *b, arena *a, arena *scratch, tables *t, lux_error *err)
{
    float *measure = NULL;
    if (!make_nodes(b, a, err) || !make_cells(b, a, scratch, &measure, err))
        return false;
    size_t nodes = (size_t)node_count(b), thetas = (size_t)b->cells.thetas;
    size_t phis = (size_t)b->cells.phis, cells = nodes * thetas * phis;
    *t          = (tables){ .measure = measure };
    t->rows     = arena_array(a, float, nodes *(thetas + 1), err);
    t->columns  = t->rows ? arena_array(a, float, nodes *thetas *(phis + 1), err) : NULL;
    t->density  = t->columns ? arena_array(a, float, cells, err) : NULL;
    t->cells    = t->density ? arena_array(scratch, double, thetas *phis, err) : NULL;
    t->row      = t->cells ? arena_array(scratch, double, thetas, err) : NULL;
    t->scale_in = t->row ? arena_array(scratch, float, (thetas + 1) * phis, err) : NULL;
    b->figures.bytes += 4 * (2 * cells + 2 * nodes * thetas + 5 * nodes);
    return t->scale_in != NULL;
}

static void integrate(brdf *b, const tables *t, const char *name, notices *n)
{
    for (int node = 0; node < node_count(b); node++)
        tabulate_node(b, t, node);
    if (gains(b, t)) {
        if (b->kind == BRDF_HALF)
            scale_halves(b);
        else
            scale_directions(b, t);
        for (int node = 0; node < node_count(b); node++)
            tabulate_node(b, t, node);
        scale_all(b);
        for (int node = 0; node < node_count(b); node++)
            tabulate_node(b, t, node);
    }
    const brdf_figures *f = &b->figures;
    if ((double)f->albedo_most > 1.0 + TELLING)
        notice_add(n,
                   "%s: gives back %.3g times the light that comes from %.3g degrees off its "
                   "normal: values of such directions are scaled down, by %.3g at the most",
                   name, (double)f->albedo_most, (double)f->theta_deg, (double)f->scale_least);
    b->reflectance = diffuse_reflectance(b);
    brdf_measure_reciprocity(b);
}

bool brdf_integrate(brdf *b, arena *a, const char *name, notices *n, lux_error *err)
{
    arena scratch = { 0 };
    tables t;
    bool made = make_tables(b, a, &scratch, &t, err);
    if (made) {
        b->cells.rows    = t.rows;
        b->cells.columns = t.columns;
        b->cells.density = t.density;
        integrate(b, &t, name, n);
    }
    arena_clear(&scratch);
    return made;
}
