/* sim/gltf_rules.c -- the part of glTF 2.0's schema that lux4 builds on, as rules for its JSON.
 *
 * After the specification (Khronos, glTF 2.0.1, appendix A) and the READMEs of the extensions.
 * What is not named here is not looked at; nor does anybody use it.
 */
#include "sim/gltf_json.h"
#include "sim/gltf_source.h"

#include <float.h>
#include <stdlib.h>

enum {
    NOTE_BUFFER = 1,
    NOTE_BUFFER_LENGTH,
    NOTE_BUFFER_URI,
    NOTE_IMAGE,
    NOTE_IMAGE_URI,
    NOTE_IMAGE_VIEW,
    NOTE_PROFILE,
    NOTE_PROFILE_URI,
    NOTE_PROFILE_VIEW,
    NOTE_PRIMITIVE,
    NOTE_INDICES,
    NOTE_ANIMATION,
    NOTE_SKIN,
};

#define MUST       .required = true
#define EITHER     .either = true
#define OF_3       .length = 3
#define AT_LEAST_0 .low = 0, .high = DBL_MAX
#define UP_TO_1    .low = 0, .high = 1
#define ABOVE_0    .low = DBL_MIN, .high = DBL_MAX
/* Of whole numbers within extensions the library keeps 32 bits: the sun has 1.6e9 cd/m^2 */
#define NARROW      .narrow = true
#define UP_TO_INT   .low = 0, .high = 2e9
#define ABOVE_0_INT .low = DBL_MIN, .high = 2e9
#define FAR         .low = -1e9, .high = 1e9
#define COLOR       OF_3, .low = 0, .high = 1e6
/* clang-format off */
#define OBJECT(name, rules)  { name, JSON_OBJECT, rules }
#define OBJECTS(name, rules) { name, JSON_OBJECTS, rules }
#define INDEX(name)          { name, JSON_INDEX }
#define NAME                 { "name", JSON_TEXT }
#define END                  { 0 }
/* clang-format on */

/* ---- bytes ---- */

static const json_rule buffer[] = { NAME,
                                    { "uri", JSON_TEXT, .note = NOTE_BUFFER_URI },
                                    { "byteLength", JSON_SIZE, MUST, .low = 1, .high = DBL_MAX,
                                      .note = NOTE_BUFFER_LENGTH },
                                    END };
static const json_rule image[]  = { NAME,
                                    { "uri", JSON_TEXT, .note = NOTE_IMAGE_URI },
                                    { "mimeType", JSON_TEXT },
                                    { "bufferView", JSON_INDEX, .note = NOTE_IMAGE_VIEW },
                                    END };
static const json_rule view[]   = { { "buffer", JSON_INDEX, MUST },
                                    { "byteOffset", JSON_SIZE },
                                    { "byteLength", JSON_SIZE, MUST, .low = 1, .high = DBL_MAX },
                                    { "byteStride", JSON_SIZE, .low = 4, .high = 252,
                                      .multiple_of = 4 },
                                    { "target", JSON_INDEX },
                                    NAME,
                                    END };

static const json_rule sparse_indices[]  = { { "bufferView", JSON_INDEX, MUST },
                                             { "byteOffset", JSON_INDEX },
                                             { "componentType", JSON_INDEX, MUST },
                                             END };
static const json_rule sparse_values[]   = { { "bufferView", JSON_INDEX, MUST },
                                             { "byteOffset", JSON_INDEX },
                                             END };
static const json_rule accessor_sparse[] = { { "count", JSON_INDEX, MUST, .low = 1, .high = 1e15 },
                                             { "indices", JSON_OBJECT, sparse_indices, MUST },
                                             { "values", JSON_OBJECT, sparse_values, MUST },
                                             END };
static const json_rule accessor[]        = { INDEX("bufferView"),
                                             { "byteOffset", JSON_SIZE },
                                             { "componentType", JSON_INDEX, MUST },
                                             { "normalized", JSON_FLAG },
                                             { "count", JSON_SIZE, MUST, .low = 1, .high = 1e15 },
                                             { "type", JSON_TEXT, MUST,
                                               .among = "SCALAR|VEC2|VEC3|VEC4|MAT2|MAT3|MAT4" },
                                             { "min", JSON_NUMBERS },
                                             { "max", JSON_NUMBERS },
                                             OBJECT("sparse", accessor_sparse),
                                             NAME,
                                             END };

/* ---- meshes and materials ---- */

static const json_rule primitive[]  = { { "attributes", JSON_MAP, MUST },
                                        { "indices", JSON_INDEX, .hide = true,
                                          .note = NOTE_INDICES },
                                        INDEX("material"),
                                        { "mode", JSON_INDEX, .low = 0, .high = 6 },
                                        { "targets", JSON_ANY },
                                        { "extensions", JSON_OBJECT },
                                        END };
