/* sim/planck.h -- the colour of a glowing black body, as linear Rec. 709 of luminance 1.
 *
 * Chromaticity from 1000 to 15000 K: Krystek, "An algorithm to calculate correlated colour
 * temperature", Color Research & Application 10(1), 1985, in CIE 1960 (u, v), within 1e-4 of the
 * Planckian locus. Up to 25000 K: Kim et al., "Design of advanced color temperature control
 * system for HDTV applications", J. Korean Physical Society 41(6), 2002, in CIE 1931 (x, y).
 * To linear RGB by the primaries and the white D65 of ITU-R BT.709-6. What no display can show
 * (blue below 1900 K or so) is cut at 0 before the colour is scaled to luminance 1.
 */
#ifndef SIM_PLANCK_H
#define SIM_PLANCK_H

#include "core/vec3.h"

/* CIE 1931 chromaticity. False, and nothing written, outside [1000, 25000] K. */
bool planck_chromaticity(double kelvin, double *x, double *y);

/* Channels >= 0. False outside [1000, 25000] K. */
bool planck_color(double kelvin, vec3 *out);

/* rgb, each finite, scaled so that 0.2126 R + 0.7152 G + 0.0722 B = 1, below 0 cut. False if
 * nothing is left. */
bool rgb_scale_to_luminance_1(const double rgb[3], vec3 *out);

#endif
