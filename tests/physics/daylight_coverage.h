/* tests/physics/daylight_coverage.h -- how often intervals of daylight hold the truth, which is a
 * run that is asked for seven times the accuracy. For test_daylight_interval.c (a few seeds) and
 * long_daylight_coverage.c.
 */
#ifndef TESTS_PHYSICS_DAYLIGHT_COVERAGE_H
#define TESTS_PHYSICS_DAYLIGHT_COVERAGE_H

#include "core/image.h"
#include "tests/lab.h"
#include "tests/test.h"

#include <stdio.h>

typedef struct coverage {
    int all, held, within; /* intervals; that hold the truth; values as accurate as asked */
} coverage;

/* Of the first grid of a study, at every moment of its series where there is one. */
static inline coverage coverage_of(lab *l, const char *yaml, double accuracy, int seeds)
{
    char path[4096];
    lux_error err = { 0 };
    int count     = 0;
    lab_write(l, "study.yaml", "lux4: 1\n%s", yaml);
    snprintf(path, sizeof path, "%s/study.yaml", l->folder);
    const study *of = study_read(&l->a, path, NULL, NULL, &err);
    const moment *hours =
        of && of->when.series ? moments_of(&l->a, of, &of->when, &count, NULL, &err) : NULL;
    scene_options with = { .threads = 2, .moments = hours, .moment_count = count };
    const scene *s     = of ? scene_new(&l->a, of, &with, NULL, &err) : NULL;
    if (!s)
        fail_msg("%s", err.text);

    coverage c = { 0 };
    grid_result truth, r;
    run_options o = {
        .accuracy = accuracy / 7.0, .deadline = HUGE_VAL, .seed = 1000, .threads = 2
    };
    assert_true(grid_run(&l->a, s, &of->grids[0], &o, &truth, NULL));
    o.accuracy = accuracy;
    for (o.seed = 1; o.seed <= (uint32_t)seeds; o.seed++) {
        arena run = { 0 };
        assert_true(grid_run(&run, s, &of->grids[0], &o, &r, NULL));
        assert_null(r.left_to_chance);
        assert_int_equal(r.end, RUN_DONE);
        for (int h = 0; h < (count ? count : 1); h++) {
            const double *got  = count ? r.moments[h].illuminance : r.illuminance;
            const double *half = count ? r.moments[h].half_width : r.half_width;
            const double *want = count ? truth.moments[h].illuminance : truth.illuminance;
            double average     = 0.0;
            for (int k = 0; k < r.sensor_count; k++)
                average += want[k] / r.sensor_count;
            for (int k = 0; k < r.sensor_count; k++, c.all++) {
                double off = fabs(got[k] - want[k]);
                c.held += off <= half[k] + 1e-5 * want[k];
                c.within += off <= accuracy * fmax(want[k], 0.1 * average);
            }
        }
        arena_clear(&run);
    }
    return c;
}

#define LIT_BY(light)                                                                              \
    "room: {size: [4, 5, 3], reflectance: 0.5, windows: [{wall: south, at: [1, 1], size: [2, "     \
    "1.2]}]}\ngrids: [{name: g, origin: [0.5, 0.5, 0.1], u: [3, 0, 0], v: [0, 4, 0], spacing: "    \
    "1}]\n" light
#define BERLIN "site: {place: 52.5N 13.4E, zone: Europe/Berlin, north: 20}\n"
#define CLEAR  BERLIN "sky: {model: clear, turbidity: 4}\nwhen: 2026-03-21T13:00\n"
#define SERIES                                                                                     \
    BERLIN "sky: {model: clear, turbidity: 4}\n"                                                   \
           "when: {date: 2026-03-21, from: \"09:00\", to: \"15:00\", step: 120}\n"

/* The sun stands at 45 degrees due south, 0.53 degrees wide: the lintel at 2.2 m has its edge of
 * 29 mm on the floor about y = 2.2 m, across 24 sensors. */
#define HALF_SHADOW                                                                                \
    "room: {size: [4, 5, 3], reflectance: 0.5, windows: [{wall: south, at: [1, 1], size: [2, "     \
    "1.2]}]}\ngrids: [{name: g, origin: [1.5, 2.17, 0], u: [0.04, 0, 0], v: [0, 0.06, 0], "        \
    "spacing: 0.01}]\nsky: {model: uniform, sun: disk, horizontal: 5000, sun_illuminance: 50000, " \
    "sun_at: {azimuth: 180, elevation: 45}}\n"

/* 64 by 32 pixels that differ, darker below the horizon, with a bright cloud in the south. */
static inline void write_sunny_panorama(const lab *l)
{
    enum { W = 64, H = 32 };
    char path[4096];
    static float rgb[3][W * H];
    lux_error err = { 0 };
    for (int i = 0; i < W * H; i++)
        for (int c = 0; c < 3; c++) {
            bool cloud = i % W < 4 && i / W >= 8 && i / W < 12;
            rgb[c][i]  = (i < W * H / 2 ? 20.0f : 4.0f) * (cloud ? 20.0f : 1.0f) *
                        (1.0f + 0.1f * (float)(i * (3 + c) % 17));
        }
    image_channel c[3] = { { "B", rgb[2] }, { "G", rgb[1] }, { "R", rgb[0] } };
    image im           = { .width = W, .height = H, .channel_count = 3, .channels = c };
    snprintf(path, sizeof path, "%s/sky.exr", l->folder);
    if (!image_write_exr(path, &im, false, NULL, &err))
        fail_msg("%s", err.text);
}

#endif
