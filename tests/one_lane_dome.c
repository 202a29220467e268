/* tests/one_lane_dome.c -- dome.c for one lane: see one_lane_sky.h. */
#undef PACKET_WIDTH
#define PACKET_WIDTH 1
#define dome_sample   one_lane_draw_dome /* beside the library's own */
#define dome_pdf      one_lane_density_dome
#define dome_new      one_lane_dome_new
#define dome_of_table one_lane_dome_of_table
#include "sky/dome.c"
#include "tests/one_lane_sky.h"

void one_lane_dome_sample(const dome *d, float s, float t, float out[4])
{
    vvec3 wi = one_lane_draw_dome(d, s, t, ALL_LANES, &out[3]);
    out[0]   = wi.x;
    out[1]   = wi.y;
    out[2]   = wi.z;
}

float one_lane_dome_pdf(const dome *d, const float wi[3])
{
    return one_lane_density_dome(d, &(vvec3){ wi[0], wi[1], wi[2] }, ALL_LANES);
}
