/* tests/unit/test_look.c -- what textures make of a material's look, and normal maps. */
#include "materials/material.h"
#include "materials/material_parts.h"
#include "tests/shapes.h"
#include "tests/test.h"

#include <string.h>

#define SAME_PLACE                                                                                 \
    {                                                                                              \
        1, 0, 0, 0, 1, 0                                                                           \
    }

static arena memory; /* of the test that runs */

static int clear(void **state)
{
    (void)state;
    arena_clear(&memory);
    return 0;
}

static texture_slot picture(int width, int height, const float *rgba)
{
    texture_desc d = { .name = "t", .width = width, .height = height, .rgba = rgba };
    return (texture_slot){ texture_new(&memory, &d, NULL), 0, SAME_PLACE };
}

static texture_slot even(float r, float g, float b, float a)
{
    return picture(1, 1, (float[4]){ r, g, b, a });
}

static vvec3 spread(float x, float y, float z) { return vspread((vec3){ x, y, z }); }

/* On a floor, u toward x; seen from above. */
static vdetail floor_detail(void)
{
    return (vdetail){ .u       = { vsplat(0.3f), vsplat(0.8f) },
                      .v       = { vsplat(0.6f), vsplat(0.1f) },
                      .scale   = { vsplat(1.0f), vsplat(2.0f) },
                      .normal  = spread(0, 0, 1),
                      .along_u = { spread(1, 0, 0), spread(0, 1, 0) } };
}
static vshading seen_from(float x, float z)
{
    float s = z < 0 ? -1.0f : 1.0f;
    return (vshading){ .wo    = vnormalize(spread(x, 0, z)),
                       .n     = spread(0, 0, s),
                       .flat  = spread(0, 0, s),
                       .front = z > 0 ? ALL_LANES : ~ALL_LANES };
}

static void look(const material *m, const vdetail *d, float width, vshading *s)
{
    materials_look(&m, vsplat_int(0), d, vsplat(width), ALL_LANES, s);
}

static void assert_rgb(vrgb got, double r, double g, double b)
{
    assert_near(lane(got.x, LANES - 1), r, 1e-6);
    assert_near(lane(got.y, LANES - 1), g, 1e-6);
    assert_near(lane(got.z, LANES - 1), b, 1e-6);
}

static material plain(const material_textures *t)
{
    return (material){ .textures = t,
                       .look     = { .color           = { 0.5f, 0.6f, 0.8f },
                                     .emission        = { 10, 20, 30 },
                                     .specular        = { 2, 1, 0.5f },
                                     .openness        = 0.25f,
                                     .metallic        = 0.5f,
                                     .roughness       = 0.4f,
                                     .transmission    = 0.6f,
                                     .specular_weight = 0.8f } };
}

/* ---- looks ----------------------------------------------------------------------------------- */

TEST(each_field_is_its_constant_times_its_channel)
{
    material_textures t = { .base            = even(0.1f, 0.2f, 0.3f, 0.4f),
                            .surface         = even(9, 0.5f, 0.25f, 9),
                            .emission        = even(1, 2, 3, 9),
                            .transmission    = even(0.5f, 9, 9, 9),
                            .specular_weight = even(9, 9, 9, 0.25f),
                            .specular_color  = even(2, 3, 4, 9) };
    material m          = plain(&t);
    vdetail d           = floor_detail();
    vshading s          = seen_from(0, 1);
    look(&m, &d, 0, &s);
    assert_rgb(s.look.color, 0.05, 0.12, 0.24);
    assert_rgb(s.look.emission, 10, 40, 90);
    assert_rgb(s.look.specular, 4, 3, 2);
    assert_near(lane(s.look.roughness, 0), 0.2, 1e-6);
    assert_near(lane(s.look.metallic, 0), 0.125, 1e-6);
    assert_near(lane(s.look.transmission, 0), 0.3, 1e-6);
    assert_near(lane(s.look.specular_weight, 0), 0.2, 1e-6);
    assert_near(lane(s.look.openness, 0), 0.25, 0); /* opaque: alpha says nothing */
    assert_true(lane(s.n.z, 0) == 1.0f);
}

