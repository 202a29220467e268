/* materials/bsdf.h -- measured glazing, blinds and fabrics: LBNL's BSDF XML.
 *
 * Klems full, half and quarter bases, and tensor trees of ranks 3 and 4: what is reflected and let
 * through from each direction, on both sides.
 */
#ifndef MATERIALS_BSDF_H
#define MATERIALS_BSDF_H

#include "core/notice.h"
#include "materials/material.h"

typedef struct bsdf bsdf;

/* NULL, with *err naming file and line. Data that give back more than they get are scaled down, and
 * the user is told; so are data for one side or direction alone, and how they are completed. */
const bsdf *bsdf_read(arena *a, const char *path, notices *n, lux_error *err);

/* A flat layer: the file's front (toward the room, by the convention of such files) lies on the
 * triangles' front side, or on their back if `front_outside`. `up` is the direction of the
 * file's up (its y axis), laid into the surface as that of brdf_desc. */
typedef struct bsdf_desc {
    const bsdf *data; /* must outlive the material */
    vec3 up;          /* not 0 */
    bool front_outside;
    material_extra extra;
} bsdf_desc;
const material *material_bsdf(arena *a, const bsdf_desc *d, lux_error *err);

#endif
