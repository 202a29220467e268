/* data/glass/room.c -- see glass.h: the closed shell, and what is on its walls.
 *
 *   y 4 +--- tiles, mirror, pictures ---+
 *       | books            | glass      |
 *       |      carpet                   |
 *   window     table                    |
 *       |                        camera |
 *     0 +-------------------------------+
 *       0                               5 x
 */
#include "data/glass/glass.h"

#include <math.h>

shape room_shell(void)
{
    static const double y[] = { -0.10, 1.0, 2.4, 4.10 }, z[] = { -0.09, 0.85, 2.25, 2.79 };
    shape s = shape_new("Shell", 1.0);
    s.ink   = FLOOR;
    add_box(&s, (point){ -0.3, -0.2, -0.2 }, (point){ 5.2, 4.2, 0.0 });
    s.ink = CEILING;
    add_box(&s, (point){ -0.3, -0.2, 2.70 }, (point){ 5.2, 4.2, 2.9 });
    s.ink = WALL;
    add_plate(&s, &(plate){ 0, COUNT(y), COUNT(z), y, z, "#### ####", -0.25, 0.0 });
    add_box(&s, (point){ -0.28, -0.15, -0.10 }, (point){ 5.15, 0.0, 2.80 });
    add_box(&s, (point){ -0.28, 4.0, -0.10 }, (point){ 5.15, 4.15, 2.80 });
    add_box(&s, (point){ 5.0, -0.10, -0.09 }, (point){ 5.12, 4.10, 2.79 });
    s.ink = TILES; /* up to the chest along the north wall, with a rail on top */
    add_box(&s, (point){ -0.01, 3.988, 0.075 }, (point){ 5.01, 4.01, 1.125 });
    s.ink = OAK;
    add_box(&s, (point){ -0.02, 3.965, 1.125 }, (point){ 5.02, 4.02, 1.155 });
    add_box(&s, (point){ -0.02, 3.980, 0.001 }, (point){ 5.02, 4.02, 0.075 });
    s.ink = SKY; /* what closes the window from outside: dark, for the light stands before it */
    add_box(&s, (point){ -0.29, 0.9, 0.75 }, (point){ -0.24, 2.5, 2.35 });
    return s;
}

shape window_frame(void)
{
    static const double x[] = { -0.705, -0.645, -0.025, 0.025, 0.645, 0.705 };
    static const double z[] = { 0.845, 0.905, 2.195, 2.255 };
    shape s                 = shape_new("Window frame", 1.0);
    s.ink                   = LACQUER;
    add_plate(&s, &(plate){ 1, 6, 4, x, z, "###### # ######", 0.06, 0.12 });
    add_box(&s, (point){ -0.78, -0.10, 0.825 }, (point){ 0.78, 0.07, 0.852 });
    return s;
}

/* Hung in folds, which are deeper below. */
shape curtain(void)
{
    enum { ACROSS = 120, DOWN = 14 };
    shape s = shape_new("Curtain", 1.0);
    s.ink   = LACE;
    for (int j = 0; j <= DOWN; j++)
        for (int i = 0; i <= ACROSS; i++) {
            const double u = (double)i / ACROSS, v = (double)j / DOWN;
            const double fold = sin(6.283185307179586 * 9.0 * u + 1.2 * sin(9.0 * u));
            add_vertex(&s, (point){ 1.8 * (u - 0.5), (0.020 + 0.025 * (1.0 - v)) * fold,
                                    0.70 + 1.75 * v });
        }
    for (int j = 0; j < DOWN; j++)
        for (int i = 0; i < ACROSS; i++) {
            const uint32_t a = (uint32_t)(j * (ACROSS + 1) + i), b = a + ACROSS + 1;
            add_triangle(&s, a, a + 1, b + 1);
            add_triangle(&s, a, b + 1, b);
        }
    s.ink             = STEEL; /* the rod */
    const point rod[] = { { -1.0, 0, 2.46 }, { 1.0, 0, 2.46 } };
    add_tube(&s, &(tube){ rod, 2, 16, 0.012, 0 });
    return s;
}

shape partition(void)
{
    static const double x[] = { 0.0, 0.04, 1.16, 1.20 }, z[] = { 0.001, 0.06, 2.06, 2.10 };
    shape s = shape_new("Partition", 1.0);
    s.ink   = STEEL;
    add_plate(&s, &(plate){ 1, 4, 4, x, z, "#### ####", -0.02, 0.02 });
    s.ink = PARTITION; /* one sheet stands for the pane */
    for (int i = 0; i < 4; i++)
        add_vertex(&s, (point){ i == 1 || i == 2 ? 1.17 : 0.03, 0.0, i < 2 ? 0.05 : 2.07 });
    add_triangle(&s, 0, 1, 2);
    add_triangle(&s, 0, 2, 3);
    return s;
}

/* A frame of four strips around something flat. */
static void add_frame(shape *s, double width, double height, double border, double depth)
{
    const double a = 0.5 * width, b = 0.5 * height;
    const double x[] = { -a - border, -a, a, a + border }, z[] = { -b - border, -b, b, b + border };
    add_plate(s, &(plate){ 1, 4, 4, x, z, "#### ####", -depth, 0.001 });
}

/* A sheet that looks along -y, a little behind the front of its frame. */
static shape hung(const char *name, int ink, double width, double height, double border)
{
    shape s        = shape_new(name, 1.0);
    const double a = 0.5 * width + 0.003, b = 0.5 * height + 0.003;
    s.ink = FRAME;
    add_frame(&s, width, height, border, 0.025);
    s.ink = ink;
    for (int i = 0; i < 4; i++)
        add_vertex(&s, (point){ i == 1 || i == 2 ? a : -a, -0.012, i < 2 ? -b : b });
    add_triangle(&s, 0, 1, 2);
    add_triangle(&s, 0, 2, 3);
    return s;
}

shape wall_mirror(void) { return hung("Mirror", MIRROR, 1.2, 0.85, 0.05); }

shape framed(const char *name, int ink, double width, double height)
{
    return hung(name, ink, width, height, 0.025);
}

shape pendant(void)
{
    static const double shade[][2] = {
        { 0.215, -0.02 }, { 0.220, -0.02 }, { 0.220, 0.0 },  { 0.16, 0.10 },   { 0.05, 0.16 },
        { 0.03, 0.17 },   { 0.03, 0.165 },  { 0.05, 0.152 }, { 0.155, 0.093 }, { 0.213, -0.002 },
    };
    shape s = shape_new("Pendant", 1.0);
    s.ink   = LACQUER;
    add_lathe(&s, &(lathe){ shade, COUNT(shade), 48, true });
    s.ink = STEEL;
    add_cylinder(&s, (point){ 0, 0, 0.155 }, 0.034, 0.05, 24);
    add_cylinder(&s, (point){ 0, 0, 0.20 }, 0.004, 0.80, 12);
    return s;
}
