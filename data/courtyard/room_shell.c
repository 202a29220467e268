/* data/courtyard/room_shell.c -- see courtyard.h: the closed room and its window.
 *
 * Walls reach into floor and ceiling, and into each other: nothing leaks, and no two faces lie in
 * one plane. The south wall has two leaves, of which this is the inner one:
 *
 *     y   0.00 +--- wall paint ---+ inside
 *        -0.14 |    frame: glass in its middle
 *        -0.26 +---------+--------+
 *        -0.40 + plaster (yard.c) + outside
 */
#include "data/courtyard/courtyard.h"

shape room_shell(void)
{
    static const double x[] = { YARD_WEST - 0.05, WINDOW_LEFT, WINDOW_RIGHT, YARD_EAST + 0.05 };
    static const double z[] = { YARD - 0.15, WINDOW_SILL, WINDOW_HEAD, EAVES - 0.02 };
    shape s                 = shape_new("Room", 1.0);
    s.ink                   = PARQUET;
    add_box(&s, (point){ -0.20, -0.10, -0.20 }, (point){ 4.20, 8.20, 0.0 });
    s.ink = CEILING;
    add_box(&s, (point){ -0.20, -0.10, 3.0 }, (point){ 4.20, 8.20, 3.2 });
    s.ink = WALL;
    add_plate(&s, &(plate){ 1, COUNT(x), COUNT(z), x, z, "#### ####", -0.26, 0.0 });
    add_box(&s, (point){ -0.18, 8.0, -0.10 }, (point){ 4.18, 8.15, 3.10 });
    add_box(&s, (point){ -0.15, -0.05, -0.09 }, (point){ 0.0, 8.10, 3.09 });
    add_box(&s, (point){ 4.0, -0.05, -0.09 }, (point){ 4.15, 8.10, 3.09 });
    return s;
}

shape room_skirting(void)
{
    shape s = shape_new("Skirting", 1.0);
    s.ink   = LACQUER;
    add_box(&s, (point){ -0.01, -0.01, 0.001 }, (point){ 4.01, 0.014, 0.080 });
    add_box(&s, (point){ -0.01, 7.986, 0.001 }, (point){ 4.01, 8.01, 0.080 });
    add_box(&s, (point){ -0.02, 0.005, 0.002 }, (point){ 0.014, 7.995, 0.081 });
    add_box(&s, (point){ 3.986, 0.005, 0.002 }, (point){ 4.02, 7.995, 0.081 });
    return s;
}

/* Where its bars are; the glass reaches a centimetre into them. */
static const double bar_x[] = {
    WINDOW_LEFT - 0.005,  WINDOW_LEFT + 0.065, 1.415, 1.485, 2.515, 2.585,
    WINDOW_RIGHT - 0.065, WINDOW_RIGHT + 0.005
};
static const double bar_z[] = { WINDOW_SILL - 0.005, WINDOW_SILL + 0.065, WINDOW_HEAD - 0.065,
                                WINDOW_HEAD + 0.005 };

shape room_window(void)
{
    shape s = shape_new("Window frame", 1.0);
    s.ink   = LACQUER;
    add_plate(&s, &(plate){ 1, COUNT(bar_x), COUNT(bar_z), bar_x, bar_z,
                            "#######"
                            "# # # #"
                            "#######",
                            -0.22, -0.14 });
    add_box(&s, (point){ WINDOW_LEFT - 0.08, -0.15, WINDOW_SILL - 0.008 },
            (point){ WINDOW_RIGHT + 0.08, 0.10, WINDOW_SILL + 0.022 });
    s.ink = COPING; /* the sill outside */
    add_box(&s, (point){ WINDOW_LEFT - 0.03, -0.45, WINDOW_SILL - 0.012 },
            (point){ WINDOW_RIGHT + 0.03, -0.21, WINDOW_SILL + 0.012 });
    s.ink = STEEL; /* handles */
    for (int i = 0; i < 2; i++)
        add_box(&s, (point){ 1.44 + 1.1 * i, -0.145, 1.68 },
                (point){ 1.46 + 1.1 * i, -0.10, 1.80 });
    return s;
}

shape room_panes(void)
{
    shape s = shape_new("Window panes", 1.0);
    s.ink   = GLASS;
    for (int i = 0; i < 3; i++) {
        const double left = bar_x[2 * i + 1] - 0.01, right = bar_x[2 * i + 2] + 0.01;
        uint32_t corner[4];
        for (int k = 0; k < 4; k++)
            corner[k] = add_vertex(&s, (point){ k == 1 || k == 2 ? right : left, -0.18,
                                                k < 2 ? bar_z[1] - 0.01 : bar_z[2] + 0.01 });
        add_triangle(&s, corner[0], corner[1], corner[2]);
        add_triangle(&s, corner[0], corner[2], corner[3]);
    }
    return s;
}
