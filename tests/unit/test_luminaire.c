/* tests/unit/test_luminaire.c -- which way the goniodiagram of a luminaire points.
 *
 * The web has four planes: 100, 200, 300, 400 cd in C0, C90, C180, C270 at gamma 90, and 10 cd
 * at gamma 0 in all; nothing above gamma 90. Points at a distance d see I / d^2.
 */
#include "lights/light.h"
#include "lights/photometry.h"
#include "tests/test.h"

static const float planes[]  = { 0, 90, 180, 270 };
static const float gammas[]  = { 0, 90 };
static const float candela[] = { 10, 100, 10, 200, 10, 300, 10, 400 };
static const photometry web  = {
     .plane_count = 4, .gamma_count = 2, .plane_deg = planes, .gamma_deg = gammas, .candela = candela
};
static const float PI = 3.14159265f;

/* cd that a luminaire at the origin shows toward a point; 0 if it lights it not. */
static double seen(vec3 aim, float rotate, vec3 toward)
{
    arena a          = { 0 };
    luminaire_desc d = { .aim = aim, .rotate = rotate, .scale = { 1, 1, 1 }, .web = &web };
    const light *l   = light_luminaire(&a, &d, NULL);
    assert_non_null(l);
    vlight_sample s;
    vvec3 p   = vspread(toward);
    vmask lit = light_sample(l, &p, vsplat(0.5f), vsplat(0.5f), ALL_LANES, &s);
    double d2 = (double)v3_dot(toward, toward);
    double cd = (double)lane(s.e.y, LANES - 1) * d2;
    vvec3 to  = vscale(vspread(toward), -1.0f / vsplat(v3_length(toward)));
    assert_true(vall(lit) == (cd > 0.0));
    if (cd > 0.0) {
        assert_near(lane(vdot(to, s.wi), 0), 1.0, 1e-6);
        assert_near(lane(s.dist, 0), (double)v3_length(toward), 1e-6);
    }
    arena_clear(&a);
    return cd;
}

TEST(aimed_down_c0_lies_along_x_and_c90_along_y)
{
    vec3 down = { 0, 0, -2 };
    assert_near(seen(down, 0, (vec3){ 0, 0, -3 }), 10, 1e-5);
    assert_near(seen(down, 0, (vec3){ 2, 0, -1e-6f }), 100, 1e-5);
    assert_near(seen(down, 0, (vec3){ 0, 2, -1e-6f }), 200, 1e-5);
    assert_near(seen(down, 0, (vec3){ -2, 0, -1e-6f }), 300, 1e-5);
    assert_near(seen(down, 0, (vec3){ 0, -2, -1e-6f }), 400, 1e-5);
    assert_near(seen(down, 0, (vec3){ 1, 0, -1 }), 55, 1e-5);       /* gamma 45, C0 */
    assert_near(seen(down, 0, (vec3){ 1, 1, -1e-6f }), 150, 1e-5);  /* gamma 90, C45 */
    assert_near(seen(down, 0, (vec3){ 1, -1, -1e-6f }), 250, 1e-5); /* C315, over the seam */
}

TEST(above_the_last_gamma_it_is_dark)
{
    vec3 down = { 0, 0, -1 };
    assert_true(seen(down, 0, (vec3){ 1, 0, 1e-3f }) == 0.0);
    assert_true(seen(down, 0, (vec3){ 0, 0, 1 }) == 0.0);
}

TEST(rotate_turns_counter_clockwise_seen_from_above)
{
    vec3 down = { 0, 0, -1 };
    assert_near(seen(down, 0.5f * PI, (vec3){ 0, 1, -1e-6f }), 100, 1e-4); /* C0 now along +y */
    assert_near(seen(down, 0.5f * PI, (vec3){ -1, 0, -1e-6f }), 200, 1e-4);
    assert_near(seen(down, 0.25f * PI, (vec3){ 1, 1, -1e-6f }), 100, 1e-4);
}

/* Down to +x turns about +y (by -90 deg): C0 goes up, C90 stays along +y. */
TEST(aimed_along_x_c0_points_up)
{
    vec3 east = { 5, 0, 0 };
    assert_near(seen(east, 0, (vec3){ 1, 0, 0 }), 10, 1e-5);
    assert_near(seen(east, 0, (vec3){ 1e-6f, 0, 1 }), 100, 1e-4);
    assert_near(seen(east, 0, (vec3){ 1e-6f, 1, 0 }), 200, 1e-4);
    assert_near(seen(east, 0, (vec3){ 1e-6f, 0, -1 }), 300, 1e-4);
}

