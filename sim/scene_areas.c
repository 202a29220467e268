/* sim/scene_areas.c -- how much surface there is of each material.
 *
 * A mesh is gone through once, however often it stands: a place of matrix M multiplies areas by
 * |det M|^(2/3), exactly where it scales all directions alike.
 */
#include "sim/scene_build.h"

static double area_factor(const transform *place)
{
    dvec3 x    = transform_vector(place, (dvec3){ 1, 0, 0 });
    dvec3 y    = transform_vector(place, (dvec3){ 0, 1, 0 });
    dvec3 z    = transform_vector(place, (dvec3){ 0, 0, 1 });
    double det = fabs(d3_dot(x, d3_cross(y, z)));
    return cbrt(det * det);
}

static void add_mesh(scene_material *info, const mesh *m, double factor)
{
    for (uint32_t t = 0; t < m->triangle_count; t++) {
        dvec3 p[3];
        for (uint32_t c = 0; c < 3; c++)
            p[c] = d3_from(m->positions[m->corners[3 * t + c]]);
        double area = 0.5 * d3_length(d3_cross(d3_sub(p[1], p[0]), d3_sub(p[2], p[0])));
        info[m->material ? m->material[t] : 0].area += factor * area;
    }
}

bool build_areas(scene_build *b, const mesh *meshes, const world_instance *instances,
                 uint32_t count)
{
    uint32_t mesh_count = 0;
    for (uint32_t i = 0; i < count; i++)
        mesh_count = instances[i].mesh >= mesh_count ? instances[i].mesh + 1 : mesh_count;
    arena scratch  = { 0 };
    double *factor = arena_array(&scratch, double, (size_t)mesh_count + 1, b->err);
    for (uint32_t i = 0; factor && i < count; i++)
        factor[instances[i].mesh] += area_factor(&instances[i].place);
    for (uint32_t k = 0; factor && k < mesh_count; k++)
        add_mesh(b->material_info.items, &meshes[k], factor[k]);
    arena_clear(&scratch);
    return factor != NULL;
}
