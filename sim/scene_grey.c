/* sim/scene_grey.c -- whether a scene is grey: then one channel of light stands for all three. */
#include "sim/scene.h"

static bool is_grey(vec3 c) { return c.x == c.y && c.x == c.z; }

static bool material_is_grey(const material *m)
{
    return !m->textures && is_grey(m->look.color) && is_grey(m->look.emission) &&
           is_grey(m->look.specular) && is_grey(m->reflectance) && is_grey(m->transmittance) &&
           is_grey(m->absorption);
}

static bool surfaces_are_grey(const scene *s)
{
    for (int i = 0; i < s->material_count; i++) {
        const scene_material *info = &s->material_info[i];
        if (info->used && (info->file || !material_is_grey(s->materials[i])))
            return false;
    }
    return true;
}

static bool lamps_are_grey(const scene *s)
{
    for (int l = 0; l < s->light_count; l++)
        if (!is_grey(s->light_info[l].color) || !is_grey(light_flux(s->lights[l])))
            return false;
    return true;
}

/* What a sky has of one colour, it has straight up and straight down; a picture may have any. */
static bool skies_are_grey(const scene *s)
{
    const vec3 up = { 0, 0, 1 }, down = { 0, 0, -1 };
    vvec3 ways[] = { vspread(up), vspread(down) };
    if (s->sky_count > 0 && s->study->sky.model == STUDY_SKY_PANORAMA)
        return false;
    for (int i = 0; i < s->sky_count; i++)
        for (int k = 0; k < 2; k++) {
            vrgb all = sky_radiance(s->skies[i].sky, &ways[k], ALL_LANES);
            vec3 one = { lane(all.x, 0), lane(all.y, 0), lane(all.z, 0) };
            if (!is_grey(one))
                return false;
        }
    return true;
}

const char *scene_colored_by(const scene *s)
{
    if (s->lights_differ)
        return "lamps differ in colour";
    if (!lamps_are_grey(s))
        return "lamps are coloured";
    if (!skies_are_grey(s))
        return "the sky is coloured";
    return surfaces_are_grey(s) ? NULL : "surfaces are coloured";
}
