/* tests/unit/test_daylight_write.c -- figures and files of series whose light is made up. */
#include "core/image.h"
#include "sim/daylight_write.h"
#include "tests/folder.h"
#include "tests/made_series.h"
#include "tests/program.h"
#include "tests/test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static arena memory;
static char *folder;
static const study from = { .path = "job/office.yaml", .folder = "job", .maintenance = 1.0 };

static int begin(void **state)
{
    (void)state;
    folder = folder_new();
    return 0;
}

static int end(void **state)
{
    (void)state;
    arena_clear(&memory);
    folder_free(folder);
    return 0;
}

static daylight_series made(int days, int hours)
{
    daylight_series s;
    made_series(&memory, days, hours, &s);
    return s;
}

static char *text_of_file(const char *name)
{
    size_t size;
    return bytes_of(path_in(folder, name), &size);
}

TEST(figures_are_of_the_sensors)
{
    daylight_series s = made(1, 2);
    assert_near(s.of[1].average, 202.0, 1e-12); /* 200 ... 204 */
    assert_true(s.of[1].minimum == 200.0 && s.of[1].maximum == 204.0);
    assert_near(s.of[1].uniformity, 200.0 / 202.0, 1e-12);
    assert_near(s.of[1].average_half_width, 2.02, 1e-12);
    assert_near(s.of[1].worst_half_width, 0.01, 1e-12);
    assert_near(s.of[1].sun, 0.6, 1e-12); /* 0.2, 0.4, ... 1 */
}

TEST(darkness_is_no_division_by_zero)
{
    double zero[2]     = { 0.0, 0.0 };
    daylight_figures f = daylight_figures_of(&(grid_moment){ zero, zero, zero, NULL }, 2);
    assert_true(f.average == 0.0 && f.uniformity == 0.0 && f.worst_half_width == 0.0);
    assert_true(f.minimum == 0.0 && f.sun == 0.0);
}

TEST(hours_of_sun_are_those_of_a_day)
{
    daylight_series one = made(1, 4), three = made(3, 4);
    assert_int_equal(one.dates, 1);
    assert_int_equal(three.dates, 3);
    for (int k = 0; k < MADE_SENSORS; k++) {
        assert_near(one.sun_hours[k], 4.0 * (k + 1) / 5.0, 1e-12);
        assert_near(three.sun_hours[k], 4.0 * (k + 1) / 5.0, 1e-12);
    }
    one.sun_hours = NULL;
    one.step_h    = (double)NAN; /* a single time has no length */
    assert_true(daylight_sum_sun(&memory, &one, NULL));
    assert_null(one.sun_hours);
}

TEST(a_table_has_a_row_for_each_sensor_and_moment)
{
    daylight_series s = made(1, 2);
    assert_true(daylight_write_csv(path_in(folder, "a.csv"), &s, NULL));
    static const char top[] =
        "time,x,y,z,nx,ny,nz,illuminance_lx,direct_lx,indirect_lx,half_width_lx\n"
        "2026-06-21T10:00Z,0.5,0.5,0.75,0,0,1,100,50,50,1\n"
        "2026-06-21T10:00Z,1.5,0.5,0.75,0,0,1,101,50.5,50.5,1.01\n";
    char *text = text_of_file("a.csv");
    assert_memory_equal(text, top, sizeof top - 1);
    assert_non_null(strstr(text, "2026-06-21T11:00Z,2.5,1.5,0.75,0,0,1,204,102,102,2.04\n"));
    assert_null(strstr(text, "1.5,1.5,")); /* left out */
    int rows = 0;
    for (const char *c = text; *c; c++)
        rows += *c == '\n';
    assert_int_equal(rows, 1 + 2 * MADE_SENSORS);
    free(text);
}

TEST(what_is_partial_says_so)
{
    daylight_series s = made(1, 2);
    s.end             = RUN_INTERRUPTED;
    image im;
    assert_true(daylight_write_csv(path_in(folder, "b.csv"), &s, NULL));
    assert_true(daylight_write_sun(path_in(folder, "b-sun.csv"), &s, NULL));
    assert_true(daylight_write_exr(path_in(folder, "b.exr"), &from, &s, NULL));
    for (int i = 0; i < 2; i++) {
        char *text = text_of_file(i ? "b-sun.csv" : "b.csv");
        assert_non_null(strstr(text, "\n# partial: "));
        free(text);
    }
    assert_true(image_read_exr_part(path_in(folder, "b.exr"), 1, &memory, &im, NULL));
    bool partial = false;
    for (int i = 0; i < im.attribute_count; i++)
        partial |= !strcmp(im.attributes[i].name, "lux4:partial");
    assert_true(partial);
}

TEST(hours_of_sun_say_whether_they_are_a_mean)
{
    daylight_series s = made(1, 5);
    assert_true(daylight_write_sun(path_in(folder, "c.csv"), &s, NULL));
    char *text = text_of_file("c.csv");
    assert_memory_equal(text, "x,y,z,nx,ny,nz,sun_hours\n0.5,0.5,0.75,0,0,1,1\n", 46);
    free(text);
    s = made(2, 5);
    assert_true(daylight_write_sun(path_in(folder, "c.csv"), &s, NULL));
    text = text_of_file("c.csv");
    assert_memory_equal(text, "x,y,z,nx,ny,nz,sun_hours_per_day\n0.5,0.5,0.75,0,0,1,1\n", 54);
    free(text);
}

