/* sim/scene_exterior.c -- what a study's patterns name in its scenes, and what is outside.
 *
 * A pattern names nodes, with all that hangs below, and materials. Where a surface is outside, its
 * material says so: one that is there on both sides is there twice, the second time as exterior,
 * and each placement has a table of what its file's materials are there.
 */
#include "sim/scene_build.h"

/* ---- patterns -------------------------------------------------------------------------------- */

/* Scratch of one file. */
typedef struct tree_work {
    int64_t *carrier;
    uint32_t *stack;
} tree_work;

static bool name_parts(scene_build *b, int i, const char *pattern, const tree_work *w,
                       named_parts *out)
{
    const gltf *g              = b->files[i];
    const scene_material *info = b->material_info.items;
    bool any                   = false;
    scene_node_carriers(g, pattern, w->carrier, w->stack);
    for (uint32_t k = 0; k < g->placement_count; k++)
        if (w->carrier[g->placements[k].node] >= 0)
            out->placements[k] = any = true;
    for (uint32_t m = 0; m < g->material_count; m++)
        if (info[b->first_material[i] + m].used && study_match(pattern, g->materials[m].name))
            out->materials[m] = any = true;
    return any;
}

bool scene_named_parts(scene_build *b, int i, const named_patterns *p, named_parts *out)
{
    const gltf *g   = b->files[i];
    arena scratch   = { 0 };
    size_t nodes    = (size_t)g->node_count + 1;
    tree_work w     = { .carrier = arena_array(&scratch, int64_t, nodes, b->err) };
    w.stack         = w.carrier ? arena_array(&scratch, uint32_t, nodes, b->err) : NULL;
    out->placements = arena_array(b->a, bool, (size_t)g->placement_count + 1, b->err);
    out->materials  = arena_array(b->a, bool, (size_t)g->material_count + 1, b->err);
    bool good       = w.stack && out->placements && out->materials;
    for (int k = 0; good && k < p->count; k++)
        if (!name_parts(b, i, p->list[k], &w, out)) {
            study_failed(b->study, b->study->scenes[i].where, b->err, ERR_ARGUMENT,
                         "`%s: %s` matches no node with surfaces and no material in use of %s",
                         p->key, p->list[k], b->study->scenes[i].file);
            good = false;
        }
    arena_clear(&scratch);
    return good;
}

/* ---- materials on both sides ----------------------------------------------------------------- */

typedef struct exterior_work {
    arena *scratch;
    named_parts *parts;     /* of each entry; placements NULL: nothing is outside */
    bool *inside, *outside; /* of each material of the scene: where it is met */
    uint32_t *as_exterior;  /* of each material of the scene */
} exterior_work;

static bool is_outside(const named_parts *p, uint32_t placement, uint32_t made)
{
    return p->placements && (p->placements[placement] || p->materials[made]);
}

/* The materials of each mesh of a file, none twice. */
typedef struct mesh_materials {
    uint32_t *first; /* of each mesh, and one more: in `list` */
    list made;       /* uint32_t */
} mesh_materials;

static bool find_mesh_materials(exterior_work *w, const gltf *g, mesh_materials *out,
                                lux_error *err)
{
    uint32_t *seen = arena_array(w->scratch, uint32_t, (size_t)g->material_count + 1, err);
    out->first     = arena_array(w->scratch, uint32_t, (size_t)g->mesh_count + 2, err);
    for (uint32_t m = 0; seen && out->first && m < g->mesh_count; m++) {
        const mesh *triangles = &g->meshes[m].triangles;
        for (uint32_t t = 0; t < triangles->triangle_count; t++) {
            uint32_t made = triangles->material ? triangles->material[t] : 0;
            if (seen[made] == m + 1)
                continue;
            seen[made]    = m + 1;
            uint32_t *new = list_new(&out->made, w->scratch, uint32_t, err);
            if (!new)
                return false;
            *new = made;
        }
        out->first[m + 1] = (uint32_t)out->made.count;
    }
    return seen && out->first;
}

/* Where the materials of one file are met. */
static bool look_at_file(scene_build *b, exterior_work *w, int i)
{
    const gltf *g      = b->files[i];
    mesh_materials all = { 0 };
    if (!find_mesh_materials(w, g, &all, b->err))
        return false;
    const uint32_t *made = all.made.items;
    for (int j = i; j < b->study->scene_count; j++)
        for (uint32_t k = 0; b->files[j] == g && k < g->placement_count; k++) {
            uint32_t m = g->placements[k].mesh;
            for (uint32_t n = all.first[m]; n < all.first[m + 1]; n++) {
                uint32_t number = b->first_material[j] + made[n];
                if (is_outside(&w->parts[j], k, made[n]))
                    w->outside[number] = true;
                else
                    w->inside[number] = true;
            }
        }
    return true;
}

