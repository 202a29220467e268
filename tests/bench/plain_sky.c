/* tests/bench/plain_sky.c -- see plain_sky.h. */
#include "tests/bench/plain_sky.h"

#include <math.h>

static int cell_of(float share, int count)
{
    int i = (int)(share * (float)count);
    return i < 0 ? 0 : i >= count ? count - 1 : i;
}

static vec3 panorama(const plain_sky *s, vec3 wi)
{
    float polar    = atan2f(sqrtf(wi.x * wi.x + wi.y * wi.y), wi.z);
    float turn     = atan2f(wi.x, wi.y) * 0.159154943f + 0.5f;
    int x          = cell_of(turn - floorf(turn), s->width);
    int y          = cell_of(polar * 0.318309886f, s->height);
    const float *p = s->rgba + 4 * (y * s->width + x);
    return (vec3){ p[0], p[1], p[2] };
}

static inline vec3 radiance(const plain_sky *s, vec3 wi)
{
    if (s->rgba)
        return panorama(s, wi);
    if (wi.z < 0.0f)
        return (vec3){ 0, 0, 0 };
    if (s->overcast)
        return v3_scale(s->scale, (1.0f + 2.0f * wi.z) * (1.0f / 3.0f));
    float l = 1.0f;
    if (s->a != 0.0f)
        l = 1.0f + s->a * expf(s->b / fmaxf(wi.z, 1e-6f));
    if (s->c != 0.0f) {
        float cosine = v3_dot(wi, s->to_sun);
        float chi    = acosf(fminf(fmaxf(cosine, -1.0f), 1.0f));
        l *= s->f0 + s->c * expf(s->d * chi) + s->e * (cosine * cosine);
    }
    return v3_scale(s->scale, fmaxf(l, 0.0f));
}

vec3 plain_sky_radiance(const plain_sky *s, vec3 wi) { return radiance(s, wi); }

vec3 plain_sky_sum(const plain_sky *s, const vec3 *wi, int count)
{
    vec3 sum = { 0 };
    for (int i = 0; i < count; i++) {
        vec3 l = radiance(s, wi[i]);
        sum    = (vec3){ sum.x + l.x, sum.y + l.y, sum.z + l.z };
    }
    return sum;
}
