/* data/office/room_parts.c -- see parts.h: the meeting corner, shelves, and what stands about. */
#include "data/office/parts.h"

#include <math.h>

#define RAD (3.14159265358979323846 / 180.0)

shape meeting_table(double detail)
{
    static const double top[][2] = {
        { 0, 0.690 }, { 0.58, 0.690 }, { 0.60, 0.705 }, { 0.60, 0.72 }, { 0, 0.72 }
    };
    static const double foot[][2] = { { 0, 0.001 },    { 0.32, 0.001 }, { 0.32, 0.012 },
                                      { 0.05, 0.035 }, { 0.04, 0.694 }, { 0, 0.694 } };
    shape s                       = shape_new("Meeting table", detail);
    s.ink                         = WOOD;
    add_lathe(&s, &(lathe){ top, COUNT(top), 28, false });
    s.ink = METAL;
    add_lathe(&s, &(lathe){ foot, COUNT(foot), 14, false });
    s.ink = PAPER;
    shape_at(&s, (point){ 0.22, -0.25, 0.72 }, 25.0, 0.0);
    add_box(&s, (point){ -0.105, -0.148, -0.002 }, (point){ 0.105, 0.148, 0.004 });
    return s;
}

/* A flat sheet along y becomes seat and back, with rounded ends: it turns up behind y = -0.1. */
static void shell_warp(point *p)
{
    const double radius = 0.14, start = -0.10, bend = 78.0 * RAD;
    const double thick = p->z;
    const double along = (start - p->y) / radius; /* rad around the bend */
    const double end   = pow((p->y + 0.17) / 0.39, 6.0);
    p->x *= 1.0 - 0.3 * end;
    p->z += 0.45 * p->x * p->x;
    if (along <= 0.0)
        return;
    const double a = fmin(along, bend), rest = (along - a) * radius;
    const double r = radius - thick - 0.9 * p->x * p->x;
    p->y           = start - r * sin(a) - rest * cos(a);
    p->z           = radius - r * cos(a) + rest * sin(a);
}

shape meeting_chair(double detail)
{
    static const double x[] = { -0.225, -0.13, 0.13, 0.225 };
    static const double y[] = { -0.56, -0.50, -0.38, -0.29, -0.23, -0.17, -0.10, 0.13, 0.22 };
    shape s                 = shape_new("Meeting chair", detail);
    s.ink                   = METAL;
    for (int i = 0; i < 4; i++) {
        const double a = i & 1 ? 1 : -1, b = i & 2 ? 1 : -1;
        const point leg[] = { { a * 0.10, b * 0.09 + 0.02, 0.425 },
                              { a * 0.235, b * 0.215 + 0.02, 0.001 } };
        add_tube(&s, &(tube){ leg, 2, 3, 0.014, 0.009 });
    }
    s.ink  = SEAT;
    s.warp = shell_warp;
    shape_at(&s, (point){ 0, 0, 0.43 }, 0.0, 0.0);
    add_plate(&s,
              &(plate){ 2, COUNT(x), COUNT(y), x, y, "########################", -0.006, 0.006 });
    s.warp = NULL;
    return s;
}

/* ---- shelves ------------------------------------------------------------------------------ */

/* Books from y = a to b on the board at z, backs flush within a centimetre or so. */
static void book_row(shape *s, double a, double b, double z, uint32_t *seed)
{
    const double end = a + (b - a) * (0.40 + 0.55 * draw(seed));
    for (double y = a; y < end - 0.075;) {
        const double thick = 0.055 + 0.058 * draw(seed), tall = 0.20 + 0.10 * draw(seed);
        const double deep = 0.17 + 0.07 * draw(seed);
        s->ink            = BOOK_RED + (int)(draw(seed) * 6.0);
        add_box(s, (point){ -0.31, y, z - 0.002 }, (point){ -0.31 + deep, y + thick, z + tall });
        y += thick + 0.0015;
    }
}

shape bookshelf(double detail, uint32_t seed)
{
    static const double y[] = { -0.45, -0.43, 0.43, 0.45 };
    static const double z[] = { 0.001, 0.08, 0.10, 0.46, 0.48, 0.84, 0.86, 1.22, 1.24, 1.60, 1.62 };
    shape s                 = shape_new("Bookshelf", detail);

    /* Sides, boards and plinth in one raster; the back is a plate of its own */
    s.ink = WOOD;
    add_plate(&s, &(plate){ 0, 4, COUNT(z), y, z,
                            "######" /* plinth, lowest board */
                            "# ####"
                            "# ####"
                            "# ####"
                            "# ####",
                            -0.34, -0.008 });
    add_box(&s, (point){ -0.012, -0.44, 0.05 }, (point){ -0.001, 0.44, 1.61 });
    for (int i = 0; i < 4; i++)
        book_row(&s, -0.425, 0.425, z[2 + 2 * i], &seed);
    return s;
}

/* ---- what stands or hangs about -------------------------------------------------------- */

