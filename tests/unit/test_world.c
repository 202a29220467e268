/* tests/unit/test_world.c -- rays against testing everything; placing, masks, lists, ties. */
#include "core/world.h"
#include "tests/shapes.h"
#include "tests/test.h"

#include <stdlib.h>
#include <string.h>

static world *make(arena *a, const world_desc *d)
{
    lux_error err = { 0 };
    world *w      = world_new(a, d, &err);
    if (!w)
        fail_msg("%s", err.text);
    return w;
}

static const world_instance once = { .place = TRANSFORM_IDENTITY };

/* A world of one shape, placed once as it is. */
typedef struct fixture {
    arena a;
    mesh m;
    world_desc d;
    world *w;
} fixture;

static void set_up(fixture *f, const shape *s)
{
    *f   = (fixture){ .m = shape_mesh(s) };
    f->d = (world_desc){ &f->m, 1, &once, 1, TRIANGLE_WATERTIGHT, 1 };
    f->w = make(&f->a, &f->d);
}

static void tear_down(fixture *f, shape *s)
{
    arena_clear(&f->a);
    shape_clear(s);
}

static bool same_bits(const void *a, const void *b, size_t size) { return !memcmp(a, b, size); }

static vhit one_hit_of(const world *w, vec3 o, vec3 d, float reach)
{
    vray r    = { 0 };
    vmask all = ALL_LANES;
    vhit h;
    for (int i = 0; i < LANES; i++)
        ray_set(&r, i, o, d, reach);
    world_first_hit(w, &r, &all, 1, RAYS_COHERENT, &h);
    return h;
}

/* ---- against testing everything -------------------------------------------------------------- */

/* From anywhere about to anywhere; one in seven along an axis, with zeros of both signs; one in
 * five of short reach; one in ten from where planes of cells meet. */
static void random_ray(vray *r, int i, uint32_t *seed)
{
    vec3 o     = v3_scale(random_point(seed), 1.5f);
    vec3 d     = random_direction(seed);
    float kind = random_unit(seed), from = random_unit(seed), reach = random_unit(seed);
    if (kind < 0.05f)
        d = (vec3){ d.x < 0.0f ? -1.0f : 1.0f, 0.0f, -0.0f };
    else if (kind < 0.1f)
        d = (vec3){ 0.0f, d.y < 0.0f ? -1.0f : 1.0f, 0.0f };
    else if (kind < 0.15f)
        d = (vec3){ -0.0f, -0.0f, d.z < 0.0f ? -1.0f : 1.0f };
    if (from < 0.1f)
        o = (vec3){ 0.25f * roundf(4.0f * o.x), 0.25f * roundf(4.0f * o.y),
                    0.25f * roundf(4.0f * o.z) };
    ray_set(r, i, o, d, reach < 0.2f ? 5.0f * reach + 1e-6f : INFINITY);
}

static int compare_with_brute_force(const fixture *f, int rays, uint32_t seed)
{
    int hits = 0;
    for (int n = 0; n < rays; n += LANES) {
        vray r    = { 0 };
        vmask all = ALL_LANES, blocked;
        vhit got;
        for (int i = 0; i < LANES; i++)
            random_ray(&r, i, &seed);
        vhit want = brute_first(&f->d, &r, all);
        world_first_hit(f->w, &r, &all, 1, RAYS_COHERENT, &got);
        assert_true(same_bits(&got.triangle, &want.triangle, sizeof got.triangle));
        assert_true(same_bits(&got.instance, &want.instance, sizeof got.instance));
        assert_true(same_bits(&got.distance, &want.distance, sizeof got.distance));
        assert_true(same_bits(&got.u, &want.u, sizeof got.u));
        assert_true(same_bits(&got.v, &want.v, sizeof got.v));

        int met = vbits(want.instance >= vsplat_int(0));
        world_any_hit(f->w, &r, &all, NULL, 1, RAYS_COHERENT, &blocked);
        assert_int_equal(vbits(blocked), met);
        hits += __builtin_popcount((unsigned)met);
    }
    return hits;
}

TEST(rays_meet_in_a_soup_what_testing_everything_meets)
{
    shape s = { 0 };
    fixture f;
    shape_soup(&s, 250, 0.5f, 1);
    set_up(&f, &s);
    assert_true(compare_with_brute_force(&f, 60000, 2) > 10000);
    tear_down(&f, &s);
}

