/* data/office/desk_parts.c -- see parts.h: all that belongs to a workplace. */
#include "data/office/parts.h"

#include <math.h>

shape desk(double detail)
{
    shape s = shape_new("Desk", detail);

    s.ink = WOOD;
    add_box(&s, (point){ -0.8, -0.4, 0.695 }, (point){ 0.8, 0.4, 0.72 });

    s.ink = METAL;
    for (int i = 0; i < 2; i++) {
        const double x = i ? 0.70 : -0.70;
        add_box(&s, (point){ x - 0.03, -0.35, 0.001 }, (point){ x + 0.03, 0.35, 0.032 });
        add_box(&s, (point){ x - 0.025, 0.02, 0.027 }, (point){ x + 0.025, 0.12, 0.662 });
        add_box(&s, (point){ x - 0.02, -0.34, 0.657 }, (point){ x + 0.02, 0.34, 0.699 });
    }
    s.ink = DARK_METAL; /* the tray for the cables holds the frame together */
    add_box(&s, (point){ -0.69, 0.20, 0.61 }, (point){ 0.69, 0.32, 0.697 });
    return s;
}

shape pedestal(double detail)
{
    static const double front[][2] = { { 0.045, 0.325 }, { 0.330, 0.545 } };
    shape s                        = shape_new("Drawer pedestal", detail);

    s.ink = PAINT;
    add_box(&s, (point){ -0.21, -0.27, 0.001 }, (point){ 0.21, 0.29, 0.56 });
    for (int i = 0; i < COUNT(front); i++) {
        const double z = front[i][1] - 0.035;
        s.ink          = PAINT;
        add_box(&s, (point){ -0.207, -0.29, front[i][0] }, (point){ 0.207, -0.265, front[i][1] });
        s.ink = METAL;
        add_box(&s, (point){ -0.07, -0.312, z }, (point){ 0.07, -0.285, z + 0.012 });
    }
    return s;
}

shape monitor(double detail)
{
    shape s = shape_new("Monitor", detail);

    s.ink = PLASTIC;
    add_box(&s, (point){ -0.305, -0.012, 0.125 }, (point){ 0.305, 0.008, 0.475 });
    add_box(&s, (point){ -0.17, 0.004, 0.20 }, (point){ 0.17, 0.028, 0.40 });
    add_box(&s, (point){ -0.028, 0.024, 0.003 }, (point){ 0.028, 0.042, 0.33 });
    add_box(&s, (point){ -0.12, -0.06, -0.003 }, (point){ 0.12, 0.12, 0.009 });
    s.ink = BLACK;
    add_box(&s, (point){ -0.297, -0.014, 0.139 }, (point){ 0.297, -0.006, 0.468 });
    return s;
}

shape keyboard(double detail)
{
    shape s = shape_new("Keyboard and mouse", detail);

    s.ink = PLASTIC;
    shape_at(&s, (point){ 0, 0, 0.0 }, 0.0, 4.0);
    add_box(&s, (point){ -0.22, -0.065, -0.006 }, (point){ 0.22, 0.065, 0.010 });
    s.ink = BLACK;
    add_box(&s, (point){ -0.21, -0.055, 0.006 }, (point){ 0.21, 0.045, 0.014 });
    shape_at(&s, (point){ 0.33, -0.01, 0.008 }, 8.0, 0.0);
    add_cushion(&s, &(cushion){ .half       = { 0.031, 0.055, 0.018 },
                                .squareness = 0.8,
                                .edge       = 0.8,
                                .segments   = 8,
                                .rings      = 3 });
    return s;
}

/* ---- the chair: looks along +y --------------------------------------------------------- */

/* A dished seat whose front edge falls off. */
static void seat_warp(point *p)
{
    const double f = fmax(p->y / 0.24, 0.0);
    p->z += 0.5 * p->x * p->x - 0.045 * f * f * f;
}

/* Local y is up, local z backwards: the sides come forward, the small of the back is supported. */
static void back_warp(point *p)
{
    const double low = p->y + 0.12;
    p->z += 0.55 * low * low - 1.1 * p->x * p->x;
}

