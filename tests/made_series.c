/* tests/made_series.c -- see made_series.h. */
#include "tests/made_series.h"

#include "tests/test.h"

#include <stdio.h>

static grid_result plan_of(arena *a)
{
    study_grid *g     = arena_new(a, study_grid, NULL);
    grid_sensor *at   = arena_array(a, grid_sensor, MADE_SENSORS, NULL);
    int *cell         = arena_array(a, int, MADE_SENSORS, NULL);
    const int cells[] = { 0, 1, 2, 3, 5 };
    *g = (study_grid){ .name = "desk", .u = { 3.0, 0.0, 0.0 }, .v = { 0.0, 2.0, 0.0 } };
    for (int k = 0; k < MADE_SENSORS; k++) {
        cell[k]      = cells[k];
        at[k].at     = (dvec3){ cells[k] % 3 + 0.5, cells[k] / 3 + 0.5, 0.75 };
        at[k].normal = (dvec3){ 0.0, 0.0, 1.0 };
    }
    return (grid_result){ .grid         = g,
                          .columns      = MADE_COLUMNS,
                          .rows         = MADE_ROWS,
                          .sensor_count = MADE_SENSORS,
                          .sensors      = at,
                          .cell         = cell,
                          .left_out     = 1 };
}

static grid_moment light_at(arena *a, int h)
{
    double *block = arena_array(a, double, 4 * MADE_SENSORS, NULL);
    grid_moment m = { block, block + MADE_SENSORS, block + 2 * MADE_SENSORS,
                      block + 3 * MADE_SENSORS };
    for (int k = 0; k < MADE_SENSORS; k++) {
        m.illuminance[k] = 100.0 * (h + 1) + k;
        m.direct[k]      = 0.5 * m.illuminance[k];
        m.half_width[k]  = 0.01 * m.illuminance[k];
        m.sun[k]         = (k + 1) / 5.0;
    }
    return m;
}

void made_series(arena *a, int days, int hours, daylight_series *out)
{
    int count       = days * hours;
    moment *moments = arena_array(a, moment, (size_t)count, NULL);
    *out            = (daylight_series){ .plan    = plan_of(a),
                                         .moments = moments,
                                         .count   = count,
                                         .wanted  = count,
                                         .step_h  = 1.0,
                                         .asked   = 0.02,
                                         .reached = 0.01 };
    out->light      = arena_array(a, grid_moment, (size_t)count, NULL);
    out->of         = arena_array(a, daylight_figures, (size_t)count, NULL);
    for (int h = 0; h < count; h++) {
        moment *m    = &moments[h];
        double day   = clock_from_civil(&(civil_time){ 2026, 6, 21, 0, 0, 0.0 });
        m->at        = day + 86400.0 * (h / hours) + 3600.0 * (10 + h % hours);
        m->local     = clock_local(NULL, m->at);
        m->sun_known = true;
        m->sun       = (sun_place){ .azimuth_deg = 180.0, .elevation_deg = 50.0 };
        clock_print(m->text, NULL, m->at);
        out->light[h] = light_at(a, h);
        out->of[h]    = daylight_figures_of(&out->light[h], MADE_SENSORS);
    }
    assert_true(daylight_sum_sun(a, out, NULL));
}
