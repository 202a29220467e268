/* materials/bsdf_parts.h -- what the files of the BSDF share; only materials/bsdf*.c include it.
 *
 * Directions before the layer are in the file's axes. That from which light comes is given by how
 * the light travels: (x, y) of its way, so that what goes on straight, and what a mirror returns,
 * keeps its (x, y). That to which it goes is given as it is. z is the cosine with the normal of the
 * side it is on, [0, 1].
 *
 *         in \    | out of a mirror      x, y of both: those of the arrows
 *             \   | ^
 *      ________v__|/______
 *                 \
 *                  v straight on
 */
#ifndef MATERIALS_BSDF_PARTS_H
#define MATERIALS_BSDF_PARTS_H

#include "core/distribution.h"
#include "core/packet_math.h"
#include "materials/bsdf.h"

/* ---- Klems' bases: rings about the normal, each in equal cells, the first about azimuth 0 ------
 */

enum { KLEMS_RINGS = 48, KLEMS_CELLS = 2000, KLEMS_NAME = 48 };

typedef struct klems {
    char name[KLEMS_NAME];
    int rings, cells;
    float cosine[KLEMS_RINGS + 1]; /* of the polar angles between rings, 1 ... 0 */
    float count[KLEMS_RINGS];      /* cells of each ring */
    int32_t first[KLEMS_RINGS];    /* its first cell */
    float area[KLEMS_RINGS];       /* projected solid angle of each of its cells, sr */
} klems;

typedef struct klems_ring {
    double low_deg, high_deg;
    int count;
} klems_ring;

/* LBNL's own by name; false: there is none of that name. */
bool klems_known(const char *name, klems *out);

/* Rings in ascending order from 0 to 90 deg; NULL if they are, else what is wrong with them. */
const char *klems_make(klems *k, const char *name, const klems_ring *ring, int rings);

/* The cell of a direction. Its cells hold what is at their lower polar angle and azimuth. */
vint vklems_cell(const klems *k, vfloat x, vfloat y, vfloat z);

/* (u, v) in [0, 1)^2: a direction of the cell, even in projected solid angle; that angle, sr. */
vvec3 vklems_direction(const klems *k, vint cell, vfloat u, vfloat v);
vfloat vklems_area(const klems *k, vint cell);

/* ---- tensor trees: the hypercube halved along all axes, again and again where data ask for it ---
 *
 * Rank 4: in's place on the square, then out's, by Shirley and Chiu's map between square and disk.
 * Rank 3: 1/2 - sin(theta of in) / 2, then out's place when all is turned so that in's azimuth is
 * 0. A branch's child has bit i set where it is in the upper half of axis i; a leaf is a grid whose
 * last axis is the fastest. */

enum { TENSOR_DEPTH = 12 };

typedef struct tensor {
    int rank, depth; /* 3 or 4; the finest leaf is 2^-depth wide */
    int32_t *first;  /* of a branch: its first child; of a leaf: its first value */
    int32_t *log2;   /* of a leaf: of its grid's resolution; of a branch: -1 */
    float *value;    /* 1/sr */
    int nodes, values;
} tensor;

/* The text of a tree; *line is that of its beginning, and moves on to that of what is wrong. */
const tensor *tensor_parse(arena *a, int rank, const char *text, const char *path, int *line,
                           lux_error *err);

/* The same value everywhere. */
const tensor *tensor_even(arena *a, int rank, float value, lux_error *err);

/* Light on the reverse of its way through; of rank 3 averaged on a grid. */
const tensor *tensor_reverse(arena *a, const tensor *t, lux_error *err);

/* The mean value in each of 4^out_log2 squares of out, for in in the box of this width that begins
 * at low[]. */
void tensor_row(const tensor *t, const double low[2], double width, int out_log2, double *mean);

/* Where in and out are in the hypercube; the value there. */
void vtensor_place(int rank, const vvec3 *in, const vvec3 *out, vfloat place[4]);
vfloat vtensor_value(const tensor *t, const vfloat place[4], vmask active);

/* The inverse of vsquare_to_disk(): [0, 1)^2. */
void vdisk_to_square(vfloat x, vfloat y, vfloat *s, vfloat *t);

/* ---- what a file says, before it is understood ----------------------------------------------- */

typedef struct bsdf_block { /* text NULL: the file has none of this kind */
    const char *text;       /* its ScatteringData, which begins on text_line */
    int line, text_line;
    char column[KLEMS_NAME], row[KLEMS_NAME], basis[KLEMS_NAME];
} bsdf_block;

typedef enum bsdf_part { BSDF_REFLECT, BSDF_TRANSMIT } bsdf_part;

typedef struct bsdf_file {
    const char *path;
    int rank;     /* 0: Klems */
    bool in_rows; /* a row for each in, not a column */
    klems basis[4];
    int bases;
    bsdf_block block[2][2]; /* [bsdf_side_name of in][bsdf_part] */
} bsdf_file;

bool bsdf_file_parse(arena *a, const char *path, const char *bytes, size_t size, notices *n,
                     bsdf_file *out, lux_error *err);

/* Of one block of a Klems file: value[in * cells + out], 1/sr. */
float *klems_parse(arena *a, const klems *k, const bsdf_file *f, const bsdf_block *b,
                   lux_error *err);

/* The number at *text, behind spaces and perhaps a comma, and moves on behind it, counting lines;
 * false with *err if there is none or it is not in [0, 1e6]. */
bool bsdf_number(const char **text, const char *path, int *line, float *out, lux_error *err);

/* ---- what is made of it ---------------------------------------------------------------------- */

/* What arrives at one side. Of each row (where in is) cdf[] draws one of 2 * cells: reflected into
 * each cell, then let through into each. */
typedef struct bsdf_side {
    float *value[2];       /* [bsdf_part], Klems: [row * cells + cell], 1/sr */
    const tensor *tree[2]; /* [bsdf_part], tensor trees */
    float *cdf;            /* [row * (2 * cells + 1) + ...] */
    float *share[2];       /* [bsdf_part], of each row: what goes into the hemisphere, [0, 1] */
} bsdf_side;

struct bsdf {
    int rank; /* 0: Klems */
    klems basis;
    int in_log2, out_log2; /* tensor trees: rows and cells to draw by, along each axis */
    int rows, cells;
    bsdf_side side[2];
    bsdf_figures figures;
};

/* Where a pair of directions is in the tables. */
typedef struct vbsdf_place {
    vint row, cell;
    vfloat at[4]; /* trees: in the hypercube */
} vbsdf_place;

vbsdf_place vbsdf_find(const bsdf *b, const vvec3 *in, const vvec3 *out);
vfloat vbsdf_value(const bsdf *b, bsdf_side_name side, bsdf_part part, const vbsdf_place *p,
                   vmask active);

/* The row alone. */
vint vbsdf_row(const bsdf *b, const vvec3 *in);

/* (u, v) in [0, 1)^2: a direction of the cell, even in projected solid angle; that angle, sr. */
vvec3 vbsdf_direction(const bsdf *b, const vvec3 *in, vint cell, vfloat u, vfloat v);
vfloat vbsdf_area(const bsdf *b, vint cell);

#endif