/* Down to +y turns about +x: C90 goes up, C0 stays along +x. */
TEST(aimed_along_y_c90_points_up)
{
    vec3 north = { 0, 1, 0 };
    assert_near(seen(north, 0, (vec3){ 1, 1e-6f, 0 }), 100, 1e-4);
    assert_near(seen(north, 0, (vec3){ 0, 1e-6f, 1 }), 200, 1e-4);
    assert_near(seen(north, 0.5f * PI, (vec3){ 0, 1e-6f, 1 }), 100, 1e-4); /* rotate goes first */
}

TEST(aimed_up_it_is_turned_about_c0)
{
    vec3 up = { 0, 0, 1 };
    assert_near(seen(up, 0, (vec3){ 0, 0, 1 }), 10, 1e-5);
    assert_near(seen(up, 0, (vec3){ 1, 0, 1e-6f }), 100, 1e-4);
    assert_near(seen(up, 0, (vec3){ 0, -1, 1e-6f }), 200, 1e-4);
    assert_near(seen(up, 0.5f * PI, (vec3){ 0, 1, 1e-6f }), 100, 1e-4);
    assert_near(seen((vec3){ -3e-8f, 4e-8f, 1 }, 0, (vec3){ 1, 0, 1e-5f }), 100, 1e-4);
}

/* Aim (1, 0, 1)/sqrt 2: 135 deg from down, about -y: C0 goes from +x to (-1, 0, 1)/sqrt 2. */
TEST(an_oblique_aim_takes_the_shortest_turn)
{
    vec3 aim = { 1, 0, 1 };
    assert_near(seen(aim, 0, (vec3){ 1, 0, 1 }), 10, 1e-4);
    assert_near(seen(aim, 0, (vec3){ -0.999999f, 0, 1 }), 100, 1e-4);
    assert_near(seen(aim, 0, (vec3){ 1e-6f, 1, 1e-6f }), 200, 1e-4);
    assert_near(seen(aim, 0, (vec3){ 1, 0, -0.999999f }), 300, 1e-4);
}

/* Down to a = (1, 1, -1)/sqrt 3 turns about (1, -1, 0) and so keeps it: it is C315 before and
 * after, at right angles to the aim: (400 + 100) / 2 cd. */
TEST(the_axis_of_the_turn_stays_where_it_is)
{
    vec3 aim = { 1, 1, -1 };
    vec3 at  = { 1 + 1e-6f, -1 + 1e-6f, -1e-6f };
    assert_near(seen(aim, 0, at), 250, 1e-4);
}

TEST(dark_lanes_are_zero)
{
    arena a          = { 0 };
    luminaire_desc d = { .aim = { 0, 0, -1 }, .scale = { 1, 2, 3 }, .web = &web };
    const light *l   = light_luminaire(&a, &d, NULL);
    vvec3 p          = { vsplat(0.0f), vsplat(0.0f), vsplat(0.0f) }; /* at the lamp itself */
    vlight_sample s;
    assert_false(vany(light_sample(l, &p, vsplat(0), vsplat(0), ALL_LANES, &s)));
    p.z = vsplat(-1.0f);
    assert_false(vany(light_sample(l, &p, vsplat(0), vsplat(0), ~ALL_LANES, &s)));
    for (int i = 0; i < LANES; i++) {
        assert_true(lane(s.e.x, i) == 0.0f && lane(s.e.z, i) == 0.0f && lane(s.pdf, i) == 0.0f);
        assert_true(lane(s.wi.z, i) == 0.0f && lane(s.dist, i) == 0.0f);
    }
    vmask one = vlane_index() < 1;
    assert_int_equal(vbits(light_sample(l, &p, vsplat(0), vsplat(0), one, &s)), 1);
    assert_near(lane(s.e.z, 0), 30.0, 1e-6); /* the third channel's scale */
    arena_clear(&a);
}

