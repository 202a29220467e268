/* tests/solids.h -- what tests of the programs that make our scenes look at. */
#ifndef TESTS_SOLIDS_H
#define TESTS_SOLIDS_H

#include "data/model/solid.h"

#include <stdio.h>

/* The bytes of the file at path, from the project's folder, are those that write() gives. */
void assert_file_is(const char *path, bool (*write)(FILE *to));

/* Every edge is used once each way: the patch is a set of closed surfaces. */
bool patch_is_closed(const patch *t);

/* The place of the i-th corner of the triangles. */
point patch_corner(const patch *t, uint32_t i);

/* The least area of a triangle, m^2, and six times the volume inside: positive if faces look out.
 */
double patch_least_area(const patch *t, double *volume6);

#endif
