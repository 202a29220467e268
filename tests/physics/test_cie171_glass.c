/* tests/physics/test_cie171_glass.c -- CIE 171:2006 5.5, 5.10 and 5.12: what clear glass lets
 * through by angle, from the sky through a roof light or a window.
 *
 * Values are exact, from independent quadrature of the slab with n = 1.53, of which one way leaves
 * 0.964: it reproduces the publication's tables where those are right. Rooms are 4 x 4 x 3 m and
 * black; points A-F are on the wall at x = 2, G-N on the floor. Skies but the uniform one are
 * integrated here, through the material's own transmittance.
 */
#include "core/color.h"
#include "materials/material.h"
#include "tests/gltf_text.h"
#include "tests/slab.h"
#include "tests/test.h"

enum { WALL = 6, FLOOR = 8, POINTS = WALL + FLOOR };

static const double index_of_glass = 1.53, inner = 0.964;
static const dvec3 up = { 0, 0, 1 };

/* ---- 5.5: directional transmittance ---------------------------------------------------------- */

/* Lux of a facing sensor behind a pane under 1000 lx, so many degrees off the normal. */
static double lux_behind(double deg, double n, double transmittance, const char *more)
{
    lab l;
    lab_open(&l);
    quad pane = quad_level(0, 0, 0, 200);
    lab_quads(&l, "pane.gltf", &pane, 1, "\"name\":\"Glass\"");
    double turn = deg * M_PI / 180.0;
    dvec3 aim   = { 0.6 * sin(turn), 0.8 * sin(turn), -cos(turn) };
    lab_probe p = { { 0.1, 0.2, -1 }, d3_scale(aim, -1.0) };
    grid_result r;
    lab_measure(&l,
                text_of(&l.a,
                        "scene: pane.gltf\nlights: [{type: parallel, aim: [%.17g, %.17g, %.17g], "
                        "illuminance: 1000}]\nmaterials: [{match: Glass, transmittance: %.9g, "
                        "ior: %g%s}]",
                        aim.x, aim.y, aim.z, transmittance, n, more),
                NULL, &p, 1, &(run_options){ 0 }, &r);
    assert_near(r.direct[0], r.illuminance[0], 1e-6); /* thin glazing included */
    double lux = r.illuminance[0];
    lab_close(&l);
    return lux;
}

TEST(case_5_5_a_pane_lets_through_by_angle)
{
    static const double deg[10]     = { 0, 10, 20, 30, 40, 50, 60, 70, 80, 85 };
    static const double no_loss[10] = { .9183, .9183, .9179, .9160, .9095,
                                        .8912, .8435, .7247, .4560, .2456 };
    static const double clear[10]   = { .8828, .8826, .8816, .8786, .8709,
                                        .8515, .8036, .6876, .4268, .2217 };
    double most = slab_of(1.52, 1.0, 1.0).passed, real = slab_of(1.53, inner, 1.0).passed;
    for (int i = 0; i < 10; i++) {
        double c = cos(deg[i] * M_PI / 180.0);
        double a = lux_behind(deg[i], 1.52, most, ""), b = lux_behind(deg[i], 1.53, real, "");
        assert_near(a, 1000.0 * slab_of(1.52, 1.0, c).passed, 5e-6);
        assert_near(b, 1000.0 * slab_of(1.53, inner, c).passed, 5e-6);
        assert_true(fabs(a - 1000.0 * no_loss[i]) < 0.06); /* the table's last digit */
        assert_true(fabs(b - 1000.0 * clear[i]) < 0.06);
    }
}

/* ---- 5.10 with the whole program: the uniform sky -------------------------------------------- */

static const double down_the_wall[WALL] = { 2.75, 2.25, 1.75, 1.25, 0.75, 0.25 };

static void points_of_5_10(lab_probe p[POINTS])
{
    for (int i = 0; i < WALL; i++)
        p[i] = (lab_probe){ { 2, 0, down_the_wall[i] }, { 0, 1, 0 } };
    for (int i = 0; i < FLOOR; i++)
        p[WALL + i] = (lab_probe){ { 2, 0.25 + 0.5 * i, 0 }, up };
}

typedef struct opening {
    const material *pane;
    dvec3 out; /* the pane's normal, outward */
    dvec3 normal;
    double (*sky)(dvec3 wi); /* times E_hz: 1 */
} opening;

static double twin_passes(const void *context, dvec3 wi)
{
    const opening *o = context;
    double c         = d3_dot(wi, o->out);
    return slab_of(index_of_glass, inner, c).passed * fmax(d3_dot(wi, o->normal), 0.0) * o->sky(wi);
}

static double uniform(dvec3 wi)
{
    (void)wi;
    return 1.0 / M_PI;
}

/* Percent of E_hz, uniform sky: the table's rows */
static const double roof_1_uniform[POINTS] = { .348,  1.699, 2.122, 1.879, 1.476, 1.113, 1.717,
                                               2.222, 2.686, 2.972, 2.972, 2.686, 2.222, 1.717 };
