/* tests/unit/test_cost.c -- what lux4 cost makes of runs: errors, slopes, time, advice, a picture.
 */
#include "sim/cost_parts.h"
#include "sim/cost_write.h"
#include "tests/folder.h"
#include "tests/program.h"
#include "tests/study_text.h"
#include "tests/test.h"

#include <stdlib.h>
#include <string.h>

enum { SENSORS = 4000 };
static const double student_t = 2.1314; /* as accuracy.h, 15 degrees of freedom */

/* Even random numbers of variance 1. */
static double uniform(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return ((double)*state / 4294967296.0 - 0.5) * sqrt(12.0);
}

/* All sensors at 100 (1 + bias + noise). */
static cost_sample made_sample(arena *a, double bias, double noise, uint32_t seed)
{
    cost_sample s = { .count = SENSORS, .floor = 10.0, .seconds = seed, .rays = 1000 * seed };
    s.value       = arena_array(a, float, SENSORS, NULL);
    s.half_width  = arena_array(a, float, SENSORS, NULL);
    for (int i = 0; i < SENSORS; i++) {
        s.value[i]      = (float)(100.0 * (1.0 + bias + noise * uniform(&seed)));
        s.half_width[i] = (float)(100.0 * student_t * noise);
    }
    return s;
}

TEST(the_median_is_the_middle_one)
{
    assert_near(cost_median((double[]){ 3.0, 1.0, 2.0 }, 3), 2.0, 0.0);
    assert_near(cost_median((double[]){ 5.0, 1.0 }, 2), 3.0, 0.0);
    assert_near(cost_median((double[]){ 7.0 }, 1), 7.0, 0.0);
}

TEST(a_slope_is_that_of_a_power_law)
{
    double x[] = { 1.0, 10.0, 100.0, 0.0, 1000.0 }, y[5];
    for (int i = 0; i < 5; i++)
        y[i] = 0.3 * pow(x[i], -0.7);
    assert_near(cost_slope(x, y, 5), -0.7, 1e-12); /* the point at 0 does not count */
}

TEST(one_point_has_no_slope)
{
    assert_true(isnan(cost_slope((double[]){ 2.0, 2.0 }, (double[]){ 1.0, 3.0 }, 2)));
    assert_true(isnan(cost_slope((double[]){ 2.0 }, (double[]){ 1.0 }, 1)));
}

/* A sum of 4000 squares is known to 2 / sqrt(4000) of itself, at two standard errors: 3 %; and its
 * root to half of that. */
TEST(the_noise_of_the_reference_is_taken_off)
{
    arena a               = { 0 };
    cost_sample reference = made_sample(&a, 0.0, 0.01, 7);
    cost_sample runs[3];
    for (uint32_t k = 0; k < 3; k++)
        runs[k] = made_sample(&a, 0.0, 0.02, 11 + k);
    cost_row r = { 0 };
    cost_row_figures(runs, 3, &reference, 0.02, &r);
    assert_near(r.rms, 0.02, 0.03);
    assert_near(r.noise, 0.02, 0.03);
    assert_near(r.half_width, student_t * 0.02, 0.01); /* values differ from the reference's */
    assert_true(r.bias < 0.003);
    arena_clear(&a);
}

TEST(bias_is_told_from_noise)
{
    arena a               = { 0 };
    cost_sample reference = made_sample(&a, 0.0, 0.001, 7);
    cost_sample runs[3];
    for (uint32_t k = 0; k < 3; k++)
        runs[k] = made_sample(&a, -0.05, 0.02, 11 + k);
    cost_row r = { 0 };
    cost_row_figures(runs, 3, &reference, 0.02, &r);
    assert_near(r.bias, 0.05, 0.03);
    assert_near(r.noise, 0.02, 0.03);
    assert_near(r.rms, sqrt(0.05 * 0.05 + 0.02 * 0.02), 0.03);
    assert_false(r.reaches);
    assert_true(isnan(cost_seconds_for_1(&r, -0.5))); /* 5 % stay */
    arena_clear(&a);
}

/* One sensor that is off by 10 and 9 times its value in two of three runs looks biased, by
 * (19 / 3)^2 - 10.1 in the square, but is one of many. */
