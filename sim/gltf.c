/* sim/gltf.c -- see gltf.h. The steps in order; extensions; what the user is told. */
#include "sim/gltf_source.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* ---- what is left out ---- */

static const char *const sentences[TALLY_KINDS] = {
    [TALLY_LINES]       = "primitives of points or lines are left out",
    [TALLY_NO_POSITION] = "primitives without POSITION are left out",
    [TALLY_EMPTY]       = "meshes have no triangles and are left out",
    [TALLY_FLAT]        = "triangles without area are left out",
    [TALLY_SINGULAR]    = "parts are left out: the matrix of their node has determinant 0",
    [TALLY_RANGE]       = "lights have a range, which is ignored",
    [TALLY_NO_PICTURE]  = "textures have no picture that lux4 reads: taken as white",
    [TALLY_WEBP]        = "textures in WebP cannot be read: the picture beside it is taken",
    [TALLY_OCCLUSION]   = "materials have an occlusion texture (shading, not light), ignored",
    [TALLY_THICKNESS]   = "materials have a thickness texture, ignored: their own shape counts",
    [TALLY_NO_TEXCOORD] = "primitives lack coordinates that their textures go by: taken as 0",
    [TALLY_NORMAL]      = "triangles have normals that are none, or of the back: they are flat",
    [TALLY_COLOR]       = "primitives have vertex colours (COLOR_0), which are ignored",
    [TALLY_MORPH]       = "primitives have morph targets, which are ignored",
    [TALLY_SKIN]        = "nodes have a skin, which is ignored: they are in the rest pose",
    [TALLY_TINT]        = "colours of EXT_lights_ies go beyond 1: cut off there",
    [TALLY_IOR]         = "materials have an index of refraction above 4: taken as 4",
};

void tally_add(reader *r, tally_kind kind, const char *pointer, ...)
{
    tally *t = &r->tallies[kind];
    if (t->count++)
        return;
    va_list args;
    va_start(args, pointer);
    vsnprintf(t->first, sizeof t->first, pointer, args);
    va_end(args);
}

static void tell_tallies(const reader *r)
{
    for (int i = 0; i < TALLY_KINDS; i++) {
        const tally *t = &r->tallies[i];
        if (t->count)
            notice_add(r->notices, "%s: %s: %llu %s", r->file->path, t->first,
                       (unsigned long long)t->count, sentences[i]);
    }
    if (r->file->animation_count)
        notice_add(r->notices, "%s: /animations: %u animations are ignored: the rest pose is read",
                   r->file->path, r->file->animation_count);
}

/* ---- extensions ---- */

/* Read. */
static const char *const simulated[] = {
    "KHR_mesh_quantization",
    "KHR_lights_punctual",
    "EXT_lights_ies",
    "EXT_lights_area",
    "EXT_mesh_gpu_instancing",
    "KHR_materials_emissive_strength",
    "KHR_materials_transmission",
    "KHR_materials_ior",
    "KHR_materials_specular",
    "KHR_materials_volume",
    "KHR_materials_unlit",
    "KHR_texture_transform",
    "EXT_texture_webp",
    NULL,
};

/* They change looks alone: a scene is whole without them. */
static const char *const looks[] = {
    "KHR_materials_clearcoat",
    "KHR_materials_sheen",
    "KHR_materials_iridescence",
    "KHR_materials_anisotropy",
    "KHR_materials_dispersion",
    "KHR_materials_variants",
    "KHR_materials_diffuse_transmission",
    "KHR_xmp_json_ld",
    "KHR_xmp",
    "KHR_animation_pointer",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_node_visibility",
    "EXT_lights_image_based",
    "MSFT_lod",
    "MSFT_packing_normalRoughnessMetallic",
    "MSFT_packing_occlusionRoughnessMetallic",
    NULL,
};

static bool listed(const char *const *list, const char *name)
{
    while (*list && strcmp(*list, name) != 0)
        list++;
    return *list != NULL;
}

static bool check_extensions(const reader *r, lux_error *err)
{
    const source *s = r->source;
    for (uint32_t i = 0; i < s->required_count; i++)
        if (!listed(simulated, s->required[i]) && !listed(looks, s->required[i]))
            return failed(err, ERR_UNSUPPORTED,
                          "%s: /extensionsRequired/%u: \"%.80s\" is not "
                          "supported",
                          r->file->path, i, s->required[i]);

    char names[240] = "";
    for (uint32_t i = 0; i < s->used_count; i++) {
        const char *name = s->used[i];
        size_t length    = strlen(names);
        if (!listed(simulated, name) && length < sizeof names - 1)
            snprintf(names + length, sizeof names - length, "%s%s", length ? ", " : "", name);
    }
    if (*names)
        notice_add(r->notices, "%s: /extensionsUsed: not simulated, ignored: %s", r->file->path,
                   names);
    return true;
}

static bool check_version(const reader *r, lux_error *err)
{
    const source *s = r->source;
    if (strncmp(s->version, "2.", 2) != 0)
        return failed(err, ERR_UNSUPPORTED, "%s: /asset/version: \"%.20s\", wanted \"2.0\"",
                      r->file->path, s->version);
    if (*s->least_version && strcmp(s->least_version, "2.0") != 0)
        return failed(err, ERR_UNSUPPORTED, "%s: /asset/minVersion: \"%.20s\", wanted \"2.0\"",
                      r->file->path, s->least_version);
    return true;
}

/* ---- what the schema's single rules do not say ---- */

static bool check_cameras(const reader *r, lux_error *err)
{
    for (uint32_t i = 0; i < r->source->camera_count; i++) {
        const source_camera *c = &r->source->cameras[i];
        if (!c->perspective && (c->xmag == 0 || c->ymag == 0))
            return failed(err, ERR_FORMAT,
                          "%s: /cameras/%u/orthographic: %g by %g m, wanted a width "
                          "and a height",
                          r->file->path, i, c->xmag, c->ymag);
    }
    return true;
}

const char *read_name(const reader *r, const char *name, lux_error *err)
{
    size_t length = strlen(name);
    char *copy    = arena_array(r->a, char, length + 1, err);
    return copy ? memcpy(copy, name, length) : NULL;
}

/* ---- the way through ---- */

static bool read_all(reader *r, gltf_file *f, source *s, const char *path, lux_error *err)
{
    return gltf_file_open(f, path, err) && gltf_file_check(f, err) && source_open(s, f, err) &&
           check_version(r, err) && check_extensions(r, err) && gltf_file_buffers(f, err) &&
           accessors_check(r, err) && check_cameras(r, err) && read_lights(r, err) &&
           textures_check(r, err) && read_meshes(r, err) && read_nodes(r, err) &&
           read_materials(r, err);
}

const gltf *gltf_read(arena *a, const char *path, notices *n, lux_error *err)
{
    arena scratch = { 0 };
    gltf_file f   = { .path = path, .scratch = &scratch };
    source s      = { 0 };
    reader r      = { .file = &f, .source = &s, .a = a, .notices = n };
    r.out         = arena_new(a, gltf, err);

    bool good = r.out && read_all(&r, &f, &s, path, err);
    if (good) {
        r.out->flat_triangles = r.tallies[TALLY_FLAT].count;
        tell_tallies(&r);
    }
    source_close(&s);
    arena_clear(&scratch);
    return good ? r.out : NULL;
}
