/* data/courtyard/yard.c -- see courtyard.h: what is outside.
 *
 * A facade is a leaf of plaster with holes; in each stands a dark pane in its casement. What goes
 * on behind is none of this study's business.
 */
#include "data/courtyard/courtyard.h"

#include <string.h>

enum { MOST_BAYS = 5 };

/* m, of each bay: where its window is, and the heights of both storeys' windows. */
#define BAY   3.2
#define LEFT  0.9
#define RIGHT 2.3
static const double storey[2][2] = { { 0.95, 2.75 }, { 4.50, 6.25 } };

/* A pane behind a hole from (x0, z0) to (x1, z1) of a leaf whose face is y. */
static void add_casement(shape *s, double y, const double x[2], const double z[2])
{
    const double middle = 0.5 * (x[0] + x[1]), rail = z[0] + 0.72 * (z[1] - z[0]);
    const double u[] = { x[0] - 0.004,  x[0] + 0.06, middle - 0.03,
                         middle + 0.03, x[1] - 0.06, x[1] + 0.004 };
    const double v[] = { z[0] - 0.004, z[0] + 0.06, rail - 0.025,
                         rail + 0.025, z[1] - 0.06, z[1] + 0.004 };
    s->ink           = CASEMENT;
    add_plate(s, &(plate){ 1, 6, 6, u, v,
                           "#####"
                           "# # #"
                           "#####"
                           "# # #"
                           "#####",
                           y + 0.085, y + 0.128 });
    s->ink = DARK_PANE;
    add_box(s, (point){ x[0] - 0.02, y + 0.115, z[0] - 0.02 },
            (point){ x[1] + 0.02, y + 0.138, z[1] + 0.02 });
    s->ink = COPING; /* its sill */
    add_box(s, (point){ x[0] - 0.05, y - 0.05, z[0] - 0.03 },
            (point){ x[1] + 0.05, y + 0.10, z[0] + 0.008 });
}

/* The plinth below and the coping on top of a leaf. */
static void add_edges(shape *s, point left, double length, double thick)
{
    s->ink = PLINTH;
    add_box(s, (point){ left.x - 0.01, left.y - 0.03, left.z - 0.12 },
            (point){ left.x + length + 0.01, left.y + 0.02, left.z + 0.45 });
    s->ink = COPING;
    add_box(s, (point){ left.x - 0.02, left.y - 0.08, left.z + EAVES - YARD - 0.01 },
            (point){ left.x + length + 0.02, left.y + thick + 0.04, left.z + EAVES - YARD + 0.06 });
}

shape facade(const char *name, int bays)
{
    double x[2 * MOST_BAYS + 2],
        z[] = { -0.10, storey[0][0], storey[0][1], storey[1][0], storey[1][1], EAVES - YARD };
    char cells[5 * (2 * MOST_BAYS + 1) + 1] = "";
    const int nu = 2 * bays + 2, across = nu - 1;
    shape s   = shape_new(name, 1.0);
    x[0]      = 0.0;
    x[nu - 1] = BAY * bays;
    memset(cells, '#', (size_t)(5 * across));
    for (int i = 0; i < bays; i++) {
        x[2 * i + 1]                  = BAY * i + LEFT;
        x[2 * i + 2]                  = BAY * i + RIGHT;
        cells[across + 2 * i + 1]     = ' ';
        cells[3 * across + 2 * i + 1] = ' ';
        add_casement(&s, 0.0, x + 2 * i + 1, storey[0]);
        add_casement(&s, 0.0, x + 2 * i + 1, storey[1]);
    }
    s.ink = PLASTER;
    add_plate(&s, &(plate){ 1, nu, 6, x, z, cells, 0.0, 0.13 });
    add_box(&s, (point){ -0.03, 0.125, -0.11 }, (point){ BAY * bays + 0.03, 0.40, EAVES - YARD });
    add_edges(&s, (point){ 0 }, BAY * bays, 0.40);
    return s;
}

