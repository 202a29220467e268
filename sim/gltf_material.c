/* sim/gltf_material.c -- the constants of materials, and the textures of those that are seen. */
#include "materials/look.h"
#include "sim/gltf_source.h"

#include <float.h>
#include <string.h>

static vec3 color_of(const double c[3]) { return (vec3){ (float)c[0], (float)c[1], (float)c[2] }; }

/* Below it nothing of the light is left: their logarithms are finite. */
static const float least_distance = 1e-9f;

static void read_volume(const source_material *m, gltf_material *out)
{
    const double *c           = m->attenuation_color;
    out->volume               = m->thickness > 0.0;
    out->thickness            = (float)fmin(m->thickness, (double)FLT_MAX);
    out->attenuation_distance = fmaxf((float)m->attenuation_distance, least_distance);
    out->attenuation_color    = (vec3){ fmaxf((float)c[0], FLT_MIN), fmaxf((float)c[1], FLT_MIN),
                                        fmaxf((float)c[2], FLT_MIN) };
}

static bool read_ior(const reader *r, uint32_t number, gltf_material *out, lux_error *err)
{
    double ior = r->source->materials[number].ior;
    if (ior > 0.0 && ior < 1.0)
        return failed(
            err, ERR_FORMAT,
            "%s: /materials/%u/extensions/KHR_materials_ior/ior: %g, wanted 0, or 1 and more",
            r->file->path, number, ior);
    out->ior = (float)fmin(ior, 4.0);
    return true;
}

/* What changes from place to place; NULL in *out if nothing does. */
static bool read_textures(texture_shelf *s, uint32_t number, const material_textures **out,
                          lux_error *err)
{
    const source_material *m = &s->r->source->materials[number];
    material_textures t      = { .normal_scale = (float)m->normal_scale,
                                 .cutoff       = (float)fmin(m->cutoff, 2.0) /* above 1 is all */ };
    if (strcmp(m->alpha_mode, "OPAQUE") != 0)
        t.alpha = !strcmp(m->alpha_mode, "MASK") ? ALPHA_MASK : ALPHA_BLEND;
    texture_slot *const slots[SLOT_KINDS] = {
        [SLOT_BASE]           = &t.base,
        [SLOT_SURFACE]        = &t.surface,
        [SLOT_EMISSION]       = &t.emission,
        [SLOT_TRANSMISSION]   = &t.transmission,
        [SLOT_SPECULAR]       = &t.specular_weight,
        [SLOT_SPECULAR_COLOR] = &t.specular_color,
        [SLOT_NORMAL]         = &t.normal,
    };
    bool some = t.alpha == ALPHA_MASK;
    for (int k = 0; k < SLOT_KINDS; k++) {
        if (!slot_read(s, number, (source_slot_kind)k, slots[k], err))
            return false;
        some = some || slots[k]->texture;
    }
    if (!some)
        return true;
    material_textures *copy = arena_new(s->r->a, material_textures, err);
    if (copy)
        *copy = t;
    *out = copy;
    return copy != NULL;
}

static void tally_material(reader *r, uint32_t number)
{
    const source_material *m = &r->source->materials[number];
    if (m->occluded)
        tally_add(r, TALLY_OCCLUSION, "/materials/%u/occlusionTexture", number);
    if (m->ior > 4.0)
        tally_add(r, TALLY_IOR, "/materials/%u/extensions/KHR_materials_ior/ior", number);
    if (m->varies && m->thickness > 0.0)
        tally_add(r, TALLY_THICKNESS,
                  "/materials/%u/extensions/KHR_materials_volume/thicknessTexture", number);
}

static bool read_material(const reader *r, uint32_t number, gltf_material *out, lux_error *err)
{
    const source_material *m = &r->source->materials[number];
    *out                     = (gltf_material){
                            .name           = read_name(r, m->name, err),
                            .base_color     = color_of(m->base_color),
                            .alpha          = strcmp(m->alpha_mode, "OPAQUE") != 0 ? (float)m->base_color[3] : 1.0f,
                            .metallic       = (float)m->metallic,
                            .roughness      = (float)m->roughness,
                            .transmission   = (float)m->transmission,
                            .specular       = (float)m->specular,
                            .specular_color = color_of(m->specular_color),
                            .unlit          = m->unlit,
    };
    for (int k = 0; k < 3; k++)
        if (m->emission[k] * m->strength > (double)FLT_MAX)
            return failed(err, ERR_FORMAT, "%s: /materials/%u/emissiveFactor: beyond every number",
                          r->file->path, number);
    out->emission = color_of((double[3]){
        m->emission[0] * m->strength, m->emission[1] * m->strength, m->emission[2] * m->strength });
    read_volume(m, out);
    return out->name && read_ior(r, number, out, err);
}

/* Of each material, the default one too, whether some triangle in its place is made of it. */
static const bool *seen_materials(const reader *r, lux_error *err)
{
    const gltf *g = r->out;
    bool *seen    = arena_array(r->file->scratch, bool, (size_t)r->source->material_count + 1, err);
    bool *placed  = arena_array(r->file->scratch, bool, g->mesh_count, err);
    if (!seen || !placed)
        return NULL;
    for (uint32_t i = 0; i < g->placement_count; i++)
        placed[g->placements[i].mesh] = true;
    for (uint32_t i = 0; i < g->mesh_count; i++)
        for (uint32_t t = 0; placed[i] && t < g->meshes[i].triangles.triangle_count; t++)
            seen[g->meshes[i].triangles.material[t]] = true;
    return seen;
}

bool read_materials(reader *r, lux_error *err)
{
    uint32_t count    = r->source->material_count;
    const bool *seen  = seen_materials(r, err);
    texture_shelf s   = { 0 };
    r->out->materials = arena_array(r->a, gltf_material, (size_t)count + 1, err);
    if (!seen || !r->out->materials || !shelf_open(&s, r, err))
        return false;
    for (uint32_t i = 0; i < count; i++) {
        gltf_material *to = &r->out->materials[i];
        if (!read_material(r, i, to, err) || (seen[i] && !read_textures(&s, i, &to->textures, err)))
            return false;
        if (seen[i])
            tally_material(r, i);
    }
    /* glTF 2.0.1, section 3.9.6 and the schema's defaults */
    r->out->materials[count] = (gltf_material){ .name                 = "",
                                                .base_color           = { 1, 1, 1 },
                                                .alpha                = 1,
                                                .metallic             = 1,
                                                .roughness            = 1,
                                                .ior                  = 1.5f,
                                                .specular             = 1,
                                                .specular_color       = { 1, 1, 1 },
                                                .attenuation_distance = INFINITY,
                                                .attenuation_color    = { 1, 1, 1 } };
    r->out->material_count   = count + 1;
    return true;
}
