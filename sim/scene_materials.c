/* sim/scene_materials.c -- the materials of room and glTF files, and what the study says of them:
 * which there are, which are used, and what is known of each. What glTF's are taken for:
 * scene_material_gltf.c.
 */
#include "core/color.h"
#include "sim/room.h"
#include "sim/scene_build.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Light dies out nowhere in a closed room whose surfaces give all of it back, and its illuminance
 * has no finite value. The whitest surfaces there are, of sintered PTFE, reflect 99 %. */
static const float most_reflectance = 0.995f;

static const char windows_name[] = "room: windows";

/* What share of a surface is no hole, as materials_look() decides it place by place. */
double material_share_there(float openness, const material_textures *t)
{
    float alpha = 1.0f - openness;
    if (!t || t->alpha == ALPHA_OPAQUE)
        return (double)alpha;
    if (t->alpha == ALPHA_BLEND) {
        float mean[4] = { 1, 1, 1, 1 };
        if (t->base.texture)
            texture_mean(t->base.texture, mean);
        return fmin((double)alpha * (double)mean[3], 1.0);
    }
    if (!t->base.texture || t->cutoff <= 0.0f || alpha <= 0.0f)
        return alpha >= t->cutoff ? 1.0 : 0.0;
    return texture_share(t->base.texture, t->cutoff / alpha);
}

static float bounded(float share, float mean)
{
    return share * mean > most_reflectance ? most_reflectance / mean : share;
}

vec3 material_bounded(scene_build *b, const material_source *s, vec3 share, vec3 mean)
{
    vec3 to    = { bounded(share.x, mean.x), bounded(share.y, mean.y), bounded(share.z, mean.z) };
    float most = fmaxf(fmaxf(share.x * mean.x, share.y * mean.y), share.z * mean.z);
    material_extra extra = material_extra_of(s->from); /* the study leaves holes as they are */
    if (s->used && most > most_reflectance &&
        (double)most * material_share_there(extra.openness, extra.textures) >
            (double)most_reflectance &&
        b->bounded_count++ == 0)
        b->first_bounded = s->from->name;
    return to;
}

static void tell_bounded(const scene_build *b)
{
    int n = b->bounded_count;
    if (n > 0)
        notice_add(b->notices,
                   "%s: %d material%s more than 99.5 %%, as no real surface does, first \"%s\": "
                   "taken as 99.5 %%",
                   b->study->path, n, n > 1 ? "s reflect" : " reflects",
                   b->first_bounded[0] ? b->first_bounded : "(unnamed)");
}

/* ---- what is known --------------------------------------------------------------------------- */

static vec3 mean_emission(const material *m)
{
    float mean[4] = { 1, 1, 1, 1 };
    if (m->textures && m->textures->emission.texture)
        texture_mean(m->textures->emission.texture, mean);
    return v3_scale(v3_mul(m->look.emission, (vec3){ mean[0], mean[1], mean[2] }),
                    (float)LUMENS_PER_WATT);
}

static void describe(const material *m, scene_material *info)
{
    const material_textures *t = m->textures;
    info->kind                 = m->type->name;
    info->reflectance          = m->reflectance;
    info->transmittance        = m->transmittance;
    info->emission             = mean_emission(m);
    info->textured             = t != NULL;
    info->bumpy                = t && t->normal.texture;
    info->there                = material_share_there(m->look.openness, t);
    info->holes                = m->look.openness > 0.0f || (t && t->alpha != ALPHA_OPAQUE);
}

static bool add(scene_build *b, const material_source *s)
{
    const material **m   = list_new(&b->materials, b->a, const material *, b->err);
    scene_material *info = list_new(&b->material_info, b->a, scene_material, b->err);
    if (!m || !info)
        return false;
    gltf_material from  = *s->from;
    material_source own = *s;
    own.from            = &from;
    if (!material_leave_out(b, &from))
        return false;
    if (b->options->lamps_off)
        from.emission = (vec3){ 0, 0, 0 };
    *info = (scene_material){ .name = s->from->name, .overridden = s->instead, .used = s->used };
    *m    = s->instead ? material_of_study(b, &own, info) : material_of_gltf(b, &own, info);
    if (*m)
        describe(*m, info);
    return *m != NULL;
}

