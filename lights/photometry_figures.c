/* lights/photometry_figures.c -- integrals of a web and what data sheets say of it; the
 * definitions and formulae are in photometry.h. All in double precision, in fixed order. */
#include "lights/photometry.h"

#include <math.h>

static const double DEG = M_PI / 180.0;

static double node(const photometry *p, int plane, int ring)
{
    return (double)p->candela[(size_t)plane * (size_t)p->gamma_count + (size_t)ring];
}

/* ---- flux ------------------------------------------------------------------------------- */

/* The integral of I sin(gamma) from g to h, I linear from at_g to at_h; in cd. */
static double cell_integral(double g, double h, double at_g, double at_h)
{
    if (!(h > g))
        return 0.0;
    return at_g * cos(g) - at_h * cos(h) + (at_h - at_g) * (sin(h) - sin(g)) / (h - g);
}

/* The same over all of a plane's cells that lie within from..to, in rad. */
static double plane_integral(const photometry *p, int plane, double from, double to)
{
    double sum = 0.0;
    for (int i = 0; i + 1 < p->gamma_count; i++) {
        double g0 = (double)p->gamma_deg[i] * DEG, g1 = (double)p->gamma_deg[i + 1] * DEG;
        double a = node(p, plane, i), b = node(p, plane, i + 1);
        double g = fmax(g0, from), h = fmin(g1, to);
        if (h > g)
            sum += cell_integral(g, h, a + (b - a) * (g - g0) / (g1 - g0),
                                 a + (b - a) * (h - g0) / (g1 - g0));
    }
    return sum;
}

/* Half the angle between the neighbours of a plane, in rad: all of them add up to 2 pi. */
static double plane_share(const photometry *p, int plane)
{
    int n = p->plane_count;
    if (n == 1)
        return 2.0 * M_PI;
    double before =
        plane > 0 ? (double)p->plane_deg[plane - 1] : (double)p->plane_deg[n - 1] - 360.0;
    double after =
        plane + 1 < n ? (double)p->plane_deg[plane + 1] : (double)p->plane_deg[0] + 360.0;
    return 0.5 * (after - before) * DEG;
}

double photometry_flux(const photometry *p, double from_deg, double to_deg)
{
    double sum = 0.0;
    for (int i = 0; i < p->plane_count; i++)
        sum += plane_share(p, i) * plane_integral(p, i, from_deg * DEG, to_deg * DEG);
    return sum;
}

/* ---- single directions ------------------------------------------------------------------ */