TEST(rays_meet_in_flat_and_square_things_what_testing_everything_meets)
{
    shape s = { 0 };
    fixture f;
    shape_box(&s, (vec3){ -1, -1, -1 }, (vec3){ 1, 1, 1 }, 4);
    shape_box(&s, (vec3){ -0.5f, -0.5f, -0.25f }, (vec3){ 0.5f, 0.5f, -0.25f }, 2); /* flat */
    shape_sphere(&s, (vec3){ 0.1f, 0.2f, 0.3f }, 0.3f, 6);
    set_up(&f, &s);
    assert_true(compare_with_brute_force(&f, 40000, 3) > 15000);
    tear_down(&f, &s);
}

static const transform places[] = {
    { { { -1, 0, 0, 0.5 }, { 0, 1, 0, 0.1 }, { 0, 0, 1, 0.2 } } },           /* mirrored */
    { { { 0.3, 0.4, 0, -0.5 }, { 0, 0.5, 0.1, 0.3 }, { 0.2, 0, 0.6, 0 } } }, /* sheared */
    { { { 0, -0.02, 0, 0 }, { 3, 0, 0, 0.4 }, { 0, 0, 0.5, -0.7 } } },       /* turned, stretched */
    { { { 0.7, 0, 0, 0 }, { 0, 0.7, 0, 0 }, { 0, 0, -0.7, 0 } } },
};
enum { PLACES = sizeof places / sizeof *places, MANY = 3 * PLACES };

/* Two meshes in many places, each place again inside of itself. */
static void set_up_places(fixture *f, shape s[2], mesh m[2], world_instance i[MANY])
{
    *f = (fixture){ 0 };
    shape_soup(&s[0], 40, 0.7f, 5);
    shape_sphere(&s[1], (vec3){ 0.5f, 0.1f, 0 }, 0.4f, 4);
    for (int k = 0; k < MANY; k++) {
        transform t = places[k % PLACES];
        if (k >= PLACES)
            t = transform_product(&t, &places[(k + k / PLACES) % PLACES]);
        i[k] = (world_instance){ .mesh = (uint32_t)k % 2, .place = t };
    }
    m[0] = shape_mesh(&s[0]);
    m[1] = shape_mesh(&s[1]);
    f->d = (world_desc){ m, 2, i, MANY, TRIANGLE_WATERTIGHT, 1 };
    f->w = make(&f->a, &f->d);
}

TEST(rays_meet_in_many_places_what_testing_everything_meets)
{
    shape s[2] = { { 0 } };
    mesh m[2];
    world_instance i[MANY];
    fixture f;
    set_up_places(&f, s, m, i);
    assert_true(compare_with_brute_force(&f, 40000, 6) > 5000);
    tear_down(&f, &s[0]);
    shape_clear(&s[1]);
}

/* Placing by matrix is placing the corners: same triangles at the same distance, to rounding
 * (1e-5: some 20 roundings of coordinates of about 1, seen at up to 80 degrees). A ray within
 * rounding of an edge may go either way: one in 10,000. */
TEST(a_placed_mesh_is_met_where_its_moved_corners_are)
{
    shape s = { 0 }, moved = { 0 };
    shape_torus(&s, (vec3){ 0.2f, 0, 0 }, 0.6f, 0.25f, 8);
    for (int k = 0; k < PLACES; k++) {
        world_instance i = { .place = places[k] };
        arena a          = { 0 };
        mesh m           = shape_mesh(&s);
        world *w         = make(&a, &(world_desc){ &m, 1, &i, 1, TRIANGLE_WATERTIGHT, 1 });

        fixture f;
        shape_torus(&moved, (vec3){ 0.2f, 0, 0 }, 0.6f, 0.25f, 8);
        for (uint32_t p = 0; p < moved.position_count; p++)
            moved.positions[p] =
                d3_to_float(transform_point(&places[k], d3_from(moved.positions[p])));
        set_up(&f, &moved);

        int other = 0, hits = 0;
        uint32_t seed = 8;
        for (int n = 0; n < 10000; n++) {
            vec3 o  = v3_scale(random_direction(&seed), 2.0f);
            vec3 to = random_direction(&seed);
            vec3 d  = { 0.3f * to.x - o.x, 0.3f * to.y - o.y, 0.3f * to.z - o.z };
            d       = v3_scale(d, 1.0f / v3_length(d));
            vhit x = one_hit_of(w, o, d, INFINITY), y = one_hit_of(f.w, o, d, INFINITY);
            hits += lane(y.instance, 0) >= 0;
            if (lane(x.triangle, 0) != lane(y.triangle, 0))
                other++;
            else if (lane(y.instance, 0) >= 0)
                assert_near(lane(x.distance, 0), lane(y.distance, 0), 1e-4);
        }
        assert_true(hits > 100 && other <= 5);
        tear_down(&f, &moved);
        arena_clear(&a);
    }
    shape_clear(&s);
}

