/* sim/sun_patch_parts.h -- what the files of sun_patch.h share: sun_patch_make.c casts the points,
 * sun_patch.c gives them out.
 */
#ifndef SIM_SUN_PATCH_PARTS_H
#define SIM_SUN_PATCH_PARTS_H

#include "sim/sun_patch.h"

/* What is kept of a point: rows of four numbers, side by side, so that a look at one point is a
 * look at one place of memory. */
enum {
    PLACE_ROW,  /* at, and of z its density */
    NORMAL_ROW, /* its normal, and of z c(y, w) */
    BEFORE_ROW, /* toward where its light comes from, and of z c(y, z) / |y - z|^2 */
    LIGHT_ROW,  /* radiance, where all is matt; else light */
    HIT_ROW,    /* instance and triangle, as bits, u and v */
    FIRST_ROWS, /* of a patch; the next are of z: */
    PATCH_ROW = FIRST_ROWS,
    SUN_ROW, /* toward the sun from y */
    SECOND_ROWS,
};

/* The points of one generation: lots of those of one sun, portal and set stand together, one lot
 * after the other, sun by sun, portal by portal. */
typedef struct patch_lots {
    int32_t *kept; /* of each lot */
    float *rows;
    int row_count; /* of a point */
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