static const float *channel(const image *im, const char *name)
{
    for (int i = 0; i < im->channel_count; i++)
        if (!strcmp(im->channels[i].name, name))
            return im->channels[i].values;
    fail_msg("no channel %s", name);
    return NULL;
}

TEST(a_picture_has_a_part_a_moment_with_the_largest_v_on_top)
{
    daylight_series s = made(1, 3);
    image im;
    assert_true(daylight_write_exr(path_in(folder, "d.exr"), &from, &s, NULL));
    for (int h = 0; h < 3; h++) {
        assert_true(image_read_exr_part(path_in(folder, "d.exr"), h, &memory, &im, NULL));
        assert_int_equal(im.channel_count, 5);
        const float base   = 100.0f * (float)(h + 1);
        const float want[] = { base + 3, 0, base + 4, base, base + 1, base + 2 };
        assert_memory_equal(channel(&im, "Y"), want, sizeof want);
        assert_near(channel(&im, "indirect.Y")[2], 0.5 * (double)want[2], 0.0);
        assert_near(channel(&im, "sun.Y")[3], 0.2, 0x1p-24); /* of a float */
    }
    assert_false(image_read_exr_part(path_in(folder, "d.exr"), 3, &memory, &im, NULL));
}

/* ---- the daylight factor --------------------------------------------------------------------- */

static daylight_factor made_factor(grid_result *r)
{
    static double all[] = { 1000, 100, 200, 300, 150 }, straight[] = { 900, 50, 0, 300, 150 };
    static double back[] = { 100, 50, 200, 0, 0 }, outside[] = { 60, 0, 250, 0, 0 };
    static double half[] = { 10, 1, 2, 3, 1.5 };
    daylight_series s    = made(1, 1);
    lux_error err        = { 0 };
    daylight_factor f    = { 0 };
    *r                   = s.plan;
    r->illuminance       = all;
    r->direct            = straight;
    r->indirect          = back;
    r->outside           = outside;
    r->half_width        = half;
    assert_true(daylight_factor_of(&memory, r, &f, &err));
    return f;
}

TEST(factors_are_shares_of_what_is_outside)
{
    grid_result r;
    daylight_factor f = made_factor(&r); /* of 10,000 lx */
    assert_near(f.all[0], 10.0, 1e-12);
    assert_near(f.sky[0], 9.0, 1e-12);
    assert_near(f.external[0], 0.6, 1e-12);
    assert_near(f.internal[0], 0.4, 1e-12);
    assert_true(f.internal[2] == 0.0); /* a rounding more outside than there is in all */
    assert_near(f.average, 3.5, 1e-12);
    assert_near(f.median, 2.0, 1e-12);
    assert_near(f.minimum, 1.0, 1e-12);
    assert_near(f.uniformity, 1.0 / 3.5, 1e-12);
    assert_near(f.share, 0.6, 1e-12); /* 10, 2, 3 */
    assert_near(f.average_sky + f.average_external + f.average_internal, f.average, 1e-12);
}

TEST(factors_as_files_have_their_parts)
{
    grid_result r;
    daylight_factor f = made_factor(&r);
    image im;
    assert_true(daylight_factor_write_csv(path_in(folder, "f.csv"), &f, NULL));
    assert_true(daylight_factor_write_exr(path_in(folder, "f.exr"), &from, &f, NULL));
    char *text = text_of_file("f.csv");
    assert_non_null(strstr(text, "\n0.5,0.5,0.75,0,0,1,10,9,0.6,0.4,0.1\n"));
    free(text);
    assert_true(image_read_exr(path_in(folder, "f.exr"), &memory, &im, NULL));
    assert_near(channel(&im, "Y")[3], 10.0, 0x1p-24);
    assert_near(channel(&im, "external.Y")[3], 0.6, 0x1p-24);
}

TEST(an_overcast_sky_of_the_study_is_kept_and_others_are_not)
{
    study own = from;
    own.sky = (study_sky){ .given = true, .model = STUDY_SKY_CIE, .type = 3, .sun_at_given = true };
    const study *s = daylight_factor_study(&memory, &own, NULL);
    assert_int_equal(s->sky.type, 3);
    assert_true(s->sky.horizontal == 10000.0 && s->sky.sun == STUDY_SUN_OFF);
    assert_false(s->sky.sun_at_given || s->when.given);
    own.sky.type = 12;
    assert_int_equal(daylight_factor_study(&memory, &own, NULL)->sky.type, 16);
    own.sky = (study_sky){ .model = STUDY_SKY_PANORAMA, .type = 1 };
    assert_int_equal(daylight_factor_study(&memory, &own, NULL)->sky.type, 16);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(figures_are_of_the_sensors),
        cmocka_unit_test(darkness_is_no_division_by_zero),
        cmocka_unit_test(hours_of_sun_are_those_of_a_day),
        cmocka_unit_test(a_table_has_a_row_for_each_sensor_and_moment),
        cmocka_unit_test(what_is_partial_says_so),
        cmocka_unit_test(hours_of_sun_say_whether_they_are_a_mean),
        cmocka_unit_test(a_picture_has_a_part_a_moment_with_the_largest_v_on_top),
        cmocka_unit_test(factors_are_shares_of_what_is_outside),
        cmocka_unit_test(factors_as_files_have_their_parts),
        cmocka_unit_test(an_overcast_sky_of_the_study_is_kept_and_others_are_not),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