static const double roof_4_uniform[POINTS] = { 31.366, 27.831, 22.928, 18.249, 14.330,
                                               11.225, 23.476, 27.163, 29.867, 31.284,
                                               31.284, 29.867, 27.163, 23.476 };

/* The sky is a glowing sheet of 6 x 6 m, 5 cm above the pane: from the points, the opening shows
 * nothing else. */
static void roof_light(double size, const double row[POINTS])
{
    lab l;
    lab_open(&l);
    double low = 2.0 - 0.5 * size, high = 2.0 + 0.5 * size;
    quad black[10], pane = quad_level(2, 2, 3, size), bright = quad_level(2, 2, 3.05, 6);
    quads_of_box((dvec3){ 0, 0, 0 }, (dvec3){ 4, 4, 3 }, black);
    black[1] = (quad){ { { 0, 0, 3 }, { 4, 0, 3 }, { 4, low, 3 }, { 0, low, 3 } } };
    black[6] = (quad){ { { 0, high, 3 }, { 4, high, 3 }, { 4, 4, 3 }, { 0, 4, 3 } } };
    black[7] = (quad){ { { 0, low, 3 }, { low, low, 3 }, { low, high, 3 }, { 0, high, 3 } } };
    black[8] = (quad){ { { high, low, 3 }, { 4, low, 3 }, { 4, high, 3 }, { high, high, 3 } } };
    if (size == 4.0)
        black[1] = black[0];
    lab_quads(&l, "walls.gltf", black, size < 4.0 ? 9 : 6, "\"name\":\"Black\"");
    lab_quads(&l, "pane.gltf", &pane, 1, "\"name\":\"Glass\"");
    lab_quads(&l, "sky.gltf", &bright, 1, lab_glow(&l, 1000.0 / M_PI));
    lab_probe p[POINTS];
    points_of_5_10(p);
    double want[POINTS];
    for (int i = 0; i < POINTS; i++) {
        opening o = { .out = up, .normal = p[i].normal, .sky = uniform };
        want[i]   = 1000.0 * quad_integral(&pane, p[i].at, 40, twin_passes, &o);
        assert_true(fabs(0.1 * want[i] - row[i]) < 6e-4 + 1e-4 * row[i]);
    }
    grid_result r;
    lab_measure(&l,
                text_of(&l.a,
                        "scene: [walls.gltf, pane.gltf, sky.gltf]\nmaterials:\n"
                        "  - {match: Black, reflectance: 0}\n"
                        "  - {match: Glass, transmittance: %.9g, ior: 1.53}\n",
                        slab_of(index_of_glass, inner, 1.0).passed),
                NULL, p, POINTS, &(run_options){ .accuracy = 0.02 }, &r);
    lab_check("5.10", &r, want, 2e-4, 0.02);
    for (int i = 0; i < POINTS; i++)
        assert_true(r.indirect[i] <= 1e-6 * r.direct[i]);
    lab_close(&l);
}

TEST(case_5_10_a_roof_light_of_1_m_under_the_uniform_sky) { roof_light(1.0, roof_1_uniform); }
TEST(case_5_10_a_roof_light_of_4_m_under_the_uniform_sky) { roof_light(4.0, roof_4_uniform); }

/* ---- 5.10, 5.12: other skies, through the material ------------------------------------------- */

/* CIE S 011: luminance over E_hz; the sun at 60 deg above the horizon, toward -y (5.12), +y (5.10)
 */
static double cie(dvec3 wi, dvec3 sun, const double k[5], double e_hz)
{
    double z = acos(wi.z), zs = acos(sun.z), chi = acos(fmin(d3_dot(wi, sun), 1.0));
    double f = 1.0 + k[2] * (exp(k[3] * chi) - exp(k[3] * M_PI / 2.0)) + k[4] * cos(chi) * cos(chi);
    double fs = 1.0 + k[2] * (exp(k[3] * zs) - exp(k[3] * M_PI / 2.0)) + k[4] * cos(zs) * cos(zs);
    return f * (1.0 + k[0] * exp(k[1] / cos(z))) / (fs * (1.0 + k[0] * exp(k[1]))) / e_hz;
}

static const double type_1[5] = { 4, -0.7, 0, -1, 0 }, type_12[5] = { -1, -0.32, 10, -3, 0.45 };
static const double ground = 0.3 / M_PI; /* luminance of it, reflectance 0.3, over E_hz */

static double overcast(dvec3 wi)
{
    return wi.z > 0.0 ? cie(wi, (dvec3){ 0, -0.5, sqrt(0.75) }, type_1, 2.4495) : ground;
}
static double even(dvec3 wi) { return wi.z > 0.0 ? 1.0 / M_PI : ground; }
static double clear_south(dvec3 wi)
{
    return wi.z > 0.0 ? cie(wi, (dvec3){ 0, -0.5, sqrt(0.75) }, type_12, 3.1906) : ground;
}
static double clear_north(dvec3 wi)
{
    return cie(wi, (dvec3){ 0, 0.5, sqrt(0.75) }, type_12, 3.1906);
}

