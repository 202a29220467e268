/* tests/unit/test_spare.c -- shadow rays that do not see the body that their light leaves. */
#include "core/world.h"
#include "tests/shapes.h"
#include "tests/test.h"

#include <string.h>

enum { OWNERS = 4, PLACES = 24, BATCH = 256 / LANES };

static world *make(arena *a, const mesh *m, const world_instance *in, int count, triangle_test test)
{
    lux_error err = { 0 };
    world *w      = world_new(a, &(world_desc){ m, 1, in, (uint32_t)count, test, 1 }, &err);
    if (!w)
        fail_msg("%s", err.text);
    return w;
}

static world_instance placed_at(vec3 p, float size, int32_t owner)
{
    double s = (double)size;
    return (world_instance){ .place = { { { s, 0, 0, (double)p.x },
                                          { 0, s, 0, (double)p.y },
                                          { 0, 0, s, (double)p.z } } },
                             .owner = owner };
}

/* ---- boxes in a row -------------------------------------------------------------------------- */

/* Whether a ray along x, past boxes of these owners at x = 0, 1, 2, ..., is blocked. */
static bool blocked_by(const int32_t *owners, int count, int32_t spare, triangle_test test,
                       ray_hint hint)
{
    shape s = { 0 };
    arena a = { 0 };
    world_instance in[OWNERS];
    shape_box(&s, (vec3){ -0.3f, -0.3f, -0.3f }, (vec3){ 0.3f, 0.3f, 0.3f }, 1);
    for (int i = 0; i < count; i++)
        in[i] = placed_at((vec3){ (float)i, 0, 0 }, 1.0f, owners[i]);
    mesh m         = shape_mesh(&s);
    const world *w = make(&a, &m, in, count, test);

    vray r      = { 0 };
    vmask all   = ALL_LANES, blocked;
    vint spared = vsplat_int(spare);
    for (int i = 0; i < LANES; i++)
        ray_set(&r, i, (vec3){ -1.0f, 0.05f, 0.1f }, (vec3){ 1, 0, 0 }, INFINITY);
    world_any_hit(w, &r, &all, &spared, 1, hint, &blocked);
    assert_true(vall(blocked) || !vany(blocked));
    arena_clear(&a);
    shape_clear(&s);
    return vany(blocked);
}

TEST(a_ray_passes_the_body_that_it_is_spared_and_no_other)
{
    static const int32_t ones[] = { 1, 1, 1 }, mixed[] = { 1, 0, 1 }, two[] = { 1, 2, 1 };
    for (int test = TRIANGLE_WATERTIGHT; test <= TRIANGLE_PROJECTION; test++)
        for (int hint = RAYS_COHERENT; hint <= RAYS_INCOHERENT; hint++) {
            triangle_test t = (triangle_test)test;
            ray_hint h      = (ray_hint)hint;
            for (int count = 1; count <= 3; count++) { /* 1: the upper tree is one leaf */
                assert_false(blocked_by(ones, count, 1, t, h));
                assert_true(blocked_by(ones, count, 2, t, h));
                assert_true(blocked_by(ones, count, 0, t, h));
            }
            assert_true(blocked_by(mixed, 3, 1, t, h));
            assert_true(blocked_by(mixed, 3, 0, t, h)); /* 0 spares nobody's, too: nothing */
            assert_true(blocked_by(mixed + 1, 1, 0, t, h));
            assert_true(blocked_by(two, 3, 1, t, h));
            assert_true(blocked_by(two, 3, 2, t, h));
        }
}

/* ---- against worlds without the body --------------------------------------------------------- */

/* Spheres of all sizes through each other, owned by 0 ... OWNERS - 1; and for each owner the world
 * without its own. Large ones lie in many leaves of the upper tree. */
typedef struct fixture {
    arena a;
    shape s;
    world *all, *without[OWNERS];
} fixture;

static void set_up(fixture *f, triangle_test test, uint32_t seed)
{
    world_instance in[PLACES], left[PLACES];
    *f = (fixture){ 0 };
    shape_sphere(&f->s, (vec3){ 0, 0, 0 }, 1.0f, 6);
    mesh m = shape_mesh(&f->s);
    for (int i = 0; i < PLACES; i++) {
        float size = 0.05f + 0.45f * random_unit(&seed) * random_unit(&seed);
        in[i]      = placed_at(random_point(&seed), size, i % OWNERS);
    }
    f->all = make(&f->a, &m, in, PLACES, test);
    for (int32_t owner = 0; owner < OWNERS; owner++) {
        int count = 0;
        for (int i = 0; i < PLACES; i++)
            if (owner == 0 || in[i].owner != owner)
                left[count++] = in[i];
        f->without[owner] = make(&f->a, &m, left, count, test);
    }
}

