/* sim/scene_build.h -- what the parts of the scene's construction share; only they include it. */
#ifndef SIM_SCENE_BUILD_H
#define SIM_SCENE_BUILD_H

#include "sim/effects.h"
#include "sim/scene.h"

#include <string.h>

/* A list that grows in an arena: what it outgrows stays there until the arena goes. */
typedef struct list {
    void *items;
    size_t count, room;
} list;

/* A new zeroed item at the end of l; NULL if memory is out. */
void *list_add(list *l, arena *a, size_t size, size_t align, lux_error *err);
#define list_new(l, a, type, err) ((type *)list_add(l, a, sizeof(type), alignof(type), err))

/* A luminaire at a glTF node. */
typedef struct node_lamp {
    transform place; /* of the node, in the user's frame */
    int32_t owner;   /* world_instance.owner of what hangs at the node */
} node_lamp;

typedef struct node_lamps {
    list lamps; /* of node_lamp */
} node_lamps;

/* Of a scene entry: the scene's number of each material of its file. Equal pointers: the same. */
typedef struct placed_materials {
    const uint32_t *plain;            /* none of them outside: of all entries of a file the same */
    const uint32_t *inside, *outside; /* of placements; of those that are outside by their node */
    const bool *placements;           /* which are; NULL: none */
} placed_materials;

typedef struct scene_build {
    arena *a;
    const study *study;
    const scene_options *options;
    notices *notices;
    lux_error *err;
    const gltf **files;                 /* of study->scenes */
    const uint32_t *first_material;     /* of each file, as the scene counts */
    placed_materials *placed_materials; /* of study->scenes */
    uint32_t *const *times; /* of each file: how often each of its meshes stands in the scene */
    node_lamps *at_nodes;   /* of study->luminaires */
    int32_t **owners;       /* of study->scenes: of placement k of copy c, c * placement_count + k;
                               NULL: nobody's */
    bool *
        *owned; /* of study->scenes, by their first use: meshes that are of some body; NULL: none */
    int32_t owner_count;
    list materials, material_info, lights, light_info, cameras, groups;
    list webs;                    /* const scene_web *, by name */
    int bounded_count;            /* of materials that reflected too much */
    const char *first_bounded;    /* the name of the first of them */
    const void **tables;          /* of study->materials: brdf or bsdf, once it is read; NULL */
    list emitters, emitter_of;    /* const light *; int32_t */
    int64_t *first_emitter;       /* as in the scene */
    double glow_watts;            /* as in the scene */
    const mirrors *mirror_images; /* NULL */
    bool smooth;                  /* as in the scene */
    bool lights_differ;           /* in colour */
    list skies;                   /* scene_sky */
    int sun_count;                /* of the last of `lights` */
    const moment *moments;        /* as in the scene */
    int moment_count;
    dvec3 centre, low, high; /* m, of the surfaces, in the user's frame */
} scene_build;

/* Whether the scene is to be built without an effect; a colour as it then is, if that is colour. */
static inline bool is_left_out(const scene_build *b, effect e) { return b->options->off >> e & 1; }
vec3 scene_color(const scene_build *b, vec3 color); /* scene_leave_out.c */

/* The places of a study's scene entry: its k-th copy. */
transform scene_copy_place(const study_scene *s, int k);

/* The first scene entry that uses the same file as entry i. */
int scene_first_use(const scene_build *b, int i);

/* Each fills in its part of the build; false with the error where it fails. */
bool build_materials(scene_build *b); /* scene_materials.c */
bool build_exteriors(scene_build *b); /* scene_exterior.c: placed_materials */
bool build_bounds(scene_build *b);    /* scene_bounds.c: times, box, centre */
bool build_bodies(scene_build *b);    /* scene_nodes.c: luminaires at nodes, what hangs there */
world *build_world(scene_build *b);   /* scene_world.c */
bool build_emitters(scene_build *b, const mesh *meshes, const world_instance *instances,
                    uint32_t count); /* scene_emitters.c, of what the world is made of */
