/* tests/box_ies.h -- a room that an independent Monte Carlo program has simulated, where present.
 */
#ifndef TESTS_BOX_IES_H
#define TESTS_BOX_IES_H

#include "sim/scene.h"

#define BOX_IES_FOLDER "../shared/data/reference/box_ies"
enum { BOX_IES_SENSORS = 240 };

typedef struct box_ies {
    const scene *scene;                                     /* of its own study */
    double direct[BOX_IES_SENSORS], total[BOX_IES_SENSORS]; /* lx, by the independent program */
} box_ies;

/* False where the files are not there. */
bool box_ies_read(arena *a, box_ies *out);

/* Its expected values alone. */
bool box_ies_expected(double direct[BOX_IES_SENSORS], double total[BOX_IES_SENSORS]);

#endif