TEST(a_wild_sensor_is_no_bias)
{
    arena a               = { 0 };
    cost_sample reference = made_sample(&a, 0.0, 0.001, 7);
    cost_sample runs[3];
    for (uint32_t k = 0; k < 3; k++)
        runs[k] = made_sample(&a, 0.0, 0.005, 11 + k);
    runs[0].value[5] = 11.0f * reference.value[5];
    runs[1].value[5] = 10.0f * reference.value[5];
    cost_row r       = { 0 };
    cost_row_figures(runs, 3, &reference, 0.02, &r);
    assert_true(r.rms > 0.1);
    assert_near(r.bias, 0.0, 0.0);
    assert_true(isfinite(cost_seconds_for_1(&r, -0.5)));
    arena_clear(&a);
}

TEST(an_error_below_the_references_noise_is_not_called_none)
{
    arena a               = { 0 };
    cost_sample reference = made_sample(&a, 0.0, 0.01, 7);
    cost_row r            = { 0 };
    cost_row_figures(&reference, 1, &reference, 0.02, &r);
    assert_near(r.rms, 0.5 * 0.01, 0.02);
    assert_true(r.reaches);
    arena_clear(&a);
}

TEST(seconds_and_rays_are_medians)
{
    arena a               = { 0 };
    cost_sample reference = made_sample(&a, 0.0, 0.01, 7);
    cost_sample runs[]    = { made_sample(&a, 0.0, 0.01, 30), made_sample(&a, 0.0, 0.01, 10),
                              made_sample(&a, 0.0, 0.01, 20) };
    cost_row r            = { 0 };
    cost_row_figures(runs, 3, &reference, 0.02, &r);
    assert_near(r.seconds, 20.0, 0.0);
    assert_int_equal(r.rays, 20000);
    assert_int_equal(r.runs, 3);
    arena_clear(&a);
}

TEST(time_for_one_percent_follows_the_slope)
{
    cost_row r = { .seconds = 2.0, .noise = 0.04 };
    assert_near(cost_seconds_for_1(&r, -0.5), 2.0 * 16.0, 1e-12);
    assert_near(cost_seconds_for_1(&r, -1.0), 2.0 * 4.0, 1e-12);
    assert_near(cost_seconds_for_1(&r, (double)NAN), 2.0 * 16.0, 1e-12); /* plain Monte Carlo */
    r.bias = 0.006; /* which leaves 0.8 % for noise */
    assert_near(cost_seconds_for_1(&r, -0.5), 2.0 * 25.0, 1e-12);
}

/* ---- time ------------------------------------------------------------------------------------ */

static void set_rung(cost_list *l, int k, double accuracy, double reached, double seconds)
{
    l->all[k].accuracy          = accuracy;
    l->all[k].runs              = 1;
    l->all[k].sample[0].reached = reached;
    l->all[k].sample[0].seconds = seconds;
}

TEST(what_a_rung_has_reached_costs_the_next_nothing_more)
{
    cost_list *l = calloc(1, sizeof *l);
    l->rungs = l->count = 3;
    set_rung(l, 0, 0.2, 0.06, 1.0);
    assert_near(cost_predict(l, 0, 0.1), 1.0, 0.0);
    assert_near(cost_predict(l, 0, 0.03), 4.0, 1e-12); /* twice as accurate: four times the time */
    set_rung(l, 1, 0.1, 0.03, 3.0);
    double e = log(3.0) / log(2.0);
    assert_near(cost_predict(l, 1, 0.015), 3.0 * pow(2.0, e), 1e-12);
    free(l);
}

TEST(what_is_left_to_do_counts_all_runs)
{
    cost_list *l = calloc(1, sizeof *l);
    l->rungs = 2, l->count = 4;
    set_rung(l, 0, 0.2, 0.2, 1.0);
    l->all[1].accuracy = 0.1;
    l->all[3].usual    = true; /* which takes its rung's figures */
    /* the rung twice more, another setting three times, the reference at 3^2 */
    assert_near(cost_still_to_do(l, 0, false, 0.1, 0.5), 2.0 + 3.0 + 9.0, 1e-12);
    /* the next rung takes 4 s, three times, as does the other; the reference is at 6^2 */
    assert_near(cost_still_to_do(l, 0, true, 0.1, 0.5), 2.0 + 12.0 + 12.0 + 36.0, 1e-12);
    l->all[2].scene.measures.projection_test = true; /* for which a scene is built */
    assert_near(cost_still_to_do(l, 0, false, 0.1, 0.5), 2.0 + 3.0 + 9.0 + 0.5, 1e-12);
    free(l);
}

/* ---- advice and picture ---------------------------------------------------------------------- */