static void tear_down(fixture *f)
{
    arena_clear(&f->a);
    shape_clear(&f->s);
}

/* Lanes go anywhere, spare anyone (or, of no owner, nothing), and one in five is dead. */
static void random_batch(vray *rays, vmask *active, vint *spare, uint32_t seed)
{
    memset(rays, 0, BATCH * sizeof *rays);
    for (int p = 0; p < BATCH; p++) {
        int32_t owner[LANES];
        active[p] = ~ALL_LANES;
        for (int i = 0; i < LANES; i++) {
            vec3 o   = random_point(&seed);
            vec3 d   = random_direction(&seed);
            float to = random_unit(&seed) < 0.5f ? INFINITY : 0.2f + random_unit(&seed);
            ray_set(&rays[p], i, o, d, to);
            owner[i] = (int32_t)(random_unit(&seed) * (OWNERS + 1.0f));
            if (random_unit(&seed) < 0.8f)
                active[p] |= vlane_index() == vsplat_int(i);
        }
        spare[p] = vload_int(owner);
    }
}

/* The rays that meet something in the world without the body that they are spared. */
static void expect_blocked(const fixture *f, const vray *rays, const vmask *active,
                           const vint *spare, vmask *want)
{
    memset(want, 0, BATCH * sizeof *want);
    for (int32_t owner = 0; owner <= OWNERS; owner++) {
        const world *w = owner < OWNERS ? f->without[owner] : f->all;
        vmask asked[BATCH];
        vhit hits[BATCH];
        for (int p = 0; p < BATCH; p++)
            asked[p] = active[p] & (spare[p] == vsplat_int(owner));
        world_first_hit(w, rays, asked, BATCH, RAYS_COHERENT, hits);
        for (int p = 0; p < BATCH; p++)
            want[p] |= hits[p].instance >= vsplat_int(0);
    }
}

static void compare_with_worlds_without(triangle_test test)
{
    fixture f;
    vray rays[BATCH];
    vmask active[BATCH], want[BATCH], got[BATCH], plain[BATCH];
    vint spare[BATCH];
    int differ = 0;
    for (uint32_t seed = 1; seed <= 12; seed++) {
        set_up(&f, test, seed);
        random_batch(rays, active, spare, seed);
        expect_blocked(&f, rays, active, spare, want);
        world_any_hit(f.all, rays, active, NULL, BATCH, RAYS_COHERENT, plain);
        for (int hint = RAYS_COHERENT; hint <= RAYS_INCOHERENT; hint++) {
            world_any_hit(f.all, rays, active, spare, BATCH, (ray_hint)hint, got);
            for (int p = 0; p < BATCH; p++) {
                assert_int_equal(vbits(got[p]), vbits(want[p]));
                differ += __builtin_popcount((unsigned)(vbits(got[p]) ^ vbits(plain[p])));
            }
        }
        tear_down(&f);
    }
    assert_true(differ > 100); /* or else nothing was tested */
}

TEST(mixed_lanes_see_the_world_without_their_own_body)
{
    compare_with_worlds_without(TRIANGLE_WATERTIGHT);
}

TEST(so_do_they_by_the_projection_test) { compare_with_worlds_without(TRIANGLE_PROJECTION); }

TEST(sparing_nobody_is_asking_for_any_hit)
{
    fixture f;
    vray rays[BATCH];
    vmask active[BATCH], none[BATCH], zero[BATCH];
    vint spare[BATCH];
    vhit hits[BATCH];
    set_up(&f, TRIANGLE_WATERTIGHT, 5);
    random_batch(rays, active, spare, 5);
    for (int p = 0; p < BATCH; p++)
        spare[p] = vsplat_int(0);
    for (int hint = RAYS_COHERENT; hint <= RAYS_INCOHERENT; hint++) {
        world_any_hit(f.all, rays, active, NULL, BATCH, (ray_hint)hint, none);
        world_any_hit(f.all, rays, active, spare, BATCH, (ray_hint)hint, zero);
        world_first_hit(f.all, rays, active, BATCH, (ray_hint)hint,
                        hits); /* owners do not matter */
        for (int p = 0; p < BATCH; p++) {
            assert_int_equal(vbits(none[p]), vbits(zero[p]));
            assert_int_equal(vbits(none[p]), vbits(hits[p].instance >= vsplat_int(0)));
        }
    }
    tear_down(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_ray_passes_the_body_that_it_is_spared_and_no_other),
        cmocka_unit_test(mixed_lanes_see_the_world_without_their_own_body),
        cmocka_unit_test(so_do_they_by_the_projection_test),
        cmocka_unit_test(sparing_nobody_is_asking_for_any_hit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
