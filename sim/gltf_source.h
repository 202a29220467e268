/* sim/gltf_source.h -- between the files of the glTF reader: what stands in a file, as plain C.
 *
 *     gltf_file.c       the bytes: .gltf or .glb, buffers
 *     gltf_uri.c        data: URIs, files beside it, and no way out of the folder
 *     gltf_rules.c      the JSON against glTF's schema (gltf_json.c)
 *     gltf_tinygltf.cpp the JSON as structures: only this file knows the library
 *     gltf_access.c     accessors: buffer views, strides, sparse and normalised numbers
 *     gltf_mesh.c       triangles          gltf_corner.c    their coordinates and normals
 *     gltf_material.c   materials          gltf_texture.c   their pictures
 *     gltf_node.c       places             gltf_light.c     lights
 *     gltf.c            all of it in order, gltf_read()
 *
 * The library sees JSON alone: buffers, images, animations, skins and the indices of
 * primitives are hidden from it, so that it opens no file, decodes nothing and refuses nothing
 * that is no fault. Types and ranges of single values have been checked when a
 * `source` is made; indices and sizes have not: who uses one, checks it.
 */
#ifndef SIM_GLTF_SOURCE_H
#define SIM_GLTF_SOURCE_H

#include "sim/gltf.h"

#ifdef __cplusplus
extern "C" {
#endif

/* An index that may be missing: -1. */
typedef int32_t source_index;

typedef struct source_buffer {
    const char *uri; /* as in the JSON, between its quotes; NULL: the binary chunk of a .glb */
    size_t uri_length;
    size_t declared;      /* byteLength */
    const uint8_t *bytes; /* `declared` of them; NULL: it has none, which is for its users to say */
} source_buffer;

/* Where a file of another kind, an image or a photometric one, stands. */
typedef struct source_content {
    const char *uri; /* as above; NULL: in a buffer view */
    size_t uri_length;
    source_index view;
} source_content;

typedef struct gltf_file {
    const char *path; /* for messages */
    arena *scratch;   /* what lives until the file has been read */
    char *json;       /* ends with a NUL */
    size_t json_size;
    const uint8_t *chunk; /* the binary chunk of a .glb; NULL: none */
    size_t chunk_size;
    source_buffer *buffers;            /* by gltf_file_check() */
    source_content *images, *profiles; /* profiles: of EXT_lights_ies */
    source_index *indices;             /* of each primitive, mesh after mesh */
    uint32_t buffer_count, image_count, profile_count, primitive_count;
    uint32_t buffer_room, image_room, profile_room, primitive_room; /* in those lists */
    uint32_t animation_count, skin_count;
} gltf_file;

typedef struct source_view {
    source_index buffer;
    size_t offset, length, stride; /* bytes; stride 0: none given */
} source_view;

typedef struct source_accessor {
    source_index view;
    size_t offset, count;
    int component; /* glTF's number: 5120, ... */
    int width;     /* components of an element, 1 .. 16 */
    bool normalized, sparse;
    size_t sparse_count, index_offset, value_offset;
    source_index index_view, value_view;
    int index_component;
} source_accessor;

typedef struct source_primitive {
    int mode;
    source_index position, normal, texcoord[2], indices, material;
    bool colored, morphed; /* has COLOR_0, has targets */
} source_primitive;

typedef struct source_mesh {
    const char *name;
    const source_primitive *primitives;
    uint32_t primitive_count;
} source_mesh;

/* Each extension that hangs lights on nodes has a list of its own. */
enum { LIST_PUNCTUAL, LIST_IES, LIST_AREA, LIGHT_LISTS };

typedef struct source_node {
    const char *name;
    source_index mesh, camera, skin;
    source_index light[LIGHT_LISTS];
    double multiplier, tint[3]; /* of the light in LIST_IES */
    const int *children;
    uint32_t child_count;
    bool has_matrix, instanced;
    double matrix[16];                 /* columns */
    double move[3], turn[4], scale[3]; /* turn: quaternion x y z w */
    source_index instance_move, instance_turn, instance_scale;
} source_node;

typedef struct source_sampler {
    int magnify, wrap_u, wrap_v; /* glTF's numbers; magnify -1: not said */
} source_sampler;

typedef struct source_texture {
    source_index image, webp, sampler; /* webp: the image of EXT_texture_webp */
} source_texture;

/* Where materials may have a texture. */
typedef enum source_slot_kind {
    SLOT_BASE,
    SLOT_SURFACE,
    SLOT_EMISSION,
    SLOT_TRANSMISSION,
    SLOT_SPECULAR,
    SLOT_SPECULAR_COLOR,
    SLOT_NORMAL,
    SLOT_KINDS
} source_slot_kind;

/* A texture in use, with its KHR_texture_transform: what texCoord says there is in set. */
typedef struct source_slot {
    source_index texture, set;
    double offset[2], rotation, scale[2]; /* rotation: rad */
} source_slot;

typedef struct source_material {
    const char *name, *alpha_mode;
    double base_color[4], emission[3], specular_color[3], attenuation_color[3];
    double metallic, roughness, strength, transmission, ior, specular, cutoff, normal_scale;
    double thickness, attenuation_distance; /* m; infinite if it is not said */
    source_slot slots[SLOT_KINDS];
    bool unlit, occluded, varies; /* has an occlusionTexture, a thicknessTexture */
} source_material;

typedef struct source_camera {
    const char *name;
    bool perspective;
    double yfov, aspect, xmag, ymag;
} source_camera;

typedef struct source_light {
    const char *name, *type;
    double color[3], intensity, inner, outer;
    bool ranged;
} source_light;

/* EXT_lights_area, its older draft too; sizes in m, 0 where they are not said. */
typedef struct source_area {
    const char *name, *type, *shape; /* type, shape: "" where they are not said */
    double color[3], intensity, size, aspect, width, height, radius;
} source_area;

typedef struct source_scene {
    const int *nodes;
    uint32_t node_count;
} source_scene;

typedef struct source {
    const source_view *views;
    const source_accessor *accessors;
    const source_mesh *meshes;
    const source_node *nodes;
    const source_material *materials;
    const source_camera *cameras;
    const source_light *lights; /* KHR_lights_punctual */
    const source_area *areas;
    const source_scene *scenes;
    const source_texture *textures;
    const source_sampler *samplers;
    const char **used, **required; /* extensions */
    const char **profile_names;    /* of gltf_file.profiles */
    uint32_t view_count, accessor_count, mesh_count, node_count, material_count, camera_count,
        light_count, area_count, scene_count, texture_count, sampler_count, used_count,
        required_count, profile_name_count;
    source_index scene;
    const char *version, *least_version; /* of glTF: asset.version, asset.minVersion */
    void *model; /* the library's; texts and lists above may point into it */
} source;

/* Reads the file and finds its JSON and its binary chunk. */
bool gltf_file_open(gltf_file *f, const char *path, lux_error *err);

/* Holds the JSON against the schema and takes from it what the library shall not see: it is
 * hidden from the text. The bytes of buffers are still missing. */
bool gltf_file_check(gltf_file *f, lux_error *err);

/* Gets the bytes of all buffers. */
bool gltf_file_buffers(gltf_file *f, lux_error *err);

/* What a URI leads to: the bytes of a data: URI, or the file's path, *bytes being NULL then.
 * `pointer` says where it stands. Files outside the scene's folder are refused. */
bool gltf_file_locate(const gltf_file *f, const char *pointer, const char *uri, size_t length,
                      const uint8_t **bytes, size_t *size, const char **path, lux_error *err);

/* Makes structures of the JSON; whatever comes, source_close() ends them. */
bool source_open(source *s, const gltf_file *f, lux_error *err);
void source_close(source *s);

/* What is left out or read as something simpler: counted, and told once a file, so that a file of
 * a million points gives one line. gltf.c has the sentences. */
typedef enum tally_kind {
    TALLY_LINES,
    TALLY_NO_POSITION,
    TALLY_EMPTY,
    TALLY_FLAT,
    TALLY_SINGULAR,
    TALLY_RANGE,
    TALLY_NO_PICTURE,
    TALLY_WEBP,
    TALLY_OCCLUSION,
    TALLY_THICKNESS,
    TALLY_NO_TEXCOORD,
    TALLY_NORMAL,
    TALLY_COLOR,
    TALLY_MORPH,
    TALLY_SKIN,
    TALLY_TINT,
    TALLY_IOR,
    TALLY_KINDS
} tally_kind;

typedef struct tally {
    uint64_t count;
    char first[100]; /* JSON pointer of the first one */
} tally;

/* The reader at work. */
typedef struct reader {
    const gltf_file *file;
    const source *source;
    arena *a; /* of the caller: results */
    notices *notices;
    gltf *out;
    gltf_light *lights[LIGHT_LISTS]; /* of each list, as any node will have them */
    uint32_t light_count[LIGHT_LISTS];
    size_t embedded;               /* bytes of photometric files so far */
    uint64_t triangles, positions; /* so far; positions: and what else vertices have */
    uint64_t zeros;                /* of those, the ones without bytes in the file */
    uint64_t texels;               /* of all textures so far */
    tally tallies[TALLY_KINDS];
} reader;

void tally_add(reader *r, tally_kind kind, const char *pointer, ...)
    __attribute__((format(printf, 3, 4)));

/* Whether the index is there and below count; `pointer` and `what` are for the message. */
bool index_valid(const reader *r, source_index i, uint32_t count, const char *what, lux_error *err,
                 const char *pointer, ...) __attribute__((format(printf, 6, 7)));

/* Elements that no byte of the file stands for; more are an attack. */
enum { ZEROS_MOST = 1 << 24 };

/* All buffer views and accessors lie within their buffers: after this the two below cannot
 * reach outside. */
bool accessors_check(const reader *r, lux_error *err);

/* The bytes of an image or the like; or the path of its file, *bytes being NULL then. `pointer`
 * says where its uri or bufferView stands. */
bool content_locate(const reader *r, const source_content *c, const char *pointer,
                    const uint8_t **bytes, size_t *size, const char **path, lux_error *err);

/* The elements of an accessor, in `into`, each `width` finite numbers, normalised where that is
 * asked for. The accessor has this width, or it is an error. */
const double *accessor_numbers(const reader *r, arena *into, source_index accessor, int width,
                               const char *pointer, lux_error *err);

/* The same for positions: floats, straight into out (3 an element); all are finite. */
bool accessor_positions(const reader *r, source_index accessor, vec3 *out, const char *pointer,
                        lux_error *err);

/* What `count` vertices have besides: `width` numbers each, floats or quantised, of any value. */
const float *accessor_attribute(const reader *r, arena *into, source_index accessor, int width,
                                size_t count, const char *pointer, lux_error *err);

/* Integers, each below `limit`, in `into`. */
const uint32_t *accessor_indices(const reader *r, arena *into, source_index accessor,
                                 uint32_t limit, const char *pointer, lux_error *err);

/* Each makes its part of r->out. */
bool read_meshes(reader *r, lux_error *err);
bool read_lights(reader *r, lux_error *err);    /* r->lights; after accessors_check() */
bool read_nodes(reader *r, lux_error *err);     /* after meshes and lights; cameras too */
bool read_materials(reader *r, lux_error *err); /* after nodes: unseen ones get no textures */

/* ---- textures (gltf_texture.c) --------------------------------------------------------------- */

struct texture_slot; /* materials/look.h */

/* Whether some texture of the material (-1: none) goes by TEXCOORD_<set>. */
bool slots_use_set(const reader *r, source_index material, int set);

/* The textures that have been made so far. */
typedef struct texture_shelf {
    reader *r;
    struct shelved **of_image; /* of each image of the file */
    bool *no_webp;             /* of each texture: its picture in WebP cannot be read */
} texture_shelf;

/* That all that the file says of textures leads somewhere. */
bool textures_check(const reader *r, lux_error *err);

bool shelf_open(texture_shelf *s, reader *r, lux_error *err);

/* Fills in *to: {0} where there is no texture, or none that matters. */
bool slot_read(texture_shelf *s, uint32_t material, source_slot_kind kind, struct texture_slot *to,
               lux_error *err);

/* ---- what corners of triangles have besides a place (gltf_corner.c) -------------------------- */

/* Of one mesh after the other. */
typedef struct corner_data {
    reader *r;
    const float **values; /* of an accessor: what was read */
    uint32_t *read_in;    /* of an accessor: 1 + the mesh that it was last read for */
    uint32_t mesh;
    size_t triangles; /* that the mesh may have */
    arena own;        /* of values */
    float *texcoord[2];
    vec3 *normals; /* both as in core/mesh.h: NULL until there are some */
} corner_data;

/* Of a primitive; NULL: it has none that is wanted. */
typedef struct vertex_data {
    const float *texcoord[2], *normals;
} vertex_data;

bool corner_open(corner_data *c, reader *r, lux_error *err);
void corner_begin(corner_data *c, uint32_t number, size_t triangles);
bool corner_primitive(corner_data *c, uint32_t number, vertex_data *out, lux_error *err);

/* Of the triangle with that number in the mesh, whose corners are those vertices of its primitive
 * and stand at `at`. */
bool corner_add(corner_data *c, const vertex_data *d, size_t triangle, const uint32_t vertex[3],
                const vec3 at[3], lux_error *err);
void corner_end(corner_data *c);

/* The lights of node i of the file: their number; whether they are there; they themselves, at
 * `place`, put into r->out for its node `number`. */
uint32_t node_light_count(const source_node *n);
bool node_lights_valid(const reader *r, uint32_t i, lux_error *err);
bool node_lights_add(reader *r, uint32_t i, uint32_t number, const transform *place,
                     lux_error *err);

/* A copy in the result's arena. */
const char *read_name(const reader *r, const char *name, lux_error *err);

#ifdef __cplusplus
}
#endif

#endif
