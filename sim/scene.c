/* sim/scene.c -- see scene.h. The order of construction; the parts are scene_*.c. */
#include "core/without.h"
#include "sim/scene_build.h"

#include <string.h>

enum { MOST_LIGHTS = 1 << 22, MOST_GROUPS = 32 /* that have a layer each */ };

void *list_add(list *l, arena *a, size_t size, size_t align, lux_error *err)
{
    if (l->count == l->room) {
        size_t room = l->room ? 2 * l->room : 16;
        void *items = arena_alloc(a, room, size, align, err);
        if (!items)
            return NULL;
        if (l->count)
            memcpy(items, l->items, l->count * size);
        l->items = items;
        l->room  = room;
    }
    return (char *)l->items + size * l->count++;
}

transform scene_copy_place(const study_scene *s, int k)
{
    double turn = s->rotate_deg * (M_PI / 180.0);
    double c = cos(turn) * s->scale, d = sin(turn) * s->scale;
    dvec3 at = s->at[k];
    if (s->rotate_deg == 0.0)
        c = s->scale, d = 0.0;
    return (transform){ { { c, -d, 0, at.x }, { d, c, 0, at.y }, { 0, 0, s->scale, at.z } } };
}

static bool read_files(scene_build *b)
{
    const study *s = b->study;
    b->files       = arena_array(b->a, const gltf *, (size_t)s->scene_count + 1, b->err);
    if (!b->files)
        return false;
    for (int i = 0; i < s->scene_count; i++) {
        if (b->options->models)
            b->files[i] = b->options->models[i];
        for (int j = 0; j < i && !b->files[i]; j++)
            if (!strcmp(s->scenes[i].file, s->scenes[j].file))
                b->files[i] = b->files[j];
        if (!b->files[i])
            b->files[i] = gltf_read(b->a, s->scenes[i].file, b->notices, b->err);
        if (!b->files[i])
            return false;
    }
    return true;
}

static bool build_cameras(scene_build *b)
{
    for (int i = 0; i < b->study->scene_count; i++) {
        const study_scene *s = &b->study->scenes[i];
        for (uint32_t c = 0; c < b->files[i]->camera_count; c++) {
            const gltf_camera *from = &b->files[i]->cameras[c];
            scene_camera *to        = list_new(&b->cameras, b->a, scene_camera, b->err);
            if (!to)
                return false;
            transform copy = scene_copy_place(s, 0);
            *to            = (scene_camera){ .name        = from->name,
                                             .place       = transform_product(&copy, &from->place),
                                             .perspective = from->perspective,
                                             .yfov        = from->yfov,
                                             .aspect      = from->aspect,
                                             .xmag        = from->xmag * s->scale,
                                             .ymag        = from->ymag * s->scale };
        }
    }
    return true;
}

static bool is_dark(vec3 c) { return c.x == 0.0f && c.y == 0.0f && c.z == 0.0f; }

static int32_t deeds_of(const material *m)
{
    return (m->type->reflect ? DOES_ASK : 0) | (m->matt ? 0 : DOES_NARROW) |
           (m->two_sided ? DOES_AROUND : 0) | (m->solid ? DOES_SOLID : 0) |
           (material_is_hollow(m) ? DOES_HOLLOW : 0);
}

static bool say_what_surfaces_do(const scene_build *b, scene *s)
{
    int32_t *does = arena_array(b->a, int32_t, (size_t)s->material_count + 1, b->err);
    for (int i = 0; does && i < s->material_count; i++) {
        const scene_material *m = &s->material_info[i];
        does[i]                 = deeds_of(s->materials[i]) | (m->exterior ? DOES_EXTERIOR : 0);
        if (!m->used)
            continue;
        s->exteriors |= m->exterior;
        s->reflects |= !is_dark(m->reflectance) || !is_dark(m->transmittance);
        s->glows |= !is_dark(m->emission);
        s->textured |= m->textured;
        s->hollow |= material_is_hollow(s->materials[i]);
        s->narrow |= !s->materials[i]->matt;
        s->solids |= s->materials[i]->solid;
        s->smoothed |= m->smoothed;
    }
    s->material_does = does;
    if (does && !scene_find_lenses(s, does, b->err))
        return false;
    if (s->light_count == 0 && s->sky_count == 0 && !s->glows)
        notice_add(b->notices, "%s: nothing gives light: every result will be 0 lx",
                   b->study->path);
    return does != NULL;
}

