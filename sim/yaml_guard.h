/* sim/yaml_guard.h -- a YAML text as libyaml's tree of nodes, if it is one to be trusted.
 *
 * libyaml 0.2.5 takes 36 s for 160 kB of `[`, and accepts aliases that contain themselves. Here
 * a text is refused, before the tree is built, that is larger than 1 MiB, nests deeper than 64,
 * has more than 1,000 anchors or 16 directives, or holds a second document; and after that a
 * tree whose aliases make a cycle, a nesting deeper than 64 or more than 1,000,000 nodes, or
 * whose tags are not those of plain mappings, lists and scalars.
 */
#ifndef SIM_YAML_GUARD_H
#define SIM_YAML_GUARD_H

#include "core/error.h"

#include <stddef.h>
#include <yaml.h>

#define YAML_GUARD_BYTES ((size_t)1 << 20)

/* Reads `size` bytes of UTF-8 into *tree, whose root is then there, and which is the caller's to
 * yaml_document_delete(). False, with *err beginning "path:line:column: ", if it is refused. */
bool yaml_guard_load(yaml_document_t *tree, const char *path, const char *text, size_t size,
                     lux_error *err);

#endif
