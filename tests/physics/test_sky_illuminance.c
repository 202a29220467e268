/* tests/physics/test_sky_illuminance.c -- what the skies give to sensors that see all of them:
 * through the whole program, against E_hz / Lz of ISO 15469 and integrals in double.
 *
 * Nothing stands around, and the ground is black. Tolerance: the quadrature (2e-4), and the larger
 * of the accuracy asked for and the interval of 99.9 %.
 */
#include "core/color.h"
#include "tests/gltf_text.h"
#include "tests/lab.h"
#include "tests/test.h"
#include "tests/two_angle_twin.h"

static const double e_hz = 10000.0, accuracy = 0.005;

/* Level; upright, toward the sun, off it and away; tilted toward it and away; face down */
enum { SENSORS = 8 };
static const double tilts[SENSORS]  = { 0, 90, 90, 90, 90, 30, 60, 180 };
static const double around[SENSORS] = { 0, 0, 90, 200, 180, 0, 180, 0 };

/* The sun is in the east, +x. */
static void place_sensors(lab_probe p[SENSORS])
{
    for (int i = 0; i < SENSORS; i++) {
        double t = tilts[i] * M_PI / 180.0, a = around[i] * M_PI / 180.0;
        p[i] = (lab_probe){ { i, 2, 1 }, { sin(t) * cos(a), sin(t) * sin(a), cos(t) } };
    }
}

static double zenith_of(const scene *s)
{
    assert_int_equal(s->sky_count, 1); /* no ground */
    return sky_green(s->skies[0].sky, (vec3){ 0, 0, 1 }) * LUMENS_PER_WATT;
}

/* ---- CIE S 011 ------------------------------------------------------------------------------- */

/* The parameters of reference.md 3.2; 0: uniform, 16: (1 + 2 sin h) / 3 */
static const double parameters[17][5] = {
    { 0, -1, 0, -1, 0 },           { 4, -0.7, 0, -1, 0 },        { 4, -0.7, 2, -1.5, 0.15 },
    { 1.1, -0.8, 0, -1, 0 },       { 1.1, -0.8, 2, -1.5, 0.15 }, { 0, -1, 0, -1, 0 },
    { 0, -1, 2, -1.5, 0.15 },      { 0, -1, 5, -2.5, 0.30 },     { 0, -1, 10, -3, 0.45 },
    { -1, -0.55, 2, -1.5, 0.15 },  { -1, -0.55, 5, -2.5, 0.30 }, { -1, -0.55, 10, -3, 0.45 },
    { -1, -0.32, 10, -3, 0.45 },   { -1, -0.32, 16, -3, 0.30 },  { -1, -0.15, 16, -3, 0.30 },
    { -1, -0.15, 24, -2.8, 0.15 },
};

/* E_hz / Lz at 15, 30, 45, 60 and 75 degrees of sun */
static const double level[17][5] = {
    { M_PI, M_PI, M_PI, M_PI, M_PI },           { 2.4495, 2.4495, 2.4495, 2.4495, 2.4495 },
    { 2.6615, 2.5566, 2.3635, 2.0860, 1.7464 }, { 2.7700, 2.7700, 2.7700, 2.7700, 2.7700 },
    { 3.0298, 2.8901, 2.6467, 2.3154, 1.9268 }, { 3.1416, 3.1416, 3.1416, 3.1416, 3.1416 },
    { 3.4558, 3.2778, 2.9775, 2.5842, 2.1385 }, { 3.9021, 3.6730, 3.1431, 2.4212, 1.6713 },
    { 4.4211, 4.1231, 3.3387, 2.3284, 1.4030 }, { 4.8652, 4.5528, 4.0587, 3.4593, 2.8266 },
    { 5.5937, 5.1449, 4.2534, 3.1703, 2.1391 }, { 6.4517, 5.8176, 4.4854, 2.9891, 1.7468 },
    { 7.2048, 6.3941, 4.8485, 3.1906, 1.8505 }, { 8.0729, 6.9952, 4.9827, 3.0259, 1.6309 },
    { 9.1176, 7.7081, 5.3753, 3.2170, 1.7195 }, { 10.338, 8.1160, 5.2711, 3.0159, 1.5926 },
    { 2.4435, 2.4435, 2.4435, 2.4435, 2.4435 },
};

