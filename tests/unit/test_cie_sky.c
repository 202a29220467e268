/* tests/unit/test_cie_sky.c -- the skies of CIE S 011, the traditional one, and the ground. */
#include "sky/gradation.h"
#include "tests/shapes.h"
#include "tests/test.h"
#include "tests/two_angle_twin.h"

static const double pi = 3.14159265358979324;

/* ISO 15469:2004, table 1 */
static const double parameters[16][5] = {
    { 0, -1, 0, -1, 0 },           { 4, -0.7, 0, -1, 0 },        { 4, -0.7, 2, -1.5, 0.15 },
    { 1.1, -0.8, 0, -1, 0 },       { 1.1, -0.8, 2, -1.5, 0.15 }, { 0, -1, 0, -1, 0 },
    { 0, -1, 2, -1.5, 0.15 },      { 0, -1, 5, -2.5, 0.30 },     { 0, -1, 10, -3, 0.45 },
    { -1, -0.55, 2, -1.5, 0.15 },  { -1, -0.55, 5, -2.5, 0.30 }, { -1, -0.55, 10, -3, 0.45 },
    { -1, -0.32, 10, -3, 0.45 },   { -1, -0.32, 16, -3, 0.30 },  { -1, -0.15, 16, -3, 0.30 },
    { -1, -0.15, 24, -2.8, 0.15 },
};

static angle_twin twin_of(int type, vec3 sun)
{
    const double *p = parameters[type];
    double length   = sqrt((double)sun.x * (double)sun.x + (double)sun.y * (double)sun.y +
                           (double)sun.z * (double)sun.z);
    return (
        angle_twin){ p[0],
                     p[1],
                     1 - p[2] * exp(p[3] * pi / 2),
                     p[2],
                     p[3],
                     p[4],
                     { (double)sun.x / length, (double)sun.y / length, (double)sun.z / length } };
}

static const sky *make(arena *a, int type, double elevation_deg)
{
    cie_desc d   = { type, angle_twin_sun(elevation_deg), 100, { 1, 1, 1 } };
    const sky *s = sky_cie(a, &d, NULL);
    assert_non_null(s);
    return s;
}

/* E_hz / L_z at 15, 30, 45, 60 and 75 degrees of sun; to the digits there are. */
TEST(level_ground_gets_what_the_reference_says_of_the_zenith)
{
    static const double table[16][5] = {
        { 2.4495, 2.4495, 2.4495, 2.4495, 2.4495 }, { 2.6615, 2.5566, 2.3635, 2.0860, 1.7464 },
        { 2.7700, 2.7700, 2.7700, 2.7700, 2.7700 }, { 3.0298, 2.8901, 2.6467, 2.3154, 1.9268 },
        { 3.1416, 3.1416, 3.1416, 3.1416, 3.1416 }, { 3.4558, 3.2778, 2.9775, 2.5842, 2.1385 },
        { 3.9021, 3.6730, 3.1431, 2.4212, 1.6713 }, { 4.4211, 4.1231, 3.3387, 2.3284, 1.4030 },
        { 4.8652, 4.5528, 4.0587, 3.4593, 2.8266 }, { 5.5937, 5.1449, 4.2534, 3.1703, 2.1391 },
        { 6.4517, 5.8176, 4.4854, 2.9891, 1.7468 }, { 7.2048, 6.3941, 4.8485, 3.1906, 1.8505 },
        { 8.0729, 6.9952, 4.9827, 3.0259, 1.6309 }, { 9.1176, 7.7081, 5.3753, 3.2170, 1.7195 },
        { 10.338, 8.1160, 5.2711, 3.0159, 1.5926 }, { 2.4435, 2.4435, 2.4435, 2.4435, 2.4435 },
    };
    arena a = { 0 };
    for (int type = 1; type <= 16; type++)
        for (int i = 0; i < 5; i++) {
            double want = table[type - 1][i], h = 15 * (i + 1);
            double digits = want > 10 ? 5e-4 : 5e-5;
            assert_true(fabs(1 / sky_cie_zenith(type, h) - want) <= 1.02 * digits);

            /* The same of the sky that is made */
            double zenith = sky_green(make(&a, type, h), (vec3){ 0, 0, 1 });
            assert_near(zenith, 100 * sky_cie_zenith(type, h), 1e-6);
        }
    assert_near(1 / sky_cie_zenith(SKY_UNIFORM, 33), pi, 1e-12);
    arena_clear(&a);
}

/* Without gradation, sun at the zenith: 2 pi (f0 / 2 + c (1 + exp(d pi/2)) / (d^2 + 4) + e / 4);
 * sun on the horizon: pi f0 + 4 c (exp(d pi) - 1) / (d (d^2 + 4)) + e pi / 4. */
