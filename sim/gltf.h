/* sim/gltf.h -- a glTF 2.0 file as lux4 needs it: checked, flattened, in our frame.
 *
 * Every number, index and size has been checked when this is handed out. World matrices take
 * mesh coordinates to metres with x east, y north, z up (glTF's y is up: (x, y, z) -> (x, -z, y)).
 */
#ifndef SIM_GLTF_H
#define SIM_GLTF_H

#include "core/arena.h"
#include "core/error.h"
#include "core/mesh.h"
#include "core/notice.h"
#include "core/transform.h"

#ifdef __cplusplus
extern "C" {
#endif

struct material_textures; /* materials/look.h, which is no C++ */

/* Constants are what textures are multiplied with. */
typedef struct gltf_material {
    const char *name;           /* "" if it has none */
    vec3 base_color;            /* linear, [0, 1] */
    float alpha;                /* [0, 1]; of alphaMode OPAQUE 1 */
    float metallic, roughness;  /* [0, 1] */
    vec3 emission;              /* cd/m^2 in each channel (emissiveFactor times strength) */
    float transmission;         /* KHR_materials_transmission, [0, 1]; 0 */
    float ior;                  /* KHR_materials_ior, 0 or [1, 4]; 1.5 */
    float specular;             /* KHR_materials_specular, [0, 1]; 1 */
    vec3 specular_color;        /* >= 0; 1 */
    bool volume;                /* KHR_materials_volume with a thickness above 0: a solid */
    float thickness;            /* m, of the surface as a shell; 0 */
    float attenuation_distance; /* m, 1e-9 at least; INFINITY */
    vec3 attenuation_color;     /* (0, 1]; 1 */
    bool unlit;                 /* KHR_materials_unlit */
    const struct material_textures *textures; /* NULL: none that changes anything and alphaMode is
                                                 not MASK, or the scene shows no such triangle */
} gltf_material;

/* Texture coordinates of a set are there if some texture of the mesh's materials goes by them and
 * some primitive has them; where one has not, they are 0. Normals are there if they say more than
 * the triangles: of a triangle whose corners are within 0.1 degree of its own all three are 0, and
 * so they are where one is not finite, has no length or points to the back. */
typedef struct gltf_mesh {
    const char *name;
    mesh triangles; /* of all its primitives; material: an index of gltf.materials */
} gltf_mesh;

/* A mesh in its place: a node, or one of a node's EXT_mesh_gpu_instancing. */
typedef struct gltf_placement {
    uint32_t mesh, node;
    transform place;
} gltf_placement;

typedef struct gltf_node {
    const char *name; /* as in the file; "" if it has none */
    transform place;
    int32_t parent; /* an index of gltf.nodes; -1: a root of the scene */
} gltf_node;

typedef struct gltf_camera {
    const char *name; /* the camera's, or else its node's */
    transform place;  /* looks along -z, +y up */
    bool perspective;
    double yfov, aspect; /* rad, vertical; width / height or 0 if not said */
    double xmag, ymag;   /* m, half width and height if orthographic */
} gltf_camera;

typedef enum gltf_light_kind {
    GLTF_POINT,
    GLTF_SPOT,
    GLTF_DIRECTIONAL, /* so far KHR_lights_punctual */
    GLTF_IES,         /* EXT_lights_ies */
    GLTF_AREA_RECT,
    GLTF_AREA_DISK, /* EXT_lights_area */
} gltf_light_kind;

/* A light at a node, which may have one of each extension. What a kind has not is 0.
 *
 * A web (GLTF_IES) hangs at its place as the extension says: (0, 0) is -z, x/y is the horizontal
 * photometric plane and x/z the vertical one. So gamma = 0 lies along place (0, 0, -1), C0 along
 * place (1, 0, 0) and, C planes being counter-clockwise for who looks along gamma = 0 from behind
 * the luminaire, C90 along place (0, 1, 0). Only directions count: scale changes nothing, and a
 * place that mirrors turns no web inside out (gamma and C0 are where they are said to be, C90
 * follows from them).
 *
 * Its file stands beside the scene (path) or within it (bytes, followed by a NUL that the size does
 * not count): one of them is not NULL. Lights of one profile have equal pointers. The file beside
 * the scene has not been opened: it lies in the scene's folder, or is missing.
 *
 * An area has its centre at the origin of its place, lies in x/y with the height along y, and
 * shines from one side, to -z, the same in all directions (Lambert). The node's scale is in its
 * size, not to be applied again. */
typedef struct gltf_light {
    const char *name; /* the light's, or else its node's */
    gltf_light_kind kind;
    uint32_t node;       /* an index of gltf.nodes */
    transform place;     /* of the node: shines along -z */
    vec3 color;          /* linear, >= 0; [0, 1] if it tints a web */
    double intensity;    /* cd; lux if directional; cd/m^2 of an area, where color is 1 */
    double inner, outer; /* rad, of a spot */

    const char *photometry_path;  /* to open, or NULL */
    const char *photometry_bytes; /* or NULL */
    size_t photometry_size;
    const char *photometry_name; /* for messages: scene's path and JSON pointer */
    double multiplier;           /* of the web's candelas, >= 0 */

    double width, height; /* m, > 0, of a rectangle: along x, along y */
    double radius;        /* m, > 0, of a disk */
} gltf_light;

typedef struct gltf {
    uint32_t material_count, mesh_count, placement_count, node_count, camera_count, light_count;
    gltf_material *materials; /* the last one is glTF's default material */
    gltf_mesh *meshes;
    gltf_placement *placements;
    gltf_node *nodes; /* those of the scene */
    gltf_camera *cameras;
    gltf_light *lights;
    uint32_t texture_count;  /* different ones that materials have */
    uint64_t flat_triangles; /* left out, without area */
} gltf;

/* Reads the .gltf or .glb at path (its first bytes decide), and the files in its folder that it
 * names, into a; pictures only of materials that the scene shows. NULL, with *err naming the file
 * and the JSON pointer, or the offset, of what is wrong. What is left out or read as something
 * simpler is noticed, once a kind.
 *
 * Meshes and materials have the file's numbers; a mesh that the scene does not show, or that has
 * no triangles, has no placement. Places are finite, with a determinant that is finite and, but
 * for nodes and point lights, not 0. Triangles of a place that mirrors run the other way round.
 * Positions are finite, each placed one may still be too large for a float. */
const gltf *gltf_read(arena *a, const char *path, notices *n, lux_error *err);

#ifdef __cplusplus
}
#endif

#endif
