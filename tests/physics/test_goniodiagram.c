/* tests/physics/test_goniodiagram.c -- luminaires whose light has a closed form.
 *
 *     I0 cos^n gamma                     F = 2 pi I0 / (n + 1)
 *     I0 (3 cos^2 - 2 cos^4)             F = 2 pi I0 (1 - 2/5) = 1.2 pi I0      (a batwing)
 *     (I0 + I1 cos C) sin gamma          F = pi^2 I0                            (I1 <= I0)
 *
 * All in the lower half space but the last, tabulated every 1.25 deg (2.5 deg along C). Linear
 * interpolation is off by at most h^2/8 |I''|: 6e-5 |I''| (2.4e-4), which where the light is
 * weakest on the desk is below 1e-3 of it.
 */
#include "lights/light.h"
#include "lights/photometry.h"
#include "tests/test.h"

#include <stdio.h>

enum { GAMMAS = 145, PLANES = 144 };

typedef double intensity(double plane, double gamma);

static double isotropic(double plane, double gamma) { return (void)plane, (void)gamma, 1000.0; }
static double cos2(double plane, double gamma)
{
    return (void)plane, gamma < M_PI / 2 ? 800.0 * cos(gamma) * cos(gamma) : 0.0;
}
static double batwing(double plane, double gamma)
{
    double c2 = cos(gamma) * cos(gamma);
    return (void)plane, gamma < M_PI / 2 ? 2500.0 / M_PI * (3.0 * c2 - 2.0 * c2 * c2) : 0.0;
}
static double skew(double plane, double gamma) { return (500.0 + 300.0 * cos(plane)) * sin(gamma); }

typedef struct sheet {
    float plane[PLANES], gamma[GAMMAS], candela[PLANES * GAMMAS];
    photometry web;
} sheet;

static void tabulate(sheet *s, intensity *f)
{
    for (int i = 0; i < PLANES; i++)
        for (int j = 0; j < GAMMAS; j++) {
            s->plane[i]                = 2.5f * (float)i;
            s->gamma[j]                = 1.25f * (float)j;
            s->candela[i * GAMMAS + j] = (float)f(2.5 * i * M_PI / 180.0, 1.25 * j * M_PI / 180.0);
        }
    s->web                  = (photometry){ .plane_count = PLANES,
                                            .gamma_count = GAMMAS,
                                            .plane_deg   = s->plane,
                                            .gamma_deg   = s->gamma,
                                            .candela     = s->candela };
    s->web.luminaire_lumens = photometry_flux(&s->web, 0, 180);
}

TEST(a_thousand_candelas_all_around_are_4000_pi_lumens)
{
    static sheet s;
    tabulate(&s, isotropic);
    assert_near(s.web.luminaire_lumens, 12566.370614359172, 1e-9); /* the web is exact */
}

TEST(fluxes_are_those_of_the_closed_forms)
{
    static sheet s;
    tabulate(&s, cos2);
    assert_near(s.web.luminaire_lumens, 2.0 * M_PI * 800.0 / 3.0, 1e-3);
    assert_near(photometry_flux(&s.web, 0, 60), 2.0 * M_PI * 800.0 / 3.0 * (1.0 - 0.125), 1e-3);
    tabulate(&s, batwing);
    assert_near(s.web.luminaire_lumens, 3000.0, 1e-3);
    tabulate(&s, skew);
    assert_near(s.web.luminaire_lumens, M_PI * M_PI * 500.0, 1e-3);
}

/* I constant within a cell and zero beyond, against what the exact integral must give: one cell
 * from 30 to 60 deg that rises from 0 to 1 cd; by parts, -cos 60 + (sin 60 - sin 30) / (pi/6). */
TEST(a_single_cell_is_integrated_exactly)
{
    const float plane = 0, gamma[] = { 30, 60 }, candela[] = { 0, 1 };
    photometry p    = { .plane_count = 1,
                        .gamma_count = 2,
                        .plane_deg   = &plane,
                        .gamma_deg   = gamma,
                        .candela     = candela };
    double by_parts = -0.5 + (sqrt(3.0) / 2.0 - 0.5) / (M_PI / 6.0);
    assert_near(photometry_flux(&p, 0, 180), 2.0 * M_PI * by_parts, 1e-12);
    assert_near(photometry_flux(&p, 0, 45) + photometry_flux(&p, 45, 180), 2.0 * M_PI * by_parts,
                1e-12);
}