/* A ladder whose error falls as rays^-0.75, and two more. */
static void made_rows(cost_row rows[5])
{
    static const double accuracies[] = { 0.2, 0.02, 0.005 };
    for (int i = 0; i < 5; i++) {
        rows[i]     = (cost_row){ .seconds = pow(16.0, i), .rays = 1000ll << (4 * i), .runs = 3 };
        rows[i].rms = rows[i].noise = rows[i].half_width = 0.08 * pow(8.0, -i);
        rows[i].accuracy                                 = accuracies[i < 3 ? i : 1];
        snprintf(rows[i].setting, sizeof rows[i].setting, "--accuracy %g%%",
                 100.0 * rows[i].accuracy);
        rows[i].reaches = rows[i].promises = i >= 1;
        rows[i].within                     = i >= 1 ? 0.99 : 0.5;
    }
    rows[3] = (cost_row){ COST_BOUNCES, "bounces 4", .seconds = 0.5, .rms = 0.01, .reaches = true };
    rows[4] = (cost_row){ COST_EFFECTS, "--no color", .seconds = 20.0, .rms = 0.01 };
}

TEST(advice_names_the_cheapest_setting_that_users_can_choose)
{
    cost_row rows[5];
    cost_result r = { .row_count = 5, .rows = rows, .asked = 0.02 };
    made_rows(rows);
    cost_conclude(rows, &r);
    assert_near(r.slope, -0.75, 1e-9);
    assert_non_null(strstr(r.advice, "--accuracy 2% is the cheapest setting that meets 2 %"));
}

TEST(advice_says_where_intervals_do_not_promise_what_is_met)
{
    cost_row rows[5];
    cost_result r = { .row_count = 5, .rows = rows, .asked = 0.02 };
    made_rows(rows);
    rows[1].promises = false;
    cost_conclude(rows, &r);
    assert_non_null(strstr(r.advice, "--accuracy 2% is the cheapest setting that meets 2 %"));
    assert_non_null(strstr(r.advice, "--accuracy 0.5% is the cheapest whose intervals do"));
}

TEST(advice_says_where_nothing_meets_what_is_asked)
{
    cost_row rows[5];
    cost_result r = { .row_count = 1, .rows = rows, .asked = 0.02 };
    made_rows(rows);
    cost_conclude(rows, &r);
    assert_non_null(strstr(r.advice, "no setting met 2 % in the time given; --accuracy 20%"));
}

TEST(the_picture_names_every_setting_once)
{
    char *folder = folder_new();
    arena a      = { 0 };
    cost_row rows[5];
    cost_result r = { .what = "desk", .row_count = 5, .rows = rows, .asked = 0.02 };
    made_rows(rows);
    rows[4].rms = 0.0; /* has no place on a logarithmic scale */
    cost_conclude(rows, &r);
    const study *s = study_of_text(&a, NULL, "lux4: 1\n");
    assert_true(cost_plot(path_in(folder, "cost.svg"), s, &r, NULL));
    size_t size;
    char *svg = bytes_of(path_in(folder, "cost.svg"), &size);
    assert_non_null(strstr(svg, ">bounces 4</text>"));
    assert_non_null(strstr(svg, ">20 %</text>"));
    assert_non_null(strstr(svg, "time / s"));
    assert_non_null(strstr(svg, "RMS error / %"));
    assert_non_null(strstr(svg, "grid desk"));
    assert_null(strstr(svg, "--no color</text>"));
    assert_null(strstr(svg, "nan"));
    assert_null(strstr(svg, "inf"));
    free(svg);
    arena_clear(&a);
    folder_free(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_median_is_the_middle_one),
        cmocka_unit_test(a_slope_is_that_of_a_power_law),
        cmocka_unit_test(one_point_has_no_slope),
        cmocka_unit_test(the_noise_of_the_reference_is_taken_off),
        cmocka_unit_test(bias_is_told_from_noise),
        cmocka_unit_test(a_wild_sensor_is_no_bias),
        cmocka_unit_test(an_error_below_the_references_noise_is_not_called_none),
        cmocka_unit_test(seconds_and_rays_are_medians),
        cmocka_unit_test(time_for_one_percent_follows_the_slope),
        cmocka_unit_test(what_a_rung_has_reached_costs_the_next_nothing_more),
        cmocka_unit_test(what_is_left_to_do_counts_all_runs),
        cmocka_unit_test(advice_names_the_cheapest_setting_that_users_can_choose),
        cmocka_unit_test(advice_says_where_intervals_do_not_promise_what_is_met),
        cmocka_unit_test(advice_says_where_nothing_meets_what_is_asked),
        cmocka_unit_test(the_picture_names_every_setting_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
