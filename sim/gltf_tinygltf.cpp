// sim/gltf_tinygltf.cpp -- the JSON of a glTF file as structures, by way of tinygltf.
//
// A shim: it calls the library, copies out what gltf_source.h names, and turns every exception
// into a `lux_error`. The library opens no file and decodes nothing: the JSON it is given names
// neither buffers nor images, and its callbacks refuse.
#include "sim/gltf_source.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>

namespace
{

using tinygltf::Value;

// ---- values of extensions ----

const Value *find(const tinygltf::ExtensionMap &map, const char *extension)
{
    auto it = map.find(extension);
    return it == map.end() ? nullptr : &it->second;
}

const Value *member(const Value *object, const char *key)
{
    return object && object->Has(key) ? &object->Get(key) : nullptr;
}

source_index index_in(const Value *object, const char *key)
{
    const Value *v = member(object, key);
    return v && v->IsInt() ? v->GetNumberAsInt() : -1;
}

double number_in(const Value *object, const char *key, double otherwise)
{
    const Value *v = member(object, key);
    return v && v->IsNumber() ? v->GetNumberAsDouble() : otherwise;
}

const char *text_in(const Value *object, const char *key)
{
    const Value *v = member(object, key);
    return v && v->IsString() ? v->Get<std::string>().c_str() : "";
}

void color_in(const Value *object, const char *key, double (&to)[3])
{
    const Value *v = member(object, key);
    for (size_t i = 0; i < 3; i++)
        to[i] = v && v->ArrayLen() == 3 ? v->Get(int(i)).GetNumberAsDouble() : 1.0;
}

template <size_t N> void copy(const std::vector<double> &from, double (&to)[N])
{
    if (from.size() == N)
        std::copy(from.begin(), from.end(), to);
}

source_index attribute(const tinygltf::Primitive &p, const char *name)
{
    auto it = p.attributes.find(name);
    return it == p.attributes.end() ? -1 : it->second;
}

// ---- one of each ----

void convert(const tinygltf::BufferView &from, source_view &to)
{
    to = { from.buffer, from.byteOffset, from.byteLength, from.byteStride };
}

void convert(const tinygltf::Accessor &from, source_accessor &to)
{
    to.view       = from.bufferView;
    to.offset     = from.byteOffset;
    to.count      = from.count;
    to.component  = from.componentType;
    to.width      = tinygltf::GetNumComponentsInType(uint32_t(from.type));
    to.normalized = from.normalized;
    to.sparse     = from.sparse.isSparse;
    if (!to.sparse)
        return;
    to.sparse_count    = size_t(from.sparse.count);
    to.index_view      = from.sparse.indices.bufferView;
    to.index_offset    = size_t(from.sparse.indices.byteOffset);
    to.index_component = from.sparse.indices.componentType;
    to.value_view      = from.sparse.values.bufferView;
    to.value_offset    = size_t(from.sparse.values.byteOffset);
}

void convert(const tinygltf::Primitive &from, source_primitive &to)
{
    to.mode        = from.mode;
    to.position    = attribute(from, "POSITION");
    to.normal      = attribute(from, "NORMAL");
    to.texcoord[0] = attribute(from, "TEXCOORD_0");
    to.texcoord[1] = attribute(from, "TEXCOORD_1");
    to.material    = from.material;
    to.colored     = attribute(from, "COLOR_0") >= 0;
    to.morphed     = !from.targets.empty();
}

void convert(const tinygltf::Node &from, source_node &to)
{
    const Value *instancing = find(from.extensions, "EXT_mesh_gpu_instancing");
    const Value *attributes = member(instancing, "attributes");
    const Value *ies        = find(from.extensions, "EXT_lights_ies");

    to.name                 = from.name.c_str();
    to.mesh                 = from.mesh;
    to.camera               = from.camera;
    to.skin                 = from.skin;
    to.multiplier           = number_in(ies, "multiplier", 1.0);
    to.children             = from.children.data();
    to.child_count          = uint32_t(from.children.size());
    to.has_matrix           = !from.matrix.empty();
    to.instanced            = instancing != nullptr;
    to.instance_move        = index_in(attributes, "TRANSLATION");
    to.instance_turn        = index_in(attributes, "ROTATION");
    to.instance_scale       = index_in(attributes, "SCALE");
    to.light[LIST_PUNCTUAL] = index_in(find(from.extensions, "KHR_lights_punctual"), "light");
    to.light[LIST_IES]      = index_in(ies, "light");
    to.light[LIST_AREA]     = index_in(find(from.extensions, "EXT_lights_area"), "light");
    color_in(ies, "color", to.tint);
    to.turn[3] = to.scale[0] = to.scale[1] = to.scale[2] = 1.0;
    copy(from.matrix, to.matrix);
    copy(from.translation, to.move);
    copy(from.rotation, to.turn);
    copy(from.scale, to.scale);
}

void pair_in(const Value *object, const char *key, double otherwise, double (&to)[2])
{
    const Value *v = member(object, key);
    for (size_t i = 0; i < 2; i++)
        to[i] = v && v->ArrayLen() == 2 ? v->Get(int(i)).GetNumberAsDouble() : otherwise;
}

source_slot slot(source_index texture, source_index set, const Value *moved)
{
    source_slot to = { texture, set, {}, number_in(moved, "rotation", 0.0), {} };
    if (member(moved, "texCoord"))
        to.set = index_in(moved, "texCoord");
    pair_in(moved, "offset", 0.0, to.offset);
    pair_in(moved, "scale", 1.0, to.scale);
    return to;
}

// Of a texture that the core names, and of one within an extension.
template <class Info> source_slot slot(const Info &from)
{
    return slot(from.index, from.texCoord, find(from.extensions, "KHR_texture_transform"));
}

source_slot slot(const Value *from)
{
    const Value *set = member(from, "texCoord");
    return slot(index_in(from, "index"), set ? index_in(from, "texCoord") : 0,
                member(member(from, "extensions"), "KHR_texture_transform"));
}

void convert(const tinygltf::Material &from, source_material &to)
{
    const auto &surface = from.pbrMetallicRoughness;
    const Value *clear  = find(from.extensions, "KHR_materials_transmission");
    const Value *glow   = find(from.extensions, "KHR_materials_emissive_strength");
    const Value *gloss  = find(from.extensions, "KHR_materials_specular");
    const Value *volume = find(from.extensions, "KHR_materials_volume");

    to.name                       = from.name.c_str();
    to.alpha_mode                 = from.alphaMode.c_str();
    to.metallic                   = surface.metallicFactor;
    to.roughness                  = surface.roughnessFactor;
    to.strength                   = number_in(glow, "emissiveStrength", 1.0);
    to.transmission               = number_in(clear, "transmissionFactor", 0.0);
    to.cutoff                     = from.alphaCutoff;
    to.normal_scale               = from.normalTexture.scale;
    to.occluded                   = from.occlusionTexture.index >= 0;
    to.varies                     = member(volume, "thicknessTexture") != nullptr;
    to.slots[SLOT_BASE]           = slot(surface.baseColorTexture);
    to.slots[SLOT_SURFACE]        = slot(surface.metallicRoughnessTexture);
    to.slots[SLOT_EMISSION]       = slot(from.emissiveTexture);
    to.slots[SLOT_NORMAL]         = slot(from.normalTexture);
    to.slots[SLOT_TRANSMISSION]   = slot(member(clear, "transmissionTexture"));
    to.slots[SLOT_SPECULAR]       = slot(member(gloss, "specularTexture"));
    to.slots[SLOT_SPECULAR_COLOR] = slot(member(gloss, "specularColorTexture"));
    to.ior                  = number_in(find(from.extensions, "KHR_materials_ior"), "ior", 1.5);
    to.specular             = number_in(gloss, "specularFactor", 1.0);
    to.thickness            = number_in(volume, "thicknessFactor", 0.0);
    to.attenuation_distance = number_in(volume, "attenuationDistance", HUGE_VAL);
    to.unlit                = find(from.extensions, "KHR_materials_unlit") != nullptr;
    color_in(gloss, "specularColorFactor", to.specular_color);
    color_in(volume, "attenuationColor", to.attenuation_color);
    copy(surface.baseColorFactor, to.base_color);
    copy(from.emissiveFactor, to.emission);
}

void convert(const tinygltf::Camera &from, source_camera &to)
{
    to.name        = from.name.c_str();
    to.perspective = from.type == "perspective";
    to.yfov        = from.perspective.yfov;
    to.aspect      = from.perspective.aspectRatio;
    to.xmag        = from.orthographic.xmag;
    to.ymag        = from.orthographic.ymag;
}

void convert(const tinygltf::Light &from, source_light &to)
{
    to.name      = from.name.c_str();
    to.type      = from.type.c_str();
    to.intensity = from.intensity;
    to.inner     = from.spot.innerConeAngle;
    to.outer     = from.spot.outerConeAngle;
    to.ranged    = from.range > 0.0;
    std::fill(to.color, to.color + 3, 1.0);
    copy(from.color, to.color);
}

void convert(const Value &from, source_area &to)
{
    to.name      = text_in(&from, "name");
    to.type      = text_in(&from, "type");
    to.shape     = text_in(&from, "shape");
    to.intensity = number_in(&from, "luminance", number_in(&from, "intensity", 1000.0));
    to.size      = number_in(&from, "size", 1.0);
    to.aspect    = number_in(member(&from, "rect"), "aspect", 1.0);
    to.width     = number_in(&from, "width", 0.0);
    to.height    = number_in(&from, "height", 0.0);
    to.radius    = number_in(&from, "radius", 0.0);
    color_in(&from, "color", to.color);
}

// A profile of EXT_lights_ies: all but its name is in gltf_file.profiles.
void convert(const Value &from, const char *&to) { to = text_in(&from, "name"); }

void convert(const tinygltf::Scene &from, source_scene &to)
{
    to = { from.nodes.data(), uint32_t(from.nodes.size()) };
}

void convert(const tinygltf::Texture &from, source_texture &to)
{
    to = { from.source, index_in(find(from.extensions, "EXT_texture_webp"), "source"),
           from.sampler };
}

void convert(const tinygltf::Sampler &from, source_sampler &to)
{
    to = { from.magFilter, from.wrapS, from.wrapT };
}

void convert(const std::string &from, const char *&to) { to = from.c_str(); }

// ---- all of each; a list that memory lacks for ends the whole by an exception ----

template <class From, class To>
To *convert_all(arena *a, const std::vector<From> &from, uint32_t &count)
{
    To *to = static_cast<To *>(arena_alloc(a, from.size(), sizeof(To), alignof(To), nullptr));
    if (!to)
        throw std::bad_alloc();
    for (size_t i = 0; i < from.size(); i++)
        convert(from[i], to[i]);
    count = uint32_t(from.size());
    return to;
}

// Indices of primitives come from the file's text: the library wants too much of them.
void convert_meshes(const gltf_file *f, const std::vector<tinygltf::Mesh> &from, source *s)
{
    arena *a                    = f->scratch;
    const source_index *indices = f->indices;
    source_mesh *to             = arena_array(a, source_mesh, from.size(), nullptr);
    if (!to)
        throw std::bad_alloc();
    for (size_t i = 0; i < from.size(); i++) {
        source_primitive *primitives = convert_all<tinygltf::Primitive, source_primitive>(
            a, from[i].primitives, to[i].primitive_count);
        for (size_t k = 0; k < from[i].primitives.size(); k++)
            primitives[k].indices = *indices++;
        to[i].name       = from[i].name.c_str();
        to[i].primitives = primitives;
    }
    s->meshes     = to;
    s->mesh_count = uint32_t(from.size());
}

const Value::Array &lights_of(const tinygltf::Model &m, const char *extension)
{
    static const Value::Array none;
    const Value *lights = member(find(m.extensions, extension), "lights");
    return lights && lights->IsArray() ? lights->Get<Value::Array>() : none;
}

void convert_model(const gltf_file *f, const tinygltf::Model &m, source *s)
{
    arena *a = f->scratch;
    using namespace tinygltf;
    s->views     = convert_all<BufferView, source_view>(a, m.bufferViews, s->view_count);
    s->accessors = convert_all<Accessor, source_accessor>(a, m.accessors, s->accessor_count);
    s->nodes     = convert_all<Node, source_node>(a, m.nodes, s->node_count);
    s->materials = convert_all<Material, source_material>(a, m.materials, s->material_count);
    s->cameras   = convert_all<Camera, source_camera>(a, m.cameras, s->camera_count);
    s->lights    = convert_all<Light, source_light>(a, m.lights, s->light_count);
    s->areas = convert_all<Value, source_area>(a, lights_of(m, "EXT_lights_area"), s->area_count);
    s->profile_names =
        convert_all<Value, const char *>(a, lights_of(m, "EXT_lights_ies"), s->profile_name_count);
    s->scenes   = convert_all<Scene, source_scene>(a, m.scenes, s->scene_count);
    s->textures = convert_all<Texture, source_texture>(a, m.textures, s->texture_count);
    s->samplers = convert_all<Sampler, source_sampler>(a, m.samplers, s->sampler_count);
    s->used     = convert_all<std::string, const char *>(a, m.extensionsUsed, s->used_count);
    s->required =
        convert_all<std::string, const char *>(a, m.extensionsRequired, s->required_count);
    convert_meshes(f, m.meshes, s);

    s->scene         = m.defaultScene;
    s->version       = m.asset.version.c_str();
    s->least_version = m.asset.minVersion.c_str();
}

// ---- callbacks: the library has nothing to look for ----

bool no_file(const std::string &, void *) { return false; }
std::string same_path(const std::string &path, void *) { return path; }
bool no_reading(std::vector<unsigned char> *, std::string *, const std::string &, void *)
{
    return false;
}
bool no_writing(std::string *, const std::string &, const std::vector<unsigned char> &, void *)
{
    return false;
}
bool no_picture(tinygltf::Image *, const int, std::string *, std::string *, int, int,
                const unsigned char *, int, void *)
{
    return true;
}

void *refused(const gltf_file *f, lux_error *err, const char *why)
{
    char line[400];
    snprintf(line, sizeof line, "%s", *why ? why : "no glTF");
    line[strcspn(line, "\r\n")] = 0;
    return failed(err, ERR_FORMAT, "%s: %s", f->path, line);
}

} // namespace

extern "C" bool source_open(source *s, const gltf_file *f, lux_error *err)
try {
    auto model = std::make_unique<tinygltf::Model>();
    tinygltf::TinyGLTF library;
    library.SetFsCallbacks({ no_file, same_path, no_reading, no_writing, nullptr });
    library.SetImageLoader(no_picture, nullptr);

    std::string why, warning;
    if (!library.LoadASCIIFromString(model.get(), &why, &warning, f->json,
                                     static_cast<unsigned>(f->json_size), ""))
        return refused(f, err, why.c_str());
    convert_model(f, *model, s);
    s->model = model.release();
    return true;
} catch (const std::bad_alloc &) {
    return failed(err, ERR_MEMORY, "%s: out of memory", f->path);
} catch (const std::exception &e) {
    return refused(f, err, e.what());
} catch (...) {
    return refused(f, err, "");
}

extern "C" void source_close(source *s)
{
    delete static_cast<tinygltf::Model *>(s->model);
    s->model = nullptr;
}
