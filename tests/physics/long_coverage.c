/* tests/physics/long_coverage.c -- intervals hold the truth: more scenes, seeds and accuracies than
 * test_interval_area.c has time for.
 *
 * The truth is a run of 7 times the accuracy; at least 93 % of the intervals must hold it, and 95 %
 * of the values must be as accurate as asked.
 */
#include "tests/lab.h"
#include "tests/test.h"

#include <stdio.h>

enum { SEEDS = 80 };

static void coverage(lab *l, const char *what, const char *yaml, double accuracy)
{
    const scene *s      = lab_scene(l, yaml);
    const study_grid *g = &s->study->grids[0];
    run_options o       = { .deadline = HUGE_VAL, .threads = 2 };
    int held = 0, within = 0, all = 0;
    grid_result truth;
    o.accuracy = 0.15 * accuracy;
    o.seed     = 1000;
    assert_true(grid_run(&l->a, s, g, &o, &truth, NULL));
    o.accuracy = accuracy;
    for (o.seed = 1; o.seed <= SEEDS; o.seed++) {
        arena run = { 0 };
        grid_result r;
        assert_true(grid_run(&run, s, g, &o, &r, NULL));
        assert_null(r.left_to_chance);
        for (int k = 0; k < r.sensor_count; k++, all++) {
            double off = fabs(r.illuminance[k] - truth.illuminance[k]);
            held += off <= r.half_width[k] + 1e-5 * truth.illuminance[k];
            within += off <= accuracy * fmax(truth.illuminance[k], 0.1 * truth.average);
        }
        arena_clear(&run);
    }
    printf("%s, %g %%: of %d intervals %.1f %% hold the truth, %.1f %% of the values are as "
           "accurate as asked\n",
           what, 100.0 * accuracy, all, 100.0 * held / all, 100.0 * within / all);
    assert_true(held >= 0.93 * all && within >= 0.95 * all);
}

#define ROOM                                                                                       \
    "lux4: 1\nroom: {size: [6, 4, 3], reflectance: {ceiling: 0.7, walls: 0.5, floor: 0.2}}\n"
#define GRID                                                                                       \
    "grids: [{name: g, origin: [0.5, 0.5, 0.1], u: [5, 0, 0], v: [0, 3, 0], spacing: 1%s}]\n"

static void write_files(lab *l)
{
    quad table[6], glow = { { { 4, 1, 2 }, { 4, 1.3, 2 }, { 4.3, 1.3, 2 }, { 4.3, 1, 2 } } };
    quads_of_box((dvec3){ 1.7, 0.8, 0.7 }, (dvec3){ 3.9, 2.3, 0.75 }, table);
    lab_quads(l, "table.gltf", table, 6, "\"name\":\"Table\"");
    lab_quads(l, "glow.gltf", &glow, 1, lab_glow(l, 10000.0));
    lab_write(l, "tube.ies",
              "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 7 1 1 2 -0.1 1.2 -0.1\n1 1 0\n"
              "0 30 60 90 120 150 180\n0\n300 280 220 150 100 60 40\n");
}

static void all_accuracies(const char *what, const char *lamps, const char *quantity)
{
    static const double accuracy[] = { 0.1, 0.05 };
    for (int i = 0; i < 2; i++) {
        char yaml[2048];
        lab l;
        lab_open(&l);
        write_files(&l);
        snprintf(yaml, sizeof yaml, ROOM "%s" GRID, lamps, quantity);
        coverage(&l, what, yaml, accuracy[i]);
        lab_close(&l);
    }
}

#define LAMPS                                                                                      \
    "scene: [table.gltf]\nmaterials: [{match: Table, reflectance: 0.3}]\n"                         \
    "lights: [{type: rect, at: [1.8, 1.3, 2.7], size: [1.2, 0.3], lumens: 3000}]\n"                \
    "luminaires: [{photometry: tube.ies, at: [4.2, 2.5, 2.5], rotate: 20}]\n"
#define GLOW                                                                                       \
    "scene: [table.gltf, glow.gltf]\nmaterials: [{match: Table, reflectance: 0.3},"                \
    " {match: Glow, reflectance: 0}]\n"

TEST(lamps_in_a_furnished_room) { all_accuracies("lamps", LAMPS, ""); }
TEST(a_glowing_square_in_a_furnished_room) { all_accuracies("glow", GLOW, ""); }
TEST(cylinders_in_a_furnished_room)
{
    all_accuracies("lamps on cylinders", LAMPS, ", quantity: cylindrical");
    all_accuracies("glow on cylinders", GLOW, ", quantity: cylindrical");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lamps_in_a_furnished_room),
        cmocka_unit_test(a_glowing_square_in_a_furnished_room),
        cmocka_unit_test(cylinders_in_a_furnished_room),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
