/* sim/planck.c -- see planck.h. */
#include "sim/planck.h"

static void krystek(double t, double *x, double *y)
{
    double u = (0.860117757 + t * (1.54118254e-4 + t * 1.28641212e-7)) /
               (1.0 + t * (8.42420235e-4 + t * 7.08145163e-7));
    double v = (0.317398726 + t * (4.22806245e-5 + t * 4.20481691e-8)) /
               (1.0 + t * (-2.89741816e-5 + t * 1.61456053e-7));
    double w = 2.0 * u - 8.0 * v + 4.0;
    *x       = 3.0 * u / w;
    *y       = 2.0 * v / w;
}

static void kim(double t, double *x, double *y)
{
    double k = 1e3 / t;
    *x       = 0.240390 + k * (0.2226347 + k * (2.1070379 - k * 3.0258469));
    *y       = -0.37001483 + *x * (3.75112997 + *x * (-5.87338670 + *x * 3.0817580));
}

bool planck_chromaticity(double kelvin, double *x, double *y)
{
    if (!(kelvin >= 1000.0 && kelvin <= 25000.0))
        return false;
    (kelvin <= 15000.0 ? krystek : kim)(kelvin, x, y);
    return true;
}

bool rgb_scale_to_luminance_1(const double rgb[3], vec3 *out)
{
    double r = fmax(rgb[0], 0.0), g = fmax(rgb[1], 0.0), b = fmax(rgb[2], 0.0);
    double luminance = 0.2126 * r + 0.7152 * g + 0.0722 * b;
    if (!(luminance >= 1e-30))
        return false;
    *out = (vec3){ (float)(r / luminance), (float)(g / luminance), (float)(b / luminance) };
    return true;
}

bool planck_color(double kelvin, vec3 *out)
{
    double x, y;
    if (!planck_chromaticity(kelvin, &x, &y))
        return false;

    /* To XYZ at Y = 1, and by BT.709's matrix to RGB */
    double big_x  = x / y;
    double big_z  = (1.0 - x - y) / y;
    double rgb[3] = { 3.2409699 * big_x - 1.5373832 - 0.4986108 * big_z,
                      -0.9692436 * big_x + 1.8759675 + 0.0415551 * big_z,
                      0.0556301 * big_x - 0.2039770 + 1.0569715 * big_z };
    return rgb_scale_to_luminance_1(rgb, out);
}
