/* tests/physics/scene_coverage.h -- how often stated intervals hold the truth in four scenes: the
 * office, a room with a window under a clear sky with its sun, a corridor of mirrors, and a bright
 * closed cavity. For test_scene_coverage.c (a few seeds) and long_scene_coverage.c.
 *
 * The truth is the mean of long runs of other seeds, with an interval of its own, h_0: an interval
 * h holds it if the two are at most sqrt(h^2 + h_0^2) apart, as those of two 95 % intervals of
 * independent means are in 95 % of all cases.
 *
 * Runs end as users end them: at an accuracy; or (as a deadline would, but after the same samples
 * each time) after two rounds, and after two scrambles of each unknown.
 */
#ifndef TESTS_PHYSICS_SCENE_COVERAGE_H
#define TESTS_PHYSICS_SCENE_COVERAGE_H

#include "core/color.h"
#include "sim/render.h"
#include "tests/lab.h"
#include "tests/test.h"

#include <stdio.h>
#include <string.h>

typedef enum run_stop { AT_ACCURACY, AFTER_TWO_ROUNDS, AFTER_TWO_SCRAMBLES, RUN_STOPS } run_stop;
static const char *const stop_text[RUN_STOPS] = { "at the accuracy", "after two rounds",
                                                  "after two scrambles" };

typedef struct coverage {
    int all, held, within; /* unknowns times seeds; intervals that hold; as accurate as asked */
    double rays;
} coverage;

typedef struct trial_scene {
    const char *name, *yaml, *file; /* the text of a study, or where it is */
    const char *grid;
    double accuracy; /* asked of grids: more than two rounds */
    bool mirrored;   /* takes many rays */
    study_view view;
} trial_scene;

static const trial_scene trial_scenes[] = {
    { .name     = "office",
      .accuracy = 0.02,
      .file     = "data/office/office.yaml",
      .grid     = "floor",
      .view     = { .camera = "corner", .width = 64, .height = 48 } },
    { .name     = "window room",
      .accuracy = 0.03,
      .yaml     = "room: {size: [4, 5, 3], reflectance: 0.5, windows: [{wall: south, at: [1, 1], "
                  "size: [2, 1.2]}]}\n"
                  "site: {place: 52.5N 13.4E, zone: Europe/Berlin, north: 20}\n"
                  "sky: {model: clear, turbidity: 4}\nwhen: 2026-03-21T13:00\n"
                  "grids: [{name: g, origin: [0.5, 0.5, 0.1], u: [3, 0, 0], v: [0, 4, 0], spacing: "
                  "1}]\n",
      .grid     = "g",
      .view = { .eye = { 0.3, 4.7, 1.6 }, .target = { 2.5, 0, 0.8 }, .width = 48, .height = 32 } },
    { .name     = "mirrored corridor",
      .accuracy = 0.02,
      .mirrored = true,
      .yaml     = "room: {size: [2, 8, 3], reflectance: {ceiling: 0.7, walls: 0.5, floor: 0.2}}\n"
                  "scene: [west.gltf, east.gltf]\n"
                  "materials: [{match: Mirror, mirror: 0.9}]\n"
                  "lights: [{type: rect, at: [1, 4, 2.9], size: [1.2, 5], lumens: 3000}, {type: point, "
                  "at: [0.7, 3, 2.2], lumens: 800}]\n"
                  "grids: [{name: g, origin: [0.2, 1, 0.1], u: [1.6, 0, 0], v: [0, 6, 0], spacing: "
                  "0.8}]\n",
      .grid     = "g",
      .view = { .eye = { 1.3, 7.5, 1.6 }, .target = { 0.8, 2, 1 }, .width = 48, .height = 32 } },
    { .name     = "closed furnace",
      .accuracy = 0.07,
      .yaml     = "room: {size: [4, 3, 2.5], reflectance: 0.9}\n"
                  "lights: [{type: disk, at: [1, 1, 2.4], radius: 0.2, lumens: 2000}]\n"
                  "grids: [{name: g, origin: [0, 0, 0.8], u: [4, 0, 0], v: [0, 3, 0], spacing: 1}]\n",
      .grid     = "g",
      .view = { .eye = { 3.6, 2.6, 1.6 }, .target = { 1, 0.5, 1.2 }, .width = 48, .height = 32 } },
};
enum { TRIAL_SCENES = sizeof trial_scenes / sizeof *trial_scenes };

static inline void write_mirror(lab *l, const char *name, double x)
{
    quad q = { { { x, 0, 0 }, { x, 8, 0 }, { x, 8, 3 }, { x, 0, 3 } } };
    lab_quads(l, name, &q, 1, "\"name\":\"Mirror\"");
}

