/* core/distribution.c -- see distribution.h. */
#include "core/distribution.h"

double distribution_make(float *cdf, const double *weights, int count)
{
    double sum = 0.0, so_far = 0.0;
    int last = 0;
    for (int i = 0; i < count; i++) {
        sum += weights[i];
        last = weights[i] > 0.0 ? i : last;
    }
    cdf[0] = 0.0f;
    for (int i = 0; i < count; i++) {
        so_far += sum > 0.0 ? weights[i] / sum : 1.0 / count;
        cdf[i + 1] =
            i >= (sum > 0.0 ? last : count - 1) ? 1.0f : (float)(so_far < 1.0 ? so_far : 1.0);
    }
    return sum;
}
