/* data/office/layout.c -- see layout.h.
 *
 *   y 7.2 +---------- windows, radiators -----------------+
 *         |                                      o   plant|
 *         |  [A4][A8]     [B4][B8]                  shelves|
 *         |  [A3][A7] ... two islands ...    table        |
 *         |                                      o        |
 *         |                                           door|
 *       0 +----- whiteboard ------------------- coat stand+
 *         0                                            10.8 x
 */
#include "data/office/layout.h"
#include "data/office/parts.h"

#include <math.h>
#include <string.h>

static void put_in(model *m, int parent, int shape_index, point at, double turn_deg)
{
    m->nodes[model_put(m, shape_index, at, turn_deg)].parent = parent;
}

/* ---- workplaces --------------------------------------------------------------------------- */

typedef struct workplace_parts {
    int desk, pedestal, monitor, keyboard, chair;
} workplace_parts;

/* Desk and all that belongs to it; a mirrored one has its drawers at the left hand. */
static void workplace(model *m, const workplace_parts *p, int number, point at, double turn_deg)
{
    static const double chair_turn[] = { 6, -18, 25, -4, 14, -30, 3, -11 };
    static const double chair_back[] = { 0.64, 0.68, 0.72, 0.63, 0.66, 0.74, 0.63, 0.69 };
    node n   = { .shape = NO_SHAPE, .parent = NO_PARENT, .at = at, .turn_deg = turn_deg };
    n.mirror = number % 2 == 1;
    snprintf(n.name, sizeof n.name, "Workplace %d", number + 1);

    const int here = model_add_node(m, n);
    put_in(m, here, p->desk, (point){ 0 }, 0.0);
    put_in(m, here, p->pedestal, (point){ 0.45, -0.07, 0.0 }, 0.0);
    if (number % 4 == 1) { /* two monitors, turned to the user */
        put_in(m, here, p->monitor, (point){ -0.33, 0.20, 0.722 }, 12.0);
        put_in(m, here, p->monitor, (point){ 0.33, 0.20, 0.722 }, -12.0);
    } else {
        put_in(m, here, p->monitor, (point){ -0.02, 0.20, 0.722 }, 0.0);
    }
    put_in(m, here, p->keyboard, (point){ -0.03, -0.20, 0.722 }, 0.0);
    put_in(m, here, p->chair, (point){ 0.02, -chair_back[number % 8], 0.0 },
           chair_turn[number % 8]);
}

static void islands(model *m, double detail)
{
    const workplace_parts p = {
        .desk     = model_add_shape(m, desk(detail)),
        .pedestal = model_add_shape(m, pedestal(detail)),
        .monitor  = model_add_shape(m, monitor(detail)),
        .keyboard = model_add_shape(m, keyboard(detail)),
        .chair    = model_add_shape(m, office_chair(detail)),
    };
    const int screen = model_add_shape(m, desk_screen(detail));
    const int bin    = model_add_shape(m, waste_bin(detail));

    for (int i = 0; i < 2; i++) {
        const double x = i ? 5.5 : 2.3, y = 3.9;
        for (int k = 0; k < 4; k++) {
            const double side = k < 2 ? -1.0 : 1.0; /* the western ones look east */
            workplace(m, &p, 4 * i + k, (point){ x + side * 0.42, y + (k % 2 ? 0.805 : -0.805), 0 },
                      side * 90.0);
        }
        model_put(m, screen, (point){ x, y, 0 }, 0.0);
        model_put(m, bin, (point){ x - 0.55, y - 1.85, 0 }, 0.0);
    }
}

/* ---- the rest of the furniture ------------------------------------------------------------ */

static void meeting_corner(model *m, double detail)
{
    static const double turns[] = { 40.0, 128.0, 215.0, 312.0 };
    const int table             = model_add_shape(m, meeting_table(detail));
    const int chair             = model_add_shape(m, meeting_chair(detail));
    const point middle          = { 8.7, 3.9, 0.0 };

    model_put(m, table, middle, 0.0);
    for (int i = 0; i < COUNT(turns); i++) {
        const double a = turns[i] * 3.14159265358979323846 / 180.0, r = 0.72 + 0.05 * (i % 2);
        const point at = { middle.x + r * cos(a), middle.y + r * sin(a), 0.0 };
        model_put(m, chair, (point){ round(at.x * 1e4) / 1e4, round(at.y * 1e4) / 1e4, 0.0 },
                  turns[i] + 90.0 + (i ? 0.0 : 14.0));
    }
}