bool build_areas(scene_build *b, const mesh *meshes, const world_instance *instances,
                 uint32_t count);       /* scene_areas.c, of the same: scene_material.area */
bool build_lamps(scene_build *b);       /* scene_lamps.c: all that follow */
bool build_luminaires(scene_build *b);  /* scene_luminaires.c */
bool build_lights(scene_build *b);      /* scene_lights.c */
bool build_gltf_lights(scene_build *b); /* scene_lights_gltf.c */
bool build_daylight(scene_build *b);    /* scene_sky.c, after all lamps: moments, suns, skies */

/* What light comes in by (scene_portals.c), once there is a world; needs s->skies. */
bool scene_find_portals(scene_build *b, scene *s);

/* The number of a group by its name, which is added if it is new; -1 if memory is out. */
int scene_group(scene_build *b, const char *name);

/* ---- what patterns name in scenes ------------------------------------------------------------ */

/* For each node of a file the uppermost one at or above it that matches, < 0: none (scene_nodes.c);
 * carrier and stack: of node_count. Whether any does. */
bool scene_node_carriers(const gltf *g, const char *pattern, int64_t *carrier, uint32_t *stack);

typedef struct named_patterns {
    const char *key; /* of the study, for messages */
    const char *const *list;
    int count;
} named_patterns;

typedef struct named_parts {
    bool *placements; /* of the file: those at or below a node of that name */
    bool *materials;  /* of the file */
} named_parts;

/* What patterns name in scene entry i (scene_exterior.c). False, with the error, if one of them
 * names no surface. */
bool scene_named_parts(scene_build *b, int i, const named_patterns *p, named_parts *out);

/* The scene's numbers of the file's materials in a placement of scene entry i. */
const uint32_t *scene_made_of(const scene_build *b, int i, uint32_t placement);

/* The least index that panes are made of: such a one reflects nothing. */
#define PANE_LEAST_IOR 1.0f

/* ---- between the files that make materials --------------------------------------------------- */

/* What the triangles of one material enclose, counted in bodies that hang together. */
typedef struct glass_shapes {
    uint32_t plates; /* closed and thin: panes modelled with both their sides */
    uint32_t bodies; /* closed and thick */
    uint32_t open;
} glass_shapes;

/* Of each material k of g with candidate[k], as it is first placed (scene_glass.c); NULL, with the
 * error, if memory is out. */
const glass_shapes *glass_shapes_of(scene_build *b, const gltf *g, const bool *candidate);

/* Where a material comes from; a room's as glTF would have it. */
typedef struct material_source {
    const char *file; /* for messages */
    const gltf_material *from;
    const study_material *instead; /* the study's, in place of all but glow and holes; NULL */
    const glass_shapes *glass;
    double scale; /* of the study, metres to one of the file's */
    bool used;    /* worth a word */
} material_source;

/* Fill in info.kind, file and box, and return the material; NULL with the error. */
const material *material_of_gltf(scene_build *b, const material_source *s,
                                 scene_material *info); /* scene_material_gltf.c */
const material *material_of_study(scene_build *b, const material_source *s,
                                  scene_material *info); /* scene_material_study.c */
bool gltf_material_is_pane(const gltf_material *m);

/* W/(sr m^2) and holes of a glTF material, with those of its textures. */
material_extra material_extra_of(const gltf_material *m);

/* By what a share (times the mean of its texture) is to be multiplied so that no surface gives back
 * more light than any real one does; the user is told, unless its holes make up for it. */
vec3 material_bounded(scene_build *b, const material_source *s, vec3 share, vec3 mean);

/* Takes from a material of glTF the textures and colours that are left out: means stand in. False,
 * if memory is out. And a measured table in whose place a matt surface reflects as much, and is as
 * open as the table lets light through (scene_leave_out.c). */
bool material_leave_out(scene_build *b, gltf_material *m);
const material *material_unmeasured(scene_build *b, const material *table);
double material_share_there(float openness, const material_textures *t); /* that is no hole */

