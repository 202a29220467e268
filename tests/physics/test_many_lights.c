/* tests/physics/test_many_lights.c -- many lamps: what of them is hidden behind an edge, and the
 * balance of energy in rooms that give light back, for every kind.
 */
#include "tests/folder.h"
#include "tests/gltf_text.h"
#include "tests/lab.h"
#include "tests/shapes.h"
#include "tests/test.h"

#include <stdio.h>

static const dvec3 up = { 0, 0, 1 };

/* ---- hidden behind an edge ------------------------------------------------------------------- */

enum { SIDE = 20, LAMPS = SIDE * SIDE, N = 6 };

static dvec3 lamp_at(int i)
{
    return (dvec3){ 1.03 * (i % SIDE) - 9.3, 0.97 * (i / SIDE) - 9.1, 4.0 };
}

static double candelas(int i) { return i % 7 == 3 ? 900.0 : 30.0 + i % 5; }

/* 400 lamps 4 m above the floor, of which some are much stronger than the others; a screen at 2 m
 * hides what lies beyond x = 0.237 there. Each sensor's sum is known; the weakest lamps are drawn
 * from, and count as far off as their bound says. */
static void hidden_lamps(const char *form, double exact, double accuracy)
{
    lab l;
    lab_open(&l);
    quad screen = { { { 0.237, -90, 2 }, { 90, -90, 2 }, { 90, 90, 2 }, { 0.237, 90, 2 } } };
    lab_quads(&l, "screen.gltf", &screen, 1, "\"name\":\"Black\"");
    lab_write(&l, "globe.ies",
              "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 1 1 2 -0.1 -0.1 -0.1\n1 1 0\n0 90 180\n0\n"
              "1 1 1\n");
    char *text = arena_array(&l.a, char, LAMPS * 160 + 200, NULL);
    size_t n   = 0;
    n += (size_t)sprintf(text, "scene: screen.gltf\nmaterials: [{match: '*', reflectance: 0}]\n%s",
                         form[0] == 'p' ? "luminaires:\n" : "lights:\n");
    for (int i = 0; i < LAMPS; i++) {
        dvec3 at = lamp_at(i);
        n += (size_t)sprintf(text + n, "  - {%s, at: [%.9g, %.9g, %.9g], ", form, at.x, at.y, at.z);
        n += form[0] == 'p' ? (size_t)sprintf(text + n, "dimming: %g}\n", candelas(i))
                            : (size_t)sprintf(text + n, "intensity: %g}\n", candelas(i));
    }
    lab_probe p[N];
    double want[N] = { 0 };
    for (int k = 0; k < N; k++) {
        p[k] = (lab_probe){ { 1.7 * k - 4.15, 0.9 * k - 2.0, 0 }, up };
        for (int i = 0; i < LAMPS; i++) {
            dvec3 d = d3_sub(lamp_at(i), p[k].at);
            if (p[k].at.x + 0.5 * d.x < 0.237)
                want[k] += candelas(i) * d.z / pow(d3_dot(d, d), 1.5);
        }
    }
    grid_result r;
    lab_measure(&l, text, NULL, p, N, &(run_options){ .accuracy = accuracy }, &r);
    lab_check(form, &r, want, exact, accuracy);
    lab_close(&l);
}

TEST(of_many_points_those_in_sight_are_summed) { hidden_lamps("type: point", 1e-5, 0.01); }

/* Globes of 10 cm, of which `want` has those that the edge cuts wholly or not at all: 1 %. */
TEST(of_many_luminaires_those_in_sight_are_summed)
{
    hidden_lamps("photometry: globe.ies", 0.01, 0.02);
}

/* ---- rooms that give light back -------------------------------------------------------------- */