/* Two ways to where a hit is, in double precision: along the ray, and by the corners. They meet
 * within 1e-5: some 20 roundings of coordinates up to 4, of rays up to 85 degrees aslant. */
TEST(distance_and_weights_name_the_same_point)
{
    shape s       = { 0 };
    uint32_t seed = 31;
    int hits      = 0;
    fixture f;
    shape_soup(&s, 300, 0.8f, 30);
    set_up(&f, &s);
    for (int n = 0; n < 20000; n++) {
        vec3 o = v3_scale(random_point(&seed), 2.0f);
        vec3 d = random_direction(&seed);
        vhit h = one_hit_of(f.w, o, d, INFINITY);
        if (lane(h.instance, 0) < 0)
            continue;
        dvec3 p[3], v = d3_from(d);
        for (uint32_t k = 0; k < 3; k++)
            p[k] = d3_from(s.positions[s.corners[3 * (uint32_t)lane(h.triangle, 0) + k]]);
        dvec3 a = d3_sub(p[1], p[0]), b = d3_sub(p[2], p[0]), across = d3_cross(a, b);
        if (fabs(d3_dot(across, v)) < 0.09 * d3_length(across) ||
            d3_length(across) < 0.1 * d3_length(a) * d3_length(b))
            continue;
        dvec3 at = d3_add(
            p[0], d3_add(d3_scale(a, (double)lane(h.u, 0)), d3_scale(b, (double)lane(h.v, 0))));
        dvec3 on = d3_add(d3_from(o), d3_scale(v, (double)lane(h.distance, 0)));
        assert_true(d3_length(d3_sub(at, on)) < 1e-5);
        hits++;
    }
    assert_true(hits > 2000);
    tear_down(&f, &s);
}

/* ---- batches, hints, masks ------------------------------------------------------------------- */

enum { BATCH = 400 / LANES };

static void random_batch(vray rays[BATCH], vmask active[BATCH], uint32_t seed)
{
    memset(rays, 0, BATCH * sizeof *rays);
    for (int p = 0; p < BATCH; p++) {
        active[p] = ~ALL_LANES;
        for (int i = 0; i < LANES; i++) {
            random_ray(&rays[p], i, &seed);
            if (random_unit(&seed) < 0.7f)
                active[p] |= vlane_index() == vsplat_int(i);
        }
    }
}

TEST(hints_and_batches_change_no_bit)
{
    shape s[2] = { { 0 } };
    mesh m[2];
    world_instance inst[MANY];
    fixture f;
    vray rays[BATCH];
    vmask active[BATCH], x[BATCH], y[BATCH];
    vhit a[BATCH], b[BATCH], c;
    set_up_places(&f, s, m, inst);
    for (uint32_t seed = 0; seed < 20; seed++) {
        random_batch(rays, active, seed);
        world_first_hit(f.w, rays, active, BATCH, RAYS_COHERENT, a);
        world_first_hit(f.w, rays, active, BATCH, RAYS_INCOHERENT, b);
        world_any_hit(f.w, rays, active, NULL, BATCH, RAYS_COHERENT, x);
        world_any_hit(f.w, rays, active, NULL, BATCH, RAYS_INCOHERENT, y);
        assert_true(same_bits(a, b, sizeof a));
        for (int p = 0; p < BATCH; p++) {
            assert_int_equal(vbits(x[p]), vbits(y[p]));
            assert_int_equal(vbits(x[p]), vbits(a[p].instance >= vsplat_int(0)));
            world_first_hit(f.w, &rays[p], &active[p], 1, RAYS_INCOHERENT, &c);
            assert_true(same_bits(&a[p], &c, sizeof c));
        }
    }
    tear_down(&f, &s[0]);
    shape_clear(&s[1]);
}

