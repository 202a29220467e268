/* sim/gltf_texture.c -- the pictures of materials: each loaded once, and how it lies on surfaces.
 *
 * glTF 2.0.1, sections 3.8 and 3.9.2; KHR_texture_transform: coordinates are scaled, then turned
 * counter-clockwise as they are seen in the picture, whose v runs downward, then moved:
 *
 *     u' =  sx cos(r) u + sy sin(r) v + ox
 *     v' = -sx sin(r) u + sy cos(r) v + oy
 *
 * The extension's example (the lower left quarter of the picture by a quarter turn) and the
 * programs that write it agree on that; the matrix printed in its text turns the other way
 * (KhronosGroup/glTF, issue 1563).
 */
#include "core/image.h"
#include "materials/look.h"
#include "sim/gltf_source.h"

#include <float.h>
#include <stdio.h>
#include <string.h>

enum { NEAREST = 9728, REPEAT = 10497, CLAMP = 33071, MIRROR = 33648 };

/* Of all pictures: 2 GB of floats, and a third more for what is made of them. */
static const uint64_t texels_most = (uint64_t)1 << 27;

/* A texture on the shelf. */
typedef struct shelved {
    struct shelved *next; /* of the same image */
    texture_wrap wrap_u, wrap_v;
    bool nearest, srgb;
    bool glows; /* above 1 it is what the picture says */
    bool plain; /* nothing is above 1 anyway */
    const texture *texture;
} shelved;

static const char *const slot_names[SLOT_KINDS] = {
    [SLOT_BASE]           = "pbrMetallicRoughness/baseColorTexture",
    [SLOT_SURFACE]        = "pbrMetallicRoughness/metallicRoughnessTexture",
    [SLOT_EMISSION]       = "emissiveTexture",
    [SLOT_TRANSMISSION]   = "extensions/KHR_materials_transmission/transmissionTexture",
    [SLOT_SPECULAR]       = "extensions/KHR_materials_specular/specularTexture",
    [SLOT_SPECULAR_COLOR] = "extensions/KHR_materials_specular/specularColorTexture",
    [SLOT_NORMAL]         = "normalTexture",
};

/* Alpha is never sRGB: what only alpha counts of can share a texture with colours. */
static const bool slot_is_srgb[SLOT_KINDS] = {
    [SLOT_BASE]           = true,
    [SLOT_EMISSION]       = true,
    [SLOT_SPECULAR]       = true,
    [SLOT_SPECULAR_COLOR] = true,
};

/* ---- what the file says of textures ---- */

static bool is_zero(const double c[3]) { return c[0] == 0.0 && c[1] == 0.0 && c[2] == 0.0; }

/* Whether there is a texture that changes anything. */
static bool slot_matters(const source_material *m, source_slot_kind kind)
{
    if (m->slots[kind].texture < 0)
        return false;
    switch (kind) {
    case SLOT_SURFACE:
        return m->metallic > 0.0 || m->roughness > 0.0;
    case SLOT_EMISSION:
        return !is_zero(m->emission) && m->strength > 0.0;
    case SLOT_TRANSMISSION:
        return m->transmission > 0.0;
    case SLOT_SPECULAR:
        return m->specular > 0.0;
    case SLOT_SPECULAR_COLOR:
        return m->specular > 0.0 && !is_zero(m->specular_color);
    case SLOT_NORMAL:
        return m->normal_scale != 0.0;
    default:
        return true;
    }
}

bool slots_use_set(const reader *r, source_index material, int set)
{
    const source_material *m = material >= 0 ? &r->source->materials[material] : NULL;
    for (int k = 0; m && k < SLOT_KINDS; k++)
        if (slot_matters(m, (source_slot_kind)k) && m->slots[k].set == set)
            return true;
    return false;
}

static bool wrap_valid(const reader *r, uint32_t i, const char *key, int wrap, lux_error *err)
{
    return wrap == REPEAT || wrap == CLAMP || wrap == MIRROR ||
           failed(err, ERR_FORMAT, "%s: /samplers/%u/%s: %d, wanted 10497, 33071 or 33648",
                  r->file->path, i, key, wrap);
}

