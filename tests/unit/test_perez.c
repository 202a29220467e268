/* tests/unit/test_perez.c -- the all-weather sky against a twin in double, whose tables were typed
 * in from another print: by coefficient, over the bins. */
#include "core/color.h"
#include "sky/sky.h"
#include "tests/shapes.h"
#include "tests/test.h"
#include "tests/two_angle_twin.h"

#include <string.h>

static const double pi = 3.14159265358979324;

static const double coefficient[20][8] = {
    { 1.3525, -1.2219, -1.1000, -0.5484, -0.6000, -1.0156, -1.0000, -1.0500 },
    { -0.2576, -0.7730, -0.2515, -0.6654, -0.3566, -0.3670, 0.0211, 0.0289 },
    { -0.2690, 1.4148, 0.8952, -0.2672, -2.5000, 1.0078, 0.5025, 0.4260 },
    { -1.4366, 1.1016, 0.0156, 0.7117, 2.3250, 1.4051, -0.5119, 0.3590 },
    { -0.7670, -0.2054, 0.2782, 0.7234, 0.2937, 0.2875, -0.3000, -0.3250 },
    { 0.0007, 0.0367, -0.1812, -0.6219, 0.0496, -0.5328, 0.1922, 0.1156 },
    { 1.2734, -3.9128, -4.5000, -5.6812, -5.6812, -3.8500, 0.7023, 0.7781 },
    { -0.1233, 0.9156, 1.1766, 2.6297, 1.8415, 3.3750, -1.6317, 0.0025 },
    { 2.8000, 6.9750, 24.7219, 33.3389, 21.0000, 14.0000, 19.0000, 31.0625 },
    { 0.6004, 0.1774, -13.0812, -18.3000, -4.7656, -0.9999, -5.0000, -14.5000 },
    { 1.2375, 6.4477, -37.7000, -62.2500, -21.5906, -7.1406, 1.2438, -46.1148 },
    { 1.0000, -0.1239, 34.8438, 52.0781, 7.2492, 7.5469, -1.9094, 55.3750 },
    { 1.8734, -1.5798, -5.0000, -3.5000, -3.5000, -3.4000, -4.0000, -7.2312 },
    { 0.6297, -0.5081, 1.5218, 0.0016, -0.1554, -0.1078, 0.0250, 0.4050 },
    { 0.9738, -1.7812, 3.9229, 1.1477, 1.4062, -1.0750, 0.3844, 13.3500 },
    { 0.2809, 0.1080, -2.6204, 0.1062, 0.3988, 1.5702, 0.2656, 0.6234 },
    { 0.0356, 0.2624, -0.0156, 0.4659, 0.0032, -0.0672, 1.0468, 1.5000 },
    { -0.1246, 0.0672, 0.1597, -0.3296, 0.0766, 0.4016, -0.3788, -0.6426 },
    { -0.5718, -0.2190, 0.4199, -0.0876, -0.0656, 0.3017, -2.4517, 1.8564 },
    { 0.9938, -0.4285, -0.5562, -0.0329, -0.1294, -0.4844, 1.4656, 0.5636 },
};
static const double efficacy[8][8] = {
    { 97.24, 107.22, 104.97, 102.39, 100.71, 106.42, 141.88, 152.23 },
    { -0.46, 1.15, 2.96, 5.59, 5.94, 3.83, 1.90, 0.35 },
    { 12.0, 0.59, -5.53, -13.95, -22.75, -36.15, -53.24, -45.27 },
    { -8.91, -3.95, -8.77, -13.9, -23.74, -28.83, -14.03, -7.98 },
    { 57.2, 98.99, 109.83, 110.34, 106.36, 107.19, 105.75, 101.18 },
    { -4.55, -3.46, -4.90, -5.84, -3.97, -1.25, 0.77, 1.58 },
    { -2.98, -1.21, -1.71, -1.99, -1.75, -1.51, -1.26, -1.10 },
    { 117.12, 12.38, -8.81, -4.56, -6.16, -26.73, -34.44, -8.29 },
};

