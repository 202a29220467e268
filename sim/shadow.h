/* sim/shadow.h -- what of a light arrives along a shadow ray: all, nothing, or what thin glass and
 * holes let through.
 *
 * Light that passes a plate of glass which refracts is taken to go straight on (other solids let no
 * shadow ray pass: scene_lens.c): each face lets through what
 * Fresnel's formulae leave of it, the inside what it does not absorb. Where the light would truly
 * go, a little or far beside, no shadow ray can know: results say so (scene_left_to_chance()).
 */
#ifndef SIM_SHADOW_H
#define SIM_SHADOW_H

#include "sim/scene.h"

/* What a ray has passed through, in a scene with hollow surfaces. */
typedef struct vpassed {
    vrgb share;   /* of light, by channel */
    vmask solids; /* faces of solids that refract were among it */
} vpassed;

/* For each asked ray, whether it is blocked and what it has passed; where no surface is hollow,
 * `passed` is left alone, and may be NULL. `spare` as world_any_hit() has it. Returns how many rays
 * were traced. */
int64_t shadow_trace(const scene *s, const vray *rays, const vmask *asked, const vint *spare,
                     int packets, ray_hint hint, vmask *blocked, vpassed *passed);

#endif