static bool texture_valid(const reader *r, uint32_t i, lux_error *err)
{
    const source_texture *t = &r->source->textures[i];
    uint32_t images         = r->file->image_count;
    return (t->image < 0 ||
            index_valid(r, t->image, images, "image", err, "/textures/%u/source", i)) &&
           (t->webp < 0 || index_valid(r, t->webp, images, "image", err,
                                       "/textures/%u/extensions/EXT_texture_webp/source", i)) &&
           (t->sampler < 0 || index_valid(r, t->sampler, r->source->sampler_count, "sampler", err,
                                          "/textures/%u/sampler", i));
}

bool textures_check(const reader *r, lux_error *err)
{
    const source *s = r->source;
    for (uint32_t i = 0; i < s->sampler_count; i++)
        if (!wrap_valid(r, i, "wrapS", s->samplers[i].wrap_u, err) ||
            !wrap_valid(r, i, "wrapT", s->samplers[i].wrap_v, err))
            return false;
    for (uint32_t i = 0; i < s->texture_count; i++)
        if (!texture_valid(r, i, err))
            return false;
    for (uint32_t i = 0; i < s->material_count; i++)
        for (int k = 0; k < SLOT_KINDS; k++) {
            source_index t = s->materials[i].slots[k].texture;
            if (t >= 0 && !index_valid(r, t, s->texture_count, "texture", err,
                                       "/materials/%u/%s/index", i, slot_names[k]))
                return false;
        }
    return true;
}

/* ---- pictures ---- */

/* Takes what is no share of light for the nearest that is: below 0, and above 1 where nothing
 * glows. What is not finite stays, to be refused. Whether nothing was above 1. */
static bool limit_texels(float *rgba, size_t count, bool glows)
{
    bool plain = true;
    for (size_t i = 0; i < 4 * count; i++) {
        bool above = rgba[i] > 1.0f && rgba[i] <= FLT_MAX;
        plain      = plain && !above;
        if (rgba[i] < 0.0f && rgba[i] >= -FLT_MAX)
            rgba[i] = 0.0f;
        if (above && (!glows || i % 4 == 3))
            rgba[i] = 1.0f;
    }
    return plain;
}

/* The texture of decoded texels, named `label`. */
static const texture *make_texture(reader *r, shelved *p, texture_desc *d, float *rgba,
                                   lux_error *err)
{
    uint64_t count = (uint64_t)d->width * (uint64_t)d->height;
    if (count > texels_most - r->texels)
        return failed(err, ERR_UNSUPPORTED, "%s: with it more than %llu texels", d->name,
                      (unsigned long long)texels_most);
    r->texels += count;
    p->plain = limit_texels(rgba, (size_t)count, p->glows);
    d->rgba  = rgba;
    return texture_new(r->a, d, err);
}

static const texture *load_picture(reader *r, uint32_t number, shelved *p, arena *scratch,
                                   lux_error *err)
{
    const source_content *c = &r->file->images[number];
    const uint8_t *bytes    = NULL;
    size_t size             = 0;
    const char *path        = NULL;
    char pointer[48];
    snprintf(pointer, sizeof pointer, "/images/%u%s", number, c->uri ? "/uri" : "/bufferView");
    if (!content_locate(r, c, pointer, &bytes, &size, &path, err))
        return NULL;

    size_t length = strlen(r->file->path) + strlen(pointer) + 3;
    char *label   = arena_array(r->a, char, length, err);
    if (!label)
        return NULL;
    snprintf(label, length, "%s: %s", r->file->path, pointer);
    texture_desc d = {
        .name = label, .wrap_u = p->wrap_u, .wrap_v = p->wrap_v, .nearest = p->nearest
    };
    lux_error why = { 0 };
    float *rgba   = NULL;
    if (image_load_rgba(path ? path : label, bytes, size, p->srgb, scratch, &d.width, &d.height,
                        &rgba, &why))
        return make_texture(r, p, &d, rgba, err);
    return path ? failed(err, why.code, "%s: %s", label, why.text)
                : failed(err, why.code, "%s", why.text);
}