TEST(the_integral_is_the_closed_form_without_gradation)
{
    for (int type = 6; type <= 8; type++) {
        const double *p = parameters[type];
        double c = p[2], d = p[3], e = p[4], f0 = 1 - c * exp(d * pi / 2);
        gradation g = { 0, -1, f0, c, d, e };
        double high = 2 * pi * (f0 / 2 + c * (1 + exp(d * pi / 2)) / (d * d + 4) + e / 4);
        double low  = pi * f0 + 4 * c * (exp(d * pi) - 1) / (d * (d * d + 4)) + e * pi / 4;
        assert_near(gradation_irradiance(&g, 0), high, 1e-9);
        assert_near(gradation_irradiance(&g, pi / 2), low, 1e-9);
    }
}

/* The midpoints are off by that near a sun at zenith or horizon; with 1600
 * rings by less than 1e-5. */
TEST(the_integral_is_that_of_the_twin)
{
    for (int type = 1; type < 16; type++)
        for (double h = 0; h <= 90; h += 45) {
            angle_twin t = twin_of(type, angle_twin_sun(h));
            gradation g  = { t.a, t.b, t.f0, t.c, t.d, t.e };
            double want  = angle_twin_level(&t, 200);
            assert_near(gradation_irradiance(&g, (90 - h) * pi / 180), want, h == 45 ? 6e-5 : 3e-4);
        }
}

TEST(radiance_is_that_of_the_twin_in_all_directions)
{
    arena a       = { 0 };
    uint32_t seed = 5;
    double worst  = 0;
    for (int type = 0; type < 16; type++)
        for (int h = 0; h <= 90; h += 10) {
            vec3 sun     = angle_twin_sun(h);
            const sky *s = make(&a, type, h);
            angle_twin t = twin_of(type, sun);
            double scale = 100 * sky_cie_zenith(type, h) / angle_twin_at(&t, (double[]){ 0, 0, 1 });
            for (int i = 0; i < 400; i++) {
                vec3 w = random_direction(&seed);
                w.z    = fabsf(w.z);
                if (i == 0) /* the zenith, the sun, the horizon, and next to them */
                    w = (vec3){ 0, 0, 1 };
                else if (i == 1)
                    w = sun;
                else if (i == 2)
                    w = (vec3){ 0.6f, 0.8f, 0 };
                else if (i == 3)
                    w = (vec3){ 0.6f, 0.8f, -0.0f };
                else if (i < 60)
                    w.z *= powf(10, -0.1f * (float)(i - 3));
                else if (i < 120)
                    w = (vec3){ sun.x + w.x * 1e-3f, sun.y + w.y * 1e-3f, sun.z + w.z * 1e-3f };
                w = v3_scale(w, 1 / v3_length(w));
                double want =
                    scale * angle_twin_at(&t, (double[]){ (double)w.x, (double)w.y, (double)w.z });
                worst = fmax(worst, fabs(sky_green(s, w) - want) / want);
                assert_near(sky_green(s, w), want, 1e-5);
            }
        }
    print_message("           worst: %.2g\n", worst);
    arena_clear(&a);
}

/* reference.md 3.3; 1e-4 of midpoints at the horizon's step */
TEST(walls_and_slopes_get_what_the_reference_says)
{
    arena a = { 0 };
    assert_near(sky_on_tilted(make(&a, 1, 40), 90, 400) / 100, 0.379182, 1e-4);
    assert_near(sky_on_tilted(make(&a, 3, 40), 90, 400) / 100, 0.446646, 1e-4);
    const sky *moon = make(&a, SKY_TRADITIONAL, 40), *even = make(&a, SKY_UNIFORM, 40);
    static const double slope[][2] = { { 0, 1 },        { 30, 0.90320 },  { 45, 0.79747 },
                                       { 60, 0.66943 }, { 90, 0.396177 }, { 120, 0.16943 } };
    for (int i = 0; i < 6; i++) {
        double tilt = slope[i][0];
        assert_near(sky_on_tilted(moon, tilt, 400) / 100, slope[i][1], 1e-4);
        double share = (1 + cos(tilt * pi / 180)) / 2;
        assert_near(sky_on_tilted(even, tilt, 400) / 100, share, 1e-4);
    }
    for (int type = 0; type <= 16; type++) /* of all types, what was asked */
        assert_near(sky_on_tilted(make(&a, type, 50), 0, 400), 100, 1e-4);
    arena_clear(&a);
}

TEST(colour_and_horizontal_are_what_was_asked)
{
    arena a    = { 0 };
    cie_desc d = { 12, angle_twin_sun(30), 50, { 0.7f, 1.0f, 1.8881f } };
    d.color.z  = (1 - 0.2126f * 0.7f - 0.7152f) / 0.0722f;
    for (d.type = 0; d.type <= 16; d.type++) {
        const sky *s = sky_cie(&a, &d, NULL);
        assert_non_null(s);
        assert_near(s->horizontal.x, 35, 1e-6);
        assert_near(s->horizontal.y, 50, 1e-6);
        assert_false(s->below);
        vvec3 wi = vspread((vec3){ 0.6f, 0, 0.8f });
        vrgb l   = sky_radiance(s, &wi, ALL_LANES);
        assert_near(lane(l.x, 0), 0.7 * (double)lane(l.y, 0), 1e-6);
    }
    d.type       = 12;
    d.horizontal = 0;
    assert_true(sky_green(sky_cie(&a, &d, NULL), (vec3){ 0, 0, 1 }) == 0);
    arena_clear(&a);
}

