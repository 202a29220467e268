/* tests/unit/test_lux4.c -- the library as other programs use it: by its one header alone. */
#include "sim/lux4.h"
#include "tests/test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char study_text[] =
    "lux4: 1\n"
    "room: {size: [4, 4, 4], reflectance: 0.5}\n"
    "lights: [{type: point, at: [2, 2, 2], lumens: 10000}, {type: point, at: [9, 2, 2], lumens: "
    "1}]\n"
    "grids:\n"
    "  - {name: floor, origin: [0, 0, 0], u: [4, 0, 0], v: [0, 4, 0], spacing: 1}\n"
    "  - {name: heads, on: room, height: 1, spacing: 2, quantity: cylindrical}\n"
    "variants:\n"
    "  dim: {lights: [{type: point, at: [2, 2, 2], lumens: 1000}]}\n"
    "  day: {room: ~, lights: ~, sky: {model: uniform, horizontal: 10000}, grids: [{name: open, "
    "origin: [0, 0, 0], u: [1, 0, 0], v: [0, 1, 0], spacing: 1}]}\n"
    "  series: {site: {place: 52N 13E}, when: {date: 2026-03-20, from: \"10:00\"}, sky: {model: "
    "clear}}\n"
    "views: [{name: wall, eye: [2, 1, 2], target: [2, 4, 2], size: [16, 12]}]\n";

static char path[] = "/tmp/lux4-library-XXXXXX";

static int write_study(void **state)
{
    (void)state;
    int fd = mkstemp(path);
    return fd < 0 || write(fd, study_text, strlen(study_text)) < 0 || close(fd);
}

static int remove_study(void **state)
{
    (void)state;
    return unlink(path);
}

/* Straight below a lamp of 10000 lm at 2 m: 10000 / (4 pi) / 4 lx of direct light at (2, 2, 0); the
 * nearest sensors are half a metre off in x and y. */
TEST(a_grid_runs_and_says_how_good_it_is)
{
    lux4_error err = { 0 };
    lux4 *study    = lux4_open(path, &err);
    assert_non_null(study);
    assert_int_equal(lux4_grid_count(study), 2);
    assert_string_equal(lux4_grid_name(study, 0), "floor");

    lux4_grid *g = lux4_run_grid(study, 0, &(lux4_options){ .accuracy = 0.05, .threads = 2 }, &err);
    assert_non_null(g);
    assert_int_equal(g->sensor_count, 16);
    assert_int_equal(g->left_out, 0);
    assert_string_equal(g->quantity, "illuminance");
    double d2 = 4.0 + 0.25 + 0.25, want = 10000.0 / (4.0 * M_PI) * 2.0 / (d2 * sqrt(d2));
    assert_near(g->x[5], 1.5, 1e-12);
    assert_near(g->normal_z[5], 1.0, 0.0);
    assert_near(g->direct_lx[5], want, 1e-5);
    assert_near(g->illuminance_lx[5], g->direct_lx[5] + g->indirect_lx[5], 1e-12);
    assert_true(g->missed == 0 && !g->interrupted && g->rays > 0);
    assert_true(g->half_width_lx[5] > 0.0 && g->half_width_lx[5] <= 0.05 * g->illuminance_lx[5]);
    lux4_grid_free(g);
    lux4_close(study);
}

/* A tenth of the light, and no lamp outside. */
TEST(a_variant_is_opened_by_its_name)
{
    lux4_error err       = { 0 };
    lux4_options options = { .direct_only = true };
    lux4 *study = lux4_open(path, &err), *dim = lux4_open_variant(path, "dim", &err);
    lux4_grid *g = lux4_run_grid(study, 1, &options, &err);
    lux4_grid *h = lux4_run_grid(dim, 1, &options, &err);
    assert_non_null(g);
    assert_non_null(h);
    assert_string_equal(h->quantity, "cylindrical illuminance");
    assert_near(h->average_lx, 0.1 * g->average_lx, 1e-5);
    assert_int_equal(lux4_warning_count(dim), 0);
    lux4_grid_free(g);
    lux4_grid_free(h);
    lux4_close(study);
    lux4_close(dim);
    assert_null(lux4_open_variant(path, "dmi", &err));
    assert_int_equal(err.code, LUX4_INPUT);
    assert_non_null(strstr(err.text, "did you mean `dim`?"));
}

/* L = rho E / pi: a matt wall of 50 %, E of which the view holds too. */
/* Under the open sky all that the study says of it arrives, unscattered. */
TEST(daylight_counts_as_lamps_do)
{
    lux4_error err = { 0 };
    lux4 *study    = lux4_open_variant(path, "day", &err);
    assert_non_null(study);
    lux4_grid *g = lux4_run_grid(study, 0, NULL, &err);
    assert_non_null(g);
    assert_near(g->average_lx, 10000.0, 0.02); /* the accuracy of grids */
    assert_near(g->direct_lx[0], g->illuminance_lx[0], 1e-12);
    lux4_grid_free(g);
    lux4_close(study);

    assert_null(lux4_open_variant(path, "series", &err)); /* one moment at a time */
    assert_int_equal(err.code, LUX4_INPUT);
    assert_non_null(strstr(err.text, "series"));
}

TEST(a_view_holds_radiance_and_illuminance)
{
    lux4 *study  = lux4_open(path, NULL);
    lux4_view *v = lux4_run_view(study, 0, NULL, NULL);
    assert_non_null(v);
    assert_true(v->width == 16 && v->height == 12 && v->enough);
    for (int k = 0; k < v->width * v->height; k++) {
        assert_near(179.0 * (double)v->green[k], 0.5 * (double)v->illuminance_lx[k] / M_PI, 1e-4);
        assert_true(v->distance_m[k] >= 3.0f && v->distance_m[k] < 4.5f);
    }
    lux4_view_free(v);
    lux4_close(study);
}

TEST(warnings_are_told)
{
    lux4 *study = lux4_open(path, NULL);
    assert_int_equal(lux4_warning_count(study), 1);
    assert_non_null(strstr(lux4_warning(study, 0), "outside the room"));
    assert_null(lux4_warning(study, 1));
    lux4_close(study);
}

TEST(errors_are_values)
{
    lux4_error err = { 0 };
    assert_null(lux4_open("/nonexistent/study.yaml", &err));
    assert_int_equal(err.code, LUX4_INPUT);
    assert_non_null(strstr(err.text, "/nonexistent/study.yaml"));
    lux4 *study = lux4_open(path, NULL);
    assert_null(lux4_run_grid(study, 2, NULL, &err));
    assert_null(lux4_run_view(study, -1, NULL, &err));
    lux4_close(study);
    lux4_close(NULL);
    lux4_grid_free(NULL);
    lux4_view_free(NULL);
}

TEST(a_run_that_is_stopped_at_once_is_an_error)
{
    volatile bool stop = true;
    lux4_error err     = { 0 };
    lux4 *study        = lux4_open(path, NULL);
    assert_null(lux4_run_grid(study, 0, &(lux4_options){ .stop = &stop }, &err));
    assert_int_equal(err.code, LUX4_INTERRUPTED);
    lux4_close(study);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_grid_runs_and_says_how_good_it_is),
        cmocka_unit_test(a_variant_is_opened_by_its_name),
        cmocka_unit_test(daylight_counts_as_lamps_do),
        cmocka_unit_test(a_view_holds_radiance_and_illuminance),
        cmocka_unit_test(warnings_are_told),
        cmocka_unit_test(errors_are_values),
        cmocka_unit_test(a_run_that_is_stopped_at_once_is_an_error),
    };
    return cmocka_run_group_tests(tests, write_study, remove_study);
}
