/* data/car/layout.c -- see car.h: where all of it stands. */
#include "data/car/car.h"

#include <math.h>

void car_build(model *m)
{
    m->title       = "Car";
    m->maker       = "make_car";
    m->paints      = car_paints;
    m->paint_count = PAINT_COUNT;

    model_put_new(m, car_studio(), (point){ 0 }, 0.0);
    model_put_new(m, car_body(), (point){ 0 }, 0.0);
    model_put_new(m, car_lamps(), (point){ 0 }, 0.0);
    model_put_new(m, car_trimmings(), (point){ 0 }, 0.0);
    model_put_new(m, car_inside(), (point){ 0 }, 0.0);

    const int wheel = model_add_shape(m, car_wheel()), liner = model_add_shape(m, car_liner());
    for (int i = 0; i < 4; i++) {
        const double x = i & 1 ? AXLE : -AXLE, side = i & 2 ? 1.0 : -1.0;
        model_put(m, wheel, (point){ x, side * TRACK, RADIUS + 0.001 }, side > 0.0 ? 180.0 : 0.0);
        model_put(m, liner, (point){ x, side * 0.50, RADIUS }, side > 0.0 ? 0.0 : 180.0);
    }
    model_add_camera(m, (camera){ "front", { 4.1, -4.6, 1.35 }, { 0.20, 0.0, 0.55 }, 33.0 });
    model_add_camera(m, (camera){ "head light", { 3.1, -1.6, 0.95 }, { 1.95, -0.58, 0.60 }, 33.0 });
}
