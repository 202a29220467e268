/* sim/scene_material_gltf.c -- what each material of a glTF file is here, and what it reflects.
 *
 * The first line that fits holds. "Clear" is transmission * (1 - metallic) of an index above 0.
 *
 *     unlit                                  matt, reflectance = base colour
 *     clear > 0, with a volume               solid: smooth border of ior; absorption within
 *                                            -ln(attenuationColor) / attenuationDistance,
 *                                            what passes the border times base colour * clear;
 *                                            of index 1 and without absorption, nothing but that
 *     clear = 1, roughness < 0.03            pane of ior with a transmittance at normal incidence
 *                                            of base colour * (1 - R) / (1 + R); as a plate that
 *                                            is closed (both faces modelled): one pane a plate
 *     metallic = 0, specular black           matt, reflectance = base colour
 *     metallic = 0, roughness = 1,           matt, reflectance = base colour: a wall paint, as
 *       plain specular, ior 1.4 ... 1.6      modelling programs export it
 *     metallic = 1, base colour black        matt, black: no metal is, but what only glows may be
 *                                            written so, and is left without gloss
 *     all else                               gloss (materials/gloss.c): metal with base colour as
 *                                            F0; else F0 = ((n-1)/(n+1))^2 * specular over a matt
 *                                            base that gives back base colour * (1 - clear) of
 *                                            what enters, and lets base colour * clear through,
 *                                            blurred. What all of it reflects of diffuse light:
 *                                            lux4 check prints it
 *
 *     alphaMode MASK, BLEND                  holes: the share 1 - alpha is not there
 *     emissiveFactor * strength              glows with so many cd/m^2 on both sides
 *     occlusion, clearcoat, sheen and so on  left out
 *
 * A constant fits only where no texture may change it. Of glTF 2.0.1, 3.9 and appendix B, and
 * KHR_materials_transmission, _volume, _ior, _specular, _unlit, _emissive_strength.
 */
#include "core/color.h"
#include "sim/scene_build.h"

static const float smooth          = 0.03f;   /* a roughness that nobody sees in a pane */
static const float nearly_smooth   = 0.1f;    /* whose lobe of transmission is narrow yet */
static const float rough           = 0.999f;  /* 1 as a slider gives it */
static const float least_ior       = 1.0001f; /* of solids */
static const float most_absorption = 1e9f;    /* 1/m: black */

/* ---- what a material is ---------------------------------------------------------------------- */

static const material_textures no_textures = { 0 };

static const material_textures *textures_of(const gltf_material *m)
{
    return m->textures ? m->textures : &no_textures;
}

static bool is_black(vec3 c) { return c.x <= 0.0f && c.y <= 0.0f && c.z <= 0.0f; }
static bool is_white(vec3 c) { return c.x == 1.0f && c.y == 1.0f && c.z == 1.0f; }

static float clearness(const gltf_material *m)
{
    return m->ior > 0.0f ? m->transmission * (1.0f - m->metallic) : 0.0f;
}

static bool is_solid(const gltf_material *m)
{
    return !m->unlit && m->volume && clearness(m) > 0.0f;
}

bool gltf_material_is_pane(const gltf_material *m)
{
    const material_textures *t = textures_of(m);
    return !m->unlit && !m->volume && clearness(m) == 1.0f && m->roughness < smooth &&
           !t->surface.texture && !t->transmission.texture;
}

static bool is_matt(const gltf_material *m)
{
    const material_textures *t = textures_of(m);
    if (m->unlit || (m->metallic == 1.0f && is_black(m->base_color) && !t->surface.texture))
        return true;
    if (m->metallic > 0.0f || clearness(m) > 0.0f)
        return false;
    if (m->specular <= 0.0f || is_black(m->specular_color))
        return true;
    bool plain = m->specular == 1.0f && is_white(m->specular_color) && m->ior >= 1.4f &&
                 m->ior <= 1.6f && !t->specular_weight.texture && !t->specular_color.texture;
    return plain && m->roughness >= rough && !t->surface.texture;
}

/* ---- what all have --------------------------------------------------------------------------- */

material_extra material_extra_of(const gltf_material *m)
{
    return (material_extra){ .emission = v3_scale(m->emission, 1.0f / (float)LUMENS_PER_WATT),
                             .openness = 1.0f - m->alpha,
                             .textures = m->textures };
}

static vec3 mean_of(const texture_slot *slot)
{
    float rgba[4] = { 1, 1, 1, 1 };
    if (slot->texture)
        texture_mean(slot->texture, rgba);
    return (vec3){ rgba[0], rgba[1], rgba[2] };
}

static vec3 base_of(scene_build *b, const material_source *s)
{
    return material_bounded(b, s, s->from->base_color, mean_of(&textures_of(s->from)->base));
}

