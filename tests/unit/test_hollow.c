/* tests/unit/test_hollow.c -- surfaces that shadow rays do not see, and lists of those alone. */
#include "core/world.h"
#include "tests/shapes.h"
#include "tests/test.h"

#include <string.h>

enum { PLACES = 30, OWNERS = 3, BATCH = 256 / LANES, MOST = 24 };

static world *make(arena *a, const mesh *m, const world_instance *in, int count, triangle_test test)
{
    lux_error err = { 0 };
    world *w      = world_new(a, &(world_desc){ m, 1, in, (uint32_t)count, test, 1 }, &err);
    if (!w)
        fail_msg("%s", err.text);
    return w;
}

/* ---- squares in a row ------------------------------------------------------------------------ */

enum { ROW = 6 };

/* Squares across z at 1, 2, 3, ..., each an instance. */
typedef struct row {
    arena a;
    shape s;
    const world *w;
    vray ray; /* up the middle of all */
} row;

static void row_make(row *r, const world_instance kinds[ROW], int count, triangle_test test)
{
    world_instance in[ROW];
    *r         = (row){ 0 };
    uint32_t p = shape_point(&r->s, (vec3){ -1, -1, 0 });
    shape_point(&r->s, (vec3){ 1, -1, 0 });
    shape_point(&r->s, (vec3){ 1, 1, 0 });
    shape_point(&r->s, (vec3){ -1, 1, 0 });
    shape_triangle(&r->s, p, p + 1, p + 2);
    shape_triangle(&r->s, p, p + 2, p + 3);
    for (int i = 0; i < count; i++) {
        in[i]               = kinds[i];
        in[i].place         = TRANSFORM_IDENTITY;
        in[i].place.m[2][3] = i + 1;
    }
    mesh m = shape_mesh(&r->s);
    r->w   = make(&r->a, &m, in, count, test);
    for (int i = 0; i < LANES; i++)
        ray_set(&r->ray, i, (vec3){ 0.3f, 0.1f, 0 }, (vec3){ 0, 0, 1 }, INFINITY);
}

static void row_clear(row *r)
{
    arena_clear(&r->a);
    shape_clear(&r->s);
}

static const world_instance solid = { 0 }, glass = { .hollow = true };

static bool row_blocks(const row *r, int32_t spare, ray_hint hint)
{
    vmask all = ALL_LANES, blocked;
    vint own  = vsplat_int(spare);
    world_any_hit(r->w, &r->ray, &all, spare ? &own : NULL, 1, hint, &blocked);
    assert_true(vall(blocked) || !vany(blocked));
    return vany(blocked);
}

TEST(shadow_rays_pass_what_is_hollow_and_nothing_else)
{
    const world_instance lamp = { .owner = 1 }, shade = { .owner = 1, .hollow = true };
    const struct {
        world_instance kinds[ROW];
        int count;
        int32_t spare;
        bool blocked;
    } cases[] = {
        { { glass }, 1, 0, false },        { { solid }, 1, 0, true },
        { { glass, glass }, 2, 0, false }, { { glass, solid }, 2, 0, true },
        { { solid, glass }, 2, 0, true },  { { glass, solid, glass }, 3, 0, true },
        { { lamp, glass }, 2, 1, false },  { { lamp, glass }, 2, 2, true },
        { { lamp, glass }, 2, 0, true },   { { shade, lamp }, 2, 1, false },
        { { shade }, 1, 0, false },        { { shade }, 1, 2, false },
        { { shade, lamp }, 2, 2, true },   { { shade, solid, lamp }, 3, 1, true },
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++)
        for (int test = TRIANGLE_WATERTIGHT; test <= TRIANGLE_PROJECTION; test++) {
            row r;
            row_make(&r, cases[k].kinds, cases[k].count, (triangle_test)test);
            for (int hint = RAYS_COHERENT; hint <= RAYS_INCOHERENT; hint++)
                assert_int_equal(row_blocks(&r, cases[k].spare, (ray_hint)hint), cases[k].blocked);
            row_clear(&r);
        }
}

