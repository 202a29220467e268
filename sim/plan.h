/* sim/plan.h -- which effects of light a study calls for, and what leaving the others out may cost.
 *
 * Before anything is simulated the scene is searched. An effect is off where it is provably without
 * effect, or where a bound on what it adds is small: the bounds of all that is off together stay
 * below a fifth of the accuracy asked for, and are added to half widths.
 */
#ifndef SIM_PLAN_H
#define SIM_PLAN_H

#include "sim/effects.h"
#include "sim/grid.h"

/* What is planned for. */
typedef struct plan_options {
    double accuracy; /* relative, of grids; NAN: the study's, or else the default */
    bool direct_only;
    bool views;          /* the study's views are to be drawn; else its grids to be run */
    bool series;         /* of several moments */
    uint32_t no, only;   /* bits 1 << effect that the user has named */
    bool has_only;       /* he has: all others are off; all bits: everything is forced on */
    transport transport; /* that he asks for; of TRANSPORT_AUTO pilots tell (plan_pilot.c), */
    uint32_t seed;       /* of this seed, */
    int threads;         /* in so many; 0: 1. What they tell does not depend on it */
    double seconds;      /* that the run may take; 0: as many as it takes */
    progress *progress;  /* NULL; only its stop counts */
} plan_options;

typedef struct plan_effect {
    bool on;
    bool forced;  /* the user said so */
    bool missed;  /* forced off, and the scene calls for it: results change */
    double bound; /* relative to a result: what being off costs at most; 0: nothing at all */
    char why[160];
} plan_effect;

typedef struct plan {
    plan_effect effects[EFFECTS];
    double accuracy; /* relative: what was planned for */
    uint32_t off;    /* bits 1 << effect: what the scene holds and is to be done without */
    uint32_t on;     /* for scene_options.on: what it does not call for, and the user asks for */
    double bound;    /* of all that is off, but for what the user forced off */
    transport transport;
    char transport_why[200];
    int weak_count; /* path classes that no sampler here reaches well: results say so */
    const char *weak[LIGHT_CLASSES];
} plan;

/* Searches the scene, which holds all effects. What the user forces off that the scene calls for is
 * noticed. False, with *err: a bad points file or camera, memory is out, or (ERR_INTERRUPTED) the
 * user stopped it. */
bool plan_make(const scene *s, const plan_options *o, plan *out, notices *n, lux_error *err);

/* For scene_options.off; 0: the scene that was searched will do. Without interreflection, which a
 * run leaves out by itself. */
static inline uint32_t plan_without(const plan *p)
{
    return p->off & ~(1u << EFFECT_INTERREFLECTION);
}

/* How a run follows the plan, in a scene that is built as it says: bound, transport, direct_only.
 */
void plan_apply(const plan *p, run_options *o);

/* The table that lux4 plan prints, and its JSON. */
void plan_print(const plan *p);
void plan_print_json(const plan *p);

/* What is said besides of a study's views, where the plan is that of its grids. */
void plan_print_views(const plan *of_views);

#endif
