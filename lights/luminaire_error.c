/* lights/luminaire_error.c -- how far a luminaire that shines from its opening is off a point that
 * shines from its centre: a bound for this web and this opening, whatever way a surface is turned.
 *
 * Flat openings and lines send I(w) dm from each place x (from the centre; dm has a sum of 1 and is
 * the same at -x). With r = c + x from the lit point, c to the centre, D = |c|, rho = |x| / D, and
 *
 *     F(x) = r / |r|^3,    E = n . integral of I F dm    where no part is below the horizon of n
 *     off  = integral of I (F~ - F(0)) + (I~ - I(0)) F~ + I' F' dm
 *
 * where F~ and I~ are the means at x and -x, F' and I' half the differences. Each is bounded:
 *
 *   F is the gradient of a harmonic function. Its term of the order k in x is, by the series of
 *   Legendre, at most (k + 1) rho^k / D^2 long; even orders make F~, odd ones F'. The term of order
 * 2 has no trace: it is that of the second moments less any multiple of the identity, so that of an
 * opening in two dimensions the greater of both moments alone counts, 3 mean(x_1^2) / D^4.
 *
 *   I changes along the great circle of c and x, by J(a) at the angle a. The angles to x and -x are
 *   kappa + delta and kappa - delta, with kappa <= rho^2 / (2 (1 - rho^2)), delta <= asin rho:
 *
 *     |I~ - I(0)| <= G kappa + integral of |dJ'| (delta - |a|) / 2,    |I'| <= G delta
 *
 *   delta and the first order of F' together: rho^2 sin g sqrt(1 + 3 cos^2 g), g between c and x,
 * at most 2 / sqrt(3) rho^2.
 *
 * The web is bilinear in (C, gamma), so that G, the greatest slope, is that of its cells, and
 *
 *     J'' = I_gamma cot(gamma) t_C^2 + 2 t_gamma t_C d/dgamma (I_C / sin gamma)
 *
 * within a cell, t being the direction of the great circle. From cell to cell J' jumps by at most
 * the difference of the slopes. Near the poles cot(gamma) has no bound, but t_gamma changes by 2 at
 * most, and the integral of |J''| by 2 |I_gamma|. So for a ball of the radius epsilon = asin rho
 *
 *     |I~ - I(0)| <= G kappa + a delta^2 + b delta,   and no more than the range of I in the ball
 *
 * with G, the range, a and b tabulated by gamma in even steps, and by epsilon, halved from rung to
 * rung. Where the web ends while there is light, G and b are infinite.
 *
 * Solids: with I and A between bounds over the ball, E is the integral of L w over directions w of
 * the opening, whose cone holds what the outline of area A(c) would fill at D + z, and is held by
 * what it would at D - z, z being half the depth along c; the inner one is symmetric about c.
 */
#include "lights/luminaire.h"

#include "core/color.h"

enum { HOMES = 128, RUNGS = 8, FIGURES = 4 }; /* steps of gamma, of epsilon; G, range, a, b */

/* What a web does between two rings, or beyond the last; at its upper end: the ring's kink. */
typedef struct band {
    double from, to;  /* rad */
    double low, high; /* cd */
    double slope;     /* cd/rad, of all directions; infinite at a pole where the planes differ */
    double steep;     /* cd/rad, along gamma */
    double twist;     /* cd/rad^2, |d/dgamma (I_C / sin gamma)| */
    double fold;      /* cd/rad, the change of slope across a plane */
    double kink;      /* cd/rad, the change of slope across the ring at `to`; infinite: a step */
    double cot_from, cot_to;
} band;

typedef struct web_view {
    const photometry *web;
    band *band;
    int bands;
    double plane_step; /* rad, the least between two planes */
} web_view;

static double radian(float deg) { return (double)deg * (M_PI / 180.0); }

static double candela_at(const photometry *w, int plane, int ring)
{
    return (double)w->candela[(plane % w->plane_count) * w->gamma_count + ring];
}