TEST(dead_lanes_are_misses_whatever_they_hold)
{
    shape s = { 0 };
    fixture f;
    vray rays[BATCH];
    vmask active[BATCH], blocked[BATCH];
    vhit hits[BATCH], all[2];
    shape_box(&s, (vec3){ -2, -2, -2 }, (vec3){ 2, 2, 2 }, 1);
    set_up(&f, &s);
    random_batch(rays, active, 1);
    for (int hint = RAYS_COHERENT; hint <= RAYS_INCOHERENT; hint++) {
        for (int p = 0; p < BATCH; p++)
            for (int i = 0; i < LANES; i++)
                if (!(vbits(active[p]) >> i & 1))
                    ray_set(&rays[p], i, (vec3){ NAN, 1, INFINITY }, (vec3){ 0, NAN, 0 }, NAN);
        world_first_hit(f.w, rays, active, BATCH, (ray_hint)hint, hits);
        world_any_hit(f.w, rays, active, NULL, BATCH, (ray_hint)hint, blocked);
        for (int p = 0; p < BATCH; p++)
            for (int i = 0; i < LANES; i++) {
                bool dead = !(vbits(active[p]) >> i & 1);
                assert_true(!dead || lane(hits[p].instance, i) == -1);
                assert_true(!dead || lane(hits[p].distance, i) == INFINITY);
                assert_true(!dead || !(vbits(blocked[p]) >> i & 1));
                assert_true(dead || lane(rays[p].reach, i) < 6.0f ||
                            lane(hits[p].instance, i) == 0);
            }
        world_all_hits(f.w, rays, active, 1, 2, all);
        assert_int_equal(vbits(all[0].instance >= vsplat_int(0)) & ~vbits(active[0]), 0);
    }
    tear_down(&f, &s);
}

/* ---- equal distances, and the ends of rays --------------------------------------------------- */

static void flat_square(shape *s, float z)
{
    uint32_t p = shape_point(s, (vec3){ -1, -1, z });
    shape_point(s, (vec3){ 1, -1, z });
    shape_point(s, (vec3){ 1, 1, z });
    shape_point(s, (vec3){ -1, 1, z });
    shape_triangle(s, p, p + 1, p + 2);
    shape_triangle(s, p, p + 2, p + 3);
}

TEST(of_equals_the_lower_instance_then_the_lower_triangle_is_met)
{
    shape s = { 0 };
    for (int i = 0; i < 10000; i++)
        flat_square(&s, 1.0f);
    world_instance i[3] = { once, once, once };
    arena a             = { 0 };
    mesh m              = shape_mesh(&s);
    world *w            = make(&a, &(world_desc){ &m, 1, i, 3, TRIANGLE_WATERTIGHT, 2 });
    for (int n = 0; n < 8; n++) {
        float x = 0.11f * (float)n;
        vhit h  = one_hit_of(w, (vec3){ x, 0.05f, 0 }, (vec3){ 0, 0, 1 }, INFINITY);
        assert_true(vall(h.instance == vsplat_int(0)));
        assert_true(vall(h.triangle == vsplat_int(x > 0.05f ? 0 : 1)));
        assert_true(vall(h.distance == 1.0f));
    }
    arena_clear(&a);
    shape_clear(&s);
}

/* Instance 1 reaches farther down, and so is walked through before instance 0 is come to. */
TEST(the_lower_instance_is_met_even_if_it_is_tried_later)
{
    shape s[2] = { { 0 } };
    flat_square(&s[0], 1.0f);
    flat_square(&s[1], 1.0f);
    flat_square(&s[1], -3.0f);
    for (uint32_t k = 4; k < 8; k++)
        s[1].positions[k].x += 4.0f;
    mesh m[2]           = { shape_mesh(&s[0]), shape_mesh(&s[1]) };
    world_instance i[2] = { { .mesh = 0, .place = TRANSFORM_IDENTITY },
                            { .mesh = 1, .place = TRANSFORM_IDENTITY } };
    arena a             = { 0 };
    world *w            = make(&a, &(world_desc){ m, 2, i, 2, TRIANGLE_WATERTIGHT, 1 });
    for (int n = 0; n < 8; n++) {
        vec3 o = { 0.11f * (float)n, 0.05f, -5.0f };
        vhit h = one_hit_of(w, o, (vec3){ 0, 0, 1 }, INFINITY);
        assert_true(vall(h.instance == vsplat_int(0)));
    }
    arena_clear(&a);
    shape_clear(&s[0]);
    shape_clear(&s[1]);
}

