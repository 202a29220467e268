/* materials/brdf_half.c -- what a table of half and difference angles gives back, by quadrature
 * over half vectors: with w_o fixed and w_i = 2 (w_o . h) h - w_o,
 *
 *     integral of f cos_i d(w_i) = integral of f cos_i 4 (w_o . h) d(h)
 *
 * Each interval of theta_h between two places is cut into steps of at most a degree, each with two
 * points of Gauss; each cell of azimuth into even ones. So narrow peaks, which tables of this kind
 * resolve to a hundredth of a degree, are never missed.
 */
#include "materials/brdf_parts.h"

static const double LARGEST_STEP = M_PI / 180.0;
enum { AZIMUTHS = 8 }; /* of a cell; a multiple of all widths */

/* Adds what a ring of h in one cell of azimuth gives, with `weight` sr for each point. */
static void add_points(const brdf *b, const vvec3 *wo, double theta, double phi_low,
                       double phi_step, double weight, double rgb[3])
{
    float cos_h = (float)cos(theta), sin_h = (float)sin(theta);
    for (int i = 0; i < AZIMUTHS; i += LANES) {
        vfloat phi  = (float)phi_low + (float)phi_step * (vto_float(i + vlane_index()) + 0.5f);
        vvec3 h     = { sin_h * vcos(phi), sin_h * vsin(phi), vsplat(cos_h) };
        vfloat cos  = vdot(*wo, h);
        vvec3 wi    = vsub(vscale(h, 2.0f * cos), *wo);
        vmask above = (cos > 0.0f) & (wi.z > 0.0f);
        vrgb f      = vbrdf_value(b, wo, &wi, above);
        vfloat part = vkeep(above, 4.0f * cos * wi.z);
        for (int k = 0; k < LANES; k++) { /* one by one: the same sum at every width */
            rgb[0] += weight * (double)lane(f.x, k) * (double)lane(part, k);
            rgb[1] += weight * (double)lane(f.y, k) * (double)lane(part, k);
            rgb[2] += weight * (double)lane(f.z, k) * (double)lane(part, k);
        }
    }
}

static void add_cell(const brdf *b, const vvec3 *wo, int row, int column, double rgb[3])
{
    double low = (double)b->axes[0].at[row], high = (double)b->axes[0].at[row + 1];
    int steps     = 1 + (int)((high - low) / LARGEST_STEP);
    double step   = (high - low) / steps;
    double offset = 0.5 * step / sqrt(3.0); /* Gauss, two points */
    double wide = 2.0 * M_PI / b->cells.phis, narrow = wide / AZIMUTHS;
    for (int i = 0; i < steps; i++) {
        double middle = low + (i + 0.5) * step;
        for (int side = -1; side <= 1; side += 2) {
            double theta = middle + side * offset;
            add_points(b, wo, theta, column * wide, narrow, 0.5 * step * narrow * sin(theta), rgb);
        }
    }
}

void brdf_half_node(const brdf *b, int node, double *cells, double rgb[3])
{
    double theta = (double)b->nodes.theta.at[node];
    vvec3 wo     = vspread((vec3){ (float)sin(theta), 0.0f, (float)fmax(cos(theta), 1e-6) });
    for (int row = 0; row < b->cells.thetas; row++) {
        for (int column = 0; column < b->cells.phis; column++) {
            double cell[3] = { 0 };
            add_cell(b, &wo, row, column, cell);
            cells[row * b->cells.phis + column] = (cell[0] + cell[1] + cell[2]) / 3.0;
            for (int k = 0; k < 3; k++)
                rgb[k] += cell[k];
        }
    }
}
