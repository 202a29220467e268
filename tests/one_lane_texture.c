/* tests/one_lane_texture.c -- a look-up as it is at width 1, whatever the width of the rest. */
#undef PACKET_WIDTH
#define PACKET_WIDTH          1
#define texture_new           one_lane_texture_new /* beside the library's own */
#define texture_mean          one_lane_texture_mean
#define texture_share         one_lane_texture_share
#define texture_range         one_lane_texture_range
#define texture_bytes         one_lane_texture_bytes
#define texture_picture_bytes one_lane_texture_picture_bytes
#define vtexture_lookup       one_lane_vtexture_lookup
#include "tests/one_lane_texture.h"
#include "materials/texture.c"

void one_lane_lookup(const texture *t, float u, float v, float width, float rgba[4])
{
    vtexel a = vtexture_lookup(t, u, v, width, 1);
    rgba[0]  = a.red;
    rgba[1]  = a.green;
    rgba[2]  = a.blue;
    rgba[3]  = a.alpha;
}
