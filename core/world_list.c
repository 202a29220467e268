/* core/world_list.c -- see world.h: what there is, one after the other. */
#include "core/trace.h"

static const solid *mesh_of(const world *w, int32_t instance)
{
    return &w->meshes[w->instances[instance].mesh];
}

int32_t world_instances(const world *w) { return (int32_t)w->instance_count; }

int32_t world_triangles(const world *w, int32_t instance)
{
    return (int32_t)mesh_of(w, instance)->triangle_count;
}

int32_t world_owner(const world *w, int32_t instance) { return w->instances[instance].owner; }

uint32_t world_mesh(const world *w, int32_t instance) { return w->instances[instance].mesh; }

uint32_t world_triangle(const world *w, int32_t instance, int32_t triangle, dvec3 corner[3])
{
    const solid *m = mesh_of(w, instance);
    const float *p = m->corners + (size_t)9 * (size_t)triangle;
    for (int i = 0; i < 3; i++)
        corner[i] = d3_from((vec3){ p[3 * i], p[3 * i + 1], p[3 * i + 2] });
    return m->material ? m->material[triangle] : 0;
}

transform world_place(const world *w, int32_t instance)
{
    transform t;
    for (int i = 0; i < 12; i++)
        t.m[i / 4][i % 4] = (double)w->instances[instance].to_world[i / 4][i % 4];
    return t;
}