static void along_walls(model *m, double detail)
{
    const int shelf[]  = { model_add_shape(m, bookshelf(detail, 7)),
                           model_add_shape(m, bookshelf(detail, 1234)) };
    const int heat     = model_add_shape(m, radiator(detail));
    const int greenery = model_add_shape(m, plant(detail));
    const int pillar   = model_add_shape(m, column(detail));

    for (int i = 0; i < 3; i++)
        model_put(m, shelf[i % 2], (point){ 10.78, 2.85 + 0.903 * i, 0.0 }, 0.0);
    for (int i = 0; i < 4; i++)
        model_put(m, heat, (point){ 1.56 + 2.56 * i, 7.08, 0.0 }, 0.0);
    model_put(m, greenery, (point){ 10.25, 6.45, 0.0 }, 20.0);
    model_put(m, pillar, (point){ 7.35, 1.80, 0.0 }, 0.0);
    model_put(m, pillar, (point){ 7.35, 6.00, 0.0 }, 0.0);
    model_put(m, model_add_shape(m, coat_stand(detail)), (point){ 10.35, 0.42, 0.0 }, 10.0);
    model_put(m, model_add_shape(m, whiteboard(detail)), (point){ 3.9, 0.0, 0.0 }, 0.0);
    model_put(m, model_add_shape(m, wall_clock(detail)), (point){ 0.0, 3.9, 2.2 }, 0.0);
}

/* ---- the building ------------------------------------------------------------------------- */

/* Where the luminaires sit: studies that place them repeat these. */
static const double panel_x[] = { 0.9, 3.9, 6.9 }, panel_y[] = { 2.7, 5.1 };
static const double downlight_x = 8.7, downlight_y[] = { 1.5, 3.9, 6.3 };

/* The grid, 0.6 m a module, between the friezes; cross bars a little higher than the runners. */
static void suspended_ceiling(model *m, double detail)
{
    const int along = model_add_shape(m, runner(detail, 9.62));
    const int cross = model_add_shape(m, runner(detail, 6.02));
    const int tiles = model_add_shape(m, tile_row(detail));
    const int lamp  = model_add_shape(m, panel(detail)),
              spot  = model_add_shape(m, downlight(detail));

    for (int j = 0; j < 9; j++)
        model_put(m, along, (point){ 0.59, 1.2 + 0.6 * j, 2.9 }, 0.0);
    for (int i = 0; i < 15; i++)
        model_put(m, cross, (point){ 1.2 + 0.6 * i, 0.59, 2.9007 }, 90.0);
    for (int j = 0; j < 10; j++)
        model_put(m, tiles, (point){ 0.59, 0.9 + 0.6 * j, 2.905 }, 0.0);
    for (int i = 0; i < 6; i++)
        model_put(m, lamp, (point){ panel_x[i % 3], panel_y[i / 3], 2.9043 }, 0.0);
    for (int i = 0; i < 3; i++)
        model_put(m, spot, (point){ downlight_x, downlight_y[i], 2.905 }, 0.0);
}

static void building(model *m, double detail)
{
    model_put(m, model_add_shape(m, shell(detail)), (point){ 0 }, 0.0);
    model_put(m, model_add_shape(m, skirting(detail)), (point){ 0 }, 0.0);
    const int window = model_add_shape(m, window_frame(detail));
    for (int i = 0; i < 4; i++)
        model_put(m, window, (point){ 1.56 + 2.56 * i, 7.2, 0.0 }, 0.0);
    model_put(m, model_add_shape(m, door(detail)), (point){ 10.8, 1.2, 0.0 }, 0.0);
    suspended_ceiling(m, detail);
}

void office_build(model *m, double detail)
{
    m->title       = "Office";
    m->maker       = "make_office";
    m->paints      = office_paints;
    m->paint_count = PAINT_COUNT;
    building(m, detail);
    islands(m, detail);
    meeting_corner(m, detail);
    along_walls(m, detail);
    model_add_camera(m, (camera){ "corner", { 0.45, 0.45, 1.6 }, { 6.5, 4.2, 0.9 }, 58.0 });
    model_add_camera(m, (camera){ "entrance", { 10.25, 2.0, 1.6 }, { 4.5, 3.9, 1.0 }, 58.0 });
}

/* ---- for the benchmark -------------------------------------------------------------------- */

static uint32_t triangles_at(double detail)
{
    model m = { 0 };
    office_build(&m, detail);
    const uint32_t n = model_triangles(&m);
    model_clear(&m);
    return n;
}

void bench_build(model *m, uint32_t triangles)
{
    /* Halve the interval of details: their triangles grow with it, by steps */
    double low = 1.0, high = 64.0;
    for (int i = 0; i < 24; i++) {
        const double middle                                = 0.5 * (low + high);
        *(triangles_at(middle) < triangles ? &low : &high) = middle;
    }
    model fine           = { 0 };
    const uint32_t under = triangles_at(low), over = triangles_at(high);
    office_build(&fine, triangles - under < over - triangles ? low : high);
    m->title       = fine.title;
    m->maker       = fine.maker;
    m->paints      = fine.paints;
    m->paint_count = fine.paint_count;
    model_put(m, model_add_shape(m, model_baked(&fine)), (point){ 0 }, 0.0);
    for (int i = 0; i < fine.camera_count; i++)
        model_add_camera(m, fine.cameras[i]);
    m->overflow |= fine.overflow;
    model_clear(&fine);
}
