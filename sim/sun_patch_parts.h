/* sim/sun_patch_parts.h -- what the files of sun_patch.h share: sun_patch_make.c casts the points,
 * sun_patch.c gives them out.
 */
#ifndef SIM_SUN_PATCH_PARTS_H
#define SIM_SUN_PATCH_PARTS_H

#include "sim/sun_patch.h"

/* What is kept of a point; vectors are three fields. */
enum {
    AT     = 0,
    NORMAL = AT + 3,
    BEFORE = NORMAL + 3, /* to_sun; from z: to y */
    LIGHT  = BEFORE + 3, /* e; of z: pi f(y) e */
    SHINES = LIGHT + 3,  /* given back where all is matt */
    U      = SHINES + 3,
    V,
    FIRST_FIELDS, /* of a patch; the next are of z: */
    PATCH  = FIRST_FIELDS,
    TO_SUN = PATCH + 3,
    AREA   = TO_SUN + 3, /* by c(y, w) */
    BACK,                /* c(y, z) / |y - z|^2 */
    DRAWN,               /* the density of z */
    FIELDS,
};

/* The points of one generation: lots of those of one sun, portal and set stand together, one lot
 * after the other, sun by sun, portal by portal. */
typedef struct patch_lots {
    int32_t *kept; /* of each lot */
    float *field[FIELDS];
    int32_t *instance, *triangle;
} patch_lots;

struct sun_patches {
    const scene *s;
    int portals, cast; /* cast: places, a lot */
    bool matt;         /* all surfaces are */
    uint32_t seed;
    const float *area; /* m^2, of each portal */
    float *facing;     /* m^2: A c(o, w) of each sun and portal, >= 0 */
    float *lit;        /* m^2: the same, times the share that is kept of all sets */
    patch_lots first, second;
    int32_t *suns;
    int sun_count;
};

static inline const light *patch_sun(const sun_patches *w, int sun)
{
    return w->s->lights[scene_lamp_count(w->s) + sun];
}

#endif