TEST(a_ray_ends_before_its_reach_and_begins_behind_its_origin)
{
    shape s = { 0 };
    fixture f;
    vec3 up = { 0, 0, 1 };
    flat_square(&s, 1.0f);
    set_up(&f, &s);
    assert_true(vall(one_hit_of(f.w, (vec3){ 0.1f, 0.2f, 0 }, up, 1.0f).instance < vsplat_int(0)));
    assert_true(
        vall(one_hit_of(f.w, (vec3){ 0.1f, 0.2f, 0 }, up, nextafterf(1.0f, 2.0f)).instance ==
             vsplat_int(0)));
    assert_true(vall(one_hit_of(f.w, (vec3){ 0.1f, 0.2f, 1 }, up, 9.0f).instance < vsplat_int(0)));
    assert_true(vall(one_hit_of(f.w, (vec3){ 0.1f, 0.2f, 2 }, up, 9.0f).instance < vsplat_int(0)));
    vhit h = one_hit_of(f.w, (vec3){ 0.5f, -0.25f, 0 }, up, INFINITY);
    assert_true(vall(h.triangle == vsplat_int(0)));
    assert_near(lane(h.u, 0), 0.375, 1e-6); /* (0.5, -0.25) = -1 + 2 (u + v), -1 + 2 v */
    assert_near(lane(h.v, 0), 0.375, 1e-6);
    tear_down(&f, &s);
}

/* ---- all hits -------------------------------------------------------------------------------- */

enum { PANES = 20 };

TEST(all_hits_come_in_order_up_to_the_first_that_is_not_hollow)
{
    shape glass = { 0 }, wall = { 0 };
    for (int i = 0; i < PANES; i++)
        flat_square(&glass, (float)((i * 7) % PANES + 1)); /* 1 to 20, in no order */
    flat_square(&wall, 0.0f);
    world_instance i[2] = { { .mesh = 0, .place = TRANSFORM_IDENTITY, .hollow = true },
                            { .mesh = 1, .place = TRANSFORM_IDENTITY } };
    i[1].place.m[2][3]  = 5.5;
    mesh m[2]           = { shape_mesh(&glass), shape_mesh(&wall) };
    arena a             = { 0 };
    world *w            = make(&a, &(world_desc){ m, 2, i, 2, TRIANGLE_WATERTIGHT, 1 });

    vray r    = { 0 };
    vmask all = ALL_LANES;
    vhit h[8];
    for (int k = 0; k < LANES; k++)
        ray_set(&r, k, (vec3){ 0.1f * (float)k, 0.25f, 0 }, (vec3){ 0, 0, 1 }, INFINITY);
    assert_true(world_all_hits(w, &r, &all, 1, 8, h));
    for (int k = 0; k < 8; k++) {
        float want = k < 5 ? (float)(k + 1) : k == 5 ? 5.5f : INFINITY;
        assert_true(vall((vabs(h[k].distance - want) < 1e-5f) | (h[k].distance == want)));
        assert_true(vall(h[k].instance == vsplat_int(k < 5 ? 0 : k == 5 ? 1 : -1)));
    }
    assert_true(world_all_hits(w, &r, &all, 1, 6, h)); /* it just fits */
    assert_false(world_all_hits(w, &r, &all, 1, 5, h));
    for (int k = 0; k < 5; k++)
        assert_true(vall(vabs(h[k].distance - (float)(k + 1)) < 1e-5f));
    assert_false(world_all_hits(w, &r, &all, 1, 1, h));
    assert_true(vall(vabs(h[0].distance - 1.0f) < 1e-5f));

    vhit every[PANES + 2]; /* the wall, too, is gone through */
    assert_true(world_every_hit(w, &r, &all, 1, PANES + 2, every));
    for (int k = 0; k < PANES + 2; k++) {
        bool wall_hit = k == 5, none = k == PANES + 1;
        assert_true(vall(every[k].instance == vsplat_int(none ? -1 : wall_hit ? 1 : 0)));
    }

    r.reach = vsplat(3.5f);
    assert_true(world_all_hits(w, &r, &all, 1, 3, h));
    arena_clear(&a);
    shape_clear(&glass);
    shape_clear(&wall);
}

/* The k-th of all hits is the first hit behind those before it. */
TEST(all_hits_of_a_soup_are_first_hits_one_behind_the_other)
{
    shape s = { 0 };
    shape_soup(&s, 300, 0.6f, 9);
    world_instance i = { .place = TRANSFORM_IDENTITY, .hollow = true };
    mesh m           = shape_mesh(&s);
    arena a          = { 0 };
    world *w         = make(&a, &(world_desc){ &m, 1, &i, 1, TRIANGLE_WATERTIGHT, 1 });
    uint32_t seed    = 4;
    for (int n = 0; n < 500; n++) {
        vray r = { 0 };
        for (int k = 0; k < LANES; k++)
            random_ray(&r, k, &seed);
        vmask all = ALL_LANES;
        vhit h[64], first;
        assert_true(world_all_hits(w, &r, &all, 1, 64, h));
        world_first_hit(w, &r, &all, 1, RAYS_COHERENT, &first);
        assert_true(same_bits(&first, &h[0], sizeof first));
        for (int k = 1; k < 64; k++) {
            assert_true(vall((h[k].distance >= h[k - 1].distance)));
            assert_true(
                vall((h[k].triangle != h[k - 1].triangle) | (h[k].instance < vsplat_int(0))));
        }
    }
    arena_clear(&a);
    shape_clear(&s);
}

