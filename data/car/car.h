/* data/car/car.h -- a coupe in a photographer's studio: 4.5 x 1.85 x 1.4 m, its front to the east.
 *
 * x from the tail (-2.25) to the nose, y to its left, z up from the floor that it stands on.
 */
#ifndef CAR_CAR_H
#define CAR_CAR_H

#include "data/model/model.h"

enum {
    PAINT,
    WINDOW,
    SEAL,
    CHROME,
    GRILLE,
    TRIM,
    LENS,
    HOUSING,
    TAIL,
    TYRE,
    RIM,
    BRAKE,
    CALIPER,
    SEAT,
    DASH,
    PLATE,
    MIRROR,
    FLOOR,
    WALL,
    BLACK,
    PAINT_COUNT,
};
extern const paint car_paints[PAINT_COUNT];

#define AXLE   1.36 /* m, where the wheels are: x, */
#define TRACK  0.78 /* their middle planes: y, */
#define RADIUS 0.33

/* form.c: the body as a smooth closed surface. Below 0 inside, about the distance in m near it. */
double form(point p);
point form_at(double along, double around); /* along of [-1, 1] from tail to nose; rad */
point form_above(double x, double y);       /* its highest point there */
double form_shoulder(double x);             /* z of the line below the windows */
double form_cabin(double x);                /* half the width of the cabin */

/* regions.c: what the body is made of where `low < inside(p) < high`, m; the first that is true. */
typedef struct region {
    double (*inside)(point p);
    double low, high;
    int ink; /* NO_INK: a hole */
} region;
enum { NO_INK = -1 };
extern const region car_regions[];
extern const int car_region_count;

/* body.c: the sheets of the body, and the solids and pots of the head lights behind. */
shape car_body(void);
shape car_lamps(void);

/* parts.c, wheel.c, studio.c */
shape car_trimmings(void);
shape car_inside(void);
shape car_liner(void); /* of one wheel, whose axle is the origin */
shape car_wheel(void); /* its axle is the origin, its outer side looks along -y */
shape car_studio(void);

/* layout.c: fills an empty model. */
void car_build(model *m);

#endif
