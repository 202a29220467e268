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

#endif
