/* data/car/parts.c -- see car.h: what is on the body and in it. */
#include "data/car/car.h"

#include <math.h>

#define RAD (3.14159265358979323846 / 180.0)

/* ---- outside ------------------------------------------------------------------------------ */

static void door_mirror(shape *s, double side)
{
    const point stalk[] = { { 0.60, side * 0.70, 0.905 }, { 0.60, side * 0.84, 0.930 } };
    s->ink              = TRIM;
    add_tube(s, &(tube){ stalk, 2, 16, 0.026, 0.020 });
    s->ink = PAINT;
    shape_at(s, (point){ 0.60, side * 0.915, 0.965 }, side * -10.0, 0.0);
    add_cushion(s, &(cushion){ .half       = { 0.055, 0.100, 0.066 },
                               .squareness = 0.7,
                               .edge       = 0.75,
                               .segments   = 48,
                               .rings      = 24 });
    s->ink = MIRROR; /* flat, looks to the rear */
    add_cushion(s, &(cushion){ .centre     = { -0.052, 0, 0 },
                               .half       = { 0.006, 0.072, 0.046 },
                               .squareness = 0.2,
                               .edge       = 0.6,
                               .segments   = 32,
                               .rings      = 12 });
    shape_at(s, (point){ 0 }, 0.0, 0.0);
}

static void handle(shape *s, double side)
{
    const double y     = side * 0.813;
    const point grip[] = { { -0.20, y - side * 0.03, 0.735 },
                           { -0.19, y, 0.742 },
                           { -0.165, y + side * 0.012, 0.745 },
                           { -0.09, y + side * 0.013, 0.742 },
                           { -0.065, y, 0.738 },
                           { -0.055, y - side * 0.03, 0.733 } };
    s->ink             = CHROME;
    add_tube(s, &(tube){ grip, COUNT(grip), 16, 0.0085, 0 });
}

static void exhaust(shape *s, double side)
{
    static const double pipe[][2] = { { 0.034, 0.0 },  { 0.040, 0.0 },    { 0.040, 0.125 },
                                      { 0.042, 0.13 }, { 0.0415, 0.136 }, { 0.037, 0.136 },
                                      { 0.034, 0.12 } };
    s->ink                        = CHROME;
    shape_at(s, (point){ -2.10, side * 0.50, 0.265 }, -90.0, 90.0); /* z to the rear */
    add_lathe(s, &(lathe){ pipe, COUNT(pipe), 48, true });
    shape_at(s, (point){ 0 }, 0.0, 0.0);
}

/* Along the foot of the windscreen, a little above the glass. */
static void wiper(shape *s, double from, double to)
{
    enum { POINTS = 10 };
    point path[POINTS];
    for (int i = 0; i < POINTS; i++) {
        const double f = (double)i / (POINTS - 1);
        path[i]        = form_above(0.93 - 0.10 * f, from + (to - from) * f);
        path[i].z += 0.012;
    }
    s->ink = SEAL;
    add_tube(s, &(tube){ path, POINTS, 8, 0.007, 0.005 });
}

/* Bright bars across the mouth, and a badge above it. */
static void front(shape *s)
{
    s->ink = CHROME;
    for (int i = 0; i < 3; i++) {
        enum { POINTS = 13 };
        point path[POINTS];
        for (int k = 0; k < POINTS; k++) {
            const double y = 0.27 * (2.0 * k / (POINTS - 1) - 1.0);
            path[k]        = (point){ 2.243 - 0.25 * y * y, y, 0.520 + 0.0275 * i };
        }
        add_tube(s, &(tube){ path, POINTS, 10, 0.0045, 0 });
    }
    s->ink = PLATE;
    add_box(s, (point){ 2.232, -0.24, 0.385 }, (point){ 2.258, 0.24, 0.485 });
    add_box(s, (point){ -2.262, -0.26, 0.46 }, (point){ -2.235, 0.26, 0.57 });
}

shape car_trimmings(void)
{
    shape s = shape_new("Trimmings", 1.0);
    for (int i = 0; i < 2; i++) {
        door_mirror(&s, side_of(i));
        handle(&s, side_of(i));
        exhaust(&s, side_of(i));
    }
    wiper(&s, 0.02, 0.52);
    wiper(&s, -0.54, -0.04);
    front(&s);
    return s;
}

/* ---- inside ------------------------------------------------------------------------------- */

static void padding(shape *s, point centre, point half, double squareness, double edge)
{
    add_cushion(s, &(cushion){ centre, half, squareness, edge, 28, 12, false });
}

static void seat(shape *s, point at)
{
    s->ink = SEAT;
    shape_at(s, at, 0.0, 0.0);
    padding(s, (point){ 0, 0, 0 }, (point){ 0.27, 0.25, 0.085 }, 0.45, 0.6);
    padding(s, (point){ -0.30, 0, 0.33 }, (point){ 0.085, 0.245, 0.33 }, 0.6, 0.5);
    padding(s, (point){ -0.33, 0, 0.725 }, (point){ 0.05, 0.13, 0.085 }, 0.6, 0.6);
    for (int i = 0; i < 2; i++)
        padding(s, (point){ -0.24, side_of(i) * 0.225, 0.30 }, (point){ 0.085, 0.04, 0.24 }, 0.8,
                0.7);
    shape_at(s, (point){ 0 }, 0.0, 0.0);
}

static void steering_wheel(shape *s)
{
    enum { RING = 12 };
    double rz[RING][2];
    for (int i = 0; i < RING; i++) {
        rz[i][0] = 0.175 + 0.015 * cos(60.0 * RAD / 2.0 * i);
        rz[i][1] = 0.015 * sin(60.0 * RAD / 2.0 * i);
    }
    const point column[] = { { 0, 0, -0.25 }, { 0, 0, -0.02 } };
    s->ink               = DASH;
    shape_at(s, (point){ 0.42, 0.36, 0.80 }, 90.0, 65.0); /* its face looks to the seat */
    add_lathe(s, &(lathe){ (const double(*)[2])rz, RING, 64, true });
    add_tube(s, &(tube){ column, 2, 16, 0.03, 0.045 });
    for (int i = 0; i < 3; i++) {
        const double a      = (90.0 + 120.0 * i) * RAD;
        const point spoke[] = { { 0, 0, -0.03 }, { 0.17 * cos(a), 0.17 * sin(a), 0.0 } };
        add_tube(s, &(tube){ spoke, 2, 12, 0.018, 0.011 });
    }
    shape_at(s, (point){ 0 }, 0.0, 0.0);
}

shape car_inside(void)
{
    shape s = shape_new("Inside", 1.0);
    seat(&s, (point){ 0.02, 0.36, 0.46 });
    seat(&s, (point){ 0.02, -0.36, 0.46 });
    s.ink = SEAT; /* the bench behind */
    padding(&s, (point){ -0.80, 0, 0.48 }, (point){ 0.24, 0.52, 0.08 }, 0.4, 0.6);
    padding(&s, (point){ -1.04, 0, 0.75 }, (point){ 0.08, 0.52, 0.25 }, 0.5, 0.5);
    s.ink = DASH;
    padding(&s, (point){ 0.72, 0, 0.78 }, (point){ 0.20, 0.66, 0.10 }, 0.4, 0.6);
    padding(&s, (point){ 0.10, 0, 0.40 }, (point){ 0.50, 0.07, 0.12 }, 0.4, 0.5);
    padding(&s, (point){ -0.10, 0, 0.24 }, (point){ 1.15, 0.70, 0.035 }, 0.3, 0.5);
    steering_wheel(&s);
    return s;
}