/* Lamps and glowing triangles in one list, and what chooses among them. */
static bool join_lights(scene_build *b, scene *s)
{
    size_t lamps = b->lights.count, glowing = b->emitters.count;
    if (lamps + glowing > MOST_LIGHTS)
        return failed(b->err, ERR_ARGUMENT, "%s: more than %d lights and glowing triangles",
                      b->study->path, MOST_LIGHTS);
    const light **all = arena_array(b->a, const light *, lamps + glowing + 1, b->err);
    if (!all)
        return false;
    if (lamps)
        memcpy(all, b->lights.items, lamps * sizeof *all);
    if (glowing)
        memcpy(all + lamps, b->emitters.items, glowing * sizeof *all);
    s->lights        = all;
    s->light_count   = (int)lamps;
    s->emitter_count = (int)glowing;
    s->first_emitter = b->first_emitter;
    s->emitter_of    = b->emitter_of.items;
    return true;
}

/* Those of one group, or all (-1), or glowing surfaces alone (-2). */
static bool make_set(scene_build *b, const scene *s, int group, light_set *to)
{
    const scene_light *info = b->light_info.items;
    size_t room             = (size_t)s->light_count + (size_t)s->emitter_count + 1;
    int32_t *numbers        = arena_array(b->a, int32_t, room, b->err);
    const light **lights    = numbers ? arena_array(b->a, const light *, room, b->err) : NULL;
    if (!lights)
        return false;
    int count = 0;
    for (int l = 0; group > -2 && l < s->light_count - s->sun_count; l++)
        if (group < 0 || info[l].group == group)
            numbers[count++] = l;
    to->lamps = count;
    for (int e = 0; (group < 0 || group == s->glow_group) && e < s->emitter_count; e++)
        numbers[count++] = s->light_count + e;
    to->emitters = count - to->lamps;
    to->lights   = numbers;
    for (int i = 0; i < count; i++)
        lights[i] = s->lights[numbers[i]];
    if (to->emitters > 0 || to->lamps > FEW_LAMPS)
        to->tree = light_tree_new(b->a, lights, count, b->err);
    return to->tree || (to->emitters == 0 && to->lamps <= FEW_LAMPS);
}

/* Groups of suns and skies alone have no set: one would be drawn in vain. */
static bool make_sets(scene_build *b, scene *s)
{
    int groups      = s->layered ? s->group_count : 1;
    light_set *all  = arena_array(b->a, light_set, (size_t)groups + 1, b->err);
    int32_t *set_of = arena_array(b->a, int32_t, (size_t)s->group_count + 1, b->err);
    s->sets         = all;
    s->set_of_group = set_of;
    for (int i = 0; all && set_of && i < groups; i++) {
        light_set *set = &all[s->set_count];
        if (!make_set(b, s, s->layered ? i : -1, set))
            return false;
        set_of[i] = set->lamps + set->emitters > 0 ? s->set_count++ : -1;
    }
    return all && set_of && make_set(b, s, -2, &s->glow_set);
}

/* Glowing surfaces are of the group of lights that are in none. */
static bool take_groups(scene_build *b, scene *s)
{
    s->glow_dimming = (float)study_group_factor(b->study, NULL);
    if (b->options->moments) {
        s->groups      = b->groups.items;
        s->group_count = (int)b->groups.count;
        s->layered = s->by_moment = true;
        return true;
    }
    const char **names = b->groups.items;
    size_t other       = 0;
    while (other < b->groups.count && strcmp(names[other], STUDY_GROUP_OTHER) != 0)
        other++;
    s->glow_group = (int)other;
    if (other == b->groups.count && s->glows) {
        const char **name = list_new(&b->groups, b->a, const char *, b->err);
        if (!name)
            return false;
        *name = STUDY_GROUP_OTHER;
    }
    s->groups      = b->groups.items;
    s->group_count = (int)b->groups.count;
    s->layered     = b->options->layered;
    if (s->layered && s->group_count > MOST_GROUPS)
        return failed(b->err, ERR_ARGUMENT, "%s: %d groups, expected at most %d for --groups",
                      b->study->path, s->group_count, MOST_GROUPS);
    return true;
}

float scene_dimming_of_group(const scene *s, int group)
{
    if (s->glows && group == s->glow_group)
        return s->glow_dimming;
    for (int l = 0; l < s->light_count; l++)
        if (s->light_info[l].group == group)
            return s->light_info[l].dimming;
    return 1.0f;
}

bool scene_is_lit(const scene *s) { return s->light_count > 0 || s->sky_count > 0 || s->glows; }

bool scene_is_in_room(const scene *s, dvec3 p)
{
    dvec3 size = s->study->room.size;
    return !s->study->room.given || (p.x >= 0.0 && p.x <= size.x && p.y >= 0.0 && p.y <= size.y &&
                                     p.z >= 0.0 && p.z <= size.z);
}

/* Lamps within a room that holds nothing else, or where there are no surfaces at all: a straight
 * line between two places in a box meets none of its sides. */
