/* tests/one_lane_sky.h -- drawing from skies one lane at a time, whatever the width of the rest. */
#ifndef TESTS_ONE_LANE_SKY_H
#define TESTS_ONE_LANE_SKY_H

struct dome;
struct portals;

/* wi[3], then the density. */
void one_lane_dome_sample(const struct dome *d, float s, float t, float out[4]);
float one_lane_dome_pdf(const struct dome *d, const float wi[3]);

/* u: pick, s, t. */
void one_lane_portals_sample(const struct portals *all, const float p[3], const float n[3],
                             const float u[3], float out[4]);
float one_lane_portals_pdf(const struct portals *all, const float p[3], const float n[3],
                           const float wi[3]);

#endif