/* ---- textures -------------------------------------------------------------------------------- */

static int by_address(const void *one, const void *other)
{
    uintptr_t a = (uintptr_t) * (const texture *const *)one;
    uintptr_t b = (uintptr_t) * (const texture *const *)other;
    return a < b ? -1 : a > b;
}

bool scene_textures(scene_build *b, uint64_t *bytes, uint64_t *largest)
{
    const material *const *all = b->materials.items;
    arena scratch              = { 0 };
    size_t count               = 0;
    const texture **found =
        arena_array(&scratch, const texture *, TEXTURE_SLOTS * b->materials.count + 1, b->err);
    for (size_t i = 0; found && i < b->materials.count; i++) {
        texture_slot slots[TEXTURE_SLOTS];
        if (!all[i]->textures)
            continue;
        texture_slots(all[i]->textures, slots);
        for (int k = 0; k < TEXTURE_SLOTS; k++)
            if (slots[k].texture)
                found[count++] = slots[k].texture;
    }
    if (found)
        qsort(found, count, sizeof *found, by_address);
    for (size_t i = 0; i < count; i++)
        if (i == 0 || found[i] != found[i - 1]) {
            uint64_t picture = texture_picture_bytes(found[i]);
            *largest         = picture > *largest ? picture : *largest;
            *bytes += texture_bytes(found[i]);
        }
    arena_clear(&scratch);
    return found != NULL;
}

/* ---- patterns -------------------------------------------------------------------------------- */

/* The last match wins. */
static const study_material *match(const scene_build *b, const char *name)
{
    for (int i = b->study->material_count - 1; i >= 0; i--)
        if (study_match(b->study->materials[i].match, name))
            return &b->study->materials[i];
    return NULL;
}

/* "`Floor`, `Wall` and 5 more": what could have been meant. */
static void list_names(const scene_build *b, char *text, size_t size)
{
    const size_t of_rest       = 24; /* " and 4294967295 more" */
    const scene_material *info = b->material_info.items;
    size_t length = 0, left = 0;
    text[0] = '\0';
    for (size_t k = 0; k < b->material_info.count; k++) {
        const char *name = info[k].name;
        if (!info[k].used || !name[0])
            continue;
        if (left > 0 || length + strlen(name) + 4 + of_rest > size)
            left++;
        else
            length +=
                (size_t)snprintf(text + length, size - length, "%s`%s`", length ? ", " : "", name);
    }
    if (left > 0)
        snprintf(text + length, size - length, "%s%zu more", length ? " and " : "", left);
}

/* Each pattern must match something: a misspelt one would be ignored in silence. */
static bool all_patterns_match(scene_build *b)
{
    const scene_material *info = b->material_info.items;
    for (int i = 0; i < b->study->material_count; i++) {
        const study_material *m = &b->study->materials[i];
        bool found              = false;
        char names[240];
        for (size_t k = 0; k < b->material_info.count && !found; k++)
            found = study_match(m->match, info[k].name);
        if (found)
            continue;
        if (b->study->room.window_count && study_match(m->match, windows_name))
            return study_failed(b->study, m->where, b->err, ERR_ARGUMENT,
                                "`%s` matches no pane: the windows of the room are open holes "
                                "where they have no `transmittance`",
                                m->match);
        list_names(b, names, sizeof names);
        return study_failed(b->study, m->where, b->err, ERR_ARGUMENT,
                            "`%s` matches no material; there are %s", m->match,
                            names[0] ? names : "none with a name");
    }
    return true;
}

/* ---- rooms and files ------------------------------------------------------------------------- */

static bool add_side(scene_build *b, const char *name, vec3 reflectance)
{
    gltf_material *m = arena_new(b->a, gltf_material, b->err);
    if (!m)
        return false;
    *m                      = (gltf_material){ .name           = name,
                                               .base_color     = reflectance,
                                               .alpha          = 1.0f,
                                               .roughness      = 1.0f,
                                               .ior            = 1.5f,
                                               .specular       = 1.0f,
                                               .specular_color = { 1, 1, 1 } };
    const glass_shapes open = { .open = 1 };
    return add(b, &(material_source){ .file    = b->study->path,
                                      .from    = m,
                                      .instead = match(b, name),
                                      .glass   = &open,
                                      .scale   = 1.0,
                                      .used    = true });
}

