/* tests/unit/test_triangle.c -- the triangle of a glowing surface against closed forms of a twin.
 */
#include "tests/flat_twin.h"
#include "tests/test.h"

static flat_twin twin_of(const triangle_desc *d)
{
    flat_twin f = { .corners = 3, .two_sided = true };
    for (int i = 0; i < 3; i++)
        f.corner[i] = d3_from(d->corner[i]);
    return f;
}

/* Corners within a ball of 1 m; slivers too, down to a height of 0.02 of a side. */
static const light *make(arena *a, uint32_t *state, flat_twin *f)
{
    triangle_desc d = { .radiance = { 1, 1, 1 } };
    double thin;
    do {
        for (int i = 0; i < 3; i++)
            d.corner[i] = d3_to_float(d3_scale(twin_direction(state), cbrt(twin_random(state))));
        *f      = twin_of(&d);
        dvec3 n = d3_cross(d3_sub(f->corner[1], f->corner[0]), d3_sub(f->corner[2], f->corner[0]));
        double len = twin_size(f);
        thin       = d3_length(n) / (len * len);
    } while (thin < 0.05);
    return light_triangle(a, &d, NULL);
}

TEST(the_closed_form_is_its_twin) { check_closed_form(make, 0.02, 1000.0); }

TEST(sixty_four_samples_are_within_5e_3) { check_sampled(make, 0.7, 100.0); }

TEST(as_a_point_it_is_off_by_no_more_than_the_bound) { check_as_point(make); }

TEST(weights_are_positive_wherever_it_is_seen) { check_weight(make); }

static const triangle_desc sail = { .corner   = { { 0, 0, 0 }, { 1, 0, 0 }, { 0.3f, 0.8f, 0 } },
                                    .radiance = { 1, 1, 1 } };

TEST(close_by_nothing_exceeds_pi_l)
{
    arena a          = { 0 };
    const light *l   = light_triangle(&a, &sail, NULL);
    flat_twin f      = twin_of(&sail);
    const dvec3 at[] = { { 0.4, 0.25, 0 }, { 0.45, 0.02, 0 }, { 0.5, 0, 0 },
                         { 0, 0, 0 },      { 0.5, -0.05, 0 }, { 0.99, 0.001, 0 } };
    for (int i = 0; i < 6; i++)
        for (int side = -1; side <= 1; side += 2)
            check_near(l, &f, at[i], (dvec3){ 0, 0, side }, 2e-2);
    assert_near(light_closed_form(l, (dvec3){ 0.4, 0.2, 1e-6 }, (dvec3){ 0, 0, -1 }), M_PI, 1e-5);
    assert_near(light_closed_form(l, (dvec3){ 0.5, 0, 1e-6 }, (dvec3){ 0, 0, -1 }), M_PI / 2, 1e-5);
    arena_clear(&a);
}

/* Far, near, above an edge, grazing, from below, a tenth of a millimetre above. */
TEST(samples_follow_their_pdf)
{
    const vec3 places[] = { { 0, 0, 1000 },        { 3, 1, 40 },          { 0.3f, -0.2f, 1 },
                            { 0.5f, 0, 0.1f },     { 3, 1, 0.1f },        { 1.5f, 0, 1e-3f },
                            { 0.1f, 0.1f, -0.3f }, { 0.4f, 0.3f, 0.01f }, { 0.7f, 0.6f, -0.02f } };
    arena a             = { 0 };
    const light *l      = light_triangle(&a, &sail, NULL);
    flat_twin f         = twin_of(&sail);
    for (int i = 0; i < 9; i++) {
        double by_chance = light_follows_its_pdf(l, &f, d3_from(places[i]));
        if (!(by_chance > 0.01))
            fail_msg("place %d: p = %g", i, by_chance);
    }
    arena_clear(&a);
}

/* 1 m long and 1 mm high, seen from near and far. */
TEST(samples_of_a_sliver_follow_their_pdf)
{
    const triangle_desc d = { .corner   = { { 0, 0, 0 }, { 1, 0, 0 }, { 0.3f, 1e-3f, 0 } },
                              .radiance = { 1, 1, 1 } };
    const vec3 places[]   = {
          { 0.3f, -0.2f, 1 }, { 0.5f, 0.1f, 0.1f }, { 3, 1, 20 }, { 2, 0.1f, 1 }
    };
    arena a        = { 0 };
    const light *l = light_triangle(&a, &d, NULL);
    flat_twin f    = twin_of(&d);
    for (int i = 0; i < 4; i++) {
        double by_chance = light_follows_its_pdf(l, &f, d3_from(places[i]));
        if (!(by_chance > 0.01))
            fail_msg("place %d: p = %g", i, by_chance);
    }
    arena_clear(&a);
}

TEST(dead_and_dark_lanes_are_zero)
{
    arena a        = { 0 };
    const light *l = light_triangle(&a, &sail, NULL);
    check_lanes(l, (dvec3){ 0.2, 0.1, -3 }, NULL);
    check_lanes(l, (dvec3){ 0.2, 0.1, 3 }, &(dvec3){ 2, 0.1, 0 });
    arena_clear(&a);
}

TEST(flux_peak_and_bounds_are_those_of_both_sides)
{
    arena a        = { 0 };
    const light *l = light_triangle(&a, &sail, NULL);
    vec3 toward, peak = l->type->peak(l, &toward);
    assert_near(light_flux(l).x, 0.8 * M_PI, 1e-6);
    assert_near(peak.y, 0.4, 1e-6);
    assert_near(fabsf(toward.z), 1.0, 1e-6);
    light_bounds b = light_bounds_of(l);
    assert_near(b.low.x + 1.0f, 1.0, 1e-6);
    assert_near(b.high.y, 0.8, 1e-6);
    assert_near(b.peak, 0.4, 1e-6);
    assert_true(b.cos_spread == -1.0f && b.cos_reach == 0.0f && !b.far);
    arena_clear(&a);
}

TEST(what_makes_no_sense_is_refused)
{
    arena a         = { 0 };
    lux_error err   = { 0 };
    triangle_desc d = sail;
    d.corner[2]     = (vec3){ 2, 0, 0 };
    assert_null(light_triangle(&a, &d, &err));
    assert_int_equal(err.code, ERR_ARGUMENT);
    d.corner[2] = (vec3){ NAN, 0, 0 };
    assert_null(light_triangle(&a, &d, &err));
    d          = sail;
    d.radiance = (vec3){ 1, -1, 1 };
    assert_null(light_triangle(&a, &d, &err));
    arena_clear(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_closed_form_is_its_twin),
        cmocka_unit_test(sixty_four_samples_are_within_5e_3),
        cmocka_unit_test(as_a_point_it_is_off_by_no_more_than_the_bound),
        cmocka_unit_test(weights_are_positive_wherever_it_is_seen),
        cmocka_unit_test(close_by_nothing_exceeds_pi_l),
        cmocka_unit_test(samples_follow_their_pdf),
        cmocka_unit_test(samples_of_a_sliver_follow_their_pdf),
        cmocka_unit_test(dead_and_dark_lanes_are_zero),
        cmocka_unit_test(flux_peak_and_bounds_are_those_of_both_sides),
        cmocka_unit_test(what_makes_no_sense_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
