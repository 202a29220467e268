/* data/glass/pictures.c -- see glass.h: woods, tiles and paper, as they go over and over a surface.
 *
 * All repeat without a seam. Colours are sRGB.
 */
#include "data/glass/glass.h"

#include <math.h>

typedef struct rgb {
    double r, g, b;
} rgb;

static double ramp(double a, double b, double x) { return fmin(fmax((x - a) / (b - a), 0.0), 1.0); }

static void put(double c[4], rgb a, rgb b, double t)
{
    c[0] = a.r + (b.r - a.r) * t;
    c[1] = a.g + (b.g - a.g) * t;
    c[2] = a.b + (b.b - a.b) * t;
}

/* Fewer shades than 256: nobody sees them, and files are smaller. */
static double shades(double x, int count) { return floor(x * count + 0.5) / count; }

/* Long streaks along u, with rings that lie aslant here and there. */
static double grain(double u, double v, uint32_t seed)
{
    const double bend = clouds(2.0 * u, 4.0 * v, 2, seed);
    const double ring = fabs(2.0 * fraction(16.0 * v + 4.0 * bend) - 1.0);
    return 0.55 * clouds(4.0 * u, 64.0 * v, 4, seed + 9) + 0.45 * ring * ring;
}

/* ---- woods -------------------------------------------------------------------------------- */

/* Eight boards along u, each joined to the next somewhere; each darker or lighter as a whole. */
static void planks(double u, double v, double c[4])
{
    const int board    = (int)(v * 8.0);
    const double along = fraction(u + 0.37 * board), across = fraction(v * 8.0);
    const double tone  = noise(board + 0.5, along < 0.55 ? 0.5 : 1.5, 8, 3);
    const double gap   = fmin(fmin(across, 1.0 - across) / 8.0, fmin(along, fabs(along - 0.55)));
    const double light = shades(0.65 * grain(u, v, (uint32_t)board) + 0.5 * tone, 24);
    put(c, (rgb){ 0.70, 0.52, 0.35 }, (rgb){ 0.44, 0.28, 0.16 }, light);
    if (gap < 0.0025)
        put(c, (rgb){ 0.20, 0.13, 0.08 }, (rgb){ 0 }, 0.0);
}
const picture picture_planks = { "planks", 512, 512, false, planks };

static void oak(double u, double v, double c[4])
{
    put(c, (rgb){ 0.78, 0.60, 0.40 }, (rgb){ 0.52, 0.35, 0.20 }, shades(grain(u, v, 77), 24));
}
const picture picture_oak = { "oak", 256, 256, false, oak };

/* ---- tiles -------------------------------------------------------------------------------- */

#define JOINT 0.018 /* of the picture, half a joint between two tiles */
#define EDGE  0.030 /* the rounding of a tile */

/* Two tiles by two; the distance from the nearest joint along one axis, signed to its middle. */
static double from_joint(double x)
{
    const double t = fraction(2.0 * x) * 0.5;
    return t < 0.25 ? t : t - 0.5;
}

static void tiles(double u, double v, double c[4])
{
    const double a = from_joint(u), b = from_joint(v), d = fmin(fabs(a), fabs(b));
    const int which = (int)(2.0 * u) + 2 * (int)(2.0 * v);
    const double x = fabs(a) - 0.25, y = fabs(b) - 0.25, r = sqrt(x * x + y * y);
    const double cloud = shades(clouds(4.0 * u, 4.0 * v, 4, 21), 12);
    put(c, (rgb){ 0.82, 0.86, 0.86 }, (rgb){ 0.66, 0.77, 0.79 }, cloud);
    if ((which == 0 || which == 3) && (fabs(r - 0.13) < 0.012 || r < 0.05)) /* an ornament */
        put(c, (rgb){ 0.16, 0.32, 0.50 }, (rgb){ 0 }, 0.0);
    if (d < JOINT)
        put(c, (rgb){ 0.62, 0.60, 0.57 }, (rgb){ 0 }, 0.0);
}
const picture picture_tiles = { "tiles", 256, 256, false, tiles };

/* The slope at an edge: it rises from the joint as a quarter circle does, cut off where steep. */
static double slope(double from)
{
    const double d = fabs(from) - JOINT, t = 1.0 - d / EDGE;
    if (d <= 0.0 || d >= EDGE)
        return 0.0;
    return copysign(fmin(t / sqrt(1.0 - t * t), 1.2), from);
}

/* x of the normal to the right, y up, z out of the wall. */
static void tiles_relief(double u, double v, double c[4])
{
    const double x = -slope(from_joint(u)), y = slope(from_joint(v));
    const double l = sqrt(1.0 + x * x + y * y);
    c[0]           = 0.5 + 0.5 * x / l;
    c[1]           = 0.5 + 0.5 * y / l;
    c[2]           = 0.5 + 0.5 / l;
}
const picture picture_tiles_relief = { "tiles, normals", 256, 256, false, tiles_relief };

/* ---- paper, cloth ------------------------------------------------------------------------- */

