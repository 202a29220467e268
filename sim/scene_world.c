/* sim/scene_world.c -- from rooms and glTF files to one traceable world.
 *
 * A mesh that stands in one place is baked, in double precision, into one common mesh: rays then
 * find no seam between walls that were modelled apart. What stands in several places is kept once
 * and placed by matrices. Triangles that let light straight through stand apart from the others:
 * each mesh falls into two halves.
 */
#include "sim/room.h"
#include "sim/scene_build.h"

#include <string.h>

/* ---- meshes and instances -------------------------------------------------------------------- */

enum { MOST_COPIED = 20000 }; /* triangles of all copies of a mesh */

/* What lets light straight through is met by other rays, and stands in meshes of its own. */
enum { OPAQUE, HOLLOW, HALVES };

typedef struct baked {
    vec3 *positions, *normals; /* normals, texcoord: as in a mesh, NULL where none has them */
    uint32_t *corners, *material;
    float *texcoord[2];
    uint32_t position_count, triangle_count;
} baked;

typedef struct world_parts {
    const bool *hollow;   /* of each material of the scene */
    bool texcoord[2];     /* some used material goes by texture coordinates of that set */
    baked common[HALVES]; /* what stands in one place */
    mesh *meshes;         /* the common ones first */
    uint32_t mesh_count;
    list instances;
} world_parts;

/* The triangles of a mesh that go into one half; `first`: the material 0 of its file. */
typedef struct half {
    const mesh *of;
    uint32_t first, count; /* count: of triangles */
    int which;
} half;

static uint32_t material_of(const half *h, uint32_t t)
{
    return h->first + (h->of->material ? h->of->material[t] : 0);
}

static bool is_of(const world_parts *w, const half *h, uint32_t t)
{
    return w->hollow[material_of(h, t)] == (h->which == HOLLOW);
}

static half half_of(const world_parts *w, const mesh *m, uint32_t first, int which)
{
    half h = { m, first, 0, which };
    for (uint32_t t = 0; t < m->triangle_count; t++)
        h.count += is_of(w, &h, t);
    return h;
}

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

/* What corner `from` of a mesh says, as the next triangle's corner c has it. */
static void bake_attributes(baked *to, int c, const mesh *m, size_t from, const transform *inverse)
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
        if (!is_of(w, h, t))
            continue;
        for (int c = 0; c < 3; c++) {
            size_t from = 3 * (size_t)t + (size_t)(mirrored && c ? 3 - c : c);
            to->corners[3 * (size_t)to->triangle_count + (size_t)c] = base + m->corners[from];
            bake_attributes(to, c, m, from, &inverse);
        }
        to->material[to->triangle_count++] = material_of(h, t);
    }
}

static void bake_file(scene_build *b, world_parts *w, int i)
{
    const study_scene *s = &b->study->scenes[i];
    const gltf *g        = b->files[i];
    for (uint32_t k = 0; k < g->placement_count; k++) {
        const gltf_placement *p = &g->placements[k];
        if (!is_baked(b, i, p->mesh))
            continue;
        for (int which = 0; which < HALVES; which++) {
            half h = half_of(w, &g->meshes[p->mesh].triangles, b->first_material[i], which);
            for (int c = 0; c < s->at_count; c++) {
                transform copy     = scene_copy_place(s, c);
                transform to_world = transform_product(&copy, &p->place);
                bake(b, w, &w->common[which], &h, &to_world);
            }
        }
    }
}

