/* tests/one_lane_portal.c -- portal.c and its tables for one lane: see one_lane_sky.h. */
#undef PACKET_WIDTH
#define PACKET_WIDTH         1
#define portals_sample       one_lane_sample /* beside the library's own */
#define portals_pdf          one_lane_pdf
#define portals_cross        one_lane_cross
#define portals_new          one_lane_portals_new
#define portal_table_box     one_lane_box
#define portal_table_draw    one_lane_draw
#define portal_table_density one_lane_density
#define portal_table_fill    one_lane_fill
#include "sky/portal.c"
#include "sky/portal_table.c"
#include "tests/one_lane_sky.h"

static vvec3 from(const float a[3]) { return (vvec3){ a[0], a[1], a[2] }; }

void one_lane_portals_sample(const portals *all, const float p[3], const float n[3],
                             const float u[3], float out[4])
{
    vvec3 place = from(p), normal = from(n), wi;
    one_lane_sample(all, &place, &normal, u[0], u[1], u[2], ALL_LANES, &wi, &out[3]);
    out[0] = wi.x;
    out[1] = wi.y;
    out[2] = wi.z;
}

float one_lane_portals_pdf(const portals *all, const float p[3], const float n[3],
                           const float wi[3])
{
    vvec3 place = from(p), normal = from(n), w = from(wi);
    return one_lane_pdf(all, &place, &normal, &w, ALL_LANES);
}
