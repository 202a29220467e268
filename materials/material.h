/* materials/material.h -- what a surface does with light, for a packet of points at once.
 *
 * Directions are unit vectors that leave the point: wo toward where the light goes in the end
 * (the eye or sensor), wi toward where it comes from. Normals are unit and on wo's side: opaque
 * surfaces reflect on both sides. wi on the other side of the surface is transmission, which only
 * materials that say so have. Lanes outside `active` are not looked at, and come back zero.
 *
 * What a material does is the sum of
 *   - a part with a density, f(wo, wi), 1/sr, which reflect() gives and lights are asked for;
 *   - mirror-like parts that go to one direction each, which only scatter() finds;
 *   - a part that goes on straight as if nothing were there (thin glass, holes), which shadow rays
 *     take into account by through(): a path that goes straight has not left its last place.
 *
 * All is radiance looked for from its end: what refraction does to it between media, n^2, is left
 * out on the way in and on the way out alike. Materials are immutable once made; any number of
 * threads may ask.
 */
#ifndef MATERIALS_MATERIAL_H
#define MATERIALS_MATERIAL_H

#include "core/arena.h"
#include "core/error.h"
#include "core/packet.h"
#include "materials/look.h"

typedef struct material material;

/* The point that is asked about. Filled in by who asks: all but `look` always; look, by
 * materials_look(), only where the material has textures. */
typedef struct vshading {
    vvec3 wo;        /* unit */
    vvec3 n;         /* unit: the shading normal; dot(wo, n) > 0 */
    vvec3 flat;      /* unit: of the triangle; dot(wo, flat) > 0 */
    vmask front;     /* wo is on the triangle's front side */
    vfloat distance; /* m, > 0: how far light goes along wo, through what is on that side */
    vlook look;      /* what textures make of the material's look */
} vshading;

/* One way on, as drawn for each point. */
typedef struct vscatter {
    vvec3 wi;
    vrgb weight;    /* f(wo, wi) |cos(wi, n)| / pdf; of a single direction what comes from there */
    vfloat pdf;     /* 1/sr, as reflect() has it; INFINITY: this was a single direction */
    vmask straight; /* goes on along -wo as if nothing were there: wi = -wo to the bit */
    vmask bent;     /* refracted to the other side of a solid, where shadow rays go straight */
} vscatter;

typedef struct material_type {
    const char *name; /* "diffuse" */

    /* (u, v) in [0,1)^2 picks the direction, pick in [0,1) which of several parts; the lanes that
     * go on are returned. */
    vmask (*scatter)(const material *self, const vshading *s, vfloat u, vfloat v, vfloat pick,
                     vmask active, vscatter *out);

    /* f(wo, wi) |cos(wi, n)|, 1/sr, and in *pdf, unless pdf is NULL, the density with which
     * scatter() draws wi, 1/sr (over all it draws: it integrates to the share of draws that are of
     * this part). NULL: it has no such part. */
    vrgb (*reflect)(const material *self, const vshading *s, const vvec3 *wi, vmask active,
                    vfloat *pdf);

    /* What goes on straight, [0, 1]. Of a solid that refracts, what of a shadow ray passes this
     * face (material.absorption apart). NULL: nothing. */
    vrgb (*through)(const material *self, const vshading *s, vmask active);

    /* What of light from the mirror direction comes back to wo as a mirror gives it back, [0, 1]:
     * to one direction, on wo's side. NULL: nothing. */
    vrgb (*mirrored)(const material *self, const vshading *s, vmask active);

    /* What of light from wo's direction, in a narrow beam, comes back on wo's side, [0, 1]: the
     * integral of f cos over that side and the mirror-like parts. */
    vrgb (*albedo)(const material *self, const vshading *s, vmask active);
} material_type;

/* The first member of every material. */
struct material {
    const material_type *type;
    material_look look;                /* constants, or what its textures are multiplied with */
    const material_textures *textures; /* NULL: none */

    vec3 reflectance;   /* of diffuse light (on the front side), [0, 1]: reports, bounds */
    vec3 transmittance; /* of diffuse light, straight and scattered, holes apart, [0, 1] */
    vec3 absorption;    /* 1/m, along the way behind the front side; of solids that refract */

    bool matt;      /* so wide a density that lights are best looked for by asking them alone */
    bool two_sided; /* reflect() may be above 0 for wi on the other side */
    bool solid;     /* refracts: shadow rays pass straight, though light would bend */
};

/* What surfaces of every kind may have besides; {0} is none of it. */
typedef struct material_extra {
    vec3 emission;                     /* W/(sr m^2), >= 0, from both sides */
    float openness;                    /* [0, 1]: the share of it that is not there (1 - alpha) */
    const material_textures *textures; /* must outlive the material */
} material_extra;

