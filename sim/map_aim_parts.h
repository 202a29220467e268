/* sim/map_aim_parts.h -- what map_aim.c, which draws, map_aim_cut.c, which cuts surfaces, and
 * map_aim_make.c, which learns, share.
 */
#ifndef SIM_MAP_AIM_PARTS_H
#define SIM_MAP_AIM_PARTS_H

#include "sim/map_aim.h"

/* A triangle of a surface, or a part of it. */
typedef struct aim_piece {
    vec3 corner[3]; /* m, in the scene's frame */
    float area;     /* m^2 */
    int32_t instance, triangle;
    int32_t block;
} aim_piece;

/* Surfaces, cut: a block is a range of pieces that follow each other. */
typedef struct aim_cut {
    int pieces, blocks;
    const aim_piece *piece;
    const int32_t *first; /* of a block, and one more: its first piece */
    const double *area;   /* m^2, of a block */
    const float *from;    /* of a piece: where it begins in its block's area, */
    const float *width;   /* and its share of that */
} aim_cut;

struct map_aim {
    const scene *s;
    float radius; /* m, around all from the frame's origin */
    int sources;
    const int32_t *source; /* as scene.lights counts */
    aim_cut cut;
    const float *source_cdf;
    const float *block_cdf; /* [source * (blocks + 1)] */
    int64_t rays;           /* of pilots */
};

/* Even places of those pieces, by a and b in [0, 1)^2; their normals, unit. */
vvec3 aim_place(const aim_cut *c, vint piece, vfloat a, vfloat b, vvec3 *normal);

enum { MOST_AIM_CHUNKS = 256 }; /* of pilots, in a round */

/* While an aim is made; tables by cell are [source * most + block]. */
typedef struct aim_learner {
    const aim_desc *d;
    arena scratch;
    map_aim *m;
    int most;        /* blocks */
    double wanted;   /* the same, about */
    double *learned; /* shares of cells, [source * most + block]; their sum is 1, or 0: none yet */
    double *base;    /* in the same order */
    double *moment[2]; /* sums of squares, W^2: of what came to matt surfaces, to sensors */
    double *share;     /* with which cells are drawn */
    int chunks;
    map_list lists[MOST_AIM_CHUNKS];
    map_balance came[MOST_AIM_CHUNKS];
    map_job job;
} aim_learner;

/* The first cut, by area; and one by what is learned, which goes over to the new blocks. */
bool aim_first_cut(aim_learner *l, lux_error *err);
bool aim_cut_anew(aim_learner *l, lux_error *err);

/* The aim's cut, which lies in what is cleared, into a. */
bool aim_keep_cut(arena *a, map_aim *m, lux_error *err);

bool aim_no_memory(lux_error *err);

#endif
