/* lights/photometry_web.c -- from the planes that a file stores to a web all the way around.
 *
 * Mirrors, of an angle C in degrees:      in C0-C180: C -> -C      in C90-C270: C -> 180 - C
 *
 * Types A and B have the pole of their sphere at right angles to the aim. With the aim down (-z),
 * the photometric frame's C0 along +x and C90 along +y, and H positive to the right as seen from
 * the luminaire along its aim with V = 90 deg up (clockwise seen from there, as LM-63 has it):
 *
 *     A, V a latitude:    d = ( cos V sin H,  sin V,        -cos V cos H )
 *     B, H a latitude:    d = ( sin H,        cos H sin V,  -cos H cos V )
 */
#include "lights/photometry_parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double SAME_DEG      = 1e-4; /* planes closer than this are one */
static const double DEG           = M_PI / 180.0;
static const double FINEST_DEG    = 0.5; /* the step of planes that types A and B are turned into */
static const double COARSEST_DEG  = 5.0;
static const double GAMMA_GAP_DEG = 2.5;   /* rings are at most this far apart */
static const double EDGE_DEG      = 0.002; /* so far beyond the file's last angles it is dark */

bool web_candela(double value, double factor, float *out, int *negative)
{
    double cd = value * factor;
    if (!(cd <= 1e30)) /* so that fluxes and squares stay finite; NaN: no */
        return false;
    *negative += cd < 0.0;
    *out = cd > 0.0 ? (float)cd : 0.0f;
    return true;
}

bool stored_web_new(stored_web *w, int planes, int gammas, scanner *c, lux_error *err)
{
    *w = (stored_web){ .plane_count = planes, .gamma_count = gammas };
    if ((int64_t)planes * gammas > MOST_VALUES)
        return failed(err, ERR_FORMAT,
                      "%s:%d:%d: found %d planes of %d angles, expected at most %d values", c->path,
                      c->line, scan_column(c), planes, gammas, MOST_VALUES);
    w->plane   = arena_array(c->a, double, (size_t)planes, err);
    w->gamma   = w->plane ? arena_array(c->a, double, (size_t)gammas, err) : NULL;
    w->candela = w->gamma ? arena_array(c->a, float, (size_t)planes *(size_t)gammas, err) : NULL;
    return w->candela != NULL;
}

bool stored_web_of_text(stored_web *w, int planes, int gammas, scanner *c, lux_error *err)
{
    if ((int64_t)planes * gammas <= MOST_VALUES &&
        (int64_t)planes * gammas > (c->end - c->at + 1) / 2) /* a digit and a blank, each */
        return failed(err, ERR_FORMAT,
                      "%s:%d:%d: found %d planes of %d angles, expected no more values than the "
                      "file has room for",
                      c->path, c->line, scan_column(c), planes, gammas);
    return stored_web_new(w, planes, gammas, c, err);
}

/* ---- mirrors ---------------------------------------------------------------------------- */

/* A plane of the whole web and the stored one that it equals. */
typedef struct image_plane {
    double deg; /* [0, 360) */
    int row, order;
} image_plane;

static double turn_to_circle(double deg)
{
    double turned = fmod(deg, 360.0);
    turned += turned < 0.0 ? 360.0 : 0.0;
    return turned > 360.0 - SAME_DEG ? 0.0 : turned;
}

static int by_angle(const void *a, const void *b)
{
    const image_plane *p = a, *q = b;
    if (p->deg != q->deg)
        return p->deg < q->deg ? -1 : 1;
    return p->order - q->order; /* what the file gives goes before its images */
}

/* All images of the planes of w, ascending, each angle once; returns how many. */
static int unfold_planes(const stored_web *w, photometry_symmetry s, image_plane *out)
{
    int n = 0;
    for (int i = 0; i < w->plane_count; i++) {
        double c         = w->plane[i];
        double images[4] = { c, -c, 180.0 - c, 180.0 + c };
        bool there[4]    = { true, s == SYMMETRY_C0 || s == SYMMETRY_QUADRANT,
                             s == SYMMETRY_C90 || s == SYMMETRY_QUADRANT, s == SYMMETRY_QUADRANT };
        for (int k = 0; k < 4; k++)
            if (there[k])
                out[n++] = (image_plane){ turn_to_circle(images[k]), i, k * w->plane_count + i };
    }
    qsort(out, (size_t)n, sizeof *out, by_angle);

    int kept = 0;
    for (int i = 0; i < n; i++)
        if (kept == 0 || out[i].deg - out[kept - 1].deg > SAME_DEG)
            out[kept++] = out[i];
    return kept;
}

bool web_unfold(photometry *p, const stored_web *w, scanner *c, lux_error *err)
{
    image_plane *planes = arena_array(c->a, image_plane, 4 * (size_t)w->plane_count, err);
    if (!planes)
        return false;
    int count = unfold_planes(w, p->symmetry, planes);
    int rings = w->gamma_count;
    if ((int64_t)count * rings > MOST_VALUES)
        return failed(err, ERR_FORMAT,
                      "%s:%d:%d: found %d planes of %d angles, expected at most %d values", c->path,
                      w->plane_line, w->plane_column, count, rings, MOST_VALUES);

    float *plane   = arena_array(c->a, float, (size_t)count, err);
    float *gamma   = plane ? arena_array(c->a, float, (size_t)rings, err) : NULL;
    float *candela = gamma ? arena_array(c->a, float, (size_t)count *(size_t)rings, err) : NULL;
    if (!candela)
        return false;
    for (int i = 0; i < count; i++) {
        plane[i] = count == 1 ? 0.0f : (float)planes[i].deg;
        memcpy(candela + (size_t)i * (size_t)rings,
               w->candela + (size_t)planes[i].row * (size_t)rings, (size_t)rings * sizeof(float));
    }
    for (int i = 0; i < rings; i++)
        gamma[i] = (float)w->gamma[i];

    p->symmetry    = count == 1 ? SYMMETRY_ROTATIONAL : p->symmetry;
    p->plane_count = count, p->gamma_count = rings;
    p->plane_deg = plane, p->gamma_deg = gamma, p->candela = candela;
    return true;
}

