/* data/car/wheel.c -- see car.h: a wheel is made lying, its axle along z, and set up at the end. */
#include "data/car/car.h"

#include <math.h>

#define TURN 6.28318530717958647692

enum { ROUND = 64 };

/* Lying things are set up: what looked up (z) looks along -y. */
static void set_up(shape *s)
{
    for (int k = 0; k < PAINT_COUNT; k++)
        for (uint32_t v = 0; v < s->patches[k].vertex_count; v++) {
            float *p      = s->patches[k].xyz + 3 * v;
            const float y = p[1];
            p[1]          = 0.0f - p[2];
            p[2]          = y;
        }
}

/* A closed loop: beads, side walls, and four grooves around the tread. */
static void tyre(shape *s)
{
    static const double rz[][2] = {
        { 0.218, -0.088 },  { 0.232, -0.096 },  { 0.255, -0.105 },  { 0.280, -0.109 },
        { 0.303, -0.106 },  { 0.318, -0.099 },  { 0.3265, -0.088 }, { 0.3290, -0.074 },
        { 0.3292, -0.062 }, { 0.3215, -0.061 }, { 0.3215, -0.052 }, { 0.3294, -0.051 },
        { 0.3297, -0.024 }, { 0.3220, -0.023 }, { 0.3220, -0.013 }, { 0.3298, -0.012 },
        { 0.3298, 0.012 },  { 0.3220, 0.013 },  { 0.3220, 0.023 },  { 0.3297, 0.024 },
        { 0.3294, 0.051 },  { 0.3215, 0.052 },  { 0.3215, 0.061 },  { 0.3292, 0.062 },
        { 0.3290, 0.074 },  { 0.3265, 0.088 },  { 0.318, 0.099 },   { 0.303, 0.106 },
        { 0.280, 0.109 },   { 0.255, 0.105 },   { 0.232, 0.096 },   { 0.218, 0.088 },
        { 0.212, 0.080 },   { 0.240, 0.060 },   { 0.290, 0.040 },   { 0.290, -0.040 },
        { 0.240, -0.060 },  { 0.212, -0.080 },
    };
    s->ink = TYRE;
    add_lathe(s, &(lathe){ rz, COUNT(rz), ROUND, true });
}

/* Oblique bars across both shoulders of the tread. */
static void tread(shape *s)
{
    for (int i = 0; i < 2 * ROUND; i++) {
        const double a = TURN * (i / 2 + 0.25) / (ROUND), z = i & 1 ? 0.081 : -0.081;
        shape_at(s, (point){ 0.3275 * cos(a), 0.3275 * sin(a), z }, 360.0 * a / TURN,
                 i & 1 ? 12 : -12);
        add_box(s, (point){ -0.004, -0.0075, -0.014 }, (point){ 0.0018, 0.0075, 0.014 });
    }
    shape_at(s, (point){ 0 }, 0.0, 0.0);
}

static void rim(shape *s)
{
    static const double barrel[][2] = {
        { 0.205, -0.086 }, { 0.226, -0.092 }, { 0.226, -0.085 }, { 0.216, -0.078 },
        { 0.200, -0.050 }, { 0.200, 0.050 },  { 0.216, 0.078 },  { 0.226, 0.086 },
        { 0.226, 0.095 },  { 0.221, 0.098 },  { 0.214, 0.094 },  { 0.206, 0.084 },
        { 0.194, 0.055 },  { 0.192, -0.050 },
    };
    static const double hub[][2] = {
        { 0, 0.010 },     { 0.070, 0.010 }, { 0.074, 0.030 }, { 0.062, 0.050 }, { 0.040, 0.056 },
        { 0.034, 0.056 }, { 0.032, 0.066 }, { 0.024, 0.071 }, { 0, 0.072 },
    };
    s->ink = RIM;
    add_lathe(s, &(lathe){ barrel, COUNT(barrel), ROUND, true });
    add_lathe(s, &(lathe){ hub, COUNT(hub), 40, false });
}

/* Ten spokes in pairs, and five nuts. */
static void spokes(shape *s)
{
    for (int i = 0; i < 10; i++) {
        shape_at(s, (point){ 0 }, 72.0 * (i / 2) + (i & 1 ? 11.0 : -11.0), 0.0);
        add_cushion(s, &(cushion){ .centre     = { 0.123, i & 1 ? 0.008 : -0.008, 0.046 },
                                   .half       = { 0.084, 0.0135, 0.017 },
                                   .squareness = 0.4,
                                   .edge       = 0.7,
                                   .segments   = 20,
                                   .rings      = 8 });
    }
    s->ink = CHROME;
    for (int i = 0; i < 5; i++) {
        shape_at(s, (point){ 0 }, 72.0 * i + 36.0, 0.0);
        add_cylinder(s, (point){ 0.052, 0, 0.040 }, 0.0085, 0.021, 6);
    }
    shape_at(s, (point){ 0 }, 0.0, 0.0);
}

static void brake(shape *s)
{
    static const double disc[][2] = { { 0, -0.028 },     { 0.148, -0.028 }, { 0.150, -0.026 },
                                      { 0.150, -0.006 }, { 0.148, -0.004 }, { 0.082, -0.004 },
                                      { 0.078, 0.012 },  { 0, 0.012 } };
    s->ink                        = BRAKE;
    add_lathe(s, &(lathe){ disc, COUNT(disc), 48, false });
    s->ink = CALIPER;
    add_cushion(s, &(cushion){ .centre     = { -0.135, 0.03, -0.014 },
                               .half       = { 0.034, 0.075, 0.032 },
                               .squareness = 0.4,
                               .edge       = 0.5,
                               .segments   = 32,
                               .rings      = 12 });
}

shape car_wheel(void)
{
    shape s = shape_new("Wheel", 1.0);
    tyre(&s);
    tread(&s);
    rim(&s);
    spokes(&s);
    brake(&s);
    set_up(&s);
    return s;
}

/* ---- what the wheel turns in -------------------------------------------------------------- */

/* x is the angle from the rear, degrees; y across the car; z the radius. */
static void bend(point *p)
{
    const double a = p->x * TURN / 360.0, r = p->z;
    p->x = -r * cos(a);
    p->z = r * sin(a);
}

shape car_liner(void)
{
    enum { STEPS = 31 };
    double angle[STEPS];
    char cells[STEPS] = { 0 };
    for (int i = 0; i < STEPS; i++) {
        angle[i] = -17.0 + 214.0 * i / (STEPS - 1);
        cells[i] = i < STEPS - 1 ? '#' : 0;
    }
    static const double across[] = { -0.035, 0.36 }, radius[] = { 0.02, 0.394 };
    shape s = shape_new("Wheel arch", 1.0);
    s.ink   = TRIM;
    s.warp  = bend;
    add_plate(&s, &(plate){ 2, STEPS, 2, angle, across, cells, 0.389, 0.396 });
    add_plate(&s, &(plate){ 1, STEPS, 2, angle, radius, cells, 0.352, 0.358 });
    s.warp = NULL;
    return s;
}
