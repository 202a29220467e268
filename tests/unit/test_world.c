/* tests/unit/test_world.c -- the BSP against testing everything, placing, masks, lists, ties. */
#include "core/world.h"
#include "tests/shapes.h"
#include "tests/test.h"

#include <string.h>

static world *make(arena *a, const world_desc *d)
{
    lux_error err = { 0 };
    world *w      = world_new(a, d, &err);
    if (!w)
        fail_msg("%s", err.text);
    return w;
}

static bool same_bits(const void *a, const void *b, size_t size) { return !memcmp(a, b, size); }

/* A ray from anywhere about to anywhere, some along an axis, some of short reach. */
static void random_ray(vray *r, int i, uint32_t *seed)
{
    vec3 o     = { 3.0f * random_unit(seed) - 1.5f, 3.0f * random_unit(seed) - 1.5f,
                   3.0f * random_unit(seed) - 1.5f };
    vec3 d     = random_direction(seed);
    float kind = random_unit(seed), reach = random_unit(seed) < 0.2f ? random_unit(seed) : INFINITY;
    if (kind < 0.05f)
        d = (vec3){ d.x < 0.0f ? -1.0f : 1.0f, 0.0f, -0.0f };
    else if (kind < 0.1f)
        d = (vec3){ 0.0f, d.y < 0.0f ? -1.0f : 1.0f, 0.0f };
    else if (kind < 0.15f)
        d = (vec3){ -0.0f, -0.0f, d.z < 0.0f ? -1.0f : 1.0f };
    ray_set(r, i, o, d, reach + 1e-6f);
}

static int compare_with_brute_force(const world_desc *d, const world *w, int rays, uint32_t seed)
{
    int hits = 0;
    for (int n = 0; n < rays; n += LANES) {
        vray r = { 0 };
        for (int i = 0; i < LANES; i++)
            random_ray(&r, i, &seed);
        vmask all = ALL_LANES, blocked;
        vhit want = brute_first(d, &r, all), got, apart;
        world_first_hit(w, &r, &all, 1, RAYS_COHERENT, &got);
        world_first_hit(w, &r, &all, 1, RAYS_INCOHERENT, &apart);
        assert_true(same_bits(&got, &apart, sizeof got));
        for (int i = 0; i < LANES; i++) {
            assert_int_equal(lane(got.triangle, i), lane(want.triangle, i));
            assert_int_equal(lane(got.instance, i), lane(want.instance, i));
            assert_true(lane(got.distance, i) == lane(want.distance, i));
            hits += lane(got.instance, i) >= 0;
        }
        int met = vbits(want.instance >= vsplat_int(0));
        world_any_hit(w, &r, &all, 1, RAYS_COHERENT, &blocked);
        assert_int_equal(vbits(blocked), met);
        world_any_hit(w, &r, &all, 1, RAYS_INCOHERENT, &blocked);
        assert_int_equal(vbits(blocked), met);
    }
    return hits;
}

static const world_instance one_instance = { .place = TRANSFORM_IDENTITY };

TEST(rays_find_in_a_soup_what_testing_everything_finds)
{
    arena a = { 0 };
    shape s = { 0 };
    shape_soup(&s, 300, 0.5f, 1);
    mesh m       = shape_mesh(&s);
    world_desc d = { &m, 1, &one_instance, 1, TRIANGLE_WATERTIGHT, 1 };
    int hits     = compare_with_brute_force(&d, make(&a, &d), 60000, 2);
    assert_true(hits > 10000);
    shape_clear(&s);
    arena_clear(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays_find_in_a_soup_what_testing_everything_finds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
