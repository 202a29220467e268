/* sim/scene_world.c -- from rooms and glTF files to one traceable world.
 *
 * A mesh that stands in one place is baked, in double precision, into one common mesh: rays then
 * find no seam between walls that were modelled apart. What stands in several places is kept once
 * and placed by matrices. Triangles that let light straight through stand apart from the others:
 * each mesh falls into two halves.
 */
#include "sim/scene_world_parts.h"

/* ---- what stands in several ------------------------------------------------------------------ */

/* The middle of a mesh's box. */
static dvec3 middle_of(const mesh *m)
{
    dvec3 low = { HUGE_VAL, HUGE_VAL, HUGE_VAL }, high = { -HUGE_VAL, -HUGE_VAL, -HUGE_VAL };
    for (uint32_t v = 0; v < m->position_count; v++) {
        dvec3 p = d3_from(m->positions[v]);
        low     = (dvec3){ fmin(low.x, p.x), fmin(low.y, p.y), fmin(low.z, p.z) };
        high    = (dvec3){ fmax(high.x, p.x), fmax(high.y, p.y), fmax(high.z, p.z) };
    }
    if (m->position_count == 0)
        return (dvec3){ 0, 0, 0 };
    return d3_rounded(d3_scale(d3_add(low, high), 0.5));
}

static bool keep_triangles(scene_build *b, const world_parts *w, const half *h, baked *to)
{
    const mesh *m        = h->of;
    const size_t corners = 3 * (size_t)h->count;
    to->corners          = arena_array(b->a, uint32_t, corners, b->err);
    to->material         = arena_array(b->a, uint32_t, h->count, b->err);
    if (!to->corners || !to->material)
        return false;
    for (int k = 0; k < 2; k++)
        if (m->texcoord[k] && w->texcoord[k] &&
            !(to->texcoord[k] = arena_array(b->a, float, 2 * corners, b->err)))
            return false;
    if (m->normals && !(to->normals = arena_array(b->a, vec3, corners, b->err)))
        return false;
    transform unturned = TRANSFORM_IDENTITY;
    for (uint32_t t = 0; t < m->triangle_count; t++) {
        if (!half_has(w, h, t))
            continue;
        for (int c = 0; c < 3; c++) {
            size_t from                                             = 3 * (size_t)t + (size_t)c;
            to->corners[3 * (size_t)to->triangle_count + (size_t)c] = m->corners[from];
            bake_corner(to, c, m, from, &unturned);
        }
        to->material[to->triangle_count++] = half_material(h, t);
    }
    return true;
}

static mesh mesh_of(const baked *from)
{
    return (mesh){ .positions      = from->positions,
                   .corners        = from->corners,
                   .material       = from->material,
                   .position_count = from->position_count,
                   .triangle_count = from->triangle_count,
                   .texcoord       = { from->texcoord[0], from->texcoord[1] },
                   .normals        = from->normals };
}

/* A placed mesh keeps its own frame, moved to the middle of its box: a mesh far from its origin
 * loses nothing in single precision. */
static bool keep_mesh(scene_build *b, world_parts *w, const half *h, dvec3 *moved)
{
    const mesh *m = h->of;
    baked to      = { .positions      = arena_array(b->a, vec3, m->position_count, b->err),
                      .position_count = m->position_count };
    if (!to.positions || !keep_triangles(b, w, h, &to))
        return false;
    *moved = middle_of(m);
    for (uint32_t v = 0; v < m->position_count; v++)
        to.positions[v] = d3_to_float(d3_sub(d3_from(m->positions[v]), *moved));
    w->meshes[w->mesh_count] = mesh_of(&to);
    return true;
}

/* The newest of w's meshes in all places where mesh m of scene i's file stands, made of those
 * materials. */
static bool add_places(scene_build *b, world_parts *w, int i, uint32_t m, const half *h,
                       dvec3 moved)
{
    const gltf *g = b->files[i];
    for (int j = i; j < b->study->scene_count; j++) {
        const study_scene *s = &b->study->scenes[j];
        for (uint32_t k = 0; b->files[j] == g && k < g->placement_count; k++) {
            if (g->placements[k].mesh != m || scene_made_of(b, j, k) != h->made_of)
                continue;
            for (int c = 0; c < s->at_count; c++) {
                world_instance *in = list_new(&w->instances, b->a, world_instance, b->err);
                if (!in)
                    return false;
                transform copy = scene_copy_place(s, c);
                in->mesh       = w->mesh_count;
                in->hollow     = h->which == HOLLOW;
                in->owner = b->owners[j] ? b->owners[j][(size_t)c * g->placement_count + k] : 0;
                in->place = transform_product(&copy, &g->placements[k].place);
                dvec3 o   = d3_sub(transform_point(&in->place, moved), b->centre);
                in->place.m[0][3] = o.x, in->place.m[1][3] = o.y, in->place.m[2][3] = o.z;
            }
        }
    }
    w->mesh_count++;
    return true;
}

