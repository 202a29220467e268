/* tests/quads_gltf.h -- scenes of parallelograms as glTF files, each a node, for tests of studies.
 */
#ifndef TESTS_QUADS_GLTF_H
#define TESTS_QUADS_GLTF_H

#include "core/transform.h"

/* Its front is where u x v points to; m, z up, as in the study. */
typedef struct quad {
    const char *node;
    int material; /* of the list */
    int parent;   /* index of another, whose node it hangs at, 0 for the first; -1: none */
    dvec3 at, u, v;
} quad;

/* Writes FOLDER/NAME. Materials by name: 0.5 each, but clear glass if it begins with "Glass". Those
 * of a child are placed in the world, as its parent's are. */
void quads_gltf_write(const char *folder, const char *name, const quad *quads, int count,
                      const char *const *materials, int material_count);

/* The six sides of a box, seen from outside, from `out[0]` on, all of one name and material: y low,
 * y high, x low, x high, z low, z high. */
void quads_box(quad out[6], const char *node, int made_of, dvec3 low, dvec3 high);

#endif
