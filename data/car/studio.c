/* data/car/studio.c -- see car.h: a floor that runs up the back wall, and three soft boxes.
 *
 * The light itself is in the study: a rectangle before the open side of each box.
 */
#include "data/car/car.h"

#include <math.h>

#define QUARTER  1.57079632679489661923
#define TURN_DEG 42.0 /* the back wall faces the camera */

/* Along y up to 3 m a floor, then around a quarter circle up a wall; z is the height on it. */
static void cove(point *p)
{
    const double start = 3.0, radius = 1.4, y = p->y, z = p->z;
    const double a  = fmin(fmax(y - start, 0.0) / radius, QUARTER);
    const double up = fmax(y - start - QUARTER * radius, 0.0), r = radius - z;
    if (y <= start)
        return;
    p->y = start + r * sin(a);
    p->z = radius - r * cos(a) + up;
}

static shape background(void)
{
    enum { LINES = 44 };
    static const double x[] = { -7.02, 7.02 };
    double y[LINES];
    char cells[LINES] = { 0 };
    y[0]              = -7.02;
    for (int i = 0; i < LINES - 3; i++)
        y[i + 1] = 3.0 + QUARTER * 1.4 * i / (LINES - 4);
    y[LINES - 2] = y[LINES - 3] + 0.1;
    y[LINES - 1] = y[LINES - 3] + 3.62;
    for (int i = 0; i < LINES - 1; i++)
        cells[i] = '#';
    shape s = shape_new("Background", 1.0);
    shape_at(&s, (point){ 0 }, TURN_DEG, 0.0);
    s.ink  = FLOOR;
    s.warp = cove;
    add_plate(&s, &(plate){ 2, 2, LINES, x, y, cells, -0.02, 0.0 });
    s.warp = NULL;
    return s;
}

/* Open below: its rim is at z = 0, the white inside of its back at 0.15. */
static void softbox(shape *s, double width, double depth)
{
    const double a = 0.5 * width, b = 0.5 * depth;
    const double x[] = { -a - 0.02, -a, a, a + 0.02 }, y[] = { -b - 0.02, -b, b, b + 0.02 };
    s->ink = BLACK;
    add_plate(s, &(plate){ 2, 4, 4, x, y, "#### ####", 0.0, 0.151 });
    add_box(s, (point){ x[0], y[0], 0.15 }, (point){ x[3], y[3], 0.17 });
}

shape car_studio(void)
{
    shape s = background();
    s.ink   = WALL;
    add_box(&s, (point){ -7.1, -7.1, 4.8 }, (point){ 7.1, 4.6, 4.9 });
    add_box(&s, (point){ -7.1, -7.1, -0.1 }, (point){ -7.0, 4.6, 4.85 });
    add_box(&s, (point){ 7.0, -7.1, -0.1 }, (point){ 7.1, 4.6, 4.85 });
    add_box(&s, (point){ -7.1, -7.1, -0.1 }, (point){ 7.1, -7.0, 4.85 });

    shape_at(&s, (point){ 0.0, 0.3, 3.7 }, 0.0, 0.0);
    softbox(&s, 4.4, 1.6);
    shape_at(&s, (point){ 1.2, -5.2, 2.2 }, 0.0, 60.0); /* at the front, tipped down to the car */
    softbox(&s, 3.2, 1.2);
    shape_at(&s, (point){ 5.3, 1.2, 1.9 }, 90.0, 70.0);
    softbox(&s, 2.4, 1.2);
    shape_at(&s, (point){ 0 }, 0.0, 0.0);
    return s;
}