/* The last of count ascending angles that is at most x; 0 if none is. */
static int last_up_to(const float *at, int count, double x)
{
    int low = 0, high = count;
    while (high - low > 1) {
        int middle = low + (high - low) / 2;
        if ((double)at[middle] <= x)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* The two planes beside C and how far C is from the first to the second. */
static double beside(const photometry *p, double plane_deg, int *i, int *j)
{
    int n    = p->plane_count;
    double c = fmod(plane_deg, 360.0);
    c += c < 0.0 ? 360.0 : 0.0;
    c += c < (double)p->plane_deg[0] ? 360.0 : 0.0;
    *i         = last_up_to(p->plane_deg, n, c);
    *j         = *i + 1 < n ? *i + 1 : 0;
    double end = (double)p->plane_deg[*j] + (*j == 0 ? 360.0 : 0.0);
    return (c - (double)p->plane_deg[*i]) / (end - (double)p->plane_deg[*i]);
}

/* At ring k, between two planes. */
static double ring_candela(const photometry *p, double plane_deg, int k)
{
    int i, j;
    double s = beside(p, plane_deg, &i, &j);
    return (1.0 - s) * node(p, i, k) + s * node(p, j, k);
}

double photometry_candela(const photometry *p, double plane_deg, double gamma_deg)
{
    int n = p->gamma_count;
    if (!(gamma_deg >= (double)p->gamma_deg[0] && gamma_deg <= (double)p->gamma_deg[n - 1]))
        return 0.0;
    int k = last_up_to(p->gamma_deg, n, gamma_deg);
    if (k + 1 == n)
        return ring_candela(p, plane_deg, k);
    double g0 = (double)p->gamma_deg[k], g1 = (double)p->gamma_deg[k + 1];
    double t = (gamma_deg - g0) / (g1 - g0);
    return (1.0 - t) * ring_candela(p, plane_deg, k) + t * ring_candela(p, plane_deg, k + 1);
}

/* ---- angles of the beam ----------------------------------------------------------------- */

/* What of a circle is bright enough, gathered in ascending order. */
typedef struct bright_arcs {
    double first, last; /* deg, where the first begins and the last one seen ends */
    double gap;         /* the widest between two of them */
    bool any;
} bright_arcs;

/* Adds the part of the segment t0..t1 in which a line from a to b is at least `least`. */
static void add_segment(bright_arcs *arcs, double t0, double t1, double a, double b, double least)
{
    if (a < least && b < least)
        return;
    double from = a >= least ? t0 : t0 + (t1 - t0) * (least - a) / (b - a);
    double to   = b >= least ? t1 : t0 + (t1 - t0) * (a - least) / (a - b);
    if (!arcs->any)
        arcs->first = from;
    else
        arcs->gap = fmax(arcs->gap, from - arcs->last);
    arcs->last = to;
    arcs->any  = true;
}

/* The smallest angle, in deg, that holds all directions of at least `least` in the plane through
 * C = plane_deg: the circle without its widest dark gap. Its angle t is gamma in that half plane
 * and 360 - gamma in the other. */
static double bright_angle(const photometry *p, double plane_deg, double least)
{
    bright_arcs arcs = { 0 };
    int n            = p->gamma_count;
    for (int i = 0; i + 1 < n; i++)
        add_segment(&arcs, (double)p->gamma_deg[i], (double)p->gamma_deg[i + 1],
                    ring_candela(p, plane_deg, i), ring_candela(p, plane_deg, i + 1), least);
    for (int i = n - 1; i > 0; i--)
        add_segment(&arcs, 360.0 - (double)p->gamma_deg[i], 360.0 - (double)p->gamma_deg[i - 1],
                    ring_candela(p, plane_deg + 180.0, i),
                    ring_candela(p, plane_deg + 180.0, i - 1), least);
    if (!arcs.any)
        return 0.0;
    double around = arcs.first + 360.0 - arcs.last;
    return 360.0 - fmax(arcs.gap, around);
}

static double plane_maximum(const photometry *p, double plane_deg)
{
    double most = 0.0;
    for (int i = 0; i < p->gamma_count; i++)
        most =
            fmax(most, fmax(ring_candela(p, plane_deg, i), ring_candela(p, plane_deg + 180.0, i)));
    return most;
}

/* ---- figures ---------------------------------------------------------------------------- */

static void find_maximum(const photometry *p, photometry_figures *f)
{
    for (int i = 0; i < p->plane_count; i++) {
        for (int j = 0; j < p->gamma_count; j++) {
            if (!(node(p, i, j) > f->maximum_cd))
                continue;
            f->maximum_cd        = node(p, i, j);
            f->maximum_plane_deg = (double)p->plane_deg[i];
            f->maximum_gamma_deg = (double)p->gamma_deg[j];
        }
    }
}

static void find_flux_code(const photometry *p, photometry_figures *f)
{
    double within[4], all = p->luminaire_lumens;
    for (int i = 0; i < 4; i++)
        within[i] = photometry_flux(p, 0.0, acos(0.25 * (3 - i)) / DEG);
    for (int i = 0; i < 3; i++)
        f->flux_code[i] = within[3] > 0.0 ? 100.0 * within[i] / within[3] : 0.0;
    f->flux_code[3] = all > 0.0 ? 100.0 * within[3] / all : 0.0;
    f->flux_code[4] = 100.0 * f->lor;
}

/* What cannot be true, or not both at once. */
static void doubt(const photometry *p, const photometry_figures *f, const char *path, notices *n)
{
    if (!p->absolute && f->lor > 1.02)
        notice_add(n, "%s: the luminaire gives %.1f lm, more than its lamps (%.1f lm): LOR %.0f %%",
                   path, p->luminaire_lumens, p->lamp_lumens, 100.0 * f->lor);
    if (!p->absolute && f->lor_known && p->stated_lor > 0.0 &&
        fabs(f->lor - p->stated_lor) > 0.05 * p->stated_lor)
        notice_add(n,
                   "%s: the light output ratio is stated as %.1f %%, the intensities add up to "
                   "%.1f %%",
                   path, 100.0 * p->stated_lor, 100.0 * f->lor);
    if (p->stated_lumens > 0.0 &&
        fabs(p->luminaire_lumens - p->stated_lumens) > 0.05 * p->stated_lumens)
        notice_add(n,
                   "%s: the luminaire's flux is stated as %.1f lm, the intensities add up to "
                   "%.1f lm",
                   path, p->stated_lumens, p->luminaire_lumens);
}

photometry_figures photometry_figure(const photometry *p, const char *path, notices *n)
{
    photometry_figures f = { 0 };
    find_maximum(p, &f);

    double lamps = p->absolute ? p->luminaire_lumens : p->lamp_lumens;
    f.lor_known  = lamps > 0.0;
    f.lor        = f.lor_known ? p->luminaire_lumens / lamps : 0.0;
    f.lor_up     = f.lor_known ? photometry_flux(p, 90.0, 180.0) / lamps : 0.0;
    f.efficacy   = p->watts > 0.0 ? p->luminaire_lumens / p->watts : 0.0;
    find_flux_code(p, &f);

    for (int i = 0; i < 2; i++) {
        double most    = plane_maximum(p, 90.0 * i);
        f.beam_deg[i]  = most > 0.0 ? bright_angle(p, 90.0 * i, 0.5 * most) : 0.0;
        f.field_deg[i] = most > 0.0 ? bright_angle(p, 90.0 * i, 0.1 * most) : 0.0;
    }
    doubt(p, &f, path, n);
    return f;
}