TEST(constants_stand_where_there_is_no_texture)
{
    material_textures t = { 0 };
    material m          = plain(&t);
    vdetail d           = floor_detail();
    vshading s          = seen_from(0, 1);
    look(&m, &d, 0, &s);
    assert_rgb(s.look.color, (double)0.5f, (double)0.6f, (double)0.8f);
    assert_rgb(s.look.emission, 10, 20, 30);
    assert_rgb(s.look.specular, 2, 1, 0.5);
    assert_true(lane(s.look.roughness, 0) == 0.4f && lane(s.look.metallic, 0) == 0.5f);
    assert_true(lane(s.look.transmission, 0) == 0.6f && lane(s.look.specular_weight, 0) == 0.8f);
}

TEST(shares_stay_shares_whatever_the_picture_says)
{
    material_textures t = { .base            = even(100, -1, 1, 7),
                            .surface         = even(0, -3, 50, 0),
                            .emission        = even(-1, 0, 1e30f, 0),
                            .transmission    = even(-1, 0, 0, 0),
                            .specular_weight = even(0, 0, 0, 3),
                            .specular_color  = even(-1, 1, 9, 0),
                            .alpha           = ALPHA_BLEND };
    material m          = plain(&t);
    vdetail d           = floor_detail();
    vshading s          = seen_from(0, 1);
    look(&m, &d, 0, &s);
    assert_rgb(s.look.color, 1, 0, (double)0.8f);
    assert_rgb(s.look.specular, 0, 1, 4.5);
    assert_rgb(s.look.emission, 0, 0, 30 * (double)1e30f);
    assert_true(lane(s.look.roughness, 0) == 0.0f && lane(s.look.metallic, 0) == 1.0f);
    assert_true(lane(s.look.transmission, 0) == 0.0f && lane(s.look.specular_weight, 0) == 1.0f);
    assert_true(lane(s.look.openness, 0) == 0.0f);
}

TEST(alpha_blends_masks_or_says_nothing)
{
    static const float alpha[] = { 0.0f, 0.3f, 0.5f, 1.0f };
    for (int i = 0; i < 4; i++) {
        material_textures t = { .base = even(1, 1, 1, alpha[i]), .cutoff = 0.375f };
        material m          = plain(&t);
        vdetail d           = floor_detail();
        vshading s          = seen_from(0, 1);
        t.alpha             = ALPHA_BLEND;
        look(&m, &d, 0, &s);
        assert_near(lane(s.look.openness, 0), 1 - 0.75 * (double)alpha[i], 1e-6);
        t.alpha = ALPHA_MASK; /* 0.75 * 0.5 is the cutoff, and there */
        look(&m, &d, 0, &s);
        assert_true(lane(s.look.openness, 0) == (i < 2 ? 1.0f : 0.0f));
        t.alpha = ALPHA_OPAQUE;
        look(&m, &d, 0, &s);
        assert_true(lane(s.look.openness, 0) == 0.25f);
    }
}

/* Holes of 2 by 2 texels in each 4 by 4, seen from where the whole picture is one pixel. Of a
 * hole's four corners, bilinear alpha leaves x y > 1/2 of a unit square, (1 - log 2) / 2, instead
 * of 1/4. */
TEST(lace_has_as_many_holes_from_afar)
{
    enum { SIDE = 16, PLACES = 256 };
    static float rgba[4 * SIDE * SIDE];
    for (int i = 0; i < SIDE * SIDE; i++)
        rgba[4 * i + 3] = i / SIDE / 2 % 2 && i / 2 % 2 ? 0.0f : 1.0f;
    material_textures t = { .base   = picture(SIDE, SIDE, rgba),
                            .alpha  = ALPHA_MASK,
                            .cutoff = 0.5f };
    material m          = plain(&t);
    m.look.openness     = 0.0f;
    double open         = 0.0;
    for (int i = 0; i < PLACES * PLACES; i++) {
        vdetail d  = floor_detail();
        vshading s = seen_from(0, 1);
        d.u[0]     = vsplat(((float)(i % PLACES) + 0.5f) / PLACES);
        d.v[0]     = vsplat(((float)(i / PLACES) + 0.5f) / PLACES);
        look(&m, &d, 1.0f, &s);
        open += (double)lane(s.look.openness, 0) / (PLACES * PLACES);
    }
    assert_near(open, (4.0 - 4.0 * (0.25 - 0.5 * (1.0 - log(2.0)))) / 16.0, 0.01);
}