/* rad, from one plane to the next. */
static double plane_width(const photometry *w, int plane)
{
    bool last = plane == w->plane_count - 1;
    return radian(last ? w->plane_deg[0] + 360.0f - w->plane_deg[plane]
                       : w->plane_deg[plane + 1] - w->plane_deg[plane]);
}

/* cd/rad, dI/dC from this plane to the next. */
static double around(const photometry *w, int plane, int ring)
{
    return (candela_at(w, plane + 1, ring) - candela_at(w, plane, ring)) / plane_width(w, plane);
}

/* |l / sin| at the end of a band where l is linear in gamma: greatest at one of both, as it is
 * quasiconvex. At a pole it is the slope there, if l is 0 there. */
static double over_sine(double l, double gamma)
{
    double s = sin(gamma);
    return s > 1e-9 ? fabs(l) / s : l == 0.0 ? 0.0 : HUGE_VAL;
}

/* The greatest |d/dgamma (l / sin gamma)| in a band, l from l0 to l1: of 5 places, with what it may
 * change between them. Toward a pole, where l is 0, it falls to 0. */
static double twist_of(double from, double to, double l0, double l1)
{
    enum { PLACES = 5 };
    double rise = (l1 - l0) / (to - from), most = 0.0;
    bool pole = sin(from) < 1e-9 || sin(to) < 1e-9;
    for (int i = 0; i < PLACES; i++) {
        double gamma = from + (to - from) * i / (PLACES - 1);
        double s     = sin(gamma);
        double l     = l0 + rise * (gamma - from);
        if (s > 1e-9)
            most = fmax(most, fabs(rise - l * cos(gamma) / s) / s);
    }
    double s    = fmin(sin(from), sin(to));
    double more = pole ? 0.0 : 2.0 * (fmax(fabs(l0), fabs(l1)) / s + fabs(rise)) / (s * s);
    return most + more * 0.5 * (to - from) / (PLACES - 1);
}

/* What one plane, and the cells to the next one, add to a band between two rings. */
static void add_plane(band *b, const photometry *w, int plane, int ring)
{
    double i0 = candela_at(w, plane, ring), i1 = candela_at(w, plane, ring + 1);
    b->low   = fmin(b->low, fmin(i0, i1));
    b->high  = fmax(b->high, fmax(i0, i1));
    b->steep = fmax(b->steep, fabs(i1 - i0) / (b->to - b->from));
    if (w->plane_count == 1)
        return;

    double l0 = around(w, plane, ring), l1 = around(w, plane, ring + 1);
    int before = (plane + w->plane_count - 1) % w->plane_count;
    double d0 = l0 - around(w, before, ring), d1 = l1 - around(w, before, ring + 1);
    b->slope = fmax(b->slope, fmax(over_sine(l0, b->from), over_sine(l1, b->to)));
    b->fold  = fmax(b->fold, fmax(over_sine(d0, b->from), over_sine(d1, b->to)));
    b->twist = fmax(b->twist, twist_of(b->from, b->to, l0, l1));
}

/* The kink, or step, across ring number `ring`; on its sides there may be darkness. */
static double kink_of(const photometry *w, int ring)
{
    double most = 0.0, gamma = radian(w->gamma_deg[ring]);
    bool first = ring == 0, last = ring == w->gamma_count - 1;
    for (int i = 0; i < w->plane_count; i++) {
        double here = candela_at(w, i, ring);
        double below =
            first ? 0.0
                  : (here - candela_at(w, i, ring - 1)) / (gamma - radian(w->gamma_deg[ring - 1]));
        double above =
            last ? 0.0
                 : (candela_at(w, i, ring + 1) - here) / (radian(w->gamma_deg[ring + 1]) - gamma);
        if ((first || last) && here > 0.0)
            return HUGE_VAL;
        most = fmax(most, fabs(above - below));
    }
    return most;
}

/* |cot|; at a pole, infinite. */
static double cot_of(double gamma)
{
    double s = sin(gamma);
    return s > 1e-9 ? fabs(cos(gamma)) / s : HUGE_VAL;
}