static void find_clear_lights(const scene_build *b, const scene *s)
{
    scene_light *info = b->light_info.items;
    bool bare         = true;
    for (int i = 0; i < b->study->scene_count; i++)
        bare = bare && b->files[i]->placement_count == 0;
    dvec3 size = b->study->room.size, off = d3_scale(size, 1e-6);
    for (int l = 0; l < s->light_count; l++) {
        light_bounds box = light_bounds_of(s->lights[l]);
        dvec3 low        = d3_add(d3_from(box.low), b->centre);
        dvec3 high       = d3_add(d3_from(box.high), b->centre);
        bool inside      = !box.far && low.x > off.x && low.y > off.y && low.z > off.z &&
                      high.x < size.x - off.x && high.y < size.y - off.y && high.z < size.z - off.z;
        info[l].clear = bare && !info[l].sun && (inside || !b->study->room.given);
    }
}

static void say_what_lights_are(scene *s)
{
    for (int l = 0; l < s->light_count; l++) {
        s->extended |= !s->light_info[l].sun && light_has_extent(s->lights[l]);
        s->owners |= s->light_info[l].owner != 0;
    }
}

/* What costs nothing where a scene has none of it, looked for all the same. */
static void force_on(const scene_build *b, scene *s)
{
    scene_light *info = b->light_info.items;
    uint32_t on       = b->options->on;
    s->extended |= on >> EFFECT_AREA_LIGHTS & 1;
    s->textured |= on >> EFFECT_TEXTURES & 1;
    s->smooth |= on >> EFFECT_NORMAL_MAPS & 1;
    s->narrow |= (on >> EFFECT_MIRRORS | on >> EFFECT_MEASURED_BRDF) & 1;
    s->hollow |= on >> EFFECT_TINTED_SHADOWS & 1;
    for (int l = 0; l < s->light_count && on >> EFFECT_SHADOWS & 1; l++)
        info[l].clear = false;
}

/* Whether this build knows all that the scene calls for. */
static bool build_can(const scene *s, lux_error *err)
{
    const char *lacks = NULL;
    if (!HAS_DAYLIGHT && (s->sky_count > 0 || s->sun_count > 0))
        lacks = "daylight";
    if (!HAS_MIRRORS && (s->narrow || s->hollow || s->mirror_images))
        lacks = "mirrors and glass";
    if (!HAS_TEXTURES && s->textured)
        lacks = "textures";
    for (int i = 0; !HAS_TABLES && i < s->material_count; i++)
        if (s->material_info[i].used && s->material_info[i].file)
            lacks = "measured tables";
    return !lacks || failed(err, ERR_ARGUMENT, "%s: calls for %s, which this build does without",
                            s->study->path, lacks);
}

const scene *scene_new(arena *a, const study *from, const scene_options *o, notices *n,
                       lux_error *err)
{
    scene_build b = { .a = a, .study = from, .options = o, .notices = n, .err = err };
    scene *s      = arena_new(a, scene, err);
    if (o->moments && scene_group(&b, SCENE_LAMPS) < 0)
        return NULL;
    if (!s || !read_files(&b) || !build_materials(&b) || !build_bounds(&b) || !build_bodies(&b))
        return NULL;
    s->world = build_world(&b);
    if (!s->world || !build_lamps(&b) || !build_daylight(&b) || !build_cameras(&b) ||
        !scene_textures(&b, &s->texture_bytes, &s->picture_bytes))
        return NULL;

    s->study          = from;
    s->centre         = b.centre;
    s->low            = b.low;
    s->high           = b.high;
    s->material_count = (int)b.materials.count;
    s->materials      = b.materials.items;
    s->material_info  = b.material_info.items;
    s->mirror_images  = b.mirror_images;
    s->glow_watts     = b.glow_watts;
    s->smooth         = b.smooth;
    s->lights_differ  = b.lights_differ;
    s->camera_count   = (int)b.cameras.count;
    s->cameras        = b.cameras.items;
    s->sun_count      = b.sun_count;
    s->skies          = b.skies.items;
    s->sky_count      = (int)b.skies.count;
    s->moments        = b.moments;
    s->moment_count   = b.moment_count;
    s->unshadowed     = is_left_out(&b, EFFECT_SHADOWS);
    s->untinted       = is_left_out(&b, EFFECT_TINTED_SHADOWS);
    s->asks_all       = is_left_out(&b, EFFECT_MANY_LIGHTS);
    s->pixel_centres  = is_left_out(&b, EFFECT_ANTIALIASING);
    if (!join_lights(&b, s) || !say_what_surfaces_do(&b, s) || !take_groups(&b, s) ||
        !make_sets(&b, s) || !scene_find_portals(&b, s))
        return NULL;
    find_clear_lights(&b, s);
    s->light_info = b.light_info.items;
    say_what_lights_are(s);
    s->small_patches = scene_small_patches(s, n);
    if (!scene_find_ways(s, n, err))
        return NULL;
    force_on(&b, s);
    s->grey = !scene_colored_by(s) && !(o->on >> EFFECT_COLOR & 1);
    return build_can(s, err) ? s : NULL;
}
