/* tests/chi_square.c -- whether counts agree with what was expected: see test.h. */
#include "tests/test.h"

/* The regularised incomplete gamma function Q(a, x), by its power series below the bend and by
 * its continued fraction (Lentz's method) above (Abramowitz & Stegun 6.5.29 and 6.5.31). */
static double gamma_tail(double a, double x)
{
    double front = exp(a * log(x) - x - lgamma(a));
    if (x < a + 1.0) {
        double term = 1.0 / a, sum = term;
        for (double n = a + 1.0; term > 1e-16 * sum; n += 1.0) {
            term *= x / n;
            sum += term;
        }
        return 1.0 - front * sum;
    }

    double b = x + 1.0 - a, c = HUGE_VAL, d = 1.0 / b, fraction = d;
    for (int i = 1; i < 100000; i++) {
        double an = -i * (i - a);
        b += 2.0;
        d           = 1.0 / (an * d + b);
        c           = b + an / c;
        double step = c * d;
        fraction *= step;
        if (fabs(step - 1.0) < 1e-15)
            break;
    }
    return front * fraction;
}

double chi_square_tail(double chi_square, int degrees)
{
    return chi_square > 0.0 ? gamma_tail(0.5 * degrees, 0.5 * chi_square) : 1.0;
}

double chi_square_test(const double *expected, const int *count, int cells)
{
    double chi_square = 0.0, pooled_expected = 0.0, pooled_count = 0.0;
    int degrees = -1; /* the sums are the same */
    for (int i = 0; i < cells; i++) {
        pooled_expected += expected[i];
        pooled_count += count[i];
        if (pooled_expected >= 5.0 || (i == cells - 1 && pooled_expected > 0.0)) {
            double off = pooled_count - pooled_expected;
            chi_square += off * off / pooled_expected;
            degrees++;
            pooled_expected = pooled_count = 0.0;
        }
    }
    return pooled_count > 0.0 ? 0.0 : chi_square_tail(chi_square, degrees > 0 ? degrees : 1);
}
