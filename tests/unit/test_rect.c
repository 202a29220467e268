/* tests/unit/test_rect.c -- the rectangular light against closed forms, published and of a twin. */
#include "tests/flat_twin.h"
#include "tests/test.h"

/* The corners as light.h describes them: width along aim x up. */
static flat_twin twin_of(const rect_desc *d)
{
    dvec3 n = d3_from(d->aim), up = d3_from(d->up);
    n           = d3_scale(n, 1.0 / d3_length(n));
    up          = d3_sub(up, d3_scale(n, d3_dot(up, n)));
    up          = d3_scale(up, 0.5 * (double)d->height / d3_length(up));
    dvec3 right = d3_scale(d3_cross(n, up), (double)d->width / (double)d->height);
    dvec3 c     = d3_from(d->centre);
    return (flat_twin){ .corners = 4,
                        .corner  = { d3_sub(d3_add(c, right), up), d3_sub(d3_sub(c, right), up),
                                     d3_add(d3_sub(c, right), up), d3_add(d3_add(c, right), up) } };
}

static vec3 random_vector(uint32_t *state) { return d3_to_float(twin_direction(state)); }

/* Sides of 0.1 to 1 m, one up to ten times the other. */
static const light *make(arena *a, uint32_t *state, flat_twin *f)
{
    rect_desc d = { .centre   = random_vector(state),
                    .aim      = random_vector(state),
                    .up       = random_vector(state),
                    .radiance = { 1, 1, 1 } };
    d.width     = (float)pow(10.0, -twin_random(state));
    d.height    = (float)pow(10.0, -twin_random(state));
    *f          = twin_of(&d);
    return light_rect(a, &d, NULL);
}

static double lit_by(rect_desc d, vec3 p, vec3 n)
{
    arena a        = { 0 };
    const light *l = light_rect(&a, &d, NULL);
    assert_non_null(l);
    double e = light_closed_form(l, d3_from(p), d3_from(n));
    arena_clear(&a);
    return e;
}

/* 1 x 0.8 m, 1.5 m away. */
TEST(published_view_factors_of_a_parallel_and_a_perpendicular_rectangle)
{
    rect_desc d = { .centre   = { 0.5f, 0.4f, 1.5f },
                    .aim      = { 0, 0, -1 },
                    .up       = { 0, 1, 0 },
                    .width    = 1,
                    .height   = 0.8f,
                    .radiance = { 1, 1, 1 } };
    assert_near(lit_by(d, (vec3){ 0, 0, 0 }, (vec3){ 0, 0, 1 }) / M_PI, 0.0766960, 1e-6);
    d.centre = (vec3){ 0.5f, 1.5f, 0.4f };
    d.aim    = (vec3){ 0, -1, 0 };
    d.up     = (vec3){ 0, 0, 1 };
    assert_near(lit_by(d, (vec3){ 0, 0, 0 }, (vec3){ 0, 0, 1 }) / M_PI, 0.0189131, 3e-6);
}

/* CIE 171:2006: a luminaire of 1 x 1 m and 1000 cd/m2 in the ceiling of a room of 4 x 4 x 3 m;
 * exact values to three digits after the point, by quadrature. */
TEST(the_luminaire_of_cie_171_case_5_3_lights_wall_and_floor)
{
    static const double wall[]   = { 32.677, 75.194, 81.323, 69.061, 53.404, 40.002 };
    static const double floor_[] = { 61.424, 79.255, 95.667, 105.778 };
    rect_desc d                  = { .centre   = { 2, 2, 3 },
                                     .aim      = { 0, 0, -1 },
                                     .up       = { 0, 1, 0 },
                                     .width    = 1,
                                     .height   = 1,
                                     .radiance = { 1000, 1000, 1000 } };
    for (int i = 0; i < 6; i++)
        assert_near(lit_by(d, (vec3){ 2, 0, 2.75f - 0.5f * (float)i }, (vec3){ 0, 1, 0 }), wall[i],
                    2e-5);
    for (int i = 0; i < 8; i++)
        assert_near(lit_by(d, (vec3){ 2, 0.25f + 0.5f * (float)i, 0 }, (vec3){ 0, 0, 1 }),
                    floor_[i < 4 ? i : 7 - i], 2e-5);
}

