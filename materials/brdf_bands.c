/* materials/brdf_bands.c -- what bands of wavelengths are in three channels; see brdf_bands.h.
 *
 * Between bands a reflectance r is linear in the wavelength, beyond the first and the last it is as
 * there. The light is D65, S; the eye is that of CIE 1931 (both in steps of 10 nm here, 380 to 780;
 * the eye by the fit of Wyman, Sloan and Shirley, "Simple Analytic Approximations to the CIE XYZ
 * Color Matching Functions", JCGT 2(2) 2013):
 *
 *     XYZ = sum of r S (x, y, z),   RGB = M XYZ with Rec. 709's M, each scaled so that r = 1 is 1
 */
#include "materials/brdf_bands.h"

#include <math.h>

/* CIE standard illuminant D65, relative, 380 nm ... 780 nm (CIE 15) */
static const double d65[] = { 49.98,  54.65,  82.75,  91.49,  93.43,  86.68,  104.87,
                              117.01, 117.81, 114.86, 115.92, 108.81, 109.35, 107.80,
                              104.79, 107.69, 104.41, 104.05, 100.00, 96.33,  95.79,
                              88.69,  90.01,  89.60,  87.70,  83.29,  83.70,  80.03,
                              80.21,  82.28,  78.28,  69.72,  71.61,  74.35,  61.60,
                              69.89,  75.09,  63.59,  46.42,  66.81,  63.38 };
enum { SAMPLES = sizeof d65 / sizeof *d65 };

static double bell(double nm, double middle, double below, double above)
{
    double t = (nm - middle) * (nm < middle ? below : above);
    return exp(-0.5 * t * t);
}

static void eye(double nm, double xyz[3])
{
    xyz[0] = 0.362 * bell(nm, 442.0, 0.0624, 0.0374) + 1.056 * bell(nm, 599.8, 0.0264, 0.0323) -
             0.065 * bell(nm, 501.1, 0.0490, 0.0382);
    xyz[1] = 0.821 * bell(nm, 568.8, 0.0213, 0.0247) + 0.286 * bell(nm, 530.9, 0.0613, 0.0322);
    xyz[2] = 1.217 * bell(nm, 437.0, 0.0845, 0.0278) + 0.681 * bell(nm, 459.0, 0.0385, 0.0725);
}

/* How much of band i the reflectance at nm is. */
static double share(const double *bands, int count, int i, double nm)
{
    if (i > 0 && nm < bands[i])
        return fmax(1.0 - (bands[i] - nm) / (bands[i] - bands[i - 1]), 0.0);
    if (i + 1 < count && nm > bands[i])
        return fmax(1.0 - (nm - bands[i]) / (bands[i + 1] - bands[i]), 0.0);
    return 1.0;
}

void bands_to_rgb(const double *nm, int count, double (*weights)[3])
{
    /* IEC 61966-2-1: Rec. 709 primaries, D65 */
    static const double m[3][3] = { { 3.2406, -1.5372, -0.4986 },
                                    { -0.9689, 1.8758, 0.0415 },
                                    { 0.0557, -0.2040, 1.0570 } };
    double white[3]             = { 0 };
    for (int i = 0; i < count; i++)
        weights[i][0] = weights[i][1] = weights[i][2] = 0.0;
    for (int s = 0; s < SAMPLES; s++) {
        double at = 380.0 + 10.0 * s, xyz[3];
        eye(at, xyz);
        for (int c = 0; c < 3; c++) {
            double rgb = d65[s] * (m[c][0] * xyz[0] + m[c][1] * xyz[1] + m[c][2] * xyz[2]);
            white[c] += rgb;
            for (int i = 0; i < count; i++)
                weights[i][c] += rgb * share(nm, count, i, at);
        }
    }
    for (int i = 0; i < count; i++)
        for (int c = 0; c < 3; c++)
            weights[i][c] /= white[c];
}
