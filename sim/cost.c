/* sim/cost.c -- see cost.h. Which settings there is time for, and the order in which they run.
 *
 *     pilot        the ladder of accuracy once, from coarse to fine, until what is left to do would
 *                  not fit into the time
 *     reference    three times as accurate as its finest rung
 *     first pass   all other settings once; then the costliest are dropped until the rest fits
 *     two more     everything again and again, in turns: what slows the machine down for a while
 *                  slows all of them
 */
#include "sim/cost_parts.h"

#include <math.h>
#include <string.h>

/* A scene that is no larger is kept from run to run. */
static const uint64_t most_kept_bytes = 32 << 20;

static const double slack = 1.15; /* runs may take so much longer than the first one did */

/* The bar over the whole tells time alone: what is expected is known after the pilot. */
typedef struct whole_bar {
    progress *outer;
    double begun, expected; /* s */
} whole_bar;

typedef struct cost_work {
    arena *a;
    const study *study;
    const cost_options *o;
    cost_result *out;
    notices *notices;
    lux_error *err;
    cost_subject of;
    const gltf **models;
    const scene *whole, *usual; /* with all effects; as planned */
    cost_list list;
    double scene_seconds; /* to build a scene */
    cost_sample reference;
    whole_bar bar;
    progress inner;
    bool stopped;
} cost_work;

static void draw_whole(void *context, const char *label, double share, double accuracy_percent)
{
    const whole_bar *bar = context;
    (void)label, (void)share;
    progress_update(bar->outer, (clock_seconds() - bar->begun) / bar->expected, accuracy_percent);
}

/* ---- scenes ---------------------------------------------------------------------------------- */

/* Files are read once for all scenes. */
static bool read_models(cost_work *w)
{
    const study *s = w->study;
    w->models      = arena_array(w->a, const gltf *, (size_t)s->scene_count + 1, w->err);
    for (int i = 0; w->models && i < s->scene_count; i++) {
        for (int j = 0; j < i && !w->models[i]; j++)
            if (!strcmp(s->scenes[i].file, s->scenes[j].file))
                w->models[i] = w->models[j];
        if (!w->models[i])
            w->models[i] = gltf_read(w->a, s->scenes[i].file, w->notices, w->err);
        if (!w->models[i])
            return false;
    }
    return w->models != NULL;
}

/* What a scene is warned of is said once, of the first. */
static const scene *build(cost_work *w, arena *a, const scene_options *like, notices *n,
                          lux_error *err)
{
    scene_options o  = *like;
    o.models         = w->models;
    double begun     = clock_seconds();
    const scene *s   = scene_new(a, w->study, &o, n, err);
    w->scene_seconds = fmax(w->scene_seconds, clock_seconds() - begun);
    return s;
}

static bool make_plan(const cost_work *w, double accuracy, plan *out, notices *n)
{
    plan_options p = w->o->plan;
    p.accuracy     = accuracy;
    p.direct_only  = w->o->run.direct_only;
    p.views        = w->of.grid == NULL;
    return plan_make(w->whole, &p, out, n, w->err);
}

/* Each rung as it is planned for its own accuracy. */
static bool plan_rungs(cost_work *w)
{
    for (int k = 0; k < w->list.rungs; k++) {
        cost_setting *s = &w->list.all[k];
        plan own;
        s->run = w->o->run;
        if (!make_plan(w, s->accuracy, &own, NULL))
            return false;
        plan_apply(&own, &s->run);
        s->scene.off = plan_without(&own);
    }
    return true;
}

static bool make_scenes(cost_work *w)
{
    plan p;
    scene_options o = { .threads = w->o->run.threads };
    w->whole        = read_models(w) ? build(w, w->a, &o, w->notices, w->err) : NULL;
    if (!w->whole || !make_plan(w, w->of.asked, &p, w->notices))
        return false;
    cost_list_make(w->whole, &p, &w->of, w->o, &w->list);
    o.off    = w->list.usual_off;
    w->usual = o.off ? build(w, w->a, &o, NULL, w->err) : w->whole;
    return w->usual && plan_rungs(w);
}

static bool is_small(const scene *s)
{
    return world_statistics(s->world).bytes + s->texture_bytes <= most_kept_bytes;
}

/* The scene of a setting; in s->own if it has one of its own. */
static const scene *scene_of(cost_work *w, cost_setting *s, lux_error *err)
{
    if (!cost_own_scene(&w->list, s))
        return s->scene.off == w->list.usual_off ? w->usual : w->whole;
    if (!s->made)
        s->made = build(w, &s->own, &s->scene, NULL, err);
    return s->made;
}