static const json_rule mesh_rules[] = { NAME,
                                        { "primitives", JSON_OBJECTS, primitive, MUST,
                                          .note = NOTE_PRIMITIVE },
                                        { "weights", JSON_NUMBERS },
                                        { "extensions", JSON_OBJECT },
                                        END };

static const json_rule transform_rules[]  = { { "offset", JSON_NUMBERS, .length = 2, FAR },
                                              { "rotation", JSON_NUMBER, FAR },
                                              { "scale", JSON_NUMBERS, .length = 2, FAR },
                                              INDEX("texCoord"),
                                              END };
static const json_rule texture_info_ext[] = { OBJECT("KHR_texture_transform", transform_rules),
                                              END };
static const json_rule texture_info[]     = { { "index", JSON_INDEX, MUST },
                                              INDEX("texCoord"),
                                              { "scale", JSON_NUMBER, FAR }, /* of normalTexture */
                                              OBJECT("extensions", texture_info_ext),
                                              END };
static const json_rule webp[]             = { INDEX("source"), END };
static const json_rule texture_ext[]      = { OBJECT("EXT_texture_webp", webp), END };
static const json_rule texture[]          = { INDEX("source"), INDEX("sampler"), NAME,
                                              OBJECT("extensions", texture_ext), END };
static const json_rule sampler[] = { { "magFilter", JSON_INDEX, .low = 9728, .high = 9729 },
                                     { "minFilter", JSON_INDEX, .low = 9728, .high = 9987 },
                                     INDEX("wrapS"),
                                     INDEX("wrapT"),
                                     NAME,
                                     { "extensions", JSON_OBJECT },
                                     END };

static const json_rule surface[]      = { { "baseColorFactor", JSON_NUMBERS, .length = 4, UP_TO_1 },
                                          OBJECT("baseColorTexture", texture_info),
                                          { "metallicFactor", JSON_NUMBER, UP_TO_1 },
                                          { "roughnessFactor", JSON_NUMBER, UP_TO_1 },
                                          OBJECT("metallicRoughnessTexture", texture_info),
                                          END };
static const json_rule strength[]     = { { "emissiveStrength", JSON_NUMBER, UP_TO_INT }, END };
static const json_rule transmission[] = { { "transmissionFactor", JSON_NUMBER, UP_TO_1 },
                                          OBJECT("transmissionTexture", texture_info),
                                          END };
static const json_rule ior[]          = { { "ior", JSON_NUMBER, AT_LEAST_0, NARROW }, END };
static const json_rule specular[]     = { { "specularFactor", JSON_NUMBER, UP_TO_1 },
                                          OBJECT("specularTexture", texture_info),
                                          { "specularColorFactor", JSON_NUMBERS, COLOR },
                                          OBJECT("specularColorTexture", texture_info),
                                          END };
static const json_rule volume[]       = { { "thicknessFactor", JSON_NUMBER, AT_LEAST_0, NARROW },
                                          OBJECT("thicknessTexture", texture_info),
                                          { "attenuationDistance", JSON_NUMBER, ABOVE_0, NARROW },
                                          { "attenuationColor", JSON_NUMBERS, OF_3, UP_TO_1 },
                                          END };
static const json_rule material_ext[] = { OBJECT("KHR_materials_emissive_strength", strength),
                                          OBJECT("KHR_materials_transmission", transmission),
                                          OBJECT("KHR_materials_ior", ior),
                                          OBJECT("KHR_materials_specular", specular),
                                          OBJECT("KHR_materials_volume", volume),
                                          { "KHR_materials_unlit", JSON_OBJECT },
                                          END };
static const json_rule material[]     = { NAME,
                                          OBJECT("pbrMetallicRoughness", surface),
                                          OBJECT("normalTexture", texture_info),
                                          OBJECT("occlusionTexture", texture_info),
                                          OBJECT("emissiveTexture", texture_info),
                                          { "emissiveFactor", JSON_NUMBERS, OF_3, AT_LEAST_0 },
                                          { "alphaMode", JSON_TEXT, .among = "OPAQUE|MASK|BLEND" },
                                          { "alphaCutoff", JSON_NUMBER, AT_LEAST_0 },
                                          { "doubleSided", JSON_FLAG },
                                          OBJECT("extensions", material_ext),
                                          END };

/* ---- nodes, cameras, lights ---- */

static const json_rule node_light[] = { { "light", JSON_INDEX, MUST }, END };
static const json_rule node_ies[]   = { { "light", JSON_INDEX, MUST },
                                        { "multiplier", JSON_NUMBER, UP_TO_INT },
                                        { "color", JSON_NUMBERS, COLOR },
                                        END };
