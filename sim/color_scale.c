/* sim/color_scale.c -- see color_scale.h. */
#include "sim/color_scale.h"

#include <math.h>
#include <stdlib.h>

/* The k-th number of ... 0.5, 1, 2, 5, 10, 20, ...; the 0-th is 1. */
static double number_125(int k)
{
    static const double digit[] = { 1.0, 2.0, 5.0 };
    int power                   = (k >= 0 ? k : k - 2) / 3;
    double scale                = pow(10.0, abs(power)); /* exact, which its inverse is not */
    return power >= 0 ? digit[k - 3 * power] * scale : digit[k - 3 * power] / scale;
}

color_scale color_scale_125(color_ramp ramp, double least, double most)
{
    color_scale s = { .ramp = ramp, .bands = MOST_BANDS };
    int top       = most > 0.0 ? (int)floor(3.0 * log10(most)) - 1 : 0;
    while (number_125(top) < most)
        top++;
    for (s.bands = 1; s.bands < MOST_BANDS && number_125(top - s.bands) > least;)
        s.bands++;
    for (int i = 0; i <= s.bands; i++)
        s.limit[i] = number_125(top - s.bands + i);
    if (s.limit[0] > least)
        s.limit[0] = 0.0;
    return s;
}

color_scale color_scale_even(color_ramp ramp, double most)
{
    static const double steps[] = { 1.0, 2.0, 2.5, 5.0, 10.0 };
    double up                   = most > 0.0 ? most : 1.0;
    double power                = pow(10.0, floor(log10(up / MOST_BANDS)));
    int i                       = 0;
    while (MOST_BANDS * steps[i] * power < up * (1.0 - 1e-9))
        i++;
    color_scale s = { .ramp = ramp, .bands = (int)ceil(up / (steps[i] * power) - 1e-9) };
    for (int k = 0; k <= s.bands; k++)
        s.limit[k] = steps[i] * power * k;
    return s;
}

int color_scale_band(const color_scale *s, double x)
{
    int band = 0;
    while (band + 1 < s->bands && x >= s->limit[band + 1])
        band++;
    return band;
}

void color_scale_color(const color_scale *s, int band, uint8_t rgb[3])
{
    enum { ANCHORS = 6 };
    static const double ramps[][ANCHORS][3] = {
        [RAMP_LIGHT] = { { 26, 18, 64 },
                         { 45, 62, 150 },
                         { 24, 118, 168 },
                         { 52, 166, 120 },
                         { 196, 200, 62 },
                         { 255, 242, 178 } },
        [RAMP_HOURS] = { { 58, 32, 78 },
                         { 130, 40, 88 },
                         { 196, 62, 66 },
                         { 234, 120, 52 },
                         { 248, 186, 88 },
                         { 255, 238, 190 } },
    };
    double at = s->bands > 1 ? (ANCHORS - 1.0) * band / (s->bands - 1) : 0.0;
    int left  = (int)fmin(floor(at), ANCHORS - 2);
    double t  = at - left;
    for (int c = 0; c < 3; c++)
        rgb[c] =
            (uint8_t)lround((1.0 - t) * ramps[s->ramp][left][c] + t * ramps[s->ramp][left + 1][c]);
}
