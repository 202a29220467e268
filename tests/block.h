/* tests/block.h -- a solid block as a glTF file, for scenes in which something casts shadows. */
#ifndef TESTS_BLOCK_H
#define TESTS_BLOCK_H

#include "core/arena.h"
#include "core/packet.h"

/* Writes NAME into the scratch folder of gltf_text.h: a block with its foot in the middle of the
 * origin, size in m along x, y and z as studies have them, grey. Its path, in a. */
const char *block_write(arena *a, const char *name, vec3 size);

#endif