/* Mesh m of scene i's file as it is made of some materials. */
static bool add_mesh(scene_build *b, world_parts *w, int i, uint32_t m, const uint32_t *made_of)
{
    for (int which = 0; which < HALVES; which++) {
        half h = half_of(w, &b->files[i]->meshes[m].triangles, made_of, which);
        dvec3 moved;
        if (h.count && !(keep_mesh(b, w, &h, &moved) && add_places(b, w, i, m, &h, moved)))
            return false;
    }
    return true;
}

/* Whether mesh m of scene i's file stands anywhere as made of those materials. */
static bool stands(const scene_build *b, int i, uint32_t m, const uint32_t *made_of)
{
    const gltf *g = b->files[i];
    for (int j = i; j < b->study->scene_count; j++)
        for (uint32_t k = 0; b->files[j] == g && k < g->placement_count; k++)
            if (g->placements[k].mesh == m && scene_made_of(b, j, k) == made_of)
                return true;
    return false;
}

static bool add_table(scene_build *b, list *to, const uint32_t *made_of)
{
    const uint32_t *const *all = to->items;
    for (size_t i = to->count; i-- > 0;)
        if (all[i] == made_of)
            return true;
    const uint32_t **new = list_new(to, b->a, const uint32_t *, b->err);
    if (new)
        *new = made_of;
    return new != NULL;
}

/* What the placements of scene i's file are made of: const uint32_t *, none twice. */
static bool find_tables(scene_build *b, int i, list *to)
{
    for (int j = i; j < b->study->scene_count; j++) {
        const placed_materials *p = &b->placed_materials[j];
        if (b->files[j] == b->files[i] &&
            !(add_table(b, to, p->inside) && add_table(b, to, p->outside)))
            return false;
    }
    return true;
}

/* The meshes of scene i's file that stand in several places, with all their places. */
static bool add_instances(scene_build *b, world_parts *w, int i)
{
    list tables = { 0 };
    if (!find_tables(b, i, &tables))
        return false;
    const uint32_t *const *all = tables.items;
    for (uint32_t m = 0; m < b->files[i]->mesh_count; m++) {
        if (b->times[i][m] == 0 || mesh_is_baked(b, i, m))
            continue;
        for (size_t k = 0; k < tables.count; k++)
            if (stands(b, i, m, all[k]) && !add_mesh(b, w, i, m, all[k]))
                return false;
    }
    return true;
}

/* ---- the whole ------------------------------------------------------------------------------- */

/* What the common mesh of a half is to hold, at most. */
typedef struct baked_size {
    size_t positions, triangles;
    bool texcoord[2], normals;
} baked_size;

static void count_mesh(const world_parts *w, const half *h, size_t times, baked_size *to)
{
    if (!h->count)
        return;
    to->positions += times * h->of->position_count;
    to->triangles += times * h->count;
    to->normals |= h->of->normals != NULL;
    for (int k = 0; k < 2; k++)
        to->texcoord[k] |= h->of->texcoord[k] && w->texcoord[k];
}

static bool make_common(scene_build *b, const baked_size *size, baked *to)
{
    const size_t corners = 3 * size->triangles;
    if (size->triangles > UINT32_MAX / 4 || size->positions > UINT32_MAX / 4)
        return failed(b->err, ERR_ARGUMENT, "%s: %zu triangles are more than lux4 traces",
                      b->study->path, size->triangles);
    to->positions = arena_array(b->a, vec3, size->positions, b->err);
    to->corners   = arena_array(b->a, uint32_t, corners, b->err);
    to->material  = arena_array(b->a, uint32_t, size->triangles, b->err);
    if (!to->positions || !to->corners || !to->material)
        return false;
    for (int k = 0; k < 2; k++)
        if (size->texcoord[k] && !(to->texcoord[k] = arena_array(b->a, float, 2 * corners, b->err)))
            return false;
    return !size->normals || (to->normals = arena_array(b->a, vec3, corners, b->err));
}

