/* core/lane_math.h -- functions of packets by the C library, lane by lane: what core/packet_math.h
 * is measured against. No light path takes them unless lux4 cost asks it to.
 */
#ifndef CORE_LANE_MATH_H
#define CORE_LANE_MATH_H

#include "core/packet.h"

/* As in C; NaN gives NaN. */
vfloat lane_atan2(vfloat y, vfloat x);

#endif
