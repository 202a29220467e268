/* materials/material_figures.h -- what a material does with light, as a report tells it: asked
 * through material.h alone, so of any kind. Holes are left out, textures are taken as white.
 *
 * Directions are in the frame of the surface: z its normal, on the front side.
 */
#ifndef MATERIALS_MATERIAL_FIGURES_H
#define MATERIALS_MATERIAL_FIGURES_H

#include "materials/material.h"

/* Of light that arrives in a narrow beam, each channel in [0, 1]. */
typedef struct material_share {
    vec3 reflected;
    vec3 through; /* to the other side, straight and scattered: within 1e-3 */
} material_share;

/* The beam comes from wo: unit, z not 0; below 0 it comes from the back. */
material_share material_share_of(const material *m, vec3 wo);

/* f(wo, wi) |cos(wi, n)| as luminance, 1/sr, of the part that has a density: how much of a beam
 * from wo leaves into a unit of solid angle about wi. Both unit, neither z 0. */
double material_lobe(const material *m, vec3 wo, vec3 wi);

/* Of |f(a, b) - f(b, a)| as luminance, over pairs of directions on the same side and, where the
 * material lets light through, on different ones. Where f is less than a thousandth of the largest
 * that is met, it does not count for `worst`. */
typedef struct material_reciprocity {
    double mean;  /* their mean over the mean f */
    double worst; /* the largest over the larger f of its pair, [0, 1] */
} material_reciprocity;
material_reciprocity material_reciprocity_of(const material *m);

#endif
