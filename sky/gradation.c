/* sky/gradation.c -- luminance by the angles to zenith and sun, in packets: see gradation.h. */
#include "sky/gradation.h"

#include "core/color.h"
#include "core/packet_math.h"

#include <math.h>

#define LOG2_E 1.4426950408889634

typedef struct gradation_sky_ {
    sky base;
    vec3 scaled; /* W/(sr m^2): the colour times the scale */
    vec3 to_sun; /* unit */
    float a, b2; /* b2 = b log2(e) */
    float f0, c, d2, e;
    bool graded, indicated; /* g, f is no constant */
} gradation_sky_;

/* The angle between unit vectors, in rad, to 2e-7. Where they are close or opposite, the chord
 * between them tells it: with s the sign of the cosine, |u - s v|^2 / 4 = sin^2 of half the angle
 * to s v; rounding the cosine would be off by 5e-4 there. */
static vfloat angle_between(vvec3 u, vvec3 v)
{
    vfloat cosine = vdot(u, v);
    vfloat size   = vabs(cosine);
    vfloat one    = vcopysign(vsplat(1.0f), cosine);
    vvec3 chord   = vsub(u, vscale(v, one));
    vmask large   = size > 0.5f;
    vfloat t      = vselect(large, 0.25f * vdot(chord, chord), size * size);
    vfloat small  = vasin_small(vselect(large, vsqrt(t), size), t);

    vfloat outer = vselect(cosine < 0.0f, 3.14159265f - 2.0f * small, 2.0f * small);
    return vselect(large, outer, 1.57079633f - vcopysign(small, cosine));
}

static vrgb gradation_radiance(const sky *self, const vvec3 *wi, vmask active)
{
    const gradation_sky_ *s = (const gradation_sky_ *)self;
    const float horizon     = 1e-6f; /* cos Z there, for 0 and -0 */
    vmask up                = active & (wi->z >= 0.0f);
    vfloat relative         = vsplat(1.0f);
    if (s->graded)
        relative = 1.0f + s->a * vexp2(s->b2 / vmax(wi->z, vsplat(horizon)));
    if (s->indicated) {
        vvec3 sun     = vspread(s->to_sun);
        vfloat cosine = vdot(*wi, sun);
        vfloat chi    = angle_between(*wi, sun);
        vfloat f      = s->f0 + s->c * vexp2(s->d2 * chi) + s->e * (cosine * cosine);
        relative      = relative * f;
    }
    vfloat seen = vkeep(up, vmax(relative, vsplat(0.0f)));
    return vscale(vspread(s->scaled), seen);
}

static const sky_type gradation_type = { .name = "gradation", .radiance = gradation_radiance };

/* ---- in double, at making ---------------------------------------------------------------------
 */

static double gradation_of(const gradation *g, double cos_zenith)
{
    return g->a == 0.0 ? 1.0 : 1.0 + g->a * exp(g->b / fmax(cos_zenith, 1e-9));
}

static double indicatrix(const gradation *g, double chi)
{
    double cosine = cos(chi);
    return g->f0 + g->c * exp(g->d * chi) + g->e * cosine * cosine;
}

double gradation_at(const gradation *g, double zenith, double chi)
{
    return fmax(gradation_of(g, cos(zenith)) * indicatrix(g, chi), 0.0);
}

/* The eight places of Gauss and Legendre on [-1, 1] (Abramowitz and Stegun, table 25.4). */
enum { PLACES = 8, CHI_PANELS = 12, PSI_PANELS = 6 };
static double gauss_at(int i, double *weight)
{
    static const double at[4]    = { 0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                     0.9602898564975363 };
    static const double share[4] = { 0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                     0.1012285362903763 };
    int k                        = i < PLACES / 2 ? PLACES / 2 - 1 - i : i - PLACES / 2;
    *weight                      = share[k];
    return i < PLACES / 2 ? -at[k] : at[k];
}

/* One ring around the sun, chi off it: over psi, counted from where the ring is highest, up to
 * where it meets the horizon, of L cos Z. cos Z = cos chi cos Zs + sin chi sin Zs cos psi. */
static double ring(const gradation *g, double chi, double sun_zenith)
{
    double middle = cos(chi) * cos(sun_zenith);
    double swing  = sin(chi) * sin(sun_zenith);
    double end    = middle >= swing ? M_PI : middle <= -swing ? 0.0 : acos(-middle / swing);
    double f      = indicatrix(g, chi);
    double step = end / PSI_PANELS, sum = 0.0, weight;
    for (int panel = 0; panel < PSI_PANELS; panel++)
        for (int i = 0; i < PLACES; i++) {
            double psi = step * (panel + 0.5 + 0.5 * gauss_at(i, &weight));
            double z   = fmax(middle + swing * cos(psi), 0.0);
            sum += weight * z * fmax(gradation_of(g, z) * f, 0.0);
        }
    return 2.0 * 0.5 * step * sum;
}