static void keep_or_drop_scene(cost_setting *s)
{
    if (s->made && s->runs < COST_RUNS && is_small(s->made))
        return;
    arena_clear(&s->own);
    s->made = NULL;
}

/* ---- runs ------------------------------------------------------------------------------------ */

/* That one setting cannot run is no reason to stop; nor to lose the others when the user stops. */
static bool pass_over(cost_work *w, cost_setting *s, const lux_error *why)
{
    if (why->code == ERR_MEMORY)
        return failed(w->err, why->code, "%s", why->text);
    if (why->code == ERR_INTERRUPTED) {
        w->stopped = true;
        s->dropped |= s->runs == 0;
        return true;
    }
    notice_add(w->notices, "cost: %s is left out: %s", s->text, why->text);
    s->dropped = true;
    return true;
}

/* Runs a setting once more; a run that time cut short counts only where there is no other. */
static bool run_once(cost_work *w, cost_setting *s)
{
    lux_error why   = { 0 };
    run_options o   = s->run;
    o.accuracy      = s->accuracy;
    o.seed          = w->o->run.seed + (uint32_t)s->runs;
    o.deadline      = w->o->run.deadline;
    o.progress      = &w->inner;
    const scene *of = scene_of(w, s, &why);
    cost_sample *to = &s->sample[s->runs];
    bool good       = of && cost_sample_take(w->a, of, &w->of, &o, to, &why);
    bool cut        = good && (to->end == RUN_LATE || to->end == RUN_INTERRUPTED);
    w->stopped |= good && to->end == RUN_INTERRUPTED;
    if (good && to->end == RUN_LATE)
        w->out->end = RUN_LATE;
    s->runs += good && (!cut || s == &w->list.all[0]);
    s->dropped |= good && s->runs == 0;
    keep_or_drop_scene(s);
    return good || pass_over(w, s, &why);
}

static bool must_stop(const cost_work *w)
{
    return w->stopped || w->out->end == RUN_LATE || progress_stopped(w->o->run.progress);
}

/* ---- the pilot and the reference --------------------------------------------------------------
 */

static double time_left(const cost_work *w) { return w->o->run.deadline - clock_seconds(); }

static void expect(cost_work *w, double more)
{
    w->bar.expected = clock_seconds() - w->bar.begun + fmin(more, fmax(time_left(w), 1e-3));
}

static double still_to_do(const cost_work *w, int k, bool next)
{
    return cost_still_to_do(&w->list, k, next, w->of.asked, w->scene_seconds);
}

/* Climbs the ladder once as far as there is time for; *finest: the last rung. */
static bool climb(cost_work *w, int *finest)
{
    *finest = 0;
    if (!run_once(w, &w->list.all[0]))
        return false;
    while (!must_stop(w) && *finest + 1 < w->list.rungs &&
           still_to_do(w, *finest, true) <= time_left(w)) {
        if (!run_once(w, &w->list.all[*finest + 1]))
            return false;
        if (w->list.all[*finest + 1].runs == 0)
            break;
        ++*finest;
        expect(w, still_to_do(w, *finest, false));
    }
    for (int k = *finest + 1; k < w->list.rungs; k++)
        w->list.all[k].dropped = true;
    return true;
}

/* In the time that the rest leaves, but in a third of all at least. */
static bool run_reference(cost_work *w, int finest)
{
    double rest    = still_to_do(w, finest, false);
    double aim     = w->list.all[finest].accuracy / COST_TIGHTER;
    double alone   = cost_predict(&w->list, finest, aim);
    double left    = time_left(w);
    run_options o  = w->o->run;
    o.accuracy     = aim;
    o.seed         = w->o->run.seed + COST_RUNS;
    o.progress     = &w->inner;
    o.transport    = TRANSPORT_PATH;
    o.deadline     = clock_seconds() + fmax(left - (rest - alone), left / 3.0);
    cost_result *r = w->out;
    if (!cost_sample_take(w->a, w->whole, &w->of, &o, &w->reference, w->err))
        return false;
    if (w->reference.end == RUN_INTERRUPTED)
        return failed(w->err, ERR_INTERRUPTED, "interrupted before there was a reference");
    r->reference_accuracy   = o.accuracy;
    r->reference_half_width = cost_half_width(&w->reference, &w->reference);
    r->reference_seconds    = w->reference.seconds;
    r->left_to_chance       = w->reference.left_to_chance;
    return true;
}

/* ---- all others ------------------------------------------------------------------------------ */

static double rest_of(const cost_work *w)
{
    double rest = 0.0;
    for (int i = 0; i < w->list.count; i++) {
        const cost_setting *s = &w->list.all[i];
        double build          = cost_own_scene(&w->list, s) && !s->made ? w->scene_seconds : 0.0;
        if (!s->dropped && !s->usual)
            rest += (COST_RUNS - s->runs) * (s->sample[0].seconds + build);
    }
    return rest;
}

