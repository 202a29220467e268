/* tests/physics/test_interval.c -- the interval that is claimed holds the truth as often as
 * claimed.
 *
 * Of 95 % intervals, pooled over sensors and seeds, at least 93 % must hold the truth, which is
 * known exactly (a glowing box) or from an independent simulation (box_ies, where it is present).
 * Each run stops by itself at the accuracy asked for: the bias of stopping early is part of what is
 * tested.
 */
#include "core/color.h"
#include "sim/render.h"
#include "tests/box.h"
#include "tests/box_ies.h"
#include "tests/folder.h"
#include "tests/test.h"

typedef struct score {
    int sensors, held, within;
} score;

static void count(score *s, const grid_result *r, const double *truth, double accuracy)
{
    double average = 0.0;
    for (int k = 0; k < r->sensor_count; k++)
        average += truth[k] / r->sensor_count;
    for (int k = 0; k < r->sensor_count; k++) {
        double off = fabs(r->illuminance[k] - truth[k]);
        s->sensors++;
        s->held += off <= r->half_width[k];
        s->within += off <= accuracy * fmax(truth[k], 0.1 * average);
    }
}

static void assert_score(const score *s, const char *what)
{
    if (!(s->sensors >= 1000 && s->held >= 0.93 * s->sensors && s->within >= 0.95 * s->sensors))
        fail_msg(
            "%s: of %d intervals %d hold the truth (93 %% wanted), %d values are as accurate as "
            "asked (95 %% wanted)",
            what, s->sensors, s->held, s->within);
}

/* L = L_e / (1 - rho) everywhere; paths end at random, and so their samples differ. */
TEST(intervals_in_a_glowing_box_hold_the_truth)
{
    arena a           = { 0 };
    const vec3 rho[3] = { { 0.6f, 0.6f, 0.6f }, { 0.6f, 0.6f, 0.6f }, { 0.6f, 0.6f, 0.6f } };
    const vec3 le[3]  = { { 1, 1, 1 }, { 1, 1, 1 }, { 1, 1, 1 } };
    const scene *s    = box_scene(&a, (dvec3){ 4, 3, 2.5 }, rho, le, true);
    study_grid g      = {
             .name = "g", .origin = { 0, 0, 0.8 }, .u = { 4, 0, 0 }, .v = { 0, 3, 0 }, .spacing = 1
    };
    double truth[12];
    for (int k = 0; k < 12; k++)
        truth[k] = M_PI * LUMENS_PER_WATT / (1.0 - (double)0.6f);
    score all = { 0 };
    for (uint32_t seed = 1; seed <= 100; seed++) {
        arena run     = { 0 };
        run_options o = { .accuracy = 0.03, .deadline = HUGE_VAL, .seed = seed, .threads = 1 };
        grid_result r;
        assert_true(grid_run(&run, s, &g, &o, &r, NULL));
        count(&all, &r, truth, 0.03);
        arena_clear(&run);
    }
    assert_score(&all, "glowing box");
    arena_clear(&a);
}

/* Every pixel of a picture taken in there is L_e / (1 - rho) too. */
TEST(intervals_of_pixels_hold_the_truth)
{
    arena a           = { 0 };
    const vec3 rho[3] = { { 0.6f, 0.6f, 0.6f }, { 0.6f, 0.6f, 0.6f }, { 0.6f, 0.6f, 0.6f } };
    const vec3 le[3]  = { { 1, 1, 1 }, { 1, 1, 1 }, { 1, 1, 1 } };
    const scene *s    = box_scene(&a, (dvec3){ 4, 3, 2.5 }, rho, le, true);
    study_view v      = { .name       = "v",
                          .eye        = { 0.5, 0.5, 1.5 },
                          .target     = { 3, 2, 1 },
                          .fov_deg    = 60,
                          .width      = 48,
                          .height     = 32,
                          .size_given = true };
    run_options o     = { .accuracy = 0.1, .deadline = HUGE_VAL, .seed = 5, .threads = 2 };
    double truth      = LUMENS_PER_WATT / (1.0 - (double)0.6f);
    view_result r;
    assert_true(view_run(&a, s, &v, &o, &r, NULL));
    score all = { 0 };
    for (int k = 0; k < r.width * r.height; k++) {
        double off = fabs(LUMENS_PER_WATT * (double)r.radiance[0][k] - truth);
        all.sensors++;
        all.held += off <= (double)r.half_width[k];
        all.within += off <= 0.1 * truth;
    }
    assert_score(&all, "picture of a glowing box");
    arena_clear(&a);
}

