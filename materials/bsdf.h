/* materials/bsdf.h -- measured glazing, blinds and fabrics: LBNL's BSDF XML.
 *
 * Klems full, half and quarter bases, bases that a file defines itself, and tensor trees of ranks
 * 3 and 4: what is reflected and let through from each direction, on both sides.
 *
 * A file's front faces the outside and its back the room, as in LBNL WINDOW, whose "Transmission
 * Front" is of light on its way in. Its z axis points into the room, y up and x to the right of who
 * looks at it from the room.
 */
#ifndef MATERIALS_BSDF_H
#define MATERIALS_BSDF_H

#include "core/notice.h"
#include "materials/material.h"

typedef struct bsdf bsdf;

/* NULL, with *err naming file and line. Data that give back more than they get are scaled down, and
 * the user is told; so are data for one side or direction alone, and how they are completed. Only
 * visible light is read. */
const bsdf *bsdf_read(arena *a, const char *path, notices *n, lux_error *err);

/* The same of bytes, at most 256 MiB of them, that messages call `path`. */
const bsdf *bsdf_parse(arena *a, const char *path, const char *bytes, size_t size, notices *n,
                       lux_error *err);

typedef enum bsdf_side_name { BSDF_FRONT, BSDF_BACK } bsdf_side_name; /* outside, room */

/* What `check` and `material` tell of a file, as it is used: completed and scaled. */
typedef struct bsdf_figures {
    const char *basis;            /* "LBNL/Klems Full", "tensor tree of rank 3" */
    int directions;               /* that are told apart on each side */
    double reflectance[2];        /* of diffuse light on each bsdf_side_name, [0, 1] */
    double transmittance[2];      /* likewise; of light that arrives there */
    double normal_reflectance[2]; /* of light square to it, into the whole hemisphere */
    double normal_transmittance[2];
    double most;        /* the file's largest reflectance plus transmittance of any incidence */
    double reciprocity; /* mean |f(a, b) - f(b, a)| over the mean f, through and reflected, of 64
                           directions and their opposites */
    double scale;       /* (0, 1]: what all of it was multiplied by, so that `most` is 1 */
} bsdf_figures;
const bsdf_figures *bsdf_figure(const bsdf *b);

/* A flat layer: the file's back (toward the room) lies on the triangles' front side, or on their
 * back if `front_outside`. `up` is the direction of the file's up (its y axis), laid into the
 * surface as that of brdf_desc. What goes straight through is not told apart: it is what the cells
 * around that direction hold, and reflect() has it. */
typedef struct bsdf_desc {
    const bsdf *data; /* must outlive the material */
    vec3 up;          /* not 0 */
    bool front_outside;
    material_extra extra;
} bsdf_desc;
const material *material_bsdf(arena *a, const bsdf_desc *d, lux_error *err);

#endif
