/* sim/effects.c -- see effects.h. */
#include "sim/effects.h"

#include "sim/direct_sensor.h"

const char *effect_name(effect e)
{
    static const char *const names[EFFECTS] = {
        [EFFECT_SHADOWS]         = "shadows",
        [EFFECT_AREA_LIGHTS]     = "area-lights",
        [EFFECT_NEAR_FIELD]      = "near-field",
        [EFFECT_MANY_LIGHTS]     = "many-lights",
        [EFFECT_INTERREFLECTION] = "interreflection",
        [EFFECT_COLOR]           = "color",
    };
    return names[e];
}

static bool is_dark(const light *l) { return !(light_bounds_of(l).peak > 0.0f); }

/* A lamp of extent that shines as a file says. */
static bool has_opening(const scene *s, int l)
{
    return s->light_info[l].web && light_has_extent(s->lights[l]) && !is_dark(s->lights[l]);
}

static bool is_grey(vec3 c) { return c.x == c.y && c.x == c.z; }

static bool surfaces_are_colored(const scene *s)
{
    for (int i = 0; i < s->material_count; i++) {
        const scene_material *m = &s->material_info[i];
        if (m->used && !(is_grey(m->reflectance) && is_grey(m->emission)))
            return true;
    }
    return false;
}

effects effects_of_grids(const scene *s, bool direct_only, bool outside)
{
    bool lit      = s->light_count > 0 || s->glows;
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
    on[EFFECT_SHADOWS]         = shadowed || s->glows;
    on[EFFECT_AREA_LIGHTS]     = s->extended || s->emitter_count > 0;
    on[EFFECT_MANY_LIGHTS]     = s->light_count > ASKED_LAMPS && points;
    on[EFFECT_INTERREFLECTION] = back;
    on[EFFECT_COLOR]           = s->lights_differ || (lit && surfaces_are_colored(s));
    for (int i = 0; i < s->set_count; i++)
        on[EFFECT_MANY_LIGHTS] |= s->sets[i].tree && (back || s->glows);
    return all;
}
