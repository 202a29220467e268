/* sim/scene_materials.c -- the materials of room and glTF files, and what the study says of them.
 *
 * A rough, non-metallic glTF material is matt: its base colour is its diffuse reflectance. What
 * glTF says beyond that (metal, gloss, transmission) is left out until it is simulated, and the
 * user is told: the base colour is then all that counts.
 */
#include "core/color.h"
#include "sim/scene_build.h"

/* Light dies out nowhere in a closed room whose surfaces give all of it back, and its illuminance
 * has no finite value. The whitest surfaces there are, of sintered PTFE, reflect 99 %. */
static const float most_reflectance = 0.995f;

static vec3 bounded(scene_build *b, vec3 reflectance, bool used)
{
    if (used && fmaxf(reflectance.x, fmaxf(reflectance.y, reflectance.z)) > most_reflectance)
        notice_add(b->notices,
                   "%s: some materials reflect more than 99.5 %%, as no real surface does: "
                   "taken as 99.5 %% (lux4 check lists them)",
                   b->study->path);
    return (vec3){ fminf(reflectance.x, most_reflectance), fminf(reflectance.y, most_reflectance),
                   fminf(reflectance.z, most_reflectance) };
}

static bool add(scene_build *b, const char *name, vec3 reflectance, vec3 emission, bool used)
{
    bool overridden = false;
    for (int i = 0; i < b->study->material_count; i++) { /* the last match wins */
        const study_material *m = &b->study->materials[i];
        if (study_match(m->match, name)) {
            reflectance = m->reflectance;
            overridden  = true;
        }
    }
    reflectance          = bounded(b, reflectance, used);
    diffuse_desc d       = { .reflectance    = reflectance,
                             .extra.emission = v3_scale(emission, 1.0f / (float)LUMENS_PER_WATT) };
    const material **m   = list_new(&b->materials, b->a, const material *, b->err);
    scene_material *info = list_new(&b->material_info, b->a, scene_material, b->err);
    const material *made = m && info ? material_diffuse(b->a, &d, b->err) : NULL;
    if (!made)
        return false;
    *m    = made;
    *info = (scene_material){ name, reflectance, emission, overridden, used };
    return true;
}

static void tell_what_is_left_out(scene_build *b, const char *file, const gltf_material *m)
{
    const char *name = m->name[0] ? m->name : "(unnamed)";
    if (m->metallic > 0.0f || m->roughness < 0.5f)
        notice_add(b->notices,
                   "%s: material \"%s\": gloss and metal are not supported yet: taken as matt, its "
                   "base colour as reflectance",
                   file, name);
    if (m->transmission > 0.0f || m->alpha < 1.0f)
        notice_add(b->notices,
                   "%s: material \"%s\": transparency is not supported yet: taken as opaque", file,
                   name);
}

/* Each pattern must match something: a misspelt one would be ignored in silence. */
static bool all_patterns_match(scene_build *b)
{
    const scene_material *info = b->material_info.items;
    for (int i = 0; i < b->study->material_count; i++) {
        const study_material *m = &b->study->materials[i];
        bool found              = false;
        for (size_t k = 0; k < b->material_info.count && !found; k++)
            found = study_match(m->match, info[k].name);
        if (!found)
            return study_failed(b->study, m->where, b->err, ERR_ARGUMENT,
                                "`%s` matches no material (lux4 check lists them)", m->match);
    }
    return true;
}

/* Which materials of a file some placed triangle is made of: the others are not worth a word. */
static bool *used_materials(scene_build *b, const gltf *g)
{
    bool *used   = arena_array(b->a, bool, g->material_count, b->err);
    bool *placed = used ? arena_array(b->a, bool, (size_t)g->mesh_count + 1, b->err) : NULL;
    if (!placed)
        return NULL;
    for (uint32_t k = 0; k < g->placement_count; k++)
        placed[g->placements[k].mesh] = true;
    for (uint32_t k = 0; k < g->mesh_count; k++) {
        const mesh *m = &g->meshes[k].triangles;
        for (uint32_t t = 0; placed[k] && t < m->triangle_count; t++)
            used[m->material ? m->material[t] : 0] = true;
    }
    return used;
}

static bool add_file(scene_build *b, const char *file, const gltf *g)
{
    const bool *used = used_materials(b, g);
    for (uint32_t k = 0; used && k < g->material_count; k++) {
        const gltf_material *m = &g->materials[k];
        if (!add(b, m->name, m->base_color, m->emission, used[k]))
            return false;
        if (used[k])
            tell_what_is_left_out(b, file, m);
    }
    return used != NULL;
}

bool build_materials(scene_build *b)
{
    const study *s  = b->study;
    uint32_t *first = arena_array(b->a, uint32_t, (size_t)s->scene_count + 1, b->err);
    if (!first)
        return false;
    if (s->room.given && !(add(b, "room: ceiling", s->room.ceiling, (vec3){ 0 }, true) &&
                           add(b, "room: walls", s->room.walls, (vec3){ 0 }, true) &&
                           add(b, "room: floor", s->room.floor, (vec3){ 0 }, true)))
        return false;
    for (int i = 0; i < s->scene_count; i++) {
        int before = scene_first_use(b, i);
        first[i]   = before < i ? first[before] : (uint32_t)b->materials.count;
        if (before == i && !add_file(b, s->scenes[i].file, b->files[i]))
            return false;
    }
    b->first_material = first;
    return all_patterns_match(b);
}
