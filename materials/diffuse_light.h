/* materials/diffuse_light.h -- what becomes of light that comes from everywhere alike, on the front
 * side: the means of a material's albedo() and through() over the half space, for its maker.
 *
 *     rho = 2 integral of a(c) c dc over c = cos theta in [0, 1]
 *
 * The same at all azimuths, and where textures are, of their mean colour.
 */
#ifndef MATERIALS_DIFFUSE_LIGHT_H
#define MATERIALS_DIFFUSE_LIGHT_H

#include "materials/material.h"

/* m is complete but for its reflectance and transmittance. */
vec3 diffuse_light_reflected(const material *m);
vec3 diffuse_light_through(const material *m); /* 0 of a type without through() */

#endif
