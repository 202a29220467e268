/* core/color.h -- where radiometry meets photometry: one constant and three weights.
 *
 * Inside lux4 light is radiometric, in three channels with Rec. 709 primaries and a D65 white.
 * One watt of equal channels is 179 lumens (the convention of Radiance), and a luminance is
 * made of the channels by the weights of ITU-R BT.709-6, item 3.2.
 */
#ifndef CORE_COLOR_H
#define CORE_COLOR_H

#include "core/packet.h"

#define LUMENS_PER_WATT 179.0 /* of equal-channel white */

/* The three channels as one: W/m^2 that weigh as much to the eye; times LUMENS_PER_WATT, lux. */
static inline float rgb_luminance(vec3 c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; }
static inline vfloat vrgb_luminance(vrgb c)
{
    return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z;
}

static inline vrgb vmul(vrgb a, vrgb b) { return (vrgb){ a.x * b.x, a.y * b.y, a.z * b.z }; }

#endif