static const json_rule instancing[] = { { "attributes", JSON_MAP, MUST }, END };
static const json_rule node_ext[]   = { OBJECT("KHR_lights_punctual", node_light),
                                        OBJECT("EXT_lights_ies", node_ies),
                                        OBJECT("EXT_lights_area", node_light),
                                        OBJECT("EXT_mesh_gpu_instancing", instancing), END };
static const json_rule node[]       = { NAME,
                                        INDEX("mesh"),
                                        INDEX("camera"),
                                        INDEX("skin"),
                                        { "children", JSON_INDICES },
                                        { "matrix", JSON_NUMBERS, .length = 16 },
                                        { "translation", JSON_NUMBERS, OF_3 },
                                        { "rotation", JSON_NUMBERS, .length = 4 },
                                        { "scale", JSON_NUMBERS, OF_3 },
                                        { "weights", JSON_NUMBERS },
                                        OBJECT("extensions", node_ext),
                                        END };
static const json_rule scene[]      = { NAME, { "nodes", JSON_INDICES }, END };

static const json_rule perspective[]  = { { "yfov", JSON_NUMBER, MUST, .low = DBL_MIN,
                                            .high = 3.1415926 },
                                          { "aspectRatio", JSON_NUMBER, ABOVE_0 },
                                          { "znear", JSON_NUMBER, MUST, AT_LEAST_0 },
                                          { "zfar", JSON_NUMBER, ABOVE_0 },
                                          END };
static const json_rule orthographic[] = { { "xmag", JSON_NUMBER, MUST },
                                          { "ymag", JSON_NUMBER, MUST },
                                          { "znear", JSON_NUMBER, MUST, AT_LEAST_0 },
                                          { "zfar", JSON_NUMBER, MUST, ABOVE_0 },
                                          END };
static const json_rule camera[]       = { NAME,
                                          { "type", JSON_TEXT, MUST,
                                            .among = "perspective|orthographic" },
                                          OBJECT("perspective", perspective),
                                          OBJECT("orthographic", orthographic),
                                          END };

static const json_rule spot[]   = { { "innerConeAngle", JSON_NUMBER, .low = 0, .high = 1.5707964 },
                                    { "outerConeAngle", JSON_NUMBER, .low = 0, .high = 1.5707964 },
                                    END };
static const json_rule light[]  = { NAME,
                                    { "type", JSON_TEXT, MUST, .among = "point|spot|directional" },
                                    { "color", JSON_NUMBERS, COLOR },
                                    { "intensity", JSON_NUMBER, AT_LEAST_0 },
                                    { "range", JSON_NUMBER, ABOVE_0 },
                                    OBJECT("spot", spot),
                                    END };
static const json_rule lights[] = { { "lights", JSON_OBJECTS, light, MUST }, END };

static const json_rule profile[]  = { NAME,
                                      { "uri", JSON_TEXT, EITHER, .note = NOTE_PROFILE_URI },
                                      { "bufferView", JSON_INDEX, EITHER,
                                        .note = NOTE_PROFILE_VIEW },
                                      { "mimeType", JSON_TEXT, .among = "application/x-ies-lm-63" },
                                      END };
static const json_rule profiles[] = {
    { "lights", JSON_OBJECTS, profile, MUST, .note = NOTE_PROFILE }, END
};

/* Both drafts: type, intensity, size, rect; shape, luminance, width, height, radius. */
static const json_rule area_rect[] = { { "aspect", JSON_NUMBER, ABOVE_0_INT }, END };
static const json_rule area[]      = { NAME,
                                       { "type", JSON_TEXT, EITHER, .among = "rect|disk" },
                                       { "shape", JSON_TEXT, EITHER, .among = "rect|disk" },
                                       { "color", JSON_NUMBERS, COLOR },
                                       { "intensity", JSON_NUMBER, UP_TO_INT },
                                       { "luminance", JSON_NUMBER, UP_TO_INT },
                                       { "size", JSON_NUMBER, ABOVE_0_INT },
                                       { "width", JSON_NUMBER, ABOVE_0_INT },
                                       { "height", JSON_NUMBER, ABOVE_0_INT },
                                       { "radius", JSON_NUMBER, ABOVE_0_INT },
                                       OBJECT("rect", area_rect),
                                       END };
static const json_rule areas[]     = { { "lights", JSON_OBJECTS, area, MUST }, END };

static const json_rule extension[] = { OBJECT("KHR_lights_punctual", lights),
                                       OBJECT("EXT_lights_ies", profiles),
                                       OBJECT("EXT_lights_area", areas), END };

/* ---- the whole ---- */