static inline const scene *make_trial_scene(lab *l, const trial_scene *t)
{
    char path[4096];
    lux_error err = { 0 };
    write_mirror(l, "west.gltf", 0.001); /* m: just before the walls */
    write_mirror(l, "east.gltf", 1.999);
    if (t->yaml)
        lab_write(l, "study.yaml", "lux4: 1\n%s", t->yaml);
    snprintf(path, sizeof path, "%s%s", t->yaml ? l->folder : "",
             t->yaml ? "/study.yaml" : t->file);
    const study *of = study_read(&l->a, path, NULL, NULL, &err);
    const scene *s = of ? scene_new(&l->a, of, &(scene_options){ .threads = 2 }, NULL, &err) : NULL;
    if (!s)
        fail_msg("%s", err.text);
    return s;
}

static inline run_options stopped(run_stop stop, double accuracy, uint32_t seed)
{
    return (run_options){ .accuracy = stop == AFTER_TWO_ROUNDS ? 1e6 : accuracy,
                          .deadline = stop == AFTER_TWO_SCRAMBLES ? 0.0 : HUGE_VAL,
                          .seed     = seed,
                          .threads  = 2 };
}

static inline void print_coverage(const char *what, const trial_scene *t, run_stop stop,
                                  double accuracy, const coverage *c)
{
    printf("%s, %s, %g %%, %s: of %d intervals %.1f %% hold the truth, %.1f %% of the values are "
           "as accurate as asked; %.3g rays each\n",
           what, t->name, 100.0 * accuracy, stop_text[stop], c->all, 100.0 * c->held / c->all,
           100.0 * c->within / c->all, c->rays / c->all);
    fflush(stdout);
}

static inline void count_one(coverage *c, double got, double half, double truth, double truth_half,
                             double enough)
{
    double off = fabs(got - truth);
    c->all++;
    c->held += off <= hypot(half, truth_half) + 1e-5 * fabs(truth);
    c->within += off <= enough;
}

typedef struct grid_truth {
    const study_grid *grid;
    grid_result r;
} grid_truth;

static inline grid_truth find_grid_truth(lab *l, const scene *s, const trial_scene *t,
                                         double accuracy)
{
    grid_truth out = { .grid = s->study->grids };
    while (strcmp(out.grid->name, t->grid) != 0)
        out.grid++;
    run_options o = stopped(AT_ACCURACY, accuracy, 1000);
    assert_true(grid_run(&l->a, s, out.grid, &o, &out.r, NULL));
    return out;
}

static inline coverage grid_coverage(const scene *s, const grid_truth *truth, run_stop stop,
                                     double accuracy, int seeds)
{
    coverage c = { 0 };
    for (int seed = 1; seed <= seeds; seed++) {
        arena run     = { 0 };
        run_options o = stopped(stop, accuracy, (uint32_t)seed);
        grid_result r;
        assert_true(grid_run(&run, s, truth->grid, &o, &r, NULL));
        for (int k = 0; k < r.sensor_count; k++)
            count_one(&c, r.illuminance[k], r.half_width[k], truth->r.illuminance[k],
                      truth->r.half_width[k],
                      accuracy * fmax(truth->r.illuminance[k], 0.1 * truth->r.average));
        c.rays += (double)r.rays;
        arena_clear(&run);
    }
    return c;
}

static inline void add_coverage(coverage *to, const coverage *c)
{
    to->all += c->all;
    to->held += c->held;
    to->within += c->within;
    to->rays += c->rays;
}

static inline double luminance_of(const view_result *r, int k)
{
    vec3 l = { r->radiance[0][k], r->radiance[1][k], r->radiance[2][k] };
    return LUMENS_PER_WATT * (double)rgb_luminance(l);
}

static inline study_view trial_view(const trial_scene *t)
{
    study_view v = t->view;
    v.name       = "v";
    v.size_given = true;
    if (!v.camera)
        v.fov_deg = 60.0;
    return v;
}

static inline view_result find_view_truth(lab *l, const scene *s, const study_view *v,
                                          double accuracy)
{
    view_result r;
    run_options o = stopped(AT_ACCURACY, accuracy, 1000);
    assert_true(view_run(&l->a, s, v, &o, &r, NULL));
    return r;
}

static inline coverage view_coverage(const scene *s, const study_view *v, const view_result *truth,
                                     run_stop stop, double accuracy, int seeds)
{
    coverage c = { 0 };
    for (int seed = 1; seed <= seeds; seed++) {
        arena run     = { 0 };
        run_options o = stopped(stop, accuracy, (uint32_t)seed);
        view_result r;
        assert_true(view_run(&run, s, v, &o, &r, NULL));
        for (int k = 0; k < r.width * r.height; k++)
            count_one(&c, luminance_of(&r, k), (double)r.half_width[k], luminance_of(truth, k),
                      (double)truth->half_width[k],
                      accuracy * fmax(luminance_of(truth, k), 0.1 * truth->log_average));
        c.rays += (double)r.rays;
        arena_clear(&run);
    }
    return c;
}

#endif
