/* sim/scene_sky.c -- the light of day: moments, suns as lamps, skies. */
#include "sim/scene_build.h"

bool build_daylight(scene_build *b)
{
    (void)b;
    return true;
}