static const json_rule asset[] = { { "version", JSON_TEXT, MUST },
                                   { "minVersion", JSON_TEXT },
                                   END };
static const json_rule root[]  = {
     { "asset", JSON_OBJECT, asset, MUST },
     { "extensionsUsed", JSON_TEXTS },
     { "extensionsRequired", JSON_TEXTS },
     { "buffers", JSON_OBJECTS, buffer, .hide = true, .note = NOTE_BUFFER },
     { "images", JSON_OBJECTS, image, .hide = true, .note = NOTE_IMAGE },
     OBJECTS("bufferViews", view),
     OBJECTS("accessors", accessor),
     OBJECTS("meshes", mesh_rules),
     OBJECTS("textures", texture),
     OBJECTS("materials", material),
     OBJECTS("nodes", node),
     OBJECTS("cameras", camera),
     OBJECTS("scenes", scene),
     INDEX("scene"),
     OBJECT("extensions", extension),
     { "animations", JSON_OBJECTS, .hide = true, .note = NOTE_ANIMATION },
     { "skins", JSON_OBJECTS, .hide = true, .note = NOTE_SKIN },
     OBJECTS("samplers", sampler),
     END
};

/* One more in a list that doubles when it is full; NULL if memory is out. */
static void *grow(arena *a, void *list, uint32_t *count, uint32_t *room, size_t size,
                  lux_error *err)
{
    if (*count == *room) {
        uint32_t wider = *room ? *room * 2 : 8;
        char *moved    = arena_alloc(a, wider, size, alignof(max_align_t), err);
        if (!moved)
            return NULL;
        if (*count)
            __builtin_memcpy(moved, list, *count * size);
        list  = moved;
        *room = wider;
    }
    ++*count;
    return list;
}

static source_content *grow_contents(arena *a, source_content *list, uint32_t *count,
                                     uint32_t *room, lux_error *err)
{
    list = grow(a, list, count, room, sizeof *list, err);
    if (list)
        list[*count - 1] = (source_content){ .view = -1 };
    return list;
}

/* A new element of a list. */
static bool seen_element(gltf_file *f, int note, lux_error *err)
{
    switch (note) {
    case NOTE_BUFFER:
        f->buffers = grow(f->scratch, f->buffers, &f->buffer_count, &f->buffer_room,
                          sizeof *f->buffers, err);
        return f->buffers != NULL;
    case NOTE_IMAGE:
        f->images = grow_contents(f->scratch, f->images, &f->image_count, &f->image_room, err);
        return f->images != NULL;
    case NOTE_PROFILE:
        f->profiles =
            grow_contents(f->scratch, f->profiles, &f->profile_count, &f->profile_room, err);
        return f->profiles != NULL;
    default:
        f->indices = grow(f->scratch, f->indices, &f->primitive_count, &f->primitive_room,
                          sizeof *f->indices, err);
        if (f->indices)
            f->indices[f->primitive_count - 1] = -1;
        return f->indices != NULL;
    }
}

static bool seen(void *context, int note, const char *value, size_t length, lux_error *err)
{
    gltf_file *f      = context;
    source_buffer *b  = f->buffer_count ? &f->buffers[f->buffer_count - 1] : NULL;
    source_content *i = f->image_count ? &f->images[f->image_count - 1] : NULL;
    source_content *p = f->profile_count ? &f->profiles[f->profile_count - 1] : NULL;
    switch (note) {
    case NOTE_BUFFER:
    case NOTE_IMAGE:
    case NOTE_PROFILE:
    case NOTE_PRIMITIVE:
        return seen_element(f, note, err);
    case NOTE_INDICES:
        f->indices[f->primitive_count - 1] = (source_index)strtoll(value, NULL, 10);
        break;
    case NOTE_ANIMATION:
        f->animation_count++;
        break;
    case NOTE_SKIN:
        f->skin_count++;
        break;
    case NOTE_BUFFER_LENGTH:
        b->declared = strtoull(value, NULL, 10);
        break;
    case NOTE_BUFFER_URI:
        b->uri = value, b->uri_length = length;
        break;
    case NOTE_IMAGE_VIEW:
        i->view = (source_index)strtoll(value, NULL, 10);
        break;
    case NOTE_IMAGE_URI:
        i->uri = value, i->uri_length = length;
        break;
    case NOTE_PROFILE_VIEW:
        p->view = (source_index)strtoll(value, NULL, 10);
        break;
    case NOTE_PROFILE_URI:
        p->uri = value, p->uri_length = length;
        break;
    }
    return true;
}

bool gltf_file_check(gltf_file *f, lux_error *err)
{
    return json_obeys(&(json_check){ f->path, f->json, f->json_size, root, seen, f }, err);
}