TEST(lanes_without_textures_are_left_alone)
{
    material_textures t = { .base         = even(0.5f, 0.5f, 0.5f, 1),
                            .normal       = even(0.5f, 1, 1, 1),
                            .normal_scale = 1 };
    material with = plain(&t), without = plain(NULL);
    const material *all[2] = { &with, &without };
    vdetail d              = floor_detail();
    vshading s             = seen_from(0, 1);
    s.look.color = s.look.emission = spread(7, 7, 7);
    s.look.roughness               = vsplat(7);
    s.n                            = spread(0, 0.6f, 0.8f);
    vint index                     = vlane_index() & 1;
    vmask active                   = vlane_index() != 2;
    materials_look(all, index, &d, vsplat(0.1f), active, &s);
    for (int i = 0; i < LANES; i++) {
        bool touched = i % 2 == 0 && i != 2;
        assert_true((lane(s.look.color.x, i) == 7.0f) == !touched);
        assert_true((lane(s.look.roughness, i) == 7.0f) == !touched);
        assert_true((lane(s.n.y, i) == 0.6f) == !touched);
    }
}

/* A ramp of 64 texels: red is u, green v, but for half a texel at the ends. */
static texture_slot ramp(void)
{
    static float rgba[64 * 64 * 4];
    for (int i = 0; i < 64 * 64; i++) {
        rgba[4 * i]     = ((float)(i % 64) + 0.5f) / 64;
        rgba[4 * i + 1] = ((float)(i / 64) + 0.5f) / 64;
        rgba[4 * i + 3] = 1;
    }
    return picture(64, 64, rgba);
}

/* KHR_texture_transform: (u', v') = translation * rotation * scale * (u, v), its rotation being
 * (cos, sin; -sin, cos): that matrix spelled out by hand. */
TEST(pictures_are_moved_turned_and_scaled)
{
    const double offset[2] = { 0.2, 0.1 }, turn = 0.5, scale[2] = { 0.5, 0.25 };
    material_textures t = { .base = ramp() };
    material m          = plain(&t);
    m.look.color        = (vec3){ 1, 1, 1 };
    for (int set = 0; set < 2; set++) {
        double u = set ? 0.8 : 0.3, v = set ? 0.1 : 0.6;
        const double to[6] = { cos(turn) * scale[0],  sin(turn) * scale[1], offset[0],
                               -sin(turn) * scale[0], cos(turn) * scale[1], offset[1] };
        double su = scale[0] * u, sv = scale[1] * v;
        double want_u = cos(turn) * su + sin(turn) * sv + offset[0];
        double want_v = -sin(turn) * su + cos(turn) * sv + offset[1];
        vdetail d     = floor_detail();
        vshading s    = seen_from(0, 1);
        t.base.set    = set;
        for (int i = 0; i < 6; i++)
            t.base.m[i] = (float)to[i];
        look(&m, &d, 0, &s);
        want_v -= floor(want_v); /* it repeats */
        assert_rgb(s.look.color, want_u, want_v, 0);
    }
}

/* Black and white columns, 64 of each: the mean where the square looked at is as wide as the whole
 * picture, here by each factor of that width in turn. */
TEST(the_width_is_in_metres_and_changed_with_the_picture)
{
    float rgba[128 * 4];
    for (int i = 0; i < 128 * 4; i++)
        rgba[i] = (float)(i / 4 % 2);
    material_textures t = { .base = picture(128, 1, rgba) };
    material m          = plain(&t);
    m.look.color        = (vec3){ 1, 1, 1 };
    const struct {
        float width, scale, m0, m4, want;
    } cases[] = {
        { 0, 1, 1, 1, 0 },
        { 0.0078125f, 1, 1, 1, 0 }, /* a texel: the full picture */
        { 0.015625f, 1, 1, 1, 0.5f },
        { 0.0078125f, 2, 1, 1, 0.5f },
        { 0.0078125f, 1, 2, 2, 0.5f },
        { 0.0078125f, 1, 4, 1, 0.5f }, /* twice as much in area's root */
        { 0.0078125f, 1, -2, 2, 0.5f },
        { 0.0078125f, 1, 4, 0.25f, 0 },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        vdetail d   = floor_detail();
        vshading s  = seen_from(0, 1);
        d.u[0]      = vsplat(0.5f / 128 / fabsf(cases[i].m0) * copysignf(1, cases[i].m0));
        d.scale[0]  = vsplat(cases[i].scale);
        t.base.m[0] = cases[i].m0;
        t.base.m[4] = cases[i].m4;
        look(&m, &d, cases[i].width, &s);
        assert_near(lane(s.look.color.x, 0), (double)cases[i].want, 1e-6);
    }
}