/* Leaves on stems in two rows, the second half a step further. */
static void wallpaper(double u, double v, double c[4])
{
    const double x = fraction(2.0 * u), y = fraction(2.0 * v + (u < 0.5 ? 0.0 : 0.5));
    const double stem = fabs(x - 0.5 - 0.06 * sin(6.283185307179586 * y));
    const double side = fabs(x - 0.5), lean = fraction(3.0 * y - 2.2 * side) - 0.5;
    const bool leaf =
        side > 0.03 && side < 0.30 && fabs(lean) < 0.30 * sin(3.14159265 * side / 0.30);
    put(c, (rgb){ 0.86, 0.83, 0.74 }, (rgb){ 0.83, 0.80, 0.71 },
        fraction(32.0 * u) < 0.5 ? 0.0 : 1.0);
    if (leaf || stem < 0.014)
        put(c, (rgb){ 0.62, 0.67, 0.55 }, (rgb){ 0.54, 0.61, 0.50 }, leaf ? 0.0 : 1.0);
}
const picture picture_wallpaper = { "wallpaper", 256, 256, false, wallpaper };

/* Stripes of two colours, woven. */
static void fabric(double u, double v, double c[4])
{
    const bool warp = (int)(u * 32.0) % 2 == (int)(v * 32.0) % 2;
    const bool dark = fraction(warp ? u * 2.0 : v * 2.0) < 0.35;
    put(c, (rgb){ 0.62, 0.20, 0.16 }, (rgb){ 0.16, 0.18, 0.30 }, dark ? 1.0 : 0.0);
    if (fraction(u * 2.0 + 0.3) < 0.06 || fraction(v * 2.0 + 0.3) < 0.06)
        put(c, (rgb){ 0.90, 0.84, 0.66 }, (rgb){ 0 }, 0.0);
}
const picture picture_fabric = { "fabric", 128, 128, false, fabric };

/* A net with flowers: what is not thread has alpha 0. */
static void lace(double u, double v, double c[4])
{
    const double a = fraction(12.0 * (u + v)), b = fraction(12.0 * (u - v));
    const double x = fraction(2.0 * u) - 0.5, y = fraction(2.0 * v + (u < 0.5 ? 0.0 : 0.5)) - 0.5;
    const double r = sqrt(x * x + y * y), turn = r > 0.0 ? x / r : 1.0;
    const double t     = 4.0 * turn * turn - 3.0; /* cos(3 a) = (4 cos(a)^2 - 3) cos(a) */
    const double petal = 0.20 + 0.12 * fabs(t * turn);
    const bool flower  = (r < petal && r > 0.12) || r < 0.06 || fabs(r - petal - 0.05) < 0.018;
    const bool net     = a < 0.24 || b < 0.24;
    c[0] = c[1] = 0.95;
    c[2]        = 0.92;
    c[3]        = flower || net ? 1.0 : 0.0;
}
const picture picture_lace = { "lace", 256, 256, true, lace };

/* A blue border and waves; u goes around eight times, v from the rim down. */
static void china(double u, double v, double c[4])
{
    const double wave = 0.5 + 0.10 * sin(6.283185307179586 * u);
    const bool line   = fabs(v - wave) < 0.02 || (v > 0.04 && v < 0.10) || fabs(v - 0.85) < 0.015;
    const double x = fraction(u + 0.25) - 0.5, y = (v - 0.30) * 1.6;
    put(c, (rgb){ 0.90, 0.90, 0.87 }, (rgb){ 0.12, 0.22, 0.50 },
        line || x * x + y * y < 0.012 ? 1.0 : 0.0);
}
const picture picture_china = { "china", 128, 256, false, china };

/* A dozen spines side by side, with bands and a title; the tops of the books are cut paper. */
static void books(double u, double v, double c[4])
{
    static const rgb colors[] = { { 0.55, 0.13, 0.11 }, { 0.13, 0.24, 0.42 }, { 0.14, 0.36, 0.24 },
                                  { 0.72, 0.55, 0.25 }, { 0.82, 0.79, 0.70 }, { 0.12, 0.12, 0.14 },
                                  { 0.42, 0.20, 0.34 } };
    const int book            = (int)(u * 12.0);
    const double x = fraction(u * 12.0), y = fraction(v + 0.083 * book);
    const rgb cloth   = colors[book * 5 % COUNT(colors)];
    const bool gilded = fabs(y - 0.12) < 0.012 || fabs(y - 0.88) < 0.012 || fabs(y - 0.16) < 0.005;
    const bool title  = x > 0.3 && x < 0.7 && y > 0.28 && y < 0.62 && fraction(y * 40.0) < 0.6 &&
                       noise(x * 9.0, y * 40.0, 64, (uint32_t)book) > 0.42;
    const double edge = ramp(0.0, 0.18, fmin(x, 1.0 - x));
    put(c, (rgb){ 0.4 * cloth.r, 0.4 * cloth.g, 0.4 * cloth.b }, cloth, shades(edge, 8));
    if ((gilded || title) && edge > 0.5)
        put(c, (rgb){ 0.86, 0.74, 0.42 }, (rgb){ 0 }, 0.0);
}
const picture picture_books = { "books", 256, 256, false, books };
