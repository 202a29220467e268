/* sky/perez.c -- the all-weather sky of Perez, Seals and Michalsky (Solar Energy 50(3), 1993).
 *
 *     L ~ (1 + a exp(b / cos Z)) (1 + c exp(d chi) + e cos^2 chi)
 *
 * with Z the angle to the zenith and chi that to the sun, made so that level ground gets
 * E = diffuse_horizontal times its luminous efficacy (Perez, Ineichen, Seals, Michalsky and
 * Stewart, Solar Energy 44(5), 1990). What the weather is like is told by
 *
 *     epsilon = ((Ed + Eb) / Ed + k Z_s^3) / (1 + k Z_s^3),  k = 1.041,       clearness, in 8 bins
 *     delta   = m Ed / E0                                                     brightness
 *
 * with Ed the diffuse horizontal and Eb the direct normal irradiance, E0 the extraterrestrial one
 * (1367 W/m^2 at 1 au), m the relative mass of air of Kasten and Young 1989, and Z_s the sun's
 * zenith angle, in rad. In each bin, x being a, b, c, d or e,
 *
 *     x = x1 + x2 Z_s + delta (x3 + x4 Z_s),  but in the first bin (erratum, 51(5))
 *     c = exp((delta (c1 + c2 Z_s))^c3) - c4
 *     d = -exp(delta (d1 + d2 Z_s)) + d3 + delta d4
 *
 *     efficacy = A + B W + C cos Z_s + D ln delta                             diffuse, lm/W
 *     efficacy = A + B W + C exp(5.73 Z_s - 5) + D delta, >= 0                direct normal
 *
 * with W = exp(0.07 T - 0.075) cm of water, T the dew point in C. Borders: delta within 0.01 ...
 * 0.6; in bins 2 to 5 the shape takes at least 0.2, as gendaylit of Radiance has it. Elsewhere,
 * too, there is weather, hardly ever seen, of which the gradation grows without bound toward the
 * horizon (b > 0) or leaves the zenith black: there delta is moved toward 0.2 as far as it takes.
 */
#include "core/color.h"
#include "sky/gradation.h"

#include <math.h>

enum { BINS = 8 };
static const double bin_ends[BINS - 1] = { 1.065, 1.230, 1.500, 1.950, 2.800, 4.500, 6.200 };

/* x1 ... x4 of a, b, c, d and e (1993, table 1) */
static const double shapes[BINS][5][4] = {
    { { 1.3525, -0.2576, -0.2690, -1.4366 },
      { -0.7670, 0.0007, 1.2734, -0.1233 },
      { 2.8000, 0.6004, 1.2375, 1.0000 },
      { 1.8734, 0.6297, 0.9738, 0.2809 },
      { 0.0356, -0.1246, -0.5718, 0.9938 } },
    { { -1.2219, -0.7730, 1.4148, 1.1016 },
      { -0.2054, 0.0367, -3.9128, 0.9156 },
      { 6.9750, 0.1774, 6.4477, -0.1239 },
      { -1.5798, -0.5081, -1.7812, 0.1080 },
      { 0.2624, 0.0672, -0.2190, -0.4285 } },
    { { -1.1000, -0.2515, 0.8952, 0.0156 },
      { 0.2782, -0.1812, -4.5000, 1.1766 },
      { 24.7219, -13.0812, -37.7000, 34.8438 },
      { -5.0000, 1.5218, 3.9229, -2.6204 },
      { -0.0156, 0.1597, 0.4199, -0.5562 } },
    { { -0.5484, -0.6654, -0.2672, 0.7117 },
      { 0.7234, -0.6219, -5.6812, 2.6297 },
      { 33.3389, -18.3000, -62.2500, 52.0781 },
      { -3.5000, 0.0016, 1.1477, 0.1062 },
      { 0.4659, -0.3296, -0.0876, -0.0329 } },
    { { -0.6000, -0.3566, -2.5000, 2.3250 },
      { 0.2937, 0.0496, -5.6812, 1.8415 },
      { 21.0000, -4.7656, -21.5906, 7.2492 },
      { -3.5000, -0.1554, 1.4062, 0.3988 },
      { 0.0032, 0.0766, -0.0656, -0.1294 } },
    { { -1.0156, -0.3670, 1.0078, 1.4051 },
      { 0.2875, -0.5328, -3.8500, 3.3750 },
      { 14.0000, -0.9999, -7.1406, 7.5469 },
      { -3.4000, -0.1078, -1.0750, 1.5702 },
      { -0.0672, 0.4016, 0.3017, -0.4844 } },
    { { -1.0000, 0.0211, 0.5025, -0.5119 },
      { -0.3000, 0.1922, 0.7023, -1.6317 },
      { 19.0000, -5.0000, 1.2438, -1.9094 },
      { -4.0000, 0.0250, 0.3844, 0.2656 },
      { 1.0468, -0.3788, -2.4517, 1.4656 } },
    { { -1.0500, 0.0289, 0.4260, 0.3590 },
      { -0.3250, 0.1156, 0.7781, 0.0025 },
      { 31.0625, -14.5000, -46.1148, 55.3750 },
      { -7.2312, 0.4050, 13.3500, 0.6234 },
      { 1.5000, -0.6426, 1.8564, 0.5636 } },
};