static perez_desc desc_of(double elevation_deg, double direct, double diffuse)
{
    return (perez_desc){ .to_sun             = angle_twin_sun(elevation_deg),
                         .direct_normal      = direct,
                         .diffuse_horizontal = diffuse,
                         .dew_point_c        = (double)NAN,
                         .distance_au        = 1,
                         .color              = { 1, 1, 1 } };
}

/* epsilon, delta and the bin */
static int weather(const perez_desc *d, double *zenith, double *epsilon, double *delta)
{
    static const double ends[] = { 1.065, 1.23, 1.5, 1.95, 2.8, 4.5, 6.2, 1e9 };
    *zenith  = atan2(hypot((double)d->to_sun.x, (double)d->to_sun.y), (double)d->to_sun.z);
    double z = *zenith, h = 90 - z * 180 / pi,
           m = 1 / (cos(z) + 0.50572 * pow(h + 6.07995, -1.6364));
    double k = 1.041 * pow(z, 3);
    *epsilon = (1 + d->direct_normal / d->diffuse_horizontal + k) / (1 + k);
    *delta   = m * d->diffuse_horizontal / 1367 * d->distance_au * d->distance_au;
    int bin  = 0;
    while (*epsilon >= ends[bin])
        bin++;
    return bin;
}

static angle_twin twin_of(const perez_desc *d)
{
    double z, epsilon, delta, x[5];
    int bin = weather(d, &z, &epsilon, &delta);
    delta   = fmin(fmax(delta, bin >= 1 && bin <= 4 ? 0.2 : 0.01), 0.6);
    for (int i = 0; i < 5; i++)
        x[i] = coefficient[4 * i][bin] + coefficient[4 * i + 1][bin] * z +
               delta * (coefficient[4 * i + 2][bin] + coefficient[4 * i + 3][bin] * z);
    if (bin == 0) {
        x[2] = exp(pow(delta * (2.8 + 0.6004 * z), 1.2375)) - 1;
        x[3] = -exp(delta * (1.8734 + 0.6297 * z)) + 0.9738 + 0.2809 * delta;
    }
    double s[3] = { (double)d->to_sun.x, (double)d->to_sun.y, (double)d->to_sun.z };
    double size = sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]);
    return (angle_twin){
        x[0], fmin(x[1], 0), 1, x[2], x[3], x[4], { s[0] / size, s[1] / size, s[2] / size }
    };
}

/* One of each bin, from overcast to clear */
static const double days[][3] = { { 30, 0, 150 },   { 45, 30, 250 },  { 20, 120, 150 },
                                  { 50, 200, 260 }, { 35, 500, 230 }, { 60, 500, 220 },
                                  { 40, 800, 110 }, { 65, 900, 90 },  { 10, 400, 55 },
                                  { 2, 20, 20 },    { 89, 950, 100 } };
enum { DAYS = sizeof days / sizeof *days };

TEST(clearness_brightness_and_light_are_as_the_papers_say)
{
    arena a    = { 0 };
    int seen   = 0;
    double dew = 4.5;
    for (int i = 0; i < DAYS; i++)
        for (int k = 0; k < 2; k++) {
            perez_desc d  = desc_of(days[i][0], days[i][1], days[i][2]);
            d.distance_au = k ? 1.0167 : 1;
            d.dew_point_c = k ? dew : (double)NAN;
            perez_figures f;
            const sky *s = sky_perez(&a, &d, &f, NULL);
            assert_non_null(s);
            double z, epsilon, delta, water = exp(0.07 * (k ? dew : 11.0) - 0.075);
            int bin = weather(&d, &z, &epsilon, &delta);
            seen |= 1 << bin;
            assert_near(f.clearness, epsilon, 1e-9);
            assert_near(f.brightness, delta, 1e-9);
            double sky_lm = efficacy[0][bin] + efficacy[1][bin] * water +
                            efficacy[2][bin] * cos(z) + efficacy[3][bin] * log(delta);
            double sun_lm = efficacy[4][bin] + efficacy[5][bin] * water +
                            efficacy[6][bin] * exp(5.73 * z - 5) + efficacy[7][bin] * delta;
            assert_near(f.diffuse_lx, days[i][2] * sky_lm, 1e-9);
            assert_near(f.direct_normal_lx, days[i][1] * fmax(sun_lm, 0), 1e-9);
            assert_true(f.diffuse_lx / days[i][2] > 80 && f.diffuse_lx / days[i][2] < 180);
            assert_near((double)s->horizontal.y * LUMENS_PER_WATT, f.diffuse_lx, 1e-6);
        }
    assert_int_equal(seen, 0xff);
    arena_clear(&a);
}