/* ---- types A and B ---------------------------------------------------------------------- */

/* The cell of x among ascending angles; false outside of them. */
static bool find(const double *at, int count, double x, int *cell, double *fraction)
{
    double first = at[0] - SAME_DEG, last = at[count - 1] + SAME_DEG;
    if (!(x >= first && x <= last))
        return false;
    int low = 0, high = count - 1;
    while (high - low > 1) {
        int middle = low + (high - low) / 2;
        if (at[middle] <= x)
            low = middle;
        else
            high = middle;
    }
    *cell     = low;
    *fraction = high > low ? fmin(fmax((x - at[low]) / (at[high] - at[low]), 0.0), 1.0) : 0.0;
    return true;
}

/* The light toward H, V of a web whose planes or rings, if they begin at 0, mirror. */
static double stored_candela(const stored_web *w, double h, double v)
{
    h = w->plane[0] >= 0.0 ? fabs(h) : h;
    v = w->gamma[0] >= 0.0 ? fabs(v) : v;
    int i, j;
    double s, t;
    if (w->plane_count == 1) /* the same for all H */
        i = 0, s = 0.0;
    else if (!find(w->plane, w->plane_count, h, &i, &s))
        return 0.0;
    if (!find(w->gamma, w->gamma_count, v, &j, &t))
        return 0.0;
    int i1          = i + 1 < w->plane_count ? i + 1 : i;
    int j1          = j + 1 < w->gamma_count ? j + 1 : j;
    const float *r0 = w->candela + (size_t)i * (size_t)w->gamma_count;
    const float *r1 = w->candela + (size_t)i1 * (size_t)w->gamma_count;
    double at0      = (1.0 - t) * (double)r0[j] + t * (double)r0[j1];
    double at1      = (1.0 - t) * (double)r1[j] + t * (double)r1[j1];
    return (1.0 - s) * at0 + s * at1;
}

static double candela_ab(const photometry *p, const stored_web *w, double plane, double gamma)
{
    double x = sin(gamma * DEG) * cos(plane * DEG);
    double y = sin(gamma * DEG) * sin(plane * DEG);
    double z = -cos(gamma * DEG);
    double h, v;
    if (p->type == 'A') {
        h = atan2(x, -z);
        v = atan2(y, hypot(x, z));
    } else {
        h = atan2(x, hypot(y, z));
        v = atan2(y, -z);
    }
    return stored_candela(w, h / DEG, v / DEG);
}

/* The smallest step of ascending angles; `so_far` if that is smaller. */
static double smallest_step(const double *at, int count, double so_far)
{
    for (int i = 1; i < count; i++)
        so_far = fmin(so_far, at[i] - at[i - 1]);
    return so_far;
}

static int ascending(const void *a, const void *b)
{
    double d = *(const double *)a - *(const double *)b;
    return (d > 0.0) - (d < 0.0);
}

/* The angles gamma to sample at: 0, 90 and 180, every |H| and |V| of the file (on the axes the
 * web is then exact), the edges of darkness, and what fills wider gaps. Returns how many; `out`
 * has room. */
static int rings_ab(const stored_web *w, double *out)
{
    const double *h = w->plane, *v = w->gamma;
    const double ends[4] = { h[0], h[w->plane_count - 1], v[0], v[w->gamma_count - 1] };
    int n                = 0;
    for (int i = 0; i <= 72; i++)
        out[n++] = GAMMA_GAP_DEG * i;
    for (int i = 0; i < 4; i++)
        out[n++] = fmin(fabs(ends[i]) + EDGE_DEG, 180.0);
    for (int i = 0; i < w->plane_count; i++)
        out[n++] = fmin(fabs(h[i]), 180.0);
    for (int i = 0; i < w->gamma_count; i++)
        out[n++] = fmin(fabs(v[i]), 180.0);
    qsort(out, (size_t)n, sizeof *out, ascending);
    int kept = 1;
    for (int i = 1; i < n; i++)
        if (out[i] - out[kept - 1] > 1e-3)
            out[kept++] = out[i];
    return kept;
}

bool web_from_ab(photometry *p, const stored_web *w, scanner *c, lux_error *err)
{
    double step = smallest_step(w->plane, w->plane_count, COARSEST_DEG);
    step        = smallest_step(w->gamma, w->gamma_count, step);
    int planes  = 4 * (int)ceil(90.0 / fmax(step, FINEST_DEG) - 1e-9);
    double *rings =
        arena_array(c->a, double, 77 + (size_t)w->plane_count + (size_t)w->gamma_count, err);
    stored_web out;
    if (!rings)
        return false;
    int ring_count = rings_ab(w, rings);
    if (!stored_web_new(&out, planes, ring_count, c, err))
        return false;

    memcpy(out.gamma, rings, (size_t)ring_count * sizeof *rings);
    for (int i = 0; i < planes; i++) {
        out.plane[i] = 360.0 * i / planes;
        for (int j = 0; j < ring_count; j++)
            out.candela[(size_t)i * (size_t)ring_count + (size_t)j] =
                (float)candela_ab(p, w, out.plane[i], rings[j]);
    }
    p->symmetry = SYMMETRY_NONE;
    return web_unfold(p, &out, c, err);
}
