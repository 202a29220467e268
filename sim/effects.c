/* sim/effects.c -- see effects.h. */
#include "sim/effects.h"

#include "sim/direct_sensor.h"

#include <string.h>

const char *effect_name(effect e)
{
    static const char *const names[EFFECTS] = {
        [EFFECT_SHADOWS]         = "shadows",
        [EFFECT_AREA_LIGHTS]     = "area-lights",
        [EFFECT_NEAR_FIELD]      = "near-field",
        [EFFECT_MANY_LIGHTS]     = "many-lights",
        [EFFECT_SUN]             = "sun",
        [EFFECT_SKY]             = "sky",
        [EFFECT_PORTALS]         = "portals",
        [EFFECT_PANORAMA]        = "panorama",
        [EFFECT_INTERREFLECTION] = "interreflection",
        [EFFECT_MIRRORS]         = "mirrors",
        [EFFECT_REFRACTION]      = "refraction",
        [EFFECT_TEXTURES]        = "textures",
        [EFFECT_NORMAL_MAPS]     = "normal-maps",
        [EFFECT_MEASURED_BRDF]   = "measured-brdf",
        [EFFECT_TINTED_SHADOWS]  = "tinted-shadows",
        [EFFECT_COLOR]           = "color",
        [EFFECT_MOTION]          = "motion",
        [EFFECT_ANTIALIASING]    = "antialiasing",
    };
    return names[e];
}

effect effect_find(const char *name, size_t length)
{
    int e = 0;
    while (e < EFFECTS && (strlen(effect_name((effect)e)) != length ||
                           strncmp(effect_name((effect)e), name, length) != 0))
        e++;
    return (effect)e;
}

static bool is_dark(const light *l) { return !(light_bounds_of(l).peak > 0.0f); }

/* A lamp of extent that shines as a file says. */
static bool has_opening(const scene *s, int l)
{
    return s->light_info[l].web && light_has_extent(s->lights[l]) && !is_dark(s->lights[l]);
}

/* What the materials of surfaces call for. Where light is not followed on from surfaces (`back`),
 * they count by what they let through and by what they give off. */
static void add_materials(const scene *s, bool back, effects *all)
{
    bool *on = all->on;
    for (int i = 0; i < s->material_count; i++) {
        const scene_material *info = &s->material_info[i];
        const material *m          = s->materials[i];
        if (!info->used)
            continue;
        vec3 glow  = info->emission;
        bool seen  = back || m->type->through || info->holes || v3_dot(glow, glow) > 0.0f;
        bool sharp = !m->type->reflect && v3_dot(info->reflectance, info->reflectance) > 0.0f;
        on[EFFECT_MIRRORS] |= back && sharp;
        on[EFFECT_REFRACTION] |= back && m->solid;
        on[EFFECT_TEXTURES] |= seen && info->textured;
        on[EFFECT_NORMAL_MAPS] |= back && info->bumpy;
        on[EFFECT_MEASURED_BRDF] |= (back || m->type->through) && info->file;
        on[EFFECT_TINTED_SHADOWS] |= m->type->through || info->holes;
    }
}

static void add_daylight(const scene *s, bool on[EFFECTS])
{
    on[EFFECT_SUN]      = s->sun_count > 0;
    on[EFFECT_SKY]      = s->dome != NULL;
    on[EFFECT_PORTALS]  = s->dome && s->portals;
    on[EFFECT_PANORAMA] = s->dome && s->study->sky.model == STUDY_SKY_PANORAMA;
}

effects effects_of_grids(const scene *s, bool direct_only, bool outside)
{
    bool lit      = scene_is_lit(s);
    bool back     = s->reflects && lit && !direct_only;
    effects all   = { 0 };
    bool *on      = all.on;
    bool shadowed = outside && s->light_count > 0, points = false;
    for (int l = 0; l < s->light_count; l++) {
        bool open = outside || !s->light_info[l].clear;
        shadowed |= open;
        points |= open && !light_has_extent(s->lights[l]);
        on[EFFECT_NEAR_FIELD] |= has_opening(s, l);
    }
    add_daylight(s, on);
    on[EFFECT_SHADOWS]         = shadowed || s->glows || s->dome;
    on[EFFECT_AREA_LIGHTS]     = s->extended || s->emitter_count > 0;
    on[EFFECT_MANY_LIGHTS]     = scene_lamp_count(s) > ASKED_LAMPS && points;
    on[EFFECT_INTERREFLECTION] = back;
    if (lit)
        add_materials(s, back, &all);
    on[EFFECT_COLOR] = lit && scene_colored_by(s);
    for (int i = 0; i < s->set_count; i++)
        on[EFFECT_MANY_LIGHTS] |= s->sets[i].tree && (back || s->glows);
    return all;
}

effects effects_of_views(const scene *s, bool direct_only)
{
    effects all                 = effects_of_grids(s, direct_only, false);
    all.on[EFFECT_ANTIALIASING] = scene_is_lit(s); /* else all is black */
    if (scene_is_lit(s))
        add_materials(s, true, &all);
    return all;
}