/* A, B, C, D of both efficacies (1990, table 4) */
static const double of_diffuse[BINS][4] = {
    { 97.24, -0.46, 12.00, -8.91 },   { 107.22, 1.15, 0.59, -3.95 },
    { 104.97, 2.96, -5.53, -8.77 },   { 102.39, 5.59, -13.95, -13.90 },
    { 100.71, 5.94, -22.75, -23.74 }, { 106.42, 3.83, -36.15, -28.83 },
    { 141.88, 1.90, -53.24, -14.03 }, { 152.23, 0.35, -45.27, -7.98 },
};
static const double of_direct[BINS][4] = {
    { 57.20, -4.55, -2.98, 117.12 }, { 98.99, -3.46, -1.21, 12.38 },
    { 109.83, -4.90, -1.71, -8.81 }, { 110.34, -5.84, -1.99, -4.56 },
    { 106.36, -3.97, -1.75, -6.16 }, { 107.19, -1.25, -1.51, -26.73 },
    { 105.75, 0.77, -1.26, -34.44 }, { 101.18, 1.58, -1.10, -8.29 },
};

/* The weather, as the tables want it. */
typedef struct weather {
    double zenith; /* rad */
    int bin;
    double clearness, brightness; /* as measured */
    double delta, shape_delta;    /* within the borders */
} weather;

static weather weather_of(const perez_desc *d, double zenith)
{
    const double solar_constant = 1367.0; /* W/m^2 */
    double elevation_deg        = 90.0 - zenith * (180.0 / M_PI);
    double mass    = 1.0 / (cos(zenith) + 0.50572 * pow(elevation_deg + 6.07995, -1.6364));
    double cube    = 1.041 * zenith * zenith * zenith;
    double above   = solar_constant / (d->distance_au * d->distance_au);
    double diffuse = d->diffuse_horizontal;

    weather w    = { .zenith = zenith };
    w.clearness  = ((diffuse + d->direct_normal) / diffuse + cube) / (1.0 + cube);
    w.brightness = mass * diffuse / above;
    while (w.bin < BINS - 1 && w.clearness >= bin_ends[w.bin])
        w.bin++;
    w.delta       = fmin(fmax(w.brightness, 0.01), 0.6);
    w.shape_delta = w.bin >= 1 && w.bin <= 4 ? fmax(w.delta, 0.2) : w.delta;
    return w;
}

static gradation shape_at(const weather *w, double delta)
{
    double x[5], z = w->zenith;
    for (int i = 0; i < 5; i++) {
        const double *k = shapes[w->bin][i];
        x[i]            = k[0] + k[1] * z + delta * (k[2] + k[3] * z);
    }
    if (w->bin == 0) {
        const double *c = shapes[0][2], *d = shapes[0][3];
        x[2] = exp(pow(delta * (c[0] + c[1] * z), c[2])) - c[3];
        x[3] = -exp(delta * (d[0] + d[1] * z)) + d[2] + delta * d[3];
    }
    return (gradation){ x[0], x[1], 1.0, x[2], x[3], x[4] };
}