/* By midpoints over all directions, which are off by that around a narrow corona */
TEST(level_ground_gets_the_diffuse_illuminance)
{
    arena a = { 0 };
    for (int i = 0; i < DAYS; i++) {
        perez_desc d = desc_of(days[i][0], days[i][1], days[i][2]);
        perez_figures f;
        const sky *s = sky_perez(&a, &d, &f, NULL);
        assert_near(sky_on_tilted(s, 0, 600) * LUMENS_PER_WATT, f.diffuse_lx, 1e-4);
    }
    arena_clear(&a);
}

/* Relative to itself, or to a hundredth of the mean where the two factors all but vanish */
TEST(radiance_is_that_of_the_twin_in_all_directions)
{
    arena a       = { 0 };
    uint32_t seed = 5;
    double worst  = 0;
    for (int i = 0; i < DAYS; i++) {
        perez_desc d = desc_of(days[i][0], days[i][1], days[i][2]);
        perez_figures f;
        const sky *s = sky_perez(&a, &d, &f, NULL);
        angle_twin t = twin_of(&d);
        double even  = f.diffuse_lx / LUMENS_PER_WATT / pi;
        vec3 up      = { 0, 0, 1 };
        double scale = sky_green(s, up) / angle_twin_at(&t, (double[]){ 0, 0, 1 });
        assert_near(scale * angle_twin_level(&t, 300), even * pi, 5e-4); /* its midpoints */
        for (int k = 0; k < 1000; k++) {
            vec3 w = random_direction(&seed);
            w.z    = fabsf(w.z);
            if (k == 0)
                w = d.to_sun;
            else if (k == 1)
                w = (vec3){ 0.6f, 0.8f, 0 };
            else if (k < 100)
                w.z *= powf(10, -0.05f * (float)k);
            else if (k < 200)
                w = (vec3){ d.to_sun.x + w.x * 1e-2f, d.to_sun.y + w.y * 1e-2f,
                            d.to_sun.z + w.z * 1e-2f };
            w = v3_scale(w, 1 / v3_length(w));
            double want =
                scale * angle_twin_at(&t, (double[]){ (double)w.x, (double)w.y, (double)w.z });
            double off = fabs(sky_green(s, w) - want) / fmax(want, 0.01 * even);
            worst      = fmax(worst, off);
        }
    }
    print_message("           worst: %.2g\n", worst);
    assert_true(worst < 1e-5);
    arena_clear(&a);
}

