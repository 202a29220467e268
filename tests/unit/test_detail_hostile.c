/* tests/unit/test_detail_hostile.c -- details of triangles that say nothing of themselves, or
 * nonsense. */
#include "core/world.h"
#include "tests/test.h"

#include <float.h>

static const transform places[] = {
    { { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 } } },                   /* as it is */
    { { { 2.5, 0, 0, 3 }, { 0, 2.5, 0, -1 }, { 0, 0, 2.5, 0.5 } } },          /* larger */
    { { { 0, -1, 0, 0 }, { 0.6, 0, -0.8, 1 }, { 0.8, 0, 0.6, 0 } } },         /* turned */
    { { { -1, 0, 0, 0.5 }, { 0, 1, 0, 0.1 }, { 0, 0, 1, 0.2 } } },            /* mirrored */
    { { { 0.3, 0.4, 0, -0.5 }, { 0, 0.5, 0.1, 0.3 }, { 0.2, 0, 0.6, 0 } } },  /* sheared */
    { { { 0, 0.02, 0, 7000 }, { 0.03, 0, 0, 0.4 }, { 0, 0, 0.01, -5000 } } }, /* small, far off */
};
enum { PLACES = sizeof places / sizeof *places };

static world *make(arena *a, const mesh *m, const transform *place, int count)
{
    world_instance in[PLACES] = { 0 };
    lux_error err             = { 0 };
    for (int i = 0; i < count; i++)
        in[i].place = place[i];
    world *w =
        world_new(a, &(world_desc){ m, 1, in, (uint32_t)count, TRIANGLE_WATERTIGHT, 1 }, &err);
    if (!w)
        fail_msg("%s", err.text);
    return w;
}

static vhit hit_at(int instance, int triangle, float u, float v)
{
    return (vhit){ vsplat(1.0f), vsplat_int(instance), vsplat_int(triangle), vsplat(u), vsplat(v) };
}

static const vec3 plain[]            = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } };
static const uint32_t one_triangle[] = { 0, 1, 2 };

TEST(nonsense_normals_leave_the_triangle_its_own)
{
    const float inf = INFINITY, nan = NAN;
    const vec3 cases[][3] = {
        { { 0, 0, 0 }, { 0, 0, 0 }, { 0, 0, 0 } },
        { { 0, 0, 1 }, { 0, 0, -1 }, { 0, 0, -1 } },
        { { 1, 0, 0 }, { -1, 0, 0 }, { -1, 0, 0 } },
        { { 0, 0, -1 }, { 0, 0, -1 }, { 0, 0, -1 } },
        { { nan, 0, 1 }, { 0, 0, 1 }, { 0, 0, 1 } },
        { { 0, inf, 1 }, { 0, 0, 1 }, { 0, 0, 1 } },
        { { 1e-30f, 0, 0 }, { 0, 1e-30f, 0 }, { 0, 0, 1e-30f } },
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        mesh m   = { plain, one_triangle, NULL, 3, 1, { NULL }, cases[k] };
        arena a  = { 0 };
        world *w = make(&a, &m, places, PLACES);
        for (int place = 0; place < PLACES; place++) {
            vhit h = hit_at(place, 0, 0.25f, 0.25f);
            vdetail d;
            vsurface s;
            world_detail(w, &h, ALL_LANES, &d);
            world_surface(w, &h, ALL_LANES, &s);
            assert_memory_equal(&d.normal, &s.normal, sizeof d.normal);
        }
        arena_clear(&a);
    }
}

/* Of no unit length, and along the triangle: a unit vector on the front side all the same. */
TEST(normals_of_other_lengths_do_no_harm)
{
    const vec3 cases[][3] = { { { 1, 0, 0 }, { 1, 0, 0 }, { 1, 0, 0 } },
                              { { 1e30f, 0, 1e30f }, { 0, 0, 1 }, { 0, 0, 1 } },
                              { { 3e38f, 0, 3e38f }, { 3e38f, 0, 3e38f }, { 3e38f, 0, 3e38f } },
                              { { 0, 0.01f, 0.02f }, { 0, 0, 0.02f }, { 100, 0, 100 } } };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        mesh m   = { plain, one_triangle, NULL, 3, 1, { NULL }, cases[k] };
        arena a  = { 0 };
        world *w = make(&a, &m, places, PLACES);
        for (int place = 0; place < PLACES; place++) {
            vhit h = hit_at(place, 0, 0.25f, 0.25f);
            vdetail d;
            vsurface s;
            world_detail(w, &h, ALL_LANES, &d);
            world_surface(w, &h, ALL_LANES, &s);
            assert_true(vall(vdot(d.normal, s.normal) > 0.0f));
            assert_near(lane(vlength(d.normal), 0), 1, 4 * 0x1p-24);
        }
        arena_clear(&a);
    }
}