/* The shape at the weather's delta, or at the nearest toward 0.2 that is finite at the horizon and
 * leaves the zenith some light. */
static gradation shape_of(const weather *w, bool *clamped)
{
    const double safe = 0.2, step = 0.01;
    double delta = w->shape_delta;
    gradation g  = shape_at(w, delta);
    while ((g.b > 0.0 || 1.0 + g.a * exp(g.b) <= 0.0) && delta != safe) {
        delta    = fabs(delta - safe) < step ? safe : delta + copysign(step, safe - delta);
        g        = shape_at(w, delta);
        *clamped = true;
    }
    *clamped |= g.b > 0.0;
    g.b = fmin(g.b, 0.0);
    return g;
}

static bool is_good(const perez_desc *d, lux_error *err)
{
    if (!(d->to_sun.z > 0.0f))
        return failed(err, ERR_ARGUMENT,
                      "Perez sky: the sun is not above the horizon, where the model knows no sky");
    if (!(fabsf(v3_length(d->to_sun) - 1.0f) <= 1e-3f))
        return failed(err, ERR_ARGUMENT, "Perez sky: a direction to the sun of length %g, wanted 1",
                      (double)v3_length(d->to_sun));
    if (!(d->direct_normal >= 0.0 && d->direct_normal <= 2000.0))
        return failed(err, ERR_ARGUMENT, "Perez sky: a direct normal of %g W/m^2, wanted 0 to 2000",
                      d->direct_normal);
    if (!(d->diffuse_horizontal > 0.0 && d->diffuse_horizontal <= 2000.0))
        return failed(err, ERR_ARGUMENT,
                      "Perez sky: a diffuse horizontal of %g W/m^2, wanted above 0, to 2000",
                      d->diffuse_horizontal);
    if (!isnan(d->dew_point_c) && !(d->dew_point_c >= -100.0 && d->dew_point_c <= 50.0))
        return failed(err, ERR_ARGUMENT, "Perez sky: a dew point of %g C, wanted -100 to 50",
                      d->dew_point_c);
    if (!(d->distance_au >= 0.9 && d->distance_au <= 1.1))
        return failed(err, ERR_ARGUMENT, "Perez sky: a sun %g au away, wanted 0.9 to 1.1",
                      d->distance_au);
    return true;
}

/* lx of both */
static void illuminances(const perez_desc *d, const weather *w, perez_figures *f)
{
    double dew      = isnan(d->dew_point_c) ? 11.0 : d->dew_point_c;
    double water    = exp(0.07 * dew - 0.075);
    const double *s = of_diffuse[w->bin], *b = of_direct[w->bin];
    double sky_efficacy = s[0] + s[1] * water + s[2] * cos(w->zenith) + s[3] * log(w->delta);
    double beam_efficacy =
        b[0] + b[1] * water + b[2] * exp(5.73 * w->zenith - 5.0) + b[3] * w->delta;
    f->diffuse_lx       = d->diffuse_horizontal * fmax(sky_efficacy, 0.0);
    f->direct_normal_lx = d->direct_normal * fmax(beam_efficacy, 0.0);
}

const sky *sky_perez(arena *a, const perez_desc *d, perez_figures *out, lux_error *err)
{
    if (!is_good(d, err))
        return NULL;
    double level    = hypot((double)d->to_sun.x, (double)d->to_sun.y);
    weather w       = weather_of(d, atan2(level, (double)d->to_sun.z));
    bool clamped    = w.shape_delta != w.brightness;
    gradation g     = shape_of(&w, &clamped);
    perez_figures f = { .clearness = w.clearness, .brightness = w.brightness, .clamped = clamped };
    illuminances(d, &w, &f);
    if (out)
        *out = f;
    return gradation_sky(a,
                         &(gradation_desc){ .what       = "Perez sky",
                                            .shape      = g,
                                            .to_sun     = d->to_sun,
                                            .horizontal = f.diffuse_lx / LUMENS_PER_WATT,
                                            .color      = d->color,
                                            .columns    = 256,
                                            .rows       = 128 },
                         err);
}