/* Solid at 1, 3 and 5: the list has 2, 4 and 6. */
TEST(hollow_hits_go_through_what_is_solid)
{
    const world_instance kinds[ROW] = { solid, glass, solid, glass, solid, glass };
    row r;
    vmask all = ALL_LANES;
    vhit h[4];
    row_make(&r, kinds, ROW, TRIANGLE_WATERTIGHT);
    assert_true(world_hollow_hits(r.w, &r.ray, &all, NULL, 1, 4, h));
    for (int k = 0; k < 4; k++) {
        assert_true(vall(h[k].distance == (k < 3 ? (float)(2 * k + 2) : INFINITY)));
        assert_true(vall(h[k].instance == vsplat_int(k < 3 ? 2 * k + 1 : -1)));
    }
    assert_true(world_hollow_hits(r.w, &r.ray, &all, NULL, 1, 3, h)); /* it just fits */
    assert_false(world_hollow_hits(r.w, &r.ray, &all, NULL, 1, 2, h));
    assert_true(vall(h[0].distance == 2.0f) && vall(h[1].distance == 4.0f));
    assert_false(world_hollow_hits(r.w, &r.ray, &all, NULL, 1, 1, h));
    assert_true(vall(h[0].distance == 2.0f));

    r.ray.reach = vsplat(5.0f);
    assert_true(world_hollow_hits(r.w, &r.ray, &all, NULL, 1, 2, h));
    assert_false(world_all_hits(r.w, &r.ray, &all, 1, 0, h)); /* the others are as they were */
    assert_true(world_all_hits(r.w, &r.ray, &all, 1, 1, h));
    assert_true(vall(h[0].instance == vsplat_int(0)));
    row_clear(&r);
}

TEST(hollow_hits_spare_the_body_of_a_lamp)
{
    const world_instance own        = { .owner = 2, .hollow = true };
    const world_instance kinds[ROW] = { own, glass, solid, own };
    row r;
    vmask all = ALL_LANES;
    vhit h[4];
    row_make(&r, kinds, 4, TRIANGLE_WATERTIGHT);
    for (int32_t spare = 0; spare <= 2; spare++) {
        vint body = vsplat_int(spare);
        assert_true(world_hollow_hits(r.w, &r.ray, &all, &body, 1, 4, h));
        assert_true(vall(h[0].instance == vsplat_int(spare == 2 ? 1 : 0)));
        assert_true(vall(h[2].instance == vsplat_int(spare == 2 ? -1 : 3)));
    }
    row_clear(&r);
}

TEST(where_nothing_is_hollow_the_list_is_empty)
{
    const world_instance kinds[ROW] = { solid, solid, { .owner = 3 } };
    row r;
    vmask all = ALL_LANES;
    vhit h[2];
    row_make(&r, kinds, 3, TRIANGLE_WATERTIGHT);
    assert_true(world_hollow_hits(r.w, &r.ray, &all, NULL, 1, 2, h));
    for (int k = 0; k < 2; k++)
        assert_true(vall(h[k].instance == vsplat_int(-1)) && vall(h[k].distance == INFINITY));
    row_clear(&r);
}

/* ---- against worlds of a part --------------------------------------------------------------- */

/* Spheres of all sizes through each other, every other one hollow; and worlds of the halves.
 * original[]: what number an instance of the hollow half has among all. */
typedef struct fixture {
    arena a;
    shape s;
    world *all, *hollow, *solid;
    int32_t original[PLACES];
} fixture;

static void set_up(fixture *f, triangle_test test, uint32_t seed)
{
    world_instance in[PLACES], half[2][PLACES];
    int count[2] = { 0 };
    *f           = (fixture){ 0 };
    shape_sphere(&f->s, (vec3){ 0, 0, 0 }, 1.0f, 6);
    for (int i = 0; i < PLACES; i++) {
        float size = 0.05f + 0.5f * random_unit(&seed) * random_unit(&seed);
        vec3 at    = random_point(&seed);
        double s   = (double)size;
        bool open  = random_unit(&seed) < 0.5f;
        in[i]      = (world_instance){ .place  = { { { s, 0, 0, (double)at.x },
                                                     { 0, s, 0, (double)at.y },
                                                     { 0, 0, s, (double)at.z } } },
                                       .hollow = open,
                                       .owner  = i % (OWNERS + 1) };
        if (open)
            f->original[count[1]] = i;
        half[open][count[open]++] = in[i];
    }
    mesh m    = shape_mesh(&f->s);
    f->all    = make(&f->a, &m, in, PLACES, test);
    f->solid  = make(&f->a, &m, half[0], count[0], test);
    f->hollow = make(&f->a, &m, half[1], count[1], test);
}

