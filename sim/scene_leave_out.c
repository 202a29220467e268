/* sim/scene_leave_out.c -- scenes without effects: what stands in for what a material has.
 *
 * What stands in keeps the light: a texture's mean is reflected in place of its picture, and a grey
 * of the same luminance in place of a colour. Pictures keep their colours where these alone are
 * left out.
 */
#include "core/color.h"
#include "sim/scene_build.h"

vec3 scene_color(const scene_build *b, vec3 color)
{
    if (!is_left_out(b, EFFECT_COLOR))
        return color;
    float grey = rgb_luminance(color);
    return (vec3){ grey, grey, grey };
}

static void mean_of(const texture_slot *slot, float rgba[4])
{
    for (int c = 0; c < 4; c++)
        rgba[c] = 1.0f;
    if (slot->texture)
        texture_mean(slot->texture, rgba);
}

static vec3 times_mean(vec3 of, const texture_slot *slot)
{
    float mean[4];
    mean_of(slot, mean);
    return v3_mul(of, (vec3){ mean[0], mean[1], mean[2] });
}

/* All of its pictures but for the normal map become constants. */
static void flatten(gltf_material *m, const material_textures *t)
{
    float surface[4], transmission[4], specular[4];
    mean_of(&t->surface, surface);
    mean_of(&t->transmission, transmission);
    mean_of(&t->specular_weight, specular);
    m->alpha          = (float)material_share_there(1.0f - m->alpha, t);
    m->base_color     = times_mean(m->base_color, &t->base);
    m->emission       = times_mean(m->emission, &t->emission);
    m->specular_color = times_mean(m->specular_color, &t->specular_color);
    m->roughness *= surface[1];
    m->metallic *= surface[2];
    m->transmission *= transmission[0];
    m->specular *= specular[3];
}

bool material_leave_out(scene_build *b, gltf_material *m)
{
    const material_textures *t = m->textures;
    bool plain                 = is_left_out(b, EFFECT_TEXTURES);
    bool smooth                = is_left_out(b, EFFECT_NORMAL_MAPS);
    m->base_color              = scene_color(b, m->base_color);
    m->emission                = scene_color(b, m->emission);
    m->specular_color          = scene_color(b, m->specular_color);
    m->attenuation_color       = scene_color(b, m->attenuation_color);
    if (!t || !(plain || smooth))
        return true;
    if (plain)
        flatten(m, t);
    m->textures = NULL;
    bool bumpy  = t->normal.texture && !smooth;
    if (plain && !bumpy)
        return true;
    material_textures *kept = arena_new(b->a, material_textures, b->err);
    if (!kept)
        return false;
    *kept = *t;
    if (plain)
        *kept = (material_textures){ .normal = t->normal, .normal_scale = t->normal_scale };
    if (smooth)
        kept->normal.texture = NULL;
    m->textures = kept;
    return true;
}

const material *material_unmeasured(scene_build *b, const material *table)
{
    float through  = rgb_luminance(table->transmittance);
    float rest     = 1.0f - through;
    vec3 back      = scene_color(b, table->reflectance);
    diffuse_desc d = { .reflectance = { 0, 0, 0 },
                       .extra       = { .emission = table->look.emission,
                                        .openness = 1.0f - (1.0f - table->look.openness) * rest,
                                        .textures = table->textures } };
    if (rest > 0.0f)
        d.reflectance = (vec3){ fminf(back.x / rest, 1.0f), fminf(back.y / rest, 1.0f),
                                fminf(back.z / rest, 1.0f) };
    return material_diffuse(b->a, &d, b->err);
}