/* Band 0 lies before the first ring, the last one behind the last ring: both dark. */
static band band_of(const photometry *w, int number)
{
    int rings   = w->gamma_count;
    band b      = { .from = number == 0 ? 0.0 : radian(w->gamma_deg[number - 1]),
                    .to   = number == rings ? M_PI : radian(w->gamma_deg[number]) };
    bool inside = number > 0 && number < rings;
    bool at_pole =
        number < rings && (w->gamma_deg[number] <= 0.0f || w->gamma_deg[number] >= 180.0f);
    b.low = inside ? HUGE_VAL : 0.0;
    for (int i = 0; inside && i < w->plane_count; i++)
        add_plane(&b, w, i, number - 1);
    b.slope    = hypot(b.slope, b.steep);
    b.cot_from = cot_of(b.from);
    b.cot_to   = cot_of(b.to);
    b.kink     = number == rings || at_pole ? 0.0 : kink_of(w, number);
    return b;
}

/* The directions of one step of gamma, and what a ball about one of them may reach. */
typedef struct home {
    double from, to;  /* rad */
    double radius;    /* rad, of the ball */
    double low, high; /* rad, in reach, within [0, pi] */
    double cot_low, cot_high;
} home;

static home home_of(int step, int rung)
{
    const double rounding = 1e-6; /* of gamma, in floats */
    home h                = { .from   = step * (M_PI / HOMES) - rounding,
                              .to     = (step + 1) * (M_PI / HOMES) + rounding,
                              .radius = asin(ldexp(0.5, -rung)) }; /* rho = 1/2, 1/4, ... */
    h.low                 = fmax(h.from - h.radius, 0.0);
    h.high                = fmin(h.to + h.radius, M_PI);
    h.cot_low             = cot_of(h.low);
    h.cot_high            = cot_of(h.high);
    return h;
}

/* Half the sum of kink (radius - distance) over the rings that a ball about gamma reaches. A great
 * circle may cross a ring twice, but near a pole alone steeply both times: between the crossings
 * t_gamma turns by at most 2 epsilon cot(gamma), below 1 if the ring is 3 epsilon from the pole. */
static double kinks_about(const web_view *v, double gamma, double radius)
{
    double sum = 0.0;
    for (int i = 0; i < v->web->gamma_count; i++) {
        double at    = v->band[i].to;
        double depth = radius - fabs(at - gamma);
        if (depth >= 0.0 && v->band[i].kink > 0.0)
            sum += v->band[i].kink * (fmin(at, M_PI - at) < 3.0 * radius ? depth : 0.5 * depth);
    }
    return sum;
}

/* The most of that for a centre within kappa of the home, which is at one of its ends or at a ring;
 * over the radius, as that is how it is tabulated: it is convex, and 0 for no radius. */
static double kinks_in_reach(const web_view *v, const home *h)
{
    double sine  = sin(h->radius);
    double kappa = 0.5 * sine * sine / (1.0 - sine * sine);
    double from = h->from - kappa, to = h->to + kappa;
    double most = fmax(kinks_about(v, from, h->radius), kinks_about(v, to, h->radius));
    for (int i = 0; i < v->web->gamma_count; i++) {
        double at = v->band[i].to;
        if (at >= from && at <= to)
            most = fmax(most, kinks_about(v, at, h->radius));
        if (v->band[i].kink == HUGE_VAL && at >= h->low && at <= h->high)
            return HUGE_VAL;
    }
    return most / h->radius;
}

/* How many planes a great circle crosses at most within the ball. */
static double planes_in_reach(const web_view *v, const home *h)
{
    double s     = fmin(sin(fmax(h->from, 0.0)), sin(fmin(h->to, M_PI)));
    double ratio = sin(h->radius) / fmax(s, 1e-9);
    double width = ratio < 1.0 ? 2.0 * asin(ratio) : M_PI;
    return floor(width / v->plane_step) + 1.0;
}

/* out: the figures of one home and rung. Cells where the bound by cot(gamma) is the lesser go into
 * a, those at the poles into b. */
