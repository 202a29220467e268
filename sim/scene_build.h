/* sim/scene_build.h -- what the parts of the scene's construction share; only they include it. */
#ifndef SIM_SCENE_BUILD_H
#define SIM_SCENE_BUILD_H

#include "sim/scene.h"

/* A list that grows in an arena: what it outgrows stays there until the arena goes. */
typedef struct list {
    void *items;
    size_t count, room;
} list;

/* A new zeroed item at the end of l; NULL if memory is out. */
void *list_add(list *l, arena *a, size_t size, size_t align, lux_error *err);
#define list_new(l, a, type, err) ((type *)list_add(l, a, sizeof(type), alignof(type), err))

typedef struct scene_build {
    arena *a;
    const study *study;
    notices *notices;
    lux_error *err;
    const gltf **files;             /* of study->scenes */
    const uint32_t *first_material; /* of each file, as the scene counts */
    uint32_t *const *times; /* of each file: how often each of its meshes stands in the scene */
    list materials, material_info, lights, light_info, cameras;
    bool lights_differ;        /* in colour */
    dvec3 centre, low, high;   /* m, of the surfaces, in the user's frame */
    double area, glowing_area; /* m^2 */
} scene_build;

/* The places of a study's scene entry: its k-th copy. */
transform scene_copy_place(const study_scene *s, int k);

/* The first scene entry that uses the same file as entry i. */
int scene_first_use(const scene_build *b, int i);

/* Each fills in its part of the build; false with the error where it fails. */
bool build_materials(scene_build *b); /* scene_materials.c */
bool build_bounds(scene_build *b);    /* scene_bounds.c: times, box, centre, areas */
world *build_world(scene_build *b, int threads);
bool build_lights(scene_build *b); /* scene_lights.c */

/* How many lamps light patches too small for samples to find, of which the user is told
 * (scene_chance.c). */
int scene_small_patches(const scene *s, notices *n);

#endif
