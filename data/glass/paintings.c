/* data/glass/paintings.c -- see glass.h: what hangs on the wall, and the carpet. */
#include "data/glass/glass.h"

#include <math.h>

static void set(double c[4], double r, double g, double b)
{
    c[0] = r;
    c[1] = g;
    c[2] = b;
}

/* ---- pictures ----------------------------------------------------------------------------- */

/* An evening: four ridges before a sun, the near ones darker. */
static void hills(double u, double v, double c[4])
{
    const double x = (u - 0.66) * 1.3, y = v - 0.42;
    set(c, 0.98 - 0.10 * v, 0.62 + 0.25 * v, 0.40 - 0.1 * v + 0.3 * (1.0 - v) * (1.0 - v));
    if (x * x + y * y < 0.012)
        set(c, 1.0, 0.93, 0.70);
    for (int i = 0; i < 4; i++) {
        const double ridge = 0.48 + 0.13 * i - 0.22 * (clouds(u * 3.0, i + 0.5, 16, 5) - 0.4);
        if (v > ridge)
            set(c, 0.50 - 0.12 * i, 0.36 - 0.07 * i, 0.46 - 0.09 * i);
    }
}
const picture picture_hills = { "hills", 256, 192, false, hills };

/* Black bars between fields of plain colours. */
static void blocks(double u, double v, double c[4])
{
    static const double x[]   = { 0.0, 0.18, 0.62, 0.85, 1.01 },
                        y[]   = { 0.0, 0.30, 0.55, 0.88, 1.01 };
    static const char color[] = "wrww"
                                "wwwb"
                                "ywww"
                                "wwrw";
    int i = 0, j = 0;
    while (u >= x[i + 1])
        i++;
    while (v >= y[j + 1])
        j++;
    const double bar = fmin(fmin(u - x[i], x[i + 1] - u), fmin(v - y[j], y[j + 1] - v));
    const char k     = color[4 * j + i];
    if (bar < 0.012)
        set(c, 0.06, 0.06, 0.07);
    else if (k == 'w')
        set(c, 0.93, 0.92, 0.88);
    else
        set(c, k == 'b' ? 0.10 : 0.85,
            k == 'b'   ? 0.20
            : k == 'y' ? 0.70
                       : 0.12,
            k == 'b' ? 0.55 : 0.10);
}
const picture picture_blocks = { "blocks", 192, 256, false, blocks };

/* Rings about three middles; where they cross, colours change places. */
static void rings(double u, double v, double c[4])
{
    static const double at[][2] = { { 0.32, 0.36 }, { 0.70, 0.42 }, { 0.47, 0.74 } };
    int count                   = 0;
    for (int i = 0; i < 3; i++) {
        const double x = u - at[i][0], y = v - at[i][1], r = sqrt(x * x + y * y);
        count += r < 0.34 && fraction(r * 12.0) < 0.5;
    }
    static const double colors[][3] = {
        { 0.91, 0.88, 0.80 }, { 0.14, 0.45, 0.52 }, { 0.90, 0.52, 0.18 }, { 0.35, 0.12, 0.25 }
    };
    set(c, colors[count][0], colors[count][1], colors[count][2]);
}
const picture picture_rings = { "rings", 256, 256, false, rings };

/* ---- the carpet --------------------------------------------------------------------------- */

/* A star of eight points of that size about the origin: two squares, one on its corner. */
static bool star(double x, double y, double size)
{
    const double a = fabs(x), b = fabs(y);
    return (a < size && b < size) || a + b < 1.4142135623730951 * size;
}

/* The middle field, in halves of its sides: a great medallion in a field of small stars. */
static void field(double x, double y, double c[4])
{
    const double r = fabs(x) * 0.75 + fabs(y);
    const double u = fraction(x * 5.0 + 0.5) - 0.5, v = fraction(y * 4.0 + 0.5) - 0.5;
    set(c, 0.50, 0.10, 0.10);
    if (star(u, v, 0.20))
        set(c, 0.78, 0.62, 0.36);
    if (star(u, v, 0.10))
        set(c, 0.10, 0.16, 0.32);
    if (r < 0.62)
        set(c, 0.10, 0.16, 0.32);
    if (r < 0.62 && (fabs(r - 0.55) < 0.02 || star(x * 1.1, y * 1.5, 0.26)))
        set(c, 0.80, 0.68, 0.45);
    if (star(x * 1.1, y * 1.5, 0.21))
        set(c, 0.55, 0.12, 0.11);
    if (star(x * 1.1, y * 1.5, 0.10))
        set(c, 0.84, 0.76, 0.58);
}

/* Knots are as wide as a pixel; borders run around at equal widths. */
static void carpet_at(double u, double v, double c[4])
{
    const double x = 2.0 * u - 1.0, y = 2.0 * v - 1.0;
    const double edge = fmin(1.4 * (1.0 - fabs(x)), 1.0 - fabs(y)); /* of half the shorter side */
    const double run  = fraction(16.0 * (1.0 - fabs(x) < (1.0 - fabs(y)) / 1.4 ? v * 0.75 : u));
    if (edge > 0.30)
        field(x, y, c);
    else if (edge > 0.27 || (edge > 0.05 && edge < 0.08))
        set(c, 0.80, 0.68, 0.45);
    else if (edge > 0.08)
        set(c, 0.10, 0.16, 0.32);
    else
        set(c, 0.42, 0.08, 0.09);
    if (edge > 0.08 && edge < 0.27 && star(run - 0.5, (edge - 0.175) * 4.2, 0.27))
        set(c, 0.62, 0.18, 0.13);
    if (edge > 0.08 && edge < 0.27 && star(run - 0.5, (edge - 0.175) * 4.2, 0.12))
        set(c, 0.86, 0.78, 0.60);
    const double wool = 0.94 + 0.12 * floor(4.0 * noise(u * 128.0, v * 128.0, 128, 8)) / 4.0;
    set(c, c[0] * wool, c[1] * wool, c[2] * wool);
}
const picture picture_carpet = { "carpet", 384, 288, false, carpet_at };