/* A lamp close to a ceiling: its light comes from a spot that few samples meet. Walls and floor are
 * black; the lamp's light reaches a place c of the ceiling as I dw, and a sensor below as
 *
 *     E = rho / pi * integral of I cos_c cos_s / d^2 dw,    over the directions w up to the
 * ceiling.
 */
static double by_quadrature(dvec3 sensor, dvec3 lamp, dvec3 room, double rho, double intensity)
{
    enum { RINGS = 400, SECTORS = 400 };
    double sum = 0.0, h = room.z - lamp.z;
    for (int i = 0; i < RINGS; i++)
        for (int j = 0; j < SECTORS; j++) {
            double up = (i + 0.5) / RINGS, turn = 2.0 * M_PI * (j + 0.5) / SECTORS;
            double r = h * sqrt(1.0 - up * up) / up;
            dvec3 c  = { lamp.x + r * cos(turn), lamp.y + r * sin(turn), room.z };
            if (!(c.x >= 0.0 && c.x <= room.x && c.y >= 0.0 && c.y <= room.y))
                continue;
            dvec3 d   = d3_sub(c, sensor);
            double d2 = d3_dot(d, d);
            sum += d.z * d.z / (d2 * d2); /* cos_c cos_s / d^2 */
        }
    return rho / M_PI * intensity * sum * 2.0 * M_PI / (RINGS * SECTORS);
}

TEST(a_lamp_close_to_the_ceiling_is_not_missed)
{
    arena a        = { 0 };
    const scene *s = scene_of_text(
        &a, "lux4: 1\nroom: {size: [6, 4, 3], reflectance: {ceiling: 0.7, walls: 0, floor: 0}}\n"
            "lights: [{type: point, at: [2.9, 1.9, 2.9], intensity: 100}]\n"
            "grids: [{name: g, origin: [0, 0, 0.75], u: [6, 0, 0], v: [0, 4, 0], spacing: 1}]\n");
    const dvec3 room = { 6, 4, 3 }, lamp = { 2.9, 1.9, 2.9 };
    double truth[24];
    for (int k = 0; k < 24; k++) {
        dvec3 at  = { k % 6 + 0.5, k / 6 + 0.5, 0.75 };
        dvec3 d   = d3_sub(lamp, at);
        double d2 = d3_dot(d, d);
        truth[k] =
            100.0 * d.z / (d2 * sqrt(d2)) + by_quadrature(at, lamp, room, (double)0.7f, 100.0);
    }
    score all = { 0 };
    for (uint32_t seed = 1; seed <= 42; seed++) {
        arena run = { 0 };
        grid_result r;
        grid_of_scene(&run, s, 0, &(run_options){ .accuracy = 0.1, .seed = seed, .threads = 2 },
                      &r);
        count(&all, &r, truth, 0.1);
        arena_clear(&run);
    }
    assert_score(&all, "lamp close to a ceiling");
    arena_clear(&a);
}

static void box_ies_holds(double accuracy, uint32_t seeds)
{
    arena a = { 0 };
    box_ies b;
    if (!box_ies_read(&a, &b))
        skip();
    score all = { 0 };
    for (uint32_t seed = 1; seed <= seeds; seed++) {
        arena run = { 0 };
        grid_result r;
        grid_of_scene(&run, b.scene, 0,
                      &(run_options){ .accuracy = accuracy, .seed = seed, .threads = 2 }, &r);
        assert_int_equal(r.sensor_count, BOX_IES_SENSORS);
        count(&all, &r, b.total, accuracy);
        arena_clear(&run);
    }
    assert_score(&all, "box_ies");
    arena_clear(&a);
}

TEST(intervals_of_10_percent_hold_an_independent_truth) { box_ies_holds(0.10, 20); }
TEST(intervals_of_5_percent_hold_an_independent_truth) { box_ies_holds(0.05, 10); }
TEST(intervals_of_2_percent_hold_an_independent_truth) { box_ies_holds(0.02, 10); }

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(intervals_in_a_glowing_box_hold_the_truth),
        cmocka_unit_test(intervals_of_pixels_hold_the_truth),
        cmocka_unit_test(a_lamp_close_to_the_ceiling_is_not_missed),
        cmocka_unit_test(intervals_of_10_percent_hold_an_independent_truth),
        cmocka_unit_test(intervals_of_5_percent_hold_an_independent_truth),
        cmocka_unit_test(intervals_of_2_percent_hold_an_independent_truth),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
