/* lights/light_tree.h -- one light of many, drawn for each point of a packet about in proportion to
 * what it may give there (Conty Estevez and Kulla, "Importance Sampling of Many Lights with
 * Adaptive Tree Splitting", HPG 2018).
 *
 * Near lights are the leaves of a binary tree; each node bounds where its lights are and where they
 * shine to, and a lane goes down to one of two children with probabilities as their importances.
 * Far lights stand beside the tree, in a row that is gone through from end to end: they are few.
 * An importance is 0 only where no light below the node can give anything, so that
 *
 *     e / probability        [W/m^2], e what the light that was chosen gives; 0 where none was
 *
 * has the sum over all lights as its mean. Immutable once made: any thread may choose.
 */
#ifndef LIGHTS_LIGHT_TREE_H
#define LIGHTS_LIGHT_TREE_H

#include "lights/light.h"

typedef struct light_tree light_tree;

/* A light as chosen for each lane. */
typedef struct vlight_choice {
    vint index;         /* into lights[]; -1: none */
    vfloat probability; /* of that index, > 0; 0: none */
    vfloat rest;        /* [0,1): where u lay in the share of [0,1) that chooses this index. It has
                           the bits of u that the choice left over, about 24 + log2(probability) */
} vlight_choice;

/* Over lights[0 .. count-1], of which bounds alone are read, and read now: the lights need not
 * live on. Those whose peak is 0 are never chosen; no lights at all are fine. NULL, with *err, if a
 * light's bounds are no numbers or memory is out; what a then holds of it lives as long as a. */
const light_tree *light_tree_new(arena *a, const light *const *lights, int count, lux_error *err);

/* One light for each active lane at p, within 1e8 m of all; u in [0,1) picks it. The lanes that
 * have one. n is the unit normal of the lit surface, or 0 0 0: nothing is below a horizon. None is
 * chosen where none can light the point, and also, with the probability that is missing in the sum
 * over all lights, where a node was found to hold none that can. */
vmask vlight_tree_choose(const light_tree *t, const vvec3 *p, const vvec3 *n, vfloat u,
                         vmask active, vlight_choice *out);

/* The probability, to the bit, with which vlight_tree_choose() chooses lights[index], 0 <= index
 * < count, in each active lane; 0 if it never does. */
vfloat vlight_tree_probability(const light_tree *t, const vvec3 *p, const vvec3 *n, vint index,
                               vmask active);

#endif
