/* data/courtyard/courtyard.c -- see courtyard.h: where all of it stands.
 *
 *     y  8 +--- shelf ---+
 *          | sofa, rug   |
 *          |    room     |
 *          |    table    |
 *        0 +--[windows]--+           x 0 .. 4
 *   +---------- facade north ---------+
 *   | w                             e |
 *   | e        courtyard            a |   z = -3.6
 *   | s   lawn, trees, bench        s |
 *   | t                             t |
 *   +---------- facade south ---------+ y -13.2
 *  x -6                               10
 */
#include "data/courtyard/courtyard.h"

static void room(model *m)
{
    model_put_new(m, room_shell(), (point){ 0 }, 0.0);
    model_put_new(m, room_skirting(), (point){ 0 }, 0.0);
    model_put_new(m, room_window(), (point){ 0 }, 0.0);
    model_put_new(m, room_panes(), (point){ 0 }, 0.0);
    model_put_new(m, long_table(), (point){ 1.35, 2.0, 0.0 }, 0.0);
    const int chair = model_add_shape(m, wooden_chair());
    model_put(m, chair, (point){ 2.05, 1.55, 0.0 }, 82.0);
    model_put(m, chair, (point){ 2.10, 2.45, 0.0 }, 104.0);
    model_put(m, chair, (point){ 0.66, 2.10, 0.0 }, -96.0);
    model_put_new(m, sofa(), (point){ 0.03, 5.4, 0.0 }, 0.0);
    model_put_new(m, rug(), (point){ 1.75, 5.4, 0.0 }, 0.0);
    model_put_new(m, low_table(), (point){ 1.65, 5.45, 0.0 }, 0.0);
    model_put_new(m, shelf_with_books(), (point){ 2.0, 7.985, 0.0 }, 90.0);
    const int hung = model_add_shape(m, wall_picture());
    model_put(m, hung, (point){ 0.0, 5.4, 0.0 }, 0.0);
    model_put(m, hung, (point){ 4.0, 2.9, 0.0 }, 180.0);
}

static void yard(model *m)
{
    const int wing = model_add_shape(m, facade("Facade wing", 4));
    const int tree = model_add_shape(m, yard_tree());
    model_put_new(m, own_facade(), (point){ 0 }, 0.0);
    model_put_new(m, facade("Facade south", 5), (point){ YARD_EAST, -13.2, YARD }, 180.0);
    model_put(m, wing, (point){ YARD_WEST, -13.2, YARD }, 90.0);
    model_put(m, wing, (point){ YARD_EAST, -0.4, YARD }, -90.0);
    model_put_new(m, yard_ground(), (point){ 0 }, 0.0);
    model_put(m, tree, (point){ 6.4, -7.4, YARD }, 0.0);
    model_put(m, tree, (point){ 2.4, -10.3, YARD }, 130.0);
    model_put_new(m, yard_bench(), (point){ 2.0, -5.2, YARD }, 0.0);
}

void courtyard_build(model *m)
{
    m->title       = "Courtyard";
    m->maker       = "make_courtyard";
    m->paints      = courtyard_paints;
    m->paint_count = PAINT_COUNT;
    room(m);
    yard(m);
    model_add_camera(m, (camera){ "room", { 3.55, 7.55, 1.60 }, { 1.55, 0.0, 1.15 }, 52.0 });
    model_add_camera(m, (camera){ "yard", { -4.4, -12.2, -1.95 }, { 3.6, -0.4, -0.1 }, 56.0 });
}