TEST(the_twin_agrees_with_quadrature)
{
    uint32_t at = 3;
    for (int i = 0; i < 20; i++) {
        arena a = { 0 };
        flat_twin f;
        make(&a, &at, &f);
        dvec3 p, n;
        twin_place(&f, 1.0, 10.0, &at, &p, &n);
        double off = twin_quadrature(&f, p, n, 200) - twin_irradiance(&f, p, n);
        assert_true(fabs(off) < 1e-4 * twin_facing(&f, p)); /* the midpoint rule, at the horizon */
        arena_clear(&a);
    }
}

TEST(the_closed_form_is_its_twin) { check_closed_form(make, 0.02, 1000.0); }

TEST(sixty_four_samples_are_within_5e_3) { check_sampled(make, 0.7, 100.0); }

TEST(as_a_point_it_is_off_by_no_more_than_the_bound) { check_as_point(make); }

TEST(weights_are_positive_wherever_it_is_seen) { check_weight(make); }

static const rect_desc desk = {
    .aim = { 0, 0, 1 }, .up = { 0, 1, 0 }, .width = 1, .height = 0.8f, .radiance = { 1, 1, 1 }
};

TEST(close_by_nothing_exceeds_pi_l)
{
    arena a          = { 0 };
    const light *l   = light_rect(&a, &desk, NULL);
    dvec3 up         = { 0, 0, 1 };
    flat_twin f      = twin_of(&desk);
    const dvec3 at[] = { { 0, 0, 0 },     { 0.3, -0.1, 0 },  { 0.5, 0, 0 },   { 0, 0.4, 0 },
                         { 0.5, 0.4, 0 }, { 0.499, 0.1, 0 }, { 0.501, 0, 0 }, { 0.8, 0.4, 0 } };
    for (int i = 0; i < 8; i++)
        check_near(l, &f, at[i], up, 4e-3);
    assert_near(light_closed_form(l, (dvec3){ 0, 0, 1e-6 }, (dvec3){ 0, 0, -1 }), M_PI, 1e-6);
    assert_near(light_closed_form(l, (dvec3){ 0.5, 0, 1e-6 }, (dvec3){ 0, 0, -1 }), M_PI / 2, 1e-5);
    arena_clear(&a);
}

/* Far, near, above an edge, grazing, a tenth of a millimetre above, and beside a corner. */
/* Where the solid angle rounds to more than 2 pi a sensor was in the dark: 0.1 um below the middle.
 */
TEST(just_below_its_middle_it_fills_half_of_all_there_is)
{
    arena a     = { 0 };
    rect_desc d = { .centre   = { -1, -0.5f, 1.15f },
                    .aim      = { 0, 0, -1 },
                    .up       = { 0, 1, 0 },
                    .width    = 1,
                    .height   = 1,
                    .radiance = { 1, 1, 1 } };
    for (int square = 0; square < 2; square++, d.height = 0.3f) {
        const light *l = light_rect(&a, &d, NULL);
        for (float h = 2e-7f; h < 1e-3f; h *= 1.5f) {
            vvec3 p      = vspread((vec3){ -1, -0.5f, 1.15f - h });
            vfloat third = vsplat(1.0f / 3.0f);
            vlight_sample s;
            assert_true(vbits(light_sample(l, &p, third, third, ALL_LANES, &s)) ==
                        vbits(ALL_LANES));
            assert_near(lane(s.e.x, 0), 2.0 * M_PI, 0.01); /* 4 h / side, and 1 mm */
        }
    }
    arena_clear(&a);
}