/* All weather there may be: finite, never below 0, and the illuminance that it should */
TEST(no_weather_breaks_it)
{
    arena a   = { 0 };
    int count = 0, outside = 0;
    for (double h = 0.01; h <= 90; h += h < 1 ? 0.3 : 7)
        for (double direct = 0; direct <= 1400; direct = direct * 2 + 5)
            for (double diffuse = 0.5; diffuse <= 1200; diffuse *= 2.5) {
                perez_desc d = desc_of(h, direct, diffuse);
                perez_figures f;
                lux_error err = { 0 };
                const sky *s  = sky_perez(&a, &d, &f, &err);
                if (!s)
                    fail_msg("%g %g %g: %s", h, direct, diffuse, err.text);
                for (double at = 0; at < 3.2; at += 0.05) {
                    vec3 w   = { (float)cos(at), 0, (float)fabs(sin(at)) };
                    double l = sky_green(s, w);
                    assert_true(l >= 0 && l < 1e7);
                }
                assert_true(f.diffuse_lx > 0 && f.direct_normal_lx >= 0);
                assert_true(isfinite(f.diffuse_lx + f.direct_normal_lx));
                if (count++ % 16 == 0)
                    assert_near(sky_on_tilted(s, 0, 100) * LUMENS_PER_WATT, f.diffuse_lx, 0.02);
                outside += f.clamped;
            }
    assert_true(count > 1000 && outside > 100 && outside < count);
    arena_clear(&a);
}

TEST(borders_are_told)
{
    arena a = { 0 };
    perez_figures f;
    perez_desc in = desc_of(30, 0, 150), dark = desc_of(30, 0, 3), glare = desc_of(30, 0, 500);
    perez_desc thin = desc_of(45, 100, 100); /* delta of 0.1 in the fifth bin */
    assert_non_null(sky_perez(&a, &in, &f, NULL));
    assert_false(f.clamped);
    assert_non_null(sky_perez(&a, &dark, &f, NULL));
    assert_true(f.clamped && f.brightness < 0.01);
    assert_non_null(sky_perez(&a, &glare, &f, NULL));
    assert_true(f.clamped && f.brightness > 0.6);
    assert_non_null(sky_perez(&a, &thin, &f, NULL));
    assert_true(f.clamped && f.clearness > 1.065 && f.clearness < 2.8);
    assert_non_null(sky_perez(&a, &thin, NULL, NULL)); /* the figures may stay unasked */
    arena_clear(&a);
}

TEST(what_makes_no_sense_is_refused)
{
    arena a               = { 0 };
    lux_error err         = { 0 };
    const perez_desc good = desc_of(30, 100, 150);
    perez_desc d          = good;
    d.to_sun              = (vec3){ 0, 1, 0 }; /* night */
    assert_null(sky_perez(&a, &d, NULL, &err));
    assert_int_equal(err.code, ERR_ARGUMENT);
    assert_non_null(strstr(err.text, "horizon"));
    d.to_sun = (vec3){ 0, 0.6f, -0.8f };
    assert_null(sky_perez(&a, &d, NULL, &err));
    d.to_sun = (vec3){ 0, NAN, 0.5f };
    assert_null(sky_perez(&a, &d, NULL, &err));
    d                    = good;
    d.diffuse_horizontal = 0;
    assert_null(sky_perez(&a, &d, NULL, &err));
    d               = good;
    d.direct_normal = -1;
    assert_null(sky_perez(&a, &d, NULL, &err));
    d.direct_normal = (double)NAN;
    assert_null(sky_perez(&a, &d, NULL, &err));
    d             = good;
    d.distance_au = 0;
    assert_null(sky_perez(&a, &d, NULL, &err));
    d             = good;
    d.dew_point_c = 400;
    assert_null(sky_perez(&a, &d, NULL, &err));
    d         = good;
    d.color.x = -1;
    assert_null(sky_perez(&a, &d, NULL, &err));
    memory_is_out = true;
    arena none    = { 0 };
    assert_null(sky_perez(&none, &good, NULL, &err));
    memory_is_out = false;
    assert_int_equal(err.code, ERR_MEMORY);
    arena_clear(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(clearness_brightness_and_light_are_as_the_papers_say),
        cmocka_unit_test(level_ground_gets_the_diffuse_illuminance),
        cmocka_unit_test(radiance_is_that_of_the_twin_in_all_directions),
        cmocka_unit_test(no_weather_breaks_it),
        cmocka_unit_test(borders_are_told),
        cmocka_unit_test(what_makes_no_sense_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