/* A material that is met on both sides becomes two. */
static bool add_exteriors(scene_build *b, exterior_work *w, size_t count)
{
    for (size_t m = 0; m < count; m++) {
        w->as_exterior[m] = (uint32_t)m;
        if (w->outside[m] && w->inside[m]) {
            const material **made = list_new(&b->materials, b->a, const material *, b->err);
            scene_material *info  = list_new(&b->material_info, b->a, scene_material, b->err);
            if (!made || !info)
                return false;
            *made             = ((const material **)b->materials.items)[m];
            *info             = ((scene_material *)b->material_info.items)[m];
            w->as_exterior[m] = (uint32_t)b->materials.count - 1;
        }
        if (w->outside[m])
            ((scene_material *)b->material_info.items)[w->as_exterior[m]].exterior = true;
    }
    return true;
}

/* ---- tables ---------------------------------------------------------------------------------- */

/* Of entry i, with what `outside` names (NULL: all) as exterior. What is the same as `plain`, or as
 * the table of an entry before, is that one: then one mesh will do. */
static const uint32_t *table_of(scene_build *b, const exterior_work *w, int i, const bool *outside,
                                const placed_materials *before)
{
    const uint32_t *plain = b->placed_materials[i].plain;
    uint32_t count        = b->files[i]->material_count;
    uint32_t *table       = arena_array(b->a, uint32_t, (size_t)count + 1, b->err);
    for (uint32_t m = 0; table && m < count; m++)
        table[m] = !outside || outside[m] ? w->as_exterior[plain[m]] : plain[m];
    const uint32_t *known[] = { plain, before->inside, before->outside };
    for (int k = 0; table && k < 3; k++)
        if (!memcmp(table, known[k], count * sizeof *table))
            return known[k];
    return table;
}

static const uint32_t *plain_table(scene_build *b, int i)
{
    uint32_t count  = b->files[i]->material_count;
    uint32_t *table = arena_array(b->a, uint32_t, (size_t)count + 1, b->err);
    for (uint32_t m = 0; table && m < count; m++)
        table[m] = b->first_material[i] + m;
    return table;
}

static bool make_tables(scene_build *b, const exterior_work *w)
{
    for (int i = 0; i < b->study->scene_count; i++) {
        int first           = scene_first_use(b, i);
        placed_materials *p = &b->placed_materials[i];
        const bool *named   = w->parts ? w->parts[i].placements : NULL;
        p->plain            = first < i ? b->placed_materials[first].plain : plain_table(b, i);
        p->inside = p->outside = p->plain;
        p->placements          = named;
        int before             = i;
        while (before > first && (before == i || b->files[before] != b->files[i]))
            before--;
        if (named && p->plain) {
            const placed_materials known = b->placed_materials[before];
            p->inside                    = table_of(b, w, i, w->parts[i].materials, &known);
            p->outside                   = table_of(b, w, i, NULL, &known);
        }
        if (!p->inside || !p->outside)
            return false;
    }
    return true;
}

const uint32_t *scene_made_of(const scene_build *b, int i, uint32_t placement)
{
    const placed_materials *p = &b->placed_materials[i];
    return p->placements && p->placements[placement] ? p->outside : p->inside;
}

/* ---- the whole ------------------------------------------------------------------------------- */

static bool find_exteriors(scene_build *b, exterior_work *w)
{
    const study *s = b->study;
    size_t count   = b->materials.count;
    w->parts       = arena_array(b->a, named_parts, (size_t)s->scene_count + 1, b->err);
    w->inside      = arena_array(w->scratch, bool, count + 1, b->err);
    w->outside     = arena_array(w->scratch, bool, count + 1, b->err);
    w->as_exterior = arena_array(w->scratch, uint32_t, count + 1, b->err);
    if (!w->parts || !w->inside || !w->outside || !w->as_exterior)
        return false;
    for (int i = 0; i < s->scene_count; i++) {
        const study_scene *e = &s->scenes[i];
        named_patterns p     = { "exterior", e->exterior, e->exterior_count };
        if (p.count && !scene_named_parts(b, i, &p, &w->parts[i]))
            return false;
    }
    for (int i = 0; i < s->scene_count; i++)
        if (scene_first_use(b, i) == i && !look_at_file(b, w, i))
            return false;
    return add_exteriors(b, w, count);
}

bool build_exteriors(scene_build *b)
{
    arena scratch   = { 0 };
    exterior_work w = { .scratch = &scratch };
    size_t scenes   = (size_t)b->study->scene_count + 1;
    bool any        = false;
    for (int i = 0; i < b->study->scene_count; i++)
        any = any || b->study->scenes[i].exterior_count;
    b->placed_materials = arena_array(b->a, placed_materials, scenes, b->err);
    bool good = b->placed_materials && (!any || find_exteriors(b, &w)) && make_tables(b, &w);
    arena_clear(&scratch);
    return good;
}