TEST(samples_follow_their_pdf)
{
    const vec3 places[] = { { 0, 0, 1000 },        { 3, 1, 40 },          { 0.3f, -0.2f, 1 },
                            { 0.5f, 0, 0.1f },     { 3, 1, 0.1f },        { 1.5f, 0, 1e-3f },
                            { 0.1f, 0.1f, 1e-4f }, { 0.7f, 0.6f, 0.02f }, { 5, 0, 0.004f } };
    arena a             = { 0 };
    const light *l      = light_rect(&a, &desk, NULL);
    flat_twin f         = twin_of(&desk);
    for (int i = 0; i < 9; i++) {
        double by_chance = light_follows_its_pdf(l, &f, d3_from(places[i]));
        if (!(by_chance > 0.01))
            fail_msg("place %d: p = %g", i, by_chance);
    }
    arena_clear(&a);
}

TEST(dead_and_dark_lanes_are_zero)
{
    arena a        = { 0 };
    const light *l = light_rect(&a, &desk, NULL);
    check_lanes(l, (dvec3){ 0.2, 0.1, 3 }, &(dvec3){ 0.2, 0.1, -3 });
    check_lanes(l, (dvec3){ 0.2, 0.1, 3 }, &(dvec3){ 2, 0.1, 0 });
    arena_clear(&a);
}

TEST(flux_peak_and_bounds_are_those_of_a_matt_rectangle)
{
    arena a        = { 0 };
    rect_desc d    = { .centre   = { 1, 2, 3 },
                       .aim      = { 0, 0, -2 },
                       .up       = { 0, 3, 1 },
                       .width    = 2,
                       .height   = 0.5f,
                       .radiance = { 3, 2, 1 } };
    const light *l = light_rect(&a, &d, NULL);
    vec3 toward, peak = l->type->peak(l, &toward);
    assert_near(light_flux(l).y, 2 * M_PI, 1e-6);
    assert_near(peak.x, 3.0, 1e-6);
    assert_near(toward.z, -1.0, 1e-6);
    light_bounds b = light_bounds_of(l);
    assert_near(b.low.x, 0.0, 1e-6); /* the width lies along +x */
    assert_near(b.high.y, 2.25, 1e-6);
    assert_near(b.low.z, 3.0, 1e-6);
    assert_near(b.peak, 0.2126 * 3 + 0.7152 * 2 + 0.0722, 1e-6);
    assert_true(b.cos_spread == 1.0f && b.cos_reach == 0.0f && b.axis.z == -1.0f && !b.far);
    arena_clear(&a);
}

TEST(what_makes_no_sense_is_refused)
{
    arena a       = { 0 };
    lux_error err = { 0 };
    rect_desc d   = desk;
    d.aim         = (vec3){ 0, 0, 0 };
    assert_null(light_rect(&a, &d, &err));
    assert_int_equal(err.code, ERR_ARGUMENT);
    d    = desk;
    d.up = (vec3){ 0, 0, -5 };
    assert_null(light_rect(&a, &d, &err));
    d       = desk;
    d.width = 0;
    assert_null(light_rect(&a, &d, &err));
    d        = desk;
    d.height = NAN;
    assert_null(light_rect(&a, &d, &err));
    d          = desk;
    d.radiance = (vec3){ 1, -1, 1 };
    assert_null(light_rect(&a, &d, &err));
    arena_clear(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(published_view_factors_of_a_parallel_and_a_perpendicular_rectangle),
        cmocka_unit_test(the_luminaire_of_cie_171_case_5_3_lights_wall_and_floor),
        cmocka_unit_test(the_twin_agrees_with_quadrature),
        cmocka_unit_test(the_closed_form_is_its_twin),
        cmocka_unit_test(sixty_four_samples_are_within_5e_3),
        cmocka_unit_test(as_a_point_it_is_off_by_no_more_than_the_bound),
        cmocka_unit_test(weights_are_positive_wherever_it_is_seen),
        cmocka_unit_test(close_by_nothing_exceeds_pi_l),
        cmocka_unit_test(just_below_its_middle_it_fills_half_of_all_there_is),
        cmocka_unit_test(samples_follow_their_pdf),
        cmocka_unit_test(dead_and_dark_lanes_are_zero),
        cmocka_unit_test(flux_peak_and_bounds_are_those_of_a_matt_rectangle),
        cmocka_unit_test(what_makes_no_sense_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
