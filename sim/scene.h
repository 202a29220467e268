/* sim/scene.h -- what is simulated: the study and all it names, read, checked and ready to trace.
 *
 * Places are re-centred: a float place q of the scene lies at q + centre in the user's frame, so
 * that a model in a country's grid is as exact as one at the origin.
 */
#ifndef SIM_SCENE_H
#define SIM_SCENE_H

#include "core/world.h"
#include "lights/light.h"
#include "lights/photometry.h"
#include "materials/material.h"
#include "sim/gltf.h"
#include "sim/study.h"

typedef struct scene_material {
    const char *name; /* "room: walls" for those of the room */
    vec3 reflectance; /* of diffuse light */
    vec3 emission;    /* cd/m^2 */
    bool overridden;  /* by the study's materials */
    bool used;        /* some surface is made of it */
} scene_material;

typedef struct scene_light {
    const char *name; /* for reports: "downlight (4.ies)" */
    dvec3 at;         /* m, in the user's frame; of a far one: where it shines to */
    double lumens;    /* initial, dimming included; INFINITY: far away */
    vec3 color;       /* luminance 1 */
} scene_light;

typedef struct scene_camera {
    const char *name;
    transform place; /* to the user's frame; looks along -z, +y up */
    bool perspective;
    double yfov, aspect, ymag, xmag;
} scene_camera;

typedef struct scene {
    const study *study;
    dvec3 centre; /* m */
    world *world;
    dvec3 low, high; /* m, box around all surfaces in the user's frame; empty: low > high */

    int material_count; /* as vsurface.material counts them */
    const material *const *materials;
    const scene_material *material_info;

    int light_count;
    const light *const *lights;
    const scene_light *light_info;
    bool lights_differ; /* in colour: then luminance does not tell all of a mixture */

    int camera_count;
    const scene_camera *cameras;

    bool reflects;     /* some surface does */
    bool glows;        /* some surface emits light */
    double glow_share; /* those that do, of the area of all */
    int small_patches; /* lamps that light a patch too small for samples to find reliably */
} scene;

/* The light that samples may miss without an interval telling, in words; NULL if there is none. */
const char *scene_left_to_chance(const scene *s, bool direct_only);

/* Builds the scene of a study into a, on that many threads. NULL, with *err naming file and
 * place. What is left out or looks like a mistake (a luminaire outside the room) is noticed. */
const scene *scene_new(arena *a, const study *s, int threads, notices *n, lux_error *err);

/* A place of the user's frame in the scene's. */
static inline vec3 scene_place(const scene *s, dvec3 p)
{
    return d3_to_float(d3_sub(p, s->centre));
}

#endif
