/* sim/gltf_material.c -- materials, each picture of which is taken as its mean colour. */
#include "core/image.h"
#include "sim/gltf_source.h"

#include <float.h>
#include <stdio.h>
#include <string.h>

/* The mean of each image, once it has been asked for: as a colour (sRGB), and as numbers. */
typedef struct image_means {
    bool known[2];
    float mean[2][4];
} image_means;

typedef struct picture_work {
    reader *r;
    image_means *means;
} picture_work;

static bool picture_mean(const picture_work *w, uint32_t number, bool srgb, lux_error *err)
{
    const gltf_file *f      = w->r->file;
    const source_content *i = &f->images[number];
    const uint8_t *bytes    = NULL;
    size_t size             = 0;
    const char *path        = NULL;
    char pointer[48], label[560];
    snprintf(pointer, sizeof pointer, "/images/%u%s", number, i->uri ? "/uri" : "/bufferView");
    if (!content_locate(w->r, i, pointer, &bytes, &size, &path, err))
        return false;

    lux_error why = { 0 };
    snprintf(label, sizeof label, "%s: %s", f->path, pointer);
    float *mean = w->means[number].mean[srgb];
    if (!image_mean(path ? path : label, bytes, size, srgb, mean, &why))
        return path ? failed(err, why.code, "%s: %s", label, why.text)
                    : failed(err, why.code, "%s", why.text);
    for (int c = 0; c < 4; c++) /* what no light can pass is not a reflectance either */
        mean[c] = mean[c] >= 0.0f ? fminf(mean[c], 1.0f) : 0.0f;
    return w->means[number].known[srgb] = true;
}

/* The mean of a texture; white if there is none. */
static bool mean_colour(const picture_work *w, uint32_t material, const char *where,
                        source_index texture, bool srgb, float mean[4], lux_error *err)
{
    const reader *r = w->r;
    for (int c = 0; c < 4; c++)
        mean[c] = 1.0f;
    if (texture < 0)
        return true;
    if (!index_valid(r, texture, r->source->texture_count, "texture", err, "/materials/%u/%s/index",
                     material, where))
        return false;
    source_index picture = r->source->textures[texture];
    if (picture < 0) {
        tally_add(w->r, TALLY_NO_PICTURE, "/textures/%d", texture);
        return true;
    }
    if (!index_valid(r, picture, r->file->image_count, "image", err, "/textures/%d/source",
                     texture))
        return false;
    if (!w->means[picture].known[srgb] && !picture_mean(w, (uint32_t)picture, srgb, err))
        return false;
    memcpy(mean, w->means[picture].mean[srgb], 4 * sizeof *mean);
    tally_add(w->r, TALLY_TEXTURE, "/materials/%u/%s", material, where);
    return true;
}

static vec3 times(const double factor[3], const float mean[3], double strength)
{
    return (vec3){ (float)(factor[0] * (double)mean[0] * strength),
                   (float)(factor[1] * (double)mean[1] * strength),
                   (float)(factor[2] * (double)mean[2] * strength) };
}

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

static bool read_ior(reader *r, uint32_t number, gltf_material *out, lux_error *err)
{
    double ior = r->source->materials[number].ior;
    if (ior > 0.0 && ior < 1.0)
        return failed(
            err, ERR_FORMAT,
            "%s: /materials/%u/extensions/KHR_materials_ior/ior: %g, wanted 0, or 1 and more",
            r->file->path, number, ior);
    if (ior > 4.0)
        tally_add(r, TALLY_IOR, "/materials/%u/extensions/KHR_materials_ior/ior", number);
    out->ior = (float)fmin(ior, 4.0);
    return true;
}

static bool read_material(const picture_work *w, uint32_t number, gltf_material *out,
                          lux_error *err)
{
    const source_material *m = &w->r->source->materials[number];
    float base[4], surface[4], glow[4], clear[4];
    if (!mean_colour(w, number, "pbrMetallicRoughness/baseColorTexture", m->base_texture, true,
                     base, err) ||
        !mean_colour(w, number, "pbrMetallicRoughness/metallicRoughnessTexture", m->surface_texture,
                     false, surface, err) ||
        !mean_colour(w, number, "emissiveTexture", m->emission_texture, true, glow, err) ||
        !mean_colour(w, number, "extensions/KHR_materials_transmission/transmissionTexture",
                     m->transmission_texture, false, clear, err))
        return false;

    *out = (gltf_material){
        .name       = read_name(w->r, m->name, err),
        .base_color = times(m->base_color, base, 1.0),
        .alpha    = strcmp(m->alpha_mode, "OPAQUE") != 0 ? (float)m->base_color[3] * base[3] : 1.0f,
        .metallic = (float)m->metallic * surface[2],
        .roughness      = (float)m->roughness * surface[1],
        .emission       = times(m->emission, glow, m->strength),
        .transmission   = (float)m->transmission * clear[0],
        .specular       = (float)m->specular,
        .specular_color = (vec3){ (float)m->specular_color[0], (float)m->specular_color[1],
                                  (float)m->specular_color[2] },
        .unlit          = m->unlit,
    };
    const vec3 e = out->emission;
    if (!(isfinite(e.x) && isfinite(e.y) && isfinite(e.z)))
        return failed(err, ERR_FORMAT, "%s: /materials/%u/emissiveFactor: beyond every number",
                      w->r->file->path, number);
    read_volume(m, out);
    if (!read_ior(w->r, number, out, err))
        return false;
    return out->name != NULL;
}

bool read_materials(reader *r, lux_error *err)
{
    uint32_t count = r->source->material_count;
    picture_work w = { r, arena_array(r->file->scratch, image_means, r->file->image_count, err) };
    r->out->materials = arena_array(r->a, gltf_material, (size_t)count + 1, err);
    if (!w.means || !r->out->materials)
        return false;
    for (uint32_t i = 0; i < count; i++)
        if (!read_material(&w, i, &r->out->materials[i], err))
            return false;
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
