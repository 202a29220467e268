/* tests/unit/test_shading_normal.c -- normals that would mirror the eye into the surface. */
#include "core/warp.h"
#include "materials/shading_normal.h"
#include "tests/shapes.h"
#include "tests/test.h"

static vvec3 spread(float x, float y, float z) { return vspread((vec3){ x, y, z }); }

static vvec3 mirrored(vvec3 wo, vvec3 n) { return vsub(vscale(n, 2.0f * vdot(wo, n)), wo); }

static vvec3 random_directions(uint32_t *seed)
{
    float s[LANES], t[LANES];
    for (int i = 0; i < LANES; i++) {
        s[i] = random_unit(seed);
        t[i] = random_unit(seed);
    }
    return vwarp_sphere(vload(s), vload(t));
}

/* A third of them within 1e-7 ... 1 of the horizon of the triangle */
static vvec3 random_eye(uint32_t *seed, int n, vvec3 flat)
{
    vvec3 u, v, wo = random_directions(seed);
    if (n % 3 == 0) {
        vfloat low = vsplat(powf(10.0f, -7.0f * random_unit(seed)));
        vframe(flat, &u, &v);
        vfloat phi = vsplat(6.28f * random_unit(seed));
        vvec3 side = vadd(vscale(u, vcos(phi)), vscale(v, vsin(phi)));
        return vnormalize(valong(side, flat, low));
    }
    return vselect3(vdot(wo, flat) < 0.0f, vneg(wo), wo);
}

TEST(any_normal_is_made_one_that_can_be_seen_and_mirrors_upward)
{
    uint32_t seed = 1;
    for (int n = 0; n < 100000; n++) {
        vvec3 flat = random_directions(&seed), wo = random_eye(&seed, n, flat);
        vvec3 got = vnormal_keep_valid(wo, random_directions(&seed), flat);
        assert_true(vall(vdot(wo, got) > 0.0f));
        assert_true(vall(vdot(mirrored(wo, got), flat) > -2e-7f)); /* of the sum itself */
        assert_true(vall(vabs(vdot(got, got) - 1.0f) < 1e-6f));
    }
}

TEST(normals_that_can_be_seen_stay_to_the_bit)
{
    uint32_t seed = 2;
    int kept      = 0;
    for (int n = 0; n < 20000; n++) {
        vvec3 flat = random_directions(&seed), wo = random_eye(&seed, n, flat);
        vvec3 bent = vnormalize(valong(flat, random_directions(&seed), vsplat(0.3f)));
        vvec3 own  = vnormal_keep_valid(wo, flat, flat);
        vvec3 got  = vnormal_keep_valid(wo, bent, flat);
        vmask seen = (vdot(wo, bent) > 0.0f) & (vdot(mirrored(wo, bent), flat) > 2e-3f);
        kept += vall(seen);
        vmask above = vdot(wo, flat) > 0.0f; /* rounding may leave it below */
        assert_true(vall(~above | ((own.x == flat.x) & (own.y == flat.y) & (own.z == flat.z))));
        assert_true(vall(~seen | ((got.x == bent.x) & (got.y == bent.y) & (got.z == bent.z))));
    }
    assert_true(kept > 5000);
}

/* The eye at 60 degrees from a floor's normal, and a normal tilted away from it by 40: the mirror
 * direction, at 140 degrees, is lifted to the horizon, and the normal halves what is between. */
TEST(a_normal_is_turned_just_so_far)
{
    const double deg = 3.14159265358979 / 180;
    vvec3 wo         = spread((float)sin(60 * deg), 0, 0.5f);
    vvec3 n          = spread(-(float)sin(40 * deg), 0, (float)cos(40 * deg));
    vvec3 got        = vnormal_keep_valid(wo, n, spread(0, 0, 1));
    double lifted    = atan2(-sin(140 * deg), (double)NORMAL_LEAST_RISE);
    double half      = 0.5 * (60 * deg + lifted);
    assert_near(lane(got.x, 0), sin(half), 1e-6);
    assert_near(lane(got.z, 0), cos(half), 1e-6);
    assert_near(lane(got.y, 0), 0.0, 0.0);
    assert_near(lane(mirrored(wo, got).z, 0), cos(lifted), 1e-3);
}

TEST(a_normal_that_looks_away_is_turned_about)
{
    vvec3 wo  = spread(0.6f, 0, 0.8f),
          got = vnormal_keep_valid(wo, spread(0, 0, -1), spread(0, 0, 1));
    assert_near(lane(got.z, 0), 1.0, 1e-6);
}

/* Until the mirror direction is straight down, which has no side to be lifted to. */
TEST(turning_sets_in_without_a_jump)
{
    vvec3 wo = spread(0.8f, 0, 0.6f), before = spread(0, 0, 1);
    for (float tilt = 0.0f; tilt < 1.0f; tilt += 1e-3f) {
        vvec3 got = vnormal_keep_valid(wo, spread(-sinf(tilt), 0, cosf(tilt)), spread(0, 0, 1));
        vvec3 off = vsub(got, before);
        assert_true(lane(vlength(off), 0) < 1.01e-3f); /* never faster than n itself */
        before = got;
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_normal_is_made_one_that_can_be_seen_and_mirrors_upward),
        cmocka_unit_test(normals_that_can_be_seen_stay_to_the_bit),
        cmocka_unit_test(a_normal_is_turned_just_so_far),
        cmocka_unit_test(a_normal_that_looks_away_is_turned_about),
        cmocka_unit_test(turning_sets_in_without_a_jump),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