shape coat_stand(double detail)
{
    static const double pole[][2] = { { 0, 0.001 },    { 0.19, 0.001 }, { 0.19, 0.015 },
                                      { 0.02, 0.035 }, { 0.018, 1.74 }, { 0, 1.77 } };
    shape s                       = shape_new("Coat stand", detail);
    s.ink                         = DARK_METAL;
    add_lathe(&s, &(lathe){ pole, COUNT(pole), 10, false });
    for (int i = 0; i < 5; i++) {
        static const point hook[] = { { 0, 0, 1.60 }, { 0.12, 0, 1.60 }, { 0.15, 0, 1.70 } };
        shape_at(&s, (point){ 0, 0, i % 2 * 0.05 }, 72.0 * i, 0.0);
        add_tube(&s, &(tube){ hook, COUNT(hook), 4, 0.009, 0.011 });
    }
    return s;
}

/* A leaf along +x: it rises, then hangs over; folded along its middle. */
static void leaf_warp(point *p)
{
    const double x = p->x;
    p->y *= 1.0 - 0.5 * x * x;
    p->z += 0.95 * x - 1.25 * x * x + 0.35 * fabs(p->y);
}

shape plant(double detail)
{
    static const double pot[][2]  = { { 0, 0.001 },   { 0.15, 0.001 }, { 0.205, 0.40 },
                                      { 0.19, 0.40 }, { 0.17, 0.30 },  { 0, 0.30 } };
    static const double soil[][2] = { { 0, 0.25 }, { 0.15, 0.25 }, { 0.182, 0.345 }, { 0, 0.36 } };
    shape s                       = shape_new("Plant", detail);
    uint32_t seed                 = 5;
    s.ink                         = POT;
    add_lathe(&s, &(lathe){ pot, COUNT(pot), 14, false });
    s.ink = SOIL;
    add_lathe(&s, &(lathe){ soil, COUNT(soil), 10, false });

    s.ink = LEAF;
    for (int i = 0; i < 11; i++) {
        const double turn = i * 137.5, size = 0.34 + 0.14 * draw(&seed);
        const double root = 0.36 + 0.066 * i, x = 0.012 * cos(turn * RAD);
        s.warp = leaf_warp;
        shape_at(&s, (point){ x, 0.012 * sin(turn * RAD), root }, turn, 0.0);
        add_cushion(&s, &(cushion){ .centre     = { 0.5 * size + 0.02, 0, 0 },
                                    .half       = { 0.5 * size, 0.062, 0.003 },
                                    .squareness = 1.0,
                                    .edge       = 1.0,
                                    .segments   = 8,
                                    .rings      = 3 });
    }
    s.warp                    = NULL;
    static const point stem[] = { { 0, 0, 0.33 }, { 0.01, 0.005, 0.8 }, { 0, 0, 1.2 } };
    shape_at(&s, (point){ 0 }, 0.0, 0.0);
    add_tube(&s, &(tube){ stem, COUNT(stem), 4, 0.016, 0.006 });
    return s;
}

shape column(double detail)
{
    shape s = shape_new("Column", detail);
    s.ink   = CONCRETE;
    add_cylinder(&s, (point){ 0, 0, -0.05 }, 0.18, 3.1, 28);
    return s;
}

shape radiator(double detail)
{
    shape s = shape_new("Radiator", detail);
    s.ink   = PAINT;
    add_box(&s, (point){ -0.80, -0.03, 0.15 }, (point){ 0.80, 0.03, 0.65 });
    for (int i = 0; i < 5; i++) {
        const double x = -0.62 + 0.31 * i;
        add_box(&s, (point){ x - 0.14, -0.042, 0.17 }, (point){ x + 0.14, -0.025, 0.63 });
    }
    for (int i = 0; i < 2; i++)
        add_box(&s, (point){ i ? 0.60 : -0.62, 0.02, 0.30 },
                (point){ i ? 0.62 : -0.60, 0.125, 0.50 });
    return s;
}

shape whiteboard(double detail)
{
    static const double x[] = { -1.0, -0.98, 0.98, 1.0 }, z[] = { 0.95, 0.97, 2.03, 2.05 };
    shape s = shape_new("Whiteboard", detail);
    s.ink   = METAL;
    add_plate(&s, &(plate){ 1, 4, 4, x, z, "#### ####", -0.003, 0.025 });
    add_box(&s, (point){ -0.3, 0.02, 0.955 }, (point){ 0.3, 0.08, 0.965 });
    s.ink = BOARD;
    add_box(&s, (point){ -0.985, -0.002, 0.965 }, (point){ 0.985, 0.018, 2.035 });
    return s;
}

shape wall_clock(double detail)
{
    shape s = shape_new("Clock", detail);
    shape_at(&s, (point){ 0 }, 90.0, 90.0); /* local z to +x */
    s.ink = BLACK;
    add_cylinder(&s, (point){ 0, 0, -0.003 }, 0.15, 0.02, 16);
    add_box(&s, (point){ -0.006, -0.02, 0.022 }, (point){ 0.006, 0.11, 0.029 });
    add_box(&s, (point){ -0.015, -0.008, 0.021 }, (point){ 0.075, 0.008, 0.027 });
    s.ink = PAPER;
    add_cylinder(&s, (point){ 0, 0, -0.002 }, 0.138, 0.026, 16);
    return s;
}