static void chair_base(shape *s)
{
    static const double lift[][2] = { { 0, 0.065 },     { 0.042, 0.065 }, { 0.042, 0.105 },
                                      { 0.026, 0.115 }, { 0.026, 0.41 },  { 0, 0.41 } };
    static const point arm[]      = { { 0.02, 0, 0.088 }, { 0.31, 0, 0.062 } };
    for (int i = 0; i < 5; i++) {
        const double turn = 90.0 + 72.0 * i, a = turn * (3.14159265358979323846 / 180.0);
        s->ink = DARK_METAL;
        shape_at(s, (point){ 0 }, turn, 0.0);
        add_tube(s, &(tube){ arm, COUNT(arm), 3, 0.026, 0.017 });
        s->ink = BLACK;
        shape_at(s, (point){ 0.30 * cos(a), 0.30 * sin(a), 0.030 }, turn, 90.0);
        add_cylinder(s, (point){ 0, 0, -0.024 }, 0.029, 0.048, 5);
    }
    s->ink = DARK_METAL;
    shape_at(s, (point){ 0 }, 0.0, 0.0);
    add_lathe(s, &(lathe){ lift, COUNT(lift), 5, false });
    add_box(s, (point){ -0.09, -0.16, 0.395 }, (point){ 0.09, 0.12, 0.45 });
}

static void chair_arms(shape *s)
{
    for (int side = -1; side <= 1; side += 2) {
        const point rail[] = { { side * 0.08, -0.04, 0.425 },
                               { side * 0.285, -0.04, 0.435 },
                               { side * 0.30, -0.03, 0.635 } };
        s->ink             = DARK_METAL;
        add_tube(s, &(tube){ rail, COUNT(rail), 4, 0.022, 0.016 });
        s->ink = BLACK;
        add_box(s, (point){ side * 0.295 - 0.04, -0.13, 0.632 },
                (point){ side * 0.295 + 0.04, 0.12, 0.658 });
    }
}

shape office_chair(double detail)
{
    static const point spine[] = { { 0, -0.12, 0.425 }, { 0, -0.30, 0.43 }, { 0, -0.315, 0.80 } };
    shape s                    = shape_new("Office chair", detail);
    chair_base(&s);
    chair_arms(&s);
    s.ink = DARK_METAL;
    add_tube(&s, &(tube){ spine, COUNT(spine), 4, 0.028, 0.022 });

    s.ink  = FABRIC;
    s.warp = seat_warp;
    shape_at(&s, (point){ 0, 0, 0.475 }, 0.0, 0.0);
    add_cushion(&s, &(cushion){ .half       = { 0.25, 0.24, 0.042 },
                                .squareness = 0.55,
                                .edge       = 0.55,
                                .segments   = 16,
                                .rings      = 4,
                                .ruled      = true });
    s.warp = back_warp;
    shape_at(&s, (point){ 0, -0.245, 0.82 }, 0.0, 98.0);
    add_cushion(&s, &(cushion){ .half       = { 0.225, 0.29, 0.032 },
                                .squareness = 0.55,
                                .edge       = 0.55,
                                .segments   = 16,
                                .rings      = 4,
                                .ruled      = true });
    s.warp = NULL;
    return s;
}

/* ---- what stands between and beside ----------------------------------------------------- */

shape desk_screen(double detail)
{
    shape s = shape_new("Desk screen", detail);
    s.ink   = SCREEN;
    add_box(&s, (point){ -0.015, -1.59, 0.60 }, (point){ 0.015, 1.59, 1.09 });
    s.ink = METAL;
    for (int i = 0; i < 2; i++) /* clamped to the desks at either side */
        add_box(&s, (point){ -0.09, i ? 1.19 : -1.21, 0.68 },
                (point){ 0.09, i ? 1.21 : -1.19, 0.70 });
    add_box(&s, (point){ -0.018, -1.594, 1.085 }, (point){ 0.018, 1.594, 1.10 });
    return s;
}

shape waste_bin(double detail)
{
    static const double wall[][2] = { { 0, 0.001 },    { 0.11, 0.001 },  { 0.14, 0.31 },
                                      { 0.136, 0.31 }, { 0.107, 0.006 }, { 0, 0.006 } };
    shape s                       = shape_new("Waste bin", detail);
    s.ink                         = DARK_METAL;
    add_lathe(&s, &(lathe){ wall, COUNT(wall), 9, false });
    return s;
}
