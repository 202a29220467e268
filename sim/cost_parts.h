/* sim/cost_parts.h -- what the files of cost.h share: cost.c plans and runs, cost_rows.c has the
 * settings, cost_subject.c what they are run on, cost_figures.c what is made of the results.
 */
#ifndef SIM_COST_PARTS_H
#define SIM_COST_PARTS_H

#include "sim/cost.h"

enum {
    COST_RUNS          = 3,
    COST_MOST_SETTINGS = 80,
    COST_TIGHTER       = 3, /* the reference, than the finest rung */
};

/* ---- what is run (cost_subject.c) ------------------------------------------------------------ */

/* The study's first grid, or its first view made small. */
typedef struct cost_subject {
    const study_grid *grid; /* NULL: the view */
    study_view view;
    const char *name;
    double asked; /* the study's accuracy, relative */
} cost_subject;

bool cost_subject_of(const study *s, double accuracy, cost_subject *out, lux_error *err);

/* What one run found: lx a sensor, or cd/m^2 a pixel. */
typedef struct cost_sample {
    int count;
    float *value, *half_width; /* half_width: INFINITY where none is known */
    double floor;              /* a tenth of their average (of a view: of the log-average) */
    double reached;            /* relative: the accuracy that it has */
    double seconds;
    int64_t rays;
    run_end end;
    const char *left_to_chance;
} cost_sample;

bool cost_sample_take(arena *a, const scene *s, const cost_subject *of, const run_options *o,
                      cost_sample *out, lux_error *err);

/* ---- by which settings (cost_rows.c) --------------------------------------------------------- */

typedef struct cost_setting {
    cost_ladder ladder;
    char text[64];
    scene_options scene;
    run_options run;
    double accuracy; /* relative; NAN: that of the rung where all such settings run */
    bool usual;      /* it is what the rung of that accuracy is: figures are the same */
    bool dropped;
    const scene *made; /* its scene, if that is kept from run to run; in `own` */
    arena own;
    int runs;
    cost_sample sample[COST_RUNS];
} cost_setting;

typedef struct cost_list {
    int count, rungs;   /* the first so many are the ladder of accuracy, from coarse to fine */
    uint32_t usual_off; /* of the scene as planned for the study's accuracy */
    cost_setting all[COST_MOST_SETTINGS];
} cost_list;

/* Whether it needs a scene that is neither the usual one nor the one with all effects. */
static inline bool cost_own_scene(const cost_list *l, const cost_setting *s)
{
    const scene_measures *m = &s->scene.measures;
    bool plain = !m->projection_test && !m->nearest_tables && !m->libm_tables && !m->point_sun;
    return !plain || (s->scene.off != l->usual_off && s->scene.off != 0);
}

/* All that make sense for a scene that holds all effects, the plan for it, and the subject. */
void cost_list_make(const scene *s, const plan *p, const cost_subject *of, const cost_options *o,
                    cost_list *out);

/* ---- in what time (cost_time.c) -------------------------------------------------------------- */

/* Seconds for an accuracy as rung k, which has run, tells it; but for the making of a scene. */
double cost_predict(const cost_list *l, int k, double accuracy);

/* The rung at whose accuracy settings besides the ladder run, if `finest` is its last. */
int cost_rung_of_others(const cost_list *l, int finest, double asked);

/* Seconds for all that is left to do once rungs up to k have run once, if rung k + 1 is run, too,
 * (`next`) or the ladder ends there. */
double cost_still_to_do(const cost_list *l, int k, bool next, double asked, double scene_seconds);

/* ---- what is made of it (cost_figures.c) ----------------------------------------------------- */

/* The middle one of n >= 1 (of an even number: the mean of the middle two). */
double cost_median(const double *x, int n);

/* The slope of the straight line through (log x, log y) by least squares; points that are not
 * > 0 left out; NAN if fewer than two different x are left. */
double cost_slope(const double *x, const double *y, int n);

/* Figures of a row, but for what a slope is needed for. */
void cost_row_figures(const cost_sample *runs, int count, const cost_sample *reference,
                      double asked, cost_row *out);

/* Root of the mean of squares of its relative half widths; NAN if one is not known. */
double cost_half_width(const cost_sample *of, const cost_sample *reference);

/* When a row with this noise and bias would have 1 % RMS. */
double cost_seconds_for_1(const cost_row *r, double slope);

/* The slope of r's ladder of accuracy, what follows of it in all rows, and the advice. */
void cost_conclude(cost_row *rows, cost_result *r);

#endif