/* What the textures of all materials keep, bytes, each counted once; and what the largest needs
 * besides while it is made. */
bool scene_textures(scene_build *b, uint64_t *bytes, uint64_t *largest);

/* Where the textures of a material stand: in *out, of `TEXTURE_SLOTS`. */
enum { TEXTURE_SLOTS = 7 };
static inline void texture_slots(const material_textures *t, texture_slot out[TEXTURE_SLOTS])
{
    const texture_slot all[] = { t->base,         t->surface,         t->emission,
                                 t->transmission, t->specular_weight, t->specular_color,
                                 t->normal };
    memcpy(out, all, sizeof all);
}

/* Whether light goes straight through what is made of it, or through holes. */
static inline bool material_is_hollow(const material *m)
{
    return m->type->through || m->look.openness > 0.0f ||
           (m->textures && m->textures->alpha != ALPHA_OPAQUE);
}

/* ---- between the files that make lights ------------------------------------------------------ */

/* A light to be added, and what is known of it. */
typedef struct lamp_entry {
    study_where where;
    const study_luminaire *luminaire; /* NULL */
    const char *name;
    dvec3 at;                       /* m, in the user's frame; of a far one: where it shines to */
    const study_emission *emission; /* colour, dimming, group */
    double lumens;                  /* not dimmed; HUGE_VAL: far away */
    double watts;                   /* not dimmed; NAN: not known */
    const photometry *web;          /* NULL */
    int32_t owner;                  /* whose body does not shade it; 0: all do */
    bool far;
} lamp_entry;

/* What a light of the scene is multiplied by when it is made: 1 in a layered scene. */
double lamp_made_with(const scene_build *b, const study_emission *e);

/* Adds a light that a maker gave, or passes on that it failed. */
bool lamp_add(scene_build *b, const light *l, const lamp_entry *e);

/* A place of the user's frame in the scene's. */
vec3 lamp_place(const scene_build *b, dvec3 at);

/* What a web gives of its light with the luminaire tilted as it is aimed (TILT of LM-63); 1 where
 * the study says how many lumens leave the luminaire (else NAN). */
double lamp_tilt(const photometry *web, dvec3 aim, double lumens);

/* Radiometric channels of a photometric strength in a colour of luminance 1. */
vec3 lamp_watts(const scene_build *b, vec3 color, double per_lumen_unit);

/* Of the places of one entry, those beyond the walls of the room, or far from all surfaces: a lamp
 * there lights nothing that was meant. */
typedef struct lamps_outside {
    int count;
    dvec3 first; /* m */
} lamps_outside;

void lamp_look_outside(const scene_build *b, dvec3 at, lamps_outside *o);
void lamp_tell_outside(const scene_build *b, study_where where, const char *what,
                       const lamps_outside *o);
void lamp_check_dimming(const scene_build *b, study_where where, double dimming);

/* ---- photometric files (scene_webs.c) -------------------------------------------------------- */

typedef struct scene_web {
    const char *name; /* the path, or where in a glTF file it is */
    const photometry *web;
    const luminaire_model *model;
} scene_web;

/* The file at the path `name`, or bytes that stand in another file at `name`, followed by a NUL
 * that size does not count; read when it is first asked for. */
const scene_web *scene_web_of(scene_build *b, const char *name, const char *bytes, size_t size,
                              lux_error *err);

/* The file that an entry of the study names. */
const scene_web *study_web(scene_build *b, const char *path, study_where where);

/* ---- the whole ------------------------------------------------------------------------------- */

/* How many lamps light patches too small for samples to find, of which the user is told
 * (scene_chance.c). */
int scene_small_patches(const scene *s, notices *n);

/* Marks the materials of solids that are no plates (scene_lens.c). */
bool scene_find_lenses(scene *s, int32_t *does, lux_error *err);

/* How much light goes by ways that no path finds, of which the user is told (scene_ways.c). */
bool scene_find_ways(scene *s, notices *n, lux_error *err);

#endif