/* ---- what a hit is --------------------------------------------------------------------------- */

/* Corners counter-clockwise from above: the front looks up, and where the matrix takes that. */
TEST(a_normal_points_to_the_image_of_the_front)
{
    shape s = { 0 };
    flat_square(&s, 0.0f);
    mesh m                 = shape_mesh(&s);
    uint32_t material[2]   = { 7, 9 };
    m.material             = material;
    const transform upside = { { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, -1, 3 } } };
    const transform mirror = { { { -1, 0, 0, 0 }, { 0, 2, 0, 0 }, { 0, 0.5, 1, 3 } } };
    const struct {
        transform place;
        vec3 normal;
    } cases[] = { { TRANSFORM_IDENTITY, { 0, 0, 1 } },
                  { upside, { 0, 0, -1 } },
                  { mirror, { 0, -0.242535625f, 0.970142500f } } }; /* across (0, 2, 0.5) */
    for (int k = 0; k < 3; k++) {
        world_instance i = { .place = cases[k].place };
        arena a          = { 0 };
        world *w         = make(&a, &(world_desc){ &m, 1, &i, 1, TRIANGLE_WATERTIGHT, 1 });
        vhit h           = one_hit_of(w, (vec3){ 0.5f, -0.25f, 9 }, (vec3){ 0, 0, -1 }, INFINITY);
        vsurface at;
        world_surface(w, &h, vlane_index() == vsplat_int(0), &at);
        assert_near(lane(at.normal.x, 0), cases[k].normal.x, 1e-6);
        assert_near(lane(at.normal.y, 0), cases[k].normal.y, 1e-6);
        assert_near(lane(at.normal.z, 0), cases[k].normal.z, 1e-6);
        assert_near(lane(at.position.x, 0), 0.5, 1e-6);
        assert_near(lane(at.position.y, 0), -0.25, 1e-6);
        assert_near(lane(at.position.z, 0), 9.0 - (double)lane(h.distance, 0), 1e-6);
        assert_true(lane(at.error, 0) > 0.0f && lane(at.error, 0) < 1e-5f);
        assert_int_equal(lane(at.material, 0), lane(h.triangle, 0) ? 9 : 7);
        for (int dead = 1; dead < LANES; dead++) {
            assert_true(lane(at.position.x, dead) == 0.0f && lane(at.normal.z, dead) == 0.0f);
            assert_true(lane(at.error, dead) == 0.0f && lane(at.material, dead) == 0);
        }
        arena_clear(&a);
    }
    shape_clear(&s);
}

/* ---- building -------------------------------------------------------------------------------- */

TEST(worlds_of_nothing_are_worlds)
{
    arena a          = { 0 };
    mesh none        = { 0 };
    const world *w[] = {
        make(&a, &(world_desc){ .threads = 1 }),
        make(&a, &(world_desc){ .meshes = &none, .mesh_count = 1, .threads = 2 }),
        make(&a, &(world_desc){ &none, 1, &once, 1, TRIANGLE_PROJECTION, 1 }),
    };
    for (int k = 0; k < 3; k++) {
        vhit h = one_hit_of(w[k], (vec3){ 0, 0, 0 }, (vec3){ 0, 0, 1 }, INFINITY);
        assert_true(vall(h.instance == vsplat_int(-1)) && vall(h.distance == INFINITY));
        vec3 low, high;
        world_bounds(w[k], &low, &high);
        assert_true(low.x > high.x && low.y > high.y && low.z > high.z);
    }
    arena_clear(&a);
}

TEST(one_triangle_is_a_world_with_its_bounds)
{
    shape s = { 0 };
    fixture f;
    vec3 low, high;
    shape_triangle(&s, shape_point(&s, (vec3){ 1, 2, 3 }), shape_point(&s, (vec3){ 4, 2, 5 }),
                   shape_point(&s, (vec3){ 1, 6, 4 }));
    set_up(&f, &s);
    world_bounds(f.w, &low, &high);
    assert_near(low.x, 1, 1e-4);
    assert_near(low.z, 3, 1e-4);
    assert_near(high.y, 6, 1e-4);
    vhit h = one_hit_of(f.w, (vec3){ 1.5f, 2.5f, 0 }, (vec3){ 0, 0, 1 }, INFINITY);
    assert_true(vall(h.triangle == vsplat_int(0)));
    tear_down(&f, &s);
}