static double material_passes(const void *context, dvec3 wi)
{
    const opening *o = context;
    vvec3 n          = vspread(d3_to_float(d3_scale(o->out, -1.0)));
    vvec3 wo         = vspread(d3_to_float(d3_scale(wi, -1.0)));
    vshading s = { .wo = wo, .n = n, .flat = n, .front = ALL_LANES, .distance = vsplat(1.0f) };
    vrgb t     = materials_through(&o->pane, vsplat_int(0), &s, ALL_LANES);
    return (double)lane(t.y, 0) * fmax(d3_dot(wi, o->normal), 0.0) * o->sky(wi);
}

/* Within half of the row's last digit, and 0.1 % for the quadrature and four digits of E_hz. */
static void under(double (*of_sky)(dvec3), const quad *pane, dvec3 out, const lab_probe *p,
                  int count, const double *row)
{
    arena a     = { 0 };
    float t     = (float)slab_of(index_of_glass, inner, 1.0).passed;
    opening o   = { .out = out, .sky = of_sky };
    pane_desc d = { .transmittance = { t, t, t }, .ior = (float)index_of_glass };
    o.pane      = material_pane(&a, &d, NULL);
    assert_non_null(o.pane);
    for (int i = 0; i < count; i++) {
        o.normal     = p[i].normal;
        double got   = 100.0 * quad_integral(pane, p[i].at, 40, material_passes, &o);
        double digit = row[i] < 10.0 ? 6e-4 : 6e-3;
        if (!(fabs(got - row[i]) <= digit + 1e-3 * row[i]))
            fail_msg("point %d: %.5g %%, not %.5g", i, got, row[i]);
    }
    arena_clear(&a);
}

TEST(case_5_10_the_pane_under_other_skies)
{
    static const double row[4][POINTS] = {
        { .153, 1.172, 1.918, 1.934, 1.629, 1.281, 2.051, 2.740, 3.386, 3.790, 3.790, 3.386, 2.740,
          2.051 },
        { .583, 2.667, 3.732, 3.944, 3.684, 3.178, 5.026, 5.288, 4.510, 3.502, 2.557, 1.795, 1.235,
          .847 },
        { 26.969, 25.276, 22.256, 18.735, 15.369, 12.449, 27.928, 32.740, 36.268, 38.113, 38.113,
          36.268, 32.740, 27.928 },
        { 47.274, 42.570, 36.419, 30.524, 25.351, 20.958, 37.006, 38.481, 38.199, 35.977, 31.590,
          25.718, 19.848, 14.746 }
    };
    lab_probe p[POINTS];
    points_of_5_10(p);
    quad small = quad_level(2, 2, 3, 1), large = quad_level(2, 2, 3, 4);
    under(overcast, &small, up, p, POINTS, row[0]);
    under(clear_north, &small, up, p, POINTS, row[1]);
    under(overcast, &large, up, p, POINTS, row[2]);
    under(clear_north, &large, up, p, POINTS, row[3]);
}

/* A window of 2 x 1 m in the wall y = 0, sill at 1 m; A-F opposite, G-N from there */
TEST(case_5_12_the_pane_in_a_facade)
{
    static const double row[3][POINTS] = { { .838, .938, 1.103, 1.331, 1.500, 1.636, .768, 1.151,
                                             1.775, 2.796, 4.397, 6.462, 7.212, 2.174 },
                                           { .838, .938, 1.583, 2.726, 3.126, 2.794, 1.115, 1.543,
                                             2.185, 3.142, 4.497, 6.025, 6.189, 1.763 },
                                           { .838, .938, 2.104, 4.352, 5.122, 4.419, 1.759, 2.459,
                                             3.564, 5.358, 8.266, 12.32, 12.75, 2.177 } };
    lab_probe p[POINTS];
    quad pane = { { { 1, 0, 1 }, { 3, 0, 1 }, { 3, 0, 2 }, { 1, 0, 2 } } };
    for (int i = 0; i < WALL; i++)
        p[i] = (lab_probe){ { 2, 4, down_the_wall[i] }, { 0, -1, 0 } };
    for (int i = 0; i < FLOOR; i++)
        p[WALL + i] = (lab_probe){ { 2, 3.75 - 0.5 * i, 0 }, up };
    under(overcast, &pane, (dvec3){ 0, -1, 0 }, p, POINTS, row[0]);
    under(even, &pane, (dvec3){ 0, -1, 0 }, p, POINTS, row[1]);
    under(clear_south, &pane, (dvec3){ 0, -1, 0 }, p, POINTS, row[2]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(case_5_5_a_pane_lets_through_by_angle),
        cmocka_unit_test(case_5_10_a_roof_light_of_1_m_under_the_uniform_sky),
        cmocka_unit_test(case_5_10_a_roof_light_of_4_m_under_the_uniform_sky),
        cmocka_unit_test(case_5_10_the_pane_under_other_skies),
        cmocka_unit_test(case_5_12_the_pane_in_a_facade),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