static void bake_room(scene_build *b, world_parts *w)
{
    dvec3 corner[ROOM_POSITIONS];
    uint32_t corners[3 * ROOM_TRIANGLES], made_of[ROOM_TRIANGLES];
    room_box(b->study->room.size, corner, corners, made_of);
    for (int which = 0; which < HALVES; which++) {
        baked *to = &w->common[which];
        for (int i = 0; i < ROOM_POSITIONS; i++)
            to->positions[i] = d3_to_float(d3_sub(corner[i], b->centre));
        to->position_count = ROOM_POSITIONS;
        for (uint32_t t = 0; t < ROOM_TRIANGLES; t++) {
            if (w->hollow[made_of[t]] != (which == HOLLOW))
                continue;
            memcpy(&to->corners[3 * to->triangle_count], &corners[3 * t], 3 * sizeof *corners);
            to->material[to->triangle_count++] = made_of[t];
        }
    }
}

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
        if (!is_of(w, h, t))
            continue;
        for (int c = 0; c < 3; c++) {
            size_t from                                             = 3 * (size_t)t + (size_t)c;
            to->corners[3 * (size_t)to->triangle_count + (size_t)c] = m->corners[from];
            bake_attributes(to, c, m, from, &unturned);
        }
        to->material[to->triangle_count++] = material_of(h, t);
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

/* The newest of w's meshes in all places where mesh m of scene i's file stands. */
static bool add_places(scene_build *b, world_parts *w, int i, uint32_t m, dvec3 moved, bool hollow)
{
    const gltf *g = b->files[i];
    for (int j = i; j < b->study->scene_count; j++) {
        const study_scene *s = &b->study->scenes[j];
        for (uint32_t k = 0; b->files[j] == g && k < g->placement_count; k++)
            for (int c = 0; g->placements[k].mesh == m && c < s->at_count; c++) {
                world_instance *in = list_new(&w->instances, b->a, world_instance, b->err);
                if (!in)
                    return false;
                transform copy = scene_copy_place(s, c);
                in->mesh       = w->mesh_count;
                in->hollow     = hollow;
                in->owner = b->owners[j] ? b->owners[j][(size_t)c * g->placement_count + k] : 0;
                in->place = transform_product(&copy, &g->placements[k].place);
                dvec3 o   = d3_sub(transform_point(&in->place, moved), b->centre);
                in->place.m[0][3] = o.x, in->place.m[1][3] = o.y, in->place.m[2][3] = o.z;
            }
    }
    w->mesh_count++;
    return true;
}

/* The meshes of scene i's file that stand in several places, with all their places. */
static bool add_instances(scene_build *b, world_parts *w, int i)
{
    const gltf *g = b->files[i];
    for (uint32_t m = 0; m < g->mesh_count; m++) {
        if (b->times[i][m] == 0 || is_baked(b, i, m))
            continue;
        for (int which = 0; which < HALVES; which++) {
            half h = half_of(w, &g->meshes[m].triangles, b->first_material[i], which);
            dvec3 moved;
            if (h.count &&
                !(keep_mesh(b, w, &h, &moved) && add_places(b, w, i, m, moved, which == HOLLOW)))
                return false;
        }
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
    baked_size size[HALVES] = { { ROOM_POSITIONS, ROOM_TRIANGLES },
                                { ROOM_POSITIONS, ROOM_TRIANGLES } };
    for (int i = 0; i < b->study->scene_count; i++) {
        const gltf *g = b->files[i];
        if (scene_first_use(b, i) != i)
            continue;
        meshes += HALVES * (size_t)g->mesh_count;
        for (uint32_t m = 0; m < g->mesh_count; m++)
            for (int which = 0; is_baked(b, i, m) && which < HALVES; which++) {
                half h = half_of(w, &g->meshes[m].triangles, b->first_material[i], which);
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
    if (!look_at_materials(b, w) || !make_room(b, w))
        return false;
    if (b->study->room.given)
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
        build_emitters(b, w.meshes, w.instances.items, (uint32_t)w.instances.count))
        made = world_new(b->a,
                         &(world_desc){ .meshes         = w.meshes,
                                        .mesh_count     = w.mesh_count,
                                        .instances      = w.instances.items,
                                        .instance_count = (uint32_t)w.instances.count,
                                        .threads        = b->options->threads },
                         b->err);
    for (uint32_t i = 0; i < w.mesh_count; i++)
        b->smooth |= w.meshes[i].normals != NULL;
    arena_clear(&scratch);
    return made;
}
