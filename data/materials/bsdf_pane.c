/* data/materials/bsdf_pane.c -- double glazing in closed form, for each polarisation:
 *
 *     one border   R = ((n cos_i - cos_t) / (n cos_i + cos_t))^2, likewise with n at the other
 * cosine one pane     a = clear^(1 / cos_t) T = (1 - R)^2 a / (1 - R^2 a^2) r = R + R a T two panes
 * T = T1 T2 / (1 - r1 r2) r = r1 + T1^2 r2 / (1 - r1 r2)
 *
 * All passages to and fro are added up (Born & Wolf, Principles of Optics, 7.6, without
 * interference).
 */
#include "data/materials/bsdf_models.h"

#include <math.h>
#include <string.h>

pane_share pane_of(double n, double clear, double cos_in)
{
    double cos_t       = sqrt(1.0 - (1.0 - cos_in * cos_in) / (n * n));
    double a           = pow(clear, 1.0 / cos_t);
    const double up[2] = { cos_in - n * cos_t, n * cos_in - cos_t };
    const double in[2] = { cos_in + n * cos_t, n * cos_in + cos_t };
    pane_share p;
    for (int i = 0; i < 2; i++) {
        double border  = up[i] / in[i] * (up[i] / in[i]);
        p.passed[i]    = (1.0 - border) * (1.0 - border) * a / (1.0 - border * border * a * a);
        p.reflected[i] = border + border * a * p.passed[i];
    }
    return p;
}

pane_share pane_behind_pane(pane_share outer, pane_share inner)
{
    pane_share p;
    for (int i = 0; i < 2; i++) {
        double to_and_fro = 1.0 / (1.0 - outer.reflected[i] * inner.reflected[i]);
        p.passed[i]       = outer.passed[i] * inner.passed[i] * to_and_fro;
        p.reflected[i]    = outer.reflected[i] +
                         outer.passed[i] * outer.passed[i] * inner.reflected[i] * to_and_fro;
    }
    return p;
}

void model_glazing(bsdf_model *m)
{
    static const double index = 1.53, clear = 0.964; /* 6 mm of clear float glass */
    memset(m, 0, sizeof *m);
    m->name = "Double clear glazing, 6 mm";
    for (int cell = 0; cell < FULL_CELLS; cell++) {
        double passed = 0.0, reflected = 0.0;
        for (int i = 0; i < FULL_SAMPLES; i++) {
            double way[3];
            full_sample(cell, i, 0, way);
            pane_share pane = pane_of(index, clear, way[2]);
            pane_share both = pane_behind_pane(pane, pane);
            passed += 0.5 * (both.passed[0] + both.passed[1]) / FULL_SAMPLES;
            reflected += 0.5 * (both.reflected[0] + both.reflected[1]) / FULL_SAMPLES;
        }
        for (int side = 0; side < 2; side++) {
            m->transmission[side][cell][cell] = passed / full_area(cell);
            m->reflection[side][cell][cell]   = reflected / full_area(cell);
        }
    }
}