/* The mean over a closed cube of 4 m, all of the reflectance rho, is flux / (S (1 - rho)). */
static void balances(const char *lamps, double flux, double rho)
{
    lab l;
    lab_open(&l);
    lab_write(&l, "tube.ies",
              "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 7 1 1 2 -0.1 1.2 -0.1\n1 1 0\n"
              "0 30 60 90 120 150 180\n0\n300 280 220 150 100 60 40\n");
    const scene *s =
        lab_scene(&l, text_of(&l.a,
                              "lux4: 1\nroom: {size: [4, 4, 4], reflectance: %g}\n%s\ngrids:\n"
                              "  - {name: floor, on: floor, spacing: 0.25}\n"
                              "  - {name: ceiling, on: ceiling, spacing: 0.25}\n"
                              "  - {name: walls, on: walls, spacing: 0.25}\n",
                              rho, lamps));
    double mean = 0.0, half = 0.0;
    for (int g = 0; g < 6; g++) {
        grid_result r;
        lux_error err = { 0 };
        run_options o = { .accuracy = 0.2, .deadline = HUGE_VAL, .seed = 1, .threads = 1 };
        if (!grid_run(&l.a, s, &s->study->grids[g], &o, &r, &err))
            fail_msg("%s", err.text);
        mean += r.average / 6.0;
        half = hypot(half, independent_half_width(&r) / 6.0);
    }
    double want = flux / (96.0 * (1.0 - (double)(float)rho));
    if (!(fabs(mean - want) <= 2e-3 * want + 2.0 * half)) /* cells of 0.25 m: 2e-3 */
        fail_msg("%s: %.6g lx, not %.6g, +- %.2g", lamps, mean, want, half);
    lab_close(&l);
}

TEST(a_rectangle_balances)
{
    balances("lights: [{type: rect, at: [1.3, 2.4, 2.6], aim: [1, 1, -3], size: [1, 0.4], "
             "lumens: 10000}]",
             10000, 0.7);
}
TEST(a_disk_balances)
{
    balances("lights: [{type: disk, at: [2.3, 1.4, 1.6], aim: [1, 0, 1], radius: 0.4, "
             "lumens: 10000}]",
             10000, 0.7);
}
TEST(a_line_balances)
{
    balances("lights: [{type: linear, from: [1.3, 1.4, 1.6], to: [2.5, 2.5, 2], lumens: 10000}]",
             10000, 0.7);
}
TEST(a_cone_balances)
{
    balances("lights: [{type: cone, at: [2.3, 1.4, 3], aim: [0.1, 0.2, -1], inner: 10, outer: 50, "
             "lumens: 10000}]",
             10000, 0.7);
}
TEST(a_luminaire_with_an_opening_balances)
{
    balances("luminaires: [{photometry: tube.ies, at: [1.7, 2.2, 2.2], aim: [0, 1, -2], rotate: 20,"
             " lumens: 10000}]",
             10000, 0.7);
}

/* 48 lamps of all kinds, of which bounces choose by a tree. */
TEST(many_lamps_of_all_kinds_balance)
{
    static const char *const kind[] = { "type: point, lumens: 100",
                                        "type: cosine, exponent: 3, lumens: 300",
                                        "type: disk, radius: 0.2, lumens: 200",
                                        "type: rect, size: [0.5, 0.1], lumens: 150",
                                        "type: cone, outer: 60, lumens: 50" };
    static const double lumens[]    = { 100, 300, 200, 150, 50 };
    lab l;
    lab_open(&l);
    uint32_t random = 1;
    double flux     = 0.0;
    char *text      = text_of(&l.a, "lights:\n");
    for (int i = 0; i < 48; i++) {
        vec3 at = random_point(&random), aim = random_direction(&random);
        const char *to = i % 5 ? text_of(&l.a, ", aim: [%g, %g, %g]", (double)aim.x, (double)aim.y,
                                         (double)aim.z)
                               : "";
        text           = text_of(&l.a, "%s  - {%s%s, at: [%g, %g, %g]}\n", text, kind[i % 5], to,
                                 2.0 + (double)at.x, 2.0 + (double)at.y, 2.0 + (double)at.z);
        flux += lumens[i % 5];
    }
    balances(text, flux, 0.6);
    lab_close(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(of_many_points_those_in_sight_are_summed),
        cmocka_unit_test(of_many_luminaires_those_in_sight_are_summed),
        cmocka_unit_test(a_rectangle_balances),
        cmocka_unit_test(a_disk_balances),
        cmocka_unit_test(a_line_balances),
        cmocka_unit_test(a_cone_balances),
        cmocka_unit_test(a_luminaire_with_an_opening_balances),
        cmocka_unit_test(many_lamps_of_all_kinds_balance),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
