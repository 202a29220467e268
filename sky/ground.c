/* sky/ground.c -- even light from all directions below the horizon: ground that nothing shadows.
 *
 * Level ground gets none of it: `horizontal` is 0. A vertical surface gets pi / 2 of the radiance.
 */
#include "sky/sky.h"

typedef struct ground_sky {
    sky base;
    vec3 radiance; /* W/(sr m^2) */
} ground_sky;

static vrgb ground_radiance(const sky *self, const vvec3 *wi, vmask active)
{
    const ground_sky *s = (const ground_sky *)self;
    return vkeep3(active & (wi->z < 0.0f), vspread(s->radiance));
}

static const sky_type ground_type = { .name = "ground", .radiance = ground_radiance };

const sky *sky_ground(arena *a, vec3 radiance, lux_error *err)
{
    if (!v3_nonnegative(radiance) || !(radiance.x + radiance.y + radiance.z < INFINITY))
        return failed(err, ERR_ARGUMENT, "ground: a radiance is not >= 0 W/(sr m^2)");
    ground_sky *s = arena_new(a, ground_sky, err);
    if (!s)
        return NULL;
    s->base     = (sky){ .type = &ground_type, .below = true };
    s->radiance = radiance;
    return &s->base;
}