/* Glass with the transmittance of window i, unless the study says otherwise. */
static bool add_pane(scene_build *b, int i)
{
    static const gltf_material any = { .name = windows_name, .alpha = 1.0f };
    const study_window *w          = &b->study->room.windows[i];
    float t                        = (float)w->transmittance;
    const glass_shapes open        = { .open = 1 };
    const study_material *instead  = match(b, any.name);
    const study_material glass     = { .where         = w->where,
                                       .match         = windows_name,
                                       .surface       = SURFACE_PANE,
                                       .exponent      = (double)NAN,
                                       .transmittance = { t, t, t },
                                       .ior           = 1.52 };
    if (!add(b, &(material_source){ .file    = b->study->path,
                                    .from    = &any,
                                    .instead = instead ? instead : &glass,
                                    .glass   = &open,
                                    .scale   = 1.0,
                                    .used    = true }))
        return false;
    scene_material *info                        = b->material_info.items;
    info[b->material_info.count - 1].overridden = instead != NULL;
    return true;
}

static bool add_room(scene_build *b)
{
    const study_room *r = &b->study->room;
    if (!r->given)
        return true;
    if (!add_side(b, "room: ceiling", r->ceiling) || !add_side(b, "room: walls", r->walls) ||
        !add_side(b, "room: floor", r->floor))
        return false;
    for (int i = 0, panes = 0; i < r->window_count; i++)
        if (room_pane(r, i) == panes && panes++ >= 0 && !add_pane(b, i))
            return false;
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

/* Lengths within materials are of one size only. */
static void tell_of_scales(scene_build *b, int i, const gltf *g)
{
    bool lengths = false;
    for (uint32_t k = 0; k < g->material_count; k++)
        lengths |= g->materials[k].volume && isfinite(g->materials[k].attenuation_distance);
    for (int j = i + 1; lengths && j < b->study->scene_count; j++)
        if (b->files[j] == g && b->study->scenes[j].scale != b->study->scenes[i].scale)
            notice_add(b->notices,
                       "%s: stands at several scales: its solids absorb light as at the first",
                       b->study->scenes[i].file);
}

static bool add_file(scene_build *b, int i)
{
    const gltf *g    = b->files[i];
    const bool *used = used_materials(b, g);
    bool *panes      = used ? arena_array(b->a, bool, g->material_count, b->err) : NULL;
    for (uint32_t k = 0; panes && k < g->material_count; k++) {
        const study_material *instead = match(b, g->materials[k].name);
        panes[k]                      = used[k] && (instead ? instead->surface == SURFACE_PANE
                                                            : gltf_material_is_pane(&g->materials[k]));
    }
    const glass_shapes *glass = panes ? glass_shapes_of(b, g, panes) : NULL;
    for (uint32_t k = 0; glass && k < g->material_count; k++) {
        material_source s = { .file    = b->study->scenes[i].file,
                              .from    = &g->materials[k],
                              .instead = match(b, g->materials[k].name),
                              .glass   = &glass[k],
                              .scale   = b->study->scenes[i].scale,
                              .used    = used[k] };
        if (!add(b, &s))
            return false;
    }
    tell_of_scales(b, i, g);
    return glass != NULL;
}

bool build_materials(scene_build *b)
{
    const study *s  = b->study;
    uint32_t *first = arena_array(b->a, uint32_t, (size_t)s->scene_count + 1, b->err);
    b->tables       = arena_array(b->a, const void *, (size_t)s->material_count + 1, b->err);
    if (!first || !b->tables || !add_room(b))
        return false;
    for (int i = 0; i < s->scene_count; i++) {
        int before = scene_first_use(b, i);
        first[i]   = before < i ? first[before] : (uint32_t)b->materials.count;
        if (before == i && !add_file(b, i))
            return false;
    }
    b->first_material = first;
    tell_bounded(b);
    return all_patterns_match(b) && build_exteriors(b);
}
