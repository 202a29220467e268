/* tests/bench/plain_brdf.c -- see plain_brdf.h; built twice, with and without PLAIN_387. */
#include "tests/bench/plain_brdf.h"

#ifdef PLAIN_387
#define plain_sum_brdf plain_sum_brdf_387
#define plain_value    plain_value_387
#endif

static const float TURN = 6.28318531f;

typedef struct place {
    int below, above;
    float share;
} place;

static place find(const plain_axis *axis, float x)
{
    const float *at = axis->at;
    int last        = axis->count - 1;
    if (axis->periodic) {
        if (x < at[0])
            x += TURN;
        if (x >= at[last])
            return (place){ last, 0, (x - at[last]) / (at[0] + TURN - at[last]) };
    } else if (x >= at[last]) {
        return (place){ last - 1, last, 1.0f };
    } else if (x <= at[0]) {
        return (place){ 0, 1, 0.0f };
    }
    int low = 0, high = last;
    while (high - low > 1) {
        int middle = (low + high) / 2;
        if (at[middle] <= x)
            low = middle;
        else
            high = middle;
    }
    return (place){ low, high, (x - at[low]) / (at[high] - at[low]) };
}

vec3 plain_value(const plain_table *t, vec3 wo, vec3 wi)
{
    if (!(wo.z > 0.0f && wi.z > 0.0f))
        return (vec3){ 0, 0, 0 };
    place p[4] = { find(&t->axes[0], atan2f(sqrtf(wo.x * wo.x + wo.y * wo.y), wo.z)),
                   find(&t->axes[1], atan2f(wo.y, wo.x)),
                   find(&t->axes[2], atan2f(sqrtf(wi.x * wi.x + wi.y * wi.y), wi.z)),
                   find(&t->axes[3], atan2f(wi.y, wi.x)) };
    int n1 = t->axes[1].count, n2 = t->axes[2].count, n3 = t->axes[3].count;
    vec3 sum = { 0, 0, 0 };
    for (int row = 0; row < 4; row++) {
        int a = row & 2 ? p[0].above : p[0].below, b = row & 1 ? p[1].above : p[1].below;
        float of_row =
            (row & 2 ? p[0].share : 1.0f - p[0].share) * (row & 1 ? p[1].share : 1.0f - p[1].share);
        const float *from = t->values + 4 * ((a * n1 + b) * n2 * n3);
        for (int column = 0; column < 4; column++) {
            int c = column & 2 ? p[2].above : p[2].below, d = column & 1 ? p[3].above : p[3].below;
            float weight = of_row * (column & 2 ? p[2].share : 1.0f - p[2].share) *
                           (column & 1 ? p[3].share : 1.0f - p[3].share);
            const float *corner = from + 4 * (c * n3 + d);
            sum.x += weight * corner[0];
            sum.y += weight * corner[1];
            sum.z += weight * corner[2];
        }
    }
    return sum;
}

vec3 plain_sum_brdf(const plain_table *t, const vec3 *wo, const vec3 *wi, int count)
{
    vec3 sum = { 0, 0, 0 };
    for (int i = 0; i < count; i++) {
        vec3 f = plain_value(t, wo[i], wi[i]);
        sum.x += f.x;
        sum.y += f.y;
        sum.z += f.z;
    }
    return sum;
}
