/* data/office/building.c -- see parts.h: the closed shell of the room and what is built into it.
 *
 * Walls reach into floor and soffit, and into each other, so that nothing leaks and no two faces
 * lie in one plane. Above the suspended ceiling is a closed void of 0.1 m.
 */
#include "data/office/parts.h"

shape shell(double detail)
{
    static const double north_x[] = {
        -0.25, 0.56, 2.56, 3.12, 5.12, 5.68, 7.68, 8.24, 10.24, 11.05
    };
    static const double north_z[] = { -0.12, 0.85, 2.55, 3.12 };
    static const double east_y[] = { -0.10, 0.75, 1.65, 7.30 }, east_z[] = { -0.11, 2.10, 3.11 };
    static const double band_x[] = { -0.05, 0.605, 10.195, 10.85 };
    static const double band_y[] = { -0.05, 0.605, 6.595, 7.25 };
    shape s                      = shape_new("Shell", detail);

    s.ink = CARPET;
    add_box(&s, (point){ -0.30, -0.30, -0.20 }, (point){ 11.10, 7.60, 0.0 });
    s.ink = CONCRETE;
    add_box(&s, (point){ -0.30, -0.30, 3.00 }, (point){ 11.10, 7.60, 3.20 });

    s.ink = WALL;
    add_box(&s, (point){ -0.25, -0.20, -0.10 }, (point){ 11.05, 0.0, 3.10 });
    add_box(&s, (point){ -0.15, -0.10, -0.09 }, (point){ 0.0, 7.30, 3.09 });
    add_plate(&s, &(plate){ 1, COUNT(north_x), COUNT(north_z), north_x, north_z,
                            "#########"
                            "# # # # #"
                            "#########",
                            7.20, 7.55 });
    s.ink = ACCENT;
    add_plate(&s,
              &(plate){ 0, COUNT(east_y), COUNT(east_z), east_y, east_z, "# ####", 10.80, 10.95 });

    s.ink = NIGHT; /* what is seen through the windows */
    add_box(&s, (point){ 0.1, 7.50, 0.5 }, (point){ 10.7, 7.53, 2.9 });
    s.ink = CEILING; /* a frieze around the tiles */
    add_plate(&s, &(plate){ 2, 4, 4, band_x, band_y, "#### ####", 2.894, 2.96 });
    return s;
}

shape skirting(double detail)
{
    shape s = shape_new("Skirting", detail);
    s.ink   = PAINT;
    add_box(&s, (point){ -0.01, -0.01, 0.001 }, (point){ 10.81, 0.014, 0.080 });
    add_box(&s, (point){ -0.01, 7.186, 0.001 }, (point){ 10.81, 7.21, 0.080 });
    add_box(&s, (point){ -0.02, 0.005, 0.002 }, (point){ 0.014, 7.195, 0.081 });
    add_box(&s, (point){ 10.786, 0.005, 0.002 }, (point){ 10.82, 0.69, 0.081 });
    add_box(&s, (point){ 10.786, 1.71, 0.002 }, (point){ 10.82, 7.195, 0.081 });
    return s;
}

shape window_frame(double detail)
{
    static const double x[] = { -1.005, -0.935, -0.035, 0.035, 0.935, 1.005 };
    static const double z[] = { 0.845, 0.915, 2.485, 2.555 };
    shape s                 = shape_new("Window", detail);
    s.ink                   = PAINT;
    add_plate(&s, &(plate){ 1, COUNT(x), COUNT(z), x, z,
                            "#####"
                            "# # #"
                            "#####",
                            0.18, 0.25 });
    add_box(&s, (point){ -1.03, -0.04, 0.843 }, (point){ 1.03, 0.19, 0.873 });
    s.ink = METAL;
    add_box(&s, (point){ -0.010, 0.150, 1.24 }, (point){ 0.010, 0.185, 1.36 });
    return s;
}

static void door_handle(shape *s)
{
    static const point lever[] = { { 0.035, -0.36, 1.05 },
                                   { -0.022, -0.36, 1.05 },
                                   { -0.026, -0.24, 1.05 } };
    s->ink                     = METAL;
    add_tube(s, &(tube){ lever, COUNT(lever), 6, 0.011, 0.010 });
    shape_at(s, (point){ 0.035, -0.36, 1.05 }, -90.0, 90.0); /* local z to -x */
    add_cylinder(s, (point){ 0 }, 0.027, 0.014, 10);
    shape_at(s, (point){ 0 }, 0.0, 0.0);
}

shape door(double detail)
{
    static const double y[] = { -0.52, -0.42, 0.42, 0.52 }, z[] = { -0.03, 2.07, 2.17 };
    shape s = shape_new("Door", detail);

    s.ink = PAINT;
    add_plate(&s, &(plate){ 0, COUNT(y), COUNT(z), y, z, "# ####", -0.016, 0.16 });
    s.ink = DOOR_WOOD;
    add_box(&s, (point){ 0.03, -0.425, 0.005 }, (point){ 0.07, 0.425, 2.075 });
    add_box(&s, (point){ 0.022, -0.30, 1.20 }, (point){ 0.035, 0.30, 1.93 });
    add_box(&s, (point){ 0.022, -0.30, 0.33 }, (point){ 0.035, 0.30, 0.93 });
    s.ink = METAL;
    add_box(&s, (point){ -0.01, -0.43, -0.01 }, (point){ 0.10, 0.43, 0.006 });
    add_box(&s, (point){ 0.027, -0.38, 0.03 }, (point){ 0.035, 0.38, 0.22 });
    door_handle(&s);
    return s;
}

/* ---- the suspended ceiling ---------------------------------------------------------------- */

shape tile_row(double detail)
{
    shape s = shape_new("Ceiling tiles", detail);
    s.ink   = CEILING;
    add_box(&s, (point){ 0.0, -0.299, 0.0 }, (point){ 9.62, 0.299, 0.015 });
    return s;
}

shape runner(double detail, double length)
{
    shape s = shape_new("T-bar", detail);
    s.ink   = BAR;
    add_box(&s, (point){ 0.0, -0.012, 0.0 }, (point){ length, 0.012, 0.006 });
    add_box(&s, (point){ 0.0, -0.001, 0.004 }, (point){ length, 0.001, 0.035 });
    return s;
}

shape panel(double detail)
{
    shape s = shape_new("Panel luminaire", detail);
    s.ink   = PAINT;
    add_box(&s, (point){ -0.297, -0.297, 0.0 }, (point){ 0.297, 0.297, 0.03 });
    s.ink = DIFFUSER;
    for (int i = 0; i < 3; i++) { /* the linear lenses, along y: C90 */
        const double x = -0.177 + 0.177 * i;
        add_box(&s, (point){ x - 0.076, -0.265, -0.003 }, (point){ x + 0.076, 0.265, 0.012 });
    }
    return s;
}

shape downlight(double detail)
{
    shape s = shape_new("Downlight", detail);
    s.ink   = METAL;
    add_cylinder(&s, (point){ 0, 0, -0.002 }, 0.105, 0.01, 14);
    s.ink = DIFFUSER;
    add_cylinder(&s, (point){ 0, 0, -0.004 }, 0.085, 0.01, 14);
    return s;
}
