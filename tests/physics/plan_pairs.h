/* tests/physics/plan_pairs.h -- pairs of scenes that need an effect and do not, for
 * test_plan_pairs*.c: what the plan leaves out stays within its bound of the run with everything
 * forced on, and a scene that needs it by a hair turns it on.
 */
#ifndef TESTS_PHYSICS_PLAN_PAIRS_H
#define TESTS_PHYSICS_PLAN_PAIRS_H

#include "sim/plan.h"
#include "tests/folder.h"
#include "tests/gltf_text.h"
#include "tests/lab_picture.h"
#include "tests/test.h"

#include <string.h>

typedef struct outcome {
    plan plan;
    grid_result grid;
    const scene *scene; /* as it was run */
} outcome;

static const plan_options as_planned = { .accuracy = (double)NAN };
static const plan_options all_is_on  = { .accuracy = (double)NAN,
                                         .has_only = true,
                                         .only     = (1u << EFFECTS) - 1 };

/* The run may be more accurate than what was planned for: then without the bound, which has no room
 * in that. NAN: as the study says. */
static inline void run_with(lab *l, const char *yaml, const plan_options *how, double accuracy,
                            outcome *out)
{
    lux_error err   = { 0 };
    const scene *s  = lab_scene(l, yaml);
    scene_options o = { .threads = 1 };
    run_options r   = { .accuracy = accuracy, .deadline = HUGE_VAL, .seed = 1, .threads = 1 };
    *out            = (outcome){ 0 };
    if (!plan_make(s, how, &out->plan, NULL, &err))
        fail_msg("%s", err.text);
    o.off      = plan_without(&out->plan);
    o.on       = out->plan.on;
    out->scene = o.off | o.on ? scene_new(&l->a, s->study, &o, NULL, &err) : s;
    assert_non_null(out->scene);
    plan_apply(&out->plan, &r);
    r.bound = isnan(accuracy) ? r.bound : 0.0;
    grid_of_scene(&l->a, out->scene, 0, &r, &out->grid);
}

static inline void run(lab *l, const char *yaml, const plan_options *how, outcome *out)
{
    run_with(l, yaml, how, (double)NAN, out);
}

#define INTERVALS_STRETCH (4.0728 / 2.1314) /* from 95 to 99.9 %, t of 15 degrees of freedom */

/* Both intervals hold the truth in 95 of 100 cases each: they overlap, and where samples took no
 * part to rounding. Both are as narrow as was asked for. */
static inline void assert_agree(const outcome *a, const outcome *b)
{
    const double rounding = 1e-6;
    assert_int_equal(a->grid.sensor_count, b->grid.sensor_count);
    assert_int_equal(a->grid.missed + b->grid.missed, 0);
    for (int k = 0; k < a->grid.sensor_count; k++) {
        double one = a->grid.illuminance[k], other = b->grid.illuminance[k];
        double most =
            INTERVALS_STRETCH * (a->grid.half_width[k] + b->grid.half_width[k]) + rounding * one;
        if (!(fabs(one - other) <= most))
            fail_msg("sensor %d: %.9g lx as planned, %.9g with all on, where %.3g may be between",
                     k, one, other, most);
    }
}

static inline bool is_on(const outcome *o, effect e) { return o->plan.effects[e].on; }

/* The plan of one scene leaves the effect out, and agrees; that of the other has it on. */
static inline void assert_pair(lab *l, effect e, const char *without, const char *with)
{
    outcome planned, forced, needed;
    run(l, without, &as_planned, &planned);
    run(l, without, &all_is_on, &forced);
    run(l, with, &as_planned, &needed);
    if (is_on(&planned, e) || !is_on(&forced, e) || !is_on(&needed, e))
        fail_msg("%s: %d without need, %d forced, %d needed", effect_name(e), is_on(&planned, e),
                 is_on(&forced, e), is_on(&needed, e));
    assert_agree(&planned, &forced);
}

#define ROOM(reflectance)                                                                          \
    "lux4: 1\nroom: {size: [4, 3, 2.5], reflectance: " reflectance "}\naccuracy: 10%\n"
#define GRID  "grids: [{name: g, on: room, height: 0.8, margin: 0.5, spacing: 0.8}]\n"
#define POINT "{type: point, at: [2, 1, 2], lumens: 1000}"

#endif
