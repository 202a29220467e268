/* tests/transports.h -- the ways to find interreflected light that tests of physics go through. */
#ifndef TESTS_TRANSPORTS_H
#define TESTS_TRANSPORTS_H

#include "sim/grid.h"

static const transport transports[] = { TRANSPORT_PATH, TRANSPORT_MAPS };
enum { TRANSPORTS = sizeof transports / sizeof *transports };

/* Reflections before which no path is ended by chance: results must not depend on it. */
static const int roulette_depths[] = { 0, 8 };
enum { ROULETTE_DEPTHS = sizeof roulette_depths / sizeof *roulette_depths };

#endif
