/* core/lane_math.c -- see lane_math.h. */
#include "core/lane_math.h"

#include <math.h>

vfloat lane_atan2(vfloat y, vfloat x)
{
    float angle[LANES];
    for (int i = 0; i < LANES; i++)
        angle[i] = atan2f(lane(y, i), lane(x, i));
    return vload(angle);
}