/* Over rings around the sun, for f has a tip there: first those that are all above the horizon,
 * then those that it cuts. Where that begins and ends the rings' length has a root's slope: the
 * cosine that is put in for chi makes it smooth. */
double gradation_irradiance(const gradation *g, double sun_zenith)
{
    double sum = 0.0, weight, whole = 0.5 * M_PI - sun_zenith;
    for (int panel = 0; panel < CHI_PANELS; panel++)
        for (int i = 0; i < PLACES; i++) {
            double t    = (panel + 0.5 + 0.5 * gauss_at(i, &weight)) / CHI_PANELS;
            double chi  = t * whole;
            double u    = M_PI * t;
            double cut  = whole + sun_zenith * (1.0 - cos(u));
            double over = 0.5 * weight / CHI_PANELS;
            sum += over * whole * sin(chi) * ring(g, chi, sun_zenith);
            sum += over * M_PI * sun_zenith * sin(u) * sin(cut) * ring(g, cut, sun_zenith);
        }
    return sum;
}

static bool color_is_good(const gradation_desc *d, lux_error *err)
{
    float luminance = rgb_luminance(d->color);
    if (!v3_nonnegative(d->color) || !(fabsf(luminance - 1.0f) <= 1e-3f))
        return failed(err, ERR_ARGUMENT, "%s: a colour of the luminance %g, wanted 1 and none < 0",
                      d->what, (double)luminance);
    return true;
}

/* The direction to the sun, of length 1 in double; up where nothing depends on it. */
static bool read_sun(const gradation_desc *d, bool needed, double sun[3], lux_error *err)
{
    const double rounding = 1e-6; /* of a sun on the horizon */
    sun[0] = sun[1] = 0.0;
    sun[2]          = 1.0;
    if (!needed)
        return true;
    double x = (double)d->to_sun.x, y = (double)d->to_sun.y, z = (double)d->to_sun.z;
    double length = sqrt(x * x + y * y + z * z);
    if (!(fabs(length - 1.0) <= 1e-3))
        return failed(err, ERR_ARGUMENT, "%s: a direction to the sun of length %g, wanted 1",
                      d->what, length);
    if (!(z >= -rounding))
        return failed(err, ERR_ARGUMENT, "%s: the sun is below the horizon, at %.3f degrees",
                      d->what, asin(z / length) * (180.0 / M_PI));
    sun[0] = x / length;
    sun[1] = y / length;
    sun[2] = fmin(fmax(z / length, 0.0), 1.0);
    return true;
}

const sky *gradation_sky(arena *a, const gradation_desc *d, lux_error *err)
{
    const gradation *g = &d->shape;
    bool indicated     = g->c != 0.0 || g->e != 0.0;
    double sun[3];
    if (!(d->horizontal >= 0.0 && d->horizontal <= 1e9))
        return failed(err, ERR_ARGUMENT, "%s: %g W/m^2 on level ground, wanted 0 to 1e9", d->what,
                      d->horizontal);
    if (!color_is_good(d, err) || !read_sun(d, indicated, sun, err))
        return NULL;
    double one = gradation_irradiance(g, acos(sun[2]));
    if (!(one > 0.0 && one < 1e9))
        return failed(err, ERR_ARGUMENT, "%s: it has no light to scale", d->what);

    gradation_sky_ *s = arena_new(a, gradation_sky_, err);
    if (!s)
        return NULL;
    s->base      = (sky){ .type       = &gradation_type,
                          .horizontal = v3_scale(d->color, (float)d->horizontal),
                          .columns    = d->columns,
                          .rows       = d->rows };
    s->scaled    = v3_scale(d->color, (float)(d->horizontal / one));
    s->to_sun    = (vec3){ (float)sun[0], (float)sun[1], (float)sun[2] };
    s->a         = (float)g->a;
    s->b2        = (float)(g->b * LOG2_E);
    s->f0        = (float)g->f0;
    s->c         = (float)g->c;
    s->d2        = (float)(g->d * LOG2_E);
    s->e         = (float)g->e;
    s->graded    = g->a != 0.0;
    s->indicated = indicated;
    if (!indicated)
        s->scaled = v3_scale(s->scaled, s->f0);
    return &s->base;
}