TEST(nothing_comes_from_below_and_dead_lanes_are_zero)
{
    arena a = { 0 };
    for (int type = 0; type <= 16; type++) {
        const sky *s = make(&a, type, 30);
        assert_true(sky_green(s, (vec3){ 0, 0, -1 }) == 0);
        assert_true(sky_green(s, (vec3){ 1, 0, -1e-6f }) == 0);
        vvec3 up = vspread((vec3){ 0, 0, 1 });
        vrgb l   = sky_radiance(s, &up, vlane_index() < 1);
        assert_true(lane(l.x, 0) > 0);
        for (int i = 1; i < LANES; i++)
            assert_true(lane(l.x, i) == 0 && lane(l.y, i) == 0 && lane(l.z, i) == 0);
    }
    arena_clear(&a);
}

TEST(ground_shines_from_below_alone)
{
    arena a      = { 0 };
    const sky *s = sky_ground(&a, (vec3){ 1, 2, 3 }, NULL);
    assert_true(s->below && s->horizontal.x == 0);
    assert_true(sky_green(s, (vec3){ 0, 0, 1 }) == 0 && sky_green(s, (vec3){ 1, 0, 0 }) == 0);
    assert_true(sky_green(s, (vec3){ 1, 0, -1e-6f }) == 2);
    assert_near(sky_on_tilted(s, 90, 200), pi, 1e-4);
    vvec3 down = vspread((vec3){ 0, 0, -1 });
    vrgb l     = sky_radiance(s, &down, vlane_index() < 1);
    for (int i = 1; i < LANES; i++)
        assert_true(lane(l.x, i) == 0 && lane(l.z, i) == 0);
    lux_error err = { 0 };
    assert_null(sky_ground(&a, (vec3){ 1, NAN, 1 }, &err));
    assert_int_equal(err.code, ERR_ARGUMENT);
    assert_null(sky_ground(&a, (vec3){ 1, INFINITY, 1 }, &err));
    arena_clear(&a);
}

TEST(what_makes_no_sense_is_refused)
{
    arena a             = { 0 };
    lux_error err       = { 0 };
    const cie_desc good = { 12, { 0, 0, 1 }, 1, { 1, 1, 1 } };
    cie_desc d          = good;
    d.type              = 17;
    assert_null(sky_cie(&a, &d, &err));
    assert_int_equal(err.code, ERR_ARGUMENT);
    d.type = -1;
    assert_null(sky_cie(&a, &d, &err));
    for (int type = 12; type <= 16; type += 4) {
        d            = good;
        d.type       = type;
        d.horizontal = (double)NAN;
        assert_null(sky_cie(&a, &d, &err));
        d.horizontal = -1;
        assert_null(sky_cie(&a, &d, &err));
        d.horizontal = 1;
        d.color      = (vec3){ 2, 2, 2 };
        assert_null(sky_cie(&a, &d, &err));
        d.color = (vec3){ NAN, 1, 1 };
        assert_null(sky_cie(&a, &d, &err));
    }
    d        = good;
    d.to_sun = (vec3){ 0, 0.6f, -0.8f };
    assert_null(sky_cie(&a, &d, &err));
    d.to_sun = (vec3){ 0, 0, 0 };
    assert_null(sky_cie(&a, &d, &err));
    d.to_sun = (vec3){ NAN, 0, 0 };
    assert_null(sky_cie(&a, &d, &err));
    d.type = 1; /* which does not look at the sun */
    assert_non_null(sky_cie(&a, &d, &err));
    memory_is_out = true;
    arena none    = { 0 };
    assert_null(sky_cie(&none, &good, &err));
    assert_null(sky_ground(&none, (vec3){ 1, 1, 1 }, &err));
    memory_is_out = false;
    assert_int_equal(err.code, ERR_MEMORY);
    arena_clear(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(level_ground_gets_what_the_reference_says_of_the_zenith),
        cmocka_unit_test(the_integral_is_the_closed_form_without_gradation),
        cmocka_unit_test(the_integral_is_that_of_the_twin),
        cmocka_unit_test(radiance_is_that_of_the_twin_in_all_directions),
        cmocka_unit_test(walls_and_slopes_get_what_the_reference_says),
        cmocka_unit_test(colour_and_horizontal_are_what_was_asked),
        cmocka_unit_test(nothing_comes_from_below_and_dead_lanes_are_zero),
        cmocka_unit_test(ground_shines_from_below_alone),
        cmocka_unit_test(what_makes_no_sense_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