TEST(degenerate_triangles_are_never_met)
{
    shape s = { 0 };
    fixture f;
    uint32_t p = shape_point(&s, (vec3){ 0, 0, 1 }), q = shape_point(&s, (vec3){ 1, 0, 1 });
    uint32_t r = shape_point(&s, (vec3){ 0.5f, 0, 1 });
    shape_triangle(&s, p, p, p);
    shape_triangle(&s, p, q, q);
    shape_triangle(&s, p, q, r); /* in a line */
    flat_square(&s, 2.0f);
    set_up(&f, &s);
    vhit h = one_hit_of(f.w, (vec3){ 0.5f, 0, 0 }, (vec3){ 0, 0, 1 }, INFINITY);
    assert_true(vall(h.distance == 2.0f));
    tear_down(&f, &s);
}

/* Whatever the size, hits are found or not, without a fault, and no distance is not a number. */
TEST(huge_and_tiny_coordinates_do_no_harm)
{
    const float sizes[] = { 1e30f, 3e38f, 1e-20f, 1e-38f, 1e-44f };
    for (int k = 0; k < 5; k++) {
        shape s = { 0 };
        fixture f;
        shape_sphere(&s, (vec3){ 0, 0, 0 }, 1.0f, 6);
        for (uint32_t p = 0; p < s.position_count; p++)
            s.positions[p] = v3_scale(s.positions[p], sizes[k]);
        shape_soup(&s, 50, 0.5f, 2);
        set_up(&f, &s);
        vray rays[BATCH];
        vmask active[BATCH];
        vhit h[BATCH];
        random_batch(rays, active, 12);
        for (int hint = RAYS_COHERENT; hint <= RAYS_INCOHERENT; hint++) {
            world_first_hit(f.w, rays, active, BATCH, (ray_hint)hint, h);
            for (int p = 0; p < BATCH; p++) {
                vsurface at;
                assert_true(vall(h[p].distance > 0.0f));
                world_surface(f.w, &h[p], active[p], &at);
            }
        }
        tear_down(&f, &s);
    }
}

/* A metre's sphere in a mesh's coordinates, kilometres or a micrometre in the world's */
TEST(a_sphere_of_any_size_is_hit_at_its_radius)
{
    for (int power = -6; power <= 6; power += 3) {
        double size      = pow(10, power);
        world_instance i = { .place = {
                                 { { size, 0, 0, 0 }, { 0, size, 0, 0 }, { 0, 0, size, 0 } } } };
        shape s          = { 0 };
        arena a          = { 0 };
        shape_sphere(&s, (vec3){ 0, 0, 0 }, 1.0f, 40);
        mesh m   = shape_mesh(&s);
        world *w = make(&a, &(world_desc){ &m, 1, &i, 1, TRIANGLE_WATERTIGHT, 1 });
        vhit h   = one_hit_of(w, (vec3){ 0, 0, 0 }, (vec3){ 0.48f, 0.6f, 0.64f }, INFINITY);
        assert_near(lane(h.distance, 0), size, 5e-3); /* facets lie within */
        arena_clear(&a);
        shape_clear(&s);
    }
}

TEST(threads_change_nothing)
{
    shape s = { 0 };
    for (int i = 0; i < 20; i++)
        shape_sphere(
            &s, (vec3){ 0.3f * (float)(i % 5) - 0.7f, 0.1f * (float)(i % 7), 0.05f * (float)i },
            0.3f, 22);
    mesh m  = shape_mesh(&s);
    arena a = { 0 };
    world *w[3];
    for (int k = 0; k < 3; k++)
        w[k] = make(&a, &(world_desc){ &m, 1, &once, 1, TRIANGLE_WATERTIGHT, k + 1 });
    vray rays[BATCH];
    vmask active[BATCH];
    vhit one[BATCH], more[BATCH];
    random_batch(rays, active, 3);
    world_first_hit(w[0], rays, active, BATCH, RAYS_INCOHERENT, one);
    for (int k = 1; k < 3; k++) {
        world_first_hit(w[k], rays, active, BATCH, RAYS_INCOHERENT, more);
        assert_true(same_bits(one, more, sizeof one));
        assert_true(world_statistics(w[k]).bytes == world_statistics(w[0]).bytes);
    }
    world_stats stats = world_statistics(w[0]);
    assert_int_equal(stats.triangles, s.triangle_count);
    assert_true(stats.bytes <= 150 * stats.triangles);
    arena_clear(&a);
    shape_clear(&s);
}

