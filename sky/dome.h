/* sky/dome.h -- drawing directions as skies are bright.
 *
 * The density follows the mean luminance of several skies over the sphere (of all the hours of a
 * series at once), less a part that is the same everywhere: what is left is for who finds light by
 * other ways, too, and mixes both by the power heuristic (Karlik et al., "MIS Compensation", ACM
 * TOG 38(6) 2019). Where that leaves nothing (a constant map), nothing is taken off.
 *
 * Immutable once made: any thread may draw.
 */
#ifndef SKY_DOME_H
#define SKY_DOME_H

#include "core/packet.h"
#include "sky/brightness.h"

typedef struct dome dome;

/* Skies: count >= 1; they are not needed afterwards. NULL, with *err, without memory. */
const dome *dome_new(arena *a, const sky *const *skies, int count, lux_error *err);

/* By a table, nothing taken off: for who finds light in no other way. */
const dome *dome_of_table(arena *a, const brightness *b, lux_error *err);

/* A unit direction and its density, 1/sr, for (s, t) in [0,1)^2: > 0 and finite. */
vvec3 dome_sample(const dome *d, vfloat s, vfloat t, vmask active, vfloat *pdf);

/* The density with which dome_sample() draws wi, 1/sr; 0 in directions that are never drawn. */
vfloat dome_pdf(const dome *d, const vvec3 *wi, vmask active);

#endif