static void tell(scene_build *b, const material_source *s, bool when, const char *what)
{
    const char *name = s->from->name[0] ? s->from->name : "(unnamed)";
    if (when && s->used)
        notice_add(b->notices, "%s: material \"%s\": %s", s->file, name, what);
}

/* ---- makers ---------------------------------------------------------------------------------- */

static const material *make_matt(scene_build *b, const material_source *s)
{
    diffuse_desc d = { .reflectance = base_of(b, s), .extra = material_extra_of(s->from) };
    return material_diffuse(b->a, &d, b->err);
}

static float absorption_of(float color, double distance)
{
    double a = -log(fmax((double)color, 1e-30)) / distance;
    return a > 0.0 ? (float)fmin(a, (double)most_absorption) : 0.0f;
}

/* As float rounds it, no more than a pane can have. */
static float most_of_pane(double ior) { return (float)(pane_most(ior) * (1.0 - 1e-7)); }

/* What light passes straight, with what it loses at each border alone: in place of a solid that
 * bends it, or for one that does not. */
static const material *make_straight(scene_build *b, const material_source *s, vec3 tint)
{
    pane_desc d = { .transmittance = tint,
                    .ior           = PANE_LEAST_IOR,
                    .extra         = material_extra_of(s->from) };
    return material_pane(b->a, &d, b->err);
}

static bool is_asked_for(const scene_build *b, effect e) { return b->options->on >> e & 1; }

static const material *make_solid(scene_build *b, const material_source *s, scene_material *info)
{
    const gltf_material *m     = s->from;
    const material_textures *t = textures_of(m);
    vec3 c                     = m->attenuation_color;
    double distance            = (double)m->attenuation_distance * s->scale;
    dielectric_desc d          = {
                 .ior        = fmaxf(m->ior, least_ior),
                 .absorption = { absorption_of(c.x, distance), absorption_of(c.y, distance),
                                 absorption_of(c.z, distance) },
                 .tint       = v3_scale(m->base_color, clearness(m) * mean_of(&t->transmission).x),
                 .extra      = material_extra_of(m)
    };
    bool acts = m->ior > 1.0f || !is_black(d.absorption);
    if (is_left_out(b, EFFECT_REFRACTION) || (!acts && !is_asked_for(b, EFFECT_REFRACTION)))
        return make_straight(b, s, d.tint);
    info->smoothed = m->roughness >= smooth || t->surface.texture;
    tell(b, s, info->smoothed, "the rough border of a solid is taken as smooth");
    tell(b, s, clearness(m) < 1.0f || t->transmission.texture,
         "a solid that is clear in part: what does not enter it is taken as lost");
    return material_dielectric(b->a, &d, b->err);
}

static const material *make_pane(scene_build *b, const material_source *s, scene_material *info)
{
    const gltf_material *m = s->from;
    const glass_shapes *g  = s->glass;
    float ior              = fmaxf(m->ior, PANE_LEAST_IOR);
    float most             = most_of_pane((double)ior);
    if (is_left_out(b, EFFECT_MIRRORS))
        ior = PANE_LEAST_IOR;
    info->box   = g->plates && !g->bodies && !g->open;
    pane_desc d = { .transmittance = v3_scale(m->base_color, most),
                    .ior           = ior,
                    .box           = info->box,
                    .extra         = material_extra_of(m) };
    tell(b, s, info->box, "closed boxes of glass: each is taken as one pane");
    tell(b, s, !info->box && g->plates,
         "some of its panes are closed boxes, others single surfaces: each surface is taken as a "
         "pane");
    tell(b, s, m->specular != 1.0f || !is_white(m->specular_color),
         "`specular` of clear glass is left out: it reflects as its index says");
    return material_pane(b->a, &d, b->err);
}

static const material *make_gloss(scene_build *b, const material_source *s)
{
    const gltf_material *m = s->from;
    gloss_desc d           = { .base_color     = base_of(b, s),
                               .metallic       = m->metallic,
                               .roughness      = m->roughness,
                               .transmission   = m->transmission,
                               .ior            = m->ior,
                               .specular       = m->specular,
                               .specular_color = m->specular_color,
                               .extra          = material_extra_of(m) };
    tell(b, s, clearness(m) > 0.0f && m->roughness < nearly_smooth,
         "smooth and clear in part: the light of lamps that passes it is hard to find, and "
         "results are slow to settle");
    return material_gloss(b->a, &d, b->err);
}

const material *material_of_gltf(scene_build *b, const material_source *s, scene_material *info)
{
    if (is_matt(s->from))
        return make_matt(b, s);
    if (is_solid(s->from))
        return make_solid(b, s, info);
    if (gltf_material_is_pane(s->from))
        return make_pane(b, s, info);
    return make_gloss(b, s);
}
