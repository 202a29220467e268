/* materials/material.h -- what a surface does with light, for a packet of points at once.
 *
 * Directions are unit vectors that leave the point: wo toward where the light goes in the end
 * (the eye or sensor), wi toward where it comes from. n is the unit normal on wo's side: every
 * surface reflects on both sides. Lanes outside `active` are not looked at, and come back zero.
 * Materials are immutable once made; any number of threads may ask.
 */
#ifndef MATERIALS_MATERIAL_H
#define MATERIALS_MATERIAL_H

#include "core/arena.h"
#include "core/error.h"
#include "core/packet.h"

typedef struct material material;

/* One way on, as drawn for each point. */
typedef struct vscatter {
    vvec3 wi;
    vrgb weight; /* f(wo, wi) cos(wi, n) / pdf */
} vscatter;

typedef struct material_type {
    const char *name;

    /* (s, t) in [0,1)^2 picks wi; the lanes that go on are returned. */
    vmask (*scatter)(const material *self, const vvec3 *wo, const vvec3 *n, vfloat s, vfloat t,
                     vmask active, vscatter *out);

    /* f(wo, wi) cos(wi, n), 1/sr. */
    vrgb (*reflect)(const material *self, const vvec3 *wo, const vvec3 *wi, const vvec3 *n,
                    vmask active);

    /* The density with which scatter() draws wi, 1/sr. */
    vfloat (*pdf)(const material *self, const vvec3 *wo, const vvec3 *wi, const vvec3 *n,
                  vmask active);

    vec3 (*albedo)(const material *self); /* of diffuse light, [0, 1] */
} material_type;

/* The first member of every material. */
struct material {
    const material_type *type;
    vec3 emission; /* W/(sr m^2), from both sides */
};

typedef struct diffuse_desc {
    vec3 reflectance; /* [0, 1] */
    vec3 emission;    /* W/(sr m^2), >= 0 */
} diffuse_desc;

/* Makers: as those of lights (lights/light.h). */
const material *material_diffuse(arena *a, const diffuse_desc *d, lux_error *err);

/* Packets whose lanes are of different materials: all[index], one material at a time. */
vmask materials_scatter(const material *const *all, vint index, const vvec3 *wo, const vvec3 *n,
                        vfloat s, vfloat t, vmask active, vscatter *out);
vrgb materials_reflect(const material *const *all, vint index, const vvec3 *wo, const vvec3 *wi,
                       const vvec3 *n, vmask active);
vfloat materials_pdf(const material *const *all, vint index, const vvec3 *wo, const vvec3 *wi,
                     const vvec3 *n, vmask active);
vrgb materials_emission(const material *const *all, vint index, vmask active);
vrgb materials_albedo(const material *const *all, vint index, vmask active);

#endif
