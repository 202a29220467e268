/* materials/brdf_reciprocity.c -- how far a table is from f(a, b) = f(b, a), which no real surface
 * breaks: |f(a, b) - f(b, a)| by the larger of the two, over pairs of directions that cover the
 * hemisphere. Pairs a thousand times darker than the brightest say nothing but noise.
 */
#include "materials/brdf_parts.h"

enum { PAIR_THETAS = 5, PAIR_PHIS = 8, PAIRS = PAIR_THETAS * PAIR_THETAS * PAIR_PHIS * 2 };

static vvec3 direction(double theta, double phi)
{
    return vspread((vec3){ (float)(sin(theta) * cos(phi)), (float)(sin(theta) * sin(phi)),
                           (float)cos(theta) });
}

static double value(const brdf *b, const vvec3 *wo, const vvec3 *wi)
{
    vrgb f = vbrdf_value(b, wo, wi, ALL_LANES);
    return ((double)lane(f.x, 0) + (double)lane(f.y, 0) + (double)lane(f.z, 0)) / 3.0;
}

void brdf_measure_reciprocity(brdf *b)
{
    static const double thetas[PAIR_THETAS] = { 0.15, 0.5, 0.85, 1.2, 1.48 };
    double there[PAIRS], back[PAIRS], most = 0.0, sum = 0.0;
    int count = 0, counted = 0;
    for (int i = 0; i < PAIR_THETAS; i++)
        for (int j = 0; j < PAIR_THETAS; j++)
            for (int k = 0; k < 2 * PAIR_PHIS; k++) {
                vvec3 wo     = direction(thetas[i], k % 2 ? 1.3 : 0.2);
                vvec3 wi     = direction(thetas[j], 0.1 + k * (M_PI / PAIR_PHIS));
                there[count] = value(b, &wo, &wi);
                back[count]  = value(b, &wi, &wo);
                most         = fmax(most, there[count++]);
            }
    for (int i = 0; i < count; i++) {
        double larger = fmax(there[i], back[i]);
        if (larger <= 1e-3 * most)
            continue;
        double error = fabs(there[i] - back[i]) / larger;
        sum += error;
        counted++;
        b->figures.reciprocity_worst = fmaxf(b->figures.reciprocity_worst, (float)error);
    }
    b->figures.reciprocity_mean = counted ? (float)(sum / counted) : 0.0f;
}
