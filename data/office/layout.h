/* data/office/layout.h -- where everything of the office stands. */
#ifndef OFFICE_LAYOUT_H
#define OFFICE_LAYOUT_H

#include "data/model/model.h"

/* Furnishes an empty model. detail 1: the office as shipped; more: rounder, with more triangles. */
void office_build(model *m, double detail);

/* All of the office as single triangles without instances, as near to this number as the
 * roundness of its parts allows (from about 13,000 to a million). */
void bench_build(model *m, uint32_t triangles);

#endif
