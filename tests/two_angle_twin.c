/* tests/two_angle_twin.c -- see two_angle_twin.h. */
#include "tests/two_angle_twin.h"

#include <math.h>

static const double pi = 3.14159265358979324;

vec3 angle_twin_sun(double elevation_deg)
{
    double h = elevation_deg * pi / 180, c = elevation_deg == 90 ? 0 : cos(h);
    return (vec3){ (float)(0.6 * c), (float)(-0.8 * c), (float)sin(h) };
}

double angle_twin_at(const angle_twin *t, const double w[3])
{
    const double *s = t->sun;
    double x = w[1] * s[2] - w[2] * s[1], y = w[2] * s[0] - w[0] * s[2],
           z   = w[0] * s[1] - w[1] * s[0];
    double dot = w[0] * s[0] + w[1] * s[1] + w[2] * s[2];
    double chi = atan2(sqrt(x * x + y * y + z * z), dot);
    if (w[2] < 0)
        return 0;
    double g = t->a == 0 ? 1 : w[2] > 0 ? 1 + t->a * exp(t->b / w[2]) : 1;
    double f = t->f0 + t->c * exp(t->d * chi) + t->e * cos(chi) * cos(chi);
    return fmax(g * f, 0);
}

double angle_twin_level(const angle_twin *t, int rings)
{
    double sum = 0;
    for (int i = 0; i < rings; i++)
        for (int j = 0; j < 2 * rings; j++) {
            double r = sqrt((i + 0.5) / rings), phi = pi * (j + 0.5) / rings;
            double way[3] = { r * cos(phi), r * sin(phi), sqrt(1 - r * r) };
            sum += angle_twin_at(t, way);
        }
    return sum * pi / (2.0 * rings * rings);
}

double sky_green(const sky *s, vec3 way)
{
    vvec3 wi = vspread(way);
    return (double)lane(sky_radiance(s, &wi, ALL_LANES).y, 0);
}

double sky_on_tilted(const sky *s, double tilt_deg, int rows)
{
    double tilt = tilt_deg * pi / 180, nx = sin(tilt), nz = cos(tilt), sum = 0;
    for (int i = 0; i < rows; i++)
        for (int j = 0; j < 2 * rows; j += LANES) {
            float x[LANES], y[LANES], z[LANES];
            double cosine[LANES];
            for (int k = 0; k < LANES; k++) {
                double theta = pi * (i + 0.5) / rows, phi = pi * (j + k + 0.5) / rows;
                x[k]      = (float)(sin(theta) * cos(phi));
                y[k]      = (float)(sin(theta) * sin(phi));
                z[k]      = (float)cos(theta);
                cosine[k] = fmax(nx * (double)x[k] + nz * (double)z[k], 0) * sin(theta);
            }
            vvec3 wi = { vload(x), vload(y), vload(z) };
            vrgb l   = sky_radiance(s, &wi, ALL_LANES);
            for (int k = 0; k < LANES; k++)
                sum += cosine[k] * (double)lane(l.y, k);
        }
    return sum * (pi / rows) * (pi / rows);
}
