/* tests/webs.c -- see webs.h. */
#include "tests/webs.h"

#include "core/sampler.h"
#include "tests/test.h"

double web_isotropic(double plane, double gamma) { return (void)plane, (void)gamma, 1.0; }
double web_lambertian(double plane, double gamma)
{
    double c = cos(gamma);
    return (void)plane, c > 1e-9 ? c : 0.0; /* dark at 90 deg too */
}
double web_both_sides(double plane, double gamma) { return (void)plane, fabs(cos(gamma)); }
double web_spot(double plane, double gamma)
{
    return (void)plane, pow(fmax(cos(gamma), 0.0), 200.0);
}
double web_batwing(double plane, double gamma)
{
    (void)plane;
    return fmax(cos(gamma), 0.0) * (0.3 + 2.0 * pow(sin(gamma), 2.0));
}
double web_asymmetric(double plane, double gamma)
{
    double x = sin(gamma) * cos(plane), y = sin(gamma) * sin(plane), z = cos(gamma);
    return fmax(z, 0.0) * (0.2 + pow(fmax(0.6 * x + 0.1 * y + 0.79 * z, 0.0), 12.0));
}
double web_sine(double plane, double gamma)
{
    double x = sin(gamma) * cos(plane);
    return sqrt(fmax(1.0 - x * x, 0.0));
}

photometry *web_make(arena *a, web_form *form, int planes, double step_deg)
{
    int rings      = (int)lrint(180.0 / step_deg) + 1;
    photometry *w  = arena_new(a, photometry, NULL);
    float *plane   = arena_array(a, float, (size_t)planes, NULL);
    float *gamma   = arena_array(a, float, (size_t)rings, NULL);
    float *candela = arena_array(a, float, (size_t)(planes * rings), NULL);
    assert_true(w && plane && gamma && candela);
    for (int i = 0; i < planes; i++)
        plane[i] = (float)(360.0 * i / planes);
    for (int j = 0; j < rings; j++)
        gamma[j] = (float)(180.0 * j / (rings - 1));
    for (int i = 0; i < planes; i++)
        for (int j = 0; j < rings; j++)
            candela[i * rings + j] = (float)form(
                2.0 * M_PI * (j == 0 || j == rings - 1 ? 0 : i) / planes, M_PI * j / (rings - 1));
    *w                  = (photometry){ .plane_count = planes,
                                        .gamma_count = rings,
                                        .plane_deg   = plane,
                                        .gamma_deg   = gamma,
                                        .candela     = candela };
    w->luminaire_lumens = photometry_flux(w, 0.0, 180.0);
    return w;
}

double mean_irradiance(const light *l, vec3 p, vec3 n, int log2_count, double *deviation)
{
    vvec3 at   = vspread(p);
    int count  = 1 << log2_count;
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < count; i += LANES) {
        vsample4 u = vsobol4(vunsigned(vlane_index() + i), vunsigned(vsplat_int(7)));
        vlight_sample s;
        vmask lit = light_sample(l, &at, u.x, u.y, ALL_LANES, &s);
        vfloat e  = s.e.y * vmax(vdot(s.wi, vspread(n)), vsplat(0.0f));
        for (int k = 0; k < LANES; k++) {
            double one = (double)lane(e, k);
            assert_true(isfinite(one) && one >= 0.0);
            assert_true(((vbits(lit) >> k) & 1) || one == 0.0);
            sum += one;
            squares += one * one;
        }
    }
    double mean = sum / count;
    if (deviation)
        *deviation = sqrt(fmax(squares / count - mean * mean, 0.0));
    return mean;
}
