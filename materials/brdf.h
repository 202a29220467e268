/* materials/brdf.h -- measured reflection: tables of f(wo, wi), and the files that hold them. */
#ifndef MATERIALS_BRDF_H
#define MATERIALS_BRDF_H

#include "core/notice.h"
#include "materials/material.h"

typedef struct brdf brdf;

/* Reads a table, .brdf (materials/brdf_file.c describes the format) or MERL .binary: the contents
 * decide. NULL, with *err naming file and line or offset. Tables that give back more than they get
 * are scaled down, and the user is told. */
const brdf *brdf_read(arena *a, const char *path, notices *n, lux_error *err);

/* The surface that a table describes, the same on both sides. `up` is where the table's azimuth 0
 * points to, as far as the surface allows (it is laid into the surface; where it is square to it, x
 * and then y take its place); of isotropic tables it has no meaning. */
typedef struct brdf_desc {
    const brdf *table; /* must outlive the material */
    vec3 up;           /* not 0 */
    material_extra extra;
} brdf_desc;
const material *material_brdf(arena *a, const brdf_desc *d, lux_error *err);

#endif