TEST(the_mean_colour_is_that_of_the_picture_and_a_share)
{
    material_textures t = { .base = picture(2, 1, (float[8]){ 0, 0.5f, 9, 1, 0.5f, 1, 9, 1 }) };
    vec3 mean           = textures_mean_color(&t);
    assert_true(mean.x == 0.25f && mean.y == 0.75f && mean.z == 1.0f);
    mean = textures_mean_color(NULL);
    assert_true(mean.x == 1.0f && mean.y == 1.0f && mean.z == 1.0f);
}

/* ---- normal maps ----------------------------------------------------------------------------- */

#define HALF 0.70710678f

/* The normal that a map of one colour makes of s->n; (0.5, 0.5, 1) is flat. */
static vec3 bent(vec3 map, const vdetail *d, vshading s, const float m[6])
{
    material_textures t = { .normal = even(map.x, map.y, map.z, 1), .normal_scale = 1 };
    material with       = plain(&t);
    if (m)
        memcpy(t.normal.m, m, sizeof t.normal.m);
    look(&with, d, 0, &s);
    return (vec3){ lane(s.n.x, 0), lane(s.n.y, 0), lane(s.n.z, 0) };
}

/* That it is this one, to the eye that looks along it. */
static void assert_bent(vec3 map, const vdetail *d, vshading s, const float m[6], double x,
                        double y, double z)
{
    s.wo     = spread((float)x, (float)y, (float)z);
    vec3 got = bent(map, d, s, m);
    assert_true(fabs((double)got.x - x) < 3e-7 && fabs((double)got.y - y) < 3e-7 &&
                fabs((double)got.z - z) < 3e-7);
}

/* Colours of maps that tilt by 45 degrees: to x, and to y */
static const vec3 TILT_X = { 0.5f + 0.5f * HALF, 0.5f, 0.5f + 0.5f * HALF };
static const vec3 TILT_Y = { 0.5f, 0.5f + 0.5f * HALF, 0.5f + 0.5f * HALF };

TEST(flat_blue_leaves_the_normal)
{
    uint32_t seed = 3;
    for (int n = 0; n < 500; n++) {
        vdetail d  = floor_detail();
        vshading s = seen_from(0.3f, n % 2 ? 1 : -1);
        float x = 0.2f * random_unit(&seed), y = 0.2f * random_unit(&seed);
        s.n = vscale(vnormalize(spread(x, y, 1)), vsplat(n % 2 ? 1.0f : -1.0f));
        assert_bent((vec3){ 0.5f, 0.5f, 1 }, &d, s, NULL, (double)lane(s.n.x, 0),
                    (double)lane(s.n.y, 0), (double)lane(s.n.z, 0));
    }
}

/* u grows along x and, in a picture that is not mirrored, v against y: up is y. */
TEST(maps_tilt_along_u_and_against_v)
{
    vdetail d  = floor_detail();
    vshading s = seen_from(0, 1);
    double h   = (double)HALF;
    assert_bent(TILT_X, &d, s, NULL, h, 0, h);
    assert_bent(TILT_Y, &d, s, NULL, 0, h, h);
    d.mirrored[0] = ALL_LANES;
    assert_bent(TILT_X, &d, s, NULL, h, 0, h);
    assert_bent(TILT_Y, &d, s, NULL, 0, -h, h);
    d            = floor_detail();
    d.along_u[0] = spread(0.6f, 0.8f, 0); /* up is (-0.8, 0.6) */
    assert_bent(TILT_X, &d, s, NULL, 0.6 * h, 0.8 * h, h);
    assert_bent(TILT_Y, &d, s, NULL, -0.8 * h, 0.6 * h, h);
}

/* The normal (0.28, 0, 0.96): u made square to it is (0.96, 0, -0.28). */
TEST(maps_tilt_what_is_smooth)
{
    vdetail d  = floor_detail();
    vshading s = seen_from(0, 1);
    s.n        = spread(0.28f, 0, 0.96f);
    double h   = (double)HALF;
    assert_bent(TILT_Y, &d, s, NULL, 0.28 * h, h, 0.96 * h);
    const vec3 back = { 0.5f - 0.5f * HALF, 0.5f, 0.5f + 0.5f * HALF };
    assert_bent(back, &d, s, NULL, (0.28 - 0.96) * h, 0, (0.96 + 0.28) * h);
}

/* Seen from behind, the surface's normal is the one in front turned about: n = -(x, y, z). */
TEST(a_bump_is_a_dent_from_behind)
{
    vdetail d  = floor_detail();
    vshading s = seen_from(0, -1);
    double h   = (double)HALF;
    assert_bent(TILT_X, &d, s, NULL, -h, 0, -h);
    assert_bent(TILT_Y, &d, s, NULL, 0, -h, -h);
}

