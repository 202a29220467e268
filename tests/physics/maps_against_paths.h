/* tests/physics/maps_against_paths.h -- grids of shipped scenes by illumination maps and by paths.
 */
#ifndef TESTS_PHYSICS_MAPS_AGAINST_PATHS_H
#define TESTS_PHYSICS_MAPS_AGAINST_PATHS_H

#include "tests/folder.h"
#include "tests/program.h"
#include "tests/test.h"

#include <stdio.h>

/* The root of the mean square by which maps are off from paths, of max(value, a tenth of the
 * grid's average), over all sensors of a study's grids: 2 % at most. Both are as accurate as
 * is usual, and maps are so within ten minutes: what they lack they would wait for in vain. */
static inline void maps_agree_with_paths(const char *file, const char *variant)
{
    arena a       = { 0 };
    lux_error err = { 0 };
    char path[4096];
    snprintf(path, sizeof path, "%s/data/%s", project_root(), file);
    const study *from = study_read(&a, path, variant, NULL, &err);
    const scene *s =
        from ? scene_new(&a, from, &(scene_options){ .threads = 2 }, NULL, &err) : NULL;
    if (!s)
        fail_msg("%s", err.text);
    double square = 0.0;
    int count     = 0;
    for (int g = 0; g < from->grid_count; g++) {
        grid_result maps, paths;
        run_options o = { .accuracy = 0.02, .seed = 1, .threads = 2, .transport = TRANSPORT_MAPS };
        o.deadline    = clock_seconds() + 600.0;
        grid_of_scene(&a, s, g, &o, &maps);
        assert_int_equal(maps.end, RUN_DONE);
        o.deadline  = HUGE_VAL;
        o.seed      = 2;
        o.transport = TRANSPORT_PATH;
        grid_of_scene(&a, s, g, &o, &paths);
        double sum = 0.0;
        for (int k = 0; k < maps.sensor_count; k++) {
            double of  = fmax(paths.illuminance[k], 0.1 * paths.average);
            double off = (maps.illuminance[k] - paths.illuminance[k]) / of;
            sum += off * off;
        }
        printf("%s, %s: %d sensors, %.1f lx by maps (%.2f s), %.1f by paths (%.2f s), RMS %.2f "
               "%%\n",
               file, from->grids[g].name, maps.sensor_count, maps.average, maps.seconds,
               paths.average, paths.seconds, 100.0 * sqrt(sum / maps.sensor_count));
        square += sum;
        count += maps.sensor_count;
    }
    assert_true(sqrt(square / count) <= 0.02);
    arena_clear(&a);
}

#endif
