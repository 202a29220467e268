/* materials/brdf.h -- measured reflection: tables of f(wo, wi), and the files that hold them.
 *
 * Angles of a direction: theta from the normal, phi about it, counter-clockwise as seen from above,
 * from the table's azimuth 0. Between its places a table is multilinear in the angles, beyond them
 * it is what it is at the last one, azimuths go round. Below the horizon it is 0.
 */
#ifndef MATERIALS_BRDF_H
#define MATERIALS_BRDF_H

#include "core/notice.h"
#include "materials/material.h"

typedef enum brdf_kind {
    BRDF_ISOTROPIC,   /* theta_in, theta_out, delta_phi = phi_out - phi_in */
    BRDF_ANISOTROPIC, /* theta_in, phi_in, theta_out, phi_out */
    BRDF_HALF,        /* theta_h, theta_d, phi_d (Rusinkiewicz 1998), isotropic and reciprocal */
} brdf_kind;

typedef struct brdf brdf;

/* Reads a table, .brdf (materials/brdf_file.c describes the format) or MERL .binary: the contents
 * decide. NULL, with *err naming file and line or offset. Tables that give back more than they get
 * are scaled down, and the user is told. */
const brdf *brdf_read(arena *a, const char *path, notices *n, lux_error *err);

/* A table as numbers. Along each axis of its kind, in the order that brdf_kind names them, places
 * ascend in degrees: thetas in [0, 90]; phi_in and phi_out less than 360 apart, or 360, where the
 * last place is the first once more; delta_phi in [0, 180] for a surface without handedness, or
 * around like these; phi_d in [0, 180], where 180 is 0 once more. */
typedef struct brdf_data {
    const char *name; /* for messages */
    brdf_kind kind;
    int counts[4]; /* >= 1; three or four of them */
    const double *deg[4];
    const float *rgb; /* 1/sr, 3 a place, the last axis fastest; below 0: not measured */
    int bands;        /* of the file that it comes from: for the figures alone */
} brdf_data;

/* Makes a table, in a; *d is no longer needed then. It takes 24 bytes a place. */
const brdf *brdf_make(arena *a, const brdf_data *d, notices *n, lux_error *err);

/* The same table, looked up in another way; b must outlive it. */
struct table_measures;
const brdf *brdf_measured(arena *a, const brdf *b, const struct table_measures *by, lux_error *err);

/* What a report says of a table. */
typedef struct brdf_figures {
    brdf_kind kind;
    int axes, counts[4], bands; /* as the file has them */
    size_t bytes;               /* of memory */
    float albedo_most;          /* largest of a channel, as measured */
    float theta_deg, phi_deg;   /* of the direction that has it */
    float scale_least;          /* what values were scaled by at the most; 1: none was */
    float reciprocity_worst;    /* |f(a, b) - f(b, a)| / the larger, of what is not very small */
    float reciprocity_mean;
    float missing; /* share of places that were not measured */
} brdf_figures;
const brdf_figures *brdf_figures_of(const brdf *b);

/* f, 1/sr, of unit directions in the frame of the surface: z its normal, x azimuth 0. */
vrgb vbrdf_value(const brdf *b, const vvec3 *wo, const vvec3 *wi, vmask active);

/* The surface that a table describes, the same on both sides. `up` is where the table's azimuth 0
 * points to, as far as the surface allows (it is laid into the surface; where it is square to it, x
 * and then y take its place); of isotropic tables it has no meaning. Textures of the base colour
 * are multiplied with the table. */
typedef struct brdf_desc {
    const brdf *table; /* must outlive the material */
    vec3 up;           /* not 0 */
    material_extra extra;
} brdf_desc;
const material *material_brdf(arena *a, const brdf_desc *d, lux_error *err);

#endif