static texture_wrap wrap_of(int number)
{
    return number == CLAMP ? WRAP_CLAMP : number == MIRROR ? WRAP_MIRROR : WRAP_REPEAT;
}

static bool serves(const shelved *p, const shelved *wanted)
{
    return p->wrap_u == wanted->wrap_u && p->wrap_v == wanted->wrap_v &&
           p->nearest == wanted->nearest && p->srgb == wanted->srgb &&
           (p->plain || p->glows == wanted->glows);
}

/* The texture of an image as a sampler and a slot want it. */
static const texture *take(texture_shelf *s, source_index picture, source_index sampler,
                           source_slot_kind kind, lux_error *err)
{
    reader *r               = s->r;
    const source_sampler *o = sampler >= 0 ? &r->source->samplers[sampler] : NULL;
    shelved wanted          = { .srgb = slot_is_srgb[kind], .glows = kind == SLOT_EMISSION };
    if (o) {
        wanted.wrap_u  = wrap_of(o->wrap_u);
        wanted.wrap_v  = wrap_of(o->wrap_v);
        wanted.nearest = o->magnify == NEAREST;
    }
    for (const shelved *p = s->of_image[picture]; p; p = p->next)
        if (serves(p, &wanted))
            return p->texture;

    shelved *made = arena_new(r->file->scratch, shelved, err);
    if (!made)
        return NULL;
    *made         = wanted;
    arena pixels  = { 0 };
    made->texture = load_picture(r, (uint32_t)picture, made, &pixels, err);
    arena_clear(&pixels);
    if (made->texture) {
        made->next           = s->of_image[picture];
        s->of_image[picture] = made;
        r->out->texture_count++;
    }
    return made->texture;
}

/* Of two pictures the one in WebP, if that can be read; NULL in *out if there is none at all. */
static bool take_either(texture_shelf *s, source_index number, source_slot_kind kind,
                        const texture **out, lux_error *err)
{
    const source_texture *t = &s->r->source->textures[number];
    *out                    = NULL;
    if (t->webp >= 0 && !s->no_webp[number]) {
        lux_error why = { 0 };
        *out          = take(s, t->webp, t->sampler, kind, t->image < 0 ? err : &why);
        if (*out || t->image < 0)
            return *out != NULL;
        s->no_webp[number] = true;
        tally_add(s->r, TALLY_WEBP, "/textures/%d", number);
    }
    if (t->image < 0) {
        tally_add(s->r, TALLY_NO_PICTURE, "/textures/%d", number);
        return true;
    }
    *out = take(s, t->image, t->sampler, kind, err);
    return *out != NULL;
}

/* ---- in use ---- */

bool shelf_open(texture_shelf *s, reader *r, lux_error *err)
{
    arena *scratch = r->file->scratch;
    s->r           = r;
    s->of_image    = arena_array(scratch, shelved *, r->file->image_count, err);
    s->no_webp     = arena_array(scratch, bool, r->source->texture_count, err);
    return s->of_image && s->no_webp;
}

bool slot_read(texture_shelf *s, uint32_t material, source_slot_kind kind, texture_slot *to,
               lux_error *err)
{
    const source_material *m = &s->r->source->materials[material];
    const source_slot *from  = &m->slots[kind];
    *to                      = (texture_slot){ 0 };
    if (!slot_matters(m, kind))
        return true;
    if (from->set < 0 || from->set > 1)
        return failed(err, ERR_UNSUPPORTED,
                      "%s: /materials/%u/%s/texCoord: %d, wanted 0 or 1 (TEXCOORD_0, TEXCOORD_1)",
                      s->r->file->path, material, slot_names[kind], from->set);
    const texture *picture;
    if (!take_either(s, from->texture, kind, &picture, err))
        return false;
    if (!picture)
        return true;
    double c = cos(from->rotation), d = sin(from->rotation);
    double sx = from->scale[0], sy = from->scale[1];
    *to = (texture_slot){
        .texture = picture,
        .set     = from->set,
        .m       = { (float)(c * sx), (float)(d * sy), (float)from->offset[0], /* u' */
                     (float)(-d * sx), (float)(c * sy), (float)from->offset[1] },
    };
    return true;
}
