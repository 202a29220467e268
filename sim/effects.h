/* sim/effects.h -- which effects of light a run simulates, by the names that users know. */
#ifndef SIM_EFFECTS_H
#define SIM_EFFECTS_H

#include "sim/scene.h"

typedef enum effect {
    EFFECT_SHADOWS,
    EFFECT_AREA_LIGHTS,
    EFFECT_NEAR_FIELD,
    EFFECT_MANY_LIGHTS,
    EFFECT_SUN,      /* a disk as much as a point: no area light */
    EFFECT_SKY,      /* of whatever kind, and the ground below it */
    EFFECT_PORTALS,  /* it is looked for through them */
    EFFECT_PANORAMA, /* it is a picture's */
    EFFECT_INTERREFLECTION,
    EFFECT_MIRRORS,    /* light that comes back to one direction each, off glass too */
    EFFECT_REFRACTION, /* through solids */
    EFFECT_TEXTURES,
    EFFECT_NORMAL_MAPS,
    EFFECT_MEASURED_BRDF,  /* tables, of glazing too */
    EFFECT_TINTED_SHADOWS, /* light that goes straight through surfaces */
    EFFECT_COLOR,
    EFFECT_MOTION,       /* of instances from moment to moment */
    EFFECT_ANTIALIASING, /* of views: more than a ray a pixel */
    EFFECTS
} effect;

typedef struct effects {
    bool on[EFFECTS];
} effects;

/* Of a run on grids; `outside`: some sensor is where lamps that are `clear` may be hidden. */
effects effects_of_grids(const scene *s, bool direct_only, bool outside);

/* Of a run on views: what surfaces look like counts, too. */
effects effects_of_views(const scene *s, bool direct_only);

const char *effect_name(effect e); /* "area-lights" */

/* The effect of that name, of so many characters; EFFECTS: there is none. */
effect effect_find(const char *name, size_t length);

#endif