static void drop_costliest(cost_work *w)
{
    while (slack * rest_of(w) > time_left(w)) {
        cost_setting *most = NULL;
        for (int i = 1; i < w->list.count; i++) {
            cost_setting *s = &w->list.all[i];
            if (!s->dropped && !s->usual &&
                (!most || s->sample[0].seconds > most->sample[0].seconds))
                most = s;
        }
        if (!most)
            return;
        most->dropped = true;
    }
}

static bool first_pass(cost_work *w, int finest)
{
    double accuracy = w->list.all[cost_rung_of_others(&w->list, finest, w->of.asked)].accuracy;
    for (int i = w->list.rungs; i < w->list.count; i++) {
        cost_setting *s = &w->list.all[i];
        s->accuracy     = accuracy;
        if (s->usual)
            continue;
        s->dropped = must_stop(w);
        if (!s->dropped && !run_once(w, s))
            return false;
    }
    return true;
}

static bool other_passes(cost_work *w)
{
    for (int pass = 1; pass < COST_RUNS; pass++)
        for (int i = 0; i < w->list.count && !must_stop(w); i++) {
            cost_setting *s = &w->list.all[i];
            if (!s->dropped && !s->usual && !run_once(w, s))
                return false;
        }
    return true;
}

/* ---- results --------------------------------------------------------------------------------- */

static void make_row(const cost_work *w, const cost_setting *s, cost_row *to)
{
    const cost_setting *from = s;
    for (int k = 0; s->usual && k < w->list.rungs; k++)
        if (w->list.all[k].accuracy == s->accuracy)
            from = &w->list.all[k];
    *to = (cost_row){ .ladder = s->ladder, .accuracy = s->accuracy };
    memcpy(to->setting, s->text, sizeof to->setting);
    cost_row_figures(from->sample, from->runs, &w->reference, w->of.asked, to);
}

static bool conclude(cost_work *w)
{
    cost_result *r       = w->out;
    size_t count         = (size_t)w->list.count;
    cost_row *rows       = arena_array(w->a, cost_row, count, w->err);
    const char **dropped = rows ? arena_array(w->a, const char *, count, w->err) : NULL;
    for (int i = 0; dropped && i < w->list.count; i++) {
        const cost_setting *s = &w->list.all[i];
        char *name            = arena_array(w->a, char, sizeof s->text, w->err);
        if (!name)
            return false;
        memcpy(name, s->text, sizeof s->text);
        if (s->dropped)
            dropped[r->dropped_count++] = name;
        else
            make_row(w, s, &rows[r->row_count++]);
    }
    r->rows    = rows;
    r->dropped = dropped;
    if (!dropped)
        return false;
    cost_conclude(rows, r);
    if (w->stopped || progress_stopped(w->o->run.progress))
        r->end = RUN_INTERRUPTED;
    return true;
}

static bool run_all(cost_work *w)
{
    int finest;
    if (!make_scenes(w))
        return false;
    if (!climb(w, &finest))
        return false;
    if (w->stopped)
        return failed(w->err, ERR_INTERRUPTED, "interrupted before there was a reference");
    if (!run_reference(w, finest) || !first_pass(w, finest))
        return false;
    drop_costliest(w);
    expect(w, rest_of(w));
    return other_passes(w) && conclude(w);
}

bool cost_run(arena *a, const study *s, const cost_options *o, cost_result *out, notices *n,
              lux_error *err)
{
    arena scratch = { 0 };
    cost_work *w  = arena_new(&scratch, cost_work, err);
    *out          = (cost_result){ .end = RUN_DONE };
    bool good     = w != NULL;
    if (good) {
        double now = clock_seconds();
        *w         = (cost_work){ .a       = a,
                                  .study   = s,
                                  .o       = o,
                                  .out     = out,
                                  .notices = n,
                                  .err     = err,
                                  .bar     = { o->run.progress, now, o->run.deadline - now } };
        w->inner   = (progress){ .draw    = draw_whole,
                                 .context = &w->bar,
                                 .stop    = o->run.progress ? o->run.progress->stop : NULL };
        progress_begin(o->run.progress, "cost");
        good = cost_subject_of(s, o->run.accuracy, &w->of, err);
    }
    if (good) {
        out->view  = !w->of.grid;
        out->what  = w->of.name;
        out->asked = w->of.asked;
        good       = run_all(w);
    }
    for (int i = 0; w && i < w->list.count; i++)
        arena_clear(&w->list.all[i].own);
    arena_clear(&scratch);
    return good;
}
