/* sim/scene_world.c -- from rooms and glTF files to one traceable world.
 *
 * A mesh that stands in one place is baked, in double precision, into one common mesh: rays then
 * find no seam between walls that were modelled apart. What stands in several places is kept once
 * and placed by matrices.
 */
#include "sim/room.h"
#include "sim/scene_build.h"

#include <string.h>

/* ---- meshes and instances -------------------------------------------------------------------- */

enum { MOST_COPIED = 20000 }; /* triangles of all copies of a mesh */

typedef struct baked {
    vec3 *positions;
    uint32_t *corners, *material;
    uint32_t position_count, triangle_count;
} baked;

typedef struct world_parts {
    baked common;
    mesh *meshes; /* the common one first */
    uint32_t mesh_count;
    list instances;
} world_parts;

/* A mesh is baked if it stands once, or is so small that copies cost little: see above. One that is
 * a lamp's body stays itself. */
static bool is_baked(const scene_build *b, int i, uint32_t mesh_index)
{
    double times      = b->times[i][mesh_index];
    const bool *owned = b->owned[scene_first_use(b, i)];
    if (owned && owned[mesh_index])
        return false;
    return times == 1.0 ||
           times * b->files[i]->meshes[mesh_index].triangles.triangle_count <= MOST_COPIED;
}

static void bake(scene_build *b, baked *to, const mesh *m, const transform *place, uint32_t first)
{
    uint32_t base = to->position_count;
    for (uint32_t v = 0; v < m->position_count; v++) {
        dvec3 p                             = transform_point(place, d3_from(m->positions[v]));
        to->positions[to->position_count++] = d3_to_float(d3_sub(p, b->centre));
    }
    bool mirrored = transform_determinant(place) < 0.0;
    for (uint32_t t = 0; t < m->triangle_count; t++, to->triangle_count++) {
        const uint32_t *c = &m->corners[3 * t];
        uint32_t *d       = &to->corners[3 * to->triangle_count];
        d[0]              = base + c[0];
        d[1]              = base + c[mirrored ? 2 : 1]; /* the front stays the front */
        d[2]              = base + c[mirrored ? 1 : 2];
        to->material[to->triangle_count] = first + (m->material ? m->material[t] : 0);
    }
}

/* A placed mesh keeps its own frame, moved to the middle of its box: a mesh far from its origin
 * loses nothing in single precision. */
static bool keep_mesh(scene_build *b, mesh *to, dvec3 *moved, const mesh *m, uint32_t first)
{
    vec3 *positions   = arena_array(b->a, vec3, m->position_count, b->err);
    uint32_t *made_of = arena_array(b->a, uint32_t, m->triangle_count, b->err);
    if (!positions || !made_of)
        return false;
    dvec3 low = { HUGE_VAL, HUGE_VAL, HUGE_VAL }, high = { -HUGE_VAL, -HUGE_VAL, -HUGE_VAL };
    for (uint32_t v = 0; v < m->position_count; v++) {
        dvec3 p = d3_from(m->positions[v]);
        low     = (dvec3){ fmin(low.x, p.x), fmin(low.y, p.y), fmin(low.z, p.z) };
        high    = (dvec3){ fmax(high.x, p.x), fmax(high.y, p.y), fmax(high.z, p.z) };
    }
    *moved = d3_rounded(d3_scale(d3_add(low, high), 0.5));
    if (m->position_count == 0)
        *moved = (dvec3){ 0, 0, 0 };
    for (uint32_t v = 0; v < m->position_count; v++)
        positions[v] = d3_to_float(d3_sub(d3_from(m->positions[v]), *moved));
    for (uint32_t t = 0; t < m->triangle_count; t++)
        made_of[t] = first + (m->material ? m->material[t] : 0);
    *to           = *m;
    to->positions = positions;
    to->material  = made_of;
    return true;
}

/* The meshes of scene i's file that stand in several places, with all their places. */
static bool add_instances(scene_build *b, world_parts *w, int i)
{
    const gltf *g = b->files[i];
    for (uint32_t m = 0; m < g->mesh_count; m++) {
        if (b->times[i][m] == 0 || is_baked(b, i, m))
            continue;
        dvec3 moved;
        if (!keep_mesh(b, &w->meshes[w->mesh_count], &moved, &g->meshes[m].triangles,
                       b->first_material[i]))
            return false;
        for (int j = i; j < b->study->scene_count; j++) {
            const study_scene *s = &b->study->scenes[j];
            for (uint32_t k = 0; b->files[j] == g && k < g->placement_count; k++)
                for (int c = 0; g->placements[k].mesh == m && c < s->at_count; c++) {
                    world_instance *in = list_new(&w->instances, b->a, world_instance, b->err);
                    if (!in)
                        return false;
                    transform copy = scene_copy_place(s, c);
                    in->mesh       = w->mesh_count;
                    in->owner = b->owners[j] ? b->owners[j][(size_t)c * g->placement_count + k] : 0;
                    in->place = transform_product(&copy, &g->placements[k].place);
                    dvec3 o   = d3_sub(transform_point(&in->place, moved), b->centre);
                    in->place.m[0][3] = o.x, in->place.m[1][3] = o.y, in->place.m[2][3] = o.z;
                }
        }
        w->mesh_count++;
    }
    return true;
}