static void add_rung(const web_view *v, const home *h, float *out)
{
    double slope = 0.0, twist = 0.0, fold = 0.0, low = HUGE_VAL, high = 0.0;
    double turn = 0.0, steep = 0.0;
    for (int i = 0; i < v->bands; i++) {
        const band *b = &v->band[i];
        if (b->from > h->high)
            break;
        if (b->to < h->low || b->to <= b->from)
            continue;
        double cot_from = b->from > h->low ? b->cot_from : h->cot_low;
        double cot_to   = b->to < h->high ? b->cot_to : h->cot_high;
        double bend     = b->steep > 0.0 ? b->steep * fmax(cot_from, cot_to) : 0.0;
        bool even       = 0.5 * h->radius * bend < b->steep;
        low             = fmin(low, b->low);
        high            = fmax(high, b->high);
        slope           = fmax(slope, b->slope);
        twist           = fmax(twist, b->twist);
        fold            = fmax(fold, b->fold);
        turn            = fmax(turn, even ? bend : 0.0);
        steep           = fmax(steep, even ? 0.0 : b->steep);
    }
    double kinks = kinks_in_reach(v, h);
    double folds = fold > 0.0 ? fold * planes_in_reach(v, h) : 0.0;
    out[0]       = (float)(kinks < HUGE_VAL ? slope : kinks);
    out[1]       = (float)(high - low);
    out[2]       = (float)(0.5 * (twist + turn));
    out[3]       = (float)(kinks + 0.5 * folds + steep);
}

const float *luminaire_error_table(arena *a, const photometry *web, lux_error *err)
{
    arena rough = { 0 };
    web_view v  = { .web = web, .bands = web->gamma_count + 1, .plane_step = 2.0 * M_PI };
    v.band      = arena_array(&rough, band, (size_t)v.bands, err);
    float *out  = v.band ? arena_array(a, float, HOMES *RUNGS *FIGURES, err) : NULL;
    for (int i = 0; web->plane_count > 1 && i < web->plane_count; i++)
        v.plane_step = fmin(v.plane_step, plane_width(web, i));
    for (int i = 0; out && i < v.bands; i++)
        v.band[i] = band_of(web, i);
    for (int i = 0; out && i < HOMES * RUNGS; i++) {
        home h = home_of(i / RUNGS, i % RUNGS);
        add_rung(&v, &h, out + i * FIGURES);
    }
    arena_clear(&rough);
    return out;
}

/* ---- asking ------------------------------------------------------------------------------ */

typedef struct vweb_change {
    vfloat slope, range, a, b;
} vweb_change;

/* Toward gamma, in a ball of the radius asin(rho), rho < 1/2. */
static vweb_change change_at(const luminaire_model *m, vfloat gamma, vfloat rho, vmask active)
{
    vint step = vto_int(vmin(gamma * (float)(HOMES / M_PI), vsplat((float)(HOMES - 1))));
    /* rho = 1/2, 1/4, ... are the ends of rungs; a rounding above counts as below */
    vfloat halvings = vmin(-vlog2(rho) - (1.0f + 1e-5f), vsplat((float)(RUNGS - 1)));
    vint rung       = vto_int(vmax(halvings, vsplat(0.0f)));
    vint at         = vkeep_int(active, (step * RUNGS + rung) * FIGURES);
    return (vweb_change){ vgather(m->error, at), vgather(m->error, at + 1),
                          vgather(m->error, at + 2), vgather(m->error, at + 3) };
}