TEST(what_makes_no_sense_is_refused)
{
    arena a                   = { 0 };
    lux_error err             = { 0 };
    const luminaire_desc good = { .aim = { 0, 0, -1 }, .scale = { 1, 1, 1 }, .web = &web };
    luminaire_desc d          = good;
    d.aim                     = (vec3){ 0, 0, 0 };
    assert_null(light_luminaire(&a, &d, &err));
    assert_int_equal(err.code, ERR_ARGUMENT);
    d        = good;
    d.rotate = NAN;
    assert_null(light_luminaire(&a, &d, &err));
    d       = good;
    d.scale = (vec3){ 1, -1, 1 };
    assert_null(light_luminaire(&a, &d, &err));
    d     = good;
    d.web = NULL;
    assert_null(light_luminaire(&a, &d, &err));
    const float back[] = { 90, 0 };
    photometry bad     = web;
    bad.gamma_deg      = back;
    d                  = good;
    d.web              = &bad;
    assert_null(light_luminaire(&a, &d, &err));
    memory_is_out = true;
    arena none    = { 0 };
    assert_null(light_luminaire(&none, &good, &err));
    memory_is_out = false;
    assert_int_equal(err.code, ERR_MEMORY);
    arena_clear(&a);
}

/* As each alone, and whatever the opening, which is the lamp's own affair. */
TEST(lamps_of_one_model_shine_as_those_that_have_their_own)
{
    arena a                  = { 0 };
    photometry panel         = web;
    panel.opening            = OPENING_RECTANGLE;
    panel.length             = 1.2f;
    panel.width              = 0.3f;
    const luminaire_model *m = luminaire_model_new(&a, &web, NULL);
    assert_non_null(m);
    luminaire_desc d = { .aim = { 0, 1, -1 }, .rotate = 0.5f, .scale = { 1, 2, 3 }, .web = &panel };
    const light *own = light_luminaire(&a, &d, NULL);
    d.model          = m;
    const light *shared = light_luminaire(&a, &d, NULL);

    vvec3 p = vspread((vec3){ 0.25f, 0.5f, -1.0f });
    vlight_sample x, y;
    assert_true(vall(light_sample(own, &p, vsplat(0.3f), vsplat(0.6f), ALL_LANES, &x)));
    assert_true(vall(light_sample(shared, &p, vsplat(0.3f), vsplat(0.6f), ALL_LANES, &y)));
    assert_memory_equal(&x, &y, sizeof x);
    vfloat error, same;
    assert_true(vall(own->type->as_point(own, &p, ALL_LANES, &x, &error)));
    assert_true(vall(shared->type->as_point(shared, &p, ALL_LANES, &y, &same)));
    assert_memory_equal(&error, &same, sizeof error);
    light_bounds b = light_bounds_of(own), c = light_bounds_of(shared);
    assert_near(c.peak, b.peak, 0.0);
    arena_clear(&a);
}

/* The model of a web with 4 planes is some 16 KB; a lamp a fraction of one. */
TEST(a_lamp_of_a_model_takes_no_more_room_for_its_web)
{
    arena a          = { 0 };
    luminaire_desc d = { .aim   = { 0, 0, -1 },
                         .scale = { 1, 1, 1 },
                         .web   = &web,
                         .model = luminaire_model_new(&a, &web, NULL) };
    uintptr_t first  = (uintptr_t)light_luminaire(&a, &d, NULL);
    uintptr_t second = (uintptr_t)light_luminaire(&a, &d, NULL);
    assert_in_range(second - first, 1, 512);
    arena_clear(&a);
}

TEST(no_model_is_made_of_what_is_no_web)
{
    arena a        = { 0 };
    lux_error err  = { 0 };
    photometry bad = web;
    bad.gamma_deg  = (const float[]){ 90, 0 };
    assert_null(luminaire_model_new(&a, &bad, &err));
    assert_int_equal(err.code, ERR_ARGUMENT);
    memory_is_out = true;
    assert_null(luminaire_model_new(&a, &web, &err));
    memory_is_out = false;
    assert_int_equal(err.code, ERR_MEMORY);
    arena_clear(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(aimed_down_c0_lies_along_x_and_c90_along_y),
        cmocka_unit_test(above_the_last_gamma_it_is_dark),
        cmocka_unit_test(rotate_turns_counter_clockwise_seen_from_above),
        cmocka_unit_test(aimed_along_x_c0_points_up),
        cmocka_unit_test(aimed_along_y_c90_points_up),
        cmocka_unit_test(aimed_up_it_is_turned_about_c0),
        cmocka_unit_test(an_oblique_aim_takes_the_shortest_turn),
        cmocka_unit_test(the_axis_of_the_turn_stays_where_it_is),
        cmocka_unit_test(dark_lanes_are_zero),
        cmocka_unit_test(what_makes_no_sense_is_refused),
        cmocka_unit_test(lamps_of_one_model_shine_as_those_that_have_their_own),
        cmocka_unit_test(a_lamp_of_a_model_takes_no_more_room_for_its_web),
        cmocka_unit_test(no_model_is_made_of_what_is_no_web),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
