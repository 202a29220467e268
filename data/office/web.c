/* data/office/web.c -- see web.h.
 *
 * Panel: I(C, g) = I0 cos(g)^3 (1 + b(C) sin(g)^2),  b(C) = 4 cos(C)^2 + 0.5 sin(C)^2
 *     a batwing of 1.3 I0 at 30 degrees across the lenses (C0), narrow along them (C90);
 *     its flux is 2 pi I0 (1/4 + B/12), B = 2.25 the mean of b.
 * Downlight: I(g) = I0 cos(g)^4, its flux is 2 pi I0 / 5.
 *
 * A reader joins the angles by straight lines, which loses up to 0.05 % of this flux at steps of
 * 2.5 degrees: I0 is that which gives the flux stated to the joined-up web.
 */
#include "data/office/web.h"

#include <math.h>

#define PI 3.14159265358979323846

enum { RINGS = 37, PLANES = 24, STORED = 7 }; /* gamma 0..90; C 0..345, of which C0..C90 stored */

static double ring_deg(int i) { return 2.5 * i; }

static double panel_form(double c_deg, double gamma_deg)
{
    const double cc = cos(c_deg * PI / 180.0), cg = cos(gamma_deg * PI / 180.0);
    const double b = 0.5 + 3.5 * cc * cc;
    return cg * cg * cg * (1.0 + b * (1.0 - cg * cg));
}

static double downlight_form(double gamma_deg)
{
    const double cg = cos(gamma_deg * PI / 180.0);
    return cg * cg * cg * cg;
}

/* The flux, per radian of C, of an intensity that runs straight from a to b between two angles:
 * the integral of I(g) sin(g) by parts. */
static double band(double a, double b, double from_deg, double to_deg)
{
    const double g0 = from_deg * PI / 180.0, g1 = to_deg * PI / 180.0;
    return a * cos(g0) - b * cos(g1) + (b - a) / (g1 - g0) * (sin(g1) - sin(g0));
}

/* Planes at even steps: b(C) goes with cos(2C), whose mean over them is exact. */
static double panel_flux(void)
{
    double sum = 0.0;
    for (int p = 0; p < PLANES; p++)
        for (int i = 0; i + 1 < RINGS; i++)
            sum += band(panel_form(15.0 * p, ring_deg(i)), panel_form(15.0 * p, ring_deg(i + 1)),
                        ring_deg(i), ring_deg(i + 1));
    return sum * 2.0 * PI / PLANES;
}

static double downlight_flux(void)
{
    double sum = 0.0;
    for (int i = 0; i + 1 < RINGS; i++)
        sum += band(downlight_form(ring_deg(i)), downlight_form(ring_deg(i + 1)), ring_deg(i),
                    ring_deg(i + 1));
    return sum * 2.0 * PI;
}

double panel_web(double c_deg, double gamma_deg)
{
    return panel_form(c_deg, gamma_deg) / panel_flux();
}

double downlight_web(double gamma_deg) { return downlight_form(gamma_deg) / downlight_flux(); }

/* One value a line, as EULUMDAT wants; readers count lines. */
bool panel_write(FILE *to)
{
    fprintf(to, "computed from a closed form for the lux4 office; not a product\r\n");
    fprintf(to, "3\r\n4\r\n%d\r\n15\r\n%d\r\n2.5\r\n", PLANES, RINGS);
    fprintf(to, "none\r\nPanel 600 x 600 with linear lenses\r\nlux4 panel\r\npanel.ldt\r\n"
                "make_office\r\n");
    fprintf(to, "600\r\n600\r\n30\r\n530\r\n530\r\n0\r\n0\r\n0\r\n0\r\n"); /* mm */
    fprintf(to, "100\r\n100\r\n1\r\n0\r\n1\r\n"); /* DFF, LORL, factor, tilt, one set of lamps */
    fprintf(to, "1\r\nLED\r\n%.0f\r\n4000 K\r\n1B\r\n43\r\n", PANEL_LUMENS);
    for (int i = 0; i < 10; i++)
        fprintf(to, "0\r\n"); /* direct ratios: not given */
    for (int p = 0; p < PLANES; p++)
        fprintf(to, "%d\r\n", 15 * p);
    for (int i = 0; i < RINGS; i++)
        fprintf(to, "%g\r\n", ring_deg(i));
    for (int p = 0; p < STORED; p++)
        for (int i = 0; i < RINGS; i++)
            fprintf(to, "%.2f\r\n", 1000.0 * panel_web(15.0 * p, ring_deg(i)) + 1e-9);
    return !ferror(to);
}

static void end_row(FILE *to, int i) { fprintf(to, i % 10 == 9 || i == RINGS - 1 ? "\r\n" : " "); }

bool downlight_write(FILE *to)
{
    fprintf(to, "IESNA:LM-63-2002\r\n"
                "[TEST] none\r\n"
                "[TESTLAB] computed from a closed form for the lux4 office; not a product\r\n"
                "[ISSUEDATE] 2026-01-01\r\n"
                "[MANUFAC] none\r\n"
                "[LUMCAT] lux4 downlight\r\n"
                "[LUMINAIRE] Round recessed downlight, 170 mm, I = I0 cos^4\r\n"
                "TILT=NONE\r\n");
    fprintf(to, "1 -1 1 %d 1 1 2 -0.17 -0.17 0\r\n1 1 18\r\n", RINGS);
    for (int i = 0; i < RINGS; i++) {
        fprintf(to, "%g", ring_deg(i));
        end_row(to, i);
    }
    fprintf(to, "0\r\n");
    for (int i = 0; i < RINGS; i++) {
        fprintf(to, "%.2f", DOWNLIGHT_LUMENS * downlight_web(ring_deg(i)) + 1e-9);
        end_row(to, i);
    }
    return !ferror(to);
}