/* A picture that is turned as a whole has its bumps turned: with u' = v and v' = -u the columns
 * go up along -u'. The picture's x is where u' grows: here v, which is -y. */
TEST(maps_turn_with_their_picture)
{
    const float quarter[6] = { 0, 1, 0, -1, 0, 0 }, flip[6] = { -1, 0, 0, 0, 1, 0 },
                large[6] = { 3, 0, 0, 0, 3, 0 };
    vdetail d            = floor_detail();
    vshading s           = seen_from(0, 1);
    double h             = (double)HALF;
    assert_bent(TILT_X, &d, s, quarter, 0, -h, h);
    assert_bent(TILT_Y, &d, s, quarter, h, 0, h); /* against v' = -u */
    assert_bent(TILT_X, &d, s, flip, -h, 0, h);
    assert_bent(TILT_Y, &d, s, flip, 0, h, h);
    assert_bent(TILT_X, &d, s, large, h, 0, h);
}

TEST(the_scale_is_of_x_and_y_alone)
{
    material_textures t = { .normal = even(0.75f, 0.5f, 1, 1), .normal_scale = 2 };
    material m          = plain(&t);
    vdetail d           = floor_detail();
    vshading s          = seen_from(0, 1);
    s.wo                = spread(HALF, 0, HALF);
    look(&m, &d, 0, &s);
    assert_near(lane(s.n.x, 0), (double)HALF, 1e-6);
    assert_near(lane(s.n.z, 0), (double)HALF, 1e-6);
}

/* Grey is no direction; a mesh without coordinates has no u. */
TEST(where_a_map_says_nothing_the_normal_stays)
{
    vdetail d  = floor_detail();
    vshading s = seen_from(0, 1);
    assert_bent((vec3){ 0.5f, 0.5f, 0.5f }, &d, s, NULL, 0, 0, 1);
    d.along_u[0] = spread(0, 0, 0);
    assert_bent(TILT_X, &d, s, NULL, 0, 0, 1);
    d                   = floor_detail();
    const float flat[6] = { 0, 0, 0.5f, 0, 0, 0.5f };
    assert_bent(TILT_X, &d, s, flat, 0, 0, 1);
}

TEST(bent_normals_never_look_away_nor_mirror_into_the_surface)
{
    uint32_t seed = 6;
    for (int n = 0; n < 500; n++) {
        vdetail d  = floor_detail();
        vshading s = seen_from(10 * random_unit(&seed), n % 2 ? 1 : -1);
        vec3 map   = { random_unit(&seed), random_unit(&seed), random_unit(&seed) };
        vec3 got   = bent(map, &d, s, NULL);
        vec3 wo    = { lane(s.wo.x, 0), 0, lane(s.wo.z, 0) };
        float c = v3_dot(wo, got), up = n % 2 ? 1 : -1;
        assert_true(c > 0 && fabsf(v3_length(got) - 1) < 1e-6f);
        assert_true(up * (2 * c * got.z - wo.z) > 0);
    }
}

#define CLEARED(test) cmocka_unit_test_teardown(test, clear)

int main(void)
{
    const struct CMUnitTest tests[] = {
        CLEARED(each_field_is_its_constant_times_its_channel),
        CLEARED(constants_stand_where_there_is_no_texture),
        CLEARED(shares_stay_shares_whatever_the_picture_says),
        CLEARED(alpha_blends_masks_or_says_nothing),
        CLEARED(lace_has_as_many_holes_from_afar),
        CLEARED(lanes_without_textures_are_left_alone),
        CLEARED(pictures_are_moved_turned_and_scaled),
        CLEARED(the_width_is_in_metres_and_changed_with_the_picture),
        CLEARED(the_mean_colour_is_that_of_the_picture_and_a_share),
        CLEARED(flat_blue_leaves_the_normal),
        CLEARED(maps_tilt_along_u_and_against_v),
        CLEARED(maps_tilt_what_is_smooth),
        CLEARED(a_bump_is_a_dent_from_behind),
        CLEARED(maps_turn_with_their_picture),
        CLEARED(the_scale_is_of_x_and_y_alone),
        CLEARED(where_a_map_says_nothing_the_normal_stays),
        CLEARED(bent_normals_never_look_away_nor_mirror_into_the_surface),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