static void tear_down(fixture *f)
{
    arena_clear(&f->a);
    shape_clear(&f->s);
}

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

TEST(a_shadow_is_that_of_the_world_without_hollow_ones)
{
    for (int test = TRIANGLE_WATERTIGHT; test <= TRIANGLE_PROJECTION; test++) {
        fixture f;
        int blocked = 0, passed = 0;
        set_up(&f, (triangle_test)test, 5);
        for (uint32_t seed = 0; seed < 30; seed++) {
            vray rays[BATCH];
            vmask active[BATCH], want[BATCH], got[BATCH];
            vint spare[BATCH];
            random_batch(rays, active, spare, seed);
            for (int hint = RAYS_COHERENT; hint <= RAYS_INCOHERENT; hint++)
                for (int spares = 0; spares < 2; spares++) {
                    const vint *own = spares ? spare : NULL;
                    world_any_hit(f.solid, rays, active, own, BATCH, RAYS_COHERENT, want);
                    world_any_hit(f.all, rays, active, own, BATCH, (ray_hint)hint, got);
                    for (int p = 0; p < BATCH; p++) {
                        assert_int_equal(vbits(got[p]), vbits(want[p]));
                        blocked += __builtin_popcount((unsigned)vbits(got[p]));
                        passed += __builtin_popcount((unsigned)vbits(active[p] & ~got[p]));
                    }
                }
        }
        assert_true(blocked > 3000 && passed > 3000);
        tear_down(&f);
    }
}

/* What lists every hit of the hollow half, to the bit, at each length of the list. */
TEST(hollow_hits_are_all_hits_of_the_world_of_hollow_ones)
{
    for (int test = TRIANGLE_WATERTIGHT; test <= TRIANGLE_PROJECTION; test++) {
        fixture f;
        int found = 0, full = 0;
        set_up(&f, (triangle_test)test, 6);
        for (uint32_t seed = 0; seed < 20; seed++) {
            static vhit want[BATCH * MOST], got[BATCH * MOST];
            vray rays[BATCH];
            vmask active[BATCH];
            vint spare[BATCH];
            random_batch(rays, active, spare, seed);
            int most  = seed % 2 ? MOST : 1 + (int)seed / 6;
            bool fits = world_all_hits(f.hollow, rays, active, BATCH, most, want);
            assert_int_equal(world_hollow_hits(f.all, rays, active, NULL, BATCH, most, got), fits);
            full += !fits;
            for (int k = 0; k < BATCH * most; k++) {
                int32_t number[LANES];
                for (int i = 0; i < LANES; i++) {
                    int32_t half = lane(want[k].instance, i);
                    number[i]    = half < 0 ? -1 : f.original[half];
                    found += half >= 0;
                    assert_true(half < 0 || vbits(active[k / most]) >> i & 1);
                }
                want[k].instance = vload_int(number);
                assert_memory_equal(&got[k], &want[k], sizeof got[k]);
            }
        }
        assert_true(found > 1500 && full > 3);
        tear_down(&f);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shadow_rays_pass_what_is_hollow_and_nothing_else),
        cmocka_unit_test(hollow_hits_go_through_what_is_solid),
        cmocka_unit_test(hollow_hits_spare_the_body_of_a_lamp),
        cmocka_unit_test(where_nothing_is_hollow_the_list_is_empty),
        cmocka_unit_test(a_shadow_is_that_of_the_world_without_hollow_ones),
        cmocka_unit_test(hollow_hits_are_all_hits_of_the_world_of_hollow_ones),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