/* Room for everything, at most: each mesh baked once. */
static bool make_room(scene_build *b, world_parts *w)
{
    size_t meshes           = HALVES;
    baked_size room         = { w->room.position_count, w->room.triangle_count };
    baked_size size[HALVES] = { room, room };
    for (int i = 0; i < b->study->scene_count; i++) {
        const gltf *g = b->files[i];
        if (scene_first_use(b, i) != i)
            continue;
        list tables = { 0 };
        if (!find_tables(b, i, &tables))
            return false;
        meshes += HALVES * tables.count * g->mesh_count;
        for (uint32_t m = 0; m < g->mesh_count; m++)
            for (int which = 0; mesh_is_baked(b, i, m) && which < HALVES; which++) {
                half h = half_of(w, &g->meshes[m].triangles, b->placed_materials[i].plain, which);
                count_mesh(w, &h, b->times[i][m], &size[which]);
            }
    }
    w->meshes = arena_array(b->a, mesh, meshes, b->err);
    return w->meshes && make_common(b, &size[OPAQUE], &w->common[OPAQUE]) &&
           make_common(b, &size[HOLLOW], &w->common[HOLLOW]);
}

/* Which materials are hollow, and which texture coordinates some of them go by. */
static bool look_at_materials(scene_build *b, world_parts *w)
{
    const material *const *all = b->materials.items;
    const scene_material *info = b->material_info.items;
    bool *hollow               = arena_array(b->a, bool, b->materials.count + 1, b->err);
    for (size_t i = 0; hollow && i < b->materials.count; i++) {
        hollow[i]                  = material_is_hollow(all[i]);
        const material_textures *t = all[i]->textures;
        if (!t || !info[i].used)
            continue;
        texture_slot slots[TEXTURE_SLOTS];
        texture_slots(t, slots);
        for (int k = 0; k < TEXTURE_SLOTS; k++)
            if (slots[k].texture)
                w->texcoord[slots[k].set] = true;
    }
    return (w->hollow = hollow) != NULL;
}

/* The common mesh of each half that has triangles, of opaque ones in any case. */
static bool add_common(scene_build *b, world_parts *w)
{
    for (int which = 0; which < HALVES; which++) {
        if (which == HOLLOW && !w->common[which].triangle_count)
            continue;
        world_instance *in = list_new(&w->instances, b->a, world_instance, b->err);
        if (!in)
            return false;
        *in                        = (world_instance){ .mesh   = w->mesh_count,
                                                       .place  = TRANSFORM_IDENTITY,
                                                       .hollow = which == HOLLOW };
        w->meshes[w->mesh_count++] = mesh_of(&w->common[which]);
    }
    return true;
}

static bool collect(scene_build *b, world_parts *w)
{
    const study_room *room = &b->study->room;
    if (room->given && !room_make(b->a, room, &w->room, b->err))
        return false;
    if (!look_at_materials(b, w) || !make_room(b, w))
        return false;
    bake_room(b, w);
    for (int i = 0; i < b->study->scene_count; i++)
        bake_file(b, w, i);
    if (!add_common(b, w))
        return false;
    for (int i = 0; i < b->study->scene_count; i++)
        if (scene_first_use(b, i) == i && !add_instances(b, w, i))
            return false;
    return true;
}

world *build_world(scene_build *b)
{
    /* The meshes are copied by the world: what is made here goes again */
    arena scratch     = { 0 };
    scene_build local = *b;
    local.a           = &scratch;
    world_parts w     = { 0 };
    world *made       = NULL;
    if (collect(&local, &w) &&
        build_areas(b, w.meshes, w.instances.items, (uint32_t)w.instances.count) &&
        build_emitters(b, w.meshes, w.instances.items, (uint32_t)w.instances.count) &&
        mirrors_find(b->a, w.meshes, w.instances.items, (uint32_t)w.instances.count,
                     b->materials.items, &b->mirror_images, b->err))
        made = world_new(b->a,
                         &(world_desc){ .meshes         = w.meshes,
                                        .mesh_count     = w.mesh_count,
                                        .instances      = w.instances.items,
                                        .instance_count = (uint32_t)w.instances.count,
                                        .test           = b->options->measures.projection_test
                                                              ? TRIANGLE_PROJECTION
                                                              : TRIANGLE_WATERTIGHT,
                                        .threads        = b->options->threads },
                         b->err);
    for (uint32_t i = 0; i < w.mesh_count; i++)
        b->smooth |= w.meshes[i].normals != NULL;
    arena_clear(&scratch);
    return made;
}
