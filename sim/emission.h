/* sim/emission.h -- particles of light: where all light of a scene sets out.
 *
 * One of all sources is drawn for each particle, in proportion to its flux (of what is far away:
 * its flux onto the scene, or by portals into it), then place and direction as the source shines.
 * Daylight sets out before the sphere around the scene, whatever it is aimed at: along lines
 * through portals, mixed by one density with lines over all of the sphere (emission_parts.h), but
 * for a closed box room, whose windows all light comes in by. The weights are unbiased: the fluxes
 * of N particles, each divided by N, add up to all light, and so they do for each source. Numbers
 * without a particle count in N.
 *
 * Light is as scene.lights and scene.skies hold it: neither scene_light.dimming nor
 * scene.glow_dimming nor scene_maintenance() is applied, which is for who adds particles up, as it
 * is in paths. In a scene that is not layered they say how many particles a source gets, and one
 * that is dimmed to nothing gets none; in a layered one each group has an equal share of them.
 */
#ifndef SIM_EMISSION_H
#define SIM_EMISSION_H

#include "core/sampler.h"
#include "sim/scene.h"

typedef struct emission emission;

/* NULL, with *err, if memory is out. A scene without light has an emission that draws nothing. */
const emission *emission_new(arena *a, const scene *s, lux_error *err);

/* W, of all sources: as luminance; of skies to the accuracy of a table. */
double emission_flux(const emission *e);

/* W, as luminance: light that is left out, of glowing surfaces with textures (scene.glow_watts). */
double emission_missing(const emission *e);

typedef struct vparticle {
    vray ray;    /* where it begins (a little off the lamp) and goes; ends at infinity */
    vrgb flux;   /* W, the density divided out */
    vfloat even; /* (0, 1]: times that, as much as those have that portals let in */
    vint source; /* of scene.lights, lamps, suns, emitters; -1 - i: of scene.skies[i] */
    vint group;  /* of scene.groups */
    vint spare;  /* instances with this owner do not see it (world_any_hit); 0: all do */
} vparticle;

/* Particle number index of the scrambled set that `seed` names (core/sampler.h); the lanes that
 * have one. */
vmask emission_draw(const emission *e, vuint index, vuint seed, vmask active, vparticle *out);

#endif