/* A desk of 6 by 6 m, 2 m below, by E = I cos / d^2. */
TEST(illuminances_are_those_of_the_closed_forms)
{
    intensity *const forms[] = { cos2, batwing, skew };
    static sheet s;
    for (size_t f = 0; f < 3; f++) {
        arena a = { 0 };
        tabulate(&s, forms[f]);
        luminaire_desc d = {
            .position = { 1, 2, 2 }, .aim = { 0, 0, -1 }, .scale = { 1, 1, 1 }, .web = &s.web
        };
        const light *l = light_luminaire(&a, &d, NULL);
        assert_non_null(l);
        for (int i = 0; i < 400; i++) {
            double x = -2.0 + 6.0 * (i % 20 + 0.5) / 20, y = -1.0 + 6.0 * (i / 20 + 0.5) / 20;
            double dx = x - 1.0, dy = y - 2.0, d2 = dx * dx + dy * dy + 4.0;
            double cos_g = 2.0 / sqrt(d2);
            double want  = forms[f](atan2(dy, dx), acos(cos_g)) * cos_g / d2;
            vvec3 p      = vspread((vec3){ (float)x, (float)y, 0 });
            vlight_sample e;
            assert_true(vall(light_sample(l, &p, vsplat(0), vsplat(0), ALL_LANES, &e)));
            double got = (double)(lane(e.e.x, 0) * lane(e.wi.z, 0));
            assert_near(got, want, 1e-3);
        }
        assert_near(light_flux(l).x, s.web.luminaire_lumens, 1e-6);
        arena_clear(&a);
    }
}

/* The direct part of a room with four downlights, as an independent program has it: its own table
 * of the same .ies file, linear in angle too; to the digits that are printed, and float's. */
TEST(a_room_of_four_downlights_is_as_others_have_it)
{
    static const vec3 at[4] = {
        { 2.5f, 1.5f, 2.99f }, { 7.5f, 1.5f, 2.99f }, { 2.5f, 4.5f, 2.99f }, { 7.5f, 4.5f, 2.99f }
    };
    FILE *f = fopen("../shared/data/reference/box_ies/expected.csv", "r");
    if (!f)
        skip();
    arena a = { 0 };
    const photometry *p =
        photometry_read(&a, "../shared/data/reference/box_ies/dl3000.ies", NULL, NULL);
    assert_non_null(p);
    assert_near(p->luminaire_lumens, 3001.27, 2e-6);
    const light *l[4];
    for (int i = 0; i < 4; i++) {
        luminaire_desc d = {
            .position = at[i], .aim = { 0, 0, -1 }, .scale = { 1, 1, 1 }, .web = p
        };
        l[i] = light_luminaire(&a, &d, NULL);
    }

    char line[256];
    int sensors = 0;
    while (fgets(line, sizeof line, f)) {
        float x, y, z;
        double want, got = 0.0;
        if (sscanf(line, "%f,%f,%f,%lf", &x, &y, &z, &want) != 4)
            continue; /* the header */
        vvec3 point = vspread((vec3){ x, y, z });
        vlight_sample s;
        for (int i = 0; i < 4; i++)
            if (vany(light_sample(l[i], &point, vsplat(0), vsplat(0), ALL_LANES, &s)))
                got += (double)(lane(s.e.y, 0) * lane(s.wi.z, 0));
        assert_near(got, want, 2e-6);
        sensors++;
    }
    fclose(f);
    arena_clear(&a);
    assert_int_equal(sensors, 240);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_thousand_candelas_all_around_are_4000_pi_lumens),
        cmocka_unit_test(fluxes_are_those_of_the_closed_forms),
        cmocka_unit_test(a_single_cell_is_integrated_exactly),
        cmocka_unit_test(illuminances_are_those_of_the_closed_forms),
        cmocka_unit_test(a_room_of_four_downlights_is_as_others_have_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
