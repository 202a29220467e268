/* tests/physics/test_interval_area.c -- the interval holds the truth as often as claimed where
 * lights have extent, things hide parts of them, and surfaces give light back.
 *
 * Of 95 % intervals, pooled over sensors and seeds, at least 93 % must hold the truth, and 95 % of
 * the values must be as accurate as asked. The truth is known exactly where nothing gives light
 * back; else it is what a run of 8 times the accuracy says, whose variance hardly counts.
 */
#include "tests/lab.h"
#include "tests/test.h"

enum { ACROSS = 5, DOWN = 3, N = ACROSS * DOWN, SEEDS = 70 };

static void coverage(lab *l, const char *yaml, const double *truth, double accuracy)
{
    const scene *s = lab_scene(l, yaml);
    int held = 0, within = 0;
    double mean = 0.0;
    for (int k = 0; k < N; k++)
        mean += truth[k] / N;
    for (uint32_t seed = 1; seed <= SEEDS; seed++) {
        arena run = { 0 };
        grid_result r;
        lux_error err = { 0 };
        run_options o = { .accuracy = accuracy, .deadline = HUGE_VAL, .seed = seed, .threads = 1 };
        if (!grid_run(&run, s, &s->study->grids[0], &o, &r, &err))
            fail_msg("%s", err.text);
        assert_int_equal(r.sensor_count, N);
        for (int k = 0; k < N; k++) {
            double off = fabs(r.illuminance[k] - truth[k]);
            held += off <= r.half_width[k] + 1e-5 * truth[k];
            within += off <= accuracy * fmax(truth[k], 0.1 * mean);
        }
        arena_clear(&run);
    }
    if (!(held >= 0.93 * N * SEEDS && within >= 0.95 * N * SEEDS))
        fail_msg("of %d intervals %d hold the truth (93 %% wanted), %d values are as accurate as "
                 "asked (95 %% wanted)",
                 N * SEEDS, held, within);
}

/* A screen hides what lies east of x = 3.1 at the height 1.4: of rectangles at the height 2.8 it
 * leaves rectangles. No light comes back. */
TEST(intervals_behind_an_edge_hold_the_truth)
{
    static const double middle[][2] = { { 2, 1.5 }, { 4, 2.5 } };
    lab l;
    lab_open(&l);
    quad screen = { { { 3.1, -9, 1.4 }, { 30, -9, 1.4 }, { 30, 9, 1.4 }, { 3.1, 9, 1.4 } } };
    lab_quads(&l, "screen.gltf", &screen, 1, "\"name\":\"Black\"");
    double truth[N] = { 0 };
    for (int k = 0; k < N; k++)
        for (int i = 0; i < 2; i++) {
            dvec3 at    = { 0.5 + 5.0 * (k % ACROSS + 0.5) / ACROSS,
                            0.5 + 3.0 * (k / ACROSS + 0.5) / DOWN, 0 };
            double west = middle[i][0] - 0.6, east = middle[i][0] + 0.6;
            double edge  = fmin(fmax(6.2 - at.x, west), east);
            dvec3 left[] = { { west, middle[i][1] - 0.3, 2.8 },
                             { edge, middle[i][1] - 0.3, 2.8 },
                             { edge, middle[i][1] + 0.3, 2.8 },
                             { west, middle[i][1] + 0.3, 2.8 } };
            truth[k] += 3000.0 * polygon_lux(left, 4, at, (dvec3){ 0, 0, 1 });
        }
    coverage(&l,
             "lux4: 1\nscene: screen.gltf\nmaterials: [{match: '*', reflectance: 0}]\n"
             "lights: [{type: rect, at: [[2, 1.5, 2.8], [4, 2.5, 2.8]], size: [1.2, 0.6], "
             "luminance: 3000}]\n"
             "grids: [{name: g, origin: [0.5, 0.5, 0], u: [5, 0, 0], v: [0, 3, 0], spacing: 1}]\n",
             truth, 0.05);
    lab_close(&l);
}

/* A panel, a luminaire with an opening, a black table and gray walls. */
TEST(intervals_in_a_furnished_room_hold_the_truth)
{
    static const char yaml[] =
        "lux4: 1\nroom: {size: [6, 4, 3], reflectance: {ceiling: 0.7, walls: 0.5, floor: 0.2}}\n"
        "scene: table.gltf\nmaterials: [{match: Table, reflectance: 0.3}]\n"
        "lights: [{type: rect, at: [1.8, 1.3, 2.7], size: [1.2, 0.3], lumens: 3000}]\n"
        "luminaires: [{photometry: tube.ies, at: [4.2, 2.5, 2.5], rotate: 20}]\n"
        "grids: [{name: g, origin: [0.5, 0.5, 0.1], u: [5, 0, 0], v: [0, 3, 0], spacing: 1}]\n";
    lab l;
    lab_open(&l);
    quad table[6];
    quads_of_box((dvec3){ 1.7, 0.8, 0.7 }, (dvec3){ 3.9, 2.3, 0.75 }, table);
    lab_quads(&l, "table.gltf", table, 6, "\"name\":\"Table\"");
    lab_write(&l, "tube.ies",
              "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 7 1 1 2 -0.1 1.2 -0.1\n1 1 0\n"
              "0 30 60 90 120 150 180\n0\n300 280 220 150 100 60 40\n");
    const scene *s = lab_scene(&l, yaml);
    grid_result best;
    run_options o = { .accuracy = 0.006, .deadline = HUGE_VAL, .seed = 99, .threads = 1 };
    assert_true(grid_run(&l.a, s, &s->study->grids[0], &o, &best, NULL));
    assert_null(best.left_to_chance);
    coverage(&l, yaml, best.illuminance, 0.05);
    lab_close(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(intervals_behind_an_edge_hold_the_truth),
        cmocka_unit_test(intervals_in_a_furnished_room_hold_the_truth),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