TEST(without_memory_there_is_no_world_but_an_error)
{
    shape s = { 0 };
    shape_soup(&s, 1000, 0.1f, 3);
    mesh m        = shape_mesh(&s);
    arena a       = { 0 };
    lux_error err = { 0 };
    memory_is_out = true;
    world *w      = world_new(&a, &(world_desc){ &m, 1, &once, 1, TRIANGLE_WATERTIGHT, 1 }, &err);
    memory_is_out = false;
    assert_null(w);
    assert_int_equal(err.code, ERR_MEMORY);

    /* Enough for the arena's own block, none to build with */
    assert_non_null(arena_alloc(&a, 1, 1, 1, &err));
    memory_is_out = true;
    w             = world_new(&a, &(world_desc){ &m, 1, &once, 1, TRIANGLE_WATERTIGHT, 1 }, &err);
    memory_is_out = false;
    assert_null(w);
    assert_int_equal(err.code, ERR_MEMORY);
    arena_clear(&a);
    shape_clear(&s);
}

/* Both tests see the same surfaces; near edges they may disagree: one ray in 1,000. */
TEST(the_projection_test_meets_what_the_watertight_test_meets)
{
    shape s = { 0 };
    shape_soup(&s, 300, 0.5f, 21);
    mesh m  = shape_mesh(&s);
    arena a = { 0 };
    world *w[2];
    for (int k = 0; k < 2; k++)
        w[k] = make(
            &a, &(world_desc){ &m, 1, &once, 1, k ? TRIANGLE_PROJECTION : TRIANGLE_WATERTIGHT, 1 });
    int apart = 0, hits = 0;
    vray rays[BATCH];
    vmask active[BATCH];
    vhit h[2][BATCH];
    for (uint32_t seed = 0; seed < 25; seed++) {
        random_batch(rays, active, seed);
        for (int k = 0; k < 2; k++)
            world_first_hit(w[k], rays, active, BATCH, RAYS_INCOHERENT, h[k]);
        for (int p = 0; p < BATCH; p++) {
            vmask same =
                (h[0][p].triangle == h[1][p].triangle) &
                ((h[0][p].triangle < vsplat_int(0)) |
                 ((vabs(h[0][p].distance - h[1][p].distance) < 1e-3f) &
                  (vabs(h[0][p].u - h[1][p].u) < 1e-3f) & (vabs(h[0][p].v - h[1][p].v) < 1e-3f)));
            apart += __builtin_popcount((unsigned)vbits(~same));
            hits += __builtin_popcount((unsigned)vbits(h[0][p].triangle >= vsplat_int(0)));
        }
    }
    assert_true(hits > 1000 && apart < 10);
    arena_clear(&a);
    shape_clear(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays_meet_in_a_soup_what_testing_everything_meets),
        cmocka_unit_test(rays_meet_in_flat_and_square_things_what_testing_everything_meets),
        cmocka_unit_test(rays_meet_in_many_places_what_testing_everything_meets),
        cmocka_unit_test(a_placed_mesh_is_met_where_its_moved_corners_are),
        cmocka_unit_test(distance_and_weights_name_the_same_point),
        cmocka_unit_test(hints_and_batches_change_no_bit),
        cmocka_unit_test(dead_lanes_are_misses_whatever_they_hold),
        cmocka_unit_test(of_equals_the_lower_instance_then_the_lower_triangle_is_met),
        cmocka_unit_test(the_lower_instance_is_met_even_if_it_is_tried_later),
        cmocka_unit_test(a_ray_ends_before_its_reach_and_begins_behind_its_origin),
        cmocka_unit_test(all_hits_come_in_order_up_to_the_first_that_is_not_hollow),
        cmocka_unit_test(all_hits_of_a_soup_are_first_hits_one_behind_the_other),
        cmocka_unit_test(a_normal_points_to_the_image_of_the_front),
        cmocka_unit_test(worlds_of_nothing_are_worlds),
        cmocka_unit_test(one_triangle_is_a_world_with_its_bounds),
        cmocka_unit_test(degenerate_triangles_are_never_met),
        cmocka_unit_test(huge_and_tiny_coordinates_do_no_harm),
        cmocka_unit_test(a_sphere_of_any_size_is_hit_at_its_radius),
        cmocka_unit_test(threads_change_nothing),
        cmocka_unit_test(without_memory_there_is_no_world_but_an_error),
        cmocka_unit_test(the_projection_test_meets_what_the_watertight_test_meets),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