static void bake_file(scene_build *b, baked *to, int i)
{
    const study_scene *s = &b->study->scenes[i];
    const gltf *g        = b->files[i];
    for (uint32_t k = 0; k < g->placement_count; k++) {
        const gltf_placement *p = &g->placements[k];
        for (int c = 0; is_baked(b, i, p->mesh) && c < s->at_count; c++) {
            transform copy     = scene_copy_place(s, c);
            transform to_world = transform_product(&copy, &p->place);
            bake(b, to, &g->meshes[p->mesh].triangles, &to_world, b->first_material[i]);
        }
    }
}

static void bake_room(scene_build *b, baked *to)
{
    dvec3 corner[ROOM_POSITIONS];
    room_box(b->study->room.size, corner, to->corners, to->material);
    for (int i = 0; i < ROOM_POSITIONS; i++)
        to->positions[i] = d3_to_float(d3_sub(corner[i], b->centre));
    to->position_count = ROOM_POSITIONS;
    to->triangle_count = ROOM_TRIANGLES;
}

/* Room for everything, at most: each mesh baked once. */
static bool make_room(scene_build *b, world_parts *w)
{
    size_t positions = ROOM_POSITIONS, triangles = ROOM_TRIANGLES, meshes = 1;
    for (int i = 0; i < b->study->scene_count; i++) {
        const gltf *g = b->files[i];
        if (scene_first_use(b, i) != i)
            continue;
        meshes += g->mesh_count;
        for (uint32_t m = 0; m < g->mesh_count; m++) {
            if (!is_baked(b, i, m))
                continue;
            size_t times = b->times[i][m];
            positions += times * g->meshes[m].triangles.position_count;
            triangles += times * g->meshes[m].triangles.triangle_count;
        }
    }
    if (triangles > UINT32_MAX / 4 || positions > UINT32_MAX / 4)
        return failed(b->err, ERR_ARGUMENT, "%s: %zu triangles are more than lux4 traces",
                      b->study->path, triangles);
    w->common.positions = arena_array(b->a, vec3, positions, b->err);
    w->common.corners   = arena_array(b->a, uint32_t, 3 * triangles, b->err);
    w->common.material  = arena_array(b->a, uint32_t, triangles, b->err);
    w->meshes           = arena_array(b->a, mesh, meshes, b->err);
    return w->common.positions && w->common.corners && w->common.material && w->meshes;
}

world *build_world(scene_build *b)
{
    /* The meshes are copied by the world: what is made here goes again */
    arena scratch     = { 0 };
    scene_build local = *b;
    local.a           = &scratch;
    world_parts w     = { 0 };
    world *made       = NULL;
    if (!make_room(&local, &w))
        goto done;

    if (b->study->room.given)
        bake_room(&local, &w.common);
    for (int i = 0; i < b->study->scene_count; i++)
        bake_file(&local, &w.common, i);
    w.meshes[w.mesh_count++] = (mesh){ w.common.positions, w.common.corners, w.common.material,
                                       w.common.position_count, w.common.triangle_count };
    world_instance *in       = list_new(&w.instances, &scratch, world_instance, b->err);
    if (!in)
        goto done;
    *in = (world_instance){ .place = TRANSFORM_IDENTITY };
    for (int i = 0; i < b->study->scene_count; i++)
        if (scene_first_use(b, i) == i && !add_instances(&local, &w, i))
            goto done;

    if (!build_emitters(b, w.meshes, w.instances.items, (uint32_t)w.instances.count))
        goto done;
    made = world_new(b->a,
                     &(world_desc){ .meshes         = w.meshes,
                                    .mesh_count     = w.mesh_count,
                                    .instances      = w.instances.items,
                                    .instance_count = (uint32_t)w.instances.count,
                                    .threads        = b->options->threads },
                     b->err);
done:
    arena_clear(&scratch);
    return made;
}