/* Luminance over that of the zenith */
static double cie_luminance(int type, const double sun[3], const double w[3])
{
    const double *k = parameters[type];
    if (type == 16)
        return (1.0 + 2.0 * w[2]) / 3.0;
    angle_twin t     = { k[0], k[1], 1.0 - k[2] * exp(k[3] * M_PI / 2.0), k[2],
                         k[3], k[4], { sun[0], sun[1], sun[2] } };
    const double z[] = { 0, 0, 1 };
    return angle_twin_at(&t, w) / angle_twin_at(&t, z);
}

/* What each sensor gets of a sky of zenith luminance 1: midpoints above the horizon. */
static void cie_integrals(int type, double elevation_deg, const lab_probe *p, double out[SENSORS])
{
    enum { ROWS = 120, COLUMNS = 4 * ROWS };
    double h = elevation_deg * M_PI / 180.0, sun[3] = { cos(h), 0, sin(h) };
    double cell = M_PI / 2.0 / ROWS * 2.0 * M_PI / COLUMNS;
    for (int i = 0; i < SENSORS; i++)
        out[i] = 0.0;
    for (int i = 0; i < ROWS; i++)
        for (int j = 0; j < COLUMNS; j++) {
            double z = (i + 0.5) * M_PI / 2.0 / ROWS, a = (j + 0.5) * 2.0 * M_PI / COLUMNS;
            double w[3] = { sin(z) * cos(a), sin(z) * sin(a), cos(z) };
            double e    = cie_luminance(type, sun, w) * sin(z) * cell;
            for (int k = 0; k < SENSORS; k++)
                out[k] += e * fmax(d3_dot(p[k].normal, (dvec3){ w[0], w[1], w[2] }), 0.0);
        }
}

static void under_type(int type, int step)
{
    double elevation = 15.0 * (step + 1), want[SENSORS];
    lab l;
    lab_open(&l);
    lab_probe p[SENSORS];
    grid_result r;
    place_sensors(p);
    const char *model = type == 0    ? "uniform"
                        : type == 16 ? "overcast"
                                     : text_of(&l.a, "cie, type: %d", type);
    char *yaml        = text_of(&l.a,
                                "sky: {model: %s, sun: off, horizontal: %g, ground: 0,\n"
                                       "      sun_at: {azimuth: 90, elevation: %g}}\n",
                                model, e_hz, elevation);
    lab_measure(&l, yaml, NULL, p, SENSORS, &(run_options){ .accuracy = accuracy }, &r);

    /* The zenith by the table, to its last digit */
    const scene *s = lab_scene(&l, text_of(&l.a, "lux4: 1\n%s", yaml));
    double digit   = level[type][step] > 10.0 ? 5.1e-4 : 5.1e-5;
    assert_near(zenith_of(s), e_hz / level[type][step], 1e-6 + digit / level[type][step]);

    cie_integrals(type, elevation, p, want);
    assert_near(want[0], level[type][step], 2e-4);
    for (int i = 0; i < SENSORS; i++)
        want[i] *= e_hz / level[type][step];
    lab_check(text_of(&l.a, "type %d, %g degrees", type, elevation), &r, want, 3e-4, accuracy);
    assert_near(r.illuminance[SENSORS - 1], 0.0, 1e-6);
    for (int i = 0; i < SENSORS; i++)
        assert_near(r.direct[i], r.illuminance[i], 1e-6);
    lab_close(&l);
}

TEST(sensors_get_what_the_integrals_say_under_every_cie_sky)
{
    for (int type = 0; type <= 16; type++)
        for (int step = 0; step < 5; step++)
            under_type(type, step);
}

/* ---- tilts of reference.md 3.3 --------------------------------------------------------------- */

static void at_tilts(const char *model, const double deg[4], const double ratio[4])
{
    const double fine = 0.002;
    lab l;
    lab_open(&l);
    lab_probe p[4];
    double want[4];
    grid_result r;
    for (int i = 0; i < 4; i++) {
        double t = deg[i] * M_PI / 180.0;
        p[i]     = (lab_probe){ { i, 2, 1 }, { 0.6 * sin(t), -0.8 * sin(t), cos(t) } };
        want[i]  = ratio[i] * e_hz;
    }
    lab_measure(&l,
                text_of(&l.a,
                        "sky: {model: %s, sun: off, horizontal: %g, ground: 0,"
                        " sun_at: {azimuth: 90, elevation: 40}}\n",
                        model, e_hz),
                NULL, p, 4, &(run_options){ .accuracy = fine }, &r);
    lab_check(model, &r, want, 2e-5, fine);
    lab_close(&l);
}

