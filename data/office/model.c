/* data/office/model.c -- see model.h: the tree of nodes, and all of it in one frame. */
#include "data/office/model.h"

#include <math.h>
#include <string.h>

static const paint paints[MATERIAL_COUNT] = {
    [CARPET]     = { "Floor carpet", { 0.185, 0.200, 0.230 } },
    [WALL]       = { "Wall paint", { 0.62, 0.60, 0.56 } },
    [ACCENT]     = { "Wall accent", { 0.36, 0.46, 0.47 } },
    [CEILING]    = { "Ceiling tile", { 0.80, 0.80, 0.79 } },
    [BAR]        = { "Ceiling T-bar", { 0.72, 0.72, 0.71 } },
    [CONCRETE]   = { "Concrete", { 0.42, 0.41, 0.39 } },
    [NIGHT]      = { "Night", { 0.015, 0.018, 0.030 } },
    [PAINT]      = { "White lacquer", { 0.76, 0.76, 0.74 } },
    [WOOD]       = { "Desk wood", { 0.60, 0.44, 0.27 } },
    [DOOR_WOOD]  = { "Door wood", { 0.40, 0.23, 0.12 } },
    [METAL]      = { "Metal grey", { 0.40, 0.40, 0.41 } },
    [DARK_METAL] = { "Metal dark", { 0.12, 0.12, 0.13 } },
    [PLASTIC]    = { "Plastic grey", { 0.22, 0.22, 0.23 } },
    [BLACK]      = { "Monitor black", { 0.030, 0.030, 0.032 } },
    [FABRIC]     = { "Chair fabric", { 0.070, 0.085, 0.120 } },
    [SEAT]       = { "Chair shell", { 0.55, 0.20, 0.08 } },
    [SCREEN]     = { "Desk screen", { 0.25, 0.38, 0.36 } },
    [DIFFUSER]   = { "Luminaire diffuser", { 0.84, 0.84, 0.84 } },
    [BOARD]      = { "Whiteboard", { 0.80, 0.81, 0.81 } },
    [PAPER]      = { "Paper", { 0.78, 0.77, 0.73 } },
    [POT]        = { "Plant pot", { 0.42, 0.19, 0.11 } },
    [SOIL]       = { "Plant soil", { 0.060, 0.045, 0.035 } },
    [LEAF]       = { "Plant leaf", { 0.075, 0.230, 0.050 } },
    [BOOK_RED]   = { "Book red", { 0.42, 0.06, 0.05 } },
    [BOOK_BLUE]  = { "Book blue", { 0.06, 0.14, 0.38 } },
    [BOOK_GREEN] = { "Book green", { 0.08, 0.26, 0.15 } },
    [BOOK_OCHRE] = { "Book ochre", { 0.62, 0.42, 0.10 } },
    [BOOK_WHITE] = { "Book white", { 0.74, 0.72, 0.66 } },
    [BOOK_BLACK] = { "Book black", { 0.045, 0.045, 0.050 } },
};

const paint *paint_of(material m) { return &paints[m]; }

int model_add_shape(model *m, shape s)
{
    m->overflow |= s.out_of_memory || m->shape_count == SHAPE_MAX;
    if (m->shape_count == SHAPE_MAX) {
        solid_clear(&s);
        return 0;
    }
    m->shapes[m->shape_count] = s;
    return m->shape_count++;
}

int model_add_node(model *m, node n)
{
    if (m->node_count == NODE_MAX) {
        m->overflow = true;
        return 0;
    }
    m->nodes[m->node_count] = n;
    return m->node_count++;
}

void model_add_camera(model *m, camera c)
{
    if (m->camera_count == CAMERA_MAX)
        m->overflow = true;
    else
        m->cameras[m->camera_count++] = c;
}

void model_clear(model *m)
{
    for (int i = 0; i < m->shape_count; i++)
        solid_clear(&m->shapes[i]);
    m->shape_count = m->node_count = m->camera_count = 0;
}

uint32_t model_triangles(const model *m)
{
    uint32_t n = 0;
    for (int i = 0; i < m->node_count; i++)
        if (m->nodes[i].shape != NO_SHAPE)
            n += shape_triangles(&m->shapes[m->nodes[i].shape]);
    return n;
}

/* From the frame of node i to the world's. */
static point placed(const model *m, int i, point p)
{
    for (; i != NO_PARENT; i = m->nodes[i].parent) {
        const node *n  = &m->nodes[i];
        const double a = n->turn_deg * (3.14159265358979323846 / 180.0);
        const double x = n->mirror ? -p.x : p.x, y = p.y;
        p = (point){ n->at.x + x * cos(a) - y * sin(a), n->at.y + x * sin(a) + y * cos(a),
                     n->at.z + p.z };
    }
    return p;
}

static bool mirrored(const model *m, int i)
{
    bool odd = false;
    for (; i != NO_PARENT; i = m->nodes[i].parent)
        odd ^= m->nodes[i].mirror;
    return odd;
}

static void bake_patch(const model *m, int n, const patch *t, shape *to)
{
    patch *out           = &to->patches[to->ink];
    const uint32_t first = out->vertex_count;
    for (uint32_t i = 0; i < t->vertex_count; i++) {
        const float *p = t->xyz + 3 * i;
        add_vertex(to, placed(m, n, (point){ (double)p[0], (double)p[1], (double)p[2] }));
    }
    const int second = mirrored(m, n) ? 2 : 1; /* a mirror turns faces inside out */
    for (uint32_t i = 0; i < t->triangle_count; i++) {
        const uint32_t *c = t->corners + 3 * i;
        add_triangle(to, first + c[0], first + c[second], first + c[3 - second]);
    }
}

shape model_baked(const model *m)
{
    shape all = shape_new("Office", 1.0);
    for (int i = 0; i < m->node_count; i++)
        for (int k = 0; k < MATERIAL_COUNT && m->nodes[i].shape != NO_SHAPE; k++) {
            all.ink = (material)k;
            bake_patch(m, i, &m->shapes[m->nodes[i].shape].patches[k], &all);
        }
    return all;
}
