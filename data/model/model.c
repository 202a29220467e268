/* data/model/model.c -- see model.h: the tree of nodes, and all of it in one frame. */
#include "data/model/model.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

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

int model_put(model *m, int shape_index, point at, double turn_deg)
{
    const node n = { .shape = shape_index, .parent = NO_PARENT, .at = at, .turn_deg = turn_deg };
    const int i  = model_add_node(m, n);
    memcpy(m->nodes[i].name, m->shapes[shape_index].name, sizeof n.name);
    return i;
}

int model_put_new(model *m, shape s, point at, double turn_deg)
{
    return model_put(m, model_add_shape(m, s), at, turn_deg);
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
    shape all = shape_new(m->title, 1.0);
    for (int i = 0; i < m->node_count; i++)
        for (int k = 0; k < INK_MAX && m->nodes[i].shape != NO_SHAPE; k++) {
            all.ink = k;
            bake_patch(m, i, &m->shapes[m->nodes[i].shape].patches[k], &all);
        }
    return all;
}

/* The path is for messages, and has 4096 bytes. */
static FILE *open_in(const char *folder, const char *name, char *path)
{
    if (snprintf(path, 4096, "%s/%s", folder, name) < 4096)
        return fopen(path, "wb");
    errno = ENAMETOOLONG;
    return NULL;
}

static int finish(FILE *f, bool done, const char *path)
{
    if (f && fclose(f) == 0 && done)
        return EXIT_SUCCESS;
    perror(path);
    return EXIT_FAILURE;
}

int model_make_file(const char *folder, const char *name, bool (*write)(FILE *to))
{
    char path[4096];
    FILE *f         = open_in(folder, name, path);
    const bool done = f && write(f);
    return finish(f, done, path);
}

int model_make(const char *folder, const char *name, void (*build)(model *m))
{
    char path[4096];
    model m = { 0 };
    build(&m);
    fprintf(stderr, "%u triangles, %d shapes, %d nodes\n", model_triangles(&m), m.shape_count,
            m.node_count);
    FILE *f         = open_in(folder, name, path);
    const bool done = f && model_write_glb(&m, f);
    model_clear(&m);
    return finish(f, done, path);
}

int model_main(int argc, char **argv, const char *name, void (*build)(model *m))
{
    if (argc == 2 && argv[1][0] != '-')
        return model_make(argv[1], name, build);
    fprintf(stderr, "%s FOLDER: writes FOLDER/%s\n", argv[0], name);
    return 2;
}