TEST(slopes_under_overcast_skies_get_the_closed_forms)
{
    at_tilts("overcast", (const double[]){ 30, 45, 60, 120 },
             (const double[]){ 0.90320, 0.79747, 0.66943, 0.16943 });
    at_tilts("overcast", (const double[]){ 0, 90, 90, 90 },
             (const double[]){ 1, 0.396177, 0.396177, 0.396177 });
    at_tilts("cie, type: 1", (const double[]){ 0, 90, 90, 90 },
             (const double[]){ 1, 0.379182, 0.379182, 0.379182 });
    at_tilts("cie, type: 3", (const double[]){ 0, 90, 90, 90 },
             (const double[]){ 1, 0.446646, 0.446646, 0.446646 });
    double even[4], deg[4] = { 20, 65, 90, 135 };
    for (int i = 0; i < 4; i++)
        even[i] = 0.5 * (1.0 + cos(deg[i] * M_PI / 180.0));
    at_tilts("uniform", deg, even);
}

/* ---- Perez ----------------------------------------------------------------------------------- */

enum { TILTED = 4 };
static const double perez_tilt[TILTED] = { 0, 35, 90, 150 };

/* Midpoints are off by 1e-4 around a narrow corona, and by half a row's share where it is cut. */
static void perez_integrals(lab *l, const char *yaml, const double day[3], bool sun,
                            double want[TILTED])
{
    double h         = day[0] * M_PI / 180.0;
    perez_desc d     = { .to_sun             = { (float)cos(h), 0, (float)sin(h) },
                         .direct_normal      = day[1],
                         .diffuse_horizontal = day[2],
                         .dew_point_c        = (double)NAN,
                         .distance_au        = 1,
                         .color              = { 1, 1, 1 } };
    perez_figures of = { 0 };
    const scene *s   = lab_scene(l, text_of(&l->a, "lux4: 1\n%s", yaml));
    assert_non_null(sky_perez(&l->a, &d, &of, NULL));
    assert_int_equal(s->sky_count, 1);
    for (int i = 0; i < TILTED; i++) {
        double t = perez_tilt[i] * M_PI / 180.0;
        want[i]  = sky_on_tilted(s->skies[0].sky, perez_tilt[i], 360) * LUMENS_PER_WATT;
        if (i == 0)
            assert_near(want[i], of.diffuse_lx, 3e-4);
        if (sun)
            want[i] += of.direct_normal_lx * fmax(sin(h + t), 0.0);
    }
}

/* The sun in the east: elevation, direct normal and diffuse horizontal irradiance */
static void under_perez(const double day[3], bool sun)
{
    lab l;
    lab_open(&l);
    lab_probe p[TILTED];
    double want[TILTED];
    for (int i = 0; i < TILTED; i++) {
        double t = perez_tilt[i] * M_PI / 180.0;
        p[i]     = (lab_probe){ { i, 2, 1 }, { sin(t), 0, cos(t) } };
    }
    const char *yaml =
        text_of(&l.a,
                "sky: {model: perez, sun: %s, ground: 0, sun_at: {azimuth: 90, elevation: %g},\n"
                "      perez: {direct_normal: %g, diffuse_horizontal: %g}}\n",
                sun ? "on" : "off", day[0], day[1], day[2]);
    grid_result r;
    perez_integrals(&l, yaml, day, sun, want);
    lab_measure(&l, yaml, NULL, p, TILTED, &(run_options){ .accuracy = accuracy }, &r);
    lab_check(text_of(&l.a, "perez, sun %g degrees high", day[0]), &r, want, 5e-4, accuracy);
    lab_close(&l);
}

/* One of each bin of clearness. The sky is held against a twin elsewhere (unit/test_perez); here
 * what sensors get of it, and of the sun beside it. */
TEST(sensors_get_what_the_integrals_say_under_skies_of_perez)
{
    static const double some[][3] = { { 30, 0, 150 },   { 45, 30, 250 },  { 20, 120, 150 },
                                      { 50, 200, 260 }, { 35, 500, 230 }, { 60, 500, 220 },
                                      { 40, 800, 110 }, { 65, 900, 90 },  { 10, 400, 55 } };
    for (int day = 0; day < 9; day++) {
        under_perez(some[day], false);
        under_perez(some[day], true);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sensors_get_what_the_integrals_say_under_every_cie_sky),
        cmocka_unit_test(slopes_under_overcast_skies_get_the_closed_forms),
        cmocka_unit_test(sensors_get_what_the_integrals_say_under_skies_of_perez),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