/* ---- makers: as those of lights (lights/light.h). NULL, with *err, for what is out of range ----
 */

/* Equally bright from everywhere: f = rho / pi. */
typedef struct diffuse_desc {
    vec3 reflectance; /* [0, 1] */
    material_extra extra;
} diffuse_desc;
const material *material_diffuse(arena *a, const diffuse_desc *d, lux_error *err);

/* Diffuse and a lobe about the mirror direction. */
typedef struct phong_desc {
    vec3 reflectance; /* diffuse, [0, 1] */
    vec3 specular;    /* what the lobe gives back at normal incidence; their sum in [0, 1] */
    float exponent;   /* [1, 1e6] */
    material_extra extra;
} phong_desc;
const material *material_phong(arena *a, const phong_desc *d, lux_error *err);

/* A mirror gives back the same share at all angles. */
typedef struct mirror_desc {
    vec3 reflectance; /* [0, 1] */
    material_extra extra;
} mirror_desc;
const material *material_mirror(arena *a, const mirror_desc *d, lux_error *err);

/* The smooth border of a solid: inside lies behind the front side. */
typedef struct dielectric_desc {
    float ior;       /* of the inside, (1, 4] */
    vec3 absorption; /* inside, 1/m, >= 0 */
    vec3 tint;       /* what of the light that passes the border does, [0, 1]: {1,1,1} is glass */
    material_extra extra;
} dielectric_desc;
const material *material_dielectric(arena *a, const dielectric_desc *d, lux_error *err);

/* A pane of clear glass as one surface: Fresnel reflection and what is absorbed within, all
 * passages to and fro added up (reference: the slab). */
typedef struct pane_desc {
    vec3 transmittance; /* of the whole pane at normal incidence, [0, (1 - R) / (1 + R)] */
    float ior;          /* [1, 4]; 1: nothing is reflected */
    bool box; /* of a closed box of glass: the whole pane acts where light enters or leaves by a
                 front side, and back sides do nothing */
    material_extra extra;
} pane_desc;
const material *material_pane(arena *a, const pane_desc *d, lux_error *err);

/* The largest transmittance that a pane can have, with no absorption: (1 - R) / (1 + R). */
double pane_most(double ior);

/* glTF's metal and rough dielectric: GGX over a diffuse base, or over a base that lets light
 * through diffusely blurred. look.metallic, roughness and transmission are glTF's. */
typedef struct gloss_desc {
    vec3 base_color;                         /* [0, 1] */
    float metallic, roughness, transmission; /* [0, 1] */
    float ior;                               /* [1, 4]; 0: F0 of 1 before `specular` */
    float specular;                          /* KHR_materials_specular, [0, 1]: F0 and F90 */
    vec3 specular_color;                     /* >= 0: F0, which stays below 1 */
    material_extra extra;
} gloss_desc;
const material *material_gloss(arena *a, const gloss_desc *d, lux_error *err);

/* The look of a material where no texture changes it. */
static inline vlook look_plain(const material *m)
{
    const material_look *l = &m->look;
    return (vlook){ .color           = vspread(l->color),
                    .emission        = vspread(l->emission),
                    .specular        = vspread(l->specular),
                    .openness        = vsplat(l->openness),
                    .metallic        = vsplat(l->metallic),
                    .roughness       = vsplat(l->roughness),
                    .transmission    = vsplat(l->transmission),
                    .specular_weight = vsplat(l->specular_weight) };
}

/* ---- packets whose lanes are of different materials: all[index], one material at a time --------
 */

vmask materials_scatter(const material *const *all, vint index, const vshading *s, vfloat u,
                        vfloat v, vfloat pick, vmask active, vscatter *out);
vrgb materials_reflect(const material *const *all, vint index, const vshading *s, const vvec3 *wi,
                       vmask active, vfloat *pdf);
vrgb materials_through(const material *const *all, vint index, const vshading *s, vmask active);
vrgb materials_mirrored(const material *const *all, vint index, const vshading *s, vmask active);
vrgb materials_albedo(const material *const *all, vint index, const vshading *s, vmask active);
vrgb materials_emission(const material *const *all, vint index, const vshading *s, vmask active);

/* Fills in s->look where materials have textures, and turns s->n by normal maps: by what is there
 * and the width that a ray stands for, m. */
void materials_look(const material *const *all, vint index, const vdetail *detail, vfloat width,
                    vmask active, vshading *s);

/* Of diffuse light, whatever the point. */
vrgb materials_reflectance(const material *const *all, vint index, vmask active);

#endif