/* Five bays: in the middle of the upper storey there is the room's window. */
shape own_facade(void)
{
    double x[] = { YARD_WEST - 0.1,      -5.1, -3.7, -1.9, -0.5, WINDOW_LEFT - 0.012, 1.3, 2.7,
                   WINDOW_RIGHT + 0.012, 4.5,  5.9,  7.7,  9.1,  YARD_EAST + 0.1 };
    double z[] = { YARD - 0.10,
                   YARD + storey[0][0],
                   YARD + storey[0][1],
                   WINDOW_SILL - 0.012,
                   YARD + storey[1][0] + 0.05,
                   YARD + storey[1][1] + 0.05,
                   WINDOW_HEAD + 0.012,
                   EAVES };
    shape s    = shape_new("Facade north", 1.0);
    s.ink      = PLASTER;
    add_plate(&s, &(plate){ 1, COUNT(x), COUNT(z), x, z,
                            "#############"
                            "# # ## ## # #"
                            "#############"
                            "#####   #####"
                            "# # #   # # #"
                            "#####   #####"
                            "#############",
                            -0.40, -0.255 });
    for (int i = 0; i < 5; i++) {
        const double left[] = { -5.1, -1.9, 1.3, 4.5, 7.7 }, at[] = { left[i], left[i] + 1.4 };
        add_casement(&s, -0.40, at, z + 1);
        if (i != 2)
            add_casement(&s, -0.40, at, z + 4);
    }
    add_edges(&s, (point){ YARD_WEST, -0.40, YARD }, YARD_EAST - YARD_WEST, 0.40);
    return s;
}

shape yard_ground(void)
{
    shape s = shape_new("Ground", 1.0);
    s.ink   = PAVING;
    add_box(&s, (point){ YARD_WEST - 0.3, -13.5, YARD - 0.3 },
            (point){ YARD_EAST + 0.3, -0.3, YARD });
    s.ink = LAWN;
    add_box(&s, (point){ -4.0, -11.4, YARD - 0.05 }, (point){ 8.0, -6.0, YARD + 0.03 });
    s.ink                   = PLINTH; /* a kerb around it */
    static const double x[] = { -4.12, -3.99, 7.99, 8.12 }, y[] = { -11.52, -11.39, -6.01, -5.88 };
    add_plate(&s, &(plate){ 2, 4, 4, x, y, "#### ####", YARD - 0.06, YARD + 0.05 });
    return s;
}

shape yard_tree(void)
{
    static const point trunk[] = { { 0, 0, -0.1 }, { 0.04, 0.02, 1.2 }, { -0.03, 0, 2.6 } };
    shape s                    = shape_new("Tree", 1.0);
    uint32_t seed              = 3;
    s.ink                      = BARK;
    add_tube(&s, &(tube){ trunk, 3, 12, 0.14, 0.08 });
    for (int i = 0; i < 7; i++) {
        const double turn = 2.4 * i, out = 0.75 + 0.3 * draw(&seed);
        const point bough[] = { { -0.02, 0, 1.7 + 0.1 * i },
                                { 0.5 * out * cos(turn), 0.5 * out * sin(turn), 2.3 + 0.12 * i },
                                { out * cos(turn), out * sin(turn), 2.7 + 0.15 * i } };
        add_tube(&s, &(tube){ bough, 3, 6, 0.045, 0.015 });
    }
    s.ink = LEAF;
    for (int i = 0; i < 1600; i++) { /* on a spiral about the crown, at all depths */
        const double up = 2.0 * (i + 0.5) / 1600 - 1.0, turn = 2.399963 * i;
        const double out = 1.0 - 0.45 * draw(&seed) * draw(&seed), r = sqrt(1.0 - up * up) * out;
        const double tilt = 140.0 * draw(&seed) - 70.0, spin = 360.0 * draw(&seed);
        shape_at(&s, (point){ 1.35 * r * cos(turn), 1.35 * r * sin(turn), 3.15 + 1.25 * up * out },
                 spin, tilt);
        add_box(&s, (point){ -0.075, -0.05, -0.003 }, (point){ 0.075, 0.05, 0.003 });
    }
    return s;
}

shape yard_bench(void)
{
    shape s = shape_new("Bench", 1.0);
    s.ink   = PLINTH;
    for (int i = 0; i < 2; i++) {
        const double x = side_of(i) * 0.65;
        add_box(&s, (point){ x - 0.05, -0.18, 0.001 }, (point){ x + 0.05, 0.18, 0.42 });
    }
    s.ink = OAK;
    for (int i = 0; i < 4; i++)
        add_box(&s, (point){ -0.9, -0.20 + 0.105 * i, 0.417 },
                (point){ 0.9, -0.115 + 0.105 * i, 0.45 });
    return s;
}
