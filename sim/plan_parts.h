/* sim/plan_parts.h -- what the files of plan.h share: plan_facts.c looks at the scene,
 * plan_bounds.c says what effects are worth at most, plan_why.c tells it in words, plan_transport.c
 * chooses how interreflected light is found, by what plan_pilot.c tries, plan.c decides.
 */
#ifndef SIM_PLAN_PARTS_H
#define SIM_PLAN_PARTS_H

#include "sim/plan.h"

/* Materials in use, by what they call for. */
typedef struct plan_materials {
    int textured, bumpy, measured, mirrors, solids, hollow;
    double area;                /* m^2, of all surfaces, one side */
    double matt_share;          /* [0, 1], of that; so is the next */
    double bright_share;        /* reflects more than BRIGHT of diffuse light */
    double most, mean;          /* [0, 1]: reflectance as luminance, transmission included */
    double sharpest;            /* of mirrors and panes; by channel the largest */
    const char *first_textured; /* names; NULL */
    const char *first_measured;
} plan_materials;
#define BRIGHT 0.2

typedef struct plan_facts {
    const scene *s;
    const plan_options *o;
    double accuracy;
    const grid_result *grids; /* of the study: sensors alone; NULL if views are planned for */
    double sensors, pixels;   /* all that are to be found, >= 0 */
    bool outside;             /* of a room: some sensor or eye is not within */
    bool sealed;              /* no light from outside comes to any of them */
    plan_materials materials;
} plan_facts;

/* False, with *err, for a points file or a camera that is bad. */
bool plan_look(arena *a, const scene *s, const plan_options *o, plan_facts *out, lux_error *err);

/* What an effect is worth at most where it is on, relative to max(result, a tenth of the average):
 * HUGE_VAL where no bound is known. `direct`: light is not followed on from surfaces. */
double plan_bound(const plan_facts *f, effect e, bool direct);

/* Why an effect that the scene calls for (or does not) is on or off, with numbers. */
void plan_tell(const plan_facts *f, effect e, bool called, plan_effect *to);

/* Fills in out->transport and out->transport_why, by what else is planned. False, with *err: memory
 * is out, or the user stopped it. */
bool plan_transport(const plan_facts *f, plan *out, lux_error *err);

/* Pilots: light of a few sensors or pixels, found both ways with a few samples. */
typedef struct plan_pilot {
    double paths, maps; /* rays to the accuracy asked for, about, as rays of paths cost */
    bool at_once;       /* paths are there so soon that maps were not tried */
    bool too_coarse;    /* maps for it would smooth too much, or be too noisy themselves */
} plan_pilot;

/* For an accuracy. False, with *err, as above. */
bool plan_pilot_run(const plan_facts *f, double accuracy, plan_pilot *out, lux_error *err);

#endif