/* cd/m^2 from a flat opening; i: cd, toward p from the centre. */
static vfloat flat_error(const opening *o, vweb_change web, vfloat i, vfloat dist2, vfloat rho)
{
    vfloat rho2  = rho * rho;
    vfloat more  = 1.0f / (1.0f - rho2);
    vfloat more2 = more * more;
    vfloat mean2 = o->mean2 / dist2;
    vfloat mean1 = o->mean1 / vsqrt(dist2);

    vfloat place = 3.0f * o->mean2_along / dist2 + 5.0f * rho2 * mean2 * more2;
    vfloat wide  = 1.0f + 0.25f * rho2; /* asin(x) <= x (1 + x^2 / 4) up to x = 1/2 */
    vfloat bend  = web.b * wide * mean1 + web.a * wide * wide * mean2;
    vfloat shift = web.slope * (0.5f * mean2 * more);
    vfloat tilt  = web.slope * (mean2 * more) * (1.1548f + 4.0f * rho2 * more2);

    vfloat mean = vmin(bend, web.range) + vmin(shift, web.range);
    return (i * place + mean * (1.0f + rho2) * more2 + vmin(tilt, web.range * mean1 * more2)) /
           dist2;
}

/* The same of a solid, seen along w in its own axes. */
static vfloat solid_error(const opening *o, vvec3 w, vweb_change web, vfloat i, vfloat dist2,
                          vfloat rho)
{
    vfloat dist  = vsqrt(dist2);
    vfloat wide  = rho * (1.0f + 0.25f * rho * rho);
    vfloat vary  = vmin(web.slope * wide, web.range);
    vfloat area  = o->type->projected(o, &w);
    vfloat less  = vmin(wide * o->area, vsplat(o->area - o->least_area));
    vfloat depth = vabs(w.x) * o->half.x + vabs(w.y) * o->half.y + vabs(w.z) * o->half.z;
    vfloat back  = 1.0f / (dist + depth);
    vfloat front = 1.0f / (dist - depth);

    vfloat l_low   = vmax(i - vary, vsplat(0.0f)) / (area + less);
    vfloat l_high  = vselect(area > less, (i + vary) / (area - less), vsplat(INFINITY));
    vfloat sr_low  = area * back * back * (1.0f - 1.5f * rho * rho);
    vfloat sr_high = area * front * front;

    vfloat along  = vmax(l_high * sr_high - i / dist2, i / dist2 - l_low * sr_low);
    vfloat across = (l_high - l_low) * sr_high + l_high * (sr_high - sr_low);
    return along + rho * across + 0.54f * rho * rho * l_high * sr_high;
}

vmask luminaire_as_point(const light *self, const vvec3 *p, vmask active, vlight_sample *out,
                         vfloat *error)
{
    const luminaire *l = (const luminaire *)self;
    vvec3 to           = vsub(vspread(l->position), *p);
    vfloat dist2       = vdot(to, to);
    vfloat dist        = vsqrt(dist2);
    vvec3 wi           = vscale(to, 1.0f / dist);

    /* The point */
    vfloat x     = -vdot(wi, vspread(l->c0));
    vfloat y     = -vdot(wi, vspread(l->c90));
    vfloat gamma = vatan2(vsqrt(x * x + y * y), -vdot(wi, vspread(l->axis)));
    vfloat cd    = { 0 };
    vmask lit    = vluminaire_lookup(l->model, x, y, gamma, active & (dist2 > 0.0f), &cd);
    cd           = vkeep(lit, cd);
    out->wi      = vkeep3(lit, wi);
    out->dist    = vkeep(lit, dist);
    out->e       = vscale(vspread(l->scale), vkeep(lit, cd / dist2));
    out->pdf     = vkeep(lit, vsplat(INFINITY));

    /* What it is off, also where it is dark itself */
    vfloat rho      = l->opening.radius / dist;
    vmask far       = active & (rho < 0.5f);
    vweb_change web = change_at(l->model, gamma, rho, far);
    vfloat off =
        l->opening.flat
            ? flat_error(&l->opening, web, cd, dist2, rho)
            : solid_error(&l->opening,
                          (vvec3){ vdot(wi, vspread(l->own[0])), vdot(wi, vspread(l->own[1])),
                                   vdot(wi, vspread(l->own[2])) },
                          web, cd, dist2, rho);
    off    = vselect(far, off * rgb_luminance(l->scale), vsplat(INFINITY));
    *error = vkeep(active, off);
    return lit;
}