TEST(a_corner_without_a_normal_has_the_triangles_own)
{
    const vec3 normals[] = { { 0, 0, 0 }, { 0.6f, 0, 0.8f }, { 0, 0, 0 } };
    mesh m               = { plain, one_triangle, NULL, 3, 1, { NULL }, normals };
    arena a              = { 0 };
    world *w             = make(&a, &m, places, 1);
    vhit h               = hit_at(0, 0, 0.5f, 0.25f);
    vdetail d;
    world_detail(w, &h, ALL_LANES, &d);
    assert_near(lane(d.normal.x, 0), 0.3 / hypot(0.3, 0.9), 1e-6);
    assert_near(lane(d.normal.z, 0), 0.9 / hypot(0.3, 0.9), 1e-6);
    arena_clear(&a);
}

static bool is_finite(vfloat a) { return vall(vabs(a) <= FLT_MAX); }

TEST(pictures_of_no_area_have_neither_scale_nor_axes)
{
    const float cases[][6] = {
        { 0.3f, 0.7f, 0.3f, 0.7f, 0.3f, 0.7f },    /* a point */
        { 0, 0, 1, 1, 1, 1 },                      /* two corners in one */
        { 0.1f, 0.03f, 0.2f, 0.06f, 0.7f, 0.21f }, /* a line, to rounding */
        { 0, 0.3f, 0.1f, 0.3f, 50, 0.3f },         /* a line of v */
        { 3e38f, 0, -3e38f, 1, 0, 3e38f },         /* too large a step for a float */
        { 1e-45f, 0, 0, 1e-45f, 0, 0 },            /* too small a one */
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        mesh m   = { plain, one_triangle, NULL, 3, 1, { cases[k], cases[k] }, NULL };
        arena a  = { 0 };
        world *w = make(&a, &m, places, PLACES);
        for (int place = 0; place < PLACES; place++) {
            vhit h = hit_at(place, 0, 0.25f, 0.5f);
            vdetail d;
            world_detail(w, &h, ALL_LANES, &d);
            for (int set = 0; set < 2; set++) {
                assert_true(is_finite(d.u[set]) && is_finite(d.v[set]));
                assert_true(vall(d.scale[set] == 0.0f) && !vany(d.mirrored[set]));
                assert_true(vall(vdot(d.along_u[set], d.along_u[set]) == 0.0f));
            }
        }
        arena_clear(&a);
    }
}

/* Needles and points of any size: what comes back is a number, axes are unit or nothing. */
TEST(degenerate_triangles_give_numbers)
{
    const float sizes[] = { 1e-44f, 1e-38f, 1e-20f, 1.0f, 1e18f, 3e38f };
    const float uv[]    = { 0, 0, 1, 0, 0, 1 };
    for (int k = 0; k < 6; k++)
        for (int thin = 0; thin < 3; thin++) {
            float e           = thin == 0 ? 1.0f : thin == 1 ? 1e-6f : 1e-9f;
            const vec3 at[]   = { { 0, 0, 0 }, { sizes[k], 0, 0 }, { sizes[k], e * sizes[k], 0 } };
            mesh m            = { at, one_triangle, NULL, 3, 1, { uv }, NULL };
            const transform p = TRANSFORM_IDENTITY;
            arena a           = { 0 };
            world *w          = make(&a, &m, &p, 1);
            vhit h            = hit_at(0, 0, 0.25f, 0.5f);
            vdetail d;
            world_detail(w, &h, ALL_LANES, &d);
            assert_true(is_finite(d.u[0]) && is_finite(d.v[0]) && is_finite(d.scale[0]));
            float length = lane(vdot(d.along_u[0], d.along_u[0]), 0);
            assert_true(length == 0.0f || fabsf(length - 1.0f) < 1e-6f);
            assert_true(k != 3 || length > 0.0f);
            arena_clear(&a);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nonsense_normals_leave_the_triangle_its_own),
        cmocka_unit_test(normals_of_other_lengths_do_no_harm),
        cmocka_unit_test(a_corner_without_a_normal_has_the_triangles_own),
        cmocka_unit_test(pictures_of_no_area_have_neither_scale_nor_axes),
        cmocka_unit_test(degenerate_triangles_give_numbers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
