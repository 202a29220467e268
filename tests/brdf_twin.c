/* tests/brdf_twin.c -- see brdf_twin.h. */
#include "tests/brdf_twin.h"
#include "tests/test.h"

#include <stdlib.h>
#include <string.h>

static const double DEG = M_PI / 180.0;

dvec direction_of(double theta, double phi)
{
    return (dvec){ sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta) };
}

static double dot(dvec a, dvec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static dvec add(dvec a, dvec b) { return (dvec){ a.x + b.x, a.y + b.y, a.z + b.z }; }
static double size(dvec a) { return sqrt(dot(a, a)); }

double ward(dvec in, dvec out)
{
    dvec h    = add(in, out);
    double ax = 0.3, ay = 0.5;
    double tan2 = (h.x * h.x / (ax * ax) + h.y * h.y / (ay * ay)) / (h.z * h.z);
    return 0.1 / M_PI + 0.4 * exp(-tan2) / (4.0 * M_PI * ax * ay * sqrt(in.z * out.z));
}

double phong(dvec in, dvec out)
{
    double along = in.z * out.z - in.x * out.x - in.y * out.y; /* to the mirror direction */
    return 0.2 / M_PI + 0.3 * 14.0 / (2.0 * M_PI) * pow(fmax(along, 0.0), 12.0);
}

/* The directions at a place: for half angles those that have them. */
static void directions_at(brdf_kind kind, const double at[4], dvec *in, dvec *out)
{
    if (kind == BRDF_ISOTROPIC) {
        *in  = direction_of(at[0] * DEG, 0.0);
        *out = direction_of(at[1] * DEG, at[2] * DEG);
    } else if (kind == BRDF_ANISOTROPIC) {
        *in  = direction_of(at[0] * DEG, at[1] * DEG);
        *out = direction_of(at[2] * DEG, at[3] * DEG);
    } else {
        double h = at[0] * DEG, d = at[1] * DEG, p = at[2] * DEG;
        dvec normal = { sin(h), 0, cos(h) }, tangent = { cos(h), 0, -sin(h) };
        double c = cos(d), x = sin(d) * cos(p), y = sin(d) * sin(p);
        *in  = (dvec){ c * normal.x + x * tangent.x, y, c * normal.z + x * tangent.z };
        *out = (dvec){ c * normal.x - x * tangent.x, -y, c * normal.z - x * tangent.z };
    }
}

static int axes_of(brdf_kind kind) { return kind == BRDF_ANISOTROPIC ? 4 : 3; }

float *fill_closed_form(brdf_kind kind, const int counts[4], const double *const deg[4],
                        closed_form *f)
{
    size_t places = 1;
    int axes = axes_of(kind), at[4] = { 0 };
    for (int k = 0; k < axes; k++)
        places *= (size_t)counts[k];
    float *rgb = malloc(3 * places * sizeof *rgb);
    for (size_t i = 0; i < places; i++) {
        double place[4] = { 0 };
        dvec in, out;
        for (int k = 0; k < axes; k++)
            place[k] = deg[k][at[k]];
        directions_at(kind, place, &in, &out);
        double value = in.z > 0.0 && out.z > 0.0 ? f(in, out) : 0.0;
        for (size_t c = 0; c < 3; c++)
            rgb[3 * i + c] = (float)(value / (double)(1 << c));
        for (int k = axes - 1; k >= 0 && ++at[k] == counts[k]; k--)
            at[k] = 0;
    }
    return rgb;
}

const brdf *table_of_form(arena *a, brdf_kind kind, double step, closed_form *f, notices *n)
{
    double thetas[200], phis[800];
    int theta_count = 0, phi_count = 0;
    for (double t = 0.0; t < 85.0; t += step)
        thetas[theta_count++] = t;
    thetas[theta_count++] = 85.0;
    double around         = kind == BRDF_ANISOTROPIC ? 360.0 : 180.0;
    for (double t = 0.0; t < around + (kind == BRDF_ISOTROPIC ? 1e-6 : -1e-6); t += step)
        phis[phi_count++] = t;
    brdf_data d = { .name = "form", .kind = kind, .bands = 3 };
    for (int k = 0; k < 4; k++) {
        bool turns  = kind == BRDF_ANISOTROPIC ? k % 2 == 1 : k == 2;
        d.counts[k] = turns ? phi_count : theta_count;
        d.deg[k]    = turns ? phis : thetas;
    }
    float *rgb    = fill_closed_form(kind, d.counts, d.deg, f);
    d.rgb         = rgb;
    lux_error err = { 0 };
    const brdf *b = brdf_make(a, &d, n, &err);
    assert_string_equal(err.text, "");
    free(rgb);
    return b;
}

/* ---- the look-up ----------------------------------------------------------------------------- */

static void find(const double *at, int count, double period, double x, int *i, int *j, double *f)
{
    if (period > 0.0 && count > 1) {
        count -= at[count - 1] - at[0] > period - 1e-6;
        x  = at[0] + fmod(fmod(x - at[0], period) + period, period);
        *i = 0;
        while (*i + 1 < count && at[*i + 1] <= x)
            ++*i;
        *j         = (*i + 1) % count;
        double end = *j ? at[*j] : at[0] + period;
        *f         = (x - at[*i]) / (end - at[*i]);
        return;
    }
    x  = fmin(fmax(x, at[0]), at[count - 1]);
    *i = 0;
    while (*i + 2 < count && at[*i + 1] <= x)
        ++*i;
    *j = count > 1 ? *i + 1 : 0;
    *f = count > 1 ? (x - at[*i]) / (at[*j] - at[*i]) : 0.0;
}

static double theta_of(dvec w) { return atan2(hypot(w.x, w.y), w.z) / DEG; }

static void angles_of(const brdf_data *d, dvec in, dvec out, double angle[4], double period[4])
{
    memset(period, 0, 4 * sizeof *period);
    if (d->kind == BRDF_ANISOTROPIC) {
        angle[0] = theta_of(in), angle[1] = atan2(in.y, in.x) / DEG;
        angle[2] = theta_of(out), angle[3] = atan2(out.y, out.x) / DEG;
        period[1] = period[3] = 360.0;
    } else if (d->kind == BRDF_ISOTROPIC) {
        double cross = in.x * out.y - in.y * out.x, along = in.x * out.x + in.y * out.y;
        angle[0] = theta_of(in), angle[1] = theta_of(out), angle[2] = atan2(cross, along) / DEG;
        if (d->deg[2][0] >= 0.0 && d->deg[2][d->counts[2] - 1] <= 180.0)
            angle[2] = fabs(angle[2]); /* without handedness */
        else
            period[2] = 360.0;
    } else { /* by turning `in` until h is upright */
        dvec h   = add(in, out);
        double l = size(h), t = atan2(hypot(h.x, h.y), h.z), p = atan2(h.y, h.x);
        dvec turned  = { in.x * cos(p) + in.y * sin(p), in.y * cos(p) - in.x * sin(p), in.z };
        dvec upright = { turned.x * cos(t) - turned.z * sin(t), turned.y,
                         turned.z * cos(t) + turned.x * sin(t) };
        dvec off     = { in.x - out.x, in.y - out.y, in.z - out.z };
        angle[0] = t / DEG, angle[1] = atan2(size(off), l) / DEG;
        angle[2]  = atan2(upright.y, upright.x) / DEG;
        period[2] = 180.0;
    }
}

double twin_value(const brdf_data *d, dvec in, dvec out)
{
    double angle[4], period[4], f[4], sum = 0.0;
    int low[4], high[4], axes = axes_of(d->kind);
    angles_of(d, in, out, angle, period);
    for (int k = 0; k < axes; k++)
        find(d->deg[k], d->counts[k], period[k], angle[k], &low[k], &high[k], &f[k]);
    for (int corner = 0; corner < 1 << axes; corner++) {
        double weight = 1.0;
        size_t at     = 0;
        for (int k = 0; k < axes; k++) {
            bool up = corner >> k & 1;
            weight *= up ? f[k] : 1.0 - f[k];
            at = at * (size_t)d->counts[k] + (size_t)(up ? high[k] : low[k]);
        }
        sum += weight * (double)d->rgb[3 * at];
    }
    return sum;
}
