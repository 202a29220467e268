/* sim/scene_bake.c -- meshes that stand in one place, or are small, become one common mesh, in
 * double precision.
 */
#include "sim/scene_world_parts.h"

#include <string.h>

/* ---- which ----------------------------------------------------------------------------------- */

enum { MOST_COPIED = 20000 }; /* triangles of all copies of a mesh */

half half_of(const world_parts *w, const mesh *m, const uint32_t *made_of, int which)
{
    half h = { m, made_of, 0, which };
    for (uint32_t t = 0; t < m->triangle_count; t++)
        h.count += half_has(w, &h, t);
    return h;
}

/* A mesh is baked if it stands once, or is so small that copies cost little. One that is
 * a lamp's body stays itself. */
bool mesh_is_baked(const scene_build *b, int i, uint32_t mesh_index)
{
    double times      = b->times[i][mesh_index];
    const bool *owned = b->owned[scene_first_use(b, i)];
    if (owned && owned[mesh_index])
        return false;
    return times == 1.0 ||
           times * b->files[i]->meshes[mesh_index].triangles.triangle_count <= MOST_COPIED;
}

/* ---- what stands in one place ---------------------------------------------------------------- */

/* Square to what it was square to: by the inverse, transposed; on the front side though the place
 * mirrors. (0, 0, 0) of what has no length. */
static vec3 placed_normal(const transform *inverse, vec3 normal)
{
    const double(*m)[4] = inverse->m;
    dvec3 n             = d3_from(normal);
    dvec3 to            = { m[0][0] * n.x + m[1][0] * n.y + m[2][0] * n.z,
                            m[0][1] * n.x + m[1][1] * n.y + m[2][1] * n.z,
                            m[0][2] * n.x + m[1][2] * n.y + m[2][2] * n.z };
    double length       = d3_length(to);
    if (!(length > 0.0 && isfinite(length)))
        return (vec3){ 0, 0, 0 };
    return d3_to_float(d3_scale(to, 1.0 / length));
}

void bake_corner(baked *to, int c, const mesh *m, size_t from, const transform *inverse)
{
    size_t at = 3 * (size_t)to->triangle_count + (size_t)c;
    for (int k = 0; k < 2; k++)
        if (to->texcoord[k] && m->texcoord[k])
            memcpy(&to->texcoord[k][2 * at], &m->texcoord[k][2 * from], 2 * sizeof(float));
    if (to->normals && m->normals)
        to->normals[at] = placed_normal(inverse, m->normals[from]);
}

static void bake(scene_build *b, const world_parts *w, baked *to, const half *h,
                 const transform *place)
{
    const mesh *m = h->of;
    uint32_t base = to->position_count;
    if (!h->count)
        return;
    for (uint32_t v = 0; v < m->position_count; v++) {
        dvec3 p                             = transform_point(place, d3_from(m->positions[v]));
        to->positions[to->position_count++] = d3_to_float(d3_sub(p, b->centre));
    }
    transform inverse = transform_inverse(place);
    bool mirrored     = transform_determinant(place) < 0.0; /* the front stays the front */
    for (uint32_t t = 0; t < m->triangle_count; t++) {
        if (!half_has(w, h, t))
            continue;
        for (int c = 0; c < 3; c++) {
            size_t from = 3 * (size_t)t + (size_t)(mirrored && c ? 3 - c : c);
            to->corners[3 * (size_t)to->triangle_count + (size_t)c] = base + m->corners[from];
            bake_corner(to, c, m, from, &inverse);
        }
        to->material[to->triangle_count++] = half_material(h, t);
    }
}

void bake_file(scene_build *b, world_parts *w, int i)
{
    const study_scene *s = &b->study->scenes[i];
    const gltf *g        = b->files[i];
    for (uint32_t k = 0; k < g->placement_count; k++) {
        const gltf_placement *p = &g->placements[k];
        if (!mesh_is_baked(b, i, p->mesh))
            continue;
        for (int which = 0; which < HALVES; which++) {
            half h = half_of(w, &g->meshes[p->mesh].triangles, scene_made_of(b, i, k), which);
            for (int c = 0; c < s->at_count; c++) {
                transform copy     = scene_copy_place(s, c);
                transform to_world = transform_product(&copy, &p->place);
                bake(b, w, &w->common[which], &h, &to_world);
            }
        }
    }
}

/* Walls and panes lie in halves of their own, each with all corners of the room. */
void bake_room(scene_build *b, world_parts *w)
{
    const room_mesh *r = &w->room;
    for (int which = 0; which < HALVES; which++) {
        baked *to = &w->common[which];
        for (uint32_t i = 0; i < r->position_count; i++)
            to->positions[i] = d3_to_float(d3_sub(r->positions[i], b->centre));
        to->position_count = r->position_count;
        for (uint32_t t = 0; t < r->triangle_count; t++) {
            if (w->hollow[r->material[t]] != (which == HOLLOW))
                continue;
            memcpy(&to->corners[3 * (size_t)to->triangle_count], &r->corners[3 * (size_t)t],
                   3 * sizeof *r->corners);
            to->material[to->triangle_count++] = r->material[t];
        }
    }
}
