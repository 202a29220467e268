/* sim/shading.h -- what a ray has met, ready to be asked what it does with light. */
#ifndef SIM_SHADING_H
#define SIM_SHADING_H

#include "sim/scene.h"

/* The hits of rays along `direction`, each of which stands for a beam that is `width` m wide there.
 * at: the surface, its normal on the side that the ray came from; shading likewise. Of lanes
 * outside `met` nothing is said. */
void scene_shade(const scene *s, const vhit *hit, const vvec3 *direction, vfloat width, vmask met,
                 vsurface *at, vshading *shading);

#endif
