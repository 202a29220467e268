/* lights/light.h -- what every light answers, for a packet of points at once.
 *
 * Lengths are in metres, angles in radians, light is radiometric: flux in W, intensity in
 * W/sr, radiance in W/(sr m^2), irradiance in W/m^2, in three channels of the same unit
 * (lumens are made of it at the user's side); directions are unit vectors that leave the
 * point being lit.
 *
 * Lights are immutable once made: every function here may run in any number of threads,
 * allocates nothing and cannot fail. Lanes outside `active` are not looked at. A function
 * returns the lanes that received light; in the other lanes its results are all zero,
 * so that sums over lanes and lights need no further masking.
 */
#ifndef LIGHTS_LIGHT_H
#define LIGHTS_LIGHT_H

#include "core/arena.h"
#include "core/error.h"
#include "core/packet.h"

typedef struct light light;
struct photometry;

/* One place of a light, as drawn for each point of a packet. */
typedef struct vlight_sample {
    vvec3 wi;    /* toward that place */
    vfloat dist; /* m, to that place, along which a shadow ray must be clear; INFINITY: far away */
    vrgb e;      /* W/m^2, on a surface facing wi, nothing in between; the pdf is divided out */
    vfloat pdf;  /* 1/sr; INFINITY for a light without extent, which no other ray can find */
} vlight_sample;

/* What a type of light is; one constant of this type per file of lights/. */
typedef struct light_type {
    const char *name; /* as study files write it */

    /* (s, t) in [0,1)^2 picks the place; even (s, t) make e an unbiased estimate. */
    vmask (*sample)(const light *self, const vvec3 *p, vfloat s, vfloat t, vmask active,
                    vlight_sample *out);

    vec3 (*flux)(const light *self); /* W, in all directions together; INFINITY if far away */

    /* The direction in which it shines strongest, and how strong, W/sr. NULL for a light that is as
     * strong in all directions, or far away. */
    vec3 (*peak)(const light *self, vec3 *toward);
} light_type;

/* The first member of every light. */
struct light {
    const light_type *type;
};

static inline vmask light_sample(const light *l, const vvec3 *p, vfloat s, vfloat t, vmask active,
                                 vlight_sample *out)
{
    return l->type->sample(l, p, s, t, active, out);
}

static inline vec3 light_flux(const light *l) { return l->type->flux(l); }

/* Makers: check *d, copy it into a, and return a light that lives as long as a does,
 * or NULL with *err filled in; a is then as it was. */
typedef struct point_desc {
    vec3 position;  /* m */
    vec3 intensity; /* W/sr, the same in all directions, >= 0 */
} point_desc;

typedef struct cone_desc {
    vec3 position;      /* m */
    vec3 aim;           /* where the axis points; any length but 0 */
    vec3 intensity;     /* W/sr, within the inner cone, >= 0 */
    float inner, outer; /* rad, half angles, 0 <= inner < outer <= pi */
} cone_desc;

typedef struct parallel_desc {
    vec3 aim;        /* where the light goes; any length but 0 */
    vec3 irradiance; /* W/m^2, on a plane square to it, >= 0 */
} parallel_desc;

typedef struct luminaire_desc {
    vec3 position; /* m, centre of the luminous opening */
    vec3 aim;      /* where gamma = 0 points; any length but 0 */
    float rotate;  /* rad, counter-clockwise about +z seen from above, before aiming */
    vec3 scale;    /* W/sr for each candela of the file: dimming, colour, 1/179; >= 0 */
    const struct photometry *web; /* must outlive the light; several lights may share it */
} luminaire_desc;

const light *light_point(arena *a, const point_desc *d, lux_error *err);
const light *light_cone(arena *a, const cone_desc *d, lux_error *err);
const light *light_parallel(arena *a, const parallel_desc *d, lux_error *err);
const light *light_luminaire(arena *a, const luminaire_desc *d, lux_error *err);

#endif
