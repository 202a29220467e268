/* data/glass/layout.c -- see glass.h: where all of it stands. */
#include "data/glass/glass.h"

#include <stddef.h>

#define TABLE_X 2.15
#define TABLE_Y 2.05
#define TOP     0.7502 /* m: what stands on the table keeps clear of it */

static point on_table(double x, double y) { return (point){ TABLE_X + x, TABLE_Y + y, TOP }; }

static void table_ware(model *m)
{
    static const double seats[][2] = {
        { -0.38, -0.26 }, { 0.38, -0.26 }, { -0.38, 0.26 }, { 0.38, 0.26 }
    };
    const int glass = model_add_shape(m, wine_glass()),
              china = model_add_shape(m, plate_of_china());
    for (int i = 0; i < COUNT(seats); i++) {
        const double x = seats[i][0], y = seats[i][1], in = y < 0.0 ? 1.0 : -1.0;
        model_put(m, china, on_table(x, y), 0.0);
        model_put(m, glass, on_table(x - 0.12 * in, y + 0.15 * in), 0.0);
    }
    model_put_new(m, carafe(), on_table(0.30, 0.06), 0.0);
    model_put_new(m, vase(), on_table(-0.62, 0.02), 0.0);
    model_put_new(m, glass_ball(), on_table(0.62, -0.02), 0.0);
    model_put_new(m, glass_block(), on_table(0.06, -0.28), 25.0);
    model_put_new(m, fruit_bowl(), on_table(-0.02, 0.06), 0.0);
}

static void furniture(model *m)
{
    model_put_new(m, carpet(), (point){ TABLE_X, TABLE_Y, 0.0 }, 0.0);
    model_put_new(m, dining_table(), (point){ TABLE_X, TABLE_Y, 0.0 }, 0.0);
    const int chair = model_add_shape(m, dining_chair());
    model_put(m, chair, (point){ TABLE_X - 0.38, TABLE_Y - 0.62, 0.0 }, 8.0);
    model_put(m, chair, (point){ TABLE_X + 0.42, TABLE_Y - 0.78, 0.0 }, -24.0);
    model_put(m, chair, (point){ TABLE_X - 0.38, TABLE_Y + 0.60, 0.0 }, 176.0);
    model_put(m, chair, (point){ TABLE_X + 0.38, TABLE_Y + 0.64, 0.0 }, 187.0);
    model_put_new(m, book_case(), (point){ 0.002, 3.20, 0.0 }, 90.0);
}

static void walls(model *m)
{
    model_put_new(m, room_shell(), (point){ 0 }, 0.0);
    model_put_new(m, window_frame(), (point){ 0.0, 1.7, 0.0 }, 90.0);
    model_put_new(m, curtain(), (point){ 0.16, 1.7, 0.0 }, 90.0);
    model_put_new(m, wall_mirror(), (point){ 1.75, 4.0, 1.72 }, 0.0);
    model_put_new(m, framed("Hills", PICTURE_1, 0.60, 0.45), (point){ 3.05, 4.0, 1.85 }, 0.0);
    model_put_new(m, framed("Blocks", PICTURE_2, 0.36, 0.48), (point){ 3.75, 4.0, 1.80 }, 0.0);
    model_put_new(m, framed("Rings", PICTURE_3, 0.44, 0.44), (point){ 4.40, 4.0, 1.80 }, 0.0);
    model_put_new(m, partition(), (point){ 3.40, 2.785, 0.0 }, 90.0);
    model_put_new(m, pendant(), (point){ TABLE_X, TABLE_Y, 1.75 }, 0.0);
}

void glass_build(model *m)
{
    m->title       = "Glass";
    m->maker       = "make_glass";
    m->paints      = glass_paints;
    m->paint_count = PAINT_COUNT;
    walls(m);
    furniture(m);
    table_ware(m);
    model_add_camera(m, (camera){ "room", { 4.75, 0.30, 1.60 }, { 1.75, 2.55, 0.95 }, 52.0 });
    model_add_camera(m, (camera){ "table", { 2.95, 1.05, 1.20 }, { 2.10, 2.08, 0.80 }, 40.0 });
}
