/* materials/look.h -- what of a material may change from place to place, by textures.
 *
 * A texture's value is multiplied with the constant of its field, as glTF 2.0 has it (section
 * 3.9.2); alpha decides what is not there (3.9.4).
 */
#ifndef MATERIALS_LOOK_H
#define MATERIALS_LOOK_H

#include "core/world.h"
#include "materials/texture.h"

typedef struct material_look {
    vec3 color;     /* linear, [0, 1]: of a material's kind, its reflectance or base colour */
    vec3 emission;  /* W/(sr m^2) */
    vec3 specular;  /* specular colour factor, >= 0 */
    float openness; /* [0, 1]: 1 - alpha */
    float metallic, roughness, transmission, specular_weight; /* [0, 1] */
} material_look;

typedef struct vlook {
    vrgb color, emission, specular;
    vfloat openness, metallic, roughness, transmission, specular_weight;
} vlook;

/* A texture in use: which coordinates it goes by, and how they are changed before:
 * u' = m[0] u + m[1] v + m[2], v' = m[3] u + m[4] v + m[5] (KHR_texture_transform). */
typedef struct texture_slot {
    const texture *texture; /* NULL: none */
    int set;                /* 0 or 1: TEXCOORD_0 or _1 */
    float m[6];
} texture_slot;

typedef enum alpha_mode { ALPHA_OPAQUE, ALPHA_MASK, ALPHA_BLEND } alpha_mode;

/* x and y of a normal map, of -1 ... 1, that are no slope: of 8 bits neither 127 nor 128 is 0, and
 * both stand for it. */
#define NORMAL_MAP_FLAT (1.0f / 255.0f + 2e-6f)

/* Which of the texture's channels is meant is glTF's affair: color RGB, alpha A of `base`;
 * roughness G and metallic B of `surface`; transmission R; specular_weight A; normal RGB, of which
 * 0 ... 1 is -1 ... 1, x along u' and y against v': bumps are turned and mirrored with their
 * picture. Shares are [0, 1] and colours >= 0 whatever the pictures hold. */
typedef struct material_textures {
    texture_slot base, surface, emission, transmission, specular_weight, specular_color, normal;
    float normal_scale; /* of the normal map's x and y */
    alpha_mode alpha;
    float cutoff;    /* ALPHA_MASK: what is below it is not there, all else is */
    bool alpha_only; /* base's colour is left out, as if it were white: holes are kept of a surface
                        whose colour is said elsewhere */
} material_textures;

#endif
