/* tests/told_scene.h -- scenes of studies in a folder of their own, and what was told of them. */
#ifndef TESTS_TOLD_SCENE_H
#define TESTS_TOLD_SCENE_H

#include "sim/scene.h"

/* The folder is made and removed by these fixtures of a group, with all that was made in it. */
int told_prepare(void **state), told_forget(void **state);
const char *told_folder(void);
arena *told_memory(void); /* cleared with it */

/* The scene of a study ("lux4: 1" goes before it), which must be good. */
const scene *told_scene_of(const char *text);

/* Whether the last scene came with a notice that holds this. */
bool was_told(const char *what);
const notice *told_first(void);

#endif
