/* tests/sources.h -- a lamp of each type, for what lets light set out. */
#ifndef TESTS_SOURCES_H
#define TESTS_SOURCES_H

#include "lights/light.h"

extern const vec3 source_at;             /* m, about where all of them are */
extern const light_target source_target; /* of what is far away */

/* Colours are as 3, 2, 1. */
typedef void source_test(const char *name, const light *l);

/* Those of many directions, and (beam) one of a single one. */
void for_each_source(bool beam, source_test *test);

/* Particles number first and on of a set. */
vlight_ray source_draw(const light *l, int first, uint32_t seed, vmask *lit);

#endif
